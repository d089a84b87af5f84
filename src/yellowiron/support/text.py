"""How values are written for people and for files: one place, so that the same value reads the same everywhere."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from typing import Any

_DISPLAY = {
    "m": ("mm", 1e3),
    "rad": ("°", 180.0 / math.pi),
    "Pa": ("MPa", 1e-6),
    "m^3/s": ("L/min", 6e4),
    "N": ("kN", 1e-3),
    "W": ("kW", 1e-3),
    "m/s": ("km/h", 3.6),
    "rad/s": ("rpm", 30.0 / math.pi),
}

_CONSONANT, _VOWEL = re.compile(r"uni|us[ae]|eu|one\b"), re.compile(r"8|11\b|18\b|hour|hon")
"""Words that begin with a vowel and are not spoken so; words and numbers that are, and begin otherwise."""


def display(value: float | None, unit: str, *, digits: int = 5) -> str:
    """An SI value in the unit people read: 0.764 m → '764 mm', 0.698 rad → '40 °'; '–' for None, '∞' for infinity."""
    if value is None or math.isnan(value):
        return "–"
    if math.isinf(value):
        return "∞" if value > 0.0 else "−∞"
    shown, factor = _DISPLAY.get(unit, (unit if unit != "1" else "", 1.0))
    number = float(f"{value * factor:.{digits}g}")
    text = f"{number:.0f}" if number == round(number) else f"{number:g}"
    return f"{text} {shown}".rstrip()


def with_article(words: str) -> str:
    """`an angle`, `a length`, `a unit`: what is filled into a sentence, by how it is spoken."""
    spoken = words.lower()
    vowel = spoken.startswith(tuple("aeiou")) and _CONSONANT.match(spoken) is None
    return f"{'an' if vowel or _VOWEL.match(spoken) else 'a'} {words}"


def plain(value: Any) -> Any:
    """A value as JSON knows it: arrays and tuples become lists, floats 12 significant digits (the rest is noise)."""
    if hasattr(value, "tolist"):  # numpy's, which errors and help do without: it takes a tenth of a second
        return plain(value.tolist())
    if isinstance(value, Mapping):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(v) for v in value]
    if isinstance(value, bool):
        return bool(value)
    if isinstance(value, int):
        return int(value)
    if isinstance(value, float):
        if not math.isfinite(value):
            return None
        rounded = float(f"{value:.12g}")
        return 0.0 if rounded == 0.0 else rounded
    return value


def to_json(document: Any, *, ascii_only: bool = False) -> str:
    """A document as the text of a JSON file: two-space indent, the writer's key order, UTF-8, a closing newline."""
    return json.dumps(plain(document), indent=2, ensure_ascii=ascii_only) + "\n"
