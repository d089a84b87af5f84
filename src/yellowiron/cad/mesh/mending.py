"""Meshes as they come, mended for measuring: triangles that are there twice, faces turned at random, shells that are
not closed. What is drawn stays as it is, save for the side that its triangles face."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from yellowiron.cad.mesh.components import linked
from yellowiron.cad.mesh.measures import distinct_triangles, welded
from yellowiron.cad.mesh.shells import Indices, closed_pieces, components, piece_measures
from yellowiron.model.geometry import Mesh

_LONELY = 0.3
"""Where more than this share of the edges has no second triangle, points may be meant to be one that are not …"""
_COARSER = (10.0, 100.0)
"""… which shows by welding them within so many times the usual."""
_LOST = 0.02
"""… as long as no more than this share of the triangles lose their area by it."""
_THICK = 0.05
"""An open piece faces inward if what it would hold, closed, is at least this share of its box, with that sign: what
holds less is a sheet, and has no inside."""


@dataclass(frozen=True, eq=False)
class Mended:
    """A mesh with its triangles turned to face outward (`mesh`), each of them `once`, and with its openings closed by
    cones over their rims (`filled`), which tells what it would hold. `closed`: it had none. `number`: which of its
    points are one."""

    mesh: Mesh
    once: Mesh
    filled: Mesh
    closed: bool
    number: Indices


def mended(mesh: Mesh) -> Mended:
    """The mesh mended: its triangles face the same way as those beside them, and every piece faces outward, unless it
    is hollow within another one. `mesh` has no triangle without an area."""
    number = _number(mesh)
    corners = number[mesh.triangles]
    first, same = distinct_triangles(corners)
    single = first[same] == np.arange(len(corners))
    once = mesh.triangles[single].astype(np.int64)
    plain = Mesh(mesh.points, once.astype(np.int32))
    label = components(plain, number)
    count = int(label.max()) + 1
    sound = closed_pieces(number[once], label, count)
    over = np.zeros(len(once), dtype=bool)
    if not sound.all():
        loose = ~sound[label]
        over[loose] = _turned_over(number[once[loose]])
        once = np.where(over[:, None], once[:, ::-1], once)
        sound = closed_pieces(number[once], label, count)
    caps, piece, points = _caps(mesh, number, once, label, sound)
    filled = Mesh(points, np.concatenate([once, caps]).astype(np.int32))
    whole = np.concatenate([label, piece])
    volume, low, high = piece_measures(filled, whole, count)
    flip = np.zeros(count, dtype=bool)
    hollow = np.where(sound, 0.0, -_THICK * np.prod(high - low, axis=1))
    for k in np.flatnonzero(volume < hollow):
        around = (volume > -volume[k]) & (low <= low[k]).all(axis=1) & (high >= high[k]).all(axis=1)
        flip[k] = not around.any()
    filled = Mesh(points, np.where(flip[whole][:, None], filled.triangles[:, ::-1], filled.triangles))
    once = filled.triangles[: len(once)]
    return Mended(_facing(mesh, single, first, same, over ^ flip[label]), Mesh(mesh.points, once), filled,
                  bool(sound.all()), number)  # fmt: skip


def _number(mesh: Mesh) -> Indices:
    """`welded`, coarser where the usual leaves a mesh in shreds and that joins them."""
    number = welded(mesh)
    lonely = _lonely(number[mesh.triangles])
    # Three triangles close nothing, however their points are joined.
    for factor in _COARSER if lonely > _LONELY and len(mesh.triangles) > 3 else ():
        coarser = welded(mesh, factor)
        corners = coarser[mesh.triangles]
        flat = (corners == np.roll(corners, 1, axis=1)).any(axis=1)
        found = _lonely(corners)
        if flat.mean() < _LOST and found < 0.5 * lonely:
            number, lonely = coarser, found
    return number


def _lonely(corners: Indices) -> float:
    """The share of the edges of triangles that only one of them has."""
    count = np.unique(_edge_keys(corners)[0], return_counts=True)[1]
    return float((count == 1).mean())


def _edge_keys(corners: Indices) -> tuple[Indices, NDArray[np.bool_]]:
    """(3 m,) a number for each edge of triangles, whichever way it is run through, and whether that is from its smaller
    end."""
    start, end = corners.T.ravel(), np.roll(corners, -1, axis=1).T.ravel()
    return np.minimum(start, end) * (int(corners.max()) + 1) + np.maximum(start, end), start < end


def _turned_over(corners: Indices) -> NDArray[np.bool_]:
    """Which triangles are to be turned so that neighbours run through the edge between them in opposite directions, as
    few of each piece as will do; none of a piece where that cannot be (a Möbius strip)."""
    count = len(corners)
    keys, forward = _edge_keys(corners)
    order = np.argsort(keys, kind="stable")
    keys, forward, face = keys[order], forward[order], np.tile(np.arange(count), 3)[order]
    starts = np.flatnonzero(np.append(True, keys[1:] != keys[:-1]))
    first = starts[np.diff(np.append(starts, len(keys))) == 2]
    a, b, alike = face[first], face[first + 1], forward[first] == forward[first + 1]
    # Every triangle stands for two: as it is, and turned over.
    pairs = np.concatenate([
        np.stack([a, np.where(alike, b + count, b)], axis=1),
        np.stack([a + count, np.where(alike, b, b + count)], axis=1),
    ])  # fmt: skip
    state = linked(pairs, 2 * count)
    piece = linked(np.stack([a, b], axis=1), count)
    root = np.full(int(piece.max()) + 1, count)
    np.minimum.at(root, piece, np.arange(count))
    turned = (state[:count] != state[root[piece]]) & (state[:count] != state[count:])
    mostly = np.bincount(piece, weights=turned) > 0.5 * np.bincount(piece)
    whole = state[root] != state[root + count]
    return np.asarray(turned ^ (mostly & whole)[piece])


def _caps(
    mesh: Mesh, number: Indices, once: Indices, label: Indices, sound: NDArray[np.bool_]
) -> tuple[Indices, Indices, NDArray[np.float64]]:
    """Triangles that close the openings of pieces that are not `sound`, the pieces they are of, and the mesh's points
    with the tips of the cones behind them."""
    loose = ~sound[label]
    if not loose.any():
        return np.zeros((0, 3), dtype=np.int64), np.zeros(0, dtype=np.int64), mesh.points
    corners, own = once[loose], np.tile(label[loose], 3)
    start, end = corners.T.ravel(), np.roll(corners, -1, axis=1).T.ravel()
    keys, forward = _edge_keys(number[corners])
    real = number[start] != number[end]
    start, end, keys, forward, own = start[real], end[real], keys[real], forward[real], own[real]
    order = np.lexsort((forward, keys, own))
    start, end, keys, forward, own = start[order], end[order], keys[order], forward[order], own[order]
    new = np.append(True, (keys[1:] != keys[:-1]) | (own[1:] != own[:-1]))
    group = np.cumsum(new) - 1
    surplus = np.bincount(group, weights=np.where(forward, 1.0, -1.0))[group]
    # Of the edges that are run through more often one way than the other, one that is run that way too often.
    rows = np.flatnonzero(new | (group != np.append(group[1:], -1)))
    rows = rows[np.where(forward[rows], surplus[rows] > 0.0, surplus[rows] < 0.0)]
    rows = rows[np.unique(group[rows], return_index=True)[1]]
    start, end, own = start[rows], end[rows], own[rows]
    if not len(start):
        return np.zeros((0, 3), dtype=np.int64), np.zeros(0, dtype=np.int64), mesh.points
    ends = np.unique(np.concatenate([own * (int(number.max()) + 1) + number[start],
                                     own * (int(number.max()) + 1) + number[end]]), return_inverse=True)[1]  # fmt: skip
    ring = linked(ends.reshape(2, -1).T, int(ends.max()) + 1)[ends[: len(start)]]
    size = np.bincount(ring)
    tips = np.stack([np.bincount(ring, weights=mesh.points[start, k]) / size for k in range(3)], axis=1)
    caps = np.stack([end, start, len(mesh.points) + ring], axis=1)
    return caps, own, np.concatenate([mesh.points, tips])


def _facing(mesh: Mesh, single: NDArray[np.bool_], first: Indices, same: Indices, over: NDArray[np.bool_]) -> Mesh:
    """The whole mesh with the triangles turned over that were turned in what has each of them once; others with the
    same corners with them."""
    if not over.any():
        turned = np.zeros(len(mesh.triangles), dtype=bool)
    else:
        place = np.cumsum(single) - 1
        turned = over[place[first[same]]]
    normals = mesh.normals
    triangles = np.where(turned[:, None], mesh.triangles[:, ::-1], mesh.triangles).astype(np.int32)
    if normals is not None and turned.any():
        normals = normals.copy()
        normals[np.unique(mesh.triangles[turned])] *= -1.0
    return Mesh(mesh.points, triangles, normals, mesh.triangle_colors)
