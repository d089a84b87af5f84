"""Tables drawn with vertical and horizontal rules → statements. pdfplumber finds the cells; a cell fills its span."""

from __future__ import annotations

import itertools
import re
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from yellowiron.specs.layout.grids.open_sided import side_walls
from yellowiron.specs.layout.grids.partly_ruled import with_columns, with_rows
from yellowiron.specs.layout.grids.table_grid import Cell, TableGrid
from yellowiron.specs.layout.rows.cells import is_circumstance, marked_by_footnote
from yellowiron.specs.layout.rows.headings import names_no_columns
from yellowiron.specs.layout.rows.lines import lines_of
from yellowiron.specs.layout.statement import (
    COUNTED,
    EXAMPLE,
    Statement,
    TextPiece,
    ascending,
    is_key,
    is_unit,
    join_boxes,
    looks_like_value,
    split_inline,
    unit_in_label,
    unit_of_heading,
    without_key,
)
from yellowiron.specs.layout.tolerances import HEADING_BAR
from yellowiron.specs.pages.fills import edges_of_fills
from yellowiron.specs.pages.strokes import Box, Rule
from yellowiron.specs.pages.words import Page, Word

_SNAP = 3.0
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
    edges = merge_edges([_edge(r) for r in (*level, *walls)], _SNAP, _SNAP, _SNAP, _SNAP)
    if not 4 <= len(edges) <= 3000:
        return []
    grids = [
        with_columns(with_rows(_grid(boxes, page.words)))
        for boxes in cells_to_tables(intersections_to_cells(edges_to_intersections(edges, _SNAP, _SNAP)))
    ]
    grids = [g for g in grids if g.columns >= 2 and sum(bool(c.lines) for c in g.cells) >= 2 and not _is_frame(g)]
    tables = [g for g in grids if g.rows >= 2 and sum(bool(c.lines) for c in g.cells) >= 3]
    found = [g for g in grids if any(g is t or (g.rows == 1 and _are_level(g, t)) for t in tables)]
    return sorted(found, key=lambda g: (g.box[1], g.box[0]))


def _closing_bars(page: Page, walls: Sequence[Rule]) -> list[Rule]:
    """The lower edges of headings' bars on which walls stand: the table's first row has no other rule above it."""
    found = []
    for bar in page.bars:
        on = [w.x0 for w in walls if abs(w.top - bar[3]) <= _SNAP and bar[0] - _SNAP <= w.x0 <= bar[2] + _SNAP]
        if bar[3] - bar[1] < HEADING_BAR and on:
            found.append(Rule(min(*on, bar[0]), bar[3], max(*on, bar[2]), bar[3]))
    return found


def _are_level(row: TableGrid, table: TableGrid) -> bool:
    """Whether a row that stands alone has the columns of a table, or some of them."""
    stops = {x for c in table.cells for x in (c.box[0], c.box[2])}
    return all(any(abs(x - stop) <= _SNAP for stop in stops) for c in row.cells for x in (c.box[0], c.box[2]))


def _edge(rule: Rule) -> dict[str, object]:
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
        if not stops or value - stops[-1] > _SNAP:
            stops.append(value)
    return stops


def _index(stops: Sequence[float], value: float) -> int:
    return min(range(len(stops)), key=lambda i: abs(stops[i] - value))


def _is_frame(grid: TableGrid) -> bool:
    """Frames around blocks of text are no table: a few big cells, each with many lines."""
    crowded = sum(len(c.lines) >= 5 for c in grid.cells)
    return crowded >= 1 and crowded >= 0.3 * sum(bool(c.lines) for c in grid.cells)


