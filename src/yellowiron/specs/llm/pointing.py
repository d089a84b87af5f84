"""Where a language model points on a page, against the page: the place becomes a `Statement`, or is turned away.

The page has the last word. The number must be printed in the cell that is named, its unit behind it or in its label,
its heading or its column; the label must be the value's own: before it in its cell, the nearest words on its row, or
right over or under it. The heading and the columns are the page's, whatever the model says of them.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import takewhile

from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.quantities import same
from yellowiron.specs.layout.page_cells import Cell
from yellowiron.specs.layout.statement import (
    Statement,
    is_key,
    is_unit,
    joined,
    unit_in_label,
    unit_noted,
    unit_of_heading,
    without_key,
    words_beside_numbers,
)
from yellowiron.specs.pages.strokes import Box

_LEVEL = 0.2
"""Two cells are on one row if this share of the lower one's height is common to both."""
_CLOSE = 1.3
"""A label stands over or under its value, and its lines over one another, within this times the type size."""
_TITLE = 2.5
"""Words set this many times larger than a label are the page's title, and head no rows."""
_OUT = 60.0
"""Points by which a heading may stand out to the left of a label."""


class RefusedError(Exception):
    """Why a place that a model points to is turned away."""


@dataclass(frozen=True)
class PageText:
    """What a model is shown: the cells of a page (or of part of a long one), numbered from 1; `sheet` counts the sheets
    that are read together from 0."""

    sheet: int
    page: int
    cells: tuple[Cell, ...]

    def cell(self, number: int) -> Cell:
        """The cell of that number; `RefusedError` if there is none."""
        if not 1 <= number <= len(self.cells):
            raise RefusedError("no such cell")
        return self.cells[number - 1]


@dataclass(frozen=True)
class Place:
    """A checked place: its statement, the words over it, the columns' names that stand over it, whether other values
    of its row stand beside it in columns of their own, and the footnote that is pointed to."""

    statement: Statement
    over: tuple[str, ...]
    in_columns: bool
    footnote: str = ""


@dataclass(frozen=True)
class Spot:
    """Where a number that is pointed to stands, whatever its label: sheet, page, the cell's box; `words`: why;
    `around`: what stands on its row and over it."""

    sheet: int
    page: int
    box: Box
    number: str
    words: str
    around: str = ""


def spot_of(said: Mapping[str, object], text: PageText) -> Spot | None:
    """Where an answer's number is printed, in digits or as a word; None where it is not."""
    cell, number = _number(said["value_cell"]), str(said["value"]).strip()
    if not 1 <= cell <= len(text.cells) or not re.search(r"\w", number):
        return None
    value, unit = text.cells[cell - 1], _number(said["unit_cell"])
    if unit and not (unit <= len(text.cells) and is_unit(text.cells[unit - 1].bare.split()[0])):
        return None  # what is pointed to as its unit is none
    if not re.search(rf"(?<![\w.,]){re.escape(number)}(?!\w*\d|[.,]\d)", value.text, re.IGNORECASE):
        return None
    over = [c for c in text.cells if c.heading and c.box[3] <= value.box[1] + 1]  # the last heading is the nearest
    around = [*over[-1:], *(c for c in text.cells if c.line == value.line), *_above(value, text.cells)]
    said_there = " ".join(c.text for c in around)
    return Spot(text.sheet, text.page, value.box, number, str(said["words"]), said_there)


