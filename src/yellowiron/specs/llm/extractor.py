"""The values a template asks for, as a language model finds them: the journal paper's flow on layout statements.

A row with one value is asked for its value and its unit apart, and a "none" discards it; a row with several is
summarised as a table, and every cell of it checked by yes or no. The model only points: the number is the one that the
rules read at that place, the column is chosen as it is for the rules, and gates in code turn away what is not printed
there, what the row's words do not say, and what they say of another value.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

from yellowiron.model.specification import Specification, fold
from yellowiron.model.template import Wanted
from yellowiron.specs.language.decimal_style import DecimalStyle
from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.quantities import Quantity, same
from yellowiron.specs.llm.endpoint import Answer, Endpoint
from yellowiron.specs.llm.prompts import (
    NAMES,
    TABLE,
    UNIT,
    VALUE,
    YES_NO,
    is_so,
    table_of,
    unit_of,
    value_of,
    which_names,
)
from yellowiron.specs.values.claims import Claim
from yellowiron.specs.values.decision import Sheets, decide, missing
from yellowiron.specs.values.matching import Match, match_one, weakly
from yellowiron.specs.values.tolerances import LEAST

_BATCH = 20
"""Rows that one question lists."""
_NONE = ("", "none", "no", "n/a", "null", "not stated", "not given")


@dataclass(frozen=True)
class Passage:
    """A row of a page: its claims (one property, one quantity each), and the row in words."""

    claims: tuple[Claim, ...]
    text: str


def find(
    wanted: Sequence[Wanted],
    claims: Sequence[Claim],
    sheets: Sheets,
    endpoint: Endpoint,
    *,
    config: str = "",
    style: DecimalStyle = "unknown",
    progress: Callable[[str], None] = lambda words: None,
) -> dict[str, Specification]:
    """What the model finds of every wanted value; `missing` where it finds nothing that passes the gates.

    `EndpointError` where the endpoint cannot be used.
    """
    direct = [w for w in wanted if w.in_label_of is None]
    found: dict[str, list[Match]] = {w.name: [] for w in direct}
    passages = passages_of(claims)
    for number, (passage, names) in enumerate(_routed(passages, direct, endpoint), 1):
        progress(f"Asking the language model ({number} of at most {len(passages)} rows)")
        asked = [w for w in direct if w.name in names]
        pointed = _single(passage, asked, endpoint, style) if _is_single(passage) else _several(
            passage, asked, endpoint, style
        )  # fmt: skip
        for one, claim in pointed:
            gated = gate(one, claim, direct)
            if gated is not None:
                found[one.name] += _with_other_columns(gated, passage)
    return {w.name: _decided(w, found[w.name], sheets, config, endpoint.options.model) for w in direct}


def passages_of(claims: Sequence[Claim]) -> list[Passage]:
    """The claims by row, in the sheets' order."""
    rows = groupby(claims, key=lambda c: (c.statement.page, c.statement.row))
    return [Passage(members, _text(members)) for members in (tuple(group) for _, group in rows)]


def gate(wanted: Wanted, claim: Claim, every: Sequence[Wanted]) -> Match | None:
    """How a claim that the model points to speaks of a wanted value; None where its words do not.

    Turned away: another dimension, forbidden or opposite words, none of the property's words, and a row whose words say
    another wanted value better. Words that say it in part make a weak match, which is for a person to review.
    """
    own = match_one(wanted, claim, every) or weakly(wanted, claim)
    if own is None:
        return None
    others = [m.score for w in every if w.name != wanted.name and (m := match_one(w, claim)) is not None]
    rival = max(others, default=0.0)
    return None if rival >= LEAST and rival > own.score else own


def _routed(
    passages: Sequence[Passage], wanted: Sequence[Wanted], endpoint: Endpoint
) -> Iterator[tuple[Passage, frozenset[str]]]:
    """The passages that the model takes for ones that state wanted values, with their names."""
    for start in range(0, len(passages), _BATCH):
        batch = passages[start : start + _BATCH]
        fitting = _fitting(wanted, [c for p in batch for c in p.claims])
        if not fitting:
            continue
        answer = endpoint.ask(which_names([p.text for p in batch], fitting), NAMES)
        names = {fold(w.name): w.name for w in fitting}
        chosen: dict[int, set[str]] = {}
        for entry in answer["lines"] if answer else ():
            name = names.get(fold(entry["name"]))
            if name is not None and 1 <= entry["line"] <= len(batch):
                chosen.setdefault(entry["line"] - 1, set()).add(name)
        for index in sorted(chosen):
            yield batch[index], frozenset(chosen[index])


