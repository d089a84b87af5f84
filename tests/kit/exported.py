"""Exports read back by code that shares nothing with the exporters: where a tree's links are at joint positions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
from scipy.spatial.transform import Rotation


@dataclass(frozen=True, eq=False)
class ReadJoint:
    """A joint of a file: `place` (4, 4) of its frame in its parent's, at position 0."""

    name: str
    kind: str
    parent: str
    child: str
    place: np.ndarray
    axis: np.ndarray
    limits: tuple[float, float] | None


def frame(xyz: str = "0 0 0", rpy: str = "0 0 0") -> np.ndarray:
    made = np.eye(4)
    made[:3, :3] = Rotation.from_euler("xyz", [float(v) for v in rpy.split()]).as_matrix()
    made[:3, 3] = [float(v) for v in xyz.split()]
    return made


def read_urdf(path: Path) -> list[ReadJoint]:
    found = []
    for joint in ET.parse(path).getroot().findall("joint"):
        origin, axis, limit = joint.find("origin"), joint.find("axis"), joint.find("limit")
        bounds = limit is not None and limit.get("lower") is not None
        found.append(
            ReadJoint(
                joint.attrib["name"], joint.attrib["type"],
                joint.find("parent").attrib["link"], joint.find("child").attrib["link"],
                frame(**origin.attrib) if origin is not None else np.eye(4),
                np.array([float(v) for v in axis.attrib["xyz"].split()]) if axis is not None else np.array([1.0, 0, 0]),
                (float(limit.attrib["lower"]), float(limit.attrib["upper"])) if bounds else None,
            )
        )  # fmt: skip
    return found


def read_sdf(path: Path) -> tuple[list[ReadJoint], dict[str, np.ndarray]]:
    """Its joints, those that close loops too, and the links' poses in the model: a joint's place is in its child."""
    model = ET.parse(path).getroot().find("model")
    poses = {link.attrib["name"]: _pose(link) for link in model.findall("link")}
    found = []
    for joint in model.findall("joint"):
        axis = joint.findtext("axis/xyz", "1 0 0")
        low, high = joint.findtext("axis/limit/lower"), joint.findtext("axis/limit/upper")
        found.append(
            ReadJoint(
                joint.attrib["name"], joint.attrib["type"], joint.findtext("parent"), joint.findtext("child"),
                _pose(joint), np.array([float(v) for v in axis.split()]),
                (float(low), float(high)) if low is not None and high is not None else None,
            )
        )  # fmt: skip
    return found, poses


def _pose(element: ET.Element) -> np.ndarray:
    numbers = element.findtext("pose", "0 0 0 0 0 0").split()
    return frame(" ".join(numbers[:3]), " ".join(numbers[3:]))


def urdf_poses(joints: list[ReadJoint], positions: Mapping[str, float]) -> dict[str, np.ndarray]:
    """Every link's pose in the root link."""
    children = {joint.child for joint in joints}
    (root,) = {joint.parent for joint in joints} - children
    poses, waiting = {root: np.eye(4)}, list(joints)
    while waiting:
        ready = [joint for joint in waiting if joint.parent in poses]
        assert ready, "the joints are no tree"
        for joint in ready:
            moved = np.eye(4)
            if joint.kind == "prismatic":
                moved[:3, 3] = positions[joint.name] * joint.axis
            elif joint.kind != "fixed":
                moved[:3, :3] = Rotation.from_rotvec(positions[joint.name] * joint.axis).as_matrix()
            poses[joint.child] = poses[joint.parent] @ joint.place @ moved
        waiting = [joint for joint in waiting if joint.child not in poses]
    return poses


def off(moved: Mapping[str, np.ndarray], poses: Mapping[str, np.ndarray], drawn: Mapping[str, np.ndarray]) -> float:
    """By how much (metres, over three points a metre from the link's frame, and the frame) the links are off where the
    kinematics has `moved` their bodies (4, 4) from the drawn pose."""
    worst = 0.0
    points = np.column_stack([np.vstack([np.zeros(3), np.eye(3)]), np.ones(4)]).T
    for body, displaced in moved.items():
        if body in poses:
            worst = max(worst, float(np.abs((poses[body] - displaced @ drawn[body]) @ points).max()))
    return worst
