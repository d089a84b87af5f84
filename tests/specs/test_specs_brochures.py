"""How makers' brochures set their tables: each a small sheet, read in one process."""

from __future__ import annotations

from pathlib import Path

import pytest
from reportlab.pdfbase.pdfmetrics import stringWidth
from specs_layouts import canvas, put, template, wanted

from yellowiron.library import load_template
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.vocabulary import ends, is_one_place, tokens
from yellowiron.specs.layout.statement import Statement, looks_like_value, unit_in_label, unit_said
from yellowiron.specs.reader import Sheet, read_sheet
from yellowiron.specs.values.claims import claims_of
from yellowiron.specs.values.enumerations import alternatives, enumerated
from yellowiron.specs.values.matching import match

_TOP = 780.0
_ROWS = (
    ("Overall length", "8,120", "mm", "26'8\""),
    ("Wheelbase", "3,300", "mm", "10'10\""),
    ("Overall width", "2,680", "mm", "8'10\""),
    ("Overall height", "3,350", "mm", "11'0\""),
    ("Ground clearance", "420", "mm", "16.5 in"),
)
_LENGTHS = {"Overall Length": 8.12, "Wheelbase": 3.3, "Overall Width": 2.68, "Overall Height": 3.35,
            "Ground Clearance": 0.42}  # fmt: skip
_ALL_OK = {name: ("ok", pytest.approx(value)) for name, value in _LENGTHS.items()}


def found(path: Path, names: dict[str, str]) -> dict[str, tuple[str, float | None]]:
    """What is not missing: status and value by name."""
    asked = template(*(wanted(name, dimension) for name, dimension in names.items()))
    return {s.name: (s.status, s.value) for s in from_sheets(asked, [read_sheet(path)]) if s.status != "missing"}


def lengths(path: Path) -> dict[str, tuple[str, float | None]]:
    return found(path, dict.fromkeys(_LENGTHS, "length"))


def test_units_one_below_the_other_stand_beside_their_values(tmp_path: Path) -> None:
    rows = [("Operating weight", "kg", "18,180", "lb", "40,080"), ("Counterweight", "kg", "1,350", "lb", "2,976"),
            ("Net power", "kW", "133", "hp", "178"), ("Implement system", "kPa", "32,200", "psi", "4,670")]  # fmt: skip
    c = canvas(tmp_path / "a.pdf")
    for i, (label, unit, value, other, second) in enumerate(rows):
        y = _TOP - 26 * i
        c.line(40, y + 10, 300, y + 10)
        put(c, 40, y, label)
        put(c, 200, y, unit)
        put(c, 300, y, value, right=True)
        if i == 3:
            put(c, 40, y - 11, "pressure")  # a label broken in two, the imperial value beside its second line
        put(c, 200, y - 11, other)
        put(c, 300, y - 11, second, right=True)
    c.line(40, _TOP - 26 * 4 + 10, 300, _TOP - 26 * 4 + 10)
    c.save()
    names = {"Operating Weight": "mass", "Counterweight": "mass", "Net Power": "power",
             "Implement System Pressure": "pressure"}  # fmt: skip
    assert found(tmp_path / "a.pdf", names) == {
        "Operating Weight": ("ok", 18180.0), "Counterweight": ("ok", 1350.0), "Net Power": ("ok", 133e3),
        "Implement System Pressure": ("ok", 32.2e6),
    }  # fmt: skip


def test_the_unit_says_itself_over_a_table(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 300, _TOP + 14, "Unit: mm", right=True, size=6.5)
    for i in range(len(_ROWS) + 1):
        c.line(40, _TOP + 10 - 14 * i, 300, _TOP + 10 - 14 * i)
    for x in (40, 220, 300):
        c.line(x, _TOP + 10, x, _TOP + 10 - 14 * len(_ROWS))
    for i, (label, value, _, _) in enumerate(_ROWS):
        put(c, 44, _TOP - 14 * i, label)
        put(c, 296, _TOP - 14 * i, value, right=True)
    c.save()
    assert lengths(tmp_path / "a.pdf") == _ALL_OK


