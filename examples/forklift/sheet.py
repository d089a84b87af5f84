"""Writes `specifications.pdf`: the example forklift's type sheet, a table in the lines of VDI 2198, and a page of
hydraulics.

    python -m forklift.sheet [FOLDER]

Values come from `values.py`. A published one is printed as it is; one of our own carries the words "example value".
What a real sheet has besides (engine, tyres, noise) is our own as well. Same bytes every time.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

from reportlab.lib.colors import Color, HexColor, white
from reportlab.lib.pagesizes import A4
from reportlab.pdfbase.pdfmetrics import stringWidth
from reportlab.pdfgen.canvas import Canvas

from drawing.values import Value

from . import values as v

WIDTH, HEIGHT = A4
MARGIN, PITCH = 40.0, 15.0
INK, GREEN, PALE, GREY = (HexColor(c) for c in ("#1b2226", "#1f6f4a", "#eef3f0", "#76828a"))
REGULAR, BOLD, ITALIC = "Helvetica", "Helvetica-Bold", "Helvetica-Oblique"
EXAMPLE_MARK = "example value"
TITLE = "Example forklift (FD70N class)"
STOPS = (MARGIN, MARGIN + 34, MARGIN + 330, MARGIN + 372, MARGIN + 424, WIDTH - MARGIN)
"""Edges of the table's columns: line, characteristic, symbol, unit, value."""
SOURCE = f"Published values: {v.MAKE} {v.MODEL}: {v.MANUAL}; {v.REVIEW}."
DISCLAIMER = (
    "Made for a software example. Not a document of, nor endorsed by, any manufacturer. Every figure marked "
    '"example value" is our own.'
)

Line = tuple[str, str, str, str, "Value | str"]
"""Line of VDI 2198, characteristic, symbol, unit, value (a text is ours)."""


def text(
    c: Canvas, x: float, y: float, words: str, *, size: float = 7.6, font: str = REGULAR, ink: Color = INK,
    align: str = "l",
) -> float:  # fmt: skip
    """Prints words at a baseline; returns their width."""
    width = stringWidth(words, font, size)
    c.setFont(font, size)
    c.setFillColor(ink)
    c.drawString(x - {"l": 0.0, "c": width / 2, "r": width}[align], y, words)
    return width


def shown(value: Value) -> str:
    """A number as the sheet prints it."""
    return f"{value.value:,.0f}" if value.value == round(value.value) else f"{value.value:g}"


def section(c: Canvas, y: float, words: str) -> float:
    """A section's bar; returns the top of the rows under it."""
    c.setFillColor(GREEN)
    c.rect(MARGIN, y - 14, WIDTH - 2 * MARGIN, 14, stroke=0, fill=1)
    text(c, MARGIN + 6, y - 10.4, words, size=8, font=BOLD, ink=white)
    return y - 14


def table(c: Canvas, y: float, lines: Sequence[Line]) -> float:
    """A ruled table under its head; returns the top of what follows."""
    head: Line = ("Line", "Characteristic", "Symbol", "Unit", f"{v.MODEL} class")
    for index, (number, words, symbol, unit, value) in enumerate((head, *lines)):
        if index % 2:
            c.setFillColor(PALE)
            c.rect(MARGIN, y - PITCH, WIDTH - 2 * MARGIN, PITCH, stroke=0, fill=1)
        c.setStrokeColor(GREY)
        c.setLineWidth(0.4)
        for left, right in pairwise(STOPS):
            c.rect(left, y - PITCH, right - left, PITCH)
        base = y - 10.4
        text(c, STOPS[0] + 5, base, number, ink=GREY)
        text(c, STOPS[1] + 5, base, words)
        text(c, STOPS[2] + 21, base, symbol, align="c", font=ITALIC)
        text(c, STOPS[3] + 26, base, unit, align="c")
        printed = value if isinstance(value, str) else shown(value)
        width = text(c, STOPS[4] + 6, base, printed)
        if index and (isinstance(value, str) or not value.published):
            text(c, STOPS[4] + 10 + width, base, EXAMPLE_MARK, size=5, font=ITALIC, ink=GREY)
        y -= PITCH
    return y - 7


def furniture(c: Canvas, page: int, heading: str) -> float:
    """Head and foot of a page; returns the top of its first table."""
    c.setFillColor(GREEN)
    c.rect(0, HEIGHT - 52, WIDTH, 52, stroke=0, fill=1)
    text(c, MARGIN, HEIGHT - 34, heading, size=17, font=BOLD, ink=white)
    text(c, WIDTH - MARGIN, HEIGHT - 34, TITLE, size=9, ink=white, align="r")
    text(c, MARGIN, 31, SOURCE, size=5.6, ink=GREY)
    text(c, MARGIN, 23, DISCLAIMER, size=5.6, ink=GREY)
    text(c, WIDTH - MARGIN, 23, str(page), size=7, font=BOLD, align="r")
    return HEIGHT - 66


