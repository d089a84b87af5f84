"""Draws small STEP files for the tests: a product tree of named, coloured, placed nodes, written by Open CASCADE."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from OCP.gp import gp_Ax1, gp_Ax2, gp_Dir, gp_Pnt, gp_Trsf
from OCP.Interface import Interface_Static
from OCP.Message import Message
from OCP.Quantity import Quantity_Color, Quantity_TOC_RGB
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.STEPControl import STEPControl_AsIs, STEPControl_Controller
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDocStd import TDocStd_Document
from OCP.TopLoc import TopLoc_Location
from OCP.XCAFApp import XCAFApp_Application
from OCP.XCAFDoc import XCAFDoc_ColorGen, XCAFDoc_ColorSurf, XCAFDoc_DocumentTool

Color = tuple[float, float, float]


@dataclass(eq=False)
class Node:
    """A product: a leaf with a `shape` (mm), or an assembly with `children`. Used twice: one product, two instances."""

    name: str
    shape: Any = None
    children: Sequence[Use] = ()
    color: Color | None = None
    face_colors: dict[int, Color] = field(default_factory=dict)


@dataclass(eq=False)
class Use:
    """An occurrence of a product in an assembly: placement (4, 4) in mm, instance name and colour."""

    node: Node
    matrix: np.ndarray = field(default_factory=lambda: np.eye(4))
    name: str = ""
    color: Color | None = None


def translation(x: float, y: float, z: float) -> np.ndarray:
    """(4, 4) matrix that moves by (x, y, z)."""
    matrix = np.eye(4)
    matrix[:3, 3] = (x, y, z)
    return matrix


def rotation(axis: Sequence[float], angle: float) -> np.ndarray:
    """(4, 4) rotation about an axis through the origin, radians."""
    trsf = gp_Trsf()
    trsf.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(*axis)), angle)
    return np.array([[trsf.Value(i, j) for j in (1, 2, 3, 4)] for i in (1, 2, 3)] + [[0, 0, 0, 1]], dtype=float)


def to_trsf(matrix: np.ndarray) -> gp_Trsf:
    """A gp_Trsf of a (4, 4) similarity; mirrored and scaled ones too."""
    trsf = gp_Trsf()
    trsf.SetValues(*(float(value) for value in matrix[:3].ravel()))
    return trsf


def write_step(
    path: Path, *roots: Node, unit: str = "MM", schema: str = "AP214IS", external: str | None = None
) -> Path:
    """Writes a product tree; `unit` is the file's own (MM, INCH, M): the drawing stays in mm.

    With `external`, a prefix of file names, each part goes into a file of its own beside it.
    """
    STEPControl_Controller.Init_s()
    Message.DefaultMessenger_s().ChangePrinters().Clear()
    document = TDocStd_Document(TCollection_ExtendedString("BinXCAF"))
    application = XCAFApp_Application.GetApplication_s()
    application.NewDocument(TCollection_ExtendedString("BinXCAF"), document)
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    shapes.SetAutoNaming_s(False)
    colors = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    labels: dict[int, Any] = {}

    def quantity(color: Color) -> Quantity_Color:
        return Quantity_Color(*color, Quantity_TOC_RGB)

    def label_of(node: Node) -> Any:
        if id(node) in labels:
            return labels[id(node)]
        if node.shape is not None:
            label = shapes.AddShape(node.shape, False)
            for index, color in node.face_colors.items():
                colors.SetColor(
                    shapes.AddSubShape(label, faces_of(node.shape)[index]), quantity(color), XCAFDoc_ColorSurf
                )
        else:
            label = shapes.NewShape()
            for use in node.children:
                component = shapes.AddComponent(label, label_of(use.node), TopLoc_Location(to_trsf(use.matrix)))
                TDataStd_Name.Set_s(component, TCollection_ExtendedString(use.name, True))
                if use.color is not None:
                    colors.SetColor(component, quantity(use.color), XCAFDoc_ColorSurf)
        TDataStd_Name.Set_s(label, TCollection_ExtendedString(node.name, True))
        if node.color is not None:
            colors.SetColor(label, quantity(node.color), XCAFDoc_ColorGen)
        labels[id(node)] = label
        return label

    for root in roots:
        label_of(root)
    shapes.UpdateAssemblies()
    Interface_Static.SetCVal_s("write.step.unit", unit)
    Interface_Static.SetCVal_s("write.step.schema", schema)
    writer = STEPCAFControl_Writer()
    writer.SetColorMode(True)
    writer.SetNameMode(True)
    if not writer.Transfer(document, STEPControl_AsIs, external):
        raise RuntimeError("transfer failed")
    with contextlib.chdir(path.parent):
        writer.Write(path.name)
    Interface_Static.SetCVal_s("write.step.unit", "MM")
    return path


def faces_of(shape: Any) -> list[Any]:
    """The faces of a shape in exploration order."""
    from OCP.TopAbs import TopAbs_FACE
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    explorer, faces = TopExp_Explorer(shape, TopAbs_FACE), []
    while explorer.More():
        faces.append(TopoDS.Face(explorer.Current()))
        explorer.Next()
    return faces


def box(dx: float, dy: float, dz: float, at: Sequence[float] = (0, 0, 0)) -> Any:
    """A block with one corner at `at`."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox

    return BRepPrimAPI_MakeBox(gp_Pnt(*at), dx, dy, dz).Shape()


def cylinder(
    radius: float,
    height: float,
    at: Sequence[float] = (0, 0, 0),
    axis: Sequence[float] = (0, 0, 1),
    turn: float = 2 * np.pi,
) -> Any:
    """A cylinder, or a part of a turn of one."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder

    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(*at), gp_Dir(*axis)), radius, height, turn).Shape()


def cut(shape: Any, *tools: Any) -> Any:
    """`shape` less the tools; the solid itself where one is left."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut

    for tool in tools:
        shape = BRepAlgoAPI_Cut(shape, tool).Shape()
    return only_solid(shape)


def only_solid(shape: Any) -> Any:
    """The solid of a compound of one."""
    from OCP.TopAbs import TopAbs_SOLID
    from OCP.TopExp import TopExp_Explorer

    explorer = TopExp_Explorer(shape, TopAbs_SOLID)
    first = explorer.Current()
    explorer.Next()
    return shape if explorer.More() else first


def compound(*shapes: Any) -> Any:
    """A compound of shapes."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Compound

    builder, result = BRep_Builder(), TopoDS_Compound()
    builder.MakeCompound(result)
    for shape in shapes:
        builder.Add(result, shape)
    return result


def moved(shape: Any, matrix: np.ndarray) -> Any:
    """A shape with its geometry transformed (mirrored and scaled too)."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform

    return BRepBuilderAPI_Transform(shape, to_trsf(matrix), True).Shape()


def to_nurbs(shape: Any) -> Any:
    """Every surface as a B-spline."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert

    return BRepBuilderAPI_NurbsConvert(shape, True).Shape()


def pin_bracket() -> Any:
    """A clevis: two cheeks 40 apart, each with a bore of radius 25 along y through (0, *, 100)."""
    base = box(200, 120, 20, (-100, -60, 0))
    cheeks = [box(100, 40, 150, (-50, y, 20)) for y in (-60, 20)]
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Fuse

    body = base
    for cheek in cheeks:
        body = BRepAlgoAPI_Fuse(body, cheek).Shape()
    return cut(body, cylinder(25, 200, (0, -100, 100), (0, 1, 0)))
