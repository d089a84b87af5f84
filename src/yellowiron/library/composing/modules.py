"""Modules: mechanisms that several types have, written once, and what a template's uses of them come to."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from yellowiron.library.composing.layers import beside
from yellowiron.library.notation.validated_json import check_document, near, read_json, where
from yellowiron.library.type_folders import DOCUMENTS, module_files
from yellowiron.model.errors import TemplateError

_PARAMETER = re.compile(r"\{(\w+)\}")
_OF_A_USE = ("module", "when")
_NOTHING = object()
"""What names a parameter that is not given: it is left out."""


@dataclass(frozen=True)
class Module:
    """A module as it is written: `parameters` name → {about, default}, `uses` of other modules, and its `documents`."""

    name: str
    path: Path
    about: str
    parameters: Mapping[str, Mapping[str, Any]]
    uses: Mapping[str, Any]
    documents: Mapping[str, Any]


def read_module(name: str, place: str) -> Module:
    """The module of that name. `TemplateError` where there is none, or its file is not valid; `place` names it."""
    files = module_files()
    if name not in files:
        known = ", ".join(files)
        raise TemplateError(
            f"There is no module '{name}'", where=place, hint=near(name, files) or f"The library has: {known}."
        )
    there = files[name].stat()
    return _read(files[name], there.st_mtime_ns, there.st_size)


@functools.lru_cache(maxsize=256)
def _read(path: Path, changed: int, size: int) -> Module:
    """A module, once while its file is as it was."""
    content = check_document(path, read_json(path), "module").data
    documents = {kind: content[kind] for kind in DOCUMENTS if kind in content and kind != "modules"}
    return Module(
        path.stem, path, content["about"], content.get("parameters", {}), content.get("modules", {}), documents
    )


def modules() -> dict[str, Module]:
    """Every module, by name."""
    return {name: read_module(name, str(path)) for name, path in module_files().items()}


def expanded(uses: Mapping[str, Any], path: Path, above: tuple[str, ...] = ()) -> dict[str, Any]:
    """Kind → the document that some uses come to together, in their order. `path` is where they are written, and
    `above` the modules that lead there. `TemplateError` for a module that is not there or uses itself, a parameter that
    is missing, and one that it does not have."""
    whole: dict[str, Any] = {}
    for name, use in uses.items():
        module = read_module(str(use.get("module", "")), where(path, (name, "module")))
        if module.name in above:
            raise TemplateError(
                f"The module '{module.name}' uses itself",
                where=where(path, (name, "module")),
                hint="Leave it out, or name another.",
            )
        given = _given(module, use, path, name)
        inner = expanded(_filled(module.uses, given), module.path, (*above, module.name))
        own = beside(_filled(module.documents, given), inner)
        whole = beside(whole, _kept_to(own, use["when"]) if use.get("when") else own)
    return whole


def behind(uses: Mapping[str, Any]) -> set[Path]:
    """The files of the modules that some uses name, and of those that these use; of those that are there."""
    files, found = module_files(), set[Path]()
    names = [str(use.get("module")) for use in uses.values() if isinstance(use, Mapping)]
    while names:
        name = names.pop()
        if name in files and files[name] not in found:
            found.add(files[name])
            names += [use["module"] for use in read_module(name, str(files[name])).uses.values()]
    return found


def _given(module: Module, use: Mapping[str, Any], path: Path, name: str) -> dict[str, Any]:
    """Parameter → its value in a use; a default may name parameters that stand before it."""
    for key in use.keys() - module.parameters.keys() - set(_OF_A_USE):
        raise TemplateError(
            f"The module '{module.name}' has no parameter '{key}'",
            where=where(path, (name, key)),
            hint=near(key, module.parameters) or f"It has: {', '.join(module.parameters)}.",
        )
    given: dict[str, Any] = {}
    for key, parameter in module.parameters.items():
        if key not in use and "default" not in parameter:
            raise TemplateError(
                f"The module '{module.name}' is not told '{key}'",
                where=where(path, (name, key)),
                hint=f"{key}: {parameter['about']}",
            )
        value = use[key] if key in use else _filled(parameter["default"], given)
        given[key] = _NOTHING if value is None else value
    return given


def _filled(value: Any, given: Mapping[str, Any]) -> Any:
    """The value with every `{parameter}` replaced; `_NOTHING` for a text that names one that is nothing, and what has
    such a text for its name, its value or its entry is left out."""
    if isinstance(value, str):
        if (alone := _PARAMETER.fullmatch(value)) and alone[1] in given:
            return given[alone[1]]
        if any(given.get(name) is _NOTHING for name in _PARAMETER.findall(value)):
            return _NOTHING
        return _PARAMETER.sub(lambda found: str(given.get(found[1], found[0])), value)
    if isinstance(value, Mapping):
        pairs = ((_filled(name, given), _filled(entry, given)) for name, entry in value.items())
        return {str(name): entry for name, entry in pairs if name is not _NOTHING and entry is not _NOTHING}
    if isinstance(value, list):
        return [entry for entry in (_filled(each, given) for each in value) if entry is not _NOTHING]
    return value


def _kept_to(documents: Mapping[str, Any], when: Mapping[str, Any]) -> dict[str, Any]:
    """The documents of a use that exists under some choices only: parts, joints, cylinders, sensors, measurements."""

    def kept(entry: Mapping[str, Any]) -> dict[str, Any]:
        own = entry.get("when", {})
        both = {variant: _common(when.get(variant), own.get(variant)) for variant in (*when, *own)}
        return {**entry, "when": both}

    def part(entry: Mapping[str, Any]) -> dict[str, Any]:
        child = entry.get("child")
        inner = {"child": {n: part(e) for n, e in child.items()}} if isinstance(child, Mapping) else {}
        own = kept(entry) if "rigid body" in entry else dict(entry)
        return {**own, **inner}

    def actuator(entry: Mapping[str, Any]) -> dict[str, Any]:
        inner = {"cylinders": [kept(c) for c in entry["cylinders"]]} if "cylinders" in entry else {}
        return {**entry, **inner}

    each: dict[str, Callable[[Any], dict[str, Any]]]
    each = {"hierarchy": part, "joints": kept, "sensors": kept, "actuators": actuator}
    whole: dict[str, Any] = {
        kind: {name: each[kind](entry) for name, entry in content.items()} if kind in each else content
        for kind, content in documents.items()
    }
    if "measurements" in whole:
        measured = whole["measurements"]
        sites = {name: kept(site) for name, site in measured.get("sites", {}).items()}
        whole["measurements"] = {"sites": sites, "measurements": [kept(m) for m in measured.get("measurements", ())]}
    return whole


def _common(one: Any, other: Any) -> Any:
    """The choices that both say, as the second spells them; of one that says nothing, the other's."""
    if one is None or other is None:
        return other if one is None else one
    listed = [one] if isinstance(one, str) else one
    return other if isinstance(other, str) else [choice for choice in other if choice in listed]
