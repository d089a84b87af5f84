"""Pages whose text is drawn as outlines in part, and what makers' pages of that kind print beside it."""

from __future__ import annotations

from pathlib import Path

import pypdfium2
import pytest
from specs_layouts import canvas, put, template, wanted

from yellowiron.specs import ocr
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.findings import unread_pages
from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.vocabulary import tokens
from yellowiron.specs.layout.statement import Statement, without_key
from yellowiron.specs.pages.words import Word, read_page
from yellowiron.specs.reader import Sheet, read_sheet
from yellowiron.specs.recognition.mending import with_whole_units


def drawn(path: Path, words: int, *, letters: int = 5, typed: int = 1) -> Path:
    """A page with typed lines, and words of letters that are small round fills."""
    c = canvas(path)
    for line in range(typed):
        put(c, 60, 760 - 12 * line, "Wheelbase and all the rest of what a page of running text says of a machine")
    for word in range(words):
        for letter in range(letters):
            c.circle(63 + 40 * (word % 10) + 5 * letter, 600 - 12 * (word // 10), 2.0, stroke=0, fill=1)
    c.save()
    return path


@pytest.mark.parametrize(
    ("words", "letters", "typed", "partly"),
    [(40, 5, 1, True), (40, 2, 1, False), (10, 5, 1, False), (40, 5, 40, False), (0, 5, 1, False)],
)
def test_letters_that_are_fills_are_text_of_the_page(
    tmp_path: Path, words: int, letters: int, typed: int, partly: bool
) -> None:
    path = drawn(tmp_path / "a.pdf", words, letters=letters, typed=typed)
    page = read_page(pypdfium2.PdfDocument(path)[0], 1)
    assert page.readable and page.partly is partly
    assert read_sheet(path).silent == ((1,) if partly else ())


def at(x: float, text: str, y: float = 100.0) -> Word:
    return Word(text, x, x + 4.0 * len(text), y, 8.0)


def test_what_is_typed_stands_and_what_is_drawn_is_read_beside_it() -> None:
    typed = [at(10, "Ground"), at(40, "clearance")]
    seen = [at(11, "Groumd"), at(39, "clearamce", 101.0), at(120, "385"), at(10, "Wheelbase", 112.0)]
    assert [w.text for w in ocr._beside(typed, seen)] == ["385", "Wheelbase"]


def said(label: str, text: str, y: float, *, guessed: bool) -> Statement:
    return Statement(1, int(y), label, text, (10.0, y, 90.0, y + 8), f"{label} {text}", guessed=guessed)


def test_of_such_a_page_only_what_was_recognised_is_for_review() -> None:
    asked = template(wanted("Wheelbase", "length"), wanted("Tread", "length"))
    statements = (said("Wheelbase", "3450 mm", 10, guessed=False), said("Tread", "2300 mm", 30, guessed=True))
    sheet = Sheet("a.pdf", 1, statements, (), "point", recognised=(1,), recogniser="rapidocr")
    found = {s.name: (s.status, s.value) for s in from_sheets(asked, [sheet])}
    assert found == {"Wheelbase": ("ok", pytest.approx(3.45)), "Tread": ("review", pytest.approx(2.3))}
    assert [f.code for f in unread_pages([sheet])] == ["SPC005"]


def test_a_unit_set_with_wide_gaps_is_one() -> None:
    spaced = [at(10, "Dimensions"), at(60, "(m"), at(72, "m)"), at(100, "(at"), at(115, "45°)")]
    assert [w.text for w in with_whole_units(spaced)] == ["Dimensions", "(mm)", "(at", "45°)"]


@pytest.mark.parametrize(
    ("text", "unit"),
    [("40 Km/h", "Km/h"), ("40 KM/H", "KM/H"), ("94 FT.", "FT."), ("1850 LBS.", "LBS."), ("35 Mpa", "Mpa"),
     ("2 IN LINE", "")],
)  # fmt: skip
def test_units_in_other_cases(text: str, unit: str) -> None:
    assert read(text)[0].numbers[0].unit == unit


def test_numbers_of_a_list_share_the_unit_of_the_last() -> None:
    units = [[q.unit for r in read(text) for q in r.numbers] for text in ("4.5/2.9km/h", "120/2000 rpm")]
    assert units == [["km/h", "km/h"], ["", "rpm"]]


def test_of_two_speeds_in_a_row_of_one_none_is_taken(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "Travel Speed")
    put(c, 160, 700, "4.5/2.9km/h")
    c.save()
    (found,) = from_sheets(template(wanted("Travel Speed", "speed")), [read_sheet(tmp_path / "a.pdf")])
    assert found.status == "conflict" and {round(c.value or 0.0, 3) for c in found.candidates} == {1.25, 0.806}


@pytest.mark.parametrize(
    ("label", "plain"),
    [
        ("f. Minimum swing radius", "Minimum swing radius"),
        ("α3 Roll back angle", "Roll back angle"),
        ("h1 Lift height", "Lift height"),
        ("a maximum of", "a maximum of"),
    ],
)
def test_keys_in_small_and_greek_letters(label: str, plain: str) -> None:
    assert without_key(label) == plain


def test_words_for_rollers_of_makers_who_translate() -> None:
    assert tokens("Thrust wheel") == tokens("Track roller")
    assert tokens("Carrier wheel") == tokens("Carrier roller")
    assert tokens("Total cycling time") == tokens("Total cycle time")


LENGTHS = ("Overall Length", "Overall Width", "Boom Length")


def lengths(path: Path) -> dict[str, tuple[str, float | None]]:
    asked = template(*(wanted(name, "length") for name in LENGTHS), wanted("Slewing Speed", "angular_speed"))
    found = from_sheets(asked, [read_sheet(path)])
    return {s.name: (s.status, None if s.value is None else round(s.value, 4)) for s in found if s.status != "missing"}


def test_a_tables_head_gives_its_unit_after_a_colon(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 300, 700, "Overall dimensions: mm", bold=True)
    put(c, 450, 700, "EX 36", bold=True)
    for row, (label, value) in enumerate((("Overall length", "11530"), ("Overall width", "3190"))):
        put(c, 300, 684 - 14 * row, label)
        put(c, 455, 684 - 14 * row, value)
    put(c, 60, 600, "A machine for quarries")
    c.save()
    assert lengths(tmp_path / "a.pdf") == {"Overall Length": ("ok", 11.53), "Overall Width": ("ok", 3.19)}


def test_dashes_behind_a_label_lead_to_its_value(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "Boom length--")
    put(c, 160, 700, "6500 mm")
    c.save()
    assert lengths(tmp_path / "a.pdf") == {"Boom Length": ("ok", 6.5)}


def test_rows_without_walls_under_rows_with_them(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    stops = (60, 200, 330, 460)
    rows = [("Hoist", "Line speed", "Line pull"), ("Main", "185 m/min", "125 kN"), ("Auxiliary", "180 m/min", "60 kN")]
    for row, cells in enumerate(rows):
        for x, text in zip(stops, cells, strict=False):
            put(c, x + 4, 686 - 20 * row, text)
    for row, (label, value) in enumerate((("Slewing speed", "1.5 rpm"), ("Boom length", "16 m"))):
        put(c, 64, 626 - 20 * row, label)
        put(c, 420, 626 - 20 * row, value)
    for line in range(6):
        c.line(60, 700 - 20 * line, 460, 700 - 20 * line)
    for x in stops:
        c.line(x, 700, x, 600 if x in (60, 460) else 640)
    c.save()
    assert lengths(tmp_path / "a.pdf") == {"Slewing Speed": ("ok", 0.1571), "Boom Length": ("ok", 16.0)}
