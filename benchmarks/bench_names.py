"""What names do to alignment: synthetic machines without names, and with right and wrong ones, on the same geometry.

`python benchmarks/bench_names.py [--first SEED] [--count N] [--kinds loader,excavator] [--defects sound,…]
[--ways none,en,…] [--out FILE.json]`, from the repository's root. Seeds below 1000 were looked at while the aligner was
written, those from 1000 on are held back. Ways: the six languages; English with typos, cut to ten letters, on the
assemblies only; half of the names dealt out anew, all of them, and names that tell the opposite. Counts as in
`bench_recognition.py`: parts wrong, wrong and not listed for review, listed.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests"), str(ROOT / "benchmarks")]

from bench_recognition import TEMPLATES, judged  # noqa: E402
from kit.machines.defects import spoiled  # noqa: E402
from kit.machines.spoken_names import (  # noqa: E402
    LANGUAGES,
    in_assemblies,
    misleading,
    mistyped,
    named,
    shuffled,
    truncated,
)
from kit.machines.synthetic import disguise  # noqa: E402
from yellowiron.alignment import align  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.assembly import Assembly  # noqa: E402
from yellowiron.model.specification import Specifications  # noqa: E402

Way = Callable[[Assembly, np.random.Generator], Assembly]
RIGHT: dict[str, Way] = {"typos": mistyped, "cut": truncated, "assemblies": in_assemblies}
WRONG: dict[str, Way] = {
    "half wrong": lambda assembly, rng: shuffled(assembly, rng, share=0.5),
    "all shuffled": shuffled,
    "opposite": misleading,
}
WAYS = ("none", *LANGUAGES, *RIGHT, *WRONG)


def called(assembly: Assembly, truth: dict[str, tuple[str, str]], way: str, seed: int, kind: str) -> Assembly:
    """The assembly with its parts named in a way."""
    if way == "none":
        return assembly
    spoken = named(assembly, truth, way if way in LANGUAGES else "en", seed, kind=kind)
    change = {**RIGHT, **WRONG}.get(way)
    return change(spoken, np.random.default_rng([seed, 43])) if change is not None else spoken


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--first", type=int, default=1300)
    parser.add_argument("--count", type=int, default=3)
    parser.add_argument("--kinds", default="loader,excavator")
    parser.add_argument("--defects", default="sound,merged")
    parser.add_argument("--ways", default=",".join(WAYS))
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    rows: list[dict[str, Any]] = []
    for kind in arguments.kinds.split(","):
        template = load_template(TEMPLATES[kind])
        for defect in arguments.defects.split(","):
            for seed in range(arguments.first, arguments.first + arguments.count):
                assembly, truth, _ = disguise(spoiled(kind, seed, defect), seed)
                for way in arguments.ways.split(","):
                    found = align(called(assembly, truth, way, seed, kind), template, Specifications())
                    row = judged(found, truth, template)
                    rows.append({"kind": kind, "defect": defect, "seed": seed, "way": way, **row})
    print(f"{'names':14s} {'machines':>8s} {'parts':>6s} {'wrong':>6s} {'silent':>6s} {'listed':>6s} {'worse':>6s}")
    bare = {(r["kind"], r["defect"], r["seed"]): r["wrong"] for r in rows if r["way"] == "none"}
    for way in arguments.ways.split(","):
        of = [r for r in rows if r["way"] == way]
        worse = sum(r["wrong"] > bare.get((r["kind"], r["defect"], r["seed"]), r["wrong"]) for r in of)
        counts = [sum(r[k] for r in of) for k in ("parts", "wrong", "silent", "flagged")]
        print(f"{way:14s} {len(of):8d} {counts[0]:6d} {counts[1]:6d} {counts[2]:6d} {counts[3]:6d} {worse:6d}")
    if arguments.out is not None:
        arguments.out.write_text(json.dumps(rows, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
