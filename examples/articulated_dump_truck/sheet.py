"""Prints the truck's sheet in the lines of the maker's: what is published, and beside it, marked, what is ours."""

from __future__ import annotations

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

TITLE = f"Example articulated truck, {v.MODEL} class"
SOURCE = (
    f"Published values are those of the {v.MAKE} {v.MODEL}: {v.FACTS}; wheelbase: {v.DEALER}. Dimensions after "
    f"ISO 7132 and ISO 6746-1, unladen, tires {v.TYRE_SIZE}. Not a publication of the maker."
)


def _page(c: Canvas) -> None:
    top = opening(c, TITLE, SOURCE)
    y = heading(c, MARGIN, top, "Engine", HALF)
    y = value_lines(c, MARGIN, y, (
        ("Gross power, SAE J1995", v.GROSS_POWER), ("Net power, SAE J1349", v.NET_POWER),
    ))  # fmt: skip
    y = heading(c, MARGIN, y, "Weights", HALF)
    y = value_lines(c, MARGIN, y, (("Rated payload", v.PAYLOAD), ("Empty weight", v.EMPTY_WEIGHT)))
    y = heading(c, MARGIN, y, "Body capacities", HALF)
    y = value_lines(c, MARGIN, y, (("Heaped SAE 2:1", v.HEAPED), ("Struck", v.STRUCK)))
    y = heading(c, MARGIN, y, "Transmission", HALF)
    rows = (("Maximum speed, forward", v.TOP_SPEED), ("Maximum speed, reverse", v.REVERSE_SPEED))
    y = value_lines(c, MARGIN, y, rows)
    y = heading(c, MARGIN, y, "Body hoist", HALF)
    y = value_lines(c, MARGIN, y, (
        ("Body dump angle", v.DUMP_ANGLE), ("Body raise time", v.RAISE_TIME), ("Body lower time", v.LOWER_TIME),
        ("Hoist pump flow", v.FLOW), ("Body hoist relief pressure", v.PRESSURE),
    ))  # fmt: skip
    y = heading(c, MARGIN, y, "Hydraulic cylinders", HALF)
    cylinder_table(c, MARGIN, y, HALF, (
        ("Hoist", 2, (v.HOIST_STROKE, v.HOIST_BORE, v.HOIST_ROD)),
        ("Steering", 2, (v.STEER_STROKE, v.STEER_BORE, v.STEER_ROD)),
    ))  # fmt: skip
    y = heading(c, SECOND, top, "Dimensions", HALF)
    y = value_lines(c, SECOND, y, (
        ("Overall length", v.LENGTH), ("Overall width, over tires", v.OVERALL_WIDTH), ("Overall height", v.HEIGHT),
        ("Wheelbase, front axle to bogie", v.WHEELBASE), ("Bogie axle spacing", v.BOGIE_SPACING),
        ("Front tread", v.FRONT_TREAD), ("Rear tread", v.REAR_TREAD), ("Front overhang", v.FRONT_OVERHANG),
        ("Ground clearance", v.GROUND_CLEARANCE), ("Approach angle", v.APPROACH_ANGLE),
        ("Tire diameter", v.TYRE_DIAMETER), ("Loading height", v.LOADING_HEIGHT),
        ("Overall height, body raised", v.RAISED_HEIGHT), ("Dump clearance", v.DUMP_CLEARANCE),
        ("Outside body width", v.BODY_WIDTH),
    ))  # fmt: skip
    y = heading(c, SECOND, y, "Steering", HALF)
    y = value_lines(c, SECOND, y, (
        ("Articulation angle, left/right", v.ARTICULATION), ("Turning radius, outside tires", v.TURNING_RADIUS),
    ))  # fmt: skip
    lines(c, SECOND, y, (Line("Tires", (v.TYRE_SIZE,)),), HALF)


def write(path: Path) -> None:
    """Writes the sheet."""
    write_pages(path, TITLE, _page)
