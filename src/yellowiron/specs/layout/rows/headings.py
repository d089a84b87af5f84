"""What stands out as a heading: by size, capitals, or a filled bar behind it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from yellowiron.specs.language.vocabulary import MODELS, tokens
from yellowiron.specs.layout.rows.lines import TextBlock
from yellowiron.specs.layout.statement import EXAMPLE, TextPiece, kind_of
from yellowiron.specs.layout.tolerances import HEADING_BAR, LARGER
from yellowiron.specs.pages.strokes import Box
from yellowiron.specs.pages.words import Page, Word


@dataclass(frozen=True)
class Heading:
    """A section's heading: where it ends, its column's extent, its words."""

    bottom: float
    x0: float
    x1: float
    text: str


def is_heading(piece: TextPiece, size: float) -> bool:
    """Whether words are set like a heading over rows of a size: larger, or in capitals."""
    return len(EXAMPLE.sub("", piece.text).split()) <= 9 and (
        piece.size > LARGER * size or (in_capitals(piece) and (piece.bold or len(piece.text) > 5))
    )


def is_title(piece: TextPiece, size: float) -> bool:
    """Whether words with a unit at the right end of their line head a section, whose bare numbers have that unit."""
    return piece.bold or is_heading(piece, size)


def in_capitals(piece: TextPiece) -> bool:
    """Whether words are set in capitals."""
    letters = [c for c in EXAMPLE.sub("", piece.text) if c.isalpha()]
    return len(letters) >= 4 and sum(c.isupper() for c in letters) > 0.85 * len(letters)


def names_no_columns(row: Sequence[str]) -> bool:
    """Whether a row of words, a label first, says nothing of its columns: the same in all, or the engine in each."""
    return len(row) > 2 and (len(set(row[1:])) == 1 or "engine" in tokens(row[0]))


def names_models(label: str) -> bool:
    """Whether a row's label says that its cells name models: "Machine model", "Modelo"."""
    words = set(tokens(label)) - {"machine"}
    return bool(words) and words <= MODELS


def bar_under(page: Page, piece: TextPiece, size: float) -> Box | None:
    """The filled bar an emphasised piece is printed on, if that is no higher than a heading needs; shaded rows of a
    table are none."""
    if not (piece.bold or piece.size > 1.05 * size or in_capitals(piece)):
        return None
    for bar in page.bars:
        if bar[3] - bar[1] < 3.2 * piece.size and bar[2] - bar[0] > 6 * piece.size and inside(piece.box, bar):
            return bar
    return None


def inside(box: Box, outer: Box) -> bool:
    """Whether a box stands in another one, within 2 points."""
    return outer[0] - 2 <= box[0] and box[2] <= outer[2] + 2 and outer[1] - 2 <= (box[1] + box[3]) / 2 <= outer[3] + 2


def bars_of(page: Page, block: TextBlock) -> list[Box]:
    """The filled bars that stand in a block and are no higher than a heading."""
    return [b for b in page.bars if b[0] < block.x1 and block.x0 < b[2] and b[3] - b[1] < HEADING_BAR]


def body_size(words: Iterable[Word]) -> float:
    """The type size that most characters have."""
    sizes: dict[float, int] = {}
    for word in words:
        key = round(word.size, 1)
        sizes[key] = sizes.get(key, 0) + len(word.text)
    return max(sizes, key=lambda s: (sizes[s], -s)) if sizes else 8.0


def labels_reach(block: TextBlock) -> float:
    """Where most labels of a column of text end, at the right; at its own end where labels and values are not parted,
    as nothing heads a column there."""
    ends = sorted(
        a.x1
        for line in block.lines
        for a, b in zip(line.pieces, line.pieces[1:], strict=False)
        if kind_of(a) == "text" and kind_of(b) in ("value", "unit")
    )
    return ends[len(ends) // 2] if ends else block.x1
