"""Draws a telehandler of the JCB 530-70 class, whose boom has two sections, as one STEP assembly, its sheet, and the
truth about it; or one of no maker with three sections, stabilisers and a levelled frame.

`python -m telehandler.draw FOLDER`, run in `examples/`, writes `telehandler.step`, `specifications.pdf` and
`truth.json`; the same bytes every time. The values it is drawn to are in `values.py`.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from pathlib import Path

from drawing.cylinders import Cylinder, draw_cylinder
from drawing.files import run, write_example
from drawing.hardware import placed
from drawing.planar import Point, direction
from drawing.product import GREY, Assembly, Part, Use
from drawing.solids import Vector, X, bored, frame, plate, rod, shift
from drawing.stabiliser import RAISED, draw_stabilisers
from drawing.steer_axle import draw_steer_axle
from drawing.wheels import WheelSizes, draw_wheel, put_wheels, wheel_places

from . import values as v
from .boom import draw_boom, draw_carriage, draw_sections, telescope
from .chassis import PIN_LEVEL, draw_frame, draw_front, draw_top
from .linkage import (
    AXLE_Z,
    FRONT_X,
    LEG_X,
    LEVEL_FROM,
    LEVEL_ON,
    LOW,
    RADIUS,
    TREAD,
    Linkage,
    Pose,
    levelling,
    solve,
    solve_axle,
    solve_stabiliser,
)
from .sheet import write
from .truth import FRAME, truth

LIFTED, OUT, LEG_DOWN = 0.25, 0.3, 0.15
"""How far lift and telescoping cylinder and the stabilisers' are drawn out; the forks are tilted back a little."""
TILTED = math.radians(4.0)
SECTIONS = {"two": 2, "three": 3}
_SIZES: dict[str, tuple[str, str, tuple[float, ...]]] = {
    "lift": ("LIFT CYL", "LIFT", (147, 70, 58, 72, 90, 30, 60, 70)),
    "compensation": ("COMP CYL", "COMPENSATION", (86, 45, 40, 54, 62, 22, 38, 44)),
    "telescope": ("TELESCOPE CYL", "TELESCOPE", (84, 40, 36, 56, 60, 22, 45, 55)),
    "tilt": ("TILT CYL", "TILT", (128, 60, 50, 72, 82, 26, 50, 60)),
    "levelling": ("LEVELLING CYL", "LEVEL", (98, 45, 40, 72, 62, 22, 38, 44)),
    "stabilizer": ("STABILISER CYL", "STABILISER", (98, 40, 34, 46, 58, 20, 42, 46)),
}
"""Name, prefix of its values; outside, pin, eye, eye's width, base, cap, piston, gland in millimetres."""


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """How a machine stands in the file."""

    k: Linkage
    pose: Pose
    leg: float

    @property
    def pins(self) -> dict[str, tuple[Point, Point]]:
        """Of the cylinders in the plane y = 0: barrel's and rod's."""
        k, p = self.k, self.pose
        return {"lift": (k.C, p.D), "compensation": (k.E, p.F), "telescope": telescope(k, p, OUT), "tilt": (p.B, p.T)}


@functools.cache
def drawn(sections: int) -> Drawn:
    """The machine as it stands in the file."""
    k, leg = solve(sections), solve_stabiliser()
    boom = k.boom_at(v.LIFT_CLOSED.value + LIFTED * v.LIFT_STROKE.value)
    raised = leg.length(RAISED) + LEG_DOWN * v.STABILISER_STROKE.value
    return Drawn(k, k.pose(boom, OUT, TILTED), leg.angle(raised))


def ends(name: str, d: Drawn) -> tuple[float, float, float]:
    """A cylinder's stroke, closed and drawn length."""
    k, p = d.k, d.pose
    if name == "compensation":  # a little longer than the boom takes it, which is what limits it
        return v.COMPENSATION_STROKE.value, k.compensation(LOW) - 8.0, k.compensation(p.boom)
    if name == "levelling":
        half = math.radians(v.LEVELLING.value)
        return v.LEVEL_STROKE.value, levelling(half), levelling(0.0)
    if name == "stabilizer":
        leg = solve_stabiliser()
        return v.STABILISER_STROKE.value, leg.length(RAISED), leg.length(d.leg)
    key = _SIZES[name][1]
    stroke, closed = getattr(v, f"{key}_STROKE").value, getattr(v, f"{key}_CLOSED").value
    at = {"lift": k.lift(p.boom), "telescope": closed + OUT * stroke, "tilt": k.tilt(p.carriage - p.boom)}
    return stroke, closed, at[name]


