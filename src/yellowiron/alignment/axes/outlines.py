"""Circles in the outline of a mesh seen along a direction, where no cylinder was recognised: few-sided rounds,
decimated bores, round ends of lugs. Three corners of the outline in a row are on one circle; corners that agree make
a round."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from yellowiron.model.geometry import Floats, Ints

WALL = 0.17
"""Sine of the angle up to which a triangle is along the direction (10°): decimation tilts walls."""
CHORD = 1.25
"""Radians that one side of a round spans at most: a pentagon is round, a square is none."""
SAME = 0.08
"""Circles are the same if centres and radii differ by less than this share of the radius."""
ARC = 0.9
"""Radians that a round covers at least."""
MOST = 4
"""Sides that meet in a corner of the outline: where more do, outlines of several things cross."""


@dataclass(frozen=True, eq=False)
class OutlineCircle:
    """A circle of an outline: centre (2,) in the plane, radius, from where to where it reaches along the direction, the
    radians it covers, whether it is a hole, and how far its corners are from it (root mean square)."""

    center: Floats
    radius: float
    low: float
    high: float
    arc: float
    inner: bool
    rms: float
    corners: int


def outline_circles(
    points: Floats, triangles: Ints, direction: Floats, plane: Floats, *, least: float, most: float
) -> list[OutlineCircle]:
    """Circles with a radius between `least` and `most` in the outline of triangles (m, 3) of points (n, 3), seen along
    a unit direction across `plane` (2, 3)."""
    sides = _sides(points, triangles, direction, plane, least)
    if sides is None:
        return []
    ends, corner, normal, low, high = sides
    v, a, b, one, two = _neighbours(ends, len(corner))
    if not len(v):
        return []
    center, radius = _through(corner[v], corner[a], corner[b])
    chord_a = np.linalg.norm(corner[a] - corner[v], axis=1)
    chord_b = np.linalg.norm(corner[b] - corner[v], axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        good = np.isfinite(radius) & (radius > least) & (radius < most)
        span_a, span_b = (2 * np.arcsin(np.minimum(1.0, c / (2 * radius))) for c in (chord_a, chord_b))
        out_a = np.einsum("ij,ij->i", 0.5 * (corner[a] + corner[v]) - center, normal[one]) / radius
        out_b = np.einsum("ij,ij->i", 0.5 * (corner[b] + corner[v]) - center, normal[two]) / radius
    # The way goes on around the centre, and both sides face it or face away from it.
    opposite = np.einsum("ij,ij->i", corner[a] - corner[v], corner[b] - corner[v]) < 0.0
    good &= (span_a < CHORD) & (span_b < CHORD) & opposite
    good &= (np.abs(out_a) > 0.6) & (np.abs(out_b) > 0.6) & (out_a * out_b > 0.0)
    rows = np.flatnonzero(good)
    if not len(rows):
        return []
    v, a, b, one, two = v[rows], a[rows], b[rows], one[rows], two[rows]
    center, radius, turn = center[rows], radius[rows], 0.5 * (span_a + span_b)[rows]
    inner = out_a[rows] < 0.0
    label = _clusters(center, radius, inner)
    found = []
    order = np.argsort(label, kind="stable")
    for group in np.split(order, np.flatnonzero(np.diff(label[order])) + 1):
        circle = _circle(group, v, a, b, corner, turn, inner, ((one, two), low, high))
        if circle is not None and least < circle.radius < most:
            found.append(circle)
    return found


def _sides(
    points: Floats, triangles: Ints, direction: Floats, plane: Floats, least: float
) -> tuple[NDArray[np.int64], Floats, Floats, Floats, Floats] | None:
    """The sides of the outline: their ends (m, 2) as rows of corners (k, 2), outward normals (m, 2), and from where to
    where each reaches along the direction."""
    corners = points[triangles]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    double = np.linalg.norm(cross, axis=1)
    wall = (np.abs(cross @ direction) < WALL * double) & (double > 1e-14)
    if not wall.any():
        return None
    rows = triangles[wall]
    normal = (cross[wall] / double[wall, None]) @ plane.T
    used, rows = np.unique(rows, return_inverse=True)
    rows = rows.reshape(-1, 3)
    flat, height = points[used] @ plane.T, points[used] @ direction
    number = _corners(flat, height, rows, 0.02 * least)
    count = np.bincount(number)
    corner = np.stack([np.bincount(number, weights=flat[:, k]) for k in range(2)], axis=1) / count[:, None]
    flat = corner[number]
    p = flat[rows]
    edge = np.stack([np.linalg.norm(p[:, k] - p[:, (k + 1) % 3], axis=1) for k in range(3)], axis=1)
    k = np.argmax(edge, axis=1)
    line = np.arange(len(rows))
    ends = np.stack([number[rows[line, k]], number[rows[line, (k + 1) % 3]]], axis=1)
    h = height[rows]
    keep = ends[:, 0] != ends[:, 1]
    ends, normal, h = np.sort(ends[keep], axis=1), normal[keep], h[keep]
    if not len(ends):
        return None
    # Walls of one outline on two plates are one side, those that face each other two.
    facing = (normal @ np.array([1.0, 1e-3]) > 0).astype(np.int64)
    # One number a side: rows are slow to compare.
    _, first, which = np.unique(
        (ends[:, 0] * len(corner) + ends[:, 1]) * 2 + facing, return_index=True, return_inverse=True
    )
    sides = ends[first]
    low, high = np.full(len(sides), np.inf), np.full(len(sides), -np.inf)
    np.minimum.at(low, which, h.min(axis=1))
    np.maximum.at(high, which, h.max(axis=1))
    mean = np.zeros((len(sides), 2))
    np.add.at(mean, which, normal)
    return sides, corner, mean / np.maximum(np.linalg.norm(mean, axis=1), 1e-300)[:, None], low, high


def _corners(flat: Floats, height: Floats, rows: NDArray[np.int64], cell: float) -> NDArray[np.int64]:
    """(n,) which corner of the outline each point is: those within a cell, and those that a wall's edge along the
    direction joins, however little that leans."""
    place = np.round(flat / cell).astype(np.int64)
    place -= place.min(axis=0)
    wide = int(place[:, 1].max()) + 1
    # One number a cell: rows are slow to compare, but for those that so many cells do not fit in.
    cells = place[:, 0] * wide + place[:, 1] if float(place[:, 0].max()) * wide < 2.0**62 else None
    first = np.unique(place if cells is None else cells, axis=0, return_inverse=True)[1].ravel()
    a = np.concatenate([rows[:, k] for k in range(3)])
    b = np.concatenate([rows[:, (k + 1) % 3] for k in range(3)])
    upright = np.linalg.norm(flat[a] - flat[b], axis=1) < 0.1 * np.abs(height[a] - height[b])
    ends = first[a[upright]], first[b[upright]]
    count = int(first.max()) + 1
    graph = coo_array((np.ones(len(ends[0])), ends), shape=(count, count))
    return np.asarray(connected_components(graph, directed=False)[1][first], dtype=np.int64)


def _neighbours(ends: NDArray[np.int64], count: int) -> tuple[NDArray[np.int64], ...]:
    """Every corner with two sides that meet in it: corner, the far ends of both, and the sides."""
    at = np.concatenate([ends[:, 0], ends[:, 1]])
    far = np.concatenate([ends[:, 1], ends[:, 0]])
    side = np.tile(np.arange(len(ends)), 2)
    order = np.argsort(at, kind="stable")
    at, far, side = at[order], far[order], side[order]
    start = np.searchsorted(at, np.arange(count))
    degree = np.bincount(at, minlength=count)
    found: list[list[NDArray[np.int64]]] = [[], [], [], [], []]
    for i in range(MOST):
        for j in range(i + 1, MOST):
            v = np.flatnonzero((degree > j) & (degree <= MOST))
            one, two = start[v] + i, start[v] + j
            for column, values in zip(found, (v, far[one], far[two], side[one], side[two]), strict=True):
                column.append(values)
    return tuple(np.concatenate(column) for column in found)


def _through(p: Floats, q: Floats, r: Floats) -> tuple[Floats, Floats]:
    """Centres (n, 2) and radii (n,) of the circles through three points each; infinite for points in line."""
    a, b = q - p, r - p
    twice = 2 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    aa, bb = (a * a).sum(axis=1), (b * b).sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        x = (b[:, 1] * aa - a[:, 1] * bb) / twice
        y = (a[:, 0] * bb - b[:, 0] * aa) / twice
    center = np.stack([x, y], axis=1)
    return center + p, np.linalg.norm(center, axis=1)


def _clusters(center: Floats, radius: Floats, inner: NDArray[np.bool_]) -> NDArray[np.int64]:
    """(n,) the number of the circle that each belongs to."""
    step = np.log1p(SAME)
    level = np.round(np.log(radius) / step).astype(np.int64)
    cell = np.exp(level * step) * SAME
    key = np.c_[np.round(center / cell[:, None]), level, inner].astype(np.int64)
    _, first, which = np.unique(key, axis=0, return_index=True, return_inverse=True)
    center, radius, level, inner = center[first], radius[first], level[first], inner[first]
    links = []
    for number in np.unique(level):
        rows = np.flatnonzero((level == number) | (level == number + 1))
        place = np.c_[center[rows], 1e3 * inner[rows]]
        pairs = cKDTree(place).query_pairs(1.5 * SAME * float(radius[rows].min()), output_type="ndarray")
        links.append(rows[pairs])
    ends = np.concatenate(links)
    graph = coo_array((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(len(first), len(first)))
    return np.asarray(connected_components(graph, directed=False)[1][which.ravel()], dtype=np.int64)


def _circle(
    group: NDArray[np.intp],
    v: NDArray[np.int64],
    a: NDArray[np.int64],
    b: NDArray[np.int64],
    corner: Floats,
    turn: Floats,
    inner: NDArray[np.bool_],
    sides: tuple[tuple[NDArray[np.int64], NDArray[np.int64]], Floats, Floats],
) -> OutlineCircle | None:
    """The circle that a group of corners agrees on."""
    middles, first = np.unique(v[group], return_index=True)
    arc = float(turn[group][first].sum()) + float(turn[group].mean())
    if len(middles) < 2 or arc < ARC:
        return None
    rim = corner[np.unique(np.concatenate([v[group], a[group], b[group]]))]
    center, radius = fitted_circle(rim)
    if not math.isfinite(radius):
        return None
    off = np.linalg.norm(rim - center, axis=1) - radius
    rms = float(np.sqrt((off * off).mean()))
    if rms > 0.1 * radius:
        return None
    (one, two), low, high = sides
    of = np.concatenate([one[group], two[group]])
    return OutlineCircle(
        center, radius, float(low[of].min()), float(high[of].max()), min(arc, 2 * math.pi),
        bool(inner[group].mean() > 0.5), rms, len(rim),
    )  # fmt: skip


def fitted_circle(points: Floats) -> tuple[Floats, float]:
    """Centre (2,) and radius of the circle nearest to points (n, 2), by linear least squares (I. Kåsa, IEEE Trans.
    Instrum. Meas. 25, 1976); an infinite radius for points in line."""
    middle = points.mean(axis=0)
    p = points - middle
    scale = float(np.abs(p).max()) or 1.0
    p = p / scale
    matrix = np.c_[2 * p, np.ones(len(p))]
    solution, _, rank, _ = np.linalg.lstsq(matrix, (p * p).sum(axis=1), rcond=1e-9)
    if rank < 3:
        return middle, math.inf
    center = solution[:2]
    square = float(solution[2] + center @ center)
    return np.asarray(middle + scale * center, dtype=np.float64), scale * math.sqrt(max(square, 0.0))
