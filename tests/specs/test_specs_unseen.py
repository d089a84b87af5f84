"""Layouts and machines that were held back while the rules were made.

First reading, before any rule was changed for them. Bobcat S76, D6 and 773F: 15 of 25 right, 1 wrong (a card's caption
taken for a column's head), 9 not ok. After general rules for those, 140 and 740 GC: 16 of 20 right, 0 wrong, 4 not ok;
and with the wheel loader's questions put to them, 1 wrong of 7 (a front axle's oscillation taken for the rear's). These
tests keep what was reached then.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from reportlab.lib.colors import HexColor
from specs_layouts import bar, canvas, lattice, put, template, wanted

from yellowiron.library import load_template
from yellowiron.model.template import Template
from yellowiron.specs import extract

pytestmark = pytest.mark.usefixtures("read_here")


# Bobcat S76, BOBCAT-S76-2-NA-PRODUCT (EXO-Robotics/exo-equipment-atlas, bobcat-s76-2): imperial first
def bobcat_s76(path: Path) -> None:
    c = canvas(path)
    put(c, 36, 800, "S76 class skid steer", size=16, bold=True)
    cards = [
        ("8,014 lb", "Operating weight"),
        ("128.3 in", "Height to bucket hinge pin"),
        ("83.7 in", "Turning radius"),
    ]
    for i, (value, label) in enumerate(cards):
        c.setFillColor(HexColor("#eeeeee"))
        c.rect(36 + 175 * i, 730, 165, 50, stroke=0, fill=1)
        put(c, 46 + 175 * i, 757, value, size=16, bold=True)
        put(c, 46 + 175 * i, 740, label, size=7)
    put(c, 36, 700, "DIMENSIONS", size=10, bold=True)
    rows = [
        ("(A) Wheelbase", "48.3 in", "1227 mm"),
        ("(B) Length without Attachment", "114.0 in", "2896 mm"),
        ("(C) Length with Standard Bucket", "142.0 in", "3607 mm"),
        ("(D) Height", "81.9 in", "2080 mm"),
        ("(E) Reach at Maximum Height", "33.5 in", "851 mm"),
        ("(F) Bucket Width", "74.0 in", "1880 mm"),
        ("(G) Width", "72.0 in", "1829 mm"),
        ("Standard Tires", "12.00 x 16.5", ""),
    ]
    for i, (label, imperial, metric) in enumerate(rows):
        x, y = (36, 684 - 13 * i) if i < 4 else (306, 684 - 13 * (i - 4))
        put(c, x, y, label)
        put(c, x + 175, y, imperial, right=True)
        put(c, x + 240, y, metric, right=True)
    c.save()


BOBCAT = template(
    wanted("Operating Weight", "mass"),
    wanted("Hinge Pin Height", "length", "height to bucket hinge pin"),
    wanted("Turning Radius", "length"),
    wanted("Wheelbase", "length"),
    wanted("Overall Length", "length", "length with standard bucket"),
    wanted("Overall Height", "length", "height"),
    wanted("Dumping Reach", "length", "reach at maximum height"),
    wanted("Bucket Width", "length"),
    wanted("Overall Width", "length", "width", forbidden=("bucket",)),
)
BOBCAT_TRUTH = {
    "Operating Weight": 3635.1,
    "Hinge Pin Height": 3.2588,
    "Turning Radius": 2.126,
    "Wheelbase": 1.2268,
    "Overall Length": 3.6068,
    "Overall Height": 2.0803,
    "Dumping Reach": 0.8509,
    "Bucket Width": 1.8796,
    "Overall Width": 1.8288,
}


# Caterpillar D6, CAT-D6-AEXQ3981-20C-AUSAM (EXO-Robotics/exo-equipment-atlas, cat-d6): rows are the options
def cat_d6(path: Path) -> None:
    c = canvas(path)
    bar(c, 36, 800, "Blades", 520)
    lattice(
        c,
        36,
        780,
        (90, 85, 85, 85, 85, 90),
        [
            (
                "Blade",
                "Capacity\nm³ (yd³)",
                "Width over end\nbits, mm (in)",
                "Height\nmm (in)",
                "Dig depth\nmm (in)",
                "Weight\nkg (lb)",
            ),
            ("6SU", "5.7 (7.5)", "3312 (130.4)", "1408 (55.4)", "502 (19.8)", "1385 (3,053)"),
            ("6S", "3.9 (5.1)", "3360 (132.3)", "1257 (49.5)", "473 (18.6)", "1154 (2,544)"),
            ("6A", "3.2 (4.2)", "4166 (164.0)", "1155 (45.5)", "506 (19.9)", "1334 (2,941)"),
        ],
    )
    bar(c, 36, 660, "Undercarriage", 250)
    for i, (label, value) in enumerate(
        [
            ("Track gauge", "1930 mm / 76 in"),
            ("Track on ground", "2964 mm / 116.7 in"),
            ("Ground pressure", "54.0 kPa / 7.8 psi"),
            ("Operating weight", "22 130 kg / 48,790 lb"),
            ("Shipping weight", "19 178 kg / 42,280 lb"),
        ]
    ):
        put(c, 36, 642 - 12 * i, f"{label}:  {value}")
    c.save()


D6 = template(
    wanted("Blade Capacity", "volume", "capacity"),
    wanted("Blade Width", "length", "width over end bits"),
    wanted("Blade Height", "length", "height"),
    wanted("Digging Depth", "length", "dig depth"),
    wanted("Blade Weight", "mass", "weight", forbidden=("operating", "shipping")),
    wanted("Track Gauge", "length"),
    wanted("Operating Weight", "mass"),
    wanted("Ground Pressure", "pressure"),
)
D6_TRUTH = {
    "Blade Capacity": 5.7,
    "Blade Width": 3.312,
    "Blade Height": 1.408,
    "Digging Depth": 0.502,
    "Blade Weight": 1385.0,
    "Track Gauge": 1.93,
    "Operating Weight": 22130.0,
    "Ground Pressure": 54e3,
}


# Caterpillar 773F (123docz.net/document/3441674): numbered dimensions, two bodies side by side
def cat_773f(path: Path) -> None:
    c = canvas(path)
    put(c, 36, 800, "Dimensions", size=13, bold=True)
    put(c, 36, 785, "All dimensions are approximate.", size=7)
    put(c, 330, 770, "Dual Slope", bold=True)
    put(c, 450, 770, "Flat Floor", bold=True)
    rows = [
        ("1 Height to Top of ROPS", "4116 mm", "13.5 ft", "4116 mm", "13.5 ft"),
        ("2 Overall Body Length", "9211 mm", "30.2 ft", "9120 mm", "29.9 ft"),
        ("3 Inside Body Length", "6254 mm", "20.5 ft", "6080 mm", "19.9 ft"),
        ("4 Overall Length", "10 249 mm", "33.6 ft", "10 070 mm", "33.0 ft"),
        ("5 Wheelbase", "4215 mm", "13.8 ft", "4215 mm", "13.8 ft"),
        ("6 Rear Axle to Tail", "2749 mm", "9.0 ft", "2690 mm", "8.8 ft"),
        ("7 Ground Clearance", "777 mm", "2.5 ft", "777 mm", "2.5 ft"),
        ("8 Dump Clearance", "616 mm", "2.0 ft", "690 mm", "2.3 ft"),
        ("9 Loading Height – Empty", "3773 mm", "12.4 ft", "3730 mm", "12.2 ft"),
        ("11 Overall Height – Body Raised", "9261 mm", "30.4 ft", "9200 mm", "30.2 ft"),
        ("12 Operating Width", "5425 mm", "17.8 ft", "5425 mm", "17.8 ft"),
    ]
    for i, (label, *cells) in enumerate(rows):
        put(c, 36, 752 - 12 * i, label)
        for stop, cell in zip((330, 390, 450, 510), cells, strict=True):
            put(c, stop, 752 - 12 * i, cell)
    c.save()


CAT_773F = template(
    wanted("Overall Height", "length", "height to top of ROPS"),
    wanted("Overall Length", "length"),
    wanted("Wheelbase", "length"),
    wanted("Ground Clearance", "length"),
    wanted("Dump Clearance", "length"),
    wanted("Loading Height", "length", "loading height empty"),
    wanted("Overall Height Raised", "length", "overall height body raised"),
    wanted("Operating Width", "length"),
)
CAT_773F_TRUTH = {
    "Overall Height": 4.116,
    "Overall Length": 10.249,
    "Wheelbase": 4.215,
    "Ground Clearance": 0.777,
    "Dump Clearance": 0.616,
    "Loading Height": 3.773,
    "Overall Height Raised": 9.261,
    "Operating Width": 5.425,
}


# Caterpillar 140, CAT-140-AEXQ4628-01-NAM (EXO-Robotics/exo-equipment-atlas, cat-140): headings that hang out, no rules
def cat_140(path: Path) -> None:
    c = canvas(path)
    put(c, 36, 800, "Motor grader", size=18, bold=True)
    put(c, 36, 778, "Technical Specifications", size=12, bold=True)
    groups = (
        (36, 130, 190, 758, "Moldboard", [("Width", "3.658 m", "12 ft"), ("Height", "556 mm", "21.9 in"),
            ("Thickness", "22 mm", "0.87 in"), ("Throat clearance", "119 mm", "4.7 in")]),
        (36, 130, 190, 690, "Steering and articulation", [("Steering range, left/right", "50°", ""),
            ("Articulation, left/right", "20°", ""), ("Wheel lean, left/right", "18°", ""),
            ("Front axle total oscillation", "32°", "")]),
        (310, 470, 525, 758, "Dimensions", [("Height – Top of cab", "3454 mm", "136 in"),
            ("Height – Top of cylinders", "3044 mm", "119.8 in"), ("Length – Between tandem axles", "1498 mm", "59 in"),
            ("Width – Outside rear tires", "2532 mm", "99.7 in"), ("Ground clearance", "333 mm", "13.1 in")]),
        (310, 470, 525, 672, "Weights", [("Operating weight, typically equipped", "19 027 kg", "41,948 lb"),
            ("Front axle", "5327 kg", "11,744 lb"), ("Rear axle", "13 700 kg", "30,203 lb")]),
    )  # fmt: skip
    for x, first, second, y, heading, rows in groups:
        put(c, x, y, heading, bold=True, size=9)
        for i, (label, metric, imperial) in enumerate(rows):
            put(c, x + 8, y - 14 - 11 * i, label)
            put(c, first, y - 14 - 11 * i, metric)
            put(c, second, y - 14 - 11 * i, imperial)
    c.save()


CAT_140 = template(
    wanted("Moldboard Width", "length"),
    wanted("Moldboard Height", "length"),
    wanted("Throat Clearance", "length"),
    wanted("Articulation Angle", "angle", "articulation left right"),
    wanted("Front Axle Oscillation", "angle", "front axle total oscillation"),
    wanted("Overall Height", "length", "height top of cab"),
    wanted("Overall Width", "length", "width outside rear tires"),
    wanted("Operating Weight", "mass"),
    wanted("Tandem Axle Spacing", "length", "length between tandem axles"),
)
CAT_140_TRUTH = {
    "Moldboard Width": 3.658,
    "Moldboard Height": 0.556,
    "Throat Clearance": 0.119,
    "Articulation Angle": math.radians(20),
    "Front Axle Oscillation": math.radians(32),
    "Overall Height": 3.454,
    "Overall Width": 2.532,
    "Operating Weight": 19027.0,
    "Tandem Axle Spacing": 1.498,
}


# Caterpillar 740 GC (manualmachine.com/cat/740gc/17904591-specifications): shaded rows; the hoist's figures are our own
def cat_740gc(path: Path) -> None:
    c = canvas(path)
    y = 800.0
    for heading, rows in (
        ("ENGINE", [("Gross Power – SAE J1995", "337 kW", "452 hp"), ("Bore", "137 mm", "5.4 in"),
            ("Stroke", "171.5 mm", "6.75 in"), ("Displacement", "15.2 L", "926 in³")]),
        ("BODY CAPACITIES", [("Heaped SAE 2:1", "22.7 m³", "29.7 yd³"), ("Struck", "17 m³", "22.2 yd³"),
            ("Tailgate Heaped SAE 2:1", "24.4 m³", "31.9 yd³"), ("Tailgate Struck", "17.9 m³", "23.4 yd³")]),
        ("WEIGHTS", [("Rated Payload", "36.3 tonnes", "40 tons"), ("Front axle – empty", "19 064 kg", "42,029 lb"),
            ("Total – empty", "33 165 kg", "73,116 lb"), ("Total – rated load", "69 465 kg", "153,144 lb")]),
        ("HYDRAULICS", [("Hoist cylinders, bore and stroke", "2 x 150 x 1950 mm", "5.9 x 76.8 in"),
            ("Raise time", "10 s", ""), ("Lower time", "8 s", ""), ("Relief valve setting", "26 MPa", "3,771 psi")]),
    ):  # fmt: skip
        put(c, 36, y, heading, bold=True, size=10)
        y -= 16
        for k, (label, metric, imperial) in enumerate(rows):
            if k % 2 == 0:
                c.setFillColor(HexColor("#e6e6e6"))
                c.rect(36, y - 4, 400, 12, stroke=0, fill=1)
            put(c, 40, y, label)
            put(c, 300, y, metric, right=True)
            put(c, 420, y, imperial, right=True)
            y -= 12
        y -= 10
    c.save()


CAT_740GC = template(
    wanted("Body Capacity Heaped", "volume", "heaped sae 2:1", forbidden=("tailgate",)),
    wanted("Body Capacity Struck", "volume", "struck", forbidden=("tailgate",)),
    wanted("Rated Payload", "mass"),
    wanted("Empty Weight", "mass", "total empty"),
    wanted("Hoist Cylinder Bore", "length"),
    wanted("Hoist Cylinder Stroke", "length"),
    wanted("Raise Time", "time"),
    wanted("Lower Time", "time"),
    wanted("Main Relief Pressure", "pressure", "relief valve setting"),
)
CAT_740GC_TRUTH = {
    "Body Capacity Heaped": 22.7,
    "Body Capacity Struck": 17.0,
    "Rated Payload": 36300.0,
    "Empty Weight": 33165.0,
    "Hoist Cylinder Bore": 0.15,
    "Hoist Cylinder Stroke": 1.95,
    "Raise Time": 10.0,
    "Lower Time": 8.0,
    "Main Relief Pressure": 26e6,
}


@pytest.mark.parametrize(
    ("draw", "asked", "truth", "config"),
    [
        (bobcat_s76, BOBCAT, BOBCAT_TRUTH, ""),
        (cat_d6, D6, D6_TRUTH, "6SU"),
        (cat_773f, CAT_773F, CAT_773F_TRUTH, "dual slope"),
        (cat_140, CAT_140, CAT_140_TRUTH, ""),
        (cat_740gc, CAT_740GC, CAT_740GC_TRUTH, ""),
    ],
)
def test_held_back(
    tmp_path: Path, draw: Callable[[Path], None], asked: Template, truth: dict[str, float], config: str
) -> None:
    draw(tmp_path / "sheet.pdf")
    found = extract(asked, [tmp_path / "sheet.pdf"], config=config)
    assert {s.name for s in found if s.status != "ok"} == set()
    for name, value in truth.items():
        assert found.number(name) == pytest.approx(value, rel=2e-3), name


def test_another_types_template_gets_nothing_wrong(tmp_path: Path) -> None:
    """The wheel loader's questions put to other machines' sheets: what is `ok` is there, and means what is asked."""
    loader = load_template("wheel_loader")
    truths = {
        cat_773f: {"Wheelbase": 4.215, "Overall Height": 4.116, "Ground Clearance": 0.777},
        bobcat_s76: {"Operating Weight": 3635.1, "Bucket Width": 1.88, "Dumping Reach": 0.851, "Turning Radius": 2.126},
        cat_d6: {"Operating Weight": 22130.0},
        cat_140: {"Overall Height": 3.454, "Operating Weight": 19027.0, "Ground Clearance": 0.333},
        cat_740gc: {"Lift Cylinder Stroke": 1.95, "Lift Cylinder Bore": 0.15, "Main Relief Pressure": 26e6}
        | {"Raise Time": 10.0, "Lower Time": 8.0},
    }
    for draw, truth in truths.items():
        draw(tmp_path / "sheet.pdf")
        found = extract(loader, [tmp_path / "sheet.pdf"])
        also = (
            {"Gross Power": 337e3, "Operating Weight": 33165.0}
            if draw is cat_740gc
            else {"Hinge Pin Height at Maximum Lift": 3.2588}
        )
        also |= {"Overall Length": 3.607, "Overall Length Without Bucket": 2.896} if draw is bobcat_s76 else {}
        came = {s.name: s.value for s in found if s.status == "ok"}
        assert truth.keys() <= came.keys() <= truth.keys() | also.keys()
        assert came == pytest.approx({name: {**truth, **also}[name] for name in came}, rel=2e-3)
