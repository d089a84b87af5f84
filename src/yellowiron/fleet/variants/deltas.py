"""Variants as what differs from the base's MJCF: element → attribute → value, and such a variant put together again.

The base is exported once. A variant is exported without its meshes, which do not vary, and held against the base done
so too; colliders are told apart, by their materials and wheels.
"""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np

from yellowiron.exporters import read_geometry
from yellowiron.exporters.assets import plain
from yellowiron.exporters.geometry import BodyGeometry, Collider, Geometry
from yellowiron.exporters.mjcf.document import ASSETS, export_mjcf
from yellowiron.exporters.values import row, text
from yellowiron.fleet.documents import UnusableError
from yellowiron.fleet.variants.changes import Changed
from yellowiron.fleet.variants.sampling import Draw
from yellowiron.fleet.variants.tools import Tool, Tools
from yellowiron.model.mechanism import Mechanism
from yellowiron.support.text import to_json

SUFFIX = ".json"
Delta = Mapping[str, Mapping[str, str | None]]
"""Element, as `joint NAME` or `inertial BODY`, → attribute → value, None where the variant has none."""
_RIM = 0.98
_ROUND = ("cylinder", "sphere", "capsule")


class Deltas:
    """Writes a machine's variants as what differs from its MJCF."""

    def __init__(self, mechanism: Mechanism, file: Path, draws: Sequence[Draw], tools: Tools) -> None:
        self._base = mechanism
        self._geometry = read_geometry(file)
        self._bare = Geometry({name: BodyGeometry() for name in self._geometry.bodies}, self._geometry.filtered)
        vary = {draw.parameter.vary for draw in draws}
        self._tools = {
            (body, word): shape_of(tool, body)
            for body, own in tools.items()
            for word, tool in own.items()
            if tool.file is not None
        }
        with tempfile.TemporaryDirectory(prefix="yellowiron-") as folder:
            self._light = _elements(self._exported(mechanism, self._bare, Path(folder, "light")))
            marked = bool(vary & {"friction", "tyre_radius"})
            self._geoms = self._marked(self._geometry, Path(folder, "marked")) if marked else []
            self._own_geoms = {
                (body, word): self._marked(self._alone(body, shape), Path(folder, "tools", str(number)))
                for number, ((body, word), shape) in enumerate(self._tools.items() if marked else ())
            }
        if "tyre_radius" in vary:
            self._check_wheels(draws)

    def _exported(self, mechanism: Mechanism, geometry: Geometry, folder: Path) -> ET.Element:
        return ET.parse(export_mjcf(mechanism, geometry, folder)).getroot()

    def _alone(self, body: str, shape: BodyGeometry) -> Geometry:
        """The geometry of a machine of which one body alone is there."""
        return replace(self._bare, bodies={**self._bare.bodies, body: shape})

    def _marked(self, geometry: Geometry, folder: Path) -> list[tuple[str, ET.Element]]:
        """Bodies and colliders, these with the number of their material for their friction, 1 for the first."""
        number = {name: float(place) for place, name in enumerate(self._base.materials, start=1)}

        def mark(collider: Collider) -> Collider:
            return replace(collider, friction=number.get(collider.material, 0.0))

        bodies = {
            name: replace(own, visuals=(), colliders=tuple(map(mark, own.colliders)))
            for name, own in geometry.bodies.items()
        }
        return list(_geoms(self._exported(self._base, replace(geometry, bodies=bodies), folder)))

    def _check_wheels(self, draws: Sequence[Draw]) -> None:
        for draw in draws:
            for name in draw.names if draw.parameter.vary == "tyre_radius" else ():
                if not any(body == name and geom.get("type") in _ROUND for body, geom in self._geoms):
                    raise UnusableError(
                        f"The tyre of '{name}' is no round collider in MJCF", where=draw.parameter.where,
                        hint="Leave it out, or write USD layers.",
                    )  # fmt: skip

    def write_base(self, folder: Path) -> None:
        """The machine in MJCF, and what its tools are of."""
        export_mjcf(self._base, self._geometry, folder)
        for (body, word), shape in self._tools.items():
            with tempfile.TemporaryDirectory(prefix="yellowiron-") as made:
                tree = self._exported(self._base, self._alone(body, shape), Path(made))
                tool = _tool_of(tree, body, word)
                for mesh in tool.iter("mesh"):
                    (folder / ASSETS).mkdir(exist_ok=True)
                    shutil.copyfile(Path(made, ASSETS, mesh.attrib.pop("from")), folder / ASSETS / mesh.attrib["file"])
            place = _tool_file(folder, body, word)
            place.parent.mkdir(exist_ok=True)
            ET.indent(tool)
            place.write_text(ET.tostring(tool, encoding="unicode") + "\n", encoding="utf-8")

    def write(self, work: Changed, variant: Mechanism, record: Mapping[str, Any], stem: Path) -> None:
        """Writes what differs to `stem` with its suffix."""
        with tempfile.TemporaryDirectory(prefix="yellowiron-") as folder:
            own = _elements(self._exported(variant, self._bare, Path(folder)))
        delta: dict[str, dict[str, str | None]] = {}
        for key, attributes in own.items():
            before = self._light[key]
            names = [*attributes, *(name for name in before if name not in attributes)]
            changed = {name: attributes.get(name) for name in names if attributes.get(name) != before.get(name)}
            if changed:
                delta[key] = changed
        for key, touching in self._touching(work, variant):
            delta.setdefault(key, {}).update(touching)
        tools = {body: word for body, word in work.tools.items() if (body, word) in self._tools}
        document = {**record, **({"tools": tools} if tools else {}), "delta": delta}
        stem.with_suffix(SUFFIX).write_text(to_json(document), encoding="utf-8")

    def _touching(self, work: Changed, variant: Mechanism) -> Iterator[tuple[str, dict[str, str | None]]]:
        """Frictions and radii of colliders."""
        materials = list(self._base.materials)
        swapped = [(body, word) for body, word in work.tools.items() if (body, word) in self._tools]
        geoms = [(geom, "") for body, geom in self._geoms if (body, work.tools.get(body, "")) not in swapped]
        for key in swapped if self._own_geoms else ():
            geoms += [(geom, f"{key[1]}.") for _, geom in self._own_geoms[key]]
        for geom, before in geoms:
            place = round(float(geom.get("friction", "0").split()[0]))
            name = materials[place - 1] if place else ""
            if name and variant.materials[name] != self._base.materials[name]:
                friction = variant.materials[name].dynamic_friction
                yield f"geom {before}{geom.get('name')}", {"friction": None if friction is None else text(friction)}
        for wheel, factor in work.radii.items():
            own = [geom for body, geom in self._geoms if body == wheel and geom.get("type") in _ROUND]
            sizes = [[float(each) for each in str(geom.get("size")).split()] for geom in own]
            largest = max(size[0] for size in sizes)
            for geom, size in zip(own, sizes, strict=True):
                if size[0] >= _RIM * largest:
                    yield f"geom {geom.get('name')}", {"size": row((size[0] * factor, *size[1:]))}


