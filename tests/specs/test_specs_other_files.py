"""The same page in another file: larger or smaller, its text in another order, its letters apart, a little askew."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from specs_layouts import HEIGHT, WIDTH, canvas, lattice, put, template, wanted

from yellowiron.model.specification import Specifications
from yellowiron.specs import extract
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.pages.words import Page, Word, _Glyph, _joined, _words
from yellowiron.specs.reader import proven

ASKED = template(
    wanted("Maximum Reach", "length"),
    wanted("Maximum Digging Depth", "length"),
    wanted("Operating Weight", "mass"),
    wanted("Net Power", "power"),
    wanted("Counterweight", "mass"),
)
RULED = [("Maximum Reach", "9,860 mm"), ("Maximum Digging Depth", "6,725 mm")]
PLAIN = [("Operating Weight", "22,500 kg"), ("Net Power", "123 kW"), ("Counterweight", "4,400 kg")]


def sheet(path: Path, scale: float) -> Specifications:
    """What is said by a page with a small ruled table over rows of words, printed in another size."""
    c = canvas(path)
    c.setPageSize((scale * WIDTH, scale * HEIGHT))
    c.scale(scale, scale)
    lattice(c, 40, 700, (140, 60), [("Working range", "Standard"), *RULED], pitch=12)
    for index, (label, value) in enumerate(PLAIN):
        put(c, 40, 600 - 14 * index, label)
        put(c, 180, 600 - 14 * index, value)
    c.save()
    return extract(ASKED, [path])


@pytest.mark.parametrize("scale", [0.3, 0.6, 1.7, 4.0])
def test_a_page_says_the_same_in_any_size_and_shows_where(tmp_path: Path, scale: float) -> None:
    plain, sized = (sheet(tmp_path / f"{by}.pdf", by) for by in (1.0, scale))
    assert [s.status for s in plain] == ["ok"] * len(ASKED.wanted)
    assert [(s.status, s.value) for s in sized] == [(s.status, s.value) for s in plain]
    for one, other in zip(plain, sized, strict=True):
        assert one.evidence and other.evidence and one.evidence.box and other.evidence.box
        assert other.evidence.box == pytest.approx([scale * v for v in one.evidence.box], abs=0.2)


def glyphs(text: str, x: float, y: float) -> list[_Glyph]:
    return [_Glyph(c, x + 4 * i, x + 4 * i + 4, y, 7.0, False) for i, c in enumerate(text)]


@pytest.mark.parametrize("seed", range(5))
def test_letters_in_any_order_are_the_words_that_they_print(seed: int) -> None:
    lines = [glyphs("Wheelbase", 40, 100), glyphs("3450", 90, 100), glyphs("Tread", 40, 110), glyphs("2140", 90, 110)]
    runs = [[glyph] for line in lines for glyph in line]
    random.Random(seed).shuffle(runs)
    words, _ = _words([glyph for run in runs for glyph in run])
    assert sorted((w.text, w.x0, w.x1) for w in words) == [
        ("2140", 90, 106), ("3450", 90, 106), ("Tread", 40, 60), ("Wheelbase", 40, 76),
    ]  # fmt: skip


def test_a_space_that_the_file_has_parts_what_touches_but_not_what_is_written_from_its_right_end() -> None:
    first, second = glyphs("12", 40, 100), glyphs("500", 48, 100)
    assert len(_joined([first, second])) == len(_joined([second, first])) == 1
    first[-1].spaced = True
    assert len(_joined([first, second])) == 2 and len(_joined([second, first])) == 1


def page(*rows: tuple[str, float, float]) -> Page:
    return Page(1, 400, 400, tuple(Word(text, x, x + 4 * len(text), y, 7.0) for text, x, y in rows))


def is_proven(quote: str, on: Page) -> bool:
    return proven([Statement(1, 0, "", "", (0, 0, 1, 1), quote)], on)[0].proven


def test_words_stand_together_by_their_place_on_the_page() -> None:
    on = page(
        ("9.2 m", 120, 100), ("Reach", 40, 109), ("Depth", 200, 100), ("Maximum", 40, 100), ("of the arm", 40, 118)
    )
    assert is_proven("Maximum Reach of the arm … 9.2 m", on) and is_proven("Maximum 9.2 m", on)
    assert not is_proven("Reach Depth", on) and not is_proven("Maximum of the arm", on)


def test_a_line_whose_words_waver_stands_together_beside_a_column_that_is_half_a_line_lower() -> None:
    on = page(("Wheelbase", 40, 100.0), ("beside", 200, 101.4), ("3450", 90, 102.0), ("mm", 110, 100.2))
    assert is_proven("Wheelbase 3450 mm", on)
