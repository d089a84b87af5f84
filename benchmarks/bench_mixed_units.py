"""What parts in another unit than the rest of their file cost: one part and three, of drawn machines and real models.

    python benchmarks/bench_mixed_units.py MACHINE,… [--models DIR[:DIR]] [--seed N] [--words]

From the repository's root. A MACHINE is `loader:3000` (a drawn one and its seed) or an open label of
`benchmarks/strangers`, read with its names (`NAME/without`: without). The parts are made `RATIOS` times as large about
the file's origin: one, drawn by lot by its share of the surface, and three, each as likely. Per cent of the surface
that is right, wrong without a word, and listed for review (`own`: what the parts have of it), and how many of them are
as large as before. What was not put right is scored as if it had been.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections import defaultdict
from collections.abc import Collection, Iterator
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests"), str(ROOT / "benchmarks")]

from bench_units import DRAWN  # noqa: E402
from kit.machines.another_unit import in_another_unit  # noqa: E402
from kit.machines.defects import drawn as drawn_machine  # noqa: E402
from kit.scene import Surface, placed, read  # noqa: E402
from kit.scoring import score  # noqa: E402
from strangers_models import models, scene_of  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.assembly import Assembly, Part  # noqa: E402
from yellowiron.model.errors import YellowironError  # noqa: E402
from yellowiron.model.specification import Specifications  # noqa: E402
from yellowiron.stages import find_roles  # noqa: E402

RATIOS = (1e3, 1e-3, 25.4, 1 / 25.4)


def restored(
    model: Assembly, sound: Assembly, parts: Collection[str], ratio: float, truth: Surface
) -> tuple[Assembly, int]:
    """The model with what of these parts is still in another unit put right, and how many were already."""

    def extent(assembly: Assembly, part: Part) -> float:
        return float(np.ptp(assembly.points_of(part), axis=0).max())

    known = {p.id: p for p in sound.parts if p.id not in parts}
    scale = [extent(model, p) / extent(sound, known[p.id]) for p in model.parts if p.id in known]
    factor, tree = float(np.median(scale)) if scale else 1.0, cKDTree(truth.points)
    left, right = set(), 0
    for part in model.parts:
        if part.id in known or not any(part.id == p or part.id.startswith(f"{p}/") for p in parts):
            continue
        centres = model.points_of(part)[model.shape_of(part).mesh.triangles].mean(axis=1)[::7] / factor
        far = [float(np.median(tree.query(centres * f)[0])) for f in (1.0, 1.0 / ratio)]
        left |= {part.id} if far[1] < far[0] else set()
        right += far[1] >= far[0]
    return in_another_unit(model, left, 1.0 / ratio), right


def machines(names: str, folders: str) -> Iterator[tuple[str, str, Assembly, Surface]]:
    """Name, type, model and truth."""
    for name in names.split(","):
        if ":" in name:
            kind, seed = name.split(":")
            machine = drawn_machine(kind, int(seed))
            yield name, DRAWN[kind], *read(machine, int(seed), placed(int(seed), "upright"), None)
            continue
        label, _, naming = name.partition("/")
        (model,) = (m for m in models([Path(f) for f in folders.split(":") if f]) if m.name == label)
        if not model.held_back:
            scene = scene_of(model, names=naming or "with")
            yield name, scene.type, scene.assembly, scene.truth


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("machines")
    parser.add_argument("--models", default=os.environ.get("YELLOWIRON_STRANGERS", ""))
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--words", action="store_true")
    chosen = parser.parse_args()
    totals: dict[str, list[tuple[float, ...]]] = defaultdict(list)
    for name, kind, sound, truth in machines(chosen.machines, chosen.models):
        template = load_template(kind)
        scales = [abs(float(np.linalg.det(p.transform[:3, :3]))) ** (2 / 3) for p in sound.parts]
        areas = np.array([sound.shape_of(p).area for p in sound.parts]) * scales
        for number, (ratio, count) in enumerate([(1.0, 0), *((r, c) for c in (1, 3) for r in RATIOS)]):
            rng = np.random.default_rng([chosen.seed, number, 7])
            some = rng.permutation(len(areas))[:count]
            if count == 1:
                some = rng.choice(len(areas), size=1, p=areas / areas.sum())
            parts = {sound.parts[i].id for i in some.tolist()}
            case = f"{count} x{ratio:.4g}"
            try:
                model, found = find_roles(in_another_unit(sound, parts, ratio), template, Specifications())
            except YellowironError as error:
                print(f"{name:28s} {case:10s} {error}", flush=True)
                continue
            back, right = restored(model, sound, parts, ratio, truth)
            result = score(back, found, None, truth, (), 1.0, template)
            shares = [100 * v / result.area for v in (result.right, result.silent, result.flagged)]
            totals[case].append((*shares, right, count))
            own = 100 * areas[some].sum() / areas.sum()
            text = f"{name:28s} {case:10s} own {own:5.1f} area {shares[0]:6.2f} silent {shares[1]:6.2f} "
            print(f"{text}listed {shares[2]:6.2f} put right {right}/{count}", flush=True)
            for words in (*result.silent_words, *(f.message for f in found.findings if f.code == "ALN033")):
                if chosen.words:
                    print(f"    {words}")
    for case, rows in totals.items():
        table = np.array(rows)
        area, silent = table[:, 0], table[:, 1]
        text = f"{case:10s} area {area.mean():6.2f} silent {silent.mean():6.2f} worst {silent.max():6.2f}"
        print(f"{text} put right {table[:, 3].sum():.0f}/{table[:, 4].sum():.0f}")


if __name__ == "__main__":
    main()
