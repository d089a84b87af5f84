"""What the standard's own lines and makers' headings say: powers by a standard, slashes, dashes, axle loads."""

from __future__ import annotations

import pytest

from kit.templates import template
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.vocabulary import tokens
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.reader import Sheet


def found(kind: str, label: str, text: str, section: str = "") -> dict[str, tuple[str, float | None]]:
    row = Statement(1, 1, label, text, (0.0, 0.0, 1.0, 1.0), f"{label} {text}", section=section)
    values = from_sheets(template(kind), [Sheet("a.pdf", 1, (row,), (), "point")])
    return {s.name: (s.status, s.value) for s in values if s.status != "missing"}


@pytest.mark.parametrize(
    "label", ["Engine power according to ISO 1585", "Motorleistung nach ISO 1585", "Potencia del motor según ISO 1585"]
)
def test_an_engines_power_by_a_standard_is_the_net_one(label: str) -> None:
    """And for no review as the engine's besides: every forklift's sheet says it so."""
    assert found("forklift", label, "36 kW") == {"Net Power": ("ok", 36e3)}


def test_a_label_that_says_net_is_no_more_than_that() -> None:
    assert found("forklift", "Net engine power ISO 1585", "36 kW") == {"Net Power": ("ok", 36e3)}


@pytest.mark.parametrize(
    ("label", "laden", "unladen"),
    [("Vitesse de levage en charge/à vide", 0.5, 0.55), ("Vitesse de levage à vide / en charge", 0.55, 0.5)],
)
def test_words_with_prepositions_go_to_numbers_with_slashes(label: str, laden: float, unladen: float) -> None:
    values = found("forklift", label, "0.5/0.55 m/s")
    assert values == {"Lift Speed Laden": ("ok", laden), "Lift Speed Unladen": ("ok", unladen)}


def test_axles_share_a_unit_though_one_bears_much_more() -> None:
    assert [q.unit for r in read("6000 / 700 kg") for q in r.numbers] == ["kg", "kg"]
    assert [q.unit for r in read("120/2000 rpm") for q in r.numbers] == ["", "rpm"]
    assert [q.unit for r in read("600/6000 kg") for q in r.numbers] == ["", "kg"]  # a load's distance and the load


def test_no_expression_goes_across_a_dash() -> None:
    assert "pilot" in tokens("Control pump")
    assert "pilot" not in tokens("Hydraulic Controls – Pump")
    values = found("dozer", "Pump Output", "214 L/min", "Hydraulic Controls – Pump")
    assert values == {"Main Pump Flow": ("ok", pytest.approx(214e-3 / 60))}
