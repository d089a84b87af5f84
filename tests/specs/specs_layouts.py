"""Small sheets in the layouts that makers use, drawn on the fly: what the extraction tests read.

Numbers are those of published specifications, each machine's source named where it is used. Nothing of a maker's
document but its numbers is in here.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from reportlab.lib.colors import HexColor, white
from reportlab.lib.pagesizes import A4
from reportlab.pdfbase.pdfmetrics import stringWidth
from reportlab.pdfgen.canvas import Canvas

from yellowiron.model.template import JointTemplate, Template, Wanted

WIDTH, HEIGHT = A4
Row = Sequence[str]
"""A label and its cells."""


def canvas(path: Path) -> Canvas:
    return Canvas(str(path), pagesize=A4, invariant=1)


def put(
    c: Canvas, x: float, y: float, words: str, *, size: float = 8, bold: bool = False, right: bool = False
) -> float:
    font = "Helvetica-Bold" if bold else "Helvetica"
    c.setFont(font, size)
    c.setFillColor(HexColor("#202020"))
    (c.drawRightString if right else c.drawString)(x, y, words)
    return stringWidth(words, font, size)


def bar(c: Canvas, x: float, y: float, words: str, width: float) -> None:
    c.setFillColor(HexColor("#404040"))
    c.rect(x, y - 4, width, 13, stroke=0, fill=1)
    c.setFont("Helvetica-Bold", 8)
    c.setFillColor(white)
    c.drawString(x + 4, y, words)


def lattice(
    c: Canvas, x: float, y: float, widths: Sequence[float], rows: Sequence[Row], *, pitch: float = 16, heads: int = 1
) -> float:
    """A full grid. A cell None merges with the one above it, "<" with the one to its left; "\\n" breaks a line."""
    edges = [x]
    for width in widths:
        edges.append(edges[-1] + width)
    tops = [y]
    for row in rows:
        lines = max(cell.count("\n") + 1 for cell in row if cell)
        tops.append(tops[-1] - max(pitch, 5 + 9.5 * lines))
    c.setLineWidth(0.5)
    for i, row in enumerate(rows):
        for j, cell in enumerate(row):
            if cell is None or cell == "<":
                continue
            last_row, last_column = i + 1, j + 1
            while last_row < len(rows) and rows[last_row][j] is None:
                last_row += 1
            while last_column < len(row) and row[last_column] == "<":
                last_column += 1
            c.rect(edges[j], tops[last_row], edges[last_column] - edges[j], tops[i] - tops[last_row])
            lines = cell.split("\n")
            middle = (tops[i] + tops[last_row]) / 2 + 4.75 * (len(lines) - 1) - 3
            for k, line in enumerate(lines):
                put(c, edges[j] + 3, middle - 9.5 * k, line, size=7.5, bold=i < heads)
    return tops[-1]


def leaders(c: Canvas, x: float, y: float, width: float, rows: Sequence[Row], *, pitch: float = 12) -> float:
    """Label, dots, value flush right."""
    for label, value in rows:
        start = x + put(c, x, y, label) + 3
        end = x + width - put(c, x + width, y, value, right=True) - 3
        put(c, end, y, "." * max(int((end - start) / stringWidth(".", "Helvetica", 8)), 0), right=True)
        y -= pitch
    return y


def ruled(
    c: Canvas, x: float, y: float, stops: Sequence[float], rows: Sequence[Row], *, pitch: float = 13, heads: int = 0
) -> float:
    """Horizontal rules only; the cells after the label end at `stops`. "\\n" breaks the label."""
    for index, row in enumerate(rows):
        lines = row[0].split("\n")
        for cell, stop in zip(row[1:], stops, strict=False):
            put(c, stop, y - 4.5 * (len(lines) - 1), cell, right=True, bold=index < heads)
        for line in lines:
            put(c, x, y, line, bold=index < heads)
            y -= 9
        y += 9
        c.setLineWidth(0.3)
        c.line(x, y - 3.5, stops[-1], y - 3.5)
        y -= pitch
    return y


def borderless(
    c: Canvas, x: float, y: float, stops: Sequence[float], rows: Sequence[Row], *, pitch: float = 11
) -> float:
    """No rules, no dots: cells begin at `stops`. "\\n" breaks the label."""
    for row in rows:
        *first, last = row[0].split("\n")
        for line in first:
            put(c, x, y, line)
            y -= pitch
        put(c, x, y, last)
        for cell, stop in zip(row[1:], stops, strict=False):
            put(c, stop, y, cell)
        y -= pitch
    return y


def wanted(name: str, dimension: str, *synonyms: str, **more: object) -> Wanted:
    """A wanted value made by hand."""
    return Wanted(name=name, dimension=dimension, synonyms={"en": synonyms}, **more)  # type: ignore[arg-type]


def template(*values: Wanted, joints: tuple[JointTemplate, ...] = ()) -> Template:
    """A template that asks for these values and no more."""
    return Template("test_machine", "", "base", (), joints, wanted=values)
