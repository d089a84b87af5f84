"""Writes `specifications.pdf`: the example excavator's specification sheet, in the layout of a maker's brochure.

`python -m excavator.sheet_excavator [folder]`, run in `examples/`; the same bytes every time. Values come from
`values.py`. A published one is printed as it is; one of our own carries the words "example value" (behind its label,
in its column's head or in its section's heading). What a real brochure prints besides (engine, capacities, other
shoes, booms, arms and buckets) is our own as well.
"""

from __future__ import annotations

import sys
from pathlib import Path

from reportlab.lib.pagesizes import A4, landscape
from reportlab.pdfgen.canvas import Canvas

from drawing.sheet_print import (
    BOLD,
    ITALIC,
    TEAL,
    Cell,
    Line,
    feet,
    flow,
    force,
    grid,
    grouped,
    heading,
    length,
    lines,
    litres,
    mass,
    pressure,
    prose,
    say,
    short,
    speed,
    torque,
)
from drawing.values import Value

from . import values as v
from .sheet_drawings import ranges, transport

WIDTH, HEIGHT = A4
MARGIN = 42.0
HALF = (WIDTH - 2 * MARGIN - 26) / 2
TITLE = "Example crawler excavator (PC210LC-11 class)"
STANDARD = (
    f"All figures are for the standard machine with {v.BOOM_LENGTH.value:.0f} mm one-piece boom, "
    f"{v.ARM_LENGTH.value:.0f} mm arm, {v.BUCKET_CAPACITY.value} m³ bucket and {v.SHOE_WIDTH.value:.0f} mm shoes "
    "unless a table says otherwise."
)
SOURCE = (
    f"Published values: {v.MAKE} {v.MODEL}, brochure BR02-0225-V2, as collected in EXO-Robotics/exo-equipment-atlas "
    "(machines/komatsu-pc210lc-11/evidence/facts.json)."
)
DISCLAIMER = (
    "Made for a software example. Not a document of, nor endorsed by, any manufacturer. Every figure marked "
    '"example value" is our own.'
)


def page_frame(c: Canvas, number: int, title: str, width: float, height: float) -> None:
    """Head and foot of an inner page."""
    say(c, MARGIN, height - 34, title, size=17, font=BOLD, ink=TEAL)
    say(c, width - MARGIN, height - 34, TITLE, size=8, font=ITALIC, align="r")
    say(c, MARGIN, 30, SOURCE, size=5.6)
    say(c, MARGIN, 23, DISCLAIMER, size=5.6)
    say(c, width - MARGIN, 23, str(number), size=8, font=BOLD, align="r")


# ---- page 1 --------------------------------------------------------------------------------------------------------
def cover(c: Canvas) -> None:
    """Title, picture, what the figures are for."""
    say(c, MARGIN, HEIGHT - 96, "Example crawler excavator", size=33, font=BOLD, ink=TEAL)
    say(c, MARGIN, HEIGHT - 122, "PC210LC-11 class", size=18)
    scale = (WIDTH - 2 * MARGIN) / 10400
    transport(c, MARGIN + 3100 * scale, 430, scale)
    low, high = v.OPERATING_WEIGHT_RANGE.value, v.OPERATING_WEIGHT_RANGE.high or 0.0
    tiles = (
        ("Net power", f"{v.NET_POWER.value} kW", "165 hp"),
        ("Operating weight, all configurations", f"{grouped(low)} – {grouped(high)} kg", "51,397 – 53,881 lb"),
        ("Bucket capacity", f"{v.BUCKET_CAPACITY.value} m³", "1.11 yd³"),
    )
    for index, (label, metric, imperial) in enumerate(tiles):
        x = MARGIN + index * (WIDTH - 2 * MARGIN) / 3
        say(c, x, 318, metric, size=17, font=BOLD)
        say(c, x, 302, label, size=8)
        say(c, x, 291, imperial, size=8, font=ITALIC)
    y = 246.0
    marked = (
        'Figures marked "example value" were chosen for this example: plausible for the class, published by nobody.'
    )
    for words in (STANDARD, marked, SOURCE, DISCLAIMER):
        y = prose(c, MARGIN, y, words, WIDTH - 2 * MARGIN, size=9) - 5


