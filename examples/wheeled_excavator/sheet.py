"""Prints the wheeled excavator's sheet: what the maker publishes, and beside it, marked, what is ours."""

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
    cells,
    cylinder_table,
    grid,
    grouped,
    heading,
    length,
    opening,
    value_lines,
    write_pages,
)
from drawing.values import Value

from . import values as v

TITLE = f"Example wheeled excavator, {v.MODEL} class"
SOURCE = (
    f"Published values are those of the {v.BROCHURE} ({v.MODEL}, 5.15 m mono boom, 3.05 m dipper, stabilisers at the "
    "rear, single wheels). Dimensions after ISO 6746-1, working ranges after ISO 7135. Not a publication of the maker."
)


def _shown(value: Value) -> tuple[str, ...]:
    own = {"rpm": f"{value.value:.1f} rpm", "deg": f"{grouped(value.value)}°", "m3": f"{value.value} m³"}
    return (own[value.unit],) if value.unit in own else cells(value)


def _first(c: Canvas) -> None:
    top = opening(c, TITLE, SOURCE)
    left = {
        "Engine and weight": (("Gross power, ISO 14396", v.GROSS_POWER), ("Operating weight", v.OPERATING_WEIGHT)),
        "Hydraulic system": (
            ("Main pump flow", v.PUMP_FLOW), ("Main relief pressure", v.MAIN_PRESSURE),
            ("Swing relief pressure", v.SWING_PRESSURE),
        ),
        "Drives and steering": (
            ("Maximum travel speed", v.TRAVEL_SPEED), ("Travel speed, low", v.LOW_SPEED),
            ("Maximum drawbar pull", v.DRAWBAR_PULL), ("Swing speed", v.SWING_SPEED),
            ("Swing torque", v.SWING_TORQUE), ("Steering angle", v.STEER_ANGLE),
            ("Turning radius outside tyres", v.TURNING_RADIUS),
        ),
    }  # fmt: skip
    right = {
        "Dimensions": (
            ("Height over cab", v.CAB_HEIGHT), ("Overall width over tyres", v.OVERALL_WIDTH),
            ("Width of upper structure", v.UPPER_WIDTH), ("Tail swing radius", v.TAIL_RADIUS),
            ("Counterweight clearance", v.COUNTERWEIGHT_CLEARANCE), ("Ground clearance", v.GROUND_CLEARANCE),
            ("Slew centre to front axle", v.SLEW_TO_FRONT), ("Wheelbase", v.WHEELBASE),
            ("Tyre diameter", v.TYRE_DIAMETER), ("Stabiliser spread", v.SPREAD),
            ("Stabiliser lift height", v.STABILISER_LIFT),
        ),
        "Working equipment": (
            ("Boom length", v.BOOM_LENGTH), ("Arm length", v.ARM_LENGTH), ("Bucket width", v.BUCKET_WIDTH),
            ("Bucket capacity", v.BUCKET_CAPACITY), ("Bucket weight", v.BUCKET_WEIGHT),
            ("Bucket rotation", v.BUCKET_ROTATION), ("Bucket digging force", v.BUCKET_FORCE),
            ("Arm digging force", v.ARM_FORCE),
        ),
    }  # fmt: skip
    for x, column in ((MARGIN, left), (SECOND, right)):
        y = top
        for words, rows in column.items():
            y = value_lines(c, x, heading(c, x, y, words, HALF), rows, _shown)


def _second(c: Canvas) -> None:
    y = heading(c, MARGIN, HEIGHT - 60, "Working ranges", FULL)
    rows = [[Cell(("",), head=True), Cell(("Working range",), head=True, align="l"), Cell(("3.05 m arm",), head=True)]]
    for key, value in zip("ABCDEFG", (
        v.MAX_REACH, v.GROUND_REACH, v.DIGGING_DEPTH, v.DIGGING_HEIGHT, v.DUMPING_HEIGHT, v.WALL_DEPTH,
        v.SWING_RADIUS_MIN,
    ), strict=True):  # fmt: skip
        words = " / ".join(length(value.value))
        rows.append([Cell((key,)), Cell((value.name,), align="l"), Cell((words,))])
    y = grid(c, MARGIN, y, (30, 260, FULL - 290), rows, 20) - 30
    y = heading(c, MARGIN, y, "Hydraulic cylinders", FULL)

    def sizes(name: str) -> tuple[Value, Value, Value]:
        key = name.upper().replace("STEERING", "STEER")
        return getattr(v, f"{key}_STROKE"), getattr(v, f"{key}_BORE"), getattr(v, f"{key}_ROD")

    number = {"Boom": 2, "Arm": 1, "Bucket": 1, "Stabiliser": 2, "Steering": 1}
    cylinder_table(c, MARGIN, y, FULL, [(name, n, sizes(name)) for name, n in number.items()])


def write(path: Path) -> None:
    """Writes the sheet."""
    write_pages(path, TITLE, _first, _second)
