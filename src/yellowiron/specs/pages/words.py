"""A PDF page as words, rulings and filled bars. Points, origin at the page's top left, y down.

Only reading is done here; what belongs together is decided in `layout`.
"""

from __future__ import annotations

import contextlib
import ctypes
import math
import re
import statistics
import unicodedata
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from yellowiron.specs.pages.strokes import Box, DrawnRule, Place, strokes_of

_SUPERSCRIPT_UNITS = re.compile(r"(?:^|[\d\s(/\[.])(?:m|cm|mm|dm|in|ft|yd)$|[-⁻]$")
_PER, _PER_UNITS = re.compile(r"[-–−]1"), re.compile(r"(?:^|[\d\s/])min$")
_NOTES = re.compile(r"(?:\(\d{1,2}\))+")
_SIGNS = re.compile(r"[\u00b9\u00b2\u00b3\u2070-\u2079]+(?:[,)\u207e][\u00b9\u00b2\u00b3\u2070-\u2079]+)*[)\u207e]?$")
"""Raised digits that are characters of their own."""
_DRAWN = (100, 0.12)
"""Letters drawn as outlines, and their share of the page's characters, from which on they are text of it."""
TYPED, PICTURED = (5.0, 8.0, 12.0), (4.0, 9.0, 18.0)
"""Points: the type of a sheet at its median is between the first and the last, and the second in units of a page where
it is not. That of a picture is only seen, and its pixels may be its points."""
_TOUCH = 0.1
"""Of the type size; runs of characters that are no farther apart are one word, whatever stands between in the file."""
_LEADER = re.compile(r"[.·•_…]{3,}|^[.·•_…]+$|(?<=[^\W\d_])[-–—]{2,}$")


@dataclass(frozen=True)
class Word:
    """A run of characters without a gap. `size` in points, `baseline` its y; `marks` are raised footnote signs."""

    text: str
    x0: float
    x1: float
    baseline: float
    size: float
    bold: bool = False
    marks: str = ""

    @property
    def top(self) -> float:
        """About the height of a capital letter above the baseline."""
        return self.baseline - 0.75 * self.size

    @property
    def bottom(self) -> float:
        """About where descenders end."""
        return self.baseline + 0.2 * self.size

    @property
    def box(self) -> Box:
        """x0, top, x1, bottom."""
        return (self.x0, self.top, self.x1, self.bottom)


@dataclass(frozen=True)
class Page:
    """What stands on a page. `number` counts from 1; `leaders` are dotted lines from a label to its value; `unmapped`
    characters have no Unicode meaning in the file; `footnotes` are signs and what they stand for; `drawn` counts
    letters that are outlines and no characters."""

    number: int
    width: float
    height: float
    words: tuple[Word, ...] = ()
    rules: tuple[DrawnRule, ...] = ()
    bars: tuple[Box, ...] = ()
    leaders: tuple[Box, ...] = ()
    characters: int = 0
    unmapped: int = 0
    images: int = 0
    drawn: int = 0
    footnotes: dict[str, str] = field(default_factory=dict)

    @property
    def readable(self) -> bool:
        """Whether the page has a text layer that means something."""
        return self.characters >= 3 and self.unmapped < 0.3 * self.characters

    def in_units(self, unit: float) -> Page:
        """The page in units of which each is so many points."""

        def boxes(own: Sequence[Box]) -> tuple[Box, ...]:
            return tuple((a / unit, b / unit, c / unit, d / unit) for a, b, c, d in own)

        return replace(
            self,
            width=self.width / unit,
            height=self.height / unit,
            words=tuple(
                replace(w, x0=w.x0 / unit, x1=w.x1 / unit, baseline=w.baseline / unit, size=w.size / unit)
                for w in self.words
            ),
            rules=tuple(DrawnRule(*box) for box in boxes([(r.x0, r.top, r.x1, r.bottom) for r in self.rules])),
            bars=boxes(self.bars),
            leaders=boxes(self.leaders),
        )

    @property
    def partly(self) -> bool:
        """Whether part of its text is drawn as outlines: a table beside typed headings, numbers beside typed labels."""
        return self.drawn >= max(_DRAWN[0], _DRAWN[1] * self.characters)


