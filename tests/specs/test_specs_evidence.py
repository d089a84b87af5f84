"""What evidence an `ok` takes, learnt on makers' PDFs that nobody had read before."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from specs_layouts import canvas, lattice, put, template, wanted

from yellowiron.model.template import Template
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.reader import Sheet, read_sheet

CRANE = template(
    wanted("Overall Height", "length", "height", "maximum height"),
    wanted("Ground Clearance", "length", "ground clearance"),
    wanted("Maximum Lifting Capacity", "mass", "maximum lifting capacity", "crane capacity"),
    wanted("Boom Angle Maximum", "angle", "boom elevation"),
    wanted("Boom Angle Minimum", "angle", "minimum boom elevation", low_end_of="Boom Angle Maximum"),
)
TRUCK = template(
    wanted("Load Center", "length", "load centre distance"),
    wanted("Load Distance", "length", "load distance", "load distance, centre of axle to fork"),
    wanted("Travel Speed", "speed", "travel speed", forbidden=("lift",)),
    wanted("Front Tread", "length", "tread front"),
    wanted("Rear Tread", "length", "tread rear"),
)


def page(path: Path, rows: list[tuple[str, ...]]) -> Sheet:
    c = canvas(path)
    for index, row in enumerate(rows):
        for column, text in enumerate(row):
            put(c, 60 + 230 * column, 700 - 16 * index, text)
    c.save()
    return read_sheet(path)


def said(asked: Template, sheet: Sheet) -> dict[str, tuple[str, float | None]]:
    return {
        s.name: (s.status, None if s.value is None else round(s.value, 4))
        for s in from_sheets(asked, [sheet])
        if s.status != "missing"
    }


def test_what_a_picture_says_is_its_own_names_though_text_has_settled_it(tmp_path: Path) -> None:
    sheet = page(tmp_path / "a.pdf", [("Load centre distance", "600 mm")])
    again = tuple(replace(s, guessed=True) for s in sheet.statements)
    sheet = replace(sheet, statements=(*sheet.statements, *again), recognised=(1,), recogniser="rapidocr")
    assert said(TRUCK, sheet) == {"Load Center": ("ok", 0.6)}


def test_maximum_makes_a_height_no_machines(tmp_path: Path) -> None:
    rows = [("Frame height (ground to frame top)", "Approx. 1,300 mm max.")]
    assert "ok" not in {status for status, _ in said(CRANE, page(tmp_path / "a.pdf", rows)).values()}
    assert said(CRANE, page(tmp_path / "b.pdf", [("Maximum height", "3,300 mm")])) == {"Overall Height": ("ok", 3.3)}


def test_of_two_values_the_one_that_is_called_the_maximum(tmp_path: Path) -> None:
    rows = [("Maximum lifting capacity", "10,000 kg"), ("Crane capacity", "4,900 kg")]
    assert said(CRANE, page(tmp_path / "a.pdf", rows)) == {"Maximum Lifting Capacity": ("review", 10000.0)}
    rows[0] = ("Crane capacity", "10,000 kg")
    assert said(CRANE, page(tmp_path / "b.pdf", rows)) == {"Maximum Lifting Capacity": ("conflict", None)}


def test_a_raised_o_is_a_degree(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "Boom elevation")
    for x, number in ((290, "1"), (309, "82")):
        end = put(c, x, 700, number)
        put(c, x + end + 0.3, 704, "o", size=5)
    put(c, 299, 700, "to")
    c.save()
    found = said(CRANE, read_sheet(tmp_path / "a.pdf"))
    assert found == {"Boom Angle Maximum": ("ok", 1.4312), "Boom Angle Minimum": ("ok", 0.0175)}


@pytest.mark.parametrize(
    ("title", "found"),
    [("A Series Mini Range Pallet Truck With Initial Lift", {"Travel Speed": ("ok", 1.6667)}), ("Lift", {})],
)
def test_a_products_name_over_a_table_names_no_part(tmp_path: Path, title: str, found: dict[str, object]) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 740, title, size=16, bold=True)
    lattice(c, 60, 700, [120, 100], [("Model", "X-100"), ("Travel speed", "6 km/h")])
    c.save()
    assert said(TRUCK, read_sheet(tmp_path / "a.pdf")) == found


@pytest.mark.parametrize(("last", "is_ok"), [("2,040 mm", True), ("6 ft 8 in", False)])
def test_a_bare_number_has_the_only_unit_of_the_sheet(tmp_path: Path, last: str, is_ok: bool) -> None:
    names = ("Mast height", "Lift height", "Wheelbase", "Fork length", "Length", "Guard height", "Fork carriage")
    rows = [(name, f"{1000 + 10 * n} mm") for n, name in enumerate(names)]
    rows += [("Width", last), ("Tread front / rear", "1,474 / 1,730")]
    found = said(TRUCK, page(tmp_path / "a.pdf", rows))
    assert (found.get("Front Tread") == ("ok", 1.474)) is is_ok
    assert (found.get("Rear Tread") == ("ok", 1.73)) is is_ok
