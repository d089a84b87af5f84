"""Tables drawn with vertical and horizontal rules, as grids of cells. pdfplumber finds the cells."""

from __future__ import annotations

import itertools
from bisect import bisect_left, bisect_right
from collections.abc import Sequence

from yellowiron.specs.layout.grids.partly_ruled import (
    joined,
    merged,
    side_walls,
    with_columns,
    with_rows,
    with_values_apart,
)
from yellowiron.specs.layout.grids.table_grid import Cell, TableGrid
from yellowiron.specs.layout.rows.lines import lines_of
from yellowiron.specs.layout.statement import join_boxes, split_inline
from yellowiron.specs.layout.tolerances import HEADING_BAR
from yellowiron.specs.pages.fills import edges_of_fills
from yellowiron.specs.pages.strokes import SNAP, Box, DrawnRule
from yellowiron.specs.pages.words import Page, Word

_WALL = 6.0
"""A vertical rule shorter than this is a tick or part of a letter."""
_MOST_EDGES = 3000
"""More are no table's."""


def grids_of(page: Page) -> list[TableGrid]:
    """The tables of a page that have at least two rows, two columns and words in three cells."""
    walls = [r for r in page.rules if not r.horizontal and r.bottom - r.top >= _WALL]
    filled, tiled = edges_of_fills(page.bars, walls, page.words)
    drawn = [r for r in page.rules if not any(_lies_in(r, box) for box in tiled)]
    walls = [r for r in drawn if not r.horizontal and r.bottom - r.top >= _WALL]
    walls += [r for r in filled if not r.horizontal]
    if len(walls) < 2:
        return []
    from pdfplumber.table import cells_to_tables, edges_to_intersections, intersections_to_cells, merge_edges

    level = [*(r for r in (*drawn, *filled) if r.horizontal), *_bands(page)]
    walls += side_walls(level, walls, page.words)
    grids = []
    for rules in _joining(_framing(merged(level), joined(walls))):
        edges = merge_edges([_edge(r) for r in rules], SNAP, SNAP, SNAP, SNAP)
        if 4 <= len(edges) <= _MOST_EDGES:
            cells = intersections_to_cells(edges_to_intersections(edges, SNAP, SNAP))
            parts = [part for boxes in cells_to_tables(cells) for part in _apart(boxes)]
            grids += [with_columns(with_rows(with_values_apart(_grid(boxes, page.words)))) for boxes in parts]
    grids = [g for g in grids if g.columns >= 2 and sum(bool(c.lines) for c in g.cells) >= 2]
    grids = [g for g in grids if not _is_frame(g) and not _is_list(g)]
    tables = [g for g in grids if g.rows >= 2 and sum(bool(c.lines) for c in g.cells) >= 3]
    found = [g for g in grids if any(g is t or (g.rows == 1 and _are_level(g, t)) for t in tables)]
    return sorted(found, key=lambda g: (g.box[1], g.box[0]))


def _framing(level: Sequence[DrawnRule], walls: Sequence[DrawnRule]) -> list[DrawnRule]:
    """The rules without those that can frame no cell: what joins no two of the other direction is a drawing's stroke,
    and would pull a table's rules together, each within `SNAP` of the next."""
    while True:
        crossed = sorted((w.x0, w.top, w.bottom) for w in walls)
        kept = [r for r in level if _joins_two(r.top, r.x0, r.x1, crossed)]
        crossed = sorted((r.top, r.x0, r.x1) for r in kept)
        across = [w for w in walls if _joins_two(w.x0, w.top, w.bottom, crossed)]
        if len(kept) == len(level) and len(across) == len(walls):
            return [*kept, *across]
        level, walls = kept, across


def _joins_two(at: float, begin: float, end: float, others: Sequence[tuple[float, float, float]]) -> bool:
    """Whether a rule at one place, from `begin` to `end`, meets two others across it (place, begin, end; sorted) that
    do not lie at one place."""
    first = None
    for place, low, high in others[bisect_left(others, (begin - SNAP,)) :]:
        if place > end + SNAP:
            return False
        if low - SNAP <= at <= high + SNAP:
            if first is not None and place - first > SNAP:
                return True
            first = place if first is None else first
    return False


def _joining(rules: Sequence[DrawnRule]) -> list[list[DrawnRule]]:
    """The rules, those together that touch each other: the rows of two tables side by side have nothing in common."""
    ordered = sorted(rules, key=lambda r: r.top)
    lead = list(range(len(ordered)))

    def root(index: int) -> int:
        while lead[index] != index:
            lead[index] = index = lead[lead[index]]
        return index

    open_: list[int] = []
    for index, rule in enumerate(ordered):
        open_ = [i for i in open_ if ordered[i].bottom >= rule.top - SNAP]
        for other in open_:
            if ordered[other].x0 - SNAP <= rule.x1 and rule.x0 - SNAP <= ordered[other].x1:
                lead[root(index)] = root(other)
        open_.append(index)
    parts: dict[int, list[DrawnRule]] = {}
    for index, rule in enumerate(ordered):
        parts.setdefault(root(index), []).append(rule)
    return list(parts.values())


