"""Turned parts as a stack of discs: rollers with their flanges, idlers with their rib. Their bores are filled."""

from __future__ import annotations

import itertools

import numpy as np

from yellowiron.model.geometry import Floats, Mesh, Shape
from yellowiron.support.convex.pieces import hull

CORNERS = 48
"""Of each disc: a rim of 0.3 m is 0.6 mm out of round."""
STEP = 2e-4
"""Metres: profile points nearer along the axis are one."""
_INSIDE = 1e-6


def turned_pieces(shape: Shape) -> tuple[Mesh, ...]:
    """Discs and cones (their hulls) between the steps of a turned shape's outer profile, in the shape's frame; none
    where it has no whole cylinder to be turned about."""
    full = [c for c in shape.cylinders if c.arc > 1.5 * np.pi]
    if not full or not len(shape.mesh.triangles):
        return ()
    axis = max(full, key=lambda c: c.radius * c.length)
    direction = np.asarray(axis.direction, dtype=np.float64)
    offset = shape.mesh.points - np.asarray(axis.point)
    along = offset @ direction
    away = np.linalg.norm(offset - along[:, None] * direction, axis=1)
    ends = shape.mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    levels = _distinct(along)
    slabs: list[tuple[float, float, float, float]] = []
    for low, high in itertools.pairwise(levels):
        first, last = (_reach(along[ends], away[ends], at) for at in (low + _INSIDE, high - _INSIDE))
        if slabs and max(abs(first - slabs[-1][3]), abs(last - first), abs(slabs[-1][2] - slabs[-1][3])) < STEP:
            slabs[-1] = (slabs[-1][0], high, slabs[-1][2], last)
        elif max(first, last) > 0.0:
            slabs.append((low, high, first, last))
    u = np.linalg.svd(direction[None, :])[2][1:]
    turn = np.linspace(0.0, 2.0 * np.pi, CORNERS, endpoint=False)
    ring = np.cos(turn)[:, None] * u[0] + np.sin(turn)[:, None] * u[1]
    start = np.asarray(axis.point, dtype=np.float64)
    made = [
        hull(np.concatenate([start + low * direction + first * ring, start + high * direction + last * ring]))
        for low, high, first, last in slabs
    ]
    return tuple(made)


def _distinct(values: Floats) -> list[float]:
    ordered = np.sort(values)
    return ordered[np.concatenate([[True], np.diff(ordered) > STEP])].tolist()


def _reach(along: Floats, away: Floats, at: float) -> float:
    """The farthest point from the axis of edges (n, 2) where they pass a height."""
    low, high = along.min(axis=1), along.max(axis=1)
    passing = (low <= at) & (high >= at) & (high - low > _INSIDE)
    if not passing.any():
        return 0.0
    z, r = along[passing], away[passing]
    share = (at - z[:, 0]) / (z[:, 1] - z[:, 0])
    return float((r[:, 0] + share * (r[:, 1] - r[:, 0])).max())
