"""Rows without a grid → statements: labels, sub-headings, section headings and column heads by position alone."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from yellowiron.specs.language.numbers import read
from yellowiron.specs.layout.rows.cells import ValueCell, statement_of
from yellowiron.specs.layout.rows.headings import Heading, bar_under, bars_of, body_size
from yellowiron.specs.layout.rows.legends import without_keys
from yellowiron.specs.layout.rows.lines import TextBlock, TextLine, bands
from yellowiron.specs.layout.rows.prose import paragraphs_of, read_paragraph
from yellowiron.specs.layout.rows.reader_state import ReaderState
from yellowiron.specs.layout.rows.row_bands import broken_in_two, split_if_separate, unfolded
from yellowiron.specs.layout.rows.value_rows import in_section, read_values
from yellowiron.specs.layout.rows.word_rows import read_words
from yellowiron.specs.layout.statement import (
    EXAMPLE,
    Statement,
    TextPiece,
    is_key,
    joined,
    kind_of,
    split_inline,
    unit_in_label,
    words_beside_numbers,
)
from yellowiron.specs.pages.words import Page


def read_block(
    page: Page, block: TextBlock, first_row: int, section: str = ""
) -> tuple[list[Statement], list[Heading]]:
    """The statements of a column of text, and its headings. `first_row` numbers its rows."""
    state = ReaderState(page, block, _type_size(page, block), section=section)
    paragraphs = paragraphs_of(block.lines)
    kept, beside = _without_paragraphs(block, paragraphs)
    lines = bands(without_keys(kept), page.rules, bars_of(page, block), block.x0, block.x1)
    rows = unfolded(broken_in_two([row for band in lines for row in split_if_separate(band)]))
    for index in range(len(rows)):
        _read_nth_row(rows, index, state, first_row)
    found = state.found
    for paragraph in paragraphs:
        headings = [h for h in state.headings if h.bottom <= paragraph[0].top + 2]
        heading = beside[paragraph[0].pieces[-1]] or (headings[-1].text if headings else section)
        found.extend(read_paragraph(page.number, paragraph, first_row + len(found) + len(block.lines), heading))
    return found, state.headings


def _type_size(page: Page, block: TextBlock) -> float:
    size = body_size(w for line in block.lines for p in line.pieces for w in p.words)
    if not any(kind_of(p) == "value" for line in block.lines for p in line.pieces):
        size = min(size, body_size(page.words))  # headings alone
    return size


def _without_paragraphs(
    block: TextBlock, paragraphs: Sequence[Sequence[TextLine]]
) -> tuple[list[TextLine], dict[TextPiece, str]]:
    """A block's lines without its running text; and, for each line of that, the words that stand beside it."""
    running = {piece for paragraph in paragraphs for line in paragraph for piece in line.pieces}
    kept = [tuple(p for p in line.pieces if p not in running) for line in block.lines]
    beside = {
        line.pieces[-1]: " ".join(p.text for p in rest)
        for line, rest in zip(block.lines, kept, strict=True)
        if len(rest) < len(line.pieces)
    }
    return [TextLine(pieces) for pieces in kept if pieces], beside


def _read_nth_row(rows: Sequence[Sequence[TextLine]], index: int, state: ReaderState, first_row: int) -> None:
    """Reads a row: more of the label above, labels over their values, or labels beside them."""
    row, following = rows[index], rows[index + 1 : index + 2]
    if _continue_label(row, following[0] if following else None, state):
        return
    before = len(state.found)
    number = first_row + before + index
    state.nearer = bool(index and following) and _between(rows[index - 1], row) < _between(row, following[0])
    ordered = sorted(row, key=lambda line: line.top)
    if len(row) == 2 and _captioned(ordered[:1], ordered[1:], ()):
        _read_captions(ordered[0], ordered[1], state, number)
    elif index and rows[index - 1][0] is not state.given and _captioned(rows[index - 1], row, following):
        _read_captions(rows[index - 1][0], row[0], state, number, _broken_caption(rows[:index]))
    else:
        _read_row(row, state, number)
        after = len(state.found)
        state.last = (row, range(before, after), row[0].pieces[0].text) if after > before else None


def _between(above: Sequence[TextLine], below: Sequence[TextLine]) -> float:
    return min(line.top for line in below) - max(line.bottom for line in above)


def _read_row(row: Sequence[TextLine], state: ReaderState, number: int) -> None:
    pieces = [p for line in row for p in line.pieces]
    kinds = ["text"] * len(pieces) if _are_designations(pieces) else [kind_of(p) for p in pieces]
    if _heads_a_section(state, pieces, kinds):
        state.open_section(state.heading(max(line.bottom for line in row), pieces[0].text), tuple(pieces[1:]))
        return
    ordered = sorted(row, key=lambda line: line.top)
    if len(row) > 1 and _are_names(ordered):
        for line in ordered:
            state.add_heads(line.pieces)
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
                if not _label_orphans(line, state):
                    read_words(line, state)
            return
    state.orphans = []
    read_values(row, state, number)
    state.data_since_heads = True


