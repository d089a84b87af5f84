"""Tables of makers' brochures whose every cell is filled, on pages cut out of spreads, for several models at once."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from reportlab.lib.colors import HexColor
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.cidfonts import UnicodeCIDFont
from reportlab.pdfgen.canvas import Canvas
from specs_layouts import canvas, put, template, wanted

from yellowiron.model.specification import Specifications
from yellowiron.specs import extract
from yellowiron.specs.language.numbers import read
from yellowiron.specs.layout.statement import counting, is_unit

ASKED = template(
    wanted("Maximum Reach", "length"),
    wanted("Maximum Digging Depth", "length"),
    wanted("Operating Weight", "mass", maximum=1e6),
    wanted("Net Power", "power"),
    wanted("Swing Speed", "angular_speed"),
    wanted("Maximum Travel Speed", "speed", "travel speed high"),
    wanted("Travel Speed Low", "speed"),
)
WIDTHS = (150, 30, 70, 70)


def tiles(
    c: Canvas, top: float, rows: Sequence[Sequence[str]], *, bold: int = 0, widths: Sequence[float] = WIDTHS
) -> float:
    """Draws a table without rules: every cell a filled box, the first `bold` rows in bold; returns where it ends."""
    for index, row in enumerate(rows):
        x = 40.0
        for text, width in zip(row, widths, strict=True):
            c.setFillColor(HexColor("#dadada" if index % 2 else "#eeeeee"))
            c.rect(x, top - 14 * (index + 1), width, 14, stroke=0, fill=1)
            c.setFillColor(HexColor("#000000"))
            c.setFont("Helvetica-Bold" if index < bold else "Helvetica", 8)
            c.drawString(x + 3, top - 14 * (index + 1) + 4, text)
            x += width
    return top - 14 * len(rows)


def said(found: Specifications) -> dict[str, tuple[str, float | None]]:
    return {s.name: (s.status, None if s.value is None else round(s.value, 4)) for s in found if s.status != "missing"}


ROWS = [
    ("Machine model", "", "8008", "8010"),
    ("Maximum reach", "mm", "9860", "9990"),
    ("Maximum digging depth", "mm", "6725", "6850"),
    ("Operating weight", "kg", "22500", "23400"),
]


@pytest.mark.parametrize(("config", "reach", "weight"), [("8008", 9.86, 22500.0), ("8010", 9.99, 23400.0)])
def test_bare_numbers_beside_model_head_the_columns(tmp_path: Path, config: str, reach: float, weight: float) -> None:
    c = canvas(tmp_path / "a.pdf")
    tiles(c, 700, ROWS)
    c.save()
    found = said(extract(ASKED, [tmp_path / "a.pdf"], config=config))
    assert (found["Maximum Reach"], found["Operating Weight"]) == (("ok", reach), ("ok", weight))


def test_a_drawing_inside_a_table_moves_no_row(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    tiles(c, 700, ROWS)
    for step in range(30):  # strokes two points apart, from one row over the next ones, and a table's wall among them
        c.line(225, 698 - 2 * step, 255, 698 - 2 * step)
    c.line(220, 640, 220, 700)
    c.line(240, 640, 240, 700)
    c.save()
    found = said(extract(ASKED, [tmp_path / "a.pdf"], config="8010"))
    assert found["Maximum Digging Depth"] == ("ok", 6.85)
    assert found["Operating Weight"] == ("ok", 23400.0)


def test_what_lies_beyond_the_edge_is_not_on_the_page(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "Maximum reach")
    put(c, 200, 700, "9860 mm")
    put(c, -300, 700, "Maximum reach")  # the other page of the spread
    put(c, -160, 700, "7000 mm")
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"])) == {"Maximum Reach": ("ok", 9.86)}


def test_a_row_alone_tells_the_tables_beside_each_other_apart(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 40, 712, "WORKING RANGES", bold=True)
    end = tiles(c, 700, [("4.7 m monoboom", "", "", ""), *ROWS[1:3]])
    tiles(c, end - 60, [("5.0 m T.A.B.", "", "", ""), ("Maximum reach", "mm", "9000", "9100"), ROWS[2], ROWS[3]])
    c.save()
    found = extract(ASKED, [tmp_path / "a.pdf"], config="monoboom").values["Maximum Reach"]
    assert {round(one.value, 3) for one in found.candidates} == {9.86, 9.99}  # of two columns without a name


def test_two_values_of_one_cell_are_named_behind_each_other(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = [
        ("Maximum reach", "9860 mm"),
        ("Travel speed", "High: 5.5 km/h"),
        ("", "Low: 3.1 km/h"),
        ("Swing speed", "JS145W: 12.6 rpm JS160W: 8.9 rpm"),
    ]
    tiles(c, 700, rows, widths=(150, 170))
    c.save()
    found = said(extract(ASKED, [tmp_path / "a.pdf"], config="JS160W"))
    assert found["Maximum Travel Speed"] == ("ok", round(5.5 / 3.6, 4))
    assert found["Travel Speed Low"] == ("ok", round(3.1 / 3.6, 4))
    assert found["Swing Speed"] == ("ok", round(8.9 * 2 * 3.14159265 / 60, 4))


def test_what_a_list_says_behind_a_number_names_it(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "The machine has a vinyl seat, 9000 mm maximum reach (8010), 8800 mm boom.")
    put(c, 60, 688, "Its operating weight is 22,500 kg. It needs no permit to be driven on the road.")
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"])) == {"Operating Weight": ("ok", 22500.0)}


def test_two_models_in_one_line_are_not_the_first(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "Operating weight: 22500kg/23400kg   Net power: 90.0kW/113.8kW")
    c.save()
    found = extract(ASKED, [tmp_path / "a.pdf"])
    assert {found.values[name].status for name in ("Operating Weight", "Net Power")} == {"conflict"}
    assert [q.value for r in read("9.0kW/13.8kW") for q in r.numbers] == [9.0, 13.8]


@pytest.mark.parametrize(
    ("printed", "unit"),
    [("Seconds", "Seconds"), ("grados", "grados"), ("KN", "KN"), ("Kg/ cm2", "Kg/ cm2"), ("kW @ 1800 rpm", "kW"),
     ("kW (hp) @ 2100rpm", "kW|hp"), ("Alta", ""), ("M", "")],
)  # fmt: skip
def test_units_as_brochures_spell_them(printed: str, unit: str) -> None:
    assert is_unit(printed) == unit


@pytest.mark.slow
@pytest.mark.parametrize(
    ("config", "status"), [("MW110", "ok"), ("MW130", "review"), ("", "ok"), ("standard boom", "ok")]
)
def test_what_all_other_models_have_is_not_sure_of_one_whose_rows_are_numbered(
    tmp_path: Path, config: str, status: str
) -> None:
    """The spread's second page has the rows' numbers alone."""
    c = canvas(tmp_path / "a.pdf")
    tiles(c, 700, [("Model", "", "MW110 LC", "MW120"), ("Maximum reach", "mm", "9860", "9860")])
    c.showPage()
    tiles(c, 700, [("1", "", "MW130", "MW110"), ("2", "", "9990", "9990")])
    c.save()
    found = said(extract(ASKED, [tmp_path / "a.pdf"], config=config))
    assert found["Maximum Reach"] == (status, 9.86)


def test_a_spreads_second_page_has_the_labels_of_its_rows_numbers(tmp_path: Path) -> None:
    rows = [
        ("Model", "", "MW110", "MW120"), ("Maximum reach", "mm", "9860", "9990"),
        ("Maximum digging depth", "mm", "6725", "6850"), ("Net power", "kW", "110", "110"),
        ("Operating weight", "kg", "22500", "23400"), ("Swing speed", "rpm", "11.5", "11.5"),
        ("Travel speed", "km/h", "5.5", "5.6"), ("Engine", "", "A", "B"), ("Brakes", "", "drum", "drum"),
        ("Seat", "", "sprung", "sprung"),
    ]  # fmt: skip
    others = ["MW130", "10120", "6990", "121", "26100", "10.5", "5.3", "C", "drum", "sprung"]
    widths = (20, 150, 30, 70, 70)
    c = canvas(tmp_path / "a.pdf")
    tiles(c, 700, [(str(i), *row) for i, row in enumerate(rows, 1)], widths=widths, bold=1)
    c.showPage()
    tiles(c, 700, [(str(i), own, own) for i, own in enumerate(others, 1)], widths=(20, 70, 70), bold=1)
    c.save()
    found = said(extract(ASKED, [tmp_path / "a.pdf"], config="MW130"))
    assert found["Maximum Reach"] == ("ok", 10.12)
    assert found["Maximum Digging Depth"] == ("ok", 6.99)
    assert found["Operating Weight"] == ("ok", 26100.0)
    assert found["Net Power"] == ("ok", 121000.0)
    assert said(extract(ASKED, [tmp_path / "a.pdf"], config="MW120"))["Maximum Reach"] == ("ok", 9.99)


def test_digits_in_circles_are_keys_and_no_numbers(tmp_path: Path) -> None:
    """They are digits to Python, and no integers: a reader failed on them."""
    keys = [chr(ord("①") + i) for i in range(10)]
    assert not counting(keys) and counting(["1", "2"])
    pdfmetrics.registerFont(UnicodeCIDFont("HeiseiKakuGo-W5"))
    c = canvas(tmp_path / "a.pdf")
    for i, key in enumerate(keys):
        c.setFont("HeiseiKakuGo-W5", 9)
        c.drawString(40, 700 - 14 * i, key)
        put(c, 60, 700 - 14 * i, "Maximum reach" if i == 0 else f"Height {key}")
        put(c, 260, 700 - 14 * i, f"{9860 - 100 * i} mm")
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"]))["Maximum Reach"] == ("ok", 9.86)


def test_a_number_of_thousands_of_digits_is_none_of_a_row(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    c.setFont("Helvetica", 0.05)
    c.drawString(40, 500, "9" * 5000)
    tiles(c, 700, ROWS)
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"], config="8008"))["Maximum Reach"] == ("ok", 9.86)
