"""The cylinder, capsule, box or sphere that a shape nearly is: analytic colliders are exact and fast."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from yellowiron.model.geometry import Floats, Shape

MAX_EXCESS = 1.6
"""A primitive stands for a shape if its volume is at most this multiple of the shape's convex hull."""

_FULL_ARC = 1.5 * math.pi
_ENDS = 1e-9


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
    candidates: list[Primitive] = [_sphere(hull_points)]
    for point, direction in _axes(shape, hull_points):
        candidates.extend(_round(hull_points, point, direction))
    candidates.extend(_box(hull_points, rotation) for rotation in _frames(shape))
    best = min(candidates, key=lambda c: c.volume)
    return best if best.volume <= max_excess * hull_volume else None


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
