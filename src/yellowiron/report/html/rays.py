"""What rays meet: triangles in Embree's scenes, whole or in pieces that each stand somewhere else.

A machine in another pose is the same pieces in other places: rays go to where a piece was, and nothing is built anew.
Metres; single precision. Many vectors are (3, n): numpy is quick along long rows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from yellowiron.model.geometry import Floats

Singles = NDArray[np.float32]
"""A picture needs no more: a micrometre at ten metres."""
_AROUND = 1.0 + 1e-4
"""Times a sphere's size: what only touches it is in it."""


@dataclass(frozen=True, eq=False)
class Hits:
    """What rays meet first: the numbers (n,) of the triangles, -1 where it is none; where on them, `u` and `v` (n,);
    how far away (n,), metres."""

    triangle: NDArray[np.int32]
    u: Singles
    v: Singles
    distance: Singles


@dataclass(frozen=True, eq=False)
class Piece:
    """Triangles that stay together: Embree's scene of them, their numbers (k,) among all, None where they are all, and
    a sphere around them: `middle` (3,) and `radius`. `place` (4, 4) is where they are now, None where they were."""

    scene: Any
    numbers: NDArray[np.int32] | None
    middle: Floats
    radius: float
    place: Floats | None = None

    def at(self, place: Floats | None) -> Piece:
        """The piece in another place."""
        still = place is None or np.array_equal(place, np.eye(4))
        return replace(self, place=None if still else place)

    def _there(self) -> Floats:
        """The middle of the sphere, where the piece is now."""
        return self.middle if self.place is None else self.place[:3, :3] @ self.middle + self.place[:3, 3]

    def _back(self, starts: Singles, directions: Singles) -> tuple[Singles, Singles]:
        """Rays (3, n) as the piece saw them where it was, one a row."""
        if self.place is None:
            return np.ascontiguousarray(starts.T), np.ascontiguousarray(directions.T)
        turn, way = self.place[:3, :3].astype(np.float32), self.place[:3, 3].astype(np.float32)
        return _turned(starts - way[:, None], turn), _turned(directions, turn)

    def seen_from(self, eye: Floats, directions: Singles) -> NDArray[np.intp]:
        """Numbers of the rays from one point, in unit `directions` (3, n), that come near the piece."""
        towards = self._there() - eye
        away, radius = float(np.linalg.norm(towards)), self.radius * _AROUND
        if away <= radius:
            return np.arange(directions.shape[1])
        narrow = np.float32((1.0 - (radius / away) ** 2) ** 0.5 - 1e-6)
        return np.flatnonzero(dot(directions, (towards / away).astype(np.float32)) >= narrow)

    def in_the_way(self, starts: Singles, towards: Singles) -> NDArray[np.intp]:
        """Numbers of the rays (3, n) in one unit direction (3,) that come near the piece."""
        beside = starts - self._there().astype(np.float32)[:, None]
        along = dot(beside, towards)
        radius = np.float32(self.radius * _AROUND)
        return np.flatnonzero((dot(beside, beside) - along * along <= radius * radius) & (along <= radius))

    def hits(self, starts: Singles, directions: Singles) -> Hits:
        """What some rays (3, n) meet of it; places on triangles and distances are the same wherever it is."""
        found = self.scene.run(*self._back(starts, directions), output=True)
        triangle = np.asarray(found["primID"], dtype=np.int32)
        if self.numbers is not None:
            triangle = np.where(triangle >= 0, self.numbers[triangle], np.int32(-1))
        return Hits(triangle, found["u"], found["v"], found["tfar"])

    def blocks(self, starts: Singles, towards: Singles) -> NDArray[np.bool_]:
        """Whether it is in the way of rays (3, n)."""
        directions = np.broadcast_to(towards[:, None], starts.shape)
        return np.asarray(self.scene.run(*self._back(starts, directions), query="OCCLUDED") >= 0)


Pieces = Sequence[Piece]


def piece_of(points: Singles, triangles: NDArray[np.int32], numbers: NDArray[np.int32] | None = None) -> Piece:
    """Triangles (m, 3) of points (n, 3) that stay together: all, or those of some numbers (k,)."""
    from embreex import rtcore_scene
    from embreex.mesh_construction import TriangleMesh

    scene = rtcore_scene.EmbreeScene()
    if numbers is not None:
        used, own = np.unique(triangles[numbers], return_inverse=True)
        points, triangles = points[used], own.reshape(-1, 3).astype(np.int32)
    TriangleMesh(scene, points, triangles)
    # Embree builds what it needs at the first ray: before several threads ask.
    scene.run(np.zeros((1, 3), dtype=np.float32), np.ones((1, 3), dtype=np.float32))
    if not len(points):
        return Piece(scene, numbers, np.zeros(3), 0.0)
    # Column by column: over rows of three numpy takes twenty times as long.
    ends = np.array([(axis.min(), axis.max()) for axis in points.T], dtype=np.float64)
    return Piece(scene, numbers, ends.mean(axis=1), 0.5 * float(np.linalg.norm(np.ptp(ends, axis=1))))


def first(pieces: Pieces, eye: Floats, directions: Singles) -> Hits:
    """What rays from one point in unit directions (3, n) meet first."""
    start = np.asarray(eye, dtype=np.float32)[:, None]
    count = directions.shape[1]
    met = Hits(
        np.full(count, -1, dtype=np.int32), np.zeros(count, dtype=np.float32), np.zeros(count, dtype=np.float32),
        np.full(count, np.inf, dtype=np.float32),
    )  # fmt: skip
    for piece in pieces:
        asked = piece.seen_from(eye, directions)
        if not len(asked):
            continue
        found = piece.hits(np.broadcast_to(start, (3, len(asked))), directions[:, asked])
        nearer = np.flatnonzero((found.triangle >= 0) & (found.distance < met.distance[asked]))
        at = asked[nearer]
        met.triangle[at], met.distance[at] = found.triangle[nearer], found.distance[nearer]
        met.u[at], met.v[at] = found.u[nearer], found.v[nearer]
    return met


def blocked(pieces: Pieces, starts: Singles, towards: Singles) -> NDArray[np.bool_]:
    """Whether anything is in the way of rays (3, n) in one unit direction (3,)."""
    found = np.zeros(starts.shape[1], dtype=bool)
    for piece in pieces:
        near = piece.in_the_way(starts, towards)
        near = near[~found[near]]
        if len(near):
            found[near] = piece.blocks(starts[:, near], towards)
    return found


def dot(one: Singles, other: Singles) -> Singles:
    """Products (n,) of vectors (3, n), or of one (3,). Not by BLAS, whose threads would spin for so little."""
    return np.asarray(one[0] * other[0] + one[1] * other[1] + one[2] * other[2])


def _turned(vectors: Singles, turn: Singles) -> Singles:
    """Vectors (3, n) turned back by a rotation (3, 3), one a row."""
    rows = np.empty(vectors.shape[::-1], dtype=np.float32)
    for axis in range(3):
        rows[:, axis] = dot(vectors, turn[:, axis])
    return rows
