"""A body as its joints see it: points all over its surface, and what is round about a direction."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from yellowiron.alignment.axes.outlines import OutlineCircle, outline_circles
from yellowiron.alignment.axes.values import Round, plane_of
from yellowiron.alignment.features.contacts import inside
from yellowiron.alignment.features.solids import Cyl, Solid
from yellowiron.alignment.spans import Spans
from yellowiron.model.geometry import Floats

SPACING = 0.008
"""Points on a surface are this share of the machine's size apart."""
PIVOT = (0.0015, 0.04)
"""Radii of what may be a pivot's pin, bore, boss or round end, in machine sizes."""
LEAN = math.cos(math.radians(5.0))
"""Cosine up to which a round face is about a direction: those fitted to few triangles lean."""
LEAST_ARC = 1.2
"""Radians that a round face covers at least."""


@dataclass(frozen=True, eq=False)
class Body:
    """Solids that move as one, in a machine of `size` metres. What is computed is kept for the next caller."""

    name: str
    solids: tuple[Solid, ...]
    size: float
    _rounds: dict[tuple[float, ...], list[Round]] = field(default_factory=dict)
    _flats: dict[tuple[float, ...], tuple[Floats, ...]] = field(default_factory=dict)
    _spans: dict[tuple[float, ...], Spans] = field(default_factory=dict)
    _outlines: dict[tuple[float, ...], tuple[Floats, Floats]] = field(default_factory=dict)

    @cached_property
    def low(self) -> Floats:
        """The lower corner of its box."""
        return np.asarray(np.min([s.low for s in self.solids], axis=0), dtype=np.float64)

    @cached_property
    def high(self) -> Floats:
        """The upper corner of its box."""
        return np.asarray(np.max([s.high for s in self.solids], axis=0), dtype=np.float64)

    @cached_property
    def samples(self) -> Floats:
        """(n, 3) points all over its surface."""
        return np.concatenate([surface_points(s, SPACING * self.size) for s in self.solids])

    @cached_property
    def tree(self) -> cKDTree:
        """Of `samples`."""
        return cKDTree(self.samples)

    def nearest(self, points: Floats) -> tuple[Floats, NDArray[np.intp]]:
        """Of points (n, 3): how far each is from its surface, as finely as that is sampled, and the sample there."""
        distance, index = self.tree.query(points)
        return np.asarray(distance, dtype=np.float64), np.asarray(index, dtype=np.intp)

    def distance(self, points: Floats) -> Floats:
        """(n,) how far points (n, 3) are from its surface, as finely as that is sampled."""
        return self.nearest(points)[0]

    def covered(self, center: Floats, ring: Floats, span: Floats, direction: Floats, plane: Floats) -> Floats:
        """(n,) in [0, 1]: how much of rings around places (n, 2) in the plane across a direction, of radii `ring` (n,),
        its surface covers within `span` (n, 2) along the direction."""
        found = np.zeros(len(center))
        if not len(center):
            return found
        key = _key(direction)
        if key not in self._flats:
            corners = np.concatenate([s.points[s.shape.mesh.triangles] for s in self.solids])
            flat, height = corners @ plane.T, corners @ direction
            self._flats[key] = (
                flat, flat.min(axis=1), flat.max(axis=1), height.min(axis=1), height.max(axis=1)
            )  # fmt: skip
            self._spans[key] = Spans(flat[:, :, 0].min(axis=1), flat[:, :, 0].max(axis=1))
        flat, low, high, bottom, top = self._flats[key]
        turn = np.linspace(0.0, 2 * math.pi, 8, endpoint=False)
        circle = np.stack([np.cos(turn), np.sin(turn)], axis=1)
        for k in range(len(center)):
            some = self._spans[key].reaching(center[k, 0] - ring[k], center[k, 0] + ring[k])
            near = (low[some] <= center[k] + ring[k]).all(axis=1) & (high[some] >= center[k] - ring[k]).all(axis=1)
            near &= (bottom[some] <= span[k, 1]) & (top[some] >= span[k, 0])
            if near.any():
                found[k] = inside(center[k] + ring[k] * circle, flat[some[near]]).mean()
        return found

    def outline(self, direction: Floats, plane: Floats) -> tuple[Floats, Floats]:
        """Unit vectors (24, 2) all around in the plane across a direction, and how far its surface is along them."""
        key = _key(direction)
        if key not in self._outlines:
            turn = np.linspace(0.0, 2 * math.pi, 24, endpoint=False)
            ways = np.stack([np.cos(turn), np.sin(turn)], axis=1)
            self._outlines[key] = (ways, (self.samples @ plane.T @ ways.T).max(axis=0))
        return self._outlines[key]

    def rounds(
        self, direction: Floats, radii: tuple[float, float] = PIVOT, *, box: tuple[Floats, Floats] | None = None,
        outlines: bool = True,
    ) -> list[Round]:  # fmt: skip
        """What is round about a unit direction, with radii in that range of machine sizes, of its solids that reach
        into a box (low, high); without `outlines` only faces that were recognised."""
        least, most = radii[0] * self.size, radii[1] * self.size
        found = []
        for solid in self.solids:
            if box is not None and ((solid.low > box[1]).any() or (solid.high < box[0]).any()):
                continue
            key = (solid.index, *_key(direction), *radii, outlines)
            if key not in self._rounds:
                self._rounds[key] = rounds_of(solid, direction, least, most, outlines=outlines)
            found += self._rounds[key]
        return found


