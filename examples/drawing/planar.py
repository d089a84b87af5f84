"""Plane geometry of linkages: x to the right, z up, angles in radians and counter-clockwise."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Point = NDArray[np.float64]


def vec(x: float, z: float) -> Point:
    """A point."""
    return np.array([x, z], dtype=np.float64)


def rot(angle: float, p: Point) -> Point:
    """`p` turned by `angle` (radians, counter-clockwise) about the origin."""
    c, s = math.cos(angle), math.sin(angle)
    return vec(c * p[0] - s * p[1], s * p[0] + c * p[1])


def direction(p: Point) -> float:
    """Angle of `p` from the x axis, radians."""
    return math.atan2(p[1], p[0])


def meet(p: Point, rp: float, q: Point, rq: float, side: float) -> Point:
    """Point at `rp` from `p` and `rq` from `q`, left (+1) or right (-1) of p -> q; nearest to both when the
    circles miss."""
    d = float(np.hypot(*(q - p)))
    along = (d * d + rp * rp - rq * rq) / (2 * d)
    square = rp * rp - along * along
    across = math.sqrt(max(0.0, square))
    u = (q - p) / d
    return p + along * u + side * across * vec(-u[1], u[0])


def sine(p: Point, corner: Point, q: Point) -> float:
    """Signed sine of the angle p-corner-q; 0 at a dead point."""
    a, b = p - corner, q - corner
    return float((a[0] * b[1] - a[1] * b[0]) / (np.hypot(*a) * np.hypot(*b)))
