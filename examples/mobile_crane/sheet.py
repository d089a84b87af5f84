"""Prints the crane's sheet in the lines of the maker's: what is published, and beside it, marked, what is ours; and the
load chart."""

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
    cells,
    cylinder_table,
    grid,
    heading,
    lines,
    opening,
    value_lines,
    write_pages,
)
from drawing.values import Value

from . import values as v

TITLE = f"Example rough-terrain crane, {v.MODEL} class"
SOURCE = (
    f"Published values are those of the {v.MAKE} {v.MODEL} ({v.FACTS}); its turning radius is that of the front wheels "
    "steered alone. Not a publication of the maker."
)
_UNITS = {"m/min": "{:g} m/min", "rpm": "{:g} rpm", "": "{:g}", "s": "{:g} s", "kg": "{:,.0f} kg"}


def _shown(value: Value) -> tuple[str, ...]:
    return (_UNITS[value.unit].format(value.value),) if value.unit in _UNITS else cells(value)


def _first(c: Canvas) -> None:
    top = opening(c, TITLE, SOURCE)
    y = heading(c, MARGIN, top, "Crane", HALF)
    y = value_lines(c, MARGIN, y, (
        ("Maximum lifting capacity", v.CAPACITY), ("Radius at maximum capacity", v.CAPACITY_RADIUS),
        ("Maximum lifting height, boom", v.LIFT_HEIGHT), ("Maximum working radius, boom", v.RADIUS_OUT),
        ("Slewing speed", v.SLEWING), ("Tail swing radius", v.TAIL),
    ), _shown)  # fmt: skip
    y = heading(c, MARGIN, y, "Boom", HALF)
    y = value_lines(c, MARGIN, y, (
        ("Boom length retracted", v.BOOM_IN), ("Boom length extended", v.BOOM_OUT),
        ("Number of boom sections", v.SECTIONS), ("Maximum boom angle", v.BOOM_HIGH),
        ("Minimum boom angle", v.BOOM_LOW), ("Boom luffing time", v.LUFFING_TIME),
        ("Boom telescoping time", v.TELESCOPE_TIME),
    ), _shown)  # fmt: skip
    y = heading(c, MARGIN, y, "Main winch", HALF)
    y = value_lines(c, MARGIN, y, (
        ("Single line speed", v.LINE_SPEED), ("Single line pull", v.LINE_PULL),
        ("Number of part lines", v.FALLS), ("Hoist rope diameter", v.ROPE),
    ), _shown)  # fmt: skip
    y = heading(c, MARGIN, y, "Hydraulic system", HALF)
    value_lines(c, MARGIN, y, (("Main pump flow", v.FLOW), ("Main relief pressure", v.PRESSURE)), _shown)
    y = heading(c, SECOND, top, "Dimensions", HALF)
    y = value_lines(c, SECOND, y, (
        ("Overall length", v.LENGTH), ("Overall width", v.WIDTH), ("Overall height", v.HEIGHT),
        ("Wheelbase", v.WHEELBASE), ("Ground clearance", v.CLEARANCE), ("Tyre diameter", v.TYRE),
    ), _shown)  # fmt: skip
    y = heading(c, SECOND, y, "Outriggers", HALF)
    y = value_lines(c, SECOND, y, (
        ("Outrigger spread, fully extended", v.SPREAD), ("Outrigger longitudinal spread", v.BASE),
    ), _shown)  # fmt: skip
    y = heading(c, SECOND, y, "Weight and engine", HALF)
    y = value_lines(c, SECOND, y, (("Gross vehicle weight", v.WEIGHT), ("Engine power", v.POWER)), _shown)
    y = heading(c, SECOND, y, "Carrier", HALF)
    y = value_lines(c, SECOND, y, (
        ("Maximum travel speed", v.SPEED), ("Turning radius, 2-wheel steering", v.TURNING),
    ), _shown)  # fmt: skip
    lines(c, SECOND, y, (Line("Tyres", ("385/95R25",)),), HALF)


def _second(c: Canvas) -> None:
    y = heading(c, MARGIN, HEIGHT - 60, "Hydraulic cylinders", FULL)
    sizes = {key: tuple(getattr(v, f"{key}_{x}") for x in ("STROKE", "BORE", "ROD"))
             for key in ("LUFFING", "TELESCOPE", "STEER", "BEAM", "JACK")}  # fmt: skip
    rows = [("Luffing", 1, sizes["LUFFING"]), ("Telescoping", 1, sizes["TELESCOPE"]), ("Steering", 2, sizes["STEER"])]
    rows += [("Outrigger beam", 4, sizes["BEAM"]), ("Outrigger jack", 4, sizes["JACK"])]
    y = cylinder_table(c, MARGIN, y, FULL, rows) - 30
    y = heading(c, MARGIN, y, "Total rated loads on outriggers, t (bounded by stability)", FULL)
    lengths, radii = sorted(v.CHART), sorted({r for row in v.CHART.values() for r in row})
    table = [[Cell(("Load radius",), head=True), *(Cell((f"{n:g} m",), head=True) for n in lengths)]]
    for r in radii:
        loads = [v.CHART[n].get(r) for n in lengths]
        table.append([Cell((f"{r:g} m",)), *(Cell(("" if one is None else f"{one:g}",)) for one in loads)])
    grid(c, MARGIN, y, [FULL / 4] * 4, table, 16)


def write(path: Path) -> None:
    """Writes the sheet."""
    write_pages(path, TITLE, _first, _second)
