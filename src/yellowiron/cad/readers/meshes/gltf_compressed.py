"""Compressed geometry of a glTF document made plain: KHR_draco_mesh_compression by DracoPy, EXT_meshopt_compression by
`meshopt`. What cannot be made plain stays compressed: the reader behind names it and leaves it out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from yellowiron.cad.readers.meshes import meshopt
from yellowiron.model.errors import CadError

DRACO = "KHR_draco_mesh_compression"
MESHOPT = ("EXT_meshopt_compression", "KHR_meshopt_compression")
_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
_KEPT = ("POSITION", "TEXCOORD_", "COLOR_0", "JOINTS_0", "WEIGHTS_0")
"""Attributes that are read behind."""


def is_fallback(buffer: Mapping[str, Any]) -> bool:
    """Whether a buffer stands for data that is compressed elsewhere: it need not be there."""
    extensions = buffer.get("extensions")
    return isinstance(extensions, dict) and any(name in extensions for name in MESHOPT)


def plain(
    document: Mapping[str, Any], buffers: Sequence[bytes], path: str
) -> tuple[dict[str, Any], list[bytes], list[str]]:
    """The document with its compressed geometry as plain accessors, its buffers with what was decoded, and what is
    wrong with what was not. `CadError` where Draco is needed and DracoPy is not here."""
    made = dict(document)
    whole, faults = list(buffers), []
    used = {str(name) for key in ("extensionsUsed", "extensionsRequired") for name in _plain_list(document, key)}
    if used & set(MESHOPT):
        faults += _meshopt(made, whole)
    if DRACO in used:
        faults += _draco(made, whole, path)
    return made, whole, faults


def _plain_list(document: Mapping[str, Any], key: str) -> list[Any]:
    found = document.get(key, [])
    return list(found) if isinstance(found, list) else []


def _extension(entry: Any, names: Sequence[str]) -> Mapping[str, Any] | None:
    extensions = entry.get("extensions") if isinstance(entry, dict) else None
    if not isinstance(extensions, dict):
        return None
    return next((extensions[name] for name in names if isinstance(extensions.get(name), dict)), None)


def _bytes(buffers: Sequence[bytes], entry: Mapping[str, Any]) -> bytes:
    """What a view is of; `ValueError` where it reaches beyond its buffer."""
    numbers = (entry.get("buffer"), entry.get("byteOffset", 0), entry.get("byteLength"))
    number, start, length = (v if isinstance(v, int) and v >= 0 else 1 << 60 for v in numbers)
    if number >= len(buffers) or start + length > len(buffers[number]):
        raise ValueError("the file has fewer bytes than it declares")
    return buffers[number][start : start + length]


def _meshopt(document: dict[str, Any], buffers: list[bytes]) -> list[str]:
    faults, views = [], _plain_list(document, "bufferViews")
    for number, view in enumerate(views):
        packed = _extension(view, MESHOPT)
        if packed is None:
            continue
        mode, count, stride = (packed.get(key) for key in ("mode", "count", "byteStride"))
        try:
            if not isinstance(count, int) or not isinstance(stride, int):
                raise ValueError("its counts are broken")
            data = meshopt.decoded(_bytes(buffers, packed), mode=str(mode), count=count, stride=stride)
            data = meshopt.filtered(data, filter=str(packed.get("filter", "NONE")), stride=stride)
        except ValueError as error:
            faults.append(f"buffer view {number}: {error}")
            data = b""
        views[number] = {"buffer": len(buffers), "byteOffset": 0, "byteLength": len(data)}
        if mode == "ATTRIBUTES":
            views[number]["byteStride"] = stride
        buffers.append(data)
    document["bufferViews"] = views
    return faults


def _uncompressed(document: Mapping[str, Any]) -> list[Any]:
    """The meshes with what a file holds for readers without Draco."""
    meshes = []
    for mesh in _plain_list(document, "meshes"):
        primitives = _plain_list(mesh, "primitives") if isinstance(mesh, dict) else []
        bare = [{k: v for k, v in p.items() if k != "extensions"} if isinstance(p, dict) else p for p in primitives]
        meshes.append({**mesh, "primitives": bare} if isinstance(mesh, dict) else mesh)
    return meshes


def _draco(document: dict[str, Any], buffers: list[bytes], path: str) -> list[str]:
    try:
        import DracoPy
    except ImportError as error:
        if DRACO not in _plain_list(document, "extensionsRequired"):
            document["meshes"] = _uncompressed(document)
            return []
        raise CadError(
            "The glTF file is compressed with Draco, which is read with the package DracoPy, which is not here",
            where=path,
            hint="Install it with: pip install DracoPy; or export the file again without compression.",
        ) from error
    faults, meshes = [], []
    accessors, views = _plain_list(document, "accessors"), _plain_list(document, "bufferViews")
    known: dict[int, Any] = {}

    def added(values: NDArray[Any], entry: Mapping[str, Any]) -> int:
        data = np.ascontiguousarray(values).tobytes()
        views.append({"buffer": len(buffers), "byteLength": len(data)})
        buffers.append(data)
        bare = {k: entry[k] for k in ("componentType", "type", "normalized") if k in entry}
        accessors.append({**bare, "bufferView": len(views) - 1, "count": len(values)})
        return len(accessors) - 1

    for index, mesh in enumerate(_plain_list(document, "meshes")):
        primitives = _plain_list(mesh, "primitives") if isinstance(mesh, dict) else []
        for k, primitive in enumerate(primitives):
            packed = _extension(primitive, [DRACO])
            attributes = primitive.get("attributes") if isinstance(primitive, dict) else None
            if packed is None or not isinstance(attributes, dict):
                continue
            try:
                view = int(packed["bufferView"])
                if view not in known:
                    known[view] = DracoPy.decode(_bytes(buffers, views[view]))
                found = {a["unique_id"]: np.asarray(a["data"]) for a in known[view].attributes}
                corners = np.asarray(known[view].faces, dtype="<u4").reshape(-1, 1)
                own = {}
                for name, number in packed["attributes"].items():
                    if name in attributes and name.startswith(_KEPT):
                        entry = accessors[attributes[name]]
                        values = found[number].reshape(len(found[number]), _WIDTHS[entry["type"]])
                        own[name] = (values.astype(_TYPES[entry["componentType"]]), entry)
            # Exceptions of the library are of no family.
            except Exception as error:  # noqa: BLE001
                faults.append(f"mesh {index}: {' '.join(str(error).split()) or type(error).__name__}")
                continue
            made = {key: value for key, value in primitive.items() if key != "extensions"}
            made["attributes"] = {name: added(values, entry) for name, (values, entry) in own.items()}
            made["indices"] = added(corners, {"componentType": 5125, "type": "SCALAR"})
            # The decoder gives lists, whatever the mode was.
            primitives[k] = {**made, "mode": 4}
        meshes.append({**mesh, "primitives": primitives} if isinstance(mesh, dict) else mesh)
    document |= {"meshes": meshes, "accessors": accessors, "bufferViews": views}
    return faults
