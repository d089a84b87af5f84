"""Prints the skid steer's sheet in the lines of the maker's: what is published, and beside it, marked, what is ours."""

from __future__ import annotations

from pathlib import Path

from reportlab.lib.pagesizes import A4
from reportlab.pdfgen.canvas import Canvas

from drawing.values import Value
from excavator.sheet_print import (
    BOLD,
    TEAL,
    Cell,
    Line,
    flow,
    grid,
    heading,
    lines,
    pressure,
    prose,
    say,
    short,
    speed,
)

from . import values as v

WIDTH, HEIGHT = A4
MARGIN = 42.0
HALF = (WIDTH - 2 * MARGIN - 26) / 2
TITLE = f"Example skid steer loader, {v.MODEL} class"
SOURCE = (
    f"Published values are those of the {v.MAKE} {v.MODEL}: {v.FACTS}; printed there in inches and pounds. "
    f"Dimensions after ISO 7131. Tyres {v.TYRE_SIZE}. Not a publication of the maker."
)
MARKED = 'Figures marked "example value" were chosen for this example: plausible for the class, published by nobody.'
Rows = tuple[tuple[str, Value], ...]


def _cells(value: Value) -> tuple[str, ...]:
    if value.unit == "deg":
        return (f"{value.value:.0f}°",)
    if value.unit == "kg":
        return f"{value.value:,.0f} kg", f"{value.value / v.POUND:,.0f} lb"
    return short(value.value)


def _rows(c: Canvas, x: float, y: float, rows: Rows) -> float:
    return lines(c, x, y, [Line(label, _cells(o), ours=not o.published) for label, o in rows], HALF)


def _page(c: Canvas) -> None:
    say(c, MARGIN, HEIGHT - 60, TITLE, size=20, font=BOLD, ink=TEAL)
    y = prose(c, MARGIN, HEIGHT - 80, SOURCE, WIDTH - 2 * MARGIN, size=8)
    top = prose(c, MARGIN, y, MARKED, WIDTH - 2 * MARGIN, size=8) - 12
    y = heading(c, MARGIN, top, "Dimensions", HALF)
    y = _rows(c, MARGIN, y, (
        ("Length with standard bucket", v.LENGTH), ("Length without attachment", v.BARE_LENGTH),
        ("Width", v.OVERALL_WIDTH), ("Bucket width", v.BUCKET_WIDTH), ("Height", v.HEIGHT),
        ("Height to bucket hinge pin", v.HINGE_HEIGHT), ("Reach at maximum height", v.REACH),
        ("Dump angle at maximum height", v.DUMP_ANGLE), ("Rollback at ground position", v.ROLLBACK),
        ("Digging depth", v.DIG_DEPTH), ("Turning radius", v.TURNING_RADIUS),
        ("Turning radius, rear", v.REAR_RADIUS), ("Wheelbase", v.WHEELBASE),
        ("Ground clearance", v.GROUND_CLEARANCE), ("Tyre diameter", v.TYRE_DIAMETER),
    ))  # fmt: skip
    x = MARGIN + HALF + 26
    y = heading(c, x, top, "Performance and weight", HALF)
    y = _rows(c, x, y, (("Operating weight", v.OPERATING_WEIGHT), ("Rated operating capacity", v.CAPACITY)))
    rows = (
        Line("Maximum travel speed", speed(v.SPEED.value), ours=True),
        Line("Bucket capacity, heaped", (f"{v.BUCKET_VOLUME.value} m³",), ours=True),
    )
    y = lines(c, x, y, rows, HALF)
    y = heading(c, x, y, "Hydraulic system", HALF)
    rows = (
        Line("Pump capacity", flow(v.FLOW.value), ours=True),
        Line("System relief at quick couplers", pressure(v.PRESSURE.value), ours=True),
    )
    y = lines(c, x, y, rows, HALF)
    y = heading(c, x, y, "Hydraulic cylinders", HALF)
    heads = ("Cylinder", "No.", "Stroke", "Bore", "Rod dia.")
    cells = [[Cell((name,), head=True, mark=name in heads[2:]) for name in heads]]
    for name in ("Lift", "Tilt"):
        sizes = [f"{getattr(v, f'{name.upper()}_{what}').value:g} mm" for what in ("STROKE", "BORE", "ROD")]
        cells.append([Cell((name,), align="l"), Cell(("2",)), *(Cell((words,)) for words in sizes)])
    grid(c, x, y, [HALF / 5] * 5, cells, 21)


def write(path: Path) -> None:
    """Writes the sheet."""
    c = Canvas(str(path), pagesize=A4, invariant=1, pageCompression=0)
    c.setTitle(f"{TITLE}: technical data")
    c.setAuthor("yellowiron examples")
    _page(c)
    c.showPage()
    c.save()
