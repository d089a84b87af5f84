"""What the rows of a column of text say about the rows below them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from yellowiron.specs.layout.rows.headings import Heading
from yellowiron.specs.layout.rows.lines import TextBlock, TextLine
from yellowiron.specs.layout.statement import Statement, TextPiece
from yellowiron.specs.pages.words import Page


@dataclass
class ReaderState:
    """A column of text that is read (`block`, on its `page`; `size`: the type size, in points, that most of its
    characters have), what its rows say (`found`), and what they say about the rows below."""

    page: Page
    block: TextBlock
    size: float
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
    found: list[Statement] = field(default_factory=list)
    orphans: list[int] = field(default_factory=list)
    nearer: bool = False
    """Whether the row that is read is nearer to the one above than to the next."""
    given: TextLine | None = None
    """The line that names the values above it, and none below."""
    last: tuple[Sequence[TextLine], range, str] | None = None
    corner: TextPiece | None = None
    """The part that a table's corner names, beside the heads of its columns ("Blade | 6S | 6SU")."""
    worded: tuple[TextPiece, ...] = ()
    """The row of words right above: a label and what is said of it."""
    circuit: TextPiece | None = None
    """The label of a row of words that names a hydraulic circuit ("Pilot pump: gear type"), which holds for the rows
    after it up to the next row of words."""

    @property
    def labels_end(self) -> float:
        """Left of this x the labels of rows begin."""
        return self.block.x0 + 0.12 * (self.block.x1 - self.block.x0) + 4

    def heading(self, bottom: float, text: str) -> Heading:
        """A heading of this column, which ends at a height."""
        return Heading(bottom, self.block.x0, self.block.x1, text)

    def open_section(self, heading: Heading, heads: tuple[TextPiece, ...]) -> None:
        """A heading ends what held above it; `heads` stand on its line."""
        if heads:
            self.kept = []
        elif self.heads and not self.data_since_heads and all(len(line) > 1 for line in self.heads):
            self.kept = list(self.heads)  # a table's own heads, above its first section
        self.section, self.unit, self.circuit, self.corner = heading.text, "", None, None
        self.headings.append(heading)
        self.context, self.pending, self.heads = [], [], [heads] if heads else list(self.kept)
        self.indented = self.data_since_heads = False

    def add_heads(self, heads: tuple[TextPiece, ...]) -> None:
        """A line of column heads: under the ones above it, or in their place where values stand between."""
        if self.heads == self.kept:
            self.heads, self.kept = [], []
        far = bool(self.heads) and heads[0].box[1] - self.heads[-1][0].box[3] > 2.5 * heads[0].size
        if self.data_since_heads or far:
            self.heads, self.corner = [], None
            self.data_since_heads = False
        self.heads.append(heads)

    def add_label(self, piece: TextPiece) -> None:
        """Words alone at the left: a sub-heading if bold, else the beginning of the next row's label."""
        if piece.bold:
            self.context, self.pending, self.indented = [piece], [], False
        elif self.pending and not self.data_since_heads and stacked(self.pending[-1], piece):
            self.pending = [*self.pending, piece]
        else:
            self.pending = [piece]
        if not self.heads:
            self.data_since_heads = False


def stacked(a: TextPiece, b: TextPiece) -> bool:
    """Whether a piece stands right under another one, like the lines of one label."""
    return abs(a.x0 - b.x0) < 2 * a.size and 0 < b.box[1] - a.box[3] < 0.9 * a.size
