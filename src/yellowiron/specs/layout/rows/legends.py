"""The keys of drawings: a legend, "A  Height to hinge pin", with the values in a table headed by its letters alone, and
keys that stand beside the rows and are none of their labels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from yellowiron.specs.language.numbers import read
from yellowiron.specs.layout.rows.lines import TextLine, lines_of
from yellowiron.specs.layout.statement import Statement, TextPiece, ascending, is_key, is_unit, kind_of
from yellowiron.specs.pages.words import Page, Word

_FEWEST = 4
"""Keys of a legend."""


@dataclass(frozen=True)
class KeyLegend:
    """The words of each key, by the height at which their legend begins, and the words that print the legends."""

    parts: tuple[tuple[float, Mapping[str, str]], ...]
    words: frozenset[Word]

    def label(self, piece: TextPiece) -> str:
        """What a key stands for: in the nearest legend that begins above it, or in the only one of the page."""
        above = [labels for top, labels in self.parts if top < piece.box[1] or len(self.parts) == 1]
        return above[-1].get(_key_of(piece), "") if above and _is_letter(piece) else ""


_NONE = KeyLegend((), frozenset())
_Entry = tuple[TextPiece, TextPiece]


def key_legend(lines: Sequence[TextLine]) -> KeyLegend:
    """The legends of a page: keys, no two alike in one legend, each right before words without a value of their own.
    Most of the keys stand once more, alone."""
    groups: list[list[_Entry]] = []
    alone: set[str] = set()
    for line in lines:
        entries = [e for i in range(len(line.pieces)) if (e := _entry(line.pieces, i)) is not None]
        alone.update(_key_of(p) for i, p in enumerate(line.pieces) if _is_letter(p) and _stands_alone(line.pieces, i))
        if entries and groups and line.top - groups[-1][-1][1].box[3] < 3 * entries[0][1].size:
            groups[-1].extend(entries)
        elif entries:
            groups.append(entries)
    groups = [g for g in groups if _is_legend([_key_of(key) for key, _ in g], alone)]
    if not groups:
        return _NONE
    parts = tuple((min(k.box[1] for k, _ in g), {_key_of(k): words.bare for k, words in g}) for g in groups)
    return KeyLegend(parts, frozenset(w for g in groups for entry in g for part in entry for w in part.words))


def _is_legend(keys: Sequence[str], alone: set[str]) -> bool:
    named = sum(k in alone for k in keys)
    return len(set(keys)) == len(keys) and named >= _FEWEST and named >= 0.6 * len(keys)


def _entry(pieces: Sequence[TextPiece], index: int) -> _Entry | None:
    """A key and its words; None where a value follows them."""
    if index + 1 >= len(pieces) or not _is_letter(pieces[index]) or kind_of(pieces[index + 1]) != "text":
        return None
    words = pieces[index + 1]
    if _is_letter(words) or any(q.dimension != "angle" for r in read(words.bare) for q in r.numbers):
        return None
    for number, piece in enumerate(pieces[index + 2 :], start=index + 3):
        if is_unit(piece.bare) and any(kind_of(p) == "value" for p in pieces[number : number + 1]):
            return None  # "B  Width  m  3.91": a metre, no key
        if _is_letter(piece):
            break
        if kind_of(piece) != "text":
            return None
    return pieces[index], words


def _is_letter(piece: TextPiece) -> bool:
    return is_key(piece.bare) and not piece.bare.strip("()")[:1].isdigit()


def _key_of(piece: TextPiece) -> str:
    return piece.bare.strip("().:")


def _stands_alone(pieces: Sequence[TextPiece], index: int) -> bool:
    """Whether a key heads a column among others, or a value follows it."""
    following = pieces[index + 1 : index + 2]
    return not following or _is_letter(following[0]) or kind_of(following[0]) == "value"


def spelled(page: Page, legend: KeyLegend) -> Page:
    """The page without its legend, whose words stand in the place of the keys that are alone."""
    if not legend.parts:
        return page
    words: list[Word] = []
    for line in lines_of([w for w in page.words if w not in legend.words]):
        for index, piece in enumerate(line.pieces):
            label = legend.label(piece)
            if label and _stands_alone(line.pieces, index):
                words.append(replace(piece.words[0], text=label, x1=piece.x1))
            else:
                words.extend(piece.words)
    return replace(page, words=tuple(words))


def labelled(statements: Sequence[Statement], legend: KeyLegend) -> list[Statement]:
    """The statements whose only name is a key's, with it as their label."""
    names = {label for _, labels in legend.parts for label in labels.values()}
    return [_labelled(s, names) for s in statements] if names else list(statements)


def _labelled(statement: Statement, names: set[str]) -> Statement:
    own = [c for c in statement.column if c in names]
    if len(own) != 1 or (statement.label and not is_unit(statement.label)):
        return statement
    return replace(statement, label=own[0], column=tuple(c for c in statement.column if c != own[0]), variant=())


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