@dataclass
class _Glyph:
    text: str
    x0: float
    x1: float
    baseline: float
    size: float
    bold: bool
    ends: bool = False
    """Whether PDFium sees a space behind it, though the file has none."""
    spaced: bool = False
    """Whether the file has a space behind it."""


def read_page(page: Any, number: int) -> Page:
    """A pypdfium2 page as words, rules and bars. Text that is not horizontal is left out, and what lies beyond the
    page's edge: a spread cut into pages leaves the other half there."""
    width, height = page.get_size()
    place = _placement(page)
    textpage = page.get_textpage()
    try:
        glyphs, characters, unmapped = _glyphs(textpage, place, (width, height))
    finally:
        textpage.close()
    words, leaders = _words(glyphs)
    rules, bars, images, drawn = strokes_of(page, place, type_unit(words, TYPED))
    return Page(
        number=number,
        width=width,
        height=height,
        words=tuple(words),
        rules=tuple(rules),
        bars=tuple(bars),
        leaders=tuple(leaders),
        characters=characters,
        unmapped=unmapped,
        images=images,
        drawn=drawn,
    )


def type_unit(words: Sequence[Word], usual: tuple[float, float, float]) -> float:
    """So many points are a unit of a page of which the type has, at its median, the usual size: what is near or thin
    on a page depends on that, and not on the paper. 1 where it is about as large as a sheet's."""
    size = statistics.median(w.size for w in words) if words else usual[1]
    return 1.0 if usual[0] <= size <= usual[2] else size / usual[1]


