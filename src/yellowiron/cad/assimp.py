"""A COLLADA or FBX file to an `Assembly`: a part for every node with meshes. Runs in the guard's child process.

Both state their unit; Open Asset Import gives metres, and keeps the tree and its names.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

from yellowiron.cad import placed
from yellowiron.cad.naming import decode_name, is_generic
from yellowiron.cad.placed import Occurrence
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Mesh

_HINT = "Export the file again, as GLB or, better, as STEP."
_UP = re.compile(rb"<up_axis>\s*([XYZ]_UP)\s*</up_axis>")
_FROM_Y_UP = {"Z_UP": np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])}
"""The library turns what has another axis up to Y up; this turns it back."""
_HELPER = "_$AssimpFbx$_"
"""Marks nodes that stand for one step of an FBX node's transform."""


def read_collada(path: str) -> Assembly:
    """The assembly in a COLLADA file, in metres, in the file's own frame. `CadError` if it is damaged or holds no
    triangle."""
    data = Path(path).read_bytes()
    up = _UP.search(data)
    frame = _FROM_Y_UP.get(up.group(1).decode() if up else "Y_UP", np.eye(4))
    try:
        entries = ElementTree.fromstring(data).iter()
        nodes = [e.attrib for e in entries if str(e.tag).endswith(("}node", "}visual_scene"))]
    except ElementTree.ParseError as error:
        raise CadError(f"The COLLADA file is broken: {error}", where=path, hint=_HINT) from error
    # The library calls nodes by their ids.
    return _read(path, "COLLADA", 0, frame, {n["id"]: n["name"] for n in nodes if n.get("id") and n.get("name")})


def read_fbx(path: str) -> Assembly:
    """The assembly in an FBX file, in metres, in the file's own frame. `CadError` if it is damaged or holds no
    triangle."""
    import assimp_py

    return _read(path, "FBX", assimp_py.Process_GlobalScale, np.eye(4), {})


def _read(path: str, format: str, flags: int, frame: Floats, titles: Mapping[str, str]) -> Assembly:
    """`frame` (4, 4) takes what the library delivers to the file's own axes; `titles` are better names of nodes."""
    import assimp_py

    try:
        scene = assimp_py.import_file(path, assimp_py.Process_Triangulate | assimp_py.Process_SortByPType | flags)
    except (RuntimeError, ValueError) as error:
        words = " ".join(str(error).split())[:200]
        raise CadError(f"The {format} file cannot be read: {words}", where=path, hint=_HINT) from error
    # The root holds the unit: it goes into the meshes, and the places stay free of it.
    unit = abs(float(np.linalg.det(np.asarray(scene.root_node.transformation).reshape(4, 4)[:3, :3]))) ** (1.0 / 3.0)
    unit = float(f"{unit:.6g}") or 1.0
    meshes = [_mesh(entry, unit) for entry in scene.meshes]
    looks = [_color(entry) for entry in scene.materials]
    paint = [looks[m.material_index] if 0 <= m.material_index < len(looks) else None for m in scene.meshes]
    joined: dict[tuple[int, ...], tuple[Mesh, Color | None] | None] = {}
    occurrences = []
    nodes = list(_nodes(scene.root_node, frame, titles))
    for names, indices, transform in nodes:
        if indices not in joined:
            joined[indices] = _joined([meshes[i] for i in indices], [paint[i] for i in indices])
        found = joined[indices]
        if found is not None:
            transform[:3, :3] /= unit
            occurrences.append(Occurrence(names[-1], names[:-1], found[0], transform, found[1]))
    findings = []
    if any(entry.get("TEXTURES") for entry in scene.materials):
        words = "Textures are not read: parts have the colour that is under them"
        findings.append(Finding("CAD012", "info", path, words))
    root = decode_name(titles.get(scene.root_node.name, ""), "utf-8")
    return placed.assemble(
        occurrences,
        name=root if not is_generic(root) else Path(path).stem,
        format=format,
        unit=unit,
        path=path,
        findings=findings,
        declared=len(nodes),
    )


def _nodes(
    node: Any, frame: Floats, titles: Mapping[str, str]
) -> Iterator[tuple[tuple[str, ...], tuple[int, ...], Floats]]:
    """Every node with meshes: names from the root, the meshes' numbers, (4, 4) transform into the file's frame."""
    stack: list[tuple[Any, tuple[str, ...], Floats]] = [(node, (), frame)]
    while stack:
        here, names, matrix = stack.pop()
        matrix = matrix @ np.asarray(here.transformation, dtype=np.float64).reshape(4, 4)
        if here is not node and _HELPER not in here.name:
            names = (*names, decode_name(titles.get(here.name, here.name), "utf-8") or "Part")
        if len(here.mesh_indices):
            yield names or ("Part",), tuple(int(i) for i in here.mesh_indices), matrix
        stack += [(child, names, matrix) for child in reversed(here.children)]


def _mesh(entry: Any, unit: float) -> Mesh:
    points = np.asarray(entry.vertices, dtype=np.float64).reshape(-1, 3) * unit
    indices = np.asarray(entry.indices, dtype=np.int64)
    # Points and lines come as meshes of their own, with fewer corners a face.
    corners = indices.reshape(-1, 3) if len(indices) == 3 * entry.num_faces else np.zeros((0, 3), dtype=np.int64)
    return Mesh(points, corners.astype(np.int32))


def _joined(meshes: list[Mesh], paint: list[Color | None]) -> tuple[Mesh, Color | None] | None:
    """A node's meshes, one for each of its materials, as one; None where it has no triangle."""
    kept = [(m, c) for m, c in zip(meshes, paint, strict=True) if len(m.triangles)]
    if len(kept) < 2:
        return kept[0] if kept else None
    starts = np.cumsum([0, *(len(m.points) for m, _ in kept)])
    points = np.concatenate([m.points for m, _ in kept])
    triangles = np.concatenate([m.triangles + start for (m, _), start in zip(kept, starts, strict=False)])
    colors = {c for _, c in kept}
    if len(colors) == 1:
        return Mesh(points, triangles.astype(np.int32)), colors.pop()
    rows = np.concatenate([np.tile(c or (0.5, 0.5, 0.5), (len(m.triangles), 1)) for m, c in kept])
    return Mesh(points, triangles.astype(np.int32), None, rows), None


def _color(material: Mapping[str, Any]) -> Color | None:
    """A material's diffuse colour; None where a picture stands for it."""
    value = material.get("COLOR_DIFFUSE")
    if value is None:
        return None
    r, g, b = (min(max(float(v), 0.0), 1.0) for v in value[:3])
    return r, g, b