def _fitting(wanted: Sequence[Wanted], claims: Sequence[Claim]) -> list[Wanted]:
    """The wanted values of a dimension that the claims have."""
    dimensions = {c.quantity.dimension for c in claims}
    return [w for w in wanted if w.dimension in dimensions]


def _single(
    passage: Passage, wanted: Sequence[Wanted], endpoint: Endpoint, style: DecimalStyle
) -> Iterator[tuple[Wanted, Claim]]:
    """Value and unit asked apart; a negative answer to either discards the row."""
    for one in _fitting(wanted, passage.claims):
        value = _said(endpoint.ask(value_of(passage.text, one), VALUE), "value")
        if value is None:
            continue
        unit = _said(endpoint.ask(unit_of(passage.text, one, value), UNIT), "unit")
        if unit is None and one.dimension != "count":
            continue
        yield from ((one, claim) for claim in _printed_there(passage, value, unit or "", style))


def _several(
    passage: Passage, wanted: Sequence[Wanted], endpoint: Endpoint, style: DecimalStyle
) -> Iterator[tuple[Wanted, Claim]]:
    """A table of the row; each of its cells is kept if the model says yes to it."""
    asked = _fitting(wanted, passage.claims)
    answer = endpoint.ask(table_of(passage.text, asked), TABLE) if asked else None
    names = {fold(w.name): w for w in asked}
    for entry in answer["rows"] if answer else ():
        one = names.get(fold(entry["name"]))
        claims = _printed_there(passage, entry["value"], entry["unit"], style)
        if one is None or not claims:
            continue
        checked = endpoint.ask(is_so(passage.text, one, entry["value"], entry["unit"]), YES_NO)
        if checked is not None and checked["answer"] == "yes":
            yield from ((one, claim) for claim in claims)


def _printed_there(passage: Passage, value: str, unit: str, style: DecimalStyle) -> list[Claim]:
    """The claims of a row that print this number and unit; none where the model made them up."""
    said = [q for r in read(f"{value} {unit}".strip(), style=style) for q in (*r.numbers, *r.partner)]
    if unit.strip().lower() in _NONE:
        said += [q for r in read(value, style=style) for q in (*r.numbers, *r.partner)]
    return [c for c in passage.claims if any(_is(q, s) for s in said for q in (c.quantity, c.partner) if q is not None)]


def _is(printed: Quantity, said: Quantity) -> bool:
    readings = [said.value] if said.other is None else [said.value, said.other]
    return printed.printed == said.printed and any(same(printed, replace(said, value=v)) for v in readings)


def _with_other_columns(found: Match, passage: Passage) -> list[Match]:
    """The match with its neighbours under other heads: which column is meant is not for the model to say."""
    own = found.claim
    return [found] + [
        replace(found, claim=claim)
        for claim in passage.claims
        if claim is not own
        and claim.words == own.words
        and claim.head != own.head
        and claim.quantity.dimension == own.quantity.dimension
    ]


def _decided(wanted: Wanted, found: Sequence[Match], sheets: Sheets, config: str, model: str) -> Specification:
    unique = {m.claim: m for m in found}
    specification = decide(wanted, list(unique.values()), sheets, config)
    if not found:
        return replace(missing(wanted), reason=f"{model} finds it on no sheet")
    return replace(specification, reason=f"{model} points to it; {specification.reason}")


def _is_single(passage: Passage) -> bool:
    return len(passage.claims) == 1


def _said(answer: Answer | None, name: str) -> str | None:
    text = str(answer[name]).strip() if answer is not None else ""
    return None if text.lower().strip(".") in _NONE else text


def _text(claims: Sequence[Claim]) -> str:
    """A row in words: its headings, its label, and each cell with its column's heads."""
    first = claims[0].statement
    place = " > ".join([*([first.section] if first.section else []), *first.context])
    cells = dict.fromkeys(
        (" / ".join((*c.statement.column, *c.statement.variant)), c.statement.text, c.statement.unit.replace("|", "/"))
        for c in claims
    )
    words = "; ".join(
        f"{head}: {text} {unit}".strip(": ") if head else f"{text} {unit}".strip() for head, text, unit in cells
    )
    return f"[{place}] {first.label} | {words}" if place else f"{first.label} | {words}"
