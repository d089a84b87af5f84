"""Rows without a grid → statements: labels, sub-headings, section headings and column heads by position alone."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.vocabulary import has_cjk
from yellowiron.specs.layout.rows.cells import (
    ValueCell,
    add_continuation,
    cells_of,
    continues,
    heads_over,
    statement_of,
)
from yellowiron.specs.layout.rows.headings import (
    LARGER,
    Heading,
    bar_under,
    bars_of,
    body_size,
    inside,
    is_heading,
    is_title,
    labels_reach,
    names_no_columns,
)
from yellowiron.specs.layout.rows.lines import TextBlock, TextLine, bands
from yellowiron.specs.layout.rows.margin import Beside, parted_margin, without_keys
from yellowiron.specs.layout.rows.prose import paragraphs_of, read_paragraph
from yellowiron.specs.layout.rows.row_bands import INDENT, split_if_separate
from yellowiron.specs.layout.rows.two_line_rows import unfolded
from yellowiron.specs.layout.statement import (
    COUNTED,
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
    unit_of_heading,
    unit_said,
    words_beside_numbers,
)
from yellowiron.specs.pages.words import Page

_LONGEST_LABEL = 12
"""Words; more are prose."""


@dataclass
class ReaderState:
    """What the rows above say about the rows below."""

    section: str = ""
    unit: str = ""
    context: list[TextPiece] = field(default_factory=list)
    pending: list[TextPiece] = field(default_factory=list)
    heads: list[tuple[TextPiece, ...]] = field(default_factory=list)
    kept: list[tuple[TextPiece, ...]] = field(default_factory=list)
    data_since_heads: bool = False
    indented: bool = False
    values_in_row: int = 0
    headings: list[Heading] = field(default_factory=list)
    orphans: list[int] = field(default_factory=list)
    last: tuple[Sequence[TextLine], range, str] | None = None
    beside: Beside | None = None

    def open_section(self, heading: Heading, heads: tuple[TextPiece, ...]) -> None:
        """A heading ends what held above it; `heads` stand on its line."""
        if heads:
            self.kept = []
        elif self.heads and not self.data_since_heads and all(len(line) > 1 for line in self.heads):
            self.kept = list(self.heads)  # a table's own heads, above its first section
        self.section, self.unit = heading.text, ""
        self.headings.append(heading)
        self.context, self.pending, self.heads = [], [], [heads] if heads else list(self.kept)
        self.indented = self.data_since_heads = False

    def add_heads(self, heads: tuple[TextPiece, ...]) -> None:
        """A line of column heads: under the ones above it, or in their place where values stand between."""
        if self.heads == self.kept:
            self.heads, self.kept = [], []
        far = bool(self.heads) and heads[0].box[1] - self.heads[-1][0].box[3] > 2.5 * heads[0].size
        if self.data_since_heads or far:
            self.heads = []
            self.data_since_heads = False
        self.heads.append(heads)

    def add_label(self, piece: TextPiece) -> None:
        """Words alone at the left: a sub-heading if bold, else the beginning of the next row's label."""
        if piece.bold:
            self.context, self.pending, self.indented = [piece], [], False
        elif self.pending and not self.data_since_heads and _stacked(self.pending[-1], piece):
            self.pending = [*self.pending, piece]
        else:
            self.pending = [piece]
        if not self.heads:
            self.data_since_heads = False


