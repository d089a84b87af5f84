"""The wheel loader's planar linkage: solved so that the machine meets its published values, and measured
again.

Frame: the machine's, in millimetres and in the plane y = 0: x forward from the articulation axis, z up from
the ground. Angles are radians, counter-clockwise seen from the machine's right side turned so that x points
right and z up (a raised boom is positive). Bucket angle: 0 = floor plane level, positive = rolled back.

Pins: A boom on the front frame, B bucket on the boom, C and D lift cylinder (frame, boom), E tilt cylinder on
the frame, F tilt rod on the rocker, G rocker on the boom, H link on the rocker, J link on the bucket. T is
the cutting edge (tooth points).
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, least_squares

from drawing.articulation import Steering, steering_between
from drawing.planar import Point, direction, meet, rot, sine, vec

from . import values as v

FRONT_AXLE_X = v.WHEELBASE.value / 2
"""Articulation in the middle of the wheelbase, as on the real machine."""
TYRE_RADIUS = v.TYRE_DIAMETER.value / 2
EDGE_DEPTH = 290.0
"""Hinge pin above the floor's underside, bucket level."""


@dataclass(frozen=True, slots=True)
class Pose:
    """Where the pins are at one lift length and one tilt length; world points, millimetres, radians."""

    lift: float
    tilt: float
    boom_angle: float
    rocker_angle: float
    bucket_angle: float
    B: Point
    D: Point
    F: Point
    G: Point
    H: Point
    J: Point
    T: Point


@dataclass(frozen=True, slots=True)
class Linkage:
    """Pin positions. A, C, E are world; D, G are in the boom's frame (origin A, x towards B); H in the
    rocker's (origin G, x towards F); J and T in the level bucket's (origin B)."""

    A: Point
    C: Point
    E: Point
    boom: float
    D: Point
    G: Point
    rocker: float
    H: Point
    link: float
    J: Point
    T: Point

    def boom_angle(self, lift: float) -> float:
        """Angle of A -> B at a lift cylinder length."""
        p, q = float(np.hypot(*(self.C - self.A))), float(np.hypot(*self.D))
        opening = math.acos((p * p + q * q - lift * lift) / (2 * p * q))
        return direction(self.C - self.A) + opening - direction(self.D)

    def lift_at(self, boom_angle: float) -> float:
        """Lift cylinder length at an angle of A -> B."""
        return float(np.hypot(*(self.A + rot(boom_angle, self.D) - self.C)))

    def pose(self, lift: float, tilt: float) -> Pose:
        """All pins at one pair of cylinder lengths."""
        return self._pose(self.boom_angle(lift), lift, tilt)

    def _pose(self, beta: float, lift: float, tilt: float) -> Pose:
        b = self.A + rot(beta, vec(self.boom, 0.0))
        g = self.A + rot(beta, self.G)
        f = meet(self.E, tilt, g, self.rocker, 1.0)
        rocker = direction(f - g)
        h = g + rot(rocker, self.H)
        j = meet(h, self.link, b, float(np.hypot(*self.J)), 1.0)
        bucket = (direction(j - b) - direction(self.J) + math.pi) % (2 * math.pi) - math.pi
        return Pose(
            lift,
            tilt,
            beta,
            rocker,
            bucket,
            b,
            self.A + rot(beta, self.D),
            f,
            g,
            h,
            j,
            b + rot(bucket, self.T),
        )

    def lift_for_hinge(self, height: float) -> float:
        """Lift cylinder length at which the bucket hinge pin is at `height`."""
        return self.lift_at(math.asin((height - self.A[1]) / self.boom))

    def tilt_for_angle(self, lift: float, angle: float) -> float:
        """Tilt cylinder length that puts the bucket at `angle` (radians)."""
        lo, hi = v.TILT_CLOSED.value, v.TILT_CLOSED.value + v.TILT_STROKE.value
        return float(brentq(lambda t: self.pose(lift, t).bucket_angle - angle, lo, hi, xtol=1e-10))

    def breakout(self) -> float:
        """Upward force, kN, 100 mm behind the edge of the level bucket on the ground, tilt cylinder at relief pressure
        (ISO 14397-2), by virtual work; weights left out."""
        lift = self.lift_for_hinge(EDGE_DEPTH)
        level, step = self.tilt_for_angle(lift, 0.0), 1e-3

        def height(tilt: float) -> float:
            pose = self.pose(lift, tilt)
            return float((pose.B + rot(pose.bucket_angle, self.T - vec(100.0, 0.0)))[1])

        rise = (height(level + step) - height(level - step)) / (2 * step)
        return v.WORK_PRESSURE.value * math.pi / 4 * v.TILT_BORE.value**2 / 1000 / rise

    def margins(self, pose: Pose) -> tuple[float, float, float, float]:
        """Sines at F (rod on rocker), H, J (link on bucket) and D (lift rod on boom): none may come near
        0."""
        return (
            sine(self.E, pose.F, pose.G),
            sine(pose.G, pose.H, pose.J),
            sine(pose.H, pose.J, pose.B),
            sine(self.A, pose.D, self.C),
        )


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
        (k._pose(ground, 0.0, TILT_MAX).bucket_angle, v.RACK_BACK_GROUND.value),
        (k._pose(top, 0.0, TILT_MAX).bucket_angle, v.RACK_BACK_MAX.value),
        (k._pose(top, 0.0, TILT_MIN).bucket_angle, -v.DUMP_ANGLE_MAX.value),
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
            pose = k._pose(float(beta), 0.0, float(tilt))
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
