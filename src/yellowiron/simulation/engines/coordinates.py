"""Joint coordinates from body poses, for engines whose own are in other units, signs or orders."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism


class Coordinates:
    """Follows the named joints: slides in metres, pivots in radians without a jump at a full turn, 0 as drawn.

    Between two instants a pivot must turn by less than half a turn.
    """

    def __init__(self, mechanism: Mechanism, names: Sequence[str]) -> None:
        joints = [mechanism.joint(name) for name in names]
        number = {body.name: index for index, body in enumerate(mechanism.bodies)}
        self._first = np.array([number[j.body0] for j in joints], dtype=int)
        self._second = np.array([number[j.body1] for j in joints], dtype=int)
        self._slides = np.array([j.type == "prismatic" for j in joints], dtype=bool)
        self._axes = np.array([j.axis for j in joints], dtype=np.float64).reshape(-1, 3)
        anchors = np.array([j.anchor for j in joints], dtype=np.float64).reshape(-1, 3)
        drawn = np.array([body.origin for body in mechanism.bodies], dtype=np.float64)
        self._arms = (anchors - drawn[self._first], anchors - drawn[self._second])
        helper = np.eye(3)[np.abs(self._axes).argmin(axis=1)] if joints else np.zeros((0, 3))
        across = np.cross(self._axes, helper)
        self._across = across / np.linalg.norm(across, axis=1, keepdims=True)
        self._third = np.cross(self._axes, self._across)
        self._last, self._turns = np.zeros(len(joints)), np.zeros(len(joints))  # angle within a turn, whole turns

    def read(self, rotations: Floats, origins: Floats) -> Floats:
        """Coordinates (n, joints) at rotations (n, bodies, 3, 3) and origins (n, bodies, 3), world frame, in the order
        in which they came."""
        first, second = rotations[:, self._first], rotations[:, self._second]
        ends = [
            origins[:, bodies] + np.einsum("tnij,nj->tni", turned, arms)
            for bodies, turned, arms in zip((self._first, self._second), (first, second), self._arms, strict=True)
        ]
        axes = np.einsum("tnij,nj->tni", first, self._axes)
        slid = np.einsum("tni,tni->tn", ends[1] - ends[0], axes)
        across = np.einsum("tnij,nj->tni", second, self._across)
        angle = np.arctan2(
            np.einsum("tni,tni->tn", across, np.einsum("tnij,nj->tni", first, self._third)),
            np.einsum("tni,tni->tn", across, np.einsum("tnij,nj->tni", first, self._across)),
        )
        steps = np.diff(angle, axis=0, prepend=self._last[None])
        self._turns = self._turns - np.cumsum(np.round(steps / (2.0 * np.pi)), axis=0)
        made = np.where(self._slides, slid, angle + 2.0 * np.pi * self._turns)
        self._last, self._turns = angle[-1], self._turns[-1]
        return made


def rotation_matrices(quaternions: Floats) -> Floats:
    """Rotations (..., 3, 3) of quaternions (..., 4) as x, y, z, w; they need not be of unit length."""
    x, y, z, w = np.moveaxis(quaternions / np.linalg.norm(quaternions, axis=-1, keepdims=True), -1, 0)
    rows = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
        [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
        [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))
