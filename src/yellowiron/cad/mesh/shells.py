"""The solids that a mesh of triangles holds: which triangle belongs to which, which way is out, and what is hollow.

Exporters weld what touches: a pin's rim lies on its bore's, and four triangles meet in one edge. Going around such an
edge from a triangle through the material behind it, the first triangle that faces back is of the same solid.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from yellowiron.cad.mesh.components import linked
from yellowiron.cad.mesh.measures import cross, welded
from yellowiron.model.geometry import Floats, Mesh
from yellowiron.support.vectors import winding

_THIN = 0.02
"""Two triangles that face each other within this angle, radians, have no material between them."""
Indices = NDArray[np.int64]


def components(mesh: Mesh, number: Indices | None = None) -> Indices:
    """(m,) for every triangle the number of the piece of connected triangles it is in, numbered in order.

    Triangles are connected through an edge; open pieces, whose edges may not match, through a point too. `number` is
    `welded(mesh)`, where that is known.
    """
    number = welded(mesh) if number is None else number
    corners = number[mesh.triangles]
    count = len(corners)
    if not count:
        return np.zeros(0, dtype=np.int64)
    points = np.zeros((int(number.max()) + 1, 3))
    points[number[::-1]] = mesh.points[::-1]
    pair, lonely, flat = _paired(points, corners)
    label = linked(pair, count)
    open_ = np.zeros(count, dtype=bool)
    open_[label[lonely]] = True
    loose = np.flatnonzero(open_[label])
    rows = np.concatenate([corners[loose, 0], corners[loose, 0]]) + count
    columns = np.concatenate([corners[loose, 1], corners[loose, 2]]) + count
    own = np.stack([loose, corners[loose, 0] + count], axis=1)
    pair = np.concatenate([pair, flat, np.stack([rows, columns], axis=1), own])
    return linked(pair, count + len(points))[:count]


def _paired(points: Floats, corners: Indices) -> tuple[Indices, Indices, Indices]:
    """Pairs (k, 2) of triangles of one solid that share an edge; the triangles that have an edge without another; and
    pairs of a triangle that welding has made flat with one that shares its edge."""
    count = len(corners)
    start = np.concatenate([corners[:, 0], corners[:, 1], corners[:, 2]])
    end = np.concatenate([corners[:, 1], corners[:, 2], corners[:, 0]])
    far = np.concatenate([corners[:, 2], corners[:, 0], corners[:, 1]])
    face = np.tile(np.arange(count), 3)
    flat = (corners == np.roll(corners, 1, axis=1)).any(axis=1)
    real = start != end
    low, high = np.minimum(start, end), np.maximum(start, end)
    order = np.lexsort((face, start != low, flat[face], high, low))
    order = order[real[order]]
    low, high, far, face = low[order], high[order], far[order], face[order]
    forward = start[order] == low
    first = np.flatnonzero(np.append(True, (low[1:] != low[:-1]) | (high[1:] != high[:-1])))
    group = np.repeat(np.arange(len(first)), np.diff(np.append(first, len(low))))
    thin = np.stack([face, face[first][group]], axis=1)[flat[face]]
    sound = ~flat[face]
    low, high, far, face, group, forward = (v[sound] for v in (low, high, far, face, group, forward))
    size = np.bincount(group, minlength=len(first))
    start_of = np.concatenate([[0], np.cumsum(size)])[:-1]
    pairs = [start_of[size == 2][:, None] + np.arange(2)]
    alone = [face[start_of[size == 1]]]
    for n in np.unique(size[size > 2]).tolist():
        rows = start_of[size == n][:, None] + np.arange(n)
        mate = _mates(points, low[rows], high[rows], far[rows], forward[rows])
        found = np.argwhere(mate)
        pairs.append(np.stack([rows[found[:, 0], found[:, 1]], rows[found[:, 0], found[:, 2]]], axis=1))
        alone.append(face[rows[~(mate.any(axis=1) | mate.any(axis=2))]])
    return face[np.concatenate(pairs)], np.concatenate(alone), thin


def _mates(points: Floats, low: Indices, high: Indices, far: Indices, forward: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(g, n, n) which of the n triangles on an edge bound one solid: [i, j] for i that runs along the edge, j against.

    `low`, `high` (g, n): the edge's ends; `far` the third corner.
    """
    edge = points[high] - points[low]
    edge /= np.linalg.norm(edge, axis=2)[:, :, None]
    side = points[far] - points[low]
    side -= np.einsum("gni,gni->gn", side, edge)[:, :, None] * edge
    u = side[:, :1] / np.maximum(np.linalg.norm(side[:, :1], axis=2), 1e-300)[:, :, None]
    v = np.cross(edge[:, :1], u)
    angle = np.arctan2((side * v).sum(axis=2), (side * u).sum(axis=2))
    # Seen along the edge, the material of a triangle that runs along it lies clockwise behind it.
    through = (angle[:, :, None] - angle[:, None, :]) % math.tau
    through = np.where((through < _THIN) | (through > math.tau - _THIN), math.tau, through)
    through = np.where(forward[:, :, None] & ~forward[:, None, :], through, np.inf)
    finite = np.isfinite(through)
    return (
        finite
        & (through <= through.min(axis=2)[:, :, None])
        & (through <= through.min(axis=1)[:, None, :])
    )  # fmt: skip


