"""Which lines are a row: what stands between two rules, and labels that are folded over their values."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.quantities import same
from yellowiron.specs.layout.rows.cells import ValueCell, cells_of
from yellowiron.specs.layout.rows.lines import TextLine
from yellowiron.specs.layout.statement import TextPiece, kind_of, unit_in_label, words_beside_numbers
from yellowiron.specs.layout.tolerances import INDENT, LARGER


def split_if_separate(row: Sequence[TextLine]) -> Iterator[Sequence[TextLine]]:
    """A band that holds several labelled values of its own is several rows; a heading over a row is none of it."""
    ordered = sorted(row, key=lambda line: line.top)
    first, rest = ordered[0], ordered[1:]
    last, before = ordered[-1], ordered[:-1]
    if rest and (_is_heading_over(first, rest) or _are_units_over(first, rest)):
        yield (first,)
        yield from split_if_separate(rest)
    elif len(rest) == 1 and _are_heads_of(first, rest[0]):
        yield (first,)
        yield (rest[0],)
    elif before and _is_heading_under(last, before):
        yield from split_if_separate(before)
        yield (last,)
    elif rest and _is_labelled(first) and _reaches_past(rest[0], first):
        yield (first,)  # what the lines under it say of the value is none of the label, and no row
    elif (sum(map(_is_labelled, row)) >= 2 or _are_rows(ordered)) and not _in_two_systems(ordered):
        for line in row:
            yield (line,)
    else:
        yield row


def _is_heading_over(first: TextLine, rest: Sequence[TextLine]) -> bool:
    """Whether the first line is words alone that stand out over the lines under it: larger than all of them, or a bold
    sub-heading from which the first of them is indented."""
    if len(_words(first)) != 1 or kind_of(first.pieces[0]) != "text":
        return False
    if _is_larger(first, rest) and first.bottom <= min(line.top for line in rest) + 1:
        return True
    under = min(rest, key=lambda line: line.top)
    stands_out = first.pieces[0].bold and not under.pieces[0].bold and under.x0 > first.x0 + INDENT
    return stands_out and first.bottom <= under.top + 1 and kind_of(under.pieces[0]) == "text"


def _is_heading_under(last: TextLine, before: Sequence[TextLine]) -> bool:
    """Whether the last line is words alone, larger than the lines over it, or bold under a row that is not: the heading
    of what follows."""
    worded = len(_words(last)) == 1 and kind_of(last.pieces[0]) == "text"
    bold = last.pieces[0].bold and any(map(_is_labelled, before)) and not any(p.bold for b in before for p in b.pieces)
    stands_out = _is_larger(last, before) or (bold and last.x0 <= min(line.x0 for line in before) + 1)
    return worded and stands_out and last.top >= max(line.bottom for line in before) - 1


def _reaches_past(line: TextLine, row: TextLine) -> bool:
    """Whether a line under a label and its value goes on past where that begins, as no line of the label does."""
    value = next((p for p in row.pieces if kind_of(p) == "value"), row.pieces[-1])
    return len(line.pieces) == 1 and row.x0 - 1 <= line.x0 < value.x0 - value.size and line.x1 > value.x0 + value.size


def _are_rows(lines: Sequence[TextLine]) -> bool:
    """Whether lines are a label and what stands beside it each, level with those of the others."""
    begins = {(round(line.x0), round(line.pieces[1].x0)) for line in lines if len(line.pieces) > 1}
    return len(begins) == 1 and all(len(line.pieces) > 1 for line in lines) and any(map(_is_labelled, lines))


def _is_larger(line: TextLine, others: Sequence[TextLine]) -> bool:
    return line.pieces[0].size > LARGER * max(p.size for other in others for p in other.pieces)


def _are_units_over(first: TextLine, rest: Sequence[TextLine]) -> bool:
    """Whether the first line is the units over the columns of the first row."""
    return all(kind_of(p) == "unit" for p in first.pieces) and first.bottom <= min(line.top for line in rest) + 1


def _is_labelled(line: TextLine) -> bool:
    kinds = [kind_of(p) for p in line.pieces]
    return kinds[0] == "text" and "value" in kinds[1:]


def _words(line: TextLine) -> list[TextPiece]:
    """What a line says, without the sign at its end that folds a section of a web page."""
    return [p for p in line.pieces if kind_of(p) != "mark"]


def _are_heads_of(line: TextLine, row: TextLine) -> bool:
    """Whether a line names the columns of the row under it: words with numbers ("Arm 2.4 m"), one over each of its two
    or more bare values, and none over its label."""
    values = [p for p in row.pieces if kind_of(p) == "value"]
    if len(line.pieces) < 2 or len(values) != len(line.pieces) or kind_of(row.pieces[0]) != "text":
        return False
    over = all(h.x0 < v.x1 + 4 and v.x0 - 4 < h.x1 for h, v in zip(line.pieces, values, strict=True))
    named = all(words_beside_numbers(h.bare, read(h.bare)) for h in line.pieces)
    bare = not any(words_beside_numbers(v.bare, read(v.bare)) for v in values)
    return over and named and bare and line.bottom <= row.top + 2 and line.x0 > row.x0 + 2 * line.pieces[0].size


def _in_two_systems(lines: Sequence[TextLine], fewest: int = 1) -> bool:
    """Whether two lines with labels are one row, its label broken in two: their values, at least so many, are the same
    one by one, metric and imperial."""
    both = [cells_of((line,)) for line in lines]
    if len(lines) != 2 or not fewest <= len(both[0]) == len(both[1]) or not all(cells[0].label for cells in both):
        return False
    return all(map(_are_the_same, *both))


def _are_the_same(*cells: ValueCell) -> bool:
    units = [c.unit or next((unit_in_label(p.bare)[1] for p in c.label[-1:]), "") for c in cells]
    values = [read(" ".join(p.text for p in c.values), unit=u) for c, u in zip(cells, units, strict=True)]
    if any(len(v) != 1 or len(v[0].numbers) != 1 for v in values):
        return False
    first, second = (v[0].numbers[0] for v in values)
    systems = {q.printed.system for q in (first, second) if q.printed}
    return systems == {"metric", "imperial"} and same(first, second)


def broken_in_two(rows: Sequence[Sequence[TextLine]]) -> list[Sequence[TextLine]]:
    """The rows, those whose label goes on beside the same values in the other system one with these: "Maximum vertical
    wall   7152 mm   6131 mm" over "digging depth   (23'6\")   (20'1\")"."""
    found: list[Sequence[TextLine]] = []
    for row in rows:
        if found and len(row) == 1 == len(found[-1]) and _in_two_systems((*found[-1], *row), fewest=2):
            found[-1] = (*found[-1], *row)
        else:
            found.append(row)
    return found


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
