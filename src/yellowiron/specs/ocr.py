"""Pages without a text layer, read through the recognition programs that are installed, the best one first.

What it reads is a guess: a digit may be another. Values from such pages are never more than `review`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from yellowiron.model.errors import SheetError
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.pages.picture_rules import rules_of_picture
from yellowiron.specs.pages.strokes import SNAP, DrawnRule
from yellowiron.specs.pages.words import PICTURED, Page, Word, read_page, type_unit
from yellowiron.specs.reader import PageRead, opened_pages, read_words
from yellowiron.specs.recognition import rapid, tesseract
from yellowiron.specs.recognition.mending import levelled
from yellowiron.specs.recognition.spelling import spelled
from yellowiron.specs.recognition.straighten import straightened

MOST_PAGES = 40
"""Pages of one file that are recognised, the first ones: each takes seconds."""
RESIDENT_MB = 2048
"""Of memory in use; a large page through rapidocr takes half of it."""
_RESOLUTION = {"rapidocr": 200.0, "tesseract": 300.0}
"""Pixels an inch, as each likes it."""
_MOST_PIXELS = 16_000_000
_SHORTEST = 15.0
"""Points; shorter strokes are parts of letters that are drawn, or of a machine."""
_OVER = 0.3
"""Share of a word's width and size by which it lies over another from which on the two are one."""
_NEAR = 60.0
"""Points within which words stand by a table's rule."""
_FEWEST = 4
"""Rules and fills; a file with fewer has its tables in its pictures."""

_SQUARE = re.compile(r"(?<=\d )m[AÂ]?[²2](?!\w)|(?<=\d)m[AÂ]?²")
"""A square metre, or what a cubic one looks like."""


def programs() -> tuple[str, ...]:
    """The recognition programs that are installed, the best one first."""
    there = {"rapidocr": rapid.installed(), "tesseract": tesseract.program() is not None}
    return tuple(name for name, installed in there.items() if installed)


def picture_programs() -> tuple[str, ...]:
    """The programs and what they know, of which it depends what is recognised."""
    languages = sorted(tesseract.languages()) if tesseract.program() is not None else []
    return (*programs(), tesseract.program() or "", *languages)


def recognise(path: Path, numbers: Sequence[int], program: str) -> list[PageRead]:
    """What pages say (`numbers` count from 1) whose text is pictures or outlines, all or in part, through one of the
    `programs`; a page on which nothing is recognised is left out. Runs in a guarded child. `SheetError` where the
    program fails."""
    found: list[PageRead] = []
    failure: SheetError | None = None
    for number, opened in opened_pages(path, numbers[:MOST_PAGES], "Recognising the text of"):
        try:
            page = _page(opened, number, program)
        except SheetError as error:  # a page that takes too long costs no other
            failure = error
            continue
        if page.readable:
            one = read_words(page, type_unit(page.words, PICTURED))
            found.append(replace(one, statements=tuple(with_cubes(one.statements))))
    if failure is not None and not found:
        raise failure
    return found


def with_cubes(statements: Sequence[Statement]) -> list[Statement]:
    """The statements, and each with a raised 2 again with a 3: the two are hardly told apart, and no name asks for
    an area where another asks for a volume."""
    again = [replace(s, text=_SQUARE.sub("m³", s.text)) for s in statements if _SQUARE.search(s.text)]
    return [*statements, *again]


def _page(page: object, number: int, program: str) -> Page:
    """A page as it looks, its words read from its picture but for those that the file has as text, its rules and fills
    from the file or else from the picture."""
    drawn = read_page(page, number)
    width, height = drawn.width, drawn.height
    scale = min(_RESOLUTION[program] / 72.0, (_MOST_PIXELS / max(width * height, 1.0)) ** 0.5)
    picture = page.render(scale=scale, grayscale=True).to_pil()  # type: ignore[attr-defined]
    rules = [r for r in drawn.rules if (r.x1 - r.x0 if r.horizontal else r.bottom - r.top) >= _SHORTEST]
    bars = [b for b in drawn.bars if b[2] - b[0] >= _SHORTEST]
    typed = drawn.words if drawn.readable else ()
    pictured = len(rules) + len(bars) < _FEWEST and (not typed or not drawn.partly)
    picture = straightened(picture) if pictured else picture
    words = (*typed, *_beside(typed, spelled(levelled(_WORDS[program](picture, scale)))))
    characters = sum(len(w.text) for w in words)
    made = Page(number, width, height, words, tuple(rules), tuple(bars), characters=characters, images=1)
    if not pictured:
        return made
    unit = type_unit(words, PICTURED)
    sized = made.in_units(unit)
    seen = rules_of_picture(np.asarray(picture), scale * unit)
    level = [r for r in seen if r.horizontal and _is_by(r, sized.words)]
    walls = [r for r in seen if not r.horizontal and (_is_by(r, sized.words) or _joins(r, level))]
    return replace(sized, rules=(*sized.rules, *level, *walls)).in_units(1 / unit)


def _is_by(rule: DrawnRule, words: Sequence[Word]) -> bool:
    """Whether a rule that a picture shows may be of a table: words stand by it, and it is no stroke of a letter."""
    x, y = (0.0, _NEAR) if rule.horizontal else (_NEAR, 0.0)
    near = [w for w in words if w.x0 < rule.x1 + x and w.x1 > rule.x0 - x]
    near = [w for w in near if w.top < rule.bottom + y and w.bottom > rule.top - y]
    return bool(near) and not any(
        w.x0 < rule.x0 - 0.5 and rule.x1 + 0.5 < w.x1 and w.top - 2 < rule.top and rule.bottom < w.bottom + 2
        for w in near
    )


def _joins(wall: DrawnRule, level: Sequence[DrawnRule]) -> bool:
    """Whether a wall ends at level rules: the side of a table may be far from its words."""
    ends = [
        {end for end in (wall.top, wall.bottom) if abs(end - r.top) <= SNAP}
        for r in level
        if r.x0 - SNAP <= wall.x0 <= r.x1 + SNAP
    ]
    return len(set().union(*ends)) == 2


def _beside(typed: Sequence[Word], seen: Sequence[Word]) -> list[Word]:
    """Of the words seen on a picture, those that are none of the typed ones."""
    return [
        word
        for word in seen
        if not any(
            min(word.x1, t.x1) - max(word.x0, t.x0) > _OVER * min(word.x1 - word.x0, t.x1 - t.x0)
            and min(word.bottom, t.bottom) - max(word.top, t.top) > _OVER * min(word.size, t.size)
            for t in typed
        )
    ]


_WORDS: dict[str, Callable[[Image.Image, float], list[Word]]] = {
    "rapidocr": rapid.words_on,
    "tesseract": tesseract.words_on,
}
