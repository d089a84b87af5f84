"""What names a value's machine or column apart from its label: titles, headings, designations; keys behind labels."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from specs_layouts import canvas, put, template, wanted

from yellowiron.library import load_template
from yellowiron.model.specification import Specifications
from yellowiron.specs import extract
from yellowiron.specs.language.numbers import read
from yellowiron.specs.layout.statement import Statement, is_key, looks_like_value, without_key, without_last_keys
from yellowiron.specs.machines import with_machines
from yellowiron.specs.values.claims import claims_of
from yellowiron.specs.values.enumerations import enumerated
from yellowiron.specs.values.matching import match

BARE = Statement(page=1, row=1, label="", text="1 m", box=(0.0, 0.0, 1.0, 1.0), quote="")
ASKED = template(
    wanted("Blade Height", "length", "blade height"),
    wanted("Blade Weight", "mass", "blade weight"),
    wanted("Raise Time", "time", "raise time"),
    wanted("Engine Power", "power", "power", "maximum power"),
    wanted("Ground Clearance", "length", "ground clearance"),
)


def said(found: Specifications) -> dict[str, tuple[str, float | None]]:
    return {s.name: (s.status, s.value) for s in found if s.status != "missing"}


def test_each_page_is_of_the_model_that_its_title_names(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    for titles, value in ((("B35D", "B40D"), ""), (("B35D",), "13 s"), (("B40D",), "11.2 s")):
        for index, title in enumerate(titles):
            put(c, 60 + 100 * index, 800, title, size=20, bold=True)
        put(c, 60, 700, "Raise time" if value else "Models")
        put(c, 200, 700, value or "see below")
        c.showPage()
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"], config="B40D")) == {"Raise Time": ("ok", 11.2)}
    assert said(extract(ASKED, [tmp_path / "a.pdf"])) == {"Raise Time": ("conflict", None)}


def test_a_heading_that_heads_a_column_elsewhere_names_the_machine() -> None:
    columns = [replace(BARE, column=(model,)) for model in ("A35D", "A40D")]
    under = [replace(BARE, section="A35D"), replace(BARE, context=("A40D",)), replace(BARE, section="Engine")]
    named = with_machines([*columns, *under], [frozenset[str]()])
    assert [s.variant for s in named] == [(), (), ("A35D",), ("A40D",), ()]


def test_designations_head_columns_and_the_one_with_nothing_more_is_meant(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = (
        ("Blade", "8 SU", "8 U", "8 SU LGP"),
        ("Height", "1690 mm", "1740 mm", "1612 mm"),
        ("Weight", "4570 kg", "5135 kg", "4850 kg"),
    )
    for index, row in enumerate(rows):
        for column, text in enumerate(row):
            put(c, 60 + 120 * column, 700 - 16 * index, text, bold=index == 0)
    c.save()
    found = said(extract(ASKED, [tmp_path / "a.pdf"], config="SU"))
    assert found == {"Blade Height": ("ok", 1.69), "Blade Weight": ("ok", 4570.0)}


def test_what_is_at_its_most_is_named_by_the_line_above(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "Total retardation power", bold=True)
    put(c, 60, 686, "721 kW (967 hp) Maximum")
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"])).get("Engine Power", ("", 0.0))[0] != "ok"


@pytest.mark.parametrize("text", ["5.9 Seconds", "5.9 seconds", "250 BAR"])
def test_units_that_are_written_out_are_so_in_any_case(text: str) -> None:
    assert read(text)[0].numbers[0].unit


@pytest.mark.parametrize(("text", "value"), [("5 B-Pin height", False), ("24 V", True), ("●4", True)])
def test_numbered_labels_are_no_values(text: str, value: bool) -> None:
    assert looks_like_value(text) is value


def test_keys_before_and_behind_labels() -> None:
    assert without_key("5 B-Pin height") == "B-Pin height"
    assert is_key("s,e,l") and is_key("∂/ß")
    labels = ["Overall length A", "Tail swing radius F", "Reach at ground B'"]
    kept = [s.label for s in without_last_keys([replace(BARE, label=label) for label in labels])]
    assert kept == ["Overall length", "Tail swing radius", "Reach at ground"]
    two = [replace(BARE, label=label) for label in labels[:2]]
    assert without_last_keys(two) == two


def test_names_in_brackets_with_commas_between_them() -> None:
    assert enumerated("Forks (thickness, width, length)", 3) == ["Forks thickness", "Forks width", "Forks length"]
    assert enumerated("Ground clearance (laden, mast)", 3) == []


def test_a_long_remark_in_brackets_makes_no_label_too_long(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "Ground clearance (see the chart on the last page of this sheet for any other tires)")
    put(c, 460, 700, "496 mm")
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"]))["Ground Clearance"][1] == 0.496


def test_a_heading_over_a_bare_measure_names_the_thing_that_is_measured(tmp_path: Path) -> None:
    asked = template(
        wanted("Upperstructure Width", "length", "upperstructure width", "width of upper structure"),
        wanted("Operating Weight", "mass", "operating weight", "total weight", "operating weight with bucket"),
        wanted("Bucket Weight", "mass", "bucket weight"),
    )
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 720, "UPPER STRUCTURE SCREENGUARD", bold=True)
    put(c, 60, 700, "Width")
    put(c, 200, 700, "1110 mm")
    for x, text in ((200, "Total"), (260, "Tip")):
        put(c, x, 600, text)
    for x, text in ((200, "Weight"), (260, "Radius")):
        put(c, x, 588, text)
    for y, size in ((572, 1336), (558, 1336)):
        put(c, 60, y, "DB Buckets")
        put(c, 200, y, f"{size} kg")
        put(c, 260, y, "1660 mm")
    c.save()
    found = extract(asked, [tmp_path / "a.pdf"])
    assert not [s.name for s in found if s.status == "ok"]


def test_a_labels_second_line_may_begin_with_a_number(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    for y in (720, 690, 660):
        c.line(50, y, 400, y)
    put(c, 60, 709, "Blade height for")
    put(c, 60, 698, "2440 mm level bottom")
    put(c, 60, 675, "Ground clearance")
    for x, a, b in ((200, "8790 mm", "450 mm"), (300, "8380 mm", "460 mm")):
        put(c, x, 709, a)
        put(c, x, 675, b)
    c.save()
    assert all(s.value != 2.44 for s in extract(ASKED, [tmp_path / "a.pdf"]))


def test_a_list_in_a_frame_is_no_table(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = ("Raise time 11.2 s", "Blade height 1.69 m", "Blade weight 4570 kg", "Capac. max. 36 %", "Power 52 kW")
    for index, text in enumerate(rows):
        y = 700 - 20 * index
        c.rect(50, y - 6, 20, 20)
        c.rect(70, y - 6, 300, 20)
        put(c, 80, y, text)
    c.save()
    found = said(extract(ASKED, [tmp_path / "a.pdf"]))
    assert found["Raise Time"] == ("ok", 11.2)
    assert found["Blade Height"] == ("ok", 1.69)
    assert found["Blade Weight"] == ("ok", 4570.0)


@pytest.mark.parametrize("ruled", [True, False])
def test_rows_that_end_in_the_number_that_they_begin_with(tmp_path: Path, ruled: bool) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = [("1.2", "Model", "FD100-8", "FD150E-8")]
    rows += [(f"2.{n}", f"Anything {n}", f"{300 + n} mm", f"{310 + n} mm") for n in range(1, 4)]
    rows += [
        ("3.1", "Blade height", "2800 mm", "3100 mm"),
        ("3.1" if ruled else "3.2", "Ground clearance", "320 mm", "350 mm"),
    ]
    rows += [("4.1", "Blade weight", "12980 kg", "16570 kg"), ("4.2", "Raise time", "9 s", "11 s")]
    for index, row in enumerate(rows):
        y = 700 - 16 * index
        for x, text in zip((60, 100, 240, 340, 440), (*row, row[0]), strict=True):
            put(c, x, y, text)
        if ruled:
            for x0, x1 in pairwise((55, 95, 235, 335, 435, 475)):
                c.rect(x0, y - 5, x1 - x0, 16)
    c.save()
    found = said(extract(ASKED, [tmp_path / "a.pdf"], config="FD150E-8"))
    assert found["Blade Height"] == ("ok", 3.1)
    assert found["Blade Weight"] == ("ok", 16570.0)
    assert found["Raise Time"] == ("ok", 11.0)


def matched(*statements: Statement) -> dict[str, list[float]]:
    asked = load_template("excavator").wanted
    found = match(claims_of(statements, "point"), asked)
    return {n: sorted(m.claim.quantity.si_value for m in own if not m.rest) for n, own in found.items() if own}


def test_what_a_part_lends_its_name_to_is_not_the_machines() -> None:
    boom = replace(BARE, label="Height", text="2,050 mm", section="Shovel Boom")
    assert "Overall Height" not in {n for n, own in matched(boom).items() if own}
    width = replace(BARE, label="Shoe width", text="790 mm", context=("Undercarriage",))
    assert matched(width) == {"Shoe Width": [0.79]}


def test_a_heading_over_one_of_two_that_are_called_the_same_does_not_choose() -> None:
    first = replace(BARE, label="SAE J1349 Net, DIN 6271", text="285 kW", section="Engine")
    second = replace(first, row=2, text="309 kW", section="")
    other = replace(first, row=3, text="40 kW", section="Fan drive")
    assert matched(first, second, other)["Net Power"] == [285e3, 309e3]


def test_an_outlines_numbers_before_labels_that_rows_follow(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = (
        ("1", "Shipping height", "3350 mm"),
        ("2", "Length to centers of rollers", ""),
        ("", "  Standard undercarriage", "3610 mm"),
        ("3", "Ground clearance", "510 mm"),
        ("4", "Track gauge", ""),
        ("", "  Standard undercarriage", "2590 mm"),
        ("", "  Long undercarriage", "2590 mm"),
    )
    for index, row in enumerate(rows):
        for x, text in zip((60, 72, 300), row, strict=True):
            put(c, x + 12 * text.startswith(" "), 700 - 14 * index, text.strip())
    c.save()
    found = extract(load_template("excavator"), [tmp_path / "a.pdf"])
    assert said(found)["Track Gauge"] == ("ok", 2.59) and said(found)["Ground Clearance"] == ("ok", 0.51)


def test_a_value_in_both_systems_ends_before_the_next_ones_number(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 686, "Ground clearance")
    x = 200.0
    for model, value in (("R3.9D", "11 190 mm (36'9\")"), ("R3.2D", "11 140 mm (36'7\")")):
        put(c, x, 700, model, bold=True)
        x += put(c, x, 686, value) + 4.5
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"], config="R3.2D")) == {"Ground Clearance": ("ok", 11.14)}


def test_what_is_said_of_a_name_a_space_behind_it_heads_no_column(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 730, "KOMATSU", bold=True, size=14)
    put(c, 60, 714, "Especificaciones", bold=True)
    for index, (label, text) in enumerate((("Tipo de transmisión", "HY"), ("Peso", "15.48 t"))):
        y = 700 - 14 * index
        x = 72 + put(c, 72, y, label, bold=True) + 3
        put(c, x, y, text, bold=True)
        c.line(x - 1, y - 3, x - 1, y + 9)
    c.save()
    assert said(extract(load_template("forklift"), [tmp_path / "a.pdf"])) == {"Operating Weight": ("ok", 15480)}


def test_a_parts_row_under_a_propertys_head_is_not_the_machines() -> None:
    stick = replace(
        BARE, label="R3.9D STICK", text="3900 mm", column=("Load Point", "Height"), section="Boom Capacities"
    )
    assert "Overall Height" not in matched(stick)
