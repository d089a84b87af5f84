"""Which doubts of the rules a language model settles that reads the same number at the same place, and which not."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
from specs_layouts import canvas, leaders, put, template, wanted

from kit.sheets.page_models import Entry, Question, at_hand
from yellowiron.endpoint import ModelOptions
from yellowiron.model.specification import Candidate, Evidence, Specification
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.extraction import read as read_pdf
from yellowiron.specs.language.quantities import Quantity
from yellowiron.specs.layout.page_cells import Cell
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.llm.agreement import Asked, agreed
from yellowiron.specs.llm.doubts import Doubted, is_answered
from yellowiron.specs.llm.page_reader import Pointed, checked
from yellowiron.specs.llm.pointing import PageText, RefusedError, place_of
from yellowiron.specs.values.claims import Claim
from yellowiron.specs.values.contention import Match
from yellowiron.specs.values.cross_check import Nearby
from yellowiron.specs.values.decision import Sheets, missing

pytestmark = pytest.mark.usefixtures("read_here")

TYPE = template(
    wanted("Arm Length", "length", "dipper length"),
    wanted("Overall Length", "length", "overall length", "maximum length"),
    wanted("Loading Height", "length", "loading height"),
    wanted("Main Winch Line Pull", "force", "winch line pull"),
)
ROWS = [
    ("Dipper", "880 mm"),
    ("Total", "9,600 mm"),
    ("Loading height folding", "6.5 m"),
    ("Winch line pull", "70 kNm"),
]


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sheets") / "doubted.pdf"
    c = canvas(path)
    put(c, 36, 800, "WORKING RANGE", size=12, bold=True)
    leaders(c, 36, 770, 300, ROWS)
    c.save()
    return path


def pointing(question: Question, name: str, label: str, value: str) -> Entry:
    cells = {c.text: c.number for c in question.cells}
    shown = next(text for text in cells if value in text)
    return {
        "name": name, "value_cell": cells[shown], "value": value, "label_cells": [cells[label]], "unit_cell": 0,
        "column_cell": 0, "footnote_cell": 0, "words": label,
    }  # fmt: skip


def said(page: Path, name: str, label: str, value: str) -> tuple[Specification, Specification]:
    """What the rules say of a value, and what becomes of it with a model that points there."""
    sheet = read_pdf(page)
    with at_hand(lambda question: [pointing(question, name, label, value)]):
        both = from_sheets(TYPE, [sheet], extractor="both", model=ModelOptions("m", "http://localhost"))
    return from_sheets(TYPE, [sheet]).values[name], both.values[name]


@pytest.mark.parametrize(
    ("name", "label", "value"),
    [
        ("Arm Length", "Dipper", "880"),  # that it is a length, only its unit says
        ("Main Winch Line Pull", "Winch line pull", "70"),  # a slip of the unit
    ],
)
def test_what_the_layout_left_open_is_settled(page: Path, name: str, label: str, value: str) -> None:
    alone, both = said(page, name, label, value)
    assert alone.status == "review" and both.status == "ok"
    assert both.value == alone.value and both.evidence == alone.evidence


@pytest.mark.parametrize(
    ("name", "label", "value"),
    [
        ("Overall Length", "Total", "9,600"),  # how much, and not of what
        ("Loading Height", "Loading height folding", "6.5"),  # a word of which nothing is known
        ("Arm Length", "Total", "880"),  # the words stand elsewhere
    ],
)
def test_what_the_page_leaves_open_is_not(page: Path, name: str, label: str, value: str) -> None:
    _, both = said(page, name, label, value)
    assert both.status != "ok"


@pytest.mark.parametrize(("text", "answered"), [("2500 mm", True), ("2500 mm stick", False)])
def test_words_behind_a_number_under_a_label_are_its_own(text: str, answered: bool) -> None:
    """It is the stick's length then, whatever reads it as the machine's."""
    asked = template(wanted("Shipping Length", "length", "shipping length")).wanted[0]
    statement = Statement(1, 1, "Shipping length", text, (36.0, 589.0, 80.0, 600.0), f"Shipping length … {text}")
    quantity = Quantity(2500.0, "mm", 12.5, "2500 mm", 0, 7)
    found = Match(asked, Claim(statement, "Shipping length", "", quantity), 1.0, "shipping length")
    value = Specification("Shipping Length", 2.5, "m", "review", reason="the layout was not understood there")
    assert is_answered(Doubted(asked, (asked,), (), Nearby(found, "above")), value) is answered


@pytest.mark.parametrize(
    ("section", "rest", "answered"),
    [
        ("", (), True),
        ("", ("gear",), True),  # of a list of three and more, or the rules bring none
        ("", ("reverse",), False),
        ("Best of its class: travel speeds that keep every cycle short", (), False),
    ],
)
def test_what_stands_over_a_speed_and_what_its_row_is_called_by(
    section: str, rest: tuple[str, ...], answered: bool
) -> None:
    """Praise over a value is of one machine of a series, whatever a second reader says."""
    asked = template(wanted("Travel Speed", "speed", "travel speed")).wanted[0]
    statement = Statement(1, 1, "Travel speed", "47 km/h", (36.0, 589.0, 80.0, 600.0), "47 km/h", section=section)
    claim = Claim(statement, "Travel speed", "", Quantity(47.0, "km/h", 0.5, "47 km/h", 0, 7))
    found = Match(asked, claim, 1.0, "travel speed", rest)
    value = Specification("Travel Speed", 47 / 3.6, "m/s", "review", reason="doubted")
    assert is_answered(Doubted(asked, (asked,), (found,), None), value) is answered


@pytest.mark.parametrize(("rest", "answered"), [((), True), (("mast",), False)])
def test_a_unit_misprinted_for_another_is_told_by_the_range_where_the_label_says_all(
    rest: tuple[str, ...], answered: bool
) -> None:
    asked = replace(template(wanted("Lift Speed", "speed", "lift speed")).wanted[0], minimum=0.05, maximum=1.5)
    statement = Statement(1, 1, "Lift speed", "530 m/s", (36.0, 589.0, 80.0, 600.0), "Lift speed … 530 m/s")
    claim = Claim(statement, "Lift speed", "", Quantity(530.0, "m/s", 0.5, "530 m/s", 0, 7))
    found = Match(asked, claim, 1.0, "lift speed", rest)
    value = Specification("Lift Speed", 0.53, "m/s", "review", reason="'530 m/s' is outside what is usual")
    assert is_answered(Doubted(asked, (asked,), (found,), None), value) is answered
    beside = replace(found, claim=replace(claim, quantity=Quantity(0.5, "m/s", 0.05, "0.5", 3, 6)))  # "2) 1955"
    assert not is_answered(Doubted(asked, (asked,), (found, beside), None), value)


@pytest.mark.parametrize(("labels", "passes"), [([1, 2], True), ([2], True), ([1], False), ([1, 4], False)])
def test_a_label_of_two_parts_on_a_row(labels: list[int], passes: bool) -> None:
    """Both are said, or the nearer one; not the farther one alone, nor what is another row's."""
    shown = [
        (36.0, 20.0, "Turning radius", "text"), (120.0, 20.0, "minimum outside", "text"),
        (210.0, 20.0, "2.05 m", "value"), (36.0, 60.0, "Ground clearance", "text"), (210.0, 60.0, "0.12 m", "value"),
    ]  # fmt: skip
    cells = tuple(
        Cell(1, int(y), words, words, (x0, y, x0 + 70.0, y + 9.0), 10.0, kind, False) for x0, y, words, kind in shown
    )
    said = {
        "value_cell": 3, "value": "2.05", "label_cells": labels, "unit_cell": 0, "column_cell": 0, "footnote_cell": 0,
        "words": "",
    }  # fmt: skip
    said["words"] = " ".join(cells[n - 1].text for n in labels)
    if not passes:
        with pytest.raises(RefusedError, match="label is not the value's own"):
            place_of(said, PageText(0, 1, cells), -1)
        return
    assert place_of(said, PageText(0, 1, cells), -1).statement.label == said["words"]


