"""The XCAF document of a STEP file: product tree, names, colours, placements. Runs in the guard's child process."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher, Sequence_TCollection_AsciiString
from OCP.collections import Sequence_TDF_Label as LabelSequence
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Interface import Interface_Static
from OCP.Quantity import Quantity_Color, Quantity_TOC_RGB
from OCP.STEPCAFControl import STEPCAFControl_Controller, STEPCAFControl_Reader
from OCP.TCollection import TCollection_AsciiString, TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label, TDF_Tool
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_FACE
from OCP.TopLoc import TopLoc_Location
from OCP.XCAFApp import XCAFApp_Application
from OCP.XCAFDoc import (
    XCAFDoc_ColorGen,
    XCAFDoc_ColorSurf,
    XCAFDoc_ColorTool,
    XCAFDoc_DocumentTool,
    XCAFDoc_LengthUnit,
    XCAFDoc_ShapeTool,
)

from yellowiron.cad.bounds import limited
from yellowiron.cad.brep.tessellate import MILLIMETRE
from yellowiron.cad.naming import decode_name, occurrence_name
from yellowiron.model.errors import CadError
from yellowiron.model.geometry import Color

EXPORT_AGAIN = "Export the file again as STEP AP214 or AP242, solids included."


@dataclass(frozen=True, eq=False)
class Leaf:
    """One occurrence of a product without components: where it hangs, its label and placement.

    `color` is the occurrence's own, stronger than the product's; `inherited` an assembly's above it, weaker.
    """

    name: str
    path: tuple[str, ...]
    label: Any
    location: Any
    color: Color | None = None
    inherited: Color | None = None


def open_step(path: str, encoding: str, *, inner_names: bool = True) -> tuple[ProductTree, list[str]]:
    """The product tree of a STEP file, and the names of the units of length in it. `CadError` if it has no content.

    `inner_names`: those of the solids inside of products are kept, too.
    """
    STEPCAFControl_Controller.Init_s()
    # Bytes that are not UTF-8 pass through as they are, one character each; `decode_name` knows what they mean.
    Interface_Static.SetCVal_s("read.step.codepage", "UTF8" if encoding == "utf-8" else "iso8859-1")
    Interface_Static.SetCVal_s("xstep.cascade.unit", "MM")
    Interface_Static.SetCVal_s("read.stepcaf.subshapes.name", "On" if inner_names else "Off")
    Interface_Static.SetRVal_s("read.encoderegularity.angle", 0.0)  # which edges are smooth is of no use here
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.SetColorMode(True)
    for switch in (reader.SetGDTMode, reader.SetLayerMode, reader.SetMatMode, reader.SetPropsMode, reader.SetViewMode):
        switch(False)
    # A relative path would silently lose every external reference.
    if reader.ReadFile(str(Path(path).absolute())) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise CadError("The STEP file cannot be read: its syntax is broken", where=path, hint=EXPORT_AGAIN)
    document = new_document()
    if not reader.Transfer(document):
        raise CadError("The STEP file holds nothing that can be read as a part", where=path, hint=EXPORT_AGAIN)
    lengths, angles, solid_angles = (Sequence_TCollection_AsciiString() for _ in range(3))
    reader.ChangeReader().FileUnits(lengths, angles, solid_angles)
    names = [lengths.Value(i).ToCString() for i in range(1, len(lengths) + 1)]
    unit, root = XCAFDoc_LengthUnit(), document.Main().Root()
    stated = root.IsAttribute(XCAFDoc_LengthUnit.GetID_s()) and root.FindAttribute(XCAFDoc_LengthUnit.GetID_s(), unit)
    # Whatever the file's unit, the geometry must arrive in the unit that was asked for.
    if stated and abs(unit.GetUnitValue() - MILLIMETRE) > 1e-12:
        raise CadError(
            f"The reader delivered units of {unit.GetUnitValue():g} m, not mm", where=path, hint=EXPORT_AGAIN
        )
    return ProductTree(document, encoding, path), names


def new_document() -> Any:
    """An empty XCAF document."""
    document = TDocStd_Document(TCollection_ExtendedString("yellowiron"))
    XCAFApp_Application.GetApplication_s().NewDocument(TCollection_ExtendedString("BinXCAF"), document)
    return document


def add_product(document: Any, name: str, shape: Any, color: Color | None = None) -> None:
    """Adds a shape (millimetres) to a document as a product of its own."""
    label = XCAFDoc_DocumentTool.ShapeTool_s(document.Main()).AddShape(shape, False)
    TDataStd_Name.Set_s(label, TCollection_ExtendedString(name, True))
    if color is not None:
        tool = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
        tool.SetColor(label, Quantity_Color(*color, Quantity_TOC_RGB), XCAFDoc_ColorSurf)


@dataclass(eq=False)
class Product:
    """What becomes a product of a document: a `shape` (millimetres) with its colour and those of single faces; or an
    assembly of other products at their places, one product at several places being several instances of it."""

    name: str
    shape: Any = None
    children: Sequence[tuple[Product, Any]] = ()
    color: Color | None = None
    face_colors: Sequence[tuple[Any, Color]] = ()


def add_products(document: Any, roots: Sequence[Product]) -> None:
    """Adds products, and all that they hold, to a document."""
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    shapes.SetAutoNaming_s(False)
    colors = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    known: dict[int, Any] = {}

    def added(product: Product) -> Any:
        if id(product) in known:
            return known[id(product)]
        if product.shape is not None:
            label = shapes.AddShape(product.shape, False)
            for face, color in product.face_colors:
                part = shapes.AddSubShape(label, face)
                if not part.IsNull():
                    colors.SetColor(part, Quantity_Color(*color, Quantity_TOC_RGB), XCAFDoc_ColorSurf)
        else:
            label = shapes.NewShape()
            for child, place in product.children:
                shapes.AddComponent(label, added(child), place)
        TDataStd_Name.Set_s(label, TCollection_ExtendedString(product.name, True))
        if product.color is not None:
            colors.SetColor(label, Quantity_Color(*product.color, Quantity_TOC_RGB), XCAFDoc_ColorSurf)
        known[id(product)] = label
        return label

    for root in roots:
        added(root)
    shapes.UpdateAssemblies()


class ProductTree:
    """The product tree of an XCAF document."""

    def __init__(self, document: Any, encoding: str, path: str) -> None:
        self.encoding = encoding
        self._path = path
        self._document = document  # its labels die with it
        roots = LabelSequence()
        XCAFDoc_DocumentTool.ShapeTool_s(document.Main()).GetFreeShapes(roots)
        self.roots = labels(roots)
        self.name = self.product_name(self.roots[0]) if len(self.roots) == 1 else ""

    def leaves(self) -> Iterator[Leaf]:
        """Every occurrence of a product without components, in tree order."""
        roots = (Leaf(self.product_name(root) or _nameless(root), (), root, TopLoc_Location()) for root in self.roots)
        for one in limited((found for root in roots for found in self._walk(root)), self._path):
            if not XCAFDoc_ShapeTool.IsAssembly_s(one.label):
                yield one

    def _walk(self, at: Leaf) -> Iterator[Leaf]:
        yield at
        if not XCAFDoc_ShapeTool.IsAssembly_s(at.label):
            return
        inherited = at.color or label_color(at.label) or at.inherited
        components = LabelSequence()
        XCAFDoc_ShapeTool.GetComponents_s(at.label, components)
        for component in labels(components):
            product = TDF_Label()
            if not XCAFDoc_ShapeTool.GetReferredShape_s(component, product):
                continue
            name = occurrence_name(self.product_name(component), self.product_name(product))
            yield from self._walk(
                Leaf(
                    name=name or _nameless(product),
                    path=(*at.path, at.name),
                    label=product,
                    location=at.location * XCAFDoc_ShapeTool.GetLocation_s(component),
                    color=label_color(component),
                    inherited=inherited,
                )
            )

    def product_name(self, label: Any) -> str:
        """A label's name, decoded; empty if it has none."""
        if not label.IsAttribute(TDataStd_Name.GetID_s()):
            return ""  # asking for an attribute that is not there crashes the binding
        name = TDataStd_Name()
        label.FindAttribute(TDataStd_Name.GetID_s(), name)
        return decode_name(name.Get().ToExtString(), self.encoding)


