"""Which machine each page is of, where the sheets of several are bound in one file."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from yellowiron.specs.layout.rows.headings import body_size
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.pages.words import Page
from yellowiron.specs.values.claims import names_model, split_phrases

_DESIGNATION = re.compile(r"([A-Z]{1,4})-?[A-Z]{0,3}\d{2,5}[A-Z]{0,4}(?![A-Za-z\d])")
"""A model as it is printed: "GR-250N", also before the number of its sheet, "GR-250N-2-00102"."""
_EDGE = 0.12
"""Of a page's height: what stands at its head or foot says what it is of."""
_LARGE = 1.3
"""Times the size of most characters: a title."""
_FEWEST = 2
"""Pages that make a sheet of its own."""
_FEWEST_EQUAL = 3
"""Sheets of equal length, bound one behind the other."""


def titled(page: Page) -> frozenset[str]:
    """The models that a page's title, its head or its foot names."""
    size = body_size(page.words)
    return frozenset(
        match.group(0)
        for word in page.words
        if word.size > _LARGE * size or not _EDGE * page.height < word.baseline < (1 - _EDGE) * page.height
        if (match := _DESIGNATION.match(word.text))
    )


def of_others(titles: Sequence[frozenset[str]], config: str) -> frozenset[int]:
    """The pages (1 = first) that are of other machines than the one that `config` names. `titles`: of each page in
    turn. A page of both, and the file is a brochure of both."""
    named = {name for names in titles for name in names}
    asked = {name for name in named for phrase in split_phrases(config) if _plain(name) == _plain(phrase)}
    owners = _owners(titles, {_family(name) for name in asked})
    own = {page: [any(_same(name, one) for one in asked) for name in names] for page, names in owners.items()}
    if any(len(set(which)) > 1 for which in own.values()):
        return frozenset()
    other = frozenset(page for page, which in own.items() if not any(which))
    return other if len(other) >= _FEWEST else frozenset()


def several(titles: Sequence[frozenset[str]]) -> dict[int, str]:
    """By page (1 = first) the machine that it is of, where the file has sheets of several."""
    for family in sorted({_family(name) for names in titles for name in names}):
        owners = _owners(titles, {family})
        own = {page: max(names, key=len) for page, names in owners.items()}
        sheets = {name for name in own.values() if sum(one == name for one in own.values()) >= _FEWEST}
        apart = all(_same(a, b) for names in owners.values() for a in names for b in names)
        if apart and any(not _same(a, b) for a in sheets for b in sheets):
            return own
    return {}


def with_machines(statements: Sequence[Statement], titles: Sequence[frozenset[str]]) -> tuple[Statement, ...]:
    """The statements, those that no column holds for with the model that is meant: that of the nearest heading over
    them which heads a column elsewhere, or that which their page is of alone, as other pages are of others."""
    models = {head for s in statements for head in s.column if names_model(head)}
    pages = _of_one(titles)

    def machine(statement: Statement) -> str:
        headings = (*reversed(statement.context), statement.section)
        return next((h for h in headings if h in models), pages.get(statement.page, ""))

    return tuple(
        s if s.column or s.variant or not (name := machine(s)) else replace(s, variant=(name,)) for s in statements
    )


def _titled_alone(titles: Sequence[frozenset[str]]) -> dict[int, str]:
    """By page (1 = first) the model that its title names, where it names no other and another page likewise names one
    of the same family."""
    alone = {page: next(iter(names)) for page, names in enumerate(titles, start=1) if len(names) == 1}
    return {
        page: name
        for page, name in alone.items()
        if any(_family(one) == _family(name) and not _same(one, name) for one in alone.values())
    }


def _of_one(titles: Sequence[frozenset[str]]) -> dict[int, str]:
    """`_titled_alone`, and the pages that go on with those, where the sheets are of equal length."""
    pages = _titled_alone(titles)
    begins = sorted(pages)
    length, *others = {b - a for a, b in pairwise(begins)} or {0}
    if len(begins) >= _FEWEST_EQUAL and not others:  # sheets of so many pages each, one behind the other
        going_on = {page + k: pages[page] for page in begins for k in range(1, length)}
        pages |= {page: name for page, name in going_on.items() if page <= len(titles) and not titles[page - 1]}
    return pages


def of_sisters(titles: Sequence[frozenset[str]], config: str) -> frozenset[int]:
    """The pages of another machine than the one that `config` names and that other pages are of, also in a brochure of
    both."""
    pages = _of_one(titles)
    asked = {_plain(phrase) for phrase in split_phrases(config)} & {_plain(name) for name in pages.values()}
    return frozenset(page for page, name in pages.items() if asked and _plain(name) not in asked)


def _owners(titles: Sequence[frozenset[str]], families: set[str]) -> dict[int, frozenset[str]]:
    """By page the models of some families that its title names; a page without one between two of the same has
    theirs."""
    found: dict[int, frozenset[str]] = {}
    waiting: list[int] = []
    last: frozenset[str] = frozenset()
    for page, names in enumerate(titles, start=1):
        own = frozenset(name for name in names if _family(name) in families)
        if not own:
            waiting.append(page)
            continue
        if own & last:
            found |= dict.fromkeys(waiting, own & last)
        found[page], last, waiting = own, own, []
    return found


def _family(name: str) -> str:
    match = _DESIGNATION.match(name)
    return match.group(1) if match else name


def _same(a: str, b: str) -> bool:
    """Whether two designations may be of one machine: "GR-300E" of "GR-300EX"."""
    return _plain(a).startswith(_plain(b)) or _plain(b).startswith(_plain(a))


def _plain(text: str) -> str:
    return re.sub(r"[\s-]", "", text).casefold()
