"""A body on a ball, held by three links: how it is turned at their lengths."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def turned(links: Sequence[tuple[Array, Array]], ball: Array, lengths: Array, start: Array) -> Array:
    """The rotation (3, 3) of a body on a ball at which three links, from fixed points to its own (as drawn), have these
    lengths: Newton, from `start`, on the nine entries of the matrix, with the six conditions of a rotation among the
    equations."""
    feet = np.array([a for a, _ in links]) - ball
    arms = np.array([b for _, b in links]) - ball
    reach = (feet**2).sum(axis=1) + (arms**2).sum(axis=1)
    matrix = start.copy()
    for _ in range(40):
        gaps = reach - 2.0 * np.einsum("ni,ij,nj->n", feet, matrix, arms) - lengths**2
        rows = [-2.0 * np.outer(foot, arm).ravel() for foot, arm in zip(feet, arms, strict=True)]
        bent = matrix.T @ matrix - np.eye(3)
        values = list(gaps)
        for i in range(3):
            for j in range(i, 3):
                row = np.zeros((3, 3))
                row[:, i] += matrix[:, j]
                row[:, j] += matrix[:, i]
                rows.append(row.ravel())
                values.append(bent[i, j])
        step = np.linalg.solve(np.array(rows), -np.array(values))
        matrix += step.reshape(3, 3)
        if np.abs(step).max() < 1e-15:
            break
    return matrix


def followed(links: Sequence[tuple[Array, Array]], ball: Array, longer: Array, steps: int = 40) -> Array:
    """The same with the links so much `longer` than drawn, followed from there in small steps."""
    drawn = np.array([np.linalg.norm(b - a) for a, b in links])
    matrix = np.eye(3)
    for share in np.linspace(0.0, 1.0, steps + 1)[1:]:
        matrix = turned(links, ball, drawn + share * longer, matrix)
    return matrix
