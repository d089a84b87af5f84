"""Reads an example's files for its tests, with nothing of the package under test."""

from __future__ import annotations

import collections
import importlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

import fcl
import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.collections import Sequence_TDF_Label
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.gp import gp_Cylinder, gp_Trsf
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Face, TopoDS_Shape
from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def module(machine: str, name: str) -> ModuleType:
    """A module of an example's package."""
    return importlib.import_module(f"{machine}.{name}")


@dataclass(frozen=True)
class Leaf:
    path: str
    shape: TopoDS_Shape
    place: gp_Trsf
    product: int


def name_of(label: TDF_Label) -> str:
    attribute = TDataStd_Name()
    assert label.FindAttribute(TDataStd_Name.GetID_s(), attribute)
    return str(attribute.Get().ToExtString())


def read_step(path: Path) -> list[Leaf]:
    """Every part of a file in tree order, in millimetres."""
    document = TDocStd_Document(TCollection_ExtendedString("BinXCAF"))
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.ReadFile(str(path))
    assert reader.Transfer(document)
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    roots = Sequence_TDF_Label()
    tool.GetFreeShapes(roots)
    assert roots.Length() == 1
    seen: collections.Counter[str] = collections.Counter()
    found: list[Leaf] = []

    def walk(label: TDF_Label, path: str, place: gp_Trsf) -> None:
        if not XCAFDoc_ShapeTool.IsAssembly_s(label):
            seen[path] += 1
            unique = path if seen[path] == 1 else f"{path}#{seen[path]}"
            found.append(Leaf(unique, XCAFDoc_ShapeTool.GetShape_s(label), place, label.Tag()))
            return
        children = Sequence_TDF_Label()
        XCAFDoc_ShapeTool.GetComponents_s(label, children, False)
        for i in range(1, children.Length() + 1):
            referred = TDF_Label()
            XCAFDoc_ShapeTool.GetReferredShape_s(children.Value(i), referred)
            here = XCAFDoc_ShapeTool.GetLocation_s(children.Value(i)).Transformation()
            walk(referred, f"{path}/{name_of(referred)}", place.Multiplied(here))

    walk(roots.Value(1), name_of(roots.Value(1)), gp_Trsf())
    return found


def faces_of(shape: TopoDS_Shape) -> list[TopoDS_Face]:
    faces = []
    explorer = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while explorer.More():
        faces.append(TopoDS.Face(explorer.Current()))
        explorer.Next()
    return faces


@dataclass(frozen=True)
class Bore:
    """A cylindrical face: metres, CAD frame."""

    point: np.ndarray
    axis: np.ndarray
    radius: float


def bores_of(leaves: list[Leaf]) -> dict[str, list[Bore]]:
    """Cylindrical faces by part; each shape is looked at once."""
    faces: dict[int, list[gp_Cylinder]] = {}
    out: dict[str, list[Bore]] = {}
    for leaf in leaves:
        if leaf.product not in faces:
            surfaces = [BRepAdaptor_Surface(face) for face in faces_of(leaf.shape)]
            round_ones = [s for s in surfaces if s.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder]
            faces[leaf.product] = [s.Cylinder() for s in round_ones]
        for face in faces[leaf.product]:
            cylinder = face.Transformed(leaf.place)
            p, d = cylinder.Axis().Location(), cylinder.Axis().Direction()
            point, axis = np.array([p.X(), p.Y(), p.Z()]) / 1e3, np.array([d.X(), d.Y(), d.Z()])
            out.setdefault(leaf.path, []).append(Bore(point, axis, cylinder.Radius() / 1e3))
    return out


