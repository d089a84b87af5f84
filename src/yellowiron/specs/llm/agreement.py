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
from yellowiron.specs.language.vocabulary import tokens
from yellowiron.specs.llm.page_reader import Pointed, says_in_full
from yellowiron.specs.values.claims import COUNTED_TOGETHER, configured_by
from yellowiron.specs.values.decision import Sheets, decide, evidence_of, missing, printed, settled
from yellowiron.specs.values.matching import Match
from yellowiron.specs.values.requested import check_hint, hint_for, usual
from yellowiron.specs.values.stated_configuration import Stated
from yellowiron.specs.values.tolerances import DOUBTFUL, SURE
from yellowiron.support.units import SI_UNIT

_EQUAL = 1e-6
"""Relative difference of two readings of the same printed number."""


@dataclass(frozen=True)
class Asked:
    """What two readers are heard on: a wanted value, how the rules' claims speak of it, the sheets and the
    configuration that is meant, the model's name."""

    wanted: Wanted
    matches: Sequence[Match]
    sheets: Sheets
    config: str
    model: str


def agreed(asked: Asked, by_rules: Specification, pointed: Sequence[Pointed]) -> Specification:
    """The specification that both readers' words make."""
    if not pointed:
        return by_rules
    if by_rules.value is None and not by_rules.candidates:
        return _brought(asked, pointed)
    own = _brought(asked, pointed)
    if by_rules.value is None:
        return _out_of_conflict(asked, by_rules, pointed)
    if own.value is None or not _same(by_rules.value, own.value):
        return _conflict(asked.wanted, by_rules, own)
    if any(p.sure for p in pointed) or any(_settles(asked, m, by_rules.value) for m in asked.matches):
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
        if not any(_same(quantity.si_value, c.value) for c in candidates):
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
    others = [m for m in asked.matches if not _same(settled(wanted, m.claim)[0].si_value, candidates[0].value)]
    sure = first.sure and len(candidates) == 1 and all(m.score < first.match.score for m in others)
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


def _settles(asked: Asked, found: Match, value: float) -> bool:
    """Whether a match of the rules is of this value, and doubted for nothing but what a second reader settles: the
    order of its words on the page, words of a heading, parts that are counted."""
    quantity, _ = settled(asked.wanted, found.claim)
    doubt = settled(asked.wanted, replace(found.claim, doubt=""))[1]
    counted = found.claim.doubt.endswith(COUNTED_TOGETHER)
    return (
        _same(quantity.si_value, value)
        and not doubt
        and (counted or not found.claim.doubt)
        and not found.claim.ranged
        and usual(asked.wanted, quantity.si_value)
        and says_in_full(found)
    )


def _out_of_conflict(asked: Asked, by_rules: Specification, pointed: Sequence[Pointed]) -> Specification:
    """The candidate that the model points to, where its row, its column or a footnote tells it from the others."""
    for one in pointed:
        value = settled(asked.wanted, one.match.claim)[0].si_value
        own = [c for c in by_rules.candidates if _same(c.value, value)]
        others = [c for c in by_rules.candidates if not _same(c.value, value)]
        if not own:
            continue
        if one.place.footnote:
            stated = Stated(one.place.footnote, one.place.statement.page)
            chosen = decide(asked.wanted, asked.matches, replace(asked.sheets, stated=(stated,)), asked.config)
            if chosen.status == "ok" and chosen.value is not None and _same(chosen.value, value):
                return replace(chosen, reason=f"{_both(asked, one)}; {chosen.reason}")
        if one.sure and _is_told_apart(asked.wanted, one, others):
            chosen = _brought(asked, [one])
            said = _both(asked, one)
            return replace(chosen, status="ok", confidence=SURE, reason=said, hint="", candidates=(*own, *others))
    return by_rules


def _is_told_apart(wanted: Wanted, one: Pointed, others: Sequence[Candidate]) -> bool:
    """Whether a candidate's row says a word of the wanted value's name that no other's says; or all stand on one row,
    and the configuration names its column."""
    statement = one.place.statement
    said = set(tokens(f"{statement.label} {' '.join(statement.column)}"))
    if any(not set(tokens(wanted.name)) & said - set(tokens(c.evidence.quote)) for c in others):
        box = statement.box
        row = [c.evidence.box for c in others if c.evidence.page == statement.page]
        level = all(b is not None and b[1] < box[3] and box[1] < b[3] for b in row)
        return one.place.in_columns and level and len(row) == len(others)
    return True


def _both(asked: Asked, one: Pointed) -> str:
    return f"rules and {asked.model} read the same beside '{one.place.statement.label}'"


def _same(a: float, b: float) -> bool:
    return abs(a - b) <= _EQUAL * max(abs(a), abs(b))


def _conflict(wanted: Wanted, by_rules: Specification, by_model: Specification) -> Specification:
    candidates: list[Candidate] = []
    for candidate in (*by_rules.candidates, *by_model.candidates):
        if not any(_same(candidate.value, kept.value) for kept in candidates):
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
