"""Tables over two facing pages, heads of several models, and what stands between two rules: each a small sheet."""

from __future__ import annotations

from pathlib import Path

import pytest
from specs_layouts import canvas, put, template, wanted
from test_specs_tiled_tables import tiles

from yellowiron.model.specification import Specifications
from yellowiron.specs import extract
from yellowiron.specs.layout.facing_pages import with_labels
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.values.claims import claims_of

ASKED = template(
    wanted("Maximum Reach", "length", "maximum reach"),
    wanted("Net Power", "power", "net power"),
    wanted("Operating Weight", "mass", "operating weight"),
)
_ROWS = (("reach", "9860", "mm"), ("depth", "6725", "mm"), ("power", "110", "kW"), ("weight", "22500", "kg"),
         ("swing", "11.5", "rpm"), ("speed", "5.5", "km/h"))  # fmt: skip
_FURTHER = ("10120", "6990", "121", "26100", "10.5", "5.3")


def said(found: Specifications) -> dict[str, tuple[str, float | None]]:
    return {s.name: (s.status, None if s.value is None else round(s.value, 4)) for s in found if s.status != "missing"}


def spread(numbers: tuple[str, ...], *, lower: float = 0.0, label: str = "") -> list[Statement]:
    """Rows of one page, and of the next those of two more machines."""
    found = [
        Statement(1, 1000 + i, name, value, (200, 20 * i, 240, 20 * i + 10), value, unit=unit)
        for i, (name, value, unit) in enumerate(_ROWS)
    ]
    for i, number in enumerate(numbers):
        box = (40, 20 * i + lower, 80, 20 * i + 10 + lower)
        found += [
            Statement(2, 2000 + i, label, number, (box[0] + x, box[1], box[2] + x, box[3]), number, column=(model,))
            for x, model in ((0, "MW130"), (60, "MW140"))
        ]
    return found


def test_rows_level_with_those_of_the_page_before_have_their_labels_and_units() -> None:
    given = [s for s in with_labels(spread(_FURTHER)) if s.page == 2]
    assert [(s.label, s.unit) for s in given[::2]] == [(name, unit) for name, _, unit in _ROWS]


@pytest.mark.parametrize(
    "statements",
    [spread(_FURTHER, lower=7), spread(("3.1", "5.2", "4.9", "3.8", "99", "71")), spread(_FURTHER, label="load"),
     spread(_FURTHER[:4])],
    ids=["at other heights", "a chart", "with labels", "few"],
)  # fmt: skip
def test_rows_of_another_table_have_none(statements: list[Statement]) -> None:
    assert with_labels(statements) == statements


def test_a_head_of_several_models_is_each_ones(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = [("Model", "MW20-AC2S MW20-AZ3S", "MW30-AC2 MW30-AZ3"), ("Maximum reach", "9860 mm", "9990 mm"),
            ("Operating weight", "22500 kg", "23400 kg"), ("Net power", "110 kW", "121 kW")]  # fmt: skip
    tiles(c, 700, rows, widths=(150, 150, 150), bold=1)
    c.save()
    for model, weight in (("MW20-AZ3S", 22500.0), ("MW30-AC2", 23400.0)):
        found = said(extract(ASKED, [tmp_path / "a.pdf"], config=model))
        assert found["Operating Weight"] == ("ok", weight)


@pytest.mark.parametrize(("printed", "label"), [("6-11", "forward/backward"), ("6/11", "forward/backward")])
def test_a_dash_between_opposites_parts_two_numbers(printed: str, label: str) -> None:
    statement = Statement(1, 1, f"Tilt angle, {label}", printed, (0, 0, 40, 10), printed, unit="°")
    found = [(c.words, c.quantity.value, c.ranged) for c in claims_of([statement], "point")]
    assert found == [("Tilt angle, forward", 6.0, False), ("Tilt angle, backward", 11.0, False)]


def test_bold_words_between_rules_are_the_next_heading(tmp_path: Path) -> None:
    """The rules stand under the headings: one engine's power was the other's, and `ok`."""
    c = canvas(tmp_path / "a.pdf")
    for y, engine, power in ((700, "Engine – MW110", "130 kW"), (660, "Engine – MW120", "145 kW")):
        put(c, 60, y, engine, bold=True)
        c.line(60, y - 3, 300, y - 3)
        put(c, 60, y - 13, "Engine model")
        put(c, 220, y - 13, "Diesel Six")
        put(c, 60, y - 26, "Net power")
        put(c, 220, y - 26, power)
    c.save()
    assert extract(ASKED, [tmp_path / "a.pdf"]).values["Net Power"].status == "conflict"


def test_what_goes_on_past_a_value_is_none_of_its_label(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = [("Operating weight – minimum", "22 300 kg", "MA25 stick"), ("Operating weight", "23 000 kg", "MA29 stick")]
    c.line(60, 711, 330, 711)
    for index, (label, value, stick) in enumerate(rows):
        y = 700 - 45 * index
        put(c, 60, y, label)
        put(c, 280, y, value)
        put(c, 66, y - 12, f"Standard boom of 5.7 m, {stick}, bucket of 1.3 m3 and shoes of 600 mm")
        c.line(60, y - 20, 330, y - 20)
    c.save()
    found = extract(ASKED, [tmp_path / "a.pdf"]).values["Operating Weight"]
    assert {round(one.value) for one in found.candidates} == {22300, 23000} or found.value == 23000.0
