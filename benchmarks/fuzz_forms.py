"""The small machine of the tests in the second forms of formats that have two: for `bench_fuzz`."""

from __future__ import annotations

import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from kit.cadfiles.exports import ITEMS, WRITERS, Meshes


def brep_binary(path: Path, meshes: Meshes) -> None:
    from OCP.BinTools import BinTools
    from OCP.BRep import BRep_Builder
    from OCP.BRepTools import BRepTools
    from OCP.TopoDS import TopoDS_Shape

    WRITERS["BREP"][1](path, meshes)
    shape = TopoDS_Shape()
    BRepTools.Read_s(shape, str(path), BRep_Builder())
    BinTools.Write_s(shape, str(path))


def stl_text(path: Path, meshes: Meshes) -> None:
    """A solid for every part, in millimetres."""
    text = ""
    for item, corners in _world(meshes):
        facets = (
            "facet normal 0 0 0\nouter loop\n"
            + "".join(f"vertex {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in corner)
            + "endloop\nendfacet\n"
            for corner in corners * 1000.0
        )
        text += f"solid {item.name}\n{''.join(facets)}endsolid {item.name}\n"
    path.write_text(text, encoding="utf-8")


def ply_binary(path: Path, meshes: Meshes) -> None:
    """Metres; every part's points for themselves."""
    corners = [(item, found) for item, found in _world(meshes)]
    points = np.concatenate([found.reshape(-1, 3) for _, found in corners])
    # The parts' seams are welded, as programs write them.
    points, number = np.unique(np.round(points, 9), axis=0, return_inverse=True)
    faces = number.reshape(-1, 3)
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
    head += "".join(f"property float {a}\n" for a in "xyz")
    head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    rows = b"".join(struct.pack("<Biii", 3, *map(int, face)) for face in faces)
    path.write_bytes(head.encode() + points.astype("<f4").tobytes() + rows)


def dxf_binary(path: Path, meshes: Meshes) -> None:
    import ezdxf

    WRITERS["DXF"][1](path, meshes)
    ezdxf.readfile(path).saveas(path, fmt="bin")


def _world(meshes: Meshes) -> list[tuple[Any, Any]]:
    """Every item and its triangles' corners (m, 3, 3) in metres."""
    found = []
    for item in ITEMS:
        points, triangles = meshes[item.shape]
        found.append((item, (points @ item.matrix[:3, :3].T + item.matrix[:3, 3])[triangles]))
    return found


FORMS: dict[str, tuple[str, Callable[[Path, Meshes], None]]] = {
    "BREP (binary)": ("machine.brep", brep_binary),
    "STL (text)": ("machine.stl", stl_text),
    "PLY (binary)": ("machine.ply", ply_binary),
    "DXF (binary)": ("machine.dxf", dxf_binary),
}
"""Format → the file's name and what writes it."""
