"""Positions of a tree with balls, whose turns are unit quaternions among plain numbers: carried on and moved."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from yellowiron.model.geometry import Floats

Balls = Sequence[tuple[int, int]]
"""Of each ball the first place of its quaternion (w, x, y, z) in a position, and of its turn in a velocity."""


def continued(last: Sequence[Floats], balls: Balls = ()) -> Floats:
    """Where the last three positions of a path lead to: a parabola through them, one step on."""
    return normalized(3.0 * (last[-1] - last[-2]) + last[-3], balls)


def normalized(positions: Floats, balls: Balls) -> Floats:
    """Positions (..., nq) with the quaternions of unit length."""
    for first, _ in balls:
        part = positions[..., first : first + 4]
        positions[..., first : first + 4] = part / np.linalg.norm(part, axis=-1, keepdims=True)
    return positions


def moved(positions: Floats, steps: Floats, balls: Balls) -> Floats:
    """Positions (n, nq) a small step (n, nv) on: balls turn in their own axes."""
    turning = {column for _, first in balls for column in range(first, first + 3)}
    quaternion = {place for first, _ in balls for place in range(first, first + 4)}
    made = positions.copy()
    plain = [place for place in range(positions.shape[1]) if place not in quaternion]
    made[:, plain] += steps[:, [column for column in range(steps.shape[1]) if column not in turning]]
    for first, column in balls:
        w, vector = positions[:, first, None], positions[:, first + 1 : first + 4]
        turn = 0.5 * steps[:, column : column + 3]
        made[:, first] -= np.sum(vector * turn, axis=1)
        made[:, first + 1 : first + 4] += w * turn + np.cross(vector, turn)
    return normalized(made, balls)
