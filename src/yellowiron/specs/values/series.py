"""Values that a sheet counts: a speed for each gear, a pull for each layer of rope. The greatest is the maximum."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from itertools import pairwise

from yellowiron.specs.language.vocabulary import tokens
from yellowiron.specs.values.contention import Match

_ORDINAL = re.compile(r"(\d{1,2})(?:st|nd|rd|th|er|era|ere|eme|da|ra|ta|to|do|o|a|e)?")
_LEAST_COUNTED = 3
_GEARS = {"gear", "shift"}
"""What counts speeds: the travel speed is that of the highest, also of two."""


def extremes(matches: Sequence[Match], value: Callable[[Match], float]) -> list[Match]:
    """Of values that the rows of each column count one by one, and that rise or fall with the count, the greatest where
    a maximum is meant, the least where a minimum is; [] where the matches are anything else. `value`: in SI."""
    columns: dict[tuple[object, ...], dict[int, list[Match]]] = {}
    counted = any(_count(m) is not None for m in matches)
    if not counted and not _are_gears(matches):
        return []
    for one in matches:
        count = _count(one) if counted else one.claim.statement.row
        if count is None:
            return []
        statement = one.claim.statement
        place = (statement.sheet, statement.page, statement.column, statement.section)
        columns.setdefault(place, {}).setdefault(count, []).append(one)
    geared = counted and all(m.wanted.dimension == "speed" and _GEARS & {*tokens(m.claim.words)} for m in matches)
    meant = _meant(matches) or ("maximum" if geared else None)
    found: list[Match] = []
    for rows in columns.values():
        values = [[value(m) for m in rows[count]] for count in sorted(rows)]
        rises = all(max(a) < min(b) or (not counted and a == b) for a, b in pairwise(values))
        falls = all(min(a) > max(b) for a, b in pairwise(values))
        if meant is None or len(rows) < (2 if geared else _LEAST_COUNTED) or not (rises or falls):
            return []
        found += rows[max(rows) if rises == (meant == "maximum") else min(rows)]
    return found


def _are_gears(matches: Sequence[Match]) -> bool:
    """Whether the values are speeds under one name, one for each gear: "1.0 Forward", "1.5 Forward"."""
    return len({m.claim.words for m in matches}) == 1 and all(m.wanted.dimension == "speed" for m in matches)


def _meant(matches: Sequence[Match]) -> str | None:
    """Which extreme a value's name or the words of each of its matches say; None where none or both."""
    said = [{*tokens(m.wanted.name), *tokens(m.claim.words), *tokens(m.claim.head)} for m in matches]
    meant = [word for word in ("maximum", "minimum") if all(word in words for words in said)]
    return meant[0] if len(meant) == 1 else None


def _count(found: Match) -> int | None:
    """The number that a row counts with, in its label or as its name; None where there is none, or several."""
    statement = found.claim.statement
    words = [w for text in (found.claim.words, *statement.variant) for w in tokens(text)]
    counts = [int(m.group(1)) for w in words if (m := _ORDINAL.fullmatch(w))]
    return counts[0] if len(counts) == 1 else None


def called(matches: Sequence[Match]) -> list[Match]:
    """Of values that differ, those whose own label says the extreme that the value's name says: of a "maximum lifting
    capacity" and a "crane capacity" the former; of forces, which are printed for their maximum, the one called so; of
    gross powers by two standards, the one by SAE J1995."""
    own = [m for m in matches if {"maximum", "minimum"} & _extremes_meant(m) & {*tokens(m.claim.words)}]
    own = own or [m for m in matches if "gross" in tokens(m.wanted.name) and _SAE_GROSS.search(m.claim.words)]
    return own if len(own) < len(matches) else []


_SAE_GROSS = re.compile(r"J\s?1995", re.IGNORECASE)


def _extremes_meant(found: Match) -> set[str]:
    name = set(tokens(found.wanted.name))
    return name if found.wanted.dimension != "force" or "minimum" in name else name | {"maximum"}


_PAIRED = {"front", "rear", "loaded", "empty"}
"""What two numbers with a slash are printed for in this order, also where the label names the first alone."""


def first_of_two(matches: Sequence[Match]) -> list[Match]:
    """The first of two numbers that stand with a slash in one cell under a label that names one of two opposites, which
    is the one that is wanted: "axle load, front: 2978 / 3252"; [] otherwise."""
    every = sorted(matches, key=lambda m: m.claim.quantity.start)
    named = [_PAIRED & {*tokens(m.wanted.name)} & {*tokens(m.claim.words)} for m in every]
    paired = len(every) == 2 and all(m.claim.ranged for m in every) and all(named)
    return every[:1] if paired and every[0].claim.statement is every[1].claim.statement else []