def planes_along(leaf: Leaf, axis: np.ndarray, anchor: np.ndarray) -> list[float]:
    """Where a part's plane faces across an axis lie along it from the anchor, metres, in order."""
    found = []
    for face in faces_of(leaf.shape):
        surface = BRepAdaptor_Surface(face)
        if surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Plane:
            plane = surface.Plane().Transformed(leaf.place)
            n, p = plane.Axis().Direction(), plane.Location()
            if abs(abs(np.dot([n.X(), n.Y(), n.Z()], axis)) - 1) < 1e-9:
                found.append(float(np.dot(np.array([p.X(), p.Y(), p.Z()]) / 1e3 - anchor, axis)))
    return sorted(found)


def mesh_of(shape: TopoDS_Shape) -> tuple[np.ndarray, np.ndarray]:
    BRepMesh_IncrementalMesh(shape, 1.0, False, 0.25)
    points: list[tuple[float, float, float]] = []
    triangles: list[tuple[int, int, int]] = []
    for face in faces_of(shape):
        where = TopLoc_Location()
        mesh = BRep_Tool.Triangulation_s(face, where)
        base = len(points)
        for i in range(1, mesh.NbNodes() + 1):
            p = mesh.Node(i).Transformed(where.Transformation())
            points.append((p.X(), p.Y(), p.Z()))
        for i in range(1, mesh.NbTriangles() + 1):
            a, b, c = mesh.Triangle(i).Get()
            triangles.append((base + a - 1, base + b - 1, base + c - 1))
    return np.array(points), np.array(triangles)


@dataclass(frozen=True)
class Solid:
    """A part as triangles in the CAD frame, millimetres."""

    path: str
    points: np.ndarray
    model: fcl.BVHModel


def solids_of(leaves: list[Leaf]) -> list[Solid]:
    """Every part as a body for collision tests."""
    meshes: dict[int, tuple[np.ndarray, np.ndarray]] = {}
    out = []
    for leaf in leaves:
        if leaf.product not in meshes:
            meshes[leaf.product] = mesh_of(leaf.shape)
        m = np.array([[leaf.place.Value(i, j) for j in range(1, 5)] for i in range(1, 4)])
        points, triangles = meshes[leaf.product]
        points = points @ m[:, :3].T + m[:, 3]
        model = fcl.BVHModel()
        model.beginModel(len(points), len(triangles))
        model.addSubModel(points, triangles)
        model.endModel()
        out.append(Solid(leaf.path, points, model))
    return out


def gaps(solids: list[Solid], moves: list[np.ndarray], within: float) -> dict[tuple[int, int], float]:
    """Distances below `within` millimetres between parts, each moved by its 4x4 matrix; 0 where they meet."""
    low, high, placed = [], [], []
    for solid, m in zip(solids, moves, strict=True):
        points = solid.points @ m[:3, :3].T + m[:3, 3]
        low.append(points.min(0))
        high.append(points.max(0))
        placed.append(fcl.CollisionObject(solid.model, fcl.Transform(m[:3, :3], m[:3, 3])))
    lo, hi = np.array(low), np.array(high)
    out: dict[tuple[int, int], float] = {}
    for i in range(len(solids)):
        for j in np.nonzero(((lo[i] - within <= hi) & (hi[i] + within >= lo)).all(1))[0]:
            if j <= i:
                continue
            a, b = placed[i], placed[int(j)]
            meet = fcl.collide(a, b, fcl.CollisionRequest(), fcl.CollisionResult()) > 0
            gap = 0.0 if meet else fcl.distance(a, b, fcl.DistanceRequest(), fcl.DistanceResult())
            if gap < within:
                out[i, int(j)] = gap
    return out


def met_as_drawn(file: Path, bodies: Mapping[str, str]) -> list[tuple[str, str]]:
    """Parts of different bodies (by path) that meet in a STEP file."""
    leaves = read_step(file)
    return [
        (leaves[i].path, leaves[j].path)
        for (i, j), gap in gaps(solids_of(leaves), [np.eye(4)] * len(leaves), 0.01).items()
        if bodies[leaves[i].path] != bodies[leaves[j].path] and gap == 0.0
    ]