def read_block(
    page: Page, block: TextBlock, first_row: int, section: str = ""
) -> tuple[list[Statement], list[Heading]]:
    """The statements of a column of text, and its headings. `first_row` numbers its rows."""
    state = ReaderState(section=section)
    found: list[Statement] = []
    size = body_size(w for line in block.lines for p in line.pieces for w in p.words)
    if not any(kind_of(p) == "value" for line in block.lines for p in line.pieces):
        size = min(size, body_size(page.words))  # headings alone
    paragraphs = paragraphs_of(block.lines)
    running = {piece for paragraph in paragraphs for line in paragraph for piece in line.pieces}
    kept = [tuple(p for p in line.pieces if p not in running) for line in block.lines]
    beside = {
        line.pieces[-1]: " ".join(p.text for p in rest)
        for line, rest in zip(block.lines, kept, strict=True)
        if len(rest) < len(line.pieces)
    }
    lines, margin = parted_margin(without_keys([TextLine(pieces) for pieces in kept if pieces]), page.rules)
    rows = unfolded([r for band in bands(lines, page.rules, bars_of(page, block), block.x0, block.x1)
                     for r in split_if_separate(band)])  # fmt: skip
    for index, row in enumerate(rows):
        _enter_margin(block, row, margin, state)
        if _continue_label(row, rows[index + 1] if index + 1 < len(rows) else None, state, found):
            continue
        before = len(found)
        ordered = sorted(row, key=lambda line: line.top)
        if len(row) == 2 and _captioned(ordered[:1], ordered[1:], ()):
            _read_captions(page, ordered[0], ordered[1], state, first_row + before + index, found)
            continue
        if index and _captioned(rows[index - 1], row, rows[index + 1 : index + 2]):
            above = _broken_caption(rows[:index])
            _read_captions(page, rows[index - 1][0], row[0], state, first_row + before + index, found, above)
            continue
        _read_row(page, block, row, state, size, first_row + len(found) + index, found)
        state.last = (row, range(before, len(found)), row[0].pieces[0].text) if len(found) > before else None
    for paragraph in paragraphs:
        headings = [h for h in state.headings if h.bottom <= paragraph[0].top + 2]
        heading = beside[paragraph[0].pieces[-1]] or (headings[-1].text if headings else section)
        found.extend(read_paragraph(page.number, paragraph, first_row + len(found) + len(block.lines), heading))
    return found, state.headings


def _enter_margin(block: TextBlock, row: Sequence[TextLine], margin: Sequence[Beside], state: ReaderState) -> None:
    """Makes what stands in the margin beside a row its section or, where it looks like a label, its sub-heading."""
    middle = (min(line.top for line in row) + max(line.bottom for line in row)) / 2
    beside = next((b for b in margin if b.top <= middle < b.bottom), None)
    if beside is state.beside:
        return
    state.beside = beside
    state.pending, state.indented = [], False
    if beside is None:
        state.context = []
    elif beside.heading:
        text = joined(p.text for p in beside.pieces)
        state.open_section(Heading(beside.top, block.x0, block.x1, text), ())
    else:
        state.context = list(beside.pieces)


def _read_row(
    page: Page,
    block: TextBlock,
    row: Sequence[TextLine],
    state: ReaderState,
    size: float,
    number: int,
    found: list[Statement],
) -> None:
    pieces = [p for line in row for p in line.pieces]
    kinds = [kind_of(p) for p in pieces]
    if _heads_a_section(page, pieces, kinds, size):
        heading = Heading(max(line.bottom for line in row), block.x0, block.x1, pieces[0].text)
        state.open_section(heading, tuple(pieces[1:]))
        return
    if "value" in kinds and _are_heads(pieces, kinds, state):
        state.heads.append(tuple(pieces))
        return
    if "value" not in kinds:
        inline = [s for p in pieces if (s := split_inline(p.bare))[0]]
        if len(inline) == len(pieces) > 1 and len({label for label, _ in inline}) == 1 and not state.pending:
            state.add_heads(tuple(pieces))  # "Arm 2.4 m   Arm 2.9 m" names columns
            return
        if not inline:
            for line in sorted(row, key=lambda one: one.top):
                if not _label_orphans(line, state, found):
                    _read_words(page, block, line, state, size)
            return
    state.orphans = []
    _read_values(page, row, state, number, found)
    state.data_since_heads = True


