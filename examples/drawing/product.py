"""The product tree of an example: parts, assemblies, and the STEP file they are written to.

Everything is designed in the machine frame (x forward, y left, z up; millimetres) and delivered in the frame of
the example's drawing office.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Tool
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.gp import gp_Trsf
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Interface import Interface_Static
from OCP.Message import Message
from OCP.Quantity import Quantity_Color, Quantity_TypeOfColor
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.STEPControl import STEPControl_StepModelType
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Shape
from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

from .solids import mirrored, moved

Colour = tuple[float, float, float]
YELLOW: Colour = (0.98, 0.72, 0.07)
GREY: Colour = (0.35, 0.36, 0.38)
BLACK: Colour = (0.08, 0.08, 0.09)
STEEL: Colour = (0.62, 0.64, 0.66)
CHROME: Colour = (0.85, 0.86, 0.88)
BRONZE: Colour = (0.72, 0.53, 0.25)
GLASS: Colour = (0.55, 0.72, 0.80)
RED: Colour = (0.75, 0.10, 0.08)
AMBER: Colour = (1.0, 0.55, 0.0)


@dataclass(eq=False)
class Part:
    """One shape of the file, used once or often."""

    name: str
    shape: TopoDS_Shape
    colour: Colour = YELLOW
    density: float = 7850.0


@dataclass(frozen=True)
class Use:
    """One occurrence in an assembly. `body` and `role` are the truth; inside a shared assembly they are tags
    that the assembly's own `Use.names` translates. A placement of None means that the child is drawn in the
    machine frame."""

    child: Part | Assembly
    placement: gp_Trsf | None = None
    body: str = ""
    role: str = ""
    names: dict[str, str] = field(default_factory=dict)


@dataclass(eq=False)
class Assembly:
    """A node of the product tree."""

    name: str
    uses: list[Use] = field(default_factory=list)

    def add(self, child: Part | Assembly, body: str = "", role: str = "", at: gp_Trsf | None = None) -> None:
        """One more occurrence; the role is the body's own unless given."""
        self.uses.append(Use(child, at, body, role or body))


def add_pair(tree: Assembly, name: str, shape: TopoDS_Shape, body: str, colour: Colour = YELLOW) -> None:
    """A part drawn on the left, and its mirror image on the right."""
    tree.add(Part(f"{name} LH", shape, colour), body)
    tree.add(Part(f"{name} RH", mirrored(shape), colour), body)


@dataclass(frozen=True)
class Occurrence:
    """A leaf of the tree: its path of product names, its place in the machine frame, and the truth about
    it."""

    path: str
    part: Part
    place: gp_Trsf
    body: str
    role: str


def occurrences(root: Assembly) -> list[Occurrence]:
    """Every leaf in tree order; the second of two equal paths ends in '#2', the third in '#3'."""
    seen: dict[str, int] = {}
    leaves: list[Occurrence] = []
    for path, part, place, body, role in _walk(root, root.name, gp_Trsf(), ()):
        seen[path] = seen.get(path, 0) + 1
        unique = path if seen[path] == 1 else f"{path}#{seen[path]}"
        leaves.append(Occurrence(unique, part, place, body, role))
    return leaves


def _walk(
    node: Assembly, path: str, place: gp_Trsf, names: tuple[dict[str, str], ...]
) -> Iterator[tuple[str, Part, gp_Trsf, str, str]]:
    for use in node.uses:
        here = place.Multiplied(use.placement) if use.placement else place
        below = f"{path}/{use.child.name}"
        if isinstance(use.child, Assembly):
            yield from _walk(use.child, below, here, (use.names, *names))
        else:
            body, role = use.body, use.role
            for table in names:
                body, role = table.get(body, body), table.get(role, role)
            yield below, use.child, here, body, role


def extent(leaves: Iterable[Occurrence], where: gp_Trsf | None = None) -> NDArray[np.float64]:
    """[[lowest x, y, z], [highest x, y, z]] of the parts in the machine frame, moved by `where`; exact,
    millimetres."""
    bounds = Bnd_Box()
    for leaf in leaves:
        place = where.Multiplied(leaf.place) if where else leaf.place
        BRepBndLib.AddOptimal_s(moved(leaf.part.shape, place), bounds, False, False)
    low, high = bounds.CornerMin(), bounds.CornerMax()
    return np.array([[low.X(), low.Y(), low.Z()], [high.X(), high.Y(), high.Z()]])


def farthest(leaves: Iterable[Occurrence], moves: Mapping[str, gp_Trsf]) -> float:
    """Greatest distance of the parts from the machine's upright axis, to a hundredth of a millimetre; `moves` carries
    the parts of a body."""
    shapes = []
    for leaf in leaves:
        place = moves[leaf.body].Multiplied(leaf.place) if leaf.body in moves else leaf.place
        shape, box = moved(leaf.part.shape, place), Bnd_Box()
        BRepBndLib.Add_s(shape, box, False)
        low, high = box.CornerMin(), box.CornerMax()
        reach = math.hypot(max(-low.X(), high.X(), 0.0), max(-low.Y(), high.Y(), 0.0))
        shapes.append((reach, shape))
    most = 0.0
    # Meshes are fine: only of what may reach farther than what was seen before, by its box.
    for reach, shape in sorted(shapes, key=lambda one: -one[0]):
        if reach < most:
            break
        BRepMesh_IncrementalMesh(shape, 0.01, False, 0.05)
        faces = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
        while faces.More():
            where = TopLoc_Location()
            mesh = BRep_Tool.Triangulation_s(TopoDS.Face(faces.Current()), where)
            for i in range(1, mesh.NbNodes() + 1):
                p = mesh.Node(i).Transformed(where.Transformation())
                most = max(most, math.hypot(p.X(), p.Y()))
            faces.Next()
    return most


