"""Faces of a B-rep shape, and the cylinders and planes among them. Millimetres in; features come out in metres."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.BRepGProp import BRepGProp, BRepGProp_Domain, BRepGProp_Face, BRepGProp_Vinert
from OCP.BRepTools import BRepTools
from OCP.GeomAbs import (
    GeomAbs_Cone,
    GeomAbs_Cylinder,
    GeomAbs_Plane,
    GeomAbs_Sphere,
    GeomAbs_Torus,
)
from OCP.gp import gp_Cylinder, gp_Lin, gp_Pln, gp_Pnt, gp_Vec
from OCP.GProp import GProp_GProps
from OCP.ShapeAnalysis import ShapeAnalysis_CanonicalRecognition
from OCP.Standard import Standard_Failure, Standard_NullObject
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FORWARD, TopAbs_REVERSED
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS

from yellowiron.cad.brep.tessellate import MILLIMETRE
from yellowiron.cad.tolerances import PARALLEL
from yellowiron.model.geometry import CylinderFeature, Floats, PlaneFeature, SphereFeature

RECOGNITION = (1e-3, 1e-2)
"""A free-form face is a plane or cylinder if it departs from one by at most its tolerance, within these bounds, mm."""
SAME_CYLINDER = 5e-3
"""Faces lie on the same cylinder if axes and radii differ by no more than this over their length, mm."""
INTEGRATION = 1e-8
"""Relative error asked of integrals over free-form faces: the default rule is off by up to 1 % there (measured)."""
ABUT = 1e-2
"""Two faces on one cylinder are one feature if the gap between them along the axis is no more than this, mm."""

LEAST_HEIGHT = 1e-3
"""Where a cone is lower than this share of the shape's diagonal, its face's area does not follow from its volume."""
ON_AXIS = 1e-9
"""A point is on a cylinder's axis if it is off by no more than this share of the radius."""

Triple = tuple[float, float, float]

_PLANE, _CYLINDER, _CONE, _SPHERE, _TORUS, _FREE = range(6)
_KINDS = {GeomAbs_Plane: _PLANE, GeomAbs_Cylinder: _CYLINDER, GeomAbs_Cone: _CONE, GeomAbs_Sphere: _SPHERE}
_KINDS[GeomAbs_Torus] = _TORUS
_EDGE_SAMPLES = 24


@dataclass(frozen=True, eq=False)
class CylindricalFace:
    """One cylindrical face, mm: `origin` on the axis, unit `axis`, ends along it, and the angles it covers.

    `intervals` (k, 2) are angles about `axis`, counted from `zero`; together they cover the face. `inner`: material
    outside. `analytic`: the file has it as a cylinder.
    """

    origin: Floats
    axis: Floats
    zero: Floats
    radius: float
    lower: float
    upper: float
    intervals: Floats
    inner: bool
    area: float
    analytic: bool


@dataclass(frozen=True, eq=False)
class Face:
    """What is known of one face, mm: kind of surface, area, centre of area, and the plane's or cylinder's data; of a
    sphere (`ball`) its centre, radius, and whether the material is outside.

    `kind` is what the surface was recognised as.
    """

    kind: int
    area: float
    center: tuple[float, float, float]
    normal: tuple[float, float, float] | None = None
    patch: CylindricalFace | None = None
    ball: tuple[Triple, float, bool] | None = None


def survey(faces: Sequence[Any], box: Floats) -> tuple[list[Face], Any]:
    """Every face that has a surface, measured and recognised, in the order given; and the properties (`GProp_GProps`)
    of the volume that these faces enclose. `box` (2, 3): the bounds of them all.

    The volume is that of the cones from one apex over every face.
    """
    surfaces = [
        (face, BRepAdaptor_Surface(face, False))  # without the face's bounds, which take long to find
        for face in faces
        if BRep_Tool.Surface_s(face, TopLoc_Location()) is not None
    ]
    kinds = [_KINDS.get(surface.GetType(), _FREE) for _, surface in surfaces]
    apex = _apex([surface for (_, surface), kind in zip(surfaces, kinds, strict=True) if kind == _CYLINDER], box)
    least = LEAST_HEIGHT * float(np.linalg.norm(box[1] - box[0]))
    found, volume = [], GProp_GProps(apex)
    for (face, surface), kind in zip(surfaces, kinds, strict=True):
        cone = _cone(face, apex, precisely=_FREE in kinds)
        if face.Orientation() in (TopAbs_FORWARD, TopAbs_REVERSED):
            volume.Add(cone)
        height = _height(surface, kind, apex)
        area, center = _area_under(cone, apex, height) if height > least else _area(face, kind)
        found.append(_face(face, surface, kind, area, center))
    return found, volume


