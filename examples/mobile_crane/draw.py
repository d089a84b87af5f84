"""Draws a rough-terrain crane of the Tadano GR-250N class as one STEP assembly, its sheet, and the truth about it: on
its outriggers, or in road order.

`python -m mobile_crane.draw FOLDER`, run in `examples/`, writes `mobile_crane.step`, `specifications.pdf` and
`truth.json`; the same bytes every time. The values it is drawn to are in `values.py`.
"""

from __future__ import annotations

import math
from pathlib import Path

from drawing.cylinders import Cylinder, draw_cylinder
from drawing.files import run, write_example
from drawing.hardware import placed
from drawing.planar import Point, direction
from drawing.product import Assembly, Use
from drawing.steer_axle import draw_steer_axle
from drawing.wheels import WheelSizes, draw_wheel, put_wheels, wheel_places

from . import values as v
from .boom import draw_boom, draw_head, draw_hoist, telescope
from .carrier import GROUNDED, draw_frame, draw_outriggers
from .linkage import HALF_BASE, RADIUS, Pose, barrel, luffing, solve_axle
from .sheet import write
from .superstructure import draw_superstructure
from .truth import FRAME, truth

POSES = {
    "working": Pose(math.radians(60.0), 0.1, 0.99, GROUNDED),
    "road": Pose(math.radians(4.0), 0.002, 0.005, 0.02),
}
"""On its outriggers, boom up and drawn out a little; in road order."""
_SIZES: dict[str, tuple[str, str, tuple[float, ...]]] = {
    "luffing": ("LUFFING CYL", "LUFFING", (350, 120, 110, 200, 190, 60, 130, 130)),
    "telescope": ("TELESCOPE CYL", "TELESCOPE", (162, 80, 60, 140, 120, 40, 120, 100)),
}
"""Name, prefix of its values; outside, pin, eye, eye's width, base, cap, piston, gland in millimetres."""


def pins(pose: Pose) -> dict[str, tuple[Point, Point]]:
    """Of the cylinders in the plane y = 0: barrel's and rod's."""
    x, z = barrel()
    start = pose.rod * 0.0
    start[:] = x, z
    return {"luffing": (start, pose.rod), "telescope": telescope(pose)}


def cylinders(pose: Pose) -> dict[str, Cylinder]:
    """Sizes of both of them, at their drawn lengths."""
    drawn = {
        "luffing": luffing(pose.boom),
        "telescope": v.TELESCOPE_CLOSED.value + pose.out * v.TELESCOPE_STROKE.value,
    }
    found = {}
    for name, (title, key, sizes) in _SIZES.items():
        outside, pin, eye, width, base, cap, piston, gland = sizes
        bore, shaft, stroke, closed = (getattr(v, f"{key}_{x}").value for x in ("BORE", "ROD", "STROKE", "CLOSED"))
        found[name] = Cylinder(
            title, bore, shaft, stroke, closed, drawn[name], outside=outside, pin=pin, eye=eye, eye_width=width,
            base=base, cap=cap, piston=piston, gland=gland, port=8.0,
        )  # fmt: skip
    return found


def draw_machine(pose: Pose) -> Assembly:
    """The whole product tree, in the machine frame."""
    hardware, root, wheels, rams = (Assembly(n) for n in ("PINS", "MOBILE CRANE GA", "WHEELS", "HYDRAULIC CYLINDERS"))
    size = WheelSizes("385/95R25", RADIUS, v.TYRE_WIDTH.value, 330.0, 60.0, 160.0, 10, inner=185.0)
    treads = {"front": (HALF_BASE, v.TREAD.value), "rear": (-HALF_BASE, v.TREAD.value)}
    put_wheels(wheels, draw_wheel(size), wheel_places(treads, RADIUS))
    carrier, boom = Assembly("CARRIER"), Assembly("BOOM GP")
    carrier.add(draw_frame())
    for end in ("front", "rear"):
        carrier.add(draw_steer_axle(solve_axle(end), hardware))
        carrier.add(draw_outriggers(end, pose))
    for part in (draw_boom(pose, hardware), draw_head(pose, hardware), draw_hoist(pose)):
        boom.add(part)
    sizes = cylinders(pose)
    for name, (start, end_pin) in pins(pose).items():
        halves = {"barrel": f"{name}_cylinder_barrel", "rod": f"{name}_piston_rod"}
        at = placed((float(start[0]), 0.0, float(start[1])), direction(end_pin - start))
        rams.uses.append(Use(draw_cylinder(sizes[name]), at, names=halves))
    for child in (carrier, draw_superstructure(hardware), boom, wheels, rams, hardware):
        root.add(child)
    return root


def main(folder: Path, kind: str = "working") -> None:
    """Writes the three files of the crane, `working` or in `road` order, into `folder`."""
    pose = POSES[kind]
    root = draw_machine(pose)
    write_example(folder, "mobile_crane", root, FRAME, truth(root, pose, cylinders(pose), pins(pose)), write)


if __name__ == "__main__":
    run(main, __file__)