def place_of(said: Mapping[str, object], text: PageText, row: int) -> Place:
    """The place that an answer's entry names; `RefusedError` where the page does not bear it out. `row`: its number."""
    value = text.cell(_number(said["value_cell"]))
    printed = str(said["value"]).strip()
    begin = _stands_at(printed, value.text)
    numbers = said["label_cells"]
    labels = [text.cell(_number(n)) for n in numbers] if isinstance(numbers, Sequence) else []
    unit_cell = text.cell(n) if (n := _number(said["unit_cell"])) else None
    label, inside = _label_of(value, begin, labels, text.cells)
    words, unit = unit_in_label(without_key(label))
    over = _over(value, text.cells)
    section = _heading(labels[0], value, text.cells)
    section, of_heading = unit_of_heading(section)
    shown = value.text[begin:] if inside else value.text
    head, of_head = _head(said, text, value, over)
    own = _own_unit(value, unit_cell, text.cells)
    shown += f" {own}" if own and inside else ""
    found = own or unit or of_head or of_heading or _noted(value, text.cells)
    if unit_cell is not None and not found:
        raise RefusedError("the unit is not the value's")
    if not read(shown, unit=found):
        raise RefusedError("the cell holds no number")
    _check_words(str(said["words"]), [label, section, head, *over])
    quote = [value.text] if inside else [label, value.text]
    statement = Statement(
        page=text.page, row=row, label=words, text=shown, box=value.box, quote=" … ".join(quote), section=section,
        column=(head,) if head else (), heads=(head,) if head else (), unit=found, x0=value.box[0], sheet=text.sheet,
    )  # fmt: skip
    footnote = text.cell(n).text if (n := _number(said["footnote_cell"])) else ""
    marked = bool(footnote) and any(_marked(footnote, c.text) for c in (*labels, value, *_above(value, text.cells)))
    return Place(statement, tuple(c.bare for c in over), _in_columns(value, text.cells), footnote if marked else "")


def _number(said: object) -> int:
    return said if isinstance(said, int) else 0


def _stands_at(number: str, text: str) -> int:
    """Where a number stands in a cell, not within another one."""
    first = re.search(r"\d", number)
    found = re.search(rf"(?<![\d.,]){re.escape(number)}(?!\d|[.,]\d)", text) if first else None
    if found is None:
        raise RefusedError("the number is not in the cell")
    return found.start()


def _label_of(value: Cell, begin: int, labels: Sequence[Cell], cells: Sequence[Cell]) -> tuple[str, bool]:
    """A value's own label, and whether it stands before it in the same cell."""
    if not labels:
        raise RefusedError("no label")
    if labels == [value]:
        ends = [q.end for r in read(value.text) for q in (*r.numbers, *r.partner) if q.end <= begin]
        before = re.sub(r"^[^\w]*(?:[^\W\d]+/?[^\W\d]*\s*\))?[\s)/;,.]*", "", value.text[max(ends, default=0) : begin])
        in_brackets = value.text[:begin].count("(") > value.text[:begin].count(")")  # a condition: "Height (at 45°)"
        behind_another = bool(ends) and before.rstrip().endswith(("/", "-", "–"))  # "6° forward /12° mast tilt"
        if in_brackets or behind_another or not re.search(r"[^\W\d_]{2,}", before):
            raise RefusedError("the label is not the value's own")
        return before.rstrip(" :("), True
    inside = re.search(r"[^\W\d_]{2,}[^:]*:", value.text[:begin]) is not None
    others = any(c.kind != "text" and not _says_words(c.bare) for c in labels)
    if value in labels or inside or others or any(re.search(r":\s*\S*\d", c.text) for c in labels):
        raise RefusedError("the label is not the value's own")
    own = [c for c in labels if _is_own(c, value, cells)]
    rest = [c for c in labels if c not in own]
    while rest:
        joins = [c for c in rest if any(_leads_to(c, o, cells) for o in own)]
        joins += [c for c in rest if any(_follows(c, o) for o in own) and not _values_right_of(c, cells)]
        if not joins:
            raise RefusedError("the label is not the value's own")
        own += [c for c in joins if c not in own]
        rest = [c for c in rest if c not in joins]
    return joined(c.bare for c in sorted(own, key=lambda c: (c.line, c.box[0]))), False