# ---- page 2 --------------------------------------------------------------------------------------------------------
def specifications(c: Canvas) -> None:
    """Engine, hydraulics, cylinders | drives, swing, undercarriage, equipment; operating weight by shoes."""
    page_frame(c, 2, "Specifications", WIDTH, HEIGHT)
    x = MARGIN
    y = heading(c, x, HEIGHT - 66, "Engine", HALF)
    engine = (
        Line("Aspiration", ("Turbocharged, aftercooled",)),
        Line("Number of cylinders", ("6",), ours=True),
        Line("Bore", short(107), ours=True),
        Line("Stroke", short(124), ours=True),
        Line("Piston displacement", ("6.69 L", "408 in³"), ours=True),
        Line("Net power at 2,000 rpm", (f"{v.NET_POWER.value} kW", "165 hp")),
    )
    y = lines(c, x, y, engine, HALF)
    y = heading(c, x, y, "Hydraulic system (example values)", HALF)
    hydraulics = (
        Line("Main pumps", ("2 variable displacement",)),
        Line("Maximum flow", flow(v.PUMP_FLOW.value), under=True),
        Line("Pilot pump flow", flow(34), under=True),
        Line("Relief valve setting"),
        Line("Implement circuits", pressure(v.MAIN_PRESSURE.value), under=True),
        Line("Travel circuit", pressure(v.TRAVEL_PRESSURE.value), under=True),
        Line("Swing circuit", pressure(v.SWING_PRESSURE.value), under=True),
        Line("Pilot circuit", pressure(3.2), under=True),
    )
    y = lines(c, x, y, hydraulics, HALF)
    y = heading(c, x, y, "Hydraulic cylinders", HALF)
    cylinders(c, x, y + 8)
    x = MARGIN + HALF + 26
    y = heading(c, x, HEIGHT - 66, "Drives and brakes (example values)", HALF)
    drives = (
        Line("Steering control", ("Two levers with pedals",)),
        Line("Maximum drawbar pull", force(v.DRAWBAR_PULL.value)),
        Line("Gradeability", (f"{v.GRADEABILITY.value:.0f}°",)),
        Line("Maximum travel speed"),
        Line("High", speed(v.TRAVEL_SPEED_HIGH.value), under=True),
        Line("Mid", speed(v.TRAVEL_SPEED_MID.value), under=True),
        Line("Low", speed(v.TRAVEL_SPEED_LOW.value), under=True),
    )
    y = lines(c, x, y, drives, HALF)
    y = heading(c, x, y, "Swing system (example values)", HALF)
    swing = (
        Line("Driven by", ("Hydraulic motor, planetary gear",)),
        Line("Swing speed", (f"{v.SWING_SPEED.value:.1f} rpm",)),
        Line("Swing torque", torque(v.SWING_TORQUE.value)),
    )
    y = lines(c, x, y, swing, HALF)
    y = heading(c, x, y, "Undercarriage (example values)", HALF)
    undercarriage = (
        Line("Number of shoes, each side", (f"{v.SHOES.value:.0f}",)),
        Line("Number of carrier rollers, each side", (f"{v.CARRIER_ROLLERS.value:.0f}",)),
        Line("Number of track rollers, each side", (f"{v.TRACK_ROLLERS.value:.0f}",)),
        Line("Ground pressure, 700 mm shoes", ("42.6 kPa", "6.2 psi")),
    )
    y = lines(c, x, y, undercarriage, HALF)
    y = heading(c, x, y, "Working equipment", HALF)
    equipment = (
        Line("Boom length, one-piece", length(v.BOOM_LENGTH.value)),
        Line("Arm length", length(v.ARM_LENGTH.value)),
        Line("Counterweight", mass(v.COUNTERWEIGHT.value)),
    )
    y = lines(c, x, y, equipment, HALF)
    y = heading(c, x, y, "Service refill capacities (example values)", HALF)
    refills = (("Fuel tank", 400), ("Engine oil", 23.1), ("Swing drive", 6.5), ("Final drive, each side", 5),
               ("Hydraulic tank", 132))  # fmt: skip
    lines(c, x, y, [Line(name, litres(n)) for name, n in refills], HALF)
    weights(c, 300)


