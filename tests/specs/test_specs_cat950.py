"""A second wheel loader, whose sheet gives no cylinders: Caterpillar 950, CAT-950-AEXQ4425-00-NAM
(EXO-Robotics/exo-equipment-atlas, cat-950). The columns beside the teeth-and-segments one are our own."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from specs_layouts import bar, canvas, lattice, leaders, put, ruled

from yellowiron.library import load_template
from yellowiron.specs import extract


def feet(mm: float) -> str:
    inches = round(mm / 25.4)
    return f"{inches // 12}'{inches % 12}\""


def both(*values: float) -> list[str]:
    return [f"{value:.0f} mm\n{feet(value)}" for value in values]


def draw(path: Path) -> None:
    c = canvas(path)
    bar(c, 36, 790, "Operating Specifications", 520)
    y = lattice(
        c,
        36,
        770,
        [150, 92, 92, 92, 94],
        [
            ["Bucket type", "General purpose", "<", "Material handling", "<"],
            [None, "Bolt-on cutting edge", "Teeth and segments", "Bolt-on cutting edge", "Teeth and segments"],
            ["Bucket rated capacity", "3.3 m³\n4.3 yd³", "3.1 m³\n4.1 yd³", "3.6 m³\n4.7 yd³", "3.4 m³\n4.4 yd³"],
            ["Bucket width", *both(2927, 2994, 2927, 2994)],
            ["Dump clearance at maximum\nlift and 45° discharge", *both(2876, 2746, 2800, 2668)],
            ["Reach at maximum lift\nand 45° discharge", *both(1424, 1546, 1500, 1620)],
            ["Overall height at maximum lift", *both(5513, 5513, 5600, 5600)],
            ["Breakout force", "180 kN", "179 kN", "166 kN", "165 kN"],
            ["Operating weight", "19 421 kg", "19 369 kg", "19 480 kg", "19 431 kg"],
        ],
        heads=2,
    )
    bar(c, 36, y - 30, "Dimensions", 520)
    lengths = [
        ("1 Height to axle centerline", 734),
        ("2 Height to top of hood", 2695),
        ("4 Height to top of ROPS", 3456),
        ("7 Ground clearance", 354),
        ("8 Rear axle centerline to edge of counterweight", 2063),
        ("9 Rear axle centerline to hitch", 1675),
        ("10 Wheelbase", 3350),
        ("11 Overall length without bucket", 7024),
        ("13 Hinge pin height at carry", 623),
        ("14 Hinge pin height at maximum lift", 4009),
        ("15 Lift arm clearance at maximum lift", 3255),
        ("25 Width over tires", 2824),
        ("26 Tread width", 2140),
    ]
    angles = [
        ("18 Dump angle at maximum lift", 51),
        ("19 Rack back at maximum lift", 59),
        ("20 Rack back at carry", 49),
        ("21 Rack back at ground", 39),
    ]
    rows = [(label, f"{mm} mm", feet(mm)) for label, mm in lengths] + [(a, f"{d} degrees", "") for a, d in angles]
    y = ruled(c, 36, y - 50, [330, 400], rows)
    bar(c, 36, y - 12, "Hydraulic Cycle Time", 250)
    leaders(
        c,
        36,
        y - 30,
        250,
        [
            ("Raise from carry position, rated payload", "5.1 seconds"),
            ("Dump at maximum raise", "1.5 seconds"),
            ("Lower, empty, float down", "2.5 seconds"),
            ("Total hydraulic cycle time", "9.1 seconds"),
        ],
    )
    bar(c, 306, y - 12, "Engine", 250)
    leaders(
        c,
        306,
        y - 30,
        250,
        [("Maximum power at 2100 rpm - ISO 14396", "186 kW 249 hp"), ("Bore", "105 mm"), ("Stroke", "135 mm")],
    )
    put(c, 36, 50, "Rear axle oscillation ±13 degrees")
    c.save()


def test_everything_the_sheet_says_and_nothing_else(tmp_path: Path) -> None:
    draw(tmp_path / "cat950.pdf")
    found = extract(
        load_template("wheel_loader"), [tmp_path / "cat950.pdf"], config="general purpose, teeth and segments"
    )
    assert {s.name: s.value for s in found if s.status == "ok"} == pytest.approx(
        {
            "Bucket Capacity Heaped": 3.1,
            "Bucket Width": 2.994,
            "Dumping Clearance": 2.746,
            "Dumping Reach": 1.546,
            "Overall Operating Height": 5.513,
            "Breakout Force": 179e3,
            "Operating Weight": 19369.0,
            "Axle Height": 0.734,
            "Overall Height": 3.456,
            "Ground Clearance": 0.354,
            "Rear Overhang": 2.063,
            "Wheelbase": 3.35,
            "Hinge Pin Height at Carry": 0.623,
            "Hinge Pin Height at Maximum Lift": 4.009,
            "Overall Width": 2.824,
            "Tread": 2.14,
            "Dump Angle at Maximum Lift": math.radians(51),
            "Rack Back at Maximum Lift": math.radians(59),
            "Rack Back at Carry": math.radians(49),
            "Rack Back at Ground": math.radians(39),
            "Rear Axle Oscillation Each Way": math.radians(13),
            "Rear Axle to Hitch": 1.675,
            "Overall Length Without Bucket": 7.024,
            "Lift Arm Clearance at Maximum Lift": 3.255,
            "Gross Power": 186e3,
            "Raise Time": 5.1,
            "Dump Time": 1.5,
            "Lower Time": 2.5,
            "Total Cycle Time": 9.1,
        },
        rel=1e-9,
    )
    assert {s.status for s in found if s.status != "ok"} == {"missing"}
