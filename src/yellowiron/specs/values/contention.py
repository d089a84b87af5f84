"""A match of a claim with a wanted value, and what several matches say of each other: twins, shared headings, ends."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

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


_GEAR = {"gear", "shift", "reverse", "r"}
_NUMBERED = re.compile(r"\d")
_FEWEST_GEARS = 3


def is_gear(words: str) -> bool:
    """Whether a row is called by its gear, and no more: "4th gear", "2", "R"."""
    said = tokens(words)
    named = {t for t in said if not _NUMBERED.search(t)}
    return bool(said) and named <= _GEAR and (len(named) < len(said) or "r" in named)


def without_lone_gears(found: Mapping[str, list[Match]]) -> None:
    """Takes off the speeds of rows that are called by their gears where the page does not count three: one alone says
    nothing of the greatest speed."""
    speeds = [m for own in found.values() for m in own if m.wanted.dimension == "speed" and "gear" in m.rest]
    geared = [m for m in speeds if is_gear(m.claim.words) and not m.by_head]
    counts: dict[tuple[object, ...], set[str]] = {}
    for one in geared:
        counts.setdefault(_list_of(one), set()).update(t for t in tokens(one.claim.words) if _NUMBERED.search(t))
    lone = {id(m) for m in geared if len(counts[_list_of(m)]) < _FEWEST_GEARS}
    for own in found.values():
        own[:] = [m for m in own if id(m) not in lone]


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
