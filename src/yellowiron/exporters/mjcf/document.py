"""MJCF: the machine's tree, a `connect` for every cut, a coupling where a joint follows, masses, convex colliders."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Literal
from xml.etree import ElementTree as ET

import numpy as np

from yellowiron.exporters.assets import Assets, plain, unique
from yellowiron.exporters.geometry import BodyGeometry, Collider, Geometry, read_geometry
from yellowiron.exporters.mjcf import actuators, ropes, sensors
from yellowiron.exporters.mjcf.hardness import SOLIMP
from yellowiron.exporters.mjcf.ropes import winch_of
from yellowiron.exporters.ropes import Rope, with_ropes
from yellowiron.exporters.shapes import ConvexPieces, placed
from yellowiron.exporters.tendons import Tendon, with_tendons
from yellowiron.exporters.values import axes_of, minus, quaternion, row, srgb, text
from yellowiron.model.errors import MechanismError
from yellowiron.model.geometry import Color, Floats
from yellowiron.model.mechanism import Body, Joint, Mechanism, chained, rolling, scrubbing
from yellowiron.support.record import CONE, IMPRATIO, SCRUBS, integrator_of

TIMESTEP = 0.001
"""Seconds. Pins of a loaded wheel loader stay within 0.02 mm at this step, 0.3 mm at 4 ms and 1.8 mm at 10 ms."""
ASSETS = "assets"
GROUND_FRICTION = 0.7
_BARE = "0.8 0.65 0.2 1"
"""Of colliders that are all there is to see."""

_JOINTS = {"revolute": "hinge", "prismatic": "slide", "spherical": "ball"}
_FAR = 1e6
PAD_BIT = "8"
"""Of `conaffinity`: nothing has it in its `contype`."""
_THIN = 0.02
"""Metres: how thick a tendon is shown whose rod is not known."""
_POSITIONS = {"revolute": 1, "prismatic": 1, "spherical": 4, "fixed": 0}


def export_mjcf(
    mechanism: Mechanism,
    geometry: Geometry | str | Path,
    folder: Path,
    *,
    base: Literal["floating", "fixed"] = "floating",
    timestep: float = TIMESTEP,
    cylinders: Literal["bodies", "tendons"] = "bodies",
) -> Path:
    """Writes `<machine>.xml`, `scene.xml` (the machine on a ground plane, with light) and `assets/` into a folder,
    and `lidar.xml` where there is one; returns the machine's file.

    `geometry` is the machine's USD file, or what `read_geometry` made of one. Positions are metres in the drawn pose,
    where all coordinates and controls are 0; controls are an actuator's coordinate: metres of its driven slide, rad/s
    of a motor. The machine does not collide with itself: give `conaffinity="1"` to its `collision` class to change
    that; bodies that are jointed or overlap as drawn are excluded all the same. Of a geometry in light
    detail the colliders are what is seen, too. With `cylinders` as tendons their halves are no bodies (`with_tendons`),
    and hooks hang on ropes that pull and do not push (`with_ropes`); controls are what they are without.

    Raises `MechanismError` where the joints are no tree with cuts.
    """
    shapes = read_geometry(geometry)
    tendons: tuple[Tendon, ...] = ()
    hung: tuple[Rope, ...] = ()
    if cylinders == "tendons":
        mechanism, hung = with_ropes(mechanism)
        mechanism, tendons = with_tendons(mechanism)
        left = {body.name for body in mechanism.bodies}
        shapes = replace(shapes, filtered=tuple(pair for pair in shapes.filtered if left.issuperset(pair)))
    folder.mkdir(parents=True, exist_ok=True)
    name = unique(plain(mechanism.name), {"scene", "lidar"})
    document = _Document(mechanism, shapes, Assets(folder / ASSETS), base, timestep, tendons, hung)
    _write(document.element(name), folder / f"{name}.xml")
    _write(_scene(mechanism, f"{name}.xml"), folder / "scene.xml")
    beams = sensors.section(mechanism, lidars=True)
    if len(beams):
        top = ET.Element("mujoco", model="lidar")
        top.append(beams)
        _write(top, folder / "lidar.xml")
    return folder / f"{name}.xml"


def export_tendons(mechanism: Mechanism, geometry: Geometry | str | Path, folder: Path) -> Path:
    """`export_mjcf` with cylinders and ropes as tendons."""
    return export_mjcf(mechanism, geometry, folder, cylinders="tendons")


def tendons_unsaid(mechanism: Mechanism) -> tuple[str, ...]:
    """What MJCF with tendons says in another way."""
    roped, hung = with_ropes(mechanism)
    reduced, tendons = with_tendons(roped)
    gone = len(roped.bodies) - len(reduced.bodies)
    stays = [c.name for c in mechanism.cylinders if c.barrel in {b.name for b in reduced.bodies}]
    words = [
        f"{gone} halves of cylinders are no bodies: their mass is on their pins, and they touch nothing.",
        f"{len(tendons)} tendons have the names of the cylinders' slides; their length is the pins' distance, controls "
        "are strokes from the drawn pose as ever.",
    ]
    if stays:
        words.append(f"Cylinders that stay bodies: {', '.join(stays)}.")
    words += [
        f"'{rope.name}' is a tendon of {rope.falls} falls between '{rope.ends[0][0]}' and '{rope.ends[1][0]}', which "
        f"is free but for it; '{winch_of(rope)}' is the winch, as light as its drive lets it be."
        for rope in hung
    ]
    return tuple(words)


class _Document:
    """One machine's document under construction."""

    def __init__(
        self,
        mechanism: Mechanism,
        geometry: Geometry,
        assets: Assets,
        base: str,
        timestep: float,
        tendons: tuple[Tendon, ...],
        hung: tuple[Rope, ...],
    ) -> None:
        self._mechanism = mechanism
        self._tendons = tendons
        self._ropes = hung
        self._commanded = replace(mechanism, joints=(*mechanism.joints, *(rope.slide for rope in hung)))
        self._geometry = geometry
        self._assets = assets
        self._base = base
        self._timestep = timestep
        self._colors: dict[Color, str] = {}
        self._geoms: set[str] = set()
        self._pieces = ConvexPieces()
        self._drawn_apart = geometry.detail != "light"
        self._order: list[Joint] = []
        self._drawn: list[float] = []
        rings = replace(mechanism, floating=mechanism.floating[: len(mechanism.floating) - len(hung)])
        self._chained = chained(rings)
        self._rolling = rolling(mechanism) if rings.floating else frozenset()
        self._scrubbing = scrubbing(mechanism)
        self._children: dict[str, list[Joint]] = {}
        for joint in mechanism.joints:
            if not joint.cut:
                self._children.setdefault(joint.body0, []).append(joint)

    def element(self, name: str) -> ET.Element:
        world = ET.Element("worldbody")
        root = self._mechanism.body(self._mechanism.root)
        self._body(world, root, None, free=self._base == "floating")
        for head in self._mechanism.floating:
            self._body(world, self._mechanism.body(head), None, free=True)
        self._check_tree()
        top = ET.Element("mujoco", model=name)
        ET.SubElement(top, "compiler", angle="radian", meshdir=ASSETS, autolimits="true")
        settings = {"integrator": integrator_of(self._mechanism), "cone": CONE, "impratio": text(IMPRATIO)}
        ET.SubElement(top, "option", {"timestep": text(self._timestep), **settings})
        top.append(self._defaults())
        top.append(self._asset())
        top.append(world)
        held = (self._contact(), self._equality(), self._tendon(), actuators.section(self._commanded, self._tendons))
        own = (
            actuators.brakes(self._mechanism),
            sensors.section(self._commanded, self._tendons),
            self._keyframe(),
        )
        for section in (*held, *own):
            if len(section):
                top.append(section)
        return top

    def _check_tree(self) -> None:
        reached = {self._mechanism.root, *self._mechanism.floating, *(joint.body1 for joint in self._order)}
        for body in self._mechanism.bodies:
            if body.name not in reached:
                raise MechanismError(
                    "no joint leads to the body from the root", where=body.name, hint="Join it to another body."
                )

    def _defaults(self) -> ET.Element:
        top = ET.Element("default")
        inner = ET.SubElement(top, "default", {"class": "machine"})
        ET.SubElement(inner, "mesh", inertia="shell")
        ET.SubElement(inner, "equality", solref=row((2.0 * self._timestep, 1.0)), solimp=row(SOLIMP))
        visual = ET.SubElement(inner, "default", {"class": "visual"})
        ET.SubElement(visual, "geom", type="mesh", contype="0", conaffinity="0", group="2", mass="0")
        collision = ET.SubElement(inner, "default", {"class": "collision"})
        touched = ET.SubElement(collision, "geom", contype="1", conaffinity="0", group="3", mass="0")
        pad = ET.SubElement(inner, "default", {"class": "pad"}) if any(b.pads for b in self._mechanism.bodies) else None
        if pad is not None:
            # They touch nothing, until who sets the brakes gives them contype 1. A bit of their own: MuJoCo leaves what
            # has none out of its search for contacts when it compiles.
            ET.SubElement(pad, "geom", type="box", contype="0", conaffinity=PAD_BIT, group="4", mass="0")
        if not self._drawn_apart:
            touched.set("group", "2")
            touched.set("rgba", _BARE)
        return top

    def _asset(self) -> ET.Element:
        asset = ET.Element("asset")
        for color, name in self._colors.items():
            ET.SubElement(asset, "material", name=name, rgba=row((*map(srgb, color), 1.0)))
        for name, file in self._assets.files.items():
            ET.SubElement(asset, "mesh", {"class": "machine", "name": name, "file": file})
        return asset

    # ---- bodies -----------------------------------------------------------------------------------------------------
    def _body(self, parent: ET.Element, body: Body, joint: Joint | None, *, free: bool = False) -> None:
        around = self._mechanism.body(joint.body0).origin if joint is not None else (0.0, 0.0, 0.0)
        element = ET.SubElement(parent, "body", name=body.name, pos=row(minus(body.origin, around)))
        if joint is None:
            element.set("childclass", "machine")
            if free:
                ET.SubElement(element, "freejoint", name=f"{body.name}.free")
                self._drawn += [*body.origin, 1.0, 0.0, 0.0, 0.0]
        elif any(known.body1 == body.name for known in self._order) or body.name == self._mechanism.root:
            raise MechanismError(
                f"two tree joints lead to the body '{body.name}'",
                where=joint.name,
                hint="Build the machine again, or correct its template.",
            )
        else:
            self._order.append(joint)
            self._drawn += [1.0, 0.0, 0.0, 0.0] if joint.type == "spherical" else [0.0] * _POSITIONS.get(joint.type, 0)
            self._joint(element, body, joint)
        inertia = 0.5 * (np.asarray(body.inertia) + np.asarray(body.inertia).T)
        ET.SubElement(
            element,
            "inertial",
            pos=row(minus(body.center_of_mass, body.origin)),
            mass=text(body.mass),
            fullinertia=row([inertia[i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]),
        )
        self._geometry_of(element, body.name, self._geometry.bodies.get(body.name, BodyGeometry()))
        for pad in body.pads:
            friction = self._mechanism.materials[pad.material].dynamic_friction if pad.material else None
            rubs = {} if friction is None else {"friction": text(friction)}
            size = row([0.5 * edge for edge in pad.size or ()])
            at = np.array(minus(pad.center, body.origin))
            self._geom(element, "pad", f"{pad.name}.pad", at, quaternion(np.eye(3)), size=size, **rubs)
        for site in self._mechanism.sites:
            if site.body == body.name:
                rotation = quaternion(axes_of(site))
                ET.SubElement(
                    element, "site", name=site.name, pos=row(minus(site.position, body.origin)), quat=row(rotation)
                )
        element.extend(sensors.on_body(self._mechanism, body))
        for cut in self._mechanism.joints:
            if cut.cut and cut.type == "distance" and body.name in (cut.body0, cut.body1):
                number = int(body.name == cut.body1)
                ET.SubElement(element, "site", name=f"{cut.name}.{number}", pos=row(minus(cut.anchor, body.origin)))
        for tendon in self._tendons:
            for number, (held, point) in enumerate(tendon.ends):
                if held == body.name:
                    place = row(minus(point, body.origin))
                    ET.SubElement(element, "site", name=f"{tendon.slide.name}.{number}", pos=place, group="4")
        ropes.put(element, body, self._ropes)
        for following in self._children.get(body.name, ()):
            self._body(element, self._mechanism.body(following.body1), following)

    def _joint(self, element: ET.Element, body: Body, joint: Joint) -> None:
        if joint.type == "distance":
            raise MechanismError(
                "a distance joint cannot hold a body in the tree", where=joint.name, hint="Mark it as a cut."
            )
        if joint.type == "fixed":
            return
        made = ET.SubElement(element, "joint", name=joint.name, type=_JOINTS[joint.type])
        made.set("pos", row(minus(joint.anchor, body.origin)))
        if joint.type == "spherical":
            if joint.upper is not None:
                made.set("range", row((0.0, joint.upper)))
            return
        made.set("axis", row(joint.axis))
        if joint.lower is not None and joint.upper is not None:
            made.set("range", row((joint.lower, joint.upper)))
        for name, value in (actuators.limits(joint.drive) if joint.drive is not None else {}).items():
            made.set(name, value)
        for name, value in (actuators.spring(joint.spring, self._base) if joint.spring is not None else {}).items():
            made.set(name, value)

    def _geometry_of(self, element: ET.Element, body: str, shapes: BodyGeometry) -> None:
        for visual in shapes.visuals if self._drawn_apart else ():
            mesh, position, rotation = placed(visual.mesh, visual.matrix)
            material = self._color(visual.color)
            for asset in self._assets.add(visual.name, mesh):
                self._geom(
                    element, "visual", f"{body}.{visual.name}", position, rotation, mesh=asset, material=material
                )
        for collider in shapes.colliders:
            self._collider(element, body, collider)

    def _collider(self, element: ET.Element, body: str, collider: Collider) -> None:
        name = f"{body}.{collider.name}.collision"
        friction = {} if collider.friction is None else {"friction": text(collider.friction)}
        scrubs = body in self._scrubbing
        friction |= {"priority": "1"} if collider.rules or scrubs else {}
        friction |= {name: row(values) for name, values in SCRUBS.items()} if scrubs else {}
        # A ring's parts touch the wheels that it runs on, the ground, and nothing else of the machine.
        friction |= {"conaffinity": "2"} if body in self._chained else {}
        friction |= {"contype": "3"} if body in self._rolling else {}
        if collider.mesh is None:
            radius, *rest = collider.size
            size = {
                "cylinder": (radius, *(0.5 * v for v in rest)),
                "capsule": (radius, *(0.5 * v for v in rest)),
                "box": tuple(0.5 * v for v in collider.size),
                "sphere": (radius,),
            }[collider.kind]
            rotation = quaternion(collider.matrix[:3, :3])
            position = collider.matrix[:3, 3]
            self._geom(element, "collision", name, position, rotation, type=collider.kind, size=row(size), **friction)
            return
        mesh, position, rotation = placed(collider.mesh, collider.matrix)
        for piece in self._pieces.of(mesh, collider.approximation):
            for asset in self._assets.add(f"{collider.name}.hull", piece):
                self._geom(element, "collision", name, position, rotation, type="mesh", mesh=asset, **friction)

    def _geom(
        self, element: ET.Element, group: str, name: str, position: Floats, rotation: Floats, **more: str
    ) -> None:
        values = {"class": group, "name": unique(name, self._geoms)}
        if np.abs(position).max() > 0.0:
            values["pos"] = row(position)
        if rotation[0] < 1.0:
            values["quat"] = row(rotation)
        ET.SubElement(element, "geom", {**values, **more})

    def _color(self, color: Color) -> str:
        return self._colors.setdefault(color, f"color_{len(self._colors) + 1}")

    # ---- what holds and moves it ------------------------------------------------------------------------------------
    def _contact(self) -> ET.Element:
        section = ET.Element("contact")
        order = {body.name: number for number, body in enumerate(self._mechanism.bodies)}
        jointed = [(joint.body0, joint.body1) for joint in self._mechanism.joints]
        pairs = {tuple(sorted(p, key=order.__getitem__)) for p in (*jointed, *self._geometry.filtered)}
        for one, other in sorted(pairs, key=lambda p: (order[p[0]], order[p[1]])):
            ET.SubElement(section, "exclude", body1=one, body2=other)
        return section

    def _equality(self) -> ET.Element:
        section = ET.Element("equality")
        for joint in self._mechanism.joints:
            if joint.cut and joint.type == "prismatic":
                raise MechanismError(
                    "a slide is cut, and cylinders must stay in the tree", where=joint.name, hint="Cut a pivot."
                )
            if joint.cut and joint.type != "distance":
                kind = "weld" if joint.type == "fixed" else "connect"
                anchor = minus(
                    joint.anchor, self._mechanism.body(joint.body0 if kind == "connect" else joint.body1).origin
                )
                ends = {"class": "machine", "name": joint.name, "body1": joint.body0, "body2": joint.body1}
                ET.SubElement(section, kind, {**ends, "anchor": row(anchor)})
            if joint.follows is not None:
                led = {"class": "machine", "name": joint.name, "joint1": joint.name, "joint2": joint.follows.joint}
                polynomial = row((joint.follows.offset, joint.follows.ratio, 0.0, 0.0, 0.0))
                ET.SubElement(section, "joint", {**led, "polycoef": polynomial})
        return section

    def _tendon(self) -> ET.Element:
        """A distance joint is a straight tendon between its two points, with its least and greatest length; so is a
        cylinder without bodies, whose ends of stroke and drive's own mass it has."""
        section = ET.Element("tendon")
        for tendon in self._tendons:
            slide = tendon.slide
            values = {"name": slide.name, "width": text(0.5 * tendon.cylinder.rod_diameter or _THIN)}
            if slide.lower is not None and slide.upper is not None:
                values["range"] = row((tendon.length + slide.lower, tendon.length + slide.upper))
            if slide.drive is not None:
                values |= actuators.limits(slide.drive)
            spatial = ET.SubElement(section, "spatial", {**values, "rgba": _BARE})
            for number in (0, 1):
                ET.SubElement(spatial, "site", site=f"{slide.name}.{number}")
        ropes.tendons(section, self._ropes)
        for joint in self._mechanism.joints:
            if joint.cut and joint.type == "distance":
                ends = (joint.lower or 0.0, joint.upper if joint.upper is not None else _FAR)
                spatial = ET.SubElement(section, "spatial", name=joint.name, range=row(ends))
                for number in (0, 1):
                    ET.SubElement(spatial, "site", site=f"{joint.name}.{number}")
        return section

    def _keyframe(self) -> ET.Element:
        section = ET.Element("keyframe")
        if self._drawn:
            ET.SubElement(section, "key", name="drawn", qpos=row(self._drawn))
        return section


def _scene(mechanism: Mechanism, machine_file: str) -> ET.Element:
    """The machine on a ground plane, with light and sky."""
    top = ET.Element("mujoco", model="scene")
    ET.SubElement(top, "include", file=machine_file)
    points = [body.hull for body in mechanism.bodies if len(body.hull)]
    size = float(np.ptp(np.concatenate(points), axis=0).max()) if points else 10.0
    ET.SubElement(top, "statistic", center=row((0.0, 0.0, 0.2 * size)), extent=text(round(size, 3)))
    visual = ET.SubElement(top, "visual")
    ET.SubElement(visual, "headlight", diffuse="0.5 0.5 0.5", ambient="0.35 0.35 0.35", specular="0.1 0.1 0.1")
    ET.SubElement(visual, "global", azimuth="140", elevation="-20")
    asset = ET.SubElement(top, "asset")
    sky = {"type": "skybox", "builtin": "gradient", "rgb1": "0.62 0.74 0.86", "rgb2": "0.95 0.96 0.97"}
    ET.SubElement(asset, "texture", {**sky, "width": "256", "height": "1536"})
    soil = {"name": "soil", "type": "2d", "builtin": "checker", "rgb1": "0.55 0.51 0.44", "rgb2": "0.5 0.46 0.4"}
    ET.SubElement(asset, "texture", {**soil, "width": "256", "height": "256"})
    ET.SubElement(asset, "material", name="soil", texture="soil", texrepeat="1 1", texuniform="true")
    world = ET.SubElement(top, "worldbody")
    ET.SubElement(world, "light", pos="0 0 20", dir="0.3 0.4 -1", directional="true", diffuse="0.6 0.6 0.6")
    ground = {"name": "ground", "type": "plane", "size": "0 0 1", "material": "soil"}
    ET.SubElement(world, "geom", {**ground, "friction": text(GROUND_FRICTION)})
    return top


def _write(element: ET.Element, path: Path) -> None:
    ET.indent(element)
    path.write_bytes(ET.tostring(element, encoding="utf-8") + b"\n")