def type_sheet(c: Canvas) -> None:
    """Page 1: the type sheet."""
    y = furniture(c, 1, "Type sheet for industrial trucks, VDI 2198")
    y = section(c, y, "Characteristics")
    y = table(c, y, (
        ("1.5", "Rated capacity", "Q", "kg", v.RATED_CAPACITY),
        ("1.6", "Load centre distance", "c", "mm", v.LOAD_CENTER),
        ("1.8", "Load distance, centre of drive axle to fork", "x", "mm", v.LOAD_DISTANCE),
        ("1.9", "Wheelbase", "y", "mm", v.WHEELBASE),
    ))  # fmt: skip
    y = section(c, y, "Weights")
    y = table(c, y, (
        ("2.1", "Service weight", "", "kg", v.SERVICE_WEIGHT),
        ("2.2", "Axle loading, laden, front / rear", "", "kg", "14,700 / 1,800"),
        ("2.3", "Axle loading, unladen, front / rear", "", "kg", "4,300 / 5,200"),
    ))  # fmt: skip
    y = section(c, y, "Wheels and tyres")
    y = table(c, y, (
        ("", "Tyre outside diameter", "", "mm", v.TYRE_DIAMETER),
        ("3.6", "Tread, front", "b10", "mm", v.FRONT_TREAD),
        ("3.7", "Tread, rear", "b11", "mm", v.REAR_TREAD),
        ("3.2", "Tyre size, front and rear", "", "", v.TYRE_SIZE),
    ))  # fmt: skip
    y = section(c, y, "Simplex mast")
    y = table(c, y, (
        ("4.2", "Height of mast, lowered", "h1", "mm", v.LOWERED_HEIGHT),
        ("4.4", "Lift", "h3", "mm", v.LIFT_HEIGHT),
        ("4.5", "Height of mast, extended", "h4", "mm", v.EXTENDED_HEIGHT),
        ("4.1", "Tilt of mast, forward", "", "°", v.TILT_FORWARD),
        ("4.1", "Tilt of mast, backward", "", "°", v.TILT_BACKWARD),
    ))  # fmt: skip
    y = section(c, y, "Dimensions")
    y = table(c, y, (
        ("4.7", "Height of overhead guard", "h6", "mm", v.GUARD_HEIGHT),
        ("4.19", "Overall length", "l1", "mm", v.OVERALL_LENGTH),
        ("4.20", "Length to face of forks", "l2", "mm", v.LENGTH_TO_FORK),
        ("4.21", "Overall width", "b1", "mm", v.OVERALL_WIDTH),
        ("4.22", "Fork thickness", "s", "mm", v.FORK_THICKNESS),
        ("4.22", "Fork width", "e", "mm", v.FORK_WIDTH),
        ("4.22", "Fork length", "l", "mm", v.FORK_LENGTH),
        ("4.24", "Fork carriage width", "b3", "mm", v.CARRIAGE_WIDTH),
        ("4.31", "Ground clearance below mast", "m1", "mm", v.MAST_CLEARANCE),
    ))  # fmt: skip
    y = section(c, y, "Performance")
    table(c, y, (
        ("5.1", "Travel speed without load", "", "km/h", v.TRAVEL_SPEED),
        ("5.2", "Lift speed without load", "", "m/s", v.LIFT_SPEED),
        ("5.5", "Drawbar pull with load", "", "kN", v.DRAWBAR_PULL),
    ))  # fmt: skip


def hydraulics(c: Canvas) -> None:
    """Page 2: cylinders, pressures, and what has nothing to do with them."""
    y = furniture(c, 2, "Hydraulic system and engine")
    y = section(c, y, "Hydraulic system")
    y = table(c, y, (
        ("", "Main relief pressure", "", "MPa", v.MAIN_PRESSURE),
        ("", "Main pump flow, control flow rate", "", "L/min", v.MAIN_FLOW),
        ("", "Hydraulic oil tank", "", "L", "105"),
    ))  # fmt: skip
    y = section(c, y, "Cylinders, simplex mast")
    y = table(c, y, tuple(
        ("", value.name, "", "mm", value)
        for value in (v.LIFT_BORE, v.LIFT_ROD, v.LIFT_STROKE, v.TILT_BORE, v.TILT_ROD, v.TILT_STROKE, v.STEER_BORE,
                      v.STEER_ROD, v.STEER_STROKE)
    ))  # fmt: skip
    y = section(c, y, "Engine")
    table(c, y, (
        ("7.1", "Engine, cylinders", "", "", "six, in line"),
        ("", "Bore x stroke", "", "mm", "94 x 120"),
        ("7.2", "Engine power according to ISO 1585", "", "kW", "63"),
        ("7.3", "Rated speed", "", "1/min", "2,300"),
        ("8.4", "Noise level at operator's ear", "", "dB(A)", "82"),
    ))  # fmt: skip


def write(path: Path) -> None:
    """Writes the sheet."""
    c = Canvas(str(path), pagesize=A4, invariant=1, pageCompression=0)
    c.setTitle(f"{TITLE}: type sheet")
    c.setAuthor("yellowiron examples")
    c.setSubject("Specification sheet of an example machine")
    for page in (type_sheet, hydraulics):
        page(c)
        c.showPage()
    c.save()


if __name__ == "__main__":
    write((Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent) / "specifications.pdf")
