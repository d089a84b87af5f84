"""Each value with the words nearest to it: a plain reading of a page that knows nothing of tables and columns.

A layout that no rule understands still prints a label beside its value, over it or under it. What this reading finds
has no say where the rules have one; `second` says what it is good for.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from yellowiron.specs.language.numbers import read
from yellowiron.specs.layout.rows.headings import body_size, is_heading
from yellowiron.specs.layout.rows.legends import key_legend, spelled
from yellowiron.specs.layout.rows.lines import TextLine, lines_of
from yellowiron.specs.layout.statement import (
    Statement,
    TextPiece,
    is_key,
    is_unit,
    joined,
    kind_of,
    split_inline,
    unit_in_label,
    unit_of_heading,
    without_key,
    words_beside_numbers,
)
from yellowiron.specs.pages.strokes import Box
from yellowiron.specs.pages.words import Page

Side = Literal["left", "above", "below", "under", "behind", "item", "cell"]
"""Where a label stands, seen from its value; `under`: in the middle below it, as in drawings; `behind` a count and
before an `item` in the same piece of text; `cell`: where the layout's rules say."""
_ITEM = re.compile(
    r"(?<!\S)([A-ZÀ-Ý][^:：\d;|]{3,50})[:：]\s*((?:[<>±Øø]\s*)*\d[^:：;|]*?)[.;|]?(?=\s+[A-ZÀ-Ý][^:：\d;|]{3,50}[:：]|$)"
)
"""A name and its value among others in a line: "Type: Planetary Ratio: 23.68:1 Rear oscillation: ± 12°"."""
COUNTS = {word: str(2 + n) for n, word in enumerate("two three four five six seven eight nine ten".split())}  # noqa: SIM905
_COUNTED = re.compile(rf"(?<![\w.,-])({'|'.join(COUNTS)}|\d)[-–\s]([a-z]{{4,}})(?!\w)([^\d,;.:()]*)", re.IGNORECASE)
_BRAND = re.compile(r"\S*[A-Z]{3}\S*")
"""How many parts a thing has, as an adjective: "four-section full power boom", "4 section"; a plural counts others."""
_CLOSE = 1.3
"""A label stands over or under its value within this times the type size; so do the lines of one label."""
_MOST_LINES = {"above": 3, "below": 2}
"""Lines of a label over or under its value."""
_FAR = 12.0
"""A sub-heading holds for rows within this times the type size."""
_INDENT = 60.0
"""Points by which a heading may stand out to the left of a label, half of it for a sub-heading."""


@dataclass(frozen=True)
class Near:
    """A value and the words on one side of it; `over` is what stands above it in its column, the nearest first."""

    side: Side
    statement: Statement
    over: tuple[str, ...] = ()


@dataclass(frozen=True)
class _Placed:
    """A piece of text with its box, measured once; `alone` on its line."""

    piece: TextPiece
    box: Box
    alone: bool


def nearest_of(page: Page) -> tuple[Near, ...]:
    """Every value that stands apart on a page, once for each side on which there are words close to it."""
    page = spelled(page, key_legend(lines_of(page.words)))
    lines = lines_of(page.words, [r for r in page.rules if not r.horizontal])
    texts = [
        _Placed(p, p.box, len(line.pieces) == 1)
        for line in lines
        for p in line.pieces
        if kind_of(p) == "text" and not is_key(p.bare)
    ]
    size = body_size(page.words)
    headings = [t for t in texts if t.piece.bold or is_heading(t.piece, size)]
    alone = [t for t in texts if t.alone]
    heads = [p for line in lines for p in line.pieces if _may_head(p)]
    boxes = [p.box for p in heads]
    found: list[Near] = []
    for row, line in enumerate(lines):
        for piece in line.pieces:
            if any(map(str.isdigit, piece.bare)) or _COUNTED.search(piece.bare):
                found += _within(page.number, row, piece, _heading(line.pieces[:1], headings))
    first = (page.number + 1) * 1_000_000  # rows of their own, apart from those of the layout's statements
    for row, line in enumerate(lines):
        for index, value in enumerate(line.pieces):
            if kind_of(value) != "value" or _is_part(value):
                continue
            before, between = _left_of(line, index)
            after = is_unit(line.pieces[index + 1].bare) if index + 1 < len(line.pieces) else ""
            sides: list[tuple[Side, list[TextPiece]]] = [("left", before)]
            sides += [("above", _stack(value, texts, up=True)), ("below", _stack(value, texts, up=False))]
            box = value.box
            middle = (box[0] + box[2]) / 2
            _, label = sides[-1]
            sides += [("under", label)] if all(_is_centred(p, middle) for p in label) else []
            over = tuple(h.bare for h, b in zip(reversed(heads), reversed(boxes), strict=True)
                         if b[3] <= box[1] + 1 and b[0] < box[2] and box[0] < b[2])  # fmt: skip
            for number, (side, label) in enumerate(sides):
                if not label:
                    continue
                context = _sub_heading(label[0], alone) if side == "left" else ()
                statement = Statement(
                    page=page.number,
                    row=first + row if side == "left" else first + 1000 * row + 4 * index + number + 100_000,
                    label="",
                    text=value.text,
                    box=box,
                    quote=_quote(side, label, value, after),
                    context=context,
                    unit=after or (between if side == "left" else ""),
                    x0=value.x0,
                )
                found.append(Near(side, _named(statement, label, headings), over))
    return tuple(found)


