"""Materials of a glTF file: colours, metalness, roughness, textures and their coordinates."""

from __future__ import annotations

import base64
import binascii
import math
import urllib.parse
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from yellowiron.cad.appearance.looks import Look
from yellowiron.cad.appearance.textures import Picture, Pictures, finish
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Mesh

_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
STEPS = {5120: 127.0, 5121: 255.0, 5122: 32767.0, 5123: 65535.0}
"""What a normalised integer is divided by."""
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
_OLD = "KHR_materials_pbrSpecularGlossiness"
_MOVED = "KHR_texture_transform"


class Materials:
    """The materials of one document, each read once."""

    def __init__(self, document: Mapping[str, Any], buffers: Sequence[bytes], path: str) -> None:
        self._document = document
        self._buffers = buffers
        self._pictures = Pictures(path)
        self._known: dict[int, tuple[Look, Mapping[str, Any] | None]] = {}

    def findings(self) -> list[Finding]:
        """What is left out."""
        return self._pictures.findings()

    def of(self, primitive: Mapping[str, Any], mesh: Mesh) -> tuple[Look, Floats | None, Floats | None]:
        """A primitive's look, the (m, 3, 2) texture coordinates and the (m, 3) paint of its triangles."""
        number = primitive.get("material")
        entries = self._list("materials")
        look, texture = Look(), None
        if isinstance(number, int) and 0 <= number < len(entries):
            if number not in self._known:
                self._known[number] = self._read(entries[number])
            look, texture = self._known[number]
        paint = self._accessor(primitive, "COLOR_0", mesh)
        return look, self._uvs(primitive, texture, mesh), None if paint is None else paint[:, :, :3].mean(axis=1)

    def _read(self, material: Mapping[str, Any]) -> tuple[Look, Mapping[str, Any] | None]:
        pbr = _object(material, "pbrMetallicRoughness")
        old = _object(_object(material, "extensions"), _OLD)
        color = _color(old.get("diffuseFactor") if old else pbr.get("baseColorFactor"))
        metallic, roughness = _number(pbr.get("metallicFactor")), _number(pbr.get("roughnessFactor"))
        if old:
            glossy = _number(old.get("glossinessFactor"))
            metallic, roughness = 0.0, None if glossy is None else 1.0 - glossy
        mixed = self._picture(_object(pbr, "metallicRoughnessTexture"))
        if mixed is not None:
            # Green is roughness, blue is metalness; the mean stands for both.
            metallic = (1.0 if metallic is None else metallic) * mixed.raw[2]
            roughness = (1.0 if roughness is None else roughness) * mixed.raw[1]
        entry = _object(old, "diffuseTexture") if old else _object(pbr, "baseColorTexture")
        picture = self._picture(entry)
        if picture is None:
            plain = (color or (1.0, 1.0, 1.0)) == (1.0, 1.0, 1.0)
            return Look(None if entry and plain else color, finish(metallic, roughness)), None
        texture, mean = picture.painted(color)
        return Look(mean, finish(metallic, roughness, texture)), entry

    def _picture(self, entry: Mapping[str, Any]) -> Picture | None:
        """The picture of a texture that a material names."""
        if not entry:
            return None
        textures, images = self._list("textures"), self._list("images")
        texture = _at(textures, entry.get("index"))
        source = texture.get("source")
        webp = _object(_object(texture, "extensions"), "EXT_texture_webp").get("source")
        image = _at(images, webp if source is None else source)
        name = str(image.get("name") or image.get("uri") or "texture")
        name = "texture" if name.startswith("data:") else name
        if isinstance(image.get("bufferView"), int):
            return self._pictures.inside(self._view(image["bufferView"]), name)
        uri = image.get("uri")
        if not isinstance(uri, str):
            self._pictures.fault(name, "it is not in the file, or of a form that is not readable")
            return None
        if not uri.startswith("data:"):
            return self._pictures.beside(uri)
        head, _, text = uri.partition(",")
        try:
            data = base64.b64decode(text) if head.endswith(";base64") else urllib.parse.unquote_to_bytes(text)
        except (binascii.Error, ValueError):
            data = b""
        return self._pictures.inside(data, name)

    def _view(self, number: int) -> bytes:
        return _view(self._document, self._buffers, number)

    def _uvs(self, primitive: Mapping[str, Any], entry: Mapping[str, Any] | None, mesh: Mesh) -> Floats | None:
        if entry is None:
            return None
        moved = _object(_object(entry, "extensions"), _MOVED)
        uvs = self._accessor(primitive, f"TEXCOORD_{moved.get('texCoord', entry.get('texCoord', 0))}", mesh)
        if uvs is None or uvs.shape[2] != 2:
            return None
        if moved:
            (du, dv), (su, sv) = _pair(moved.get("offset"), 0.0), _pair(moved.get("scale"), 1.0)
            angle = _number(moved.get("rotation")) or 0.0
            c, s = math.cos(angle), math.sin(angle)
            u, v = uvs[..., 0] * su, uvs[..., 1] * sv
            uvs = np.stack([c * u + s * v + du, -s * u + c * v + dv], axis=2)
        # glTF counts from the upper left.
        return np.stack([uvs[..., 0], 1.0 - uvs[..., 1]], axis=2)

    def _accessor(self, primitive: Mapping[str, Any], name: str, mesh: Mesh) -> Floats | None:
        """(m, 3, k) an attribute's numbers at the triangles' corners; None where it is absent or broken."""
        number = _object(primitive, "attributes").get(name)
        values = accessor(self._document, self._buffers, number, normalized=name.startswith("COLOR"))
        if values is None or values.shape[1] < 2 or (len(mesh.triangles) and mesh.triangles.max() >= len(values)):
            return None
        return np.asarray(values[mesh.triangles])

    def _list(self, key: str) -> list[Mapping[str, Any]]:
        return _list(self._document, key)