def _elements(top: ET.Element) -> dict[str, dict[str, str]]:
    """The attributes of all elements that have a name, and of every body's inertia."""
    found = {}
    for element in top.iter():
        if element.get("name"):
            found[f"{element.tag} {element.get('name')}"] = dict(element.attrib)
        if element.tag == "body":
            for inertial in element.findall("inertial"):
                found[f"inertial {element.get('name')}"] = dict(inertial.attrib)
    return found


def _geoms(top: ET.Element) -> Iterator[tuple[str, ET.Element]]:
    for body in top.iter("body"):
        for geom in body.findall("geom"):
            if geom.get("class") == "collision":
                yield str(body.get("name")), geom


def shape_of(tool: Tool, body: str) -> BodyGeometry:
    """What a tool of another machine looks like and collides with, in the drawn body's frame."""
    assert tool.file is not None
    shift = np.eye(4)
    shift[:3, 3] = tool.shift
    own = read_geometry(tool.file).bodies[body]
    return replace(
        own,
        visuals=tuple(replace(each, matrix=shift @ each.matrix) for each in own.visuals),
        colliders=tuple(replace(each, matrix=shift @ each.matrix) for each in own.colliders),
    )


def _tool_file(base: Path, body: str, word: str) -> Path:
    return base / "tools" / f"{plain(body)}.{plain(word)}.xml"


