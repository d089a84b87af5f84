"""Prints the grader's sheet in the lines of the maker's: what is published, and beside it, marked, what is ours."""

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

from . import values as v

TITLE = f"Example motor grader, {v.MODEL} class"
SOURCE = (
    f"Published values are those of the {v.MAKE} {v.MODEL} ({v.BROCHURE}), with ripper and push plate. Dimensions "
    f"after ISO 7134 and ISO 6746-1, tires {v.TYRE_SIZE}. Not a publication of the maker."
)


def _first(c: Canvas) -> None:
    x, top = MARGIN, opening(c, TITLE, SOURCE)
    y = heading(c, x, top, "Weights", HALF)
    weight = v.OPERATING_WEIGHT.value
    cells = f"{weight:,.0f} kg", f"{weight / 0.45359237:,.0f} lb"
    y = lines(c, x, y, (Line("Operating weight, typically equipped", cells),), HALF)
    y = heading(c, x, y, "Hydraulic system", HALF)
    y = value_lines(c, x, y, (("Pump flow", v.FLOW), ("Main relief pressure", v.PRESSURE)))
    y = heading(c, x, y, "Power train", HALF)
    y = value_lines(c, x, y, (("Top speed, forward", v.TOP_SPEED),))
    y = heading(c, x, y, "Steering and axles", HALF)
    y = value_lines(c, x, y, (
        ("Steering range, left/right", v.STEERING), ("Articulation angle, left/right", v.ARTICULATION),
        ("Wheel lean, left/right", v.LEAN), ("Front axle oscillation, total", v.OSCILLATION),
        ("Turning radius, outside front tires", v.TURNING),
    ))  # fmt: skip
    y = heading(c, x, y, "Ripper", HALF)
    value_lines(c, x, y, (("Ripping depth, maximum", v.RIPPING_DEPTH), ("Ripper lift height", v.RIPPER_LIFT)))
    x = SECOND
    y = heading(c, x, top, "Moldboard", HALF)
    y = value_lines(c, x, y, (
        ("Moldboard width", v.BLADE_LENGTH), ("Moldboard height", v.BLADE_HEIGHT),
        ("Moldboard thickness", v.BLADE_THICK), ("Arc radius", v.BLADE_RADIUS), ("Throat clearance", v.THROAT),
    ))  # fmt: skip
    y = heading(c, x, y, "Blade range", HALF)
    y = value_lines(c, x, y, (
        ("Maximum lift above ground", v.BLADE_LIFT), ("Maximum depth of cut", v.DEPTH_OF_CUT),
        ("Blade side shift, left", v.SHIFT_LEFT), ("Blade side shift, right", v.SHIFT_RIGHT),
        ("Shoulder reach outside tires", v.SHOULDER),
    ))  # fmt: skip
    y = lines(c, x, y + 8, (Line("Bank cut angle, maximum", (f"{v.BANK_CUT.value:.1f}°",), ours=True),), HALF)
    y = value_lines(c, x, y + 8, (
        ("Blade tip angle, forward", v.TIP_FORWARD), ("Blade tip angle, backward", v.TIP_BACK),
        ("Circle rotation", v.CIRCLE_TURN), ("Circle diameter", v.CIRCLE_DIAMETER),
    ))  # fmt: skip
    y = heading(c, x, y, "Dimensions", HALF)
    value_lines(c, x, y, (
        ("Height to top of cab", v.HEIGHT), ("Front axle center height", v.AXLE_HEIGHT),
        ("Height to top of cylinders", v.CYLINDERS_HEIGHT), ("Between tandem axles", v.TANDEM),
        ("Front axle to mid tandem", v.WHEELBASE), ("Front axle to articulation hitch", v.FRONT_TO_HITCH),
        ("Rear axle to articulation hitch", v.REAR_TO_HITCH), ("Rear tire centerline width", v.TREAD),
        ("Width outside rear tires", v.WIDTH), ("Overall length, push plate to ripper", v.LENGTH),
        ("Ground clearance at rear axle", v.GROUND_CLEARANCE),
    ))  # fmt: skip


def _second(c: Canvas) -> None:
    y = heading(c, MARGIN, HEIGHT - 60, "Hydraulic cylinders", FULL)
    cylinder_table(c, MARGIN, y, FULL, (
        ("Blade lift cylinder", 2, (v.LIFT_STROKE, v.LIFT_BORE, v.LIFT_ROD)),
        ("Center shift cylinder", 1, (v.CENTRE_STROKE, v.CENTRE_BORE, v.CENTRE_ROD)),
        ("Blade tip cylinder", 1, (v.TIP_STROKE, v.TIP_BORE, v.TIP_ROD)),
        ("Side shift cylinder", 1, (v.SIDE_STROKE, v.SIDE_BORE, v.SIDE_ROD)),
        ("Steering cylinder", 2, (v.STEER_STROKE, v.STEER_BORE, v.STEER_ROD)),
        ("Wheel lean cylinder", 1, (v.LEAN_STROKE, v.LEAN_BORE, v.LEAN_ROD)),
        ("Articulation cylinder", 2, (v.BEND_STROKE, v.BEND_BORE, v.BEND_ROD)),
        ("Ripper lift cylinder", 2, (v.RIPPER_STROKE, v.RIPPER_BORE, v.RIPPER_ROD)),
    ))  # fmt: skip


def write(path: Path) -> None:
    """Writes the sheet."""
    write_pages(path, TITLE, _first, _second)
