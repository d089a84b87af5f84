"""A 3MF file to an `Assembly`: a part for every object with a mesh that its build places. Runs in the guard's child
process.

3MF Core Specification 1.3: units, objects, components, transforms (row vectors, twelve numbers), base materials.
"""

from __future__ import annotations

import zipfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from yellowiron.cad.bounds import limited
from yellowiron.cad.mesh import assembly
from yellowiron.cad.mesh.assembly import Occurrence
from yellowiron.cad.naming import decode_name, is_generic
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Mesh, linear

_UNITS = {"micron": 1e-6, "millimeter": 1e-3, "centimeter": 1e-2, "meter": 1.0, "inch": 0.0254, "foot": 0.3048}
_DAMAGED = "Copy or export it again; the file is damaged."
_LARGEST = 2 * 1024**3
"""Bytes of one document when unpacked."""
_DEEPEST = 50


@dataclass
class _Object:
    """An object: its name, its mesh if it has one, else what it is made of."""

    name: str
    mesh: Mesh | None = None
    color: Color | None = None
    components: list[tuple[tuple[str, str], Floats]] = field(default_factory=list)


def read_3mf(path: str) -> Assembly:
    """The assembly in a 3MF file, in metres. `CadError` if it is damaged or places no mesh."""
    objects: dict[tuple[str, str], _Object] = {}
    items: list[tuple[tuple[str, str], Floats]] = []
    unit = 1e-3
    try:
        with zipfile.ZipFile(path) as archive:
            names = sorted(n for n in archive.namelist() if n.lower().endswith(".model"))
            for name in names:
                if archive.getinfo(name).file_size > _LARGEST:
                    raise CadError(f"{name} unpacks to more than 2 GB", where=path, hint="Split the model.")
                root = ElementTree.fromstring(archive.read(name))
                own = _UNITS.get(root.get("unit", "millimeter"), 1e-3)
                unit = own if name.lower().endswith("3dmodel.model") else unit
                items += _model(root, f"/{name}", own, objects)
    except (zipfile.BadZipFile, ElementTree.ParseError, ValueError, KeyError, EOFError, NotImplementedError) as error:
        raise CadError(f"The 3MF file is broken: {error}", where=path, hint=_DAMAGED) from error
    held = (found for key, matrix in items for found in _placed(key, matrix, (), objects, path))
    placements = [found for found in limited(held, path) if found[1].mesh is not None]
    occurrences = [
        Occurrence(names[-1], names[:-1], one.mesh, matrix, one.color)
        for names, one, matrix in placements
        if one.mesh is not None
    ]
    findings: list[Finding] = []
    return assembly.assemble(
        occurrences, name=Path(path).stem, format="3MF", unit=unit, path=path, findings=findings,
        declared=len(placements),
    )  # fmt: skip


def _model(
    root: ElementTree.Element, file: str, unit: float, objects: dict[tuple[str, str], _Object]
) -> list[tuple[tuple[str, str], Floats]]:
    """Reads one model document's objects; what its build places."""
    colors: dict[tuple[str, int], Color] = {}
    for group in _all(root, "basematerials") + _all(root, "colorgroup"):
        for index, entry in enumerate(group):
            color = _color(entry.get("displaycolor") or entry.get("color") or "")
            if color is not None:
                colors[group.get("id", ""), index] = color
    for entry in _all(root, "object"):
        key = (file, entry.get("id", ""))
        name = decode_name(entry.get("name") or entry.get("partnumber") or "", "utf-8")
        one = _Object("Part" if is_generic(name) else name)
        one.color = colors.get((entry.get("pid", ""), int(entry.get("pindex", "0"))))
        meshes = _all(entry, "mesh")
        if meshes:
            one.mesh = _mesh(meshes[0], unit, entry, colors, one.color)
        for component in _all(entry, "component"):
            other = next((v for k, v in component.attrib.items() if k.endswith("path")), file)
            one.components.append(((other, component.get("objectid", "")), _transform(component, unit)))
        objects[key] = one
    found = []
    for item in _all(root, "item"):
        other = next((v for k, v in item.attrib.items() if k.endswith("path")), file)
        found.append(((other, item.get("objectid", "")), _transform(item, unit)))
    return found


def _placed(
    key: tuple[str, str], matrix: Floats, above: tuple[str, ...], objects: dict[tuple[str, str], _Object], path: str
) -> Iterator[tuple[tuple[str, ...], _Object, Floats]]:
    """An object and all below it, with names and transforms."""
    if key not in objects:
        raise CadError(f"The 3MF file names an object that is not there: {key[1]}", where=path, hint=_DAMAGED)
    if len(above) > _DEEPEST:
        raise CadError("The 3MF file is broken: an object holds itself", where=path, hint=_DAMAGED)
    one = objects[key]
    names = (*above, one.name)
    yield names, one, matrix
    for other, place in one.components:
        yield from _placed(other, matrix @ place, names, objects, path)


def _mesh(
    entry: ElementTree.Element,
    unit: float,
    owner: ElementTree.Element,
    colors: dict[tuple[str, int], Color],
    color: Color | None,
) -> Mesh:
    vertices, triangles = _all(entry, "vertex"), _all(entry, "triangle")
    points = np.array([[float(v.get(axis, "nan")) for axis in "xyz"] for v in vertices]).reshape(-1, 3)
    corners = np.array([[int(t.get(f"v{i}", "-1")) for i in (1, 2, 3)] for t in triangles], dtype=np.int64)
    corners = corners.reshape(-1, 3)
    if len(corners) and not 0 <= corners.min() <= corners.max() < len(points):
        raise ValueError("its triangles name points that are not there")
    own = [
        colors.get((t.get("pid", owner.get("pid", "")), int(t.get("p1", "0")))) if t.get("p1") else color
        for t in triangles
    ]
    several = len(set(own)) > 1
    painted = np.array([c or (0.5, 0.5, 0.5) for c in own]) if several else None
    return Mesh(points * unit, corners.astype(np.int32), None, painted)


def _transform(entry: ElementTree.Element, unit: float) -> Floats:
    text = entry.get("transform")
    matrix = np.eye(4)
    if text:
        numbers = np.array([float(v) for v in text.split()])
        if numbers.shape != (12,):
            raise ValueError("a transform has not twelve numbers")
        matrix[:3] = numbers.reshape(4, 3).T
        matrix[:3, 3] *= unit
    return matrix


def _all(entry: ElementTree.Element, name: str) -> list[ElementTree.Element]:
    """The elements of that name below one, in whatever namespace."""
    return [e for e in entry.iter() if isinstance(e.tag, str) and e.tag.rpartition("}")[2] == name]


def _color(text: str) -> Color | None:
    """#RRGGBB or #RRGGBBAA, which are sRGB, in linear RGB."""
    try:
        return linear([int(text[i : i + 2], 16) / 255.0 for i in (1, 3, 5)])
    except ValueError:
        return None
