"""Vectors (3,) in any one frame: as tuples, their angles and distances; what surfaces are wound around."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Triple = tuple[float, float, float]

_SHORT = 1e-9
"""Metres: points that are nearer are one."""
_FLAT = 1e-3
"""Three points of a circle are this far (share of their distance) from one line."""


def triple(values: Any) -> Triple:
    """Three numbers, in an array or any other sequence, as a tuple of plain floats."""
    x, y, z = (float(v) for v in values)
    return (x, y, z)


def clean_triple(values: Any) -> Triple:
    """As `triple`, 0.0 for -0.0: what is written reads the same whatever sign a rounding left."""
    x, y, z = (float(v) + 0.0 for v in values)
    return (x, y, z)


def unit(vector: Floats) -> Floats:
    """A vector (3,) at length 1."""
    return np.asarray(vector / np.linalg.norm(vector), dtype=np.float64)


def angle_between(a: Floats | Sequence[float], b: Floats | Sequence[float]) -> float:
    """The angle between two directions, rad, 0 … π. Exact for small angles, where an arc cosine is not."""
    return math.atan2(float(np.linalg.norm(np.cross(a, b))), float(np.dot(a, b)))


def angle_between_lines(a: Floats | Sequence[float], b: Floats | Sequence[float]) -> float:
    """The angle between two lines whichever way they point, rad, 0 … π/2."""
    return math.atan2(float(np.linalg.norm(np.cross(a, b))), abs(float(np.dot(a, b))))


def distance_from_line(point: Floats, origin: Floats, direction: Floats) -> float:
    """How far a point (3,) is from a line through `origin` along a unit `direction`; the points' unit."""
    delta = point - origin
    return float(np.linalg.norm(delta - (delta @ direction) * direction))


def line_through(points: Floats) -> tuple[Floats, Floats] | None:
    """The line through two points (2, 3), metres, or about the circle through three (3, 3): their middle (3,) and a
    unit vector (3,). None where two are one, or three nearly on one line."""
    u = points[1] - points[0]
    if len(points) == 2:
        return (points.mean(axis=0), unit(u)) if np.linalg.norm(u) >= _SHORT else None
    v = points[2] - points[0]
    normal = np.cross(u, v)
    if np.linalg.norm(normal) <= _FLAT * np.linalg.norm(u) * np.linalg.norm(v):
        return None
    # The middle of the circle through three corners of a triangle.
    return points[0] + np.cross(u @ u * v - v @ v * u, normal) / (2.0 * normal @ normal), unit(normal)


def winding(points: Floats, triangles: Floats) -> Floats:
    """How often triangles (m, 3, 3) are wound around points (n, 3), in one frame: (n,), ±1 inside of a closed surface,
    0 outside, and between them where it is open (van Oosterom and Strackee 1983; Jacobson et al. 2013)."""
    a, b, c = (triangles[None, :, corner] - points[:, None] for corner in range(3))
    la, lb, lc = (np.linalg.norm(each, axis=2) for each in (a, b, c))
    volume = np.einsum("nmk,nmk->nm", a, np.cross(b, c))
    over = la * lb * lc
    over = over + np.einsum("nmk,nmk->nm", a, b) * lc
    over = over + np.einsum("nmk,nmk->nm", b, c) * la
    over = over + np.einsum("nmk,nmk->nm", c, a) * lb
    return np.asarray(np.arctan2(volume, over).sum(axis=1) / (2.0 * np.pi))