def _nameless(label: Any) -> str:
    return "Assembly" if XCAFDoc_ShapeTool.IsAssembly_s(label) else "Part"


def label_entry(label: Any) -> str:
    """A label's address in its document (`0:1:1:7`)."""
    entry = TCollection_AsciiString()
    TDF_Tool.Entry_s(label, entry)
    return str(entry.ToCString())


def labels(sequence: Any) -> list[Any]:
    """An Open CASCADE sequence of labels as a list."""
    # The binding's `Length` takes 0.2 ms.
    return [sequence.Value(i) for i in range(1, len(sequence) + 1)]


def label_color(label: Any) -> Color | None:
    """The colour on a label (linear RGB), surface colour first."""
    color = Quantity_Color()
    for kind in (XCAFDoc_ColorSurf, XCAFDoc_ColorGen):
        if XCAFDoc_ColorTool.GetColor_s(label, kind, color):
            return (color.Red(), color.Green(), color.Blue())
    return None


class Styles:
    """Names and colours that a product gives to its sub-shapes."""

    def __init__(self, tree: ProductTree, label: Any) -> None:
        self._map = IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher()
        self._styles: list[tuple[str, Color | None]] = []
        self.has_face_colors = False
        found = LabelSequence()
        XCAFDoc_ShapeTool.GetSubShapes_s(label, found)
        for sub in labels(found):
            shape = XCAFDoc_ShapeTool.GetShape_s(sub)
            if shape is None or shape.IsNull():
                continue
            color = label_color(sub)
            size = self._map.Size()
            if self._map.Add(shape.Located(TopLoc_Location())) > size:
                self._styles.append((tree.product_name(sub), color))
                self.has_face_colors |= color is not None and shape.ShapeType() == TopAbs_FACE

    def of(self, shape: Any) -> tuple[str, Color | None]:
        """A sub-shape's own name and colour."""
        index = self._map.FindIndex(shape.Located(TopLoc_Location())) if self._styles else 0
        return self._styles[index - 1] if index else ("", None)

    def of_faces(self, faces: Sequence[Any]) -> list[Color | None] | None:
        """One colour a face, where faces have any."""
        if not self.has_face_colors:
            return None
        colors = [self.of(face)[1] for face in faces]
        return colors if any(color is not None for color in colors) else None