_DESIGNATION = re.compile(r"\d{1,3}(?:\s[A-Z]{1,4})+")


def _are_designations(pieces: Sequence[TextPiece]) -> bool:
    """Whether a row names columns by numbers with letters: "Blade   8 SU   8 U   8 SU LGP"; "24 V" is no name."""
    names = [p.bare for p in pieces[1:] if _DESIGNATION.fullmatch(p.bare)]
    return 1 < len(names) == len(pieces) - 1 and any(re.search(r"[A-Z]{2}", name) for name in names)


def _are_names(lines: Sequence[TextLine]) -> bool:
    """Whether bold lines name columns, each by its name and what stands under it: "Stick   R3.9   R3.2" over
    "(12'10\")   (10'6\")", "Bucket   GP 1.19 m3   GP 1.19 m3" over "with coupler" under the second."""
    (first, *over), under = lines[0].pieces, [line.pieces for line in lines[1:]]
    bold = all(p.bold for line in lines for p in line.pieces)
    named = all(kind_of(n) != "value" or words_beside_numbers(n.bare, read(n.bare)) for n in over)
    return bold and named and kind_of(first) == "text" and len(over) == len(under[0]) > 1 and all(
        any(n.x0 < p.x1 and p.x0 < n.x1 for n in over) for line in under for p in line
    ) and all(kind_of(p) == "value" for p in under[0])  # fmt: skip


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
    labels: TextLine, values: TextLine, state: ReaderState, number: int, above: Sequence[TextPiece] = ()
) -> None:
    state.heads, state.pending, state.last = [], [], None
    lines = [*(TextLine((p,)) for p in above), labels, values]
    context = [p for p in state.context if p not in (*above, *labels.pieces)]
    for label, value in zip(labels.pieces, values.pieces, strict=True):
        cell = ValueCell([*above, label], [value])
        marked = any(EXAMPLE.search(text) for text in (state.section, label.text, value.text))
        statement = statement_of(state.page, lines, cell, (), context, (), number)
        state.found.append(in_section(statement, state, marked=marked))


def _continue_label(row: Sequence[TextLine], following: Sequence[TextLine] | None, state: ReaderState) -> bool:
    """Gives a label whose value stands beside its first line the words under it: they are nearer to it than to the row
    below."""
    if state.last is None or len(row) != 1 or len(row[0].pieces) != 1:
        return False
    (above, indices, first), found = state.last, state.found
    more, label = row[0].pieces[0], above[0].pieces[0]
    worded = kind_of(more) == "text" or bool(kind_of(more) == "value" and re.search(r"[^\W\d_]{3,}", more.text))
    plain = worded and kind_of(label) == "text" and not (more.bold and not label.bold)
    up = row[0].bottom - above[-1].bottom
    down = min(line.bottom for line in following) - row[0].bottom if following else float("inf")
    same = (
        abs(more.x0 - (label.x0 if more.text.startswith("(") else _behind_key(label, more.x0))) < 1.5
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


def _behind_key(label: TextPiece, x0: float) -> float:
    """Where a label begins, or its words behind the key of its drawing, whichever is nearer: "5 Maximum depth cut for"
    over "  2240 mm level bottom"."""
    words = label.words[: 2 if is_key(label.words[0].text) else 1]
    return min((w.x0 for w in words), key=lambda begin: abs(begin - x0))


def _label_orphans(line: TextLine, state: ReaderState) -> bool:
    """Gives values without any label the words right beneath them: a card with a big number over its name, or what is
    nearer to them than to the next row."""
    orphans, state.orphans, found = state.orphans, [], state.found
    if not orphans or len(line.pieces) != len(orphans):
        return False
    for index, piece in zip(orphans, line.pieces, strict=True):
        box = found[index].box
        height = box[3] - box[1]
        overlaps = piece.x0 < box[2] and box[0] < piece.x1
        small = piece.size <= 0.85 * height or state.nearer
        if kind_of(piece) != "text" or not overlaps or piece.box[1] - box[3] > height or not small:
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
    state.given = line
    return True


def _heads_a_section(state: ReaderState, pieces: Sequence[TextPiece], kinds: Sequence[str]) -> bool:
    """Whether a row on a heading's bar names the section and its columns by numbers: "Dimensions   2.5-m arm   3-m
    arm"."""
    if len(pieces) < 3 or kinds[0] != "text" or not set(kinds[1:]) <= {"value"} or not all(p.bold for p in pieces):
        return False
    named = all(words_beside_numbers(p.bare, read(p.bare)) for p in pieces[1:])
    return named and bar_under(state.page, pieces[0], state.size) is not None


def _are_heads(pieces: Sequence[TextPiece], kinds: Sequence[str], state: ReaderState) -> bool:
    """Whether a row without a label names columns by numbers: "3.4-m arm   3.9-m arm" above their values."""
    if state.data_since_heads or state.pending or len(pieces) < 2 or "text" in kinds:
        return False
    return all(words_beside_numbers(p.bare, read(p.bare)) for p in pieces)
