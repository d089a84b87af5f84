"""What makers' own pages do that plain tables do not: filled cells, notes of units, names of values in their cells."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from reportlab.lib.colors import HexColor, white
from specs_layouts import WIDTH, canvas, lattice, put, template, wanted

from yellowiron.model.errors import YellowironError
from yellowiron.model.specification import Specifications
from yellowiron.specs import accept, columns_of, extract, merge, parse_settings, read

LENGTHS = ("Maximum Reach", "Maximum Digging Depth", "Arm Length")
ASKED = template(
    *(wanted(name, "length") for name in LENGTHS),
    wanted("Operating Weight", "mass"),
    wanted("Net Power", "power"),
    wanted("Maximum Travel Speed", "speed"),
)


def said(found: Specifications) -> dict[str, tuple[str, float | None]]:
    return {s.name: (s.status, None if s.value is None else round(s.value, 4)) for s in found if s.status != "missing"}


def test_filled_cells_beside_a_drawing_are_a_table(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = [("Maximum Reach", "9,860 mm"), ("Maximum Digging Depth", "6,725 mm"), ("Arm Length", "2.94 m")]
    for x in (40, 320):
        c.setFillColor(HexColor("#003070"))
        c.rect(x, 700, 240, 14, stroke=0, fill=1)
        c.setFillColor(white)
        c.setFont("Helvetica-Bold", 8)
        c.drawString(x + 3, 704, "WORKING RANGES" if x == 40 else "WEIGHTS")
        for index in range(3):
            c.setFillColor(HexColor("#e6e8ea" if index % 2 else "#f2f4f6"))
            c.rect(x, 686 - 14 * index, 160, 14, stroke=0, fill=1)
            c.rect(x + 160, 686 - 14 * index, 80, 14, stroke=0, fill=1)
    for index, (label, _) in enumerate(rows):  # all labels first: the file's order is not the page's
        put(c, 43, 690 - 14 * index, label)
    for index, label in enumerate(("Operating Weight", "Net Power", "Maximum Travel Speed")):
        put(c, 323, 690 - 14 * index, label)
    for index, (_, value) in enumerate(rows):
        put(c, 203, 690 - 14 * index, value)
    for index, value in enumerate(("22,500 kg", "123 kW", "5.5 km/h")):
        put(c, 483, 690 - 14 * index, value)
    for step in range(12):  # a machine's drawing under the tables, in the walls' columns
        c.line(100 + 14 * step, 300, 100 + 14 * step, 420)
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"])) == {
        "Maximum Reach": ("ok", 9.86),
        "Maximum Digging Depth": ("ok", 6.725),
        "Arm Length": ("ok", 2.94),
        "Operating Weight": ("ok", 22500.0),
        "Net Power": ("ok", 123000.0),
        "Maximum Travel Speed": ("ok", 1.5278),
    }


def test_a_note_under_a_table_gives_its_unit(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    bottom = lattice(c, 60, 700, (200, 80), [("Maximum Reach", "9860"), ("Maximum Digging Depth", "6725")], heads=0)
    put(c, 60, bottom - 14, "All dimensions are in mm")
    c.save()
    found = said(extract(ASKED, [tmp_path / "a.pdf"]))
    assert found == {"Maximum Reach": ("ok", 9.86), "Maximum Digging Depth": ("ok", 6.725)}


def test_a_line_lists_values_behind_their_names(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "Operating Weight: 22,500 kg / 49,604 lb Net Power: 123 kW / 165 hp Arm Length: 2.94 m")
    c.save()
    found = said(extract(ASKED, [tmp_path / "a.pdf"]))
    assert found["Operating Weight"] == ("ok", 22500.0)
    assert found["Net Power"] == ("ok", 123000.0)
    assert found["Arm Length"] == ("ok", 2.94)


def test_the_ends_of_a_range_from_nothing_and_with_their_names(tmp_path: Path) -> None:
    crane = template(
        wanted("Minimum Working Radius", "length"),
        wanted("Maximum Working Radius", "length"),
        wanted("Maximum Travel Speed", "speed", "travel speed"),
    )
    c = canvas(tmp_path / "a.pdf")
    rows = [("Working Radius", "Min. 0.65m to Max. 7.51m"), ("Travel Speed", "0 - 4.3 kmph")]
    lattice(c, 60, 700, (200, 160), rows, heads=0)
    c.save()
    assert said(extract(crane, [tmp_path / "a.pdf"])) == {
        "Minimum Working Radius": ("ok", 0.65),
        "Maximum Working Radius": ("ok", 7.51),
        "Maximum Travel Speed": ("ok", 1.1944),
    }


def test_a_range_gives_both_ends_where_both_are_asked_for(tmp_path: Path) -> None:
    angles = replace(wanted("Boom Angle Minimum", "angle"), low_end_of="Boom Angle Maximum", minimum=-0.3, maximum=0.6)
    crane = template(wanted("Boom Angle Maximum", "angle", "boom raising speed", "boom angle"), angles)
    c = canvas(tmp_path / "a.pdf")
    lattice(c, 60, 700, (200, 160), [("Boom Raising Speed", "1°to 80°/25s"), ("Winch Drums", "2")], heads=0)
    c.save()
    found = said(extract(crane, [tmp_path / "a.pdf"]))
    assert found["Boom Angle Maximum"] == ("ok", pytest.approx(1.396, abs=1e-3))
    assert found["Boom Angle Minimum"] == ("ok", pytest.approx(0.01745, abs=1e-4))


def test_a_range_whose_lower_end_cannot_be_is_not_told_apart(tmp_path: Path) -> None:
    low = replace(wanted("Boom Length Retracted", "length"), low_end_of="Boom Length Extended", maximum=5.0)
    crane = template(wanted("Boom Length Extended", "length", "main boom"), low)
    c = canvas(tmp_path / "a.pdf")
    lattice(c, 60, 700, (200, 160), [("Main Boom", "18 m - 140 m"), ("Winch Drums", "2")], heads=0)
    c.save()
    found = said(extract(crane, [tmp_path / "a.pdf"]))
    assert found["Boom Length Extended"][0] != "ok" and "Boom Length Retracted" not in found


def models(path: Path) -> Path:
    c = canvas(path)
    rows = [
        ("Model", "QX 210", "QX 240"),
        ("Operating Weight", "21,500 kg", "24,300 kg"),
        ("Maximum Reach", "9,860 mm", "10,180 mm"),
        ("Maximum Digging Depth", "6,725 mm", "6,980 mm"),
    ]
    lattice(c, 60, 700, (200, 80, 80), rows)
    c.save()
    return path


def test_models_are_listed_and_chosen(tmp_path: Path) -> None:
    path = models(tmp_path / "a.pdf")
    assert [(c.name, c.page, c.values) for c in columns_of([read(path)])] == [("QX 210", 1, 3), ("QX 240", 1, 3)]
    found = said(extract(ASKED, [path], config="QX 240"))
    assert found["Operating Weight"] == ("ok", 24300.0)
    assert found["Maximum Reach"] == ("ok", 10.18)


def test_a_value_at_a_columns_head_names_the_column(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = [
        ("Arm length (mm)", "1620", "2120"),
        ("Maximum Reach (mm)", "6310", "6800"),
        ("Maximum Digging Depth (mm)", "4150", "4660"),
    ]
    lattice(c, 60, 700, (200, 80, 80), rows, heads=0)
    c.save()
    found = said(extract(ASKED, [tmp_path / "a.pdf"], config="2120"))
    assert {name: found[name][1] for name in LENGTHS} == {
        "Arm Length": 2.12,
        "Maximum Reach": 6.8,
        "Maximum Digging Depth": 4.66,
    }


def test_headings_in_the_middle_of_the_page_close_the_ones_before(tmp_path: Path) -> None:
    truck = template(wanted("Body Capacity", "volume", sections=("body capacity",)), wanted("Net Power", "power"))
    c = canvas(tmp_path / "a.pdf")
    y = 760
    for words, size in (("BODY OPTIONS", 16), ("Coal body", 9), ("ENGINE", 12), ("Net Power: 300 kW", 9)):
        c.setFont("Helvetica", size)
        (c.drawCentredString if size > 9 else c.drawString)(WIDTH / 2 if size > 9 else 80, y, words)
        y -= 30
    for index in range(6):
        put(c, 80, y - 20 * index, f"Filter number {index}: changed every {index + 2}00 hours", size=9)
    c.save()
    sheet = read(tmp_path / "a.pdf")
    assert next(s.section for s in sheet.statements if s.label == "Net Power") == "ENGINE"
    assert said(extract(truck, [tmp_path / "a.pdf"])) == {"Net Power": ("ok", 300000.0)}


def test_values_to_review_are_accepted_by_hand(tmp_path: Path) -> None:
    asked = template(
        wanted("Operating Weight", "mass", minimum=1000.0, maximum=50000.0), wanted("Arm Length", "length")
    )
    c = canvas(tmp_path / "a.pdf")
    rows = [("Operating weight, ready", "21,500 kg (49,604 lb)"), ("Arm length", "2.94 m")]
    lattice(c, 60, 700, (200, 160), rows, heads=0)
    c.save()
    found = extract(asked, [tmp_path / "a.pdf"])
    assert found.values["Operating Weight"].status == "review"  # the two systems differ
    for names in (["operating weight"], ["all-proven"]):
        settled = accept(found, names, asked)
        assert (settled.values["Operating Weight"].status, settled.values["Operating Weight"].source) == ("ok", "set")
        assert settled.values["Operating Weight"].value == 21500.0
        assert settled.values["Arm Length"].source == "sheet"
    by_hand = merge(found, parse_settings(["Operating Weight=22500 kg"], asked))
    assert by_hand.values["Operating Weight"].value == 22500.0
    with pytest.raises(YellowironError, match="is no value to review"):
        accept(found, ["Bucket Width"], asked)


def test_a_part_too_small_for_its_range_is_not_the_whole_machine(tmp_path: Path) -> None:
    crane = template(
        wanted("Boom Length Extended", "length", "maximum boom length", minimum=6.0, maximum=100.0),
        wanted("Overall Length", "length", "maximum length", minimum=4.0, maximum=30.0),
    )
    c = canvas(tmp_path / "a.pdf")
    lattice(c, 60, 700, (200, 160), [("Boom length", "Min. 3.27m to Max. 5.51m"), ("Cab width", "2.1 m")], heads=0)
    c.save()
    assert "ok" not in {s.status for s in extract(crane, [tmp_path / "a.pdf"])}
