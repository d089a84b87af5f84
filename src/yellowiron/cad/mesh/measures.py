"""Measures of triangle meshes, for bodies that come without surfaces and solids whose own measures fail."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from yellowiron.cad.mesh.components import linked
from yellowiron.model.geometry import Floats, Mesh

WELD = 1e-6
"""Points of one mesh closer than about this are one point, as a part of its diagonal."""


def cross(a: Floats, b: Floats) -> Floats:
    """(n, 3) the cross products of vectors, as `numpy.cross`, which takes several times as long for few of them."""
    result = np.empty(a.shape)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        result[:, i] = a[:, j] * b[:, k] - a[:, k] * b[:, j]
    return result


def volume_properties(mesh: Mesh) -> tuple[float, Floats, Floats]:
    """Volume, centroid (3,) and inertia (3, 3; density 1, about the centroid) of what a mesh encloses.

    The sum over signed tetrahedra between the triangles and a point near the middle; a closed mesh is taken for
    granted. Second moments of a tetrahedron with one corner at the origin: V/20 (Σ xᵢxᵢᵀ + (Σxᵢ)(Σxᵢ)ᵀ).
    """
    middle = mesh.points.mean(axis=0)
    corners = np.stack([mesh.points[mesh.triangles[:, i]] - middle for i in range(3)])
    volumes = np.einsum("ij,ij->i", corners[0], cross(corners[1], corners[2])) / 6.0
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
    areas = np.linalg.norm(cross(b - a, c - a), axis=1) / 2.0
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
    """A hash of the points and triangles, to a millionth of the size, and of the size."""
    low, high = bounds(mesh)
    size = float(np.linalg.norm(high - low))
    step = max(size * WELD, 1e-12)
    digest = hashlib.sha256(f"{size:.4e}".encode())  # like shapes of other sizes are other shapes
    digest.update(np.round(mesh.points / step).astype("<i8").tobytes())
    digest.update(mesh.triangles.astype("<i4").tobytes())
    return digest.hexdigest()[:32]


def welded(mesh: Mesh, coarser: float = 1.0) -> NDArray[np.int64]:
    """(n,) for every point the number of the point it is one with: those nearer than `WELD` of the size (`coarser`: so
    many times that), or than the rounding of coordinates in single precision."""
    low, high = bounds(mesh)
    rounding = 4.0 * float(np.finfo(np.float32).eps) * float(max(np.abs(low).max(), np.abs(high).max()))
    step = max(coarser * float(np.linalg.norm(high - low)) * WELD, rounding, 1e-12)
    points, own = _distinct(mesh.points)
    pairs = cKDTree(points).query_pairs(step, output_type="ndarray")
    label = linked(pairs, len(points))
    # Numbered by the first point of each, so that the order of equal ones does not matter.
    first = np.full(int(label.max()) + 1, len(own))
    np.minimum.at(first, label[own], np.arange(len(own)))
    return np.asarray(np.argsort(np.argsort(first))[label[own]], dtype=np.int64)


def _distinct(points: Floats) -> tuple[Floats, NDArray[np.int64]]:
    """The points of which no two are equal, and the number of each point's; a triangle soup has six of each."""
    bits = (np.ascontiguousarray(points) + 0.0).view(np.uint64)
    mixed = bits[:, 0] * np.uint64(0x9E3779B97F4A7C15)
    for column in (1, 2):
        mixed = (mixed ^ (mixed >> np.uint64(29)) ^ bits[:, column]) * np.uint64(0xBF58476D1CE4E5B9)
    _, first, own = np.unique(mixed, return_index=True, return_inverse=True)
    distinct = points[first]
    if not np.array_equal(distinct[own], points):
        distinct, own = np.unique(points, axis=0, return_inverse=True)
    return distinct, np.asarray(own, dtype=np.int64).reshape(-1)


def distinct_triangles(corners: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The first triangles of those with the same three corners, and for every triangle the number of its first."""
    ordered = np.sort(corners, axis=1)
    base = int(corners.max()) + 1
    if base < 2_000_000:
        keys = (ordered[:, 0] * base + ordered[:, 1]) * base + ordered[:, 2]
        _, first, same = np.unique(keys, return_index=True, return_inverse=True)
    else:
        _, first, same = np.unique(ordered, axis=0, return_index=True, return_inverse=True)
    return first.astype(np.int64), same.reshape(-1).astype(np.int64)


def compacted(mesh: Mesh) -> Mesh:
    """The mesh without points that no triangle has, and without triangles that have no area."""
    corners = mesh.points[mesh.triangles]
    twice = np.linalg.norm(cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    good = twice > 1e-14 * float(np.ptp(corners.reshape(-1, 3), axis=0).max()) ** 2
    return chosen(mesh, good)


def chosen(mesh: Mesh, rows: NDArray[Any]) -> Mesh:
    """Some triangles of a mesh (flags or numbers), with all that belongs to them."""
    used, triangles = np.unique(mesh.triangles[rows], return_inverse=True)
    return Mesh(
        points=mesh.points[used],
        triangles=triangles.reshape(-1, 3).astype(np.int32),
        normals=None if mesh.normals is None else mesh.normals[used],
        triangle_colors=None if mesh.triangle_colors is None else mesh.triangle_colors[rows],
        uvs=None if mesh.uvs is None else mesh.uvs[rows],
        triangle_finishes=None if mesh.triangle_finishes is None else mesh.triangle_finishes[rows],
    )


def extent(placed: Iterable[tuple[Floats, Floats]]) -> float:
    """The diagonal, metres, of the box around boxes (2, 3) at their places (4, 4)."""
    corners = []
    for bounds, place in placed:
        x, y, z = np.meshgrid(*bounds.T, indexing="ij")
        corners.append(np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1) @ place[:3, :3].T + place[:3, 3])
    return float(np.linalg.norm(np.ptp(np.concatenate(corners), axis=0)))
