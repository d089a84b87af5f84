"""SDFormat → `View`: a model of Gazebo's, or of Drake's with its ball constraints and mimics."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
from scipy.spatial.transform import Rotation

from yellowiron.checks.exchange.parts import JointRead, LinkRead, inertia_of, numbers, view_of
from yellowiron.checks.view import View
from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.support.vectors import unit

_KINDS = {
    "fixed": "fixed",
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
    "ball": "spherical",
}
_FAR = 1e16
"""SDFormat's "no limit"."""
_DRAKE = "{http://drake.mit.edu}"
_CONTROLLERS = ("JointPositionController", "JointController")
_WORLD = ("world", "__model__")


def read_sdf(path: Path, top: ET.Element) -> View:
    """The links and joints of the one model of an `sdf` element. `YellowironError` where there is none or several, a
    model is nested or included, or a frame is not there."""
    models = [*top.findall("model"), *top.findall("world/model")]
    if len(models) != 1 or models[0].find("model") is not None or models[0].find("include") is not None:
        raise YellowironError(
            "The file is not one model without others in it", where=str(path), hint="Give the model's own file."
        )
    model = _Model(path, models[0])
    links = [model.link(element) for element in models[0].findall("link")]
    joints = [model.joint(element) for element in models[0].findall("joint")]
    return view_of(path.name, links, [*_cut(joints), *model.welds(), *model.balls()])


