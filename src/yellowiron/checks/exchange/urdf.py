"""URDF → `View`. Loops that a file beside it tells of are read as cut pins: `joints.json`, as `export` writes it."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
from scipy.spatial.transform import Rotation

from yellowiron.checks.exchange.parts import JointRead, LinkRead, inertia_of, numbers, view_of
from yellowiron.checks.view import View
from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats

_KINDS = {
    "fixed": "fixed",
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
    "floating": "free",
    "planar": "planar",
    "spherical": "spherical",
}
_FAR = 1e3
"""Metres: a slide with such limits has none; the format wants a number."""
_TABLE = ("../scripts/joints.json", "joints.json")
"""Where the table of loops is, seen from the file."""


def read_urdf(path: Path, robot: ET.Element) -> View:
    """The links and joints of a `robot`. `YellowironError` where its joints are no tree, or a number is none."""
    elements = [joint for joint in robot.findall("joint") if joint.find("parent") is not None]
    poses = _poses(path, robot, elements)
    links = [_link(path, element, poses[element.get("name", "")]) for element in robot.findall("link")]
    driven = {j.get("name", "") for j in robot.findall("ros2_control/joint") if j.find("command_interface") is not None}
    driven |= {j.get("name", "") for j in robot.findall("transmission/joint")}
    joints = [_joint(path, element, poses, driven) for element in elements]
    return view_of(path.name, links, [*joints, *_cuts(path, poses)])


def _poses(path: Path, robot: ET.Element, joints: list[ET.Element]) -> dict[str, Floats]:
    """Every link's frame in that of the root, or of the first of several roots, all joints at zero."""
    names = [link.get("name", "") for link in robot.findall("link")]
    ends = {j.get("name", ""): (_end(j, "parent"), _end(j, "child")) for j in joints}
    for name, pair in ends.items():
        for end in pair:
            if end not in names:
                raise YellowironError(
                    f"The joint '{name}' names a link that is not there: '{end}'",
                    where=str(path),
                    hint="Correct the file, or write it again.",
                )
    children = {child for _, child in ends.values()}
    poses = {name: np.eye(4) for name in names if name not in children}
    waiting = list(joints)
    while waiting:
        ready = [j for j in waiting if _end(j, "parent") in poses]
        if not ready or len(children) < len(ends):
            raise YellowironError(
                "The joints are no tree", where=str(path), hint="A link has one parent; URDF has no loops."
            )
        for joint in ready:
            poses[_end(joint, "child")] = poses[_end(joint, "parent")] @ _origin(path, joint)
        waiting = [j for j in waiting if _end(j, "child") not in poses]
    return poses


def _end(joint: ET.Element, tag: str) -> str:
    element = joint.find(tag)
    return element.get("link", "") if element is not None else ""


def _origin(path: Path, element: ET.Element) -> Floats:
    """The frame (4, 4) of an `origin` element."""
    origin = element.find("origin")
    made = np.eye(4)
    if origin is not None:
        where = f"{path}: {element.get('name', element.tag)}"
        made[:3, :3] = Rotation.from_euler("xyz", numbers(origin.get("rpy"), 3, where=where)).as_matrix()
        made[:3, 3] = numbers(origin.get("xyz"), 3, where=where)
    return made


def _link(path: Path, element: ET.Element, pose: Floats) -> LinkRead:
    name = element.get("name", "")
    inertial = element.find("inertial")
    if inertial is None:
        return LinkRead(name, pose)
    where = f"{path}: {name}"
    mass, tensor = inertial.find("mass"), inertial.find("inertia")
    frame = pose @ _origin(path, inertial)
    value = None if mass is None else float(numbers(mass.get("value"), 1, where=where)[0])
    inertia = None if tensor is None else inertia_of(tensor.attrib, where=where)
    turned = None if inertia is None else frame[:3, :3] @ inertia @ frame[:3, :3].T
    return LinkRead(name, pose, value, frame[:3, 3], turned)


def _joint(path: Path, element: ET.Element, poses: dict[str, Floats], driven: set[str]) -> JointRead:
    name, kind = element.get("name", ""), element.get("type", "")
    where = f"{path}: {name}"
    if kind not in _KINDS:
        raise YellowironError(
            f"URDF has no joint of the type '{kind}'", where=where, hint=f"There are {', '.join(_KINDS)}."
        )
    parent, child = _end(element, "parent"), _end(element, "child")
    place = poses[child]
    axis, limit, mimic = element.find("axis"), element.find("limit"), element.find("mimic")
    along = numbers(axis.get("xyz") if axis is not None else None, 3, where=where, default=(1.0, 0.0, 0.0))
    lower = upper = None
    if limit is not None and kind in ("revolute", "prismatic"):
        lower, upper = (float(numbers(limit.get(end), 1, where=where)[0]) for end in ("lower", "upper"))
        if min(abs(lower), abs(upper)) >= _FAR:
            lower = upper = None
    effort = 0.0 if limit is None else float(numbers(limit.get("effort"), 1, where=where)[0])
    return JointRead(
        name, _KINDS[kind], parent, child, (place[:3, 3], place[:3, 3]),
        place[:3, :3] @ along if np.linalg.norm(along) else place[:3, 0], lower, upper,
        moved=name in driven if driven else effort > 0.0 and mimic is None,
        leader=None if mimic is None else mimic.get("joint", ""),
        ratio=1.0 if mimic is None else float(numbers(mimic.get("multiplier"), 1, where=where, default=(1.0,))[0]),
        offset=0.0 if mimic is None else float(numbers(mimic.get("offset"), 1, where=where)[0]),
    )  # fmt: skip


def _cuts(path: Path, poses: dict[str, Floats]) -> list[JointRead]:
    """The pins that a table of loops beside the file has, between links of the file."""
    table = next((file for name in _TABLE if (file := path.parent / name).is_file()), None)
    if table is None:
        return []
    try:
        document = json.loads(table.read_text(encoding="utf-8"))
        return [
            JointRead(
                cut["name"], cut["type"], cut["parent"], cut["child"],
                (_at(poses[cut["parent"]], cut["in_parent"]), _at(poses[cut["child"]], cut["in_child"])),
                np.array(cut["axis"], dtype=np.float64), cut=True,
            )
            for cut in document["cuts"] if cut["type"] != "distance"
        ]  # fmt: skip
    except (ValueError, KeyError, TypeError) as error:
        raise YellowironError(
            "The table of loops does not fit the file", where=str(table), hint="Export the machine again."
        ) from error


def _at(pose: Floats, point: list[float]) -> Floats:
    return np.asarray((pose @ np.append(np.array(point, dtype=np.float64), 1.0))[:3], dtype=np.float64)
