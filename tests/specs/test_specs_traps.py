"""Layouts known to break tools, one each."""

from __future__ import annotations

from pathlib import Path

import pytest
from specs_layouts import bar, borderless, canvas, lattice, leaders, put, ruled, template, wanted

from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template
from yellowiron.specs import extract

pytestmark = pytest.mark.usefixtures("read_here")


def ok(asked: Template, path: Path, config: str = "") -> dict[str, float | None]:
    found: Specifications = extract(asked, [path], config=config)
    return {s.name: s.value for s in found if s.status == "ok"}


def test_a_label_between_its_metric_and_imperial_lines(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    for i, (label, metric, imperial) in enumerate(
        [
            ("Digging depth", "6620 mm", "21'9\""),
            ("Dumping height", "7110 mm", "23'4\""),
            ("Wheelbase", "3450 mm", "11'4\""),
        ]
    ):
        y = 780 - 24 * i
        put(c, 200, y + 4.5, metric)
        put(c, 36, y, label)
        put(c, 200, y - 4.5, imperial)
    c.save()
    asked = template(*(wanted(n, "length") for n in ("Digging Depth", "Dumping Height", "Wheelbase")))
    assert ok(asked, tmp_path / "a.pdf") == {"Digging Depth": 6.62, "Dumping Height": 7.11, "Wheelbase": 3.45}


def test_a_spanned_head_that_reaches_the_middle_column_only(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 262, 790, "Reach boom", bold=True)
    put(c, 442, 790, "Mass boom", bold=True)
    for x, stick in ((220, "R2.5"), (280, "R2.9"), (340, "R3.9"), (400, "M2.5"), (460, "M2.9"), (520, "M3.0")):
        put(c, x, 778, stick, bold=True)
    for i, (label, cells) in enumerate(
        [
            ("Maximum digging depth", ("6330", "6730", "7720", "6060", "6460", "6560")),
            ("Maximum reach", ("9470", "9870", "10 740", "9150", "9510", "9600")),
        ]
    ):
        put(c, 36, 764 - 12 * i, f"{label} (mm)")
        for x, cell in zip((220, 280, 340, 400, 460, 520), cells, strict=True):
            put(c, x, 764 - 12 * i, cell)
    c.save()
    asked = template(wanted("Maximum Digging Depth", "length"), wanted("Maximum Reach", "length"))
    path = tmp_path / "a.pdf"
    assert ok(asked, path) == {}
    assert ok(asked, path, "reach boom, R2.9") == {"Maximum Digging Depth": 6.73, "Maximum Reach": 9.87}
    assert ok(asked, path, "mass boom, M2.5") == {"Maximum Digging Depth": 6.06, "Maximum Reach": 9.15}
    assert ok(asked, path, "reach boom") == {}


def test_a_quantity_in_a_label_is_no_value(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    ruled(
        c,
        36,
        780,
        (330,),
        [
            ("Maximum depth cut for 2240 mm level bottom", "11 700 mm"),
            ("2.44 m (8') level bottom", "6580 mm"),
            ("Reach at 2130 mm (7'0\") height", "1700 mm"),
            ("Maximum digging depth", "11 800 mm"),
        ],
    )
    c.save()
    asked = template(
        wanted("Maximum Digging Depth", "length"),
        wanted("Level Bottom Depth", "length", "maximum depth cut for level bottom"),
        wanted("Dumping Reach", "length", "reach", forbidden=("2130", "7 ft")),
    )
    assert ok(asked, tmp_path / "a.pdf") == {"Maximum Digging Depth": 11.8, "Level Bottom Depth": 11.7}


def test_a_wrong_unit_in_a_label_is_reviewed(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    leaders(c, 36, 780, 300, [("Boom length (m)", "2950"), ("Arm length (mm)", "2900")])
    c.save()
    asked = template(
        wanted("Boom Length", "length", minimum=1.0, maximum=30.0),
        wanted("Arm Length", "length", minimum=0.5, maximum=20.0),
    )
    found = extract(asked, [tmp_path / "a.pdf"])
    assert [(s.status, s.value) for s in found] == [("review", pytest.approx(2.95)), ("ok", 2.9)]


def test_the_engines_stroke_is_no_cylinders(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    bar(c, 36, 800, "ENGINE", 300)
    y = leaders(c, 36, 784, 300, [("Number of cylinders", "6"), ("Bore", "125 mm"), ("Stroke", "150 mm")])
    bar(c, 36, y, "HYDRAULICS", 300)
    y = leaders(c, 36, y - 16, 300, [("Pump", "axial piston")])
    put(c, 36, y, "Lift cylinders")
    borderless(c, 46, y - 11, (200,), [("Bore", "150 mm"), ("Stroke", "764 mm")])
    c.save()
    asked = template(
        wanted("Lift Cylinder Bore", "length"),
        wanted("Lift Cylinder Stroke", "length"),
        wanted("Tilt Cylinder Stroke", "length"),
    )
    assert ok(asked, tmp_path / "a.pdf") == {"Lift Cylinder Bore": 0.15, "Lift Cylinder Stroke": 0.764}


@pytest.mark.parametrize("gap", [2, 6, 14])
def test_side_by_side_blocks_on_one_line(tmp_path: Path, gap: int) -> None:
    c = canvas(tmp_path / "a.pdf")
    left = [("Wheelbase", "3450 mm"), ("Tread", "2385 mm"), ("Ground clearance", "520 mm"), ("Hitch height", "1200 mm")]
    right = [
        ("Operating weight", "25 510 kg"),
        ("Bucket weight", "2196 kg"),
        ("Tipping load", "20 540 kg"),
        ("Fuel", "375 L"),
    ]
    for i, (a, b) in enumerate(zip(left, right, strict=True)):
        y = 780 - 12 * i
        put(c, 36, y, a[0])
        put(c, 240, y, a[1], right=True)
        put(c, 240 + gap + 6, y, b[0])
        put(c, 460, y, b[1], right=True)
    c.save()
    asked = template(
        wanted("Wheelbase", "length"),
        wanted("Hitch Height", "length"),
        wanted("Operating Weight", "mass"),
        wanted("Bucket Weight", "mass"),
    )
    found = ok(asked, tmp_path / "a.pdf")
    expected = {"Wheelbase": 3.45, "Hitch Height": 1.2, "Operating Weight": 25510.0, "Bucket Weight": 2196.0}
    assert found.items() <= expected.items()  # nothing wrong, however tight
    if gap > 2:
        assert found == expected


def test_changes_and_options_are_no_values(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    lattice(
        c,
        36,
        780,
        (120, 120, 120),
        [
            ("Tyre", "Change in operating weight", "Change in overall width"),
            ("26.5R25 L5", "+580 kg", "+95 mm"),
            ("775/65R29", "+240 kg", "+20 mm"),
        ],
    )
    leaders(c, 36, 650, 300, [("Operating weight with optional counterweight", "26 100 kg")])
    c.save()
    asked = template(wanted("Operating Weight", "mass"), wanted("Overall Width", "length"))
    assert ok(asked, tmp_path / "a.pdf") == {}


def test_chinese_labels(tmp_path: Path) -> None:
    from reportlab.pdfbase import pdfmetrics
    from reportlab.pdfbase.cidfonts import UnicodeCIDFont

    pdfmetrics.registerFont(UnicodeCIDFont("STSong-Light"))
    c = canvas(tmp_path / "a.pdf")
    c.setFont("STSong-Light", 9)
    for i, (label, value) in enumerate([("轴距", "3450 mm"), ("动臂油缸行程", "764 mm"), ("工作质量", "25510 kg")]):
        c.drawString(36, 780 - 14 * i, label)
        c.drawString(200, 780 - 14 * i, value)
    c.save()
    asked = template(
        wanted("Wheelbase", "length", "轴距"),
        wanted("Lift Cylinder Stroke", "length", "动臂油缸行程"),
        wanted("Operating Weight", "mass", "工作质量"),
    )
    assert ok(asked, tmp_path / "a.pdf") == {
        "Wheelbase": 3.45,
        "Lift Cylinder Stroke": 0.764,
        "Operating Weight": 25510.0,
    }


def test_a_unit_column_and_groups_that_span_their_rows(tmp_path: Path) -> None:
    """Held back too. First reading: 18 right, 0 wrong, 5 in doubt (a group's name was taken for part of the label)."""
    c = canvas(tmp_path / "a.pdf")
    lattice(
        c,
        36,
        795,
        [100, 190, 55, 85, 85],
        [
            ("Item", "<", "Unit", "Standard arm", "High-lift arm"),
            ("Dimensions", "Wheelbase", "mm", "3,450", "3,450"),
            (None, "Hinge pin height (max. height)", "mm", "4,370", "4,870"),
            ("Front axle", "Oscillation, total", "deg", "20", "20"),
            ("Engine", "Bore x stroke", "mm", "125 x 150", "125 x 150"),
            (None, "Rated power", "kW/min-1", "216/1,700", "216/1,700"),
            ("Loader hydraulics", "Lift cylinders (bore x stroke)", "mm", "2 - 150 x 764", "2 - 150 x 764"),
            (None, "Relief valve setting", "MPa", "31.4", "31.4"),
        ],
    )
    c.save()
    asked = template(
        wanted("Wheelbase", "length"),
        wanted("Hinge Pin Height", "length", "hinge pin height, max. height"),
        wanted("Rear Axle Oscillation", "angle", "total oscillation"),
        wanted("Lift Cylinder Bore", "length"),
        wanted("Lift Cylinder Stroke", "length"),
        wanted("Main Relief Pressure", "pressure", "relief valve setting"),
    )
    expected = {
        "Wheelbase": 3.45,
        "Lift Cylinder Bore": 0.15,
        "Lift Cylinder Stroke": 0.764,
        "Main Relief Pressure": 31.4e6,
    }
    assert ok(asked, tmp_path / "a.pdf") == expected
    assert ok(asked, tmp_path / "a.pdf", "high-lift arm") == expected | {"Hinge Pin Height": 4.87}
