"""Arrangements of tables that once gave a wrong value or none: read in one process, a small sheet each."""

from __future__ import annotations

from pathlib import Path

import pytest
from specs_layouts import canvas, put, template, wanted

from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.language.decimal_style import decimal_style
from yellowiron.specs.layout.statement import Statement, is_unit
from yellowiron.specs.reader import read_sheet
from yellowiron.specs.values.claims import claims_of

_TOP = 780.0
_SIZES = (
    ("Overall length", "8,120", "26'8\""),
    ("Wheelbase", "3,300", "10'10\""),
    ("Overall width", "2,680", "8'10\""),
    ("Overall height", "3,350", "11'0\""),
    ("Ground clearance", "420", "16.5 in"),
)
_LENGTHS = {"Overall Length": 8.12, "Wheelbase": 3.3, "Overall Width": 2.68, "Overall Height": 3.35,
            "Ground Clearance": 0.42}  # fmt: skip


def found(path: Path, names: dict[str, str], config: str = "") -> dict[str, tuple[str, float | None]]:
    """What is not missing: status and value by name."""
    asked = template(*(wanted(name, dimension) for name, dimension in names.items()))
    values = from_sheets(asked, [read_sheet(path)], config=config)
    return {s.name: (s.status, s.value) for s in values if s.status != "missing"}


def lengths(path: Path, config: str = "") -> dict[str, tuple[str, float | None]]:
    return found(path, dict.fromkeys(_LENGTHS, "length"), config)


_ALL_OK = {name: ("ok", value) for name, value in _LENGTHS.items()}