def _face(face: Any, surface: Any, kind: int, area: float, center: Triple) -> Face:
    if kind == _PLANE:
        return Face(kind, area, center, normal=_plane_normal(face, surface))
    if kind == _CYLINDER:
        return Face(kind, area, center, patch=_cylinder_patch(face, surface, area))
    if kind == _FREE:
        return _recognise(face, surface, area, center)
    if kind == _SPHERE:
        return Face(kind, area, center, ball=_ball(face, surface))
    return Face(kind, area, center)


def _ball(face: Any, surface: Any) -> tuple[Triple, float, bool]:
    sphere = surface.Sphere()
    position = sphere.Position()
    inner = position.Direct() == (face.Orientation() == TopAbs_REVERSED)
    x, y, z = position.Location().Coord()
    return (x, y, z), float(sphere.Radius()), inner


def _apex(cylinders: Sequence[Any], box: Floats) -> Any:
    """The middle of a box, or the point nearest to it on the axis of the widest cylinder, if that is near."""
    middle = box.mean(axis=0)
    if not cylinders:
        return gp_Pnt(*middle)
    position = max((surface.Cylinder() for surface in cylinders), key=lambda cylinder: cylinder.Radius()).Position()
    origin, axis = np.array(position.Location().Coord()), np.array(position.Direction().Coord())
    point = origin + axis * ((middle - origin) @ axis)
    near = float(np.linalg.norm(point - middle)) <= float(np.linalg.norm(box[1] - box[0]))
    return gp_Pnt(*(point if near else middle))


def _cone(face: Any, apex: Any, *, precisely: bool) -> Any:
    """Properties of the cone from an apex over a face; negative where the face looks at the apex."""
    edges = [BRepGProp_Domain(face)] if face.NbChildren() else []
    return BRepGProp_Vinert(BRepGProp_Face(face), *edges, apex, *([INTEGRATION] if precisely else []))


def _height(surface: Any, kind: int, apex: Any) -> float:
    """The distance from an apex to a surface's tangent planes where it is the same for all of them; else 0."""
    if kind == _PLANE:
        return float(surface.Plane().Distance(apex))
    if kind == _CYLINDER:
        cylinder = surface.Cylinder()
        radius = float(cylinder.Radius())
        return radius if gp_Lin(cylinder.Axis()).Distance(apex) <= ON_AXIS * radius else 0.0
    return 0.0


def _area_under(cone: Any, apex: Any, height: float) -> tuple[float, Triple]:
    """Area and centre of a face from its cone: the volume is a third of area times height, and the centre of that is at
    three quarters of the way from the apex to the face's."""
    x, y, z = (a + (c - a) / 0.75 for a, c in zip(apex.Coord(), cone.CentreOfMass().Coord(), strict=True))
    return 3.0 * abs(cone.Mass()) / height, (x, y, z)


def _area(face: Any, kind: int) -> tuple[float, Triple]:
    """Area and centre of any face."""
    properties = GProp_GProps()
    if kind == _FREE:
        BRepGProp.SurfaceProperties_s(face, properties, INTEGRATION, False)
    else:
        BRepGProp.SurfaceProperties_s(face, properties)
    return properties.Mass(), properties.CentreOfMass().Coord()


def _recognise(face: Any, surface: Any, area: float, center: tuple[float, float, float]) -> Face:
    """A free-form face, or the plane or cylinder that it really is."""
    tolerance = min(max(BRep_Tool.Tolerance_s(face), RECOGNITION[0]), RECOGNITION[1])
    recognition = ShapeAnalysis_CanonicalRecognition(face)
    plane, cylinder = gp_Pln(), gp_Cylinder()
    try:
        kind = _PLANE if recognition.IsPlane(tolerance, plane) else _FREE
        kind = _CYLINDER if kind == _FREE and recognition.IsCylinder(tolerance, cylinder) else kind
    except (
        Standard_Failure,
        Standard_NullObject,
    ):  # no subclasses in Python; a surface that it cannot load, of a face that is sound otherwise
        return Face(_FREE, area, center)
    if kind == _PLANE:
        return Face(_PLANE, area, center, normal=_outward(face, surface))
    if kind == _CYLINDER:
        patch = _sampled_patch(face, surface, cylinder, area)
        if patch is not None:
            return Face(_CYLINDER, area, center, patch=patch)
    return Face(_FREE, area, center)


def _plane_normal(face: Any, surface: Any) -> tuple[float, float, float]:
    position = surface.Plane().Position()
    sign = 1.0 if position.Direct() else -1.0
    if face.Orientation() == TopAbs_REVERSED:
        sign = -sign
    x, y, z = position.Direction().Coord()
    return (sign * x, sign * y, sign * z)


