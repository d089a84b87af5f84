"""Vectors (3,) in any one frame: as tuples, their angles and distances; what surfaces are wound around."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Triple = tuple[float, float, float]

_SHORT = 1e-9
"""Metres: points that are nearer are one."""
_PATCH = 64
"""Triangles that are taken for one patch by points far from it: farther than …"""
_FAR = 3.0
"""… so many of its radii, where what is left out is below a hundredth of a winding number."""
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


@dataclass(frozen=True, eq=False)
class Wound:
    """Triangles (n, 3, 3) for many questions what they are wound around: from afar a patch of them is its middle and
    its area vector (a dipole; Barill et al. 2018). `first` (patches + 1,) says where each begins; `middles` and `areas`
    (patches, 3); `radii` (patches,)."""

    triangles: Floats
    first: NDArray[np.int64]
    middles: Floats
    areas: Floats
    radii: Floats

    @staticmethod
    def of(triangles: Floats) -> Wound:
        """Patches of neighbouring triangles."""
        centers = triangles.mean(axis=1)
        rows = np.concatenate([np.zeros(0, dtype=np.int64), *_halved(centers, np.arange(len(centers)))])
        first = np.append(np.arange(0, len(rows), _PATCH), len(rows))
        sorted_ = triangles[rows]
        normals = 0.5 * np.cross(sorted_[:, 1] - sorted_[:, 0], sorted_[:, 2] - sorted_[:, 0])
        weights = np.linalg.norm(normals, axis=1) + 1e-300
        patches = [slice(a, b) for a, b in zip(first[:-1].tolist(), first[1:].tolist(), strict=True)]
        middles = [np.average(sorted_[p].mean(axis=1), axis=0, weights=weights[p]) for p in patches]
        radii = [
            np.sqrt(((sorted_[p] - middle) ** 2).sum(axis=2).max()) for p, middle in zip(patches, middles, strict=True)
        ]
        areas = [normals[p].sum(axis=0) for p in patches]
        shape = (len(patches), 3)
        return Wound(
            sorted_, first, np.reshape(middles, shape), np.reshape(areas, shape), np.asarray(radii, dtype=np.float64)
        )

    def around(self, points: Floats) -> Floats:
        """How often they are wound around points (n, 3): (n,), as `winding` says, to about a hundredth."""
        way = self.middles - points[:, None]
        distance = np.linalg.norm(way, axis=2)
        near = distance < _FAR * self.radii
        dipole = np.einsum("npk,pk->np", way, self.areas) / np.maximum(distance, 1e-300) ** 3
        total = np.where(near, 0.0, dipole).sum(axis=1) / (4.0 * math.pi)
        for row, patches in enumerate(near):
            own = [self.triangles[self.first[p] : self.first[p + 1]] for p in np.flatnonzero(patches).tolist()]
            if own:
                total[row] += winding(points[row : row + 1], np.concatenate(own))[0]
        return np.asarray(total)


def _halved(centers: Floats, rows: NDArray[np.int64]) -> list[NDArray[np.int64]]:
    """Rows in patches of neighbours, of `_PATCH` each but the last: halved across the widest way, again and again."""
    if len(rows) <= _PATCH:
        return [rows]
    own = centers[rows]
    order = np.argsort(own[:, int(np.argmax(np.ptp(own, axis=0)))], kind="stable")
    half = _PATCH * ((len(rows) // _PATCH + 1) // 2)
    return _halved(centers, rows[order[:half]]) + _halved(centers, rows[order[half:]])
