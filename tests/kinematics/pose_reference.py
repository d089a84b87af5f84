"""A page's way to pose a machine, in Python: coordinates from the tables, then the screws of the tree."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from yellowiron.model.mechanism import Mechanism
from yellowiron.model.poses import PoseTable, PoseTables


def weights(axis: np.ndarray, x: float) -> tuple[int, np.ndarray]:
    """First node and the four weights of cubic interpolation (Lagrange) on an evenly spaced axis."""
    t = (x - axis[0]) / (axis[1] - axis[0])
    first = int(min(max(np.floor(t) - 1, 0), len(axis) - 4))
    nodes = np.arange(first, first + 4)
    return first, np.array([np.prod([(t - n) / (m - n) for n in nodes if n != m]) for m in nodes])


def interpolated(table: PoseTable, given: dict[str, float]) -> np.ndarray:
    values = table.values
    for driver, axis in zip(table.drivers, table.axes, strict=True):
        first, weight = weights(axis, given.get(driver, 0.0))
        values = np.tensordot(weight, values[first : first + 4], axes=(0, 0))
    return values


def pose(mechanism: Mechanism, tables: PoseTables, given: dict[str, float]) -> dict[str, np.ndarray]:
    joints = {joint.name: joint for joint in mechanism.joints}
    at: dict[str, object] = dict(given)
    for table in tables.tables:
        row, column = interpolated(table, given), 0
        for name in table.dependent:
            width = 4 if joints[name].type == "spherical" else 1
            at[name] = row[column : column + width] if width == 4 else row[column]
            column += width
    placed = {mechanism.root: np.eye(4)}
    waiting = [joint for joint in mechanism.joints if not joint.cut]
    while waiting:
        for joint in [j for j in waiting if j.body0 in placed]:
            waiting.remove(joint)
            screw, q = np.eye(4), at.get(joint.name, 0.0)
            if joint.type == "prismatic":
                screw[:3, 3] = q * np.array(joint.axis)
            elif joint.type != "fixed":
                quaternion = q if joint.type == "spherical" else None
                screw[:3, :3] = (
                    Rotation.from_quat(np.array(quaternion) if np.ndim(q) else [1, 0, 0, 0], scalar_first=True)
                    if joint.type == "spherical"
                    else Rotation.from_rotvec(q * np.array(joint.axis))
                ).as_matrix()
                screw[:3, 3] = np.array(joint.anchor) - screw[:3, :3] @ np.array(joint.anchor)
            placed[joint.body1] = placed[joint.body0] @ screw
    return placed
