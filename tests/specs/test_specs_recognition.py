"""What is made of the lines that a recognition program finds on a picture, and of two programs on one page."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pypdfium2
import pytest
from PIL import Image, ImageDraw, ImageFont
from reportlab.lib.utils import ImageReader
from specs_layouts import canvas, put, template, wanted
from test_specs_ocr import ROWS, pictured

from yellowiron.specs import extraction, ocr, reader
from yellowiron.specs.layout.router import statements_of
from yellowiron.specs.layout.statement import Statement, looks_like_value
from yellowiron.specs.ocr import with_cubes
from yellowiron.specs.pages.words import Page, Word
from yellowiron.specs.reader import PageRead, read_sheet
from yellowiron.specs.recognition.mending import levelled, with_whole_units, without_leaders
from yellowiron.specs.recognition.rapid import words_of_line
from yellowiron.specs.recognition.spelling import spelled
from yellowiron.specs.recognition.straighten import straightened

FONT = ImageFont.load_default(30)


def drawn(text: str, *, paper: int = 255, ink: int = 0) -> tuple[np.ndarray, list[tuple[str, float]]]:
    """A line as a grey picture, and its letters (without the spaces) with their middles."""
    picture = Image.new("L", (700, 60), paper)
    pen = ImageDraw.Draw(picture)
    pen.text((20, 12), text, fill=ink, font=FONT)
    ends = [20 + pen.textlength(text[:n], font=FONT) for n in range(len(text) + 1)]
    middles = [(a + b) / 2 for a, b in itertools.pairwise(ends)]
    return np.asarray(picture), [(c, x) for c, x in zip(text, middles, strict=True) if c != " "]


@pytest.mark.parametrize("colours", [(255, 0), (40, 250), (230, 120)])
@pytest.mark.parametrize("text", ["Max reach", "No. of bottom rollers", "Track Shoe Width", "11.1 kN", "13,800 kg"])
def test_words_end_where_the_ink_has_a_gap(text: str, colours: tuple[int, int]) -> None:
    picture, letters = drawn(text, paper=colours[0], ink=colours[1])
    words = words_of_line(picture, (14, 8, 690, 52), letters, 2.0)
    assert " ".join(w.text for w in words) == text
    assert all(a.x1 < b.x0 for a, b in itertools.pairwise(words))
    assert len({(w.baseline, w.size) for w in words}) == 1
    assert words[0].x0 == pytest.approx(10.0, abs=2.0) and words[0].size == pytest.approx(15.0, rel=0.15)


def test_letters_that_are_set_apart_are_of_one_word() -> None:
    """As headings in capitals are: a word ends where the gap is wider than the others."""
    picture, letters = drawn("\u200a".join("TECHNICAL DATA").replace(" ", "  "))
    letters = [(c, x) for c, x in letters if c.isalpha()]
    found = words_of_line(picture, (14, 8, 690, 52), letters, 2.0)
    assert [w.text for w in found] == ["TECHNICAL", "DATA"]


def test_the_factors_of_a_product_are_one_word() -> None:
    def texts(*seen: str) -> list[str]:
        return [w.text for w in with_whole_units([word(text) for text in seen])]

    assert texts("2752x", "1450x2205") == texts("2752", "x1450x2205") == ["2752x1450x2205"]
    assert texts("13.00x24", "16PR") == ["13.00x24", "16PR"] and texts("(m", "m)") == ["(mm)"]


@pytest.mark.slow
@pytest.mark.parametrize("points", [1.0, 8.0])
def test_a_page_whose_points_are_pixels_is_read_as_one_of_paper(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, points: float
) -> None:
    """The words of a page of A4, drawn eight times as large: rows and boxes are those of the small one."""
    c = canvas(tmp_path / "a.pdf")
    c.setPageSize((595 * points, 842 * points))
    c.rect(0, 0, 10, 10, fill=1)
    c.save()
    rows = [("Wheelbase", "3450", "mm"), ("Tread", "2140", "mm"), ("Overall height", "3100", "mm")]
    seen = [
        Word(text, points * x, points * (x + 5 * len(text)), points * (100 + 30 * n), points * 9)
        for n, row in enumerate(rows)
        for text, x in zip(row, (72, 300, 323), strict=True)
    ]
    read: list[Page] = []
    monkeypatch.setitem(ocr._WORDS, "rapidocr", lambda picture, scale: seen)
    monkeypatch.setattr(reader, "statements_of", lambda page: (read.append(page), statements_of(page))[1])
    (page,) = ocr.recognise(tmp_path / "a.pdf", [1], "rapidocr")
    assert [(s.label, s.text) for s in page.statements] == [(a, f"{b} {c}") for a, b, c in rows]
    assert {w.size for w in read[0].words} == {9.0} and read[0].width == pytest.approx(595, rel=1e-6)
    assert page.statements[1].box == pytest.approx([points * v for v in (300, 123.25, 333, 131.8)], rel=1e-6)


def test_pictures_under_a_head_that_states_nothing_are_read(tmp_path: Path) -> None:
    def silent(*typed: str) -> tuple[int, ...]:
        drawn = pypdfium2.PdfDocument(pictured(tmp_path / "drawn.pdf", ROWS))[0]
        c = canvas(tmp_path / "a.pdf")
        c.drawImage(ImageReader(drawn.render(scale=1, grayscale=True).to_pil()), 0, 0, *drawn.get_size())
        for n, text in enumerate(typed):
            put(c, 72, 40 + 12 * n, text)
        c.save()
        return read_sheet(tmp_path / "a.pdf").silent

    assert silent("www.maker.example", "All rights reserved, edition 2") == (1,)
    assert silent("www.maker.example", "Operating weight: 3500 kg") == ()


def test_a_page_askew_is_turned_and_a_level_one_is_left() -> None:
    level = Image.new("L", (1200, 1600), 255)
    for y in range(200, 1400, 60):
        ImageDraw.Draw(level).text((150, y), "Maximum digging depth  5,068 mm", fill=0, font=FONT)
    assert straightened(level) is level
    turned = np.asarray(straightened(level.rotate(0.8, Image.Resampling.BICUBIC, fillcolor=255)), float)
    rows = np.asarray(level, float).mean(axis=1)
    assert np.corrcoef(turned.mean(axis=1), rows)[0, 1] > 0.95


def word(text: str) -> Word:
    return Word(text, 0.0, 10.0, 10.0, 8.0)


@pytest.mark.parametrize(
    ("seen", "meant"),
    [
        ("ANGULODEROTACION", "ANGULO DE ROTACION"),
        ("Max.SteeringAngle:", "Max. Steering Angle:"),
        ("Breakoutforce", "Breakout force"),
        ("ength", "length"),
        ("Weiqht", "weight"),
        ("Hubzylinder", "Hubzylinder"),
        ("Tower", "Tower"),
        ("Achslasten", "Achslasten"),
        ("serviceable", "serviceable"),
        ("DISCHARGETO", "DISCHARGE TO"),
        ("Dimensions(without", "Dimensions (without"),
        ("C175-16", "C175-16"),
    ],
)
def test_words_run_together_are_cut_and_a_missed_letter_is_put_back(seen: str, meant: str) -> None:
    found = spelled([word(seen)])
    assert " ".join(w.text for w in found) == meant
    assert (found[0].x0, found[-1].x1) == (0.0, 10.0)


def test_a_row_has_one_baseline_and_its_letters_one_size() -> None:
    row = [Word("Boom length", 0, 50, 100.0, 8.0), Word("3720", 90, 110, 102.4, 7.4), Word("mm", 120, 130, 101.0, 8.6)]
    under = Word("Arm length", 0, 50, 112.0, 8.0)
    title = Word("TITLE", 0, 90, 60.0, 20.0)
    found = levelled([*row, under, title])
    assert {w.baseline for w in found if w.text != "TITLE" and w.text != "Arm length"} == {101.0}
    assert {w.size for w in found} == {8.0, 20.0}


def test_what_is_left_of_leaders_is_no_decimal_point() -> None:
    dotted = [word(t) for t in (".12.8", ".1", ".23", "0.5")]
    assert [w.text for w in without_leaders(dotted)] == ["12.8", "1", "23", "0.5"]
    assert [w.text for w in without_leaders([word(".5")])] == [".5"]


def test_a_raised_two_may_be_a_three() -> None:
    one = Statement(1, 1, "General purpose", "0.73 m²", (0, 0, 1, 1), "General purpose 0.73 m²")
    assert [s.text for s in with_cubes([one])] == ["0.73 m²", "0.73 m³"]
    assert len(with_cubes([Statement(1, 1, "Length", "4 m", (0, 0, 1, 1), "Length 4 m")])) == 1


@pytest.mark.parametrize("text", ["45 each side", "7 per side"])
def test_a_count_says_of_what(text: str) -> None:
    assert looks_like_value(text) and not looks_like_value("10 Wheelbase")


def test_another_program_says_only_what_the_first_leaves_open(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    said = {
        "rapidocr": [("Wheelbase", "3450 mm")],
        "tesseract": [("Wheelbase", "3950 mm"), ("Operating weight", "25 510 kg")],
    }

    def recognise(path: Path, numbers: tuple[int, ...], program: str) -> list[PageRead]:
        rows = [
            Statement(1, n, label, text, (300.0, 130.0, 350.0, 140.0), f"{label} {text}")
            for n, (label, text) in enumerate(said[program])
        ]
        return [PageRead(1, tuple(rows))]

    guarded = reader.run_guarded

    def run(target: str, *given: object, **options: object) -> object:
        if target.endswith("ocr:recognise"):
            return recognise(*given)  # type: ignore[arg-type]
        return guarded(target, *given, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(reader, "run_guarded", run)
    monkeypatch.setattr(ocr, "programs", lambda: ("rapidocr", "tesseract"))
    asked = template(wanted("Wheelbase", "length"), wanted("Operating Weight", "mass"), wanted("Tread", "length"))
    found = extraction.extract(asked, [pictured(tmp_path / "scan.pdf", ROWS)])
    assert [(s.status, s.value) for s in found] == [("review", 3.45), ("review", 25510.0), ("missing", None)]
    assert "rapidocr" in found.values["Wheelbase"].reason and "tesseract" in found.values["Operating Weight"].reason
    (finding,) = found.findings
    assert finding.code == "SPC005" and "rapidocr, then tesseract" in finding.message
