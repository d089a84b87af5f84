"""Where the truck's axles, hinges and cylinders are: solved so that it meets its values.

Machine frame, millimetres: x forward from the articulation, y left, z up from the ground. Angles are radians; a raised
body is positive.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, least_squares

from drawing.articulation import Steering, steering_between
from drawing.planar import Point, direction, rot, vec

from . import values as v

RADIUS = v.TYRE_DIAMETER.value / 2
LOCK = math.radians(v.ARTICULATION.value)
FRONT_X = (
    v.WHEELBASE.value - (v.TURNING_RADIUS.value - (v.FRONT_TREAD.value + v.TYRE_WIDTH.value) / 2) * math.sin(LOCK)
) / (1.0 - math.cos(LOCK))
"""The front axle ahead of the articulation: what the turning radius takes."""
BOGIE_X = FRONT_X - v.WHEELBASE.value
MIDDLE_X, REAR_X = (BOGIE_X + sign * v.BOGIE_SPACING.value / 2 for sign in (1.0, -1.0))
NOSE = FRONT_X + v.FRONT_OVERHANG.value
TAIL = NOSE - v.LENGTH.value
ROLL_Z, STEER_Z = 1215.0, 1230.0
"""Heights of the axis that the rear frame rolls about, and of the steering cylinders."""
HINGE = vec(-4900.0, 1500.0)
"""The body's pivot."""
FLOOR, HEAD_X = 1985.0, -350.0
"""Underside of the body's floor; its foremost point."""
HOIST_Y = 620.0
_HOIST_Z = (1000.0, 1890.0)
"""Heights of the hoist cylinders' pins, on the frame and on the lowered body."""
DUMP = math.radians(v.DUMP_ANGLE.value)


def carry(raised: float, point: Point) -> Point:
    """Where a point of the lowered body is when it is raised."""
    return HINGE + rot(raised, point - HINGE)


@dataclass(frozen=True, slots=True, eq=False)
class Hoist:
    """A hoist cylinder's pins: C on the frame, D on the lowered body."""

    C: Point
    D: Point

    def length(self, raised: float) -> float:
        """Of the cylinder."""
        return float(np.hypot(*(carry(raised, self.D) - self.C)))

    def raised(self, length: float) -> float:
        """The body's angle at a length of the cylinder."""
        return float(brentq(lambda a: self.length(a) - length, -0.01, DUMP + 0.01, xtol=1e-14))


@functools.cache
def solve_hoist() -> Hoist:
    """Pins for which the stroke gives the dump angle; the same on every call."""
    low, high = _HOIST_Z
    closed, stroke = v.HOIST_CLOSED.value, v.HOIST_STROKE.value

    def pins(x: Point) -> Hoist:
        return Hoist(vec(x[0], low), vec(x[1], high))

    def missed(x: Point) -> Point:
        return np.array([pins(x).length(0.0) - closed, pins(x).length(DUMP) - closed - stroke])

    return pins(least_squares(missed, [-1750.0, -3660.0], xtol=1e-15, ftol=1e-15, gtol=1e-15).x)


@functools.cache
def solve_steering() -> Steering:
    """Barrels on the tractor, rods on the hitch; the same on every call."""
    return steering_between(1060.0, -150.0, LOCK, v.STEER_CLOSED.value, v.STEER_STROKE.value)


def head_top() -> float:
    """Height of the headboard: what the raised body's height takes."""
    over = v.RAISED_HEIGHT.value - HINGE[1] - (HEAD_X - HINGE[0]) * math.sin(DUMP)
    return float(HINGE[1] + over / math.cos(DUMP))


def tail_low() -> float:
    """Height of the lowered tail's underside: what the clearance under the raised one takes."""
    under = v.DUMP_CLEARANCE.value - HINGE[1] - (TAIL - HINGE[0]) * math.sin(DUMP)
    return float(HINGE[1] + under / math.cos(DUMP))


def bumper_low() -> float:
    """Height of the bumper: what the approach angle takes, a ramp that touches the front tyres."""
    angle = math.radians(v.APPROACH_ANGLE.value)
    return RADIUS - RADIUS / math.cos(angle) + v.FRONT_OVERHANG.value * math.tan(angle)


def measured() -> dict[str, float]:
    """What the solved layout gives, by the value's name; millimetres and degrees."""
    hoist, steering = solve_hoist(), solve_steering()
    lock = steering.lock(v.STEER_CLOSED.value, v.STEER_STROKE.value)
    raised = hoist.raised(v.HOIST_CLOSED.value + v.HOIST_STROKE.value)
    # The turn's middle, in the rear frame's axes: on the bogie's line, and on the front axle's.
    axle = vec(FRONT_X * math.cos(lock), FRONT_X * math.sin(lock))
    inwards = vec(-math.sin(lock), math.cos(lock))
    radius = (axle[0] - BOGIE_X) / -inwards[0]
    corner, tail = (carry(raised, vec(x, z)) for x, z in ((HEAD_X, head_top()), (TAIL, tail_low())))
    nose = vec(NOSE - FRONT_X, bumper_low() - RADIUS)
    return {
        v.TURNING_RADIUS.name: float(radius) + (v.FRONT_TREAD.value + v.TYRE_WIDTH.value) / 2,
        v.ARTICULATION.name: math.degrees(lock),
        v.DUMP_ANGLE.name: math.degrees(raised),
        v.RAISED_HEIGHT.name: float(corner[1]),
        v.DUMP_CLEARANCE.name: float(tail[1]),
        v.APPROACH_ANGLE.name: math.degrees(direction(nose) + math.asin(RADIUS / float(np.hypot(*nose)))),
        v.WHEELBASE.name: FRONT_X - BOGIE_X,
        v.BOGIE_SPACING.name: MIDDLE_X - REAR_X,
        v.LENGTH.name: NOSE - TAIL,
    }
