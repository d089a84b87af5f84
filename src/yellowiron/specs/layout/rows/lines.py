"""Words → pieces → visual rows, and the columns of text that stand side by side on a page."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from yellowiron.specs.layout.statement import TextPiece, kind_of, split_inline
from yellowiron.specs.pages.strokes import Box, DrawnRule
from yellowiron.specs.pages.words import Word

_TALLEST = 6.5
_TALLEST_HEAD = 8.0
"""Between two rules that are farther apart than this times the type size stand rows of their own; so do bold heads."""
_HANGING = 20.0
"""Points by which a heading may stand out to the left of the labels under it."""
_PANEL = 60.0
"""Points; what is filled higher than this lies behind many rows, and is no heading's bar."""
_GAP = 0.75
"""A gap wider than this times the type size parts a label from a value."""
_NARROW = 0.45
"""Likewise where a value ends in its other unit and a number follows: no space between words is so wide."""


@dataclass(frozen=True)
class TextLine:
    """Pieces on one baseline, from left to right."""

    pieces: tuple[TextPiece, ...]

    @property
    def top(self) -> float:
        """Top of its highest word."""
        return min(p.box[1] for p in self.pieces)

    @property
    def bottom(self) -> float:
        """Bottom of its lowest word."""
        return max(p.box[3] for p in self.pieces)

    @property
    def x0(self) -> float:
        """Left edge."""
        return self.pieces[0].x0

    @property
    def x1(self) -> float:
        """Right edge."""
        return max(p.x1 for p in self.pieces)

    @property
    def text(self) -> str:
        """All its words."""
        return " ".join(p.text for p in self.pieces)


def lines_of(words: Sequence[Word], walls: Sequence[DrawnRule] = ()) -> list[TextLine]:
    """Words by baseline, parted where a wide gap or a vertical rule is between them; from top to bottom."""
    upright = sorted((w for w in walls if not w.horizontal), key=lambda w: w.x0)
    at = [w.x0 for w in upright]
    rows: list[list[Word]] = []
    for word in sorted(words, key=lambda w: (w.baseline, w.x0)):
        if rows and abs(rows[-1][0].baseline - word.baseline) <= 0.25 * min(rows[-1][0].size, word.size):
            rows[-1].append(word)
        else:
            rows.append([word])
    lines = []
    for row in rows:
        row.sort(key=lambda w: w.x0)
        pieces: list[list[Word]] = []
        for word in row:
            last = pieces[-1][-1] if pieces else None
            gap = _NARROW if last is not None and _ends_value(last, word) else _GAP
            if last is None or word.x0 - last.x1 > gap * max(word.size, last.size) or _walled(last, word, upright, at):
                pieces.append([word])
            else:
                pieces[-1].append(word)
        found = tuple(TextPiece(tuple(p)) for p in pieces)
        # a colon in a column of its own parts labels from values, and is neither
        lines.append(TextLine(tuple(p for p in found if p.text not in (":", "：")) or found))
    return lines


def _ends_value(last: Word, word: Word) -> bool:
    """Whether a value is complete in both systems, and a number begins: "(36'9\")   11 140 mm"."""
    return last.text.endswith(")") and any(map(str.isdigit, last.text)) and word.text[0].isdigit()


def _walled(a: Word, b: Word, walls: Sequence[DrawnRule], at: Sequence[float]) -> bool:
    """Whether one of the upright rules (sorted by their x, which is `at`) stands between two words of a line."""
    between = walls[bisect_left(at, a.x1 - 1) : bisect_right(at, b.x0 + 1)]
    return any(w.top < a.baseline and w.bottom > a.baseline - 0.5 * a.size for w in between)


@dataclass(frozen=True)
class TextBlock:
    """Lines that belong to one column of text, `x0` to `x1`."""

    lines: tuple[TextLine, ...]
    x0: float
    x1: float