def cylinders(c: Canvas, x: float, top: float) -> None:
    """A grid: one row a cylinder, what is published beside what is ours."""
    widths = (64.0, 34.0, 60.0, 44.0, HALF - 202)
    head = [
        Cell(("Cylinder",), head=True),
        Cell(("No.",), head=True),
        Cell(("Stroke",), head=True),
        Cell(("Bore",), head=True, mark=True),
        Cell(("Rod dia.",), head=True, mark=True),
    ]
    rows = [head]
    for name, count, stroke, bore, rod in (
        ("Boom", v.BOOM_COUNT, v.BOOM_STROKE, v.BOOM_BORE, v.BOOM_ROD),
        ("Arm", v.ARM_COUNT, v.ARM_STROKE, v.ARM_BORE, v.ARM_ROD),
        ("Bucket", v.BUCKET_COUNT, v.BUCKET_STROKE, v.BUCKET_BORE, v.BUCKET_ROD),
    ):
        cells = (f"{count.value:.0f}", *(f"{grouped(each.value)} mm" for each in (stroke, bore, rod)))
        rows.append([Cell((name,), align="l"), *(Cell((words,)) for words in cells)])
    grid(c, x, top, widths, rows, 21)


def weights(c: Canvas, y: float) -> None:
    """Operating weight and ground pressure by shoes: the shoes are the columns."""
    y = heading(c, MARGIN, y, "Operating weight by shoes", WIDTH - 2 * MARGIN)
    words = (
        "Operating weight, including one-piece boom, arm, bucket, rated capacity of lubricants, coolant, full fuel "
        "tank and operator."
    )
    y = prose(c, MARGIN, y + 3, words, WIDTH - 2 * MARGIN, size=7)
    low, high = v.OPERATING_WEIGHT_RANGE.value, v.OPERATING_WEIGHT_RANGE.high or 0.0
    heads = ("600 mm shoes", f"{v.SHOE_WIDTH.value:.0f} mm shoes", "800 mm shoes")
    rows = [
        [
            Cell(("Triple grouser shoes",), head=True, align="l"),
            *(Cell((h,), head=True, mark=h.startswith("7")) for h in heads),
        ],
        [Cell(("Operating weight",), align="l")]
        + [Cell((" / ".join(mass(kg)),)) for kg in (low, v.OPERATING_WEIGHT.value, high)],
        [Cell(("Ground pressure",), align="l", mark=True)]
        + [Cell((f"{kpa} kPa / {kpa * 0.1450377:.1f} psi",)) for kpa in (49.0, 42.6, 38.5)],
    ]
    grid(c, MARGIN, y + 4, (132, *[(WIDTH - 2 * MARGIN - 132) / 3] * 3), rows, 22)


