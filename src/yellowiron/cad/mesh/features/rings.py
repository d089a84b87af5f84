"""Round walls that are only nearly cylinders: what a converter's decimation, noise or coarse rounding has left of a
bore or a shaft.

Their facets are few, uneven and twisted, and their corners lie on no one cylinder, but they still go all the way round,
and what they stand on is still flat and square to their axis. How far they may stray from a cylinder is what their own
facets are too wide to tell: the height of the arc over a chord.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from yellowiron.cad.mesh.components import linked
from yellowiron.cad.mesh.features.roundness import Round, across, widths
from yellowiron.cad.mesh.features.soup import Flags, Indices, Soup
from yellowiron.cad.mesh.features.tolerances import ROUGH, SLIGHTEST
from yellowiron.model.geometry import Floats

_FOLD = math.radians(65.0)
"""Two facets of one wall meet at less than this angle: six to a circle, with a margin; walls and ends at more."""
_CORNERS = 7
"""A wall has corners in at least so many directions from its axis: what has six is a nut."""
_APART = math.radians(3.0)
"""Two directions, seen from the axis, are two if they are this far apart."""
_LEAN = 0.35
"""Sine of the most by which a facet of a wall leans from the axis: those of a thin plate's bore are twisted."""
_ALL_ROUND = 0.3
"""The normals of a wall that goes all the way round, added up, leave no more than this share of their areas."""
_GAP = math.radians(80.0)
"""The widest gap between the corners of a wall, seen from its axis …"""
_MANY = 9
"""… if it has corners in so many directions; with fewer, it is `_FOLD`."""
_TWISTED = 1.4
"""… or so many times as many as at either of its ends."""
_STRAY = 0.8
"""A wall's corners stray from its cylinder by no more than this share of the arc's height over its widest chords."""
_TOLD = 0.4
"""The share of that height by which a radius may be off: some programs move the corners that they leave outward."""
_WIDE = 75.0
"""The percentile of the facets' widths that counts as the widest: slivers are narrow, and a few are missing."""
_WAYS = 12
"""So many directions of flat faces are looked along, those of the largest area."""
_ALONG = math.cos(math.radians(1.0))
"""Flat faces that face the same way within this are one of them."""
_STOUT = 0.02
"""A flat face is looked along if faces like it make up this share of the mesh's area."""


@dataclass(frozen=True, eq=False)
class Ring:
    """A round that goes all the way, and how far (metres) its radius and its axis may be off."""

    round: Round
    error: float


def rings(soup: Soup, free: Flags, least: float) -> Iterator[Ring]:
    """The round walls among the `free` triangles, of a radius of at least `least` metres; `free` stays as it is."""
    bent = (soup.angle > SLIGHTEST) & (soup.angle < _FOLD) & free[soup.pair].all(axis=1)
    if int(bent.sum()) < _CORNERS:
        return
    left = free.copy()
    for direction in (*_ways(soup), *_patches(soup, left, bent)):
        for rows in _walls(soup, left, direction):
            ring = _ring(soup, rows, direction)
            if ring is not None and ring.round.radius > least:
                left[ring.round.triangles] = False
                yield ring


def _ways(soup: Soup) -> list[Floats]:
    """The directions in which most of the flat area faces, or the opposite."""
    total = float(soup.areas.sum())
    found: list[Floats] = []
    left = np.ones(len(soup.corners), dtype=bool)
    while left.any() and len(found) < _WAYS:
        # By facets: a wall's are many and small.
        best = int(np.argmax(np.where(left, np.bincount(soup.facets, weights=soup.areas)[soup.facets], 0.0)))
        same = left & (np.abs(soup.normals @ soup.normals[best]) > _ALONG)
        if float(soup.areas[same].sum()) < _STOUT * total:
            break
        found.append(soup.normals[best])
        left &= ~same
    return found


def _patches(soup: Soup, free: Flags, bent: Flags) -> Iterator[Floats]:
    """The direction that the normals of each smooth patch lie across: for walls without ends."""
    label = linked(soup.pair[bent], len(soup.corners))
    members = _members(label)
    for k in np.flatnonzero(np.bincount(label) > _CORNERS).tolist():
        rows = members(k)
        if not free[rows].all():
            continue
        normals = soup.normals[rows]
        values, vectors = np.linalg.eigh((normals * soup.areas[rows, None]).T @ normals)
        if values[0] < 0.2 * values[1]:
            yield vectors[:, 0]


