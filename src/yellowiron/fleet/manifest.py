"""A manifest → the plan of a batch: machines one by one, or by a pattern of files, with `{stem}` in what goes along."""

from __future__ import annotations

import functools
import glob
import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from yellowiron.fleet.documents import Key, UnusableError, checked, read_document
from yellowiron.fleet.places import is_remote, joined
from yellowiron.fleet.values import Item, Plan, Variants

TRACKS = ("belt", "shoes", "fixed")
KEYS: Mapping[str, Key] = {
    "id": Key("text"),
    "type": Key("text"),
    "cad": Key("text"),
    "specs": Key("texts"),
    "data": Key("texts"),
    "alignment": Key("text"),
    "set": Key("texts"),
    "config": Key("text"),
    "tracks": Key("text", TRACKS),
    "mirror": Key("flag"),
    "page": Key("flag"),
    "engines": Key("texts"),
    "variants": Key("table"),
    "timeout": Key("duration"),
    "memory": Key("size"),
}
"""What an entry of `machines` says; `defaults` says the same of all, but `id` and `cad`."""
VARIANT_KEYS: Mapping[str, Key] = {"file": Key("text"), "count": Key("integer"), "seed": Key("integer")}
_MANIFEST: Mapping[str, Key] = {"defaults": Key("table"), "machines": Key("tables")}
_ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,99}")
_UNFIT = re.compile(r"[^A-Za-z0-9._-]+")
_MAGIC = re.compile(r"[*?\[]")
_PLAIN = ("set", "config", "tracks", "mirror", "page", "engines")
_MOST = 100_000


def read_manifest(address: str | Path) -> Plan:
    """The plan that a manifest (YAML, TOML, JSON or CSV) makes. Paths in it are relative to its folder.

    An entry whose `cad` is a pattern (`loaders/*.step`, `**` for any depth) is one item a file, in the order of their
    names; `{stem}`, `{name}` and `{parent}` in its other texts are the file's. Without an `id` an item has its file's
    stem. `UnusableError` with the entry's place for what it does not know, an id that is there twice, and a pattern
    that no file fits. Whether files are there and what is in them is found out when an item runs.
    """
    address = str(address) if is_remote(str(address)) else str(Path(address).resolve())
    document = read_document(address, what="The manifest")
    if not isinstance(document, Mapping):
        raise UnusableError("The manifest has no machines", where=address, hint="It begins with: machines:")
    whole = checked(document, _MANIFEST, where=address, needed=["machines"])
    usual = {name: key for name, key in KEYS.items() if name not in ("id", "cad")}
    defaults = checked(whole.get("defaults", {}), usual, where=f"{address}: defaults")
    base = address.rpartition("/")[0]
    items: list[Item] = []
    places: dict[str, str] = {}
    for number, entry in enumerate(whole["machines"], start=1):
        where = f"{address}: machines[{number}]"
        said = checked(entry, KEYS, where=where, needed=["cad"])
        for item in _items({**defaults, **said}, base, where):
            other = places.setdefault(item.id.casefold(), where)
            if other != where or (items and items[-1].id == item.id):
                raise UnusableError(
                    f"The id '{item.id}' is given twice", where=where,
                    hint=f"It is also {other.rpartition(': ')[2]}'s: say id: …, with {{stem}} where files are many.",
                )  # fmt: skip
            items.append(item)
            if len(items) > _MOST:
                raise UnusableError(f"There are more than {_MOST} machines", where=where, hint="Split the manifest.")
    twice = {item.id.casefold() for item in items}
    if len(twice) < len(items):
        raise UnusableError(
            "Two files of one entry have the same id", where=address, hint="Put {parent} or {name} into its id."
        )
    return Plan(address, tuple(items))


