"""An STL file to an `Assembly`: a part for every piece of connected triangles. Runs in the guard's child process.

STL has no names (but of solids, in text), no tree, no colours and no unit.
"""

from __future__ import annotations

import struct
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.cad import placed
from yellowiron.cad.naming import decode_name, is_generic
from yellowiron.cad.placed import Occurrence
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.geometry import Mesh

_HEADER, _TRIANGLE = 84, 50
_DAMAGED = "Copy or export it again; the file is damaged."


def read_stl(path: str) -> Assembly:
    """The assembly in an STL file, binary or text, in metres. `CadError` if it is cut short, if it holds another number
    of triangles than it says, or none."""
    solids = solids_of(Path(path))
    unit, findings = placed.guessed_unit([mesh.points for _, mesh in solids], path)
    occurrences = []
    for name, mesh in solids:
        mesh = Mesh(mesh.points * unit, mesh.triangles)
        # What is not a number is left in one piece, for the check of every part to name it.
        pieces = placed.pieces(mesh) if np.isfinite(mesh.points).all() else [mesh]
        title = name if name and not is_generic(name) else Path(path).stem
        occurrences += [Occurrence(title, (), piece, np.eye(4)) for piece in pieces]
    return placed.assemble(
        occurrences, name=Path(path).stem, format="STL", unit=unit, path=path, findings=findings,
    )  # fmt: skip


def solids_of(file: Path) -> list[tuple[str, Mesh]]:
    """Name and triangles of every solid, in the file's unit. `CadError` as for `read_stl`."""
    data = file.read_bytes()
    _check(data, str(file))
    return _solids(data, str(file))


def _check(data: bytes, path: str) -> None:
    """`CadError` where the file's length is not what it says, or its text has no end."""
    count = struct.unpack_from("<I", data, 80)[0] if len(data) >= _HEADER else 0
    length = _HEADER + count * _TRIANGLE
    if len(data) == length:
        return
    if data.lstrip()[:5].lower() == b"solid" and b"\0" not in data[:1024]:
        if data.lower().count(b"endsolid") == 0:
            words = "The STL file is truncated: its text has no 'endsolid'"
            raise CadError(words, where=path, hint=_DAMAGED)
        return
    held = (len(data) - _HEADER) // _TRIANGLE if len(data) >= _HEADER else 0
    words = f"The STL file declares {count} triangles and has room for {held}: it is truncated, or lies"
    raise CadError(words, where=path, hint=_DAMAGED)


def _solids(data: bytes, path: str) -> list[tuple[str, Mesh]]:
    """Name and triangles of every solid, in the file's unit."""
    from trimesh.exchange.stl import load_stl

    try:
        loaded: dict[str, Any] = load_stl(BytesIO(data))
    except ValueError as error:
        raise CadError(f"The STL file is broken: {error}", where=path, hint=_DAMAGED) from error
    found = loaded["geometry"].values() if "geometry" in loaded else [loaded]
    solids = []
    for entry in found:
        points = np.asarray(entry["vertices"], dtype=np.float64).reshape(-1, 3)
        triangles = np.asarray(entry["faces"], dtype=np.int32).reshape(-1, 3)
        name = decode_name(str(entry.get("metadata", {}).get("name") or ""), "utf-8")
        solids.append((name, Mesh(points, triangles)))
    return solids
