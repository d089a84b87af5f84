"""An IGES file to an `Assembly`. Runs in the guard's child process.

IGES knows surfaces and only seldom solids: what hangs together is sewn, and what closes is a solid. Groups (402) and
subfigures (308) are assemblies, or parts where they hold surfaces alone; a subfigure that is placed several times (408)
is one product with several instances. Names are those of the property 406, form 15, else the entities' labels.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid, BRepBuilderAPI_Sewing
from OCP.BRepClass3d import BRepClass3d_SolidClassifier
from OCP.gp import gp_Trsf, gp_Vec
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.IGESControl import IGESControl_Controller, IGESControl_Reader
from OCP.Interface import Interface_Static
from OCP.Standard import Standard_Failure
from OCP.TCollection import TCollection_ExtendedString
from OCP.TopAbs import TopAbs_FACE, TopAbs_IN, TopAbs_SHELL
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Compound

from yellowiron.cad.brep import products
from yellowiron.cad.brep.tessellate import MILLIMETRE
from yellowiron.cad.brep.to_shape import subshapes
from yellowiron.cad.brep.xcaf import EXPORT_AGAIN, Product, ProductTree, add_products, new_document
from yellowiron.cad.naming import decode_name, encoding_remarks, is_generic, sniff_encoding
from yellowiron.cad.readers.exact.patience import file_must_end
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, linear

_SEAM = 0.02
"""Millimetres. Edges of neighbouring surfaces closer than this are one; IGES repeats each of them."""
_UNITS = {"IN": 0.0254, "INCH": 0.0254, "MM": 1e-3, "FT": 0.3048, "MI": 1609.344, "M": 1.0, "KM": 1e3, "MIL": 2.54e-5}
_UNITS |= {"UM": 1e-6, "CM": 1e-2, "UIN": 2.54e-8}
"""IGES 5.3, global parameter 15."""
_CODES = {1: 0.0254, 2: 1e-3, 4: 0.3048, 5: 1609.344, 6: 1.0, 7: 1e3, 8: 2.54e-5, 9: 1e-6, 10: 1e-2, 11: 2.54e-8}
"""IGES 5.3, global parameter 14; 3 leaves it to the name."""
_COLORS: dict[int, Color] = {
    1: (0.0, 0.0, 0.0), 2: (1.0, 0.0, 0.0), 3: (0.0, 1.0, 0.0), 4: (0.0, 0.0, 1.0),
    5: (1.0, 1.0, 0.0), 6: (1.0, 0.0, 1.0), 7: (0.0, 1.0, 1.0), 8: (1.0, 1.0, 1.0),
}  # fmt: skip
"""IGES 5.3, field 13 of the directory entry."""
_GROUP, _FIGURE, _PLACED, _SOLID = 402, 308, 408, 186
_SURFACES = frozenset({108, 114, 118, 120, 122, 128, 140, 143, 144, 190, 192, 194, 196, 198, 510, 514})
_WHOLE = frozenset({143, 144, _SOLID})
"""Solids and trimmed surfaces, which are nothing else's geometry."""
_DEEPEST = 50
_END = re.compile(rb"^.{72}T[ \d]{7}", re.MULTILINE)
"""The line that ends the file."""
_NO_NUMBER = re.compile(rb"[,;][-+]?(?:\d+\.?\d*[EeDd]\+?(?:1[5-9]|[2-9]\d)\d\b|(?:nan|inf)[,;])", re.IGNORECASE)
"""From 1e150 on: what stands for infinity is less."""


def read_iges(path: str) -> Assembly:
    """The assembly in an IGES file, in metres. `CadError` if it is damaged or holds no surface."""
    _check(Path(path).read_bytes(), path)
    # Some damaged surfaces are worked on for ever.
    with file_must_end(Path(path).stat().st_size):
        return _read(path)


def _check(data: bytes, path: str) -> None:
    """`CadError` for damage on which Open CASCADE crashes, or goes on for ever: no end, no text, no numbers."""
    fault, data = "", data.rstrip(b"\0\x1a")
    if not _END.search(data[-4096:]):
        fault = "is truncated: its last section is missing"
    elif b"\0" in data:
        fault = f"is broken: byte {data.index(0) + 1} is no text"
    elif number := _NO_NUMBER.search(data):
        fault = f"is broken: {number.group().decode(errors='replace')} is no coordinate"
    if fault:
        raise CadError(f"The IGES file {fault}", where=path, hint=EXPORT_AGAIN)


def _read(path: str) -> Assembly:
    IGESControl_Controller.Init_s()
    Interface_Static.SetCVal_s("xstep.cascade.unit", "MM")
    reader = IGESControl_Reader()
    if reader.ReadFile(path) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise CadError("The IGES file cannot be read: its syntax is broken", where=path, hint=EXPORT_AGAIN)
    document = new_document()
    model = _Model(reader, path)
    add_products(document, model.products())
    tree = ProductTree(document, "utf-8", path)
    if not tree.roots:
        raise CadError("The IGES file holds nothing that can be read as a part", where=path, hint=EXPORT_AGAIN)
    return products.assemble(tree, path=path, format="IGES", unit=model.unit, findings=model.findings)


