"""Files that a person writes for a fleet: YAML, TOML, JSON or CSV, read into plain values.

What such a file may say is a table of `Key`s, from which errors name the place and the nearest word; JSON Schemas of
the same are in `schema/`, for editors.
"""

from __future__ import annotations

import csv
import io
import json
import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import resources
from pathlib import PurePosixPath
from typing import Any, ClassVar, Literal

from yellowiron.fleet.places import MEGABYTE, read_address
from yellowiron.library.notation.validated_json import near
from yellowiron.model.errors import YellowironError
from yellowiron.support.text import with_article

LARGEST = 64 * MEGABYTE
_SUFFIXES = (".yaml", ".yml", ".toml", ".json", ".csv")
_DURATION = re.compile(r"\s*([0-9]*\.?[0-9]+)\s*(s|sec|min|h)?\s*")
_SECONDS = {"s": 1.0, "sec": 1.0, "min": 60.0, "h": 3600.0}
_SIZE = re.compile(r"\s*([0-9]*\.?[0-9]+)\s*(MB|GB|MiB|GiB)?\s*", re.IGNORECASE)
_MEGABYTES = {"mb": 1.0, "gb": 1000.0, "mib": 1.0, "gib": 1024.0}


@dataclass(frozen=True)
class Key:
    """A key of a document: what its value is, and what it may be if that is one of several words."""

    kind: Literal["text", "texts", "number", "integer", "flag", "duration", "size", "table", "tables", "any"]
    choices: tuple[str, ...] = ()


class UnusableError(YellowironError):
    """A manifest, or a file of variants, that cannot be used."""


def read_document(address: str, *, what: str) -> Any:
    """The content of a YAML, TOML, JSON or CSV file, plain. A CSV file's rows become its `machines`, empty cells left
    out. `UnusableError` where it cannot be read; `what` begins the message ("The manifest")."""
    suffix = PurePosixPath(address).suffix.lower()
    if suffix not in _SUFFIXES:
        raise UnusableError(f"{what} is of no known form", where=address, hint=f"Use {', '.join(_SUFFIXES)}.")
    try:
        text = read_address(address, what=what, most=LARGEST).decode("utf-8-sig")
        if suffix == ".toml":
            return tomllib.loads(text)
        if suffix == ".json":
            return json.loads(text)
        if suffix == ".csv":
            return {"machines": _rows(text)}
        return _yaml(text, address)
    except (ValueError, csv.Error) as error:
        said = " ".join(str(error).split())[:300]
        raise UnusableError(
            f"{what} is not {suffix[1:].upper()}: {said}", where=address, hint="Mend it there."
        ) from error


def _yaml(text: str, address: str) -> Any:
    try:
        import yaml
    except ImportError as error:
        raise UnusableError(
            "YAML cannot be read here", where=address, hint="pip install pyyaml, or write it as TOML, JSON or CSV."
        ) from error
    # The safe loader that is in C, where it is there: a fifth of the time.
    safe: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)

    class Loader(safe):
        """The same, which makes out once what the same word is."""

        known: ClassVar[dict[Any, Any]] = {}

        def resolve(self, kind: Any, value: Any, implicit: Any) -> Any:
            key = (kind, value, implicit)
            if key not in self.known:
                self.known[key] = super().resolve(kind, value, implicit)
            return self.known[key]

    try:
        return yaml.load(text, Loader=Loader)
    except yaml.YAMLError as error:
        raise ValueError(str(error)) from error
    except RecursionError as error:
        raise ValueError("it is nested too deeply") from error


def _rows(text: str) -> list[dict[str, Any]]:
    rows = csv.DictReader(io.StringIO(text))
    found = []
    for row in rows:
        if None in row:
            raise ValueError(f"line {rows.line_num} has more cells than the first line")
        found.append({key.strip(): value.strip() for key, value in row.items() if value and value.strip()})
    return found


def checked(value: Any, keys: Mapping[str, Key], *, where: str, needed: Sequence[str] = ()) -> dict[str, Any]:
    """A table of a document with its values as their keys have them: texts that may be one are lists, durations are
    seconds, sizes megabytes. `UnusableError` for what does not fit, naming `where` and the key."""
    if not isinstance(value, Mapping):
        raise UnusableError(
            f"There should be a table, not {_shown(value)}", where=where, hint=f"Keys: {', '.join(keys)}."
        )
    for name in value:
        if name not in keys:
            hint = near(str(name), keys) or f"Keys: {', '.join(keys)}."
            raise UnusableError(f"'{name}' is not a key here", where=where, hint=hint)
    for name in needed:
        if name not in value:
            raise UnusableError(f"'{name}' is missing", where=where, hint=f"Say it there: {name}: …")
    return {name: _value(each, keys[name], f"{where}.{name}") for name, each in value.items()}


def _value(value: Any, key: Key, where: str) -> Any:
    made = _converted(value, key)
    if made is None:
        words = {"flag": "true or false", "duration": "a time (90 s, 20 min)", "size": "a size (6 GB)"}
        hint = "It may be " + (" or ".join(key.choices) or words.get(key.kind, with_article(key.kind))) + "."
        raise UnusableError(f"{_shown(value)} does not fit here", where=where, hint=hint)
    return made


def _converted(value: Any, key: Key) -> Any:
    """The value as its key has it, None where it does not fit. Cells of a CSV file are texts."""
    if key.kind == "any":
        return value
    if key.kind == "text" or key.choices:
        text = str(value) if isinstance(value, (str, int, float)) and not isinstance(value, bool) else None
        return text if not key.choices or text in key.choices else None
    if key.kind == "texts":
        # In a cell of a CSV file, semicolons are between them.
        given = [part.strip() for part in value.split(";")] if isinstance(value, str) else value
        fits = isinstance(given, list) and all(isinstance(each, str) and each for each in given)
        return tuple(given) if fits else None
    if key.kind == "flag":
        return {"true": True, "yes": True, "false": False, "no": False}.get(str(value).lower())
    if key.kind in ("number", "integer"):
        return _number(value, whole=key.kind == "integer")
    if key.kind in ("duration", "size"):
        pattern, factors = (_DURATION, _SECONDS) if key.kind == "duration" else (_SIZE, _MEGABYTES)
        match = pattern.fullmatch(str(value)) if not isinstance(value, bool) else None
        made = float(match.group(1)) * factors[(match.group(2) or next(iter(factors))).lower()] if match else 0.0
        return (made if key.kind == "duration" else max(1, round(made))) if made > 0.0 else None
    if key.kind == "table":
        return value if isinstance(value, Mapping) else None
    return value if isinstance(value, list) and all(isinstance(each, Mapping) for each in value) else None


def _number(value: Any, *, whole: bool) -> float | int | None:
    if isinstance(value, bool):
        return None
    try:
        return int(str(value)) if whole else float(value)
    except (TypeError, ValueError):
        return None


def _shown(value: Any) -> str:
    text = repr(value) if not isinstance(value, str) else f"'{value}'"
    return text if len(text) <= 80 else f"{text[:77]}…"


def schema(kind: Literal["manifest", "variants"]) -> dict[str, Any]:
    """The JSON Schema of a manifest, or of a file of variants."""
    folder = resources.files("yellowiron.fleet") / "schema"
    content: dict[str, Any] = json.loads((folder / f"{kind}.json").read_text(encoding="utf-8"))
    return content
