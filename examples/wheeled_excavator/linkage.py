"""The wheeled excavator's linkages, solved so that it meets its published values: the digger's in the plane y = 0, the
steering's from above, the stabilisers' across. Millimetres, radians."""

from __future__ import annotations

import functools
import math

import numpy as np
from scipy.optimize import brentq, fsolve

from drawing.digger import Ends, Linkage, Sketch, Strokes, fitted
from drawing.planar import Point, direction, rot, vec
from drawing.stabiliser import FOOT, HEEL, Stabiliser
from drawing.steer_axle import SteerAxle

from . import values as v

BOOM, ARM = v.BOOM_LENGTH.value, v.ARM_LENGTH.value
STROKES = Strokes(
    (v.BOOM_CLOSED.value, v.BOOM_CLOSED.value + v.BOOM_STROKE.value),
    (v.ARM_CLOSED.value, v.ARM_CLOSED.value + v.ARM_STROKE.value),
    (v.BUCKET_CLOSED.value, v.BUCKET_CLOSED.value + v.BUCKET_STROKE.value),
)
NOSE_AT = 2_562.115
"""x of the bucket pin with boom, arm and bucket cylinder open: what the published minimum swing radius takes of the
drawn arm and bucket."""

SKETCH = Sketch(
    {
        "A.x": (150, 40), "A.z": (1855, 20), "C.x": (560, 30), "C.z": (1410, 15), "D.x": (2250, 60), "D.z": (560, 15),
        "M.x": (2575, 80), "M.z": (815, 12), "P.x": (-690, 30), "P.z": (380, 30), "E.x": (400, 50), "E.z": (590, 20),
        "G.x": (ARM - 435, 25), "G.z": (45, 20), "tipping": (650, 40), "link": (580, 40), "J.r": (415, 25),
        "J.a": (math.radians(95), 0.12), "tip": (1380, 25), "low": (math.radians(-48), 0.1),
        "high": (math.radians(73), 0.05), "out": (math.radians(-37), 0.04), "crowd": (math.radians(-148), 0.04),
        "open": (math.radians(17), 0.06), "curl": (math.radians(-166), 0.06),
    },
    boom=BOOM, arm=ARM, strokes=STROKES, least_sine=0.3, pull=60.0,
)  # fmt: skip
"""Proportions of the class."""


def ranges(a: Point, tip: float, e: Ends) -> dict[str, float]:
    """The working ranges by the values' names, millimetres (see the excavator's `ranges`): the arm hangs straight down
    when the tooth points are deepest, or as far out as it goes where that is not so far; the bucket is in line with A
    when they are farthest, or open where it does not open so far."""
    boom, arm = vec(BOOM, 0.0), vec(ARM, 0.0)
    low = a + rot(e.low, boom)
    deep = low + rot(min(-math.pi / 2, e.low + e.out), arm)
    pin = boom + rot(e.out, arm)
    opened = min(e.open, direction(pin) - e.out)
    far = float(np.hypot(*(pin + rot(e.out + opened, vec(tip, 0.0)))))
    out = a + rot(e.high, boom + rot(e.out, arm))
    return {
        v.DIGGING_DEPTH.name: tip - float(deep[1]),
        v.GROUND_REACH.name: float(a[0]) + math.sqrt(max(0.0, far**2 - float(a[1]) ** 2)),
        v.MAX_REACH.name: float(a[0]) + far,
        v.DIGGING_HEIGHT.name: float((out + rot(e.high + e.out + e.open, vec(tip, 0.0)))[1]),
        v.DUMPING_HEIGHT.name: float(out[1]) - tip,
    }


def _published(k: Linkage, e: Ends) -> list[float]:
    got = ranges(k.A, k.tip, e)
    wanted = (v.DIGGING_DEPTH, v.GROUND_REACH, v.MAX_REACH, v.DIGGING_HEIGHT, v.DUMPING_HEIGHT)
    folded = k.A + rot(e.high, vec(BOOM, 0.0) + rot(e.crowd, vec(ARM, 0.0)))
    turned = 1000.0 * (e.open - e.curl - math.radians(v.BUCKET_ROTATION.value))
    return [*(got[value.name] - value.value for value in wanted), float(folded[0]) - NOSE_AT, turned]


@functools.cache
def solve() -> Linkage:
    """The digger's linkage; the same on every call."""
    return fitted(SKETCH, _published)


# ---- wheels and steering, from above --------
RADIUS = v.TYRE_DIAMETER.value / 2
FRONT_X = v.SLEW_TO_FRONT.value
REAR_X = FRONT_X - v.WHEELBASE.value
TREAD = v.OVERALL_WIDTH.value - v.TYRE_WIDTH.value
AXLE_Z = 560.0
SPINDLE = 45.0
"""Radius."""


@functools.cache
def solve_axle() -> SteerAxle:
    """The front axle, its kingpins and its arms so that all wheels turn about one point of the rear axle's line: the
    inner one by the steering angle, the outer one's tyre on the published radius."""
    inner, base = math.radians(v.STEER_ANGLE.value), v.WHEELBASE.value

    def axle(king: float, back: float, inset: float) -> SteerAxle:
        return SteerAxle(
            "front_axle", FRONT_X, AXLE_Z, king=king, arm=(FRONT_X - back, king - inset),
            end=(FRONT_X - back - 25.0, 330.0), ram_z=AXLE_Z - 75.0, tie_z=AXLE_Z - 118.0, wheel_z=RADIUS,
            spindle=(2 * SPINDLE, TREAD / 2 - king - 20.0), bore=v.STEER_BORE.value, rod=v.STEER_ROD.value,
            stroke=v.STEER_STROKE.value, outside=122.0, on="undercarriage",
        )  # fmt: skip

    def outside(king: float) -> float:
        centre = king + base / math.tan(inner)
        return math.hypot(base, centre + king) + (TREAD + v.TYRE_WIDTH.value) / 2 - king

    king = float(brentq(lambda king: outside(king) - v.TURNING_RADIUS.value, 600.0, 800.0, xtol=1e-12))
    outer = math.atan2(base, 2 * king + base / math.tan(inner))

    def missed(arm: Point) -> list[float]:
        made = axle(king, *map(float, arm))
        angles = (made.knuckle_angle(-v.STEER_STROKE.value / 2, side) for side in (1.0, -1.0))
        return [got - wanted for got, wanted in zip(angles, (inner, outer), strict=True)]

    back, inset = fsolve(missed, (202.0, 38.0), xtol=1e-13)
    return axle(king, float(back), float(inset))


# ---- stabilisers: across, (y, z) of the left one --------
LEG_X = (-1_940.0, -1_860.0)


@functools.cache
def solve_stabiliser() -> Stabiliser:
    """The triangle that lowers the leg over the stroke, as far below the ground as it lifts the machine."""
    clearance, long = 390.0, 1_000.0
    lowered = -math.asin((clearance + HEEL - FOOT + v.STABILISER_LIFT.value) / long)
    leg = Stabiliser(clearance, v.SPREAD.value, (480.0, 1_100.0), long=long, lowered=lowered)
    return leg.moved_by(v.STABILISER_STROKE.value)
