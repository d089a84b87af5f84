"""A GLB or glTF 2.0 file to an `Assembly`: a part for every node with a mesh. Runs in the guard's child process.

The container, the tree and what refers to what are read and checked here. A mesh that is skinned becomes a part for
every bone that it follows, in the pose that the tree has.
"""

from __future__ import annotations

import base64
import binascii
import json
import math
import re
import struct
import urllib.parse
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.cad.appearance.looks import joined
from yellowiron.cad.mesh import assembly
from yellowiron.cad.mesh.assembly import Occurrence
from yellowiron.cad.naming import decode_name, decode_text, is_generic
from yellowiron.cad.readers.meshes.gltf_compressed import DRACO, MESHOPT, is_fallback, plain
from yellowiron.cad.readers.meshes.gltf_materials import Materials
from yellowiron.cad.readers.meshes.gltf_meshes import has_triangles, pieces_of
from yellowiron.cad.readers.meshes.gltf_skins import bind, bones_of
from yellowiron.model.assembly import Assembly, Node
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats

_MAGIC, _JSON, _BIN = b"glTF", 0x4E4F534A, 0x004E4942
_AGAIN = "Export it again as GLB, without compression."
_DAMAGED = "Copy or export it again; the file is damaged."
_READABLE = {"KHR_mesh_quantization", "EXT_mesh_gpu_instancing", DRACO, *MESHOPT}
_NEEDLESS = re.compile(r"[A-Z0-9]+_(?:materials?|textures?|lights?|image|animation|audio|lod|xmp)(?:_\w+)?")
"""Extensions that a file may require: of geometry, what is decoded here; of looks, what geometry can do without."""
_NAMES = re.compile(rb'"name"\s*:\s*"([^"]*)"')
_DEEPEST = 200
_KNOWN = {
    "nodes": {"name", "mesh", "children", "camera", "skin", "matrix", "rotation", "scale", "translation", "weights"},
    "scenes": {"name", "nodes"},
}
"""What the standard has in a node and a scene, besides `extensions` and `extras`."""


@dataclass(frozen=True, eq=False)
class _Node:
    """An occurrence of a mesh: names from the root, (4, 4) transform, its number in the tree, its skin if any."""

    path: tuple[str, ...]
    name: str
    mesh: int
    transform: Floats
    number: int
    skin: int | None


def read_gltf(path: str) -> Assembly:
    """The assembly in a GLB or glTF file, metres, in the file's own frame (Y up, if its program kept to the standard).

    `CadError` if the file is damaged, needs an extension that is not readable, refers to files outside of its folder,
    or has no triangle in it.
    """
    document, blob = _container(path)
    _require(document, path)
    document, buffers, faults = plain(document, _buffers(document, blob, path), path)
    tree, nodes, numbers = _nodes(document, path)
    findings = [Finding("CAD003", "error", path, f"Compressed geometry is broken: {w}", _AGAIN) for w in faults[:5]]
    materials = Materials(document, buffers, path)
    found = {n: pieces_of(document, buffers, n, materials, findings) for n in sorted({n.mesh for n in nodes})}
    dressed = {n: joined([p.drawn for p in pieces]) for n, pieces in found.items() if pieces}
    broken = {n for n, pieces in found.items() if not pieces and has_triangles(document, n)}
    bones = bones_of(document, buffers, numbers, tree)
    occurrences: list[Occurrence] = []
    for node in nodes:
        bound = bind(found[node.mesh], bones.get(node.skin)) if node.skin is not None else {}
        for bone, one in bound.items():
            above = _names(tree, bone)
            name = node.name if len(bound) == 1 else tree[bone].name
            occurrences.append(Occurrence(name, above, one.mesh, np.eye(4), one.color, one.finishes, bone))
        if not bound and node.mesh in dressed:
            if node.skin is not None:
                words = "Its skin is broken: it is left where its node stands, which may be a wrong place"
                findings.append(Finding("CAD003", "warning", node.name, words, _AGAIN))
            one = dressed[node.mesh]
            occurrences.append(
                Occurrence(node.name, node.path, one.mesh, node.transform, one.color, one.finishes, node.number)
            )
    findings += materials.findings()
    loose = sum("mesh" in entry for entry in _list(document, "nodes")) - len(nodes)
    if loose:
        words = f"{loose} nodes with meshes are not in the scene that is shown, and were left out"
        hint = "Put them into the scene, or export it again, if they are parts of the machine."
        findings.append(Finding("CAD001", "warning", path, words, hint))
    findings += _strange(document, path)
    scene = _list(document, "scenes")[document.get("scene", 0)] if _list(document, "scenes") else {}
    name = str(scene.get("name") or "")
    return assembly.assemble(
        occurrences,
        name=name if name and not is_generic(name) else Path(path).stem,
        format="glTF",
        unit=1.0,
        path=path,
        findings=findings,
        declared=len(occurrences) + sum(n.mesh in broken for n in nodes),
        nodes=tree,
    )


