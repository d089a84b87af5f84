"""Mesh files that another file refers to (a robot's): their meshes, in the numbers that stand in them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from yellowiron.cad import assimp, gltf, obj, stl
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.geometry import Color, Mesh


def loose_meshes(path: Path) -> list[tuple[str, Mesh, Color | None]]:
    """Name, mesh and colour of everything in an STL, OBJ, COLLADA, GLB or glTF file, placed as the file has it.

    STL and OBJ state no unit: their numbers are taken as they are. `CadError` for other formats and damaged files.
    """
    kind = path.suffix.lower()
    if kind == ".stl":
        return [("", mesh, None) for _, mesh in stl.solids_of(path)]
    if kind == ".obj":
        return [
            (name, replace(one.mesh, uvs=None, triangle_finishes=None), one.color) for name, one in obj.meshes_of(path)
        ]
    if kind == ".dae":
        return _of(assimp.read_collada(str(path)))
    if kind in (".glb", ".gltf"):
        return _of(gltf.read_gltf(str(path)))
    raise CadError(
        f"Meshes of the format {kind or 'of no name'} are not read",
        where=str(path),
        hint="Convert it to STL, OBJ or DAE.",
    )


def _of(assembly: Assembly) -> list[tuple[str, Mesh, Color | None]]:
    found = []
    for part in assembly.parts:
        mesh = assembly.shape_of(part).mesh
        found.append(
            (part.name, Mesh(assembly.points_of(part), mesh.triangles, None, mesh.triangle_colors), part.color)
        )
    return found
