"""Two extractors, one word: what the rules and a language model say of the same wanted value.

Agreement raises confidence, disagreement is a `conflict` with both candidates, and what only the model found is for a
person to review: a model that says yes to everything must not be able to make a value `ok`.
"""

from __future__ import annotations

from dataclasses import replace

from yellowiron.model.specification import Candidate, Specification
from yellowiron.model.template import Wanted
from yellowiron.specs.values.requested import check_hint, hint_for
from yellowiron.specs.values.tolerances import DOUBTFUL

_EQUAL = 1e-6
"""Relative difference of two readings of the same printed number."""


def agreed(wanted: Wanted, by_rules: Specification, by_model: Specification) -> Specification:
    """The specification that both extractors' words make."""
    if by_model.value is None and not by_model.candidates:
        said = by_rules.status in ("ok", "review")
        return replace(by_rules, reason=f"{by_rules.reason}; {by_model.reason}") if said else by_rules
    if by_rules.status == "missing":
        if by_model.status == "ok":
            by_model = replace(by_model, status="review", confidence=min(by_model.confidence, DOUBTFUL))
        hint = by_model.hint or check_hint(wanted.name)
        return replace(by_model, reason=f"{by_model.reason}; the rules do not find it", hint=hint)
    if by_rules.value is None or by_model.value is None:
        return by_rules  # a conflict that the rules see is not the model's to settle
    if _same(by_rules.value, by_model.value):
        surer = 1.0 - (1.0 - by_rules.confidence) * (1.0 - by_model.confidence)
        return replace(by_rules, confidence=round(surer, 3), reason=f"{by_rules.reason}; {by_model.reason}")
    return _conflict(wanted, by_rules, by_model)


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
        reason=f"the rules read {by_rules.text}, and {by_model.reason.split(';')[0]} at {by_model.text}",
        hint=hint_for(wanted),
        candidates=tuple(candidates),
    )
