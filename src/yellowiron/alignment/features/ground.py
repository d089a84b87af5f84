"""What the machine stands on: a drawn floor, a pallet, the slab of a scene."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from yellowiron.model.geometry import Floats

THIN = 0.08
"""A ground is no thicker than this share of its shorter side."""
SUNK = 0.02
"""What stands on a ground may be sunk into it by this share of the machine's size."""
UNDER = 0.98
"""A ground lies under this share of all points of the machine at least …"""
WIDER = 1.05
"""… and is this many times as large as what they cover of it."""
_SOME = 50
"""Of so many points one tells, nearly always, that a flat part is smaller than what is over it."""
FEWEST = 8
"""So many parts stand on it at least: less is a model of something else, on its base."""


def grounds_of(points: Sequence[Floats]) -> list[int]:
    """The parts, by the numbers of their points (n, 3), that are grounds: flat, under all others, and wider than these
    together. Whatever stands on a ground is not held by it."""
    if not points:
        return []
    sizes = np.array([float(np.linalg.norm(np.ptp(p, axis=0))) for p in points])
    every, first = np.concatenate(points), np.cumsum([0, *map(len, points[:-1])])
    sunk = SUNK * np.sqrt(3.0) * float(np.linalg.norm(np.ptp(every, axis=0)))  # along whatever axes, no more
    found: list[int] = []
    for k in sorted(np.flatnonzero(sizes >= 0.5 * sizes.max(initial=0.0)).tolist(), key=lambda k: (-sizes[k], k)):
        middle, axes = _lying(points[k])
        if axes is None or len(points) - len(found) <= FEWEST:
            continue
        left = [i for i in range(len(points)) if i != k and i not in found]
        # Nearly every flat part has some of the machine on both sides, which one look along its normal tells.
        height = (every - middle) @ axes[2]
        lowest, highest = np.minimum.reduceat(height, first), np.maximum.reduceat(height, first)
        if lowest[left].min() < lowest[k] - sunk and highest[left].max() > highest[k] + sunk:
            continue
        others = [points[i] for i in left]
        if _is_under((points[k] - middle) @ axes.T, (np.concatenate(others) - middle) @ axes.T):
            found.append(k)
    return found


def _lying(ground: Floats) -> tuple[Floats, Floats | None]:
    """The middle of points, and their principal axes (rows, the longest first) if they are flat."""
    middle = ground.mean(axis=0)
    axes = np.linalg.eigh((ground - middle).T @ (ground - middle))[1].T[::-1]
    _, short, thick = np.ptp((ground - middle) @ axes.T, axis=0)
    return middle, axes if thick <= THIN * short and short > 0.0 else None


def _least_area(points: Floats) -> float:
    """What some of many points (n, 2) cover, which all of them cover at least."""
    try:
        return float(ConvexHull(points).volume)  # of two dimensions: the area
    except QhullError:  # they are on a line, or too few
        return 0.0


def _is_under(flat: Floats, over: Floats) -> bool:
    """Whether flat points are those of a ground to other points, both along the ground's axes."""
    sunk = SUNK * float(np.linalg.norm(np.ptp(over, axis=0)))
    above = (over[:, 2] > flat[:, 2].min() - sunk).mean(), (over[:, 2] < flat[:, 2].max() + sunk).mean()
    if max(above) < 1.0:
        return False
    try:
        hull = ConvexHull(flat[:, :2])
        if hull.volume < WIDER * _least_area(over[::_SOME, :2]) or hull.volume < WIDER * ConvexHull(over[:, :2]).volume:
            return False
    except QhullError:
        return False
    inside = (over[:, :2] @ hull.equations[:, :2].T + hull.equations[:, 2] <= sunk).all(axis=1)
    return bool(inside.mean() >= UNDER)