def _captioned(above: Sequence[TextLine], row: Sequence[TextLine], following: Sequence[Sequence[TextLine]]) -> bool:
    """Whether a line of values has a label right above each; where more values stand under them, the words above are
    columns' heads."""
    if len(above) != 1 or len(row) != 1 or len(above[0].pieces) != len(row[0].pieces):
        return False
    for label, value in zip(above[0].pieces, row[0].pieces, strict=True):
        near = abs(label.x0 - value.x0) < 2 and value.box[1] - label.box[3] < 0.8 * value.size
        if not near or kind_of(label) != "text" or kind_of(value) != "value" or label.size > 1.05 * value.size:
            return False
    return not (following and all(kind_of(p) == "value" for line in following[0] for p in line.pieces))


def _broken_caption(rows: Sequence[Sequence[TextLine]]) -> list[TextPiece]:
    """The lines of a label over its value that stand above the last one, set like it and close to it."""
    found: list[TextPiece] = []
    below = rows[-1][0].pieces[0]
    for row in reversed(rows[:-1]):
        piece = row[0].pieces[0]
        alike = abs(piece.x0 - below.x0) < 1 and piece.bold == below.bold and abs(piece.size - below.size) < 0.1
        close = 0 < below.box[1] - piece.box[3] < 0.45 * below.size
        if len(row) != 1 or len(row[0].pieces) != 1 or not alike or not close or kind_of(piece) != "text":
            break
        found.insert(0, piece)
        below = piece
    return found


def _read_captions(
    page: Page,
    labels: TextLine,
    values: TextLine,
    state: ReaderState,
    number: int,
    found: list[Statement],
    above: Sequence[TextPiece] = (),
) -> None:
    state.heads, state.pending, state.last = [], [], None
    lines = [*(TextLine((p,)) for p in above), labels, values]
    context = [p for p in state.context if p not in (*above, *labels.pieces)]
    for label, value in zip(labels.pieces, values.pieces, strict=True):
        cell = ValueCell([*above, label], [value])
        marked = any(EXAMPLE.search(text) for text in (state.section, label.text, value.text))
        statement = statement_of(page, lines, cell, (), context, (), number)
        found.append(_in_section(statement, state, marked=marked))


def _in_section(statement: Statement, state: ReaderState, *, marked: bool) -> Statement:
    section, unit = unit_of_heading(EXAMPLE.sub("", state.section).strip())
    unit = statement.unit or ("" if COUNTED.search(statement.label) else unit or state.unit)
    return replace(statement, section=section, unit=unit, example=marked or statement.example)


def _continue_label(
    row: Sequence[TextLine], following: Sequence[TextLine] | None, state: ReaderState, found: list[Statement]
) -> bool:
    """Gives a label whose value stands beside its first line the words under it: they are nearer to it than to the row
    below."""
    if state.last is None or len(row) != 1 or len(row[0].pieces) != 1:
        return False
    above, indices, first = state.last
    more, label = row[0].pieces[0], above[0].pieces[0]
    worded = kind_of(more) == "text" or bool(kind_of(more) == "value" and re.search(r"[^\W\d_]{3,}", more.text))
    plain = worded and kind_of(label) == "text" and not (more.bold and not label.bold)
    up = row[0].bottom - above[-1].bottom
    down = min(line.bottom for line in following) - row[0].bottom if following else float("inf")
    same = (
        abs(more.x0 - label.x0) < 1.5
        and abs(more.size - label.size) < 0.1
        and more.x1 < min(found[i].x0 for i in indices)
    )
    if not (plain and same and 0 < up < 1.6 * more.size and up < 0.88 * down and len(above) == 1):
        return False
    own = [i for i in indices if found[i].label and found[i].quote.startswith(first)]
    for index in own:
        statement = found[index]
        words, unit = unit_in_label(joined([statement.label, more.bare]))
        rest = statement.quote.removeprefix(first).removeprefix(" … ").strip()
        quote = " … ".join(part for part in (first, rest, more.text) if part)
        found[index] = replace(statement, label=words, unit=statement.unit or unit, quote=quote)
    if own:
        state.last = (row, indices, first)
    return bool(own)