def blocks_of(lines: Sequence[TextLine], bars: Sequence[Box] = (), across: Sequence[Box] = ()) -> list[TextBlock]:
    """The columns of text, in reading order: what is above a pair of columns, the left one, the right one, the rest.

    A gutter is an x at which several lines begin a label anew, each with a value to its right, and which no piece
    crosses; at which running text begins beside running text; or a filled bar beside another. `across` are leaders and
    rules, which do not cross a gutter either.
    """
    if not lines:
        return []
    found = _gutter(lines, bars, [*across, *bars])
    x0, x1 = min(line.x0 for line in lines), max(line.x1 for line in lines)
    if found is None:
        return [TextBlock(tuple(lines), x0, x1)]
    x, first, last = found
    left: list[TextLine] = []
    right: list[TextLine] = []
    for line in lines[first:last]:
        pieces = [part for p in line.pieces for part in _cut_at(p, x)]
        a = tuple(p for p in pieces if p.x0 < x - 2)
        b = tuple(p for p in pieces if p.x0 >= x - 2)
        if a:
            left.append(TextLine(a))
        if b:
            right.append(TextLine(b))
    return [
        *blocks_of(lines[:first], bars, across),
        *blocks_of(left, bars, across),
        *blocks_of(right, bars, across),
        *blocks_of(lines[last:], bars, across),
    ]


def _cut_at(piece: TextPiece, x: float) -> list[TextPiece]:
    """A piece, parted where one of its words begins at an x: columns of text may stand closer than a wide gap."""
    for index, (a, b) in enumerate(pairwise(piece.words), 1):
        if abs(b.x0 - x) < 2 and b.x0 - a.x1 > 0.3 * b.size:
            return [TextPiece(piece.words[:index]), TextPiece(piece.words[index:])]
    return [piece]


def _gutter(lines: Sequence[TextLine], bars: Sequence[Box], across: Sequence[Box]) -> tuple[float, int, int] | None:
    """The best gutter: its x and the range of lines that it parts."""
    by_bars = sorted({b[0] for b in bars if any(a[2] <= b[0] and a[1] < b[3] and b[1] < a[3] for a in bars)})
    drawn = [*by_bars, *_of_broken_rules(lines, across)]
    running = _of_running_text(lines)
    best: tuple[int, float, int, int] | None = None
    for x in [*_of_repeated_labels(lines), *_of_right_set_labels(lines), *drawn, *running]:
        first, last, weight = _run(lines, across, x)
        part = lines[first:last]
        parts = sum(_has_value_left_of(line, x) for line in part) >= 2 or (
            x in drawn and _begun_at(part, x) >= 3 and not _parts_labels_from_values(part, x)
        )
        parts = parts or (x in running and all(_runs(part, x, side) >= _FEWEST_RUNNING for side in (-1, 1)))
        bold = all(p.bold for line in part for p in line.pieces)
        if weight >= (_FEWEST_BOLD if bold else 3) and parts and (best is None or weight > best[0]):
            best = (weight, x, first, last)
    return best[1:] if best else None


_SURELY_PAIRED = 6
"""So many labels with values make a column of them, though a list without values goes on under them."""
_FEWEST_BOLD = 6
"""Lines of bold words that may be a column of text; fewer are heads of a table's columns."""
_FEWEST_RUNNING = 5
"""Lines of running text that make a column of it."""


def _of_running_text(lines: Sequence[TextLine]) -> list[float]:
    """Where several lines of running text begin that are not the first of their line on the page."""
    starts: dict[int, list[float]] = {}
    left_edge = min(line.x0 for line in lines)
    for line in lines:
        for piece in line.pieces:
            if piece.x0 > left_edge + 5 * _HANGING and _is_running(piece):
                starts.setdefault(round(piece.x0 / 4), []).append(piece.x0)
    found = [min(xs) for key, xs in sorted(starts.items()) if len(xs) >= _FEWEST_RUNNING]
    return sorted({x for label in found for x in (label, *_hanging(lines, label))})


def _hanging(lines: Sequence[TextLine], x: float) -> list[float]:
    """Where headings hang out to the left of what begins at an x."""
    return sorted({p.x0 for line in lines for p in line.pieces if x - _HANGING <= p.x0 < x - 2})[:3]


def _is_running(piece: TextPiece) -> bool:
    """Whether a piece may be a line of running text: several words, most of them in letters."""
    return len(piece.words) >= 4 and 2 * sum(w.text[:1].isalpha() for w in piece.words) > len(piece.words)


def _runs(lines: Sequence[TextLine], x: float, side: int) -> int:
    """How many lines of running text stand left (-1) or right (1) of an x."""
    return sum(_is_running(p) and (p.x0 < x - 2) == (side < 0) for line in lines for p in line.pieces)


def _has_value_left_of(line: TextLine, x: float) -> bool:
    return any(p.x0 < x - 2 and (kind_of(p) == "value" or _says_all(line, i)) for i, p in enumerate(line.pieces))


