"""Draws a motor grader of the Cat 140 class as one STEP assembly, its sheet, and the truth about it.

`python -m grader.draw FOLDER`, run in `examples/`, writes `grader.step`, `specifications.pdf` and `truth.json`; the
same bytes every time. The values it is drawn to are in `values.py`.
"""

from __future__ import annotations

import functools
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from drawing.ball import Array
from drawing.cylinders import Cylinder, draw_cylinder, draw_hung_cylinder, put_pair
from drawing.files import run, write_example
from drawing.product import Assembly, Use
from drawing.solids import Vector, frame
from drawing.wheels import WheelSizes, draw_wheel, put_wheels

from . import axle, blade, frames
from . import values as v
from .linkage import (
    AXLE_X,
    CENTRE_FOOT,
    KING_Y,
    LEAN_EYE_Z,
    LEAN_FOOT_Y,
    LEAN_Y,
    LIFT_FOOT,
    MIRROR,
    RADIUS,
    RAISED,
    RIPPER_FOOT,
    RIPPER_RAISED,
    STEER_FOOT,
    STEER_Z,
    TIP_FOOT,
    TIP_PIVOT,
    pitch_for,
    pitched,
    rip_for,
    ripped,
    solve,
    solve_bend,
)
from .sheet import write
from .truth import FRAME, WHEELS, three, truth

DOWN, UP = pitch_for(RAISED), rip_for(RIPPER_RAISED)
"""How far the drawbar is turned down and the ripper up in the file."""


@functools.cache
def cylinders() -> dict[str, Cylinder]:
    """Sizes of a cylinder of each kind, at its drawn length."""
    k = solve()
    lift, centre = (
        float(np.linalg.norm(pitched(DOWN, eye) - foot))
        for eye, foot in ((k.lift_eye, LIFT_FOOT), (k.centre_eye, CENTRE_FOOT))
    )
    found = blade.sizes(k, lift, centre) | axle.sizes(k) | frames.sizes(k, k.ripper_length(UP))
    # The lift cylinders reach as far up as the maker says.
    slope = (pitched(DOWN, k.lift_eye) - LIFT_FOOT) / lift
    steep, flat = -float(slope[2]), math.hypot(float(slope[0]), float(slope[1]))

    def over(behind: float) -> float:
        return float(LIFT_FOOT[2]) + behind * steep + found["lift"].outside / 2 * flat - v.CYLINDERS_HEIGHT.value

    behind = float(brentq(over, 100.0, 1_500.0))
    return found | {"lift": replace(found["lift"], base=found["lift"].cap - behind)}


def _put(tree: Assembly, child: Assembly, name: str, start: Array, end: Array, across: Vector, side: str = "") -> None:
    """A cylinder from one point to another, its pins or studs along `across`."""
    along = end - start
    up = np.cross(along, across)
    halves = {"barrel": f"{name}_cylinder_barrel{side}", "rod": f"{name}_piston_rod{side}"}
    tree.uses.append(Use(child, frame(three(start), three(along), three(up)), names=halves))


def draw_cylinders() -> Assembly:
    """All but the side shift's, in one assembly as a parts book has them."""
    tree, k, sizes = Assembly("HYDRAULIC CYLINDERS"), solve(), cylinders()
    lift = draw_hung_cylinder(sizes["lift"], blade.LIFT_BALL, collar=blade.COLLAR)
    steer = draw_cylinder(sizes["steer"])
    for side, sign in (("_l", 1.0), ("_r", -1.0)):
        mirror = MIRROR if sign < 0 else np.ones(3)
        _put(tree, lift, "blade_lift", LIFT_FOOT * mirror, pitched(DOWN, k.lift_eye * mirror), (0.0, sign, 0.0), side)
        foot, eye = (np.array([AXLE_X + p[0], sign * (KING_Y + p[1]), STEER_Z]) for p in (STEER_FOOT, k.steer_eye))
        _put(tree, steer, "steering", foot, eye, (0.0, 0.0, 1.0), side)
    centre = draw_hung_cylinder(sizes["centre"], blade.CENTRE_BALL)
    _put(tree, centre, "centre_shift", CENTRE_FOOT, pitched(DOWN, k.centre_eye), (1.0, 0.0, 0.0))
    tip = [pitched(DOWN, np.array([p[0], 0.0, p[1]])) for p in (TIP_FOOT, TIP_PIVOT + k.tip_eye)]
    _put(tree, draw_cylinder(sizes["tip"]), "blade_tip", tip[0], tip[1], (0.0, 1.0, 0.0))
    x = AXLE_X - axle.EYE_AHEAD
    foot, eye = np.array([x, LEAN_FOOT_Y, k.lean_foot_z]), np.array([x, LEAN_Y, LEAN_EYE_Z])
    _put(tree, draw_cylinder(sizes["lean"]), "wheel_lean", foot, eye, (1.0, 0.0, 0.0))
    bend = solve_bend()
    p, q = ((float(c[0]), float(c[1]), frames.BEND_Z) for c in (bend.P, bend.Q))
    put_pair(tree, draw_cylinder(sizes["bend"]), "articulation", p, q)
    up = ripped(UP, k.ripper_eye)
    rip = [(float(c[0]), frames.RIP_Y, float(c[1])) for c in (RIPPER_FOOT, up)]
    put_pair(tree, draw_cylinder(sizes["ripper"]), "ripper_lift", rip[0], rip[1])
    return tree


def draw_machine() -> Assembly:
    """The whole product tree, in the machine frame."""
    k, hardware, root, wheels = solve(), Assembly("PINS"), Assembly("GRADER GA"), Assembly("WHEELS")
    sizes = WheelSizes(v.TYRE_SIZE, RADIUS, v.WIDTH.value - v.TREAD.value, 312.0, axle.SPINDLE, circle=150.0, bolts=10)
    put_wheels(wheels, draw_wheel(sizes), WHEELS)
    front, rear, work = Assembly("FRONT FRAME"), Assembly("REAR FRAME"), Assembly("BLADE EQUIPMENT")
    for child in (frames.draw_front(hardware), frames.draw_cab(), axle.draw_axle(k, hardware)):
        front.add(child)
    for child in (frames.draw_rear(hardware), frames.draw_tandems(hardware), frames.draw_ripper(k, UP, hardware)):
        rear.add(child)
    blade.pin_saddle(hardware)
    for child in (
        blade.draw_saddle(hardware), blade.draw_drawbar(k, DOWN, hardware), blade.draw_circle(k, DOWN, hardware),
        blade.draw_carrier(k, DOWN, hardware), blade.draw_moldboard(DOWN),
    ):  # fmt: skip
        work.add(child)
    for child in (front, rear, work, wheels, draw_cylinders(), hardware):
        root.add(child)
    return root


def main(folder: Path) -> None:
    """Writes the three files into `folder`."""
    root = draw_machine()
    document = truth(root, solve(), solve_bend(), DOWN, UP, cylinders())
    write_example(folder, "grader", root, FRAME, document, write)


if __name__ == "__main__":
    run(main, __file__)
