"""Opens a PDF and reads its pages into statements. Runs in the guarded child process."""

from __future__ import annotations

import functools
import re
import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from yellowiron.model.errors import SheetError
from yellowiron.specs.language.decimal_style import DecimalStyle, decimal_style
from yellowiron.specs.language.numbers import read
from yellowiron.specs.layout.facing_pages import with_labels
from yellowiron.specs.layout.nearest import Near, nearest_of
from yellowiron.specs.layout.page_cells import Cell, cells_of
from yellowiron.specs.layout.router import statements_of
from yellowiron.specs.layout.rows.lines import lines_of
from yellowiron.specs.layout.statement import Statement, join_boxes
from yellowiron.specs.machines import titled
from yellowiron.specs.pages.strokes import Box
from yellowiron.specs.pages.words import TYPED, Page, read_page, type_unit
from yellowiron.specs.values.stated_configuration import Stated, stated_in
from yellowiron.support.files.inputs import require_file
from yellowiron.support.guard import beat, run_guarded

TIMEOUT_S = 60.0
"""For one page; the reader gives a sign of life at each."""
MEMORY_MB = 4096
RESIDENT_MB = 1024
"""Of memory in use; half of it is a page of a very large drawing."""
_MOST_S = 600.0
"""For a whole file."""
_MOST_PAGES = 5000
_MOST_BYTES = 512 * 1024 * 1024


@dataclass(frozen=True)
class PageRead:
    """What a page says (`number` counts from 1); `titles`: the models that its title names."""

    number: int
    statements: tuple[Statement, ...] = ()
    text: str = ""
    stated: tuple[Stated, ...] = ()
    near: tuple[Near, ...] = ()
    titles: frozenset[str] = frozenset()
    cells: tuple[Cell, ...] = ()


@dataclass(frozen=True)
class Sheet:
    """A read PDF. `silent` pages have pictures or marks but no readable text, or text that is drawn in part, or
    pictures under text where the file's states no value; `style`: how it writes decimals; `stated`: sentences that may
    say which configuration its figures are for. `recognised`: pages whose words are a program's guess from their
    picture, all or in part (`recogniser`: whose); `unrecognised` says why that program failed; `again`: the same sheet
    through another program. `near`: its values again, each with the words around it; `cells`: the text of its pages,
    piece by piece; `titles`: the models that the title of each page names."""

    file: str
    pages: int
    statements: tuple[Statement, ...]
    silent: tuple[int, ...]
    style: DecimalStyle
    stated: tuple[Stated, ...] = ()
    recognised: tuple[int, ...] = ()
    recogniser: str = ""
    unrecognised: str = ""
    near: tuple[Near, ...] = ()
    cells: tuple[Cell, ...] = ()
    titles: tuple[frozenset[str], ...] = ()
    again: Sheet | None = None


def read_sheet(path: Path) -> Sheet:
    """A PDF's statements, page by page. `SheetError` if absent, empty, no PDF, cut short, damaged, encrypted or without
    pages."""
    import pypdfium2

    check_file(path)
    try:
        with closing(pypdfium2.PdfDocument(path)) as document:
            count = len(document)
    except pypdfium2.PdfiumError as error:
        raise _open_error(path, str(error)) from error
    only = "Give the pages with the specifications only."
    if count > _MOST_PAGES:
        raise SheetError(f"{path.name} has {count} pages, more than {_MOST_PAGES}", where=str(path), hint=only)
    reads: list[PageRead] = []
    silent: list[int] = []
    pictured: list[int] = []
    begin = time.monotonic()
    try:
        for number, opened in opened_pages(path, range(1, count + 1), "Reading", of=f" of {count}"):
            if time.monotonic() - begin > _MOST_S:
                late = f"{path.name} takes more than {_MOST_S:g} s: stopped at page {number} of {count}"
                raise SheetError(late, where=str(path), hint=only)
            page = read_page(opened, number)
            one = read_words(page, type_unit(page.words, TYPED))
            reads.append(replace(one, statements=tuple(proven(one.statements, page))))
            if page.partly or (not page.readable and (page.images or page.characters or page.rules)):
                silent.append(number)
            elif page.images:
                pictured.append(number)
    except pypdfium2.PdfiumError as error:
        raise SheetError(
            f"Page {len(reads) + 1} of {path.name} cannot be read: the file is damaged",
            where=f"{path}, page {len(reads) + 1}",
            hint="Get the file again, or print it to a new PDF.",
        ) from error
    statements = [s for one in reads for s in one.statements]
    if not any(map(_states, statements)):  # typed are a head and a foot: what they stand around is a picture
        silent = sorted([*silent, *pictured])
    return Sheet(
        file=path.name,
        pages=count,
        statements=tuple(with_labels(statements)),
        silent=tuple(silent),
        style=decimal_style([one.text for one in reads]),
        stated=tuple(s for one in reads for s in one.stated),
        near=tuple(n for one in reads for n in one.near),
        cells=tuple(c for one in reads for c in one.cells),
        titles=tuple(one.titles for one in reads),
    )


def opened_pages(path: Path, numbers: Iterable[int], doing: str, of: str = "") -> Iterator[tuple[int, Any]]:
    """The pages of a PDF in turn, each closed at once: those of a manual would fill the memory."""
    import pypdfium2

    with closing(pypdfium2.PdfDocument(path)) as document:
        for number in numbers:
            beat(f"{doing} page {number}{of} of {path.name}")
            with closing(document[number - 1]) as page:
                yield number, page