def _walls(soup: Soup, free: Flags, direction: Floats) -> Iterator[Indices]:
    """The pieces of connected free triangles along a direction that face all ways across it, in the order of their
    first triangles."""
    wall = free & (np.abs(soup.normals @ direction) < _LEAN)
    tied = (soup.angle < _GAP) & wall[soup.pair].all(axis=1)
    label = linked(soup.pair[tied], len(soup.corners))
    count = np.bincount(label)
    size = np.bincount(label, weights=soup.areas)
    net: Floats = np.stack([np.bincount(label, weights=soup.areas * soup.normals[:, k]) for k in range(3)], axis=1)
    net = net - np.outer(net @ direction, direction)
    members = _members(label)
    for k in np.flatnonzero((count >= _CORNERS) & (np.linalg.norm(net, axis=1) < _ALL_ROUND * size)).tolist():
        yield members(k)


def _members(label: Indices) -> Callable[[int], Indices]:
    """The rows that have a label, in order."""
    order = np.argsort(label, kind="stable")
    ends = np.cumsum(np.bincount(label))
    return lambda k: order[ends[k - 1] if k else 0 : ends[k]]


def _ring(soup: Soup, rows: Indices, direction: Floats) -> Ring | None:
    """The cylinder about a direction that a wall's corners are nearest to, if they are near to it."""
    basis = np.stack(across(direction))
    points = soup.corners_of(rows)
    flat = points @ basis.T
    circle = _circle(flat)
    if circle is None:
        return None
    center, radius = circle
    foot = center @ basis + float((points @ direction).mean()) * direction
    outward = (soup.middles[rows] @ basis.T - center) @ basis
    facing = float(soup.areas[rows] @ np.sign(np.einsum("ij,ij->i", outward, soup.normals[rows])))
    found = Round(foot, direction, radius, facing < 0.0, rows)
    if abs(facing) < 0.9 * float(soup.areas[rows].sum()):
        return None
    angles, along = np.arctan2(flat[:, 1] - center[1], flat[:, 0] - center[0]), points @ direction
    corners, gap = _directions(angles)
    upper = along > along.mean()
    # What is angular has the same corners at both ends; a round wall that lost most of its corners has others.
    twisted = corners > _TWISTED * max(_directions(angles[upper])[0], _directions(angles[~upper])[0])
    if corners < _CORNERS or gap > (_GAP if corners >= _MANY or twisted else _FOLD):
        return None
    stray = float(np.abs(np.linalg.norm(flat - center, axis=1) - radius).max())
    if stray > _STRAY * _height(soup, found, 100.0) + ROUGH * radius:
        return None
    return Ring(found, max(stray, _TOLD * _height(soup, found)))


def _directions(angles: Floats) -> tuple[int, float]:
    """How many directions there are among some angles, and the widest gap between them, radians."""
    ordered = np.sort(angles)
    gaps = np.append(np.diff(ordered), ordered[0] + math.tau - ordered[-1])
    return int((gaps > _APART).sum()), float(gaps.max())


def untold(soup: Soup, found: Round) -> float:
    """How far (metres) the radius of a round may be off on which the corners of its facets lie: by what facets as wide
    as its own cannot tell. 0 for narrow ones."""
    return max(0.0, _TOLD * _height(soup, found) - ROUGH * found.radius)


def _height(soup: Soup, found: Round, percentile: float = _WIDE) -> float:
    """The height of the arcs over the chords of a round's wider facets, metres."""
    wide = min(float(np.percentile(widths(soup, found, found.triangles), percentile)), _FOLD)
    return found.radius * (1.0 - math.cos(0.5 * wide))


def _circle(points: Floats) -> tuple[Floats, float] | None:
    """Centre and radius of the circle that points (n, 2) are nearest to: the algebraic fit, then Gauss-Newton."""
    middle = points.mean(axis=0)
    moved = points - middle
    matrix = np.column_stack([2.0 * moved, np.ones(len(moved))])
    solved, _, rank, _ = np.linalg.lstsq(matrix, (moved**2).sum(axis=1), rcond=1e-9)
    if rank < 3:
        return None
    center, radius = solved[:2], math.sqrt(max(0.0, float(solved[2] + solved[:2] @ solved[:2])))
    for _ in range(4):
        offset = moved - center
        distance = np.maximum(np.linalg.norm(offset, axis=1), 1e-12)
        step = np.linalg.lstsq(np.column_stack([offset / distance[:, None], np.ones(len(moved))]), distance - radius,
                               rcond=1e-9)[0]  # fmt: skip
        center, radius = center + step[:2], radius + float(step[2])
    return (middle + center, radius) if radius > 0.0 else None
