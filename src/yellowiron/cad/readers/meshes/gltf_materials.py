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
from yellowiron.cad.readers.meshes.gltf_accessors import accessor, item, part, view
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Mesh

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
        look, texture = Look(), None
        entries = self._document.get("materials")
        if isinstance(number, int) and isinstance(entries, list) and 0 <= number < len(entries):
            if number not in self._known:
                self._known[number] = self._read(item(self._document, "materials", number))
            look, texture = self._known[number]
        paint = self._accessor(primitive, "COLOR_0", mesh)
        return look, self._uvs(primitive, texture, mesh), None if paint is None else paint[:, :, :3].mean(axis=1)

    def _read(self, material: Mapping[str, Any]) -> tuple[Look, Mapping[str, Any] | None]:
        pbr = part(material, "pbrMetallicRoughness")
        old = part(part(material, "extensions"), _OLD)
        color = _color(old.get("diffuseFactor") if old else pbr.get("baseColorFactor"))
        metallic, roughness = _number(pbr.get("metallicFactor")), _number(pbr.get("roughnessFactor"))
        if old:
            glossy = _number(old.get("glossinessFactor"))
            metallic, roughness = 0.0, None if glossy is None else 1.0 - glossy
        mixed = self._picture(part(pbr, "metallicRoughnessTexture"))
        if mixed is not None:
            # Green is roughness, blue is metalness; the mean stands for both.
            metallic = (1.0 if metallic is None else metallic) * mixed.raw[2]
            roughness = (1.0 if roughness is None else roughness) * mixed.raw[1]
        entry = part(old, "diffuseTexture") if old else part(pbr, "baseColorTexture")
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
        texture = item(self._document, "textures", entry.get("index"))
        source = texture.get("source")
        webp = part(part(texture, "extensions"), "EXT_texture_webp").get("source")
        image = item(self._document, "images", webp if source is None else source)
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
        return view(self._document, self._buffers, number)

    def _uvs(self, primitive: Mapping[str, Any], entry: Mapping[str, Any] | None, mesh: Mesh) -> Floats | None:
        if entry is None:
            return None
        moved = part(part(entry, "extensions"), _MOVED)
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
        number = part(primitive, "attributes").get(name)
        values = accessor(self._document, self._buffers, number, normalized=name.startswith("COLOR"))
        if values is None or values.shape[1] < 2 or (len(mesh.triangles) and mesh.triangles.max() >= len(values)):
            return None
        return np.asarray(values[mesh.triangles])


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
