"""What is round, but no cylinder: ovals, which a model's scale has made of cylinders (other factors along its axes, as
where a machine of one size was stretched into one of another), and knuckles, bosses that are rounded by eye. Their axis
is still where they turn."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from yellowiron.cad.mesh.components import linked
from yellowiron.cad.mesh.features.roundness import Round, across
from yellowiron.cad.mesh.features.soup import Flags, Indices, Soup, beside
from yellowiron.cad.mesh.features.tolerances import ROUGH, WIDEST
from yellowiron.model.geometry import Floats

_IN_LINE = math.cos(math.radians(0.5))
"""Folds of one oval run in one direction within this."""
_FEWEST_FOLDS = 10
"""An oval has at least this many folds: five numbers are fitted to them."""
_NARROWEST = 0.5
"""The least ratio of an oval's axes."""
_AROUND = 0.9 * math.pi
"""Radians around it that its folds cover at least."""
_BY_EYE = 0.15
"""A knuckle's outline strays from a circle by no more than this share of its radius, root mean square."""
_TRIED, _AT_ONCE = 4096, 2**22
"""Directions tried for a knuckle's, and pairs of them compared at once."""
_NONE = np.zeros(0, dtype=np.int64)


@dataclass(frozen=True, eq=False)
class Oval:
    """A round whose radius is the mean of the two of an ellipse, how far around it goes, radians, and the ratio of the
    smaller to the larger radius."""

    round: Round
    arc: float
    ratio: float = 1.0


def ovals(soup: Soup, free: Flags, roundest: float = 1.0) -> Iterator[Oval]:
    """The ovals among the free triangles, those with most folds first; without most of those whose radii have a larger
    ratio than `roundest`."""
    chosen = np.flatnonzero(soup.bent & free[soup.pair].all(axis=1))
    if len(chosen) < _FEWEST_FOLDS:
        return
    ends = soup.points[soup.edges[chosen]]
    direction = ends[:, 1] - ends[:, 0]
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    pairs = soup.beside if len(chosen) == int(soup.bent.sum()) else beside(soup, chosen)
    if not len(pairs):
        return
    a, b = pairs[:, 0], pairs[:, 1]
    alike = np.abs(np.einsum("ij,ij->i", direction[a], direction[b])) > _IN_LINE
    alike &= soup.concave[chosen[a]] == soup.concave[chosen[b]]
    label = linked(pairs[alike], len(chosen))
    members = np.bincount(label)
    for k in sorted(np.flatnonzero(members >= _FEWEST_FOLDS).tolist(), key=lambda k: (-members[k], k)):
        rows = chosen[label == k]
        found = _oval(soup, rows, direction[label == k], roundest)
        if found is not None and free[found.round.triangles].all():
            yield found


def _oval(soup: Soup, folds: Indices, directions: Floats, roundest: float) -> Oval | None:
    """The oval that most of some folds lie on, in line with each other."""
    signed = directions * np.where(directions @ directions[0] < 0.0, -1.0, 1.0)[:, None]
    axis = signed.mean(axis=0)
    axis /= float(np.linalg.norm(axis))
    basis = np.stack(across(axis))
    flat = soup.points[soup.edges[folds]].mean(axis=1) @ basis.T
    away = np.linalg.norm(flat - flat.mean(axis=0), axis=1)
    if float(np.ptp(away)) < 0.2 * (1.0 - roundest) * float(away.max()):
        return None
    kept = np.arange(len(folds))
    while len(kept) >= _FEWEST_FOLDS:
        ellipse = _ellipse(flat[kept])
        if ellipse is None:
            return None
        center, shape, radius = ellipse
        off = np.abs(np.sqrt(np.einsum("ni,ij,nj->n", flat[kept] - center, shape, flat[kept] - center)) - 1.0)
        if float(off.max()) <= ROUGH:
            break
        kept = kept[off < max(0.6 * float(off.max()), ROUGH)]
    else:
        return None
    values, vectors = np.linalg.eigh(shape)
    ratio = math.sqrt(values[0] / values[1])
    if ratio < _NARROWEST:
        return None
    # In the frame in which the ellipse is a circle.
    unit = (flat[kept] - center) @ vectors * np.sqrt(values)
    angles = np.sort(np.unique(np.round(np.arctan2(unit[:, 1], unit[:, 0]), 4)))
    gaps = np.append(np.diff(angles), angles[0] + math.tau - angles[-1])
    arc = math.tau - (float(gaps.max()) if float(gaps.max()) > WIDEST else 0.0)
    if len(angles) < _FEWEST_FOLDS or arc < _AROUND or float(np.sort(gaps)[-2]) > WIDEST:
        return None
    triangles = np.unique(soup.pair[folds[kept]])
    point = center @ basis + float((soup.middles[triangles] @ axis).mean()) * axis
    return Oval(Round(point, axis, radius, bool(soup.concave[folds[0]]), triangles), arc, ratio)