def _strange(document: Mapping[str, Any], path: str) -> list[Finding]:
    """A finding for nodes and scenes that say what the standard does not know: a damaged `mesh` is no mesh."""
    known = {"extensions", "extras"}
    keys = {k for kind, own in _KNOWN.items() for entry in _list(document, kind) for k in entry if k not in own | known}
    if not keys:
        return []
    words = f"Its nodes say what glTF does not know ({', '.join(sorted(keys)[:5])}): parts may be missing"
    return [Finding("CAD001", "warning", path, words, _DAMAGED)]


# ---- the container ----
def _container(path: str) -> tuple[dict[str, Any], bytes | None]:
    """The document, and the binary chunk where the file is a GLB."""
    data = Path(path).read_bytes()
    if not data.startswith(_MAGIC):
        return _document(data, path), None
    if len(data) < 20:
        raise CadError("The GLB file is truncated: its header is not whole", where=path, hint=_DAMAGED)
    version, length = struct.unpack_from("<II", data, 4)
    if version != 2:
        raise CadError(f"The GLB file is of version {version}; 2 is read", where=path, hint=_AGAIN)
    if length > len(data):
        words = f"The GLB file is truncated: it declares {length} bytes and has {len(data)}"
        raise CadError(words, where=path, hint=_DAMAGED)
    chunks: dict[int, bytes] = {}
    at = 12
    while at + 8 <= length:
        size, kind = struct.unpack_from("<II", data, at)
        if at + 8 + size > length:
            raise CadError("The GLB file's chunks are longer than the file", where=path, hint=_DAMAGED)
        chunks.setdefault(kind, data[at + 8 : at + 8 + size])
        at += 8 + size
    if _JSON not in chunks:
        raise CadError("The GLB file has no document in it", where=path, hint=_DAMAGED)
    return _document(chunks[_JSON], path), chunks.get(_BIN)


def _document(text: bytes, path: str) -> dict[str, Any]:
    try:
        # UTF-8 by the standard; some programs write names as their computer has them.
        document = json.loads(decode_text(text, _NAMES.findall(text))[0])
    except (ValueError, RecursionError) as error:
        raise CadError("The glTF document is broken: it is not JSON", where=path, hint=_DAMAGED) from error
    if not isinstance(document, dict) or not isinstance(document.get("asset"), dict):
        raise CadError("This is not a glTF document: it has no 'asset'", where=path, hint=_DAMAGED)
    if not str(document["asset"].get("version", "")).startswith("2"):
        raise CadError("The glTF document is not of version 2", where=path, hint="Export it again as glTF 2.0.")
    return document


def _require(document: dict[str, Any], path: str) -> None:
    """`CadError` for what the file needs and is not readable here."""
    required = {str(name) for name in _plain_list(document, "extensionsRequired")}
    beyond = sorted(name for name in required - _READABLE if not _NEEDLESS.fullmatch(name))
    if beyond:
        raise CadError(f"The glTF file needs {', '.join(beyond)}, which is not readable here", where=path, hint=_AGAIN)


def _plain_list(document: Mapping[str, Any], key: str) -> list[Any]:
    found = document.get(key, [])
    return found if isinstance(found, list) else []


def _list(document: Mapping[str, Any], key: str) -> list[dict[str, Any]]:
    """The objects under a key, in order; what is no object is an empty one."""
    return [item if isinstance(item, dict) else {} for item in _plain_list(document, key)]


def _buffers(document: dict[str, Any], blob: bytes | None, path: str) -> list[bytes]:
    buffers = []
    for number, entry in enumerate(_list(document, "buffers")):
        length, uri = entry.get("byteLength"), entry.get("uri")
        if is_fallback(entry):
            buffers.append(b"")
            continue
        data = _fetch(uri, path) if isinstance(uri, str) else blob if number == 0 and blob is not None else b""
        if not isinstance(length, int) or length < 0 or length > len(data):
            words = f"The glTF file is truncated: it declares {length} bytes of geometry and has {len(data)}"
            raise CadError(words, where=path, hint=_DAMAGED)
        buffers.append(data[:length])
    return buffers