def _lies_in(rule: DrawnRule, box: Box) -> bool:
    level = box[0] - SNAP <= rule.x0 and rule.x1 <= box[2] + SNAP
    return level and box[1] - SNAP <= rule.top and rule.bottom <= box[3] + SNAP


def _bands(page: Page) -> list[DrawnRule]:
    """The upper and lower edges of filled bars no higher than a row of some lines: they part rows, walls columns."""
    bars = [b for b in page.bars if 6 <= b[3] - b[1] <= HEADING_BAR and b[2] - b[0] >= 12]
    return [DrawnRule(b[0], y, b[2], y) for b in bars for y in (b[1], b[3])]


def _are_level(row: TableGrid, table: TableGrid) -> bool:
    """Whether a row that stands alone has the columns of a table, or some of them."""
    stops = {x for c in table.cells for x in (c.box[0], c.box[2])}
    return all(any(abs(x - stop) <= SNAP for stop in stops) for c in row.cells for x in (c.box[0], c.box[2]))


def _edge(rule: DrawnRule) -> dict[str, object]:
    place = {name: getattr(rule, name) for name in ("x0", "x1", "top", "bottom")}
    size = {"width": rule.x1 - rule.x0, "height": rule.bottom - rule.top}
    return {**place, **size, "orientation": "h" if rule.horizontal else "v", "object_type": "line"}


def _grid(boxes: Sequence[Box], words: Sequence[Word]) -> TableGrid:
    xs, ys = (_stops([b[i] for b in boxes] + [b[i + 2] for b in boxes]) for i in (0, 1))
    inside: dict[tuple[int, int], list[Word]] = {}
    for word in words:
        place = (_slot(ys, (word.top + word.bottom) / 2), _slot(xs, (word.x0 + word.x1) / 2))
        inside.setdefault(place, []).append(word)
    cells = []
    for box in sorted(boxes, key=lambda b: (b[1], b[0])):
        rows, columns = (_index(ys, box[1]), _index(ys, box[3])), (_index(xs, box[0]), _index(xs, box[2]))
        own = [w for place in itertools.product(range(*rows), range(*columns)) for w in inside.get(place, ())]
        cells.append(Cell(box, rows, columns, tuple(lines_of(own))))
    return TableGrid(join_boxes(boxes), tuple(cells), len(ys) - 1, len(xs) - 1)


def _slot(stops: Sequence[float], value: float) -> int:
    """The interval of the grid that a coordinate lies in; −1 outside."""
    index = bisect_right(stops, value) - 1
    return index if index < len(stops) - 1 else -1


def _stops(values: Sequence[float]) -> list[float]:
    stops: list[float] = []
    for value in sorted(values):
        if not stops or value - stops[-1] > SNAP:
            stops.append(value)
    return stops


def _index(stops: Sequence[float], value: float) -> int:
    return min(range(len(stops)), key=lambda i: abs(stops[i] - value))


def _apart(boxes: list[Box]) -> list[list[Box]]:
    """The cells of a table, parted where one side ends about where the other begins: tables that touch at a corner."""
    for x in sorted({b[0] for b in boxes})[1:]:
        left, right = [b for b in boxes if b[2] <= x + SNAP], [b for b in boxes if b[0] >= x - SNAP]
        if len(left) + len(right) != len(boxes) or min(len(left), len(right)) < 4:
            continue
        (_, top, _, bottom), (_, other_top, _, other_bottom) = join_boxes(left), join_boxes(right)
        if min(bottom, other_bottom) - max(top, other_top) < 1.5 * min(b[3] - b[1] for b in boxes):
            return [*_apart(left), *_apart(right)]
    return [boxes]


def _is_list(grid: TableGrid) -> bool:
    """Whether every row is one text, and most of these a name and its value: a list in a frame, no table."""
    filled = [c for c in grid.cells if c.lines]
    rows = sum(bool(split_inline(c.text)[0]) for c in filled)
    return len({c.rows[0] for c in filled}) == len(filled) and rows >= _FEWEST_ROWS and 2 * rows >= len(filled)


_FEWEST_ROWS = 4
"""Names with their values that make a list."""


def _is_frame(grid: TableGrid) -> bool:
    """Frames around blocks of text are no table: a few big cells, each with many lines."""
    crowded = sum(len(c.lines) >= 5 for c in grid.cells)
    return crowded >= 1 and crowded >= 0.3 * sum(bool(c.lines) for c in grid.cells)
