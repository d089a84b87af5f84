"""Parts as the aligner sees them: world features, boxes, symmetry. Metres, CAD frame."""

from __future__ import annotations

import contextlib
import functools
import math
import weakref
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import CylinderFeature, Floats, Ints, PlaneFeature, Shape
from yellowiron.support.caching.remembered import remembered
from yellowiron.support.vectors import distance_from_line, triple

FULL_ARC = 0.6 * 2 * math.pi
"""Radians around: more is taken for a whole cylinder (bores and shafts are often split, slotted or cross-drilled)."""
MOST_TILT = 0.03
"""Radians by which the axis of a coarse round face may be tilted at most: what is flat beside it tells it better."""
SLIGHT = 5e-4
"""Volume over the cube of the diagonal: a hose has less, a plate or a bar more."""
FEW_POINTS = 500
"""Of so many points, all are looked at for where a shape ends; of more, the outermost ones."""


@dataclass(frozen=True, eq=False)
class Cyl:
    """A cylindrical face in the CAD frame: `center` midway on its axis, unit `direction`, half length `half`; its
    radius and axis may be off by `error` metres."""

    center: Floats
    direction: Floats
    radius: float
    half: float
    arc: float
    inner: bool
    error: float = 0.0

    @property
    def full(self) -> bool:
        """True where it goes (nearly) all the way round."""
        return self.arc >= FULL_ARC

    def interval(self, origin: Floats, direction: Floats) -> tuple[float, float]:
        """Its span along a parallel line through `origin`."""
        middle = float((self.center - origin) @ direction)
        return middle - self.half, middle + self.half

    def off(self, point: Floats) -> float:
        """Distance of a point from its axis, metres."""
        return distance_from_line(point, self.center, self.direction)


@dataclass(frozen=True, eq=False)
class Ball:
    """A ball or (`inner`) a socket in the CAD frame."""

    center: Floats
    radius: float
    inner: bool


@dataclass(frozen=True, eq=False)
class Solid:
    """One part, ready to be reasoned about. `axis` is the cylinder whose axis the part is symmetric about, or None;
    `shaft` the solid bar it mainly is (a pin, a bolt, a rod), or None; `reach` its greatest radius about `axis` or
    `shaft`, and [`start`, `end`] its span along it, measured from that cylinder's centre; `knuckles` are bosses rounded
    by eye."""

    index: int
    part: Part
    shape: Shape
    points: Floats
    low: Floats
    high: Floats
    center: Floats
    volume: float
    cylinders: tuple[Cyl, ...]
    plane_points: Floats
    plane_normals: Floats
    axis: Cyl | None
    shaft: Cyl | None
    reach: float = 0.0
    start: float = 0.0
    end: float = 0.0
    knuckles: tuple[Cyl, ...] = ()
    balls: tuple[Ball, ...] = ()

    @functools.cached_property
    def size(self) -> float:
        """Diagonal of its box."""
        return float(np.linalg.norm(self.high - self.low))

    @property
    def slight(self) -> bool:
        """True for hoses, rails and sheets."""
        return self.volume < SLIGHT * self.size**3

    @functools.cached_property
    def surface(self) -> float:
        """Its area in the CAD frame, m²."""
        return self.shape.area * abs(float(np.linalg.det(self.part.transform[:3, :3]))) ** (2 / 3)

    @property
    def line(self) -> Cyl | None:
        """The line it is turned about: that of its symmetry, else of its shaft."""
        return self.axis if self.axis is not None else self.shaft

    @property
    def hole(self) -> float:
        """Radius of the largest full bore about its axis of symmetry (0: none)."""
        if self.axis is None:
            return 0.0
        return max(
            (c.radius for c in self.cylinders if c.inner and c.full and coaxial(c, self.axis, 0.02)), default=0.0
        )

    def span(self, origin: Floats, direction: Floats) -> tuple[float, float]:
        """Its span along a line through `origin`."""
        along = (self.points[_outermost(self.shape)] - origin) @ direction
        return float(along.min()), float(along.max())


@remembered
def _outermost(shape: Shape) -> Ints | slice:
    """The points of a shape that nothing of it is outside of: where it ends in any direction."""
    points = shape.mesh.points
    if len(points) > FEW_POINTS:
        with contextlib.suppress(QhullError):  # a flat one has none
            return np.asarray(ConvexHull(points).vertices, dtype=np.int64)
    return slice(None)


@dataclass(frozen=True, eq=False)
class Patch:
    """The triangles of a shape that lie on one of its planes, in the shape's frame: corners (m, 3, 3)."""

    corners: Floats
    area: float


def coaxial(a: Cyl, b: Cyl, slack: float, tolerance: float = 0.0) -> bool:
    """True if two cylinders share an axis within `slack` times the smaller radius, or `tolerance` metres."""
    if not parallel(a, b, 1 - 5e-6 * (1 + 100 * slack)):
        return False
    return b.off(a.center) <= max(tolerance, slack * min(a.radius, b.radius)) + a.error + b.error