def read_grid(
    page: Page, grid: TableGrid, first_row: int, section: str = "", above: Sequence[TextPiece] = ()
) -> list[Statement]:
    """The statements of a table: a value's label is the words to its left, its column the heads above; `above` are
    heads that stand over the table, outside of it."""
    found: list[Statement] = []
    grid = _without_keys(grid)
    heads = _head_rows(page, grid)
    naming = frozenset(heads)
    titles = _titles(grid)
    for row in range(grid.rows):
        cells = _row_cells(grid, row)
        filled = [c for c in cells if c.lines]
        values = [c for c in filled if looks_like_value(c.text)]
        if len(values) == 2 and values[0] is not filled[-1] and all(is_circumstance(p) for p in values[0].pieces):
            values = values[1:]
        if not values and all(split_inline(c.text)[0] for c in filled):
            values = filled
        if not values:
            if len(filled) == 1 and filled[0].columns[1] - filled[0].columns[0] == grid.columns:
                section = " ".join(p.text for p in filled[0].pieces)
                continue
            if not (filled and filled[0].columns[0] == 0 and names_no_columns([c.text for c in filled])):
                heads.append(row)
            continue
        if not _labels(cells, values[0]) and (not heads or row in naming):
            heads.extend([] if row in heads else [row])
            continue
        over = [h for h in heads if h <= row] if row in naming else heads
        read = _read_row(page, grid, row, cells, values, over, first_row + row, section)
        if row in titles:
            read = [replace(f, label=f.label.removeprefix(titles[row]).strip(" :"),
                            context=(*f.context, titles[row])) for f in read]  # fmt: skip
        if above and not heads:
            read = [_headed(f, above) for f in read]
        found.extend(read)
    return found


def columns_of(grid: TableGrid) -> list[tuple[float, float]]:
    """Left and right edges of the columns that hold values."""
    found = {c.columns: c.box for c in grid.cells if c.columns[1] - c.columns[0] == 1 and looks_like_value(c.text)}
    return sorted((box[0], box[2]) for box in found.values())


def _headed(statement: Statement, above: Sequence[TextPiece]) -> Statement:
    """The statement with the heads over its cell; a cell under all of them has none of its own."""
    own = [p for p in above if statement.box[0] <= (p.x0 + p.x1) / 2 <= statement.box[2]]
    if len(own) == len(above) > 1:
        return statement
    unit = next((u for p in own if (u := is_unit(p.bare) or unit_in_label(p.bare)[1])), "")
    column = [p for p in own if not is_unit(p.bare)]
    return replace(
        statement,
        column=tuple(unit_in_label(p.bare)[0] for p in column),
        heads=tuple(p.text for p in column),
        unit=statement.unit or unit,
    )


def _without_keys(grid: TableGrid) -> TableGrid:
    """The grid with the columns of a drawing's keys emptied: letters, symbols or outline numbers, no two alike, beside
    a column of words."""
    keys: set[Cell] = set()
    for column in range(grid.columns - 1):
        cells = [c for c in grid.cells if c.columns[0] == column and c.lines]
        own = [c for c in cells if is_key(c.text)]
        texts = [c.text for c in own]
        numbers = any(t[0].isdigit() for t in texts)
        if len(own) < 3 or len(own) < len(cells) - 1 or len(set(texts)) < len(texts) or all(map(is_unit, texts)):
            continue
        if numbers and not (ascending(texts) and all(_begins(grid, c) for c in own)
                            and all(_worded(grid, c) for c in own)):  # fmt: skip
            continue
        keys.update(own)
    return grid.emptied(keys) if keys else grid


def _begins(grid: TableGrid, key: Cell) -> bool:
    """Whether no words stand left of a cell in its row."""
    left = [grid.at(key.rows[0], column) for column in range(key.columns[0])]
    return not any(c is not None and c.lines and c.rows == key.rows for c in left)


def _worded(grid: TableGrid, key: Cell) -> bool:
    """Whether the cell right of a number holds a label: words, and no unit."""
    beside = grid.at(key.rows[0], key.columns[1])
    return beside is not None and bool(beside.lines) and not (is_unit(beside.text) or looks_like_value(beside.text))


def _titles(grid: TableGrid) -> dict[int, str]:
    """Row → the line that ends in a colon over the label of the first row beside one drawing's key, which holds for all
    of that key's rows: "1 | Machine height: / top of cab", "  | with boom installed"."""
    found: dict[int, str] = {}
    for key in grid.cells:
        if key.rows[1] - key.rows[0] < 2 or not _is_key(key.text):
            continue
        label = grid.at(key.rows[0], key.columns[1])
        first = " ".join(p.bare for p in label.lines[0].pieces) if label is not None and len(label.lines) > 1 else ""
        if first.endswith(":"):
            found.update(dict.fromkeys(range(*key.rows), first.rstrip(" :")))
    return found