def _is_own(label: Cell, value: Cell, cells: Sequence[Cell]) -> bool:
    """Whether a label is a value's: the nearest words to the left on its row; or right over or under it, where no words
    are on its row and no other value on the label's."""
    level = _level(label.box, value.box)
    left = [c for c in cells if c.box[2] <= value.box[0] + 1 and _level(c.box, value.box) >= _LEVEL]
    beside = [c for c in left if _is_words(c, value)]
    if level >= _LEVEL and label.box[2] <= value.box[0] + 1:
        nearest = max(c.box[2] for c in beside) if beside else 0.0
        return label.box[2] >= nearest - 1 or not any(
            c.box[0] > label.box[2] - 1 or (_meet(c.box, label.box) and _level(c.box, value.box) > level)
            for c in beside
        )
    if beside or not _meet(label.box, value.box) or _values_right_of(label, cells):
        return False
    gap = max(value.box[1] - label.box[3], label.box[1] - value.box[3])
    return gap < _CLOSE * min(label.size, value.size) and not any(
        c is not label and c is not value and _meet(c.box, value.box)
        and min(label.box[1], value.box[1]) < c.box[1] < max(label.box[1], value.box[1]) for c in cells
    )  # fmt: skip


def _is_words(cell: Cell, value: Cell) -> bool:
    """Whether a cell is words, and no value beside one that has words of its own ("6 x 19 IWRC ø10 mm")."""
    if cell.kind != "text" or _is_key(cell.bare):
        return False
    return value.kind != "text" or not _has_unit(cell.text)


@functools.lru_cache(maxsize=8192)
def _is_key(text: str) -> bool:
    """Whether a text is a drawing's key: "h1", "b 10 (mm)"."""
    return is_key(text) or is_key(unit_in_label(text)[0])


@functools.lru_cache(maxsize=8192)
def _has_unit(text: str) -> bool:
    return any(q.unit for r in read(text) for q in r.numbers)


@functools.lru_cache(maxsize=8192)
def _says_words(text: str) -> bool:
    """Whether a text has words beside its numbers."""
    return bool(words_beside_numbers(text, read(text)))


def _follows(a: Cell, b: Cell) -> bool:
    """Whether two cells are lines of one text."""
    gap = max(a.box[1] - b.box[3], b.box[1] - a.box[3])
    return _meet(a.box, b.box) and gap < 0.9 * a.size and abs(a.size - b.size) < 0.6


def _leads_to(left: Cell, right: Cell, cells: Sequence[Cell]) -> bool:
    """Whether two cells are the parts of one row's label: "Turning radius | minimum outside | mm | 2,050"."""
    beside = [c for c in cells if c.box[0] >= left.box[2] - 1 and _level(c.box, left.box) >= 0.5]
    return bool(beside) and min(beside, key=lambda c: c.box[0]) is right


def _values_right_of(label: Cell, cells: Sequence[Cell]) -> bool:
    """Whether the nearest thing to the right on a label's row is a value."""
    right = [c for c in cells if c.box[0] >= label.box[2] - 1 and _level(c.box, label.box) >= 0.5]
    return bool(right) and min(right, key=lambda c: c.box[0]).kind == "value"


def _in_columns(value: Cell, cells: Sequence[Cell]) -> bool:
    """Whether the row has further values beside this one, no words between them: those of other columns, and not this
    one again in the other system of measurement."""
    row = sorted((c for c in cells if _level(c.box, value.box) >= 0.5), key=lambda c: c.box[0])
    at = row.index(value)
    for side in (row[at + 1 :], row[:at][::-1]):
        for cell in side:
            if _is_words(cell, value):
                break
            if cell.kind in ("value", "text") and not _is_again(cell, value):
                return True
    return False


def _is_again(cell: Cell, value: Cell) -> bool:
    """Whether two cells print one quantity in two units, each its own: "169 kW" beside "227 hp"."""
    own, other = ([q for r in read(c.bare) for q in (*r.numbers, *r.partner)] for c in (value, cell))
    apart = bool(own and other) and {q.unit for q in own}.isdisjoint(q.unit for q in other)
    return apart and all(q.unit_printed for q in (*own, *other)) and all(same(a, b) for a in own for b in other)


def _above(value: Cell, cells: Sequence[Cell]) -> list[Cell]:
    """The cells above a value that overlap it, the nearest first."""
    found = [c for c in cells if c.box[3] <= value.box[1] + 1 and _meet(c.box, value.box)]
    return sorted(found, key=lambda c: -c.box[3])


