"""A COLLADA or FBX file to an `Assembly`: a part for every node with meshes. Runs in the guard's child process.

Both state their unit; Open Asset Import gives metres, and keeps the tree and its names.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from yellowiron.cad.appearance.looks import Dressed, Look, joined
from yellowiron.cad.appearance.textures import Pictures, finish
from yellowiron.cad.mesh import assembly
from yellowiron.cad.mesh.assembly import Occurrence
from yellowiron.cad.naming import decode_name, encoding_remarks, is_generic
from yellowiron.cad.readers.meshes.fbx_mended import legible, without_edges
from yellowiron.model.assembly import Assembly, Node
from yellowiron.model.errors import CadError
from yellowiron.model.geometry import Color, Floats, Mesh

_HINT = "Export the file again, as GLB or, better, as STEP."
_UP = re.compile(rb"<up_axis>\s*([XYZ]_UP)\s*</up_axis>")
_INDICES = re.compile(r"(?:^|\})(?:p|h|v|vcount)$")
"""Elements that hold indices and counts."""
_NO_INDEX = re.compile(r"[^\s\d+-]")
_EDGES = re.compile(rb"<((?:\w+:)?(?:lines|linestrips))\b[^>]*?(?:/>|>.*?</\1\s*>)", re.DOTALL)
"""Drawn edges, as SketchUp exports them: the library reads no face where there is one."""
_FROM_Y_UP = {"Z_UP": np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])}
"""The library turns what has another axis up to Y up; this turns it back."""
_DIFFUSE = 1
"""The library's number for textures of the diffuse colour."""
_DRAWN = re.compile(rb'\x00\x01ModelS\x04\x00\x00\x00Mesh|\bModel:[^\n{]{0,300}?,\s*"Mesh"')
"""A node with a mesh in an FBX file, binary or text."""
_GEOMETRY = re.compile(
    rb'\x08GeometryL(.{8})S.{4}[^\0]{0,300}\0\x01\w+S\x04\0\0\0Mesh|\bGeometry:\s*(-?\d+)\s*,[^\n{]{0,300}?"Mesh"',
    re.DOTALL,
)
"""A mesh in an FBX file, and its number (binary or text)."""
_LINK = re.compile(rb'\x01CS\x02\0\0\0OOL(.{8})L(.{8})|\bC:\s*"OO"\s*,\s*(-?\d+)\s*,\s*(-?\d+)', re.DOTALL)
"""What hangs below what in an FBX file, by their numbers (binary or text)."""
_HELPER = "_$AssimpFbx$_"
"""Marks nodes that stand for one step of an FBX node's transform …"""
_PIVOT, _GEOMETRIC = "RotationPivot", "Geometric"
"""… of which one puts the point that the node turns about, and some move its mesh alone."""
_BONE = re.compile(
    rb'S(?:.{4})([^\0]{0,300})\0\x01ModelS\x08\0\0\0LimbNode|\bModel:[^\n{"]*"Model::([^"\n]*)",\s*"LimbNode"',
    re.DOTALL,
)
"""A bone in an FBX file, binary or text, and its name."""


def read_collada(path: str) -> Assembly:
    """The assembly in a COLLADA file, in metres, in the file's own frame. `CadError` if it is damaged or holds no
    triangle."""
    data = Path(path).read_bytes()
    up = _UP.search(data)
    frame = _FROM_Y_UP.get(up.group(1).decode() if up else "Y_UP", np.eye(4))
    try:
        entries = list(ElementTree.fromstring(data).iter())
        nodes = [e.attrib for e in entries if str(e.tag).endswith(("}node", "}visual_scene"))]
    except ElementTree.ParseError as error:
        raise CadError(f"The COLLADA file is broken: {error}", where=path, hint=_HINT) from error
    # On such the library takes all the memory that there is.
    if any(_INDICES.search(str(e.tag)) and _NO_INDEX.search(e.text or "") for e in entries):
        raise CadError("The COLLADA file is broken: an index in it is no whole number", where=path, hint=_HINT)
    # The library calls nodes by their ids.
    titles = {n["id"]: n["name"] for n in nodes if n.get("id") and n.get("name")}
    bones = {name for n in nodes if n.get("type") == "JOINT" for key in ("id", "name") if (name := n.get(key))}
    faces = _EDGES.sub(b"", data)
    with TemporaryDirectory(prefix="yellowiron-") as folder:
        spelled = path
        if faces != data:
            spelled = str(Path(folder) / "model.dae")
            Path(spelled).write_bytes(faces)
        return _read(path, "COLLADA", 0, frame, titles, bones=bones, spelled=spelled)


