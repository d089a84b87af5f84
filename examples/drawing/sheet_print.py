"""How the examples' sheets print: numbers in both systems, words, headings, rows, grids with merged cells, pages."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from reportlab.lib.colors import Color, HexColor
from reportlab.lib.pagesizes import A4
from reportlab.pdfbase.pdfmetrics import stringWidth
from reportlab.pdfgen.canvas import Canvas

from .values import Value

WIDTH, HEIGHT = A4
MARGIN = 42.0
FULL = WIDTH - 2 * MARGIN
HALF, SECOND = (FULL - 26) / 2, MARGIN + (FULL - 26) / 2 + 26
"""Of a page in two columns: a column's width, and where the second begins."""
INK, TEAL, MIST, LINE = (HexColor(c) for c in ("#20262b", "#0f5c66", "#e6eff0", "#8fa3a8"))
REGULAR, BOLD, ITALIC = "Times-Roman", "Times-Bold", "Times-Italic"
MARK = "example value"
SIZE = 8.0


# ---- numbers -------------------------------------------------------------------------------------------------------
def grouped(value: float) -> str:
    """1234.5 → "1,234.5", 1234.0 → "1,234"."""
    return f"{value:,.1f}".removesuffix(".0")


def feet(mm: float) -> str:
    """Millimetres as feet and inches: 21'9"."""
    inches = round(mm / 25.4)
    return f"{inches // 12}'{inches % 12}\""


def length(mm: float) -> tuple[str, str]:
    """A length as two cells: ("6,620 mm", "21'9\\"")."""
    return f"{grouped(mm)} mm", feet(mm)


def short(mm: float) -> tuple[str, str]:
    """A short length as two cells, millimetres and inches to a tenth."""
    return f"{grouped(mm)} mm", f'{mm / 25.4:.1f}"'


def mass(kg: float) -> tuple[str, str]:
    """A mass as two cells."""
    return f"{grouped(kg)} kg", f"{grouped(5.0 * round(kg / 0.45359237 / 5))} lb"


def force(kn: float) -> tuple[str, str]:
    """A force as two cells."""
    return f"{grouped(kn)} kN", f"{grouped(10 * round(kn * 22.4809))} lbf"


def pressure(mpa: float) -> tuple[str, str]:
    """A pressure as two cells."""
    return f"{mpa:.1f} MPa", f"{mpa * 145.0377:,.0f} psi"


def flow(litres: float) -> tuple[str, str]:
    """A flow as two cells."""
    return f"{grouped(litres)} L/min", f"{litres / 3.785411784:.1f} gal/min"


def speed(kmh: float) -> tuple[str, str]:
    """A travel speed as two cells."""
    return f"{kmh:.1f} km/h", f"{kmh / 1.609344:.1f} mph"


def torque(knm: float) -> tuple[str, str]:
    """A torque as two cells."""
    return f"{grouped(knm)} kN·m", f"{grouped(10 * round(knm * 73.75621))} lbf·ft"


def litres(n: float) -> tuple[str, str]:
    """A capacity as two cells."""
    return f"{grouped(n)} L", f"{n / 3.785411784:.1f} U.S. gal"


def cells(value: Value) -> tuple[str, ...]:
    """A value as the cells of a row, by its unit."""
    return _CELLS[value.unit](value.value)


_CELLS: dict[str, Callable[[float], tuple[str, ...]]] = {
    "mm": length, "kg": mass, "kN": force, "MPa": pressure, "L/min": flow, "km/h": speed, "kNm": torque, "L": litres,
    "kW": lambda kw: (f"{kw:.0f} kW", f"{kw / 0.7457:.0f} hp"),
    "m3": lambda m3: (f"{m3:.1f} m³", f"{m3 / 0.764555:.1f} yd³"),
    "deg": lambda deg: (f"{deg:.0f}°",),
    "s": lambda s: (f"{s:.1f} s",),
}  # fmt: skip


# ---- words ---------------------------------------------------------------------------------------------------------
def say(
    c: Canvas,
    x: float,
    y: float,
    words: str,
    *,
    size: float = SIZE,
    font: str = REGULAR,
    ink: Color = INK,
    align: str = "l",
) -> float:
    """Prints words at a baseline; returns their width. `align`: l, c or r of `x`."""
    width = float(stringWidth(words, font, size))
    c.setFont(font, size)
    c.setFillColor(ink)
    c.drawString(x - {"l": 0.0, "c": width / 2, "r": width}[align], y, words)
    return width


def prose(c: Canvas, x: float, y: float, words: str, width: float, *, size: float = SIZE) -> float:
    """Prints wrapped text; returns the baseline below it."""
    line = ""
    for word in words.split():
        longer = f"{line} {word}".strip()
        if stringWidth(longer, REGULAR, size) > width:
            say(c, x, y, line, size=size)
            y, longer = y - 1.3 * size, word
        line = longer
    say(c, x, y, line, size=size)
    return y - 1.3 * size


def heading(c: Canvas, x: float, y: float, words: str, width: float) -> float:
    """A section's heading in colour over a thick rule; returns the first baseline under it."""
    say(c, x, y, words, size=10.5, font=BOLD, ink=TEAL)
    c.setStrokeColor(TEAL)
    c.setLineWidth(1.4)
    c.line(x, y - 4, x + width, y - 4)
    return y - 18