def cylinders(d: Drawn) -> dict[str, Cylinder]:
    """Sizes of a cylinder of each kind that the machine has, at its drawn length."""
    found = {}
    for name, (title, key, sizes) in _SIZES.items():
        if d.k.sections == 2 and name in ("levelling", "stabilizer"):
            continue
        outside, pin, eye, width, base, cap, piston, gland = sizes
        bore, shaft = getattr(v, f"{key}_BORE").value, getattr(v, f"{key}_ROD").value
        found[name] = Cylinder(
            title, bore, shaft, *ends(name, d), outside=outside, pin=pin, eye=eye, eye_width=width, base=base, cap=cap,
            piston=piston, gland=gland, port=8.0,
        )  # fmt: skip
    return found


def draw_cylinders(d: Drawn) -> Assembly:
    """All cylinders, in one assembly as a parts book has them."""
    tree, made = Assembly("HYDRAULIC CYLINDERS"), {name: draw_cylinder(c) for name, c in cylinders(d).items()}

    def put(name: str, at: object, side: str = "") -> None:
        halves = {"barrel": f"{name}_cylinder_barrel{side}", "rod": f"{name}_piston_rod{side}"}
        tree.uses.append(Use(made[name], at, names=halves))

    def across(name: str, x: float, start: Vector, end: Vector, side: str = "") -> None:
        # Drawn with its pins along y, which lie along the machine here.
        along = (0.0, end[1] - start[1], end[2] - start[2])
        put(name, frame((x, start[1], start[2]), along, (0.0, -along[2], along[1])), side)

    for name, (start, end) in d.pins.items():
        put(name, placed((float(start[0]), 0.0, float(start[1])), direction(end - start)))
    if d.k.sections == 2:
        return tree
    (ay, az), (ry, rz) = LEVEL_FROM, LEVEL_ON
    across("levelling", FRONT_X, (0, float(ay), float(az)), (0, float(ry), float(rz)))
    leg = solve_stabiliser()
    (by, bz), (qy, qz) = leg.barrel, leg.rod(d.leg)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        start, end = ((0.0, sign * float(y), float(z)) for y, z in ((by, bz), (qy, qz)))
        across("stabilizer", sum(LEG_X) / 2, start, end, f"_{letter}")
    return tree


def draw_level_lug(hardware: Assembly) -> Assembly:
    """The levelling cylinder's lug on the front axle."""
    tree, (y, z), body = Assembly("LEVELLING LUG"), LEVEL_ON, "front_axle"
    for name, x in (("RR", FRONT_X - 60), ("FRT", FRONT_X + 38)):
        lug = plate([(y, z, 40), (y - 70, AXLE_Z + 50, 0), (y + 70, AXLE_Z + 50, 0)], "yz", x, x + 22)
        tree.add(Part(f"AXLE LUG {name}", bored(lug, X, ((0, y, z), PIN_LEVEL / 2)), GREY), body)
    bar = Part(f"PIN D{PIN_LEVEL:g}", rod((0, 0, 0), X, PIN_LEVEL / 2, 128))
    hardware.add(bar, body, "levelling_piston_rod_pin", shift(FRONT_X - 64, float(y), float(z)))
    return tree


def draw_machine(d: Drawn) -> Assembly:
    """The whole product tree, in the machine frame."""
    hardware, root, wheels = Assembly("PINS"), Assembly("TELEHANDLER GA"), Assembly("WHEELS")
    size = WheelSizes("15.5-25", RADIUS, v.TYRE_WIDTH.value, 318.0, 45.0, 130.0, 10, inner=190.0)
    put_wheels(wheels, draw_wheel(size), wheel_places({"front": (FRONT_X, TREAD), "rear": (0.0, TREAD)}, RADIUS))
    chassis, boom, axles = Assembly("CHASSIS"), Assembly("BOOM GP"), Assembly("AXLES")
    chassis.add(draw_frame(d.k, hardware))
    chassis.add(draw_top())
    for end in ("front", "rear"):
        axles.add(draw_steer_axle(solve_axle(end, d.k.sections), hardware))
    boom.add(draw_boom(d.k, d.pose, hardware))
    boom.add(draw_sections(d.k, d.pose, OUT, hardware))
    boom.add(draw_carriage(d.k, d.pose, hardware))
    if d.k.sections > 2:
        chassis.add(draw_front(hardware))
        axles.add(draw_level_lug(hardware))
        axles.add(draw_stabilisers(solve_stabiliser(), d.leg, LEG_X, hardware))
    for child in (chassis, axles, boom, wheels, draw_cylinders(d), hardware):
        root.add(child)
    return root


def main(folder: Path, kind: str = "two") -> None:
    """Writes the three files of the machine with two sections, or with three, into `folder`."""
    d = drawn(SECTIONS[kind])
    root = draw_machine(d)
    document = truth(root, d, cylinders(d))
    write_example(folder, "telehandler", root, FRAME, document, functools.partial(write, sections=d.k.sections))


if __name__ == "__main__":
    run(main, __file__)