def accessor(
    document: Mapping[str, Any], buffers: Sequence[bytes], number: Any, *, normalized: bool = False
) -> Floats | None:
    """(n, k) the numbers of an accessor, integers divided by their range where it, or `normalized`, says so; None where
    it is absent or broken."""
    entry = _at(_list(document, "accessors"), number)
    kind, width = _TYPES.get(entry.get("componentType", 0)), _WIDTHS.get(str(entry.get("type")))
    view = _at(_list(document, "bufferViews"), entry.get("bufferView"))
    count, start = entry.get("count"), entry.get("byteOffset", 0)
    if kind is None or width is None or not isinstance(count, int) or not isinstance(start, int) or start < 0:
        return None
    size = np.dtype(kind).itemsize * width
    stride = view.get("byteStride") or size
    data = _view(document, buffers, entry["bufferView"]) if view else b""
    if not 0 < count <= 1 << 28 or not isinstance(stride, int) or not size <= stride <= 252:
        return None
    if start + (count - 1) * stride + size > len(data):
        return None
    raw = np.ndarray((count, width), dtype=kind, buffer=data, offset=start, strides=(stride, size // width))
    values = raw.astype(np.float64)
    return values / STEPS.get(entry["componentType"], 1.0) if entry.get("normalized") or normalized else values


def _view(document: Mapping[str, Any], buffers: Sequence[bytes], number: int) -> bytes:
    view = _at(_list(document, "bufferViews"), number)
    buffer, start, length = (view.get(k, 0) for k in ("buffer", "byteOffset", "byteLength"))
    if not all(isinstance(v, int) and v >= 0 for v in (buffer, start, length)) or buffer >= len(buffers):
        return b""
    return buffers[buffer][start : start + length]


def _list(document: Mapping[str, Any], key: str) -> list[Mapping[str, Any]]:
    found = document.get(key, [])
    return [item if isinstance(item, dict) else {} for item in found] if isinstance(found, list) else []


def _object(entry: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    found = entry.get(key)
    return found if isinstance(found, dict) else {}


def _at(entries: Sequence[Mapping[str, Any]], number: Any) -> Mapping[str, Any]:
    return entries[number] if isinstance(number, int) and 0 <= number < len(entries) else {}


def _number(value: Any) -> float | None:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        return None
    return float(value)


def _pair(value: Any, default: float) -> tuple[float, float]:
    numbers = [_number(v) for v in value] if isinstance(value, list) and len(value) == 2 else [None, None]
    first, second = (default if v is None else v for v in numbers)
    return first, second


def _color(value: Any) -> Color:
    """Linear RGB of a factor; white without one."""
    numbers = [_number(v) for v in value[:3]] if isinstance(value, list) else []
    if len(numbers) != 3 or None in numbers:
        return (1.0, 1.0, 1.0)
    r, g, b = (min(max(v or 0.0, 0.0), 1.0) for v in numbers)
    return r, g, b
