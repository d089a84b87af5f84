"""Tables that are ruled in part: rows, columns and sides without rules, heads on a bar above them."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.quantities import same
from yellowiron.specs.layout.grids.table_grid import Cell, TableGrid
from yellowiron.specs.layout.rows.lines import TextLine, lines_of
from yellowiron.specs.layout.statement import TextPiece, is_key, is_unit, kind_of, looks_like_value
from yellowiron.specs.pages.strokes import SNAP, Box, DrawnRule
from yellowiron.specs.pages.words import Word

_LEVEL = 2.5
"""Points within which the lines of a row lie."""
_APART = 0.3
"""Share of a cell's width that lies between a label and its value in it."""
_FEWEST, _MOST_OF, _ACROSS = 3, 0.5, 0.2
"""So many cells, and such a share of a column's, have words on both sides of what parts it; at most such a share have
words across it."""


def with_rows(grid: TableGrid) -> TableGrid:
    """The table with the rows parted that hold several lines of values, each level with a line of the labels."""
    edges = {row: _edges(grid, row) for row in range(grid.rows)}
    if not any(edges.values()):
        return grid
    first = [0, *itertools.accumulate(1 + len(edges[row]) for row in range(grid.rows))]
    cells: list[Cell] = []
    for cell in grid.cells:
        a, b = cell.rows
        inner = edges[a] if b == a + 1 else []
        if not inner or (len(cell.lines) == 1 and not _is_valued(cell)):
            cells.append(replace(cell, rows=(first[a], first[b])))
            continue
        stops = [cell.box[1], *inner, cell.box[3]]
        for index, (top, bottom) in enumerate(pairwise(stops)):
            lines = tuple(line for line in cell.lines if top <= (line.top + line.bottom) / 2 < bottom)
            box = (cell.box[0], top, cell.box[2], bottom)
            cells.append(replace(cell, box=box, rows=(first[a] + index, first[a] + index + 1), lines=lines))
    return replace(grid, cells=tuple(cells), rows=first[-1])


def _edges(grid: TableGrid, row: int) -> list[float]:
    """The heights at which a row is to be parted; [] if it is one."""
    cells = [c for c in grid.cells if c.rows == (row, row + 1) and c.lines]
    valued = [c for c in cells if len(c.lines) > 1 and _is_valued(c)]
    labels = [c for c in cells if any(kind_of(p) == "text" for p in c.pieces) and not any(c is v for v in valued)]
    most = max((len(c.lines) for c in valued), default=0)
    if not labels or most < 2 or (most == 2 and len(valued) < 2) or any(map(_in_two_systems, valued)):
        return []
    full = next(c for c in valued if len(c.lines) == most)
    label = max(labels, key=lambda c: sum(_is_level(line, c) for line in full.lines))
    if not all(_is_level(line, label) for c in valued for line in c.lines):
        return []
    levels = [line for line in full.lines if _is_level(line, label)]
    return [min(line.top for c in cells for line in c.lines if abs(line.bottom - at.bottom) <= _LEVEL) - 0.5
            for at in levels[1:]]  # fmt: skip


def _is_valued(cell: Cell) -> bool:
    """Whether every line of a cell is a value, or a dash for none; outline numbers and units are none."""
    texts = [" ".join(p.bare for p in line.pieces) for line in cell.lines]
    kinds = {kind_of(line.pieces[0]) for line in cell.lines}
    return kinds <= {"value", "mark"} and any(map(looks_like_value, texts)) and not any(map(is_unit, texts))


def _is_level(line: TextLine, cell: Cell) -> bool:
    return any(abs(line.bottom - other.bottom) <= _LEVEL for other in cell.lines)


def _in_two_systems(cell: Cell) -> bool:
    """Whether a line of values is the one above it again, in the other system of measurement."""
    return any(_restated(a, b) for a, b in pairwise(cell.lines))


def _restated(a: TextLine, b: TextLine) -> bool:
    first, second = read(a.text), read(b.text.strip("()"))
    if len(first) != 1 or len(second) != 1:
        return False
    one, other = first[0].numbers[0], second[0].numbers[0]
    systems = {q.printed.system for q in (one, other) if q.printed}
    return len(systems) == 2 and same(one, other)


# ---- columns -------------------------------------------------------------------------------------------------------


def with_columns(grid: TableGrid) -> TableGrid:
    """The table with the columns parted in whose cells values stand side by side, or a label and its value, as if a
    wall stood between them; what crosses that place spans both parts."""
    column = 0
    while column < grid.columns:
        x = _gap(grid, column)
        if x is None:
            column += 1
        else:
            grid = _with_wall(grid, column, x)  # its left part has one piece to a cell, unless it has a gap itself
    return grid


