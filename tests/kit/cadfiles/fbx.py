"""FBX 7.4 files, as text and binary, from one tree of records: a name, properties, records below."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np


@dataclass(eq=False)
class Title:
    """The name of an object, which the two forms write in different ways."""

    kind: str
    name: str


@dataclass(eq=False)
class Record:
    name: str
    properties: Sequence[Any] = ()
    below: Sequence[Record] = field(default_factory=list)


def settings(*, unit_cm: float, z_up: bool) -> Record:
    """The file's axes (right-handed) and unit."""
    axes = {"UpAxis": 2 if z_up else 1, "UpAxisSign": 1, "FrontAxis": 1 if z_up else 2}
    axes |= {"FrontAxisSign": -1 if z_up else 1, "CoordAxis": 0, "CoordAxisSign": 1}
    below = [Record("P", [key, "int", "Integer", "", value]) for key, value in axes.items()]
    below.append(Record("P", ["UnitScaleFactor", "double", "Number", "", float(unit_cm)]))
    return Record("GlobalSettings", [], [Record("Version", [1000]), Record("Properties70", [], below)])


def geometry(number: int, points: np.ndarray, triangles: np.ndarray, uvs: np.ndarray | None = None) -> Record:
    """Triangles in the file's unit, one material; `uvs` (m, 3, 2)."""
    corners = triangles.astype(np.int32).copy()
    corners[:, 2] = -corners[:, 2] - 1
    layers = [Record("LayerElement", [], [Record("Type", ["LayerElementMaterial"]), Record("TypedIndex", [0])])]
    head = [Record("Version", [101]), Record("Name", [""])]
    below = [
        Record("Vertices", [points.astype(np.float64).reshape(-1)]),
        Record("PolygonVertexIndex", [corners.reshape(-1)]),
        Record("GeometryVersion", [124]),
        Record("LayerElementMaterial", [0], [
            *head, Record("MappingInformationType", ["AllSame"]), Record("ReferenceInformationType", ["IndexToDirect"]),
            Record("Materials", [np.zeros(1, dtype=np.int32)]),
        ]),
    ]  # fmt: skip
    if uvs is not None:
        below.append(Record("LayerElementUV", [0], [

            *head, Record("MappingInformationType", ["ByPolygonVertex"]),
            Record("ReferenceInformationType", ["Direct"]),
            Record("UV", [uvs.astype(np.float64).reshape(-1)]),
        ]))  # fmt: skip
        layers.append(Record("LayerElement", [], [Record("Type", ["LayerElementUV"]), Record("TypedIndex", [0])]))
    below.append(Record("Layer", [0], [Record("Version", [100]), *layers]))
    return Record("Geometry", [number, Title("Geometry", ""), "Mesh"], below)


def material(number: int, name: str, color: Sequence[float]) -> Record:
    """A diffuse material."""
    paint = Record("P", ["DiffuseColor", "Color", "", "A", *(float(v) for v in color)])
    below = [Record("Version", [102]), Record("ShadingModel", ["lambert"]), Record("Properties70", [], [paint])]
    return Record("Material", [number, Title("Material", name), ""], below)


def model(
    number: int,
    name: str,
    matrix: np.ndarray,
    *,
    mesh: bool,
    scale: Sequence[float] = (1.0, 1.0, 1.0),
    bone: bool = False,
    further: Mapping[str, Sequence[float]] | None = None,
) -> Record:
    """A node: a rigid (4, 4) placement in the file's unit, as translation and Euler angles about X first; scale;
    `further` vectors of its transform (`RotationPivot`, `GeometricTranslation` …)."""
    r = matrix[:3, :3]
    angles = np.degrees([np.arctan2(r[2, 1], r[2, 2]), np.arcsin(-r[2, 0]), np.arctan2(r[1, 0], r[0, 0])])
    parts = {"Translation": matrix[:3, 3], "Rotation": angles, "Scaling": scale}
    rows = [
        Record("P", [f"Lcl {key}", f"Lcl {key}", "", "A", *(float(v) for v in values)]) for key, values in parts.items()
    ]
    for key, values in (further or {}).items():
        rows.append(Record("P", [key, "Vector3D", "Vector", "", *(float(v) for v in values)]))
    kind = "Mesh" if mesh else "LimbNode" if bone else "Null"
    below = [Record("Version", [232]), Record("Properties70", [], rows)]
    return Record("Model", [number, Title("Model", name), kind], below)


