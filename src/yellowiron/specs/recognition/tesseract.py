"""Text recognition through the program `tesseract`."""

from __future__ import annotations

import csv
import functools
import io
import shutil
import statistics
import subprocess
from collections import defaultdict
from collections.abc import Sequence

from PIL import Image

from yellowiron.model.errors import SheetError
from yellowiron.specs.pages.words import Word
from yellowiron.specs.recognition.mending import mended

PAGE_TIMEOUT_S = 60.0
_LATIN = ("eng", "deu", "fra", "spa")
_CJK = ("chi_sim", "jpn")
_NOISE = 50.0
"""Confidence (of 100) below which a word without a digit is dirt, or the dots of a leader."""
_DOUBTFUL = 60.0
"""Median confidence (of 100) below which a page may be in another script."""
_CAP = 0.72
"""Height of a capital letter or digit as a share of the size of its font."""
_LOW = set("gjpqyQ,;()[]{}|/")
_HIGH = set("bdfhklt0123456789")


def program() -> str | None:
    """The path of the `tesseract` program; None where it is not installed."""
    return shutil.which("tesseract")


def words_on(picture: Image.Image, scale: float) -> list[Word]:
    """The words on a picture of `scale` pixels a point, in points from its top left. `SheetError` where the program
    fails or takes longer than `PAGE_TIMEOUT_S`."""
    stream = io.BytesIO()
    picture.save(stream, "PNG")
    words, sure = _words(stream.getvalue(), _LATIN, scale)
    if sure < _DOUBTFUL:
        others, surer = _words(stream.getvalue(), _CJK, scale)
        if surer > sure:
            return others
    return words


def _words(picture: bytes, wanted: Sequence[str], scale: float) -> tuple[list[Word], float]:
    """The words on a picture and their median confidence; none where the program lacks the languages."""
    there = [code for code in wanted if code in languages()]
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
            mended(r["text"].strip()),
            int(r["left"]) / scale,
            (int(r["left"]) + int(r["width"])) / scale,
            baseline,
            size,
        )
        for r in rows
    ]


@functools.cache
def languages() -> frozenset[str]:
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
