"""Prints the dozer's sheet: what the maker publishes, and beside it, marked, what is ours."""

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
    flow,
    heading,
    lines,
    mass,
    opening,
    pressure,
    speed,
    value_lines,
    write_pages,
)

from . import values as v

TITLE = "Example dozer, D6 class, six-way blade"
SOURCE = (
    f"Published values are those of the {v.BROCHURE} (610 mm shoes, 42 sections, on push arms); the six-way blade and "
    "its cylinders are ours. Dimensions after ISO 6746-1 and ISO 6747. Not a publication of the maker."
)


def _first(c: Canvas) -> None:
    x, top = MARGIN, opening(c, TITLE, SOURCE)
    y = heading(c, x, top, "Engine and weight", HALF)
    rows = (
        Line("Net power, ISO 9249", (f"{v.NET_POWER.value:.0f} kW", "216 hp")),
        Line("Operating weight", mass(v.OPERATING_WEIGHT.value)),
    )
    y = lines(c, x, y, rows, HALF)
    y = heading(c, x, y, "Hydraulic system", HALF)
    rows = (
        Line("Pump flow", flow(v.FLOW.value), ours=True),
        Line("Main relief pressure", pressure(v.PRESSURE.value), ours=True),
    )
    y = lines(c, x, y, rows, HALF)
    y = heading(c, x, y, "Travel", HALF)
    rows = (
        Line("Maximum travel speed", speed(v.TRAVEL_SPEED.value), ours=True),
        Line("Maximum drawbar pull", (f"{v.DRAWBAR_PULL.value:.0f} kN", "71,900 lbf"), ours=True),
    )
    lines(c, x, y, rows, HALF)
    x = SECOND
    y = heading(c, x, top, "Undercarriage", HALF)
    y = value_lines(c, x, y, (("Track gauge", v.TRACK_GAUGE), ("Shoe width", v.SHOE_WIDTH),
                              ("Length of track on ground", v.TRACK_ON_GROUND)))  # fmt: skip
    rows = (
        Line("Number of shoes, each side", (f"{v.SHOES.value:.0f}",)),
        Line("Track rollers, each side", (f"{v.TRACK_ROLLERS.value:.0f}",)),
    )
    y = lines(c, x, y, rows, HALF)
    y = heading(c, x, y, "Dimensions", HALF)
    y = value_lines(c, x, y, (
        ("Width over tracks", v.WIDTH), ("Overall height", v.HEIGHT), ("Ground clearance", v.GROUND_CLEARANCE),
        ("Length without blade", v.BARE_LENGTH),
    ))  # fmt: skip
    y = heading(c, x, y, "Blade", HALF)
    value_lines(c, x, y, (
        ("Blade width, over end bits", v.BLADE_WIDTH), ("Blade lift height", v.LIFT_HEIGHT),
        ("Digging depth", v.DIG_DEPTH), ("Maximum blade tilt", v.MAX_TILT),
        ("Blade angle, each side", v.BLADE_ANGLE),
    ))  # fmt: skip


def _second(c: Canvas) -> None:
    y = heading(c, MARGIN, HEIGHT - 60, "Hydraulic cylinders", FULL)
    kinds = (
        ("Blade lift cylinder", 2, "LIFT"),
        ("Blade tilt cylinder", 1, "TILT"),
        ("Blade angle cylinder", 2, "ANGLE"),
    )
    rows = [
        (name, count, tuple(getattr(v, f"{key}_{what}") for what in ("STROKE", "BORE", "ROD")))
        for name, count, key in kinds
    ]
    cylinder_table(c, MARGIN, y, FULL, rows)  # type: ignore[arg-type]


def write(path: Path) -> None:
    """Writes the sheet."""
    write_pages(path, TITLE, _first, _second)
