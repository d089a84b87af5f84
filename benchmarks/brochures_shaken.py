"""The same brochure in another file: what a stranger's program may have done to a PDF without another sheet of it.

    with shaken(pdf, "small", folder) as path:
        sheet = read_sheet(path)

Of the *file*, through PDFium, so that the program's own reader meets it: "small" and "large" (the page 0.6 and 1.7
times as large), "moved" (its boxes begin far from the origin), "rotated" (drawn on its side, and shown turned back),
"spread" (two pages that follow each other on one sheet). Of the *text layer* as PDFium would give it: "shuffled" (words
in any order), "split" (runs of one to three letters in any order), "spaceless" (no spaces, only gaps), "jittered"
(every word a little out of its place). Of the *drawing*: "unruled" (no rules), "unfilled" (no fills), "zebra" (every
other row on a fill, where no wall is near). Of the *typography*: "digits" (full-width ones), "dashes" (a minus sign, an
en dash), "grouped" (thin spaces between thousands), "ligatures", "capitals" (words of four letters and more).

A reading that does not stand such a change was right by luck. All are seeded; text recognition is left out.
"""

from __future__ import annotations

import ctypes
import itertools
import random
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest import mock

import pypdfium2
import pypdfium2.raw as pdfium

from yellowiron.specs import reader
from yellowiron.specs.layout.rows.lines import blocks_of, lines_of
from yellowiron.specs.layout.statement import kind_of
from yellowiron.specs.pages import words
from yellowiron.specs.pages.strokes import DrawnRule
from yellowiron.specs.pages.words import Page

SMALL, LARGE = 0.6, 1.7
AWAY = (-137.0, 411.0)
"""Points, of the lower left corner."""
JITTER = 0.3
"""Points."""
WALLED = 12.0
"""Points about a line in which no wall stands."""
Run = list[Any]
"""Characters that the reader has as `_Glyph`, a space behind them with them."""


@contextmanager
def shaken(pdf: Path, how: str, folder: Path) -> Iterator[Path]:
    """A PDF's path after one of `SHAKES`; as long as it is open `read_sheet` meets that change."""
    path = folder / pdf.name
    document = pypdfium2.PdfDocument(pdf)
    for page in document:  # a dealer's crop box may hide half of the maker's table
        page.set_cropbox(*page.get_mediabox())
    document = FILES.get(how, lambda kept: kept)(document)
    document.save(path)
    document.close()
    with ExitStack() as stack:
        seed = random.Random(pdf.stem)
        if how in TEXTS:
            stack.enter_context(mock.patch.object(reader, "read_page", _with_text(TEXTS[how], seed)))
        if how in DRAWINGS:
            stack.enter_context(mock.patch.object(reader, "read_page", _drawn(DRAWINGS[how])))
        yield path


def _sized(scale: float) -> Callable[[pypdfium2.PdfDocument], pypdfium2.PdfDocument]:
    return lambda document: _transformed(document, lambda box: (scale, 0, 0, scale, 0, 0))


def _moved(document: pypdfium2.PdfDocument) -> pypdfium2.PdfDocument:
    return _transformed(document, lambda box: (1, 0, 0, 1, *AWAY))


def _rotated(document: pypdfium2.PdfDocument) -> pypdfium2.PdfDocument:
    turned = _transformed(document, lambda box: (0, 1, -1, 0, box[3] + box[1], 0))
    for page in turned:
        page.set_rotation((page.get_rotation() + 90) % 360)
    return turned


Matrix = tuple[float, float, float, float, float, float]


def _transformed(
    document: pypdfium2.PdfDocument, matrix_of: Callable[[Sequence[float]], Matrix]
) -> pypdfium2.PdfDocument:
    """The document with the content of each page, and its boxes, transformed by a matrix that depends on these."""
    for page in document:
        box = page.get_mediabox()
        a, b, c, d, e, f = matrix_of(box)
        matrix = pdfium.FS_MATRIX(a, b, c, d, e, f)
        everywhere = pdfium.FS_RECTF(-1e5, 1e5, 1e5, -1e5)
        pdfium.FPDFPage_TransFormWithClip(page, ctypes.byref(matrix), ctypes.byref(everywhere))
        xs, ys = zip(*((a * x + c * y + e, b * x + d * y + f) for x in box[::2] for y in box[1::2]), strict=True)
        for put in (page.set_mediabox, page.set_cropbox):
            put(min(xs), min(ys), max(xs), max(ys))
    return document


def _spread(document: pypdfium2.PdfDocument) -> pypdfium2.PdfDocument:
    """Page 1 by itself, as a cover, then two and two; nothing where the pages are not alike in size."""
    if len({tuple(round(side) for side in page.get_size()) for page in document}) > 1:
        return document
    made = pypdfium2.PdfDocument.new()
    made.import_pages(document, [0])
    width, height = document[0].get_size()
    rest = pypdfium2.PdfDocument.new()
    rest.import_pages(document, list(range(1, len(document))))
    if len(rest) < 2:
        return document
    made.import_pages(pypdfium2.PdfDocument(pdfium.FPDF_ImportNPagesToOne(rest, 2 * width, height, 2, 1)))
    return made


FILES: dict[str, Callable[[pypdfium2.PdfDocument], pypdfium2.PdfDocument]] = {
    "small": _sized(SMALL), "large": _sized(LARGE), "moved": _moved, "rotated": _rotated, "spread": _spread,
}  # fmt: skip


def _with_text(
    change: Callable[[list[Run], random.Random], list[Run]], seed: random.Random
) -> Callable[[Any, int], Page]:
    """The reader of a page whose characters a change has met; its text in the order of them."""
    taken, read = words._glyphs, words.read_page

    def changed_page(page: Any, number: int) -> Page:

        def glyphs(*args: Any) -> Any:
            found, *counts = taken(*args)
            runs = change(_runs(found), seed)
            return list(itertools.chain.from_iterable(runs)), *counts

        with mock.patch.object(words, "_glyphs", glyphs):
            made = read(page, number)
        return made

    return changed_page