@dataclass(frozen=True, slots=True)
class Line:
    """A row: label, metric and imperial cell; `ours` prints the mark behind the label, `under` stands it in under the
    label above. Without cells it is a sub-heading."""

    label: str
    cells: tuple[str, ...] = ()
    ours: bool = False
    under: bool = False


def lines(c: Canvas, x: float, y: float, rows: Sequence[Line], width: float) -> float:
    """Rows held apart by space alone, metric and imperial in columns of their own; returns the next heading's line."""
    for row in rows:
        start = x + (10 if row.under else 0)
        used = say(c, start, y, row.label)
        if row.ours:
            say(c, start + used + 4, y, MARK, size=5.2, font=ITALIC, ink=TEAL)
        if len(row.cells) == 1:
            say(c, x + width, y, row.cells[0], align="r")
        elif row.cells:
            say(c, x + width - 72, y, row.cells[0], align="r")
            say(c, x + width, y, row.cells[1], align="r")
        y -= 12.6
    return y - 8


# ---- grids ---------------------------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class Cell:
    """One cell of a grid: its lines of text, how many columns and rows it spans; `head` is shaded and bold; `mark`
    prints the mark as its last line; `align` l or c."""

    words: tuple[str, ...]
    across: int = 1
    down: int = 1
    head: bool = False
    mark: bool = False
    align: str = "c"


def grid(
    c: Canvas, left: float, top: float, widths: Sequence[float], rows: Sequence[Sequence[Cell]], height: float
) -> float:
    """A table with every cell boxed; a row lists only the cells that begin in it. Returns its bottom."""
    edges = [left]
    for width in widths:
        edges.append(edges[-1] + width)
    taken: set[tuple[int, int]] = set()
    for number, row in enumerate(rows):
        column = 0
        for cell in row:
            while (number, column) in taken:
                column += 1
            taken |= {(number + i, column + j) for i in range(cell.down) for j in range(cell.across)}
            x0, x1 = edges[column], edges[column + cell.across]
            y1 = top - number * height
            _cell(c, x0, y1 - cell.down * height, x1, y1, cell)
            column += cell.across
    return top - len(rows) * height


def _cell(c: Canvas, x0: float, y0: float, x1: float, y1: float, cell: Cell) -> None:
    c.setStrokeColor(LINE)
    c.setLineWidth(0.6)
    c.setFillColor(MIST)
    c.rect(x0, y0, x1 - x0, y1 - y0, stroke=1, fill=1 if cell.head else 0)
    font = BOLD if cell.head else REGULAR
    count = len(cell.words) + (0.75 if cell.mark else 0.0)
    pitch = 9.2
    y = (y0 + y1) / 2 + pitch * count / 2 - 0.82 * pitch
    for words in cell.words:
        if cell.align == "c":
            say(c, (x0 + x1) / 2, y, words, size=7.6, font=font, align="c")
        else:
            say(c, x0 + 5, y, words, size=7.6, font=font)
        y -= pitch
    if cell.mark:
        y += 1.5
        if cell.align == "c":
            say(c, (x0 + x1) / 2, y, MARK, size=5.2, font=ITALIC, ink=TEAL, align="c")
        else:
            say(c, x0 + 5, y, MARK, size=5.2, font=ITALIC, ink=TEAL)


# ---- sheets ---------------------------------------------------------------------------------------------------------
OURS = 'Figures marked "example value" were chosen for this example: plausible for the class, published by nobody.'


def opening(c: Canvas, title: str, source: str) -> float:
    """The head of a sheet: its title, where its values are from, what is ours; returns the first heading's line."""
    say(c, MARGIN, HEIGHT - 60, title, size=20, font=BOLD, ink=TEAL)
    y = prose(c, MARGIN, HEIGHT - 80, source, FULL, size=8)
    return prose(c, MARGIN, y, OURS, FULL, size=8) - 12


def value_lines(
    c: Canvas, x: float, y: float, rows: Iterable[tuple[str, Value]], shown: Callable[[Value], tuple[str, ...]] = cells
) -> float:
    """Rows of values in a column, as they are `shown`, marked where they are ours; returns the next heading's line."""
    return lines(c, x, y, [Line(label, shown(o), ours=not o.published) for label, o in rows], HALF)


def cylinder_table(
    c: Canvas, x: float, y: float, width: float, rows: Iterable[tuple[str, int, tuple[Value, Value, Value]]]
) -> float:
    """The hydraulic cylinders, name, number, (stroke, bore, rod diameter) each, all of them ours; returns the table's
    bottom."""
    heads = ("Cylinder", "No.", "Stroke", "Bore", "Rod dia.")
    table = [[Cell((head,), head=True, mark=head in heads[2:]) for head in heads]]
    for name, number, sizes in rows:
        words = [f"{grouped(size.value)} mm" for size in sizes]
        table.append([Cell((name,), align="l"), Cell((str(number),)), *(Cell((word,)) for word in words)])
    return grid(c, x, y, [width / 5] * 5, table, 21)


def write_pages(path: Path, title: str, *pages: Callable[[Canvas], None]) -> None:
    """Writes a sheet; the same bytes every time."""
    c = Canvas(str(path), pagesize=A4, invariant=1, pageCompression=0)
    c.setTitle(f"{title}: technical data")
    c.setAuthor("yellowiron examples")
    for page in pages:
        page(c)
        c.showPage()
    c.save()
