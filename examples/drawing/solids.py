"""Small B-rep vocabulary on OpenCascade: prisms from outlines, turned parts, holes, placements. Lengths in
millimetres.

An outline is a list of (u, v, r): corner circles in order, counter-clockwise, joined by their outer tangents.
r = 0 is a sharp corner, r > 0 rounds outwards (a boss), r < 0 rounds inwards (a hollow). Two circles make a
lug.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.BRepBuilderAPI import (
    BRepBuilderAPI_MakeEdge,
    BRepBuilderAPI_MakeFace,
    BRepBuilderAPI_MakeWire,
    BRepBuilderAPI_Transform,
)
from OCP.BRepOffsetAPI import BRepOffsetAPI_MakePipe
from OCP.BRepPrimAPI import (
    BRepPrimAPI_MakeCylinder,
    BRepPrimAPI_MakePrism,
    BRepPrimAPI_MakeRevol,
    BRepPrimAPI_MakeSphere,
)
from OCP.GC import GC_MakeArcOfCircle
from OCP.gp import gp_Ax1, gp_Ax2, gp_Ax3, gp_Circ, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec
from OCP.ShapeUpgrade import ShapeUpgrade_UnifySameDomain
from OCP.TopoDS import TopoDS_Shape

Corner = tuple[float, float, float]
Vector = tuple[float, float, float]
Segment = tuple[tuple[float, float], ...]
"""Two points: a line. Three: an arc through the middle one."""

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
_PLANES: dict[str, tuple[Vector, Vector, Vector]] = {"xz": (X, Z, Y), "xy": (X, Y, Z), "yz": (Y, Z, X)}


def outline(corners: Sequence[Corner]) -> list[Segment]:
    """Lines and arcs around the corner circles."""
    n = len(corners)
    normals: list[tuple[float, float]] = []
    for i in range(n):
        (ax, ay, ar), (bx, by, br) = corners[i], corners[(i + 1) % n]
        d = math.hypot(bx - ax, by - ay)
        ux, uy = (bx - ax) / d, (by - ay) / d
        along = (ar - br) / d
        across = math.sqrt(1.0 - along * along)
        normals.append((ux * along + uy * across, uy * along - ux * across))
    path: list[Segment] = []
    for i in range(n):
        x, y, r = corners[i]
        (px, py), (qx, qy) = normals[i - 1], normals[i]
        start, end = (x + r * px, y + r * py), (x + r * qx, y + r * qy)
        if r:
            turn = (math.atan2(qy, qx) - math.atan2(py, px)) % (2 * math.pi)
            turn = turn if r > 0 else turn - 2 * math.pi
            if 1.5 * math.pi < abs(turn) < 2 * math.pi - 1e-6:
                raise ValueError(f"the outline turns the wrong way about ({x:g}, {y:g}, {r:g})")
            if abs(turn) > 1e-9 and abs(abs(turn) - 2 * math.pi) > 1e-9:
                c, s = math.cos(turn / 2), math.sin(turn / 2)
                path.append((start, (x + r * (c * px - s * py), y + r * (s * px + c * py)), end))
        nx, ny, nr = corners[(i + 1) % n]
        path.append((end, (nx + nr * qx, ny + nr * qy)))
    return path


def prism(path: Iterable[Segment], plane: str, low: float, high: float) -> TopoDS_Shape:
    """The closed path, drawn in "xz", "xy" or "yz", extruded from `low` to `high` along the third axis."""
    u, v, w = _PLANES[plane]

    def point(p: tuple[float, float]) -> gp_Pnt:
        return gp_Pnt(*(p[0] * a + p[1] * b + low * c for a, b, c in zip(u, v, w, strict=True)))

    wire = BRepBuilderAPI_MakeWire()
    for seg in path:
        pts = [point(p) for p in seg]
        if len(pts) == 3:
            wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(*pts).Value()).Edge())
        elif pts[0].Distance(pts[1]) > 1e-6:
            wire.Add(BRepBuilderAPI_MakeEdge(*pts).Edge())
    face = BRepBuilderAPI_MakeFace(wire.Wire(), True).Face()
    return BRepPrimAPI_MakePrism(face, gp_Vec(*((high - low) * c for c in w))).Shape()


def plate(corners: Sequence[Corner], plane: str, low: float, high: float) -> TopoDS_Shape:
    """A plate with a rounded outline; see the module's text."""
    return prism(outline(corners), plane, low, high)


def box(x0: float, x1: float, y0: float, y1: float, z0: float, z1: float) -> TopoDS_Shape:
    """An axis-parallel block."""
    return plate([(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)], "xy", z0, z1)


def sheet_box(x0: float, x1: float, y0: float, y1: float, z0: float, z1: float, wall: float) -> TopoDS_Shape:
    """A closed sheet box."""
    inner = box(x0 + wall, x1 - wall, y0 + wall, y1 - wall, z0 + wall, z1 - wall)
    return cut(box(x0, x1, y0, y1, z0, z1), inner)


