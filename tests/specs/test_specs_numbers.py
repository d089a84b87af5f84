"""Numbers, units, products, feet and inches, as sheets print them."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from yellowiron.model.errors import YellowironError
from yellowiron.specs.language.decimal_style import DecimalStyle, decimal_style
from yellowiron.specs.language.numbers import parse_one, read
from yellowiron.specs.language.quantities import same
from yellowiron.specs.language.units import printed_unit, printed_units
from yellowiron.specs.language.vocabulary import tokens
from yellowiron.specs.layout.statement import is_unit, looks_like_value, split_inline, unit_in_label, without_key
from yellowiron.specs.values.claims import spelled_out
from yellowiron.specs.values.enumerations import enumerated
from yellowiron.support.units import SI_UNIT, to_si


def numbers(text: str, **options: str) -> list[tuple[float, str]]:
    return [(q.value, q.unit) for r in read(text, **options) for q in r.numbers]  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("764 mm", [(764, "mm")]),
        ("1,234.5 kg", [(1234.5, "kg")]),
        ("1 234,5 mm", [(1234.5, "mm")]),
        ("25\u202f510 kg", [(25510, "kg")]),
        ("1.234,5 kg", [(1234.5, "kg")]),
        ("1.234.567 kg", [(1234567, "kg")]),
        ("0.022 m", [(0.022, "m")]),
        ("±13°", [(13, "°")]),
        ("-45°", [(-45, "°")]),
        ("14'4\"", [(172, "in")]),
        ("14 ft 4 1/2 in", [(172.5, "in")]),
        ("39 ft. 4 in.", [(472, "in")]),
        ("5 1/2 in", [(5.5, "in")]),
        ("5½ in", [(5.5, "in")]),
        ("95 x 441 mm", [(95, "mm"), (441, "mm")]),
        ("Ø 95 × 441 mm", [(95, "mm"), (441, "mm")]),
        ("150 mm x 764 mm", [(150, "mm"), (764, "mm")]),
        ("16.4 km/h4.0 mph", [(16.4, "km/h")]),
        ("26.5R25", []),
        ("ISO 6396:2008", []),
        ("SAA6D125E-7", []),
        ("4WD", []),
        ("35 °C", [(35, "")]),
    ],
)
def test_numbers(text: str, expected: list[tuple[float, str]]) -> None:
    assert numbers(text) == expected


def test_a_separator_says_what_it_may_be() -> None:
    def both(text: str, style: DecimalStyle) -> tuple[float, float | None]:
        quantity = read(text, style=style)[0].numbers[0]
        return quantity.value, quantity.other

    assert both("86.275 kg", "unknown") == (86.275, 86275)
    assert both("86.275 kg", "comma") == (86275, None)
    assert both("3.658 m", "point") == (3.658, None)
    assert both("1,234 kg", "unknown") == (1234, None)
    assert both("1,234 m", "comma") == (1.234, None)
    assert decimal_style(["4.2 m³", "31.4 MPa", "25,510 kg"]) == "point"
    assert decimal_style(["4,2 m³", "31,4 MPa", "25.510 kg"]) == "comma"
    assert decimal_style(["25.510 kg"]) == "unknown"


def test_products_counts_and_ranges() -> None:
    (cylinders,) = read("2 - 150 x 764 mm")
    assert (cylinders.kind, cylinders.count, [q.value for q in cylinders.numbers]) == ("product", 2, [150, 764])
    (boom,) = read("2 x 1334 mm stroke")
    assert (boom.kind, boom.count, boom.numbers[0].value, boom.qualifier) == ("single", 2, 1334, "stroke")
    (mixed,) = read("150 mm (5.9 in) x 764 mm (30.1 in)")
    assert ([q.value for q in mixed.numbers], [q.value for q in mixed.partner]) == ([150, 764], [5.9, 30.1])
    (weight,) = read("86,275 - 92,020 kg")
    assert (weight.kind, [q.value for q in weight.numbers]) == ("range", [86275, 92020])


def test_qualifiers_and_conditions() -> None:
    first, second = read("35° each direction (40° to max. end stop)")
    assert (first.qualifier, second.qualifier) == ("each direction", "to max end stop")
    flow, speed = read("325 L/min at 2,000 rpm")
    assert (flow.condition, speed.condition) == (False, True)
    main, steering = read("Main 31.4 MPa, steering 24.5 MPa")
    assert (main.qualifier, steering.qualifier) == ("Main", "steering")


@pytest.mark.parametrize(
    ("text", "agrees"),
    [
        ("1156 mm (46 in)", True),  # a fixed 0.6 % would call this wrong
        ("4,370 mm 14'4\"", True),
        ("35000 kPa 5076 psi", True),
        ("3.03 m (9'9\")", False),
        ("4.2 t (10,400 lb)", False),
        ("4267 mm (12 ft)", False),
        ("2.44 m (8')", True),
        ("4.2 m³ (5.5 yd³)", True),
    ],
)
def test_two_systems_agree_within_their_printed_digits(text: str, agrees: bool) -> None:
    (reading,) = read(text)
    assert reading.agrees is agrees


@settings(max_examples=150, deadline=None)
@given(st.floats(1, 99999), st.integers(0, 3), st.sampled_from(["mm", "kg", "kPa", "L/min", "in"]))
def test_any_printed_number_is_read_back(value: float, decimals: int, unit: str) -> None:
    printed = f"{value:,.{decimals}f}"
    (reading,) = read(f"{printed} {unit}", style="point")
    quantity = reading.numbers[0]
    candidates = {quantity.value, quantity.other}
    assert round(value, decimals) in candidates or float(f"{value:.{decimals}f}") in candidates
    if decimals != 3:
        assert quantity.other is None
    european = printed.translate(str.maketrans(",.", ".,"))
    (other,) = read(f"{european} {unit}", style="comma")
    assert float(f"{value:.{decimals}f}") in {other.numbers[0].value, other.numbers[0].other}


@settings(max_examples=150, deadline=None)
@given(st.floats(10, 20000), st.booleans())
def test_honest_conversions_always_agree(mm: float, in_feet: bool) -> None:
    inches = round(mm / 25.4)
    imperial = f"{inches // 12}'{inches % 12}\"" if in_feet else f"{mm / 25.4:.1f} in"
    (reading,) = read(f"{mm:.0f} mm ({imperial})")
    assert reading.agrees


@settings(max_examples=100, deadline=None)
@given(st.floats(500, 20000), st.sampled_from([0.8, 0.9, 1.1, 1.3]))
def test_wrong_conversions_never_agree(mm: float, factor: float) -> None:
    (reading,) = read(f"{mm:.0f} mm ({factor * mm / 25.4:.1f} in)")
    assert reading.agrees is False


@settings(max_examples=200, deadline=None)
@given(st.text(alphabet="0123456789.,'\"-–x×°½/ ()mkgintPaL±", max_size=40))
def test_no_text_breaks_the_reader(text: str) -> None:
    for reading in read(text):
        for quantity in (*reading.numbers, *reading.partner):
            assert math.isfinite(quantity.si_value) and 0 <= quantity.start < quantity.end <= len(text)
            assert same(quantity, quantity)
    looks_like_value(text)
    split_inline(text)
    unit_in_label(text)


def test_settings_take_one_quantity() -> None:
    assert parse_one("1,234 kg").value == 1234
    for text in ("", "two", "3 mm or 4 mm", "3..4 mm"):
        with pytest.raises(YellowironError):
            parse_one(text)


@pytest.mark.parametrize(
    ("spelling", "unit"),
    [
        ("L/min", "liter/minute"),
        ("l/min", "liter/minute"),
        ("gal/min", "gallon/minute"),
        ("kgf/cm²", "kgf/centimeter**2"),
        ("yd³", "yard**3"),
        ("cu yd", "yard**3"),
        ("KG", "kilogram"),
        ("MPa", "megapascal"),
        ("ft", "foot"),
        ("min-1", "revolution/minute"),
        ("N·m", "newton*meter"),
        ("seconds", "second"),
        ("º", "degree"),
    ],
)
def test_units(spelling: str, unit: str) -> None:
    found = printed_unit(spelling)
    assert found is not None and found.name == unit


def test_labels() -> None:
    assert unit_in_label("Boom length (m)") == ("Boom length", "m")
    assert unit_in_label("Height mm (in)") == ("Height", "mm|in")
    assert unit_in_label("Wheelbase, mm") == ("Wheelbase", "mm")
    assert unit_in_label("Height (ROPS)") == ("Height (ROPS)", "")
    assert is_unit("m (ft-in)") == "m|ft-in"
    assert spelled_out("5.62 (18-5)", "m|ft-in") == ("5.62 (18'5\")", "m")
    assert without_key("B Hinge pin height") == "Hinge pin height"
    assert without_key("(A) Wheelbase") == "Wheelbase"
    assert without_key("F – Radstand") == "Radstand"  # German sheets have a dash behind the letter
    assert without_key("A' Maximum Reach") == "Maximum Reach"
    assert without_key("Bore") == "Bore"
    assert split_inline("Wheelbase: 3,450 mm") == ("Wheelbase", "3,450 mm")
    assert split_inline("Track gauge 1930 mm / 76 in") == ("Track gauge", "1930 mm / 76 in")
    assert split_inline("Dumping clearance at 45°") == ("", "")
    assert not looks_like_value("10 Wheelbase") and not looks_like_value("1st") and not looks_like_value("775/65R29")
    assert tokens("Hinge-pin heights, max. (45°) of tyres") == ("hinge", "pin", "height", "maximum", "45", "tire")


def test_lists_in_labels() -> None:
    assert enumerated("Lift cylinders – number of cylinders – bore x stroke", 2) == [
        "Lift cylinders bore",
        "Lift cylinders stroke",
    ]
    assert enumerated("Bore x rod x stroke", 3) == ["Bore", "rod", "stroke"]
    assert enumerated("Bucket cylinder bore diameter × stroke", 2)[1] == "Bucket cylinder stroke"
    assert enumerated("Bore x stroke", 3) == []
    assert enumerated("Wheelbase", 2) == []


def test_the_scales_of_units_are_pints() -> None:
    for unit in [unit for unit, _ in printed_units()]:
        scale, si = to_si(1.0, unit.name)
        assert unit.scale == pytest.approx(scale, rel=1e-15), unit.name
        assert si == SI_UNIT[unit.dimension]
