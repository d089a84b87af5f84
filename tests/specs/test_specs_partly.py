"""Tables that are ruled in part, as makers set them: each a small sheet, read in one process."""

from __future__ import annotations

from pathlib import Path

import pytest
from reportlab.pdfgen.canvas import Canvas
from specs_layouts import canvas, put, template, wanted

from yellowiron.specs.columns import configured
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.language.numbers import read
from yellowiron.specs.layout.statement import Statement, is_unit, unit_of_heading
from yellowiron.specs.reader import read_sheet
from yellowiron.specs.values.claims import claims_of
from yellowiron.specs.values.enumerations import alternatives, enumerated

_ROWS = (("Overall length", "7,900", "8,120"), ("Wheelbase", "3,200", "3,300"), ("Overall width", "2,580", "2,680"),
         ("Overall height", "3,250", "3,350"), ("Ground clearance", "400", "420"))  # fmt: skip
_NAMES = ("Overall Length", "Wheelbase", "Overall Width", "Overall Height", "Ground Clearance")
_SECOND = {"Overall Length": 8.12, "Wheelbase": 3.3, "Overall Width": 2.68, "Overall Height": 3.35,
           "Ground Clearance": 0.42}  # fmt: skip


def found(path: Path, config: str = "", names: tuple[str, ...] = _NAMES) -> dict[str, tuple[str, float | None]]:
    asked = template(*(wanted(name, "length") for name in names))
    values = from_sheets(asked, [read_sheet(path)], config=config)
    return {s.name: (s.status, s.value) for s in values if s.status != "missing"}


def ok(values: dict[str, float]) -> dict[str, tuple[str, float]]:
    return {name: ("ok", pytest.approx(value)) for name, value in values.items()}


def fill(c: Canvas, x: float, y: float, width: float, height: float, grey: float) -> None:
    c.setFillGray(grey)
    c.rect(x, y, width, height, stroke=0, fill=1)
    c.setFillGray(0)