def _is_centred(piece: TextPiece, middle: float) -> bool:
    return abs((piece.x0 + piece.x1) / 2 - middle) < 0.5 * piece.size


def _within(page: int, row: int, piece: TextPiece, heading: str) -> Iterator[Near]:
    """What a piece of text says by itself: how many parts a thing has, and values behind their names."""
    quote = f"{heading} … {piece.text}" if heading else piece.text
    said = Statement(page, row, "", "", piece.box, quote, section=heading, x0=piece.x0)
    for match in _COUNTED.finditer(piece.bare):
        if not match.group(2).endswith("s"):
            count, label = match.group(1).casefold(), f"{match.group(2)}{_BRAND.sub('', match.group(3))}"
            yield Near("behind", replace(said, label=label, text=COUNTS.get(count, count)))
    inline = split_inline(piece.bare)
    for label, text in [match.groups() for match in _ITEM.finditer(piece.bare)] or [inline] * bool(inline[0]):
        yield Near("item", replace(said, label=label, text=text))


def _may_head(piece: TextPiece) -> bool:
    """Whether a piece may name a column: words, also with a number ("2.9 m arm")."""
    kind = kind_of(piece)
    return kind == "text" or (kind == "value" and bool(words_beside_numbers(piece.bare, read(piece.bare))))


def _is_part(value: TextPiece) -> bool:
    """Whether a piece is no value by itself: one digit alone, or the end of what begins in other brackets."""
    return len(value.bare) < 2 or value.text.count("(") != value.text.count(")")


def _named(statement: Statement, label: Sequence[TextPiece], headings: Sequence[_Placed]) -> Statement:
    """The statement with its label and heading, each without the unit that it gives."""
    words, unit = unit_in_label(without_key(joined(p.bare for p in label)))
    section, said = unit_of_heading(_heading(label, headings))
    return replace(statement, label=words, section=section, unit=statement.unit or unit or said)


def _quote(side: Side, label: Sequence[TextPiece], value: TextPiece, unit: str) -> str:
    """What the page prints, from top to bottom."""
    words = [p.text for p in label]
    own = [value.text, *([unit] if unit else [])]
    return " … ".join([*own, *words] if side == "below" else [*words, *own])


def _left_of(line: TextLine, index: int) -> tuple[list[TextPiece], str]:
    """The label to the left of a value, past other values, keys and units; the unit that stands between."""
    unit = ""
    for piece in reversed(line.pieces[:index]):
        kind = kind_of(piece)
        if kind == "text" and not is_key(piece.bare):
            return [piece], unit
        if kind == "unit":
            unit = unit or is_unit(piece.bare)
    return [], ""


def _stack(value: TextPiece, texts: Iterable[_Placed], *, up: bool) -> list[TextPiece]:
    """The lines of words right over a value, or right under it, of one size, from top to bottom."""
    edges, own = value.box, value.size
    near = [t for t in texts if t.box[0] < edges[2] + 2 and edges[0] < t.box[2] + 2]
    found: list[TextPiece] = []
    for _ in range(_MOST_LINES["above" if up else "below"]):
        gaps = [(edges[1] - t.box[3] if up else t.box[1] - edges[3], t) for t in near]
        close = [
            (gap, t)
            for gap, t in gaps
            if -0.3 * own < gap < _CLOSE * own
            and not any(t.piece is p for p in found)
            and (not found or abs(t.piece.size - found[0].size) < 0.2)
            and (t.box[1] < edges[1] if up else t.box[1] > edges[1])
        ]
        if not close:
            break
        nearest = min(close, key=lambda pair: pair[0])[1]
        found.insert(0 if up else len(found), nearest.piece)
        edges, own = nearest.box, nearest.piece.size
    return found


def _heading(label: Sequence[TextPiece], headings: Sequence[_Placed]) -> str:
    """The nearest heading above a label, in its column."""
    x0, top = label[0].x0, min(p.box[1] for p in label)
    above = [
        h
        for h in headings
        if h.box[3] <= top + 1 and x0 - _INDENT < h.box[0] <= label[0].x1 and not any(h.piece is p for p in label)
    ]
    return max(above, key=lambda h: h.box[3]).piece.bare if above else ""


def _sub_heading(label: TextPiece, alone: Sequence[_Placed]) -> tuple[str, ...]:
    """The nearest words above a label that stand alone on their line, at its left edge or out from it."""
    box = label.box
    above = [
        t
        for t in alone
        if t.box[3] <= box[1] + 1
        and box[1] - t.box[3] < _FAR * label.size
        and box[0] - _INDENT / 2 < t.box[0] <= box[0] + 1
    ]
    return (max(above, key=lambda t: t.box[3]).piece.bare,) if above else ()
