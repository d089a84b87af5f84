"""Where the truck's axles, hinges, steering and cylinders are: solved so that it meets its values.

Machine frame, millimetres: x forward from the rear axle, y left, z up from the ground. Angles are radians; a raised
body and a turn to the left are positive.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, least_squares

from drawing.planar import Point, rot, vec
from drawing.tipper import Hoist, Tipper, fitted_hoist

from . import values as v

RADIUS = v.TYRE_DIAMETER.value / 2
FRONT_X = v.WHEELBASE.value
TAIL = -v.REAR_OVERHANG.value
NOSE, CANOPY_X = TAIL + v.LENGTH.value, TAIL + v.BODY_LENGTH.value
FLOOR, HINGE_Z = 1950.0, 1700.0
HOIST_Y, STEER_Z = 545.0, 975.0
DUMP, LOCK = math.radians(v.DUMP_ANGLE.value), math.radians(v.STEER_ANGLE.value)
_OVER = v.RAISED_HEIGHT.value - HINGE_Z - (v.CANOPY_HEIGHT.value - HINGE_Z) * math.cos(DUMP)
TIPPER = Tipper(vec(CANOPY_X - _OVER / math.sin(DUMP), HINGE_Z), DUMP)
"""Pivoted where the canopy comes to the published height when the body is tipped."""
TAIL_LOW = TIPPER.lowered(TAIL, v.DUMP_CLEARANCE.value)
APART = v.TYRES_WIDTH.value - v.REAR_TREAD.value - v.TYRE_WIDTH.value
"""Between the middles of the twin tyres."""
KING = vec(FRONT_X, 1150.0)
"""The left kingpin, from above: x, y."""
ARM = 466.0
"""From the kingpin to the tie rod's pin, towards the middle of the rear axle: so the inner wheel turns farther."""
TIE = KING - ARM * KING / float(np.hypot(*KING))


@functools.cache
def solve_hoist() -> Hoist:
    """Pins for which the stroke gives the dump angle; the same on every call."""
    near = vec(2380.0, 1050.0), vec(660.0, 1850.0)
    return fitted_hoist(TIPPER, near, v.HOIST_CLOSED.value, v.HOIST_STROKE.value)


def outer(inner: float) -> float:
    """How far the right knuckle turns as the left one does to the left (radians), by the tie rod."""
    left, mirror = KING + rot(inner, TIE - KING), vec(KING[0], -KING[1])
    arm = vec(TIE[0], -TIE[1]) - mirror

    def gap(angle: float) -> float:
        return float(np.hypot(*(mirror + rot(angle, arm) - left))) - 2.0 * float(TIE[1])

    return float(brentq(gap, 0.5 * inner, inner, xtol=1e-14))


@dataclass(frozen=True, slots=True, eq=False)
class Steering:
    """The left steering cylinder from above: P on the chassis, Q on the knuckle of the straight machine."""

    P: Point
    Q: Point

    def length(self, angle: float) -> float:
        """Of the cylinder at an angle of its knuckle."""
        return float(np.hypot(*(KING + rot(angle, self.Q - KING) - self.P)))


@functools.cache
def solve_steering() -> Steering:
    """Pins for which one cylinder is closed and the other open at full lock; the same on every call."""
    closed, stroke, far = v.STEER_CLOSED.value, v.STEER_STROKE.value, outer(LOCK)

    def pins(x: Point) -> Steering:
        return Steering(vec(3850.0, x[0]), KING + x[1] * (TIE - KING) / ARM)

    def missed(x: Point) -> Point:
        s = pins(x)
        # The left knuckle turns to the right as far as the right one does to the left.
        return np.array([s.length(LOCK) - closed, s.length(-far) - closed - stroke])

    return pins(least_squares(missed, [250.0, 257.0], xtol=1e-15, ftol=1e-15, gtol=1e-15).x)
