"""Distances between meshes, asked only where a decision hangs on them."""

from __future__ import annotations

import weakref
from typing import Any

import fcl
import numpy as np

from yellowiron.alignment.features.solids import Cyl, Solid, solids_of
from yellowiron.alignment.spans import Spans
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Floats, Shape
from yellowiron.support.caching.remembered import remembered
from yellowiron.support.vectors import winding

SAMPLES = 12
"""Points of a part that are asked whether they are inside of another."""
PATCHES = 24
"""Points of a part's surface that are asked so, each for as much of it."""


class Touch:
    """Mesh distances of one assembly, remembered, and by every other look at the same solids. `tolerance` metres counts
    as touching."""

    def __init__(self, solids: tuple[Solid, ...], tolerance: float) -> None:
        self._solids = solids
        self._tolerance = tolerance
        self._low = np.array([s.low for s in solids]).reshape(-1, 3)
        self._high = np.array([s.high for s in solids]).reshape(-1, 3)
        self._spans = Spans(self._low[:, 0], self._high[:, 0])
        self._near: dict[int, list[int]] = {}

    def distance(self, a: int, b: int) -> float:
        """Metres between two solids; 0 where they cut each other."""
        first, second = self._solids[min(a, b)], self._solids[max(a, b)]
        known = _distances.setdefault(first, weakref.WeakKeyDictionary())
        if second not in known:
            known[second] = _distance(_object_of(first), _object_of(second))
        return known[second]

    def sunk(self, a: int, b: int) -> float:
        """The share of solid `a` that is inside of solid `b`, by some of its points; 0 where `b` is open."""
        inner, outer = self._solids[a], self._solids[b]
        known = _shares.setdefault(inner, weakref.WeakKeyDictionary())
        if outer not in known:
            known[outer] = _sunk(inner, outer)
        return known[outer]

    def buried(self, a: int, b: int) -> float:
        """The share of the surface of solid `a` that is inside of solid `b`; 0 where `b` is open. Of a bolt through a
        plate no corner is in the plate."""
        inner, outer = self._solids[a], self._solids[b]
        return _inside(_on_surface(inner), outer)

    def reaching(self, low: Floats, high: Floats) -> list[int]:
        """The solids whose boxes reach a box, (3,) corners."""
        some = self._spans.reaching(float(low[0]), float(high[0]))
        found = some[(self._low[some] <= high).all(axis=1) & (self._high[some] >= low).all(axis=1)]
        return np.sort(found).tolist()

    def near(self, index: int) -> list[int]:
        """The solids whose boxes reach that of a solid, itself among them."""
        if index not in self._near:
            self._near[index] = self.reaching(self._low[index], self._high[index])
        return self._near[index]

    def pierced(self, index: int, bar: Cyl, radius: float) -> bool:
        """True if a solid's mesh comes within a radius of the axis of a bar, between its ends."""
        u = np.linalg.svd(bar.direction[None, :])[2][1]
        turn = np.stack([u, np.cross(bar.direction, u), bar.direction], axis=1)
        core = fcl.CollisionObject(fcl.Cylinder(radius, 2.0 * bar.half), fcl.Transform(turn, bar.center))
        return bool(fcl.collide(_object_of(self._solids[index]), core, fcl.CollisionRequest(), fcl.CollisionResult()))

    def touching(self, a: int, b: int) -> bool:
        """True within the tolerance (boxes first)."""
        sa, sb = self._solids[a], self._solids[b]
        apart = np.maximum(sa.low - sb.high, sb.low - sa.high).max()
        return bool(apart <= self._tolerance) and self.distance(min(a, b), max(a, b)) <= self._tolerance


@remembered
def touch_of(assembly: Assembly, tolerance: float) -> Touch:
    """The distances of all parts of an assembly."""
    return Touch(solids_of(assembly), tolerance)


_objects: weakref.WeakKeyDictionary[Part, tuple[Shape, Any]] = weakref.WeakKeyDictionary()
_distances: weakref.WeakKeyDictionary[Solid, weakref.WeakKeyDictionary[Solid, float]] = weakref.WeakKeyDictionary()
_shares: weakref.WeakKeyDictionary[Solid, weakref.WeakKeyDictionary[Solid, float]] = weakref.WeakKeyDictionary()
"""What was measured of solids that are still in use: it is the same with every contact tolerance."""


def _object_of(solid: Solid) -> Any:
    """A solid as the collision library wants it."""
    known = _objects.get(solid.part)
    if known is None or known[0] is not solid.shape:
        model = fcl.BVHModel()
        triangles = solid.shape.mesh.triangles
        model.beginModel(len(solid.points), len(triangles))
        model.addSubModel(np.ascontiguousarray(solid.points), np.ascontiguousarray(triangles))
        model.endModel()
        known = _objects[solid.part] = (solid.shape, fcl.CollisionObject(model))
    return known[1]


def _distance(first: Any, second: Any) -> float:
    if fcl.collide(first, second, fcl.CollisionRequest(), fcl.CollisionResult()):
        return 0.0
    return max(0.0, float(fcl.distance(first, second, fcl.DistanceRequest(), fcl.DistanceResult())))


def _sunk(inner: Solid, outer: Solid) -> float:
    return _inside(np.concatenate([inner.center[None], inner.points[:: max(1, len(inner.points) // SAMPLES)]]), outer)


def _on_surface(solid: Solid) -> Floats:
    """(n, 3) points of a solid's surface, each for as much of it as every other."""
    corners = solid.points[solid.shape.mesh.triangles]
    area = np.cumsum(np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1))
    at = np.searchsorted(area, (np.arange(PATCHES) + 0.5) / PATCHES * area[-1])
    return np.asarray(corners[at].mean(axis=1))


def _inside(points: Floats, outer: Solid) -> float:
    """The share of points (n, 3) that is inside of a solid; 0 where it is open."""
    if not outer.shape.closed:
        return 0.0
    within = np.zeros(len(points))
    beside = ((points >= outer.low) & (points <= outer.high)).all(axis=1)
    corners = outer.points[outer.shape.mesh.triangles] if beside.any() else np.zeros((0, 3, 3))
    for k in np.flatnonzero(beside):
        within[k] = min(1.0, abs(float(winding(points[k : k + 1], corners)[0])))
    return float(np.mean(within))
