"""Prints the mini excavator's sheet: what the maker publishes, and beside it, marked, what is ours."""

from __future__ import annotations

from pathlib import Path

from reportlab.pdfgen.canvas import Canvas

from drawing.sheet_print import (
    FULL,
    HALF,
    HEIGHT,
    MARGIN,
    SECOND,
    Cell,
    Line,
    cylinder_table,
    flow,
    grid,
    heading,
    length,
    lines,
    mass,
    opening,
    pressure,
    short,
    speed,
    torque,
    value_lines,
    write_pages,
)
from drawing.values import Value

from . import values as v

TITLE = "Example mini excavator, 8008 CTS class"
SOURCE = (
    f"Published values are those of the {v.BROCHURE} (880 mm dipper, tracks and blade retracted). Dimensions after "
    "ISO 6746-1, working ranges after ISO 7135. Not a publication of the maker."
)


def _lengths(value: Value) -> tuple[str, ...]:
    return length(value.value)


def _first(c: Canvas) -> None:
    x, top = MARGIN, opening(c, TITLE, SOURCE)
    y = heading(c, x, top, "Engine and weight", HALF)
    rows = (
        Line("Gross power, ISO 14396", (f"{v.GROSS_POWER.value} kW", "12.1 hp")),
        Line("Operating weight", mass(v.OPERATING_WEIGHT.value)),
    )
    y = lines(c, x, y, rows, HALF)
    y = heading(c, x, y, "Hydraulic system", HALF)
    rows = (
        Line("Main pumps, maximum flow", flow(v.PUMP_FLOW.value)),
        Line("Relief valve setting"),
        Line("Implement circuits", pressure(v.MAIN_PRESSURE.value), under=True),
        Line("Swing circuit", pressure(v.SWING_PRESSURE.value), under=True),
    )
    y = lines(c, x, y, rows, HALF)
    y = heading(c, x, y, "Drives", HALF)
    rows = (
        Line("Maximum travel speed", speed(v.TRAVEL_SPEED.value)),
        Line("Maximum drawbar pull", (f"{v.DRAWBAR_PULL.value} kN", "1,740 lbf")),
        Line("Swing speed", (f"{v.SWING_SPEED.value:.1f} rpm",)),
        Line("Swing torque", torque(v.SWING_TORQUE.value), ours=True),
        Line("Track rollers, each side", (f"{v.TRACK_ROLLERS.value:.0f}",)),
        Line("Track shoes, each side", (f"{v.SHOES.value:.0f}",), ours=True),
    )
    lines(c, x, y, rows, HALF)
    x = SECOND
    y = heading(c, x, top, "Dimensions", HALF)
    y = value_lines(c, x, y, (
        ("Overall height (to top of canopy)", v.CANOPY_HEIGHT), ("Overall width", v.OVERALL_WIDTH),
        ("Width of upper structure", v.UPPER_WIDTH), ("Tail swing radius", v.TAIL_RADIUS),
        ("Kingpost clearance", v.KINGPOST_CLEARANCE), ("Track length on ground", v.TRACK_ON_GROUND),
        ("Track length", v.TRACK_LENGTH), ("Track gauge", v.TRACK_GAUGE), ("Shoe width", v.SHOE_WIDTH),
        ("Ground clearance (minimum)", v.GROUND_CLEARANCE), ("Blade width", v.BLADE_WIDTH),
        ("Blade height", v.BLADE_HEIGHT),
    ), _lengths)  # fmt: skip
    y = heading(c, x, y, "Working equipment", HALF)
    rows = (
        Line("Boom length", length(v.BOOM_LENGTH.value), ours=True),
        Line("Arm length", length(v.ARM_LENGTH.value)),
        Line("Bucket width", short(v.BUCKET_WIDTH.value)),
        Line("Bucket weight", mass(v.BUCKET_WEIGHT.value), ours=True),
        Line("Bucket capacity, heaped", (f"{v.BUCKET_CAPACITY.value} m³",), ours=True),
    )
    lines(c, x, y, rows, HALF)


def _second(c: Canvas) -> None:
    y = heading(c, MARGIN, HEIGHT - 60, "Working ranges", FULL)
    rows = [[Cell(("",), head=True), Cell(("Working range",), head=True, align="l"), Cell(("880 mm arm",), head=True)]]
    for key, label, value in (
        ("K", "Boom swing right", v.SWING_RIGHT),
        ("L", "Boom swing left", v.SWING_LEFT),
        ("M", "Max. digging height", v.DIGGING_HEIGHT),
        ("N", "Max. dumping height", v.DUMPING_HEIGHT),
        ("O", "Max. vertical wall digging depth", v.WALL_DEPTH),
        ("P", "Max. digging depth", v.DIGGING_DEPTH),
        ("Q", "Max. digging reach at ground level", v.GROUND_REACH),
        ("R", "Blade lift above ground", v.BLADE_LIFT),
        ("S", "Blade depth below ground", v.BLADE_DIG),
        ("T", "Min. swing radius", v.SWING_RADIUS_MIN),
    ):
        words = f"{value.value:.0f}°" if value.unit == "deg" else " / ".join(length(value.value))
        rows.append([Cell((key,)), Cell((label,), align="l"), Cell((words,))])
    y = grid(c, MARGIN, y, (30, 260, FULL - 290), rows, 20) - 30
    y = heading(c, MARGIN, y, "Hydraulic cylinders", FULL)
    names = ("Boom", "Arm", "Bucket", "Boom swing", "Blade")

    def sizes(name: str) -> tuple[Value, Value, Value]:
        key = name.split()[-1].upper()
        return getattr(v, f"{key}_STROKE"), getattr(v, f"{key}_BORE"), getattr(v, f"{key}_ROD")

    cylinder_table(c, MARGIN, y, FULL, [(name, 1, sizes(name)) for name in names])


def write(path: Path) -> None:
    """Writes the sheet."""
    write_pages(path, TITLE, _first, _second)
