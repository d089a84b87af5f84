"""Captions: a stack of lines, mostly the same in several languages, with its unit in brackets, over the rows of values
that it names; a filled bar between them may name the columns."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from yellowiron.specs.layout.rows.lines import TextLine, lines_of
from yellowiron.specs.layout.statement import Statement, TextPiece, is_unit, join_boxes, kind_of, looks_like_value
from yellowiron.specs.pages.strokes import Box
from yellowiron.specs.pages.words import Page, Word

_FEWEST = 3
"""Lines over the unit; fewer may be a label that goes on."""
_LEADING = 0.8
"""The lines of a stack follow each other within this times the type size."""
_DEEPEST = 4.5
"""A row stands under the one before, or under its caption, within this times the type size."""
_MODEL = re.compile(r"(?=.*\d)(?=.*[A-Z])[A-Z\d/-]+")
_NUMBER = re.compile(r"\d+([.,]\d+)?")
_BRACKETED = re.compile(r"[(\[][^()\[\]]{1,8}[)\]]")


@dataclass(frozen=True)
class _Caption:
    """A stack of lines, the unit in brackets the last of them."""

    lines: tuple[TextPiece, ...]
    box: Box

    @property
    def size(self) -> float:
        """The size of its type."""
        return self.lines[0].size


def captioned(page: Page, first_row: int) -> tuple[list[Statement], frozenset[Word]]:
    """What a page prints under captions, and the words that this takes from the rest of the page. `first_row` numbers
    its rows."""
    pieces = [p for line in lines_of(page.words) for p in line.pieces]
    captions = _captions(pieces)
    found: list[Statement] = []
    taken: set[Word] = set()
    for caption in captions:
        bar, place = _place(caption, captions, page.bars)
        inside = [w for w in page.words if _within(w, place)]
        rows = _rows(caption, [w for w in inside if bar is None or not _within(w, bar)], bar)
        if not any(looks_like_value(p.bare) for row in rows for p in row.pieces):
            continue
        heads = [w for w in inside if bar is not None and _within(w, bar)]
        taken.update(w for p in caption.lines for w in p.words)
        taken.update(heads, (w for row in rows for p in row.pieces for w in p.words))
        found.extend(_statements(page.number, first_row + len(found), caption, sorted(heads, key=lambda w: w.x0), rows))
    return found, frozenset(taken)


def _captions(pieces: Sequence[TextPiece]) -> list[_Caption]:
    """The stacks of lines that end with a unit in brackets, set alike and flush left."""
    found: list[_Caption] = []
    for last in pieces:
        if not _BRACKETED.fullmatch(last.text):
            continue
        stack = [last]
        while above := next((p for p in pieces if _continues(p, stack[0])), None):
            stack.insert(0, above)
        if len(stack) > _FEWEST and not any(_has_value(p, pieces) for p in stack[:-1]):
            found.append(_Caption(tuple(stack), join_boxes(p.box for p in stack)))
    return found


def _continues(piece: TextPiece, below: TextPiece) -> bool:
    """Whether a line of words stands right over another one of its stack."""
    gap = below.box[1] - piece.box[3]
    return (
        abs(piece.x0 - below.x0) < 0.6 * below.size
        and abs(piece.size - below.size) < 0.3 * below.size
        and -0.5 * below.size < gap < _LEADING * below.size
        and piece.box[1] < below.box[1]
        and kind_of(piece) == "text"
        and not any(map(str.isdigit, piece.text))
    )


def _has_value(piece: TextPiece, pieces: Sequence[TextPiece]) -> bool:
    """Whether a line is a label: the next thing to its right is a value."""
    middle = (piece.box[1] + piece.box[3]) / 2
    level = [p for p in pieces if p.x0 > piece.x0 and p.box[1] < middle < p.box[3]]
    return bool(level) and looks_like_value(min(level, key=lambda p: p.x0).bare)


def _place(caption: _Caption, captions: Sequence[_Caption], bars: Sequence[Box]) -> tuple[Box | None, Box]:
    """The filled bar under a caption, if there is one, and where the rows under it stand: up to the next captions."""
    x0, top, x1, bottom = caption.box
    size = caption.size
    level = [c.box for c in captions if c.box[0] > x0 + size and c.box[1] < bottom and c.box[3] > top]
    under = [b for b in bars if b[0] < x1 and b[2] > x0 and -size < b[1] - bottom < 2 * size and b[3] - b[1] < 3 * size]
    bar = min(under, key=lambda b: b[1], default=None)
    wide = max(x1, bar[2]) if bar else x1
    right = min([*(b[0] for b in level), *([wide + size] if bar or not level else [])])
    lower = [c.box[1] for c in captions if c.box[1] > bottom and c.box[0] < right and c.box[2] > x0]
    deepest = bottom + 12 * size
    return bar, (x0 - size, bottom, right - 0.3 * size, min([deepest, *lower]))


def _within(word: Word, place: Box) -> bool:
    x, y = (word.x0 + word.x1) / 2, (word.top + word.bottom) / 2
    return place[0] <= x <= place[2] and place[1] <= y <= place[3]


def _rows(caption: _Caption, words: Sequence[Word], bar: Box | None) -> list[TextLine]:
    """The rows under a caption, as far as they follow each other; each begins with a number or a short name."""
    rows: list[TextLine] = []
    edge = bar[3] if bar else caption.box[3]
    for line in lines_of(words):
        if line.top - edge > _DEEPEST * caption.size or not any(map(str.isdigit, line.text)):
            break
        rows.append(line)
        edge = line.bottom
    return rows


def _statements(
    page: int, row: int, caption: _Caption, heads: Sequence[Word], lines: Sequence[TextLine]
) -> list[Statement]:
    """The values of the rows under a caption, each under its column's head; one alone holds for all columns."""
    label = " ".join(p.bare for p in caption.lines[:-1])
    unit = is_unit(caption.lines[-1].bare.strip("()[]. "))
    left = caption.box[0] + 2 * caption.size
    numbers = any(p.x0 < left and _NUMBER.fullmatch(p.bare) for line in lines for p in line.pieces[:1])
    named = heads and heads[0].x0 < left and not numbers  # what stands over the names of the rows
    columns = heads[1:] if named else heads
    rows = [_cells(line, columns, caption) for line in lines]
    alone = sum(len(cells) for _, cells in rows) == 1
    found: list[Statement] = []
    for number, (name, cells) in enumerate(rows):
        for cell in cells:
            text = "".join(w.text for w in cell) if columns else " ".join(w.text for w in cell)
            head = "" if alone else _head(cell, columns)
            quote = [*(p.text for p in caption.lines), *([head] if head else []), *([name] if name else [])]
            found.append(
                Statement(
                    page=page,
                    row=row + number,
                    label=label,
                    text=text,
                    box=join_boxes(w.box for w in cell),
                    quote=" … ".join([*quote, " ".join(w.text for w in cell)]),
                    context=(name,) if name and not _MODEL.fullmatch(name) else (),
                    column=(head,) if head else (),
                    variant=(name,) if name and _MODEL.fullmatch(name) else (),
                    unit=unit,
                    x0=cell[0].x0,
                )
            )
    return found


