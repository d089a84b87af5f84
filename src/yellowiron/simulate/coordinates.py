"""Joint coordinates from body poses, for engines whose own are in other units, signs or orders."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism


class Coordinates:
    """Follows the named joints: slides in metres, pivots in radians without a jump at a full turn, 0 as drawn.

    Between two calls a pivot must turn by less than half a turn.
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
        self._last = np.zeros(len(joints))

    def read(self, rotations: Floats, origins: Floats) -> Floats:
        """Coordinates (joints,) at rotations (bodies, 3, 3) and origins (bodies, 3), world frame."""
        first, second = rotations[self._first], rotations[self._second]
        ends = [
            origins[bodies] + np.einsum("nij,nj->ni", turned, arms)
            for bodies, turned, arms in zip((self._first, self._second), (first, second), self._arms, strict=True)
        ]
        axes = np.einsum("nij,nj->ni", first, self._axes)
        slid = np.einsum("ni,ni->n", ends[1] - ends[0], axes)
        turned = np.einsum("nji,njk,nk->ni", first, second, self._across)
        angle = np.arctan2(np.einsum("ni,ni->n", turned, self._third), np.einsum("ni,ni->n", turned, self._across))
        angle = self._last + np.remainder(angle - self._last + np.pi, 2.0 * np.pi) - np.pi
        self._last = np.where(self._slides, slid, angle)
        return self._last.copy()


def rotation_matrices(quaternions: Floats) -> Floats:
    """Rotations (n, 3, 3) of quaternions (n, 4) as x, y, z, w; they need not be of unit length."""
    x, y, z, w = (quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T
    rows = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
        [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
        [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)
