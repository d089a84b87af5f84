"""Draws a wheeled excavator of the JCB JS160W class as one STEP assembly, its sheet, and the truth about it.

`python -m wheeled_excavator.draw FOLDER`, run in `examples/`, writes `wheeled_excavator.step`, `specifications.pdf` and
`truth.json`; the same bytes every time. The values it is drawn to are in `values.py`.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass
from pathlib import Path

from drawing.cylinders import Cylinder, draw_cylinder, put_pair
from drawing.digger import Linkage, Pose
from drawing.files import run, write_example
from drawing.hardware import placed
from drawing.planar import direction
from drawing.product import Assembly, Use
from drawing.stabiliser import RAISED, draw_stabilisers, put_stabiliser_cylinders
from drawing.steer_axle import draw_steer_axle
from drawing.wheels import WheelSizes, draw_wheel, put_wheels, wheel_places
from excavator.bucket import Sizes, draw_bucket, draw_bucket_link, draw_tipping_links
from excavator.equipment import CYLINDER_Y, draw_arm, draw_boom

from . import values as v
from .carrier import draw_undercarriage, draw_upper
from .linkage import FRONT_X, LEG_X, RADIUS, REAR_X, SPINDLE, STROKES, TREAD, solve, solve_axle, solve_stabiliser
from .sheet import write
from .truth import FRAME, truth

SHARES = {"boom": 0.62, "arm": 0.4, "bucket": 0.62, "stabilizer": 0.15}
"""How far out the cylinders are drawn: neither end of a stroke, the bucket clear of the ground, the legs up."""
_SIZES: dict[str, tuple[float, ...]] = {
    "boom": (142, 90, 80, 110, 150, 40, 90, 105),
    "arm": (154, 90, 88, 124, 160, 45, 95, 110),
    "bucket": (134, 80, 76, 110, 145, 40, 85, 100),
    "stabilizer": (96, 40, 34, 46, 58, 20, 42, 46),
}
"""Outside, pin, eye, eye's width, base, cap, piston, gland; millimetres."""
BUCKET = Sizes(v.BUCKET_WIDTH.value, v.BUCKET_CAPACITY.value, v.WALL_DEPTH.value, 0.92)
WHEELS = wheel_places({"front": (FRONT_X, TREAD), "rear": (REAR_X, TREAD)}, RADIUS)


@functools.cache
def cylinders() -> dict[str, Cylinder]:
    """Sizes of a cylinder of each kind, at its drawn length."""
    closed = {"boom": STROKES.boom[0], "arm": STROKES.arm[0], "bucket": STROKES.bucket[0]}
    closed["stabilizer"] = solve_stabiliser().length(RAISED)
    found = {}
    for name, sizes in _SIZES.items():
        key = name.upper().replace("Z", "S")
        bore, rod, stroke = (getattr(v, f"{key}_{what}").value for what in ("BORE", "ROD", "STROKE"))
        outside, pin, eye, width, base, cap, piston, gland = sizes
        found[name] = Cylinder(
            f"{key} CYLINDER", bore, rod, stroke, closed[name], closed[name] + SHARES[name] * stroke, outside=outside,
            pin=pin, eye=eye, eye_width=width, base=base, cap=cap, piston=piston, gland=gland, port=14.0,
        )  # fmt: skip
    return found


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """The linkages as they stand in the file."""

    k: Linkage
    pose: Pose
    leg: float


@functools.cache
def drawn() -> Drawn:
    """How the machine stands in the file."""
    k, sizes = solve(), cylinders()
    pose = k.pose(*(sizes[name].drawn for name in ("boom", "arm", "bucket")))
    return Drawn(k, pose, solve_stabiliser().angle(sizes["stabilizer"].drawn))


def draw_cylinders(d: Drawn) -> Assembly:
    """All cylinders, in one assembly as a parts book has them."""
    tree, k, pose = Assembly("HYDRAULIC CYLINDERS"), d.k, d.pose
    start, end = ((float(p[0]), CYLINDER_Y, float(p[1])) for p in (k.C, pose.D))
    put_pair(tree, draw_cylinder(cylinders()["boom"]), "boom", start, end)
    for name, p, q in (("arm", pose.M, pose.P), ("bucket", pose.E, pose.H)):
        child = draw_cylinder(cylinders()[name], pin_fast_in_rod=name == "bucket")
        at = placed((float(p[0]), 0.0, float(p[1])), direction(q - p))
        tree.uses.append(Use(child, at, names={"barrel": f"{name}_cylinder_barrel", "rod": f"{name}_piston_rod"}))
    put_stabiliser_cylinders(tree, draw_cylinder(cylinders()["stabilizer"]), solve_stabiliser(), d.leg, sum(LEG_X) / 2)
    return tree


def draw_machine() -> Assembly:
    """The whole product tree, in the machine frame."""
    d, hardware, root = drawn(), Assembly("PINS"), Assembly("WHEELED EXCAVATOR GA")
    work, wheels = Assembly("WORK EQUIPMENT"), Assembly("WHEELS")
    for part in (draw_boom, draw_arm, draw_tipping_links):
        work.add(part(d.k, d.pose, hardware))
    work.add(draw_bucket_link(d.k, d.pose))
    work.add(draw_bucket(d.k, d.pose, hardware, BUCKET))
    size = WheelSizes("18R19.5", RADIUS, v.TYRE_WIDTH.value, 262.0, SPINDLE, 140.0, 10, inner=190.0)
    put_wheels(wheels, draw_wheel(size), WHEELS)
    legs = draw_stabilisers(solve_stabiliser(), d.leg, LEG_X, hardware)
    for child in (
        draw_undercarriage(hardware), draw_steer_axle(solve_axle(), hardware), legs, draw_upper(d.k, hardware), work,
        wheels, draw_cylinders(d), hardware,
    ):  # fmt: skip
        root.add(child)
    return root


def main(folder: Path) -> None:
    """Writes the three files into `folder`."""
    root = draw_machine()
    write_example(folder, "wheeled_excavator", root, FRAME, truth(root, drawn(), cylinders()), write)


if __name__ == "__main__":
    run(main, __file__)
