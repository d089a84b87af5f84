"""Mesh files that another file refers to (a robot's): their meshes, in the numbers that stand in them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from yellowiron.cad.readers.meshes import assimp, gltf, obj, stl
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Mesh

_LOST = ("CAD001", "CAD003")
"""What says that something of a file is missing; what it looks like is the other file's to say."""


def loose_meshes(path: Path, findings: list[Finding]) -> list[tuple[str, Mesh, Color | None]]:
    """Name, mesh and colour of everything in an STL, OBJ, COLLADA, GLB or glTF file, placed as the file has it; what
    is missing of it goes to `findings`.

    STL and OBJ state no unit: their numbers are taken as they are. `CadError` for other formats and damaged files.
    """
    remarks: list[Finding] = []
    found = _found(path, remarks)
    findings += [remark for remark in remarks if remark.code in _LOST]
    return found


def _found(path: Path, remarks: list[Finding]) -> list[tuple[str, Mesh, Color | None]]:
    kind = path.suffix.lower()
    if kind == ".stl":
        return [("", mesh, None) for _, mesh in stl.solids_of(path, remarks)]
    if kind == ".obj":
        return [
            (name, replace(one.mesh, uvs=None, triangle_finishes=None), one.color)
            for name, one in obj.meshes_of(path, remarks)
        ]
    if kind in (".dae", ".glb", ".gltf"):
        read = assimp.read_collada(str(path)) if kind == ".dae" else gltf.read_gltf(str(path))
        remarks += read.findings
        return _of(read)
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
