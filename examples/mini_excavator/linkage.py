"""The mini excavator's linkages, solved so that it meets its published values: the digger's in the plane y = 0, the
boom swing's and the blade's triangles."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from drawing.digger import Ends, Linkage, Sketch, Strokes, fitted
from drawing.planar import Point, direction, rot, vec

from . import values as v

BOOM, ARM = v.BOOM_LENGTH.value, v.ARM_LENGTH.value
STROKES = Strokes(
    (v.BOOM_CLOSED.value, v.BOOM_CLOSED.value + v.BOOM_STROKE.value),
    (v.ARM_CLOSED.value, v.ARM_CLOSED.value + v.ARM_STROKE.value),
    (v.BUCKET_CLOSED.value, v.BUCKET_CLOSED.value + v.BUCKET_STROKE.value),
)
NOSE_AT = 1124.02
"""x of the bucket pin with boom, arm and bucket cylinder open: what the published minimum swing radius takes of the
drawn arm and bucket."""

SKETCH = Sketch(
    {
        "A.x": (490, 10),
        "A.z": (650, 20),
        "C.x": (600, 30),
        "C.z": (435, 15),
        "D.x": (690, 50),
        "D.z": (28, 3),
        "M.x": (640, 40),
        "M.z": (275, 12),
        "P.x": (-215, 20),
        "P.z": (110, 20),
        "E.x": (110, 30),
        "E.z": (140, 12),
        "G.x": (760, 12),
        "G.z": (10, 8),
        "tipping": (178, 15),
        "link": (165, 15),
        "J.r": (132, 10),
        "J.a": (math.radians(95), 0.15),
        "tip": (480, 10),
        "low": (math.radians(-42), 0.06),
        "high": (math.radians(68), 0.04),
        "out": (math.radians(-36), 0.05),
        "crowd": (math.radians(-148), 0.05),
        "open": (math.radians(25), 0.1),
        "curl": (math.radians(-145), 0.15),
    },
    boom=BOOM, arm=ARM, strokes=STROKES, least_sine=0.3, pull=20.0,
)  # fmt: skip


def ranges(a: Point, tip: float, e: Ends) -> dict[str, float]:
    """The working ranges by the values' names, millimetres (see the excavator's `ranges`)."""
    boom, arm = vec(BOOM, 0.0), vec(ARM, 0.0)
    low = a + rot(e.low, boom)
    far = float(np.hypot(*(boom + rot(e.out, arm)))) + tip
    out = a + rot(e.high, boom + rot(e.out, arm))
    return {
        v.DIGGING_DEPTH.name: ARM + tip - float(low[1]),
        v.GROUND_REACH.name: float(a[0]) + math.sqrt(max(0.0, far**2 - float(a[1]) ** 2)),
        v.DIGGING_HEIGHT.name: float((out + rot(e.high + e.out + e.open, vec(tip, 0.0)))[1]),
        v.DUMPING_HEIGHT.name: float(out[1]) - tip,
    }


def _published(k: Linkage, e: Ends) -> list[float]:
    got = ranges(k.A, k.tip, e)
    wanted = (v.DIGGING_DEPTH, v.GROUND_REACH, v.DIGGING_HEIGHT, v.DUMPING_HEIGHT)
    folded = k.A + rot(e.high, vec(BOOM, 0.0) + rot(e.crowd, vec(ARM, 0.0)))
    return [*(got[value.name] - value.value for value in wanted), float(folded[0]) - NOSE_AT]


@functools.cache
def solve() -> Linkage:
    """The digger's linkage; the same on every call."""
    return fitted(SKETCH, _published)


# ---- boom swing: in plan, about the upright pin of the bracket --------
PIVOT = vec(400.0, 0.0)
"""The bracket's pin, from above: x forward, y left."""
SWING_Z = 495.0
"""Height of the swing cylinder."""
_BEHIND = vec(500.0 * math.cos(math.radians(205)), 500.0 * math.sin(math.radians(205)))
"""From the bracket's pin to the barrel's, right behind it."""
_STRAIGHT = math.radians(85)
"""Angle at the bracket's pin between barrel pin and rod pin, the boom straight ahead."""


@dataclass(frozen=True, slots=True)
class Swing:
    """The boom swing's triangle: distance of the rod's pin from the bracket's."""

    arm: float

    @property
    def barrel(self) -> Point:
        """The barrel's pin, from above."""
        return PIVOT + _BEHIND

    def rod(self, left: float) -> Point:
        """The rod's pin with the boom swung to the left by an angle."""
        return PIVOT + rot(direction(_BEHIND) + _STRAIGHT + left, vec(self.arm, 0.0))

    def length(self, left: float) -> float:
        """The cylinder's length with the boom swung to the left by an angle."""
        return float(np.hypot(*(self.rod(left) - self.barrel)))

    @property
    def closed(self) -> float:
        """Closed length: the boom at its right stop."""
        return self.length(-math.radians(v.SWING_RIGHT.value))


@functools.cache
def solve_swing() -> Swing:
    """The triangle that swings the boom from stop to stop over the stroke."""

    def miss(arm: float) -> float:
        swing = Swing(arm)
        return swing.length(math.radians(v.SWING_LEFT.value)) - swing.closed - v.SWING_STROKE.value

    return Swing(float(brentq(miss, 90.0, 150.0, xtol=1e-12)))


# ---- blade: in the plane y = 0 --------
BLADE_PIN, BLADE_BARREL = vec(240.0, 170.0), vec(150.0, 300.0)
"""Where arms and cylinder of the blade are on the undercarriage."""
_EDGE = float(np.hypot(450.0, BLADE_PIN[1]))
"""From the arms' pin to the blade's edge."""


@dataclass(frozen=True, slots=True)
class Blade:
    """The blade's triangle: the rod's pin from the arms' pin, seen along the line to the edge."""

    rod: tuple[float, float]

    def at(self, height: float) -> float:
        """Angle of the line from the arms' pin to the edge, which stands so high."""
        return math.asin((height - float(BLADE_PIN[1])) / _EDGE)

    def pins(self, angle: float) -> tuple[Point, Point]:
        """The rod's pin and the edge."""
        return BLADE_PIN + rot(angle, vec(*self.rod)), BLADE_PIN + rot(angle, vec(_EDGE, 0.0))

    def length(self, angle: float) -> float:
        """The cylinder's length."""
        return float(np.hypot(*(self.pins(angle)[0] - BLADE_BARREL)))

    @property
    def closed(self) -> float:
        """Closed length: the blade raised."""
        return self.length(self.at(v.BLADE_LIFT.value))

    def angle(self, length: float) -> float:
        """The angle at a length of the cylinder."""
        low, high = self.at(-v.BLADE_DIG.value), self.at(v.BLADE_LIFT.value)
        return float(brentq(lambda a: self.length(a) - length, low - 0.01, high + 0.01, xtol=1e-14))


@functools.cache
def solve_blade() -> Blade:
    """The triangle that moves the blade from its highest to its lowest over the stroke."""

    def miss(up: float) -> float:
        blade = Blade((300.0, up))
        return blade.length(blade.at(-v.BLADE_DIG.value)) - blade.closed - v.BLADE_STROKE.value

    return Blade((300.0, float(brentq(miss, 0.0, 200.0, xtol=1e-12))))
