"""Where a mesh may be round: guesses at cylinders, from the folds between its triangles and from its normals.

A fold between two strips of a cylinder runs along its axis, and the three lines that bound the strips lie on a circle.
Where slivers hide the strips (a rod that ends in an eye), the normals of the whole patch still lie on a great circle.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator

import numpy as np

from yellowiron.cad.mesh.components import linked
from yellowiron.cad.mesh.features.roundness import Round, across
from yellowiron.cad.mesh.features.soup import Flags, Indices, Soup, beside
from yellowiron.cad.mesh.features.tolerances import FEWEST, ROUGH, WIDEST
from yellowiron.cad.mesh.measures import cross
from yellowiron.model.geometry import Floats

_ALIKE = 0.15
"""Two folds tell of one cylinder if their radii and axes differ by less than this share of the radius …"""
_ALIGNED = math.cos(math.radians(3.0))
"""… and their directions by less than this."""
_TRIES = 48
_AT_ONCE = 4000
"""So many triangles are held against circles in one step, but for a patch of more."""
_ONE_WAY = math.cos(0.05)
"""Normals that are all this near to one of them are not spread out at all."""
_NONE = np.zeros(0, dtype=np.int64)


def by_folds(soup: Soup) -> Iterator[tuple[Round, Indices]]:
    """Guesses with the triangles that they rest on, those on most folds first."""
    chosen = np.flatnonzero(soup.bent)
    if not len(chosen):
        return
    point, direction, radius, good = _circles(soup, chosen)
    chosen, point, direction, radius = chosen[good], point[good], direction[good], radius[good]
    inner = soup.concave[chosen]
    pairs = soup.beside if good.all() else beside(soup, chosen)
    if not len(pairs):
        return
    a, b = pairs[:, 0], pairs[:, 1]
    apart = point[b] - point[a]
    apart = np.linalg.norm(apart - np.einsum("ij,ij->i", apart, direction[a])[:, None] * direction[a], axis=1)
    alike = (
        (inner[a] == inner[b])
        & (np.abs(np.einsum("ij,ij->i", direction[a], direction[b])) > _ALIGNED)
        & (np.abs(radius[a] - radius[b]) < _ALIKE * np.minimum(radius[a], radius[b]))
        & (apart < _ALIKE * np.minimum(radius[a], radius[b]))
    )
    label = linked(pairs[alike], len(chosen))
    members = np.bincount(label)
    order = np.argsort(label, kind="stable")
    starts = np.concatenate([[0], np.cumsum(members)])
    for k in sorted(np.flatnonzero(members >= 2).tolist(), key=lambda k: (-members[k], k)):
        rows = order[starts[k] : starts[k + 1]]
        ends = soup.points[soup.edges[chosen[rows]]]
        weight = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) * np.minimum(soup.angle[chosen[rows]], 0.3)
        # From fold to fold a chain may turn, as a bent pipe does: what is in line with the surest fold goes first.
        while len(rows) >= 2:
            best = int(rows[int(np.argmax(weight))])
            apart = point[rows] - point[best]
            apart = np.linalg.norm(apart - np.outer(apart @ direction[best], direction[best]), axis=1)
            mine = (np.abs(direction[rows] @ direction[best]) > _ALIGNED) & (apart < 2.0 * _ALIKE * radius[best])
            guess = Round(point[best], direction[best], float(radius[best]), bool(inner[best]), _NONE)
            if int(mine.sum()) >= 2:
                yield guess, np.unique(soup.pair[chosen[rows[mine]]])
            mine[rows == best] = True
            rows, weight = rows[~mine], weight[~mine]


def _circles(soup: Soup, chosen: Indices) -> tuple[Floats, Floats, Floats, Flags]:
    """Axis point, direction and radius of the circle that each fold makes with the corners opposite to it."""
    start = soup.points[soup.edges[chosen, 0]]
    direction = soup.points[soup.edges[chosen, 1]] - start
    direction /= np.linalg.norm(direction, axis=1)[:, None]

    def flattened(points: Floats) -> Floats:
        offset = points - start
        return np.asarray(offset - np.einsum("ij,ij->i", offset, direction)[:, None] * direction)

    one, other = flattened(soup.points[soup.opposite[chosen, 0]]), flattened(soup.points[soup.opposite[chosen, 1]])
    # The circle through the origin, `one` and `other`: its centre c has 2 c·p = p·p for both.
    aa, bb = np.einsum("ij,ij->i", one, one), np.einsum("ij,ij->i", other, other)
    ab = np.einsum("ij,ij->i", one, other)
    det = aa * bb - ab * ab
    good = det > 1e-12 * aa * bb
    safe = np.where(good, det, 1.0)
    s, t = 0.5 * bb * (aa - ab) / safe, 0.5 * aa * (bb - ab) / safe
    center = s[:, None] * one + t[:, None] * other
    radius = np.linalg.norm(center, axis=1)
    good &= (radius > soup.resolution) & (radius < soup.size)
    # A strip is no wider than its neighbour by much more than the ends of a patch are narrower.
    return start + center, direction, radius, good


def by_normals(soup: Soup, free: Flags) -> Iterator[tuple[Round, Indices]]:
    """Guesses for the smooth patches of free triangles, the largest patch first; one guess a patch and side."""
    smooth = (soup.angle < WIDEST) & free[soup.pair].all(axis=1)
    label = linked(soup.pair[smooth], len(soup.corners))
    members = np.bincount(label)
    order = np.argsort(label, kind="stable")
    starts = np.concatenate([[0], np.cumsum(members)])
    patches = [order[starts[k] : starts[k + 1]] for k in np.flatnonzero(members >= 6)]
    for patch in sorted(patches, key=lambda rows: (-float(soup.areas[rows].sum()), int(rows[0]))):
        yield from _guesses(soup, patch)


def _guesses(soup: Soup, patch: Indices) -> Iterator[tuple[Round, Indices]]:
    direction = _great_circle(soup, patch)
    if direction is None:
        return
    rows = patch[np.abs(soup.normals[patch] @ direction) < 0.12]
    if len(rows) < 6:
        return
    basis = np.stack(across(direction))
    points, normals = soup.points[soup.corners[rows]] @ basis.T, soup.normals[rows] @ basis.T
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    middles = points.mean(axis=1)
    areas = soup.areas[rows]
    tried: list[tuple[Floats, float]] = []
    for i, j in _picks(len(rows)).tolist():
        turn = normals[i] - normals[j]
        square = float(turn @ turn)
        if square < 0.02:
            continue
        radius = float((middles[i] - middles[j]) @ turn) / square
        if soup.resolution < abs(radius) < soup.size:
            tried.append((0.5 * (middles[i] - radius * normals[i] + middles[j] - radius * normals[j]), radius))
    best: tuple[float, Floats, float] | None = None
    at_once = max(1, _AT_ONCE // len(rows))
    for start in range(0, len(tried), at_once):
        some = tried[start : start + at_once]
        off = _off(points, np.array([center for center, _ in some]), np.abs([radius for _, radius in some]))
        near = off < 0.06 * np.abs([radius for _, radius in some])[:, None]
        for (center, radius), on in zip(some, near, strict=True):
            score = float(areas[on].sum())
            if best is None or score > best[0] * (1.0 + 1e-9):
                best = (score, center, radius)
    if best is None or best[0] <= 0.0:
        return
    _, center, radius = best
    off = np.abs(np.linalg.norm(points - center, axis=2) - abs(radius)).max(axis=1)
    seeds = rows[off < max(0.06, ROUGH) * abs(radius)]
    if len(seeds) >= FEWEST:
        foot = center @ basis + float(soup.middles[seeds].mean(axis=0) @ direction) * direction
        yield Round(foot, direction, abs(radius), radius < 0.0, _NONE), seeds


def _off(points: Floats, centers: Floats, radii: Floats) -> Floats:
    """(k, n) by how much the corners of n triangles (n, 3, 2) are off k circles at most."""
    offset = points - centers[:, None, None]
    offset *= offset
    off = np.abs(np.sqrt(offset[..., 0] + offset[..., 1]) - radii[:, None, None])
    return np.asarray(np.maximum(np.maximum(off[..., 0], off[..., 1]), off[..., 2]))


def _great_circle(soup: Soup, patch: Indices) -> Floats | None:
    """The direction that most of a patch's normals lie across; None where they lie in all directions or in one."""
    normals, areas = soup.normals[patch], soup.areas[patch]
    if (normals @ normals[0] > _ONE_WAY).all():
        return None
    best: tuple[float, Floats] | None = None
    picks = _picks(len(patch))
    axes = cross(normals[picks[:, 0]], normals[picks[:, 1]])
    length = np.linalg.norm(axes, axis=1)
    axes = axes[length > 0.1] / length[length > 0.1, None]
    for axis in axes:
        score = float(areas[np.abs(normals @ axis) < 0.06].sum())
        if best is None or score > best[0] * (1.0 + 1e-9):
            best = (score, axis)
    if best is None or best[0] < 0.4 * float(areas.sum()):
        return None
    axis = best[1]
    for _ in range(2):
        rows = np.abs(normals @ axis) < 0.08
        spread = (normals[rows] * areas[rows, None]).T @ normals[rows]
        axis = np.linalg.eigh(spread)[1][:, 0]
    return np.asarray(axis)


@functools.cache
def _picks(count: int) -> Indices:
    """(k, 2) pairs of rows, spread over all of them; always the same ones."""
    k = np.arange(_TRIES)
    i = (k * 7919) % count
    j = (i + 1 + (k * 104729) % max(1, count - 1)) % count
    return np.stack([i, j], axis=1)[i != j]
