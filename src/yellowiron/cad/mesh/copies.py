"""Equal meshes at several places as one mesh with several places: files of triangles write every copy out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from yellowiron.cad.mesh.measures import WELD
from yellowiron.model.geometry import Floats, Ints, Mesh

_ALIKE = 1e-4
"""Copies have the same area and reach within this share, before anything else is compared."""


def originals(meshes: Sequence[Mesh]) -> list[tuple[int, Floats | None]]:
    """For every mesh the number of the first one that it is a copy of (or its own), and the rigid (4, 4) transform from
    that one to it; None where they are the same.

    Copies have equal triangles in the same order, turned and moved but not mirrored, to what single precision leaves of
    their coordinates; and equal colours and texture coordinates. A mesh with coordinates that are not finite is a copy
    of none.
    """
    known: dict[int, _Alike] = {}
    result: list[tuple[int, Floats | None]] = []
    for index, mesh in enumerate(meshes):
        corners = mesh.points[mesh.triangles].reshape(-1, 3)
        result.append((index, None))
        if len(corners) < 12 or not np.isfinite(corners).all():
            continue
        middle = corners.mean(axis=0)
        centred = corners - middle
        measures = _measures(centred)
        rounding = max(WELD * measures[1], 4.0 * float(np.finfo(np.float32).eps) * float(np.abs(corners).max()))
        group = known.setdefault(len(corners), _Alike())
        for first, other, slack in group.near(measures, rounding, len(corners)):
            if not _same_looks(meshes[first], mesh):
                continue
            turn = _rotation(other, centred)
            if turn is None or float(np.abs(other @ turn.T - centred).max()) > 2.0 * (rounding + slack):
                continue
            transform = np.eye(4)
            transform[:3, :3] = turn
            transform[:3, 3] = middle - turn @ meshes[first].points[meshes[first].triangles].reshape(-1, 3).mean(axis=0)
            result[-1] = (first, transform)
            break
        else:
            group.add(index, centred, measures, rounding)
    return result


class _Alike:
    """Meshes of as many corners, none a copy of another: the number and the centred corners of each, and, a row each of
    arrays that grow, its measures and the rounding of its coordinates."""

    def __init__(self) -> None:
        self._known: list[tuple[int, Floats]] = []
        self._rows = np.zeros((4, 4))

    def add(self, index: int, centred: Floats, measures: Floats, rounding: float) -> None:
        """Takes in a mesh."""
        if len(self._known) == len(self._rows):
            self._rows = np.concatenate([self._rows, np.zeros_like(self._rows)])
        self._rows[len(self._known)] = (*measures, rounding)
        self._known.append((index, centred))

    def near(self, measures: Floats, rounding: float, corners: int) -> Iterator[tuple[int, Floats, float]]:
        """Number, centred corners and rounding of those that measure the same, in order."""
        sizes, slack = self._rows[: len(self._known), :3], self._rows[: len(self._known), 3]
        # What rounding does to a small part far from the origin may be more than a share of it.
        by_rounding = 2.0 * (rounding + slack)[:, None] * np.array([measures[2], 1.0, corners])
        other = (np.abs(sizes - measures) > _ALIKE * measures + by_rounding).any(axis=1)
        for n in np.flatnonzero(~other).tolist():
            yield (*self._known[n], float(slack[n]))


def _measures(centred: Floats) -> Floats:
    """Area, reach and length of all edges; none changes when corners (3 m, 3) are turned."""
    a, b, c = centred[0::3], centred[1::3], centred[2::3]
    area = 0.5 * float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())
    edges = float(sum(np.linalg.norm(p - q, axis=1).sum() for p, q in ((a, b), (b, c), (c, a))))
    return np.array([area, float(np.linalg.norm(centred, axis=1).max()), edges])


def _rotation(one: Floats, other: Floats) -> Floats | None:
    """The rotation that takes centred points (n, 3) nearest to others (Kabsch, 1976); None where they are in line."""
    u, sizes, v = np.linalg.svd(one.T @ other)
    if sizes[1] <= 1e-12 * sizes[0]:
        return None
    sign = np.sign(float(np.linalg.det(u) * np.linalg.det(v)))
    return np.asarray(v.T @ np.diag([1.0, 1.0, sign]) @ u.T)


def _same_looks(one: Mesh, other: Mesh) -> bool:
    return (
        _equal(one.triangle_colors, other.triangle_colors)
        and _equal(one.uvs, other.uvs)
        and _equal(one.triangle_finishes, other.triangle_finishes)
    )


def _equal(one: Floats | Ints | None, other: Floats | Ints | None) -> bool:
    if one is None or other is None:
        return one is other
    return bool(np.allclose(one, other, atol=1e-4))
