"""The telehandlers' linkages, solved so that the first meets its values: boom, its cylinders and its carriage in the
plane y = 0, steering from above.

Machine frame, millimetres: x forward from the rear axle, z up from the ground. The boom's own frame has its pivot P as
origin and x along its sections; the carriage's its pin N, x along the level forks. Angles are radians.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq, fsolve

from drawing.planar import Point, rot, vec
from drawing.stabiliser import Stabiliser
from drawing.steer_axle import SteerAxle

from . import values as v

FRONT_X, RADIUS = v.WHEELBASE.value, v.TYRE_DIAMETER.value / 2
DROP = 800.0
"""How far the carriage's pin is below the boom's pivot, square to the sections."""
HEEL = vec(150.0, -330.0)
"""The forks' heel, on their upper faces, in the carriage's frame."""
ON_GROUND = 60.0
"""Height of the forks' upper faces when they travel just above the ground."""
HIGH, LOW = math.radians(v.BOOM_ANGLE.value), math.radians(v.LOW_ANGLE.value)
ROLLED_BACK = math.radians(25.0)
"""Of the carriage from the boom's sections, its cylinder in."""
DUMPED = ROLLED_BACK - math.radians(v.ROTATION.value)
LIFTS = v.LIFT_CLOSED.value, v.LIFT_CLOSED.value + v.LIFT_STROKE.value
TILTS = v.TILT_CLOSED.value, v.TILT_CLOSED.value + v.TILT_STROKE.value
ROD = vec(1750.0, -390.0)
"""The lift rod's pin, in the boom's frame."""
COMPENSATION = (vec(-384.0, -351.0), vec(300.0, -350.0))
"""The compensation cylinder's barrel pin from P, its rod pin in the boom's frame."""
TILT_FROM = vec(-720.0, 450.0)
"""The tilt cylinder's barrel pin from the carriage's, in the boom's frame."""


def _length(p: Point) -> float:
    return float(np.hypot(*p))


@dataclass(frozen=True, slots=True, eq=False)
class Pose:
    """Pins in the machine's frame: N carriage, D lift rod, F compensation rod, B and T tilt cylinder; `heel` of the
    forks; angles of boom and carriage from the level."""

    boom: float
    carriage: float
    N: Point
    D: Point
    F: Point
    B: Point
    T: Point
    heel: Point