def _head_rows(page: Page, grid: TableGrid) -> list[int]:
    """The first rows of quantities that name the columns ("2925 mm arm"): set in bold or shaded, which not all that
    follows is, or spread over columns that part below."""
    found: list[int] = []
    for row in range(grid.rows - 1):
        filled = [c for c in _row_cells(grid, row) if c.lines]
        values = [c for c in filled if looks_like_value(c.text)]
        if not values:
            if found or len(filled) == 1:
                break
            continue
        below = [c for c in grid.cells if c.rows[0] > row and looks_like_value(c.text)]
        wide = all(c.columns[1] - c.columns[0] > 1 and _parts(grid, row, c) for c in values)
        if wide and len(values) == 1 and _labels(filled, values[0]) and values[0].columns[1] == grid.columns:
            break  # one value for all columns
        bold = all(_is_bold(c) for c in filled) and not all(_is_bold(c) for c in below)
        shaded = all(_is_shaded(page, c) for c in filled) and not any(_is_shaded(page, c) for c in below)
        if not below or not (wide or bold or shaded):
            break
        found.append(row)
    return found


def _parts(grid: TableGrid, row: int, cell: Cell) -> bool:
    """Whether values stand side by side below a cell."""
    return any(
        len({c for k in range(*cell.columns) if (c := grid.at(below, k)) is not None and c.lines}) > 1
        for below in range(row + 1, grid.rows)
    )


def _is_bold(cell: Cell) -> bool:
    return all(p.bold for p in cell.pieces if not EXAMPLE.fullmatch(p.text.strip()))


def _is_shaded(page: Page, cell: Cell) -> bool:
    x, y = (cell.box[0] + cell.box[2]) / 2, (cell.box[1] + cell.box[3]) / 2
    return any(b[0] <= x <= b[2] and b[1] <= y <= b[3] for b in page.bars)


def _row_cells(grid: TableGrid, row: int) -> list[Cell]:
    cells = (grid.at(row, column) for column in range(grid.columns))
    return list(dict.fromkeys(c for c in cells if c is not None))


def _labels(cells: Sequence[Cell], value: Cell) -> list[Cell]:
    return [c for c in cells if c.lines and c.columns[1] <= value.columns[0] and not looks_like_value(c.text)]


def _read_row(
    page: Page,
    grid: TableGrid,
    row: int,
    cells: Sequence[Cell],
    values: Sequence[Cell],
    heads: Sequence[int],
    number: int,
    section: str,
) -> list[Statement]:
    labels: list[Cell] = []
    seen = -1
    found = []
    for value in values:
        fresh = [
            c for c in cells if c.lines and not looks_like_value(c.text) and seen < c.columns[0] < value.columns[0]
        ]
        words = [c for c in fresh if not is_unit(c.text) and not _is_key(c.text) and any(t.isalnum() for t in c.text)]
        if words:
            labels = words
        after = labels[-1].columns[0] if labels else -1
        units = [is_unit(c.text) for c in _units_for(value, values, fresh, cells) if c.columns[0] > after]
        seen = value.columns[0]
        over = _heads_over(grid, heads, value, labels)
        found.append(_statement(page, grid, value, labels, over, units[0] if units else "", number, section))
    if heads and row not in heads and not any(f.label for f in found):
        found = [replace(f, variant=(values[0].text,)) for f in found]
    return found


def _heads_over(grid: TableGrid, heads: Sequence[int], value: Cell, labels: Sequence[Cell]) -> list[Cell]:
    """The heads of a value's column; a value across several columns has those that stand over all of them."""
    over: list[Cell] = []
    for row in heads:
        if row > value.rows[0]:
            continue
        above = [grid.at(row, column) for column in range(*value.columns)]
        cell = above[0]
        if any(c is not cell for c in above):
            beyond = [c for c in _row_cells(grid, row) if c.lines and c.columns[0] >= value.columns[1]]
            before = [c for c in _row_cells(grid, row) if c.lines and c.columns[1] <= value.columns[0]]
            named = [c for c in before if not any(c is one for one in labels) and c.columns[0] > _last(labels)]
            if beyond or named:  # one value for some of the columns: it has all of their heads
                over.extend(c for c in dict.fromkeys(above) if c is not None and c.lines)
            continue
        if cell is not None and cell.lines and not any(cell is c for c in (*over, *labels)):
            over.append(cell)
    return over


