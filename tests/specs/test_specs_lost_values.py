"""What makers' brochures print and reading lost: each cause in the smallest form that shows it."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import pytest
from specs_layouts import template, wanted

from yellowiron.model.specification import Specification
from yellowiron.model.template import Template
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.layout.nearest import Near, nearest_of
from yellowiron.specs.layout.rows.lines import TextLine
from yellowiron.specs.layout.rows.prose import paragraphs_of, read_paragraph
from yellowiron.specs.layout.statement import Statement, TextPiece, looks_like_value
from yellowiron.specs.pages.words import Page, Word
from yellowiron.specs.reader import Sheet
from yellowiron.specs.values.claims import claims_of


def said(label: str, text: str, *, row: int = 1, page: int = 1, **more: Any) -> Statement:
    return Statement(page, row, label, text, (200, 20.0 * row, 240, 20.0 * row + 8), f"{label} {text}".strip(), **more)


def reading(asked: Template, *statements: Statement) -> dict[str, Specification]:
    """What becomes of a sheet that says this; the second reading sees a word of another page."""
    elsewhere = Near("left", said("Elsewhere", "3 g", page=99))
    return from_sheets(asked, [Sheet("a.pdf", 9, statements, (), "point", near=(elsewhere,))]).values


def test_a_bare_number_with_feet_in_brackets_behind_it_has_the_unit_in_which_they_agree() -> None:
    row = Statement(1, 0, "Distancia entre ejes", "3,275 (10'9\")", (0, 0, 9, 9), "q")
    (claim,) = claims_of([row], "point")
    assert (claim.quantity.si_value, claim.quantity.unit, claim.doubt) == (3.275, "mm", "")
    other = Statement(1, 0, "Distancia entre ejes", "3,275 (9'6\")", (0, 0, 9, 9), "q")
    assert all(c.doubt for c in claims_of([other], "point") if c.quantity.unit)


def test_a_number_without_a_unit_comes_to_review_in_the_one_that_is_usual() -> None:
    asked = template(*(wanted(f"{end} Tread", "length", minimum=0.3, maximum=4.0) for end in ("Front", "Rear")))
    row = said("Tread front / rear", "1,474 / 1,730")
    found = reading(asked, row)
    assert {n: (s.status, s.value) for n, s in found.items()} == {
        "Front Tread": ("review", pytest.approx(1.474)),
        "Rear Tread": ("review", pytest.approx(1.73)),
    }
    assert found["Rear Tread"].reason == "the sheet prints no unit for '1,730': in mm it would be usual"
    assert reading(asked, said("Tread front / rear", "7 / 8"))["Front Tread"].status == "missing"


def test_a_label_without_the_word_that_its_unit_says_comes_to_review() -> None:
    asked = template(wanted("Arm Length", "length"), wanted("Slewing Speed", "angular_speed", "swing speed"))
    found = reading(asked, said("Arm", "880 mm"), said("continuous smooth swing", "2.5 rpm", row=2, running=True))
    assert (found["Arm Length"].status, found["Arm Length"].value) == ("review", pytest.approx(0.88))
    assert found["Arm Length"].reason == "that 'Arm' is a length, only its unit says"
    assert (found["Slewing Speed"].status, found["Slewing Speed"].value) == ("review", pytest.approx(0.2617994))
    others = reading(asked, said("Arm width", "880 mm"), said("Arm", "880 mm", row=2, column=("Stroke",)))
    assert others["Arm Length"].status == "missing", "what names another property is none"


def test_a_torque_for_a_force_is_the_force_that_is_meant() -> None:
    asked = template(wanted("Bucket Digging Force", "force", "bucket breakout force"))
    found = reading(asked, said("Bucket breakout force", "247.3 kNm"))["Bucket Digging Force"]
    assert (found.status, found.value) == ("review", pytest.approx(247300.0))
    assert found.reason == "the sheet prints 'kNm' for a force"


@pytest.mark.parametrize(
    ("label", "variant", "head"),
    [("Forward speed {}", (), ""), ("Forward speed", ("{}",), ""), ("", ("{}",), "Maximum speed")],
)  # fmt: skip
def test_of_values_that_rows_count_the_last_is_the_maximum(label: str, variant: tuple[str, ...], head: str) -> None:
    asked = template(wanted("Maximum Travel Speed", "speed", "forward speed", "maximum speed", "speed"))
    rows = [
        said(label.format(n), f"{speed} km/h", row=n, column=(head,) if head else (),
             variant=tuple(v.format(n) for v in variant), heads=(head,))
        for n, speed in ((1, 7.3), (2, 12.5), (3, 27.5), (4, 40.0))
    ]  # fmt: skip
    found = reading(asked, *rows)["Maximum Travel Speed"]
    assert (found.status, found.value) == ("ok", pytest.approx(40.0 / 3.6))
    assert "; the rows count 4 values up or down, of which this is the last" in found.reason
    without_the_first = reading(asked, *rows[1:])["Maximum Travel Speed"]
    assert (without_the_first.status, without_the_first.value) == ("review", pytest.approx(40.0 / 3.6))
    assert reading(asked, *rows[:2])["Maximum Travel Speed"].status == "conflict", "two are no series"
    unordered = [*rows[:2], replace(rows[2], text="3 km/h"), rows[3]]
    assert reading(asked, *unordered)["Maximum Travel Speed"].status == "conflict"


def test_a_row_that_is_called_the_maximum_ends_the_chart() -> None:
    asked = template(wanted("Boom Length Extended", "length", "maximum boom length", "boom length"))
    chart = [said("", f"{ft} ft", row=ft, page=9, column=("Length", "Boom")) for ft in (35, 50, 65, 80)]
    found = reading(asked, said("Maximum boom length", "110 ft"), *chart)["Boom Length Extended"]
    assert (found.status, found.value) == ("ok", pytest.approx(33.528))
    assert reading(asked, said("Boom length", "110 ft"), *chart)["Boom Length Extended"].status == "conflict"


def test_two_times_a_flow_is_what_both_pumps_give() -> None:
    asked = template(wanted("Main Pump Flow", "flow", "maximum flow"))
    found = reading(asked, said("Maximum flow", "2 x 123 l/min"))["Main Pump Flow"]
    assert (found.status, found.value) == ("ok", pytest.approx(0.0041))
    assert reading(asked, said("Maximum flow (2x)", "123 l/min"))["Main Pump Flow"].status == "review"


def test_a_label_in_several_languages_over_its_value() -> None:
    asked = template(wanted("Maximum Lifting Capacity", "mass", "rated capacity"))
    above = ("Rated capacity Capacité nominale", "Nenntraglast:")
    found = reading(asked, said("", "72.6 t at 3 m", context=above))["Maximum Lifting Capacity"]
    assert found.value == pytest.approx(72600.0)


def test_the_basic_boom_is_the_standard_one() -> None:
    asked = template(wanted("Operating Weight", "mass", "total weight", forbidden=("boom",)))
    assert reading(asked, said("Total weight (with basic boom)", "108,000 kg"))["Operating Weight"].status == "ok"
    assert reading(asked, said("Total weight (with long boom)", "108,000 kg"))["Operating Weight"].status == "missing"


def test_a_designation_before_a_diameter_is_part_of_the_value() -> None:
    assert looks_like_value("IWRC 6×P・WS(26)φ10mm×129m")
    assert not looks_like_value("Lift cylinder φ10mm×129m") and not looks_like_value("LIFT CYLINDER φ10")
    row = said("Wire rope", "IWRC 6×P・WS(26)φ10mm×129m")
    assert [c.quantity.si_value for c in claims_of([row], "point") if c.words == "Wire rope diameter"] == [0.01]


@pytest.mark.parametrize(
    ("text", "side", "label", "value"),
    [
        ("38 - 115 ft four-section full power boom", "behind", "section full power boom", "4"),
        ("five section TWIN-LOCK boom, 51 m", "behind", "section  boom", "5"),
        ("Overall ratio: 23.68:1 Rear oscillations: ± 12°", "item", "Rear oscillations", "± 12°"),
        ("Weight: 9 t Power: 74 kW", "item", "Power", "74 kW"),
    ],
)
def test_what_a_piece_of_text_says_by_itself(text: str, side: str, label: str, value: str) -> None:
    words, x = [], 40.0
    for word in text.split():
        words.append(Word(word, x, x + 4.0 * len(word), 100.0, 8.0))
        x += 4.0 * len(word) + 2.0
    near = [n for n in nearest_of(Page(1, 600, 800, tuple(words))) if n.side == side]
    assert (label, value) in {(n.statement.label, n.statement.text) for n in near}


def test_three_telescoping_sections_are_not_all_of_them() -> None:
    words = tuple(Word(w, 40.0 + 60 * i, 95.0 + 60 * i, 100.0, 8.0) for i, w in enumerate(("three", "sections")))
    assert not [n for n in nearest_of(Page(1, 600, 800, words)) if n.side == "behind"]


@pytest.mark.parametrize(
    ("lines", "label", "value"),
    [
        (
            ("38 - 115 ft (11.6 - 35 m) four-section", "full power boom."),
            "four-section full power boom",
            "38 - 115 ft (11.6 - 35 m)",
        ),
        (
            ("35.5-110 ft (10.8-33.5 m) four-section boom", "Two mode extension of sections, by one cylinder."),
            "four-section boom",
            "35.5-110 ft (10.8-33.5 m)",
        ),
        (
            ("Hydraulic motor with a reducer for", "continuous smooth swing at 2.5 rpm."),
            "Hydraulic motor with a reducer for continuous smooth swing",
            "2.5 rpm.",
        ),
    ],
)
def test_running_text_that_opens_with_a_value_or_says_at(lines: tuple[str, ...], label: str, value: str) -> None:
    def line(text: str, baseline: float) -> TextLine:
        starts = [40.0 + 4 * match.start() for match in re.finditer(r"\S+", text)]
        words = zip(text.split(), starts, strict=True)
        return TextLine((TextPiece(tuple(Word(w, x, x + 4 * len(w), baseline, 8.0) for w, x in words)),))

    (paragraph,) = paragraphs_of([line(text, 100.0 + 10 * n) for n, text in enumerate(lines)])
    assert (label, value) in [(s.label, s.text) for s in read_paragraph(1, paragraph, 0, "Boom")]


def test_what_a_cell_says_in_itself_gives_way_to_the_words_around_a_value() -> None:
    asked = template(wanted("Arm Length", "length"))
    cell, beside = said("Arm", "880 mm"), Near("left", said("Arm length", "1,690 mm", row=3))
    found = from_sheets(asked, [Sheet("a.pdf", 1, (cell,), (), "point", near=(beside,))]).values["Arm Length"]
    assert (found.status, found.value) == ("review", pytest.approx(1.69))


def test_a_speed_of_nothing_gives_way_to_one_that_can_be() -> None:
    asked = template(wanted("Maximum Travel Speed", "speed", "travel speed", minimum=1.0, maximum=40.0))
    cell, beside = said("Travel speed", "0 mph"), Near("left", said("Travel speed", "65 mph", row=3))
    found = from_sheets(asked, [Sheet("a.pdf", 1, (cell,), (), "point", near=(beside,))]).values["Maximum Travel Speed"]
    assert (found.status, found.value) == ("review", pytest.approx(29.0576))
