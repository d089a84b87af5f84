"""The aligned CAD model in the machine frame: which parts a body has, and their features, points and facets there."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from yellowiron.mechanism.declared import DeclaredAxis, declared_axes
from yellowiron.model.alignment import Alignment, Vector
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats, Shape
from yellowiron.model.template import Role, Template

_ROUND = 1e-6
"""Relative difference of two scales up to which a scaled cylinder is still one."""


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
    _points: dict[int, Floats] = field(default_factory=dict)

    def rows_of_body(self, body: str) -> tuple[int, ...]:
        """Rows of the parts that move with a body, in CAD order."""
        return tuple(i for i, name in enumerate(self.bodies) if name == body)

    def rows_of_role(self, role: str) -> tuple[int, ...]:
        """Rows of the parts that play exactly this role, in CAD order."""
        return tuple(i for i, name in enumerate(self.roles) if name == role)

    def has_body(self, body: str) -> bool:
        """Whether any part moves with that body."""
        return body in self.bodies

    def features(self, rows: Iterable[int]) -> Features:
        """Cylinder features of those parts, machine frame."""
        return join(self._features_of(row) for row in rows)

    def points(self, row: int) -> Floats:
        """(n, 3) mesh points of one part, machine frame."""
        if row not in self._points:
            matrix = self.transforms[row]
            self._points[row] = self.shapes[row].mesh.points @ matrix[:3, :3].T + matrix[:3, 3]
        return self._points[row]

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
    return placement, findings


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


def _place(shape: Shape, matrix: Floats, row: int) -> Features:
    """A shape's features through its transform; those that a scale makes elliptic are dropped."""
    if not shape.cylinders:
        return _NO_FEATURES
    linear = matrix[:3, :3]
    direction = np.array([c.direction for c in shape.cylinders]) @ linear.T
    stretch = np.linalg.norm(direction, axis=1)
    unit = direction / stretch[:, None]
    radius = np.array([c.radius for c in shape.cylinders])
    scale, round_ = _cross_scale(np.array([c.direction for c in shape.cylinders]), linear, unit)
    length = np.array([c.length for c in shape.cylinders])
    arc = np.array([c.arc for c in shape.cylinders])
    return Features(
        center=np.array([c.center for c in shape.cylinders]) @ linear.T + matrix[:3, 3],
        direction=unit,
        radius=radius * scale,
        length=length * stretch,
        area=radius * scale * arc * length * stretch,
        inner=np.array([c.inner for c in shape.cylinders]),
        exact=np.array([c.exact for c in shape.cylinders]),
        part=np.full(len(radius), row, dtype=np.int64),
    ).take(round_)


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
