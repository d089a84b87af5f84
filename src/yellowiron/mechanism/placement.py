"""The aligned CAD model in the machine frame: which parts a body has, and their features, points and facets there."""

from __future__ import annotations

import weakref
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from yellowiron.mechanism.declared import DeclaredAxis, declared_axes
from yellowiron.model.alignment import Alignment, Vector
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats, Shape
from yellowiron.model.template import Role, Template
from yellowiron.support.caching.remembered import remembered

Name = TypeVar("Name", str, str | None)

_ROUND = 1e-4
"""Relative difference of two scales up to which a scaled cylinder is still one: transforms in single precision, one
over the other, are off by 1e-6 to 3e-5 in open models of strangers; what is squeezed there is by 0.1 and more."""


@dataclass(frozen=True, eq=False)
class Features:
    """Cylinder features of several parts, one row each, machine frame, metres.

    `center` (n, 3) is midway along the axis, `direction` (n, 3) a unit vector; `length`, `radius`, `area` (n,);
    `inner` marks bores, `exact` those of B-rep surfaces; `part` (n,) indexes `Placement.parts`.
    """

    center: Floats
    direction: Floats
    radius: Floats
    length: Floats
    area: Floats
    inner: NDArray[np.bool_]
    exact: NDArray[np.bool_]
    part: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.radius)

    def take(self, rows: NDArray[np.bool_] | NDArray[np.int64]) -> Features:
        """Those rows only."""
        return Features(**{name: getattr(self, name)[rows] for name in _COLUMNS})


_COLUMNS = ("center", "direction", "radius", "length", "area", "inner", "exact", "part")


def join(many: Iterable[Features]) -> Features:
    """Features of several parts one after the other."""
    tables = [_NO_FEATURES, *many]
    return Features(**{name: np.concatenate([getattr(t, name) for t in tables]) for name in _COLUMNS})


_NO_FEATURES = Features(
    center=np.zeros((0, 3)),
    direction=np.zeros((0, 3)),
    radius=np.zeros(0),
    length=np.zeros(0),
    area=np.zeros(0),
    inner=np.zeros(0, dtype=bool),
    exact=np.zeros(0, dtype=bool),
    part=np.zeros(0, dtype=np.int64),
)