def solids(mesh: Mesh) -> Indices:
    """(m,) for every triangle the number of the solid or open shell it belongs to: a piece of connected triangles, with
    the hollows within it."""
    number = welded(mesh)
    label = components(mesh, number)
    count = int(label.max()) + 1 if len(label) else 0
    if count < 2:
        return label
    volume, low, high = piece_measures(mesh, label, count)
    sound = closed_pieces(number[mesh.triangles], label, count)
    sign = 1.0 if float(volume[sound].sum()) >= 0.0 else -1.0
    home = np.arange(count)
    for k in np.flatnonzero(sound & (sign * volume < 0.0)).tolist():
        around = (
            sound & (sign * volume > -sign * volume[k]) & (low <= low[k]).all(axis=1) & (high >= high[k]).all(axis=1)
        )
        point = mesh.points[mesh.triangles[label == k][0, 0]]
        for other in sorted(np.flatnonzero(around).tolist(), key=lambda i: (sign * volume[i], i)):
            if abs(float(winding(point[None], mesh.points[mesh.triangles[label == other]])[0])) > 0.5:
                home[k] = other
                break
    used = np.unique(home[label], return_inverse=True)[1]
    return np.asarray(used, dtype=np.int64)


def piece_measures(mesh: Mesh, label: Indices, count: int) -> tuple[Floats, Floats, Floats]:
    """Of each of `count` pieces, which `label` (m,) numbers: the signed volume, and the (count, 3) least and largest
    coordinates."""
    corners = mesh.points[mesh.triangles]
    shifted = corners - mesh.points.mean(axis=0)
    signed = np.einsum("ij,ij->i", shifted[:, 0], cross(shifted[:, 1], shifted[:, 2])) / 6.0
    volume = np.bincount(label, weights=signed, minlength=count).astype(np.float64)
    low: Floats = np.full((count, 3), np.inf)
    high: Floats = np.full((count, 3), -np.inf)
    np.minimum.at(low, label, corners.min(axis=1))
    np.maximum.at(high, label, corners.max(axis=1))
    return volume, low, high


def closed_pieces(triangles: Indices, label: Indices, count: int) -> NDArray[np.bool_]:
    """(count,) which pieces have every edge once in each direction, or as often in one as in the other."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    piece = np.tile(label, 3)
    real = edges[:, 0] != edges[:, 1]
    edges, piece = edges[real], piece[real]
    forward = edges[:, 0] < edges[:, 1]
    low, high = edges.min(axis=1), edges.max(axis=1)
    order = np.lexsort((high, low, piece))
    low, high, piece, forward = low[order], high[order], piece[order], forward[order]
    new = np.append(True, (low[1:] != low[:-1]) | (high[1:] != high[:-1]) | (piece[1:] != piece[:-1]))[: len(low)]
    number = np.cumsum(new) - 1
    balance = np.bincount(number, weights=np.where(forward, 1.0, -1.0))
    uneven = np.zeros(count, dtype=bool)
    uneven[piece[balance[number] != 0.0]] = True
    return ~uneven
