"""Whether a drawing is the committed one, as far as machines agree on numbers."""

from __future__ import annotations

import re
from pathlib import Path

_NUMBER = re.compile(r"-?\d+\.\d*(?:E[-+]?\d+)?", re.IGNORECASE)
SLACK = 1e-4
"""Millimetres: the linkages are found by iteration, whose last digits differ from processor to processor."""


def differences(drawn: Path, committed: Path) -> list[str]:
    """The first numbers that are not the same within `SLACK` or their last digit, as pairs; what stands between them
    must be the same."""
    a, b = ("".join(path.read_text(encoding="utf-8").split()) for path in (drawn, committed))
    if _NUMBER.split(a) != _NUMBER.split(b):
        return [f"{drawn.name}: other words than in {committed}"]
    pairs = zip(_NUMBER.findall(a), _NUMBER.findall(b), strict=True)
    return [f"{x} is not {y}" for x, y in pairs if abs(float(x) - float(y)) > max(SLACK, _digit(x))][:5]


def _digit(number: str) -> float:
    decimals = number.partition(".")[2]
    return 1.01 * 10.0 ** -len(decimals) if decimals.isdigit() else 0.0
