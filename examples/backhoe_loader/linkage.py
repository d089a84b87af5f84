"""The backhoe loader's linkages, solved so that it meets its values: the loader's and the backhoe's in the plane y = 0,
the swing's from above, the stabilisers' across the machine.

Machine frame, millimetres: x forward from the rear axle, z up from the ground. The backhoe's own plane goes backward
from the swing pivot. Angles are radians.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq, least_squares

from drawing import loader
from drawing.digger import Ends, Linkage, Sketch, Strokes, fitted
from drawing.planar import Point, direction, rot, vec
from drawing.stabiliser import Stabiliser
from drawing.steer_axle import SteerAxle

from . import values as v

FRONT_X, SWING_X = v.WHEELBASE.value, -v.SLEW_TO_AXLE.value
FRONT_RADIUS, REAR_RADIUS = v.FRONT_TYRE.value / 2, v.TYRE_DIAMETER.value / 2


# ---- loader --------
DEPTH = 190.0
"""The loader bucket's hinge pin above its floor's underside, level."""
EDGE = vec(math.sqrt(2) * (v.HINGE_HEIGHT.value - v.DUMP_HEIGHT.value) - DEPTH, -DEPTH)
ARMS = vec(1000.0, 1560.0)
"""The arms' pins on the chassis."""
TOP = vec(FRONT_X + FRONT_RADIUS + v.DUMP_REACH.value - float(rot(math.radians(-45.0), EDGE)[0]), v.HINGE_HEIGHT.value)
"""The hinge with the arms raised."""
LIFTS = v.LIFT_CLOSED.value, v.LIFT_CLOSED.value + v.LIFT_STROKE.value
TILTS = v.TILT_CLOSED.value, v.TILT_CLOSED.value + v.TILT_STROKE.value
# C, D (polar in the arms), E, G (in the arms), G-F, H (polar in the rocker), link, J; and how near.
_LOADER = np.array([
    1217.5, 989.0, 1477.2, -0.016, 1436.4, 1478.6, 1553.2, 264.1, 774.9, 372.3, 2.893, 942.2, -44.2, 225.8,
])  # fmt: skip
_NEAR = np.array([40.0, 40.0, 60.0, 0.05, 60.0, 50.0, 100.0, 60.0, 100.0, 80.0, 0.2, 120.0, 40.0, 40.0])


def _loader(x: Point) -> loader.Linkage:
    return loader.Linkage(
        A=ARMS, C=vec(x[0], x[1]), D=rot(x[3], vec(x[2], 0.0)), E=vec(x[4], x[5]), G=vec(x[6], x[7]),
        boom=float(np.hypot(*(TOP - ARMS))), rocker=float(x[8]), H=rot(x[10], vec(x[9], 0.0)), link=float(x[11]),
        J=vec(x[12], x[13]), T=EDGE,
    )  # fmt: skip


def _loader_missed(x: Point) -> Point:
    """What must be zero: the lift cylinders' ends, rollback on the ground, dump angle raised."""
    k = _loader(x)
    ground, low = (math.asin((z - float(ARMS[1])) / k.boom) for z in (DEPTH, DEPTH - v.LOADER_DEPTH.value))
    top = direction(TOP - ARMS)
    angles = (
        k.pose_at(ground, 0.0, TILTS[1]).bucket_angle - math.radians(v.ROLLBACK.value),
        k.pose_at(top, 0.0, TILTS[0]).bucket_angle + math.radians(v.DUMP_ANGLE.value),
    )
    return np.array([k.lift_at(low) - LIFTS[0], k.lift_at(top) - LIFTS[1], *(1000.0 * angle for angle in angles)])


@functools.cache
def solve_loader() -> loader.Linkage:
    """Arms and Z-bar: the level bucket stays within 10 degrees of level as the arms rise. The same on every call."""

    def wished(x: Point) -> Point:
        return np.concatenate([_loader_missed(x), 0.1 * (x - _LOADER) / _NEAR])

    near = least_squares(wished, _LOADER, x_scale=_NEAR, xtol=1e-12, ftol=1e-12, gtol=1e-12).x
    exact = least_squares(_loader_missed, near, x_scale=_NEAR, method="trf", xtol=1e-15, ftol=1e-15, gtol=1e-15).x
    return _loader(np.round(exact, 9))


# ---- backhoe --------
BOOM, ARM = v.BOOM_LENGTH.value, v.DIPPER_LENGTH.value + v.EXTENSION_STROKE.value
"""The arm of the digger is the dipper, drawn out."""
STROKES = Strokes(
    (v.BOOM_CLOSED.value, v.BOOM_CLOSED.value + v.BOOM_STROKE.value),
    (v.DIPPER_CLOSED.value, v.DIPPER_CLOSED.value + v.DIPPER_STROKE.value),
    (v.BUCKET_CLOSED.value, v.BUCKET_CLOSED.value + v.BUCKET_STROKE.value),
)
SKETCH = Sketch(
    {
        "A.x": (125, 4), "A.z": (1000, 10), "C.x": (180, 8), "C.z": (645, 10), "D.x": (1240, 60), "D.z": (-10, 8),
        "M.x": (1216, 60), "M.z": (540, 15), "P.x": (-400, 25), "P.z": (200, 25), "E.x": (ARM - 1283, 40),
        "E.z": (245, 8), "G.x": (ARM - 205, 15), "G.z": (17, 10), "tipping": (297, 25), "link": (275, 25),
        "J.r": (225, 15), "J.a": (math.radians(95), 0.15), "tip": (800, 15), "low": (math.radians(-57), 0.06),
        "high": (math.radians(75), 0.06), "out": (math.radians(-38), 0.05), "crowd": (math.radians(-145), 0.08),
        "open": (math.radians(25), 0.12), "curl": (math.radians(-145), 0.15),
    },
    boom=BOOM, arm=ARM, strokes=STROKES, least_sine=0.27, pull=20.0,
)  # fmt: skip