def _label_orphans(line: TextLine, state: ReaderState, found: list[Statement]) -> bool:
    """Gives values without any label the words right beneath them: a card with a big number over its name."""
    orphans, state.orphans = state.orphans, []
    if not orphans or len(line.pieces) != len(orphans):
        return False
    for index, piece in zip(orphans, line.pieces, strict=True):
        box = found[index].box
        height = box[3] - box[1]
        overlaps = piece.x0 < box[2] and box[0] < piece.x1
        if kind_of(piece) != "text" or not overlaps or piece.box[1] - box[3] > height or piece.size > 0.85 * height:
            return False
    for index, piece in zip(orphans, line.pieces, strict=True):
        statement = found[index]
        label, unit = unit_in_label(piece.bare)
        found[index] = replace(
            statement,
            label=label,
            context=(),
            unit=statement.unit or unit,
            quote=f"{statement.text} … {piece.text}",
            example=statement.example or bool(EXAMPLE.search(piece.text)),
        )
    return True


def _heads_a_section(page: Page, pieces: Sequence[TextPiece], kinds: Sequence[str], size: float) -> bool:
    """Whether a row on a heading's bar names the section and its columns by numbers: "Dimensions   2.5-m arm   3-m
    arm"."""
    if len(pieces) < 3 or kinds[0] != "text" or not set(kinds[1:]) <= {"value"} or not all(p.bold for p in pieces):
        return False
    named = all(words_beside_numbers(p.bare, read(p.bare)) for p in pieces[1:])
    return named and bar_under(page, pieces[0], size) is not None


def _are_heads(pieces: Sequence[TextPiece], kinds: Sequence[str], state: ReaderState) -> bool:
    """Whether a row without a label names columns by numbers: "3.4-m arm   3.9-m arm" above their values."""
    if state.data_since_heads or state.pending or len(pieces) < 2 or "text" in kinds:
        return False
    return all(words_beside_numbers(p.bare, read(p.bare)) for p in pieces)


# ---- rows without a value ------------------------------------------------------------------------------------------


def _read_words(page: Page, block: TextBlock, line: TextLine, state: ReaderState, size: float) -> None:
    """A heading, column heads, a sub-heading, or the first line of a label."""
    texts = [q for p in line.pieces if kind_of(p) != "mark" for q in _parted(p)]
    if not texts:
        if state.heads and not state.data_since_heads:
            state.heads.append(line.pieces)
        return
    labels_end = block.x0 + 0.12 * (block.x1 - block.x0) + 4
    if len(texts) == 1 and (unit := unit_said(texts[0].bare)):
        state.unit = unit
        return
    at_label = texts[0].x0 < labels_end
    if at_label and not texts[0].bold and names_no_columns([p.bare for p in texts]):
        state.pending = []
        return
    if len(texts) == 1 == len(line.pieces) and texts[0].size > LARGER * size and texts[0].x0 < labels_reach(block):
        at_label = True  # a heading in the middle
    bar = bar_under(page, texts[0], size) if at_label or len(texts) < 2 else None
    if bar is not None or (len(texts) == 1 and at_label and is_heading(texts[0], size)):
        on_bar = [p.text for p in line.pieces if kind_of(p) != "mark" and (bar is None or inside(p.box, bar))]
        heads = tuple(p for p in texts[1:] if not unit_said(p.bare))
        unit = next((u for p in texts[1:] if (u := unit_said(p.bare))), "")
        section = texts[0].text if heads or unit else " ".join(on_bar)
        section += f" ({unit})" if unit else ""
        state.open_section(Heading(line.bottom, block.x0, block.x1, section), heads)
    elif len(texts) == 2 and at_label and is_title(texts[0], size) and (unit := is_unit(texts[1].bare)):
        words = f"{texts[0].text} {unit.replace('|', ' (')})" if "|" in unit else f"{texts[0].text} ({unit})"
        state.open_section(Heading(line.bottom, block.x0, block.x1, words), ())
    elif _are_column_heads(texts, labels_end, state):
        state.add_heads(tuple(texts))
        if at_label and not is_unit(texts[0].bare):
            state.pending = []
    elif at_label and len(texts) == 1 and not _is_prose(texts[0]):
        state.add_label(texts[0])
    else:
        state.pending = []


