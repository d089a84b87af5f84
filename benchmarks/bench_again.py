"""What a second build takes: the same again, with one value changed, with one part's role changed.

    python benchmarks/bench_again.py [--cad FILE --type TYPE --specs PDF]

Each build is a process of its own, from its start to its end, into one folder, with a cache of its own; the alternative
that it is measured against is the first, which has kept nothing to go by.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
EXAMPLE = ROOT / "examples" / "wheel_loader"


def main() -> None:
    """Prints a row a build."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--type", default="wheel_loader")
    parser.add_argument("--cad", type=Path, default=EXAMPLE / "wheel_loader.step")
    parser.add_argument("--specs", type=Path, default=None)
    parser.add_argument("--set", default="Lift Cylinder Stroke=700 mm")
    given = parser.parse_args()
    sheet = given.specs or (EXAMPLE / "specifications.pdf" if given.cad.parent == EXAMPLE else None)
    with tempfile.TemporaryDirectory() as folder:
        out, environment = Path(folder, "out"), {**os.environ, "YELLOWIRON_CACHE": str(Path(folder, "cache"))}
        command = [
            sys.executable,
            "-m",
            "yellowiron",
            "build",
            given.type,
            "--cad",
            str(given.cad),
            "--out",
            str(out),
            "-q",
        ]
        command += ["--specs", str(sheet)] if sheet is not None else []

        def build(*more: str) -> tuple[float, dict[str, float]]:
            start = time.perf_counter()
            subprocess.run([*command, *more], env=environment, check=False)
            return time.perf_counter() - start, json.loads((out / "timings.json").read_text(encoding="utf-8"))

        rows = [("first", *build()), ("the same again", *build()), ("one value", *build("--set", given.set))]
        file = out / "alignment.json"
        document = json.loads(file.read_text(encoding="utf-8"))
        entry = next(e for e in document["parts"] if e["role"] and e["role"] == e["body"])
        entry["source"] = "confirmed"
        file.write_text(json.dumps(document), encoding="utf-8")
        rows.append(("one part confirmed", *build()))
    stages = [name for name in rows[0][2] if name != "total"]
    print(f"{'':20s} {'whole s':>8s} {'share':>6s}  " + "  ".join(f"{name:>9s}" for name in stages))
    for name, seconds, timings in rows:
        each = "  ".join(f"{timings[stage]:9.2f}" for stage in stages)
        print(f"{name:20s} {seconds:8.2f} {seconds / rows[0][1]:6.2f}  {each}")


if __name__ == "__main__":
    main()
