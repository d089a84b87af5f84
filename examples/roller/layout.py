"""Where the rollers' axles and steering pins are: solved so that they meet their values.

Machine frame, millimetres: x forward from the articulation, y left, z up from the ground. Angles are radians.
"""

from __future__ import annotations

import functools
import math

from drawing.articulation import Steering, steering_between

from . import values as v

DRUM = v.DRUM_DIAMETER.value / 2
HALF = v.DRUM_WIDTH.value / 2
LOCK = math.radians(v.ARTICULATION.value)
ROLL_Z = STEER_Z = 1000.0
"""Heights of the axis that the front frame rolls about, and of the steering cylinders."""


def front_x(m: v.Machine) -> float:
    """The front drum ahead of the articulation: what the turning radius takes, which its outer edge has, or that of the
    tyres, which stand farther out."""
    middle, base, c = m.turning_radius.value - outer_half(m), m.wheelbase.value, math.cos(LOCK)
    front = base - middle * math.sin(LOCK) if m.tyre is None else middle * math.sin(LOCK) - base * c
    return front / (1.0 - c)


def rear_x(m: v.Machine) -> float:
    """The rear drum's or the wheels' axis."""
    return front_x(m) - m.wheelbase.value


def outer_half(m: v.Machine) -> float:
    """From the middle to the outside of what is behind."""
    return HALF if m.tyre is None else (m.tyre[2].value + m.tyre[1].value) / 2


@functools.cache
def solve_steering() -> Steering:
    """Barrels on the rear frame, rods on the hitch; the same on every call."""
    return steering_between(-770.0, 130.0, LOCK, v.STEER_CLOSED.value, v.STEER_STROKE.value)


def measured(m: v.Machine) -> dict[str, float]:
    """What the solved layout gives, by the value's name; millimetres and degrees."""
    lock = solve_steering().lock(v.STEER_CLOSED.value, v.STEER_STROKE.value)
    front, rear = front_x(m), -rear_x(m)
    # The turn's middle is on either axle's line: its distances from their middles.
    radii = ((rear + front * math.cos(lock)) / math.sin(lock) + HALF,
             (front + rear * math.cos(lock)) / math.sin(lock) + outer_half(m))  # fmt: skip
    return {
        m.turning_radius.name: max(radii),
        v.ARTICULATION.name: math.degrees(lock),
        m.wheelbase.name: front + rear,
    }