def turned(profile: Sequence[tuple[float, float]], origin: Vector = (0, 0, 0), axis: Vector = Y) -> TopoDS_Shape:
    """A solid of revolution; the profile is a closed polygon of (position along the axis, radius)."""
    a = gp_Dir(*axis)
    side = gp_Ax2(gp_Pnt(*origin), a).XDirection()
    wire = BRepBuilderAPI_MakeWire()
    pts = [
        gp_Pnt(
            origin[0] + s * a.X() + r * side.X(),
            origin[1] + s * a.Y() + r * side.Y(),
            origin[2] + s * a.Z() + r * side.Z(),
        )
        for s, r in profile
    ]
    for p, q in zip(pts, pts[1:] + pts[:1], strict=True):
        wire.Add(BRepBuilderAPI_MakeEdge(p, q).Edge())
    face = BRepBuilderAPI_MakeFace(wire.Wire(), True).Face()
    return BRepPrimAPI_MakeRevol(face, gp_Ax1(gp_Pnt(*origin), a)).Shape()


def rod(start: Vector, axis: Vector, radius: float, length: float) -> TopoDS_Shape:
    """A cylinder from `start` along `axis`."""
    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(*start), gp_Dir(*axis)), radius, length).Shape()


def ball(center: Vector, radius: float) -> TopoDS_Shape:
    """A sphere."""
    return BRepPrimAPI_MakeSphere(gp_Pnt(*center), radius).Shape()


def ring(start: Vector, axis: Vector, outer: float, inner: float, length: float) -> TopoDS_Shape:
    """A tube from `start` along `axis`; radii."""
    return cut(rod(start, axis, outer, length), rod(start, axis, inner, length))


def cut(body: TopoDS_Shape, *tools: TopoDS_Shape) -> TopoDS_Shape:
    """`body` less the tools."""
    for tool in tools:
        body = BRepAlgoAPI_Cut(body, tool).Shape()
    return body


def fuse(body: TopoDS_Shape, *others: TopoDS_Shape) -> TopoDS_Shape:
    """One solid of several, faces merged."""
    for other in others:
        body = BRepAlgoAPI_Fuse(body, other).Shape()
    merge = ShapeUpgrade_UnifySameDomain(body, True, True, False)
    merge.Build()
    return merge.Shape()


def bored(body: TopoDS_Shape, axis: Vector, *holes: tuple[Vector, float]) -> TopoDS_Shape:
    """`body` with through holes: (a point on the axis, radius)."""
    for p, r in holes:
        start: Vector = (p[0] - 4000 * axis[0], p[1] - 4000 * axis[1], p[2] - 4000 * axis[2])
        body = cut(body, rod(start, axis, r, 8000.0))
    return body


# ---- placements --------
def shift(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> gp_Trsf:
    """A translation."""
    t = gp_Trsf()
    t.SetTranslation(gp_Vec(x, y, z))
    return t


def turn(axis: Vector, degrees: float, origin: Vector = (0, 0, 0)) -> gp_Trsf:
    """A rotation about an axis through `origin`."""
    t = gp_Trsf()
    t.SetRotation(gp_Ax1(gp_Pnt(*origin), gp_Dir(*axis)), math.radians(degrees))
    return t


def frame(origin: Vector, x_axis: Vector, z_axis: Vector) -> gp_Trsf:
    """Places a part drawn about its own origin: its x and z axes go where the arguments say."""
    t = gp_Trsf()
    t.SetTransformation(gp_Ax3(gp_Pnt(*origin), gp_Dir(*z_axis), gp_Dir(*x_axis)), gp_Ax3())
    return t


def moved(body: TopoDS_Shape, trsf: gp_Trsf) -> TopoDS_Shape:
    """A copy with the placement in its geometry."""
    return BRepBuilderAPI_Transform(body, trsf, True).Shape()


def mirrored(body: TopoDS_Shape) -> TopoDS_Shape:
    """A copy on the other side of the plane y = 0."""
    t = gp_Trsf()
    t.SetMirror(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 1, 0)))
    return BRepBuilderAPI_Transform(body, t, True).Shape()


def pipe(points: Sequence[Vector], radius: float, bend: float) -> TopoDS_Shape:
    """A round bar along a polyline whose corners are bent to the radius `bend`."""
    pts = [gp_Vec(*p) for p in points]
    wire = BRepBuilderAPI_MakeWire()
    here = pts[0]
    for a, corner, b in zip(pts, pts[1:], pts[2:], strict=False):
        u, w = (corner - a).Normalized(), (b - corner).Normalized()
        angle = u.Angle(w)
        back = bend * math.tan(angle / 2)
        start, end = corner - u * back, corner + w * back
        inward = (w - u).Normalized()
        mid = corner + inward * (bend / math.cos(angle / 2) - bend)
        wire.Add(BRepBuilderAPI_MakeEdge(_pnt(here), _pnt(start)).Edge())
        wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(_pnt(start), _pnt(mid), _pnt(end)).Value()).Edge())
        here = end
    wire.Add(BRepBuilderAPI_MakeEdge(_pnt(here), _pnt(pts[-1])).Edge())
    first = (pts[1] - pts[0]).Normalized()
    circle = gp_Circ(gp_Ax2(_pnt(pts[0]), gp_Dir(first)), radius)
    profile = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire()
    return BRepOffsetAPI_MakePipe(wire.Wire(), BRepBuilderAPI_MakeFace(profile, True).Face()).Shape()


def _pnt(p: gp_Vec) -> gp_Pnt:
    return gp_Pnt(p.X(), p.Y(), p.Z())
