"""Polygons and simple solids as triangles: what several readers of triangle formats need."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from yellowiron.model.geometry import Mesh

SIDES = 48
"""Facets around a cylinder or ball that a file gives as a formula."""


def fans(counts: ArrayLike, corners: ArrayLike) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
    """Polygons, `counts` corners each, cut into fans: (m, 3) triangles, and (m,) the polygon that each is of."""
    sizes = np.asarray(counts, dtype=np.int64)
    points = np.asarray(corners, dtype=np.int64)
    spare = np.maximum(sizes - 2, 0)
    polygon = np.repeat(np.arange(len(sizes)), spare)
    first = (np.cumsum(sizes) - sizes)[polygon]
    step = np.arange(len(polygon)) - np.repeat(np.cumsum(spare) - spare, spare)
    triangles = np.stack([points[first], points[first + step + 1], points[first + step + 2]], axis=1)
    return triangles.astype(np.int32), polygon


def box(size: ArrayLike) -> Mesh:
    """A box about the origin with these edges (3,)."""
    return _mesh("box", extents=np.asarray(size, dtype=np.float64))


def cylinder(radius: float, length: float) -> Mesh:
    """A cylinder about the origin, along Z."""
    return _mesh("cylinder", radius=radius, height=length, sections=SIDES)


def cone(radius: float, length: float) -> Mesh:
    """A cone about the origin, along Z, its tip up."""
    mesh = _mesh("cone", radius=radius, height=length, sections=SIDES)
    return Mesh(mesh.points - [0.0, 0.0, length / 2.0], mesh.triangles)


def capsule(radius: float, length: float) -> Mesh:
    """A capsule about the origin, along Z; `length` is its cylinder's."""
    return _mesh("capsule", radius=radius, height=length, count=[SIDES, SIDES // 2])


def ball(radius: float) -> Mesh:
    """A ball about the origin."""
    return _mesh("uv_sphere", radius=radius, count=[SIDES // 2, SIDES])


def _mesh(kind: str, **sizes: Any) -> Mesh:
    import trimesh

    made = getattr(trimesh.creation, kind)(**sizes)
    return Mesh(np.asarray(made.vertices, dtype=np.float64), np.asarray(made.faces, dtype=np.int32))