def test_words_behind_another_number_of_the_cell_are_that_ones() -> None:
    cell = Cell(1, 1, *2 * ("6° forward /12° mast tilt",), (36.0, 20.0, 160.0, 29.0), 10.0, "text", False)
    said = {
        "value_cell": 1, "value": "12", "label_cells": [1], "unit_cell": 0, "column_cell": 0, "footnote_cell": 0,
        "words": "forward",
    }  # fmt: skip
    with pytest.raises(RefusedError, match="label is not the value's own"):
        place_of(said, PageText(0, 1, (cell,)), -1)


def pointed(label: str, text: str) -> Pointed:
    """What the gates make of an entry that points to a value and the label on its left."""
    cells = tuple(
        Cell(1, 1, words, words, (x0, 20.0, x0 + 60.0, 29.0), 10.0, kind, False)
        for x0, words, kind in ((36.0, label, "text"), (200.0, text, "value"))
    )
    said = {
        "name": REACH.name, "value_cell": 2, "value": re.findall(r"[\d.,]+", text)[0], "label_cells": [1],
        "unit_cell": 0, "column_cell": 0, "footnote_cell": 0, "words": label,
    }  # fmt: skip
    return checked(REACH, said, PageText(0, 1, cells), -1, "point", (REACH,), (), "")