def _unit(reader: Any) -> float:
    section = reader.IGESModel().GlobalSection()
    stated = section.UnitName()
    name = stated.ToCString().strip().upper() if stated is not None else ""
    return _UNITS.get(name) or _CODES.get(int(section.UnitFlag()), 1e-3)


@dataclass
class _Entities:
    """What one group or subfigure holds."""

    below: list[tuple[Product, Any]] = field(default_factory=list)
    faces: list[tuple[Any, Color | None]] = field(default_factory=list)


class _Model:
    """The entities of a file, and the products that they make."""

    def __init__(self, reader: Any, path: str) -> None:
        self.unit = _unit(reader)
        self._reader = reader
        self._path = path
        model = reader.IGESModel()
        # Held all the time: an entity is known again by being the same object.
        self._entities = [model.Entity(i) for i in range(1, model.NbEntities() + 1)]
        self._number = {id(entity): i for i, entity in enumerate(self._entities, start=1)}
        self._raw = {id(e): _name(e) for e in self._entities if _is_named(e)}
        self._encoding = sniff_encoding(sorted(set(self._raw.values())))
        self._members = {id(e.Value(k)) for e in self._entities if _holds(e) for k in range(1, e.NbEntities() + 1)}
        self._known: dict[int, Product | None] = {}
        self._taken: set[int] = set()
        self.findings: list[Finding] = encoding_remarks(self._encoding, path)
        damaged = sum(model.IsErrorEntity(i) or model.IsRedefinedContent(i) for i in self._number.values())
        if damaged:
            words = f"{damaged} entities of the file are damaged: parts may be missing or incomplete"
            self.findings.append(Finding("CAD001", "warning", path, words, EXPORT_AGAIN))

    def products(self) -> list[Product]:
        """The products that nothing else holds, in the file's order; loose surfaces are one."""
        held = _Entities()
        for entity in self._entities:
            if not self._is_inside(entity):
                self._take(entity, held, 0)
        for entity in self._entities:
            # Dependent on something that is not known here: better loose than lost.
            if entity.TypeNumber() in _WHOLE and not {id(entity)} & (self._taken | self._members):
                self._take(entity, held, 0)
        roots = [_moved(product, place) for product, place in held.below]
        if held.faces:
            roots.append(self._surfaces(Path(self._path).stem, held.faces, None))
        return roots

    def _is_inside(self, entity: Any) -> bool:
        """Whether an entity is there for another one only: a figure's definition, a solid's face, a group's member."""
        if entity.TypeNumber() == _FIGURE:
            return True
        return entity.SubordinateStatus() in (1, 3) or id(entity) in self._members

    def _take(self, entity: Any, held: _Entities, depth: int) -> None:
        """Adds what an entity is to what holds it."""
        kind = entity.TypeNumber()
        self._taken.add(id(entity))
        if depth > _DEEPEST:
            raise CadError("The IGES file is broken: a group holds itself", where=self._path, hint=EXPORT_AGAIN)
        if kind == _GROUP and _holds(entity):
            product = self._group(entity, depth)
            if product is not None:
                held.below.append((product, TopLoc_Location()))
        elif kind == _PLACED:
            figure = entity.Subfigure()
            product = self._group(figure, depth) if figure is not None else None
            if product is not None:
                held.below.append((product, _place(entity, self.unit)))
        elif kind == _SOLID:
            product = self._solid(entity)
            if product is not None:
                held.below.append((product, TopLoc_Location()))
        elif kind in _SURFACES:
            color = self._color(entity)
            held.faces += [(face, color) for shape in self._shapes(entity) for face in subshapes(shape, TopAbs_FACE)]

    def _group(self, entity: Any, depth: int) -> Product | None:
        """A group's or figure's product, made once; None where nothing of it has a surface."""
        number = self._number[id(entity)]
        if number not in self._known:
            held = _Entities()
            for k in range(1, entity.NbEntities() + 1):
                self._take(entity.Value(k), held, depth + 1)
            self._known[number] = self._joined(self._title(entity), held, self._color(entity))
        return self._known[number]

    def _joined(self, title: str, held: _Entities, color: Color | None) -> Product | None:
        if held.faces:
            own = self._surfaces(title, held.faces, color)
            if not held.below:
                return own
            held.below.append((own, TopLoc_Location()))
        if not held.below:
            return None
        first, place = held.below[0]
        if len(held.below) == 1 and (is_generic(title) or is_generic(first.name)):
            # A group of one, of which one name says something.
            return _moved(Product(title if is_generic(first.name) else first.name, first.shape, first.children,
                                  first.color or color, first.face_colors), place)  # fmt: skip
        return Product(title, None, held.below, color)

    def _solid(self, entity: Any) -> Product | None:
        shapes = self._shapes(entity)
        if not shapes:
            return None
        color = self._color(entity)
        faces = [(f, self._face_color(f)) for f in subshapes(shapes[0], TopAbs_FACE)]
        own = [(f, c) for f, c in faces if c is not None and c != color]
        return Product(self._title(entity), shapes[0], [], color, own)

    def _surfaces(self, title: str, faces: Sequence[tuple[Any, Color | None]], color: Color | None) -> Product:
        shape, sewn = closed([face for face, _ in faces])
        colors = {c for _, c in faces}
        if len(colors) == 1:
            return Product(title, shape, [], colors.pop() or color)
        own = [(new, c) for new, (_, c) in zip(sewn, faces, strict=True) if c is not None]
        return Product(title, shape, [], color, own)

    def _shapes(self, entity: Any) -> list[Any]:
        """What Open CASCADE makes of an entity, in millimetres."""
        before = self._reader.NbShapes()
        try:
            done = self._reader.TransferOne(self._number[id(entity)])
        except Standard_Failure:
            done = False
        if not done or self._reader.NbShapes() == before:
            words = f"Left out: entity {self._number[id(entity)]} (type {entity.TypeNumber()}) has no usable surface"
            self.findings.append(Finding("CAD003", "error", self._title(entity) or self._path, words, EXPORT_AGAIN))
            return []
        return [self._reader.Shape(self._reader.NbShapes())]

    def _face_color(self, face: Any) -> Color | None:
        made_from = self._reader.WS().TransferReader().EntityFromShapeResult(face, 1)
        return None if made_from is None or not hasattr(made_from, "RankColor") else self._color(made_from)

    def _color(self, entity: Any) -> Color | None:
        rank = entity.RankColor()
        if rank > 0:
            return _COLORS.get(rank)
        stated = entity.Color() if rank < 0 else None
        if stated is None:
            return None
        r, g, b = (min(max(v / 100.0, 0.0), 1.0) for v in stated.RGBIntensity())
        return linear((r, g, b))

    def _title(self, entity: Any) -> str:
        raw = self._raw.get(id(entity), b"")
        name = decode_name(raw.decode(self._encoding, errors="replace"), "utf-8")
        # Open CASCADE's own writer puts addresses where it has no name.
        return "" if name.startswith("=>[") else name


