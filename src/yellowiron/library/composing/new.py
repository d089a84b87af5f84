"""A template of a few lines: like a type, with modules."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from yellowiron.library.composing.documents import template_documents
from yellowiron.library.composing.modules import expanded
from yellowiron.library.notation.written import document_text
from yellowiron.library.type_folders import documents_in, find_template, type_folders
from yellowiron.model.errors import OutputError, TemplateError
from yellowiron.support.output import output_folder


def compose_template(folder: str | Path, *, like: str | None = None, modules: Sequence[str] = ()) -> Path:
    """Writes a template into a folder that is new or empty, and returns it: that of a library type (`like`), document
    by document, with more modules. A module is `name`, or `name:parameter=value,parameter=value`; the bodies that its
    parameters name and that nothing else brings are written into `hierarchy.json`.

    `OutputError` where the folder has something in it or cannot be written; `TemplateError` for a type or a module that
    is not there, and a module that is told too little.
    """
    target = Path(folder)
    if target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise OutputError(
            "The folder is there already, and nothing is overwritten",
            where=str(target),
            hint="Name a folder that is new or empty.",
        )
    own, documents = dict(_use(text) for text in _numbered(modules)), dict[str, dict[str, Any]]()
    if like is not None:
        other = find_template(like)
        if other not in type_folders().values():
            raise TemplateError(
                f"'{like}' is no type of the library", where=like, hint="Copy a folder of yours, and change the copy."
            )
        documents = {kind: {"like": other.name} for kind in documents_in(other)}
        there = set(_names(template_documents(other)["hierarchy"].data)) if "hierarchy" in documents else set()
    else:
        there = set()
    if not documents and not own:
        raise TemplateError("There is nothing to write", where=str(target), hint="Name a type to be like, or modules.")
    if own:
        documents["modules"] = {**documents.get("modules", {}), **own}
        bodies = {name: {"rigid body": "Y"} for name in _missing(own, target / "modules.json") if name not in there}
        if bodies:
            group: dict[str, Any] = {"child": bodies}
            if like is None:
                group = {"rigid body": "N", "kind": "group", **group}
            documents["hierarchy"] = {**documents.get("hierarchy", {}), target.resolve().name: group}
    with output_folder(target) as staged:
        for kind, document in documents.items():
            (staged / f"{kind}.json").write_text(document_text(document) + "\n", encoding="utf-8")
    return target


def _numbered(modules: Sequence[str]) -> list[tuple[str, str]]:
    """Each use's text with a name for it: the module's, or that and a number."""
    named: dict[str, str] = {}
    for text in modules:
        base = name = text.partition(":")[0].strip()
        while name in named:
            name = f"{base}_{int(name.rpartition('_')[2]) + 1 if name != base else 2}"
        named[name] = text
    return list(named.items())


def _use(named: tuple[str, str]) -> tuple[str, dict[str, Any]]:
    name, text = named
    module, _, parameters = text.partition(":")
    use: dict[str, Any] = {"module": module.strip()}
    for each in filter(None, (part.strip() for part in parameters.split(","))):
        key, sign, value = each.partition("=")
        if not sign or not key.strip():
            raise TemplateError(
                f"'{each}' is no parameter and value", where=text, hint="Write MODULE:PARAMETER=VALUE,PARAMETER=VALUE."
            )
        number = re.fullmatch(r"-?\d+(\.\d+)?(e\d+)?", value.strip())
        use[key.strip()] = json.loads(value) if number else value.strip()
    return name, use


def _missing(uses: Mapping[str, Any], path: Path) -> list[str]:
    """The parts that modules move with, or join, and that none of them brings."""
    brought = expanded(uses, path)
    hierarchy = brought.get("hierarchy", {})
    named = [entry["parent"] for entry in hierarchy.values() if "parent" in entry]
    named += [part.partition("[")[0] for joint in brought.get("joints", {}).values() for part in joint["Body"]]
    there = set(_names(hierarchy))
    return [name for name in dict.fromkeys(named) if name not in there]


def _names(hierarchy: Mapping[str, Any]) -> Iterator[str]:
    for name, entry in hierarchy.items():
        yield name.removesuffix("[*]")
        yield from _names(entry["child"] if isinstance(entry.get("child"), Mapping) else {})