def parallel(a: Cyl, b: Cyl, cosine: float) -> bool:
    """True if two axes are parallel within an angle of that cosine, and what the cylinders' errors tilt them by."""
    found = abs(float(a.direction @ b.direction))
    if found >= cosine or not (a.error or b.error):
        return found >= cosine
    tilt = sum(min(MOST_TILT, c.error / max(c.half, c.error)) for c in (a, b))
    return math.acos(min(1.0, found)) <= math.acos(cosine) + tilt


def size_of(solids: Sequence[Solid]) -> float:
    """The machine's size, metres: the diagonal of the box around its solids, of which there is at least one."""
    return float(np.linalg.norm(np.max([s.high for s in solids], axis=0) - np.min([s.low for s in solids], axis=0)))


_known: weakref.WeakKeyDictionary[Assembly, tuple[Solid, ...]] = weakref.WeakKeyDictionary()
"""What was computed of assemblies that are still in use: every contact tolerance looks at the same solids."""


def solids_of(assembly: Assembly) -> tuple[Solid, ...]:
    """Every part with a mesh, in an order that depends on shape and place alone (then on the id)."""
    if assembly not in _known:
        _known[assembly] = _solids(assembly)
    return _known[assembly]


def _solids(assembly: Assembly) -> tuple[Solid, ...]:
    solids = []
    planes: dict[str, tuple[PlaneFeature, ...]] = {}
    for part in assembly.parts:
        shape = assembly.shape_of(part)
        if len(shape.mesh.points) == 0:
            continue
        if part.shape not in planes:
            planes[part.shape] = shape.planes or flat_faces(shape)
        solids.append((part, shape, assembly.points_of(part), planes[part.shape]))
    middle = np.mean([p.mean(axis=0) for _, _, p, _ in solids], axis=0) if solids else np.zeros(3)

    def rank(item: tuple[Part, Shape, Floats, tuple[PlaneFeature, ...]]) -> tuple[float, float, str]:
        part, shape, points, _ = item
        away = float(np.linalg.norm(0.5 * (points.min(axis=0) + points.max(axis=0)) - middle))
        return (-round(shape.area, 5), round(away, 4), part.id)

    return tuple(_numbered(i, *item) for i, item in enumerate(sorted(solids, key=rank)))


_seen: weakref.WeakKeyDictionary[Part, Solid] = weakref.WeakKeyDictionary()
"""Parts that are still in use: what is computed of them is the same in every assembly of them."""


def _numbered(index: int, part: Part, shape: Shape, points: Floats, planes: tuple[PlaneFeature, ...]) -> Solid:
    known = _seen.get(part)
    if known is None or known.shape is not shape:
        known = _seen[part] = _solid(index, part, shape, points, planes)
    return known if known.index == index else replace(known, index=index)


def _solid(index: int, part: Part, shape: Shape, points: Floats, planes: tuple[PlaneFeature, ...]) -> Solid:
    matrix = part.transform[:3, :3]
    scale = abs(float(np.linalg.det(matrix))) ** (1 / 3)
    turn = matrix / scale
    cylinders = tuple(_cyl(c, part.transform, turn, scale) for c in shape.cylinders)
    flat = np.array([p.point for p in planes], dtype=np.float64).reshape(-1, 3)
    normals = np.array([p.normal for p in planes], dtype=np.float64).reshape(-1, 3)
    centre = shape.centroid @ matrix.T + part.transform[:3, 3]
    low, high = points.min(axis=0), points.max(axis=0)
    moments = turn @ shape.inertia @ turn.T
    volume = abs(shape.volume) * scale**3
    axis = _symmetry(cylinders, points, centre, moments) if shape.closed else _round_points(cylinders, points)
    shaft = _shaft(cylinders, points, volume)
    line = axis if axis is not None else shaft
    reach = start = end = 0.0
    if line is not None:
        reach, start, end = _extent(line, points)
    return Solid(
        index, part, shape, points, low, high, centre, volume, cylinders,
        flat @ matrix.T + part.transform[:3, 3], normals @ turn.T, axis, shaft, reach, start, end,
        tuple(_cyl(c, part.transform, turn, scale) for c in shape.knuckles),
        tuple(
            Ball(np.array(b.center) @ matrix.T + part.transform[:3, 3], b.radius * scale, b.inner)
            for b in shape.spheres
        ),
    )  # fmt: skip


def _cyl(c: CylinderFeature, transform: Floats, turn: Floats, scale: float) -> Cyl:
    centre = np.asarray(c.center, dtype=np.float64) @ transform[:3, :3].T + transform[:3, 3]
    direction = turn @ np.asarray(c.direction, dtype=np.float64)
    return Cyl(centre, direction / np.linalg.norm(direction), c.radius * scale, 0.5 * c.length * scale, c.arc, c.inner,
               c.error * scale)  # fmt: skip


def _extent(line: Cyl, points: Floats) -> tuple[float, float, float]:
    delta = points - line.center
    along = delta @ line.direction
    radial = np.linalg.norm(delta - along[:, None] * line.direction, axis=1)
    return float(radial.max()), float(along.min()), float(along.max())


