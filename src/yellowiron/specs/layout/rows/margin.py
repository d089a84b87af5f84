"""What stands beside the rows of a column of text and is none of their labels: keys of drawings, headings in the
margin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from yellowiron.specs.layout.rows.lines import TextLine
from yellowiron.specs.layout.statement import TextPiece, ascending, is_key, is_unit, kind_of
from yellowiron.specs.pages.strokes import DrawnRule

_LEVEL = 2.0
"""Points within which the left edges of labels lie."""
_FEWEST = 4
"""Rows that a margin stands beside at least."""


@dataclass(frozen=True)
class Beside:
    """Words in the margin that hold for the rows from `top` to `bottom`; `heading`: set apart from the labels."""

    top: float
    bottom: float
    pieces: tuple[TextPiece, ...]
    heading: bool


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


def parted_margin(lines: Sequence[TextLine], rules: Sequence[DrawnRule]) -> tuple[list[TextLine], list[Beside]]:
    """The lines without what stands in the margin beside their labels, and that, from top to bottom.

    A margin: left of where nearly all rows with values begin their labels, level with some of them and empty beside
    others. Its words hold from rule to rule where rules part the groups, else from their own height to the next.
    """
    found = _margin(lines)
    if found is None:
        return list(lines), []
    start, first, last = found
    own = [p for line in lines[first:last] for p in line.pieces if p.x0 < start - _LEVEL]
    left = min(p.x0 for p in own)
    top, bottom = lines[first].top, lines[last - 1].bottom
    across = sorted(r.top for r in rules if r.horizontal and r.x0 <= left + 4 and r.x1 >= start + 4)
    groups = _groups(own, across)
    edges = [y for y in across if top - 12 <= y <= bottom + 12]
    labels = [p for line in lines[first:last] for p in line.pieces if abs(p.x0 - start) <= _LEVEL]
    beside = [
        Beside(above, below, tuple(group), _is_set_apart(group, labels))
        for group, (above, below) in zip(groups, _extents(groups, edges, top, bottom), strict=True)
    ]
    inner = [tuple(p for p in line.pieces if p.x0 >= start - _LEVEL) for line in lines[first:last]]
    return [*lines[:first], *(TextLine(pieces) for pieces in inner if pieces), *lines[last:]], beside


def _groups(pieces: Sequence[TextPiece], across: Sequence[float]) -> list[list[TextPiece]]:
    """The pieces of a margin that stand close to each other, in one weight, with no rule `across` between them."""
    groups: list[list[TextPiece]] = []
    for piece in pieces:
        before = groups[-1][-1] if groups else None
        near = before is not None and piece.box[1] - before.box[3] < 0.7 * piece.size and before.bold == piece.bold
        if before is not None and near and not any(before.box[3] - 2 <= y <= piece.box[1] + 2 for y in across):
            groups[-1].append(piece)
        else:
            groups.append([piece])
    return groups


def _extents(
    groups: Sequence[Sequence[TextPiece]], edges: Sequence[float], top: float, bottom: float
) -> list[tuple[float, float]]:
    """From where to where each group of a margin holds: between its rules where each group has its own, else to the
    next one."""
    places = [_cell_of(g, edges) for g in groups]
    if edges and all(places.count(place) == 1 for place in places):
        return [(max(above, top - 1), min(below, bottom + 1)) for above, below in places]
    begins = [g[0].box[1] - 0.5 * g[0].size for g in groups]
    ends = [after[0].box[1] - 0.5 * g[0].size for g, after in pairwise(groups)]
    return list(zip(begins, [*ends, bottom + 1], strict=True))


def _is_set_apart(group: Sequence[TextPiece], labels: Sequence[TextPiece]) -> bool:
    """Whether words in the margin stand out from the labels: a heading."""
    marked = all(p.bold or p.size > 1.1 * max(q.size for q in labels) for p in group)
    return marked and not all(p.bold for p in labels)


def _cell_of(group: Sequence[TextPiece], edges: Sequence[float]) -> tuple[float, float]:
    """The rules above and below some words."""
    middle = (group[0].box[1] + group[-1].box[3]) / 2
    above = max((y for y in edges if y < middle), default=float("-inf"))
    return above, min((y for y in edges if y >= middle), default=float("inf"))


def _margin(lines: Sequence[TextLine]) -> tuple[float, int, int] | None:
    """Where labels begin right of a margin, and the range of lines that have it; None if there is no margin."""
    starts: dict[int, int] = {}
    for line in lines:
        for piece, after in zip(line.pieces, line.pieces[1:], strict=False):
            if kind_of(piece) == "text" and kind_of(after) in ("value", "unit"):
                starts[round(piece.x0)] = starts.get(round(piece.x0), 0) + 1
    for start in sorted(starts, key=lambda x: (-starts[x], x))[:2]:
        best = _run(lines, float(start))
        if best is not None:
            return float(start), *best
    return None


def _run(lines: Sequence[TextLine], start: float) -> tuple[int, int] | None:
    """The first run of lines in which every row with a value begins its label at `start` and only words stand left of
    that, level with some of the labels, absent beside at least as many."""
    first = 0
    while first < len(lines):
        last = first
        while last < len(lines) and _fits(lines[last], start):
            last += 1
        while last > first and not _at(lines[last - 1], start):
            last -= 1
        rows = [line for line in lines[first:last] if _at(line, start) and _has_value(line)]
        level = [line for line in rows if line.x0 < start - _LEVEL]
        alone = [line for line in lines[first:last] if not _at(line, start)]
        if len(rows) >= _FEWEST and level and len(rows) - len(level) >= len(level) and len(alone) <= 2 * len(level):
            while not _at(lines[first], start):
                first += 1
            return first, last
        first = max(last, first) + 1
    return None


def _fits(line: TextLine, start: float) -> bool:
    left = [p for p in line.pieces if p.x0 < start - _LEVEL]
    if any(kind_of(p) != "text" or p.x1 > start - 2 for p in left) or len(left) > 1:
        return False
    return _at(line, start) or not _has_value(line)


def _at(line: TextLine, start: float) -> bool:
    return any(abs(p.x0 - start) <= _LEVEL and kind_of(p) == "text" for p in line.pieces)


def _has_value(line: TextLine) -> bool:
    return any(kind_of(p) == "value" for p in line.pieces)