def write_step(root: Assembly, path: Path, *, cad: gp_Trsf) -> None:
    """The tree as one STEP AP214 file, the same bytes every time; `cad` takes the machine frame to the file's."""
    document = TDocStd_Document(TCollection_ExtendedString("BinXCAF"))
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colours = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    made: dict[tuple[int, bool], TDF_Label] = {}

    def name(label: TDF_Label, text: str) -> None:
        TDataStd_Name.Set_s(label, TCollection_ExtendedString(text, True))

    def label_of(node: Part | Assembly, own_frame: bool) -> TDF_Label:
        key = (id(node), own_frame)
        if key in made:
            return made[key]
        if isinstance(node, Part):
            label = shapes.AddShape(node.shape if own_frame else moved(node.shape, cad), False)
            tint = Quantity_Color(*node.colour, Quantity_TypeOfColor.Quantity_TOC_sRGB)
            colours.SetColor(label, tint, XCAFDoc_ColorType.XCAFDoc_ColorSurf)
        else:
            label = shapes.NewShape()
            for use in node.uses:
                at = use.placement
                child = label_of(use.child, own_frame or at is not None)
                where = gp_Trsf() if at is None else (at if own_frame else cad.Multiplied(at))
                name(shapes.AddComponent(label, child, TopLoc_Location(where)), use.child.name)
        name(label, node.name)
        made[key] = label
        return label

    label_of(root, False)
    shapes.UpdateAssemblies()
    XCAFDoc_ShapeTool.SetAutoNaming_s(False)
    messenger = Message.DefaultMessenger_s()
    if not messenger.Printers().IsEmpty():  # once a process
        messenger.RemovePrinters(messenger.Printers().First().DynamicType())
    writer = STEPCAFControl_Writer()
    Interface_Static.SetCVal_s("write.step.schema", "AP214IS")
    Interface_Static.SetCVal_s("write.step.unit", "MM")
    Interface_Static.SetIVal_s("write.surfacecurve.mode", 0)
    writer.SetNameMode(True)
    writer.SetColorMode(True)
    writer.Transfer(document, STEPControl_StepModelType.STEPControl_AsIs)
    if writer.Write(str(path)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise OSError(f"the STEP file could not be written: {path}")
    text = path.read_text(encoding="utf-8")
    path.write_text(_sorted_colours(_plain_header(text, root.name)), encoding="utf-8", newline="\n")


def _plain_header(text: str, title: str) -> str:
    """A header without the time of day, the user or the machine it was written on."""
    head = (
        f"FILE_NAME('{title}','2025-01-01T00:00:00',('yellowiron example'),(''),"
        "'Open CASCADE','yellowiron example','');"
    )
    return re.sub(r"FILE_NAME\(.*?\);", lambda _: head, text, count=1, flags=re.S)


def _sorted_colours(text: str) -> str:
    """The colours at the end of the file in the order of what they colour; OpenCascade writes them in the
    order of its memory."""
    start = text.rindex("\n", 0, text.index("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION")) + 1
    end = text.index("ENDSEC;", start)
    statements = dict(re.findall(r"(#\d+) = (.*?);\n", text[start:end], flags=re.S))
    colours: list[tuple[int, str, str, str]] = []
    for statement in statements.values():
        if not statement.startswith("STYLED_ITEM"):
            continue
        style, item = re.findall(r"#\d+", statement)
        while not statements[style].startswith("COLOUR_RGB"):
            style = re.findall(r"#\d+", statements[style])[-1]
        own = next(key for key, value in statements.items() if value == statement)
        group = next(
            v for v in statements.values() if v.startswith("MECHANICAL") and own in re.findall(r"#\d+", v)[:-1]
        )
        rgb = ",".join(f"{float(c):.6g}" for c in re.findall(r"[\d.]+E?-?\d*", statements[style].split("'',")[1]))
        colours.append((int(item[1:]), item, re.findall(r"#\d+", group)[-1], rgb))
    n = int(text[start + 1 : text.index(" ", start)])
    lines: list[str] = []
    number: dict[str, int] = {}
    for _, item, context, rgb in sorted(colours):
        if rgb not in number:
            number[rgb] = n
            red_green_blue = ",".join(c if "." in c else f"{c}." for c in rgb.split(","))
            lines.append(f"#{n} = COLOUR_RGB('',{red_green_blue});")
            n += 1
        lines += [
            f"#{n} = MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(#{n + 1}),{context});",
            f"#{n + 1} = STYLED_ITEM('color',(#{n + 2}),{item});",
            f"#{n + 2} = PRESENTATION_STYLE_ASSIGNMENT((#{n + 3}));",
            f"#{n + 3} = SURFACE_STYLE_USAGE(.BOTH.,#{n + 4});",
            f"#{n + 4} = SURFACE_SIDE_STYLE('',(#{n + 5}));",
            f"#{n + 5} = SURFACE_STYLE_FILL_AREA(#{n + 6});",
            f"#{n + 6} = FILL_AREA_STYLE('',(#{n + 7}));",
            f"#{n + 7} = FILL_AREA_STYLE_COLOUR('',#{number[rgb]});",
        ]
        n += 8
    return text[:start] + "\n".join(lines) + "\n" + text[end:]
