"""JSON files as the template formats want them: no key twice, keys and values in any spelling, checked by schema."""

from __future__ import annotations

import difflib
import functools
import importlib.resources
import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jsonschema import Draft202012Validator
from jsonschema.exceptions import ValidationError

from yellowiron.model.errors import TemplateError
from yellowiron.model.specification import fold
from yellowiron.support.files.inputs import MEGABYTE, read_input

LARGEST = 16 * MEGABYTE
"""Bytes; no template comes near, and a file beyond is not read."""
_LARGEST_NUMBER = 1e15
"""In size; the stiffest drive stays far below."""
_LONGEST_NAME, _LONGEST_TEXT = 200, 4000
"""Letters of a key, and of any other text."""
_ENUM_WORDS = 12
_FORMAT_HINT = "docs/template-format.md lists every key."


@dataclass(frozen=True)
class Document:
    """A JSON file as read: `data`, its keys canonical, and the `path` that errors name."""

    path: Path
    data: Any

    def at(self, *keys: object) -> str:
        """`file: key.key`, for the `where` of an error."""
        return where(self.path, keys)


class _TwiceError(ValueError):
    """A key given twice in one object."""


class _UnusableError(ValueError):
    """A key, a text or a number that no document can have."""


def where(path: Path, keys: Iterable[object]) -> str:
    """`file: a.b[0]` for a file and the keys that lead to a value."""
    text = ""
    for key in keys:
        text += f"[{key}]" if isinstance(key, int) else f"{'.' if text else ''}{key}"
    return f"{path}: {text}" if text else str(path)


def near(name: str, known: Iterable[str], *, at_least: float = 0.6) -> str:
    """'Did you mean …?' for a name that is not known, or an empty text; `at_least` is difflib's ratio."""
    names = {fold(k): k for k in known}
    found = difflib.get_close_matches(fold(name), list(names), n=3, cutoff=at_least)
    return f"Did you mean {' or '.join(names[f] for f in found)}?" if found else ""


@functools.cache
def _schema_text(kind: str) -> str:
    folder = importlib.resources.files("yellowiron.library") / "schema"
    return (folder / f"{kind}.json").read_text(encoding="utf-8")


def template_schema(kind: str) -> dict[str, Any]:
    """The published JSON Schema of a document: `hierarchy`, `relations`, `joints`, `joint_overrides`, `materials`,
    `collision`, `wanted`, `common`, `variants`, `actuators`, `measurements`, `tests`, `sensors` or `words`."""
    try:
        text = _schema_text(kind)
        shared = re.search(r'"(\w+)\.json#/', text)
        schema: dict[str, Any] = json.loads(text if shared is None else text.replace(shared.group()[1:-1], "#"))
        if shared is not None:
            schema["$defs"] = template_schema(shared.group(1))["$defs"]
    except FileNotFoundError as error:
        raise TemplateError(f"There is no schema '{kind}'", where=kind, hint=_FORMAT_HINT) from error
    return schema


def read_json(path: Path) -> Any:
    """The content of a JSON file. `TemplateError` for a file that cannot be read, is not UTF-8 JSON, or has a key
    twice."""

    def pairs(items: list[tuple[str, Any]]) -> dict[str, Any]:
        found: dict[str, str] = {}
        for key, _ in items:
            if not key.strip() or not key.isprintable():
                raise _UnusableError(f"'{_short(key)}' is no name" if key.strip() else "a name is empty")
            if len(key) > _LONGEST_NAME:
                raise _UnusableError(f"the name '{_short(key)}' has {len(key)} letters, more than {_LONGEST_NAME}")
            if fold(key) in found:
                raise _TwiceError(key)
            found[fold(key)] = key
        for _, value in items:
            for text in value if isinstance(value, list) else (value,):
                if isinstance(text, str) and len(text) > _LONGEST_TEXT:
                    raise _UnusableError(f"the text '{_short(text)}' has more than {_LONGEST_TEXT} letters")
        return dict(items)

    def number(text: str) -> float:
        value = float(text)
        if not abs(value) <= _LARGEST_NUMBER:
            raise _UnusableError(f"{_short(text)} is no number that can be used")
        return value

    def whole(text: str) -> int:
        number(text)
        return int(text)

    data = read_input(path, what="The document", most=LARGEST, error=TemplateError)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise TemplateError("The file is not text in UTF-8", where=str(path), hint="Save it as UTF-8.") from error
    try:
        return json.loads(text, object_pairs_hook=pairs, parse_constant=number, parse_float=number, parse_int=whole)
    except json.JSONDecodeError as error:
        raise TemplateError(
            f"The file is not JSON: {error.msg}",
            where=f"{path}: line {error.lineno}, column {error.colno}",
            hint="Mind commas and quotes; JSON knows no comments.",
        ) from error
    except _TwiceError as error:
        raise TemplateError(
            f"The key '{error}' is there twice",
            where=str(path),
            hint="Keep one of the two; case, _ and - do not count.",
        ) from error
    except (ValueError, RecursionError) as error:
        reason = "it is nested too deep" if isinstance(error, RecursionError) else str(error)
        raise TemplateError(f"The file is not usable JSON: {reason}", where=str(path), hint=_FORMAT_HINT) from error


