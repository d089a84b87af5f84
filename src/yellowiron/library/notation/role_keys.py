"""Keys of a document that stand for roles: a name, a pattern such as `*_pin`, or `*`."""

from __future__ import annotations

import fnmatch
import re
from collections.abc import Mapping
from typing import TypeVar

from yellowiron.library.notation.validated_json import Document, near
from yellowiron.model.errors import TemplateError
from yellowiron.model.specification import fold
from yellowiron.model.template import Role

EVERYTHING = "*"
T = TypeVar("T")


def matches(name: str, pattern: str) -> bool:
    """Whether a role fits a pattern in which `*` stands for any text; case does not count, and `_`, `-` and a space
    are the same."""
    return fnmatch.fnmatchcase(*(re.sub(r"[\s_-]+", "_", text.strip().casefold()) for text in (name, pattern)))


def by_role(document: Document, entries: Mapping[str, T], roles: tuple[Role, ...]) -> dict[str, T]:
    """Entries whose keys are role names, patterns (`*_pin`) or `*`, as one entry a role in the hierarchy's order, and
    `*` itself. An exact name wins over a pattern, a later pattern over an earlier one. `TemplateError` for a key that
    fits no role."""
    exact: dict[str, T] = {}
    for key, entry in entries.items():
        fits = [r.name for r in roles if fold(r.name) == fold(key) or (EVERYTHING in key and matches(r.name, key))]
        if not fits and key != EVERYTHING:
            raise TemplateError(
                f"'{key}' is no role of the template",
                where=document.at(key),
                hint=near(key, (r.name for r in roles)) or "hierarchy.json has the roles.",
            )
        if EVERYTHING not in key:
            exact[fits[0]] = entry
    found: dict[str, T] = {}
    for role in roles:
        matching = [e for k, e in entries.items() if k != EVERYTHING and EVERYTHING in k and matches(role.name, k)]
        if role.name in exact:
            found[role.name] = exact[role.name]
        elif matching:
            found[role.name] = matching[-1]
        elif EVERYTHING in entries:
            found[role.name] = entries[EVERYTHING]
    if EVERYTHING in entries:
        found[EVERYTHING] = entries[EVERYTHING]
    return found
