"""What recognition is known to misread, put right."""

from __future__ import annotations

import re


def mended(text: str) -> str:
    """A word without what is left of a leader's dots, its raised exponent of a unit put right: ".265" → "265",
    "kgf/cm?" → "kgf/cm2"."""
    text = re.sub(r"(?<=/cm)[?*°’'\"]$", "2", text)
    text = re.sub(r"(?<=[A-Za-z])[.…]{2,}$|^[.…]+(?=\d{3}|\d+[x×])|^[.…]{2,}(?=\d)", "", text)
    return text or "."
