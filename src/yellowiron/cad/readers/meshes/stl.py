"""An STL file to an `Assembly`: a part for every piece of connected triangles. Runs in the guard's child process.

STL has no names (but of solids, in text), no tree and no unit; some programs put colours into the two bytes that the
binary form has to spare.
"""

from __future__ import annotations

import re
import struct
from collections import Counter
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.cad.appearance.looks import Dressed, repainted
from yellowiron.cad.mesh import assembly
from yellowiron.cad.mesh.assembly import Occurrence
from yellowiron.cad.naming import decode_name, is_generic
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats, Mesh, linear_values

_HEADER, _TRIANGLE = 84, 50
_WORDS = re.compile(rb"^[ \t]*((?:end)?(?:solid|facet)|vertex)\b", re.MULTILINE)
"""What lines of a text begin with."""
_DAMAGED = "Copy or export it again; the file is damaged."


def read_stl(path: str) -> Assembly:
    """The assembly in an STL file, binary or text, in metres. `CadError` if it is cut short, if it holds another number
    of triangles than it says, or none."""
    findings: list[Finding] = []
    solids = solids_of(Path(path), findings)
    unit, remarks = assembly.guessed_unit([mesh.points for _, mesh in solids], path)
    findings += remarks
    occurrences = []
    for name, mesh in solids:
        mesh = replace(mesh, points=mesh.points * unit)
        # What is not a number is left in one piece, for the check of every part to name it.
        pieces = assembly.pieces(mesh) if np.isfinite(mesh.points).all() else [mesh]
        title = name if name and not is_generic(name) else Path(path).stem
        dressed = [repainted(piece) for piece in pieces]
        occurrences += [Occurrence(title, (), one.mesh, np.eye(4), one.color) for one in dressed]
    return assembly.assemble(
        occurrences, name=Path(path).stem, format="STL", unit=unit, path=path, findings=findings,
    )  # fmt: skip


def meshes_of(file: Path, findings: list[Finding]) -> list[tuple[str, Dressed]]:
    """The triangles of every solid, in the file's unit, without names: among other files theirs tell more than what
    programs write there. What is amiss goes to `findings`. `CadError` as for `read_stl`."""
    return [("", repainted(mesh)) for _, mesh in solids_of(file, findings)]


def solids_of(file: Path, findings: list[Finding]) -> list[tuple[str, Mesh]]:
    """Name and triangles of every solid, in the file's unit; what is amiss goes to `findings`. `CadError` as for
    `read_stl`."""
    data = file.read_bytes()
    _check(data, str(file))
    solids = _solids(data, str(file))
    findings += _damage(data, sum(len(mesh.triangles) for _, mesh in solids), str(file))
    return solids


def _check(data: bytes, path: str) -> None:
    """`CadError` where the file's length is not what it says, or its text has no end."""
    count = struct.unpack_from("<I", data, 80)[0] if len(data) >= _HEADER else 0
    length = _HEADER + count * _TRIANGLE
    if len(data) == length:
        return
    if data.lstrip()[:5].lower() == b"solid" and b"\0" not in data[:1024]:
        if not data.rstrip().rpartition(b"\n")[2].lstrip().lower().startswith(b"endsolid"):
            words = "The STL file is truncated: its text has no 'endsolid'"
            raise CadError(words, where=path, hint=_DAMAGED)
        return
    held = (len(data) - _HEADER) // _TRIANGLE if len(data) >= _HEADER else 0
    words = f"The STL file declares {count} triangles and has room for {held}: it is truncated, or lies"
    raise CadError(words, where=path, hint=_DAMAGED)


def _damage(data: bytes, read: int, path: str) -> list[Finding]:
    """A finding where a text names another number of triangles than were read."""
    if len(data) >= _HEADER and len(data) == _HEADER + struct.unpack_from("<I", data, 80)[0] * _TRIANGLE:
        return []
    counts = Counter(_WORDS.findall(data.lower()))
    solids, facets, corners = (counts[w] for w in (b"solid", b"facet", b"vertex"))
    if solids == counts[b"endsolid"] and facets == counts[b"endfacet"] == read and corners == 3 * read:
        return []
    words = f"Its text has {facets} facets with {corners} corners, of which {read} were read: parts may be incomplete"
    return [Finding("CAD001", "warning", path, words, _DAMAGED)]


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
    colors = _colors(data) if len(solids) == 1 else None
    if colors is not None and len(colors) == len(solids[0][1].triangles):
        solids = [(solids[0][0], replace(solids[0][1], triangle_colors=colors))]
    return solids


def _colors(data: bytes) -> Floats | None:
    """(m, 3) colours of a binary file's triangles, 15 bits each; None where it has none. With 'COLOR=' in the header
    (Magics) red comes first and the top bit means "the header's"; else (VisCAM) blue, and the bit must be there."""
    if len(data) < _HEADER or len(data) != _HEADER + _TRIANGLE * struct.unpack_from("<I", data, 80)[0]:
        return None
    bits = np.ndarray((len(data) - _HEADER) // _TRIANGLE, dtype="<u2", buffer=data, offset=_HEADER + 48, strides=50)
    whole = data[:80].find(b"COLOR=")
    own = (bits & 0x8000) != 0
    if 0 <= whole <= 70:
        own = ~own
    if not own.any():
        return None
    channels = np.stack([bits & 31, bits >> 5 & 31, bits >> 10 & 31], axis=1) / 31.0
    rest = np.array([0.5, 0.5, 0.5])
    if 0 <= whole <= 70:
        rest = np.frombuffer(data[whole + 6 : whole + 9], dtype=np.uint8) / 255.0
    else:
        channels = channels[:, ::-1]
    srgb = np.where(own[:, None], channels, rest)
    return linear_values(srgb)