def _placement(page: Any) -> Place:
    """PDF user space → points from the top left of the page as shown (its crop box and rotation applied)."""
    left, bottom, right, top = page.get_bbox()
    turns = (page.get_rotation() // 90) % 4

    def place(x: float, y: float) -> tuple[float, float]:
        if turns == 1:
            return (y - bottom, x - left)
        if turns == 2:
            return (right - x, y - bottom)
        if turns == 3:
            return (top - y, right - x)
        return (x - left, top - y)

    return place


def _glyphs(textpage: Any, place: Place, size_of_page: tuple[float, float]) -> tuple[list[_Glyph], int, int]:
    import pypdfium2.raw as pdfium

    ox, oy = ctypes.c_double(), ctypes.c_double()
    rect = pdfium.FS_RECTF()
    matrix = pdfium.FS_MATRIX()
    styles: dict[int, tuple[float, bool, bool]] = {}
    found: list[_Glyph] = []
    characters = unmapped = 0
    for index in range(textpage.count_chars()):
        code = pdfium.FPDFText_GetUnicode(textpage, index)
        if code in (0x0D, 0x0A):
            continue
        if pdfium.FPDFText_IsGenerated(textpage, index) == 1:
            if code == 0x20 and found:
                found[-1].ends = True
            continue
        if code in (0x09, 0x20, 0xA0):
            found.append(_Glyph(" ", 0, 0, 0, 0, False))
            continue
        if not pdfium.FPDFText_GetLooseCharBox(textpage, index, rect):
            continue
        (xa, ya), (xb, yb) = place(rect.left, rect.bottom), place(rect.right, rect.top)
        x0, x1, middle = min(xa, xb), max(xa, xb), (ya + yb) / 2
        if not (0 <= (x0 + x1) / 2 <= size_of_page[0] and 0 <= middle <= size_of_page[1]):
            continue
        characters += 1
        if (
            code in (0, 0xFFFD, 0xFFFE)
            or 0xE000 <= code <= 0xF8FF
            or pdfium.FPDFText_HasUnicodeMapError(textpage, index) == 1
        ):
            unmapped += 1
            continue
        pdfium.FPDFText_GetCharOrigin(textpage, index, ox, oy)
        owner = pdfium.FPDFText_GetTextObject(textpage, index)
        key = ctypes.cast(owner, ctypes.c_void_p).value or 0
        if key not in styles:
            pdfium.FPDFText_GetMatrix(textpage, index, matrix)
            size = pdfium.FPDFText_GetFontSize(textpage, index) * math.hypot(matrix.c, matrix.d)
            (left, low), (right, high) = place(0, 0), place(matrix.a, matrix.b)
            styles[key] = (size, _bold(textpage, index), right - left > 5 * abs(high - low))
        size, bold, level = styles[key]
        if not level:  # text that runs up or down the page as shown
            continue
        _, baseline = place(ox.value, oy.value)
        if x1 <= x0:
            continue
        text = _SPELLED.get(code) or chr(code)
        found.append(_Glyph(text, x0, x1, baseline, size if size > 0.5 else abs(yb - ya), bold))
    return found, characters, unmapped


_CLOSING, _OPENING = {"(": ")", "[": "]"}, {")": "(", "]": "["}


def _joined(runs: list[list[_Glyph]]) -> list[list[_Glyph]]:
    """The runs, those joined of which one begins where another ends, in whatever order the file has them. PDFium takes
    what is written from its right end for Arabic and gives the mirror images of some brackets: none closes a word's
    begin or opens its end."""
    ordered = sorted(range(len(runs)), key=lambda i: runs[i][0].x0)
    begins = [runs[i][0].x0 for i in ordered]
    after: dict[int, int] = {}
    begun: set[int] = set()
    for index in ordered:
        first, last = runs[index][0], runs[index][-1]
        near = ordered[
            bisect_left(begins, last.x1 - _TOUCH * last.size) : bisect_right(begins, last.x1 + _TOUCH * last.size)
        ]
        # a space behind a run is on its other side where that is written from its right end
        touching = [
            i for i in near
            if runs[i][0].x0 > first.x0 and i not in begun and _alike(last, runs[i][0])
            and (i < index or not last.spaced)
        ]  # fmt: skip
        if touching:
            after[index] = min(touching, key=lambda i: abs(runs[i][0].x0 - last.x1))
            begun.add(after[index])
    words: list[list[_Glyph]] = []
    for index in range(len(runs)):
        if index in begun:
            continue
        word = list(runs[index])
        follows = after.get(index)
        while follows is not None:
            word += runs[follows]
            follows = after.get(follows)
        if index in after:
            word[0].text = _OPENING.get(word[0].text, word[0].text)
            word[-1].text = _CLOSING.get(word[-1].text, word[-1].text)
        words.append(word)
    return words


def _gap(last: _Glyph) -> float:
    """How far the next character of a word may be, of the type size."""
    return 0.12 if last.ends else 0.22


def _alike(one: _Glyph, other: _Glyph) -> bool:
    """Whether two characters are on one line, in one size."""
    return abs(one.baseline - other.baseline) < 0.1 * one.size and abs(one.size - other.size) < 0.2 * one.size


_SPELLED = {0x02: "-", 0xAD: "-", 0x2010: "-", 0x2011: "-"}
"""Hyphens in their several codes (pdfium gives one at a line's end as U+0002)."""


def _bold(textpage: Any, index: int) -> bool:
    import pypdfium2.raw as pdfium

    if pdfium.FPDFText_GetFontWeight(textpage, index) >= 600:
        return True
    buffer = ctypes.create_string_buffer(128)
    flags = ctypes.c_int()
    pdfium.FPDFText_GetFontInfo(textpage, index, buffer, 128, flags)
    return re.search(rb"bold|black|heavy|demi", buffer.value, re.IGNORECASE) is not None


def _words(glyphs: list[_Glyph]) -> tuple[list[Word], list[Box]]:
    """Characters that follow each other without a gap, raised ones joined to the word before them; and the leaders."""
    runs: list[list[_Glyph]] = []
    for glyph in glyphs:
        last = runs[-1][-1] if runs else None
        if glyph.text == " ":
            if last is not None:
                last.spaced = True
        elif (
            last is not None
            and not last.spaced
            and _alike(last, glyph)
            and -0.5 * last.size < glyph.x0 - last.x1 < _gap(last) * last.size
        ):
            runs[-1].append(glyph)
        else:
            runs.append([glyph])
    once = {_place(run): run for run in reversed(runs)}  # what is printed twice to look bold
    words: list[Word] = []
    leaders: list[Box] = []
    for run in _joined([*reversed(once.values())]):
        text = "".join(g.text for g in run)
        start = 0
        for match in [*_LEADER.finditer(text), None]:
            end = match.start() if match else len(run)
            if end > start:
                words.append(_word(run[start:end]))
            if match:
                leaders.append(_word(run[match.start() : match.end()]).box)
                start = match.end()
    return _with_superscripts(words), leaders


def _place(run: list[_Glyph]) -> tuple[str, int, int]:
    """What a run says, and about where."""
    grain = 0.12 * run[0].size
    return "".join(g.text for g in run), round(run[0].x0 / grain), round(run[0].baseline / grain)


def _word(run: list[_Glyph]) -> Word:
    first, text = run[0], _repaired("".join(g.text for g in run))
    signs = _SIGNS.search(text)
    host = text[: signs.start()] if signs else ""
    # "Ground clearance²" has a note, "4.2 m³" has not.
    marks = text[len(host) :] if host and not _SUPERSCRIPT_UNITS.search(host) else ""
    return Word(host if marks else text, first.x0, run[-1].x1, first.baseline, first.size, first.bold, marks)


def _repaired(text: str) -> str:
    """A word with full-width letters and digits as plain ones, and put right where its bytes were read in the wrong
    encoding: "１．５ｋＮ" → "1.5kN", "mÂ³" → "m³"."""
    if any(mark in text for mark in "ÂÃâ"):
        with contextlib.suppress(UnicodeError):
            text = text.encode("cp1252").decode("utf-8")
    return "".join(unicodedata.normalize("NFKC", c) if "\uff0e" <= c <= "\uff5a" and _is_plain(c) else c for c in text)


def _is_plain(character: str) -> bool:
    return character == "．" or character.isalnum()


def _with_superscripts(words: list[Word]) -> list[Word]:
    """Raised small characters joined to the word they follow: an exponent of a unit, or a footnote's sign."""
    small = [i for i, w in enumerate(words) if len(w.text) <= 4 or _NOTES.fullmatch(w.text)]
    hosts: dict[int, int] = {}
    rows: dict[int, list[int]] = {}
    for index, word in enumerate(words):
        rows.setdefault(int(word.baseline // 16), []).append(index)
    for own in small:
        raised = words[own]
        best: tuple[float, int] | None = None
        row = int(raised.baseline // 16)
        for index in (i for near in (row, row + 1) for i in rows.get(near, ())):
            host = words[index]
            gap = raised.x0 - host.x1
            lift = host.baseline - raised.baseline
            if (
                index != own
                and raised.size < 0.85 * host.size
                and -0.3 * host.size < gap < 0.35 * host.size
                and 0.12 * host.size < lift < 0.85 * host.size
                and (best is None or abs(gap) < best[0])
            ):
                best = (abs(gap), index)
        if best is not None:
            hosts[own] = best[1]
    joined = list(words)
    for own, index in hosts.items():
        raised, host = words[own], joined[index]
        exponent = raised.text in ("2", "3") and _SUPERSCRIPT_UNITS.search(host.text)
        if raised.text in ("o", "O") and host.text[-1].isdigit():  # a degree, as word processors raise it
            joined[index] = replace(host, text=f"{host.text}°", x1=max(host.x1, raised.x1))
        elif exponent or (_PER.fullmatch(raised.text) and _PER_UNITS.search(host.text)):
            joined[index] = replace(
                host, text=host.text + raised.text.replace("–", "-").replace("−", "-"), x1=max(host.x1, raised.x1)
            )
        else:
            joined[index] = replace(host, marks=host.marks + raised.text, x1=max(host.x1, raised.x1))
    return [w for index, w in enumerate(joined) if index not in hosts]
