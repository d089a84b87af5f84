"""The value cells of a row without a grid: their labels, the heads over them, their statements."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.quantities import FEET_DASH
from yellowiron.specs.layout.rows.lines import TextLine
from yellowiron.specs.layout.statement import (
    EXAMPLE,
    Statement,
    TextPiece,
    is_key,
    is_unit,
    join_boxes,
    joined,
    kind_of,
    split_inline,
    unit_in_label,
    without_key,
    words_beside_numbers,
)
from yellowiron.specs.pages.strokes import Box
from yellowiron.specs.pages.words import Page

_LONGEST_NOTE = 8
"""Words after a value that may say which it is; more are a remark."""


@dataclass
class ValueCell:
    """The pieces of one value: its label's, its own (one below the other: metric, imperial), the words after the last
    value of the row; `unit` where a piece of its own gives it, or, `lent`, one at the end of the row all of them."""

    label: list[TextPiece]
    values: list[TextPiece]
    notes: list[TextPiece] = field(default_factory=list)
    unit: str = ""
    lent: bool = False


def statement_of(
    page: Page,
    row: Sequence[TextLine],
    cell: ValueCell,
    heads: Sequence[TextPiece],
    context: Sequence[TextPiece],
    above: Sequence[TextPiece],
    number: int,
) -> Statement:
    """The statement of a cell: `heads` stand over it, `context` are its sub-headings, `above` those the quote needs."""
    label, text = joined(p.bare for p in cell.label), " ".join(p.text for p in cell.values)
    if not cell.label:
        inline = split_inline(" ".join(p.bare for p in cell.values))
        if inline[0]:
            label, text = inline
    column = [h for h in heads if not is_unit(h.bare)]
    unit = next((u for h in reversed(heads) if (u := is_unit(h.bare) or unit_in_label(h.bare)[1])), "")
    own = "" if cell.lent and any(is_unit(h.bare) for h in heads) else cell.unit  # "s" may be a sign's letter: ●
    bare = not cell.unit and not unit and not any(q.unit for r in read(text) for q in r.numbers)
    label, label_unit = unit_in_label(without_key(label), bare=bare)
    box = join_boxes(p.box for p in cell.values)
    return Statement(
        page=page.number,
        row=number,
        label=label,
        text=EXAMPLE.sub("", text).strip(),
        box=box,
        quote=_quote(page, row, above, cell, column if not cell.label else []),
        context=tuple(p.bare for p in context),
        column=tuple(unit_in_label(h.bare)[0] for h in column if h.bare),
        unit=own or label_unit or unit,
        example=any(EXAMPLE.search(h.text) for h in heads)
        or marked_by_footnote(page, [*cell.label, *cell.values, *heads]),
        x0=box[0],
        heads=tuple(h.text for h in column) if cell.label else (),
    )


def cells_of(row: Sequence[TextLine]) -> list[ValueCell]:
    """The row's values, each with the labels to its left back to the value before."""
    pieces, kinds = _pieces_of(row)
    values = [p for p in pieces if kinds[p] == "value"] or [p for p in pieces if split_inline(p.bare)[0]]
    others = [p for p in pieces if not any(p is v for v in values)]
    cells: list[ValueCell] = []
    left_edge = float("-inf")
    for column in _columns_of(values):
        x0 = min(p.x0 for p in column)
        between = [p for p in others if left_edge <= p.x0 < x0]
        cells.append(_cell(column, between, kinds, cells[-1] if cells else None))
        left_edge = max(p.x1 for p in column)
    return _with_notes(cells, [p for p in others if p.x0 >= left_edge], kinds) if cells else []


_Kinds = Mapping[TextPiece, str]
"""What `kind_of` says of each piece of a row."""


def _pieces_of(row: Sequence[TextLine]) -> tuple[list[TextPiece], _Kinds]:
    """A row's pieces, line by line, without a drawing's keys; and what each is in its row."""
    pieces = sorted((p for line in row for p in line.pieces), key=lambda p: (p.words[0].baseline, p.x0))
    kinds = {p: kind_of(p) for p in pieces}
    if [kinds[p] for p in pieces[:2]] == ["value", "value"] and is_circumstance(pieces[0]):
        kinds[pieces[0]] = "text"
    kinds |= {p: "text" for p in pieces if kinds[p] == "value" and _goes_on(p, pieces, kinds)}
    keys = _keys_of(pieces, kinds)
    return [p for p in pieces if p not in keys], kinds


