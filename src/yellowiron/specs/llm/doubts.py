"""Which doubts of the rules a second reader answers that read the same number at the same place of the page.

It answers what the layout left open: which words are a number's own, which row of several is meant, what a count is of.
It does not answer what the page itself leaves open: a range, a sign, two systems that differ, a value that cannot be
in any unit, a word that tells of a condition, of another body or of another wanted value.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, replace

from yellowiron.model.specification import Specification
from yellowiron.model.template import Wanted
from yellowiron.specs.language.vocabulary import HARMLESS, KNOWN, NEUTRAL, TELLING, tokens
from yellowiron.specs.layout.nearest import COUNTS
from yellowiron.specs.llm.pointing import Spot
from yellowiron.specs.values.claims import COUNTED_TOGETHER, PRINTED_FOR_A_FORCE
from yellowiron.specs.values.contention import Match, of_another_place
from yellowiron.specs.values.cross_check import Nearby
from yellowiron.specs.values.decision import OF_OTHERS, WOULD_BE_USUAL, is_broken_off, is_measures, settled
from yellowiron.specs.values.requested import phrases, usual
from yellowiron.specs.values.tolerances import LEAST, SURE

_EQUAL = 1e-6
"""Relative difference of two readings of the same printed number."""
_EXTENT = frozenset({"maximum", "minimum", "overall"})
"""What says how much of a property is meant, and not which property."""
_GEARS = frozenset({"gear", "shift"})
"""What a speed of a list of three gears and more is called by; with fewer the rules bring none."""
_UNDER_WHICH = re.compile(r"(?:\b(?:with|at|for|if|mit|bei|für|avec|pour|con|para)|@|\()\s*$", re.IGNORECASE)
"""What stands before a circumstance: "9.8 m/min with 6-part line"."""


@dataclass(frozen=True)
class Doubted:
    """A wanted value, among `every` that is asked for; how the rules' claims speak of it, and what their second
    reading brought."""

    wanted: Wanted
    every: Sequence[Wanted]
    matches: Sequence[Match]
    nearby: Nearby | None


def is_answered(doubted: Doubted, value: Specification) -> bool:
    """Whether the doubt about a value for review is one that a second reader answers by reading the same."""
    contended = any(not alike(c.value, value.value or 0.0) for c in value.candidates)
    if value.status != "review" or value.value is None or contended or OF_OTHERS in value.reason:
        return False
    if doubted.nearby is not None and alike(_value(doubted.nearby.match), value.value):
        return _is_named(doubted, doubted.nearby)
    own = [m for m in doubted.matches if alike(_value(m), value.value)]
    return any(_is_clear(doubted, m) for m in own)


def reads_same(value: Specification, files: Sequence[str], spot: Spot) -> bool:
    """Whether the number that is pointed to is the one that a value's evidence shows, and the words that are given for
    it stand there."""
    seen = value.evidence
    if seen is None or seen.box is None or (seen.file, seen.page) != (files[spot.sheet], spot.page):
        return False
    a, b = seen.box, spot.box
    there = a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]
    number, text = spot.number.casefold(), value.text.casefold()
    number = COUNTS.get(number, number)
    words = re.findall(r"[^\W\d_]+", spot.words.casefold())
    quote = f"{seen.quote} {spot.around}".casefold()
    return there and (number in text or text in number) and bool(words) and all(word in quote for word in words)


def says_in_full(found: Match) -> bool:
    """Whether a label says a value and nothing that a second reader could not settle: no word of it is left over, and
    none of its headings that tells of a condition or of another body."""
    if any(t in TELLING for t in found.rest):
        return False
    label = {t for t in tokens(found.claim.words) if t not in NEUTRAL}
    left = label - set(tokens(found.phrase)) - set(tokens(found.wanted.name))
    if found.phrase and not left:
        return True
    return found.score >= LEAST and not found.rest


def alike(a: float, b: float) -> bool:
    """Whether two readings are of the same printed number."""
    return abs(a - b) <= _EQUAL * max(abs(a), abs(b))


def _value(found: Match) -> float:
    return settled(found.wanted, found.claim)[0].si_value


def _is_clear(doubted: Doubted, found: Match) -> bool:
    """Whether nothing but the layout, or words that mean no other value, make a match doubtful."""
    claim, statement = found.claim, found.claim.statement
    quantity, doubt = settled(doubted.wanted, replace(claim, doubt=""))
    told = claim.doubt.endswith((COUNTED_TOGETHER, PRINTED_FOR_A_FORCE))
    open_ = is_broken_off(statement.label) or any(map(is_measures, statement.column)) or of_another_place(found)
    if doubt.endswith(WOULD_BE_USUAL) and not found.rest and found.score >= SURE:
        # "530 m/s" where the label says a lift speed in full: the range leaves one unit, if nothing can be as printed.
        as_printed = any(usual(doubted.wanted, m.claim.quantity.si_value) for m in doubted.matches)
        doubt = doubt if as_printed else ""
    if doubt or (claim.doubt and not told) or claim.ranged or open_ or not usual(doubted.wanted, quantity.si_value):
        return False
    rest = set(found.rest) - (_GEARS if doubted.wanted.dimension == "speed" else set())
    return says_in_full(replace(found, rest=tuple(sorted(rest)))) or (
        bool(found.rest) and _are_idle(doubted, found, rest)
    )


def _are_idle(doubted: Doubted, found: Match, words: AbstractSet[str]) -> bool:
    """Whether words that are left over are known, and no other wanted value can be meant by them: none is of another
    one's name in this dimension, and with the rest of the label they say none of any dimension."""
    own = set(tokens(found.phrase)) | set(tokens(doubted.wanted.name))
    if not words <= KNOWN or words & TELLING:
        return False
    return not words & _of_others(doubted, own, same_dimension=True) and not _says_another(doubted, found, own)


