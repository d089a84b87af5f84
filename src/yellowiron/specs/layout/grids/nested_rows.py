"""Cells of a drawn table that hold rows of their own: "Bore: 108 mm" under "Stroke: 130 mm"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from yellowiron.specs.layout.grids.table_grid import Cell, TableGrid
from yellowiron.specs.layout.rows.cells import ValueCell, statement_of
from yellowiron.specs.layout.rows.lines import TextLine, blocks_of
from yellowiron.specs.layout.rows.row_reader import read_block
from yellowiron.specs.layout.statement import (
    EXAMPLE,
    Statement,
    TextPiece,
    kind_of,
    looks_like_value,
    split_inline,
    unit_of_heading,
)
from yellowiron.specs.pages.words import Page

_LEVEL = 3.0
"""Points within which the left edges of a column lie."""
_FEWEST = 2
"""Rows in a cell; one value with its label may be a value with words."""


@dataclass(frozen=True)
class Filled:
    """A table whose cells with rows of their own are read and emptied, and what they say."""

    grid: TableGrid
    statements: tuple[Statement, ...]


def read_boxes(page: Page, grid: TableGrid, first_row: int, section: str) -> Filled:
    """Reads the cells that hold rows as blocks of text, under the words of the cell to their left or right above."""
    emptied: set[Cell] = set()
    found: list[Statement] = []
    page = replace(page, rules=())  # those of the table part none of the rows in its cells
    if not _mostly_boxes(grid):
        return Filled(grid, ())
    for cell in grid.cells:
        if not _holds_rows(cell):
            continue
        title = _title_of(grid, cell)
        heading = " ".join(p.text for p in title.pieces) if title is not None else section
        pieces = [p for line in cell.lines for p in line.pieces]
        if 2 * sum(_names(p) for p in pieces) >= len(pieces):
            found.extend(_read_items(page, cell, first_row + len(found), heading))
        else:
            for block in blocks_of(cell.lines):
                statements, _ = read_block(page, block, first_row + len(found), heading)
                found.extend(statements)
        emptied.update(c for c in (cell, title) if c is not None)
    return Filled(grid.emptied(emptied), tuple(found))


def _read_items(page: Page, cell: Cell, first_row: int, heading: str) -> list[Statement]:
    """The statements of a cell of "label: value", one below the other in columns; either may go on in the next line."""
    columns: list[list[TextPiece]] = []
    for piece in (p for line in cell.lines for p in line.pieces):
        near = next((c for c in columns if abs(c[0].x0 - piece.x0) <= _LEVEL), None)
        if near is None:
            columns.append([piece])
        else:
            near.append(piece)
    items: list[list[TextPiece]] = []
    for column in columns:
        done = True
        for piece in column:
            begins = bool(split_inline(piece.bare)[0]) or kind_of(piece) == "text"
            if done and begins:
                items.append([piece])
            elif items and items[-1][-1] in column and (not done or piece.bare.startswith("(")):
                items[-1].append(piece)
            else:
                continue
            done = bool(split_inline(" ".join(p.bare for p in items[-1]))[0])
    section, unit = unit_of_heading(EXAMPLE.sub("", heading).strip())
    found = []
    for number, item in enumerate(items):
        text = " ".join(p.bare for p in item)
        if not split_inline(text)[0]:
            continue
        lines = [TextLine((p,)) for p in item]
        statement = statement_of(page, lines, ValueCell([], item), (), (), (), first_row + number)
        marked = any(EXAMPLE.search(t) for t in (heading, *(p.text for p in item)))
        found.append(replace(statement, section=section, unit=statement.unit or unit,
                             example=statement.example or marked))  # fmt: skip
    return found


def _mostly_boxes(grid: TableGrid) -> bool:
    """Whether two or more cells hold rows, and more than are plain values."""
    boxes = sum(_holds_rows(c) and len(_rows_of(c)) >= _FEWEST for c in grid.cells)
    plain = sum(looks_like_value(c.text) for c in grid.cells)
    return boxes >= _FEWEST and boxes > plain


def _holds_rows(cell: Cell) -> bool:
    """Whether every line of a cell says something whole, or goes on with the line before."""
    rows = _rows_of(cell)
    return bool(rows) and 3 * len(rows) >= 2 * len(cell.lines) and not looks_like_value(cell.text)


def _rows_of(cell: Cell) -> list[TextLine]:
    return [line for line in cell.lines if _is_row(line.pieces)]


def _is_row(pieces: Sequence[TextPiece]) -> bool:
    """Whether a line has a label with its value, in one piece or beside each other."""
    if any(_names(p) for p in pieces):
        return True
    kinds = [kind_of(p) for p in pieces]
    return kinds[0] == "text" and "value" in kinds[1:]


def _names(piece: TextPiece) -> bool:
    """Whether a piece has a label before a value, which may be on the next line."""
    return bool(split_inline(piece.bare)[0]) or piece.bare.endswith((":", "："))


def _title_of(grid: TableGrid, cell: Cell) -> Cell | None:
    """The cell that heads one with rows: the only words beside it, else those right above it."""
    row, column = cell.rows[0], cell.columns[0]
    for place in ((row, column - 1), (row - 1, column)):
        beside = grid.at(*place)
        if beside is not None and beside.lines and not _holds_rows(beside) and not looks_like_value(beside.text):
            return beside
    return None