def _goes_on(piece: TextPiece, pieces: Sequence[TextPiece], kinds: _Kinds) -> bool:
    """Whether a piece that begins with a number is the second line of a label: "Maximum depth cut for", and under it
    "2440 mm level bottom"."""
    flush = any(kinds[p] == "text" and abs(p.x0 - piece.x0) < 1 and p.box[3] <= piece.box[1] + 1 for p in pieces)
    beside = any(kinds[p] == "value" and p.x0 > piece.x1 for p in pieces)
    return flush and beside and len(words_beside_numbers(piece.bare, read(piece.bare))) > 1


def _columns_of(values: Sequence[TextPiece]) -> list[list[TextPiece]]:
    """Values that overlap from left to right, as those one below the other do."""
    columns: list[list[TextPiece]] = []
    for piece in sorted(values, key=lambda p: (p.x0, p.box[1])):
        if columns and any(p.x0 < piece.x1 and piece.x0 < p.x1 for p in columns[-1]):
            columns[-1].append(piece)
        else:
            columns.append([piece])
    return columns


def _cell(
    column: Sequence[TextPiece], between: Sequence[TextPiece], kinds: _Kinds, before: ValueCell | None
) -> ValueCell:
    """The cell of a column's values: `between` are the pieces since the value `before`, which takes the unit that
    stands behind it and lends its label to a value that has none."""
    label = [p for p in between if kinds[p] == "text"]
    units = [p for p in between if kinds[p] == "unit"]
    if before is not None and units and not _has_unit(before) and (not label or units[0].x0 < label[0].x0):
        before.values.append(units.pop(0))  # the unit after a number, in a column of its own
    if before is not None and label:
        units = [u for u in units if u.x0 > label[0].x0]
    unit = is_unit(units[-1].bare) if units else ""
    if not label and before is not None:
        label, unit = before.label, unit if units else before.unit
    stacked = sorted(column, key=lambda p: (p.words[0].baseline, p.x0))
    if len(stacked) > 1 and (beside := _beside(stacked, units)):
        stacked, unit = beside, ""
    return ValueCell(label, stacked, unit=unit)


def _with_notes(cells: list[ValueCell], after: list[TextPiece], kinds: _Kinds) -> list[ValueCell]:
    """The cells of a row with what stands after its last value: a unit, which holds for all of them where none has its
    own, and words, which may say which value it is."""
    cells[-1].notes = after
    units = [p for p in after if kinds[p] == "unit"]
    if units and any(kinds[p] == "unit" for c in cells for p in c.values):
        if not _has_unit(cells[-1]):
            cells[-1].values.append(units[0])
    elif units and all(not c.unit for c in cells):
        cells = [replace(c, unit=is_unit(units[0].bare), lent=True) for c in cells]
    for note in (p for p in after if kinds[p] == "text"):
        if is_key(note.bare):
            break  # another table's key
        if len(note.words) <= _LONGEST_NOTE:
            cells[-1].values.append(note)
    return cells


def is_circumstance(piece: TextPiece) -> bool:
    """Whether a piece that begins with an angle is the label of the value beside it: "40° full turn"."""
    readings = read(piece.bare)
    return (
        len(readings) == 1
        and readings[0].numbers[0].dimension == "angle"
        and bool(words_beside_numbers(piece.bare, readings))
    )


def _beside(values: Sequence[TextPiece], units: Sequence[TextPiece]) -> list[TextPiece]:
    """Values one below the other, each with the unit on its own line behind it; [] where no unit or several stand on a
    line, or a unit on none."""
    found: list[TextPiece] = []
    for value in values:
        level = [u for u in units if abs(u.words[0].baseline - value.words[0].baseline) < 0.3 * value.size]
        if len(level) > 1 or not (level or _has_unit(ValueCell([], [value])) or FEET_DASH.fullmatch(value.bare)):
            return []
        found += [value, *level]
    return found if len(found) == len(values) + len(units) else []


def _has_unit(cell: ValueCell) -> bool:
    """Whether a value has its unit: before it in a column of its own, or at its last number."""
    readings = read(" ".join(p.text for p in cell.values))
    return bool(cell.unit) or not readings or bool((readings[-1].partner or readings[-1].numbers)[-1].unit)