def _of_others(doubted: Doubted, own: AbstractSet[str], *, same_dimension: bool) -> frozenset[str]:
    """The words of other wanted values' phrases."""
    others = (w for w in doubted.every if w.name != doubted.wanted.name)
    named = (w for w in others if not same_dimension or w.dimension == doubted.wanted.dimension)
    return frozenset(t for w in named for p in phrases(w) for t in tokens(p)) - own


def _says_another(doubted: Doubted, found: Match, own: AbstractSet[str]) -> bool:
    """Whether the words of a label say another wanted value's phrase of several words."""
    said = set(tokens(found.claim.words)) | set(found.rest)
    for other in doubted.every:
        for phrase in phrases(other):
            named = set(tokens(phrase)) - NEUTRAL
            if other.name != doubted.wanted.name and len(named) > 1 and named <= said and named - own:
                return True
    return False


def _is_named(doubted: Doubted, nearby: Nearby) -> bool:
    """Whether the words next to a value that only the second reading brought say what is wanted."""
    found, statement = nearby.match, nearby.match.claim.statement
    said = set(tokens(statement.label))
    if nearby.side == "behind":
        begin = statement.text[: found.claim.quantity.start]
        above = {t for text in (*statement.context, statement.section, *statement.column) for t in tokens(text)}
        counted = doubted.wanted.dimension == "count" and set(tokens(doubted.wanted.name)) <= said | above
        return counted and _UNDER_WHICH.search(begin) is None
    if not statement.unit and not re.search(r"[^\W\d]", found.claim.quantity.text):
        return False  # its unit is what would be usual, and not printed there
    behind = set(tokens(statement.text[found.claim.quantity.end :])) - said - HARMLESS - NEUTRAL
    if nearby.side == "above" and behind & (KNOWN | TELLING):
        return False  # "2500 mm stick" under a label: it is the stick's
    left = said - set(tokens(found.phrase)) - HARMLESS - NEUTRAL
    if nearby.side == "cell":
        telling = (said & set(tokens(found.phrase))) - _EXTENT
        return bool(telling) and not left & (KNOWN | TELLING)
    named = [set(tokens(p)) for p in (found.phrase, doubted.wanted.name)]
    whole = [own for own in named if own <= said and (len(own) > 1 or own == set(tokens(doubted.wanted.name)))]
    return bool(whole) and not left & TELLING
