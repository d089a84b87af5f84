"""Where the pins of the blade's linkage are: the C-frame on its pivot, the blade on its ball. Everything is told as it
stands with the cutting edge on the ground, the blade straight and level. Machine frame, millimetres.

Free dimensions are solved so that the strokes give what the sheet prints: the lift cylinder's eye and closed length by
lift and depth, the tilt cylinder's height by the tilt at the corner, the angle cylinders' eyes by the blade's angle.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, fsolve

from drawing.ball import Array, followed

from . import values as v

PIVOT = np.array([250.0, 0.0, 560.0])
BALL = np.array([2_480.0, 0.0, 560.0])
EDGE_X = 2_900.0
CORNER = np.array([EDGE_X, v.BLADE_WIDTH.value / 2, 0.0])
"""Left end of the cutting edge."""
LIFT_Y, ANGLE_Z = 480.0, 720.0
LIFT_FOOT = np.array([900.0, LIFT_Y, 1_350.0])
LIFT_Z = 900.0
"""Height of the lift cylinders' eyes on the C-frame."""
TILT_X, TILT_Y = 2_470.0, (130.0, 950.0)
"""Where the tilt cylinder lies behind the blade: from its barrel's pin to its rod's."""
ANGLE_FOOT = np.array([1_460.0, 580.0, ANGLE_Z])
ANGLE_X = 2_560.0
"""Where the angle cylinders' eyes are."""
LINK = (np.array([2_366.0, 0.0, 1_100.0]), np.array([2_580.0, 0.0, 1_130.0]))
"""The pitch link's ends, on the C-frame and on the blade."""
LIFTED = 300.0
"""How high the edge is drawn."""


@dataclass(frozen=True, eq=False)
class Linkage:
    """The solved linkage: the eyes of the lift, tilt and left angle cylinder with the edge on the ground, and the tilt
    cylinder's foot; the lift cylinder's closed length. Tilt and angle cylinders are half out there."""

    lift_eye: Array
    lift_closed: float
    tilt_foot: Array
    tilt_eye: Array
    angle_eye: Array

    def lift_length(self, turn: float) -> float:
        """A lift cylinder's length with the C-frame turned up so far (radians) from where the edge is on the ground."""
        return float(np.linalg.norm(raised(turn, self.lift_eye) - LIFT_FOOT))

    def turn_at(self, length: float) -> float:
        """How far the C-frame is turned up at a lift cylinder's length."""
        return float(brentq(lambda turn: self.lift_length(turn) - length, -0.5, 0.9, xtol=1e-14))

    def closed(self, name: str) -> float:
        """A cylinder's closed length."""
        if name == "lift":
            return self.lift_closed
        foot, eye, stroke = {
            "tilt": (self.tilt_foot, self.tilt_eye, v.TILT_STROKE.value),
            "angle": (ANGLE_FOOT, self.angle_eye, v.ANGLE_STROKE.value),
        }[name]
        return float(np.linalg.norm(eye - foot)) - stroke / 2

    def blade(self, tilt: float, angle: float) -> Array:
        """The blade's rotation on the C-frame with tilt and left angle cylinder so much longer than half out."""
        return _blade(self.tilt_foot, self.tilt_eye, self.angle_eye, tilt, angle)


def raised(turn: float, p: Array) -> Array:
    """A point of the C-frame with that turned up (radians) about its pivot."""
    c, s = math.cos(turn), math.sin(turn)
    x, y, z = p - PIVOT
    return PIVOT + np.array([c * x - s * z, y, s * x + c * z])


def turn_for(height: float) -> float:
    """How far the C-frame is turned up where the edge of the straight blade is so high."""
    return float(brentq(lambda turn: raised(turn, CORNER)[2] - height, -0.5, 0.9, xtol=1e-14))


def _blade(tilt_foot: Array, tilt_eye: Array, angle_eye: Array, tilt: float, angle: float) -> Array:
    links = [(tilt_foot, tilt_eye), (ANGLE_FOOT, angle_eye), LINK]
    return followed(links, BALL, np.array([tilt, angle, 0.0]))


def corners(turned: Array) -> tuple[Array, Array]:
    """The cutting edge's left and right ends on a blade turned on its ball, the C-frame as it is."""
    right = CORNER * (1.0, -1.0, 1.0)
    return turned @ (CORNER - BALL) + BALL, turned @ (right - BALL) + BALL


def tilt_of(turned: Array, lift: float = 0.0) -> float:
    """How much higher the right corner is than the left, the C-frame turned up so far."""
    left, right = (raised(lift, corner) for corner in corners(turned))
    return float(right[2] - left[2])


def angle_of(turned: Array, lift: float = 0.0) -> float:
    """How far the cutting edge is turned to the left, degrees."""
    left, right = (raised(lift, corner) for corner in corners(turned))
    return math.degrees(math.atan2(-(left - right)[0], (left - right)[1]))


@functools.cache
def solve() -> Linkage:
    """The linkage that gives what the sheet prints."""
    high, low = turn_for(v.LIFT_HEIGHT.value), turn_for(-v.DIG_DEPTH.value)

    def lift(free: Array) -> list[float]:
        eye = np.array([free[0], LIFT_Y, LIFT_Z])
        ends = [float(np.linalg.norm(raised(turn, eye) - LIFT_FOOT)) for turn in (high, low)]
        return [ends[0] - free[1], ends[1] - free[1] - v.LIFT_STROKE.value]

    x, closed = fsolve(lift, [2_090.0, 940.0], xtol=1e-14)
    drawn = turn_for(LIFTED)

    def pins(free: Array) -> tuple[Array, Array, Array]:
        tilt = [np.array([TILT_X, y, free[0]]) for y in TILT_Y]
        return tilt[0], tilt[1], np.array([ANGLE_X, free[1], ANGLE_Z])

    def ball(free: Array) -> list[float]:
        over = _blade(*pins(free), v.TILT_STROKE.value / 2, 0.0)
        aside = _blade(*pins(free), 0.0, -v.ANGLE_STROKE.value / 2)
        return [tilt_of(over, drawn) - v.MAX_TILT.value, angle_of(aside, drawn) - v.BLADE_ANGLE.value]

    return Linkage(np.array([float(x), LIFT_Y, LIFT_Z]), float(closed), *pins(fsolve(ball, [980.0, 600.0], xtol=1e-13)))