def with_values_apart(grid: TableGrid) -> TableGrid:
    """The table with the cells parted that span columns and hold words on both sides of the walls of other rows, or a
    label at their left and its value at their right, as rows without walls under rows with them do."""
    walls = {first: c.box[0] for c in grid.cells for first in c.columns[:1]}
    often = Counter(c.columns for c in grid.cells if len(c.pieces) > 1)
    parts = [part for c in grid.cells for part in (_walled(c, walls) if often[c.columns] >= _FEWEST else (c,))]
    cells = [part for c in parts for part in (_halves(c) if c.columns[1] - c.columns[0] > 1 else (c,))]
    return replace(grid, cells=tuple(cells))


def _walled(cell: Cell, walls: Mapping[int, float]) -> Iterator[Cell]:
    """A cell cut at the walls that its pieces leave free and stand on both sides of."""
    first, last = cell.columns
    for column in range(first + 1, last):
        x = walls.get(column, cell.box[0])
        before, after = [p for p in cell.pieces if p.x1 <= x + 1], [p for p in cell.pieces if p.x0 >= x - 1]
        if cell.box[0] < x < cell.box[2] and before and after and len(before) + len(after) == len(cell.pieces):
            part, rest = _cut(cell, x, (first, column), (column, last))
            yield part
            yield from _walled(rest, walls)
            return
    yield cell


def _cut(cell: Cell, x: float, before: tuple[int, int], after: tuple[int, int]) -> tuple[Cell, Cell]:
    """The two parts of a cell with a wall at `x` between them, and the columns that they cover."""
    left, top, right, bottom = cell.box
    words = [w for p in cell.pieces for w in p.words]
    lines = [tuple(lines_of([w for w in words if ((w.x0 + w.x1) / 2 < x) == is_left])) for is_left in (True, False)]
    return (
        replace(cell, box=(left, top, x, bottom), columns=before, lines=lines[0]),
        replace(cell, box=(x, top, right, bottom), columns=after, lines=lines[1]),
    )


def _halves(cell: Cell) -> tuple[Cell, ...]:
    pieces = sorted(cell.pieces, key=lambda p: p.x0)
    ends = list(itertools.accumulate((p.x1 for p in pieces), max))
    gaps = [(after.x0 - end, index + 1) for index, (end, after) in enumerate(zip(ends, pieces[1:], strict=False))]
    wide, at = max(gaps, default=(0.0, 0))
    parted = wide >= _APART * (cell.box[2] - cell.box[0]) and all(kind_of(p) == "text" for p in pieces[:at])
    if not parted or not any(looks_like_value(p.bare) for p in pieces[at:]):
        return (cell,)
    first, last = cell.columns
    return _cut(cell, (ends[at - 1] + pieces[at].x0) / 2, (first, first + 1), (first + 1, last))


def _gap(grid: TableGrid, column: int) -> float | None:
    """Where the cells of a column are to be parted: a strip with a value right of it and words left in most of them,
    and words across it in few."""
    own = [c for c in grid.cells if c.columns == (column, column + 1) and c.lines]
    several = [c.pieces for c in own if len(c.lines) == 1 and len(c.pieces) > 1]
    pairs = [pair for pieces in several for pair in pairwise(pieces) if kind_of(pair[1]) in ("value", "mark")]
    least = max(_FEWEST, _MOST_OF * len(own))
    for left in sorted({a.x1 for a, _ in pairs}):
        beside = [(a.x1, b.x0) for a, b in pairs if a.x1 <= left < b.x0]
        x = (left + min((b for _, b in beside), default=left)) / 2
        across = sum(any(p.x0 < x < p.x1 for p in c.pieces) for c in own)
        if len(beside) - across >= least and across <= _ACROSS * len(own):
            return x
    return None


def _with_wall(grid: TableGrid, column: int, x: float) -> TableGrid:
    cells: list[Cell] = []
    for cell in grid.cells:
        first, last = cell.columns
        if (first, last) == (column, column + 1) and not any(p.x0 < x < p.x1 for p in cell.pieces):
            cells += _cut(cell, x, (first, first + 1), (last, last + 1))
        else:
            cells.append(replace(cell, columns=(first + (first > column), last + (last > column))))
    return replace(grid, cells=tuple(cells), columns=grid.columns + 1)


_HIGHEST = 60.0
"""Points; what is higher is no row."""
_FAR = 40.0
"""Points between a row of heads and the table or the heading under it."""