def _holds(entity: Any) -> bool:
    """Whether an entity is a group or the definition of a figure; 402 has forms that are neither."""
    return entity.TypeNumber() in (_GROUP, _FIGURE) and hasattr(entity, "NbEntities") and hasattr(entity, "Value")


def _is_named(entity: Any) -> bool:
    return entity.HasName() or entity.HasShortLabel() or entity.TypeNumber() == _FIGURE


def _name(entity: Any) -> bytes:
    """The bytes of an entity's name: a figure's own, a name property's, else its label."""
    text = entity.Name() if entity.TypeNumber() == _FIGURE else None
    if text is None or not text.Length():
        text = entity.NameValue() if entity.HasName() else entity.ShortLabel() if entity.HasShortLabel() else None
    if text is None:
        return b""
    # One character a byte, whatever they mean.
    return TCollection_ExtendedString(text.String(), False).ToExtString().encode("latin-1", errors="replace").strip()


def _place(entity: Any, unit: float) -> Any:
    """Where a subfigure is placed: scaled, moved, and then what its directory entry says; `unit` in metres."""
    own = gp_Trsf()
    own.SetScaleFactor(entity.ScaleFactor() or 1.0)
    own.SetTranslationPart(gp_Vec(entity.Translation()))
    if entity.HasTransf():
        stated, outer = entity.Location(), gp_Trsf()
        outer.SetValues(*(stated.Value(i, j) for i in (1, 2, 3) for j in (1, 2, 3, 4)))
        own = outer.Multiplied(own)
    own.SetTranslationPart(gp_Vec(own.TranslationPart()) * (unit / MILLIMETRE))
    return TopLoc_Location(own)


def _moved(product: Product, place: Any) -> Product:
    if place.IsIdentity():
        return product
    if product.shape is None:
        children = [(child, place * inner) for child, inner in product.children]
        return Product(product.name, None, children, product.color)
    return Product(product.name, None, [(product, place)], None)


def closed(faces: Sequence[Any]) -> tuple[Any, list[Any]]:
    """Faces sewn to a compound of shells, those that close as solids, right side out, and the faces that stay alone;
    and what has become of every face."""
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
    return found, [sewing.Modified(face) if sewing.IsModified(face) else face for face in faces]


def _solid(shell: Any) -> Any:
    solid = BRepBuilderAPI_MakeSolid(TopoDS.Shell(shell)).Solid()
    # A solid that holds the point at infinity is inside out.
    far = BRepClass3d_SolidClassifier(solid)
    far.PerformInfinitePoint(1e-3)
    if far.State() == TopAbs_IN:
        solid.Reverse()
    return solid
