"""A page's text as it lies there: pieces of lines with their boxes, for a reader that knows no layouts."""

from __future__ import annotations

from dataclasses import dataclass, replace

from yellowiron.specs.layout.rows.headings import body_size, is_heading
from yellowiron.specs.layout.rows.lines import lines_of
from yellowiron.specs.layout.statement import kind_of, scaled
from yellowiron.specs.pages.strokes import Box
from yellowiron.specs.pages.words import Page


@dataclass(frozen=True)
class Cell:
    """A piece of a line: `text` with its footnote signs, `bare` without; `kind` as `kind_of` says; `heading`: set as
    one. `line` counts the page's lines from the top."""

    page: int
    line: int
    text: str
    bare: str
    box: Box
    size: float
    kind: str
    heading: bool

    def in_points(self, unit: float) -> Cell:
        """The cell in points, read in units of so many points."""
        return replace(self, box=scaled(self.box, unit), size=unit * self.size)


def cells_of(page: Page) -> tuple[Cell, ...]:
    """The cells of a page, line by line and from left to right."""
    size = body_size(page.words)
    lines = lines_of(page.words, [r for r in page.rules if not r.horizontal])
    return tuple(
        Cell(page.number, number, p.printed, p.bare, p.box, p.size, kind_of(p), p.bold or is_heading(p, size))
        for number, line in enumerate(lines)
        for p in line.pieces
    )
