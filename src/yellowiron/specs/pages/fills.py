"""Tables drawn with filled cells instead of rules: their edges, as rules."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from collections.abc import Set as AbstractSet

from yellowiron.specs.pages.strokes import SNAP, Box, DrawnRule
from yellowiron.specs.pages.words import Word

_HIGHEST = 150.0
"""Points; what is higher is a panel behind a part of the page."""
_FEWEST = 2
"""Pairs of cells side by side; one may be a heading beside another."""
_FEWEST_TILES = 6
_UNCOVERED = 0.1
"""The share of a table that its cells may leave free, or cover twice."""


def edges_of_fills(
    bars: Sequence[Box], walls: Sequence[DrawnRule], words: Sequence[Word]
) -> tuple[list[DrawnRule], list[Box]]:
    """The edges of filled boxes that stand side by side like a table's cells, and of those over and under them; none
    where drawn walls part the columns, unless the boxes cover the whole table: then they are its cells, and what else
    is drawn there is none of its rules. With the edges the places of those tables."""
    cells = sorted({b for b in bars if b[3] - b[1] <= _HIGHEST and b[2] - b[0] >= 12})
    beside = [(a, b) for a, b in _meeting(cells, 2, 0) if _overlap(a, b) > 0.6]
    next_to: dict[Box, list[Box]] = {}
    for a, b in (*beside, *(pair for pair in _meeting(cells, 3, 1) if _continues(*pair))):
        next_to.setdefault(a, []).append(b)
        next_to.setdefault(b, []).append(a)
    found: list[DrawnRule] = []
    tiled: list[Box] = []
    while beside:
        table = {beside[0][0]}
        newest = list(table)
        while newest := list({c for member in newest for c in next_to[member]} - table):
            table.update(newest)
        pairs = [pair for pair in beside if pair[0] in table]
        beside = [pair for pair in beside if pair[0] not in table]
        whole = _extent(table)
        if len(table) >= _FEWEST_TILES and _covers(table, whole) and _holds_numbers(table, words):
            tiled.append(whole)
        elif len(pairs) < _FEWEST or _are_walled(table, walls):
            continue
        found.extend(edge for box in sorted(table) for edge in _edges(box))
    return found, tiled


def _covers(table: AbstractSet[Box], whole: Box) -> bool:
    """Whether boxes cover a place, and lie beside each other."""
    share = sum(map(_area, table)) / _area(whole)
    return 1 - _UNCOVERED <= share <= 1 + _UNCOVERED


def _holds_numbers(table: AbstractSet[Box], words: Sequence[Word]) -> bool:
    """Whether cells begin with a number: labels alone may be filled, with their values beside them."""
    first: dict[Box, Word] = {}
    for word in words:
        x, y = (word.x0 + word.x1) / 2, (word.top + word.bottom) / 2
        box = next((b for b in table if b[0] <= x <= b[2] and b[1] <= y <= b[3]), None)
        if box is not None and (box not in first or word.x0 < first[box].x0):
            first[box] = word
    return sum(word.text[0].isdigit() for word in first.values()) >= _FEWEST


def _area(box: Box) -> float:
    return (box[2] - box[0]) * (box[3] - box[1])


def _extent(table: AbstractSet[Box]) -> Box:
    return (min(b[0] for b in table), min(b[1] for b in table), max(b[2] for b in table), max(b[3] for b in table))


def _are_walled(table: AbstractSet[Box], walls: Sequence[DrawnRule]) -> bool:
    """Whether drawn walls part the columns of a table of filled cells."""
    left, top, right, bottom = _extent(table)
    inner = {round(w.x0) for w in walls
             if left + SNAP < w.x0 < right - SNAP and w.top < bottom - SNAP and w.bottom > top + SNAP}  # fmt: skip
    return len(inner) > 1


def _meeting(cells: Sequence[Box], end: int, begin: int) -> Iterator[tuple[Box, Box]]:
    """The pairs of boxes of which the second begins, at its edge `begin`, where the first ends, at `end`."""
    ordered = sorted(cells, key=lambda b: b[begin])
    places = [b[begin] for b in ordered]
    for cell in cells:
        first, last = bisect_left(places, cell[end] - SNAP), bisect_right(places, cell[end] + SNAP)
        yield from ((cell, other) for other in ordered[first:last])


def _overlap(a: Box, b: Box) -> float:
    """The share of the lower one's height in which two boxes are level."""
    return (min(a[3], b[3]) - max(a[1], b[1])) / min(a[3] - a[1], b[3] - b[1])


def _continues(a: Box, b: Box) -> bool:
    """Whether a box right over another one is level with it at a side."""
    return abs(a[0] - b[0]) <= SNAP or abs(a[2] - b[2]) <= SNAP


def _edges(box: Box) -> tuple[DrawnRule, ...]:
    x0, top, x1, bottom = box
    return (
        DrawnRule(x0, top, x1, top),
        DrawnRule(x0, bottom, x1, bottom),
        DrawnRule(x0, top, x0, bottom),
        DrawnRule(x1, top, x1, bottom),
    )
