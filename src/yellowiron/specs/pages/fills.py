"""Tables drawn with filled cells instead of rules: their edges, as rules."""

from __future__ import annotations

from collections.abc import Sequence

from yellowiron.specs.pages.strokes import SNAP, Box, DrawnRule

_HIGHEST = 150.0
"""Points; what is higher is a panel behind a part of the page."""
_FEWEST = 2
"""Pairs of cells side by side; one may be a heading beside another."""


def edges_of_fills(bars: Sequence[Box], walls: Sequence[DrawnRule]) -> list[DrawnRule]:
    """The edges of filled boxes that stand side by side like a table's cells, and of those over and under them; none
    where drawn walls part the columns."""
    cells = [b for b in bars if b[3] - b[1] <= _HIGHEST and b[2] - b[0] >= 12]
    beside = [(a, b) for a in cells for b in cells if abs(a[2] - b[0]) <= SNAP and _overlap(a, b) > 0.6]
    if len(beside) < _FEWEST:
        return []
    table = {box for pair in beside for box in pair}
    while more := [c for c in cells if c not in table and any(_continues(c, member) for member in table)]:
        table.update(more)
    left, right = min(box[0] for box in table), max(box[2] for box in table)
    if len({round(w.x0) for w in walls if left + SNAP < w.x0 < right - SNAP}) > 1:
        return []
    return [edge for box in sorted(table) for edge in _edges(box)]


def _overlap(a: Box, b: Box) -> float:
    """The share of the lower one's height in which two boxes are level."""
    return (min(a[3], b[3]) - max(a[1], b[1])) / min(a[3] - a[1], b[3] - b[1])


def _continues(a: Box, b: Box) -> bool:
    """Whether a box stands right over or under another one, and level with it at a side."""
    touch = abs(a[1] - b[3]) <= SNAP or abs(a[3] - b[1]) <= SNAP
    return touch and (abs(a[0] - b[0]) <= SNAP or abs(a[2] - b[2]) <= SNAP)


def _edges(box: Box) -> tuple[DrawnRule, ...]:
    x0, top, x1, bottom = box
    return (
        DrawnRule(x0, top, x1, top),
        DrawnRule(x0, bottom, x1, bottom),
        DrawnRule(x0, top, x0, bottom),
        DrawnRule(x1, top, x1, bottom),
    )