@dataclass(frozen=True, eq=False)
class Placement:
    """The parts that move with some body, placed in the machine frame. `transforms` (n, 4, 4) take a shape's frame
    there.

    `bodies` and `roles` give each part's body and role; `axes`, of joints without a pin, the alignment's axis (a point
    and a unit vector), `by_hand` those that a person gave, whatever is drawn; `declared` are the joints that the CAD
    file declares; what is computed from a part is kept for the next caller.
    """

    parts: tuple[Part, ...]
    shapes: tuple[Shape, ...]
    transforms: Floats
    bodies: tuple[str, ...]
    roles: tuple[str | None, ...]
    axes: Mapping[str, tuple[Floats, Floats]] = field(default_factory=dict)
    by_hand: frozenset[str] = frozenset()
    declared: tuple[DeclaredAxis, ...] = ()
    _features: dict[int, Features] = field(default_factory=dict)
    _joined: dict[tuple[int, ...], Features] = field(default_factory=dict)
    _points: dict[int, Floats] = field(default_factory=dict)
    _planes: dict[int, tuple[Floats, Floats, Floats]] = field(default_factory=dict)
    _boxes: list[tuple[Floats, Floats]] = field(default_factory=list)

    def stands_as(self, other: Placement) -> bool:
        """Whether another has the same parts in the same places, whatever bodies they are of."""
        same = len(self.parts) == len(other.parts) and all(a is b for a, b in zip(self.parts, other.parts, strict=True))
        return same and np.array_equal(self.transforms, other.transforms)

    def rows_of_body(self, body: str) -> tuple[int, ...]:
        """Rows of the parts that move with a body, in CAD order."""
        return self._by_body.get(body, ())

    def rows_of_role(self, role: str) -> tuple[int, ...]:
        """Rows of the parts that play exactly this role, in CAD order."""
        return self._by_role.get(role, ())

    @cached_property
    def _by_body(self) -> dict[str, tuple[int, ...]]:
        return _rows(self.bodies)

    @cached_property
    def _by_role(self) -> dict[str | None, tuple[int, ...]]:
        return _rows(self.roles)

    def has_body(self, body: str) -> bool:
        """Whether any part moves with that body."""
        return body in self.bodies

    def features(self, rows: Iterable[int]) -> Features:
        """Cylinder features of those parts, machine frame."""
        wanted = tuple(rows)
        if wanted not in self._joined:
            self._joined[wanted] = join(self._features_of(row) for row in wanted)
        return self._joined[wanted]

    def spheres(self, row: int) -> list[tuple[Floats, float, bool]]:
        """Balls and sockets of one part, machine frame: middle (3,), radius, whether it is a socket."""
        matrix = self.transforms[row]
        scale = abs(float(np.linalg.det(matrix[:3, :3]))) ** (1 / 3)
        return [
            (matrix[:3, :3] @ np.array(s.center) + matrix[:3, 3], s.radius * scale, s.inner)
            for s in self.shapes[row].spheres
        ]

    def points(self, row: int) -> Floats:
        """(n, 3) mesh points of one part, machine frame."""
        if row not in self._points:
            matrix = self.transforms[row]
            self._points[row] = self.shapes[row].mesh.points @ matrix[:3, :3].T + matrix[:3, 3]
        return self._points[row]

    @property
    def boxes(self) -> tuple[Floats, Floats]:
        """Least and greatest corners (n, 3) of the parts, machine frame; infinite of a part without points."""
        if not self._boxes:
            corners = np.full((2, len(self.parts), 3), np.inf)
            for row in range(len(self.parts)):
                if len(points := self.points(row)):
                    corners[:, row] = points.min(axis=0), points.max(axis=0)
            self._boxes.append((corners[0], corners[1]))
        return self._boxes[0]

    def diagonal(self, rows: Iterable[int]) -> float:
        """Metres across the box around those parts; 0 without any."""
        some = np.fromiter(rows, dtype=np.int64)
        low, high = (corners[some] for corners in self.boxes)
        there = np.isfinite(low).all(axis=1)
        return float(np.linalg.norm(high[there].max(axis=0) - low[there].min(axis=0))) if there.any() else 0.0

    def planes(self, row: int) -> tuple[Floats, Floats, Floats]:
        """Planar faces of one part, else its facets, machine frame: points (m, 3), unit normals (m, 3), areas (m,)."""
        if row not in self._planes:
            self._planes[row] = self._planes_of(row)
        return self._planes[row]

    def _planes_of(self, row: int) -> tuple[Floats, Floats, Floats]:
        planes, matrix = self.shapes[row].planes, self.transforms[row]
        if not planes:
            return self.facets(row)
        linear = matrix[:3, :3]
        normal = np.array([p.normal for p in planes]) @ np.linalg.inv(linear)
        stretch = np.linalg.norm(normal, axis=1)
        area = np.array([p.area for p in planes]) * stretch * abs(np.linalg.det(linear))
        return np.array([p.point for p in planes]) @ linear.T + matrix[:3, 3], normal / stretch[:, None], area

    def points_of(self, rows: Iterable[int]) -> Floats:
        """(n, 3) mesh points of several parts, machine frame."""
        return np.concatenate([np.zeros((0, 3)), *(self.points(row) for row in rows)])

    def facets(self, row: int) -> tuple[Floats, Floats, Floats]:
        """Facets of one part, machine frame: centres (m, 3), outward unit normals (m, 3), areas (m,)."""
        corners = self.points(row)[self.shapes[row].mesh.triangles]
        cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        if np.linalg.det(self.transforms[row][:3, :3]) < 0.0:
            cross = -cross
        twice = np.linalg.norm(cross, axis=1)
        good = twice > 0.0
        return corners[good].mean(axis=1), cross[good] / twice[good, None], 0.5 * twice[good]

    def ids(self, rows: Iterable[int]) -> list[str]:
        """Ids of those parts, each once, in CAD order."""
        return [self.parts[row].id for row in sorted({int(r) for r in rows})]

    def _features_of(self, row: int) -> Features:
        if row not in self._features:
            self._features[row] = _place(self.shapes[row], self.transforms[row], row)
        return self._features[row]


def place(assembly: Assembly, template: Template, alignment: Alignment) -> tuple[Placement, list[Finding]]:
    """Every part that the alignment gives a body, in the machine frame. A body unknown to the template is a finding."""
    bodies = {role.name for role in template.roles if role.rigid}
    assigned = {a.part: a for a in alignment.parts if a.body is not None}
    strays = [a for a in assigned.values() if a.body not in bodies]
    hint = "Correct its body in the alignment."
    findings = [
        Finding("MEC007", "error", a.part, f"The template has no body '{a.body}': the part is left out.", hint)
        for a in strays
    ]
    kept = [p for p in assembly.parts if p.id in assigned and assigned[p.id].body in bodies]
    findings += [
        Finding("MEC008", "warning", p.id, "The part has no surface: it is left out.", "Check it in the CAD model.")
        for p in kept
        if len(assembly.shape_of(p).mesh.points) == 0
    ]
    kept = [p for p in kept if len(assembly.shape_of(p).mesh.points)]
    placement = Placement(
        parts=tuple(kept),
        shapes=tuple(assembly.shape_of(p) for p in kept),
        transforms=np.array([alignment.frame @ p.transform for p in kept]).reshape(-1, 4, 4),
        bodies=tuple(str(assigned[p.id].body) for p in kept),
        roles=tuple(assigned[p.id].role for p in kept),
        axes={name: _axis(alignment.frame, *axis) for name, axis in alignment.axes.items()},
        by_hand=alignment.by_hand,
        declared=declared_axes(assembly, alignment),
    )
    last = _last.get(assembly)
    if last is not None and last.stands_as(placement):
        # What was computed of parts in these places holds.
        placement = replace(placement, **{name: getattr(last, name) for name in _KEPT})
    _last[assembly] = placement
    return placement, findings


