"""Mesh files beside a document: binary STL or OBJ, one file a distinct mesh, the same bytes for the same meshes."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Literal

import numpy as np

from yellowiron.model.geometry import Mesh

_LONGEST = 100
"""Letters of a file name."""
MOST_TRIANGLES = 200_000
"""The largest STL that MuJoCo reads; a larger mesh becomes several."""

_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


class Assets:
    """Files in a folder. Equal meshes share one; names are those of their first use, in plain letters."""

    def __init__(self, folder: Path, *, form: Literal["stl", "obj"] = "stl", most: int = MOST_TRIANGLES) -> None:
        """`most`: triangles of a file; a larger mesh becomes several."""
        self._folder = folder
        self._form = form
        self._most = most
        self._by_content: dict[bytes, str] = {}
        self._taken: set[str] = set()
        self.files: dict[str, str] = {}
        """Asset name → file name, in order of first use."""

    def add(self, name: str, mesh: Mesh) -> tuple[str, ...]:
        """The asset names that hold a mesh, written if they are new."""
        chunks = range(0, len(mesh.triangles), self._most)
        return tuple(self._one(name, mesh.points, mesh.triangles[start : start + self._most]) for start in chunks)

    def _one(self, name: str, points: np.ndarray, triangles: np.ndarray) -> str:
        content = _stl(points, triangles) if self._form == "stl" else _obj(points, triangles)
        if content not in self._by_content:
            asset = unique(plain(name), self._taken)
            self._by_content[content] = asset
            self.files[asset] = f"{asset}.{self._form}"
            self._folder.mkdir(parents=True, exist_ok=True)
            (self._folder / self.files[asset]).write_bytes(content)
        return self._by_content[content]


def _stl(points: np.ndarray, triangles: np.ndarray) -> bytes:
    corners = points[triangles].astype(np.float32) + np.float32(0.0)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).astype(np.float64)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    records = np.zeros(len(triangles), dtype=_RECORD)
    records["normal"] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0.0) + 0.0
    records["corners"] = corners
    return b"\0" * 80 + np.uint32(len(triangles)).tobytes() + records.tobytes()


def _obj(points: np.ndarray, triangles: np.ndarray) -> bytes:
    """The points that are used, to a micrometre of a hundred metres, and the triangles, counted from 1."""
    used, places = np.unique(triangles, return_inverse=True)
    lines = ["v {:.9g} {:.9g} {:.9g}".format(*point) for point in (points[used] + 0.0).tolist()]
    lines += ["f {} {} {}".format(*row) for row in (places.reshape(-1, 3) + 1).tolist()]
    return ("\n".join(lines) + "\n").encode("ascii")


def plain(name: str) -> str:
    """A name in letters, digits, `_`, `-` and `.` that a file may have on every system."""
    return re.sub(r"[^A-Za-z0-9_.-]+", "_", name).strip("._")[:_LONGEST] or "part"


def unique(name: str, taken: set[str]) -> str:
    """The name, numbered from 2 if it is taken (without regard to case); it is taken afterwards."""
    number, found = 1, name
    while found.lower() in taken:
        number += 1
        found = f"{name}_{number}"
    taken.add(found.lower())
    return found
