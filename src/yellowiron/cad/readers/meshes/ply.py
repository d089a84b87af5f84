"""A PLY file to an `Assembly`: a part for every piece of connected triangles. Runs in the guard's child process.

PLY has no names, no tree and no unit; colours may stand at faces or points.
"""

from __future__ import annotations

import re
import struct
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.cad.appearance.looks import Dressed, repainted
from yellowiron.cad.mesh import assembly
from yellowiron.cad.mesh.assembly import Occurrence
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats, Mesh

_ELEMENT = re.compile(rb"^element[ \t]+(\w+)[ \t]+(\d{1,18})[ \t]*\r?$", re.MULTILINE)
_TEXT = re.compile(rb"^format[ \t]+ascii", re.MULTILINE)
_DAMAGED = "Copy or export it again; the file is damaged."


def read_ply(path: str) -> Assembly:
    """The assembly in a PLY file, text or binary, in metres. `CadError` if it is damaged or holds no triangle."""
    findings: list[Finding] = []
    raw = _mesh(Path(path), findings)
    unit, remarks = assembly.guessed_unit([raw.points], path)
    findings += remarks
    mesh = Mesh(raw.points * unit, raw.triangles, None, raw.triangle_colors)
    pieces = assembly.pieces(mesh) if np.isfinite(mesh.points).all() else [mesh]
    name = Path(path).stem
    return assembly.assemble(
        [Occurrence(name, (), one.mesh, np.eye(4), one.color) for one in map(repainted, pieces)],
        name=name, format="PLY", unit=unit, path=path, findings=findings,
    )  # fmt: skip


def _require_room(data: bytes, path: str) -> None:
    """`CadError` where the header declares more than the file has bytes for."""
    declared = sum(int(count) for _, count in _ELEMENT.findall(data.partition(b"end_header")[0]))
    if declared > len(data):
        words = f"The PLY file declares {declared} points and faces and has {len(data)} bytes: it is truncated, or lies"
        raise CadError(words, where=path, hint=_DAMAGED)


def _damage(data: bytes, read: int, path: str) -> list[Finding]:
    """A finding where a file holds another number of lines or faces than its header says."""
    head, _, body = data.partition(b"end_header")
    counts = {name: int(count) for name, count in _ELEMENT.findall(head)}
    held, stated = sum(map(bool, map(bytes.strip, body.split(b"\n")))), sum(counts.values())
    words = ""
    if _TEXT.search(head) and held != stated:
        words = f"The header declares {stated} lines, and {held} follow"
    elif read < counts.get(b"face", 0):
        words = f"The header declares {counts[b'face']} faces, of which {read} were read"
    return [Finding("CAD001", "warning", path, f"{words}: parts may be incomplete", _DAMAGED)] if words else []


def meshes_of(file: Path, findings: list[Finding]) -> list[tuple[str, Dressed]]:
    """The triangles of a PLY file, in the file's unit, without a name; what is amiss goes to `findings`. `CadError` as
    for `read_ply`."""
    return [("", repainted(_mesh(file, findings)))]


def _mesh(file: Path, findings: list[Finding]) -> Mesh:
    from trimesh.exchange.ply import load_ply

    path, data = str(file), file.read_bytes()
    if b"end_header" not in data[:65536]:
        raise CadError("The PLY file is truncated: its header has no end", where=path, hint=_DAMAGED)
    _require_room(data, path)
    try:
        loaded: dict[str, Any] = load_ply(BytesIO(data))
    except (ValueError, IndexError, KeyError, TypeError, struct.error) as error:
        raise CadError(f"The PLY file is broken: {error}", where=path, hint=_DAMAGED) from error
    points = np.asarray(loaded.get("vertices", []), dtype=np.float64).reshape(-1, 3)
    triangles = np.asarray(loaded.get("faces", []), dtype=np.int64).reshape(-1, 3)
    if not len(triangles):
        raise CadError("The PLY file holds no triangle", where=path, hint="Export surfaces, not a cloud of points.")
    if not 0 <= triangles.min() <= triangles.max() < len(points):
        raise CadError("The PLY file is broken: its faces name points that are not there", where=path, hint=_DAMAGED)
    findings += _damage(data, len(triangles), path)
    return Mesh(points, triangles.astype(np.int32), None, _colors(loaded, triangles))


def _colors(loaded: dict[str, Any], triangles: np.ndarray[Any, Any]) -> Floats | None:
    """(m, 3) colours of the triangles: the faces' own, else the mean of their corners'."""
    faces, corners = loaded.get("face_colors"), loaded.get("vertex_colors")
    if faces is not None and len(faces) == len(triangles):
        return np.asarray(faces, dtype=np.float64)[:, :3] / 255.0
    if corners is not None and len(corners) > triangles.max():
        return np.asarray(np.asarray(corners, dtype=np.float64)[:, :3][triangles].mean(axis=1) / 255.0)
    return None