# ---- page 3 --------------------------------------------------------------------------------------------------------
def dimensions(c: Canvas) -> None:
    """Letter-keyed drawing; a grid by arm, cells merged where the arm does not matter."""
    page_frame(c, 3, "Dimensions", WIDTH, HEIGHT)
    scale = (WIDTH - 2 * MARGIN) / 10600
    transport(c, MARGIN + 3200 * scale, 590, scale)
    rows = [
        [
            Cell(("",), head=True),
            Cell((f"Boom: {v.BOOM_LENGTH.value:.0f} mm one-piece",), head=True, align="l"),
            Cell(("2410 mm arm",), head=True, mark=True),
            Cell((f"{v.ARM_LENGTH.value:.0f} mm arm",), head=True),
        ],
        _by_arm("A", "Overall length", 9750, v.OVERALL_LENGTH),
        _by_arm("B", "Length on ground (transport)", 5390, Value("on ground", 4985, "mm")),
        _by_arm("C", "Overall height (to top of boom)", 3190, v.BOOM_HEIGHT),
    ]
    for key, label, value in (
        ("D", "Overall width", v.OVERALL_WIDTH),
        ("E", "Overall height (to top of cab)", v.CAB_HEIGHT),
        ("F", "Overall height (to top of handrail)", v.HANDRAIL_HEIGHT),
        ("G", "Ground clearance, counterweight", v.COUNTERWEIGHT_CLEARANCE),
        ("H", "Ground clearance (minimum)", v.GROUND_CLEARANCE),
        ("I", "Tail swing radius", v.TAIL_RADIUS),
        ("J", "Track length on ground", v.TRACK_ON_GROUND),
        ("K", "Track length", v.TRACK_LENGTH),
        ("L", "Track gauge", v.TRACK_GAUGE),
        ("M", "Width of crawler, 800 mm shoes", Value("wide shoes", 3180, "mm")),
        ("N", "Shoe width", v.SHOE_WIDTH),
        ("P", "Track height", v.TRACK_HEIGHT),
        ("Q", "Width of upper structure", v.UPPER_WIDTH),
    ):
        cells = [Cell((key,)), Cell((label,), align="l", mark=not value.published)]
        rows.append([*cells, Cell((_both(value.value),), across=2)])
    widths = (24, 215, *[(WIDTH - 2 * MARGIN - 239) / 2] * 2)
    grid(c, MARGIN, 500, widths, rows, 22)


def _by_arm(key: str, label: str, shorter: float, standard: Value) -> list[Cell]:
    cells = [Cell((_both(mm),)) for mm in (shorter, standard.value)]
    return [Cell((key,)), Cell((label,), align="l", mark=not standard.published), *cells]


def _both(mm: float) -> str:
    metric, imperial = length(mm)
    return f"{metric} ({imperial})"


# ---- page 4 --------------------------------------------------------------------------------------------------------
def working_ranges(c: Canvas) -> None:
    """Landscape: the envelope beside the matrix of booms and arms; its letters are its own."""
    c.setPageSize(landscape(A4))
    width, height = landscape(A4)
    page_frame(c, 4, "Working ranges and digging forces", width, height)
    scale = 300 / 14000
    ranges(c, MARGIN + 3600 * scale, 250, scale)
    arm, boom = f"{v.ARM_LENGTH.value:.0f} mm", f"{v.BOOM_LENGTH.value:.0f} mm one-piece"
    rows = [
        [
            Cell(("",), across=2, head=True),
            Cell(("Boom length",), head=True, align="l"),
            Cell((boom,), across=2, head=True),
            Cell(("5850 mm two-piece",), across=2, head=True, mark=True),
        ],
        [
            Cell(("",), across=2, head=True),
            Cell(("Arm length",), head=True, align="l"),
            Cell(("2410 mm",), head=True, mark=True),
            Cell((arm,), head=True),
            Cell(("2410 mm",), head=True, mark=True),
            Cell((arm,), head=True, mark=True),
        ],
    ]
    table = (
        ("A", ("Max. digging height",), v.DIGGING_HEIGHT, (9790, 10640, 10930)),
        ("B", ("Max. dumping height",), v.DUMPING_HEIGHT, (6930, 7660, 7960)),
        ("C", ("Max. digging depth",), v.DIGGING_DEPTH, (6110, 5980, 6460)),
        ("D", ("Max. vertical wall digging", "depth"), v.WALL_DEPTH, (5280, 4960, 5470)),
        ("E", ("Max. digging depth of cut for", f"{v.LEVEL_LENGTH:.0f} mm ({feet(v.LEVEL_LENGTH)}) level bottom"),
         v.LEVEL_DEPTH, (5900, 5860, 6350)),
        ("F", ("Max. digging reach",), v.MAX_REACH, (9410, 9620, 10080)),
        ("G", ("Max. digging reach at ground", "level"), v.GROUND_REACH, (9230, 9440, 9910)),
        ("H", ("Min. swing radius",), v.SWING_RADIUS_MIN, (3340, 2600, 2480)),
        ("I", ("Min. dumping height",), v.DUMPING_HEIGHT_MIN, (3060, 3390, 2870)),
    )  # fmt: skip
    for number, (key, label, value, others) in enumerate(table):
        first = [Cell(("Working", "range"), down=len(table), head=True)] if number == 0 else []
        columns = (others[0], value.value, others[1], others[2])
        rows.append(
            [
                *first,
                Cell((key,)),
                Cell(label, align="l", mark=not value.published),
                *(Cell(length(mm)) for mm in columns),
            ]
        )
    forces = (
        (("Bucket digging force",), v.BUCKET_FORCE, (138, 138, 138)),
        (("Arm digging force",), v.ARM_FORCE, (122, 122, 103)),
    )
    for number, (label, value, others) in enumerate(forces):
        first = [Cell(("ISO", "6015"), across=2, down=2, head=True)] if number == 0 else []
        columns = (others[0], value.value, others[1], others[2])
        rows.append([*first, Cell(label, align="l", mark=True), *(Cell(force(kn)) for kn in columns)])
    widths = (44, 22, 140, *[(width - 2 * MARGIN - 310 - 206) / 4] * 4)
    grid(c, MARGIN + 310, height - 60, widths, rows, 33)


