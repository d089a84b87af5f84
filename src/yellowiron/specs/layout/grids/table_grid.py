"""The cells of a table on a grid of rows and columns."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

from yellowiron.specs.layout.rows.lines import TextLine
from yellowiron.specs.layout.statement import EXAMPLE, TextPiece, joined
from yellowiron.specs.pages.strokes import Box


@dataclass(frozen=True)
class Cell:
    """A cell with the rows and columns of the grid that it covers (first, last + 1) and its words."""

    box: Box
    rows: tuple[int, int]
    columns: tuple[int, int]
    lines: tuple[TextLine, ...] = ()

    @functools.cached_property
    def pieces(self) -> tuple[TextPiece, ...]:
        """All its pieces, line by line."""
        return tuple(p for line in self.lines for p in line.pieces)

    @functools.cached_property
    def text(self) -> str:
        """All its words without footnote signs and example marks."""
        return EXAMPLE.sub("", joined(" ".join(p.bare for p in line.pieces) for line in self.lines)).strip()


@dataclass(frozen=True)
class TableGrid:
    """A table: its cells on a grid of `rows` × `columns`."""

    box: Box
    cells: tuple[Cell, ...]
    rows: int
    columns: int

    @functools.cached_property
    def places(self) -> Mapping[tuple[int, int], Cell]:
        """The cells by the grid positions that they cover."""
        return {place: c for c in self.cells for place in itertools.product(range(*c.rows), range(*c.columns))}

    def at(self, row: int, column: int) -> Cell | None:
        """The cell that covers a grid position."""
        return self.places.get((row, column))

    def emptied(self, cells: Collection[Cell]) -> TableGrid:
        """The table with no words in some of its cells."""
        return replace(self, cells=tuple(replace(c, lines=()) if c in cells else c for c in self.cells))