class _Model:
    """A model's elements and where its frames are."""

    def __init__(self, path: Path, element: ET.Element) -> None:
        self._path = path
        self._element = element
        self._frames = {e.get("name", ""): e for tag in ("frame", "joint", "link") for e in element.findall(tag)}
        self._placed: dict[str, Floats] = {name: np.eye(4) for name in _WORLD}
        plugins = {kind: self._plugins(kind) for kind in (*_CONTROLLERS, "DetachableJoint")}
        self._driven = {p.findtext("joint_name", "") for kind in _CONTROLLERS for p in plugins[kind]}
        self._welds = plugins["DetachableJoint"]

    def _plugins(self, kind: str) -> list[ET.Element]:
        return [p for p in self._element.findall("plugin") if kind in p.get("name", "")]

    def place(self, name: str, open_: frozenset[str] = frozenset()) -> Floats:
        """A frame, link or joint in the model (4, 4)."""
        if name in self._placed:
            return self._placed[name]
        element = self._frames.get(name)
        if element is None or name in open_:
            words = f"There is no frame '{name}'" if element is None else f"The frame '{name}' stands on itself"
            raise YellowironError(words, where=str(self._path), hint="Correct the file, or write it again.")
        pose = element.find("pose")
        on = {"joint": element.findtext("child", "").strip(), "frame": element.get("attached_to", "")}
        relative = (pose.get("relative_to") if pose is not None else None) or on.get(element.tag) or "__model__"
        made = self.place(relative, open_ | {name}) @ self._pose(element)
        self._placed[name] = made
        return made

    def _pose(self, element: ET.Element) -> Floats:
        made = np.eye(4)
        pose = element.find("pose")
        if pose is None:
            return made
        where = f"{self._path}: {element.get('name', element.tag)}"
        if pose.get("rotation_format") == "quat_xyzw":
            values = numbers(pose.text, 7, where=where, default=(0, 0, 0, 0, 0, 0, 1))
            made[:3, :3] = Rotation.from_quat(values[3:]).as_matrix()
        else:
            values = numbers(pose.text, 6, where=where)
            turns = np.radians(values[3:]) if pose.get("degrees") in ("true", "1") else values[3:]
            made[:3, :3] = Rotation.from_euler("xyz", turns).as_matrix()
        made[:3, 3] = values[:3]
        return made

    def link(self, element: ET.Element) -> LinkRead:
        name = element.get("name", "")
        pose = self.place(name)
        inertial = element.find("inertial")
        if inertial is None:
            # Unlike URDF's, a link that says nothing weighs a kilogram.
            return LinkRead(name, pose, 1.0, pose[:3, 3], np.eye(3))
        where = f"{self._path}: {name}"
        frame = pose @ self._pose(inertial)
        mass = float(numbers(inertial.findtext("mass"), 1, where=where, default=(1.0,))[0])
        section = inertial.find("inertia")
        entries = {e.tag: e.text or "" for e in section} if section is not None else {}
        inertia = inertia_of(entries, where=where) if entries else np.eye(3)
        return LinkRead(name, pose, mass, frame[:3, 3], frame[:3, :3] @ inertia @ frame[:3, :3].T)

    def joint(self, element: ET.Element) -> JointRead:
        name, kind = element.get("name", ""), element.get("type", "")
        where = f"{self._path}: {name}"
        parent, child = (self._carrier(element.findtext(tag, "").strip()) for tag in ("parent", "child"))
        place = self.place(name)
        axis = element.find("axis")
        along, lower, upper, effort = place[:3, 0], None, None, math.inf
        leader, ratio, offset = None, 1.0, 0.0
        if axis is not None:
            xyz = axis.find("xyz")
            base = place if xyz is None or not xyz.get("expressed_in") else self.place(xyz.get("expressed_in", ""))
            text = None if xyz is None else xyz.text
            along = base[:3, :3] @ unit(numbers(text, 3, where=where, default=(0.0, 0.0, 1.0)))
            ends = [axis.findtext(f"limit/{end}") for end in ("lower", "upper")]
            values = [None if t is None else float(numbers(t, 1, where=where)[0]) for t in ends]
            if kind != "continuous":
                lower, upper = (None if v is None or abs(v) >= _FAR else v for v in values)
            effort = float(numbers(axis.findtext("limit/effort"), 1, where=where, default=(math.inf,))[0])
            mimic = axis.find("mimic")
            if mimic is not None:
                leader = mimic.get("joint", "")
                ratio = float(numbers(mimic.findtext("multiplier"), 1, where=where)[0])
                offset = float(numbers(mimic.findtext("offset"), 1, where=where)[0])
        mimic = element.find(f"{_DRAKE}mimic")
        if mimic is not None:
            leader = mimic.get("joint", "")
            ratio = float(numbers(mimic.get("multiplier"), 1, where=where, default=(1.0,))[0])
            offset = float(numbers(mimic.get("offset"), 1, where=where)[0])
        moved = name in self._driven if self._driven else effort != 0.0 and leader is None
        return JointRead(
            name, _KINDS.get(kind, "free"), parent, child, (place[:3, 3], place[:3, 3]), along, lower, upper,
            moved=moved, leader=leader, ratio=ratio, offset=offset,
        )  # fmt: skip

    def _carrier(self, name: str) -> str:
        """The link that a name stands for, "" the world."""
        seen: set[str] = set()
        while (element := self._frames.get(name)) is not None and element.tag != "link" and name not in seen:
            seen.add(name)
            name = element.findtext("child", "").strip() if element.tag == "joint" else element.get("attached_to", "")
        if name not in self._frames and name not in _WORLD:
            raise YellowironError(f"There is no link '{name}'", where=str(self._path), hint="Correct the file.")
        return "" if name == "world" else name

    def welds(self) -> list[JointRead]:
        """What Gazebo's detachable joints hold together while the model runs."""
        found = []
        for number, plugin in enumerate(self._welds, 1):
            parent, child = plugin.findtext("parent_link", "").strip(), plugin.findtext("child_link", "").strip()
            if parent in self._frames and child in self._frames:
                at = self.place(child)[:3, 3]
                found.append(JointRead(f"weld {number}", "fixed", parent, child, (at, at), np.eye(3)[0], cut=True))
        return found

    def balls(self) -> list[JointRead]:
        """Drake's ball constraints, each a cut pin; those of a pair of bodies at several points hold them whole."""
        found: dict[tuple[str, str], list[tuple[Floats, Floats]]] = {}
        for held in self._element.findall(f"{_DRAKE}ball_constraint"):
            ends = [held.findtext(f"{_DRAKE}ball_constraint_body_{side}", "").strip() for side in "AB"]
            words = [held.findtext(f"{_DRAKE}ball_constraint_p_{side}") for side in ("AP", "BQ")]
            where = f"{self._path}: ball constraint of {ends[0]}"
            points = [np.append(numbers(text, 3, where=where), 1.0) for text in words]
            placed = [(self.place(end) @ point)[:3] for end, point in zip(ends, points, strict=True)]
            found.setdefault((ends[0], ends[1]), []).append((placed[0], placed[1]))
        made = []
        for (parent, child), points_of in found.items():
            kind = "fixed" if len(points_of) > 2 else "spherical"
            for pair in points_of[:1] if kind == "fixed" else points_of:
                name = f"ball constraint of {parent} and {child}"
                made.append(JointRead(name, kind, parent, child, pair, np.eye(3)[0], cut=True))
        return made


def _cut(joints: list[JointRead]) -> list[JointRead]:
    """The joints, those of a link that has a parent already as cuts: the first closes no loop."""
    held: set[str] = set()
    made = []
    for joint in joints:
        made.append(replace(joint, cut=True) if joint.child in held else joint)
        held.add(joint.child)
    return made