def _items(said: Mapping[str, Any], base: str, where: str) -> Iterator[Item]:
    if "type" not in said:
        raise UnusableError("'type' is missing", where=where, hint="Say it there, or in defaults: type: wheel_loader")
    files = _files(joined(base, said["cad"]), where)
    for file in files:
        folder, _, name = file.rpartition("/")
        stem = name.rpartition(".")[0] or name
        words = {"{stem}": stem, "{name}": name, "{parent}": folder.rpartition("/")[2]}
        filled = {key: _filled(value, words) for key, value in said.items()}
        if "id" not in filled:
            filled["id"] = _UNFIT.sub("_", stem).strip("_.-")[:100] or "machine"
        yield _item({**filled, "cad": file}, base, where)


def _files(cad: str, where: str) -> list[str]:
    """The files that a pattern fits, in the order of their names; what is no pattern, or is a file's name, itself."""
    if not _MAGIC.search(cad) or (not is_remote(cad) and Path(cad).exists()):
        return [cad]
    if is_remote(cad):
        import fsspec

        scheme = cad.partition("://")[0]
        system, path = fsspec.core.url_to_fs(cad)
        found = [f"{scheme}://{each.lstrip('/')}" for each in system.glob(path)]
    else:
        found = glob.glob(cad, recursive=True)  # noqa: PTH207 - the pattern is a text with a folder in it
    if not found:
        raise UnusableError("No file fits the pattern", where=f"{where}.cad", hint=f"Nothing is at {cad}.")
    return sorted(found)


def _filled(value: Any, words: Mapping[str, str]) -> Any:
    if isinstance(value, str):
        for name, word in words.items() if "{" in value else ():
            value = value.replace(name, word)
        return value
    return tuple(_filled(each, words) for each in value) if isinstance(value, tuple) else value


def _item(said: Mapping[str, Any], base: str, where: str) -> Item:
    if not _ID.fullmatch(said["id"]):
        raise UnusableError(
            f"The id '{said['id'][:120]}' cannot name a folder", where=f"{where}.id",
            hint="Letters, digits, '.', '_' and '-', at most a hundred.",
        )  # fmt: skip
    kind = said["type"]
    if "/" in kind or (kind not in _library() and _is_folder(base, kind)):
        kind = joined(base, kind)
    variants = None
    if "variants" in said:
        more = checked(said["variants"], VARIANT_KEYS, where=f"{where}.variants", needed=["file", "count"])
        variants = Variants(joined(base, more["file"]), more["count"], more.get("seed", 0))
    made = Item(
        id=said["id"],
        type=kind,
        cad=said["cad"],
        variants=variants,
        timeout_s=said.get("timeout", Item.timeout_s),
        memory_mb=said.get("memory", Item.memory_mb),
        where=where,
    )
    plain: dict[str, Any] = {
        name: said[name] for name in ("set", "config", "tracks", "mirror", "page", "engines") if name in said
    }
    paths: dict[str, Any] = {
        name: tuple(joined(base, each) for each in said[name]) for name in ("specs", "data") if name in said
    }
    alignment: dict[str, Any] = {"alignment": joined(base, said["alignment"])} if said.get("alignment") else {}
    return replace(made, **plain, **paths, **alignment)


@functools.cache
def _library() -> frozenset[str]:
    """The types that there are without a folder: a folder of such a name beside a manifest is none of them."""
    from yellowiron import library

    return frozenset(library.list_templates())


@functools.lru_cache(maxsize=256)
def _is_folder(base: str, name: str) -> bool:
    return not is_remote(base) and Path(base, name).is_dir()


def shard_of(plan: Plan, shard: str) -> Plan:
    """The items of a share of a plan, `i/n` with i from 1 to n: every n-th, so that sizes mix. `UnusableError`."""
    match = re.fullmatch(r"([0-9]{1,6})/([0-9]{1,6})", shard)
    number, of = (int(match.group(1)), int(match.group(2))) if match else (0, 0)
    if not 1 <= number <= of:
        raise UnusableError(f"'{shard}' is no share", where="--shard", hint="The first of eight is 1/8.")
    return replace(plan, items=plan.items[number - 1 :: of])