def _fetch(uri: str, path: str) -> bytes:
    """What a URI of the document names: data in it, or a file beside it or below."""
    if uri.startswith("data:"):
        try:
            return base64.b64decode(uri.partition(",")[2], validate=True)
        except (binascii.Error, ValueError) as error:
            raise CadError("Geometry inside the glTF document is broken", where=path, hint=_DAMAGED) from error
    folder = Path(path).absolute().parent.resolve()
    name = urllib.parse.unquote(uri).replace("\\", "/")
    target = (folder / name).resolve()
    if "://" in name or not target.is_relative_to(folder):
        words = f"The glTF file refers to '{uri}', which is outside of its folder"
        raise CadError(words, where=path, hint="Put the file beside it, or export it again as GLB.")
    if not target.is_file():
        words = f"A file that the glTF file refers to is missing: '{uri}'"
        raise CadError(words, where=path, hint="Put it beside the glTF file, or export again as GLB.")
    return target.read_bytes()


# ---- the tree ----
def _nodes(document: dict[str, Any], path: str) -> tuple[list[Node], list[_Node], dict[int, int]]:
    """The scene's tree, every occurrence of a mesh in it, in tree order, and where in the tree each of the document's
    nodes is."""
    entries, meshes = _list(document, "nodes"), _list(document, "meshes")
    scenes, chosen = _list(document, "scenes"), document.get("scene", 0)
    children = {c for entry in entries for c in _plain_list(entry, "children")}
    roots = [i for i in range(len(entries)) if i not in children]
    if scenes and isinstance(chosen, int) and 0 <= chosen < len(scenes):
        roots = _plain_list(scenes[chosen], "nodes")
    bones = {
        joint for skin in _list(document, "skins") for joint in _plain_list(skin, "joints") if isinstance(joint, int)
    }
    tree: list[Node] = []
    found: list[_Node] = []
    seen: dict[int, int] = {}
    stack: list[tuple[Any, tuple[str, ...], int | None]] = [(root, (), None) for root in reversed(roots)]
    while stack:
        index, above, parent = stack.pop()
        if not isinstance(index, int) or not 0 <= index < len(entries):
            raise CadError(f"The glTF tree names a node that is not there: {index}", where=path, hint=_DAMAGED)
        if index in seen or len(above) > _DEEPEST:
            raise CadError("The glTF tree is broken: a node hangs in it twice", where=path, hint=_DAMAGED)
        seen[index] = len(tree)
        entry = entries[index]
        matrix = _matrix(entry, index, path)
        with np.errstate(all="ignore"):
            matrix = matrix if parent is None else tree[parent].transform @ matrix
        mesh = entry.get("mesh")
        name = decode_name(str(entry.get("name") or ""), "utf-8")
        number = len(tree)
        tree.append(Node(name or "Node", parent, matrix, index in bones))
        if mesh is not None:
            if not isinstance(mesh, int) or not 0 <= mesh < len(meshes):
                raise CadError(f"The glTF tree names a mesh that is not there: {mesh}", where=path, hint=_DAMAGED)
            own = decode_name(str(meshes[mesh].get("name") or ""), "utf-8")
            called = (own if is_generic(name) and own else name) or "Part"
            skin = entry.get("skin")
            found.append(_Node(above, called, mesh, matrix, number, skin if isinstance(skin, int) else None))
        below = (*above, name or "Assembly")
        stack += [(child, below, number) for child in reversed(_plain_list(entry, "children"))]
    return tree, found, seen


def _names(tree: Sequence[Node], number: int | None) -> tuple[str, ...]:
    """The names from the root down to a node of the tree, its own among them."""
    names: list[str] = []
    while number is not None:
        names.append(tree[number].name)
        number = tree[number].parent
    return tuple(reversed(names))


def _matrix(entry: Mapping[str, Any], index: int, path: str) -> Floats:
    """(4, 4) of a node: its matrix, or its translation · rotation · scale."""
    try:
        if "matrix" in entry:
            matrix = np.array(entry["matrix"], dtype=np.float64).reshape(4, 4).T
        else:
            x, y, z, w = (float(v) for v in entry.get("rotation", (0.0, 0.0, 0.0, 1.0)))
            length = math.sqrt(x * x + y * y + z * z + w * w)
            x, y, z, w = (v / length for v in (x, y, z, w))
            turn = np.array(
                [
                    [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
                ]
            )
            matrix = np.eye(4)
            matrix[:3, :3] = turn * np.array(entry.get("scale", (1.0, 1.0, 1.0)), dtype=np.float64).reshape(3)
            matrix[:3, 3] = np.array(entry.get("translation", (0.0, 0.0, 0.0)), dtype=np.float64).reshape(3)
    except (TypeError, ValueError, ZeroDivisionError) as error:
        raise CadError(f"The placement of node {index} is broken", where=path, hint=_DAMAGED) from error
    return np.asarray(matrix, dtype=np.float64)