def read_fbx(path: str) -> Assembly:
    """The assembly in an FBX file, in metres, in the file's own frame. `CadError` if it is damaged or holds no
    triangle."""
    import assimp_py

    drawn = Path(path).read_bytes()
    data, titles, encoding = legible(drawn)
    data = without_edges(data)
    up, unit = _setting(data, b"UpAxis"), _setting(data, b"UnitScaleFactor")
    frame = _FROM_Y_UP["Z_UP"] if up == 2.0 else np.eye(4)
    bones = {(binary or text).decode("utf-8", "replace") for binary, text in _BONE.findall(data)}
    with TemporaryDirectory(prefix="yellowiron-") as folder:
        spelled = path
        if data != drawn:
            spelled = str(Path(folder) / "model.fbx")
            Path(spelled).write_bytes(data)
        flags = assimp_py.Process_GlobalScale
        read = _read(path, "FBX", flags, frame, titles, _declared(data), bones, spelled=spelled)
    # The library has used the unit, centimetres by default, up.
    findings = (*read.findings, *encoding_remarks(encoding, path))
    return replace(read, unit=0.01 * (unit or 1.0), findings=findings)


def _declared(data: bytes) -> int:
    """How many nodes with meshes an FBX file has: by what is called one, or by what has a mesh below it. A damaged name
    is not in both."""
    numbers = {binary or text for binary, text in _GEOMETRY.findall(data)}
    links = ((below or low, above or high) for below, above, low, high in _LINK.findall(data))
    return max(len(_DRAWN.findall(data)), len({above for below, above in links if below in numbers}))


def _setting(data: bytes, name: bytes) -> float | None:
    """A number of an FBX file's global settings, text or binary; None where it states none."""
    text = re.search(rb'"%s"\s*,\s*"\w*"\s*,\s*"\w*"\s*,\s*"\w*"\s*,\s*([-+.\deE]+)' % name, data)
    record = rb"S%s\0\0\0%s(?:S[\0-\x20]\0\0\0\w*){3}([ID])(.{8})" % (bytes([len(name)]), name)
    packed = None if text else re.search(record, data, re.DOTALL)
    try:
        if text:
            return float(text.group(1))
        if packed:
            kind, size = ("<i", 4) if packed.group(1) == b"I" else ("<d", 8)
            return float(struct.unpack(kind, packed.group(2)[:size])[0])
    except ValueError:
        return None
    return None


def _read(
    path: str,
    format: str,
    flags: int,
    frame: Floats,
    titles: Mapping[str, str],
    declared: int = 0,
    bones: Collection[str] = (),
    *,
    spelled: str = "",
) -> Assembly:
    """`frame` (4, 4) takes what the library delivers to the file's own axes; `titles` are better names of nodes;
    `declared` is how many nodes with meshes the file says it has, if it does; `bones` are the library's names of
    bones; `spelled` is the same file with names that the library reads."""
    import assimp_py

    try:
        scene = assimp_py.import_file(
            spelled or path, assimp_py.Process_Triangulate | assimp_py.Process_SortByPType | flags
        )
    except (RuntimeError, ValueError) as error:
        words = " ".join(str(error).split())[:200]
        raise CadError(f"The {format} file cannot be read: {words}", where=path, hint=_HINT) from error
    # The root holds the unit: it goes into the meshes, and the places stay free of it.
    unit = abs(float(np.linalg.det(np.asarray(scene.root_node.transformation).reshape(4, 4)[:3, :3]))) ** (1.0 / 3.0)
    unit = float(f"{unit:.6g}") or 1.0
    pictures = Pictures(path)
    looks = [_look(entry, pictures) for entry in scene.materials]
    meshes = [_mesh(entry, unit, looks) for entry in scene.meshes]
    known: dict[tuple[int, ...], Dressed | None] = {}
    occurrences = []
    tree: list[Node] = []
    nodes = list(_nodes(scene.root_node, frame, titles, bones, tree))
    for names, indices, transform, number in nodes:
        if indices not in known:
            kept = [meshes[i] for i in indices if len(meshes[i][0].triangles)]
            known[indices] = joined(kept) if kept else None
        one = known[indices]
        if one is not None:
            transform[:3, :3] /= unit
            occurrences.append(Occurrence(names[-1], names[:-1], one.mesh, transform, one.color, one.finishes, number))
    root = decode_name(titles.get(scene.root_node.name, ""), "utf-8")
    return assembly.assemble(
        occurrences,
        name=root if not is_generic(root) else Path(path).stem,
        format=format,
        unit=unit,
        path=path,
        findings=pictures.findings(),
        declared=max(declared, len(nodes)),
        nodes=[replace(n, transform=n.transform / [[unit] * 3 + [1.0]]) for n in tree],
    )