def _over(value: Cell, cells: Sequence[Cell]) -> tuple[Cell, ...]:
    """What may name a value's column: words above it, also with a number, and among them nothing wider than a table's
    cell would be."""
    return tuple(
        c for c in _above(value, cells) if c.kind == "text" or _says_words(c.bare)
    )  # fmt: skip


def _head(said: Mapping[str, object], text: PageText, value: Cell, over: Sequence[Cell]) -> tuple[str, str]:
    """The column's head that is pointed to, without its unit, and that unit."""
    number = _number(said["column_cell"])
    if not number:
        return "", ""
    cell = text.cell(number)
    between = [c for c in over if c.box[1] > cell.box[3] + _CLOSE * cell.size]
    if cell not in over or any(c.heading or c.kind == "text" for c in between):
        raise RefusedError("the column is not the value's own")
    return ("", unit) if (unit := is_unit(cell.bare)) else unit_in_label(cell.bare)


def _heading(label: Cell, value: Cell, cells: Sequence[Cell]) -> str:
    """The nearest heading above a label, in its column of text; what has heads over the row's values beside it is the
    label of the heads' row ("Stick options | R3.2 | R2.9")."""
    right = sorted((c for c in cells if c.line == value.line and c.box[0] >= label.box[2] - 1), key=lambda c: c.box[0])
    own = list(takewhile(lambda c: c is value or not _is_words(c, value), right))
    end = max(c.box[2] for c in (*own, value))
    over = [c for c in cells if label.box[2] <= c.box[0] < end and c.kind != "unit"]
    above = [
        c for c in cells
        if c.heading and c.kind == "text" and c.box[3] <= label.box[1] + 1
        and 0.99 * label.size <= c.size < _TITLE * label.size and label.box[0] - _OUT < c.box[0] <= label.box[2]
        and not any(_level(c.box, head.box) >= 0.5 for head in over)
    ]  # fmt: skip
    return max(above, key=lambda c: c.box[3]).bare if above else ""


def _own_unit(value: Cell, unit: Cell | None, cells: Sequence[Cell]) -> str:
    """The unit in a cell of its own: next to the value on its row, over its column, or at the begin of the line on
    which the value's goes on."""
    if unit is None or unit is value:
        return ""
    row = sorted((c for c in cells if c.line == value.line), key=lambda c: c.box[0])
    at = row.index(value)
    alone = is_unit(unit.bare)
    if alone and (unit in row[max(0, at - 1) : at + 2] or unit in _above(value, cells)):
        return alone
    following = [c for c in cells if c.line == value.line + 1]
    if value is row[-1] and following and unit is following[0]:
        first = unit.text.split()[0]
        return unit.text if is_unit(first) else ""
    return ""


def _noted(value: Cell, cells: Sequence[Cell]) -> str:
    noted = {unit for c in cells if c.page == value.page and (unit := unit_noted(c.text))}
    return noted.pop() if len(noted) == 1 else ""


def _check_words(words: str, places: Sequence[object]) -> None:
    """The words that a reason rests on are the label's, its heading's or its column's."""
    there = " ".join(p.bare if isinstance(p, Cell) else str(p) for p in places).casefold()
    said = re.findall(r"[^\W\d_]+", words.casefold())
    if not said or any(word not in there for word in said):
        raise RefusedError("its words are not the label's")


def _marked(footnote: str, text: str) -> bool:
    """Whether a footnote's sign stands at the end of a text."""
    sign = re.match(r"\s*([*†‡§¤◊]+|\d\))", footnote)
    return sign is not None and text.rstrip().endswith(sign.group(1))


def _level(a: Box, b: Box) -> float:
    common = min(a[3], b[3]) - max(a[1], b[1])
    return common / max(min(a[3] - a[1], b[3] - b[1]), 0.1)


def _meet(a: Box, b: Box) -> bool:
    return a[0] < b[2] and b[0] < a[2]