# ---- page 5 --------------------------------------------------------------------------------------------------------
def buckets(c: Canvas) -> None:
    """One row a bucket: heads name the properties; dots say which arm takes it."""
    c.setPageSize(A4)
    page_frame(c, 5, "Bucket and arm combinations", WIDTH, HEIGHT)
    mark = [True, False, True]
    rows = [
        [
            Cell(("Bucket capacity", "ISO 7451, heaped"), head=True, down=2),
            Cell(("Bucket width",), head=True, down=2),
            Cell(("Bucket weight",), head=True, down=2, mark=True),
            Cell(("Number", "of teeth"), head=True, down=2, mark=True),
            Cell(("Arm",), head=True, across=2),
        ],
        [Cell(("2410 mm",), head=True), Cell((f"{v.ARM_LENGTH.value:.0f} mm",), head=True)],
    ]
    for ours, capacity, wide, heavy, teeth, on_short, on_long in zip(
        mark, (0.68, v.BUCKET_CAPACITY.value, 1.02), (762, v.BUCKET_WIDTH.value, 1067),
        (655, v.BUCKET_WEIGHT.value, 835), (4, 5, 5), "○○○", "○○□", strict=True
    ):  # fmt: skip
        del on_short, on_long
        rows.append(
            [
                Cell((f"{capacity:.2f} m³", f"{capacity / 0.764554857984:.2f} yd³"), mark=ours),
                Cell(short(wide)),
                Cell(mass(heavy)),
                Cell((str(teeth),)),
                Cell(("yes",)),
                Cell(("yes" if capacity < 1 else "light material",)),
            ]
        )
    bottom = grid(c, MARGIN, HEIGHT - 62, [(WIDTH - 2 * MARGIN) / 6] * 6, rows, 32)
    prose(
        c,
        MARGIN,
        bottom - 18,
        f"The standard bucket is the {v.BUCKET_CAPACITY.value} m³ one. Capacities after ISO 7451, digging forces after "
        "ISO 6015, working ranges after ISO 7135, dimensions after ISO 6746-1. The other booms, arms, buckets and "
        "shoes are of our own choosing, to stand where a brochure offers alternatives.",
        WIDTH - 2 * MARGIN,
        size=7.5,
    )


def write(path: Path) -> None:
    """Writes the sheet."""
    c = Canvas(str(path), pagesize=A4, invariant=1, pageCompression=0)
    c.setTitle(f"{TITLE}: technical data")
    c.setAuthor("yellowiron examples")
    c.setSubject("Specification sheet of an example machine")
    for page in (cover, specifications, dimensions, working_ranges, buckets):
        page(c)
        c.showPage()
    c.save()


if __name__ == "__main__":
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent
    write(folder / "specifications.pdf")