def _cells(line: TextLine, heads: Sequence[Word], caption: _Caption) -> tuple[str, list[tuple[Word, ...]]]:
    """What a row is called, and its values: under heads each number is one, else each piece of text but one that
    stands where names begin ("601 T")."""
    words = [w for p in line.pieces for w in p.words]
    left = heads[0].x0 - heads[0].size if heads else 0.0
    first = next((i for i, w in enumerate(words) if w.x1 > left and looks_like_value(w.text)), len(words))
    cells: list[tuple[Word, ...]] = []
    for word in words[first:] if heads else ():
        if cells and re.match(r"[.,]\d", word.text) and word.x0 - cells[-1][-1].x1 < word.size:
            cells[-1] = (*cells[-1], word)  # "9 ,9"
        else:
            cells.append((word,))
    apart = [p.words for part in lines_of(words[first:]) for p in part.pieces]
    if len(apart) > 1 and not first and apart[0][0].x0 < caption.box[0] + 2 * caption.size:
        first = len(apart.pop(0))
    name = " ".join(w.text for w in words[:first] if any(map(str.isalnum, w.text)))
    return name, [c for c in (cells or apart) if looks_like_value(c[0].text)]


def _head(cell: Sequence[Word], heads: Sequence[Word]) -> str:
    """The head that stands over a value, if one does."""
    middle = (cell[0].x0 + cell[-1].x1) / 2
    over = [w for w in heads if w.x0 - w.size < middle < w.x1 + w.size]
    return min(over, key=lambda w: abs((w.x0 + w.x1) / 2 - middle)).text if over else ""