def test_a_table_may_be_closed_by_the_bar_of_its_heading(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    c.setFillColorRGB(0.9, 0.8, 0.8)
    c.rect(40, _TOP + 10, 260, 16, stroke=0, fill=1)
    c.setFillColorRGB(0, 0, 0)
    put(c, 44, _TOP + 14, "Dimensions", bold=True)
    for i, (label, value, unit, _) in enumerate(_ROWS):
        y = _TOP - 14 * i
        put(c, 44, y, label)
        put(c, 210, y, unit)
        put(c, 296, y, value, right=True)
        c.line(40, y - 4, 300, y - 4)
    for x in (40, 200, 240, 300):
        c.line(x, _TOP + 10, x, _TOP - 14 * (len(_ROWS) - 1) - 4)
    c.save()
    assert lengths(tmp_path / "a.pdf") == _ALL_OK


def test_a_label_and_its_value_may_share_a_ruled_cell(tmp_path: Path) -> None:
    """A label that holds a quantity of its own is no value."""
    rows = (("A", "Overall length", "8,120 mm"), ("B", "Digging depth (2.44 m level)", "6,510 mm"),
            ("C", "Wheelbase", "3,300 mm"), ("D", "Overall height", "3,350 mm"))  # fmt: skip
    c = canvas(tmp_path / "a.pdf")
    for i in range(len(rows) + 1):
        c.line(40, _TOP + 10 - 14 * i, 300, _TOP + 10 - 14 * i)
    for x in (40, 60, 300):
        c.line(x, _TOP + 10, x, _TOP + 10 - 14 * len(rows))
    for i, (key, label, value) in enumerate(rows):
        put(c, 46, _TOP - 14 * i, key)
        put(c, 64, _TOP - 14 * i, label)
        put(c, 296, _TOP - 14 * i, value, right=True)
    c.save()
    names = {"Overall Length": "length", "Wheelbase": "length", "Overall Height": "length", "Digging Depth": "length"}
    values = found(tmp_path / "a.pdf", names)
    assert {name: value for name, (_, value) in values.items()} == {
        "Overall Length": 8.12, "Digging Depth": 6.51, "Wheelbase": 3.3, "Overall Height": 3.35}  # fmt: skip


def test_labels_set_against_their_values_in_two_columns_with_headings_in_the_middle(tmp_path: Path) -> None:
    others = (("Fuel tank", "315", "L"), ("Hydraulic oil tank", "148", "L"), ("Engine oil", "23", "L"),
              ("Coolant", "38", "L"), ("Final drives", "12", "L"))  # fmt: skip
    c = canvas(tmp_path / "a.pdf")
    for x, heading in ((180, "Dimensions"), (440, "Service capacities")):
        put(c, x - 20, _TOP + 16, heading, size=10, bold=True)
    for i, ((label, value, unit, _), (name, number, litres)) in enumerate(zip(_ROWS, others, strict=True)):
        y = _TOP - 13 * i - 4 * (i > 2)
        put(c, 175, y, label, right=True)
        put(c, 185, y, f"{value} {unit}", bold=True)
        put(c, 435, y - 3, name, right=True)
        put(c, 445, y - 3, f"{number} {litres}", bold=True)
    c.save()
    sheet = read_sheet(tmp_path / "a.pdf")
    assert lengths(tmp_path / "a.pdf") == _ALL_OK
    assert {s.section for s in sheet.statements if s.label in ("Wheelbase", "Coolant")} == {
        "Dimensions", "Service capacities"}  # fmt: skip


def test_footnotes_and_their_signs_are_no_values_and_no_words(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    for i, (label, value, unit, _) in enumerate(_ROWS):
        put(c, 40, _TOP - 13 * i, label + "²" * (i == 2))
        put(c, 220, _TOP - 13 * i, f"{value} {unit}")
    put(c, 40, 40, "² Varies by 25 – 60 mm with the tires; overall height 3,500 mm with beacon.", size=5)
    c.save()
    assert lengths(tmp_path / "a.pdf") == _ALL_OK
    assert not any("Varies" in s.label for s in read_sheet(tmp_path / "a.pdf").statements)


@pytest.mark.parametrize(
    ("label", "bare", "expected"),
    [
        ("Hubzylinder, Kolbendurchmesser mm", False, ("Hubzylinder, Kolbendurchmesser", "mm")),
        ("Schaufeldrehpunkt, max. Höhe mm", False, ("Schaufeldrehpunkt, max. Höhe", "mm")),
        ("Max. engine power (net) kW (hp)", True, ("Max. engine power (net)", "kW|hp")),
        ("Longueur de flèche m", True, ("Longueur de flèche", "m")),
        ("Longueur de flèche m", False, ("Longueur de flèche m", "")),
        ("额定净功率（kW）", False, ("额定净功率", "kW")),
        ("铲斗容量（平装）（m³）", False, ("铲斗容量（平装）", "m³")),
        ("铲斗容量（平装）", False, ("铲斗容量（平装）", "")),
        ("Gesamtlänge L", True, ("Gesamtlänge L", "")),
        ("Grabtiefe bei Sohle von 2.240 mm", True, ("Grabtiefe bei Sohle von 2.240 mm", "")),
    ],
)
def test_a_unit_at_a_label_s_end(label: str, bare: bool, expected: tuple[str, str]) -> None:
    assert unit_in_label(label, bare=bare) == expected


@pytest.mark.parametrize(("text", "unit"), [("Unit: mm", "mm"), ("(Unidad: mm)", "mm"), ("单位：mm", "mm"),
                                            ("Einheit: mm", "mm"), ("Length in mm", ""), ("mm wide", "")])  # fmt: skip
def test_words_that_give_a_unit_and_nothing_else(text: str, unit: str) -> None:
    assert unit_said(text) == unit


def test_a_tolerance_is_no_value_and_either_side_has_a_sign() -> None:
    reading = read("2,820 ± 50 mm")
    assert [[(q.value, q.unit) for q in r.numbers] for r in reading] == [[(2820.0, "mm")]]
    assert reading[0].numbers[0].text == "2,820 ± 50 mm"
    assert tokens("Articulation angle ±") == tokens("Articulation angle, each side")
    assert tokens("Length w/o bucket") == tokens("Length without bucket")


@pytest.mark.parametrize(
    ("text", "is_value"),
    [("env. 1 840 kg", True), ("約 1,270", True), ("aprox. 19.300 kg", True), ("ca. 20.240", True),
     ("45°卸料时斗刃高度", False), ("45°前傾時リーチ", False), ("37°（左右各）", True)],
)  # fmt: skip
def test_what_is_a_value_and_what_a_label(text: str, is_value: bool) -> None:
    assert looks_like_value(text) == is_value


@pytest.mark.parametrize(
    ("label", "expected"),
    [
        ("Axle load, front/rear", ["Axle load, front", "Axle load, rear"]),
        ("Driving speed, with load/without load", ["Driving speed, with load", "Driving speed, without load"]),
        ("Hubgeschwindigkeit mit/ohne Last", ["Hubgeschwindigkeit mit Last", "Hubgeschwindigkeit ohne Last"]),
        ("起升速度（满载/空载）", ["起升速度（满载）", "起升速度（空载）"]),
        ("Fork s/e", ["Fork thickness", "Fork width"]),
        ("Overall length", []),
        ("Travel speed, backwards laden/unladen", ["Travel speed, backwards laden", "Travel speed, backwards unladen"]),
    ],
)
def test_alternatives_of_a_label(label: str, expected: list[str]) -> None:
    assert alternatives(label, 2) == expected


def test_numbers_with_slashes_go_to_their_own_names() -> None:
    row = Statement(1, 0, "Axle load, front/rear", "5570 / 730", (0, 0, 9, 9), "q", unit="kg")
    assert [(c.words, c.quantity.si_value) for c in claims_of([row], "point")] == [
        ("Axle load, front", 5570.0), ("Axle load, rear", 730.0)]  # fmt: skip
    two = Statement(1, 0, "Width", "2,550 mm / 8'4\"", (0, 0, 9, 9), "q")
    assert [c.quantity.si_value for c in claims_of([two], "point")] == [2.55]


def test_length_width_and_height_by_their_letters() -> None:
    assert enumerated("Overall dimensions (L × W × H)", 3) == [
        f"Overall dimensions {name}" for name in ("length", "width", "height")]  # fmt: skip


def test_a_distance_has_two_ends() -> None:
    assert ends("Rear axle to edge of counterweight") == (frozenset({"axle"}), frozenset({"edge", "counterweight"}))
    assert ends("De l'essieu arrière à l'axe d'articulation") is not None
    assert ends("Capacité à refus du godet") is None
    assert is_one_place(frozenset(tokens("rear axle"))) and not is_one_place(
        frozenset(tokens("front axle to rear axle"))
    )
    asked = [wanted("Rear Overhang", "length", "rear axle to counterweight", "rear axle rear"),
             wanted("Rear Axle to Hitch", "length", "rear axle to articulation")]  # fmt: skip
    labels = ["Rear axle to articulation pin", "Rear axle to bumper", "Rear axle"]
    rows = [Statement(1, i, label, "1,780 mm", (0, 0, 9, 9), "q") for i, label in enumerate(labels)]
    by_name = {name: [m.claim.words for m in own] for name, own in match(claims_of(rows, "point"), asked).items()}
    assert by_name == {"Rear Overhang": [], "Rear Axle to Hitch": ["Rear axle to articulation pin"]}


def test_a_vague_word_needs_the_heading_of_its_part() -> None:
    asked = template(wanted("Bucket Capacity Struck", "volume", "struck", sections=("bucket",)))
    for section, status in (("Bucket", "ok"), ("Dump body", "missing")):
        row = Statement(1, 0, "Struck", "3.1 m³", (0, 0, 9, 9), "Struck 3.1 m³", section=section)
        sheet = Sheet("a.pdf", 1, (row,), (), "point")
        assert from_sheets(asked, [sheet]).values["Bucket Capacity Struck"].status == status


def test_a_word_that_nothing_explains_makes_a_value_one_to_review() -> None:
    asked = template(
        wanted("Bucket Weight", "mass", "bucket weight"), wanted("Operating Weight", "mass", "machine weight")
    )
    row = Statement(
        1, 0, "Machine weight with bucket", "17,860 kg", (0, 0, 9, 9), "Machine weight with bucket 17,860 kg"
    )
    values = from_sheets(asked, [Sheet("a.pdf", 1, (row,), (), "point")]).values
    assert values["Bucket Weight"].status != "ok"


def test_a_model_over_a_column_reverses_nothing() -> None:
    asked = template(wanted("Wheelbase", "length", "wheelbase"))
    for head, status in (("VS 135", "ok"), ("Option", "missing")):
        row = Statement(1, 0, "Wheelbase", "1.515 m", (0, 0, 9, 9), "Wheelbase 1.515 m", column=(head,))
        assert from_sheets(asked, [Sheet("a.pdf", 1, (row,), (), "point")]).values["Wheelbase"].status == status


def test_the_symbols_of_a_type_sheet_are_no_words(tmp_path: Path) -> None:
    """VDI 2198 as a maker sets it: filled rows, an outline's number, the label, its symbol with a lower index, the
    unit, a column for each model. One symbol has two letters, one stands in two rows, and that of a product says what
    its three values are."""
    rows = [
        ("1.9", "Wheelbase", ("y", ""), "mm", "1453"), ("4.2", "Mast height lowered", ("h", "1"), "mm", "2900"),
        ("4.3", "Free lift", ("h", "2"), "mm", "1925"), ("4.4", "Lift", ("h", "3"), "mm", "6874"),
        ("4.5", "Mast height extended", ("h", "4"), "mm", "7849"), ("4.8", "Seat height", ("h", "7"), "mm", "1140"),
        ("4.19", "Overall length", ("l", "1"), "mm", "2686"), ("4.20", "Length to fork face", ("l", "2"), "mm", "1436"),
        ("4.22", "Fork dimensions", ("s/e/l", ""), "mm", "40/100/1250"),
        ("4.34.1", "Aisle width crossways", ("A", "st"), "mm", "3175"),
        ("4.34.2", "Aisle width lengthways", ("A", "st"), "mm", "3075"),
        ("4.35", "Turning radius", ("W", "a"), "mm", "1710"),
    ]  # fmt: skip
    c = canvas(tmp_path / "a.pdf")
    for i, (number, label, (symbol, index), unit, value) in enumerate(rows):
        y = _TOP - 14 * i
        c.setFillGray(0.8 if i % 2 else 1.0)
        for x0, x1 in ((40, 72), (74, 278), (280, 318), (320, 358), (360, 480)):
            c.rect(x0, y - 4, x1 - x0, 14, stroke=0, fill=1)
        c.setFillGray(0)
        for x, text in ((44, number), (78, label), (284, symbol), (330, unit), (364, value)):
            put(c, x, y, text)
        put(c, 284.5 + stringWidth(symbol, "Helvetica", 8), y - 2, index, size=5)
    c.save()
    sheet = [read_sheet(tmp_path / "a.pdf")]
    read_values = {s.name: (s.status, s.value) for s in from_sheets(load_template("forklift", sheet_only=True), sheet)}
    said = {
        "Wheelbase": 1.453, "Lowered Mast Height": 2.9, "Free Lift Height": 1.925, "Lift Height": 6.874,
        "Extended Mast Height": 7.849, "Seat Height": 1.14, "Overall Length": 2.686, "Length to Fork Face": 1.436,
        "Fork Thickness": 0.04, "Fork Width": 0.1, "Fork Length": 1.25, "Turning Radius": 1.71,
    }  # fmt: skip
    assert {name: read_values[name] for name in said} == {n: ("ok", pytest.approx(v)) for n, v in said.items()}


def test_a_unit_printed_for_another_is_for_review_with_what_it_should_be(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 40, _TOP, "Boom length (m): 2950")
    put(c, 40, _TOP - 20, "Arm length (m): 29500")
    c.save()
    asked = template(
        wanted("Boom Length", "length", minimum=1.5, maximum=9.0),
        wanted("Arm Length", "length", minimum=0.5, maximum=6.0),
    )
    boom, arm = from_sheets(asked, [read_sheet(tmp_path / "a.pdf")])
    assert (boom.status, boom.value) == ("review", pytest.approx(2.95))
    assert boom.reason == "'2950 m' is outside what is usual for Boom Length; in mm it would be usual"
    assert (arm.status, arm.value) == ("review", pytest.approx(29500.0))


def test_words_of_a_heading_are_not_left_over_of_a_label(tmp_path: Path) -> None:
    """The width of the undercarriage cannot be 450 mm; its name is in the heading, the label says the shoe's."""
    c = canvas(tmp_path / "a.pdf")
    put(c, 40, _TOP, "UNDERCARRIAGE", size=14)
    put(c, 40, _TOP - 24, "Shoe width")
    put(c, 200, _TOP - 24, "450 mm")
    c.save()
    sheet = [read_sheet(tmp_path / "a.pdf")]
    read_values = {s.name: (s.status, s.value) for s in from_sheets(load_template("excavator"), sheet)}
    assert read_values["Shoe Width"] == ("ok", pytest.approx(0.45))
