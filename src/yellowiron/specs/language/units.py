"""Units as sheets print them: each spelling's unit, dimension and system of measurement."""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass
from typing import Literal

from yellowiron.specs.language.vocabulary import data
from yellowiron.support.units import SI_UNIT

System = Literal["metric", "imperial", "both"]


@dataclass(frozen=True)
class PrintedUnit:
    """A unit of a sheet. `name` is what pint understands; `scale` is the SI value of one such unit.

    `fine` units are so big that sheets print thousandths of them ("3.658 m"), so that "3.658" is no doubt a decimal;
    of the others ("86.275 kg") it may be a thousands separator.
    """

    name: str
    dimension: str
    system: System
    scale: float
    fine: bool = False

    @property
    def si(self) -> str:
        """The SI unit of the dimension."""
        return SI_UNIT[self.dimension]


@functools.cache
def printed_units() -> tuple[tuple[PrintedUnit, tuple[str, ...]], ...]:
    """Every unit with the patterns of its spellings, the longest of which wins: `data/units.json`. The scales are
    pint's own (a test compares them): loading it takes a reader's child longer than a page."""
    return tuple(
        (PrintedUnit(name, dimension, system, scale, bool(fine)), tuple(spellings))
        for name, (scale, dimension, system, spellings, *fine) in data("units").items()
    )


@functools.cache
def unit_pattern() -> str:
    """A regular expression for any unit's spelling, not followed by a letter. A digit may be glued to it; then it is no
    exponent: "1.007 m39.6 in" is metres and inches."""
    spellings = [_any_case(s) for _, patterns in printed_units() for s in patterns]
    spellings = [re.sub(r"\(\?:([23])\|", r"(?:\1(?![.,]?\\d)|", s) for s in spellings]
    return (
        "(?:"
        + "|".join(sorted(spellings, key=len, reverse=True))
        + r")(?:(?<![A-Za-z])|(?![A-Za-zµÀ-ÖØ-öø-ɏ]))(?! ?[CF]\b)"
    )


def _any_case(spelling: str) -> str:
    """A unit that is written out, in any case ("Seconds", "BAR"); of a sign the case tells which it is."""
    return f"(?i:{spelling})" if re.fullmatch(r"[a-z]{4}[a-z?]*", spelling) else spelling


@functools.lru_cache(maxsize=512)
def printed_unit(text: str) -> PrintedUnit | None:
    """The unit of a spelling, or None. Case counts only where it must (`m`, `MPa`; but `KG`, `Mm` are accepted)."""
    text = text.strip()
    for flags in (0, re.IGNORECASE):
        for unit, patterns in printed_units():
            if re.fullmatch("|".join(patterns), text, flags):
                return unit
    return None
