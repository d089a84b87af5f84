"""Rows with values: their statements under the heads, sub-headings and labels of the rows above."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from yellowiron.specs.layout.rows.cells import (
    ValueCell,
    cells_of,
    heads_over,
    statement_of,
)
from yellowiron.specs.layout.rows.lines import TextLine
from yellowiron.specs.layout.rows.reader_state import ReaderState
from yellowiron.specs.layout.statement import (
    COUNTED,
    EXAMPLE,
    Statement,
    TextPiece,
    is_key,
    join_boxes,
    kind_of,
    unit_of_heading,
)
from yellowiron.specs.layout.tolerances import INDENT, LONGEST_LABEL


def read_values(row: Sequence[TextLine], state: ReaderState, number: int) -> None:
    """Adds the statements of a row with values, `number` theirs, to those found above it."""
    state.worded = ()
    cells = [c for c in cells_of(row) if _words_of(c.label) <= LONGEST_LABEL]
    if not cells:
        return
    pending, state.pending = state.pending, []
    has_label = any(c.label for c in cells)
    _end_heads(row, cells, state)
    _keep_sub_heading(cells, pending, state)
    context = [*state.context, *(p for p in pending if p not in state.context)]
    if state.circuit is not None:
        context.insert(0, state.circuit)
    if state.corner is not None and state.heads:
        context.insert(0, state.corner)
    marked = bool(EXAMPLE.search(state.section)) or any(
        EXAMPLE.search(p.text) for p in [*context, *(q for c in cells for q in [*c.notes, *c.label, *c.values])]
    )
    for cell in cells:
        heads = heads_over(state.heads, join_boxes(p.box for p in cell.values), alone=len(cells) == 1)
        above = context if not cell.label or pending else []
        statement = statement_of(state.page, row, cell, heads, context, above, number)
        state.found.append(in_section(statement, state, marked=marked))
    if not has_label:
        # A value under a label on a line of its own, its partner beneath: "25,510 kg" / "56,240 lb".
        state.pending = pending
        if not pending and not state.heads:
            state.orphans = list(range(len(state.found) - len(cells), len(state.found)))


def _words_of(label: Sequence[TextPiece]) -> int:
    """How many words a label has; a remark in brackets is none of it."""
    return len(re.sub(r"\([^()]*\)", " ", " ".join(p.text for p in label)).split())


def _keep_sub_heading(cells: Sequence[ValueCell], pending: Sequence[TextPiece], state: ReaderState) -> None:
    """A line of words holds for all the rows that are indented under it, not only the next."""
    labels = [c.label[0].x0 for c in cells if c.label]
    if not labels:
        return
    if state.indented and labels[0] < state.context[-1].x0 + INDENT:
        state.context, state.indented = [], False
    if pending and labels[0] >= pending[-1].x0 + INDENT:
        state.context, state.indented = list(pending), True


def _end_heads(row: Sequence[TextLine], cells: Sequence[ValueCell], state: ReaderState) -> None:
    """Forgets column heads where their table has ended: a narrower row, a row of several labels, or a gap."""
    labels = {c.label[0] for c in cells if c.label}
    dashes = sum(kind_of(p) == "mark" and bool(p.bare) for line in row for p in line.pieces)  # "none" in a column
    filled = len(cells) + dashes
    narrower = state.data_since_heads and 2 * filled < state.values_in_row
    apart = False
    if state.heads and not state.data_since_heads:
        state.heads = [h for h in state.heads if not _are_keys(h, cells)]
    if state.heads and not state.data_since_heads and state.heads != state.kept:
        lowest = max(p.box[3] for head in state.heads for p in head)
        size = max(p.size for line in row for p in line.pieces)
        apart = min(line.top for line in row) - lowest > 3 * size
    if narrower or apart or len(labels) > 1:
        state.heads = []
    state.values_in_row = filled


def _are_keys(heads: Sequence[TextPiece], cells: Sequence[ValueCell]) -> bool:
    """Whether the letters of a line stand about a drawing, and not each over a column of values."""
    if not all(is_key(h.bare) for h in heads):
        return False
    columns = [join_boxes(p.box for p in c.values) for c in cells]
    return len(heads) < 2 or not all(any(h.x0 < box[2] and box[0] < h.x1 for box in columns) for h in heads)


def in_section(statement: Statement, state: ReaderState, *, marked: bool) -> Statement:
    """The statement with its section and the section's unit; `marked`: its row is marked as an example."""
    section, unit = unit_of_heading(EXAMPLE.sub("", state.section).strip())
    unit = statement.unit or ("" if COUNTED.search(statement.label) else unit or state.unit)
    return replace(statement, section=section, unit=unit, example=marked or statement.example)
