"""Prints a telehandler's sheet in the lines of the maker's: what is published, and beside it, marked, what is ours."""

from __future__ import annotations

import functools
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
from .linkage import printed

TITLES = {2: f"Example telehandler, {v.MODEL} class", 3: "Example telehandler, boom of three sections"}
SOURCE = (
    f"Published values are those of the {v.MAKE} {v.MODEL} ({v.FACTS}); its turning radius is that of the front wheels "
    "steered alone. Dimensions after ISO 6746-1. Not a publication of the maker."
)
NONE = "A machine of no maker: all of its values are ours. Dimensions after ISO 6746-1."


def _time(value: Value) -> tuple[str, ...]:
    return (f"{value.value:g} s",)


def _first(sections: int, c: Canvas) -> None:
    def own(*rows: tuple[str, Value]) -> list[tuple[str, Value]]:
        return [(label, printed(value, sections)) for label, value in rows]

    top = opening(c, TITLES[sections], SOURCE if sections == 2 else NONE)
    y = heading(c, MARGIN, top, "Performance", HALF)
    y = value_lines(c, MARGIN, y, own(
        ("Maximum lift capacity", v.CAPACITY), ("Lift capacity to full height", v.HEIGHT_CAPACITY),
        ("Lift capacity at full reach", v.REACH_CAPACITY), ("Maximum lift height", v.LIFT_HEIGHT),
        ("Reach at maximum lift height", v.HEIGHT_REACH), ("Maximum forward reach", v.FORWARD_REACH),
        ("Maximum boom angle", v.BOOM_ANGLE), ("Minimum boom angle", v.LOW_ANGLE),
        ("Carriage rotation", v.ROTATION),
    ))  # fmt: skip
    y = heading(c, MARGIN, y, "Boom speeds", HALF)
    y = value_lines(c, MARGIN, y, own(
        ("Boom lift time", v.LIFT_TIME), ("Boom lower time", v.LOWER_TIME), ("Boom extend time", v.EXTEND_TIME),
        ("Boom retract time", v.RETRACT_TIME),
    ), _time) if sections == 2 else y  # fmt: skip
    y = heading(c, MARGIN, y, "Weight and engine", HALF)
    value_lines(c, MARGIN, y, own(("Operating weight", v.WEIGHT), ("Gross power", v.POWER)))
    y = heading(c, SECOND, top, "Dimensions", HALF)
    more = () if sections == 2 else (("Frame levelling", v.LEVELLING), ("Stabiliser spread", v.SPREAD))
    y = value_lines(c, SECOND, y, own(
        ("Overall height", v.OVERALL_HEIGHT), ("Overall width", v.OVERALL_WIDTH), ("Wheelbase", v.WHEELBASE),
        ("Length to fork face", v.FORK_FACE), ("Ground clearance", v.GROUND_CLEARANCE),
        ("Turning radius", v.TURNING_RADIUS), ("Fork length", v.FORK_LENGTH), ("Wheel diameter", v.TYRE_DIAMETER),
        *more,
    ))  # fmt: skip
    y = heading(c, SECOND, y, "Transmission and steering", HALF)
    y = value_lines(c, SECOND, y, own(("Maximum travel speed", v.SPEED), ("Steering angle", v.STEER_ANGLE)))
    y = heading(c, SECOND, y, "Hydraulic system", HALF)
    y = value_lines(c, SECOND, y, own(("Main pump flow", v.FLOW), ("Main relief pressure", v.PRESSURE)))
    lines(c, SECOND, y, (Line("Tyres", ("15.5-25",)),), HALF)


def _second(sections: int, c: Canvas) -> None:
    y = heading(c, MARGIN, HEIGHT - 60, "Hydraulic cylinders", FULL)

    def sizes(key: str) -> tuple[Value, Value, Value]:
        return getattr(v, f"{key}_STROKE"), getattr(v, f"{key}_BORE"), getattr(v, f"{key}_ROD")

    rows = [
        ("Lift", 1, "LIFT"),
        ("Telescoping", 1, "TELESCOPE"),
        ("Tilt", 1, "TILT"),
        ("Compensation", 1, "COMPENSATION"),
    ]
    rows += [("Steering", 2, "STEER")]
    rows += [("Levelling", 1, "LEVEL"), ("Stabiliser", 2, "STABILISER")] if sections > 2 else []
    cylinder_table(c, MARGIN, y, FULL, [(name, number, sizes(key)) for name, number, key in rows])


def write(path: Path, sections: int = 2) -> None:
    """Writes the sheet of a machine."""
    write_pages(path, TITLES[sections], functools.partial(_first, sections), functools.partial(_second, sections))
