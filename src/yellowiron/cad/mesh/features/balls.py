"""Balls and sockets on triangles: patches that are bent alike in every direction. A corner of a mesh lies on the
surface that it was made from, so the sphere is fitted to the corners."""

from __future__ import annotations

import math

import numpy as np

from yellowiron.cad.mesh.components import linked
from yellowiron.cad.mesh.features.soup import Indices, Soup
from yellowiron.model.geometry import Floats, SphereFeature

_FOLD = math.radians(40.0)
"""Triangles on one ball are no more bent against each other than this, radians."""
_FLAT = 0.06
"""A flat facet with a larger share of a mesh's area is none of a ball's."""
_LEAST = 24
"""Triangles of a patch that is looked at."""
_OFF, _ASKEW = 0.01, math.cos(math.radians(25.0))
"""Shares of the radius by which a ball's corners are off at most, and the cosine between a triangle's normal and the
line to the centre."""
_COVERED = 0.12
"""Least share of a whole sphere that a patch covers."""
_ALL_WAYS = 0.02
"""Least share of its triangles' normals along any direction: of a band or a cylinder there are none along the axis."""
_ROUNDS = 6


def balls(soup: Soup) -> tuple[SphereFeature, ...]:
    """The balls and sockets of a mesh, in the order of their first triangles."""
    area = np.bincount(soup.facets, weights=soup.areas)
    wide = area[soup.facets] > _FLAT * float(soup.areas.sum())
    near = (soup.angle < _FOLD) & ~wide[soup.pair].any(axis=1)
    label = linked(soup.pair[near], len(soup.corners))
    sizes = np.bincount(label)
    found = []
    for number in np.flatnonzero(sizes >= _LEAST).tolist():
        rows = np.flatnonzero((label == number) & ~wide)
        ball = _fitted(soup, rows) if len(rows) >= _LEAST else None
        if ball is not None:
            found.append(ball)
    return tuple(found)


def _fitted(soup: Soup, rows: Indices) -> SphereFeature | None:
    """The sphere of a patch, what is not on it (a neck) left out; None where there is none."""
    for _ in range(_ROUNDS):
        center, radius = _sphere(soup.points[soup.corners[rows]].reshape(-1, 3))
        if not 0.0 < radius < soup.size:
            return None
        off = np.abs(np.linalg.norm(soup.points[soup.corners[rows]] - center, axis=2) - radius).max(axis=1)
        outwards = soup.middles[rows] - center
        outwards /= np.maximum(np.linalg.norm(outwards, axis=1, keepdims=True), 1e-12)
        facing = np.einsum("ij,ij->i", outwards, soup.normals[rows])
        inner = float(facing @ soup.areas[rows]) < 0.0
        on = (off < _OFF * radius) & ((-facing if inner else facing) > _ASKEW)
        if on.all():
            return _judged(soup, rows, center, radius, inner=inner)
        # Far from it at first: the nearer half stays.
        kept = rows[on] if on.sum() >= _LEAST else rows[off <= np.median(off)]
        if len(kept) < _LEAST or len(kept) == len(rows):
            return None
        rows = kept
    return None


def _judged(soup: Soup, rows: Indices, center: Floats, radius: float, *, inner: bool) -> SphereFeature | None:
    area = float(soup.areas[rows].sum())
    weights = soup.areas[rows] / area
    spread = np.linalg.eigvalsh((soup.normals[rows] * weights[:, None]).T @ soup.normals[rows])
    if area < _COVERED * 4.0 * math.pi * radius**2 or float(spread[0]) < _ALL_WAYS:
        return None
    x, y, z = (float(c) for c in center)
    return SphereFeature((x, y, z), radius, inner, area)


def _sphere(points: Floats) -> tuple[Floats, float]:
    """Centre and radius of the sphere through points (least squares); radius 0 where they lie in a plane."""
    middle = points.mean(axis=0)
    local = points - middle
    rows = np.c_[2.0 * local, np.ones(len(local))]
    found, _, rank, _ = np.linalg.lstsq(rows, np.sum(local**2, axis=1), rcond=None)
    square = float(found[3] + found[:3] @ found[:3])
    return middle + found[:3], math.sqrt(square) if rank == 4 and square > 0.0 else 0.0
