"""A Wavefront OBJ file to an `Assembly`: a part for every object or group. Runs in the guard's child process.

OBJ has no unit and no instances; of its material file the colours, metalness, roughness and textures are read.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from yellowiron.cad.appearance.looks import Dressed, Look, dress
from yellowiron.cad.appearance.textures import Pictures, finish
from yellowiron.cad.bounds import CORNERS, require_polygon
from yellowiron.cad.mesh import assembly
from yellowiron.cad.mesh.assembly import Occurrence
from yellowiron.cad.naming import decode_name, decode_text, encoding_remarks, is_generic
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Mesh

_DAMAGED = "Copy or export it again; the file is damaged."
_NAMES = re.compile(rb"^[ \t]*(?:o|g|usemtl|mtllib|newmtl)[ \t]+([^\r\n]*)", re.MULTILINE)
_STATEMENTS = frozenset(
    ("v", "vt", "vn", "vp", "f", "fo", "l", "p", "o", "g", "s", "mg", "usemtl", "mtllib", "usemap", "maplib", "cstype",
     "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole", "scrv", "sp", "end", "con", "bevel",
     "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj", "ctech", "stech", "call", "csh")
)  # fmt: skip
"""What a line may begin with, besides `#`."""
_HEADS = ("o", "g", "usemtl")
"""What something follows."""
_OPTION = re.compile(r"\s*-(?:[a-z]+)(?:\s+(?:on|off|[lmrgbz]|[-+]?[\d.]+(?:e[-+]?\d+)?))*\s+", re.IGNORECASE)


@dataclass
class _Group:
    """The faces under one object and group, as corners into the file's points and texture coordinates (-1: none), and
    the material of each."""

    name: str
    triangles: list[tuple[int, int, int]] = field(default_factory=list)
    pictured: list[tuple[int, int, int]] = field(default_factory=list)
    materials: list[str] = field(default_factory=list)


@dataclass
class _File:
    """What stands in a file: points (n, 3) in its unit, their colours where all have one, texture coordinates (k, 2),
    the groups that have faces, and the material files it names."""

    points: Floats
    paint: Floats | None
    coordinates: Floats
    groups: list[_Group]
    libraries: list[str]
    encoding: str
    faults: list[str]
    """What shows that something is missing."""


def read_obj(path: str) -> Assembly:
    """The assembly in an OBJ file, in metres, its polygons cut into fans of triangles. `CadError` if a line is broken,
    if faces name points that are not there, or without a face."""
    findings: list[Finding] = []
    groups = _groups(path, findings)
    unit, remarks = assembly.guessed_unit([one.mesh.points for _, one in groups], path)
    findings += remarks
    occurrences = []
    for name, one in groups:
        scaled = replace(one.mesh, points=one.mesh.points * unit)
        title = name if name and not is_generic(name) else "Part"
        occurrences.append(Occurrence(title, (), scaled, np.eye(4), one.color, one.finishes))
    return assembly.assemble(
        occurrences, name=Path(path).stem, format="OBJ", unit=unit, path=path, findings=findings,
    )  # fmt: skip


def meshes_of(file: Path, findings: list[Finding]) -> list[tuple[str, Dressed]]:
    """Name and mesh (in the file's unit) of every object or group; what is amiss goes to `findings`. `CadError` as for
    `read_obj`."""
    return _groups(str(file), findings)


def _groups(path: str, findings: list[Finding]) -> list[tuple[str, Dressed]]:
    file = _parsed(path)
    findings += encoding_remarks(file.encoding, path)
    if file.faults:
        words = f"{'; '.join(file.faults)}: parts may be missing or incomplete, as in a file that is cut short"
        findings.append(Finding("CAD001", "warning", path, words, _DAMAGED))
    looks = _looks(file, path, findings)
    numbers = {name: number for number, name in enumerate(looks)}
    found = []
    for group in file.groups:
        corners = np.array(group.triangles, dtype=np.int64)
        used, triangles = np.unique(corners, return_inverse=True)
        mesh = Mesh(file.points[used], triangles.reshape(-1, 3).astype(np.int32))
        rows = np.array([numbers.get(name, -1) for name in group.materials], dtype=np.int64)
        pictured = np.array(group.pictured, dtype=np.int64)
        uvs = file.coordinates[pictured] if len(file.coordinates) and (pictured >= 0).all() else None
        paint = None if file.paint is None else file.paint[corners].mean(axis=1)
        found.append((group.name, dress(mesh, list(looks.values()), rows, uvs=uvs, paint=paint)))
    return found


@dataclass
class _Reading:
    """What the lines read so far say, and which object, group and material the next faces are of."""

    path: str
    points: list[tuple[float, float, float]] = field(default_factory=list)
    paint: list[tuple[float, float, float]] = field(default_factory=list)
    coordinates: list[tuple[float, float]] = field(default_factory=list)
    groups: dict[tuple[int, str], _Group] = field(default_factory=dict)
    libraries: list[str] = field(default_factory=list)
    drawn: list[int] = field(default_factory=list)
    """The points of lines and points, which are read and left out."""
    objects: int = 0
    above: str = ""
    group: str = ""
    material: str = ""

    def vertex(self, rest: str) -> None:
        """`v x y z [r g b]`."""
        values = [float(v) for v in rest.split()]
        x, y, z = values[:3]
        self.points.append((x, y, z))
        if len(values) == 6:
            self.paint.append((values[3], values[4], values[5]))

    def coordinate(self, rest: str) -> None:
        """`vt u [v]`."""
        values = [float(v) for v in rest.split()]
        self.coordinates.append((values[0], values[1] if len(values) > 1 else 0.0))

    def face(self, rest: str) -> None:
        """`f` and its corners, `point/coordinate/normal` each: a fan of triangles."""
        entries = rest.split(None, CORNERS)
        require_polygon(len(entries), self.path)
        corners = [_index(entry, len(self.points)) for entry in entries]
        if len(corners) < 3:
            raise ValueError
        count = len(self.coordinates)
        seen = [_coordinate(entry, count) for entry in entries] if count else [-1] * len(corners)
        key = (self.objects, self.group)
        own = self.groups.setdefault(key, _Group(decode_name(self.group or self.above, "utf-8")))
        for k in range(1, len(corners) - 1):
            own.triangles.append((corners[0], corners[k], corners[k + 1]))
            own.pictured.append((seen[0], seen[k], seen[k + 1]))
            own.materials.append(self.material)

    def named_object(self, rest: str) -> None:
        """`o`: objects may share a name."""
        self.above, self.group = rest.strip(), ""
        self.objects += 1

    def named_group(self, rest: str) -> None:
        """`g`: a group that is named again goes on."""
        self.group = rest.strip()

    def used_material(self, rest: str) -> None:
        """`usemtl`."""
        self.material = rest.strip()

    def material_library(self, rest: str) -> None:
        """`mtllib`."""
        self.libraries.append(rest.strip())

    def line_or_point(self, rest: str) -> None:
        """`l`, `p`."""
        self.drawn += [_index(entry, len(self.points)) for entry in rest.split()]


_STEPS: dict[str, Callable[[_Reading, str], None]] = {
    "v": _Reading.vertex,
    "vt": _Reading.coordinate,
    "f": _Reading.face,
    "o": _Reading.named_object,
    "g": _Reading.named_group,
    "usemtl": _Reading.used_material,
    "mtllib": _Reading.material_library,
    "l": _Reading.line_or_point,
    "p": _Reading.line_or_point,
}
"""The statements that are read."""


def _parsed(path: str) -> _File:
    reading, last, strange = _Reading(path), "", 0
    data = Path(path).read_bytes()
    text, encoding = decode_text(data, _NAMES.findall(data))
    for number, line in enumerate(text.replace("\\\n", " ").splitlines(), start=1):
        word, _, rest = line.strip().partition(" ")
        if step := _STEPS.get(word):
            try:
                step(reading, rest)
            except (ValueError, IndexError) as error:
                words = f"The OBJ file is broken in line {number}: '{line.strip()[:60]}'"
                raise CadError(words, where=path, hint=_DAMAGED) from error
        elif word and not word.startswith("#") and word not in _STATEMENTS:
            strange += 1
            continue
        last = word if word and not word.startswith("#") else last
    if not reading.groups:
        raise CadError("The OBJ file holds no face", where=path, hint="Export the machine's parts with it.")
    points, paint = reading.points, reading.paint
    faults = [f"{strange} lines begin with what OBJ does not know"] if strange else []
    faults += [f"{loose} of its points are in no face"] if (loose := _in_no_face(reading)) else []
    faults += [f"it ends with '{last}', after which nothing comes"] if last in _HEADS else []
    return _File(
        points=np.array(points, dtype=np.float64).reshape(-1, 3),
        paint=np.clip(np.array(paint, dtype=np.float64), 0.0, 1.0) if len(paint) == len(points) else None,
        coordinates=np.array(reading.coordinates, dtype=np.float64).reshape(-1, 2),
        groups=list(reading.groups.values()),
        libraries=reading.libraries,
        encoding=encoding,
        faults=faults,
    )


def _in_no_face(reading: _Reading) -> int:
    """How many points no face, line or point has."""
    faces = [np.array(own.triangles, dtype=np.int64).reshape(-1) for own in reading.groups.values()]
    used = np.unique(np.concatenate([np.array(reading.drawn, dtype=np.int64), *faces]))
    return len(reading.points) - len(used)


def _index(entry: str, count: int) -> int:
    """A face's corner counted from 0; `IndexError` for one that is not there."""
    index = int(entry.partition("/")[0])
    index = index - 1 if index > 0 else count + index
    if not 0 <= index < count:
        raise IndexError
    return index


def _coordinate(entry: str, count: int) -> int:
    """A corner's texture coordinate counted from 0; -1 for one that is not there."""
    text = entry.split("/", 2)[1:2]
    if not text or not text[0]:
        return -1
    index = int(text[0])
    index = index - 1 if index > 0 else count + index
    return index if 0 <= index < count else -1


@dataclass
class _Material:
    color: Color | None = None
    metallic: float | None = None
    roughness: float | None = None
    picture: str = ""


def _looks(file: _File, path: str, findings: list[Finding]) -> dict[str, Look]:
    """Material → look, from the material files beside the OBJ file; others are not opened."""
    folder = Path(path).absolute().parent.resolve()
    pictures = Pictures(path)
    looks: dict[str, Look] = {}
    for library in file.libraries:
        target = (folder / library.replace("\\", "/")).resolve()
        if not target.is_relative_to(folder) or not target.is_file():
            where = "outside of its folder" if not target.is_relative_to(folder) else "not there"
            words = f"The material file '{library}' is {where}: parts have no colour"
            findings.append(Finding("CAD008", "warning", path, words, "Put it beside the OBJ file."))
            continue
        for name, one in _materials(target.read_bytes(), file.encoding).items():
            picture = pictures.beside(one.picture) if one.picture else None
            if picture is None:
                looks[name] = Look(one.color, finish(one.metallic, one.roughness))
                continue
            # Black under a picture is what exporters write for "the picture alone".
            texture, mean = picture.painted(one.color if one.color and max(one.color) > 0.0 else None)
            looks[name] = Look(mean, finish(one.metallic, one.roughness, texture))
    findings += pictures.findings()
    return looks


def _materials(data: bytes, encoding: str) -> dict[str, _Material]:
    found: dict[str, _Material] = {}
    one = _Material()
    for line in data.decode(encoding, errors="replace").splitlines():
        word, _, rest = line.strip().partition(" ")
        if word == "newmtl":
            one = found.setdefault(rest.strip(), _Material())
        elif word == "Kd" and len(color := _triple(rest)) == 3:
            one.color = (color[0], color[1], color[2])
        elif word in ("Pm", "Pr") and (value := _triple(rest)):
            one.metallic, one.roughness = (value[0], one.roughness) if word == "Pm" else (one.metallic, value[0])
        elif word == "map_Kd":
            one.picture = re.sub(rf"^(?:{_OPTION.pattern})+", "", rest.strip(), flags=re.IGNORECASE).strip()
    return found


def _triple(text: str) -> list[float]:
    """Up to three numbers in [0, 1], or nothing."""
    try:
        values = [float(v) for v in text.split()[:3]]
    except ValueError:
        return []
    return [min(max(v, 0.0), 1.0) for v in values] if all(math.isfinite(v) for v in values) else []