def test_a_drawing_s_letters_are_neither_labels_nor_units_nor_heads(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    for i, key in enumerate("KALNM"):
        put(c, 80 + 97 * i, _TOP - 17 * (i % 3), key, size=6)
    c.line(60, 722, 500, 722)
    put(c, 458, 705, "mm", bold=True)
    for i, (key, (label, metric, imperial)) in enumerate(zip("KALNM", _SIZES, strict=True)):
        y = 692 - 12 * i
        put(c, 42, y, key, size=6)
        put(c, 60, y, label)
        put(c, 470, y, metric, right=True)
        put(c, 558, y, imperial, right=True)
        c.line(36, y - 3, 560, y - 3)
    c.save()
    assert lengths(tmp_path / "a.pdf") == _ALL_OK


def test_a_bare_number_beside_feet_and_inches_is_in_the_unit_in_which_they_agree(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    for i, (label, metric, imperial) in enumerate(_SIZES):
        put(c, 36, _TOP - 13 * i, label)
        put(c, 300, _TOP - 13 * i, metric if label != "Wheelbase" else "3,900", right=True)
        put(c, 420, _TOP - 13 * i, imperial, right=True)
    c.save()
    read = lengths(tmp_path / "a.pdf")
    assert read.pop("Wheelbase")[0] == "review"
    assert read == {k: v for k, v in _ALL_OK.items() if k != "Wheelbase"}


@pytest.mark.parametrize("walls", [False, True])
def test_number_and_unit_in_columns_of_their_own(tmp_path: Path, walls: bool) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = [("Operating weight", "18,200", "kg", "40,124", "lb"), ("Wheelbase", "3,300", "mm", "129.9", "in"),
            ("Ground clearance", "420", "mm", "16.5", "in")]  # fmt: skip
    for i, row in enumerate(rows):
        for x, text in zip((40, 262, 332, 402, 472), row, strict=True):
            put(c, x, _TOP - 14 * i, text)
    if walls:
        for i in range(4):
            c.line(36, _TOP + 10 - 14 * i, 530, _TOP + 10 - 14 * i)
        for x in (36, 260, 330, 400, 470, 530):
            c.line(x, _TOP + 10, x, _TOP - 32)
    c.save()
    names = {"Operating Weight": "mass", "Wheelbase": "length", "Ground Clearance": "length"}
    assert found(tmp_path / "a.pdf", names) == {
        "Operating Weight": ("ok", 18200.0), "Wheelbase": ("ok", 3.3), "Ground Clearance": ("ok", 0.42)
    }  # fmt: skip


def family(path: Path) -> None:
    """Three models under a bar, walls between their columns only; cells that hold for two, for all and for one."""
    c = canvas(path)
    edges = (36, 260, 340, 420, 500)
    c.setFillGray(0.85)
    c.rect(36, 766, 464, 16, stroke=0, fill=1)
    for x, name in zip(edges[1:], ("MW 110", "MW 120", "MW 130"), strict=False):
        put(c, x + 20, 771, name, bold=True)
    put(c, 36, 750, "Dimensions", size=9, bold=True)
    rows = (("Overall length (mm)", ((1, 2, "7,900"), (2, 3, "8,120"), (3, 4, "8,500"))),
            ("Wheelbase (mm)", ((1, 3, "3,300"), (3, 4, "3,500"))), ("Overall width (mm)", ((1, 4, "2,680"),)),
            ("Overall height (mm)", ((1, 2, "–"), (2, 3, "3,350"), (3, 4, "–"))),
            ("Ground clearance (mm)", ((1, 2, "400"), (2, 3, "–"), (3, 4, "–"))))  # fmt: skip
    for i, (label, cells) in enumerate(rows):
        y = 745 - 14 * i
        c.line(36, y, 500, y)
        put(c, 36, y - 10, label)
        for first, last, text in cells:
            put(c, (edges[first] + edges[last]) / 2 - 10, y - 10, text)
            c.line(edges[first], y, edges[first], y - 14)
    c.line(36, 745 - 14 * len(rows), 500, 745 - 14 * len(rows))
    c.save()


def test_a_family_of_models_under_one_head(tmp_path: Path) -> None:
    family(tmp_path / "a.pdf")
    asked = lengths(tmp_path / "a.pdf", "MW 120")
    assert asked == {k: v for k, v in _ALL_OK.items() if k != "Ground Clearance"}, "its own column, or a common cell"
    assert lengths(tmp_path / "a.pdf", "MW 130")["Wheelbase"] == ("ok", 3.5)
    undecided = lengths(tmp_path / "a.pdf")
    assert undecided["Overall Length"] == undecided["Wheelbase"] == ("conflict", None)
    assert undecided["Overall Width"] == ("ok", 2.68)


def test_outline_numbers_and_symbols_stand_beside_the_rows(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    edges = (36, 64, 260, 300, 340, 420)
    for i, ((label, metric, _), symbol) in enumerate(zip(_SIZES, ("l1", "m3", "b1", "h4", "m2"), strict=True)):
        y = _TOP - 14 * i
        for x, text in zip(edges, (f"1.{i + 1}", label, symbol, "mm", metric), strict=False):
            put(c, x + 3, y - 10, text)
        c.line(36, y, 420, y)
        for x in edges:
            c.line(x, y, x, y - 14)
    c.line(36, _TOP - 14 * len(_SIZES), 420, _TOP - 14 * len(_SIZES))
    c.save()
    assert lengths(tmp_path / "a.pdf") == _ALL_OK


def test_outline_numbers_say_nothing_of_a_document_s_decimals() -> None:
    assert decimal_style(["1.1 Largo 8,12 m 1.2 Ancho 2,68 m 1.3 Alto 3,35 m 1.4 Peso"]) == "comma"


def test_rows_counted_side_by_side(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 36, 800, "Dimensions", bold=True, size=10)
    for i, (label, metric, _) in enumerate(_SIZES):
        y = _TOP - 14 * i
        for x, number, words, value in ((40, i + 1, label, metric), (300, i + 6, f"Other {label}", f"9,{i}00")):
            put(c, x, y, str(number))
            put(c, x + 20, y, words)
            put(c, x + 210, y, f"{value} mm", right=True)
    c.save()
    assert lengths(tmp_path / "a.pdf") == _ALL_OK


def test_both_systems_parted_by_a_stroke_under_a_unit_of_both(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = [
        ("Wheelbase", "mm / in", "3,300 / 129.9"),
        ("Overall width", "mm [in]", "2,680 [105.5]"),
        ("Travel speed", "km/h (mph)", "38 (23.6)"),
        ("Operating weight", "kg | lb", "18,200 | 40,124"),
    ]

    for i, (label, unit, value) in enumerate(rows):
        put(c, 36, _TOP - 14 * i, label)
        put(c, 200, _TOP - 14 * i, unit)
        put(c, 400, _TOP - 14 * i, value, right=True)
    c.save()
    names = {"Wheelbase": "length", "Overall Width": "length", "Travel Speed": "speed", "Operating Weight": "mass"}
    assert found(tmp_path / "a.pdf", names) == {
        "Wheelbase": ("ok", 3.3), "Overall Width": ("ok", 2.68),
        "Travel Speed": ("ok", pytest.approx(38 / 3.6)), "Operating Weight": ("ok", 18200.0),
    }  # fmt: skip


def test_units_in_pairs() -> None:
    assert is_unit("L/min (gal/min)") == "L/min|gal/min"
    assert is_unit("km/h (mph)") == "km/h|mph"
    assert is_unit("mm / in") == "mm|in"
    assert is_unit("km/h") == "km/h"


@pytest.mark.parametrize(
    ("text", "unit", "value", "printed"),
    [
        ("858 33.8", "in", 858.0, "mm"),
        ("26,380 58,158", "lb", 26380.0, "kg"),
        ("2,820 (9-3)", "ft-in", 2820.0, "mm"),
    ],
)
def test_two_numbers_under_an_imperial_unit(text: str, unit: str, value: float, printed: str) -> None:
    """The metric one counts: both had the cell's one unit, and the inches were taken, a hundredth off."""
    statement = Statement(1, 0, "Stroke", text, (0.0, 0.0, 1.0, 1.0), text, unit=unit)
    (claim,) = claims_of([statement], "point")
    assert (claim.quantity.value, claim.quantity.unit) == (value, printed) and claim.partner is not None
