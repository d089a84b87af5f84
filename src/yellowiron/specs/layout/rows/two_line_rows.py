"""Rows folded in two: a label on one line, its value on the line under it, further right."""

from __future__ import annotations

from collections.abc import Sequence

from yellowiron.specs.layout.rows.lines import TextLine
from yellowiron.specs.layout.statement import kind_of

_FEWEST = 3
"""Folded rows; fewer may be anything."""


def unfolded(rows: Sequence[Sequence[TextLine]]) -> list[Sequence[TextLine]]:
    """The rows of a column of text, each label that stands alone over its value in one row with it, where that is how
    the column prints its values: three or more times, and more often than a label beside its value."""
    pairs = {index for index in range(len(rows) - 1) if _is_folded(rows[index], rows[index + 1])}
    beside = sum(
        any(kind_of(p) == "text" and kind_of(q) == "value" for line in row
            for p, q in zip(line.pieces, line.pieces[1:], strict=False))
        for row in rows
    )  # fmt: skip
    if len(pairs) < _FEWEST or len(pairs) <= beside:
        return list(rows)
    found: list[Sequence[TextLine]] = []
    for index, row in enumerate(rows):
        if index - 1 in pairs:
            found[-1] = (*found[-1], *row)
        else:
            found.append(row)
    return found


def _is_folded(row: Sequence[TextLine], following: Sequence[TextLine]) -> bool:
    if len(row) != 1 or len(following) != 1 or len(row[0].pieces) != 1 or len(following[0].pieces) != 1:
        return False
    label, value = row[0].pieces[0], following[0].pieces[0]
    return (
        kind_of(label) == "text"
        and kind_of(value) == "value"
        and value.x0 > label.x0 + label.size
        and value.box[1] - label.box[3] < 0.8 * value.size
        and abs(label.size - value.size) < 0.1 * value.size
        and (value.bold or not label.bold)
    )
