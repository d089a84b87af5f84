"""Where the bodies of a type usually are, and how large they are: `usual.json`."""

from __future__ import annotations

from collections.abc import Mapping

from yellowiron.library.notation.validated_json import Document, near
from yellowiron.model.errors import TemplateError
from yellowiron.model.template import Role, Usual


def read_usual(document: Document, roles: tuple[Role, ...]) -> Mapping[str, Usual]:
    """Body → where it usually is. `TemplateError` for a name that is no body's."""
    known = {role.name for role in roles if role.rigid}
    found = {}
    for name, entry in document.data.items():
        if name not in known:
            raise TemplateError(
                f"'{name}' is no body of the template",
                where=document.at(name),
                hint=near(name, known) or "Write the names of bodies, as in hierarchy.json.",
            )
        found[name] = Usual(tuple(entry["low"]), tuple(entry["high"]), entry["length"], entry["area"])
    return found
