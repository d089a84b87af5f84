"""The crane's linkages, solved so that they meet its values: boom and luffing cylinder in the plane y = 0, steering
from above.

Machine frame, millimetres: the slewing axis is x = y = 0, x forward over the cab, z up from the ground. The boom's
own frame has its foot pin P as origin and x along its sections. Angles are radians.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, fsolve

from drawing.planar import Point, rot, vec
from drawing.steer_axle import SteerAxle

from . import values as v

RADIUS, HALF_BASE = v.TYRE.value / 2, v.WHEELBASE.value / 2
HIGH, LOW = math.radians(v.BOOM_HIGH.value), math.radians(v.BOOM_LOW.value)
P = vec(v.RADIUS_OUT.value - v.BOOM_OUT.value, 2_500.0)
"""The boom's foot pin: level and all out, the boom's head has the published radius."""
D = vec(3_300.0, 20.0)
"""The luffing rod's pin, in the boom's frame."""
TRAVEL = v.BOOM_OUT.value - v.BOOM_IN.value
RAISED = float(P[1]) + v.BOOM_OUT.value * math.sin(HIGH) - v.LIFT_HEIGHT.value
"""From the pin of the head's sheaves down to the hook's middle, hauled in: it is then at the published height."""
HAUL = 1_000.0
"""How far it can be hauled in from where it is drawn."""


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """How the crane stands: the boom's angle and the share it is drawn out, the shares that outrigger beams and jacks
    are; D luffing rod's pin and N the head's in the machine's frame."""

    boom: float
    out: float
    beam: float
    jack: float

    @property
    def rod(self) -> Point:
        """The luffing rod's pin."""
        return P + rot(self.boom, D)

    @property
    def length(self) -> float:
        """Of the boom, from foot to head."""
        return v.BOOM_IN.value + self.out * TRAVEL

    @property
    def head(self) -> Point:
        """The pin of the head's sheaves."""
        return P + rot(self.boom, vec(self.length, 0.0))


@functools.cache
def barrel() -> tuple[float, float]:
    """The luffing barrel's pin: closed the boom is at its lowest, drawn out at its highest."""
    ends = v.LUFFING_CLOSED.value, v.LUFFING_CLOSED.value + v.LUFFING_STROKE.value

    def over(at: Point) -> list[float]:
        return [luffing(a, at) - n for a, n in zip((LOW, HIGH), ends, strict=True)]

    x, z = fsolve(over, P + vec(900.0, -860.0), xtol=1e-12)
    return float(x), float(z)


def luffing(boom: float, at: Point | None = None) -> float:
    """Length of the luffing cylinder."""
    start = np.array(barrel()) if at is None else at
    return float(np.hypot(*(P + rot(boom, D) - start)))


def boom_at(radius: float, length: float) -> float:
    """The boom's angle at which the hook hangs at a radius, millimetres both."""
    return math.acos((radius - float(P[0])) / length)


# ---- steering --------
KING = 760.0


def _axle(end: str, out: float) -> SteerAxle:
    x = HALF_BASE if end == "front" else -HALF_BASE
    tread = v.TREAD.value
    return SteerAxle(
        "carrier", x, RADIUS, king=KING, arm=(x - out, KING - 25.0), end=(x - out - 25.0, 330.0),
        ram_z=RADIUS - 75.0, tie_z=RADIUS - 118.0, wheel_z=RADIUS, spindle=(120.0, tread / 2 - KING - 20.0),
        bore=v.STEER_BORE.value, rod=v.STEER_ROD.value, stroke=v.STEER_STROKE.value, outside=v.STEER_BORE.value + 8.0,
        prefix=f"{end}_", on="carrier", fast=True,
    )  # fmt: skip


def turning_radius(axle: SteerAxle) -> float:
    """Outside the outer front tyre where it stands, steered to the left by the front wheels alone: about the point to
    which the four wheels' axes come nearest."""
    half, places, axes, tread = v.STEER_STROKE.value / 2, [], [], v.TREAD.value
    for x in (HALF_BASE, -HALF_BASE):
        for side in (1.0, -1.0):
            angle = axle.knuckle_angle(-half, side) if x > 0.0 else 0.0
            across = rot(angle, vec(0.0, 1.0))
            places.append(vec(x, side * axle.king) + side * (tread / 2 - axle.king) * across)
            axes.append(across)
    normals = np.column_stack([-np.array(axes)[:, 1], np.array(axes)[:, 0]])
    centre = np.linalg.lstsq(normals, np.sum(normals * np.array(places), axis=1), rcond=None)[0]
    wide = v.TYRE_WIDTH.value / 2
    return float(
        max(np.hypot(*(p + s * wide * a - centre)) for p, a in zip(places, axes, strict=True) for s in (1, -1))
    )


@functools.cache
def _arm() -> float:
    """How long the knuckles' arms are with which the machine turns on the published radius."""
    return float(brentq(lambda out: turning_radius(_axle("front", out)) - v.TURNING.value, 215.0, 320.0, xtol=1e-11))


def solve_axle(end: str) -> SteerAxle:
    """The front or the rear axle; they are alike."""
    return _axle(end, _arm())


def values() -> dict[str, float]:
    """What the linkages give, by the value's name; millimetres, degrees, seconds at the pump's flow."""

    def angle(length: float) -> float:
        return math.degrees(float(brentq(lambda a: luffing(a) - length, -0.3, 1.6, xtol=1e-14)))

    high, low = Pose(HIGH, 1.0, 0.0, 0.0), Pose(LOW, 1.0, 0.0, 0.0)
    litres = math.pi / 4 * v.LUFFING_BORE.value**2 * v.LUFFING_STROKE.value * 1e-6
    return {
        v.BOOM_HIGH.name: angle(v.LUFFING_CLOSED.value + v.LUFFING_STROKE.value),
        v.BOOM_LOW.name: angle(v.LUFFING_CLOSED.value),
        v.BOOM_OUT.name: v.BOOM_IN.value + 3.0 * v.TELESCOPE_STROKE.value,
        v.RADIUS_OUT.name: float(low.head[0]),
        v.LIFT_HEIGHT.name: float(high.head[1]) - RAISED,
        v.LUFFING_TIME.name: 60.0 * litres / v.FLOW.value,
        v.TURNING.name: turning_radius(solve_axle("front")),
    }
