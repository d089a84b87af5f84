"""Rows that are counted: a spread's second page has their numbers alone, and its first says what they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.pages.words import Page, Word

_MANY = 10
"""Rows that are counted, at least."""
_DIGITS = 3
"""Of a row's number, at most."""
_UNDER = 3.0
"""Points within which the middles of numbers under each other lie."""


def with_numbers(statements: Sequence[Statement], page: Page) -> list[Statement]:
    """The statements of a page, those level with a number that counts its rows with that number."""
    numbers = _counted([w for w in page.words if w.text.isdecimal() and len(w.text) <= _DIGITS])

    def key(statement: Statement) -> str:
        level = [w for w in numbers if statement.box[1] <= (w.top + w.bottom) / 2 <= statement.box[3]]
        return f"{level[0].text}/{numbers[-1].text}" if len(level) == 1 else ""

    return [replace(s, key=key(s)) for s in statements] if numbers else list(statements)


def with_labels(statements: Sequence[Statement]) -> list[Statement]:
    """The statements of a sheet; those of a page whose rows have numbers and no labels have the labels, sub-headings
    and units of the last page before it whose rows have them, and are counted as far."""
    labels: Mapping[str, Statement] = {}
    found: list[Statement] = []
    for page in dict.fromkeys(s.page for s in statements):
        own = [s for s in statements if s.page == page]
        labelled = {s.key: s for s in reversed(own) if s.key and s.label}
        if labelled:
            labels = labelled
        else:
            own = [s if s.key not in labels else _said_by(s, labels[s.key]) for s in own if not _counts(s, labels)]
        found += own
    return found


def _counts(statement: Statement, labels: Mapping[str, Statement]) -> bool:
    """Whether what was taken for a value is the number of a row that is said elsewhere."""
    return statement.key in labels and statement.text == statement.key.partition("/")[0]


def _counted(numbers: Sequence[Word]) -> list[Word]:
    """The longest run of numbers under each other that go up one by one, of those that are long enough."""
    runs: list[list[Word]] = []
    waiting: dict[int, list[list[Word]]] = {}
    for word in sorted(numbers, key=lambda w: w.top):
        number, middle = int(word.text), (word.x0 + word.x1) / 2
        above = [r for r in waiting.get(number, []) if abs((r[-1].x0 + r[-1].x1) / 2 - middle) < _UNDER]
        if above:
            run = above[0]
            waiting[number].remove(run)
        else:
            runs.append(run := [])
        run.append(word)
        waiting.setdefault(number + 1, []).append(run)
    longest = max(runs, key=len, default=[])
    return longest if len(longest) >= _MANY else []


def _said_by(statement: Statement, row: Statement) -> Statement:
    """A value with what the row of its number says of it elsewhere."""
    return replace(
        statement,
        label=row.label,
        context=row.context,
        section=row.section or statement.section,
        unit=statement.unit or row.unit,
        variant=(),
    )
