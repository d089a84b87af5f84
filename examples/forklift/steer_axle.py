"""The steered rear axle: beam on its oscillation pin, double-rod steering cylinder, ties, knuckles. Machine frame,
millimetres, wheels straight ahead."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq

from drawing.cylinders import Ram, draw_ram
from drawing.hardware import CLEARANCE, fit_pin, pin
from drawing.product import CHROME, GREY, Assembly, Part, Use
from drawing.solids import X, Y, Z, bored, box, fuse, mirrored, plate, rod, shift, turn

from . import values as v
from .wheels import SPINDLE

AXLE_X, AXLE_Z = -v.WHEELBASE.value, 420.0
"""Where the axle oscillates: over the middle of the wheels, at its pin's height."""
PIN_OSCILLATION, PIN_KING, PIN_TIE = 60.0, 50.0, 30.0
KINGPIN = (AXLE_X, 680.0)
ARM = (AXLE_X - 150.0, 700.0)
"""Pin between the left knuckle's arm and its tie: x, y."""
ROD_END = (AXLE_X - 200.0, 320.0)
"""Pin between the left end of the steering rod and its tie."""
CYL_Z, TIE_Z = 345.0, 302.0
WHEEL_Z = v.TYRE_DIAMETER.value / 2


def steer_ram() -> Ram:
    """Sizes of the steering cylinder, drawn in its middle."""
    stroke = v.STEER_STROKE.value
    # In the ram's frame: along z from its right end, y down, x ahead.
    middle = 0.5 * (stroke + 120.0)
    feet = [box(-20, 40, CYL_Z - AXLE_Z - 45, 15, middle + y, middle + y + 30) for y in (120.0, -150.0)]
    return Ram(
        "STEER CYL", v.STEER_BORE.value, v.STEER_ROD.value, stroke, stroke / 2, 100.0, ROD_END[1] - 25.0,
        base=40.0, piston=40.0, gland=40.0, through=True, lugs=fuse(*feet),
    )  # fmt: skip


def knuckle_angle(shift_y: float, side: float = 1.0) -> float:
    """How far a knuckle turns (radians, to the left positive) as the steering rod goes to the left by `shift_y`;
    `side` is +1 for the left knuckle. The tie keeps its length."""
    king, arm, end = np.array(KINGPIN), np.array(ARM), np.array(ROD_END)
    tie = float(np.hypot(*(arm - end)))
    moved = end + np.array([0.0, side * shift_y])

    def gap(angle: float) -> float:
        c, s = math.cos(angle), math.sin(angle)
        turned = king + np.array([[c, -s], [s, c]]) @ (arm - king)
        return float(np.hypot(*(turned - moved))) - tie

    return side * float(brentq(gap, -0.9, 0.9, xtol=1e-12))


def _both(tree: Assembly, name: str, shape: object, bodies: tuple[str, str]) -> None:
    tree.add(Part(f"{name} LH", shape, GREY), bodies[0])
    tree.add(Part(f"{name} RH", mirrored(shape), GREY), bodies[1])


def draw_steer_axle(hardware: Assembly) -> Assembly:
    """Beam, cylinder, rod ends, ties and knuckles; the wheels are put on by the caller."""
    tree = Assembly("STEER AXLE ASSY")
    x, z = AXLE_X, AXLE_Z
    beam = box(x - 60, x + 60, -730, 730, z - 50, z + 50)
    beam = bored(beam, X, ((0, 0, z), PIN_OSCILLATION / 2 + CLEARANCE))
    beam = bored(beam, Z, (((KINGPIN[0], KINGPIN[1], 0)), PIN_KING / 2), ((KINGPIN[0], -KINGPIN[1], 0), PIN_KING / 2))
    tree.add(Part("STEER AXLE BEAM", beam, GREY), "steer_axle")
    _both(tree, "STEER CYL BRKT", box(x - 160, x - 60, 120, 150, z - 45, z + 45), ("steer_axle", "steer_axle"))
    names = {
        "barrel": "steer_axle",
        "rod": "steering_piston_rod",
        "barrel_role": "steering_cylinder_barrel",
        "rod_role": "steering_piston_rod",
    }
    ram = steer_ram()
    # Its axis goes from z to y: the barrel's foot to the right, the rod out to the left.
    at = shift(x - 200, -ram.length / 2, CYL_Z).Multiplied(turn(X, -90.0))
    tree.uses.append(Use(draw_ram(ram), at, names=names))
    ex, ey = ROD_END
    eye = bored(box(ex - 28, ex + 28, ey - 25, ey + 28, CYL_Z - 20, CYL_Z + 20), Z, ((ex, ey, 0), PIN_TIE / 2))
    tree.add(Part("STEER ROD END", eye, CHROME), "steering_piston_rod")
    tree.add(Part("STEER ROD END", mirrored(eye), CHROME), "steering_piston_rod")
    ax, ay = ARM
    tie = plate([(ex, ey, 26), (ax, ay, 26)], "xy", TIE_Z - 19, TIE_Z + 19)
    tie = bored(tie, Z, ((ex, ey, 0), PIN_TIE / 2 + CLEARANCE), ((ax, ay, 0), PIN_TIE / 2 + CLEARANCE))
    _both(tree, "TIE ROD", tie, ("tie_rod_l", "tie_rod_r"))
    king = (KINGPIN[0], KINGPIN[1], 52.0)
    wall = [(x + 60, 735, 0), (x - 60, 735, 0)]
    upper = bored(plate([*wall[:1], (x + 60, 736, 0), (x - 60, 736, 0), king], "xy", z + 55, z + 95), Z,
                  ((*KINGPIN, 0), PIN_KING / 2 + CLEARANCE))  # fmt: skip
    lower = fuse(
        plate([(x + 60, 735, 0), (x + 60, 736, 0), (x - 60, 736, 0), king], "xy", z - 95, z - 55),
        plate([king, (ax, ay, 30)], "xy", z - 95, z - 55),
    )
    lower = bored(lower, Z, ((*KINGPIN, 0), PIN_KING / 2 + CLEARANCE), ((ax, ay, 0), PIN_TIE / 2))
    post = fuse(box(x - 60, x + 60, 735, 765, z - 95, z + 95), rod((x, 765, WHEEL_Z), Y, SPINDLE / 2, 120))
    knuckle = fuse(upper, post, lower)
    tree.add(Part("STEER KNUCKLE LH", knuckle, GREY), "knuckle_l")
    tree.add(Part("STEER KNUCKLE RH", mirrored(knuckle), GREY), "knuckle_r")
    for sign, letter in ((1.0, "l"), (-1.0, "r")):
        fit_pin(hardware, (KINGPIN[0], sign * KINGPIN[1], z - 95), PIN_KING, 190, "steer_axle",
                f"knuckle_{letter}_pin", upright=True)  # fmt: skip
        fit_pin(hardware, (ax, sign * ay, TIE_Z - 19), PIN_TIE, CYL_Z + 20 - TIE_Z + 19, f"knuckle_{letter}",
                f"tie_rod_{letter}_pin", upright=True)  # fmt: skip
        fit_pin(hardware, (ex, sign * ey, TIE_Z - 19), PIN_TIE, CYL_Z + 20 - TIE_Z + 19, "steering_piston_rod",
                f"steering_piston_rod_{letter}_pin", upright=True)  # fmt: skip
    bolt = pin(PIN_OSCILLATION, 290)
    hardware.add(bolt, "chassis", "steer_axle_pin", shift(x - 145, 0, z).Multiplied(turn(Z, -90.0)))
    return tree