def _runs(glyphs: Run) -> list[Run]:
    """The characters of each word, as they follow each other in the file, with the spaces behind it."""
    runs: list[Run] = []
    for glyph in glyphs:
        last = runs[-1][-1] if runs else None
        if last is not None and (glyph.text == " " or (last.text != " " and _follows(last, glyph))):
            runs[-1].append(glyph)
        elif glyph.text != " ":
            runs.append([glyph])
    return runs


def _follows(last: Any, glyph: Any) -> bool:
    gap = (glyph.x0 - last.x1) / last.size
    return abs(last.baseline - glyph.baseline) < 0.1 * last.size and -0.5 < gap < (0.12 if last.ends else 0.22)


def _shuffled(runs: list[Run], seed: random.Random) -> list[Run]:
    seed.shuffle(runs)
    return runs


def _split(runs: list[Run], seed: random.Random) -> list[Run]:
    pieces = []
    for run in runs:
        while run:
            size = seed.randint(1, 3)
            piece, run = run[:size], run[size:]
            if run and all(g.text == " " for g in run):
                piece, run = piece + run, []
            pieces.append(piece)
    return _shuffled(pieces, seed)


def _spaceless(runs: list[Run], seed: random.Random) -> list[Run]:
    """As PDFium gives text without spaces: it sees one where a gap is wide."""
    for run, following in itertools.zip_longest(runs, runs[1:]):
        spaced = run[-1].text == " "
        run[:] = [g for g in run if g.text != " "]
        gap = following[0].x0 - run[-1].x1 if following else 0.0
        run[-1].ends = run[-1].ends or (spaced and gap > 0.15 * run[-1].size)
    return runs


def _jittered(runs: list[Run], seed: random.Random) -> list[Run]:
    for run in runs:
        x, y = seed.uniform(-JITTER, JITTER), seed.uniform(-JITTER, JITTER)
        for glyph in run:
            glyph.x0, glyph.x1, glyph.baseline = glyph.x0 + x, glyph.x1 + x, glyph.baseline + y
    return runs


def _set(spell: Callable[[str], str]) -> Callable[[list[Run], random.Random], list[Run]]:
    """The words in another typography, letter for letter."""

    def change(runs: list[Run], seed: random.Random) -> list[Run]:
        for run in runs:
            text = "".join(g.text for g in run)
            spelled = spell(text)
            if len(spelled) == len(text) == len(run):
                for glyph, letter in zip(run, spelled, strict=True):
                    glyph.text = letter
        return runs

    return change


def _ligatures(runs: list[Run], seed: random.Random) -> list[Run]:
    for run in runs:
        for place in range(len(run) - 2, -1, -1):
            sign = {"ff": "ﬀ", "fi": "ﬁ", "fl": "ﬂ"}.get(run[place].text + run[place + 1].text)
            if sign:
                run[place].text, run[place].x1, run[place].ends = sign, run[place + 1].x1, run[place + 1].ends
                del run[place + 1]
    return runs


_THOUSANDS = re.compile(r"(?<![\d.,])\d{1,3}(?:,\d{3})+(?![\d,])")
_FULL = str.maketrans("0123456789", "０１２３４５６７８９")


def _in_capitals(text: str) -> str:
    """A word of a label in capitals; units and numbers stay."""
    return (
        text.upper() if re.fullmatch(r"[(]?[^\W\d_]{4,}[-).,:\s]*", text) and len(text.upper()) == len(text) else text
    )


TEXTS: dict[str, Callable[[list[Run], random.Random], list[Run]]] = {
    "shuffled": _shuffled,
    "split": _split,
    "spaceless": _spaceless,
    "jittered": _jittered,
    "digits": _set(lambda text: text.translate(_FULL)),
    "dashes": _set(lambda text: text.translate({0x2D: "\u2212" if text[:1] == "-" else "\u2013"})),
    "grouped": _set(lambda text: _THOUSANDS.sub(lambda number: number.group().replace(",", "\u2009"), text)),
    "ligatures": _ligatures,
    "capitals": _set(_in_capitals),
}


def _drawn(change: Callable[[Page], Page]) -> Callable[[Any, int], Page]:
    read = words.read_page
    return lambda page, number: change(read(page, number))


def _zebra(page: Page) -> Page:
    """Fills behind every other one of rows that follow each other, each a line of a label and its values, where no wall
    is near."""
    walls = [r for r in page.rules if not r.horizontal]
    bars = []
    for block in blocks_of(lines_of(page.words, walls), page.bars):
        count = 0
        for line in block.lines:
            count = count + 1 if {"text", "value"} <= {kind_of(p) for p in line.pieces} else 0
            bar = (block.x0 - 2, line.top - 1, block.x1 + 2, line.bottom + 1)
            if count and not count % 2 and not any(_is_near(wall, bar) for wall in walls):
                bars.append(bar)
    return replace(page, bars=(*page.bars, *bars))


def _is_near(wall: DrawnRule, bar: tuple[float, float, float, float]) -> bool:
    return bar[0] - WALLED < wall.x0 < bar[2] + WALLED and wall.top - WALLED < bar[3] and bar[1] < wall.bottom + WALLED


DRAWINGS: dict[str, Callable[[Page], Page]] = {
    "unruled": lambda page: replace(page, rules=()),
    "unfilled": lambda page: replace(page, bars=()),
    "zebra": _zebra,
}
SHAKES = ("printed", *FILES, *TEXTS, *DRAWINGS)
"""By name; "printed" changes nothing."""