def _tool_of(tree: ET.Element, body: str, word: str) -> ET.Element:
    """The geoms of one body and what they are made of, as a document. Names begin with the tool's; a mesh says which
    file its own is made `from`."""
    top = ET.Element("mujoco", model=word)
    asset = ET.SubElement(top, "asset")
    for made in tree.findall("asset/*"):
        made.set("name", f"{word}.{made.get('name')}")
        if made.tag == "mesh":
            made.set("from", str(made.get("file")))
            made.set("file", f"{plain(word)}.{made.get('file')}")
        asset.append(made)
    holder = ET.SubElement(ET.SubElement(top, "worldbody"), "body", name=body)
    for geom in next(each for each in tree.iter("body") if each.get("name") == body).findall("geom"):
        for name in ("name", "mesh", "material"):
            if geom.get(name):
                geom.set(name, f"{word}.{geom.get(name)}")
        holder.append(geom)
    return top


def swap(document: ET.Element, base: Path, tools: Mapping[str, str]) -> None:
    """Puts tools to the MJCF of the machine in the folder `base`, in place of the drawn ones."""
    assets = document.find("asset")
    for name, word in tools.items():
        tool = ET.parse(_tool_file(base, name, word)).getroot()
        body = next(each for each in document.iter("body") if each.get("name") == name)
        drawn = body.findall("geom")
        place = list(body).index(drawn[0]) if drawn else len(body)
        for geom in drawn:
            body.remove(geom)
        for number, geom in enumerate(tool.findall("worldbody/body/geom")):
            body.insert(place + number, geom)
        if assets is None:
            assets = ET.SubElement(document, "asset")
        assets.extend(tool.findall("asset/*"))


def apply(document: ET.Element, delta: Delta) -> None:
    """Puts what a variant's file has as `delta` to the base's MJCF, in place. `YellowironError` where it is of another
    machine."""
    places: dict[str, ET.Element] = {}
    for element in document.iter():
        if element.get("name"):
            places[f"{element.tag} {element.get('name')}"] = element
        if element.tag == "body":
            for inertial in element.findall("inertial"):
                places[f"inertial {element.get('name')}"] = inertial
    for key, attributes in delta.items():
        if key not in places:
            raise UnusableError(f"The base has no {key}", where=key, hint="The delta is of another machine.")
        for name, value in attributes.items():
            if value is None:
                places[key].attrib.pop(name, None)
            else:
                places[key].set(name, value)


def spec_of(file: str | Path) -> Any:
    """A variant that `vary` wrote with `to="mjcf"`, as MuJoCo's `MjSpec`: `.compile()` makes the model. `file` is its
    `.json`; the base stands where it was written."""
    import mujoco

    file = Path(file).resolve()
    base = file.parent.parent / "base"
    scenes = ("scene.xml", "lidar.xml")
    machine = next(path for path in sorted(base.glob("*.xml")) if path.name not in scenes)
    document = ET.parse(machine).getroot()
    said = json.loads(file.read_text(encoding="utf-8"))
    swap(document, base, said.get("tools", {}))
    apply(document, said["delta"])
    spec = mujoco.MjSpec.from_string(ET.tostring(document, encoding="unicode"))
    spec.meshdir = str(base / ASSETS)
    return spec
