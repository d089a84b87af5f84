"""A FreeCAD file to an `Assembly`. Runs in the guard's child process.

The file is an archive: `Document.xml` lists objects with labels and placements, `GuiDocument.xml` those that are shown
and their colours; the shapes are BREP files beside it, in millimetres. Objects that others are made from are hidden, or
used by them.
"""

from __future__ import annotations

import itertools
import struct
import zipfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from xml.etree import ElementTree

from OCP.gp import gp_Pnt, gp_Quaternion, gp_Trsf, gp_Vec
from OCP.TopAbs import TopAbs_FACE
from OCP.TopLoc import TopLoc_Location

from yellowiron.cad.bounds import limited
from yellowiron.cad.brep import products
from yellowiron.cad.brep.to_shape import subshapes
from yellowiron.cad.brep.xcaf import Product, ProductTree, add_products, new_document
from yellowiron.cad.naming import decode_name
from yellowiron.cad.readers.exact.brep_file import shape_in
from yellowiron.cad.readers.exact.patience import file_must_end
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, linear

_DAMAGED = "Copy or save it again; the file is damaged."
_GROUPS = ("App::Part", "App::DocumentObjectGroup", "Assembly::AssemblyObject", "App::LinkGroup")
_LINKS = ("App::Link", "App::LinkElement")
_SOLID = ("Part::Feature", "PartDesign::Body")
_LARGEST = 1024**3
"""Bytes of one file of an archive when unpacked."""
_LARGEST_PALETTE = 64 * 1024**2
_PALETTES = {"DiffuseColor": ("ColorList", 4, 0), "ShapeAppearance": ("MaterialList", 24, 4)}
"""Lists of colours: their element, the bytes of an entry, and where its diffuse colour is."""
_DEEPEST = 50


@dataclass
class _Object:
    """An object of a FreeCAD document: what it is called, where it is, and what it is made of."""

    name: str
    kind: str
    label: str
    file: str = ""
    place: Any = None
    uses: list[str] = field(default_factory=list)
    members: list[str] = field(default_factory=list)
    linked: str = ""
    shown: bool = True
    color: Color | None = None
    stated: bool = False
    """Whether it says that it has a shape."""
    doubtful: bool = False
    """Whether what says that it is shown is damaged."""
    palette: list[Color] = field(default_factory=list)
    """A colour for every face of its shape."""


def read_freecad(path: str) -> Assembly:
    """The assembly in a FreeCAD file, in metres. `CadError` if it is damaged or shows no shape."""
    try:
        with zipfile.ZipFile(path) as archive:
            root = ElementTree.fromstring(archive.read("Document.xml"))
            objects = _objects(root)
            if "GuiDocument.xml" in archive.namelist():
                _looks(ElementTree.fromstring(archive.read("GuiDocument.xml")), objects, archive)
            shapes = _shapes(archive, objects, path)
    except (zipfile.BadZipFile, ElementTree.ParseError, KeyError, ValueError, EOFError, NotImplementedError) as error:
        raise CadError(f"The FreeCAD file is broken: {error}", where=path, hint=_DAMAGED) from error
    document = _Document(objects, shapes, path, limited(itertools.count(), path))
    owned = {m for o in objects.values() for m in o.members}
    roots: list[tuple[Product, Any]] = []
    for name in objects:
        if name not in owned:
            _add(roots, name, TopLoc_Location(), document)
    with file_must_end(Path(path).stat().st_size):
        made = new_document()
        add_products(made, [_at(product, place) for product, place in roots])
        tree = ProductTree(made, "utf-8", path)
        return products.assemble(tree, path=path, format="FreeCAD", unit=1e-3, findings=_damage(root, objects, path))


def _at(product: Product, place: Any) -> Product:
    """A product that nothing holds, at its place."""
    if product.shape is None or place.IsIdentity():
        return product
    faces = [(face.Moved(place), color) for face, color in product.face_colors]
    return replace(product, shape=product.shape.Moved(place), face_colors=faces)