def side_walls(level: Sequence[DrawnRule], walls: Sequence[DrawnRule], words: Sequence[Word]) -> list[DrawnRule]:
    """The walls that a table lacks at its left or right: between two rules that end level with each other and that
    walls in between join, with words but no value left of the first wall, or with words right of the last one."""
    found: list[DrawnRule] = []
    rules, walls = merged(level), joined(walls)
    for edge in ("x0", "x1"):
        for above in rules:
            x = getattr(above, edge)
            below = next((r for r in rules if r.top > above.top + SNAP and abs(getattr(r, edge) - x) <= SNAP), None)
            if below is not None and _lacks_wall(above, below, x, walls, words):
                found.append(DrawnRule(x, above.top, x, below.top))
    return found


def _lacks_wall(
    above: DrawnRule, below: DrawnRule, x: float, walls: Sequence[DrawnRule], words: Sequence[Word]
) -> bool:
    """Whether a table's row between two rules, or several that no rule parts, has words beside its walls, at `x`."""
    x0, x1 = max(above.x0, below.x0), min(above.x1, below.x1)
    joining = [
        w.x0
        for w in walls
        if w.top <= above.top + SNAP and w.bottom >= below.top - SNAP and x0 - SNAP <= w.x0 <= x1 + SNAP
    ]
    inner = [wall for wall in joining if x0 + 10 < wall < x1 - 10]
    if not inner or any(abs(x - wall) <= SNAP for wall in joining):
        return False
    high = below.top - above.top >= _HIGHEST
    row = [w for w in words if above.top < (w.top + w.bottom) / 2 < below.top and x0 - 4 <= w.x0 <= x1]
    before = [p for line in lines_of([w for w in row if w.x1 <= min(inner) + 1]) for p in line.pieces]
    left = {kind_of(p) for p in before if p is not before[0] or not is_key(p.bare)}
    right = {kind_of(p) for line in lines_of([w for w in row if w.x0 >= max(inner) - 1]) for p in line.pieces}
    if high:
        return len(inner) > 1 and "value" in right if x > max(inner) else len(inner) > 1 and "text" in left
    return bool(right) if x > max(inner) else "text" in left and "value" not in left


def merged(level: Iterable[DrawnRule], slack: float = SNAP) -> list[DrawnRule]:
    """Rules at one height that touch are one; from top to bottom."""
    found: list[DrawnRule] = []
    for rule in sorted(level, key=lambda r: (round(r.top), r.x0)):
        last = found[-1] if found else None
        touch = last is not None and last.x0 - slack <= rule.x1 and rule.x0 <= last.x1 + slack
        if last is not None and touch and abs(last.top - rule.top) <= 1:
            found[-1] = DrawnRule(min(last.x0, rule.x0), last.top, max(last.x1, rule.x1), last.top)
        else:
            found.append(rule)
    return sorted(found, key=lambda r: (r.top, r.x0))


def joined(walls: Iterable[DrawnRule]) -> list[DrawnRule]:
    """Walls at one place that touch are one, though drawn row by row."""
    return [DrawnRule(w.top, w.x0, w.bottom, w.x1) for w in merged((_laid(w) for w in walls), slack=1.0)]


def _laid(wall: DrawnRule) -> DrawnRule:
    """A wall as a level rule, its height for its place."""
    return DrawnRule(wall.top, wall.x0, wall.bottom, wall.x0)


def heads_above(
    lines: Sequence[TextLine], box: Box, columns: Sequence[tuple[float, float]], tables: Sequence[Box]
) -> tuple[TextPiece, ...]:
    """The heads that stand over a table's columns (left and right edges, without the labels') outside of it: the
    nearest line above with words over two or more of them. Only headings, tables of the same width and their heads may
    stand between."""
    top = box[1]
    same = [t for t in tables if abs(t[0] - box[0]) < 2 * SNAP and abs(t[2] - box[2]) < 2 * SNAP]
    for line in sorted(lines, key=lambda one: -one.bottom):
        if line.bottom > box[1] + 2 or line.x1 < box[0] or line.x0 > box[2]:
            continue
        nearest = max((t[3] for t in same if t[3] <= top + 2), default=float("-inf"))
        while nearest > line.bottom and top - nearest <= _FAR + 20:
            top = min(t[1] for t in same if t[3] == nearest)
            nearest = max((t[3] for t in same if t[3] <= top + 2), default=float("-inf"))
        if top - line.bottom > _FAR:
            return ()
        over = [p for p in line.pieces if _column_of(p, columns) is not None]
        if len(over) >= 2 and len({_column_of(p, columns) for p in over}) == len(over):
            return tuple(over)
        if len(line.pieces) > 1 or kind_of(line.pieces[0]) != "text":
            return ()
        top = line.top
    return ()


def _column_of(piece: TextPiece, columns: Sequence[tuple[float, float]]) -> int | None:
    """The column that a head stands over."""
    middle = (piece.x0 + piece.x1) / 2
    return next((i for i, (x0, x1) in enumerate(columns) if x0 <= middle <= x1 and x0 - 6 <= piece.x0), None)
