"""Which entry of the documents speaks for a part: materials and collision alike."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Generic, TypeVar

from yellowiron.mechanism.placement import ancestors
from yellowiron.model.specification import fold
from yellowiron.model.template import Template

Entry = TypeVar("Entry")

BY_USER = "data"
"""How the words begin that name an entry of a user's document."""


class Choice(Generic[Entry]):
    """Entries by CAD part name or role from a user's documents, and by role from the template.

    The most telling one wins: the CAD part's name in a document, its role there, its role in the template, then the
    nearest ancestor in either, then `*`. Names are compared as `fold` does.
    """

    def __init__(self, template: Template, by_document: Mapping[str, Entry], by_template: Mapping[str, Entry]) -> None:
        self._template = template
        self._documents = {fold(name): entry for name, entry in by_document.items()}
        self._own = {fold(name): entry for name, entry in by_template.items()}
        self._by_role: dict[str | None, tuple[Entry, str] | None] = {}

    def of(self, part: str, role: str | None) -> tuple[Entry, str] | None:
        """The entry for a part of that name and role, and which one it is in words; None where nothing speaks for
        it."""
        if (key := fold(part)) in self._documents:
            return self._documents[key], f"{BY_USER}: part '{part}'"
        if role not in self._by_role:
            self._by_role[role] = self._of_role(role)
        return self._by_role[role]

    def _of_role(self, role: str | None) -> tuple[Entry, str] | None:
        above = ancestors(self._template, role)
        names = [*(name for r in above for name in (r.name, r.row) if name), "*"]
        for name in names:
            for entries, origin in ((self._documents, BY_USER), (self._own, "template")):
                if (key := fold(name)) in entries:
                    return entries[key], f"{origin}: {'role ' if name != '*' else ''}'{name}'"
        return None