def ranges(a: Point, tip: float, e: Ends) -> dict[str, float]:
    """The working ranges by the values' names, millimetres. The lowest point: boom down, dipper out as far as it goes
    but not past the plumb line, tooth points straight below K. The farthest: dipper out, K and T in line with A."""
    boom, arm = vec(BOOM, 0.0), vec(ARM, 0.0)
    low = a + rot(e.low, boom) + rot(min(e.low + e.out, -math.pi / 2), arm)
    far = float(np.hypot(*(boom + rot(e.out, arm)))) + tip
    high = a + rot(e.high, boom + rot(e.out, arm))
    return {
        v.DIG_DEPTH.name: tip - float(low[1]),
        v.GROUND_REACH.name: float(a[0]) + math.sqrt(max(0.0, far**2 - float(a[1]) ** 2)),
        v.LOADING_HEIGHT.name: float(high[1]) - tip,
    }


@functools.cache
def solve_backhoe() -> Linkage:
    """The backhoe's linkage with its dipper drawn out; the same on every call."""

    def published(k: Linkage, e: Ends) -> list[float]:
        got = ranges(k.A, k.tip, e)
        return [got[value.name] - value.value for value in (v.DIG_DEPTH, v.GROUND_REACH, v.LOADING_HEIGHT)]

    return fitted(SKETCH, published)


def drawn_in(k: Linkage, by: float) -> Linkage:
    """The linkage with its dipper shorter by so much: what the extension carries comes nearer."""
    back = vec(by, 0.0)
    return replace(k, arm=k.arm - by, E=k.E - back, G=k.G - back)


# ---- swing: from above, about the pivot; y left --------
SWING_Z = 720.0
_BARREL = vec(890.0, 133.0)
"""The left cylinder's barrel pin, from the pivot."""
HALF_ARC = math.radians(v.SWING_ARC.value / 2)


@dataclass(frozen=True, slots=True)
class Swing:
    """The swing's triangle: distance of the left rod's pin from the pivot, square to the barrel's straight ahead."""

    arm: float

    def rod(self, left: float) -> Point:
        """The left rod's pin from the pivot, with the backhoe turned to the left by an angle."""
        return rot(direction(_BARREL) + math.pi / 2 + left, vec(self.arm, 0.0))

    def length(self, left: float) -> float:
        """The left cylinder's length."""
        return float(np.hypot(*(self.rod(left) - _BARREL)))

    @property
    def barrel(self) -> Point:
        """The left barrel's pin from the pivot."""
        return _BARREL


@functools.cache
def solve_swing() -> Swing:
    """The triangle that swings the backhoe from stop to stop over the stroke."""

    def miss(arm: float) -> float:
        swing = Swing(arm)
        return swing.length(HALF_ARC) - swing.length(-HALF_ARC) - v.SWING_STROKE.value

    return Swing(float(brentq(miss, 100.0, 300.0, xtol=1e-12)))


# ---- stabilisers: across, (y, z) of the left one --------
@functools.cache
def solve_stabiliser() -> Stabiliser:
    """The triangle that lowers the leg over the stroke."""
    leg = Stabiliser(v.FEET_CLEARANCE.value, v.SPREAD.value, (560.0, 1150.0))
    return leg.moved_by(v.STABILISER_STROKE.value)


# ---- steering --------
KING, AXLE_Z = 690.0, 520.0


def _axle(out: float) -> SteerAxle:
    """The front axle with its arms' pins at a distance behind the kingpins."""
    return SteerAxle(
        "front_axle", FRONT_X, AXLE_Z, king=KING, arm=(FRONT_X - out, KING - 30.0), end=(FRONT_X - out - 25.0, 330.0),
        ram_z=AXLE_Z - 75.0, tie_z=AXLE_Z - 118.0, wheel_z=FRONT_RADIUS, spindle=(90.0, 160.0),
        bore=v.STEER_BORE.value, rod=v.STEER_ROD.value, stroke=v.STEER_STROKE.value,
    )  # fmt: skip


@functools.cache
def solve_axle() -> SteerAxle:
    """The axle whose left wheel turns to the left by the steering angle when the rod is at its right end."""
    angle, half = math.radians(v.STEER_ANGLE.value), v.STEER_STROKE.value / 2
    return _axle(float(brentq(lambda out: _axle(out).knuckle_angle(-half) - angle, 175.0, 260.0, xtol=1e-12)))
