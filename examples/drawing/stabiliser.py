"""Legs that swing down beside a machine, each by a cylinder: the left one across it, (y, z) in millimetres, and both
drawn. Angles are of the leg from the level, radians."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from .hardware import CLEARANCE
from .planar import Point, direction, rot, vec
from .product import Assembly, Part, Use
from .solids import X, bored, cut, frame, fuse, mirrored, plate, rod, shift
from .truth import Joints

HEEL, FOOT = 110.0, 60.0
"""Radii of a leg's ends."""
LEG = 640.0
"""Length of a leg, where an example has no other."""
_OPEN = math.radians(25.0)
"""Angle at the leg's pin between barrel pin and rod pin, raised."""
RAISED, LOWERED = math.radians(55.0), math.radians(-64.0)
PIN_LEG, PIN_LEG_CYL = 60.0, 40.0


@dataclass(frozen=True, slots=True)
class Stabiliser:
    """The left leg's triangle. Raised, its heel is clear of the ground by `clearance`; on the ground its foot has the
    `spread`; `barrel`: y and z of the cylinder's pin; `arm`: distance of the rod's pin from the leg's; `long`: of the
    leg; `lowered`: its angle at the end of the stroke."""

    clearance: float
    spread: float
    barrel_pin: tuple[float, float]
    arm: float = 0.0
    long: float = LEG
    lowered: float = LOWERED

    @property
    def pin(self) -> Point:
        """The leg's pin: raised, its heel has the published clearance; on the ground its foot the spread."""
        z = self.clearance + HEEL
        out = self.long * math.sqrt(1.0 - ((z - FOOT) / self.long) ** 2) + FOOT
        return vec(self.spread / 2 - out, z)

    @property
    def widest(self) -> float:
        """Over both legs, their feet on the ground."""
        return 2.0 * (float(self.pin[0]) + math.sqrt(self.long**2 - (float(self.pin[1]) - FOOT) ** 2) + FOOT)

    @property
    def barrel(self) -> Point:
        """The barrel's pin."""
        return vec(*self.barrel_pin)

    @property
    def lug(self) -> float:
        """Angle from the leg to its rod's pin."""
        return direction(self.barrel - self.pin) - _OPEN - RAISED

    def rod(self, angle: float) -> Point:
        """The rod's pin at an angle of the leg."""
        return self.pin + rot(angle + self.lug, vec(self.arm, 0.0))

    def length(self, angle: float) -> float:
        """The cylinder's length."""
        return float(np.hypot(*(self.rod(angle) - self.barrel)))

    def angle(self, length: float) -> float:
        """The leg's angle at a length of the cylinder."""
        return float(brentq(lambda a: self.length(a) - length, self.lowered - 0.01, RAISED + 0.01, xtol=1e-14))

    def moved_by(self, stroke: float) -> Stabiliser:
        """With the arm at which a cylinder's stroke lowers the leg."""

        def miss(arm: float) -> float:
            leg = replace(self, arm=arm)
            return leg.length(leg.lowered) - leg.length(RAISED) - stroke

        return replace(self, arm=float(brentq(miss, 120.0, 300.0, xtol=1e-12)))


def fit_stabiliser_pins(leg: Stabiliser, x: tuple[float, float], body: str, hardware: Assembly) -> None:
    """The pins of both legs and of their cylinders in the body that carries them, from one `x` to the other."""
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        for role, (y, z), size in (
            (f"stabilizer_{letter}_pin", leg.pin, PIN_LEG),
            (f"stabilizer_cylinder_barrel_{letter}_pin", leg.barrel, PIN_LEG_CYL),
        ):
            bar = Part(f"PIN D{size:g}", rod((0, 0, 0), X, size / 2, x[1] - x[0]))
            hardware.add(bar, body, role, shift(x[0], sign * float(y), float(z)))


def draw_stabilisers(leg: Stabiliser, angle: float, x: tuple[float, float], hardware: Assembly) -> Assembly:
    """Both legs at an angle, from one `x` to the other: a box from heel to foot, lugs of the cylinder."""
    tree = Assembly("STABILISERS")
    (ly, lz), (qy, qz) = leg.pin, leg.rod(angle)
    fy, fz = leg.pin + rot(angle, vec(leg.long, 0.0))
    shape = plate([(ly, lz, HEEL), (fy, fz, FOOT)], "yz", *x)
    core = plate([(ly, lz, HEEL - 14), (fy, fz, FOOT - 14)], "yz", x[0] + 14, x[1] - 14)
    hub = rod((x[0], ly, lz), X, PIN_LEG / 2 + 22, x[1] - x[0])
    slot = rod((x[0] + 14, qy, qz), X, 44, x[1] - x[0] - 28)
    shape = bored(cut(fuse(cut(shape, core), hub), slot), X, ((0, ly, lz), PIN_LEG / 2 + CLEARANCE))
    lugs = []
    for start in (x[0], x[1] - 14):
        lug = plate([(qy, qz, 34), (ly, lz, 60)], "yz", start, start + 14)
        lugs.append(bored(lug, X, ((0, qy, qz), PIN_LEG_CYL / 2), ((0, ly, lz), PIN_LEG / 2 + CLEARANCE)))
    whole = fuse(shape, *lugs)
    for letter, sign, one in (("l", 1.0, whole), ("r", -1.0, mirrored(whole))):
        body = f"stabilizer_{letter}"
        tree.add(Part(f"STABILISER LEG {letter.upper()}H", one), body)
        bar = Part(f"PIN D{PIN_LEG_CYL:g}", rod((0, 0, 0), X, PIN_LEG_CYL / 2, x[1] - x[0] + 8))
        role = f"stabilizer_piston_rod_{letter}_pin"
        hardware.add(bar, body, role, shift(x[0] - 4, sign * float(qy), float(qz)))
    return tree


def put_stabiliser_cylinders(tree: Assembly, cylinder: Assembly, leg: Stabiliser, angle: float, x: float) -> None:
    """A drawn cylinder between its pins on either side, the legs at an angle."""
    (by, bz), (qy, qz) = leg.barrel, leg.rod(angle)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        along = (0.0, sign * float(qy - by), float(qz - bz))
        # Drawn with its pins along y, which lie along the machine here.
        at = frame((x, sign * float(by), float(bz)), along, (0.0, -along[2], along[1]))
        names = {"barrel": f"stabilizer_cylinder_barrel_{letter}", "rod": f"stabilizer_piston_rod_{letter}"}
        tree.uses.append(Use(cylinder, at, names=names))


def leg_joints(found: Joints, leg: Stabiliser, angle: float, x: float, on: str) -> None:
    """The joints of both legs, at an angle, and of their cylinders on the body that carries them."""
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        pin, p, q = ((x, sign * float(c[0]), float(c[1])) for c in (leg.pin, leg.barrel, leg.rod(angle)))
        found.pivot(on, f"stabilizer_{letter}", pin, X)
        found.cylinder("stabilizer", f"_{letter}", (on, f"stabilizer_{letter}"), p, q, X)
