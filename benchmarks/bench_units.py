"""How often the unit of a model without one is told right, no sheet helping: strangers' models and drawn machines.

    python benchmarks/bench_units.py [--models DIR[:DIR]] [--only NAME,…] [--count N] [--words]

From the repository's root. Each machine is written in numbers of metres, millimetres, centimetres, inches and feet, and
in metres, inches and feet whose factor a program applied once more (`twice`, `m as mm`); then read as a file without a
unit (CAD009) and scaled as `yellowiron align` does. The scale is right if the machine comes out at 0.5 to 2 times its
true size. True is how large a model is drawn; of those without a size of their own (games, toys) what such machines
usually are, `LONG`. Drawn machines have the seeds from 3000 on, `--count` of each kind.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests"), str(ROOT / "benchmarks")]

from bench_recognition import TEMPLATES  # noqa: E402
from kit.machines.defects import drawn as drawn_machine  # noqa: E402
from strangers_models import models  # noqa: E402
from yellowiron.alignment import to_scale  # noqa: E402
from yellowiron.alignment.assignment.unit_scale import scaled  # noqa: E402
from yellowiron.cad import read_cad  # noqa: E402
from yellowiron.cad.mesh.assembly import guessed_unit  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.assembly import Assembly  # noqa: E402
from yellowiron.model.specification import Specifications  # noqa: E402

WRITTEN = {
    "m": 1.0, "mm": 1e3, "cm": 1e2, "inch": 1 / 0.0254, "foot": 1 / 0.3048,
    "m as mm": 1e-3, "m as cm": 1e-2, "in twice": 0.0254, "ft twice": 0.3048,
}  # fmt: skip
"""What a metre is in a file's numbers."""
DRAWN = {
    **TEMPLATES, "skid_steer": "skid_steer", "articulated_truck": "articulated_dump_truck", "grader": "grader",
    "rigid_truck": "rigid_dump_truck", "dozer": "dozer",
}  # fmt: skip
RIGHT = (0.5, 2.0)
LONG = {
    "andreneder_dump_truck": 9.2, "clem_excavator": 9.5, "erdogankir_excavator": 9.5, "gaia_dump_truck": 9.2,
    "gaia_excavator": 9.5, "gaia_wheel_loader": 8.0, "kimsonun_dump_truck": 9.2, "nattthan_dozer": 5.5,
    "sarisman_excavator": 9.5, "trailer_wheel_loader": 8.0,
}  # fmt: skip
"""Metres across the box of models that have no size of their own: what such machines usually are."""


def _length(assembly: Assembly) -> float:
    points = np.concatenate([assembly.points_of(p) for p in assembly.parts])
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def ratio(drawn: Assembly, kind: str, numbers: float, true: float) -> tuple[float, list[str]]:
    """The size that a model is given, written so that a metre is so many `numbers`, as a share of the true one."""
    points = [drawn.points_of(p) * numbers for p in drawn.parts]
    unit, findings = guessed_unit(points, "model")
    read = replace(scaled(drawn, numbers * unit), unit=unit, findings=tuple(findings))
    found = to_scale(read, load_template(kind), Specifications())
    words = [f.message for f in found.findings if f.code == "ALN014"]
    return numbers * found.unit / true, words


def machines(chosen: argparse.Namespace) -> Iterator[tuple[str, str, Assembly, float]]:
    """Name, type, model, and the scale that it should have had."""
    for model in models([Path(f) for f in chosen.models.split(":") if f]):
        wanted = not chosen.only or model.name in chosen.only.split(",")
        if model.cad is None or model.held_back or not wanted:
            continue
        drawn = read_cad(model.cad)
        true = LONG[model.name] / _length(drawn) if model.name in LONG else 1.0
        yield model.name, model.labels.get("template", "excavator"), drawn, true
    for kind, template in DRAWN.items():
        for seed in range(3000, 3000 + chosen.count):
            yield f"drawn {kind} {seed}", template, drawn_machine(kind, seed).assembly(), 1.0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", default=os.environ.get("YELLOWIRON_STRANGERS", ""))
    parser.add_argument("--only", default="")
    parser.add_argument("--count", type=int, default=3)
    parser.add_argument("--words", action="store_true", help="what is said of each")
    chosen = parser.parse_args()
    right: dict[str, list[bool]] = defaultdict(list)
    print(f"{'size it is given / true':28s}" + "".join(f"{name:>10s}" for name in WRITTEN))
    for name, kind, drawn, true in machines(chosen):
        line = f"{name:28s}"
        said = []
        for written, numbers in WRITTEN.items():
            share, words = ratio(drawn, kind, numbers, true)
            right[written].append(RIGHT[0] <= share <= RIGHT[1])
            line += f"{share:9.3g}" + (" " if right[written][-1] else "!")
            said += [f"    {written}: {w}" for w in words]
        print(line, flush=True)
        for text in said if chosen.words else ():
            print(text)
    totals = "".join(f"{sum(r):7d}/{len(r):<2d}" for r in right.values())
    print(f"{'right':28s}{totals}  all {sum(map(sum, right.values()))}/{sum(map(len, right.values()))}")


if __name__ == "__main__":
    main()
