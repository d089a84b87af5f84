"""A template's documents, whole: what they are like, the modules they are put together from, and what they say."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from yellowiron.library.composing.layers import in_order, in_order_throughout, less, nested, on_top
from yellowiron.library.composing.modules import behind, expanded
from yellowiron.library.notation.validated_json import Document, check_document, near, read_json
from yellowiron.library.type_folders import DOCUMENTS, documents_in, library_folder, type_folders
from yellowiron.model.errors import TemplateError

_MODULES = "modules"
_OF_LAYERS = ("like", "without", "order")


def template_documents(folder: Path) -> dict[str, Document]:
    """A template's documents by kind, each whole and valid by its schema.

    What the folder's modules bring comes first, in the order of `modules.json` (of wanted values last, what the folder
    does not ask for itself), and the folder's own document is put on top. A document that is `like` another type's is
    put on top of that one, less the entries whose names match a pattern of `without`: objects key by key, lists of
    named entries one after the other, anything else instead; the
    group that has the other type's name has this one's. Where the folder has a `modules.json` of its own, it is put on
    top of what the other type adds to its modules. Entries stand in the order that the patterns of `order` say.
    `TemplateError` names file and key."""
    paths, known = documents_in(folder), dict[Path, dict[str, Any]]()
    found = {kind: _content(folder, kind, (), known) for kind in DOCUMENTS if kind != _MODULES}
    at = {kind: paths.get(kind, paths.get(_MODULES, folder)) for kind in found}
    return {kind: check_document(at[kind], content, kind) for kind, content in found.items() if content is not None}


def is_whole(folder: Path, kind: str) -> bool:
    """Whether a folder's own document says all that the template has of its kind."""
    paths = documents_in(folder)
    if _MODULES in paths or kind not in paths:
        return False
    own = read_json(paths[kind])
    return not isinstance(own, Mapping) or not own.keys() & set(_OF_LAYERS)


def uses_of(folder: Path) -> Mapping[str, Any]:
    """What a template's `modules.json` uses, and how: name → module and parameters; nothing where it has none."""
    path = documents_in(folder).get(_MODULES) if folder.is_dir() else None
    return {} if path is None else check_document(path, _layered(folder, _MODULES, (), {}, bare=True), _MODULES).data


def files_behind(folder: Path) -> tuple[Path, ...]:
    """Every file that a template is read from: its documents and modules, those of the types that they are like, and
    what types share."""
    types, seen = type_folders(), set[Path]()
    found, folders = {library_folder() / "common.json"}, [folder]
    while folders:
        here = folders.pop()
        if here in seen:
            continue
        seen.add(here)
        for kind, path in documents_in(here).items():
            found.add(path)
            own = content_as_it_is(path)
            if isinstance(own, Mapping):
                folders += [types[name] for name in (own.get("like"),) if isinstance(name, str) and name in types]
                found |= behind(own) if kind == _MODULES else set()
    return tuple(sorted(found))


def _content(folder: Path, kind: str, above: tuple[Path, ...], known: dict[Path, dict[str, Any]]) -> Any:
    """A document of a folder, whole, for those `above` that are like it; None where there is none. `known`: folder →
    what its modules bring."""
    if folder not in known:
        known[folder] = {}
        uses = uses_of(folder)
        known[folder] = expanded(uses, documents_in(folder)[_MODULES]) if uses else {}
    brought, content = known[folder].get(kind), _layered(folder, kind, above, known, bare=False)
    order: list[str] = []
    if isinstance(content, dict) and "order" in content:
        order = _names(content["order"], documents_in(folder).get(kind, folder), "order")
        content = {name: entry for name, entry in content.items() if name != "order"}
    if brought is not None:
        own = content if isinstance(content, dict) else {}
        content = brought if content is None else on_top(brought, content)
        if kind == "wanted" and isinstance(content, dict):
            content = {name: content[name] for name in (*own, *(n for n in content if n not in own))}
        content = nested(content) if kind == "hierarchy" and isinstance(content, dict) else content
    if not order:
        return content
    return in_order_throughout(content, order) if kind == "hierarchy" else in_order(content, order)


def _layered(folder: Path, kind: str, above: tuple[Path, ...], known: dict[Path, dict[str, Any]], *, bare: bool) -> Any:
    """A folder's own document on top of what it is like: of another type's, whole, or `bare` what it adds to its
    modules."""
    paths = documents_in(folder)
    if kind not in paths:
        return None
    path, own = paths[kind], content_as_it_is(paths[kind])
    if not isinstance(own, dict) or not isinstance(own.get("like"), str):
        return own
    other, types = own["like"], type_folders()
    without = _names(own.get("without", []), path, "without")
    if path.resolve() in above:
        raise TemplateError(
            "The document is like itself, or like one that is like it", where=f"{path}: like", hint="Name another type."
        )
    way, bare = (*above, path.resolve()), bare or _MODULES in paths
    base = None
    if other in types:
        base = _layered(types[other], kind, way, known, bare=True) if bare else _content(types[other], kind, way, known)
    if not isinstance(base, dict):
        raise TemplateError(
            f"There is no {path.name} of a type '{other}' to be like", where=f"{path}: like", hint=near(other, types)
        )
    renamed = {folder.name if name == other else name: entry for name, entry in less(base, without).items()}
    return on_top(renamed, {name: entry for name, entry in own.items() if name not in ("like", "without")})


def content_as_it_is(path: Path) -> Any:
    """A file's content, read once while the file is as it was."""
    there = path.stat()
    return _read(path, there.st_mtime_ns, there.st_size)


@functools.lru_cache(maxsize=256)
def _read(path: Path, changed: int, size: int) -> Any:
    return read_json(path)


def _names(value: Any, path: Path, key: str) -> list[str]:
    if not isinstance(value, list) or not all(isinstance(pattern, str) for pattern in value):
        raise TemplateError("It is no list of names", where=f"{path}: {key}", hint='Write e.g. ["track_*"].')
    return value
