"""Two readers, one word: what the rules and a language model say of the same wanted value.

What the model points to is `ok` only where the page's own words say it in full (`Pointed.sure`), or where the rules
read the same number and doubted it for a reason that a second reader settles. Disagreement is a `conflict` with both
candidates. A conflict of the rules is settled by the row, the column or the footnote that is pointed to, and not by
the model's word.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from yellowiron.model.specification import Candidate, Specification
from yellowiron.model.template import Wanted
from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.quantities import Quantity, same
from yellowiron.specs.language.vocabulary import tokens
from yellowiron.specs.llm.doubts import Doubted, alike, is_answered, reads_same
from yellowiron.specs.llm.page_reader import Pointed
from yellowiron.specs.llm.pointing import Spot
from yellowiron.specs.values.claims import configured_by, split_phrases
from yellowiron.specs.values.contention import Match, of_another_place
from yellowiron.specs.values.cross_check import Nearby
from yellowiron.specs.values.decision import Sheets, decide, evidence_of, missing, printed, settled
from yellowiron.specs.values.requested import check_hint, hint_for
from yellowiron.specs.values.stated_configuration import Stated
from yellowiron.specs.values.tolerances import DOUBTFUL, SURE
from yellowiron.support.units import SI_UNIT


@dataclass(frozen=True)
class Asked:
    """What two readers are heard on: a wanted value among `every` one, how the rules' claims speak of it and what their
    second reading brought, the sheets and the configuration that is meant, the model's name."""

    wanted: Wanted
    every: Sequence[Wanted]
    matches: Sequence[Match]
    nearby: Nearby | None
    sheets: Sheets
    config: str
    model: str
    ruled: Specification | None = None
    """The rules' word, also where only the model's is asked for."""


def agreed(
    asked: Asked, by_rules: Specification, pointed: Sequence[Pointed], seen: Sequence[Spot] = ()
) -> Specification:
    """The specification that both readers' words make. `seen`: where the model's numbers stand, also those that its own
    label does not bear out."""
    doubted = Doubted(asked.wanted, asked.every, asked.matches, asked.nearby)
    others = [p for p in pointed if p.sure and not alike(_value(p.match), by_rules.value or 0.0)]
    there = any(reads_same(by_rules, asked.sheets.files, spot) for spot in seen)
    if there and not others and is_answered(doubted, by_rules):
        said = f"rules and {asked.model} read the same beside '{by_rules.evidence.quote if by_rules.evidence else ''}'"
        return replace(by_rules, status="ok", confidence=SURE, reason=said, hint="")
    if not pointed:
        return by_rules
    if by_rules.value is None and not by_rules.candidates:
        return _brought(asked, pointed)
    own = _brought(asked, pointed)
    if by_rules.value is None:
        return _out_of_conflict(asked, by_rules, pointed)
    if own.value is None or not alike(by_rules.value, own.value):
        return _conflict(asked.wanted, by_rules, own)
    if (any(p.sure for p in pointed) and not _is_contended(asked, by_rules)) or is_answered(doubted, by_rules):
        return replace(by_rules, status="ok", confidence=SURE, reason=_both(asked, pointed[0]), hint="")
    return replace(by_rules, reason=f"{by_rules.reason}; {asked.model} reads the same")


def _brought(asked: Asked, pointed: Sequence[Pointed]) -> Specification:
    """What the model alone finds: `ok` where all it points to is one number that the page's words say in full, and
    better than the rules' claims say another one."""
    wanted = asked.wanted
    first = max(pointed, key=lambda p: (p.sure, p.match.score))
    candidates: list[Candidate] = []
    for one in sorted(pointed, key=lambda p: p is not first):
        quantity, doubt = settled(wanted, one.match.claim)
        if not any(alike(quantity.si_value, c.value) for c in candidates):
            candidates.append(
                Candidate(
                    value=quantity.si_value,
                    unit=SI_UNIT[wanted.dimension],
                    evidence=evidence_of(one.match, asked.sheets),
                    configuration=", ".join(configured_by(one.match.claim)),
                    confidence=round(one.match.score, 3),
                    reason=doubt or f"{asked.model} points to it",
                )
            )
    others = [m for m in asked.matches if not alike(settled(wanted, m.claim)[0].si_value, candidates[0].value)]
    sure = first.sure and len(candidates) == 1 and all(m.score < first.match.score for m in others)
    sure = sure and not (asked.ruled and _reads_another(asked.ruled, candidates[0].value))
    return replace(
        missing(wanted),
        value=candidates[0].value,
        status="ok" if sure else "review",
        evidence=candidates[0].evidence,
        text=printed(settled(wanted, first.match.claim)[0]),
        confidence=round(min(first.match.score, SURE if sure else DOUBTFUL), 3),
        reason=f"{asked.model} points to it beside '{first.place.statement.label}'; the rules do not find it",
        hint="" if sure else check_hint(wanted.name),
        candidates=tuple(candidates),
    )


