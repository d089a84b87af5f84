"""Prints the crane's sheet in the lines of the maker's: what is published, and beside it, marked, what is ours."""

from __future__ import annotations

from pathlib import Path

from reportlab.pdfgen.canvas import Canvas

from drawing.sheet_print import HALF, MARGIN, SECOND, cells, heading, opening, value_lines, write_pages
from drawing.values import Value

from . import values as v

TITLE = f"Example crawler crane, {v.MODEL} class"
SOURCE = (
    f"Published values are those of the {v.MAKE} {v.MODEL} with its basic boom ({v.FACTS}). Not a publication of the "
    "maker."
)
_UNITS = {"m/min": "{:g} m/min", "rpm": "{:g} rpm", "": "{:g}", "kPa": "{:g} kPa", "kg": "{:,.0f} kg"}


def _shown(value: Value) -> tuple[str, ...]:
    return (_UNITS[value.unit].format(value.value),) if value.unit in _UNITS else cells(value)


def _page(c: Canvas) -> None:
    top = opening(c, TITLE, SOURCE)
    y = heading(c, MARGIN, top, "Crane", HALF)
    y = value_lines(c, MARGIN, y, (
        ("Maximum lifting capacity", v.CAPACITY), ("Radius at maximum capacity", v.CAPACITY_RADIUS),
        ("Maximum lifting height", v.LIFT_HEIGHT), ("Slewing speed", v.SLEWING), ("Tail swing radius", v.TAIL),
        ("Counterweight", v.COUNTERWEIGHT),
    ), _shown)  # fmt: skip
    y = heading(c, MARGIN, y, "Boom", HALF)
    y = value_lines(c, MARGIN, y, (
        ("Basic boom length", v.BOOM), ("Maximum boom length", v.BOOM_LONGEST), ("Maximum boom angle", v.HIGH),
        ("Minimum boom angle", v.LOW), ("Boom foot height", v.FOOT),
    ), _shown)  # fmt: skip
    y = heading(c, MARGIN, y, "Winches", HALF)
    value_lines(c, MARGIN, y, (
        ("Main hoist line speed", v.LINE_SPEED), ("Main hoist line pull", v.LINE_PULL),
        ("Number of part lines", v.FALLS), ("Boom hoist line speed", v.BOOM_SPEED),
        ("Boom hoist line pull", v.BOOM_PULL), ("Boom hoist part lines", v.BOOM_FALLS),
    ), _shown)  # fmt: skip
    y = heading(c, SECOND, top, "Dimensions", HALF)
    y = value_lines(c, SECOND, y, (
        ("Overall width", v.WIDTH), ("Gantry height", v.GANTRY), ("Ground clearance", v.CLEARANCE),
        ("Track length", v.TRACK), ("Track length on ground", v.ON_GROUND), ("Track gauge", v.GAUGE),
        ("Shoe width", v.SHOE),
    ), _shown)  # fmt: skip
    y = heading(c, SECOND, y, "Weight and engine", HALF)
    y = value_lines(c, SECOND, y, (
        ("Operating weight", v.WEIGHT), ("Ground pressure", v.PRESSURE), ("Engine power", v.POWER),
    ), _shown)  # fmt: skip
    y = heading(c, SECOND, y, "Travel", HALF)
    value_lines(c, SECOND, y, (("Travel speed", v.SPEED),), _shown)


def write(path: Path) -> None:
    """Writes the sheet."""
    write_pages(path, TITLE, _page)
