"""What stands beside the rows of a column of text and is none of their labels: keys of drawings."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from yellowiron.specs.layout.rows.lines import TextLine
from yellowiron.specs.layout.statement import TextPiece, ascending, is_key, is_unit, kind_of


def without_keys(lines: Sequence[TextLine]) -> list[TextLine]:
    """The lines without a drawing's keys: a column of letters or outline numbers, no two alike, beside the rows'
    labels. A letter may look like a unit (L, N, m), and units repeat."""
    keys: set[TextPiece] = set()
    for column in _key_columns(lines):
        texts = [piece.bare for piece, _ in column]
        counted = _one_by_one(texts)  # each before a label, though that has no value: "7  Track gauge" over its rows
        if (
            len(column) >= 3
            and len(set(texts)) == len(texts)
            and sum(beside for _, beside in column) >= (0.4 if counted else 0.6) * len(column)
            and not all(is_unit(t) for t in texts)
            and _counts([piece for piece, _ in column if piece.bare[0].isdigit()], lines)
        ):
            keys.update(piece for piece, beside in column if beside or counted)
    again = [line.pieces[-1] for line in lines if _repeats(line)]
    if len(again) >= _FEWEST_REPEATED:
        keys.update(again)
    if not keys:
        return list(lines)
    kept = [tuple(p for p in line.pieces if p not in keys) for line in lines]
    return [TextLine(pieces) for pieces in kept if pieces]


_FEWEST_REPEATED = 3
"""Rows that end in the number that they begin with."""


def _repeats(line: TextLine) -> bool:
    """Whether a row ends in the outline's number that it begins with: "1.9   Wheelbase   2800   3100   1.9"."""
    first, last = line.pieces[0].bare, line.pieces[-1].bare
    return len(line.pieces) > 2 and first == last and first[0].isdigit() and is_key(first)


def _key_columns(lines: Sequence[TextLine]) -> list[list[tuple[TextPiece, bool]]]:
    """What may be keys, by column; each with whether it stands beside a label and a value."""
    columns: list[list[tuple[TextPiece, bool]]] = []
    for line in lines:
        for index, piece in enumerate(line.pieces):
            if not is_key(piece.bare):
                continue
            words = [kind_of(p) == "text" and not is_key(p.bare) for p in line.pieces]
            values = [kind_of(p) == "value" for p in line.pieces[index + 1 :]]
            begins = not any(words[:index]) or kind_of(line.pieces[index - 1]) == "value"
            if piece.bare[0].isdigit() and not (begins and words[index + 1 : index + 2] == [True]):
                continue  # a number: only right before a label
            middle = (piece.x0 + piece.x1) / 2
            near = [c for c in columns if abs((c[0][0].x0 + c[0][0].x1) / 2 - middle) < 0.8 * piece.size
                    or abs(c[0][0].x0 - piece.x0) < 1]  # fmt: skip
            column = near[0] if near else []
            if not near:
                columns.append(column)
            column.append((piece, any(words) and any(values)))
    return columns


def _counts(numbers: Sequence[TextPiece], lines: Sequence[TextLine]) -> bool:
    """Whether numbers count rows: they go up; those behind another row's value, one by one."""
    texts = [piece.bare for piece in numbers]
    first = {line.pieces[0] for line in lines}
    if all(piece in first for piece in numbers):
        return ascending(texts)
    return _one_by_one(texts)


def _one_by_one(texts: Sequence[str]) -> bool:
    counted = [int(t) if t.isdecimal() else 0 for t in (text.strip("()[].:") for text in texts)]
    return all(b == a + 1 for a, b in pairwise(counted))
