"""What a plain reading of the pages (`nearest`) adds to the rules: values that they missed, and doubts.

It also reads the rules' own cells with what they leave unsaid: a unit, or the word that a unit says. A value that only
this reading finds is to be reviewed; one that the rules hold to be undisputed, but whose words stand
beside another value, too.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, replace

from yellowiron.model.specification import Candidate, Evidence, Specification
from yellowiron.model.template import Wanted
from yellowiron.specs.language.decimal_style import DecimalStyle
from yellowiron.specs.language.quantities import Quantity
from yellowiron.specs.language.vocabulary import KNOWN, TELLING, tokens
from yellowiron.specs.layout.nearest import Near, Side
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.pages.strokes import Box
from yellowiron.specs.values.claims import BARE_UNITS, Claim, claims_of, phrases_in
from yellowiron.specs.values.contention import Match, extremes
from yellowiron.specs.values.decision import Sheets, candidate, evidence_of, name_printed, printed, settled, specified
from yellowiron.specs.values.matching import match
from yellowiron.specs.values.requested import check_hint, usual
from yellowiron.specs.values.tolerances import DOUBTFUL, SURE
from yellowiron.support.text import with_article

_UNITS = {**BARE_UNITS, "angle": ("°",), "time": ("s",)}
_AROUND: tuple[Side, ...] = ("left", "above", "below")
_WITHIN: tuple[Side, ...] = ("behind", "item", "cell")
"""What speaks only where the words around a value do not."""
_SIDES = (*_AROUND, "under", *_WITHIN)
_SAID_BY_UNIT = {
    "angular_speed": "speed", "flow": "flow", "force": "force", "length": "length", "mass": "weight", "power": "power",
    "pressure": "pressure", "time": "time",
}  # fmt: skip
"""What a unit says of its number, though the label leaves it out: "Dipper 880 mm" is a length."""
_NEARBY = 0.4
"""Confidence of a value that only the nearest words name: less than of a doubtful one whose layout was understood."""


@dataclass(frozen=True)
class Nearby:
    """What the second reading brought for review, and on which side of the value the words stand."""

    match: Match
    side: Side


def second_reading(
    wanted: Sequence[Wanted],
    values: Mapping[str, Specification],
    near: Sequence[tuple[Sequence[Near], DecimalStyle]],
    sheets: Sheets,
    config: str = "",
) -> tuple[dict[str, Specification], dict[str, Nearby]]:
    """The values with those that the words nearest to a value name, and doubts where they name another one.

    On each side of the values the words speak for themselves: the side with the most matches first, as that is how the
    pages print their labels, and what is said within a text last; a value counts once. Where one label has several
    values, `config` chooses the one that stands under its name, also out of a conflict of the rules. `near`: what each
    file prints, with how it writes decimals. And by name what was brought.
    """
    brought: dict[str, Nearby] = {}
    if not any(own for own, _ in near):
        return dict(values), brought
    asked = {w.name: w for w in wanted if w.in_label_of is None}
    taken = [(seen, value) for one in values.values() if one.status != "missing" for seen, value in _seen(one)]
    found = dict(values)
    readings, chosen = _undisputed(list(asked.values()), near, config)
    under = {n: one for n, one in readings["under"].items() if n not in readings["above"] and _names(one, values[n])}
    for name, one in (readings["left"] | under).items():
        quantity, _ = settled(asked[name], one.claim)
        told = quantity.unit_printed or name in under
        if values[name].status == "ok" and told and _differs(values[name], quantity):
            found[name] = _doubted(values[name], one, quantity, sheets)
    around = sorted(_AROUND, key=lambda side: len(readings[side]), reverse=True)  # stable: left, above, below
    for side in (*around, *_WITHIN):
        listed = side in _WITHIN  # a cell may give the values of several names
        for name, one in readings[side].items():
            evidence, own = evidence_of(one, sheets), _value(one)
            settles = side == "left" and name in chosen and _is_offered(values[name], one)
            if found[name].status == "conflict" and settles:
                found[name], brought[name] = _to_review(one, side, sheets), Nearby(one, side)
            used = any(_is_there(evidence, seen) and not (listed and value != own) for seen, value in taken)
            if not used and (found[name].status == "missing" or _is_nothing(asked[name], found[name])):
                found[name], brought[name] = _to_review(one, side, sheets), Nearby(one, side)
                taken.append((evidence, own))
    return found, brought


def _undisputed(
    asked: Sequence[Wanted], near: Sequence[tuple[Sequence[Near], DecimalStyle]], config: str
) -> tuple[dict[Side, dict[str, Match]], AbstractSet[str]]:
    """By side, the wanted values of which the words there give one, and only one, that is usual; those of them at the
    left for which the configuration had to choose."""
    place_of = {id(n.statement): n for own, _ in near for n in own}
    meant = phrases_in(config)
    claims = [
        claim
        for own, style in near
        for side in _SIDES
        for claim in _filled_in(claims_of([n.statement for n in own if n.side == side], style), side)
    ]
    found: dict[Side, dict[str, Match]] = {side: {} for side in _SIDES}
    chosen: set[str] = set()
    for name, matches in match(claims, asked).items():
        for side in _SIDES:
            sure = [m for m in matches if place_of[id(m.claim.statement)].side == side and _is_sure(m, side)]
            if meant and _differ(sure):
                sure = [m for m in sure if _stands_under(place_of[id(m.claim.statement)], meant)]
                chosen.update([name] if side == "left" else [])
            sure = extremes(sure, _value) if _differ(sure) else sure
            if sure and not _differ(sure):
                found[side][name] = sure[0]
    return found, chosen


def _is_nothing(wanted: Wanted, value: Specification) -> bool:
    """Whether what the rules bring for review says of a thing that there is none: a travel speed of 0 mph."""
    return value.status == "review" and value.value == 0.0 and not usual(wanted, 0.0)


def _differ(matches: Sequence[Match]) -> bool:
    return len({f"{_value(m):.9g}" for m in matches}) > 1


def _stands_under(near: Near, meant: AbstractSet[str]) -> bool:
    """Whether a name of the configuration stands over a value."""
    return any(own and own <= meant for own in map(phrases_in, near.over))


def _is_offered(value: Specification, one: Match) -> bool:
    """Whether a value is among a conflict's candidates."""
    return any(abs(c.value - _value(one)) <= 1e-9 * abs(c.value) for c in value.candidates)


