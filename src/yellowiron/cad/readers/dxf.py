"""A DXF file's 3D content to an `Assembly`: a part for every block that is placed, else for every layer. Runs in the
guard's child process.

Read are meshes, polyfaces and 3D faces. Solids in ACIS's own form (3DSOLID, BODY, REGION) cannot be: that is said.
"""

from __future__ import annotations

import re
import struct
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.cad.appearance.looks import Dressed, Look, dress
from yellowiron.cad.bounds import limited, require_occurrences
from yellowiron.cad.mesh import assembly, polygons
from yellowiron.cad.mesh.assembly import Occurrence
from yellowiron.cad.naming import decode_name
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Mesh, linear

_DAMAGED = "Copy or export it again; the file is damaged."
_ACIS = ("3DSOLID", "BODY", "REGION", "SURFACE", "EXTRUDEDSURFACE", "LOFTEDSURFACE", "REVOLVEDSURFACE", "SWEPTSURFACE")
_STEP = "Export the solids as STEP from the program that made the drawing; they are kept in a form that is not open."
_BINARY = b"AutoCAD Binary DXF"
_DRAWN = ("INSERT", "3DFACE", "MESH", "POLYLINE")
"""Entities that draw in space, or place what does."""
_MARKED = {"INSERT": b"AcDbBlockReference", "3DFACE": b"AcDbFace", "MESH": b"AcDbSubDMesh"}
"""What else stands in some of them, once, since release 13; in tables the first one does, too."""
_TABLE = b"ACAD_TABLE"
_DEEPEST = 20


def read_dxf(path: str) -> Assembly:
    """The assembly in a DXF file, in metres. `CadError` if it is damaged, or holds no 3D content that is readable."""
    document, faults = opened(path, path)
    return assembled(document, path, "DXF", faults)


def opened(file: str, path: str) -> tuple[Any, int]:
    """The drawing in a DXF file, text or binary, and how many of its values and entities were damaged; errors name
    `path`."""
    import ezdxf.audit
    from ezdxf import recover

    data = Path(file).read_bytes()
    try:
        if data.startswith(_BINARY):
            document = ezdxf.readfile(file)
            auditor = document.audit()
        else:
            document, auditor = recover.readfile(file)
    except (OSError, ezdxf.DXFError, ValueError, struct.error, IndexError) as error:
        raise CadError(f"The DXF file cannot be read: {error}", where=path, hint=_DAMAGED) from error
    # A letter in no known encoding is none: names are written in all kinds of them.
    codes = ezdxf.audit.AuditError
    lost = sum(entry.code == codes.UNDEFINED_BLOCK for entry in auditor.fixes)
    lost += sum(entry.code != codes.DECODING_ERROR for entry in auditor.errors)
    # Some damaged entities are dropped, or taken for others, without a word.
    held = Counter(entity.dxftype() for block in document.blocks for entity in block)
    dropped = _written(data, 0, map(str.encode, _DRAWN)) - sum(held[kind] for kind in _DRAWN)
    marked = _written(data, 100, _MARKED.values()) - _written(data, 0, [_TABLE]) - sum(held[kind] for kind in _MARKED)
    return document, max(lost, dropped, marked)


def _written(data: bytes, code: int, words: Iterable[bytes]) -> int:
    """How often a text or binary file has one of the words as the value of a group."""
    either = b"|".join(words)
    text = rb"^[ \t]*%d[ \t]*\r?\n[ \t]*(?:%s)[ \t]*\r?$" % (code, either)
    # Group codes take two bytes; one until release 12, after the end of a word.
    packed = rb"%s\0(?:%s)\0" % (re.escape(bytes([code])), either)
    return len(re.findall(packed if data.startswith(_BINARY) else text, data, re.MULTILINE))


def assembled(document: Any, path: str, format: str, faults: int = 0) -> Assembly:
    """The assembly in a drawing of ezdxf's, in metres. `CadError` if it holds no 3D content that is readable."""
    from ezdxf import units

    blocks: dict[str, list[tuple[str, Dressed]]] = {}
    acis = 0
    lost: list[str] = []
    require_occurrences(_declared(document.modelspace(), {}, 0), path)
    placements = list(limited(_inserted(document.modelspace(), (), np.eye(4), 0, lost), path))
    raw: list[tuple[tuple[str, ...], str, Dressed, Floats]] = []
    for names, layout, transform in placements:
        key = layout.block_record_handle if hasattr(layout, "block_record_handle") else layout.layout_key
        acis += sum(1 for e in layout if e.dxftype() in _ACIS)
        if key not in blocks:
            blocks[key] = list(_meshes(layout, document))
        # A block is a part; loose geometry is one a layer.
        for layer, one in blocks[key]:
            raw.append((names[:-1], names[-1] if names else layer, one, transform))
    if not raw:
        held = f"{acis} ACIS solids and no mesh" if acis else "no 3D faces"
        words = f"The {format} file holds {held}"
        raise CadError(words, where=path, hint=_STEP)
    code = document.units
    findings: list[Finding] = []
    if code:
        unit = float(units.conversion_factor(code, units.M))
    else:
        unit, findings = assembly.guessed_unit([_at(one.mesh.points, t) for _, _, one, t in raw], path)
    scaled = {id(one): replace(one.mesh, points=one.mesh.points * unit) for _, _, one, _ in raw}
    occurrences = []
    for above, name, one, transform in raw:
        place = transform.copy()
        place[:3, 3] *= unit
        occurrences.append(Occurrence(name, above, scaled[id(one)], place, one.color))
    if lost:
        words = f"{len(lost)} blocks are placed and hold nothing: {', '.join(sorted(set(lost))[:5])}"
        findings.append(Finding("CAD001", "warning", path, words, _DAMAGED))
    if faults:
        words = f"{faults} values or entities of the drawing are damaged: parts may be missing or misshapen"
        findings.append(Finding("CAD001", "warning", path, words, _DAMAGED))
    if acis:
        words = f"{acis} ACIS solids of the drawing cannot be read"
        findings.append(Finding("CAD001", "warning", path, words, _STEP))
    return assembly.assemble(
        occurrences, name=Path(path).stem, format=format, unit=unit, path=path, findings=findings,
    )  # fmt: skip


