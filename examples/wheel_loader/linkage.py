"""The wheel loader's planar linkage: solved so that the machine meets its published values, and measured
again.

Frame: the machine's, in millimetres and in the plane y = 0: x forward from the articulation axis, z up from
the ground.

Pins and angles are those of `drawing.loader`.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from drawing import loader
from drawing.articulation import Steering, steering_between
from drawing.planar import Point, direction, rot, vec

from . import values as v

FRONT_AXLE_X = v.WHEELBASE.value / 2
"""Articulation in the middle of the wheelbase, as on the real machine."""
TYRE_RADIUS = v.TYRE_DIAMETER.value / 2
EDGE_DEPTH = 290.0
"""Hinge pin above the floor's underside, bucket level."""


@dataclass(frozen=True, slots=True)
class Linkage(loader.Linkage):
    """The linkage with this machine's tilt cylinder."""

    def tilt_for(self, lift: float, angle: float) -> float:
        """Tilt cylinder length that puts the bucket at `angle` (radians)."""
        return self.tilt_for_angle(lift, angle, (TILT_MIN, TILT_MAX))

    def breakout(self) -> float:
        """Upward force, kN, 100 mm behind the edge of the level bucket on the ground, tilt cylinder at relief pressure
        (ISO 14397-2), by virtual work; weights left out."""
        lift = self.lift_for_hinge(EDGE_DEPTH)
        level, step = self.tilt_for(lift, 0.0), 1e-3

        def height(tilt: float) -> float:
            pose = self.pose(lift, tilt)
            return float((pose.B + rot(pose.bucket_angle, self.T - vec(100.0, 0.0)))[1])

        rise = (height(level + step) - height(level - step)) / (2 * step)
        return v.WORK_PRESSURE.value * math.pi / 4 * v.TILT_BORE.value**2 / 1000 / rise


LIFT_MIN, LIFT_MAX = v.LIFT_CLOSED.value, v.LIFT_CLOSED.value + v.LIFT_STROKE.value
TILT_MIN, TILT_MAX = v.TILT_CLOSED.value, v.TILT_CLOSED.value + v.TILT_STROKE.value
EDGE = vec(math.sqrt(2) * (v.HINGE_HEIGHT_MAX.value - v.DUMP_CLEARANCE.value) - EDGE_DEPTH, -EDGE_DEPTH)
"""T in the bucket: at a 45 degree dump its height below B is (x + depth)/sqrt 2, the published hinge height
less the clearance."""
EDGE_GROUND_X = v.OVERALL_LENGTH.value - FRONT_AXLE_X - v.REAR_OVERHANG.value
"""x of the edge with the bucket level on the ground, from the overall length."""
HINGE_GROUND = vec(EDGE_GROUND_X - EDGE[0], EDGE_DEPTH)
HINGE_MAX = vec(
    FRONT_AXLE_X + TYRE_RADIUS + v.DUMP_REACH.value - rot(math.radians(-45.0), EDGE)[0],
    v.HINGE_HEIGHT_MAX.value,
)

# Where the search starts and what it stays near (sketch), and how near (loose): proportions of the class.
_SKETCH = np.array(
    [
        *(805.0, 2119.0),  # A
        *(600.0, 1440.0),  # C
        *(1430.0, math.radians(-5.0)),  # D, polar in the boom
        *(1190.0, 2085.0),  # E
        *(1950.0, 340.0),  # G, in the boom
        860.0,  # G-F
        *(745.0, math.radians(172.0)),  # H, polar in the rocker
        800.0,  # link
        *(-130.0, 345.0),  # J, in the level bucket
    ]
)
_LOOSE = np.array([40.0, 20.0, 40.0, 40.0, 40.0, 0.10, 80.0, 80.0, 100.0, 60.0, 60.0, 60.0, 0.3, 60.0, 40.0, 40.0])
_LEAST_SINE = 0.27
"""How far every lever of the bucket's linkage stays from its dead point, as a sine."""


def _linkage(x: Point) -> Linkage:
    a = vec(x[0], x[1])
    return Linkage(
        A=a,
        C=vec(x[2], x[3]),
        E=vec(x[6], x[7]),
        boom=float(np.hypot(*(HINGE_MAX - a))),
        D=rot(x[5], vec(x[4], 0.0)),
        G=vec(x[8], x[9]),
        rocker=float(x[10]),
        H=rot(x[12], vec(x[11], 0.0)),
        link=float(x[13]),
        J=vec(x[14], x[15]),
        T=EDGE,
    )


def _required(x: Point) -> Point:
    """What must be zero: millimetres and, for angles, radians times 1000."""
    k = _linkage(x)
    top = direction(HINGE_MAX - k.A)
    ground = direction(HINGE_GROUND - k.A)
    low = math.asin((EDGE_DEPTH - v.DIG_DEPTH.value - k.A[1]) / k.boom)
    angles = (
        (k.pose_at(ground, 0.0, TILT_MAX).bucket_angle, v.RACK_BACK_GROUND.value),
        (k.pose_at(top, 0.0, TILT_MAX).bucket_angle, v.RACK_BACK_MAX.value),
        (k.pose_at(top, 0.0, TILT_MIN).bucket_angle, -v.DUMP_ANGLE_MAX.value),
    )
    return np.array(
        [
            np.hypot(*(HINGE_GROUND - k.A)) - k.boom,
            k.lift_at(top) - LIFT_MAX,
            k.lift_at(low) - LIFT_MIN,
            *(1000.0 * (got - math.radians(want)) for got, want in angles),
        ]
    )


def _wished(x: Point) -> Point:
    """The required residuals, and softly: near the sketch, and every lever far from its dead point over the
    whole range."""
    k = _linkage(x)
    top = direction(HINGE_MAX - k.A)
    low = math.asin((EDGE_DEPTH - v.DIG_DEPTH.value - k.A[1]) / k.boom)
    short: list[float] = []
    for beta in np.linspace(low, top, 7):
        for tilt in np.linspace(TILT_MIN, TILT_MAX, 7):
            pose = k.pose_at(float(beta), 0.0, float(tilt))
            for margin in (m * sign for m, sign in zip(k.margins(pose)[:3], (1.0, -1.0, 1.0), strict=True)):
                short.append(20.0 * min(0.0, margin - _LEAST_SINE))
            reach = ((k.E, tilt, pose.G, k.rocker), (pose.H, k.link, pose.B, float(np.hypot(*k.J))))
            for p, rp, q, rq in reach:
                d = float(np.hypot(*(q - p)))
                short.append(0.04 * (max(0.0, d - rp - rq) + max(0.0, abs(rp - rq) - d)))
    return np.concatenate([_required(x), 0.1 * (x - _SKETCH) / _LOOSE, np.array(short)])


@functools.cache
def solve() -> Linkage:
    """The linkage that meets every published and example value exactly, near the sketch; the same on every
    call."""
    close = {"xtol": 1e-12, "ftol": 1e-12, "gtol": 1e-12}
    near = least_squares(_wished, _SKETCH, x_scale=_LOOSE, method="trf", max_nfev=400, **close).x
    exact = least_squares(_required, near, x_scale=_LOOSE, method="trf", xtol=1e-15, ftol=1e-15, gtol=1e-15).x
    return _linkage(np.round(exact, 9))


# ---- steering --------
@functools.cache
def solve_steering(p_x: float = -500.0, q_x: float = 520.0) -> Steering:
    """Pins at the given distances from the articulation, such that one cylinder is closed and the other open
    at full lock."""
    return steering_between(p_x, q_x, math.radians(v.STEER_ANGLE.value), v.STEER_CLOSED.value, v.STEER_STROKE.value)
