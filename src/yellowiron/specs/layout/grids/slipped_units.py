"""A table's column of units that the page prints one row too high or too low: "Wheelbase | kg", "Lifting speed | N"."""

from __future__ import annotations

from dataclasses import replace

from yellowiron.specs.language.units import printed_unit
from yellowiron.specs.language.vocabulary import tokens
from yellowiron.specs.layout.grids.table_grid import Cell, TableGrid
from yellowiron.specs.layout.statement import is_unit, unit_in_label

_SAID = {
    "weight": "mass", "wheelbase": "length", "length": "length", "width": "length", "height": "length",
    "radius": "length", "clearance": "length", "diameter": "length", "speed": "speed", "pull": "force",
    "force": "force", "power": "power", "pressure": "pressure", "angle": "angle", "time": "time",
}  # fmt: skip
"""The dimension that a label's word says of its value."""
_ALSO = {"speed": "angular_speed", "force": "mass"}
"""Dimensions that such a word may have, too: a speed in rpm, a pull in kg."""
_FEWEST_ROWS = 12
"""A column with fewer units tells too little."""
_FEWEST_WRONG = 4
"""So many rows have a unit that their label cannot have."""


def units_in_their_rows(grid: TableGrid) -> tuple[TableGrid, frozenset[int]]:
    """The table with a column of units moved to the rows whose labels they fit, and the rows that have another unit by
    that: where they stand some contradict the labels, one row on none does, and more fit."""
    for column in range(1, grid.columns):
        cells = {c.rows[0]: c for c in grid.cells if c.columns == (column, column + 1) and c.rows[1] == c.rows[0] + 1}
        units = {row: unit for row, c in cells.items() if (unit := _unit(c))}
        if len(units) < _FEWEST_ROWS or 2 * len(units) < sum(bool(c.lines) for c in cells.values()):
            continue
        labels = {row: _dimension(grid, row, column) for row in cells}
        found = [_fitting(units, labels, by) for by in (0, 1, -1)]
        (fit, wrong), *moved = found
        for by, (fits, contradicts) in zip((1, -1), moved, strict=True):
            lost = cells[max(cells) if by > 0 else min(cells)].lines
            if wrong >= _FEWEST_WRONG and not contradicts and fits > fit and not lost:
                lines = {row: cells[row - by].lines if row - by in cells else () for row in cells}
                own = set(cells.values())
                put = tuple(replace(c, lines=lines[c.rows[0]]) if c in own else c for c in grid.cells)
                other = frozenset(row for row in cells if units.get(row) != units.get(row - by))
                return replace(grid, cells=put), other
    return grid, frozenset()


def _fitting(units: dict[int, str], labels: dict[int, str], by: int) -> tuple[int, int]:
    """In how many rows the units, so many rows lower, have the dimension that the label says, and in how many not."""
    pairs = [(labels.get(row + by, ""), unit) for row, unit in units.items()]
    said = [(label, found.dimension) for label, unit in pairs if label and (found := printed_unit(unit))]
    fits = sum(own in (label, _ALSO.get(label)) for label, own in said)
    return fits, len(said) - fits


def _unit(cell: Cell) -> str:
    """The unit that a cell is, alone or behind a key: "kg", "h1 (mm)"."""
    unit = is_unit(cell.text) or (unit_in_label(cell.text)[1] if len(cell.text.split()) < 5 else "")
    return unit if "|" not in unit else ""


def _dimension(grid: TableGrid, row: int, column: int) -> str:
    """The one dimension that the words left of a column say in a row; "" where none or several."""
    left = [c for c in (grid.at(row, k) for k in range(column)) if c is not None]
    words = {t for c in left for t in tokens(c.text)}
    said = {_SAID[t] for t in words if t in _SAID}
    return said.pop() if len(said) == 1 and "rpm" not in words else ""