def _is_sure(found: Match, side: Side) -> bool:
    """Whether the words speak of the value and of nothing else; behind a count, a name may stand between them."""
    rest = {word for word in found.rest if side != "behind" or word in KNOWN | TELLING}
    clear = not rest and (found.score >= SURE or side == "behind")
    unsaid = _SAID_BY_UNIT.get(found.wanted.dimension)
    if side == "cell" and unsaid in tokens(found.claim.words) and unsaid not in tokens(found.claim.statement.label):
        statement, phrase = found.claim.statement, set(tokens(found.phrase)) - {unsaid}
        label = set(tokens(statement.label)) if statement.label else {t for h in statement.column for t in tokens(h)}
        above = [h for h in (*statement.column, *statement.context) if h != statement.text]
        headed = bool(statement.label) and any(KNOWN & set(tokens(h)) for h in above)
        clear = (
            clear and not headed and bool(label) and (label <= phrase or (statement.running and bool(label & phrase)))
        )
    return clear and not found.claim.doubt and usual(found.wanted, _value(found))


def _filled_in(claims: Sequence[Claim], side: Side) -> list[Claim]:
    """The claims, those of bare numbers in every unit that a sheet may leave unsaid, as what is usual tells them apart
    (but how many parts a thing has is no length); those of the layout's cells with what their unit says."""
    found: list[Claim] = []
    for claim in claims:
        unsaid = _SAID_BY_UNIT.get(claim.quantity.dimension) if side == "cell" else None
        found.append(replace(claim, words=f"{claim.words} {unsaid}") if unsaid else claim)
        bare = not claim.quantity.unit and claim.quantity.sign in ("", "±") and "%" not in claim.statement.text
        if bare and side != "behind" and (side != "cell" or claim.quantity.value >= 10.0):
            units = [unit for group in _UNITS.values() for unit in group]
            found += [replace(claim, quantity=replace(claim.quantity, unit=unit)) for unit in units]
    return found


def _value(found: Match) -> float:
    return settled(found.wanted, found.claim)[0].si_value


def _names(one: Match, value: Specification) -> bool:
    """Whether the words right under a number are those that name another value: in a drawing they name the number."""
    statement, seen = one.claim.statement, value.evidence
    return seen is not None and seen.page == statement.page and seen.quote.startswith(statement.label)


def _differs(value: Specification, quantity: Quantity) -> bool:
    slack = max(1e-6 * abs(quantity.si_value), quantity.si_digit)
    return value.value is None or abs(value.value - quantity.si_value) > slack


def stands_in(value: Statement, cell: Statement) -> bool:
    """Whether a value stands in the cell of a statement."""
    return value.page == cell.page and _inside(value.box, cell.box)


def _is_there(one: Evidence, other: Evidence) -> bool:
    return (one.file, one.page) == (other.file, other.page) and bool(
        one.box and other.box and _inside(one.box, other.box)
    )


def _inside(box: Box, outer: Box) -> bool:
    x, y = (box[0] + box[2]) / 2, (box[1] + box[3]) / 2
    return outer[0] <= x <= outer[2] and outer[1] <= y <= outer[3]


def _seen(value: Specification) -> list[tuple[Evidence, float | None]]:
    own = [(value.evidence, value.value), *((c.evidence, c.value) for c in value.candidates)]
    return [(evidence, number) for evidence, number in own if evidence is not None]


def _to_review(one: Match, side: Side, sheets: Sheets) -> Specification:
    wanted, (quantity, _) = one.wanted, settled(one.wanted, one.claim)
    why = f"the layout was not understood there; the words nearest to it are '{name_printed(one)}'"
    if side == "behind":
        why = f"'{one.claim.statement.label}' is what the sheet says {quantity.text} of"
    elif side == "cell" and not one.claim.statement.unit and not quantity.text.strip("0123456789., "):
        why = f"the sheet prints no unit for '{quantity.text}': in {quantity.unit} it would be usual"
    elif side == "cell":
        why = f"that '{name_printed(one)}' is {with_article(wanted.dimension.replace('_', ' '))}, only its unit says"
    return specified(
        wanted,
        quantity.si_value,
        "review",
        evidence=evidence_of(one, sheets),
        text=printed(quantity),
        confidence=_NEARBY,
        reason=why,
        hint=check_hint(wanted.name),
        candidates=(_candidate(one, quantity, sheets),),
    )


def _doubted(value: Specification, one: Match, quantity: Quantity, sheets: Sheets) -> Specification:
    return replace(
        value,
        status="review",
        confidence=min(value.confidence, DOUBTFUL),
        reason=f"'{name_printed(one)}' stands beside '{quantity.text}', too; {value.reason}",
        hint=check_hint(value.name),
        candidates=(*value.candidates, _candidate(one, quantity, sheets)),
    )


def _candidate(one: Match, quantity: Quantity, sheets: Sheets) -> Candidate:
    reason = f"the words nearest to it are '{name_printed(one)}'"
    return replace(candidate(one, sheets, quantity.si_value), configuration="", confidence=_NEARBY, reason=reason)
