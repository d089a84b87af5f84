"""A GLB or glTF 2.0 file to an `Assembly`: a part for every node with a mesh. Runs in the guard's child process.

The container, the tree and what refers to what are read and checked here; the numbers of the meshes are decoded by
trimesh from a copy of the file that holds them and nothing else, so that it opens no other file.
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
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.cad.appearance.looks import Dressed, Look, joined
from yellowiron.cad.mesh import assembly
from yellowiron.cad.mesh.assembly import Occurrence
from yellowiron.cad.naming import decode_name, decode_text, is_generic
from yellowiron.cad.readers.meshes.gltf_compressed import DRACO, MESHOPT, is_fallback, plain
from yellowiron.cad.readers.meshes.gltf_materials import STEPS, Materials
from yellowiron.model.assembly import Assembly, Node
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats, Mesh

_MAGIC, _JSON, _BIN = b"glTF", 0x4E4F534A, 0x004E4942
_AGAIN = "Export it again as GLB, without compression."
_DAMAGED = "Copy or export it again; the file is damaged."
_READABLE = {"KHR_mesh_quantization", "EXT_mesh_gpu_instancing", DRACO, *MESHOPT}
_NEEDLESS = re.compile(r"[A-Z0-9]+_(?:materials?|textures?|lights?|image|animation|audio|lod|xmp)(?:_\w+)?")
"""Extensions that a file may require: of geometry, what is decoded here; of looks, what geometry can do without."""
_SIZES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_TRIANGLES = (4, 5, 6)
"""Modes of triangles: lists, strips, fans."""
_FAN = 6
_NAMES = re.compile(rb'"name"\s*:\s*"([^"]*)"')
_DEEPEST = 200
_KNOWN = {
    "nodes": {"name", "mesh", "children", "camera", "skin", "matrix", "rotation", "scale", "translation", "weights"},
    "scenes": {"name", "nodes"},
}
"""What the standard has in a node and a scene, besides `extensions` and `extras`."""


@dataclass(frozen=True, eq=False)
class _Node:
    """An occurrence of a mesh: names from the root, (4, 4) transform, its number in the tree."""

    path: tuple[str, ...]
    name: str
    mesh: int
    transform: Floats
    number: int


def read_gltf(path: str) -> Assembly:
    """The assembly in a GLB or glTF file, metres, in the file's own frame (Y up, if its program kept to the standard).

    `CadError` if the file is damaged, needs an extension that is not readable, refers to files outside of its folder,
    or has no triangle in it.
    """
    document, blob = _container(path)
    _require(document, path)
    document, buffers, faults = plain(document, _buffers(document, blob, path), path)
    tree, nodes = _nodes(document, path)
    findings = [Finding("CAD003", "error", path, f"Compressed geometry is broken: {w}", _AGAIN) for w in faults[:5]]
    materials = Materials(document, buffers, path)
    found = _meshes(document, buffers, {n.mesh for n in nodes}, materials, findings)
    broken = {n.mesh for n in nodes if n.mesh not in found and _has_triangles(document, n.mesh)}
    occurrences = [
        Occurrence(n.name, n.path, one.mesh, n.transform, one.color, one.finishes, n.number)
        for n in nodes
        if (one := found.get(n.mesh)) is not None
    ]
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
        declared=sum(1 for n in nodes if n.mesh in found or n.mesh in broken),
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
def _nodes(document: dict[str, Any], path: str) -> tuple[list[Node], list[_Node]]:
    """The scene's tree, and every occurrence of a mesh in it, in tree order."""
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
    seen: set[int] = set()
    stack: list[tuple[Any, tuple[str, ...], int | None]] = [(root, (), None) for root in reversed(roots)]
    while stack:
        index, above, parent = stack.pop()
        if not isinstance(index, int) or not 0 <= index < len(entries):
            raise CadError(f"The glTF tree names a node that is not there: {index}", where=path, hint=_DAMAGED)
        if index in seen or len(above) > _DEEPEST:
            raise CadError("The glTF tree is broken: a node hangs in it twice", where=path, hint=_DAMAGED)
        seen.add(index)
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
            found.append(_Node(above, (own if is_generic(name) and own else name) or "Part", mesh, matrix, number))
        below = (*above, name or "Assembly")
        stack += [(child, below, number) for child in reversed(_plain_list(entry, "children"))]
    return tree, found


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


# ---- the meshes ----
def _meshes(
    document: dict[str, Any],
    buffers: Sequence[bytes],
    wanted: set[int],
    materials: Materials,
    findings: list[Finding],
) -> dict[int, Dressed]:
    """The triangles of the wanted meshes, by index; those that have none or are broken are absent, with a finding."""
    entries = _list(document, "meshes")
    chosen: list[tuple[int, dict[str, Any]]] = []
    for index in sorted(wanted):
        name = str(entries[index].get("name") or f"mesh {index}")
        for primitive in _list(entries[index], "primitives"):
            if primitive.get("mode", 4) not in _TRIANGLES:
                continue
            words = _fault(document, buffers, primitive)
            if words:
                findings.append(Finding("CAD003", "error", name, f"Left out: {words}", _AGAIN))
            else:
                chosen.append((index, primitive))
    decoded = _decoded(document, buffers, [p for _, p in chosen])
    pieces: dict[int, list[tuple[Mesh, Look, Floats | None, Floats | None]]] = {}
    for (index, primitive), mesh in zip(chosen, decoded, strict=True):
        pieces.setdefault(index, []).append((mesh, *materials.of(primitive, mesh)))
    return {index: joined(found) for index, found in pieces.items()}


