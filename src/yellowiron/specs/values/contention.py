"""A match of a claim with a wanted value, and what several matches say of each other: twins, shared headings, ends, and
values that a sheet counts (a speed for each gear, a pull for each layer of rope): the greatest is the maximum."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from itertools import pairwise

from yellowiron.model.template import Wanted
from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.vocabulary import tokens
from yellowiron.specs.values.claims import Claim, names_model
from yellowiron.specs.values.requested import usual


@dataclass(frozen=True)
class Match:
    """A claim that speaks of a wanted value. `score` 0…1: the share of its label that the wanted value's phrases
    explain, less what is borrowed from headings. `rest` are its other words that may mean another property, `lost` what
    they cost; `by_label` is False where only headings or heads name the property, `by_head` True where heads are needed
    for it."""

    wanted: Wanted
    claim: Claim
    score: float
    phrase: str
    rest: tuple[str, ...] = ()
    lost: float = 0.0
    by_label: bool = True
    by_head: bool = False


def explained(found: Match, words: Set[str]) -> Match:
    """The match with these words, which something else explains, taken off its label's doubt."""
    rest = tuple(w for w in found.rest if w not in words)
    if len(rest) == len(found.rest):
        return found
    lost = found.lost * (len(found.rest) - len(rest)) / len(found.rest)
    return replace(found, score=found.score + lost, lost=found.lost - lost, rest=rest)


_GEAR = {"gear", "shift", "travel", "reverse", "r"}
_ONE_WAY = re.compile(r"\([^()]*\)")
"""What a gear's remark says: "4th gear (forward only)"."""
_NUMBERED = re.compile(r"\d")
_KEY = re.compile(r"(\d{1,2}(?:\.\d)?)\.?\s+(?=[^\W\d])")
_FEWEST_GEARS = 3


def is_gear(words: str) -> bool:
    """Whether a row is called by its gear, and no more: "4th gear", "2", "R", "4th gear (forward only)"."""
    said = tokens(_ONE_WAY.sub("", words))
    named = {t for t in said if not _NUMBERED.search(t)}
    return bool(said) and named <= _GEAR and (len(named) < len(said) or "r" in named)


def row_name(claim: Claim) -> str:
    """What a row is called: its words, those of a gear with the number before them ("1. Gang")."""
    key = _KEY.match(claim.statement.quote) if tokens(claim.words) == ("gear",) else None
    return f"{key.group(1)} {claim.words}" if key else claim.words


def without_lone_gears(found: Mapping[str, list[Match]]) -> None:
    """Takes off the speeds of rows that are called by their gears where the page does not count three: one alone says
    nothing of the greatest speed. Where it does, the greatest speed is one of theirs."""
    speeds = [m for own in found.values() for m in own if m.wanted.dimension == "speed" and "gear" in m.rest]
    geared = [m for m in speeds if is_gear(row_name(m.claim)) and not m.by_head]
    counts: dict[tuple[object, ...], set[str]] = {}
    for one in geared:
        counts.setdefault(_list_of(one), set()).update(t for t in tokens(row_name(one.claim)) if _NUMBERED.search(t))
    lone = {id(m) for m in geared if len(counts[_list_of(m)]) < _FEWEST_GEARS}
    greatest = {id(m) for m in geared if "maximum" in tokens(m.wanted.name)}
    for own in found.values():
        own[:] = [explained(m, {"gear"}) if id(m) in greatest else m for m in own if id(m) not in lone]


def _list_of(found: Match) -> tuple[object, ...]:
    statement = found.claim.statement
    return (statement.sheet, statement.page, statement.section)


def is_possible(found: Match) -> bool:
    """Whether the value, in one of its readings, lies where the wanted value can lie."""
    wanted, quantity = found.wanted, found.claim.quantity
    scale = quantity.si_value / quantity.value if quantity.value else 1.0
    readings = [quantity.si_value, *([quantity.other * scale] if quantity.other is not None else [])]
    return any(usual(wanted, reading) for reading in readings)


def add_twins(found: dict[str, list[Match]], claims: Sequence[Claim]) -> None:
    """Adds to a value's matches those of the same label under no heading at all: nothing says that they are another
    one's, where a heading had to help the first."""
    matched = {id(m.claim) for own in found.values() for m in own}
    bare: dict[tuple[str, str], list[Claim]] = {}
    for claim in claims:
        place = claim.statement
        if id(claim) not in matched and not (place.column or place.context or place.section):
            bare.setdefault((claim.words, claim.quantity.dimension), []).append(claim)
    for own in found.values():
        first = {(m.claim.words, m.claim.quantity.dimension): m for m in own if m.by_label and not m.by_head}
        own += [replace(m, claim=claim) for key, m in first.items() for claim in bare.get(key, ())]


def without_shared_headings(matches: list[Match]) -> list[Match]:
    """The matches without those of values that have no name but a heading which stands over other ones, too."""
    under: dict[tuple[object, ...], set[tuple[float, ...]]] = {}

    def place(one: Match) -> tuple[object, ...]:
        statement = one.claim.statement
        model = (statement.context, statement.label) if names_model(statement.label) else ()
        return (statement.sheet, statement.page, statement.section, statement.column, model)

    for one in matches:
        if not one.by_label and not one.by_head:
            under.setdefault(place(one), set()).add(one.claim.statement.box)
    return [m for m in matches if m.by_label or m.by_head or m.claim.ranged or len(under[place(m)]) == 1]