def _outward(face: Any, surface: Any, uv: tuple[float, float] | None = None) -> tuple[float, float, float]:
    """The unit normal out of the material, at the middle of the face's parameters."""
    if uv is None:
        u0, u1, v0, v1 = _bounds(face)
        uv = (0.5 * (u0 + u1), 0.5 * (v0 + v1))
    point, du, dv = gp_Pnt(), gp_Vec(), gp_Vec()
    surface.D1(*uv, point, du, dv)
    normal = np.cross(du.Coord(), dv.Coord())
    length = float(np.linalg.norm(normal))
    if length == 0.0:
        return (0.0, 0.0, 0.0)
    normal /= -length if face.Orientation() == TopAbs_REVERSED else length
    return (float(normal[0]), float(normal[1]), float(normal[2]))


def _bounds(face: Any) -> tuple[float, float, float, float]:
    u0, u1, v0, v1 = BRepTools.UVBounds_s(face)
    return u0, u1, v0, v1


def _cylinder_patch(face: Any, surface: Any, area: float) -> CylindricalFace:
    cylinder = surface.Cylinder()
    position = cylinder.Position()
    u0, u1, v0, v1 = _bounds(face)
    axis = np.array(position.Direction().Coord())
    # A left-handed frame turns the parameter round: the interval then runs backwards about the axis.
    turn = 1.0 if position.Direct() else -1.0
    inner = (turn < 0.0) != (face.Orientation() == TopAbs_REVERSED)
    return CylindricalFace(
        origin=np.array(position.Location().Coord()),
        axis=axis,
        zero=np.array(position.XDirection().Coord()),
        radius=cylinder.Radius(),
        lower=v0,
        upper=v1,
        intervals=np.array([sorted((turn * u0, turn * u1))]),
        inner=inner,
        area=area,
        analytic=True,
    )


def _sampled_patch(face: Any, surface: Any, cylinder: Any, area: float) -> CylindricalFace | None:
    """The patch of a free-form face on a recognised cylinder; its extents come from its boundary."""
    position = cylinder.Position()
    origin = np.array(position.Location().Coord())
    axis = np.array(position.Direction().Coord())
    zero = np.array(position.XDirection().Coord())
    points = _boundary(face)
    if not len(points):
        return None
    along = (points - origin) @ axis
    angles = np.arctan2((points - origin) @ np.cross(axis, zero), (points - origin) @ zero)
    # The boundary runs round wherever the face does; from one sample to the next it takes the short way.
    steps = (np.diff(angles, axis=1) + math.pi) % math.tau - math.pi
    starts = angles[:, :-1]
    intervals = np.stack([np.minimum(starts, starts + steps), np.maximum(starts, starts + steps)], axis=-1)
    u0, u1, v0, v1 = _bounds(face)
    uv = (0.5 * (u0 + u1), 0.5 * (v0 + v1))
    middle = np.array(surface.Value(*uv).Coord()) - origin
    outward = np.array(_outward(face, surface, uv))
    return CylindricalFace(
        origin=origin,
        axis=axis,
        zero=zero,
        radius=cylinder.Radius(),
        lower=float(along.min()),
        upper=float(along.max()),
        intervals=intervals.reshape(-1, 2),
        inner=float(outward @ (middle - axis * (middle @ axis))) < 0.0,
        area=area,
        analytic=False,
    )


def _boundary(face: Any) -> Floats:
    """(edges, samples, 3) points along the edges of a face."""
    points: list[list[tuple[float, float, float]]] = []
    explorer = TopExp_Explorer(face, TopAbs_EDGE)
    while explorer.More():
        edge = TopoDS.Edge(explorer.Current())
        explorer.Next()
        if BRep_Tool.Degenerated_s(edge):
            continue
        curve = BRepAdaptor_Curve(edge)
        first, last = curve.FirstParameter(), curve.LastParameter()
        if not (math.isfinite(first) and math.isfinite(last)):
            continue
        points.append([curve.Value(float(t)).Coord() for t in np.linspace(first, last, _EDGE_SAMPLES + 1)])
    return np.array(points, dtype=np.float64)


def planes(faces: Sequence[Face]) -> tuple[PlaneFeature, ...]:
    """The planar faces, in order, metres."""
    return tuple(
        PlaneFeature(_metres(face.center), _clean(face.normal), face.area * MILLIMETRE**2)
        for face in faces
        if face.normal is not None
    )


def spheres(faces: Sequence[Face]) -> tuple[SphereFeature, ...]:
    """The spheres, metres: faces on the same sphere are one feature, in the order of their first faces."""
    found: list[tuple[Floats, float, bool, float]] = []
    for face in faces:
        if face.ball is None:
            continue
        center, radius, inner = np.array(face.ball[0]), face.ball[1], face.ball[2]
        for number, (at, other, inside, area) in enumerate(found):
            near = float(np.linalg.norm(at - center)) < SAME_CYLINDER and abs(other - radius) < SAME_CYLINDER
            if near and inside == inner:
                found[number] = (at, other, inside, area + face.area)
                break
        else:
            found.append((center, radius, inner, face.area))
    return tuple(
        SphereFeature(_metres(tuple(map(float, at))), radius * MILLIMETRE, inner, area * MILLIMETRE**2)
        for at, radius, inner, area in found
    )


