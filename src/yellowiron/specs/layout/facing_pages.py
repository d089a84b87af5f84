"""A table over facing pages: the second has values alone, level with the rows that the first one labels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby

from yellowiron.specs.language.numbers import read
from yellowiron.specs.layout.statement import Statement

_FEWEST, _MOST = 5, 0.8
"""Rows without labels that go on those of the page before: so many, and such a share of all, at least."""
_LEVEL, _ALIKE = 1.0, 3.0
"""Points within which the middles of two rows are level, and times that a value may be that of a sister machine."""

_Row = Sequence[Statement]


def with_labels(statements: Sequence[Statement]) -> list[Statement]:
    """The statements of a sheet; those of a page whose rows have values and no labels, and go on the rows of the page
    before it (level with them, with values about as much), have the labels, sub-headings and units of those."""
    found: list[Statement] = []
    labelled: list[_Row] = []
    last = 0
    for page, group in groupby(statements, key=lambda s: s.page):
        own = list(group)
        rows = _rows(own)
        bare = [row for row in rows if len(row) > 1 and not any(s.label for s in row)]
        facing = [(row, said) for row in bare if (said := _level(row, labelled))] if page == last + 1 else []
        if len(facing) >= _FEWEST and len(facing) >= _MOST * len(bare):
            given = {s: new for row, said in facing for s, new in zip(row, _said_by(row, said), strict=True)}
            own = [given.get(s, s) for s in own]
            rows = _rows(own)
        labelled, last = [row for row in rows if all(s.label for s in row)], page
        found += own
    return found


def _rows(statements: Sequence[Statement]) -> list[_Row]:
    return [sorted(row, key=lambda s: s.box[0]) for _, row in groupby(statements, key=lambda s: s.row)]


def _level(row: _Row, rows: Sequence[_Row]) -> _Row:
    """The only one of some rows that a row goes on; none where two are level with it."""
    middle = sum(row[0].box[1::2]) / 2
    level = [one for one in rows if abs(sum(one[0].box[1::2]) / 2 - middle) < _LEVEL]
    if len({(s.label, s.context) for one in level for s in one}) != 1:
        return ()
    a, b = (next((q.value for r in read(s.text) for q in r.numbers), 0.0) for s in (row[0], level[0][0]))
    return level[0] if a == b or (a * b > 0 and 1 / _ALIKE < a / b < _ALIKE) else ()


def _said_by(row: _Row, said: _Row) -> list[Statement]:
    """The values of a row with what the row level with it says of its own: one unit, or two of them in turn."""
    units = [s.unit for s in said]
    turns = [n for n in (1, 2) if not (len(row) % n or len(said) % n) and units == units[:n] * (len(said) // n)]
    first = said[0]
    return [
        replace(s, label=first.label, context=first.context, section=first.section or s.section, variant=(),
                unit=s.unit or (units[i % turns[0]] if turns else ""))
        for i, s in enumerate(row)
    ]  # fmt: skip
