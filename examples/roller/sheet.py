"""Prints the roller's sheet in the lines of the maker's: what is published, and beside it, marked, what is ours."""

from __future__ import annotations

import functools
from pathlib import Path

from reportlab.pdfgen.canvas import Canvas

from drawing.sheet_print import (
    HALF,
    MARGIN,
    SECOND,
    Line,
    cylinder_table,
    heading,
    lines,
    opening,
    value_lines,
    write_pages,
)

from . import values as v

SOURCE = (
    f"Published values are those of the {v.MAKE} {v.MODEL} ({v.FACTS}). Dimensions after ISO 8811 and ISO 6746-1. "
    "Not a publication of the maker."
)
NONE = "A machine of no maker: all of its values are ours. Dimensions after ISO 8811 and ISO 6746-1."


def _page(m: v.Machine, c: Canvas) -> None:
    top = opening(c, m.title, SOURCE if m.published else NONE)
    y = heading(c, MARGIN, top, "Engine", HALF)
    y = value_lines(c, MARGIN, y, (("Gross power", v.GROSS_POWER),))
    y = heading(c, MARGIN, y, "Weights", HALF)
    y = value_lines(c, MARGIN, y, (("Operating weight", m.weight),))
    y = heading(c, MARGIN, y, "Propulsion", HALF)
    y = value_lines(c, MARGIN, y, (("Maximum travel speed", v.TOP_SPEED),))
    y = heading(c, MARGIN, y, "Steering", HALF)
    y = value_lines(c, MARGIN, y, (
        ("Articulation angle, left/right", m.own(v.ARTICULATION)), ("Oscillation angle", m.own(v.OSCILLATION)),
        ("Turning radius, outside", m.turning_radius), ("Turning radius, inside", m.inner_radius),
        ("Steering pump flow", v.FLOW),
        ("Steering relief pressure", v.PRESSURE),
    ))  # fmt: skip
    y = heading(c, MARGIN, y, "Drums and vibration", HALF)
    y = value_lines(c, MARGIN, y, (
        ("Drum diameter", m.own(v.DRUM_DIAMETER)), ("Drum width", m.own(v.DRUM_WIDTH)),
        ("Drum shell thickness", v.SHELL),
    ))  # fmt: skip
    y = heading(c, SECOND, top, "Dimensions", HALF)
    tyre = (("Tire diameter", m.tyre[0]),) if m.tyre else ()
    y = value_lines(c, SECOND, y, (
        ("Overall length", m.length), ("Overall width", m.width), ("Overall height", m.height),
        ("Wheelbase", m.wheelbase), ("Curb clearance", v.CURB_CLEARANCE), ("Ground clearance", m.ground), *tyre,
    ))  # fmt: skip
    if m.tyre:
        y = heading(c, SECOND, y, "Tires", HALF)
        y = lines(c, SECOND, y, (Line("Tires", (v.TYRE_SIZE,)),), HALF)
    y = heading(c, SECOND, y, "Hydraulic cylinders", HALF)
    cylinder_table(c, SECOND, y, HALF, (("Steering", 2, (v.STEER_STROKE, v.STEER_BORE, v.STEER_ROD)),))


def write(path: Path, m: v.Machine) -> None:
    """Writes the sheet."""
    write_pages(path, m.title, functools.partial(_page, m))