def _parts_labels_from_values(lines: Sequence[TextLine], x: float) -> bool:
    """Whether what stands right of an x are the values of the words left of it: cells filled side by side are no
    columns of text."""
    both = [
        (before[-1], after[0])
        for line in lines
        if (before := [p for p in line.pieces if p.x0 < x - 2]) and (after := [p for p in line.pieces if p.x0 >= x - 2])
    ]
    return 2 * sum(kind_of(a) == "text" and kind_of(b) in ("value", "unit") for a, b in both) > len(both) > 0


def _begun_at(lines: Sequence[TextLine], x: float) -> int:
    """How many lines have a piece that begins about there."""
    return sum(any(abs(p.x0 - x) < 12 for p in line.pieces) for line in lines)


def _of_repeated_labels(lines: Sequence[TextLine]) -> list[float]:
    """Where several lines begin a label anew, most of them with its value, and where headings hang out from there."""
    starts = _label_starts(lines)
    found: list[float] = []
    for key in sorted(starts):
        near = starts[key] + starts.get(key + 1, [])
        pairs = sum(paired for _, paired in near)
        if len(near) >= 4 and pairs >= max(3, 0.5 * len(near) if pairs < _SURELY_PAIRED else 0.3 * len(near)):
            label = min(x for x, _ in near)
            found.extend([label, *_hanging(lines, label)])
    return found


def _label_starts(lines: Sequence[TextLine]) -> dict[int, list[tuple[float, bool]]]:
    """By thirds of their x in points: where words begin that are not the first of the page's left edge, and whether
    they have a value."""
    starts: dict[int, list[tuple[float, bool]]] = {}
    left_edge = min(line.x0 for line in lines)
    for number, line in enumerate(lines):
        for index, piece in enumerate(line.pieces):
            # The rows of two columns need not be level with each other: a label may stand alone on its line.
            if kind_of(piece) != "text" or (index == 0 and piece.x0 < left_edge + _HANGING):
                continue
            paired = any(kind_of(p) == "value" for p in line.pieces[index + 1 : index + 4]) or _says_all(line, index)
            paired = paired or _folded(lines, number, index)
            starts.setdefault(round(piece.x0 / 3), []).append((piece.x0, paired))
    return starts


def _of_broken_rules(lines: Sequence[TextLine], across: Sequence[Box]) -> list[float]:
    """Where a rule begins beside another one at the same height, as under the headings of two columns, and words."""
    thin = sorted({b for b in across if b[3] - b[1] <= 6}, key=lambda b: b[1])
    heights = [b[1] for b in thin]
    begins: set[float] = set()
    for b in thin:
        level = thin[bisect_right(heights, b[1] - 1.5) : bisect_left(heights, b[1] + 1.5)]
        if b[0] not in begins and any(0 < b[0] - a[2] < 40 for a in level):
            begins.add(b[0])
    pieces = sorted((p for line in lines for p in line.pieces), key=lambda p: p.x0)
    starts = [p.x0 for p in pieces]
    found = []
    for x in sorted(begins):
        kinds = [kind_of(p) for p in pieces[bisect_right(starts, x - 12) : bisect_left(starts, x + 12)]]
        if len(kinds) >= 3 and kinds.count("text") >= 0.6 * len(kinds):
            found.append(x)
    return found


def _of_right_set_labels(lines: Sequence[TextLine]) -> list[float]:
    """Where the longest of labels begins that are set against their values: they end level with each other."""
    ends: dict[int, list[TextPiece]] = {}
    for line in lines:
        for label, value in zip(line.pieces, line.pieces[1:], strict=False):
            if kind_of(label) == "text" and kind_of(value) == "value":
                ends.setdefault(round(label.x1 / 2), []).append(label)
    found = []
    for key in sorted(ends):
        near = ends[key] + ends.get(key + 1, [])
        starts = {round(label.x0 / 3) for label in near}
        if len(near) >= 4 and len(starts) > 0.6 * len(near):
            found.append(min(label.x0 for label in near))
    return found


def _folded(lines: Sequence[TextLine], number: int, index: int) -> bool:
    """Whether the value of a label stands on the line under it: a row folded in two, or a label over its value."""
    piece = lines[number].pieces[index]
    after = lines[number].pieces[index + 1 : index + 2]
    end = after[0].x0 if after else float("inf")
    for line in lines[number + 1 : number + 6]:
        under = [p for p in line.pieces if piece.x0 - 2 <= p.x0 < end]
        if line.top - lines[number].bottom > 0.8 * piece.size:
            return False
        if under and line.bottom > lines[number].bottom + 0.5 * piece.size:
            return kind_of(under[0]) == "value"
    return False


