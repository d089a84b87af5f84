"""Where the bodies of a type usually are, and how large: `usual.json` of its template, from the machines we can draw.

    python benchmarks/fit_usual.py [--first SEED] [--count N] [--only TYPE]

From the repository's root. For every body: the box that the middle 90 % of its surface takes (forward, left, up, in
machine sizes, as `alignment.fusion.stance` finds the frame, its front where it is), over all machines; its length and
its share of the surface (medians and the spread of their logarithms). For what hangs on a limb (`LIMBS`), the same box
in the limb's own frame, in its lengths (`along`, as `alignment.fusion.limbs` finds it).
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests")]

from kit.machines.defects import drawn  # noqa: E402
from kit.machines.synthetic import disguise  # noqa: E402
from yellowiron.alignment.features.solids import size_of, solids_of  # noqa: E402
from yellowiron.alignment.features.wheels import rolling_of  # noqa: E402
from yellowiron.alignment.fusion.limbs import limb_of  # noqa: E402
from yellowiron.alignment.fusion.stance import on_wheels, stance_of, surface_points  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.template import Template  # noqa: E402

TYPES = {
    "wheel_loader": ("loader", "parallel_loader"), "excavator": ("excavator", "mini"), "skid_steer": ("skid_steer",),
    "articulated_dump_truck": ("articulated_truck",), "rigid_dump_truck": ("rigid_truck",),
    "backhoe_loader": ("backhoe",), "roller": ("roller", "yoke_roller"), "forklift": ("forklift",),
    "telehandler": ("telehandler",), "dozer": ("dozer", "rocking_dozer"),
    "wheeled_excavator": ("wheeled_excavator",), "mobile_crane": ("crane",), "grader": ("grader",),
}  # fmt: skip
"""Type → kinds of machines that we draw of it; a body is measured on the first kind that has it."""
LIMBS = {
    "excavator": {
        ("arm", "bucket"): (
            "bucket_cylinder_barrel", "bucket_piston_rod", "tipping_link", "bucket_link", "arm_piston_rod",
        ),
    },
}  # fmt: skip
"""Type → limb, with what its end carries → the bodies of linkages whose places on it are measured."""
KEPT = 0.05
"""This share of a body's surface is left out at either end of its box."""


def seen(kind: str, seed: int, template: Template) -> dict[str, tuple[np.ndarray, float, float]]:
    """Body → points of its surface in the machine's frame and in sizes, its length, its share of the surface."""
    machine = drawn(kind, seed)
    assembly, truth, back = disguise(machine, seed, rotate=False)
    solids = solids_of(assembly)
    size = size_of(solids)
    stance = on_wheels(stance_of(solids, size), rolling_of(solids, template, set(), 1e-3 * size))
    if (stance.rotation @ back[:3, :3].T)[0, 0] < 0.0:
        stance = stance.turned()  # the judge tries either end as the front
    if np.abs(stance.rotation @ back[:3, :3].T - np.eye(3)).max() > 0.3:
        return {}
    groups: dict[str, list] = {}
    for solid in solids:
        role, body = truth[solid.part.id]
        groups.setdefault(body, []).append(solid) if body and not role.endswith("_pin") else None
    total = sum(s.surface for s in solids)
    found = {}
    for body, group in groups.items():
        points = stance.place(surface_points(group, 200))
        spread = np.ptp(points @ np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2].T, axis=0)
        found[body] = (points, float(spread.max()), sum(s.surface for s in group) / total)
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--only", choices=sorted(TYPES), help="a type; without it all of them")
    given = parser.parse_args()
    for name, kinds in TYPES.items():
        if given.only not in (None, name):
            continue
        bodies: dict[str, list] = {}
        on_limbs: dict[str, tuple[str, str, list]] = {}
        template = load_template(name)
        for kind in kinds:
            own: dict[str, list] = {}
            for seed in range(given.first, given.first + given.count):
                there = seen(kind, seed, template)
                for body, what in there.items():
                    own.setdefault(body, []).append(what)
                for (limb, toward), hanging in LIMBS.get(name, {}).items():
                    if kind == kinds[0] and {limb, toward} <= there.keys():
                        lies = limb_of(there[limb][0], there[toward][0])
                        for body in there.keys() & {*hanging}:
                            on_limbs.setdefault(body, (limb, toward, []))[2].append(lies.place(there[body][0]))
            bodies = own | bodies
        table = {}
        known = {r.name for r in template.roles if r.rigid and not r.many}
        for body, whats in sorted(b for b in bodies.items() if b[0] in known):
            points = np.concatenate([w[0] for w in whats])
            low, high = np.quantile(points, [KEPT, 1 - KEPT], axis=0)
            length, area = np.array([w[1] for w in whats]), np.array([w[2] for w in whats])
            table[body] = {
                "low": low.round(3).tolist(), "high": high.round(3).tolist(),
                "length": round(float(np.median(length)), 3), "area": round(float(np.median(area)), 5),
            }  # fmt: skip
            if body in on_limbs:
                limb, toward, places = on_limbs[body]
                low, high = np.quantile(np.concatenate(places), [KEPT, 1 - KEPT], axis=0)
                table[body]["along"] = {
                    "limb": limb, "toward": toward, "low": low.round(3).tolist(), "high": high.round(3).tolist(),
                }  # fmt: skip
        rows = ",\n".join(f' "{body}": {json.dumps(row)}' for body, row in table.items())
        path = ROOT / "src/yellowiron/library/data" / name / "usual.json"
        path.write_text("{\n" + rows + "\n}\n", encoding="utf-8")
        sys.stdout.write(f"{path}: {len(table)} bodies\n")


if __name__ == "__main__":
    main()
