"""What the 3D view unpacks (`studio/src/viewer/model.ts`).

Gzip of a little-endian uint32 (the length of what follows), a JSON header padded to a multiple of 8, and one block of
binary in which the header's `[kind, offset, count]` entries point. The same content gives the same bytes.
"""

from __future__ import annotations

import gzip
import json
import struct
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats, Mesh, Shape


class Binary:
    """Arrays one after the other, each aligned to 8 bytes."""

    def __init__(self) -> None:
        self._pieces: list[bytes] = []
        self._length = 0

    def add(self, array: NDArray[Any]) -> list[Any]:
        """Appends an array; returns its kind, offset in bytes and number of elements."""
        entry = [array.dtype.kind + str(8 * array.dtype.itemsize), self._length, int(array.size)]
        piece = np.ascontiguousarray(array).tobytes()
        piece += b"\0" * (-len(piece) % 8)
        self._pieces.append(piece)
        self._length += len(piece)
        return entry

    def bytes(self) -> bytes:
        """All of them, as they are written."""
        return b"".join(self._pieces)


def packed(header: Mapping[str, Any], binary: Binary) -> bytes:
    """A header and the arrays that its entries point to."""
    text = json.dumps(header, separators=(",", ":"), sort_keys=True, ensure_ascii=False).encode("utf-8")
    text += b" " * (-(4 + len(text)) % 8)
    return gzip.compress(struct.pack("<I", len(text)) + text + binary.bytes(), compresslevel=9, mtime=0)


def largest(assembly: Assembly, keys: Sequence[str], *, most: int) -> dict[str, int]:
    """Shape → its number, in the given order, without the smallest ones beyond a budget of `most`
    triangles."""

    def size(shape: Shape) -> float:
        return float(np.linalg.norm(np.ptp(shape.mesh.points, axis=0))) if len(shape.mesh.points) else 0.0

    budget = most
    kept: set[str] = set()
    for key in sorted(keys, key=lambda each: -size(assembly.shapes[each])):
        budget -= len(assembly.shapes[key].mesh.triangles)
        if budget < 0 and kept:
            break
        if len(assembly.shapes[key].mesh.triangles):
            kept.add(key)
    return {key: number for number, key in enumerate(key for key in keys if key in kept)}


def mesh_entry(mesh: Mesh, binary: Binary) -> dict[str, Any]:
    """A mesh quantised to its own box: positions to 16 bits (planes of differences, which pack well), normals to two
    bytes (octahedral), indices as differences."""
    points = np.asarray(mesh.points, dtype=np.float64)
    low = points.min(axis=0)
    size = np.maximum(points.max(axis=0) - low, 1e-9)
    grid = np.rint((points - low) / size * 65535.0).astype(np.int64)
    steps = np.diff(grid, axis=0, prepend=np.zeros((1, 3), dtype=np.int64))
    indices = np.asarray(mesh.triangles, dtype=np.int64).reshape(-1)
    jumps = np.diff(indices, prepend=0)
    narrow = len(points) <= 65536
    return {
        "low": [float(f"{x:.7g}") for x in low],
        "size": [float(f"{x:.7g}") for x in size],
        "points": binary.add((steps.T % 65536).astype("<u2")),
        "indices": binary.add((jumps % 65536).astype("<u2") if narrow else jumps.astype("<i4")),
        "normals": None if mesh.normals is None else binary.add(_octahedral(mesh.normals).T.astype("i1")),
    }


def _octahedral(normals: Floats) -> NDArray[np.int64]:
    """Unit vectors (n, 3) as two signed bytes (n, 2): the octahedron unfolded (Cigolle et al., JCGT 2014)."""
    n = np.asarray(normals, dtype=np.float64)
    n = n / np.maximum(np.abs(n).sum(axis=1, keepdims=True), 1e-12)
    folded = (1.0 - np.abs(n[:, [1, 0]])) * np.where(n[:, :2] >= 0.0, 1.0, -1.0)
    return np.rint(127.0 * np.where(n[:, 2:] >= 0.0, n[:, :2], folded)).astype(np.int64)


def _srgb(linear: Floats | Sequence[float]) -> NDArray[np.int64]:
    """Linear RGB as display bytes, as in the pictures."""
    return np.rint(255.0 * np.clip(np.asarray(linear, dtype=np.float64), 0.0, 1.0) ** (1.0 / 2.2)).astype(np.int64)


def rgb(linear: Sequence[float]) -> list[int]:
    """Linear RGB as display bytes."""
    return list(_bytes(tuple(linear)))


@lru_cache(maxsize=1024)
def _bytes(linear: tuple[float, ...]) -> tuple[int, ...]:
    """Most parts of a machine have one of a few colours."""
    return tuple(int(value) for value in _srgb(linear))