@dataclass(frozen=True, slots=True, eq=False)
class Linkage:
    """`P` boom, `C` and `E` barrels of lift and compensation cylinder in the machine's frame; `arm`: the tilt rod's pin
    in the carriage's frame; `retracted`: from P to the carriage's pin along the sections; `sections` of the boom."""

    P: Point
    C: Point
    E: Point
    arm: Point
    retracted: float
    sections: int = 2

    @property
    def travel(self) -> float:
        """How far the innermost section goes out: each as far out of the one before as the cylinder goes."""
        return (self.sections - 1) * v.TELESCOPE_STROKE.value

    def pose(self, boom: float, out: float, carriage: float) -> Pose:
        """Of a boom at an angle and a share out, the carriage at an angle from the level."""
        n = self.P + rot(boom, vec(self.retracted + out * self.travel, -DROP))
        return Pose(
            boom, carriage, n, self.P + rot(boom, ROD), self.P + rot(boom, COMPENSATION[1]),
            n + rot(boom, TILT_FROM), n + rot(carriage, self.arm), n + rot(carriage, HEEL),
        )  # fmt: skip

    def lift(self, boom: float) -> float:
        """Length of the lift cylinder."""
        return _length(self.P + rot(boom, ROD) - self.C)

    def compensation(self, boom: float) -> float:
        """Length of the compensation cylinder."""
        return _length(self.P + rot(boom, COMPENSATION[1]) - self.E)

    def tilt(self, carriage: float) -> float:
        """Length of the tilt cylinder, the carriage at an angle from the boom's sections."""
        return _length(rot(carriage, self.arm) - TILT_FROM)

    def boom_at(self, lift: float) -> float:
        """The boom's angle at a length of the lift cylinder."""
        return float(brentq(lambda a: self.lift(a) - lift, LOW - 0.01, HIGH + 0.01, xtol=1e-14))

    def carriage_at(self, tilt: float) -> float:
        """The carriage's angle from the boom's sections at a length of the tilt cylinder."""
        return float(brentq(lambda a: self.tilt(a) - tilt, DUMPED - 0.01, ROLLED_BACK + 0.01, xtol=1e-14))

    def travelling(self) -> Pose:
        """Drawn in, the level forks just above the ground."""

        def height(boom: float) -> float:
            return float(self.pose(boom, 0.0, 0.0).heel[1]) - ON_GROUND

        return self.pose(float(brentq(height, LOW, 0.0, xtol=1e-14)), 0.0, 0.0)

    def values(self) -> dict[str, float]:
        """What it makes of the values, by their names."""
        high, front = self.pose(HIGH, 1.0, 0.0), FRONT_X + RADIUS
        far = float(self.P[0] + HEEL[0]) + math.hypot(self.retracted + self.travel, DROP)
        return {
            v.LIFT_HEIGHT.name: float(high.heel[1]),
            v.HEIGHT_REACH.name: float(high.heel[0]) - front,
            v.FORWARD_REACH.name: far - front,
            v.BOOM_ANGLE.name: math.degrees(self.boom_at(LIFTS[1])),
            v.LOW_ANGLE.name: math.degrees(self.boom_at(LIFTS[0])),
            v.ROTATION.name: math.degrees(self.carriage_at(TILTS[0]) - self.carriage_at(TILTS[1])),
            v.FORK_FACE.name: float(self.travelling().heel[0]) - REAR_X,
        }


def _solved() -> Linkage:
    """The machine with two sections: lift height and both reaches give the pivot and the boom's length."""
    behind = v.FORWARD_REACH.value - v.HEIGHT_REACH.value
    drop = vec(0.0, -DROP)

    def over(long: float) -> float:
        return math.hypot(long, DROP) - float((rot(HIGH, vec(long, 0.0) + drop))[0]) - behind

    long = float(brentq(over, 4_000.0, 9_000.0, xtol=1e-12))
    front = FRONT_X + RADIUS
    x = front + v.FORWARD_REACH.value - float(HEEL[0]) - math.hypot(long, DROP)
    z = v.LIFT_HEIGHT.value - float(HEEL[1] + (rot(HIGH, vec(long, 0.0) + drop))[1])
    pivot = vec(x, z)

    def lifts(at: Point) -> list[float]:
        return [_length(pivot + rot(a, ROD) - at) - n for a, n in zip((LOW, HIGH), LIFTS, strict=True)]

    def tilts(at: Point) -> list[float]:
        return [_length(rot(a, at) - TILT_FROM) - n for a, n in zip((ROLLED_BACK, DUMPED), TILTS, strict=True)]

    lift = np.array(fsolve(lifts, pivot + vec(170.0, -1190.0), xtol=1e-12))
    tilt = np.array(fsolve(tilts, vec(-42.0, 216.0), xtol=1e-12))
    return Linkage(pivot, lift, pivot + COMPENSATION[0], tilt, long - v.TELESCOPE_STROKE.value)


@functools.cache
def solve(sections: int = 2) -> Linkage:
    """The linkage of a machine; the same on every call. The one with three sections is that with two, longer by the
    collar of the middle one."""
    k = _solved()
    return k if sections == 2 else Linkage(k.P, k.C, k.E, k.arm, k.retracted + 100.0, sections)


REAR_X = float(_solved().travelling().heel[0]) - v.FORK_FACE.value
"""The rearmost point, of the counterweight."""


# ---- steering --------
AXLE_Z = 560.0
TREAD = v.OVERALL_WIDTH.value - v.TYRE_WIDTH.value