def read_words(page: Page, unit: float) -> PageRead:
    """What the words of a page say, its type in units of so many points; its title alone where they mean nothing."""
    if not page.readable:
        return PageRead(page.number, titles=titled(page))
    text = " ".join(w.text for w in page.words)
    stated, titles = stated_in(text, page.number), titled(page)
    page = page.in_units(unit)
    statements = tuple(s.in_points(unit) for s in statements_of(page))
    near = tuple(replace(n, statement=n.statement.in_points(unit)) for n in nearest_of(page))
    return PageRead(
        page.number, statements, text, stated, near, titles, tuple(c.in_points(unit) for c in cells_of(page))
    )


def in_child(target: str, path: Path, *arguments: Any, **options: Any) -> Any:
    """The result of `module:function` of this package on a PDF, called in a guarded child process."""
    bounds = {"timeout_s": TIMEOUT_S, "memory_mb": MEMORY_MB, "resident_mb": RESIDENT_MB} | options
    target = f"yellowiron.specs.{target}"
    return run_guarded(target, path.resolve(), *arguments, where=str(path), error=SheetError, **bounds)


def _states(statement: Statement) -> bool:
    """Whether it is a value with a unit."""
    return bool(statement.unit) or any(q.unit for reading in read(statement.text) for q in reading.numbers)


def proven(statements: Sequence[Statement], page: Page) -> list[Statement]:
    """The statements, each with whether the words of its quote stand together on their page: side by side on a line, or
    on lines one over the other. The order in which the file has them says nothing: many write all labels first."""
    lines = [[((_squeezed(p.printed), _squeezed(p.text)), p.box) for p in line.pieces] for line in lines_of(page.words)]
    whole = "\n".join("".join(texts[k] for texts, _ in line) for line in lines for k in (0, 1))
    pieces = [({*texts} - {""}, box) for line in lines for texts, box in line]

    @functools.cache
    def together(part: str) -> bool:
        return part in whole or any(
            text[i] == part[0] and part.startswith(text[i:]) and _goes_on(pieces, part[len(text) - i :], box)
            for texts, box in pieces
            for text in texts
            for i in range(len(text))
        )

    return [
        s if all(together(_squeezed(part)) for part in s.quote.split(" … ")) else replace(s, proven=False)
        for s in statements
    ]


_LEADING = 2.0
"""Lines follow each other within this times their height."""


def _goes_on(pieces: Sequence[tuple[set[str], Box]], rest: str, begin: Box) -> bool:
    """Whether the rest of a quote goes on from the piece that it begins in: behind the last piece, or under what was
    read so far."""
    waiting, seen = [(rest, begin, begin)], set[tuple[int, Box]]()
    while waiting:
        rest, last, read = waiting.pop()
        high = last[3] - last[1]
        behind = [one for one in pieces if one[1][0] >= last[2] - 1 and abs(one[1][3] - last[3]) < high / 2]
        under = [one for one in pieces if high / 2 <= one[1][3] - last[3] <= _LEADING * high and one[1][0] < read[2]
                 and read[0] < one[1][2]]  # fmt: skip
        for texts, box in [*sorted(behind, key=lambda one: one[1][0])[:1], *under]:
            for text in texts:
                if text.startswith(rest):
                    return True
                if rest.startswith(text) and (len(rest), box) not in seen:
                    seen.add((len(rest), box))
                    waiting.append((rest[len(text) :], box, join_boxes((read, box))))
    return False


def _squeezed(text: str) -> str:
    """A text without spaces, dotted leaders and hyphens, also those of broken words."""
    return re.sub(r"\.(?!\d)|(?<!\d)\.|[_\-–\u00ad\ufffe]", "", "".join(text.split()))


def check_file(path: Path) -> None:
    """`SheetError` for what can be told from the bytes: no file, a folder, empty, too big, no PDF, cut short."""
    if path.is_dir():
        raise SheetError(
            f"{path.name or path.resolve().name or path} is a folder, not a PDF",
            where=str(path),
            hint="Give the sheet's file.",
        )
    try:
        size = require_file(path, what=path.name, most=_MOST_BYTES, error=SheetError)
        with path.open("rb") as stream:
            head = stream.read(1024)
            stream.seek(max(0, size - 8192))
            tail = stream.read()
    except OSError as error:
        raise SheetError(
            f"{path.name} cannot be opened: {error.strerror or error}", where=str(path), hint="Check the path."
        ) from error
    if size == 0:
        raise SheetError(f"{path.name} is empty", where=str(path), hint="Get the file again.")
    if b"%PDF-" not in head:
        raise SheetError(f"{path.name} is not a PDF", where=str(path), hint="Give the sheet as a PDF file.")
    if b"%%EOF" not in tail:
        raise SheetError(
            f"{path.name} is cut short: its end is missing", where=str(path), hint="Download or copy the file again."
        )


def _open_error(path: Path, message: str) -> SheetError:
    if "password" in message.lower() or "security" in message.lower():
        return SheetError(
            f"{path.name} is encrypted and asks for a password",
            where=str(path),
            hint="Open it with its password and print it to a new PDF without one.",
        )
    if _has_no_pages(path):
        return SheetError(f"{path.name} has no pages", where=str(path), hint="Get the file again.")
    return SheetError(
        f"{path.name} is a damaged PDF", where=str(path), hint="Get the file again, or print it to a new PDF."
    )


def _has_no_pages(path: Path) -> bool:
    """Whether a file that PDFium refuses is sound but for its page tree, which is empty."""
    from pdfminer.pdfdocument import PDFDocument
    from pdfminer.pdfexceptions import PDFException
    from pdfminer.pdfparser import PDFParser
    from pdfminer.pdftypes import dict_value, list_value
    from pdfminer.psexceptions import PSException

    try:
        with path.open("rb") as stream:
            pages = dict_value(PDFDocument(PDFParser(stream)).catalog.get("Pages"))
            return bool(pages) and not list_value(pages.get("Kids"))
    except (PDFException, PSException):
        return False
