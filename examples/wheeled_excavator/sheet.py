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
    Line,
    cylinder_table,
    grid,
    heading,
    length,
    lines,
    opening,
    short,
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


def _first(c: Canvas) -> None:
    x, top = MARGIN, opening(c, TITLE, SOURCE)
    y = heading(c, x, top, "Engine and weight", HALF)
    y = value_lines(c, x, y, (("Gross power, ISO 14396", v.GROSS_POWER), ("Operating weight", v.OPERATING_WEIGHT)))
    y = heading(c, x, y, "Hydraulic system", HALF)
    rows = (("Main pump flow", v.PUMP_FLOW), ("Main relief pressure", v.MAIN_PRESSURE))
    y = value_lines(c, x, y, (*rows, ("Swing relief pressure", v.SWING_PRESSURE)))
    y = heading(c, x, y, "Swing system", HALF)
    y = lines(c, x, y, (Line("Swing speed", (f"{v.SWING_SPEED.value:.1f} rpm",)),), HALF) + 8
    y = value_lines(c, x, y, (("Swing torque", v.SWING_TORQUE),))
    y = heading(c, x, y, "Transmission and steering", HALF)
    y = value_lines(c, x, y, (
        ("Maximum travel speed", v.TRAVEL_SPEED), ("Travel speed, low", v.LOW_SPEED),
        ("Maximum drawbar pull", v.DRAWBAR_PULL), ("Turning radius outside tyres", v.TURNING_RADIUS),
    )) + 8  # fmt: skip
    steered = Line("Steering angle", (f"{v.STEER_ANGLE.value:.1f}°",), ours=True)
    lines(c, x, y, (steered, Line("Tyres", ("18R19.5",))), HALF)
    x = SECOND
    y = heading(c, x, top, "Dimensions", HALF)
    y = value_lines(c, x, y, (
        ("Height over cab", v.CAB_HEIGHT), ("Overall width over tyres", v.OVERALL_WIDTH),
        ("Width of upper structure", v.UPPER_WIDTH), ("Tail swing radius", v.TAIL_RADIUS),
        ("Counterweight clearance", v.COUNTERWEIGHT_CLEARANCE), ("Ground clearance", v.GROUND_CLEARANCE),
        ("Slew centre to front axle", v.SLEW_TO_FRONT), ("Wheelbase", v.WHEELBASE),
        ("Tyre diameter", v.TYRE_DIAMETER), ("Stabiliser spread", v.SPREAD),
        ("Stabiliser lift height", v.STABILISER_LIFT),
    ))  # fmt: skip
    y = heading(c, x, y, "Working equipment", HALF)
    rows = (("Boom length", v.BOOM_LENGTH), ("Arm length", v.ARM_LENGTH), ("Bucket weight", v.BUCKET_WEIGHT))
    y = value_lines(c, x, y, rows) + 8
    more = (
        Line("Bucket width", short(v.BUCKET_WIDTH.value)),
        Line("Bucket capacity", (f"{v.BUCKET_CAPACITY.value} m³",)),
        Line("Bucket rotation", (f"{v.BUCKET_ROTATION.value:.0f}°",)),
    )
    y = lines(c, x, y, more, HALF) + 8
    value_lines(c, x, y, (("Bucket digging force", v.BUCKET_FORCE), ("Arm digging force", v.ARM_FORCE)))


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