def _units_for(value: Cell, values: Sequence[Cell], before: Sequence[Cell], cells: Sequence[Cell]) -> list[Cell]:
    """The unit cells that may hold for a value: those before it (after the last value), else any of the row; where each
    value has one after it, that."""
    units = [c for c in cells if c.lines and is_unit(c.text)]
    ends = [*(v.columns[0] for v in values), cells[-1].columns[1] if cells else 0]
    after = [[u for u in units if a < u.columns[0] < b] for a, b in pairwise(ends)]
    if len(values) > 1 and after[0] and sum(bool(u) for u in after) > 1:
        return next(u for v, u in zip(values, after, strict=True) if v is value)
    return [c for c in before if is_unit(c.text)] + units


def _last(labels: Sequence[Cell]) -> int:
    """The last column of a row's labels."""
    return max((c.columns[1] - 1 for c in labels), default=-1)


def _statement(
    page: Page,
    grid: TableGrid,
    value: Cell,
    labels: Sequence[Cell],
    over: Sequence[Cell],
    unit: str,
    number: int,
    section: str,
) -> Statement:
    names = [c for c in labels if not _is_key(c.text)]
    # cells that span more rows than the value are the sub-headings of theirs
    groups = [c for c in names[:-1] if c.rows[1] - c.rows[0] > value.rows[1] - value.rows[0] or _is_group(grid, c)]
    label, own_unit = _label_of([c for c in names if not any(c is g for g in groups)])
    label, label_unit = unit_in_label(without_key(label))
    text = value.text
    if not label:
        inline = split_inline(text)
        label, text = inline if inline[0] else (label, text)
    column = [c for c in over if not is_unit(c.text)]
    head_unit = next((u for c in reversed(over) if (u := is_unit(c.text) or unit_in_label(c.text)[1])), "")
    pieces = [p for c in [*labels, *over, value] for p in c.pieces]
    marked = any(EXAMPLE.search(" ".join(p.text for p in c.pieces)) for c in [*labels, *over, value])
    quote = [line.text for c in [*labels, value] for line in c.lines]
    if not labels:
        quote = [line.text for c in column for line in c.lines] + quote
    return Statement(
        page=page.number,
        row=number,
        label=label,
        text=text,
        box=value.box,
        quote=" … ".join(quote),
        context=tuple(c.text for c in groups),
        section=unit_of_heading(EXAMPLE.sub("", section).strip())[0],
        column=tuple(unit_in_label(c.text)[0] for c in column if c.text),
        unit=unit
        or own_unit
        or label_unit
        or head_unit
        or ("" if COUNTED.search(label) else unit_of_heading(section)[1]),
        example=marked or bool(EXAMPLE.search(section)) or marked_by_footnote(page, pieces),
        x0=value.box[0],
        heads=tuple(line.text for c in column for line in c.lines) if labels else (),
    )


def _label_of(cells: Sequence[Cell]) -> tuple[str, str]:
    """The words of label cells, and the unit that stands apart at the end of the last one, alone or behind the symbol
    of a type sheet: "h1 (mm)", "Ast (mm)"; the symbol is no word, but where it lists a product's factors."""
    texts = [c.text for c in cells]
    last = cells[-1] if cells else None
    if last is None or len(last.lines) != 1:
        return " ".join(texts), ""
    if len(last.pieces) > 1 and (unit := is_unit(last.pieces[-1].bare)):
        return " ".join([*texts[:-1], *(p.bare for p in last.pieces[:-1])]), unit
    symbol, unit = unit_in_label(last.text)
    lists = symbol == "s/e/l" and not _LISTED.search(" ".join(texts[:-1]))
    if len(cells) > 1 and unit and not lists and (is_key(symbol) or _SYMBOL.fullmatch(symbol)):
        return " ".join(texts[:-1]), unit
    return " ".join(texts), ""


_SYMBOL = re.compile(r"[A-Z][a-z]{1,2}\d?")
_LISTED = re.compile(r"[^\W\d]\s?[/／×x]\s?[^\W\d]+\s?[/／×x]\s?[^\W\d]")


def _is_group(grid: TableGrid, cell: Cell) -> bool:
    """Whether a cell stands in a column whose cells span several rows each: a group that has one row only."""
    column = [c for c in grid.cells if c.columns == cell.columns and c.lines]
    return any(c.rows[1] - c.rows[0] > 1 for c in column) and not any(looks_like_value(c.text) for c in column)


def _is_key(text: str) -> bool:
    """A drawing's letter: "A", "B'", "12"."""
    return len(text) <= 2 and (text[:1].isupper() or text.isdigit())
