"""Assemblies written as files of triangles, with nothing else: no surfaces, and names only where they are asked for."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import trimesh

from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats, Ints

Lump = tuple[str, Floats, Ints]
"""A name, points (n, 3) in the model's frame, metres, and triangles (m, 3)."""


def lumps(assembly: Assembly, groups: Sequence[Sequence[str]] | None = None) -> list[Lump]:
    """The parts' triangles, welded part by part, in single precision; those of the part ids in a group as one mesh.
    Without groups every part is a mesh of its own."""
    by_id = {part.id: part for part in assembly.parts}
    found = []
    for number, group in enumerate(groups or [[part.id] for part in assembly.parts]):
        points, triangles, count = [], [], 0
        for part in (by_id[id] for id in group):
            mesh = assembly.shape_of(part).mesh
            place = part.transform
            own = (mesh.points @ place[:3, :3].T + place[:3, 3]).astype(np.float32).astype(np.float64)
            own, index = np.unique(own, axis=0, return_inverse=True)
            corners = index.reshape(-1)[mesh.triangles]
            corners = corners[:, ::-1] if np.linalg.det(place[:3, :3]) < 0.0 else corners
            corners = corners[(corners != np.roll(corners, 1, axis=1)).all(axis=1)]
            points.append(own)
            triangles.append(corners + count)
            count += len(own)
        found.append((f"Mesh_{number:04d}", np.concatenate(points), np.concatenate(triangles).astype(np.int32)))
    return found


def write_stl(path: Path, meshes: Sequence[Lump]) -> Path:
    """One binary STL of all triangles, metres."""
    corners = np.concatenate([points[triangles] for _, points, triangles in meshes])
    records = np.zeros(len(corners), dtype=[("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
    records["v"] = corners
    path.write_bytes(bytes(80) + struct.pack("<I", len(records)) + records.tobytes())
    return path


def write_obj(path: Path, meshes: Sequence[Lump], scale: float = 1.0) -> Path:
    """An object for every mesh; `scale` units to a metre."""
    lines, start = [], 1
    for name, points, triangles in meshes:
        lines.append(f"o {name}")
        lines += [f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in points * scale]
        lines += [f"f {a} {b} {c}" for a, b, c in triangles + start]
        start += len(points)
    path.write_text("\n".join(lines) + "\n", encoding="ascii")
    return path


def write_glb(path: Path, meshes: Sequence[Lump]) -> Path:
    """A node for every mesh, metres."""
    scene = trimesh.Scene()
    for name, points, triangles in meshes:
        scene.add_geometry(trimesh.Trimesh(points, triangles, process=False), node_name=name, geom_name=name)
    path.write_bytes(scene.export(file_type="glb"))
    return path