def _says_all(line: TextLine, index: int) -> bool:
    """Whether a piece holds both a label and its value ("Wheelbase: 3450 mm"), and no other value follows it."""
    after = line.pieces[index + 1 : index + 2]
    return bool(split_inline(line.pieces[index].bare)[0]) and not any(kind_of(p) == "value" for p in after)


def _run(lines: Sequence[TextLine], across: Sequence[Box], x: float) -> tuple[int, int, int]:
    """The longest run of lines that nothing crosses at `x`, and how many of them stand on the thinner side."""
    crossing = [b for b in across if b[0] < x - 6 and b[2] > x + 6]
    heights = sorted((b[1] + b[3]) / 2 for b in crossing if b[3] - b[1] <= 6)
    covers = [b for b in crossing if 6 < b[3] - b[1] <= _PANEL]
    best = (0, 0, 0)
    start = 0
    for index in range(len(lines) + 1):
        ends = index == len(lines)
        crossed = ends or any(p.x0 < x - 2 and p.x1 > x - 2 and len(_cut_at(p, x)) == 1 for p in lines[index].pieces)
        if not crossed:
            middle = (lines[index].top + lines[index].bottom) / 2
            crossed = any(b[1] <= middle <= b[3] for b in covers)
        parted = not crossed and index > start and _any_between(heights, lines[index - 1].top, lines[index].bottom)
        if not (crossed or parted):
            continue
        part = lines[start:index]
        left = sum(any(p.x1 <= x - 2 for p in line.pieces) for line in part)
        right = sum(any(p.x0 >= x - 2 for p in line.pieces) for line in part)
        weight = min(left, right)
        if weight > best[2]:
            best = (start, index, weight)
        start = index if parted else index + 1
    return best


def _any_between(heights: Sequence[float], top: float, bottom: float) -> bool:
    index = bisect_left(heights, top)
    return index < len(heights) and heights[index] < bottom


def visual_rows(lines: Sequence[TextLine]) -> list[tuple[TextLine, ...]]:
    """Lines that overlap in height are one row: a label beside the two lines of its value."""
    rows: list[list[TextLine]] = []
    for line in sorted(lines, key=lambda one: one.top):
        if rows:
            bottom = max(one.bottom for one in rows[-1])
            height = min(line.bottom - line.top, min(one.bottom - one.top for one in rows[-1]))
            last = rows[-1][-1]
            if bottom - line.top > 0.25 * height and not _same_columns(last, line):
                rows[-1].append(line)
                continue
        rows.append([line])
    return [tuple(row) for row in rows]


def _same_columns(a: TextLine, b: TextLine) -> bool:
    """Whether two lines overlapping in height are yet stacked: one has a piece right above the other's."""
    return any(p.x0 < q.x1 and q.x0 < p.x1 and q.box[1] - p.box[1] < 0.5 * p.size for p in a.pieces for q in b.pieces)


def bands(
    lines: Sequence[TextLine], rules: Sequence[DrawnRule], bars: Sequence[Box], x0: float, x1: float
) -> list[tuple[TextLine, ...]]:
    """Lines between two neighbouring horizontal rules that run along (most of) the block are one row.

    Lines outside such a pair of rules are grouped by overlap alone; a line on a filled bar stands alone.
    """
    ys = sorted({round(r.top, 1) for r in rules if r.horizontal and min(r.x1, x1) - max(r.x0, x0) > 0.6 * (x1 - x0)})
    edges = sorted({*ys, *(b[1] for b in bars), *(b[3] for b in bars)})
    groups: dict[tuple[float, float], list[TextLine]] = {}
    free: list[TextLine] = []
    for line in lines:
        middle = (line.top + line.bottom) / 2
        above = max((y for y in edges if y < middle), default=None)
        below = min((y for y in edges if y >= middle), default=None)
        if above is None or below is None or below not in ys:
            free.append(line)
        else:
            groups.setdefault((above, below), []).append(line)
    rows: list[tuple[TextLine, ...]] = []
    for (above, below), group in groups.items():
        tallest = _TALLEST_HEAD if all(p.bold for line in group for p in line.pieces) else _TALLEST
        row = [line for line in group if below - above <= tallest * line.pieces[0].size]
        free += [line for line in group if below - above > tallest * line.pieces[0].size]
        rows += [tuple(row)] if row else []
    rows += visual_rows(free)
    return sorted(rows, key=lambda row: (min(line.top for line in row), row[0].x0))