def _at(points: Floats, transform: Floats) -> Floats:
    return np.asarray(points @ transform[:3, :3].T + transform[:3, 3])


def _declared(layout: Any, known: dict[tuple[str, int], int], depth: int) -> int:
    """How many occurrences of it and of blocks a layout comes to; a few blocks that hold rows of each other are more
    than anybody can count one by one."""
    count = 1
    for insert in layout.query("INSERT") if depth < _DEEPEST else ():
        key = insert.dxf.name, depth
        if key not in known:
            block = insert.block()
            known[key] = _declared(block, known, depth + 1) if block is not None else 0
        count += max(1, insert.mcount) * known[key]
    return count


def _inserted(
    layout: Any, names: tuple[str, ...], transform: Floats, depth: int, lost: list[str]
) -> Iterator[tuple[tuple[str, ...], Any, Floats]]:
    """A layout and every block placed in it, with names from outermost, and (4, 4) transforms; `lost` are the names of
    those that are not there, or empty."""
    yield names, layout, transform
    if depth >= _DEEPEST:
        return
    for insert in layout.query("INSERT"):
        block = insert.block()
        if block is None or not len(block):
            lost.append(str(insert.dxf.get("name", "?")))
            continue
        title = decode_name(insert.dxf.name, "utf-8")
        copies = insert.multi_insert() if insert.mcount > 1 else [insert]
        for one in copies:
            # ezdxf's matrices take row vectors.
            own = np.array(list(one.matrix44()), dtype=np.float64).reshape(4, 4).T
            yield from _inserted(block, (*names, title), transform @ own, depth + 1, lost)


def _meshes(layout: Any, document: Any) -> Iterator[tuple[str, Dressed]]:
    """A layout's own geometry, one mesh a layer: its name, triangles in the file's unit, colours."""
    points: dict[str, list[Floats]] = {}
    triangles: dict[str, list[Any]] = {}
    colors: dict[str, list[tuple[Color | None, int]]] = {}
    count: dict[str, int] = {}
    for entity in layout:
        for vertices, faces in _faces(entity):
            layer = entity.dxf.layer
            start = count.get(layer, 0)
            count[layer] = start + len(vertices)
            counts = [len(f) for f in faces]
            cut, _ = polygons.fans(counts, [i for f in faces for i in f])
            points.setdefault(layer, []).append(np.array(vertices, dtype=np.float64).reshape(-1, 3))
            triangles.setdefault(layer, []).append(cut + start)
            colors.setdefault(layer, []).append((_color(entity, document), len(cut)))
    for layer in points:
        mesh = Mesh(np.concatenate(points[layer]), np.concatenate(triangles[layer]).astype(np.int32))
        looks = list(dict.fromkeys(Look(color) for color, _ in colors[layer]))
        rows = np.repeat([looks.index(Look(color)) for color, _ in colors[layer]], [n for _, n in colors[layer]])
        yield decode_name(layer, "utf-8"), dress(mesh, looks, rows)


def _faces(entity: Any) -> Iterator[tuple[Any, Any]]:
    """Vertices and faces of what an entity draws in space."""
    from ezdxf.render import MeshBuilder

    kind = entity.dxftype()
    if kind == "3DFACE":
        corners = entity.wcs_vertices()
        yield [tuple(c) for c in corners], [list(range(len(corners)))]
    elif kind == "MESH":
        found = MeshBuilder.from_mesh(entity)
        yield [tuple(v) for v in found.vertices], found.faces
    elif kind == "POLYLINE" and (entity.is_poly_face_mesh or entity.is_polygon_mesh):
        found = MeshBuilder.from_polyface(entity)
        yield [tuple(v) for v in found.vertices], found.faces


def _color(entity: Any, document: Any) -> Color | None:
    """An entity's colour, or its layer's (sRGB), in linear RGB; None where a block decides."""
    from ezdxf import colors

    if entity.dxf.hasattr("true_color"):
        rgb = colors.int2rgb(entity.dxf.true_color)
    else:
        index = entity.dxf.color
        if index == 256 and entity.dxf.layer in document.layers:
            index = abs(document.layers.get(entity.dxf.layer).dxf.color)
        if not 0 < index < 256:
            return None
        rgb = colors.aci2rgb(index)
    return linear([v / 255.0 for v in rgb])