def _has_triangles(document: dict[str, Any], mesh: int) -> bool:
    """Whether a mesh should have triangles: it says so, or has lost what it has to have."""
    primitives = _list(_list(document, "meshes")[mesh], "primitives")
    return not primitives or any(p.get("mode", 4) in _TRIANGLES for p in primitives)


def _fault(document: dict[str, Any], buffers: Sequence[bytes], primitive: Mapping[str, Any]) -> str:
    """What keeps a primitive's triangles from being read; '' if nothing does."""
    attributes = primitive.get("attributes")
    if not isinstance(attributes, dict) or "POSITION" not in attributes:
        return "it has no points"
    if "extensions" in primitive and {DRACO} & set(primitive["extensions"]):
        return "its compressed triangles are broken"
    if primitive.get("mode", 4) == _FAN:
        return "its triangles are fans"
    wanted = [attributes["POSITION"], *([primitive["indices"]] if "indices" in primitive else [])]
    counts: list[int] = []
    for number in wanted:
        accessors, views = _list(document, "accessors"), _list(document, "bufferViews")
        if not isinstance(number, int) or not 0 <= number < len(accessors):
            return "it refers to numbers that are not there"
        entry = accessors[number]
        view_number, count = entry.get("bufferView"), entry.get("count", -1)
        if "sparse" in entry or not isinstance(view_number, int) or not 0 <= view_number < len(views):
            return "its numbers are stored in a way that is not readable here"
        size, width = _SIZES.get(entry.get("componentType", 0), 0), _WIDTHS.get(str(entry.get("type")), 0)
        view = views[view_number]
        row, start = size * width, view.get("byteOffset", 0)
        step, offset, length = view.get("byteStride", row), entry.get("byteOffset", 0), view.get("byteLength", 0)
        whole = all(isinstance(v, int) and v >= 0 for v in (count, start, step, offset, length))
        if not whole or row == 0 or view.get("buffer") not in range(len(buffers)) or (step < row and count > 1):
            return "the layout of its numbers is broken"
        end = offset + (count - 1) * step + row if count else 0
        if end > length or start + length > len(buffers[view["buffer"]]):
            return f"it declares {count} numbers and the file has fewer"
        counts.append(count)
    if _list(document, "accessors")[wanted[0]].get("type") != "VEC3":
        return "its points are not in space"
    if primitive.get("mode", 4) == 4 and counts[-1] % 3:
        return "its corners do not make whole triangles"
    return ""


def _decoded(document: dict[str, Any], buffers: Sequence[bytes], primitives: Sequence[dict[str, Any]]) -> list[Mesh]:
    """The primitives' triangles, by trimesh, from a copy of the file with a mesh for each and nothing else."""
    from trimesh.exchange.gltf import load_glb

    if not primitives:
        return []
    used = sorted({n for p in primitives for n in _accessors_of(p)})
    place = {number: k for k, number in enumerate(used)}
    accessors, views = _list(document, "accessors"), _list(document, "bufferViews")
    offsets = np.concatenate([[0], np.cumsum([len(b) + (-len(b)) % 4 for b in buffers])]).tolist()
    meshes = []
    for number, primitive in enumerate(primitives):
        attributes = {k: place[v] for k, v in primitive["attributes"].items() if k in ("POSITION",)}
        entry: dict[str, Any] = {"attributes": attributes, "mode": primitive.get("mode", 4)}
        if "indices" in primitive:
            entry["indices"] = place[primitive["indices"]]
        meshes.append({"name": str(number), "primitives": [entry]})
    blob = b"".join(b + b"\0" * (-len(b) % 4) for b in buffers)
    copy = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(blob)}],
        "bufferViews": [
            {
                **{k: v[k] for k in ("byteLength", "byteStride") if k in v},
                "buffer": 0,
                "byteOffset": offsets[v["buffer"]] + v.get("byteOffset", 0),
            }
            for v in (views[accessors[n]["bufferView"]] for n in used)
        ],
        "accessors": [{**_bare(accessors[n]), "bufferView": k} for k, n in enumerate(used)],
        "meshes": meshes,
        "nodes": [{"mesh": k} for k in range(len(meshes))],
        "scenes": [{"nodes": list(range(len(meshes)))}],
        "scene": 0,
    }
    geometry = load_glb(BytesIO(_packed(copy, blob)), skip_materials=True)["geometry"]
    result = []
    for number, primitive in enumerate(primitives):
        found = geometry[str(number)]
        points = np.asarray(found["vertices"], dtype=np.float64)
        entry = accessors[primitive["attributes"]["POSITION"]]
        if entry.get("normalized") and entry["componentType"] in STEPS:
            points = np.maximum(points / STEPS[entry["componentType"]], -1.0)
        triangles = np.asarray(found["faces"], dtype=np.int64)
        inside = np.asarray(((triangles >= 0) & (triangles < len(points))).all(axis=1))
        # A corner that is not there is a point that is not a number: the check behind finds and names it.
        points = np.concatenate([points, np.full((1, 3), np.nan)]) if not inside.all() else points
        triangles = np.where(inside[:, None], triangles, len(points) - 1)
        result.append(Mesh(points, triangles.astype(np.int32)))
    return result


def _accessors_of(primitive: Mapping[str, Any]) -> list[int]:
    return [primitive["attributes"]["POSITION"], *([primitive["indices"]] if "indices" in primitive else [])]


def _bare(accessor: Mapping[str, Any]) -> dict[str, Any]:
    return {k: accessor[k] for k in ("componentType", "type", "count", "byteOffset") if k in accessor}


def _packed(document: Mapping[str, Any], blob: bytes) -> bytes:
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sIIII", _MAGIC, 2, 28 + len(text) + len(blob), len(text), _JSON)
    return head + text + struct.pack("<II", len(blob), _BIN) + blob