def _keys_of(pieces: Sequence[TextPiece], kinds: _Kinds) -> frozenset[TextPiece]:
    """The keys of a drawing before a row's labels: letters or numbers that words follow, and a value after them. A key
    may look like a unit (L, N, m) or a value (7): the row begins with it, or another key does."""
    ordered = sorted(pieces, key=lambda p: p.x0)
    keys: set[TextPiece] = set()
    for index, (piece, following) in enumerate(pairwise(ordered)):
        begins = index == 0 or (bool(keys) and kinds[ordered[index - 1]] != "text")
        valued = any(kinds[p] == "value" for p in ordered[index + 2 :])
        if begins and valued and is_key(piece.bare) and kinds[following] == "text" and not is_key(following.bare):
            keys.add(piece)
    return frozenset(keys)


def heads_over(heads: Sequence[tuple[TextPiece, ...]], box: Box, *, alone: bool = False) -> list[TextPiece]:
    """The head of each head line that stands over a value: the one that overlaps it, else the nearest one; none over
    one that is `alone` in its row and stands between the columns, as it holds for all of them."""
    over: list[TextPiece] = []
    for line in heads:
        if alone and _is_between(line, box):
            continue
        overlap = [(min(p.x1, box[2]) - max(p.x0, box[0]), p) for p in line]
        best = max(overlap, key=lambda pair: pair[0])
        if best[0] > 0:
            over.extend(p for _, p in overlap if p is best[1])
        elif len(line) >= 2 or best[0] > -40:
            nearest = max(overlap, key=lambda pair: pair[0])
            if nearest[0] > -60:
                over.append(nearest[1])
    return over


def _is_between(heads: Sequence[TextPiece], box: Box) -> bool:
    """Whether a value is level with none of the columns' heads, at the left, the middle or the right, but stands
    between the first and the last."""
    middle = (box[0] + box[2]) / 2
    middles = [(h.x0 + h.x1) / 2 for h in heads]
    level = any(
        abs(h.x0 - box[0]) < 3 or abs(h.x1 - box[2]) < 3 or abs(m - middle) < 4
        for h, m in zip(heads, middles, strict=True)
    )
    return len(heads) > 1 and not level and not is_unit(heads[-1].bare) and min(middles) < middle < max(middles)


def _quote(
    page: Page, row: Sequence[TextLine], context: Sequence[TextPiece], cell: ValueCell, heads: Sequence[TextPiece]
) -> str:
    """What the page prints: sub-heading or head, then each line of the row from the label to the value. Pieces that do
    not follow each other on the page are parted: a drawing's key may stand between them, or, in the file, the second
    line of a broken label."""
    parts = [p.printed for p in [*heads, *context]]
    chosen = [*cell.label, *cell.values]
    for line in row:
        mine = [i for i, p in enumerate(line.pieces) if any(p is q for q in chosen)]
        if not mine:
            continue
        pieces = line.pieces[mine[0] : mine[-1] + 1]
        text = pieces[0].printed
        for before, piece in pairwise(pieces):
            parted = len(row) > 1 or _any_between(page, before, piece)
            text += f"{' … ' if parted else ' '}{piece.printed}"
        parts.append(text)
    return " … ".join(dict.fromkeys(parts))


def _any_between(page: Page, a: TextPiece, b: TextPiece) -> bool:
    """Whether the page prints a word between two pieces of a line."""
    base = a.words[0].baseline
    return any(abs(w.baseline - base) < 0.3 * w.size and a.x1 < w.x0 and w.x1 < b.x0 for w in page.words)


def marked_by_footnote(page: Page, pieces: Sequence[TextPiece]) -> bool:
    """Whether a footnote sign at one of the pieces stands for "example value" at the foot of the page."""
    marks = "".join(p.marks for p in pieces)
    return any(mark in marks and EXAMPLE.search(text) for mark, text in page.footnotes.items())


def footnotes_of(lines: Sequence[TextLine]) -> dict[str, str]:
    """Footnote signs and what they mean: lines that begin with one."""
    found: dict[str, str] = {}
    for line in lines:
        match = re.match(r"^([*†‡§¤◊]+|\d\))\s*(\S.*)$", line.text)
        if match:
            found.setdefault(match.group(1), match.group(2))
        elif line.pieces[0].words[0].marks and len(line.text.split()) > 1:
            found.setdefault(line.pieces[0].words[0].marks, line.text)
    return found
