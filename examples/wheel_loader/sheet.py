"""Writes `specifications.pdf`: the example wheel loader's specification sheet, in the layout of a maker's brochure.

`python -m wheel_loader.sheet [FOLDER]`, run in `examples/`.

Values come from `values.py`. A published one is printed as it is; one of our own carries the words "example value"
(beside the number, in its column's head or in its section's bar). The distractors a real brochure has (engine, tyres,
capacities, other buckets, a high-lift boom) are our own as well. Same bytes every time.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from reportlab.lib.colors import white
from reportlab.lib.pagesizes import A4
from reportlab.pdfgen.canvas import Canvas

from . import values as v
from .sheet_buckets import BUCKETS, Bucket
from .sheet_parts import (
    AMBER,
    BOLD,
    COLUMN,
    EXAMPLE_MARK,
    GREY,
    HEIGHT,
    INK,
    ITALIC,
    LEFT,
    MARGIN,
    PALE,
    REGULAR,
    RIGHT,
    WIDTH,
    Row,
    bar,
    bore_by_stroke,
    dual_flow,
    dual_mm,
    dual_pressure,
    feet,
    gallons,
    grid_row,
    grouped,
    inches,
    leader_rows,
    paragraph,
    pounds,
    rule,
    ruled_rows,
    text,
    yards,
)  # fmt: skip
from .sheet_views import keys, machine
from .values import Value

TITLE = "Example wheel loader (WA475-10 class)"
SOURCE = (
    f"Published values: {v.MAKE} {v.MODEL} brochure AESS942-0225, pages 18 and 19, as collected in EXO-Robotics/"
    "exo-equipment-atlas (machines/komatsu-wa475-10/evidence/facts.json)."
)
DISCLAIMER = (
    "Made for a software example. Not a document of, nor endorsed by, any manufacturer. Every figure marked "
    '"example value" is our own.'
)


def furniture(c: Canvas, page: int, heading: str) -> None:
    """Header and footer of an inner page."""
    c.setFillColor(AMBER)
    c.rect(0, HEIGHT - 44, WIDTH, 3, stroke=0, fill=1)
    text(c, MARGIN, HEIGHT - 33, heading, size=15, font=BOLD)
    text(c, WIDTH - MARGIN, HEIGHT - 33, TITLE, size=8, ink=GREY, align="r")
    rule(c, MARGIN, 40, WIDTH - MARGIN)
    text(c, MARGIN, 31, SOURCE, size=5.4, ink=GREY)
    text(c, MARGIN, 24, DISCLAIMER, size=5.4, ink=GREY)
    text(c, WIDTH - MARGIN, 24, str(page), size=7, font=BOLD, align="r")


# ---- page 1: title and headline figures ----------------------------------------------------------------------------
def cover(c: Canvas) -> None:
    """Title, drawing, three headline figures."""
    c.setFillColor(INK)
    c.rect(0, HEIGHT - 190, WIDTH, 190, stroke=0, fill=1)
    c.setFillColor(AMBER)
    c.rect(0, HEIGHT - 196, WIDTH, 6, stroke=0, fill=1)
    text(c, MARGIN, HEIGHT - 92, "Example wheel loader", size=34, font=BOLD, ink=white)
    text(c, MARGIN, HEIGHT - 120, "WA475-10 class", size=18, ink=AMBER)
    text(c, MARGIN, HEIGHT - 160, "Technical data sheet  |  standard boom, Z-bar loader linkage", size=10, ink=white)
    scale = (WIDTH - 2 * MARGIN - 40) / 9400
    machine(c, MARGIN + 20 + 4300 * scale, 420, scale, raised=False)
    tiles = (
        ("OPERATING WEIGHT", f"{grouped(v.OPERATING_WEIGHT.value)} kg", f"{pounds(v.OPERATING_WEIGHT.value)} lb"),
        (
            "BUCKET CAPACITY, HEAPED",
            f"{v.BUCKET_CAPACITY_HEAPED.value} m³",
            f"{yards(v.BUCKET_CAPACITY_HEAPED.value)} yd³",
        ),
        ("STATIC TIPPING LOAD, FULL TURN", f"{grouped(v.TIPPING_LOAD_FULL_TURN.value)} kg",
         f"{pounds(v.TIPPING_LOAD_FULL_TURN.value)} lb"),
    )  # fmt: skip
    third = (WIDTH - 2 * MARGIN - 24) / 3
    for index, (label, metric, imperial) in enumerate(tiles):
        x = MARGIN + index * (third + 12)
        c.setFillColor(PALE)
        c.rect(x, 270, third, 86, stroke=0, fill=1)
        c.setFillColor(AMBER)
        c.rect(x, 353, third, 3, stroke=0, fill=1)
        text(c, x + 12, 335, label, size=7.5, font=BOLD, ink=GREY)
        text(c, x + 12, 306, metric, size=20, font=BOLD)
        text(c, x + 12, 286, imperial, size=11, ink=GREY)
    y = 236.0
    for words in (
        "Figures are for the standard boom with the 4.2 m³ stock-pile bucket with bolt-on edge and 26.5R25 tyres "
        "unless a table says otherwise.",
        f'Figures marked "{EXAMPLE_MARK}" were chosen for this example: they are plausible for the class, and '
        "published by nobody. All other figures are published ones.",
        SOURCE,
        DISCLAIMER,
    ):
        y = paragraph(c, MARGIN, y, words, WIDTH - 2 * MARGIN, size=8) - 6


# ---- page 2: specifications in two columns -------------------------------------------------------------------------
def specifications(c: Canvas) -> None:
    """Engine, transmission, axles, tyres | steering, hydraulics, refills, sound."""
    furniture(c, 2, "Specifications")
    y = bar(c, LEFT, HEIGHT - 62, "ENGINE (example values)")
    y = leader_rows(
        c,
        LEFT,
        y,
        (
            Row("Type", "Water-cooled, 4-cycle, turbocharged"),
            Row("Number of cylinders", "6"),
            Row("Bore x stroke", "125 x 150 mm (4.9 x 5.9 in)"),
            Row("Piston displacement", "11.04 L (674 in³)"),
            Row("Gross power at 1,700 rpm", "217 kW (291 hp)"),
            Row("Net power at 1,700 rpm", "216 kW (290 hp)"),
            Row("Maximum torque at 1,250 rpm", "1,515 N·m (1,117 lbf·ft)"),
            Row("Low idle / high idle", "800 / 1,950 rpm"),
        ),
    )
    y = bar(c, LEFT, y, "TRANSMISSION (example values)")
    y = speeds(c, LEFT, y)
    y = bar(c, LEFT, y, "AXLES AND FINAL DRIVES")
    y = leader_rows(
        c,
        LEFT,
        y,
        (
            Row("Drive system", "Four-wheel drive"),
            Row("Front axle", "Fixed, semi-floating"),
            Row("Rear axle, total oscillation", f"{v.OSCILLATION_TOTAL.value:.0f}°"),
            Row("Vertical travel at rear wheel", "520 mm (20.5 in)", ours=True),
            Row("Final drive reduction", "4.588 : 1", ours=True),
        ),
    )
    y = bar(c, LEFT, y, "BRAKES (example values)")
    y = leader_rows(
        c,
        LEFT,
        y,
        (
            Row("Service brakes", "Wet disc, all four wheels"),
            Row("Brake charge pressure, cut-in", "11.8 MPa (1,711 psi)"),
            Row("Parking brake", "Spring applied, on output shaft"),
        ),
    )
    y = bar(c, LEFT, y, "TYRES")
    leader_rows(
        c,
        LEFT,
        y,
        (
            Row("Standard", v.TYRE_SIZE),
            Row("Optional", "775/65R29", ours=True),
            Row("Outside diameter", dual_mm(v.TYRE_DIAMETER), ours=True),
            Row("Section width", dual_mm(v.TYRE_WIDTH), ours=True),
            Row("Inflation pressure front / rear", "450 / 350 kPa", ours=True),
        ),
    )
    y = bar(c, RIGHT, HEIGHT - 62, "STEERING SYSTEM")
    y = ruled_rows(
        c,
        RIGHT,
        y,
        (
            Row("Type", "Articulated, fully hydraulic"),
            Row(
                "Steering angle",
                f"{v.STEER_ANGLE_NOMINAL.value:.0f}° each direction ({v.STEER_ANGLE.value:.0f}° to max. end stop)",
            ),
            Row(
                "Steering cylinders\nNumber of cylinders – bore x stroke",
                bore_by_stroke(v.STEER_COUNT, v.STEER_BORE, v.STEER_STROKE),
            ),
            Row("Steering cylinder, rod diameter", dual_mm(v.STEER_ROD), ours=True),
            Row("Steering pump flow", dual_flow(v.STEER_PUMP_FLOW), ours=True),
            Row("Steering relief pressure", dual_pressure(v.STEER_PRESSURE), ours=True),
            Row(v.TURNING_RADIUS.name, dual_mm(v.TURNING_RADIUS), ours=True),
        ),
    )  # fmt: skip
    y = bar(c, RIGHT, y, "HYDRAULIC SYSTEM")
    y = ruled_rows(
        c,
        RIGHT,
        y,
        (
            Row("Work equipment pump flow at 2,000 rpm", dual_flow(v.WORK_PUMP_FLOW), ours=True),
            Row("Main relief pressure, work equipment", dual_pressure(v.WORK_PRESSURE), ours=True),
            Row("Pilot pressure", "3.7 MPa (537 psi)", ours=True),
            Row("Lift cylinders\nNumber of cylinders – bore x stroke",
                bore_by_stroke(v.LIFT_COUNT, v.LIFT_BORE, v.LIFT_STROKE)),
            Row("Lift cylinder, rod diameter", dual_mm(v.LIFT_ROD), ours=True),
            Row("Bucket cylinder\nNumber of cylinders – bore x stroke",
                bore_by_stroke(v.TILT_COUNT, v.TILT_BORE, v.TILT_STROKE)),
            Row("Bucket cylinder, rod diameter", dual_mm(v.TILT_ROD), ours=True),
        ),
    )  # fmt: skip
    y = bar(c, RIGHT, y, "HYDRAULIC CYCLE TIME, RATED LOAD (example values)")
    total = v.TIME_RAISE.value + v.TIME_DUMP.value + v.TIME_LOWER.value
    y = ruled_rows(
        c,
        RIGHT,
        y,
        (
            Row("Raise", f"{v.TIME_RAISE.value} s"),
            Row("Dump", f"{v.TIME_DUMP.value} s"),
            Row("Lower, empty", f"{v.TIME_LOWER.value} s"),
            Row("Total", f"{total:.1f} s"),
        ),
    )
    y = bar(c, RIGHT, y, "SERVICE REFILL CAPACITIES (example values)")
    refills = (("Fuel tank", 375), ("Engine oil", 37), ("Hydraulic tank", 178), ("Front axle", 52), ("Rear axle", 50))
    y = ruled_rows(c, RIGHT, y, [Row(name, f"{n} L ({gallons(n, 1)} gal)") for name, n in refills])
    y = bar(c, RIGHT, y, "SOUND LEVELS (example values)")
    ruled_rows(
        c,
        RIGHT,
        y,
        (Row("Operator's ear, ISO 6396:2008", "69 dB(A)"), Row("Outside, ISO 6395:2008", "107 dB(A)")),
    )


def speeds(c: Canvas, x: float, y: float) -> float:
    """Travel speeds by gear: a small table with its own heads, no rules."""
    stops = (x + 92, x + 130, x + 168, x + 206, x + COLUMN)
    top = v.TRAVEL_SPEED_MAX.value
    forward, reverse = (7.1, 12.4, 22.6, top), (7.4, 13.0, 23.7, top)
    text(c, x, y, "Gear", font=BOLD)
    for stop, head in zip(stops, ("1st", "2nd", "3rd", "4th"), strict=False):
        text(c, stop, y, head, font=BOLD, align="r")
    y -= 13
    for name, row in (("Forward", forward), ("Reverse", reverse)):
        for unit, factor in (("km/h", 1.0), ("mph", 1 / 1.609344)):
            text(c, x, y, name if unit == "km/h" else "")
            for stop, speed in zip(stops, row, strict=False):
                text(c, stop, y, f"{speed * factor:.1f}", align="r")
            text(c, stops[4], y, unit, align="r")
            y -= 11
    return leader_rows(c, x, y - 2, (Row("Maximum travel speed", f"{top} km/h ({top / 1.609344:.1f} mph)"),))


# ---- page 3: dimensions --------------------------------------------------------------------------------------------
def dimensions(c: Canvas) -> None:
    """Letter-keyed drawing; table with the standard boom beside the high-lift boom; bucket angles."""
    furniture(c, 3, "Dimensions")
    scale = (WIDTH - 2 * MARGIN - 60) / 9650
    origin_x, ground = MARGIN + 34 + 4300 * scale, 476.0
    machine(c, origin_x, ground, scale, raised=True)
    keys(c, origin_x, ground, scale)
    y = bar(c, MARGIN, 416, "MACHINE DIMENSIONS WITH STOCK-PILE BUCKET", WIDTH - 2 * MARGIN)
    right = WIDTH - MARGIN
    stops = (right - 190, right - 132, right - 62, right)
    text(c, (stops[0] + stops[1]) / 2 - 14, y, "Standard boom", font=BOLD, align="c")
    text(c, (stops[2] + stops[3]) / 2 - 14, y, "High-lift boom", font=BOLD, align="c")
    text(c, (stops[2] + stops[3]) / 2 - 14, y - 7, EXAMPLE_MARK, size=5, font=ITALIC, ink=GREY, align="c")
    y -= 16
    for stop, unit in zip(stops, ("mm", "ft in", "mm", "ft in"), strict=True):
        text(c, stop, y, unit, size=6.2, ink=GREY, align="r")
    y -= 5
    rule(c, MARGIN, y, right, weight=0.8, ink=INK)
    y -= 10
    rows = (
        ("", "Tread", v.TREAD, v.TREAD.value),
        ("", "Width over tyres", v.WIDTH_OVER_TYRES, v.WIDTH_OVER_TYRES.value),
        ("A", "Wheelbase", v.WHEELBASE, v.WHEELBASE.value),
        ("B", "Hinge pin height, max. lift", v.HINGE_HEIGHT_MAX, 4870),
        ("C", "Hinge pin height, carry position", v.HINGE_HEIGHT_CARRY, 660),
        ("D", "Ground clearance", v.GROUND_CLEARANCE, v.GROUND_CLEARANCE.value),
        ("E", "Hitch height", v.HITCH_HEIGHT, v.HITCH_HEIGHT.value),
        ("F", "Height to top of exhaust stack", v.STACK_HEIGHT, v.STACK_HEIGHT.value),
        ("G", "Overall height, ROPS cab", v.CAB_HEIGHT, v.CAB_HEIGHT.value),
        ("H", "Height to roof rail", Value("roof rail", 3565, "mm"), 3565),
        ("J", "Rear axle centre to counterweight", v.REAR_OVERHANG, v.REAR_OVERHANG.value + 90),
    )
    for key, label, value, high in rows:
        text(c, MARGIN + 2, y, key, font=BOLD)
        width = text(c, MARGIN + 18, y, label)
        if not value.published:
            text(c, MARGIN + 22 + width, y, EXAMPLE_MARK, size=5, font=ITALIC, ink=GREY)
        for stop, cell in zip(stops, (grouped(value.value), feet(value.value), grouped(high), feet(high)), strict=True):
            text(c, stop, y, cell, align="r")
        rule(c, MARGIN, y - 4.6, right, weight=0.3)
        y -= 15.5
    y = bar(c, MARGIN, y - 6, "BUCKET ANGLES, STANDARD BOOM (example values)", WIDTH - 2 * MARGIN)
    pairs = (
        (("Rack back at ground", v.RACK_BACK_GROUND), ("Rack back at maximum lift", v.RACK_BACK_MAX)),
        (("Dump angle at maximum lift", v.DUMP_ANGLE_MAX), ("Approach angle, carry", v.APPROACH_ANGLE_CARRY)),
    )
    for pair in pairs:
        for x, (label, value) in zip((LEFT, RIGHT), pair, strict=True):
            text(c, x, y, label)
            text(c, x + COLUMN - 40, y, f"{value.value:.0f}°", align="r")
        y -= 14


# ---- page 4: buckets -----------------------------------------------------------------------------------------------
def buckets(c: Canvas) -> None:
    """The selection table: a full grid, one column a bucket, metric above imperial in each cell."""
    furniture(c, 4, "Bucket selection")
    text(
        c,
        MARGIN,
        HEIGHT - 60,
        "Standard boom, 26.5R25 tyres, full fuel tank, operator. Dumping figures at 45° with the boom fully raised.",
        size=7.5,
    )
    edges = [MARGIN, MARGIN + 24, MARGIN + 176]
    edges += [edges[-1] + (WIDTH - MARGIN - edges[-1]) * (i + 1) / len(BUCKETS) for i in range(len(BUCKETS))]
    y = HEIGHT - 76.0
    y = _heads(c, edges, y)
    rows: tuple[tuple[str, tuple[str, ...], Callable[[Bucket], tuple[str, str]]], ...] = (
        ("", ("Bucket capacity, heaped",), lambda b: (f"{b.heaped:.1f} m³", f"{yards(b.heaped)} yd³")),
        ("", ("Bucket capacity, struck",), lambda b: (f"{b.struck:.1f} m³", f"{yards(b.struck)} yd³")),
        ("", ("Bucket width",), lambda b: (f"{grouped(b.width)} mm", feet(b.width))),
        ("", ("Bucket weight",), lambda b: (f"{grouped(b.weight)} kg", f"{pounds(b.weight)} lb")),
        ("", ("Static tipping load, straight",), lambda b: _mass(b.tipping_straight)),
        ("", ("Static tipping load, 40° full turn",), lambda b: _mass(b.tipping_turned)),
        ("", ("Breakout force (example value)",), lambda b: _force(b.breakout)),
        ("H", ("Dumping clearance, max. lift", "and 45° dump angle"), lambda b: _length(b.clearance)),
        ("I", ("Reach at max. lift", "and 45° dump angle"), lambda b: _length(b.reach)),
        ("K", ("Digging depth, bucket level", "(example value)"), lambda b: _short(b.dig_depth)),
        ("L", ("Operating height, fully raised",), lambda b: _length(b.operating_height)),
        ("M", ("Overall length, bucket on ground",), lambda b: _length(b.overall_length)),
        ("", ("Operating weight",), lambda b: _mass(b.operating_weight)),
    )  # fmt: skip
    for key, label, cells in rows:
        height = 29.0
        grid_row(c, edges, y, height)
        text(c, (edges[0] + edges[1]) / 2, y - 17, key, font=BOLD, align="c")
        for index, line in enumerate(label):
            text(c, edges[1] + 5, y - 17 + 4.6 * (len(label) - 1) - 9.2 * index, line)
        for column, bucket in enumerate(BUCKETS):
            metric, imperial = cells(bucket)
            centre = (edges[2 + column] + edges[3 + column]) / 2
            text(c, centre, y - 12.5, metric, align="c", font=BOLD if column == 0 else REGULAR)
            text(c, centre, y - 22.5, imperial, size=6.4, ink=GREY, align="c")
        y -= height
    y = paragraph(
        c,
        MARGIN,
        y - 14,
        "Capacities after ISO 7546, static tipping loads after ISO 14397-1 with rigid tyres, dimensions after ISO "
        "7131. The other three buckets are of our own choosing, to stand where a brochure offers alternatives.",
        WIDTH - 2 * MARGIN,
        size=6.5,
    )
    tyre_options(c, bar(c, MARGIN, y - 4, "OTHER TYRES: CHANGES (example values)", WIDTH - 2 * MARGIN) + 6)


def tyre_options(c: Canvas, y: float) -> None:
    """What other tyres change: a grid whose heads name the properties and whose rows are the options."""
    edges = [MARGIN + (WIDTH - 2 * MARGIN) * i / 5 for i in range(6)]
    heads = (
        "Tyre",
        "Change in operating weight",
        "Change in tipping load, 40°",
        "Change in overall width",
        "Change in height",
    )
    rows = (
        ("26.5R25 L5", "+580 kg", "+420 kg", "0 mm", "+15 mm"),
        ("775/65R29", "+240 kg", "+170 kg", "+95 mm", "-10 mm"),
        ("Solid 26.5", "+1,900 kg", "+1,370 kg", "+5 mm", "-20 mm"),
    )
    for index, row in enumerate((heads, *rows)):
        if index == 0:
            c.setFillColor(PALE)
            c.rect(edges[0], y - 17, edges[-1] - edges[0], 17, stroke=0, fill=1)
        grid_row(c, edges, y, 17)
        for left, right, words in zip(edges, edges[1:], row, strict=False):
            text(c, (left + right) / 2, y - 11, words, align="c", font=BOLD if index == 0 else REGULAR, size=6.8)
        y -= 17


def _heads(c: Canvas, edges: Sequence[float], y: float) -> float:
    """Two rows of heads: the bucket's kind spans its columns, its edge stands below."""
    spans = ((2, 4), (4, 5), (5, 6))
    c.setFillColor(PALE)
    c.rect(edges[0], y - 44, edges[-1] - edges[0], 44, stroke=0, fill=1)
    c.setStrokeColor(GREY)
    c.setLineWidth(0.5)
    c.rect(edges[0], y - 44, edges[2] - edges[0], 44)
    text(c, edges[0] + 6, y - 25, "Bucket type", font=BOLD)
    for first, last in spans:
        c.rect(edges[first], y - 18, edges[last] - edges[first], 18)
        text(c, (edges[first] + edges[last]) / 2, y - 12, BUCKETS[first - 2].head[0], font=BOLD, align="c")
    for column, bucket in enumerate(BUCKETS):
        c.rect(edges[2 + column], y - 44, edges[3 + column] - edges[2 + column], 26)
        centre = (edges[2 + column] + edges[3 + column]) / 2
        text(c, centre, y - 28, bucket.head[1], align="c")
        if column:
            text(c, centre, y - 38, EXAMPLE_MARK, size=5, font=ITALIC, ink=GREY, align="c")
    return y - 44


def _length(mm: float) -> tuple[str, str]:
    return f"{grouped(mm)} mm", feet(mm)


def _short(mm: float) -> tuple[str, str]:
    return f"{mm:.0f} mm", f"{inches(mm)} in"


def _force(kn: float) -> tuple[str, str]:
    return f"{kn:.0f} kN", f"{grouped(kn * 224.809)} lbf"


def _mass(kg: float) -> tuple[str, str]:
    return f"{grouped(kg)} kg", f"{pounds(kg)} lb"


def write(path: Path) -> None:
    """Writes the sheet."""
    c = Canvas(str(path), pagesize=A4, invariant=1, pageCompression=0)
    c.setTitle(f"{TITLE}: technical data")
    c.setAuthor("yellowiron examples")
    c.setSubject("Specification sheet of an example machine")
    for page in (cover, specifications, dimensions, buckets):
        page(c)
        c.showPage()
    c.save()


if __name__ == "__main__":
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent
    write(folder / "specifications.pdf")
    print(folder / "specifications.pdf")
