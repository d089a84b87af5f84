"""What recognition is known to misread, put right."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from yellowiron.specs.layout.statement import is_unit
from yellowiron.specs.pages.words import Word


def mended(text: str) -> str:
    """A word without what is left of a leader's dots, its raised exponent of a unit put right: ".265" → "265",
    "kgf/cm?" → "kgf/cm2"."""
    text = re.sub(r"(?<=/cm)[?*°’'\"]$", "2", text)
    text = re.sub(r"(?<=[A-Za-z])[.…]{2,}$|^[.…]+(?=\d{3}|\d+[x×])|^[.…]{2,}(?=\d)", "", text)
    return text or "."


def with_whole_units(words: Sequence[Word]) -> list[Word]:
    """The words of a line, a unit in brackets that is set with wide gaps in one: "(m", "m)" → "(mm)"."""
    found: list[Word] = []
    for word in words:
        last = found[-1] if found else None
        whole = last.text + word.text if last else ""
        if last and last.text[0] == "(" and whole[-1] == ")" and "(" not in word.text and is_unit(whole):
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