@dataclass(frozen=True)
class _Document:
    """A document's objects by name, the shapes of those that have one, and the file."""

    objects: Mapping[str, _Object]
    shapes: Mapping[str, Any]
    path: str
    steps: Iterator[int]
    """A number for every object that is placed, as far as they go."""


def _add(
    held: list[tuple[Product, Any]], name: str, outer: Any, document: _Document, depth: int = 0, label: str = ""
) -> None:
    """Adds an object, and what it groups or links to, at its place; `outer` is from the document's origin."""
    next(document.steps)
    one = document.objects.get(name)
    if one is None or (not one.shown and not label):
        return
    if depth > _DEEPEST:
        raise CadError("The FreeCAD file is broken: an object holds itself", where=document.path, hint=_DAMAGED)
    place = outer if one.place is None else outer * one.place
    # Types of groups and links are many, and a damaged one holds what it held.
    if one.kind in _GROUPS or (one.members and not one.file):
        inner: list[tuple[Product, Any]] = []
        for member in one.members:
            _add(inner, member, place, document, depth + 1)
        if inner:
            held.append((Product(label or one.label, None, inner), TopLoc_Location()))
    elif one.kind in _LINKS or (one.linked and not one.file):
        target = document.objects.get(one.linked)
        if target is not None:
            # A link has a place of its own instead of its target's.
            undo = target.place.Inverted() if target.place is not None else TopLoc_Location()
            _add(held, one.linked, place * undo, document, depth + 1, one.label)
    elif name in document.shapes and (label or not _is_used(one, document.objects)):
        # The shape's file has its object's own place in it.
        shape = document.shapes[name]
        faces = subshapes(shape, TopAbs_FACE)
        painted = list(zip(faces, one.palette, strict=True)) if len(faces) == len(one.palette) > 1 else []
        held.append((Product(label or one.label, shape, [], one.color, painted), outer))


def _is_used(one: _Object, objects: Mapping[str, _Object]) -> bool:
    """Whether another object was made from this one: a body from its features, a cut from two bodies."""
    return any(one.name in other.uses and other.file for other in objects.values())


def _damage(root: ElementTree.Element, objects: Mapping[str, _Object], path: str) -> list[Finding]:
    """A finding for what shows that an object is lost: names that lead nowhere, shapes that nothing says."""
    listed = {e.get("name", "") for e in root.iterfind("./Objects/Object")}
    named = {n for o in objects.values() for n in (*o.members, o.linked) if n}
    gone = sorted((listed | named) - set(objects) | set(objects) - listed)
    words = [f"objects are named that are not there ({', '.join(gone[:5])})"] if gone else []
    bare = sorted(o.label for o in objects.values() if o.kind in _SOLID and o.shown and not o.stated)
    words += [f"objects have no shape ({', '.join(bare[:5])})"] if bare else []
    hidden = sorted(o.label for o in objects.values() if o.doubtful)
    words += [f"whether objects are shown cannot be read ({', '.join(hidden[:5])})"] if hidden else []
    if not words:
        return []
    return [Finding("CAD001", "warning", path, f"{'; '.join(words)}: parts may be missing", _DAMAGED)]


def _objects(root: ElementTree.Element) -> dict[str, _Object]:
    kinds = {e.get("name", ""): e.get("type", "") for e in root.iterfind("./Objects/Object")}
    found: dict[str, _Object] = {}
    for entry in root.iterfind("./ObjectData/Object"):
        name = entry.get("name", "")
        one = _Object(name, kinds.get(name, ""), name)
        for item in entry.iterfind("./Properties/Property"):
            key = item.get("name", "")
            links = [v for e in item.iter() if e.tag in ("Link", "LinkSub") and (v := e.get("value"))]
            if key == "Label":
                one.label = decode_name(next((e.get("value", "") for e in item.iter("String")), name), "utf-8")
            elif key == "Shape":
                one.stated = True
                one.file = next((e.get("file", "") for e in item.iter("Part")), "")
            elif key in ("Placement", "LinkPlacement") and one.place is None:
                one.place = next((_location(e) for e in item.iter("PropertyPlacement")), None)
            elif key == "Group":
                one.members = links
            elif key == "LinkedObject":
                one.linked = next((e.get("name") or e.get("value") or "" for e in item.iter("XLink")), "") or (
                    links[0] if links else ""
                )
            elif key not in ("Origin", "_GroupTouched"):
                one.uses += links
        if one.kind == "PartDesign::Body":
            one.uses += one.members
            one.members = []
        found[name] = one
    return found