def _ellipse(points: Floats) -> tuple[Floats, Floats, float] | None:
    """(centre, M, mean radius) of the ellipse (x − c)ᵀ M (x − c) = 1 through points (n, 2) by least squares."""
    middle, size = points.mean(axis=0), float(np.ptp(points, axis=0).max())
    if size <= 0.0:
        return None
    x, y = ((points - middle) / size).T
    matrix = np.stack([x * x, x * y, y * y, x, y], axis=1)
    p, _, rank, _ = np.linalg.lstsq(matrix, np.ones(len(points)), rcond=1e-12)
    if rank < 5:
        return None
    quadratic = np.array([[p[0], 0.5 * p[1]], [0.5 * p[1], p[2]]])
    if float(np.linalg.det(quadratic)) <= 0.0:
        return None
    center = np.linalg.solve(quadratic, -0.5 * p[3:])
    level = 1.0 + float(center @ quadratic @ center)
    shape = quadratic / level
    if float(shape[0, 0]) <= 0.0 or float(np.linalg.det(shape)) <= 0.0:
        return None
    radius = size * float(np.linalg.det(shape)) ** -0.25
    return middle + size * center, shape / size**2, radius


def knuckles(soup: Soup, free: Flags) -> Iterator[Oval]:
    """The rounded bosses among the pieces of connected triangles of which none is known to be round, in their order:
    the circle that is nearest to the folds along a piece's main direction."""
    bent = soup.bent & ~soup.concave & free[soup.pair].all(axis=1)
    sides = np.concatenate([soup.corners[:, [0, 1]], soup.corners[:, [0, 2]]])
    piece = linked(sides, len(soup.points))[soup.corners[:, 0]]
    known = set(piece[~free].tolist())
    folds = np.flatnonzero(bent)
    label = piece[soup.pair[folds, 0]]
    order = np.argsort(label, kind="stable")
    starts = np.flatnonzero(np.append(True, np.diff(label[order]) != 0)) if len(order) else _NONE
    for one in np.split(folds[order], starts[1:]):
        if len(one) >= _FEWEST_FOLDS and int(piece[soup.pair[one[0], 0]]) not in known:
            found = _knuckle(soup, one)
            if found is not None:
                yield found


def _main(direction: Floats, length: Floats) -> Floats:
    """The one of some directions (n, 3) that the greatest length is in line with; of many, one in every so many is
    tried, a few at a time: all with all would take gigabytes for a mesh of a million triangles."""
    tried = direction[:: 1 + (len(direction) - 1) // _TRIED]
    step = max(1, _AT_ONCE // len(direction))
    votes = [
        (np.abs(tried[k : k + step] @ direction.T) > _IN_LINE) @ length for k in range(0, len(tried), step)
    ]  # fmt: skip
    return np.asarray(tried[int(np.argmax(np.concatenate(votes)))])


def _knuckle(soup: Soup, folds: Indices) -> Oval | None:
    ends = soup.points[soup.edges[folds]]
    direction = ends[:, 1] - ends[:, 0]
    length = np.linalg.norm(direction, axis=1)
    direction /= length[:, None]
    main = _main(direction, length)
    kept = np.abs(direction @ main) > _IN_LINE
    if int(kept.sum()) < _FEWEST_FOLDS:
        return None
    basis = np.stack(across(main))
    flat = ends[kept].mean(axis=1) @ basis.T
    # The circle nearest to points by the algebraic fit: x² + y² = 2 c·(x, y) + const.
    solved = np.linalg.lstsq(np.column_stack([2.0 * flat, np.ones(len(flat))]), (flat**2).sum(axis=1), rcond=None)[0]
    center = solved[:2]
    distance = np.linalg.norm(flat - center, axis=1)
    radius = float(distance.mean())
    angles = np.sort(np.arctan2(flat[:, 1] - center[1], flat[:, 0] - center[0]))
    gap = float(np.append(np.diff(angles), angles[0] + math.tau - angles[-1]).max())
    if float(distance.std()) > _BY_EYE * radius or gap > math.pi:
        return None
    triangles = np.unique(soup.pair[folds[kept]])
    along = float((ends[kept].reshape(-1, 3) @ main).mean())
    point = center @ basis + along * main
    return Oval(Round(point, main, radius, False, triangles), math.tau - (gap if gap > WIDEST else 0.0))
