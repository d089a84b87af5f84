"""Measures of triangle meshes, for bodies that come without surfaces and solids whose own measures fail."""

from __future__ import annotations

import hashlib

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from yellowiron.model.geometry import Floats, Mesh

WELD = 1e-6
"""Points of one mesh closer than about this are one point, as a part of its diagonal."""


def volume_properties(mesh: Mesh) -> tuple[float, Floats, Floats]:
    """Volume, centroid (3,) and inertia (3, 3; density 1, about the centroid) of what a mesh encloses.

    The sum over signed tetrahedra between the triangles and a point near the middle; a closed mesh is taken for
    granted. Second moments of a tetrahedron with one corner at the origin: V/20 (Σ xᵢxᵢᵀ + (Σxᵢ)(Σxᵢ)ᵀ).
    """
    middle = mesh.points.mean(axis=0)
    corners = np.stack([mesh.points[mesh.triangles[:, i]] - middle for i in range(3)])
    volumes = np.einsum("ij,ij->i", corners[0], np.cross(corners[1], corners[2])) / 6.0
    volume = float(volumes.sum())
    if volume == 0.0:
        return 0.0, np.asarray(middle), np.zeros((3, 3))
    total = corners.sum(axis=0)
    offset = volumes @ total / (4.0 * volume)
    moments = np.einsum("kni,knj,n->ij", corners, corners, volumes) + np.einsum("ni,nj,n->ij", total, total, volumes)
    covariance = moments / 20.0 - volume * np.outer(offset, offset)
    return volume, np.asarray(middle + offset), np.trace(covariance) * np.eye(3) - covariance


def area_properties(mesh: Mesh) -> tuple[float, Floats]:
    """Area and its centre (3,)."""
    a, b, c = (mesh.points[mesh.triangles[:, i]] for i in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0
    area = float(areas.sum())
    return area, np.asarray(areas @ (a + b + c) / (3.0 * area) if area > 0.0 else mesh.points.mean(axis=0))


def bounds(mesh: Mesh) -> Floats:
    """(2, 3) smallest and largest coordinates."""
    return np.array([mesh.points.min(axis=0), mesh.points.max(axis=0)])


def is_closed(mesh: Mesh) -> bool:
    """True where every edge of the welded mesh is run through once in each direction."""
    low, high = bounds(mesh)
    step = max(float(np.linalg.norm(high - low)) * WELD, 1e-12)
    _, welded = np.unique(np.round((mesh.points - low) / step), axis=0, return_inverse=True)
    triangles = welded.reshape(-1)[mesh.triangles]
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges = edges[edges[:, 0] != edges[:, 1]]
    there, back = np.unique(edges, axis=0), np.unique(edges[:, ::-1], axis=0)
    return len(there) == len(edges) and np.array_equal(there, back)


def content_key(mesh: Mesh) -> str:
    """A hash of the points and triangles, to a millionth of the size."""
    low, high = bounds(mesh)
    step = max(float(np.linalg.norm(high - low)) * WELD, 1e-12)
    digest = hashlib.sha256(np.round(mesh.points / step).astype("<i8").tobytes())
    digest.update(mesh.triangles.astype("<i4").tobytes())
    return digest.hexdigest()[:32]


def welded(mesh: Mesh) -> NDArray[np.int64]:
    """(n,) for every point the number of the point it is one with: those nearer than `WELD` of the size, or than the
    rounding of coordinates in single precision."""
    low, high = bounds(mesh)
    rounding = 4.0 * float(np.finfo(np.float32).eps) * float(max(np.abs(low).max(), np.abs(high).max()))
    step = max(float(np.linalg.norm(high - low)) * WELD, rounding, 1e-12)
    pairs = cKDTree(mesh.points).query_pairs(step, output_type="ndarray")
    count = len(mesh.points)
    graph = coo_array((np.ones(len(pairs), dtype=np.int8), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


def compacted(mesh: Mesh) -> Mesh:
    """The mesh without points that no triangle has, and without triangles that have no area."""
    corners = mesh.points[mesh.triangles]
    twice = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    good = twice > 1e-14 * float(np.ptp(corners.reshape(-1, 3), axis=0).max()) ** 2
    used, triangles = np.unique(mesh.triangles[good], return_inverse=True)
    return Mesh(
        points=mesh.points[used],
        triangles=triangles.reshape(-1, 3).astype(np.int32),
        normals=None if mesh.normals is None else mesh.normals[used],
        triangle_colors=None if mesh.triangle_colors is None else mesh.triangle_colors[good],
    )


def components(mesh: Mesh) -> NDArray[np.int64]:
    """(m,) for every triangle the number of the piece of connected triangles it is in, numbered in order."""
    points = welded(mesh)
    corners = points[mesh.triangles]
    rows = np.concatenate([corners[:, 0], corners[:, 0]])
    columns = np.concatenate([corners[:, 1], corners[:, 2]])
    count = int(points.max()) + 1 if len(points) else 0
    graph = coo_array((np.ones(len(rows), dtype=np.int8), (rows, columns)), shape=(count, count))
    label = connected_components(graph, directed=False)[1][corners[:, 0]]
    first = np.unique(label, return_index=True)[1]
    order = np.argsort(np.argsort(first))
    return np.asarray(order[np.unique(label, return_inverse=True)[1]], dtype=np.int64)


def right_side_out(mesh: Mesh) -> tuple[Mesh, float, bool]:
    """The mesh with every closed piece turned to face outward, the volume of the closed pieces (m³, hollows within
    others taken off), and whether all of it is closed."""
    label = components(mesh)
    points = welded(mesh)
    middle = mesh.points.mean(axis=0)
    corners = mesh.points[mesh.triangles] - middle
    signed = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
    count = int(label.max()) + 1
    volume = np.bincount(label, weights=signed, minlength=count)
    sound = _closed_pieces(points[mesh.triangles], label, count)
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(low, label, corners.min(axis=1))
    np.maximum.at(high, label, corners.max(axis=1))
    flip = np.zeros(count, dtype=bool)
    for k in np.flatnonzero(sound & (volume < 0.0)):
        around = sound & (volume > -volume[k]) & (low <= low[k]).all(axis=1) & (high >= high[k]).all(axis=1)
        flip[k] = not around.any()
    turned = flip[label]
    triangles = np.where(turned[:, None], mesh.triangles[:, ::-1], mesh.triangles).astype(np.int32)
    normals = mesh.normals
    if normals is not None and turned.any():
        normals = normals.copy()
        normals[np.unique(mesh.triangles[turned])] *= -1.0
    total = float(np.where(flip, -volume, volume)[sound].sum())
    return Mesh(mesh.points, triangles, normals, mesh.triangle_colors), max(0.0, total), bool(sound.all())


def _closed_pieces(triangles: NDArray[np.int64], label: NDArray[np.int64], count: int) -> NDArray[np.bool_]:
    """(count,) which pieces have every edge once in each direction, or as often in one as in the other."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    piece = np.tile(label, 3)
    real = edges[:, 0] != edges[:, 1]
    edges, piece = edges[real], piece[real]
    forward = edges[:, 0] < edges[:, 1]
    number = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)[1].reshape(-1)
    balance = np.bincount(number, weights=np.where(forward, 1.0, -1.0))
    uneven = np.zeros(count, dtype=bool)
    uneven[piece[balance[number] != 0.0]] = True
    return ~uneven