def _reads_another(by_rules: Specification, value: float) -> bool:
    """Whether the rules read another number, or others beside this one, and not in vain: their `ok`, and what they
    could not choose from, speaks against a model that points to one of them."""
    own = [c.value for c in by_rules.candidates] + ([] if by_rules.value is None else [by_rules.value])
    return any(not alike(one, value) for one in own)


def _is_contended(asked: Asked, by_rules: Specification) -> bool:
    """Whether the nearest words give another number than the layout ("BIN WIDTH" between "3601" and "5612"), or what
    stands over the value praises another machine or is a chart's."""
    if any(of_another_place(m) for m in asked.matches if alike(_value(m), by_rules.value or 0.0)):
        return True
    said = [by_rules.value or 0.0, *map(_value, asked.matches)]
    return any(not any(alike(c.value, one) for one in said) for c in by_rules.candidates)


def _out_of_conflict(asked: Asked, by_rules: Specification, pointed: Sequence[Pointed]) -> Specification:
    """The candidate that the model points to, where its row, its column or a footnote tells it from the others."""
    for one in pointed:
        value = _value(one.match)
        own = [c for c in by_rules.candidates if alike(c.value, value)]
        rounded = [_value(m) for m in asked.matches if _rounds(m.claim.quantity, one.match.claim.quantity)]
        others = [c for c in by_rules.candidates if not any(alike(c.value, v) for v in (value, *rounded))]
        if not own:
            continue
        if one.sure and not others:
            return replace(_brought(asked, [one]), status="ok", confidence=SURE, reason=_both(asked, one), hint="")
        if one.place.footnote:
            stated = Stated(one.place.footnote, one.place.statement.page)
            chosen = decide(asked.wanted, asked.matches, replace(asked.sheets, stated=(stated,)), asked.config)
            if chosen.status == "ok" and chosen.value is not None and alike(chosen.value, value):
                return replace(chosen, reason=f"{_both(asked, one)}; {chosen.reason}")
        if one.sure and _is_told_apart(asked, one, others):
            chosen = _brought(asked, [one])
            said = _both(asked, one)
            return replace(chosen, status="ok", confidence=SURE, reason=said, hint="", candidates=(*own, *others))
    return by_rules


def _value(found: Match) -> float:
    return settled(found.wanted, found.claim)[0].si_value


def _rounds(other: Quantity, fine: Quantity) -> bool:
    """Whether a number is another, more finely printed one, rounded."""
    return other.si_half > fine.si_half and same(other, fine)


def _is_told_apart(asked: Asked, one: Pointed, others: Sequence[Candidate]) -> bool:
    """Whether a candidate's row says a word of the wanted value's name that no other's says, or names the configuration
    that is meant ("Operating weight – SU") as no other's; or all stand on one row, and the configuration names its
    column; or it is the end of a range that holds all others: "9.35 m to 30.5 m", and a chart for each length
    between."""
    wanted, statement = asked.wanted, one.place.statement
    ends = [q.si_value for r in read(statement.text, unit=statement.unit) for q in r.numbers]
    value = _value(one.match)
    if len(ends) == 2 and value in ends and all(min(ends) <= c.value <= max(ends) for c in others):
        return True
    said = set(tokens(f"{statement.label} {' '.join(statement.column)}"))
    explained = set(tokens(one.match.phrase))
    beyond = [{t for t in tokens(c.evidence.quote) if t.isalpha()} - explained for c in others]
    if said - explained in [set(words) for words in map(tokens, split_phrases(asked.config)) if words]:
        return said - explained not in beyond
    if any(not set(tokens(wanted.name)) & said - set(tokens(c.evidence.quote)) for c in others):
        box = statement.box
        row = [c.evidence.box for c in others if c.evidence.page == statement.page]
        level = all(b is not None and b[1] < box[3] and box[1] < b[3] for b in row)
        return one.place.in_columns and level and len(row) == len(others)
    return True


def _both(asked: Asked, one: Pointed) -> str:
    return f"rules and {asked.model} read the same beside '{one.place.statement.label}'"


def _conflict(wanted: Wanted, by_rules: Specification, by_model: Specification) -> Specification:
    candidates: list[Candidate] = []
    for candidate in (*by_rules.candidates, *by_model.candidates):
        if not any(alike(candidate.value, kept.value) for kept in candidates):
            candidates.append(candidate)
    return replace(
        by_rules,
        value=None,
        status="conflict",
        text=f"{by_rules.text} | {by_model.text}",
        confidence=0.0,
        reason=f"the rules read {by_rules.text}, and {by_model.reason.split(' beside')[0]} at {by_model.text}",
        hint=hint_for(wanted),
        candidates=tuple(candidates),
    )
