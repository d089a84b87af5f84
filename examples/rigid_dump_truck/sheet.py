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

TITLE = f"Example rigid dump truck, {v.MODEL} class"
SOURCE = (
    f"Published values are those of the {v.MAKE} {v.MODEL}, dual slope body: {v.FACTS}. Dimensions after ISO 7132 and "
    f"ISO 6746-1, unladen, tires {v.TYRE_SIZE}. Not a publication of the maker."
)


def _page(c: Canvas) -> None:
    top = opening(c, TITLE, SOURCE)
    y = heading(c, MARGIN, top, "Weights", HALF)
    y = value_lines(c, MARGIN, y, (("Rated payload", v.PAYLOAD), ("Empty weight", v.EMPTY_WEIGHT)))
    y = heading(c, MARGIN, y, "Body capacities", HALF)
    y = value_lines(c, MARGIN, y, (("Heaped SAE 2:1", v.HEAPED), ("Struck", v.STRUCK)))
    y = heading(c, MARGIN, y, "Transmission", HALF)
    y = value_lines(c, MARGIN, y, (("Maximum speed, forward", v.TOP_SPEED),))
    y = heading(c, MARGIN, y, "Steering", HALF)
    y = value_lines(c, MARGIN, y, (("Steering angle", v.STEER_ANGLE),))
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
    rows = (
        v.HEIGHT, v.BODY_LENGTH, v.LENGTH, v.WHEELBASE, v.REAR_OVERHANG, v.DUMP_CLEARANCE, v.LOADING_HEIGHT,
        v.RAISED_HEIGHT, v.FRONT_TREAD, v.CANOPY_WIDTH, v.BODY_WIDTH, v.CANOPY_HEIGHT, v.AXLE_CLEARANCE, v.REAR_TREAD,
        v.TYRES_WIDTH, v.TYRE_DIAMETER,
    )  # fmt: skip
    y = value_lines(c, SECOND, y, [(value.name, value) for value in rows])
    lines(c, SECOND, y, (Line("Tires", (v.TYRE_SIZE,)),), HALF)


def write(path: Path) -> None:
    """Writes the sheet."""
    write_pages(path, TITLE, _page)
