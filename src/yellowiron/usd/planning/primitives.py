"""The cylinder, capsule, box or sphere that a shape nearly is: analytic colliders are exact and fast."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from yellowiron.model.geometry import Floats, Shape
from yellowiron.model.mechanism import BodyShape
from yellowiron.support.convex.solids import Convex

MAX_EXCESS = 1.6
"""A primitive stands for a shape if its volume is at most this multiple of the shape's convex hull."""

_FULL_ARC = 1.5 * math.pi
_ENDS = 1e-9
_SCALE_TOLERANCE = 1e-6
_FACETS = 48
"""Of a round one's likeness: one of 1 m is 2 mm smaller between its corners."""


@dataclass(frozen=True, eq=False)
class Primitive:
    """An enclosing primitive in the shape's frame, metres. `rotation` (3, 3) takes its axes to the shape's; cylinders
    and capsules lie along its z. `size`: (radius, height) for these (a capsule's height without its caps), (radius,)
    for a sphere, the three edges for a box."""

    kind: Literal["cylinder", "capsule", "box", "sphere"]
    center: Floats
    rotation: Floats
    size: tuple[float, ...]

    @property
    def volume(self) -> float:
        """m³."""
        if self.kind == "box":
            return math.prod(self.size)
        ball = 4.0 / 3.0 * math.pi * self.size[0] ** 3
        if self.kind == "sphere":
            return ball
        tube = math.pi * self.size[0] ** 2 * self.size[1]
        return tube + ball if self.kind == "capsule" else tube

    @classmethod
    def of(cls, shape: BodyShape) -> Primitive:
        """A body's own collider, in the frame that it is told in."""
        if shape.size is None:
            return cls("sphere", np.asarray(shape.center, dtype=np.float64), np.eye(3), (float(shape.radius),))
        return cls("box", np.asarray(shape.center, dtype=np.float64), np.eye(3), shape.size)

    def placed(self, matrix: Floats) -> Primitive | None:
        """It in the frame that `matrix` (4, 4) leads to: its frame stays a proper rotation, since it is its own mirror
        image. None where the matrix scales the axes differently, or shears."""
        linear = matrix[:3, :3]
        scale = abs(float(np.linalg.det(linear))) ** (1.0 / 3.0)
        off = np.abs(linear.T @ linear - scale**2 * np.eye(3)).max()
        if scale <= 0.0 or off > _SCALE_TOLERANCE * scale**2:
            return None
        rotation = linear @ self.rotation / scale
        if np.linalg.det(rotation) < 0.0:
            rotation = rotation * (-1.0, 1.0, 1.0)
        center = linear @ self.center + matrix[:3, 3]
        return Primitive(self.kind, center, rotation, tuple(scale * edge for edge in self.size))

    def surface(self) -> Floats:
        """(n, 3) points on it, of which it is the hull but for its roundness."""
        if self.kind == "box":
            local = np.array(list(itertools.product((-0.5, 0.5), repeat=3))) * self.size
        else:
            radius, height = self.size[0], 0.0 if self.kind == "sphere" else self.size[1]
            turn = np.linspace(0.0, 2.0 * math.pi, _FACETS, endpoint=False)
            ring = np.column_stack([np.cos(turn), np.sin(turn), np.zeros_like(turn)])
            if self.kind == "cylinder":
                rings = [(radius, 0.5 * height), (radius, -0.5 * height)]
            else:
                tilt = np.linspace(0.0, 0.5 * math.pi, _FACETS // 8 + 1)
                half = [(radius * math.cos(t), 0.5 * height + radius * math.sin(t)) for t in tilt.tolist()]
                rings = [*half, *((r, -z) for r, z in half)]
            local = np.concatenate([r * ring + (0.0, 0.0, z) for r, z in rings])
        return np.asarray(local @ self.rotation.T + self.center)


def fit_primitive(shape: Shape, *, max_excess: float = MAX_EXCESS) -> Primitive | None:
    """The smallest enclosing primitive of a shape, or None where even that one is a poor likeness.

    Axes are tried where the shape has fitted cylinders, and along its own frame otherwise.
    """
    points = shape.mesh.points
    if len(points) < 4:
        return None
    hull_points, hull_volume = _convex_hull(points)
    if hull_volume <= 0.0:
        return None
    best = min(_candidates(hull_points, _axes(shape, hull_points), _frames(shape)), key=lambda c: c.volume)
    return best if best.volume <= max_excess * hull_volume else None


def enclosing(solid: Convex, within: float) -> Primitive | None:
    """The smallest primitive around a solid that nowhere stands out of it by more than `within`, metres; None where
    there is none."""
    normals = _large_normals(solid)
    frames = [np.eye(3), *_square(normals)]
    middle = 0.5 * (solid.low + solid.high)
    axes = [(middle, frame[:, k]) for frame in frames for k in range(3)]
    fitting = [c for c in _candidates(solid.corners, axes, frames) if float(solid.beyond(c.surface()).max()) <= within]
    return min(fitting, key=lambda c: c.volume, default=None)


def _large_normals(solid: Convex) -> list[Floats]:
    """Of a solid's largest faces, those of one plane together, largest first."""
    a, b, c = (solid.corners[solid.triangles[:, k]] for k in range(3))
    crossed = np.cross(b - a, c - a)
    areas = np.linalg.norm(crossed, axis=1)
    found: list[tuple[float, Floats]] = []
    for row in np.argsort(-areas, kind="stable").tolist():
        normal = crossed[row] / max(areas[row], 1e-12)
        if all(abs(float(normal @ other)) < 1.0 - 1e-3 for _, other in found):
            same = np.abs(crossed @ normal) > (1.0 - 1e-3) * areas
            found.append((float(areas[same].sum()), normal))
        if len(found) == 6:
            break
    return [normal for _, normal in sorted(found, key=lambda each: -each[0])]


def _square(normals: Iterable[Floats]) -> list[Floats]:
    """Right-handed frames of two normals each, the second made square to the first."""
    frames = []
    for first, second in itertools.combinations(normals, 2):
        side = second - (second @ first) * first
        length = float(np.linalg.norm(side))
        if length > 0.5:
            side = side / length
            frames.append(np.column_stack([first, side, np.cross(first, side)]))
    return frames


def _candidates(points: Floats, axes: Iterable[tuple[Floats, Floats]], frames: Iterable[Floats]) -> list[Primitive]:
    """The sphere, cylinders, capsules and boxes around points (n, 3)."""
    made: list[Primitive] = [_sphere(points)]
    for point, direction in axes:
        made.extend(_round(points, point, direction))
    made.extend(_box(points, rotation) for rotation in frames)
    return made


def _convex_hull(points: Floats) -> tuple[Floats, float]:
    """Hull corners and volume; a flat cloud has none."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(points)
    except QhullError:
        return points, 0.0
    return points[hull.vertices], float(hull.volume)


def _axes(shape: Shape, points: Floats) -> list[tuple[Floats, Floats]]:
    """Candidate axes: of the full cylinders, larger first; else the frame's own through the middle."""
    full = sorted((c for c in shape.cylinders if c.arc >= _FULL_ARC), key=lambda c: -c.area)[:4]
    if full:
        return [(np.asarray(c.point), np.asarray(c.direction)) for c in full]
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    return [(middle, axis) for axis in np.eye(3)]


def _frames(shape: Shape) -> list[Floats]:
    """Candidate box orientations: the shape's own frame, and that of its two largest perpendicular faces."""
    frames = [np.eye(3)]
    faces = sorted(shape.planes, key=lambda p: -p.area)[:12]
    for first, second in itertools.combinations((np.asarray(f.normal) for f in faces), 2):
        if abs(first @ second) < 1e-6:
            frames.append(np.column_stack([first, second, np.cross(first, second)]))
            break
    return frames


def _round(points: Floats, point: Floats, direction: Floats) -> list[Primitive]:
    """The cylinder and the capsule about an axis."""
    offset = points - point
    along = offset @ direction
    radial = np.linalg.norm(offset - along[:, None] * direction, axis=1)
    radius = float(radial.max())
    rotation = _rotation_to(direction)
    lower, upper = float(along.min()), float(along.max())
    made = [Primitive("cylinder", point + 0.5 * (lower + upper) * direction, rotation, (radius, upper - lower))]
    cap = np.sqrt(np.maximum(radius**2 - radial**2, 0.0))
    first, last = float((along + cap).min()), float((along - cap).max())
    if last - first > _ENDS:
        made.append(Primitive("capsule", point + 0.5 * (first + last) * direction, rotation, (radius, last - first)))
    return made


def _box(points: Floats, rotation: Floats) -> Primitive:
    local = points @ rotation
    lower, upper = local.min(axis=0), local.max(axis=0)
    size = tuple(float(v) for v in upper - lower)
    return Primitive("box", rotation @ (0.5 * (lower + upper)), rotation, size)


def _sphere(points: Floats) -> Primitive:
    center = 0.5 * (points.min(axis=0) + points.max(axis=0))
    return Primitive("sphere", center, np.eye(3), (float(np.linalg.norm(points - center, axis=1).max()),))


def _rotation_to(direction: Floats) -> Floats:
    """A rotation whose third column is `direction`."""
    helper = np.eye(3)[int(np.argmin(np.abs(direction)))]
    first = np.cross(helper, direction)
    first /= np.linalg.norm(first)
    return np.column_stack([first, np.cross(direction, first), direction])
