"""Configurations that the end of a label or heading names: "Shoe width – STD/XL", "Engine – LGP"."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from yellowiron.specs.values.claims import Claim, phrases_in, without_case

_TAIL = re.compile(r"\s[–—-]\s|[(:]")
_BETWEEN = re.compile(r"[\s/,&+()]+")


def of_configuration(claims: Sequence[Claim], config: str) -> list[Claim]:
    """The claims without those whose label or headings name other configurations at their end, and not the one that is
    asked for; where they name that one, the label is without it. Configurations are what heads columns beside a column
    that is headed by the one asked for, anywhere in the sheet."""
    asked = phrases_in(config)
    rows: dict[tuple[int, int], set[frozenset[str]]] = {}
    for claim in claims:
        heads = frozenset(without_case(head) for head in claim.statement.column)
        rows.setdefault((claim.statement.page, claim.statement.row), set()).add(heads)
    beside = [columns for columns in rows.values() if any(heads & asked for heads in columns)]
    own = {head for columns in beside for heads in columns if heads & asked for head in heads}
    others = {head for columns in beside for heads in columns for head in heads} - own
    if not others:
        return list(claims)
    return [_without_tail(claim, own, others) for claim in claims if not _is_others(claim, own, others)]


def _is_others(claim: Claim, own: set[str], others: set[str]) -> bool:
    statement = claim.statement
    named = [_named(text) for text in (claim.words, *statement.context, statement.section)]
    return any(words & others and not words & own for words in named)


def _named(text: str) -> set[str]:
    """What the end of a text may name: its words, and all of it."""
    parts = _TAIL.split(text)
    if len(parts) < 2:
        return set()
    return {without_case(word) for word in (*_BETWEEN.split(parts[-1]), parts[-1])} - {""}


def _without_tail(claim: Claim, own: set[str], others: set[str]) -> Claim:
    words = {without_case(word) for word in _BETWEEN.split(_TAIL.split(claim.words)[-1])} - {""}
    if not _named(claim.words) or not words & own or not words <= own | others:
        return claim
    end = [match.start() for match in _TAIL.finditer(claim.words)][-1]
    return replace(claim, words=claim.words[:end].strip())