def _location(entry: ElementTree.Element) -> Any:
    px, py, pz, *quaternion = (float(entry.get(key, "0")) for key in ("Px", "Py", "Pz", "Q0", "Q1", "Q2", "Q3"))
    turn = gp_Trsf()
    if any(quaternion):
        turn.SetRotation(gp_Quaternion(*quaternion))
    turn.SetTranslationPart(gp_Vec(gp_Pnt(), gp_Pnt(px, py, pz)))
    return TopLoc_Location(turn)


def _looks(root: ElementTree.Element, objects: Mapping[str, _Object], archive: zipfile.ZipFile) -> None:
    """Which objects are shown, and in which colours: one, or one a face (packed RGBA, sRGB). They stand in the
    document up to FreeCAD 0.21 (`DiffuseColor` in a file of its own), in `ShapeAppearance` since 1.0."""
    for entry in root.iterfind("./ViewProviderData/ViewProvider"):
        one = objects.get(entry.get("name", ""))
        if one is None:
            continue
        for item in entry.iterfind("./Properties/Property"):
            key = item.get("name", "")
            if key == "Visibility":
                said = [e.get("value") for e in item.iter("Bool")]
                one.shown, one.doubtful = "true" in said, said not in (["true"], ["false"])
            elif key == "ShapeColor":
                packed = next((int(e.get("value", "0")) for e in item.iter("PropertyColor")), None)
                one.color = None if packed is None else _unpacked(packed)
            elif key in _PALETTES:
                tag, size, at = _PALETTES[key]
                file = next((e.get("file", "") for e in item.iter(tag)), "")
                one.palette = _palette(archive, file, size, at)
                if len(one.palette) == 1:
                    one.color = one.palette[0]


def _palette(archive: zipfile.ZipFile, file: str, size: int, at: int) -> list[Color]:
    """The colours in a list of an archive: how many there are, then `size` bytes each, the colour `at` so many."""
    if file not in archive.namelist() or archive.getinfo(file).file_size > _LARGEST_PALETTE:
        return []
    data = archive.read(file)
    count = struct.unpack_from("<I", data)[0] if len(data) >= 4 else 0
    if len(data) < 4 + count * size:
        return []
    return [_unpacked(struct.unpack_from("<I", data, 4 + n * size + at)[0]) for n in range(count)]


def _unpacked(packed: int) -> Color:
    return linear([(packed >> shift & 255) / 255.0 for shift in (24, 16, 8)])


def _shapes(archive: zipfile.ZipFile, objects: Mapping[str, _Object], path: str) -> dict[str, Any]:
    """The shape of every object that has one."""
    shapes: dict[str, Any] = {}
    with TemporaryDirectory(prefix="yellowiron-") as folder:
        for name, one in objects.items():
            if not one.file or archive.getinfo(one.file).file_size == 0:
                continue
            if archive.getinfo(one.file).file_size > _LARGEST:
                raise CadError(f"{one.file} unpacks to more than 1 GB", where=path, hint="Save it in parts.")
            # Under a name of ours: the archive's may lead anywhere.
            copy = Path(folder, f"shape{len(shapes)}")
            copy.write_bytes(archive.read(one.file))
            shapes[name] = shape_in(str(copy), path)
    return shapes
