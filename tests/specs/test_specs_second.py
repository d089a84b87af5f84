"""What is read a second time: values that only the words nearest to them name, and doubts about those of the rules."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from specs_layouts import canvas, put, template, wanted

from yellowiron.model.specification import Specifications
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.layout.nearest import Near, nearest_of
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.pages.words import Page, Word
from yellowiron.specs.reader import Sheet, read_sheet

_NAMES = ("Overall Length", "Wheelbase", "Overall Width")


def word(text: str, x: float, y: float, size: float = 8.0) -> Word:
    return Word(text, x, x + 0.5 * size * len(text), y, size)


def said(label: str, text: str, unit: str, *, row: int = 1, top: float = 100.0) -> Statement:
    return Statement(page=1, row=row, label=label, text=text, box=(200, top, 240, top + 8), quote=label, unit=unit)


def asked(sheet: Sheet, config: str = "") -> Specifications:
    return from_sheets(template(*(wanted(name, "length") for name in _NAMES)), [sheet], config=config)


def sheet(statements: tuple[Statement, ...], near: tuple[Statement, ...]) -> Sheet:
    return Sheet("a.pdf", 1, statements, (), "point", near=tuple(Near("left", s) for s in near))


def test_words_beside_over_and_under_a_value_are_told_apart() -> None:
    words = (
        word("Wheelbase", 40, 100), word("3,300", 200, 100), word("mm", 230, 100),
        word("Length", 40, 300), word("8,120", 40, 309),
        word("2,680", 40, 500), word("Width", 40, 509),
        word("B", 180, 700), word("3,350", 200, 700), word("7", 40, 720),
    )  # fmt: skip
    found = {
        (n.side, n.statement.label, n.statement.text, n.statement.unit) for n in nearest_of(Page(1, 600, 800, words))
    }
    assert found == {
        ("left", "Wheelbase", "3,300", "mm"),
        ("above", "Length", "8,120", ""),
        ("below", "Width", "2,680", ""),
        ("under", "Width", "2,680", ""),
    }, "a drawing's key names nothing, and one digit alone is no value"


def test_a_name_in_the_middle_under_another_number_is_doubted() -> None:
    by_rules = said("Wheelbase", "6,194", "mm")
    near = (Near("left", by_rules), Near("under", said("Wheelbase", "3,264", "mm", top=90)))
    doubted = asked(Sheet("a.pdf", 1, (by_rules,), (), "point", near=near)).values["Wheelbase"]
    assert doubted.status == "review" and "3,264" in doubted.reason
    over = Near("above", by_rules)  # a card: the label is over its own value, too
    assert asked(Sheet("a.pdf", 1, (by_rules,), (), "point", near=(*near, over))).values["Wheelbase"].status == "ok"


def test_what_the_rules_miss_comes_to_review_with_its_page_and_quote() -> None:
    found = asked(sheet((said("Wheelbase", "3,300", "mm"),), (said("Overall length", "8,120", "mm", top=200),)))
    length, base = found.values["Overall Length"], found.values["Wheelbase"]
    assert (base.status, base.value) == ("ok", pytest.approx(3.3))
    assert (length.status, length.value) == ("review", pytest.approx(8.12)) and length.confidence < 0.5
    assert length.evidence is not None and length.evidence.page == 1 and "nearest" in length.reason
    assert found.number("Overall Length") is None, "nothing relies on it"


def test_a_bare_number_has_the_only_unit_in_which_it_is_usual() -> None:
    asked_for = template(replace(wanted("Overall Length", "length"), minimum=2.0, maximum=15.0))
    for text, value in (("8,120", 8.12), ("8.12", 8.12)):
        found = from_sheets(asked_for, [sheet((), (said("Overall length", text, ""),))]).values["Overall Length"]
        assert (found.status, found.value) == ("review", pytest.approx(value))
    assert (
        from_sheets(asked_for, [sheet((), (said("Overall length", "81", ""),))]).values["Overall Length"].value is None
    )


def test_a_value_has_one_name_and_a_label_one_value() -> None:
    found = asked(sheet((said("Wheelbase", "3,300", "mm"),), (said("Overall length", "3,300", "mm"),)))
    assert found.values["Overall Length"].status == "missing", "it is the wheelbase already"
    two = (said("Overall length", "8,120", "mm", top=200), said("Overall length", "7,900", "mm", row=2, top=300))
    assert asked(sheet((), two)).values["Overall Length"].status == "missing", "which of the two is not said"


def test_a_label_that_stands_beside_another_value_too_makes_its_own_one_to_review() -> None:
    own = said("Wheelbase", "3,300", "mm")
    agrees = asked(sheet((own,), (said("Wheelbase", "3,300 mm", ""),))).values["Wheelbase"]
    assert agrees.status == "ok"
    differs = asked(sheet((own,), (said("Wheelbase", "3,030 mm", "", top=300),))).values["Wheelbase"]
    assert (differs.status, differs.value) == ("review", pytest.approx(3.3))
    assert [c.value for c in differs.candidates] == [pytest.approx(3.3), pytest.approx(3.03)]


def test_another_machines_column_is_not_read_a_second_time() -> None:
    first = replace(said("Wheelbase", "3,300", "mm"), column=("MW 110",))
    second = replace(said("Wheelbase", "3,500", "mm", top=100), column=("MW 120",), box=(300, 100, 340, 108))
    only = replace(said("Overall width", "2,680", "mm", row=2, top=120), column=("MW 110",))
    near = (said("Overall width", "2,680", "mm", row=2, top=120),)
    found = asked(sheet((first, second, only), near), config="MW 120")
    assert (found.values["Wheelbase"].status, found.values["Wheelbase"].value) == ("ok", pytest.approx(3.5))
    assert found.values["Overall Width"].status == "missing"


def test_words_that_do_not_stand_together_on_the_page_are_for_review(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 40, 700, "Wheelbase")
    put(c, 200, 700, "3,300 mm")
    c.save()
    read = read_sheet(tmp_path / "a.pdf")
    assert [s.proven for s in read.statements] == [True]
    assert asked(read).values["Wheelbase"].status == "ok"
    false = replace(read, statements=tuple(replace(s, proven=False) for s in read.statements))
    assert asked(false).values["Wheelbase"].status == "review"


def test_a_configuration_chooses_the_value_under_its_name() -> None:
    values = (said("Wheelbase", "3,300", "mm"), said("Wheelbase", "3,500", "mm", row=1))
    near = tuple(
        Near("left", s, over=("Dimensions", head)) for s, head in zip(values, ("MW 110", "MW 120"), strict=True)
    )
    misread = Sheet("a.pdf", 1, values, (), "point", near=near)
    assert asked(misread).values["Wheelbase"].status == "conflict"
    chosen = asked(misread, config="MW 120").values["Wheelbase"]
    assert (chosen.status, chosen.value) == ("review", pytest.approx(3.5)), "the layout gave the columns no heads"
    assert asked(misread, config="MW 130").values["Wheelbase"].status == "conflict"
    once = replace(misread, near=near[:1])
    assert asked(once, config="MW 120").values["Wheelbase"].status == "conflict", (
        "what one reading sees once settles none"
    )
    words = (word("MW", 200, 80), word("120", 211, 80), word("Wheelbase", 40, 100), word("3,500", 200, 100))
    (only,) = (n for n in nearest_of(Page(1, 600, 800, words)) if n.side == "left")
    assert only.over == ("MW 120",)
