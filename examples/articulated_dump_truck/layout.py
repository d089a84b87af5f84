"""Where the truck's axles, hinges and cylinders are: solved so that it meets its values.

Machine frame, millimetres: x forward from the articulation, y left, z up from the ground. Angles are radians; a raised
body is positive.
"""

from __future__ import annotations

import functools
import math

import numpy as np

from drawing.articulation import Steering, steering_between
from drawing.planar import direction, vec
from drawing.tipper import Hoist, Tipper, fitted_hoist

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
TIPPER = Tipper(vec(-4900.0, 1500.0), math.radians(v.DUMP_ANGLE.value))
FLOOR, HEAD_X = 1985.0, -350.0
"""Underside of the body's floor; its foremost point."""
HEAD_TOP, TAIL_LOW = (
    TIPPER.lowered(x, value.value) for x, value in ((HEAD_X, v.RAISED_HEIGHT), (TAIL, v.DUMP_CLEARANCE))
)
"""Heights of the headboard and of the tail's underside on the lowered body: what its heights when raised take."""
HOIST_Y = 620.0


@functools.cache
def solve_hoist() -> Hoist:
    """Pins for which the stroke gives the dump angle; the same on every call."""
    near = vec(-1750.0, 1000.0), vec(-3660.0, 1890.0)
    return fitted_hoist(TIPPER, near, v.HOIST_CLOSED.value, v.HOIST_STROKE.value)


@functools.cache
def solve_steering() -> Steering:
    """Barrels on the tractor, rods on the hitch; the same on every call."""
    return steering_between(1060.0, -150.0, LOCK, v.STEER_CLOSED.value, v.STEER_STROKE.value)


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
    corner, tail = (TIPPER.carry(raised, vec(x, z)) for x, z in ((HEAD_X, HEAD_TOP), (TAIL, TAIL_LOW)))
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
