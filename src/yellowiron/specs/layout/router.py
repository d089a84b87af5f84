"""The router: which part of a page is a drawn table, which a column of rows, and their statements in reading order."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from yellowiron.specs.language.numbers import read
from yellowiron.specs.layout.captions import captioned
from yellowiron.specs.layout.grids.lattice import grids_of
from yellowiron.specs.layout.grids.nested_rows import read_boxes
from yellowiron.specs.layout.grids.partly_ruled import heads_above
from yellowiron.specs.layout.grids.table_grid import TableGrid
from yellowiron.specs.layout.grids.table_reader import columns_of, read_grid
from yellowiron.specs.layout.rows.cells import footnotes_of
from yellowiron.specs.layout.rows.headings import Heading, body_size
from yellowiron.specs.layout.rows.legends import key_legend, labelled, spelled, without_keys
from yellowiron.specs.layout.rows.lines import TextLine, blocks_of, lines_of
from yellowiron.specs.layout.rows.row_reader import read_block
from yellowiron.specs.layout.statement import (
    COUNTED,
    Statement,
    is_unit,
    kind_of,
    unit_noted,
    unit_said,
    without_last_keys,
)
from yellowiron.specs.pages.strokes import Box
from yellowiron.specs.pages.words import Page, Word


def statements_of(page: Page) -> list[Statement]:
    """Every value that a page prints, with the words that say what it is.

    Vertical rules: the cells of the drawn grid. Horizontal rules only: what stands between two of them is a row. No
    rules: rows by gaps and overlap.
    """
    lines = lines_of(page.words)
    keys = key_legend(lines)
    notes = _footnote_words(lines, body_size(page.words))
    page = replace(page, words=tuple(w for w in page.words if w not in notes))
    page = replace(spelled(page, keys), footnotes=footnotes_of(lines))
    under_captions, taken = captioned(page, 1000 * page.number)
    if taken:
        page = replace(page, words=tuple(w for w in page.words if w not in taken))
    grids = grids_of(page)
    outside = [
        w
        for w in page.words
        if not any(
            g.box[0] - 1 <= (w.x0 + w.x1) / 2 <= g.box[2] + 1 and g.box[1] - 1 <= (w.top + w.bottom) / 2 <= g.box[3] + 1
            for g in grids
        )
    ]
    found = under_captions
    row = 1000 * page.number + len(found)
    walls = [r for r in page.rules if not r.horizontal]
    headings: list[Heading] = []
    across = [*page.leaders, *((r.x0, r.top, r.x1, r.bottom) for r in page.rules if r.horizontal)]
    bars = [b for b in page.bars if not any(_within(b, g.box) for g in grids)]
    for block in blocks_of(without_keys(lines_of(outside, walls)), bars, across):
        statements, more = read_block(
            page, block, row, _heading_above(headings, block.lines[0].top, block.x0, block.x1)
        )
        headings.extend(more)
        row += len(statements) + len(block.lines) + 1
        found.extend(statements)
    free, boxes = lines_of(outside) if grids else [], [g.box for g in grids]
    for grid in grids:
        title = _title(free, grid) or _heading_above(headings, grid.box[1], grid.box[0], grid.box[2])
        if unit := _unit_above(free, grid):
            title = f"{title} ({unit})".strip()
        filled = read_boxes(page, grid, row, title)
        row += len(filled.statements)
        found.extend(filled.statements)
        above = heads_above(free, grid.box, columns_of(grid), boxes)
        found.extend(read_grid(page, filled.grid, row, title, above))
        row += grid.rows + 1
    return _in_noted_unit(without_last_keys(labelled(found, keys)), lines)


_LEAST_NOTED = 100.0
"""Bare numbers under this may count things, whatever unit a note gives."""


def _in_noted_unit(statements: Sequence[Statement], lines: Sequence[TextLine]) -> list[Statement]:
    """The statements, bare numbers in the unit of length that the nearest note under them or over them gives, in their
    column of the page: "All dimensions are in mm"."""
    notes = [(p.box, unit) for line in lines for p in line.pieces if (unit := unit_noted(p.bare))]
    if not notes:
        return list(statements)
    return [_noted(s, notes) for s in statements]


def _noted(statement: Statement, notes: Sequence[tuple[Box, str]]) -> Statement:
    readings = read(statement.text)
    numbers = [q for r in readings for q in r.numbers]
    if statement.unit or COUNTED.search(statement.label) or any(q.unit or q.value < _LEAST_NOTED for q in numbers):
        return statement
    box = statement.box
    beside = [(abs(b[1] - box[1]), unit) for b, unit in notes if len({u for _, u in notes}) == 1 or b[0] < box[2]]
    return replace(statement, unit=min(beside)[1]) if numbers and beside else statement


_NOTE = re.compile(r"[\u00b9\u00b2\u00b3\u2070-\u2079*†‡§]+[)]?|[(\[]?\d[)\]]")


def _footnote_words(lines: Sequence[TextLine], size: float) -> frozenset[Word]:
    """The words of footnotes: small print behind a sign. They tell circumstances, and no values."""
    found: set[Word] = set()
    for line in lines:
        first = next(
            (i for i, p in enumerate(line.pieces) if _NOTE.fullmatch(p.words[0].text) and len(p.words) > 3), None
        )
        if first is not None and all(w.size < 0.92 * size for p in line.pieces[first:] for w in p.words):
            found.update(w for p in line.pieces[first:] for w in p.words)
    return frozenset(found)


def _within(inner: Box, outer: Box) -> bool:
    return all(a >= b - 1 for a, b in zip(inner[:2], outer[:2], strict=True)) and all(
        a <= b + 1 for a, b in zip(inner[2:], outer[2:], strict=True)
    )


def _title(lines: Sequence[TextLine], grid: TableGrid) -> str:
    """The words right above a table: one bold or larger piece over its left part."""
    box = grid.box
    sizes = sorted(p.size for c in grid.cells for p in c.pieces)
    over = [line for line in lines if 0 <= box[1] - line.bottom < 1.2 * line.pieces[0].size]
    for line in over:
        piece = line.pieces[0]
        if (
            len(line.pieces) == 1
            and (piece.bold or piece.size > 1.1 * sizes[len(sizes) // 2])
            and box[0] - 4 <= piece.x0 < (box[0] + box[2]) / 2
            and kind_of(piece) == "text"
        ):
            return piece.text
    return ""


def _unit_above(lines: Sequence[TextLine], grid: TableGrid) -> str:
    """The unit that a line right above a table gives for its bare numbers, or that stands over its only column of
    them."""
    box, columns = grid.box, columns_of(grid)
    over = [p for line in lines for p in line.pieces if -2 <= box[1] - p.box[3] < 1.5 * p.size]
    said = next((u for p in over if p.x1 > box[0] and p.x0 < box[2] and (u := unit_said(p.bare))), "")
    if said or len(columns) != 1:
        return said
    x0, x1 = columns[0]
    return next((u for p in over if x0 <= (p.x0 + p.x1) / 2 <= x1 and (u := is_unit(p.bare))), "")


def _heading_above(headings: list[Heading], top: float, x0: float, x1: float) -> str:
    """The nearest heading above a place, in a column of text that it overlaps."""
    above = [h for h in headings if h.bottom <= top + 2 and h.x0 < x1 and x0 < h.x1]
    return max(above, key=lambda h: h.bottom).text if above else ""