def _key(direction: Floats) -> tuple[float, ...]:
    """What is the same for directions that are, to rounding."""
    return tuple(np.round(direction, 6).tolist())


def surface_points(solid: Solid, spacing: float) -> Floats:
    """(n, 3) corners of a solid's triangles, and points about `spacing` apart on those that are larger."""
    triangles = solid.shape.mesh.triangles
    corners = solid.points[triangles]
    area = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    longest = np.max([np.linalg.norm(corners[:, k] - corners[:, k - 1], axis=1) for k in range(3)], axis=0)
    steps = np.clip(np.ceil(longest / spacing), 1, 24).astype(np.int64)
    steps[area < 0.1 * spacing * spacing] = 1
    found = [solid.points[np.unique(triangles)]]
    for n in np.unique(steps[steps > 1]).tolist():
        i, j = np.divmod(np.arange((n + 1) ** 2), n + 1)
        inside = i + j <= n
        i, j = i[inside] / n, j[inside] / n
        weights = np.stack([1 - i - j, i, j], axis=1)
        found.append(np.einsum("wk,mkx->mwx", weights, corners[steps == n]).reshape(-1, 3))
    points = np.concatenate(found)
    cell = np.round(points / (0.5 * spacing)).astype(np.int64)
    cell -= cell.min(axis=0)
    count = cell.max(axis=0) + 1
    # One number a cell: rows are slow to compare.
    cells = np.unique((cell[:, 0] * count[1] + cell[:, 1]) * count[2] + cell[:, 2], return_index=True)[1]
    return np.asarray(points[np.sort(cells)], dtype=np.float64)


def rounds_of(solid: Solid, direction: Floats, least: float, most: float, *, outlines: bool = True) -> list[Round]:
    """What is round about a unit direction in a solid, with radii between `least` and `most` metres: its cylinders, its
    bosses, and circles in its outline."""
    found = []
    for faces, rough in ((solid.cylinders, False), (solid.knuckles, True)):
        for face in faces:
            if least < face.radius < most and abs(float(face.direction @ direction)) > LEAN and face.arc > LEAST_ARC:
                found.append(_round(face, solid, rough=rough))
    if not outlines or (solid.shape.exact and solid.cylinders):
        return found
    known = [(r.face.center, r.face.radius, r.face.inner) for r in found if r.what != "boss"]
    plane = plane_of(direction)
    circles = outline_circles(
        solid.points, solid.shape.mesh.triangles, direction, plane, least=least, most=most
    )  # fmt: skip
    for circle in circles:
        center = circle.center @ plane + 0.5 * (circle.low + circle.high) * direction
        new = all(
            inner != circle.inner
            or abs(radius - circle.radius) > 0.1 * radius
            or float(np.linalg.norm((middle - center) @ plane.T)) > 0.1 * radius
            for middle, radius, inner in known
        )
        if new:
            found.append(_outline_round(circle, center, direction, solid))
    return found


def _round(face: Cyl, solid: Solid, *, rough: bool) -> Round:
    """A cylindrical face, or a boss that is nearly one (`rough`)."""
    share = min(1.0, face.arc / (2 * math.pi))
    if face.full:
        short = 2 * face.half < 8 * face.radius
        quality, what = (1.0, "bore") if face.inner else (0.8, "round part")
        quality *= 1.0 if short or not face.inner else 0.6
        spread = 0.005 * face.radius
    else:
        quality, what = (0.15 + 0.7 * share, "bore") if face.inner else (0.35 + 0.5 * share, "round end")
        spread = _across(face.arc, 0.01 * face.radius)
    slim = min(1.0, 0.5 + face.half / face.radius)
    quality *= slim
    if rough:
        quality, what, spread = 0.7 * quality, "boss", 5 * spread
    elif not face.inner and solid.shaft is not None and face.full:
        quality, what = 1.0 * slim, "pin"
    return Round(face, spread, quality, what, solid.index)


def _across(arc: float, error: float) -> float:
    """The uncertainty of a circle's centre from an arc of it whose points are off by `error`."""
    return error / max(0.05, math.sin(min(arc, math.pi) / 2) ** 2)


def _outline_round(circle: OutlineCircle, center: Floats, direction: Floats, solid: Solid) -> Round:
    face = Cyl(
        center, direction, circle.radius, 0.5 * (circle.high - circle.low), circle.arc, circle.inner
    )  # fmt: skip
    plain = _round(face, solid, rough=False)
    spread = _across(circle.arc, 0.01 * circle.radius + circle.rms)
    few = min(1.0, 0.4 + 0.1 * circle.corners)
    return replace(plain, spread=spread, quality=0.8 * few * plain.quality, what=f"{plain.what} of few sides")


def axis_segment(face: Cyl, beyond: float = 0.0) -> Floats:
    """(5, 3) points along the axis of a round face, from end to end and `beyond`."""
    steps = np.linspace(-1.0, 1.0, 5)[:, None] * (face.half + beyond)
    return np.asarray(face.center + steps * face.direction, dtype=np.float64)


def bodies_of(solids: Sequence[Solid], labels: Iterable[tuple[str, Sequence[int]]], size: float) -> dict[str, Body]:
    """The bodies with at least one solid, by name."""
    return {name: Body(name, tuple(solids[i] for i in rows), size) for name, rows in labels if len(rows)}
