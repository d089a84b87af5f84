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
    tied = (soup.angle < _GAP) & wall[soup.pair[:, 0]] & wall[soup.pair[:, 1]]
    if int(tied.sum()) < _CORNERS - 1:
        return
    label = linked(soup.pair[tied], len(soup.corners))
    count = np.bincount(label)
    if int(count.max()) < _CORNERS:
        return
    size = np.bincount(label, weights=soup.areas)
    net: Floats = np.stack([np.bincount(label, weights=soup.areas * soup.normals[:, k]) for k in range(3)], axis=1)
    net = net - np.outer(net @ direction, direction)
    chosen = np.flatnonzero((count >= _CORNERS) & (np.linalg.norm(net, axis=1) < _ALL_ROUND * size))
    if not len(chosen):
        return
    members = _members(label)
    walls = [members(k) for k in chosen.tolist()]
    corners = soup.points[soup.corners[np.concatenate(walls)]] @ np.stack(across(direction)).T
    for rows, no_wall in zip(walls, _are_no_walls(corners, np.cumsum([0, *map(len, walls)])[:-1]), strict=True):
        if not no_wall:
            yield rows


def _members(label: Indices) -> Callable[[int], Indices]:
    """The rows that have a label, in order."""
    order = np.argsort(label, kind="stable")
    ends = np.cumsum(np.bincount(label))
    return lambda k: order[ends[k - 1] if k else 0 : ends[k]]


def _ring(soup: Soup, rows: Indices, direction: Floats) -> Ring | None:
    """The cylinder about a direction that a wall's corners are nearest to, if they are near to it."""
    points = soup.corners_of(rows)
    if len(points) < _CORNERS:
        return None
    basis = np.stack(across(direction))
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
    angles = np.arctan2(flat[:, 1] - center[1], flat[:, 0] - center[0])
    corners, gap = _directions(angles)
    if corners < _CORNERS or gap > _GAP:
        return None
    if gap > _FOLD and corners < _MANY:
        # What is angular has the same corners at both ends; a round wall that lost most of its corners has others.
        along = points @ direction
        upper = along > along.mean()
        if corners <= _TWISTED * max(_directions(angles[upper])[0], _directions(angles[~upper])[0]):
            return None
    stray = float(np.abs(np.linalg.norm(flat - center, axis=1) - radius).max())
    if stray > _STRAY * _height(found, float(widths(soup, found, rows).max())) + ROUGH * radius:
        return None
    return Ring(found, max(stray, _TOLD * _height(found, _wide(soup, found))))


def _directions(angles: Floats) -> tuple[int, float]:
    """How many directions there are among some angles, and the widest gap between them, radians."""
    ordered = np.sort(angles)
    gaps = np.append(np.diff(ordered), ordered[0] + math.tau - ordered[-1])
    return int((gaps > _APART).sum()), float(gaps.max())


def untold(soup: Soup, found: Round) -> float:
    """How far (metres) the radius of a round may be off on which the corners of its facets lie: by what facets as wide
    as its own cannot tell. 0 for narrow ones."""
    return max(0.0, _TOLD * _height(found, _wide(soup, found)) - ROUGH * found.radius)


def _wide(soup: Soup, found: Round) -> float:
    """The angle about its axis that a round's wider facets cover, radians."""
    return float(np.percentile(widths(soup, found, found.triangles), _WIDE))


def _height(found: Round, wide: float) -> float:
    """The height of the arc over the chord of a facet that covers so many radians of a round, metres."""
    return found.radius * (1.0 - math.cos(0.5 * min(wide, _FOLD)))


def _circle(points: Floats) -> tuple[Floats, float] | None:
    """Centre and radius of the circle that points (n, 2) are nearest to: the algebraic fit, then Gauss-Newton."""
    middle = points.mean(axis=0)
    moved = points - middle
    matrix = np.empty((len(moved), 3))
    matrix[:, :2], matrix[:, 2] = 2.0 * moved, 1.0
    solved, _, rank, _ = np.linalg.lstsq(matrix, (moved**2).sum(axis=1), rcond=1e-9)
    if rank < 3:
        return None
    center, radius = solved[:2], math.sqrt(max(0.0, float(solved[2] + solved[:2] @ solved[:2])))
    for _ in range(4):
        offset = moved - center
        distance = np.maximum(np.linalg.norm(offset, axis=1), 1e-12)
        matrix[:, :2] = offset / distance[:, None]
        step = np.linalg.lstsq(matrix, distance - radius, rcond=1e-9)[0]
        center, radius = center + step[:2], radius + float(step[2])
    return (middle + center, radius) if radius > 0.0 else None


def _are_no_walls(corners: Floats, starts: Indices) -> Flags:
    """(walls,) which pieces are too far from every circle to be walls, so that none need be fitted to them. `corners`
    (m, 3, 2): those of their triangles, seen along the direction, piece after piece from `starts` on.

    If corners stray by s from some circle of radius r, |d² - r²| <= s (2 r + s) for the distance d of each of them from
    its centre: this is no less than the root mean square of d² - r², and that no less than where it is least, which is
    a linear fit. As a wall's, s is no more than `_STRAY` of the height h of the arc over the widest facet, and a
    little. h is at most r (1 - cos(_FOLD / 2)); and as that facet's corners are no nearer to the centre than r - s, its
    longest side c is at least 2 (r - s) sin(w / 2) where it covers w, so that h = 2 r sin²(w / 4) is at most
    r (c / (r - s))² / 7.3. And r is bounded by the corners' extent along any direction, as the gaps between them are no
    wider than `_GAP`."""
    count = 3.0 * np.diff(np.append(starts, len(corners)))
    sides = corners - corners[:, (1, 2, 0)]
    chord = np.maximum.reduceat((sides * sides).sum(axis=2).max(axis=1), starts)
    low, high = np.minimum.reduceat(corners.min(axis=1), starts), np.maximum.reduceat(corners.max(axis=1), starts)
    most = _STRAY * (1.0 - math.cos(0.5 * _FOLD)) + ROUGH
    radius = (high - low).min(axis=1) / (2.0 * (1.0 - most) * math.cos(0.5 * _GAP))
    by_chord = _STRAY * chord / (7.3 * (1.0 - most) ** 2) + ROUGH * radius**2
    # The fit of d² - r² about the middle of the corners, where their sums are 0.
    middle = np.add.reduceat(corners.sum(axis=1), starts) / count[:, None]
    x, y = (corners - np.repeat(middle, np.diff(np.append(starts, len(corners))), axis=0)[:, None]).transpose(2, 0, 1)
    square = x * x + y * y
    sums = [x * x, x * y, y * y, square, square * square, x * square, y * square]
    xx, xy, yy, one, two, by_x, by_y = (np.add.reduceat(values.sum(axis=1), starts) for values in sums)
    with np.errstate(divide="ignore", invalid="ignore"):
        told = (by_x * by_x * yy - 2.0 * by_x * by_y * xy + by_y * by_y * xx) / (xx * yy - xy * xy)
        least = (two - one * one / count - told - 1e-6 * two) / count
    sure = xx * yy - xy * xy > 1e-6 * (xx + yy) ** 2
    return np.asarray(sure & ((1.001 * (2.0 + most) * np.minimum(most * radius**2, by_chord)) ** 2 < least))