def cylinders(faces: Sequence[Face]) -> tuple[CylinderFeature, ...]:
    """The cylinders, metres: faces on the same cylinder that overlap or abut along its axis are one feature.

    Ordered by the group's first face, then along the axis. A feature's point is the middle of its axis.
    """
    groups: list[list[CylindricalFace]] = []
    for face in faces:
        if face.patch is None:
            continue
        for group in groups:
            if _same_cylinder(group[0], face.patch):
                group.append(face.patch)
                break
        else:
            groups.append([face.patch])
    return tuple(feature for group in groups for feature in _features(group))


def _same_cylinder(one: CylindricalFace, other: CylindricalFace) -> bool:
    if one.inner != other.inner or abs(one.radius - other.radius) > SAME_CYLINDER:
        return False
    ends = other.origin + np.outer((other.lower, other.upper), other.axis) - one.origin
    off = ends - np.outer(ends @ one.axis, one.axis)
    if float(np.abs(off).max()) > SAME_CYLINDER:
        return False
    return abs(float(one.axis @ other.axis)) > PARALLEL


def _features(group: Sequence[CylindricalFace]) -> list[CylinderFeature]:
    """Features of faces on one cylinder. The exact axis is the largest analytic face's."""
    main = max(group, key=lambda patch: (patch.analytic, patch.area))
    axis = _canonical(main.axis)
    zero = main.zero
    pieces = []
    for patch in group:
        ends = sorted(float((patch.origin + t * patch.axis - main.origin) @ axis) for t in (patch.lower, patch.upper))
        pieces.append((ends[0], ends[1], patch))
    pieces.sort(key=lambda piece: piece[:2])
    runs: list[list[tuple[float, float, CylindricalFace]]] = []
    for piece in pieces:
        if runs and piece[0] <= max(p[1] for p in runs[-1]) + ABUT:
            runs[-1].append(piece)
        else:
            runs.append([piece])
    features = []
    for run in runs:
        lower, upper = run[0][0], max(piece[1] for piece in run)
        half = 0.5 * (upper - lower) * MILLIMETRE
        features.append(
            CylinderFeature(
                point=_metres(main.origin + 0.5 * (lower + upper) * axis),
                direction=_clean(axis),
                radius=main.radius * MILLIMETRE,
                lower=-half,
                upper=half,
                arc=_coverage([interval for _, _, patch in run for interval in _intervals(patch, axis, zero)]),
                inner=main.inner,
                area=sum(patch.area for _, _, patch in run) * MILLIMETRE**2,
            )
        )
    return features


def _canonical(axis: Floats) -> Floats:
    """The axis or its opposite: the one whose first component that is not zero is positive."""
    for component in axis:
        if abs(component) > 1e-6:
            return axis if component > 0 else -axis
    return axis


def _intervals(patch: CylindricalFace, axis: Floats, zero: Floats) -> list[tuple[float, float]]:
    """The angles a patch covers about `axis`, counted from `zero`."""
    side = np.cross(axis, zero)
    shift = math.atan2(float(patch.zero @ side), float(patch.zero @ zero))
    turned = shift + (patch.intervals if float(patch.axis @ axis) > 0.0 else -patch.intervals[:, ::-1])
    return [(float(first), float(last)) for first, last in turned]


def _coverage(intervals: Sequence[tuple[float, float]]) -> float:
    """The measure of a union of angular intervals, at most a full turn."""
    flat: list[tuple[float, float]] = []
    for first, last in intervals:
        if last - first >= math.tau - 1e-9:
            return math.tau
        start = first % math.tau
        end = start + last - first
        flat.append((start, min(end, math.tau)))
        if end > math.tau:
            flat.append((0.0, end - math.tau))
    covered = reach = 0.0
    for start, end in sorted(flat):
        covered += max(0.0, end - max(start, reach))
        reach = max(reach, end)
    return math.tau if covered > math.tau - 1e-6 else covered


def _metres(point: Sequence[float] | Floats) -> tuple[float, float, float]:
    return (float(point[0]) * MILLIMETRE, float(point[1]) * MILLIMETRE, float(point[2]) * MILLIMETRE)


def _clean(direction: Sequence[float] | Floats) -> tuple[float, float, float]:
    """A unit vector without the rounding dust of 1e-16 and negative zeros."""
    x, y, z = (0.0 if abs(c) < 1e-14 else float(c) for c in direction)
    return (x, y, z)
