"""How many parts a mutant of `bench_fuzz` declares, counted without its reader: what honestly has one part less is told
from what lost one."""

from __future__ import annotations

import re
import struct
import tempfile

import numpy as np


def count(kind: str, data: bytes) -> int | None:
    """The parts that a file declares; None where nothing here counts them."""
    counted = _COUNTS.get(kind)
    try:
        return None if counted is None else counted(data)
    except (ValueError, IndexError, KeyError, struct.error):
        return None


def _stl(data: bytes) -> int:
    """Pieces of triangles that share corners."""
    number = struct.unpack_from("<I", data, 80)[0]
    if len(data) == 84 + 50 * number:
        corners = np.ndarray((number, 3, 3), dtype="<f4", buffer=data, offset=96, strides=(50, 12, 4))
        return _pieces(corners.astype(np.float64))
    rows = re.findall(rb"^\s*vertex\s+(\S+)\s+(\S+)\s+(\S+)", data, re.MULTILINE)
    return _pieces(np.array([[float(v) for v in row] for row in rows]).reshape(-1, 3, 3))


def _ply(data: bytes) -> int:
    """Pieces of triangles that share corners; of the forms that the benchmark writes."""
    head, _, body = data.partition(b"end_header\n")
    points, faces = (int(n) for n in re.findall(rb"^element \w+ (\d+)", head, re.MULTILINE))
    if b"\nformat ascii" in head:
        rows = [line.split() for line in body.splitlines()]
        place = np.array([[float(v) for v in row[:3]] for row in rows[:points]])
        corner = np.array([[int(v) for v in row[1:4]] for row in rows[points : points + faces]])
        return _pieces(place[corner])
    place = np.frombuffer(body, dtype="<f4", count=3 * points).reshape(-1, 3)
    corner = np.ndarray((faces, 3), dtype="<i4", buffer=body, offset=12 * points + 1, strides=(13, 4))
    return _pieces(place[corner].astype(np.float64))


def _obj(data: bytes) -> int:
    """Objects that have a face."""
    return sum(re.search(rb"^f ", block, re.MULTILINE) is not None for block in re.split(rb"^o ", data, flags=re.M))


def _pieces(corners: np.ndarray) -> int:
    """How many pieces triangles (m, 3, 3) with an area make."""
    edges = corners[:, 1:] - corners[:, :1]
    corners = corners[np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1) > 1e-20]
    _, number = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    root = list(range(int(number.max()) + 1))

    def top(k: int) -> int:
        while root[k] != k:
            root[k] = k = root[root[k]]
        return k

    for a, b, c in number.reshape(-1, 3).tolist():
        root[top(b)] = root[top(c)] = top(a)
    return sum(top(k) == k for k in range(len(root)))


def _brep(data: bytes) -> int:
    """Solids, in whatever compounds."""
    from OCP.BinTools import BinTools
    from OCP.BRep import BRep_Builder
    from OCP.BRepTools import BRepTools
    from OCP.TopAbs import TopAbs_SOLID
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS_Shape

    shape = TopoDS_Shape()
    with tempfile.NamedTemporaryFile() as file:
        file.write(data)
        file.flush()
        if data.lstrip(b"\n").startswith(b"Open CASCADE Topology V"):
            BinTools.Read_s(shape, file.name)
        else:
            BRepTools.Read_s(shape, file.name, BRep_Builder())
    solids, found = TopExp_Explorer(shape, TopAbs_SOLID), 0
    while solids.More():
        found += 1
        solids.Next()
    return found


def _dxf(data: bytes) -> int:
    """Placed blocks, by what begins and what marks them; one of the benchmark's is the group of the others."""
    words = (rb"INSERT", rb"AcDbBlockReference")
    return max(len(re.findall(rb"(?<![\w$])%s(?!\w)" % word, data)) for word in words) - 1


_COUNTS = {"STL": _stl, "PLY": _ply, "OBJ": _obj, "BREP": _brep, "DXF": _dxf}