def test_rows_that_no_rule_parts_have_a_line_in_every_cell(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    fill(c, 40, 760, 400, 16, 0.8)
    put(c, 240, 765, "MW 110", bold=True)
    put(c, 340, 765, "MW 120", bold=True)
    for i, (label, first, second) in enumerate(_ROWS):
        y = 748 - 13 * i
        if i % 2 == 0:
            fill(c, 62, y - 3.5, 378, 12, 0.95)
        for x, text in ((44, f"1.{i + 1}"), (66, label), (205, "mm"), (250, first), (350, second)):
            put(c, x, y, text)
    bottom = 748 - 13 * len(_ROWS) + 6
    for x in (62, 200, 235, 335):
        c.line(x, 760, x, bottom)
    c.line(40, 760, 440, 760)
    c.line(40, bottom, 440, bottom)
    c.save()
    assert found(tmp_path / "a.pdf", "MW 120") == ok(_SECOND)


def test_a_table_of_pairs_has_values_in_words_too(tmp_path: Path) -> None:
    """A label and its value twice in a row: words in the left one's place are no label of the right one."""
    c = canvas(tmp_path / "a.pdf")
    rows = [
        ("Built in", "Shandong", "Dimension (L*W*H)", "6340*1857*2920 mm"),
        ("Tank volume", "1.93 m3", "Discharge", "1.5 m3"),
        ("Model", "ZL 12 turbo", "Ground clearance", "292 mm"),
        ("Wheelbase", "2440 mm", "Gradeability", "30 °"),
    ]
    for i in range(len(rows) + 2):
        c.line(40, 760 - 20 * i, 480, 760 - 20 * i)
    for x in (40, 480):
        c.line(x, 760, x, 660)
    for x in (150, 250, 370):
        c.line(x, 740, x, 660)
    put(c, 180, 746, "TECHNICAL SPECIFICATIONS", bold=True)
    for i, row in enumerate(rows):
        for x, text in zip((44, 154, 254, 374), row, strict=True):
            put(c, x, 726 - 20 * i, text)
    c.save()
    assert found(tmp_path / "a.pdf") == ok(
        {"Overall Length": 6.34, "Overall Width": 1.857, "Overall Height": 2.92, "Ground Clearance": 0.292,
         "Wheelbase": 2.44}
    )  # fmt: skip


def test_walls_of_some_rows_hold_in_those_that_lack_them(tmp_path: Path) -> None:
    """As where a picture's faint walls are lost; the numbers that count the rows are no values, though one is lost."""
    c = canvas(tmp_path / "a.pdf")
    rows = [*_ROWS, *((f"Other measure {n}", f"{10 * n}1", f"{10 * n}2") for n in range(11, 18))]
    c.line(40, 752, 440, 752)
    for i, (label, _, value) in enumerate(rows):
        y = 740 - 16 * i
        for x, text in ((44, label), (205, str(i + 1) if i != 6 else ""), (250, "mm"), (355, value)):
            put(c, x, y, text)
        c.line(40, y - 5, 440, y - 5)
        for x in (40, 190, 440) if i > 3 else (40, 190, 230, 320, 440):
            c.line(x, y - 5, x, y + 11)
    c.save()
    assert found(tmp_path / "a.pdf") == ok(_SECOND)


def test_columns_that_no_wall_parts_stand_under_their_heads(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    fill(c, 40, 760, 400, 16, 0.85)
    put(c, 255, 765, "2.5 m arm")
    put(c, 355, 765, "2.9 m arm")
    for i, (label, first, second) in enumerate(_ROWS):
        y = 748 - 16 * i
        put(c, 44, y, label)
        put(c, 255, y, f"{first} mm")
        put(c, 355, y, f"{second} mm")
        c.line(40, y - 5, 440, y - 5)
        for x in (40, 240, 440):
            c.line(x, y - 5, x, y + 11)
    put(c, 44, 748 - 16 * 5, "Counterweight clearance")
    put(c, 305, 748 - 16 * 5, "1,010 mm")  # across both
    c.line(40, 748 - 16 * 5 - 5, 440, 748 - 16 * 5 - 5)
    for x in (40, 240, 440):
        c.line(x, 748 - 16 * 5 - 5, x, 748 - 16 * 5 + 11)
    c.save()
    names = (*_NAMES, "Counterweight Clearance")
    assert found(tmp_path / "a.pdf", "2.9 m arm", names) == ok({**_SECOND, "Counterweight Clearance": 1.01})


def test_cells_may_be_filled_instead_of_ruled(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    groups = (
        ("Lift cylinder", (150, 85, 764)),
        ("Tilt cylinder", (160, 95, 774)),
        ("Steering cylinder", (95, 50, 441)),
    )
    y = 760.0
    fill(c, 40, y + 12, 360, 16, 0.3)
    for group, sizes in groups:
        fill(c, 40, y - 3 * 16 + 12, 110, 3 * 16 - 1, 0.8)
        put(c, 44, y - 16, group)
        for part, size in zip(("Bore", "Rod diameter", "Stroke"), sizes, strict=True):
            fill(c, 151, y - 4, 110, 15, 0.9)
            put(c, 155, y, part)
            put(c, 300, y, f"{size} mm")
            c.line(262, y - 4.5, 400, y - 4.5)
            y -= 16
    c.save()
    truth = {f"{group.title()} {part.title()}": size / 1000 for group, sizes in groups
             for part, size in zip(("bore", "rod diameter", "stroke"), sizes, strict=True)}  # fmt: skip
    assert found(tmp_path / "a.pdf", names=tuple(truth)) == ok(truth)


@pytest.mark.parametrize("engine", ["6HK1", "4HK1"])
def test_a_row_of_engines_heads_no_columns(tmp_path: Path, engine: str) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 240, 780, "MW 110", bold=True, size=10)
    put(c, 340, 780, "MW 120", bold=True, size=10)
    c.line(40, 775, 440, 775)
    rows = (("Engine model", "6HK1", engine), *((a, f"{b} mm", f"{d} mm") for a, b, d in _ROWS))
    put(c, 40, 758, "Engine and dimensions", bold=True, size=9)
    for i, cells in enumerate(rows):
        y = 740 - 15 * i
        c.line(40, y + 10, 440, y + 10)
        for x, text in zip((40, 240, 340), cells, strict=True):
            put(c, x, y, text)
    c.line(40, 740 - 15 * len(rows) + 10, 440, 740 - 15 * len(rows) + 10)
    c.save()
    assert found(tmp_path / "a.pdf", "MW 120") == ok(_SECOND)


def test_a_section_and_its_columns_on_one_bar_and_a_value_for_all_of_them(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    fill(c, 40, 756, 400, 14, 0.85)
    put(c, 44, 760, "Dimensions", bold=True)
    put(c, 240, 760, "2.58 m stick", bold=True)
    put(c, 340, 760, "2.98 m stick", bold=True)
    for i, (label, first, second) in enumerate(_ROWS):
        y = 744 - 14 * i
        put(c, 44, y, label)
        if i == 2:
            put(c, 285, y, f"{second} mm")
        else:
            put(c, 240, y, f"{first} mm")
            put(c, 340, y, f"{second} mm")
        c.line(40, y - 4, 440, y - 4)
    c.save()
    assert found(tmp_path / "a.pdf", "2.98 m stick") == ok(_SECOND)


def test_a_sub_heading_over_its_first_row_between_two_rules(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 40, 780, "Hydraulic cylinders", bold=True, size=10)
    y, truth = 760.0, {}
    for group in ("Lift cylinder", "Tilt cylinder"):
        c.line(40, y + 10, 300, y + 10)
        put(c, 40, y, group, bold=True)
        for part, size in (("Bore", 150), ("Rod diameter", 85), ("Stroke", 764)):
            y -= 13
            size += 10 * (group == "Tilt cylinder")
            put(c, 48, y, part)
            put(c, 180, y, "mm")
            put(c, 300, y, str(size), right=True, bold=True)
            c.line(40, y - 3.5, 300, y - 3.5)
            truth[f"{group} {part}".title()] = size / 1000
        y -= 14
    c.save()
    assert found(tmp_path / "a.pdf", names=tuple(truth)) == ok(truth)


def test_a_heading_in_capitals_under_a_section_of_one_row_between_two_rules(tmp_path: Path) -> None:
    """Zebra rows with a rule under each heading: the next heading stands between two rules with the only row."""
    c = canvas(tmp_path / "a.pdf")
    put(c, 40, 790, "Item", bold=True)
    put(c, 300, 790, "XA 10", bold=True)
    put(c, 400, 790, "XA 20", bold=True)
    y = 772.0
    for heading, rows in (("BUCKET", (("Bucket capacity, m3", "0.25", "0.3"),)),
                          ("DIMENSIONS", (("Overall width, mm", "2,055", "2,185"),)),
                          ("UNDERCARRIAGE", (("Track gauge, mm", "1,660", "1,765"),))):  # fmt: skip
        put(c, 40, y, heading, bold=True)
        c.line(40, y - 4, 440, y - 4)
        for label, first, second in rows:
            y -= 15
            put(c, 40, y, label)
            put(c, 300, y, first)
            put(c, 400, y, second)
        y -= 15
    c.save()
    names = ("Overall Width", "Bucket Width", "Track Gauge")
    assert found(tmp_path / "a.pdf", "XA 20", names) == ok({"Overall Width": 2.185, "Track Gauge": 1.765})


def test_a_sign_at_the_end_of_the_row_that_reads_as_a_unit_is_none_where_columns_have_theirs(tmp_path: Path) -> None:
    """A list of buckets, in its last column a round sign whose letter is "s": no capacity is seconds."""
    c = canvas(tmp_path / "a.pdf")
    for x, head, unit in ((200, "Bucket capacity", "m3"), (300, "Bucket width", "mm")):
        put(c, x, 780, head, bold=True)
        put(c, x, 766, unit)
    put(c, 400, 780, "Long stick", bold=True)
    for i, (name, capacity, width, sign) in enumerate(
        (("General purpose", "0.94", "762", "s"), ("Rock", "1.19", "914", "s"), ("Ditch", "1.46", "1,067", ""))
    ):
        y = 750 - 15 * i
        for x, text in ((40, name), (200, capacity), (300, width), (400, sign)):
            if text:
                put(c, x, y, text)
        c.line(40, y - 4, 460, y - 4)
    c.save()
    units = {s.text: s.unit for s in read_sheet(tmp_path / "a.pdf").statements if s.text in ("0.94", "1.19", "762")}
    assert units == {"0.94": is_unit("m3"), "1.19": is_unit("m3"), "762": "mm"}


def test_a_colon_in_a_column_of_its_own_is_no_label(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 40, 780, "Dimensions", bold=True, size=10)
    for i, (label, _, value) in enumerate(_ROWS):
        for x, text in ((40, label), (180, ":"), (200, f"{value} mm")):
            put(c, x, 760 - 14 * i, text)
    c.save()
    assert found(tmp_path / "a.pdf") == ok(_SECOND)


@pytest.mark.parametrize(
    ("text", "inches"), [("31.3 ft in", 375.0), ("10.11 ft in", 131.0), ("9.0 ft in", 108.0), ("5.4 ft-in", 64.0)]
)
def test_feet_and_inches_with_a_point(text: str, inches: float) -> None:
    (reading,) = read(text)
    assert (reading.numbers[0].value, reading.numbers[0].unit) == (inches, "in")


def test_gravitational_units_in_braces_and_a_power_over_its_speed() -> None:
    assert is_unit("kN{kgf}") == "kN" and is_unit("MPa {kgf/cm²}") == "MPa"
    assert is_unit("kW/min-1") == "kW|rpm" and is_unit("kW{PS}/min⁻¹") == "kW|rpm"
    assert is_unit("kW (PS)") == "kW|PS" and is_unit("kW/ch") == "kW|ch"
    cells = (("Drawbar pull", "267{27,200}", "kN", 267e3), ("Net power", "175{238}/2,000", "kW|rpm", 175e3))
    for label, text, unit, value in cells:
        statement = Statement(page=1, row=1, label=label, text=text, box=(0, 0, 9, 9), quote=text, unit=unit)
        assert claims_of([statement], "point")[0].quantity.si_value == pytest.approx(value)


def test_a_heading_gives_the_units_of_both_systems() -> None:
    assert unit_of_heading("Dimensions Unit: mm (ft-in)") == ("Dimensions", "mm|ft-in")
    assert unit_of_heading("Dimensions (mm)") == ("Dimensions", "mm")


def test_lists_of_with_and_without_and_the_last_of_two_lists() -> None:
    assert alternatives("Lift speed with/without load", 2) == ["Lift speed with load", "Lift speed without load"]
    assert alternatives("提升速度，有／无载荷", 2) == ["提升速度，有载荷", "提升速度，无载荷"]
    assert alternatives("Tilt of mast/fork carriage forward/backward α/β", 2) == [
        "Tilt of mast/fork carriage forward α/β", "Tilt of mast/fork carriage backward α/β"]  # fmt: skip
    assert enumerated("Anzahl – Bohrung × Hub", 2) == ["Bohrung", "Hub"]
    assert enumerated("Fork dimensions ISO 2331 s/e/l", 3)[0].endswith("thickness")


def test_a_configuration_may_have_a_comma_of_its_own() -> None:
    def claim(column: str, text: str) -> Statement:
        return Statement(page=1, row=1, label="Width", text=text, box=(0, 0, 9, 9), quote=text, column=(column,))

    claims = claims_of([claim("General Purpose, BOCE", "3,080 mm"), claim("Rock, Spade Edge", "3,240 mm")], "point")
    assert [c.quantity.text for c in configured(claims, "Rock, Spade Edge")] == ["3,240 mm"]