def _parted(piece: TextPiece) -> list[TextPiece]:
    """Heads that nearly touch, parted behind their units: "bore (mm) stroke (mm)"."""
    ends = [i for i, w in enumerate(piece.words[:-1], start=1) if w.text[0] == "(" and is_unit(w.text)]
    if not ends or not is_unit(piece.words[-1].text):
        return [piece]
    return [TextPiece(piece.words[a:b]) for a, b in zip([0, *ends], [*ends, len(piece.words)], strict=True)]


def _are_column_heads(texts: Sequence[TextPiece], labels_end: float, state: ReaderState) -> bool:
    """Whether a line of words names columns: units alone, several words over the values, or emphasis."""
    over_values = [p for p in texts if p.x0 >= labels_end]
    bold = all(p.bold for p in texts)
    if all(is_unit(p.bare) for p in texts) or len(over_values) >= 2:
        return True
    if len(over_values) == len(texts):
        return bold or not state.pending
    return len(texts) == 2 and bold


def _is_prose(piece: TextPiece) -> bool:
    return len(piece.words) > _LONGEST_LABEL or (piece.text.endswith(".") and len(piece.words) > 3)


def _stacked(a: TextPiece, b: TextPiece) -> bool:
    return abs(a.x0 - b.x0) < 2 * a.size and 0 < b.box[1] - a.box[3] < 0.9 * a.size


# ---- rows with values ----------------------------------------------------------------------------------------------


def _read_values(page: Page, row: Sequence[TextLine], state: ReaderState, number: int, found: list[Statement]) -> None:
    cells = [c for c in cells_of(row) if sum(len(p.words) for p in c.label) <= _LONGEST_LABEL]
    if not cells:
        return
    pending, state.pending = state.pending, []
    if pending and cells[0].label and _broken(pending[-1], cells[0].label[0]):
        cells = [replace(c, label=[pending[-1], *c.label]) if c.label is cells[0].label else c for c in cells]
        pending = pending[:-1]
    has_label = any(c.label for c in cells)
    if not has_label and not pending and found and continues(found, cells):
        add_continuation(found, cells)
        return
    _end_heads(row, cells, state)
    _keep_sub_heading(cells, pending, state)
    context = [*state.context, *(p for p in pending if p not in state.context)]
    marked = bool(EXAMPLE.search(state.section)) or any(
        EXAMPLE.search(p.text) for p in [*context, *(q for c in cells for q in [*c.notes, *c.label, *c.values])]
    )
    for cell in cells:
        heads = heads_over(state.heads, join_boxes(p.box for p in cell.values), alone=len(cells) == 1)
        above = context if not cell.label or pending else []
        statement = statement_of(page, row, cell, heads, context, above, number)
        found.append(_in_section(statement, state, marked=marked))
    if not has_label:
        # A value under a label on a line of its own, its partner beneath: "25,510 kg" / "56,240 lb".
        state.pending = pending
        if not pending and not state.heads:
            state.orphans = list(range(len(found) - len(cells), len(found)))


def _broken(above: TextPiece, label: TextPiece) -> bool:
    """Whether a label of a script without spaces is broken over two lines, perhaps within a word."""
    return _stacked(above, label) and abs(above.x0 - label.x0) < 1 and has_cjk(above.text)


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