def ends_told_apart(found: dict[str, list[Match]], wanted: Sequence[Wanted]) -> dict[str, list[Match]]:
    """The matches, where a range has both of its ends asked for, and both are possible: the lower one speaks of the one
    value, the upper one of the other, and neither leaves open what is meant."""
    for low in (w for w in wanted if w.low_end_of in found):
        high = next(w for w in wanted if w.name == low.low_end_of)
        matched = {id(m.claim): m for m in found[low.name] + found[high.name] if m.claim.ranged}.values()
        told = {
            (id(m.claim.statement), m.claim.low): replace(
                m, wanted=low if m.claim.low else high, claim=replace(m.claim, ranged=False)
            )
            for m in matched
        }
        both = {at for at, _ in told if all((at, end) in told and is_possible(told[at, end]) for end in (True, False))}
        for name in (low.name, high.name):
            found[name] = [m for m in found[name] if not (m.claim.ranged and id(m.claim.statement) in both)]
        for (at, _), one in told.items():
            if at in both:
                found[one.wanted.name].append(one)
    return found


_CHART = re.compile(r"\blift(?:ing)? capacit(?:y|ies)\b", re.IGNORECASE)
"""A heading over a chart of loads."""
_LOADED = {"lift", "load", "radius", "capacity"}
"""What a value is called that such a chart may give itself."""
_SENTENCE = 8
"""So many words over a value, its own name among them, are a sentence that praises one machine of a series."""


def of_another_place(found: Match) -> str:
    """Why a value is in doubt that stands over a chart of loads and says what the chart holds for, or under a sentence
    that praises it."""
    section = found.claim.statement.section
    charted = _CHART.search(section) is not None and not read(section)
    if charted and found.wanted.dimension != "mass" and not _LOADED & set(tokens(found.wanted.name)):
        return f"the chart '{section}' holds for it"
    praised = len(section.split()) >= _SENTENCE and set(tokens(found.phrase)) <= set(tokens(section))
    if praised and not found.claim.statement.column:
        return f"it stands under '{section}'"
    return ""


_ORDINAL = re.compile(r"[fr]?(\d{1,2})(?:st|nd|rd|th|er|era|ere|eme|da|ra|ta|to|do|o|a|e)?")
_LEAST_COUNTED = 3
_GEARS = {"gear", "shift"}
"""What counts speeds: the travel speed is that of the highest, also of two."""


def extremes(matches: Sequence[Match], value: Callable[[Match], float]) -> list[Match]:
    """Of values that the rows of each column count one by one, and that rise or fall with the count, the greatest where
    a maximum is meant, the least where a minimum is; [] where the matches are anything else. `value`: in SI."""
    speeds = all(m.wanted.dimension == "speed" for m in matches)
    geared = speeds and all(_GEARS & {*tokens(m.claim.words)} for m in matches)
    meant = _meant(matches) or ("maximum" if geared else None)
    found: list[Match] = []
    for rows in _by_count(matches):
        values = [[value(m) for m in rows[count]] for count in sorted(rows)]
        rises = all(max(a) < min(b) or (speeds and a == b) for a, b in pairwise(values))
        falls = all(min(a) > max(b) for a, b in pairwise(values))
        if meant is None or len(rows) < (2 if geared else _LEAST_COUNTED) or not (rises or falls):
            return []
        found += rows[max(rows) if rises == (meant == "maximum") else min(rows)]
    return found


def are_all_gears(matches: Sequence[Match]) -> bool:
    """Whether matches are the speeds of all gears, counted from the first with none left out, of which the greatest is
    asked for: that of the last is it."""
    meant = all(m.wanted.dimension == "speed" and "maximum" in tokens(m.wanted.name) for m in matches)
    counts = [sorted(rows) for rows in _by_count(matches)]
    whole = [len(own) >= _LEAST_COUNTED and own[0] == 1 and all(b - a <= 1 for a, b in pairwise(own)) for own in counts]
    return meant and bool(whole) and all(whole)


def _by_count(matches: Sequence[Match]) -> list[dict[float, list[Match]]]:
    """By column of a table, the matches by the number that their row counts with; [] where one has none."""
    columns: dict[tuple[object, ...], dict[float, list[Match]]] = {}
    for one in matches:
        count, place = _count(one), one.claim.statement
        if count is None:
            return []
        column = (place.sheet, place.page, place.column, place.section)
        columns.setdefault(column, {}).setdefault(count, []).append(one)
    return list(columns.values())


def _meant(matches: Sequence[Match]) -> str | None:
    """Which extreme a value's name or the words of each of its matches say; None where none or both."""
    said = [{*tokens(m.wanted.name), *tokens(m.claim.words), *tokens(m.claim.head)} for m in matches]
    meant = [word for word in ("maximum", "minimum") if all(word in words for words in said)]
    return meant[0] if len(meant) == 1 else None


def _count(found: Match) -> float | None:
    """The number that a row of speeds begins with, or that a row counts with in its label or as its name; None where
    there is none, or several."""
    statement = found.claim.statement
    key = _KEY.match(statement.quote) if found.wanted.dimension == "speed" else None
    words = [w for text in (found.claim.words, *statement.variant) for w in tokens(text)]
    counts = [int(m.group(1)) for w in words if (m := _ORDINAL.fullmatch(w))]
    if key is not None and not counts:
        return float(key.group(1))
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
