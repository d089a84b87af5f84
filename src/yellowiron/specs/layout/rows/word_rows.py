"""Rows without a value: headings, column heads, sub-headings, the first lines of labels."""

from __future__ import annotations

from collections.abc import Sequence

from yellowiron.specs.language.vocabulary import CIRCUITS, names_a_part, tokens
from yellowiron.specs.layout.rows.headings import (
    Heading,
    bar_under,
    inside,
    is_heading,
    is_title,
    labels_reach,
    names_no_columns,
)
from yellowiron.specs.layout.rows.lines import TextLine
from yellowiron.specs.layout.rows.reader_state import ReaderState, stacked
from yellowiron.specs.layout.statement import TextPiece, is_unit, kind_of, unit_of_heading, unit_said
from yellowiron.specs.layout.tolerances import LARGER, LONGEST_LABEL


def read_words(line: TextLine, state: ReaderState) -> None:
    """Reads a line without a value: a heading, column heads, a sub-heading, or the first line of a label."""
    texts = [q for p in line.pieces if kind_of(p) != "mark" for q in _parted(p)]
    above, state.worded = state.worded, ()
    if not texts:
        if state.heads and not state.data_since_heads:
            state.heads.append(line.pieces)
        return
    if len(texts) == 1 and (unit := unit_said(texts[0].bare)):
        state.unit = unit
        return
    at_label = texts[0].x0 < state.labels_end
    if at_label and not texts[0].bold and names_no_columns([p.bare for p in texts]):
        state.pending = []
        return
    if len(texts) == 1 == len(line.pieces) and _is_larger_over_labels(texts[0], state):
        at_label = True  # a heading in the middle
    if len(texts) == 1 and len(above) == 2 and not at_label and stacked(above[1], texts[0]):
        state.worded = (above[0], texts[0])  # what is said of it goes on
        return
    heading = _on_bar_or_large(state, line, texts, at_label=at_label)
    heading = heading or (_titled_with_unit(state, line, texts) if at_label else None)
    if heading is not None:
        state.open_section(*heading)
    elif _are_column_heads(texts, state):
        titled = at_label or ":" in texts[0].bare  # "Dimensions: mm   Model"
        unit = unit_of_heading(texts[0].bare)[1] if titled and len(texts) > 1 else ""
        state.unit = unit or ("" if state.data_since_heads else state.unit)
        state.add_heads(tuple(texts))
        if at_label and not is_unit(texts[0].bare):
            state.pending = []
            state.corner = texts[0] if len(texts) > 2 and names_a_part(texts[0].bare) else state.corner
            if sum(head[0].x0 < state.labels_end for head in state.heads) > 1:
                state.corner = None  # "Stick   R3.9 m   R3.2 m" over "Bucket   GD   SD": each names its line of heads
    elif at_label and len(texts) == 1 and not _is_prose(texts[0]):
        state.add_label(texts[0])
    else:
        state.pending = []
        if at_label and len(texts) == 2:
            # "Pump type – implements", "Pump type – steering": rows of one kind open no part of the table
            alike = above and tokens(above[0].bare)[:1] == tokens(texts[0].bare)[:1]
            state.circuit = texts[0] if CIRCUITS & set(tokens(texts[0].bare)) and not alike else None
            state.worded = tuple(texts)


def _is_larger_over_labels(piece: TextPiece, state: ReaderState) -> bool:
    """Whether words alone on their line are set larger than the rows, and begin over their labels or stand in the
    middle of the page."""
    centred = abs((piece.x0 + piece.x1) / 2 - state.page.width / 2) < 0.01 * state.page.width
    return piece.size > LARGER * state.size and (piece.x0 < labels_reach(state.block) or centred)


_Section = tuple[Heading, tuple[TextPiece, ...]]
"""A section's heading, and the column heads on its line."""


def _on_bar_or_large(
    state: ReaderState, line: TextLine, texts: Sequence[TextPiece], *, at_label: bool
) -> _Section | None:
    """The section that a line opens which is printed on a filled bar or set like a heading."""
    bar = bar_under(state.page, texts[0], state.size) if at_label or len(texts) < 2 else None
    if bar is None and not (len(texts) == 1 and at_label and is_heading(texts[0], state.size)):
        return None
    on_bar = [p.text for p in line.pieces if kind_of(p) != "mark" and (bar is None or inside(p.box, bar))]
    heads = tuple(p for p in texts[1:] if not unit_said(p.bare))
    unit = next((u for p in texts[1:] if (u := unit_said(p.bare))), "")
    section = texts[0].text if heads or unit else " ".join(on_bar)
    return state.heading(line.bottom, f"{section} ({unit})" if unit else section), heads


def _titled_with_unit(state: ReaderState, line: TextLine, texts: Sequence[TextPiece]) -> _Section | None:
    """The section that a title opens which has the unit of its rows' numbers at the end of its line."""
    if len(texts) != 2 or not is_title(texts[0], state.size) or not (unit := is_unit(texts[1].bare)):
        return None
    words = f"{texts[0].text} {unit.replace('|', ' (')})" if "|" in unit else f"{texts[0].text} ({unit})"
    return state.heading(line.bottom, words), ()


def _parted(piece: TextPiece) -> list[TextPiece]:
    """Heads that nearly touch, parted behind their units: "bore (mm) stroke (mm)"."""
    ends = [i for i, w in enumerate(piece.words[:-1], start=1) if w.text[0] == "(" and is_unit(w.text)]
    if not ends or not is_unit(piece.words[-1].text):
        return [piece]
    return [TextPiece(piece.words[a:b]) for a, b in zip([0, *ends], [*ends, len(piece.words)], strict=True)]


def _are_column_heads(texts: Sequence[TextPiece], state: ReaderState) -> bool:
    """Whether a line of words names columns: units alone, several words over the values, or emphasis."""
    if len(texts) == 2 and texts[1].x0 - texts[0].x1 < 0.5 * texts[0].size:
        return False  # "Transmission|HY": a name and what is said of it, parted by no more than a space
    over_values = [p for p in texts if p.x0 >= state.labels_end]
    bold = all(p.bold for p in texts)
    if all(is_unit(p.bare) for p in texts) or len(over_values) >= 2:
        return True
    if len(over_values) == len(texts):
        return bold or not state.pending
    return len(texts) == 2 and bold


def _is_prose(piece: TextPiece) -> bool:
    return len(piece.words) > LONGEST_LABEL or (piece.text.endswith(".") and len(piece.words) > 3)
