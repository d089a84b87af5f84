"""Documents of a type that is like another: they say only what differs."""

from __future__ import annotations

from collections.abc import Mapping
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

from yellowiron.library.notation.validated_json import Document, check_document, near, read_json
from yellowiron.library.type_folders import type_folders
from yellowiron.model.errors import TemplateError


def template_document(path: Path, kind: str) -> Document:
    """A template's document, valid by the schema of its kind. With `like` it is that of the library type of that name,
    less the entries whose names match a pattern of `without`, and with what else is in it put on top: objects key by
    key, lists of named entries one after the other, anything else instead. The group that has the other type's name
    has this one's. `TemplateError` names file and key."""
    return check_document(path, _whole(path, ()), kind)


def is_like(path: Path) -> bool:
    """Whether a document names a type that it is like."""
    own = read_json(path)
    return isinstance(own, dict) and "like" in own


def _whole(path: Path, above: tuple[Path, ...]) -> Any:
    """A document's content, for those `above` that are like it."""
    own = read_json(path)
    if not isinstance(own, dict) or not isinstance(own.get("like"), str):
        return own
    other, types, without = own["like"], type_folders(), own.get("without", [])
    if not isinstance(without, list) or not all(isinstance(pattern, str) for pattern in without):
        raise TemplateError("It is no list of names", where=f"{path}: without", hint='Write e.g. ["track_*"].')
    if other not in types or not (types[other] / path.name).is_file():
        raise TemplateError(
            f"There is no {path.name} of a type '{other}' to be like", where=f"{path}: like", hint=near(other, types)
        )
    if path.resolve() in above:
        raise TemplateError(
            "The document is like itself, or like one that is like it", where=f"{path}: like", hint="Name another type."
        )
    base = _less(_whole(types[other] / path.name, (*above, path.resolve())), tuple(without))
    renamed = {path.parent.name if name == other else name: entry for name, entry in base.items()}
    return _on_top(renamed, {name: entry for name, entry in own.items() if name not in ("like", "without")})


def _less(value: Any, patterns: tuple[str, ...]) -> Any:
    """The value without the entries that have a matching name, at any depth."""

    def goes(name: object) -> bool:
        return isinstance(name, str) and any(fnmatchcase(name, pattern) for pattern in patterns)

    if isinstance(value, Mapping):
        return {name: _less(entry, patterns) for name, entry in value.items() if not goes(name)}
    if isinstance(value, list):
        return [_less(e, patterns) for e in value if not (isinstance(e, Mapping) and goes(e.get("name")))]
    return value


def _on_top(base: Any, own: Any) -> Any:
    if isinstance(base, Mapping) and isinstance(own, Mapping):
        return {**base, **{name: _on_top(base.get(name), entry) for name, entry in own.items()}}
    if isinstance(base, list) and isinstance(own, list) and all("name" in e for e in own if isinstance(e, Mapping)):
        return [*base, *own] if any(isinstance(e, Mapping) for e in own) else own
    return own
