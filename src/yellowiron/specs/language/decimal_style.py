"""How a document writes decimals: with a point or with a comma."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import takewhile
from typing import Literal

DecimalStyle = Literal["point", "comma", "unknown"]


def decimal_style(texts: Iterable[str]) -> DecimalStyle:
    """Whether a document writes decimals with a point or a comma, from the numbers that leave no doubt."""
    point = comma = 0
    for text in texts:
        for number in _outline(text):
            text = re.sub(rf"(?<![\d.,]){re.escape(number)}(?![\d.,])", " ", text)
        point += len(re.findall(r"(?<![\d.,])\d+\.(?:\d{1,2}|\d{4,})(?![\d.,])", text))
        point += len(re.findall(r"(?<![\d.,])\d{1,3}(?:,\d{3})+\.\d+(?![\d.,])", text))
        comma += len(re.findall(r"(?<![\d.,])\d+,(?:\d{1,2}|\d{4,})(?![\d.,])", text))
        comma += len(re.findall(r"(?<![\d.,])\d{1,3}(?:\.\d{3})+,\d+(?![\d.,])", text))
    if point > 3 * comma:
        return "point"
    return "comma" if comma > 3 * point else "unknown"


_OUTLINE = re.compile(r"(?<![\d.,])(\d{1,2})\.(\d{1,2})(?![\d.,])")


def _outline(text: str) -> set[str]:
    """The numbers of an outline's lines: "2.1", "2.2", "2.3", which are no decimals."""
    found = {match.group(0) for match in _OUTLINE.finditer(text)}
    numbered: set[str] = set()
    for first in {text.partition(".")[0] for text in found}:
        chain = list(takewhile(found.__contains__, (f"{first}.{n}" for n in range(1, 100))))
        numbered.update(chain if len(chain) >= 3 else ())
    return numbered
