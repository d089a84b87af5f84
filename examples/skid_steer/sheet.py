"""Prints the skid steer's sheet in the lines of the maker's: what is published, and beside it, marked, what is ours."""

from __future__ import annotations

from pathlib import Path

from reportlab.pdfgen.canvas import Canvas

from drawing.sheet_print import (
    HALF,
    MARGIN,
    SECOND,
    Line,
    cylinder_table,
    flow,
    heading,
    lines,
    opening,
    pressure,
    short,
    speed,
    value_lines,
    write_pages,
)
from drawing.values import Value

from . import values as v

TITLE = f"Example skid steer loader, {v.MODEL} class"
SOURCE = (
    f"Published values are those of the {v.MAKE} {v.MODEL}: {v.FACTS}; printed there in inches and pounds. "
    f"Dimensions after ISO 7131. Tyres {v.TYRE_SIZE}. Not a publication of the maker."
)


def _cells(value: Value) -> tuple[str, ...]:
    if value.unit == "deg":
        return (f"{value.value:.0f}°",)
    if value.unit == "kg":
        return f"{value.value:,.0f} kg", f"{value.value / v.POUND:,.0f} lb"
    return short(value.value)


def _page(c: Canvas) -> None:
    top = opening(c, TITLE, SOURCE)
    y = heading(c, MARGIN, top, "Dimensions", HALF)
    y = value_lines(c, MARGIN, y, (
        ("Length with standard bucket", v.LENGTH), ("Length without attachment", v.BARE_LENGTH),
        ("Width", v.OVERALL_WIDTH), ("Bucket width", v.BUCKET_WIDTH), ("Height", v.HEIGHT),
        ("Height to bucket hinge pin", v.HINGE_HEIGHT), ("Reach at maximum height", v.REACH),
        ("Dump angle at maximum height", v.DUMP_ANGLE), ("Rollback at ground position", v.ROLLBACK),
        ("Digging depth", v.DIG_DEPTH), ("Turning radius", v.TURNING_RADIUS),
        ("Turning radius, rear", v.REAR_RADIUS), ("Wheelbase", v.WHEELBASE),
        ("Ground clearance", v.GROUND_CLEARANCE), ("Tyre diameter", v.TYRE_DIAMETER),
    ), _cells)  # fmt: skip
    x = SECOND
    y = heading(c, x, top, "Performance and weight", HALF)
    y = value_lines(
        c, x, y, (("Operating weight", v.OPERATING_WEIGHT), ("Rated operating capacity", v.CAPACITY)), _cells
    )
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
    cylinders = (
        ("Lift", 2, (v.LIFT_STROKE, v.LIFT_BORE, v.LIFT_ROD)), ("Tilt", 2, (v.TILT_STROKE, v.TILT_BORE, v.TILT_ROD)),
    )  # fmt: skip
    cylinder_table(c, x, y, HALF, cylinders)


def write(path: Path) -> None:
    """Writes the sheet."""
    write_pages(path, TITLE, _page)
