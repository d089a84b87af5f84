"""The meshes of a glTF document: their primitives' triangles and looks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from yellowiron.cad.appearance.looks import Look
from yellowiron.cad.readers.meshes.gltf_accessors import accessor, fault, item, part
from yellowiron.cad.readers.meshes.gltf_compressed import DRACO
from yellowiron.cad.readers.meshes.gltf_materials import Materials
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats, Mesh

_LIST, _STRIP, _FAN = 4, 5, 6
"""Modes of triangles."""
_AGAIN = "Export it again as GLB, without compression."


@dataclass(frozen=True, eq=False)
class Piece:
    """A primitive: as it is drawn (mesh, look, texture coordinates and paint as in `looks.joined`), and the (n, k)
    bones of its points with their weights, where it is skinned."""

    drawn: tuple[Mesh, Look, Floats | None, Floats | None]
    bones: Floats | None
    weights: Floats | None


def pieces_of(
    document: Mapping[str, Any], buffers: Sequence[bytes], index: int, materials: Materials, findings: list[Finding]
) -> list[Piece]:
    """The primitives of triangles of a mesh; those that are broken are absent, with a finding."""
    entry = item(document, "meshes", index)
    found: list[Piece] = []
    for primitive in _primitives(entry):
        words = _fault(document, buffers, primitive)
        if words:
            name = str(entry.get("name") or f"mesh {index}")
            findings.append(Finding("CAD003", "error", name, f"Left out: {words}", _AGAIN))
            continue
        mesh = _mesh(document, buffers, primitive)
        bones = _attributes(document, buffers, primitive, "JOINTS", len(mesh.points))
        weights = _attributes(document, buffers, primitive, "WEIGHTS", len(mesh.points))
        matched = bones is not None and weights is not None and bones.shape == weights.shape
        found.append(
            Piece((mesh, *materials.of(primitive, mesh)), bones if matched else None, weights if matched else None)
        )
    return found


def has_triangles(document: Mapping[str, Any], index: int) -> bool:
    """Whether a mesh should have triangles: it says so, or has lost what it has to have."""
    entry = item(document, "meshes", index)
    return not entry.get("primitives") or bool(_primitives(entry))


def _primitives(entry: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """Those of triangles."""
    found = entry.get("primitives")
    every = [p if isinstance(p, dict) else {} for p in found] if isinstance(found, list) else []
    return [p for p in every if p.get("mode", _LIST) in (_LIST, _STRIP, _FAN)]


def _fault(document: Mapping[str, Any], buffers: Sequence[bytes], primitive: Mapping[str, Any]) -> str:
    """What keeps a primitive's triangles from being read; '' if nothing does."""
    points = part(primitive, "attributes").get("POSITION")
    if points is None:
        return "it has no points"
    if DRACO in part(primitive, "extensions"):
        return "its compressed triangles are broken"
    words = fault(document, buffers, points)
    if not words and "indices" in primitive:
        words = fault(document, buffers, primitive["indices"])
    if words:
        return words
    if item(document, "accessors", points).get("type") != "VEC3":
        return "its points are not in space"
    corners = item(document, "accessors", primitive.get("indices", points))
    if "indices" in primitive and corners.get("type") != "SCALAR":
        return "its corners are not numbers of points"
    if primitive.get("mode", _LIST) == _LIST and corners["count"] % 3:
        return "its corners do not make whole triangles"
    return ""


def _mesh(document: Mapping[str, Any], buffers: Sequence[bytes], primitive: Mapping[str, Any]) -> Mesh:
    """The triangles of a primitive that `_fault` finds nothing wrong with."""
    points = accessor(document, buffers, primitive["attributes"]["POSITION"])
    points = np.zeros((0, 3)) if points is None else points
    read = accessor(document, buffers, primitive["indices"]) if "indices" in primitive else None
    triangles = _triangles(np.arange(len(points)) if read is None else read[:, 0].astype(np.int64), primitive)
    inside = np.asarray(((triangles >= 0) & (triangles < len(points))).all(axis=1))
    # A corner that is not there is a point that is not a number: the check behind finds and names it.
    points = np.concatenate([points, np.full((1, 3), np.nan)]) if not inside.all() else points
    triangles = np.where(inside[:, None], triangles, len(points) - 1)
    return Mesh(points, triangles.astype(np.int32))


def _triangles(corners: NDArray[np.int64], primitive: Mapping[str, Any]) -> NDArray[np.int64]:
    """(m, 3) the triangles of a list, strip or fan; the empty ones, by which strips are joined, are left out."""
    mode = primitive.get("mode", _LIST)
    if mode == _LIST:
        return corners.reshape(-1, 3)
    first = np.arange(max(len(corners) - 2, 0))
    if mode == _STRIP:
        odd = first % 2
        found = np.stack([corners[first], corners[first + 1 + odd], corners[first + 2 - odd]], axis=1)
    else:
        found = np.stack([corners[first * 0], corners[first + 1], corners[first + 2]], axis=1)
    a, b, c = found.T
    return np.asarray(found[(a != b) & (b != c) & (a != c)])


def _attributes(
    document: Mapping[str, Any], buffers: Sequence[bytes], primitive: Mapping[str, Any], name: str, count: int
) -> Floats | None:
    """(count, 4 k) an attribute that comes in k sets of four; None where it is absent or does not fit the points."""
    sets: list[Floats] = []
    while f"{name}_{len(sets)}" in part(primitive, "attributes"):
        number = primitive["attributes"][f"{name}_{len(sets)}"]
        values = accessor(document, buffers, number, normalized=name == "WEIGHTS")
        if values is None or len(values) > count or values.shape[1] != 4:
            return None
        # A point that is added for corners that are not there has no bone.
        sets.append(np.concatenate([values, np.zeros((count - len(values), 4))]))
    return np.concatenate(sets, axis=1) if sets else None
