"""Prints the backhoe loader's sheet: what is published, and beside it, marked, what is ours."""

from __future__ import annotations

from pathlib import Path

from reportlab.pdfgen.canvas import Canvas

from drawing.sheet_print import (
    FULL,
    HALF,
    HEIGHT,
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
from drawing.values import Value

from . import values as v

TITLE = f"Example backhoe loader, {v.MODEL} class"
SOURCE = (
    f"Published values are those of the {v.MAKE} {v.MODEL}: {v.FACTS}; working ranges of the backhoe with its dipper "
    "drawn out. Dimensions after ISO 8812. Not a publication of the maker."
)


def _first(c: Canvas) -> None:
    top = opening(c, TITLE, SOURCE)
    y = heading(c, MARGIN, top, "Dimensions", HALF)
    y = value_lines(c, MARGIN, y, (
        ("Wheelbase", v.WHEELBASE), ("Slew centre to rear axle centre", v.SLEW_TO_AXLE),
        ("Stabiliser feet clearance", v.FEET_CLEARANCE), ("Kingpost clearance", v.KINGPOST_CLEARANCE),
        ("Cab roof height", v.CAB_HEIGHT), ("Rear frame width", v.FRAME_WIDTH), ("Stabiliser spread", v.SPREAD),
        ("Ground clearance", v.GROUND_CLEARANCE), ("Wheel diameter", v.TYRE_DIAMETER),
    ))  # fmt: skip
    y = heading(c, MARGIN, y, "Loader", HALF)
    y = value_lines(c, MARGIN, y, (
        ("Loader dump height", v.DUMP_HEIGHT), ("Loader hinge pin height", v.HINGE_HEIGHT),
        ("Loader dump reach", v.DUMP_REACH), ("Loader dump angle", v.DUMP_ANGLE), ("Loader rollback angle", v.ROLLBACK),
        ("Loader digging depth", v.LOADER_DEPTH), ("Loader bucket width", v.SHOVEL_WIDTH),
        ("Loader bucket capacity", v.LOADER_VOLUME), ("Loader breakout force", v.LOADER_FORCE),
    ))  # fmt: skip
    y = heading(c, SECOND, top, "Backhoe", HALF)
    y = value_lines(c, SECOND, y, (
        ("Maximum digging depth", v.DIG_DEPTH), ("Reach at ground level", v.GROUND_REACH),
        ("Backhoe loading height", v.LOADING_HEIGHT), ("Swing arc", v.SWING_ARC),
        ("Backhoe bucket capacity", v.HOE_VOLUME), ("Bucket digging force", v.BUCKET_FORCE),
        ("Dipper digging force", v.DIPPER_FORCE),
    ))  # fmt: skip
    y = heading(c, SECOND, y, "Weight and engine", HALF)
    y = value_lines(c, SECOND, y, (("Operating weight", v.WEIGHT),)) + 8
    y = lines(c, SECOND, y, (Line("Engine power", (f"{v.POWER.value} kW", f"{v.POWER.value / 0.7457:.0f} hp")),), HALF)
    y = heading(c, SECOND, y, "Transmission and steering", HALF)
    y = value_lines(c, SECOND, y, (("Maximum travel speed", v.SPEED), ("Steering angle", v.STEER_ANGLE)))
    y = heading(c, SECOND, y, "Hydraulic system", HALF)
    y = value_lines(c, SECOND, y, (("Main pump flow", v.FLOW), ("Main relief pressure", v.PRESSURE)))
    lines(c, SECOND, y, (Line("Tyres, front and rear", ("12.5-18, 16.9-28",)),), HALF)


def _second(c: Canvas) -> None:
    y = heading(c, MARGIN, HEIGHT - 60, "Hydraulic cylinders", FULL)

    def sizes(key: str) -> tuple[Value, Value, Value]:
        return getattr(v, f"{key}_STROKE"), getattr(v, f"{key}_BORE"), getattr(v, f"{key}_ROD")

    cylinder_table(c, MARGIN, y, FULL, [(name, number, sizes(key)) for name, number, key in (
        ("Loader lift", 2, "LIFT"), ("Loader bucket", 1, "TILT"), ("Boom", 1, "BOOM"), ("Dipper", 1, "DIPPER"),
        ("Extension", 1, "EXTENSION"), ("Backhoe bucket", 1, "BUCKET"), ("Swing", 2, "SWING"),
        ("Stabiliser", 2, "STABILISER"), ("Steering", 1, "STEER"),
    )])  # fmt: skip


def write(path: Path) -> None:
    """Writes the sheet."""
    write_pages(path, TITLE, _first, _second)