_KEPT = ("_features", "_joined", "_points", "_planes", "_boxes")
"""What a placement computes of parts by their places alone, whatever bodies they are of."""
_last: weakref.WeakKeyDictionary[Assembly, Placement] = weakref.WeakKeyDictionary()
"""How the parts of an assembly that is still in use were placed last."""


def _axis(frame: Floats, point: Vector, direction: Vector) -> tuple[Floats, Floats]:
    """An axis through a rigid transform (4, 4)."""
    return frame[:3, :3] @ np.array(point) + frame[:3, 3], frame[:3, :3] @ np.array(direction)


def ancestors(template: Template, role: str | None) -> tuple[Role, ...]:
    """The role and its ancestors, nearest first; empty for a role the template does not have."""
    by_name = {r.name: r for r in template.roles}
    chain: list[Role] = []
    while role is not None and role in by_name and len(chain) <= len(by_name):
        chain.append(by_name[role])
        role = by_name[role].parent
    return tuple(chain)


def _rows(names: Sequence[Name]) -> dict[Name, tuple[int, ...]]:
    found: dict[Name, list[int]] = {}
    for row, name in enumerate(names):
        found.setdefault(name, []).append(row)
    return {name: tuple(rows) for name, rows in found.items()}


def _place(shape: Shape, matrix: Floats, row: int) -> Features:
    """A shape's features through its transform; those that a scale makes elliptic are dropped."""
    if not shape.cylinders:
        return _NO_FEATURES
    linear = matrix[:3, :3]
    center, axes, radius, length, arc, inner, exact = _columns(shape)
    direction = axes @ linear.T
    stretch = np.linalg.norm(direction, axis=1)
    unit = direction / stretch[:, None]
    scale, round_ = _cross_scale(axes, linear, unit)
    placed = Features(
        center=center @ linear.T + matrix[:3, 3],
        direction=unit,
        radius=radius * scale,
        length=length * stretch,
        area=radius * scale * arc * length * stretch,
        inner=inner,
        exact=exact,
        part=np.full(len(radius), row, dtype=np.int64),
    )
    return placed if round_.all() else placed.take(round_)


@remembered
def _columns(shape: Shape) -> tuple[Floats, Floats, Floats, Floats, Floats, NDArray[np.bool_], NDArray[np.bool_]]:
    """Centres and directions (n, 3), radii, lengths, arcs (n,), whether inner and exact, of a shape's cylinders."""
    names = ("center", "direction", "radius", "length", "arc", "inner", "exact")
    center, axes, radius, length, arc, inner, exact = (
        np.array([getattr(c, n) for c in shape.cylinders]) for n in names
    )
    return center, axes, radius, length, arc, inner, exact


def _cross_scale(axes: Floats, linear: Floats, placed: Floats) -> tuple[Floats, NDArray[np.bool_]]:
    """How a linear map scales the cross-section of cylinders about `axes` (n, 3): (scale (n,), still a cylinder
    (n,))."""
    if np.abs(linear.T @ linear - np.eye(3)).max() < 1e-9:
        return np.ones(len(axes)), np.ones(len(axes), dtype=bool)
    helper = np.eye(3)[np.argmin(np.abs(axes), axis=1)]
    u = np.cross(axes, helper)
    u /= np.linalg.norm(u, axis=1)[:, None]
    v = np.cross(axes, u)
    mapped_u, mapped_v = u @ linear.T, v @ linear.T
    long_u, long_v = np.linalg.norm(mapped_u, axis=1), np.linalg.norm(mapped_v, axis=1)
    size = np.maximum(long_u, long_v)
    skew = np.maximum.reduce(
        [
            np.abs(long_u - long_v),
            np.abs(np.sum(mapped_u * mapped_v, axis=1)) / size,
            np.abs(np.sum(mapped_u * placed, axis=1)),
            np.abs(np.sum(mapped_v * placed, axis=1)),
        ]
    )
    return 0.5 * (long_u + long_v), skew <= _ROUND * size