def _nodes(
    node: Any, frame: Floats, titles: Mapping[str, str], bones: Collection[str], tree: list[Node]
) -> Iterator[tuple[tuple[str, ...], tuple[int, ...], Floats, int | None]]:
    """Every node with meshes: names from the root, the meshes' numbers, (4, 4) transform into the file's frame, its
    number in `tree`, to which all nodes but the root are added, their lengths scaled as those of the transforms."""
    stack: list[tuple[Any, tuple[str, ...], Floats, int | None, Floats | None]] = [(node, (), frame, None, None)]
    while stack:
        here, names, outer, number, pivot = stack.pop()
        matrix = outer @ np.asarray(here.transformation, dtype=np.float64).reshape(4, 4)
        if _HELPER in here.name:
            step = here.name.rpartition(_HELPER)[2].lstrip("_")
            # What moves the mesh alone moves no node, and is undone (…Inverse) for the nodes below.
            if step == _PIVOT:
                pivot = matrix
            elif step.startswith(_GEOMETRIC) and not step.endswith("Inverse") and pivot is None:
                pivot = outer
        elif here is not node:
            title = decode_name(titles.get(here.name, here.name), "utf-8") or "Part"
            place = matrix.copy()
            if pivot is not None:
                place[:, 3] = pivot[:, 3]
            tree.append(Node(title, number, place, here.name in bones))
            names, number, pivot = (*names, title), len(tree) - 1, None
        if len(here.mesh_indices):
            yield names or ("Part",), tuple(int(i) for i in here.mesh_indices), matrix, number
        stack += [(child, names, matrix, number, pivot) for child in reversed(here.children)]


def _mesh(entry: Any, unit: float, looks: Sequence[Look]) -> tuple[Mesh, Look, Floats | None, Floats | None]:
    """A mesh in metres, its look, its triangles' texture coordinates (m, 3, 2) and colours (m, 3)."""
    points = np.asarray(entry.vertices, dtype=np.float64).reshape(-1, 3) * unit
    # A mesh of loose points and edges has no indices.
    indices = np.asarray(() if entry.indices is None else entry.indices, dtype=np.int64)
    # Points and lines come as meshes of their own, with fewer corners a face.
    corners = indices.reshape(-1, 3) if len(indices) == 3 * entry.num_faces else np.zeros((0, 3), dtype=np.int64)
    look = looks[entry.material_index] if 0 <= entry.material_index < len(looks) else Look()
    uvs = _corners(entry.texcoords, len(points), corners)
    paint = _corners(entry.colors, len(points), corners)
    mesh = Mesh(points, corners.astype(np.int32))
    return mesh, look, None if uvs is None else uvs[:, :, :2], None if paint is None else paint[:, :, :3].mean(axis=1)


def _corners(sets: Any, count: int, corners: NDArray[np.int64]) -> Floats | None:
    """(m, 3, k) the first set of numbers at `count` points, at the triangles' corners; None without one."""
    numbers = np.asarray(sets[0], dtype=np.float64) if sets else np.zeros(0)
    if not count or not numbers.size or numbers.size % count or numbers.size < 2 * count:
        return None
    return np.asarray(numbers.reshape(count, -1)[corners])


def _look(material: Mapping[str, Any], pictures: Pictures) -> Look:
    """A material's diffuse colour, or the picture that stands for it, metalness and roughness."""
    value = material.get("COLOR_DIFFUSE")
    color: Color | None = None
    if value is not None:
        r, g, b = (min(max(float(v), 0.0), 1.0) for v in value[:3])
        color = (r, g, b)
    metallic, roughness = (_number(material.get(f"{key}FACTOR")) for key in ("METALLIC", "ROUGHNESS"))
    names = (material.get("TEXTURES") or {}).get(_DIFFUSE) or []
    name = str(names[0]) if names else ""
    if name.startswith("*"):
        pictures.fault(name, "it is packed into the file, where it cannot be got at")
    picture = pictures.beside(name) if name and not name.startswith("*") else None
    if picture is None:
        return Look(color, finish(metallic, roughness))
    texture, mean = picture.painted(None)
    return Look(mean, finish(metallic, roughness, texture))


def _number(value: Any) -> float | None:
    return float(value) if isinstance(value, (int, float)) else None
