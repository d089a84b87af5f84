"""Slips of tables that a person sees at once: units a row too high, gears without a name, two numbers for one label."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from reportlab.lib.colors import HexColor
from specs_layouts import canvas, put, template, wanted

from yellowiron.model.specification import Specifications
from yellowiron.specs import extract
from yellowiron.specs.layout.statement import looks_like_value, without_key
from yellowiron.specs.machines import of_sisters

ROWS = [
    ("Model", "", "FX40", "FX50"),
    ("Wheelbase", "mm", "2100", "2150"),
    ("Operating weight", "kg", "6230", "6500"),
    ("Overall length", "mm", "4280", "4345"),
    ("Overall width", "mm", "1490", "1495"),
    ("Ground clearance", "mm", "186", "187"),
    ("Travel speed", "km/h", "24", "25"),
    ("Drawbar pull", "kN", "30", "31"),
    ("Engine power", "kW", "52", "53"),
    ("Operating pressure", "bar", "195", "196"),
    ("Axle weight", "kg", "2978", "2837"),
    ("Fork width", "mm", "150", "151"),
    ("Fork length", "mm", "1070", "1071"),
    ("Turning radius", "mm", "2850", "2905"),
    ("Tank", "", "Steel", "Steel"),
]
ASKED = template(
    wanted("Wheelbase", "length"),
    wanted("Operating Weight", "mass"),
    wanted("Overall Length", "length"),
    wanted("Overall Width", "length"),
    wanted("Drawbar Pull", "force"),
    wanted("Turning Radius", "length"),
)


def table(path: Path, rows: Sequence[Sequence[str]]) -> Path:
    """A table of filled cells."""
    c = canvas(path)
    for index, row in enumerate(rows):
        x = 40.0
        for text, width in zip(row, (150, 40, 70, 70), strict=True):
            c.setFillColor(HexColor("#dadada" if index % 2 else "#eeeeee"))
            c.rect(x, 700 - 14 * (index + 1), width, 14, stroke=0, fill=1)
            c.setFillColor(HexColor("#000000"))
            c.setFont("Helvetica-Bold" if not index else "Helvetica", 8)
            c.drawString(x + 3, 704 - 14 * (index + 1), text)
            x += width
    c.save()
    return path


def slipped(rows: Sequence[Sequence[str]], by: int) -> list[tuple[str, ...]]:
    units = [row[1] for row in rows]
    return [(row[0], units[(n + by) % len(rows)], *row[2:]) for n, row in enumerate(rows)]


def said(found: Specifications) -> dict[str, tuple[str, float]]:
    return {s.name: (s.status, round(s.value, 3)) for s in found if s.value is not None}


def test_units_in_their_rows_are_left_there(tmp_path: Path) -> None:
    found = said(extract(ASKED, [table(tmp_path / "a.pdf", ROWS)], config="FX40"))
    assert found["Wheelbase"] == ("ok", 2.1) and found["Operating Weight"] == ("ok", 6230.0)
    assert {status for status, _ in found.values()} == {"ok"}


@pytest.mark.parametrize("by", [1, -1])
def test_units_a_row_off_are_those_of_the_labels_they_fit(tmp_path: Path, by: int) -> None:
    """For review where the row prints another one; where both agree nothing is doubtful."""
    found = said(extract(ASKED, [table(tmp_path / "a.pdf", slipped(ROWS, by))], config="FX40"))
    assert found["Operating Weight"] == ("review", 6230.0)
    assert found["Drawbar Pull"] == ("review", 30000.0)
    assert found["Overall Length"][1] == 4.28 and found["Turning Radius"][1] == 2.85
    assert found["Overall Width"] == ("ok", 1.49)


def test_a_few_units_that_fit_no_label_move_nothing(tmp_path: Path) -> None:
    rows = [row if n not in (1, 2) else (row[0], "kN", *row[2:]) for n, row in enumerate(ROWS)]
    found = said(extract(ASKED, [table(tmp_path / "a.pdf", rows)], config="FX40"))
    assert "Wheelbase" not in found and found["Overall Length"] == ("ok", 4.28)


def test_gears_say_the_greatest_speed_together_and_none_alone(tmp_path: Path) -> None:
    asked = template(wanted("Maximum Travel Speed", "speed", "travel speed", maximum=30.0))
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "VEHICLE SPEEDS")
    for n, speed in enumerate(("8", "17", "24", "37")):
        put(c, 60, 680 - 14 * n, f"{n + 1}. gear")
        put(c, 200, 680 - 14 * n, f"{speed} km/h")
    c.save()
    assert said(extract(asked, [tmp_path / "a.pdf"])) == {"Maximum Travel Speed": ("ok", round(37 / 3.6, 3))}
    reason = extract(asked, [tmp_path / "a.pdf"]).values["Maximum Travel Speed"].reason
    assert reason.endswith("; the rows count 4 values up or down, of which this is the last")
    c = canvas(tmp_path / "b.pdf")
    put(c, 60, 700, "VEHICLE SPEEDS")
    put(c, 60, 680, "2. gear")
    put(c, 200, 680, "17 km/h")
    c.save()
    assert said(extract(asked, [tmp_path / "b.pdf"])) == {}


@pytest.mark.parametrize(
    ("title", "forward", "reverse"),
    [
        ("TRAVEL SPEEDS", ("F1", "F2", "F3", "F4"), ("R1", "R2", "R3")),
        ("TRANSMISIÓN", ("1era marcha", "2da marcha", "3ra marcha", "4ta marcha (solo avance)"), ("R",)),
        ("Getriebe", ("1. Gang", "2. Gang", "3. Gang", "4. Gang"), ("R",)),
    ],
)
def test_gears_of_either_way(tmp_path: Path, title: str, forward: Sequence[str], reverse: Sequence[str]) -> None:
    speeds = [7.4, 14.5, 25.2, 37.9]
    asked = template(wanted("Maximum Travel Speed", "speed", "travel speed"),
                     wanted("Maximum Reverse Speed", "speed", "reverse travel speed"))  # fmt: skip
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, title, size=11, bold=True)
    rows = [*zip(forward, speeds, strict=True), *((gear, 0.9 * v) for gear, v in zip(reverse, speeds, strict=False))]
    for n, (gear, speed) in enumerate(rows):
        put(c, 60, 680 - 14 * n, gear)
        put(c, 200, 680 - 14 * n, f"{speed:.2f} km/h")
    c.save()
    found = said(extract(asked, [tmp_path / "a.pdf"]))
    assert found["Maximum Travel Speed"] == ("ok", round(37.9 / 3.6, 3))
    assert found["Maximum Reverse Speed"] == ("ok", round(0.9 * speeds[len(reverse) - 1] / 3.6, 3))


def test_of_a_pair_under_a_label_of_one_the_first_is_meant(tmp_path: Path) -> None:
    asked = template(wanted("Axle Load Front", "mass"), wanted("Overall Width", "length"))
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "Axle load, front")
    put(c, 200, 700, "2978 kg / 3252 kg")
    put(c, 60, 680, "Overall width, standard / dual")
    put(c, 200, 680, "1490 mm")
    c.save()
    found = extract(asked, [tmp_path / "a.pdf"])
    assert said(found) == {"Axle Load Front": ("review", 2978.0), "Overall Width": ("ok", 1.49)}
    assert [c.value for c in found.values["Axle Load Front"].candidates] == [2978.0, 3252.0]


def test_units_in_capitals_and_keys_before_small_letters() -> None:
    assert looks_like_value("6900KG") and not looks_like_value("990XYZ")
    assert without_key("F standard track shoe width") == "standard track shoe width"
    assert without_key("A standard boom") == "A standard boom"


def test_pages_that_go_on_with_a_sister() -> None:
    titles = [frozenset({name} if name else ()) for name in ("BX35D", "", "BX40D", "", "BX45D", "")]
    assert of_sisters(titles, "BX40D") == {1, 2, 5, 6}
    assert of_sisters(titles, "") == of_sisters(titles, "standard boom") == frozenset()
    assert of_sisters([*titles[:3], frozenset(), frozenset(), *titles[4:]], "BX40D") == {1, 6}
