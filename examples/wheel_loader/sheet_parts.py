"""The parts a specification sheet is put together from: numbers in both systems, text, bars, rows and grids."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from reportlab.lib.colors import Color, HexColor, white
from reportlab.lib.pagesizes import A4
from reportlab.pdfbase.pdfmetrics import stringWidth
from reportlab.pdfgen.canvas import Canvas

from .values import Value

WIDTH, HEIGHT = A4
MARGIN, GUTTER = 36.0, 22.0
COLUMN = (WIDTH - 2 * MARGIN - GUTTER) / 2
LEFT, RIGHT = MARGIN, MARGIN + COLUMN + GUTTER
INK, SLATE, AMBER, PALE, GREY = (HexColor(c) for c in ("#1d2429", "#35424a", "#e8a317", "#f1f3f4", "#7b868d"))
REGULAR, BOLD, ITALIC = "Helvetica", "Helvetica-Bold", "Helvetica-Oblique"
EXAMPLE_MARK = "example value"
PITCH = 14.2
"""Points from row to row."""


# ---- numbers as a brochure prints them -----------------------------------------------------------------------------
def grouped(value: float, decimals: int = 0) -> str:
    """1234.5 → "1,234.5"."""
    return f"{value:,.{decimals}f}"


def feet(mm: float) -> str:
    """Millimetres as feet and inches: 14'4"."""
    inches = round(mm / 25.4)
    return f"{inches // 12}'{inches % 12}\""


def inches(mm: float) -> str:
    """Millimetres as inches to a tenth, without the unit."""
    return f"{mm / 25.4:.1f}"


def pounds(kg: float) -> str:
    """Kilograms as pounds to the nearest 5."""
    return grouped(5 * round(kg / 0.45359237 / 5))


def yards(m3: float) -> str:
    """Cubic metres as cubic yards."""
    return f"{m3 / 0.764554857984:.1f}"


def gallons(litres: float, decimals: int = 0) -> str:
    """Litres as US gallons."""
    return grouped(litres / 3.785411784, decimals)


def psi(mpa: float) -> str:
    """Megapascals as pounds a square inch."""
    return grouped(mpa / 0.00689475729)


def dual_mm(value: Value) -> str:
    """A short length in both systems: 90 mm (3.5 in)."""
    return f"{grouped(value.value)} mm ({inches(value.value)} in)"


def dual_pressure(value: Value) -> str:
    """A pressure in both systems."""
    return f"{value.value} MPa ({psi(value.value)} psi)"


def dual_flow(value: Value) -> str:
    """A flow in both systems."""
    return f"{value.value:.0f} L/min ({gallons(value.value, 1)} gal/min)"


def bore_by_stroke(count: Value, bore: Value, stroke: Value) -> str:
    """ "2 - 150 x 764 mm"."""
    return f"{count.value:.0f} - {bore.value:.0f} x {stroke.value:.0f} mm"


# ---- drawing -------------------------------------------------------------------------------------------------------
def text(
    c: Canvas,
    x: float,
    y: float,
    words: str,
    *,
    size: float = 7.2,
    font: str = REGULAR,
    ink: Color = INK,
    align: str = "l",
) -> float:
    """Prints words at a baseline; returns their width. `align`: l, c or r of `x`."""
    width = stringWidth(words, font, size)
    c.setFont(font, size)
    c.setFillColor(ink)
    c.drawString(x - {"l": 0.0, "c": width / 2, "r": width}[align], y, words)
    return width


def paragraph(c: Canvas, x: float, y: float, words: str, width: float, *, size: float = 7.2, ink: Color = INK) -> float:
    """Prints wrapped text; returns the baseline below it."""
    line = ""
    for word in words.split():
        longer = f"{line} {word}".strip()
        if stringWidth(longer, REGULAR, size) > width:
            text(c, x, y, line, size=size, ink=ink)
            y, longer = y - 1.35 * size, word
        line = longer
    text(c, x, y, line, size=size, ink=ink)
    return y - 1.35 * size


def bar(c: Canvas, x: float, y: float, words: str, width: float = COLUMN) -> float:
    """A section's bar with its top at `y`; returns the first baseline under it."""
    c.setFillColor(SLATE)
    c.rect(x, y - 14, width, 14, stroke=0, fill=1)
    c.setFillColor(AMBER)
    c.rect(x, y - 14, 4, 14, stroke=0, fill=1)
    text(c, x + 10, y - 10.2, words, size=8, font=BOLD, ink=white)
    return y - 25


def rule(c: Canvas, x0: float, y: float, x1: float, *, weight: float = 0.4, ink: Color = GREY) -> None:
    """A horizontal rule."""
    c.setStrokeColor(ink)
    c.setLineWidth(weight)
    c.line(x0, y, x1, y)


@dataclass(frozen=True, slots=True)
class Row:
    """A label and what is printed beside it; `ours` prints the mark. `label` may have a second line."""

    label: str
    value: str
    ours: bool = False


def leader_rows(c: Canvas, x: float, y: float, rows: Sequence[Row], width: float = COLUMN) -> float:
    """Rows with dotted leaders, no rules; returns the next bar's top."""
    for row in rows:
        *head, last = row.label.split("\n")
        for line in head:
            text(c, x, y, line)
            y -= 9
        start = x + text(c, x, y, last) + 3
        right = x + width
        if row.ours:
            right -= text(c, right, y, EXAMPLE_MARK, size=5, font=ITALIC, ink=GREY, align="r") + 3
        end = right - text(c, right, y, row.value, align="r") - 3
        dots = int((end - start) / stringWidth(".", REGULAR, 7.2))
        text(c, end, y, "." * dots, ink=GREY, align="r")
        y -= PITCH
    return y - 6


def ruled_rows(c: Canvas, x: float, y: float, rows: Sequence[Row], width: float = COLUMN) -> float:
    """Rows with a hair rule under each; returns the next bar's top."""
    for row in rows:
        lines = row.label.split("\n")
        value_y = y - 4.5 * (len(lines) - 1)
        right = x + width
        if row.ours:
            right -= text(c, right, value_y, EXAMPLE_MARK, size=5, font=ITALIC, ink=GREY, align="r") + 3
        text(c, right, value_y, row.value, align="r")
        for line in lines:
            text(c, x, y, line)
            y -= 9
        y += 4.5
        rule(c, x, y, x + width, weight=0.3)
        y -= PITCH - 4.5
    return y - 5


def grid_row(c: Canvas, edges: Sequence[float], y: float, height: float) -> None:
    """The boxes of a table's row, its top at `y`."""
    c.setStrokeColor(GREY)
    c.setLineWidth(0.5)
    for x0, x1 in pairwise(edges):
        c.rect(x0, y - height, x1 - x0, height)
