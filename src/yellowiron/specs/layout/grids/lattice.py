"""Tables drawn with vertical and horizontal rules, as grids of cells. pdfplumber finds the cells."""

from __future__ import annotations

import itertools
from bisect import bisect_right
from collections.abc import Sequence

from yellowiron.specs.layout.grids.open_sided import side_walls
from yellowiron.specs.layout.grids.partly_ruled import with_columns, with_rows
from yellowiron.specs.layout.grids.table_grid import Cell, TableGrid
from yellowiron.specs.layout.rows.lines import lines_of
from yellowiron.specs.layout.statement import join_boxes
from yellowiron.specs.layout.tolerances import HEADING_BAR
from yellowiron.specs.pages.fills import edges_of_fills
from yellowiron.specs.pages.strokes import SNAP, Box, DrawnRule
from yellowiron.specs.pages.words import Page, Word

_WALL = 6.0
"""A vertical rule shorter than this is a tick or part of a letter."""


def grids_of(page: Page) -> list[TableGrid]:
    """The tables of a page that have at least two rows, two columns and words in three cells."""
    walls = [r for r in page.rules if not r.horizontal and r.bottom - r.top >= _WALL]
    filled = edges_of_fills(page.bars, walls)
    walls += [r for r in filled if not r.horizontal]
    if len(walls) < 2:
        return []
    from pdfplumber.table import cells_to_tables, edges_to_intersections, intersections_to_cells, merge_edges

    level = [*(r for r in (*page.rules, *filled) if r.horizontal), *_closing_bars(page, walls)]
    walls += side_walls(level, walls, page.words)
    edges = merge_edges([_edge(r) for r in (*level, *walls)], SNAP, SNAP, SNAP, SNAP)
    if not 4 <= len(edges) <= 3000:
        return []
    grids = [
        with_columns(with_rows(_grid(boxes, page.words)))
        for boxes in cells_to_tables(intersections_to_cells(edges_to_intersections(edges, SNAP, SNAP)))
    ]
    grids = [g for g in grids if g.columns >= 2 and sum(bool(c.lines) for c in g.cells) >= 2 and not _is_frame(g)]
    tables = [g for g in grids if g.rows >= 2 and sum(bool(c.lines) for c in g.cells) >= 3]
    found = [g for g in grids if any(g is t or (g.rows == 1 and _are_level(g, t)) for t in tables)]
    return sorted(found, key=lambda g: (g.box[1], g.box[0]))


def _closing_bars(page: Page, walls: Sequence[DrawnRule]) -> list[DrawnRule]:
    """The lower edges of headings' bars on which walls stand: the table's first row has no other rule above it."""
    found = []
    for bar in page.bars:
        on = [w.x0 for w in walls if abs(w.top - bar[3]) <= SNAP and bar[0] - SNAP <= w.x0 <= bar[2] + SNAP]
        if bar[3] - bar[1] < HEADING_BAR and on:
            found.append(DrawnRule(min(*on, bar[0]), bar[3], max(*on, bar[2]), bar[3]))
    return found


def _are_level(row: TableGrid, table: TableGrid) -> bool:
    """Whether a row that stands alone has the columns of a table, or some of them."""
    stops = {x for c in table.cells for x in (c.box[0], c.box[2])}
    return all(any(abs(x - stop) <= SNAP for stop in stops) for c in row.cells for x in (c.box[0], c.box[2]))


def _edge(rule: DrawnRule) -> dict[str, object]:
    return {
        "x0": rule.x0,
        "x1": rule.x1,
        "top": rule.top,
        "bottom": rule.bottom,
        "width": rule.x1 - rule.x0,
        "height": rule.bottom - rule.top,
        "orientation": "h" if rule.horizontal else "v",
        "object_type": "line",
    }


def _grid(boxes: Sequence[Box], words: Sequence[Word]) -> TableGrid:
    xs, ys = (
        _stops([b[0] for b in boxes] + [b[2] for b in boxes]),
        _stops([b[1] for b in boxes] + [b[3] for b in boxes]),
    )
    inside: dict[tuple[int, int], list[Word]] = {}
    for word in words:
        place = (_slot(ys, (word.top + word.bottom) / 2), _slot(xs, (word.x0 + word.x1) / 2))
        inside.setdefault(place, []).append(word)
    cells = []
    places: dict[tuple[int, int], Cell] = {}
    for box in sorted(boxes, key=lambda b: (b[1], b[0])):
        rows, columns = (_index(ys, box[1]), _index(ys, box[3])), (_index(xs, box[0]), _index(xs, box[2]))
        covered = list(itertools.product(range(*rows), range(*columns)))
        cell = Cell(box, rows, columns, tuple(lines_of([w for place in covered for w in inside.get(place, ())])))
        cells.append(cell)
        places.update((place, cell) for place in covered)
    return TableGrid(join_boxes(boxes), tuple(cells), len(ys) - 1, len(xs) - 1, places)


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


def _is_frame(grid: TableGrid) -> bool:
    """Frames around blocks of text are no table: a few big cells, each with many lines."""
    crowded = sum(len(c.lines) >= 5 for c in grid.cells)
    return crowded >= 1 and crowded >= 0.3 * sum(bool(c.lines) for c in grid.cells)