def _symmetry(cylinders: tuple[Cyl, ...], points: Floats, centre: Floats, inertia: Floats) -> Cyl | None:
    """The cylinder about whose axis the mass is balanced: centroid on it, second moments equal across it."""
    full = [c for c in cylinders if c.full]
    if not full:
        return None
    line = max(full, key=lambda c: (round(c.radius * c.half, 9), not c.inner))
    reach = _extent(line, points)[0]
    coarse = line.error / line.radius
    if line.off(centre) > (0.01 + coarse) * reach:
        return None
    second = 0.5 * np.trace(inertia) * np.eye(3) - inertia
    u = np.linalg.svd(line.direction[None, :])[2][1:]
    across = u @ second @ u.T
    tilt = u @ second @ line.direction
    total = float(np.trace(across))
    if total <= 0:
        return None
    uneven = math.hypot(0.5 * (across[0, 0] - across[1, 1]), across[0, 1]) / total
    leaning = float(np.linalg.norm(tilt)) / (total + 1e-12)
    even = uneven < 0.015 + 2 * coarse and leaning < 0.03 + 2 * coarse
    return line if even and _round_points(cylinders, points) is not None else None


def _round_points(cylinders: tuple[Cyl, ...], points: Floats) -> Cyl | None:
    """The largest full cylinder, where the outline about it reaches equally far on all sides (square blocks do not)."""
    full = [c for c in cylinders if c.full]
    if not full:
        return None
    line = max(full, key=lambda c: (round(c.radius * c.half, 9), not c.inner))
    u, v = np.linalg.svd(line.direction[None, :])[2][1:]
    delta = points - line.center
    x, y = delta @ u, delta @ v
    turn = np.linspace(0, math.pi, 12, endpoint=False)
    widths = np.array([np.abs(x * math.cos(t) + y * math.sin(t)).max() for t in turn])
    return line if widths.min() > 0.82 * widths.max() else None


def _shaft(cylinders: tuple[Cyl, ...], points: Floats, volume: float) -> Cyl | None:
    """The bar that a part mainly is: a long full outer cylinder, hardly hollow, with nothing wide around it."""
    bars = [c for c in cylinders if c.full and not c.inner]
    if not bars:
        return None
    bar = max(bars, key=lambda c: round(c.radius * c.half, 9))
    # A left and a right pin may be one part.
    equal = [
        c for c in bars
        if abs(c.radius - bar.radius) < 0.01 * bar.radius + c.error + bar.error and coaxial(c, bar, 0.02)
    ]  # fmt: skip
    length = sum(2 * c.half for c in equal)
    if length < bar.radius:
        return None
    hollow = any(
        c.inner and c.full and c.radius > 0.4 * bar.radius and c.half > 0.4 * bar.half and coaxial(c, bar, 0.05)
        for c in cylinders
    )
    reach, start, end = _extent(bar, points)
    several = len(equal) > 1 and abs(length - volume / (math.pi * bar.radius**2)) < 0.1 * length
    slender = reach <= 3.6 * bar.radius and (several or length > 0.35 * (end - start))
    filled = several or volume > 0.45 * math.pi * bar.radius**2 * (end - start)
    return bar if slender and filled and not hollow else None


def flat_faces(shape: Shape) -> tuple[PlaneFeature, ...]:
    """Planes of a mesh that came without features: its larger sets of coplanar triangles."""
    corners = shape.mesh.points[shape.mesh.triangles]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    double = np.linalg.norm(cross, axis=1)
    good = double > 1e-14
    normals = np.zeros_like(cross)
    normals[good] = cross[good] / double[good, None]
    size = float(np.linalg.norm(np.ptp(shape.mesh.points, axis=0))) or 1.0
    offsets = np.einsum("ij,ij->i", normals, corners[:, 0])
    scaled = np.concatenate([normals * 500, (offsets / size * 2000)[:, None]], axis=1)[good]
    which = np.unique(np.round(scaled).astype(np.int32), axis=0, return_inverse=True)[1].ravel()
    areas = 0.5 * double[good]
    total = np.bincount(which, weights=areas)
    centres = corners[good].mean(axis=1)
    planes = []
    for k in np.flatnonzero(total > 0.02 * total.sum()):
        rows = np.flatnonzero(which == k)
        weights = areas[rows] / total[k]
        normal = weights @ normals[good][rows]
        point = weights @ centres[rows]
        normal = normal / np.linalg.norm(normal)
        planes.append(PlaneFeature(triple(point), triple(normal), float(total[k])))
    return tuple(planes)


def patch(shape: Shape, plane: PlaneFeature, tolerance: float) -> Patch:
    """The triangles of a shape on one of its planes; `tolerance` metres in the shape's frame."""
    triangles: Ints = shape.mesh.triangles
    normal = np.asarray(plane.normal)
    off = np.abs((shape.mesh.points - np.asarray(plane.point)) @ normal) <= tolerance
    chosen = triangles[off[triangles].all(axis=1)]
    corners = shape.mesh.points[chosen]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    double = np.linalg.norm(cross, axis=1)
    facing = (cross @ normal > 0.99 * double) & (double > 1e-14)
    return Patch(corners[facing], float(0.5 * double[facing].sum()))
