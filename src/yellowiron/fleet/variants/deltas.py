"""Variants as what differs from the base's MJCF: element → attribute → value, and such a variant put together again.

The base is exported once. A variant is exported without its meshes, which do not vary, and held against the base done
so too; colliders are told apart, by their materials and wheels.
"""

from __future__ import annotations

import json
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

from yellowiron.exporters import read_geometry
from yellowiron.exporters.geometry import BodyGeometry, Collider, Geometry
from yellowiron.exporters.mjcf.document import ASSETS, export_mjcf
from yellowiron.exporters.values import row, text
from yellowiron.fleet.documents import UnusableError
from yellowiron.fleet.variants.changes import Changed
from yellowiron.fleet.variants.sampling import Draw
from yellowiron.fleet.variants.tools import Tools
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
        with tempfile.TemporaryDirectory(prefix="yellowiron-") as folder:
            self._light = _elements(self._exported(mechanism, self._bare, Path(folder, "light")))
            marked = vary & {"friction", "tyre_radius"}
            tree = self._exported(mechanism, self._marked(), Path(folder, "marked")) if marked else None
        self._geoms = list(_geoms(tree)) if tree is not None else []
        if "tyre_radius" in vary:
            self._check_wheels(draws)

    def _exported(self, mechanism: Mechanism, geometry: Geometry, folder: Path) -> ET.Element:
        return ET.parse(export_mjcf(mechanism, geometry, folder)).getroot()

    def _marked(self) -> Geometry:
        """The geometry with the number of each collider's material for its friction, 1 for the first."""
        number = {name: float(place) for place, name in enumerate(self._base.materials, start=1)}

        def mark(collider: Collider) -> Collider:
            return replace(collider, friction=number.get(collider.material, 0.0))

        bodies = {
            name: replace(own, visuals=(), colliders=tuple(map(mark, own.colliders)))
            for name, own in self._geometry.bodies.items()
        }
        return replace(self._geometry, bodies=bodies)

    def _check_wheels(self, draws: Sequence[Draw]) -> None:
        for draw in draws:
            for name in draw.names if draw.parameter.vary == "tyre_radius" else ():
                if not any(body == name and geom.get("type") in _ROUND for body, geom in self._geoms):
                    raise UnusableError(
                        f"The tyre of '{name}' is no round collider in MJCF", where=draw.parameter.where,
                        hint="Leave it out, or write USD layers.",
                    )  # fmt: skip

    def write_base(self, folder: Path) -> None:
        """The machine in MJCF."""
        export_mjcf(self._base, self._geometry, folder)

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
        stem.with_suffix(SUFFIX).write_text(to_json({**record, "delta": delta}), encoding="utf-8")

    def _touching(self, work: Changed, variant: Mechanism) -> Iterator[tuple[str, dict[str, str | None]]]:
        """Frictions and radii of colliders."""
        materials = list(self._base.materials)
        for _, geom in self._geoms:
            place = round(float(geom.get("friction", "0").split()[0]))
            name = materials[place - 1] if place else ""
            if name and variant.materials[name] != self._base.materials[name]:
                friction = variant.materials[name].dynamic_friction
                yield f"geom {geom.get('name')}", {"friction": None if friction is None else text(friction)}
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
    apply(document, json.loads(file.read_text(encoding="utf-8"))["delta"])
    spec = mujoco.MjSpec.from_string(ET.tostring(document, encoding="unicode"))
    spec.meshdir = str(base / ASSETS)
    return spec
