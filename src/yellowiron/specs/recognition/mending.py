"""What recognition is known to misread, put right."""

from __future__ import annotations

import re
import statistics
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import replace

from yellowiron.specs.layout.statement import is_unit
from yellowiron.specs.pages.words import Word

_PLAIN = str.maketrans("（），：／％", "(),:/%")


def mended(text: str) -> str:
    """A word without what is left of a leader's dots, its raised exponent of a unit put right: ".265" → "265",
    "kgf/cm?" → "kgf/cm2"."""
    text = re.sub(r"(?<=/cm)[?*°’'\"]$", "2", text)
    text = re.sub(r"^(\d*m)[?*°’'\"]$", r"\1²", text)
    text = re.sub(r"^(\d*\(?)[I|]?(?=/min\b)", r"\1l", text)
    if not re.search(r"[\u3040-\u30ff\u3400-\u9fff]", text):
        text = text.translate(_PLAIN)
    text = re.sub(r"^s/e/[1I|]$", "s/e/l", text)
    text = re.sub(r"^(\d{4,})[”\"]$", r"\1", text)
    text = re.sub(r"^[—–-]+(?=\d)", "-", text)
    text = re.sub(r"(?<![A-Za-z])I(?=(?:pm|bs?|bf)(?![A-Za-z]))", "l", text)
    text = re.sub(r"(?<=[A-Za-z])[.…]{2,}$|^[.…]+(?=\d{3}|\d+[x×])|^[.…]{2,}(?=\d)", "", text)
    return text or "."


_FACTORS = re.compile(r"^\d\S*[x×*] \d|^\d\S*\d [x×*]\d")
"""Two words that are factors of one product."""


def with_whole_units(words: Sequence[Word]) -> list[Word]:
    """The words of a line, a unit in brackets that is set with wide gaps in one, and a product: "(m", "m)" → "(mm)",
    "2752x", "1450x2205" → "2752x1450x2205"."""
    found: list[Word] = []
    for word in words:
        last = found[-1] if found else None
        whole = last.text + word.text if last else ""
        unit = last and last.text[0] == "(" and whole[-1] == ")" and "(" not in word.text and is_unit(whole)
        if last and (unit or _FACTORS.search(f"{last.text} {word.text}")):
            found[-1] = replace(last, text=whole, x1=word.x1)
        else:
            found.append(word)
    return found


_DOTTED = 3
"""Values that begin with a dot, from which on a page has leaders: a decimal seldom lacks its zero."""


def without_leaders(words: Sequence[Word]) -> list[Word]:
    """The words of a page, those that begin a number with a dot without it, if that is what is left of leaders:
    ".12.8" and ".1" → "12.8" and "1" beside others of their kind."""
    dotted = [w for w in words if re.match(r"\.\d", w.text)]
    if len(dotted) < _DOTTED:
        return list(words)
    return [replace(w, text=w.text[1:]) if re.match(r"\.\d", w.text) else w for w in words]


_LEVEL = 0.4
"""Of a word's size, by which the baselines of words beside each other may be read apart."""


_ALIKE = 0.15
"""Share of a size by which it is measured too large or too small: a line of a few letters may have no tall one."""


def levelled(words: Sequence[Word]) -> list[Word]:
    """The words of a page in as few sizes as they are set in, those of a row on one baseline: what is measured of each
    line that was found is off by a little."""
    words = _in_few_sizes(words)
    found: list[Word] = []
    row: list[Word] = []
    for word in sorted(words, key=lambda w: w.baseline):
        if row and word.baseline - row[0].baseline > _LEVEL * min(word.size, row[0].size):
            found += _on_one(row)
            row = []
        row.append(word)
    return found + _on_one(row)


def _on_one(row: Sequence[Word]) -> list[Word]:
    if not row:
        return []
    level = statistics.median_low([w.baseline for w in row])
    return [replace(w, baseline=level) for w in row]


def _in_few_sizes(words: Sequence[Word]) -> list[Word]:
    """The words, each in the size that the most have of those that differ little from its own."""
    left = sorted(words, key=lambda w: w.size)
    found: list[Word] = []
    while left:
        sizes = [w.size for w in left]
        spans = [(bisect_left(sizes, s * (1 - _ALIKE)), bisect_right(sizes, s * (1 + _ALIKE)), s) for s in sizes]
        first, end, size = max(spans, key=lambda span: span[1] - span[0])
        found += [replace(w, size=size) for w in left[first:end]]
        left = left[:first] + left[end:]
    return found
