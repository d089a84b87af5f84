"""What brochures showed when they were opened: text from its right end, units in pairs, tables side by side."""

from __future__ import annotations

from pathlib import Path

import pytest
from specs_layouts import canvas, put, template, wanted

from yellowiron.specs import extract
from yellowiron.specs.language.decimal_style import DecimalStyle
from yellowiron.specs.language.units import printed_unit
from yellowiron.specs.layout.grids.partly_ruled import merged
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.machines import with_machines
from yellowiron.specs.pages.strokes import DrawnRule
from yellowiron.specs.pages.words import _Glyph, _joined
from yellowiron.specs.values.claims import claims_of

_POINT: DecimalStyle = "point"


def stated(label: str, text: str, page: int = 1) -> Statement:
    return Statement(page, 1, label, text, (0.0, 0.0, 1.0, 1.0), f"{label} {text}")


def glyphs(text: str, x: float) -> list[_Glyph]:
    return [_Glyph(c, x + 4 * i, x + 4 * i + 4, 100.0, 7.0, False) for i, c in enumerate(text)]


def test_text_written_from_its_right_end_is_joined_and_its_brackets_stand_right() -> None:
    # "8000 (3500)": PDFium gives the last bracket first, and mirrors both.
    runs = [glyphs("(", 60.0), glyphs("3500", 44.0), glyphs(")", 40.0), glyphs("8000", 20.0)]
    assert ["".join(g.text for g in run) for run in _joined(runs)] == ["(3500)", "8000"]
    plain = [glyphs("8000", 20.0), glyphs("(3500)", 40.0)]
    assert ["".join(g.text for g in run) for run in _joined(plain)] == ["8000", "(3500)"]


@pytest.mark.parametrize(
    ("spelling", "name"), [("pulg", "inch"), ("Zoll", "inch"), ("pies", "foot"), ("libras", "pound")]
)
def test_units_of_other_languages(spelling: str, name: str) -> None:
    unit = printed_unit(spelling)
    assert unit is not None and unit.name == name


def test_rules_a_point_apart_are_one_only_where_they_touch() -> None:
    left, right = DrawnRule(40, 323.8, 544, 323.8), DrawnRule(919, 323.0, 1013, 323.0)
    assert merged([left, right]) == [right, left]
    assert merged([left, DrawnRule(546, 323.0, 600, 323.0)]) == [DrawnRule(40, 323.0, 600, 323.0)]


def test_two_speeds_before_both_in_the_other_system() -> None:
    claims = claims_of([stated("Travel speed (loaded/unloaded)", "23 km/h / 25 km/h (14.3 mph / 15.5 mph)")], _POINT)
    assert [(c.words, c.quantity.value) for c in claims] == [
        ("Travel speed (loaded)", 23.0),
        ("Travel speed (unloaded)", 25.0),
    ]


def test_factors_with_slashes_in_the_order_of_their_initials() -> None:
    claims = claims_of([stated("Dimensiones de la horquilla T x A x L", "40/100/1070 mm")], _POINT)
    assert [c.words.split()[-1] for c in claims] == ["thickness", "width", "length"]


@pytest.mark.parametrize(
    ("text", "agree"),
    [
        ("2575 kg (5685 lb)", True),
        ("400 kW (544 HP)", True),
        ("103 kW/140 hp", True),
        ("3500 kg (8000 lb)", False),
        ("103 kW/150 hp", False),
    ],
)
def test_what_is_rounded_in_each_system_agrees(text: str, agree: bool) -> None:
    (claim,) = claims_of([stated("Weight or power", text)], _POINT)
    assert (not claim.doubt) is agree


def test_a_page_that_goes_on_with_a_machine_s_sheet_is_of_it() -> None:
    titles = [frozenset[str]([name]) if name else frozenset[str]() for name in ("B35D", "", "B40D", "", "B45D", "")]
    own = with_machines([stated("Track width", "3010 mm", page=6), stated("Note", "3 m", page=7)], titles)
    assert [s.variant for s in own] == [("B45D",), ()]


def ruled(path: Path, rows: list[tuple[str, ...]], widths: tuple[float, ...]) -> Path:
    c = canvas(path)
    for index, row in enumerate(rows):
        x, y = 40.0, 700.0 - 14 * index
        for text, width in zip(row, widths, strict=True):
            c.rect(x, y - 4, width, 14)
            put(c, x + 3, y, text, size=8)
            x += width
    c.save()
    return path


def test_pairs_of_values_under_two_units_have_each_its_own(tmp_path: Path) -> None:
    rows = [
        ("Modelo", "", "", "GP20", "GP20", "GP25", "GP25"),
        ("Distancia entre ejes", "pulg", "mm", "65.0", "1,650", "67.0", "1,702"),
        ("Peso operativo", "lb", "kg", "7,190", "3,260", "7,830", "3,550"),
    ]
    sheet = ruled(tmp_path / "a.pdf", rows, (140, 30, 30, 50, 50, 50, 50))
    asked = template(wanted("Wheelbase", "length"), wanted("Operating Weight", "mass"))
    found = extract(asked, [sheet], config="GP25")
    assert found.number("Wheelbase") == pytest.approx(1.702, rel=2e-3)
    assert found.number("Operating Weight") == pytest.approx(3550.0, rel=2e-3)


def test_numbers_on_both_sides_are_keys_though_a_value_is_one_of_them(tmp_path: Path) -> None:
    labels = ("Wheelbase", "Overall length", "Overall width", "Ground clearance", "Fork length", "Fork width", "Teeth")
    values = ("2100", "4280", "1490", "186", "1070", "150", "7")
    units = ("mm",) * 6 + ("",)
    rows = [(str(n), *row, str(n)) for n, row in enumerate(zip(labels, units, values, strict=True), start=1)]
    sheet = ruled(tmp_path / "a.pdf", [("", "Model", "", "FX40", ""), *rows], (20, 140, 30, 60, 20))
    found = extract(template(wanted("Wheelbase", "length"), wanted("Overall Width", "length")), [sheet])
    assert {one.name: one.value for one in found} == {"Wheelbase": 2.1, "Overall Width": 1.49}


def test_in_a_drawing_a_name_is_that_of_the_number_over_it(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 36, 800, "B45D", size=16, bold=True)
    for y, number, name in ((700, "3010 mm", "Wheelbase"), (684, "3900 mm", "Overall width")):
        c.setFont("Helvetica", 6)
        c.drawCentredString(100, y, number)
        c.drawCentredString(100, y - 6.4, name)
    c.save()
    found = extract(template(wanted("Wheelbase", "length"), wanted("Overall Width", "length")), [tmp_path / "a.pdf"])
    assert found.number("Wheelbase") in (None, 3.01) and found.number("Overall Width") in (None, 3.9)
