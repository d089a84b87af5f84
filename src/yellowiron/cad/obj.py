"""A Wavefront OBJ file to an `Assembly`: a part for every object or group. Runs in the guard's child process.

OBJ has no unit and no instances; of its material file the colours are read.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from yellowiron.cad import placed
from yellowiron.cad.naming import decode_name, is_generic
from yellowiron.cad.placed import Occurrence
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Mesh

_DAMAGED = "Copy or export it again; the file is damaged."


@dataclass
class _Group:
    """The faces under one object and group, as corners into the file's points, and the material of each."""

    name: str
    triangles: list[tuple[int, int, int]] = field(default_factory=list)
    materials: list[str] = field(default_factory=list)


def read_obj(path: str) -> Assembly:
    """The assembly in an OBJ file, in metres, its polygons cut into fans of triangles. `CadError` if a line is broken,
    if faces name points that are not there, or without a face."""
    findings: list[Finding] = []
    groups = _groups(path, findings)
    unit, remarks = placed.guessed_unit([mesh.points for _, mesh, _ in groups], path)
    findings += remarks
    occurrences = []
    for name, mesh, color in groups:
        scaled = Mesh(mesh.points * unit, mesh.triangles, None, mesh.triangle_colors)
        occurrences.append(Occurrence(name if name and not is_generic(name) else "Part", (), scaled, np.eye(4), color))
    return placed.assemble(
        occurrences, name=Path(path).stem, format="OBJ", unit=unit, path=path, findings=findings,
    )  # fmt: skip


def meshes_of(file: Path) -> list[tuple[str, Mesh, Color | None]]:
    """Name, triangles (in the file's unit) and colour of every object or group. `CadError` as for `read_obj`."""
    return _groups(str(file), [])


def _groups(path: str, findings: list[Finding]) -> list[tuple[str, Mesh, Color | None]]:
    points, groups, libraries = _parsed(path)
    colors = _colors(libraries, path, findings)
    found = []
    for group in groups:
        used, triangles = np.unique(np.array(group.triangles, dtype=np.int64), return_inverse=True)
        paint = [colors.get(name) for name in group.materials]
        several = len(set(paint)) > 1
        painted = np.array([c or (0.5, 0.5, 0.5) for c in paint]) if several else None
        mesh = Mesh(points[used], triangles.reshape(-1, 3).astype(np.int32), None, painted)
        found.append((group.name, mesh, None if several else paint[0]))
    return found


def _parsed(path: str) -> tuple[np.ndarray[tuple[int, int], np.dtype[np.float64]], list[_Group], list[str]]:
    """Points (n, 3) in the file's unit, its groups that have faces, and the material files it names."""
    points: list[tuple[float, float, float]] = []
    groups: dict[tuple[int, str], _Group] = {}
    libraries: list[str] = []
    above = group = material = ""
    objects = 0
    text = Path(path).read_bytes().decode("utf-8", errors="replace").replace("\\\n", " ")
    for number, line in enumerate(text.splitlines(), start=1):
        word, _, rest = line.strip().partition(" ")
        try:
            if word == "v":
                x, y, z = (float(v) for v in rest.split()[:3])
                points.append((x, y, z))
            elif word == "f":
                corners = [_index(entry, len(points)) for entry in rest.split()]
                if len(corners) < 3:
                    raise ValueError
                own = groups.setdefault((objects, group), _Group(decode_name(group or above, "utf-8")))
                for k in range(1, len(corners) - 1):
                    own.triangles.append((corners[0], corners[k], corners[k + 1]))
                    own.materials.append(material)
            elif word in ("o", "g"):
                # Objects may share a name; a group that is named again goes on.
                above, group = (rest.strip(), "") if word == "o" else (above, rest.strip())
                objects += word == "o"
            elif word == "usemtl":
                material = rest.strip()
            elif word == "mtllib":
                libraries.append(rest.strip())
        except (ValueError, IndexError) as error:
            words = f"The OBJ file is broken in line {number}: '{line.strip()[:60]}'"
            raise CadError(words, where=path, hint=_DAMAGED) from error
    if not groups:
        raise CadError("The OBJ file holds no face", where=path, hint="Export the machine's parts with it.")
    return np.array(points, dtype=np.float64).reshape(-1, 3), list(groups.values()), libraries


def _index(entry: str, count: int) -> int:
    """A face's corner counted from 0; `IndexError` for one that is not there."""
    index = int(entry.partition("/")[0])
    index = index - 1 if index > 0 else count + index
    if not 0 <= index < count:
        raise IndexError
    return index


def _colors(libraries: list[str], path: str, findings: list[Finding]) -> dict[str, Color]:
    """Material → linear RGB, from the material files beside the OBJ file; others are not opened."""
    folder = Path(path).absolute().parent.resolve()
    colors: dict[str, Color] = {}
    for library in libraries:
        target = (folder / library.replace("\\", "/")).resolve()
        if not target.is_relative_to(folder) or not target.is_file():
            where = "outside of its folder" if not target.is_relative_to(folder) else "not there"
            words = f"The material file '{library}' is {where}: parts have no colour"
            findings.append(Finding("CAD008", "warning", path, words, "Put it beside the OBJ file."))
            continue
        name = ""
        for line in target.read_bytes().decode("utf-8", errors="replace").splitlines():
            word, _, rest = line.strip().partition(" ")
            if word == "newmtl":
                name = rest.strip()
            elif word == "Kd" and len(color := _triple(rest)) == 3:
                colors[name] = (color[0], color[1], color[2])
    return colors


def _triple(text: str) -> list[float]:
    """Three numbers in [0, 1], or nothing."""
    try:
        values = [float(v) for v in text.split()[:3]]
    except ValueError:
        return []
    return [min(max(v, 0.0), 1.0) for v in values] if all(math.isfinite(v) for v in values) else []
