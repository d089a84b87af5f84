"""Rules and the edges of fills on the picture of a page: long straight steps of its grey."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from yellowiron.specs.pages.strokes import DrawnRule

_STEP = 6
"""Of 255 grey levels, from a point to the third next: the least step of an edge; a light band behind a row is one."""
_SHARE = 0.85
"""Share of an edge's points that have the step; along the tops of letters only some do."""
_LEVEL_PT = 40.0
"""Points that a level edge is long at least."""
_WALL_PT = 14.0
"""Points that an upright edge is high at least: more than a capital letter of a heading."""
_GAP_PT = 2.5
"""Points within which two edges are the sides of one rule, and a step may be missing."""
_BREAK_PT = 6.0
"""Points of a level rule that dirt may cover."""
_MOST = 1500
"""Edges of a page; more are a photograph's."""


def rules_of_picture(picture: NDArray[np.uint8], scale: float) -> list[DrawnRule]:
    """The rules of a page's grey picture at `scale` pixels a point, in points from the top left; the edges of fills
    are rules, too. None where a photograph covers the page."""
    grey = picture.astype(np.int16)
    level = _edges(grey, _LEVEL_PT * scale, _GAP_PT * scale, _BREAK_PT * scale)
    upright = _edges(grey.T, _WALL_PT * scale, _GAP_PT * scale, _GAP_PT * scale)
    if len(level) + len(upright) > _MOST:
        return []
    rules = [DrawnRule(a / scale, y / scale, b / scale, y / scale) for y, a, b in level]
    return rules + [DrawnRule(x / scale, a / scale, x / scale, b / scale) for x, a, b in upright]


def _edges(grey: NDArray[np.int16], least: float, gap: float, longest: float) -> list[tuple[float, float, float]]:
    """The edges along the rows of a picture, from light to dark and from dark to light, as (row, first, last + 1), over
    breaks of at most `longest`."""
    step = grey[3:] - grey[:-3]
    window = max(3, int(least / 3))
    edge = np.zeros(step.shape, bool)
    for mask in (step >= _STEP, step <= -_STEP):
        # of an edge is what lies in a window most of whose points have the step
        dense = _windowed(mask, window) >= _SHARE * window
        edge |= mask & (_windowed(dense, window) > 0)
    return [(y + 3, a, b) for y, a, b in _runs(edge, least, gap, longest)]


def _windowed(mask: NDArray[np.bool_], window: int) -> NDArray[np.int32]:
    """How many are True along the rows in the window around each point."""
    summed = np.cumsum(np.pad(mask, ((0, 0), (window // 2 + 1, window))), axis=1, dtype=np.int32)
    return summed[:, window : window + mask.shape[1]] - summed[:, : mask.shape[1]]


def _runs(mask: NDArray[np.bool_], least: float, gap: float, longest: float) -> list[tuple[float, float, float]]:
    """The long runs of True along the rows of a mask, as (row, first, last + 1); those of neighbouring rows are one."""
    found: list[tuple[float, float, float]] = []
    for row in np.flatnonzero(mask.sum(axis=1) >= least):
        at = np.flatnonzero(mask[row])
        breaks = np.flatnonzero(np.diff(at) > longest)
        firsts, lasts = at[np.r_[0, breaks + 1]], at[np.r_[breaks, len(at) - 1]]
        for first, last in zip(firsts, lasts, strict=True):
            if last - first < least:
                continue
            merged = next(
                (i for i, (y, a, b) in enumerate(found[-40:], start=max(0, len(found) - 40))
                 if row - y <= gap and first < b and a < last),
                None,
            )  # fmt: skip
            if merged is None:
                found.append((float(row), float(first), float(last) + 1))
            else:
                y, a, b = found[merged]
                found[merged] = (y, min(a, float(first)), max(b, float(last) + 1))
    return found
