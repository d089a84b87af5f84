"""The steering of machines that bend in the middle: two cylinders beside the upright hinge, one of which pushes as the
other pulls. Millimetres, radians."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, least_squares

from .planar import Point, rot, vec


@dataclass(frozen=True, slots=True)
class Steering:
    """Left steering cylinder seen from above (x forward, y left, the hinge at the origin): P on one frame, Q on the
    other, both in the straight machine; the right one is its mirror image. With P on the rear frame angles to the left
    are positive, with P on the front frame angles to the right."""

    P: Point
    Q: Point

    def length(self, angle: float) -> float:
        """Length of the left cylinder at a steering angle (radians)."""
        return float(np.hypot(*(rot(angle, self.Q) - self.P)))

    def lever(self, angle: float) -> float:
        """Lever arm of the left cylinder about the articulation axis, millimetres."""
        q = rot(angle, self.Q)
        return float(abs(self.P[0] * q[1] - self.P[1] * q[0]) / np.hypot(*(q - self.P)))

    def lock(self, closed: float, stroke: float) -> float:
        """The angle at which the first of the two cylinders has come to an end, radians."""

        def at(length: float) -> float:
            return float(brentq(lambda angle: self.length(angle) - length, -0.9, 0.9, xtol=1e-12))

        return min(abs(at(closed)), abs(at(closed + stroke)))


def steering_between(p_x: float, q_x: float, lock: float, closed: float, stroke: float) -> Steering:
    """Pins at the given distances from the articulation, such that one cylinder is closed and the other open at full
    lock (radians)."""
    inwards = lock if p_x < 0.0 else -lock

    def residual(y: Point) -> Point:
        s = Steering(vec(p_x, y[0]), vec(q_x, y[1]))
        return np.array([s.length(inwards) - closed, s.length(-inwards) - closed - stroke])

    y = least_squares(residual, [300.0, 350.0], xtol=1e-15, ftol=1e-15, gtol=1e-15).x
    return Steering(vec(p_x, y[0]), vec(q_x, y[1]))
