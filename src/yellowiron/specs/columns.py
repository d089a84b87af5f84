"""The columns of a sheet's tables, and what the ends of labels name: the models or configurations that `--config`
chooses among."""

from __future__ import annotations

import re
from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, replace

from yellowiron.specs.layout.statement import Statement, is_key, is_unit
from yellowiron.specs.reader import Sheet
from yellowiron.specs.values.claims import Claim, is_system, phrases_in, sisters_in, without_case

_FEWEST = 3
"""Values under a head that name a column; a table with fewer is none of specifications."""


@dataclass(frozen=True)
class SheetColumn:
    """A column: its head as `--config` takes it, the sheet's file, the first page it stands on (1 = first), and how
    many values stand under it."""

    name: str
    file: str
    page: int
    values: int


def columns_of(sheets: Sequence[Sheet]) -> list[SheetColumn]:
    """The columns that stand beside others of their row, each with its own values, in the order of the sheets."""
    found: list[SheetColumn] = []
    for sheet in sheets:
        rows: dict[tuple[int, int], list[Statement]] = {}
        for statement in sheet.statements:
            if statement.column:
                rows.setdefault((statement.page, statement.row), []).append(statement)
        under: dict[str, list[int]] = {}
        for row in rows.values():
            shared = set.intersection(*(set(s.column) for s in row))
            for statement in row if len(row) > 1 else []:
                for head in statement.column:
                    if head not in shared and _names_one(head):
                        under.setdefault(head, []).append(statement.page)
        found += [
            SheetColumn(head, sheet.file, min(pages), len(pages))
            for head, pages in under.items()
            if len(pages) >= _FEWEST
        ]
    return found


def _names_one(head: str) -> bool:
    """Whether a head may name a model or a configuration: it has letters, and is no unit, system or drawing's key."""
    return any(map(str.isalpha, head)) and not (is_unit(head) or is_system(head) or is_key(head))


def configured(claims: Sequence[Claim], config: str) -> list[Claim]:
    """The claims without those of other columns than the one that a configuration names to the letter: columns that
    stand beside it in some row, whether or not it has a value in theirs."""
    asked = phrases_in(config)
    rows: dict[tuple[int, int], list[Statement]] = {}
    for claim in claims:
        if claim.statement.column:
            rows.setdefault((claim.statement.page, claim.statement.row), []).append(claim.statement)
    others: set[tuple[str, ...]] = set()
    for row in rows.values():
        columns = {s.column for s in row}
        named = {c for c in columns for h in c if (o := phrases_in(h)) and (o <= asked or sisters_in(h) & asked)}
        if named:
            others.update(columns - named)
    return _in_line(asked, [c for c in claims if c.statement.column not in others])


def _in_line(asked: AbstractSet[str], claims: Sequence[Claim]) -> list[Claim]:
    """The claims without those of other columns than the one at whose head a value stands that the configuration names
    to the letter ("2.9 m" beside "Arm length"): where each cell of a row is in line with one of the values there, only
    the cell under that one."""
    rows: dict[tuple[int, int], list[Statement]] = {}
    for claim in claims:
        row = rows.setdefault((claim.statement.page, claim.statement.row), [])
        if claim.statement not in row:
            row.append(claim.statement)
    dropped: set[Statement] = set()
    for (page, _), heads in rows.items():
        named = [s for s in heads if without_case(s.text) in asked]
        if len(named) != 1 or len(heads) < 2:
            continue
        for (other_page, _), cells in rows.items():
            if other_page == page and len(cells) == len(heads) and cells[0].box[1] >= heads[0].box[1] - 1:
                pairs = zip(*(sorted(own, key=lambda s: s.box[0]) for own in (heads, cells)), strict=True)
                level = all(_overlap(a, b) for a, b in pairs)
                dropped.update(c for c in cells if level and not _overlap(named[0], c))
    return [c for c in claims if c.statement not in dropped]


def _overlap(a: Statement, b: Statement) -> bool:
    return a.box[0] < b.box[2] and b.box[0] < a.box[2]


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