def _axle(end: str, king: float, out: float, fast: bool = False) -> SteerAxle:
    """An axle with kingpins at `king` and its arms' pins at `out` behind them; `fast` on the chassis."""
    x = FRONT_X if end == "front" else 0.0
    return SteerAxle(
        f"{end}_axle", x, AXLE_Z, king=king, arm=(x - out, king - 25.0), end=(x - out - 25.0, 330.0),
        ram_z=AXLE_Z - 75.0, tie_z=AXLE_Z - 118.0, wheel_z=RADIUS, spindle=(90.0, TREAD / 2 - king - 20.0),
        bore=v.STEER_BORE.value, rod=v.STEER_ROD.value, stroke=v.STEER_STROKE.value, prefix=f"{end}_",
        fast=fast,
    )  # fmt: skip


def turning_radius(axle: SteerAxle, tyre: float) -> float:
    """Outside the outer front tyre where it stands, steered to the left by the front wheels alone: about the point to
    which the four wheels' axes come nearest."""
    half, places, axes = v.STEER_STROKE.value / 2, [], []
    for x in (axle.x, 0.0):
        for side in (1.0, -1.0):
            angle = axle.knuckle_angle(-half, side) if x else 0.0
            across = rot(angle, vec(0.0, 1.0))
            places.append(vec(x, side * axle.king) + side * (TREAD / 2 - axle.king) * across)
            axes.append(across)
    normals = np.column_stack([-np.array(axes)[:, 1], np.array(axes)[:, 0]])
    centre = np.linalg.lstsq(normals, np.sum(normals * np.array(places), axis=1), rcond=None)[0]
    return max(_length(p + s * tyre / 2 * a - centre) for p, a in zip(places, axes, strict=True) for s in (1.0, -1.0))


@functools.cache
def _steered() -> tuple[float, float]:
    """Kingpin and arm with which the inner wheel turns by the steering angle at the end of the stroke and the machine
    on the published radius."""
    angle, half = math.radians(v.STEER_ANGLE.value), v.STEER_STROKE.value / 2

    def out(king: float) -> float:
        def over(out: float) -> float:
            return _axle("front", king, out).knuckle_angle(-half) - angle

        far = 220.0
        while over(far) < 0.0:  # nearer arms are soon past their dead point
            far -= 1.0
        return float(brentq(over, far, far + 1.0, xtol=1e-12))

    def over(king: float) -> float:
        return turning_radius(_axle("front", king, out(king)), v.TYRE_WIDTH.value) - v.TURNING_RADIUS.value

    king = float(brentq(over, 660.0, 700.0, xtol=1e-10))
    return king, out(king)


def solve_axle(end: str, sections: int = 2) -> SteerAxle:
    """The front or the rear axle of a machine; they are alike. With two sections the front one is fast."""
    return _axle(end, *_steered(), fast=end == "front" and sections == 2)


# ---- what the machine with three sections has besides: across, (y, z) of the left side --------
LEG_X = (3_130.0, 3_210.0)
LEVEL_FROM, LEVEL_ON = vec(420.0, 1_120.0), vec(470.0, 690.0)
"""The levelling cylinder's barrel pin on the chassis, its rod pin on the front axle, level."""


@functools.cache
def solve_stabiliser() -> Stabiliser:
    """The triangle that lowers a leg over the stroke."""
    return Stabiliser(390.0, v.SPREAD.value, (560.0, 1_150.0)).moved_by(v.STABILISER_STROKE.value)


def levelling(angle: float) -> float:
    """Length of the levelling cylinder, the front axle turned on the chassis by an angle, its left end up."""
    middle = vec(0.0, AXLE_Z)
    return _length(middle + rot(angle, LEVEL_ON - middle) - LEVEL_FROM)


# ---- sheets --------
def printed(value: v.Value, sections: int) -> v.Value:
    """A value as a machine's sheet has it: of the one with three sections what its linkage gives, and ours."""
    if sections == 2:
        return value
    made = solve(sections).values() | {v.WEIGHT.name: 8_400.0}
    return replace(value, value=round(made.get(value.name, value.value), 1), source=None, location="")
