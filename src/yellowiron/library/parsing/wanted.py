"""`wanted.json`: what a sheet is asked for. What types have in common stands once, in the library's `common.json`."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import Any

from yellowiron.library.notation.quantities import quantity
from yellowiron.library.notation.role_keys import EVERYTHING
from yellowiron.library.notation.validated_json import Document, near, read_json
from yellowiron.library.parsing.variants import choices_of
from yellowiron.library.type_folders import library_folder
from yellowiron.model.errors import TemplateError
from yellowiron.model.specification import fold
from yellowiron.model.template import Role, Wanted

_LISTS = ("sections", "forbidden")
"""The keys in which `@name` stands for a list of `common.json`."""


def read_wanted(document: Document, roles: tuple[Role, ...]) -> tuple[Wanted, ...]:
    """The values of a `wanted.json`; plausible bounds in SI. `TemplateError` as of `complete`, and for bounds that are
    none and a `mass_of` that is no body."""
    document = complete(document)
    bodies = {fold(r.name): r.name for r in roles if r.rigid}
    wanted = []
    for name, entry in document.data.items():
        dimension = entry["dimension"]
        bounds = [
            quantity(entry[key], dimension, where=document.at(name, key)) if key in entry else None
            for key in ("minimum", "maximum")
        ]
        if bounds[0] is not None and bounds[1] is not None and bounds[0] >= bounds[1]:
            raise TemplateError(
                f"The minimum of '{name}' is not below its maximum",
                where=document.at(name, "minimum"),
                hint="Exchange the two.",
            )
        mass_of = entry.get("mass_of")
        if mass_of not in (None, EVERYTHING):
            if fold(mass_of) not in bodies:
                raise TemplateError(
                    f"'{mass_of}' is no body of the template",
                    where=document.at(name, "mass_of"),
                    hint=near(mass_of, bodies.values()),
                )
            mass_of = bodies[fold(mass_of)]
        wanted.append(
            Wanted(
                name=" ".join(name.split()),
                dimension=dimension,
                synonyms={lang: tuple(words) for lang, words in entry.get("synonyms", {}).items()},
                concepts=tuple(entry.get("concepts", ())),
                forbidden=tuple(entry.get("forbidden", ())),
                sections=tuple(entry.get("sections", ())),
                use=entry.get("use", ""),
                where=entry.get("where", ""),
                mass_of=mass_of,
                length_of=entry.get("length_of"),
                in_label_of=_other("in_label_of", entry, document, name),
                low_end_of=_other("low_end_of", entry, document, name),
                minimum=bounds[0],
                maximum=bounds[1],
                when=choices_of(entry, "when"),
                usual_weight=entry.get("usual_weight", {}).get("per_cubic_metre"),
                usual_length=_usual_length(entry, document, name),
            )
        )
    return tuple(wanted)


def _usual_length(entry: Mapping[str, Any], document: Document, name: str) -> tuple[float, float] | None:
    if (usual := entry.get("usual_length")) is None:
        return None
    where = document.at(name, "usual_length")
    least, most = (quantity(usual[end], "length", where=where) for end in ("least", "most"))
    if not 0.0 < least < most:
        raise TemplateError("The least length is not less than the most", where=where, hint="Exchange the two.")
    return least, most


def complete(document: Document) -> Document:
    """The document with nothing left to look up: what an entry does not state is that of the common entry it names
    (of `synonyms`, language by language), and `@name` in its lists is the common list of that name.

    `TemplateError` for a name that `common.json` does not have.
    """
    common = _common()
    entries = {}
    for name, entry in document.data.items():
        whole = _with_common(entry, common["wanted"], document.at(name, "common"))
        for key in _LISTS:
            if key in whole:
                whole[key] = _spelled_out(whole[key], common[key], document.at(name, key))
        entries[name] = whole
    return Document(document.path, entries)


@functools.cache
def _common() -> Mapping[str, Mapping[str, Any]]:
    # Not checked by its schema each time: the tests do that.
    shared: Mapping[str, Mapping[str, Any]] = read_json(library_folder() / "common.json")
    return shared


def _with_common(entry: Mapping[str, Any], common: Mapping[str, Any], where: str) -> dict[str, Any]:
    """An entry on top of the common one that it names, which may name another."""
    if "common" not in entry:
        return dict(entry)
    base = _with_common(common[_known(entry["common"], common, where)], common, where)
    own = {key: value for key, value in entry.items() if key != "common"}
    if "synonyms" in base:
        own["synonyms"] = {**base["synonyms"], **own.get("synonyms", {})}
    return {**base, **own}


def _spelled_out(words: list[str], lists: Mapping[str, list[str]], where: str) -> list[str]:
    """Words in which `@name` is replaced by the list of that name."""
    return [
        each for word in words for each in (lists[_known(word[1:], lists, where)] if word.startswith("@") else [word])
    ]


def _known(name: str, entries: Mapping[str, Any], where: str) -> str:
    """A name as `common.json` spells it."""
    names = {fold(each): each for each in entries}
    if fold(name) not in names:
        raise TemplateError(f"The library has no common '{name}'", where=where, hint=near(name, names.values()))
    return names[fold(name)]


def _other(key: str, entry: Mapping[str, Any], document: Document, name: str) -> str | None:
    """Another value of the same document that an entry names, as it is spelled there."""
    if (wanted := entry.get(key)) is None:
        return None
    names = {fold(each): " ".join(each.split()) for each in document.data}
    if fold(wanted) not in names:
        place = document.at(name, key)
        raise TemplateError(f"'{wanted}' is no wanted value", where=place, hint=near(wanted, names.values()))
    return names[fold(wanted)]
