"""A loader's planar linkage: arms, and a bucket that a tilt cylinder moves by a rocker on the arms and a link (Z-bar).

In millimetres and in the plane y = 0: x forward, z up from the ground. Angles are radians, counter-clockwise seen from
the machine's right side turned so that x points right and z up (a raised boom is positive). Bucket angle: 0 = floor
plane level, positive = rolled back.

Pins: A boom on the frame, B bucket on the boom, C and D lift cylinder (frame, boom), E tilt cylinder on the frame, F
tilt rod on the rocker, G rocker on the boom, H link on the rocker, J link on the bucket. T is the cutting edge (tooth
points).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from .planar import Point, direction, meet, rot, sine, vec


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
        return self.pose_at(self.boom_angle(lift), lift, tilt)

    def pose_at(self, beta: float, lift: float, tilt: float) -> Pose:
        """All pins at an angle of A -> B and a tilt cylinder length."""
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

    def tilt_for_angle(self, lift: float, angle: float, tilts: tuple[float, float]) -> float:
        """Tilt cylinder length, of `tilts`, that puts the bucket at `angle` (radians)."""
        return float(brentq(lambda t: self.pose(lift, t).bucket_angle - angle, *tilts, xtol=1e-10))

    def margins(self, pose: Pose) -> tuple[float, float, float, float]:
        """Sines at F (rod on rocker), H, J (link on bucket) and D (lift rod on boom): none may come near
        0."""
        return (
            sine(self.E, pose.F, pose.G),
            sine(pose.G, pose.H, pose.J),
            sine(pose.H, pose.J, pose.B),
            sine(self.A, pose.D, self.C),
        )
