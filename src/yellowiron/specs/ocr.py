"""Pages without a text layer, read through the `tesseract` program where it is installed.

What it reads is a guess: a digit may be another. Values from such pages are never more than `review`.
"""

from __future__ import annotations

import csv
import functools
import io
import re
import shutil
import statistics
import subprocess
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from yellowiron.model.errors import SheetError
from yellowiron.specs.layout.nearest import Near, nearest_of
from yellowiron.specs.layout.router import statements_of
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.pages.picture_rules import rules_of_picture
from yellowiron.specs.pages.words import Page, Word, read_page
from yellowiron.specs.values.stated_configuration import Stated, stated_in
from yellowiron.support.guard import beat

MOST_PAGES = 40
"""Pages of one file that are recognised, the first ones: each takes seconds."""
PAGE_TIMEOUT_S = 60.0
_RESOLUTION = 300.0
"""Pixels an inch, as tesseract likes it."""
_MOST_PIXELS = 16_000_000
_LATIN = ("eng", "deu", "fra", "spa")
_CJK = ("chi_sim", "jpn")
_NOISE = 50.0
"""Confidence (of 100) below which a word without a digit is dirt, or the dots of a leader."""
_DOUBTFUL = 60.0
"""Median confidence (of 100) below which a page may be in another script."""
_SHORTEST = 15.0
"""Points; shorter strokes are parts of letters that are drawn, or of a machine."""
_FEWEST = 4
"""Rules and fills; a file with fewer has its tables in its pictures."""
_CAP = 0.72
"""Height of a capital letter or digit as a share of the size of its font."""
_LOW = set("gjpqyQ,;()[]{}|/")
_HIGH = set("bdfhklt0123456789")


@dataclass(frozen=True)
class Recognised:
    """What was recognised on one page (`number` counts from 1)."""

    number: int
    statements: tuple[Statement, ...]
    text: str
    stated: tuple[Stated, ...]
    near: tuple[Near, ...] = ()


def program() -> str | None:
    """The path of the `tesseract` program; None where it is not installed."""
    return shutil.which("tesseract")


def recognise(path: Path, numbers: Sequence[int]) -> list[Recognised]:
    """The statements of pages (`numbers` count from 1) that have no text layer; a page on which nothing is recognised
    is left out. Runs in a guarded child. `SheetError` where the program fails."""
    import pypdfium2

    found: list[Recognised] = []
    failure: SheetError | None = None
    document = pypdfium2.PdfDocument(path)
    try:
        for number in numbers[:MOST_PAGES]:
            beat(f"Recognising the text of page {number} of {path.name}")
            try:
                page = _page(document[number - 1], number)
            except SheetError as error:  # a page that takes too long costs no other
                failure = error
                continue
            if page.readable:
                text = " ".join(w.text for w in page.words)
                statements, near = tuple(statements_of(page)), nearest_of(page)
                found.append(Recognised(number, statements, text, tuple(stated_in(text, number)), near))
    finally:
        document.close()
    if failure is not None and not found:
        raise failure
    return found


def _page(page: object, number: int) -> Page:
    """A page as it looks, its words read from its picture, its rules and fills from the file or else from the picture.
    Points, from the top left."""
    drawn = read_page(page, number)
    width, height = drawn.width, drawn.height
    scale = min(_RESOLUTION / 72.0, (_MOST_PIXELS / max(width * height, 1.0)) ** 0.5)
    picture = page.render(scale=scale, grayscale=True).to_pil()  # type: ignore[attr-defined]
    stream = io.BytesIO()
    picture.save(stream, "PNG")
    words, sure = _words(stream.getvalue(), _LATIN, scale)
    if sure < _DOUBTFUL:
        others, surer = _words(stream.getvalue(), _CJK, scale)
        if surer > sure:
            words = others
    rules = [r for r in drawn.rules if (r.x1 - r.x0 if r.horizontal else r.bottom - r.top) >= _SHORTEST]
    bars = [b for b in drawn.bars if b[2] - b[0] >= _SHORTEST]
    if len(rules) + len(bars) < _FEWEST:
        rules = [*rules, *rules_of_picture(np.asarray(picture), scale)]
    return Page(
        number,
        width,
        height,
        tuple(words),
        tuple(rules),
        tuple(bars),
        characters=sum(len(w.text) for w in words),
        images=1,
    )


def _words(picture: bytes, languages: Sequence[str], scale: float) -> tuple[list[Word], float]:
    """The words on a picture and their median confidence; none where the program lacks the languages."""
    there = [code for code in languages if code in _languages()]
    if not there:
        return [], 0.0
    # Sparse text (11): columns of a table are not taken for columns of a book.
    output = _run("stdin", "stdout", "-l", "+".join(there), "--psm", "11", "tsv", given=picture)
    lines: dict[tuple[str, ...], list[dict[str, str]]] = defaultdict(list)
    for row in csv.DictReader(io.StringIO(output), delimiter="\t", quoting=csv.QUOTE_NONE):
        if row.get("level") == "5" and _meant(row.get("text") or "", float(row["conf"])):
            lines[row["block_num"], row["par_num"], row["line_num"]].append(row)
    words = [word for line in lines.values() for word in _line(line, scale)]
    sure = [float(row["conf"]) for line in lines.values() for row in line]
    return words, statistics.median(sure) if sure else 0.0


def _meant(text: str, confidence: float) -> bool:
    return bool(text.strip()) and (confidence >= _NOISE or (confidence >= 0.0 and any(c.isdigit() for c in text)))


def _line(rows: Sequence[dict[str, str]], scale: float) -> list[Word]:
    """A recognised line's words on one baseline, in one size."""
    standing = [r for r in rows if not _LOW & set(r["text"])] or rows
    full = [r for r in standing if any(c.isupper() or c in _HIGH or ord(c) > 0x2E7F for c in r["text"])] or standing
    baseline = statistics.median(int(r["top"]) + int(r["height"]) for r in standing) / scale
    size = statistics.median(int(r["height"]) for r in full) / scale / _CAP
    return [
        Word(
            _mended(r["text"].strip()),
            int(r["left"]) / scale,
            (int(r["left"]) + int(r["width"])) / scale,
            baseline,
            size,
        )
        for r in rows
    ]


def _mended(text: str) -> str:
    """A word without what is left of a leader's dots, its raised exponent of a unit put right: ".265" → "265",
    "kgf/cm?" → "kgf/cm2"."""
    text = re.sub(r"(?<=/cm)[?*°’'\"]$", "2", text)
    text = re.sub(r"(?<=[A-Za-z])[.…]{2,}$|^[.…]+(?=\d{3})|^[.…]{2,}(?=\d)", "", text)
    return text or "."


@functools.cache
def _languages() -> frozenset[str]:
    """The languages that the program has data of."""
    return frozenset(_run("--list-langs").split())


def _run(*arguments: str, given: bytes = b"") -> str:
    command = program()
    if command is None:
        raise SheetError("The program tesseract is not installed", where="PATH", hint="Install tesseract-ocr.")
    try:
        done = subprocess.run(
            [command, *arguments], input=given, capture_output=True, timeout=PAGE_TIMEOUT_S, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise SheetError("Text recognition does not answer", where=command, hint=f"tesseract: {error}") from error
    if done.returncode:
        words = done.stderr.decode(errors="replace").strip().splitlines()
        raise SheetError(
            "Text recognition failed", where=command, hint=f"tesseract: {words[-1] if words else 'no word'}"
        )
    return done.stdout.decode(errors="replace")