def read_document(path: Path, kind: str) -> Document:
    """A JSON file with canonical keys, valid by the schema of its kind. `TemplateError` names file and key."""
    return check_document(path, read_json(path), kind)


def check_document(path: Path, content: Any, kind: str) -> Document:
    """As `read_document`, for content that was read before."""
    schema = template_schema(kind)
    try:
        data = _canonical(content, schema, schema, path, ())
        errors = sorted(Draft202012Validator(schema).iter_errors(data), key=lambda e: [str(p) for p in e.absolute_path])
    except RecursionError as error:
        raise TemplateError("The file is nested too deep", where=str(path), hint=_FORMAT_HINT) from error
    if errors:
        deepest = errors[0]
        while deepest.context and deepest.validator == "anyOf":
            deepest = _nearest(deepest)
        message, hint = _explain(deepest)
        raise TemplateError(message, where=where(path, deepest.absolute_path), hint=hint)
    return Document(path, data)


def _resolve(schema: Mapping[str, Any], root: Mapping[str, Any]) -> Mapping[str, Any]:
    reference = schema.get("$ref")
    return root["$defs"][reference.rpartition("/")[2]] if isinstance(reference, str) else schema


def _canonical(
    value: Any, schema: Mapping[str, Any], root: Mapping[str, Any], path: Path, keys: tuple[object, ...]
) -> Any:
    """The value with keys and words spelled as in the schema, where they differ only in case, `_`, `-` and spaces."""
    schema = _resolve(schema, root)
    for option in schema.get("anyOf", ()):
        if _fits(value, _resolve(option, root)):
            return _canonical(value, option, root, path, keys)
    if isinstance(value, dict):
        known = {fold(k): (k, s) for k, s in schema.get("properties", {}).items()}
        other = schema.get("additionalProperties", {})
        other = other if isinstance(other, Mapping) else {}
        result: dict[str, Any] = {}
        for key, item in value.items():
            name, sub = known.get(fold(key), (key, other))
            if name in result:
                raise TemplateError(
                    f"The key '{name}' is there twice", where=where(path, keys), hint="Keep one of the two."
                )
            result[name] = _canonical(item, sub, root, path, (*keys, name))
        return result
    if isinstance(value, list):
        return [_canonical(v, schema.get("items", {}), root, path, (*keys, i)) for i, v in enumerate(value)]
    if isinstance(value, str):
        for word in schema.get("enum", ()):
            if isinstance(word, str) and fold(word) == fold(value):
                return word
    return value


def _fits(value: Any, schema: Mapping[str, Any]) -> bool:
    """Whether a value is of the JSON type that one option of an `anyOf` is for."""
    kinds = {"object": dict, "array": list, "string": str}
    kind = schema.get("type")
    if kind is None:
        return "enum" in schema and isinstance(value, str)
    return isinstance(value, kinds.get(kind, (int, float)))


def _nearest(error: ValidationError) -> ValidationError:
    """Of an `anyOf` that failed, the option that got farthest; at equal depth one that failed on more than the type."""
    return max(error.context or [], key=lambda e: (len(e.absolute_path), e.validator != "type"))


def _explain(error: ValidationError) -> tuple[str, str]:
    """One sentence and a hint for a schema's complaint."""
    instance: Any = error.instance
    value: Any = error.validator_value
    schema: Any = error.schema
    meaning = f"{schema['description'].rstrip('.')}. {_FORMAT_HINT}" if "description" in schema else _FORMAT_HINT
    if error.validator == "required":
        return f"'{next(key for key in value if key not in instance)}' is missing", _FORMAT_HINT
    if error.validator == "additionalProperties" and isinstance(instance, dict):
        known = list(schema.get("properties", {}))
        odd = next(key for key in instance if key not in known)
        return f"'{odd}' is no key of this entry", near(odd, known) or f"Known: {', '.join(known)}."
    if error.validator == "enum":
        choices = [str(w) for w in value if w not in (None, "") and not isinstance(w, bool)]
        hint = near(str(instance), choices) or f"Known: {', '.join(choices[:_ENUM_WORDS])}."
        return f"'{_short(instance)}' is none of the words this key knows", hint
    if error.validator == "type":
        kinds = [value] if isinstance(value, str) else list(value)
        return f"'{_short(instance)}' should be {_kinds(kinds)}", meaning
    if error.validator in ("minProperties", "minItems") and not instance:
        return "There is nothing in it", meaning
    if error.validator in ("minItems", "maxItems"):
        return f"The list has {len(instance)} items, not {value}", meaning
    bounds = {"minimum": "at least", "maximum": "at most", "exclusiveMinimum": "more than"}
    if error.validator in bounds:
        return f"{instance} should be {bounds[str(error.validator)]} {value}", meaning
    return f"'{_short(instance)}' does not fit: {_short(error.message)}", meaning


def _kinds(kinds: list[str]) -> str:
    words = {"object": "an object {…}", "array": "a list […]", "string": "a text", "number": "a number", "null": "null"}
    return " or ".join(words.get(k, k) for k in kinds)


def _short(value: object) -> str:
    text = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False, default=str)
    return text if len(text) <= 60 else text[:57] + "…"