def texture(number: int, file: str) -> Record:
    """A picture beside the file."""
    below = [Record("Type", ["TextureVideoClip"]), Record("Version", [202])]
    below += [Record("FileName", [f"C:\\work\\{file}"]), Record("RelativeFilename", [file])]
    return Record("Texture", [number, Title("Texture", "picture"), ""], below)


def write(
    path: Path,
    objects: Sequence[Record],
    links: Sequence[tuple[int, int] | tuple[int, int, str]],
    *,
    unit_cm: float = 1.0,
    z_up: bool = True,
    binary: bool = False,
) -> Path:
    """Writes objects and what hangs below what (0 is the root; a third entry is the property that is meant)."""
    header = Record("FBXHeaderExtension", [], [Record("FBXHeaderVersion", [1003]), Record("FBXVersion", [7400])])
    rows = [Record("C", ["OP" if len(link) > 2 else "OO", *link]) for link in links]
    tree = [
        header,
        settings(unit_cm=unit_cm, z_up=z_up),
        Record("Objects", [], objects),
        Record("Connections", [], rows),
    ]
    if not binary:
        text = "".join(_text(record, 0) for record in tree)
        path.write_text(f"; FBX 7.4.0 project file\n{text}", encoding="utf-8")
        return path
    data = b"Kaydara FBX Binary  \x00\x1a\x00" + struct.pack("<I", 7400)
    for record in tree:
        data += _binary(record, len(data))
    path.write_bytes(data + bytes(13))
    return path


def _text(record: Record, depth: int) -> str:
    def shown(value: Any) -> str:
        if isinstance(value, Title):
            return f'"{value.kind}::{value.name}"'
        if isinstance(value, np.ndarray):
            form = "d" if value.dtype == np.int32 else ".15g"
            return f"*{value.size} {{ a: {','.join(format(v, form) for v in value.tolist())} }}"
        return f'"{value}"' if isinstance(value, str) else format(value, "d" if isinstance(value, int) else ".15g")

    indent = "\t" * depth
    line = f"{indent}{record.name}: {','.join(shown(v) for v in record.properties)}"
    if not record.below:
        return line + (" {\n" + indent + "}\n" if not record.properties else "\n")
    return f"{line} {{\n{''.join(_text(r, depth + 1) for r in record.below)}{indent}}}\n"


def _binary(record: Record, at: int) -> bytes:
    def packed(value: Any) -> bytes:
        if isinstance(value, np.ndarray):
            kind, data = (b"i", value.astype("<i4")) if value.dtype == np.int32 else (b"d", value.astype("<f8"))
            return kind + struct.pack("<III", value.size, 0, data.nbytes) + data.tobytes()
        if isinstance(value, float):
            return b"D" + struct.pack("<d", value)
        if isinstance(value, int):
            # Numbers of objects are long, all others short.
            long = record.name in ("C", "Geometry", "Material", "Model", "Texture")
            return b"L" + struct.pack("<q", value) if long else b"I" + struct.pack("<i", value)
        text = f"{value.name}\0\x01{value.kind}" if isinstance(value, Title) else value
        return b"S" + struct.pack("<I", len(text.encode())) + text.encode()

    name, properties = record.name.encode(), b"".join(packed(v) for v in record.properties)
    head = 13 + len(name)
    below = b""
    for one in record.below:
        below += _binary(one, at + head + len(properties) + len(below))
    below += bytes(13) if record.below else b""
    end = at + head + len(properties) + len(below)
    return struct.pack("<IIIB", end, len(record.properties), len(properties), len(name)) + name + properties + below