REACH = template(wanted("Maximum Reach", "length", "maximum reach", "length")).wanted[0]


@pytest.mark.parametrize(
    ("label", "text", "sure"),
    [
        ("Maximum reach", "12,580 mm", True),
        ("Maximum reach at", "12,580 mm", False),  # below it stands "ground level"
        ("Maximum reach", "- / 12.58 m", False),  # of one of two things only
        ("Length", "12.58 m", False),  # of whatever it may be
    ],
)
def test_a_label_that_goes_on_and_a_value_that_is_not_given(label: str, text: str, sure: bool) -> None:
    assert pointed(label, text).sure is sure


@pytest.mark.parametrize(
    ("status", "values", "heard"),
    [
        ("missing", (), True),
        ("ok", (12.58,), True),
        ("ok", (11.9,), False),
        ("conflict", (11.9, 12.58), False),
        ("review", (12.58, 11.9), False),  # the nearest words give another number than the layout
    ],
)
def test_what_the_rules_read_besides_speaks_against_a_model(
    status: str, values: tuple[float, ...], heard: bool
) -> None:
    """Also where only the model is asked for its word."""
    one = pointed("Maximum reach", "12,580 mm")
    evidence = Evidence("a.pdf", 1, "Maximum reach … 12 580 mm", (200.0, 20.0, 260.0, 29.0))
    ruled = Specification(
        REACH.name, values[0] if values and status != "conflict" else None, "m", status,  # type: ignore[arg-type]
        evidence, "12,580 mm", candidates=tuple(Candidate(v, "m", evidence) for v in values),
    )  # fmt: skip
    asked = Asked(REACH, (REACH,), (one.match,), None, Sheets(("a.pdf",), {}), "", "m", ruled)
    assert (agreed(asked, missing(REACH), [one]).status == "ok") is heard
    if status == "review":
        assert agreed(asked, ruled, [one]).status != "ok"
        alone = replace(ruled, candidates=ruled.candidates[:1])
        assert agreed(asked, alone, [one]).status == "ok"
        over = replace(one.match.claim.statement, section="The maximum reach of its class, for every job on every site")
        praised = replace(one.match, claim=replace(one.match.claim, statement=over))
        assert agreed(replace(asked, matches=(praised,)), alone, [one]).status != "ok"


@pytest.mark.parametrize(("head_at", "section"), [(210.0, ""), (500.0, "Bucket options")])
def test_the_label_of_a_row_of_heads_is_no_heading(head_at: float, section: str) -> None:
    """Bold words with a head over the row's values beside them; far to the right stands another column's heading."""

    def cell(line: int, x0: float, text: str, kind: str, *, heading: bool = False) -> Cell:
        return Cell(1, line, text, text, (x0, 20.0 * line, x0 + 60.0, 20.0 * line + 9.0), 10.0, kind, heading)

    cells = (
        cell(1, 36.0, "Bucket options", "text", heading=True),
        cell(1, head_at, "GP 1.2", "text", heading=True),
        cell(2, 36.0, "Digging depth", "text"),
        cell(2, 200.0, "6.6 m", "value"),
    )
    said = {
        "value_cell": 4, "value": "6.6", "label_cells": [3], "unit_cell": 0, "column_cell": 0, "footnote_cell": 0,
        "words": "Digging depth",
    }  # fmt: skip
    assert place_of(said, PageText(0, 1, cells), -1).statement.section == section


def test_played_models_do_not_answer_for_one_another(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("YELLOWIRON_CACHE", str(tmp_path))
    assert said(page, "Arm Length", "Total", "880")[1].status != "ok"
    assert said(page, "Arm Length", "Dipper", "880")[1].status == "ok"
