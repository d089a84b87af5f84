"""Times the stages of a build of the example machine, and prints them against what the papers report for theirs.

Run with `python benchmarks/bench_build.py [--runs N]`. The papers' figures are a person's or a program's time on a
Caterpillar 982M (journal paper, Table 2 and section 4.2.2) and on an excavator (conference paper, section 4.2).
"""

from __future__ import annotations

import argparse
import json
import statistics
import tempfile
from pathlib import Path

from rich.console import Console
from rich.table import Table

from yellowiron.pipeline import build

ROOT = Path(__file__).resolve().parent.parent
PAPER = {
    "extract": (6.0, "language model, journal paper Table 2"),
    "align": (3 * 3600.0, "a person renaming and re-parenting, journal paper Table 2"),
    "mechanism + write": (7.0, "fusion program, journal paper section 4.2.2 (conference paper: 2 s)"),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--example", type=Path, default=ROOT / "examples" / "wheel_loader")
    arguments = parser.parse_args()
    cad = next(arguments.example.glob("*.step"))
    timings: list[dict[str, float]] = []
    for _ in range(arguments.runs):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder, "machine")
            build(arguments.example.name, cad, out, sheets=[arguments.example / "specifications.pdf"])
            timings.append(json.loads((out / "timings.json").read_text(encoding="utf-8")))
    for seconds in timings:
        seconds["mechanism + write"] = seconds["mechanism"] + seconds["write"]
    table = Table("stage", "median s", "paper s", "paper / ours", "what the paper timed")
    for stage in timings[0]:
        median = statistics.median(t[stage] for t in timings)
        paper, what = PAPER.get(stage, (None, ""))
        ratio = f"{paper / median:,.0f} ×" if paper else ""
        table.add_row(stage, f"{median:.2f}", f"{paper:g}" if paper else "", ratio, what)
    Console(width=140).print(table)


if __name__ == "__main__":
    main()
