"""What part names call the bodies of a template, language by language: `words.json`."""

from __future__ import annotations

from collections.abc import Mapping

from yellowiron.library.notation.validated_json import Document, near
from yellowiron.model.errors import TemplateError
from yellowiron.model.specification import fold
from yellowiron.model.template import ITSELF, VAGUE, Role


def read_words(document: Document, roles: tuple[Role, ...]) -> Mapping[str, Mapping[str, tuple[str, ...]]]:
    """Words of role names, joined by spaces (`boom cylinder`) → language → what parts are called there.
    What machines of the type are called stands under `ITSELF`. `TemplateError` for a key with a word that no role's
    name has."""
    known = {word for role in roles for word in role.name.split("_")}
    found = {}
    for key, entry in document.data.items():
        vague = VAGUE if key.startswith(VAGUE) else ""
        words = key.removeprefix(VAGUE).replace("_", " ").casefold().split()
        for word in words if key != ITSELF else ():
            if word not in known:
                raise TemplateError(
                    f"'{word}' is in no role's name",
                    where=document.at(key),
                    hint=near(fold(word), known) or "Write words of the role names, as in `rear frame`.",
                )
        found[vague + " ".join(words)] = {language: tuple(names) for language, names in entry.items()}
    return found
