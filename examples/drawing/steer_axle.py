"""A steered axle that oscillates: beam on its pin, steering cylinder with a rod at both ends, ties, knuckles. Machine
frame, millimetres, wheels straight ahead; arms and cylinder are behind the beam."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from OCP.TopoDS import TopoDS_Shape
from scipy.optimize import brentq

from .cylinders import Ram, draw_ram
from .hardware import CLEARANCE, fit_pin, pin
from .product import CHROME, GREY, Assembly, Part, Use
from .solids import X, Y, Z, bored, box, fuse, mirrored, plate, rod, shift, turn
from .truth import Joints

PIN_OSCILLATION, PIN_KING, PIN_TIE = 60.0, 50.0, 30.0


@dataclass(frozen=True, slots=True)
class SteerAxle:
    """`body`: of the beam; `x`, `z`: where it oscillates, over the middle of the wheels. `king`: y of the left kingpin;
    `arm` and `end`: x and y of the pins between its knuckle's arm and its tie, and between that and the steering rod.
    `ram_z` and `tie_z`: heights of cylinder and ties; `wheel_z`: of the wheels, on spindles of a diameter and a length.
    Bore, rod and stroke of the cylinder, its diameter outside. `prefix`: of the names of all but the beam, where a
    machine has two such axles. `on`: the body that carries the beam; with `fast` the beam is of it."""

    body: str
    x: float
    z: float
    king: float
    arm: tuple[float, float]
    end: tuple[float, float]
    ram_z: float
    tie_z: float
    wheel_z: float
    spindle: tuple[float, float]
    bore: float
    rod: float
    stroke: float
    outside: float = 100.0
    prefix: str = ""
    on: str = "chassis"
    fast: bool = False

    def ram(self) -> Ram:
        """Sizes of the steering cylinder, drawn in its middle."""
        # In the ram's frame: along z from its right end, y down, x ahead.
        middle = 0.5 * (self.stroke + 120.0)
        feet = [box(-20, 40, self.ram_z - self.z - 45, 15, middle + y, middle + y + 30) for y in (120.0, -150.0)]
        return Ram(
            "STEER CYL", self.bore, self.rod, self.stroke, self.stroke / 2, self.outside, self.end[1] - 25.0,
            base=40.0, piston=40.0, gland=40.0, through=True, lugs=fuse(*feet),
        )  # fmt: skip

    def knuckle_angle(self, shift_y: float, side: float = 1.0) -> float:
        """How far a knuckle turns (radians, to the left positive) as the steering rod goes to the left by `shift_y`;
        `side` is +1 for the left knuckle. The tie keeps its length."""
        king, arm, end = np.array([self.x, self.king]), np.array(self.arm), np.array(self.end)
        tie = float(np.hypot(*(arm - end)))
        moved = end + np.array([0.0, side * shift_y])

        def gap(angle: float) -> float:
            c, s = math.cos(angle), math.sin(angle)
            turned = king + np.array([[c, -s], [s, c]]) @ (arm - king)
            return float(np.hypot(*(turned - moved))) - tie

        return side * float(brentq(gap, -0.9, 0.9, xtol=1e-12))


def _both(tree: Assembly, name: str, shape: TopoDS_Shape, bodies: tuple[str, str]) -> None:
    tree.add(Part(f"{name} LH", shape, GREY), bodies[0])
    tree.add(Part(f"{name} RH", mirrored(shape), GREY), bodies[1])


def draw_steer_axle(a: SteerAxle, hardware: Assembly) -> Assembly:
    """Beam, cylinder, rod ends, ties and knuckles; the wheels are put on by the caller. Its pin is the chassis'."""
    tree = Assembly("STEER AXLE ASSY")
    x, z, wall, body = a.x, a.z, a.king + 55, a.on if a.fast else a.body
    steering = f"{a.prefix}steering"
    king = (x, a.king, 0.0)
    beam = box(x - 60, x + 60, -a.king - 50, a.king + 50, z - 50, z + 50)
    beam = beam if a.fast else bored(beam, X, ((0, 0, z), PIN_OSCILLATION / 2 + CLEARANCE))
    beam = bored(beam, Z, (king, PIN_KING / 2), ((x, -a.king, 0), PIN_KING / 2))
    tree.add(Part("STEER AXLE BEAM", beam, GREY), body)
    ram, (ex, ey), (ax, ay) = a.ram(), a.end, a.arm
    _both(tree, "STEER CYL BRKT", box(ex + 40, x - 60, 120, 150, z - 45, z + 45), (body, body))
    names = {
        "barrel": body,
        "rod": f"{steering}_piston_rod",
        "barrel_role": f"{steering}_cylinder_barrel",
        "rod_role": f"{steering}_piston_rod",
    }
    # Its axis goes from z to y: the barrel's foot to the right, the rod out to the left.
    at = shift(ex, -ram.length / 2, a.ram_z).Multiplied(turn(X, -90.0))
    tree.uses.append(Use(draw_ram(ram), at, names=names))
    low, high = a.tie_z - 19, a.ram_z + 20
    eye = bored(box(ex - 28, ex + 28, ey - 25, ey + 28, a.ram_z - 20, high), Z, ((ex, ey, 0), PIN_TIE / 2))
    tree.add(Part("STEER ROD END", eye, CHROME), f"{steering}_piston_rod")
    tree.add(Part("STEER ROD END", mirrored(eye), CHROME), f"{steering}_piston_rod")
    tie = plate([(ex, ey, 26), (ax, ay, 26)], "xy", low, a.tie_z + 19)
    tie = bored(tie, Z, ((ex, ey, 0), PIN_TIE / 2 + CLEARANCE), ((ax, ay, 0), PIN_TIE / 2 + CLEARANCE))
    _both(tree, "TIE ROD", tie, (f"{a.prefix}tie_rod_l", f"{a.prefix}tie_rod_r"))
    fork = [(x + 60, wall, 0.0), (x + 60, wall + 1, 0.0), (x - 60, wall + 1, 0.0)]
    upper = plate([(x + 60, wall, 0), *fork[1:], (x, a.king, 52.0)], "xy", z + 55, z + 95)
    upper = bored(upper, Z, (king, PIN_KING / 2 + CLEARANCE))
    lower = fuse(
        plate([*fork, (x, a.king, 52.0)], "xy", z - 95, z - 55),
        plate([(x, a.king, 52.0), (ax, ay, 30)], "xy", z - 95, z - 55),
    )
    lower = bored(lower, Z, (king, PIN_KING / 2 + CLEARANCE), ((ax, ay, 0), PIN_TIE / 2))
    size, length = a.spindle
    post = box(x - 60, x + 60, wall, wall + 30, z - 95, z + 95)
    post = fuse(post, rod((x, wall + 30, a.wheel_z), Y, size / 2, length))
    _both(tree, "STEER KNUCKLE", fuse(upper, post, lower), (f"{a.prefix}knuckle_l", f"{a.prefix}knuckle_r"))
    for sign, letter in ((1.0, "l"), (-1.0, "r")):
        knuckle = f"{a.prefix}knuckle_{letter}"
        fit_pin(hardware, (x, sign * a.king, z - 95), PIN_KING, 190, body, f"{knuckle}_pin", upright=True)
        for px, py, owner, role in (
            (ax, ay, knuckle, f"{a.prefix}tie_rod_{letter}_pin"),
            (ex, ey, f"{steering}_piston_rod", f"{steering}_piston_rod_{letter}_pin"),
        ):
            fit_pin(hardware, (px, sign * py, low), PIN_TIE, high - low, owner, role, upright=True)
    if not a.fast:
        bolt = pin(PIN_OSCILLATION, 290)
        hardware.add(bolt, a.on, f"{body}_pin", shift(x - 145, 0, z).Multiplied(turn(Z, -90.0)))
    return tree


def steering_joints(found: Joints, a: SteerAxle) -> None:
    """The joints of the axle on what carries it, and of all that steers; those of the wheels are the caller's."""
    piston = f"{a.prefix}steering_piston_rod"
    if not a.fast:
        found.pivot(a.on, a.body, (a.x, 0.0, a.z), X)
    found.slide(a.body, piston, (a.end[0], 0.0, a.ram_z), Y)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        knuckle, tie = (f"{a.prefix}{what}_{letter}" for what in ("knuckle", "tie_rod"))
        found.pivot(a.body, knuckle, (a.x, sign * a.king, a.z), Z)
        found.pivot(knuckle, tie, (a.arm[0], sign * a.arm[1], a.ram_z), Z)
        found.pivot(piston, tie, (a.end[0], sign * a.end[1], a.ram_z), Z)
