"""An IGES file to an `Assembly`. Runs in the guard's child process.

IGES knows surfaces and only seldom solids: what hangs together is sewn, and what closes is a solid. Its names are those
of single entities, if it has any.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid, BRepBuilderAPI_Sewing
from OCP.BRepClass3d import BRepClass3d_SolidClassifier
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.IGESCAFControl import IGESCAFControl_Reader
from OCP.IGESControl import IGESControl_Controller
from OCP.Interface import Interface_Static
from OCP.TopAbs import TopAbs_FACE, TopAbs_IN, TopAbs_SHELL, TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Compound
from OCP.XCAFDoc import XCAFDoc_ShapeTool

from yellowiron.cad import products
from yellowiron.cad.brep import subshapes
from yellowiron.cad.xcaf import EXPORT_AGAIN, Tree, add_product, label_color, new_document
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError

_SEAM = 0.02
"""Millimetres. Edges of neighbouring surfaces closer than this are one; IGES repeats each of them."""
_UNITS = {"IN": 0.0254, "INCH": 0.0254, "MM": 1e-3, "FT": 0.3048, "MI": 1609.344, "M": 1.0, "KM": 1e3, "MIL": 2.54e-5}
_UNITS |= {"UM": 1e-6, "CM": 1e-2, "UIN": 2.54e-8}
"""IGES 5.3, global parameter 15."""


def read_iges(path: str) -> Assembly:
    """The assembly in an IGES file, in metres. `CadError` if it is damaged or holds no surface."""
    IGESControl_Controller.Init_s()
    Interface_Static.SetCVal_s("xstep.cascade.unit", "MM")
    reader = IGESCAFControl_Reader()
    reader.SetNameMode(True)
    reader.SetColorMode(True)
    reader.SetLayerMode(False)
    if reader.ReadFile(path) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise CadError("The IGES file cannot be read: its syntax is broken", where=path, hint=EXPORT_AGAIN)
    stated = reader.IGESModel().GlobalSection().UnitName()
    unit = _UNITS.get(stated.ToCString().strip().upper() if stated is not None else "", 1e-3)
    document = new_document()
    if not reader.Transfer(document):
        raise CadError("The IGES file holds nothing that can be read as a part", where=path, hint=EXPORT_AGAIN)
    sewn = new_document()
    loose = []
    for leaf in Tree(document, "utf-8").leaves():
        shape = XCAFDoc_ShapeTool.GetShape_s(leaf.label)
        if shape is None or shape.IsNull():
            continue
        shape = shape.Moved(leaf.location)
        faces = subshapes(shape, TopAbs_FACE)
        if len(faces) == 1:
            loose += faces
        elif faces:
            whole = shape if TopExp_Explorer(shape, TopAbs_SOLID).More() else closed(faces)
            add_product(sewn, leaf.name, whole, leaf.color or label_color(leaf.label))
    if loose:
        add_product(sewn, Path(path).stem, closed(loose))
    return products.assemble(Tree(sewn, "utf-8"), path=path, format="IGES", unit=unit)


def closed(faces: Sequence[Any]) -> Any:
    """Faces sewn to a compound of shells, those that close as solids, right side out, and the faces that stay alone."""
    sewing = BRepBuilderAPI_Sewing(_SEAM)
    for face in faces:
        sewing.Add(face)
    sewing.Perform()
    sewn = sewing.SewedShape()
    found = TopoDS_Compound()
    builder = BRep_Builder()
    builder.MakeCompound(found)
    for shell in subshapes(sewn, TopAbs_SHELL):
        builder.Add(found, _solid(shell) if BRep_Tool.IsClosed_s(shell) else shell)
    alone = TopExp_Explorer(sewn, TopAbs_FACE, TopAbs_SHELL)
    while alone.More():
        builder.Add(found, alone.Current())
        alone.Next()
    return found


def _solid(shell: Any) -> Any:
    solid = BRepBuilderAPI_MakeSolid(TopoDS.Shell(shell)).Solid()
    # A solid that holds the point at infinity is inside out.
    far = BRepClass3d_SolidClassifier(solid)
    far.PerformInfinitePoint(1e-3)
    if far.State() == TopAbs_IN:
        solid.Reverse()
    return solid
