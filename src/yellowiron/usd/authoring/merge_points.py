"""Points that coincide in single precision become one: CAD meshes repeat them along every edge between two faces."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from yellowiron.model.geometry import Floats, Ints, Mesh

Singles = NDArray[np.float32]


def weld(mesh: Mesh) -> tuple[Singles, Ints, NDArray[np.bool_]]:
    """Points without repetition (in order of first use), triangles on them, and which of the mesh's triangles stay."""
    points, ranks = distinct(mesh.points)
    triangles = ranks[np.asarray(mesh.triangles, dtype=np.int64)].reshape(-1, 3)
    kept = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    return points, triangles[kept], kept


def distinct(rows: Floats) -> tuple[Singles, Ints]:
    """Rows in single precision without repetition, in order of first use, and the rank of every given row in them."""
    single = np.ascontiguousarray(rows, dtype=np.float32) + np.float32(0.0)
    if not len(single):
        return single, np.zeros(0, dtype=np.int32)
    order = np.lexsort(single.T)
    ordered = single[order]
    new = np.ones(len(single), dtype=bool)
    new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    group = np.empty(len(single), dtype=np.int64)
    group[order] = np.cumsum(new) - 1
    first = np.minimum.reduceat(order, np.flatnonzero(new))
    ranks = np.empty(len(first), dtype=np.int32)
    ranks[np.argsort(first)] = np.arange(len(first), dtype=np.int32)
    return single[np.sort(first)], ranks[group]
