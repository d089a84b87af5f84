"""How long alignment takes and how right it is: the example machine and synthetic loaders, with and without names.

Run from the repository's root: `python benchmarks/bench_align.py [SEEDS]`. Times are wall and CPU seconds of `align`
alone, one thread; "silent" counts wrong parts that are not listed for review. Seeds below 100 were looked at while the
aligner was written, those from 1000 on were not.
"""

from __future__ import annotations

import json
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests" / "align")]

from synthetic import disguise, loader  # noqa: E402

from yellowiron.align import align  # noqa: E402
from yellowiron.cad import read_cad  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.assembly import Assembly  # noqa: E402
from yellowiron.model.specification import Specifications  # noqa: E402

TEMPLATE = load_template("wheel_loader")
PINS = {r.name for r in TEMPLATE.roles if r.kind == "pin"}


def measured(label: str, assembly: Assembly, truth: dict[str, tuple[str, str]]) -> tuple[int, int, int, int]:
    """One alignment: prints a line; (parts, wrong, silent, to review)."""
    wall, cpu = time.perf_counter(), time.process_time()
    found = align(assembly, TEMPLATE, Specifications())
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    wrong = []
    for p in found.parts:
        role, body = truth[p.part]
        if body and (p.body != body or ((p.role in PINS or role in PINS) and p.role != role)):
            wrong.append(p.part)
    silent = len(set(wrong) - set(found.to_review))
    print(
        f"{label:34s} {len(found.parts):4d} parts  wrong {len(wrong):3d}  silent {silent:3d}  "
        f"review {len(found.to_review):3d}  missing {len(found.missing):2d}  {wall:5.2f} s wall  {cpu:5.2f} s CPU"
    )
    return len(found.parts), len(wrong), silent, len(found.to_review)


def example() -> None:
    """The example machine, with its names and as a stranger sends it."""
    folder = ROOT / "examples" / "wheel_loader"
    assembly = read_cad(folder / "wheel_loader.step")
    parts = json.loads((folder / "truth.json").read_text(encoding="utf-8"))["parts"]
    truth = {k: (v["role"], v["body"]) for k, v in parts.items()}
    measured("example, names", assembly, truth)
    order = np.random.default_rng(0).permutation(len(assembly.parts))
    bare, ids = [], {}
    for number, k in enumerate(order, 1):
        part = assembly.parts[int(k)]
        name = f"Part_{number:03d}"
        ids[name] = truth[part.id]
        bare.append(replace(part, id=name, name=name, path=()))
    measured("example, Part_001 …", replace(assembly, parts=tuple(bare)), ids)


def synthetic(first: int, count: int) -> None:
    """Synthetic loaders without names, turned and shuffled, in four manners of drawing."""
    for manner in ({}, {"embedded": True}, {"embedded": True, "stop": True}, {"embedded": True, "hoses": 8}):
        total = np.zeros(4, dtype=int)
        for seed in range(first, first + count):
            assembly, truth, _ = disguise(loader(seed, **manner), seed)
            total += measured(f"seed {seed} {' '.join(manner)}", assembly, truth)
        print(f"  = {total[0]} parts, {total[1]} wrong, {total[2]} silent, {total[3]} to review")


if __name__ == "__main__":
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    example()
    synthetic(0, seeds)
    synthetic(1000, seeds)
