"""Documents on top of each other, as values: what is left out, what is put on top, in which order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fnmatch import fnmatchcase
from typing import Any


def less(value: Any, patterns: Sequence[str]) -> Any:
    """The value without the entries that have a matching name, at any depth."""

    def goes(name: object) -> bool:
        return isinstance(name, str) and any(fnmatchcase(name, pattern) for pattern in patterns)

    if isinstance(value, Mapping):
        return {name: less(entry, patterns) for name, entry in value.items() if not goes(name)}
    if isinstance(value, list):
        return [less(e, patterns) for e in value if not (isinstance(e, Mapping) and goes(e.get("name")))]
    return value


def on_top(base: Any, own: Any) -> Any:
    """A document put on top of another: objects key by key, lists of named entries one after the other, anything else
    instead."""
    if isinstance(base, Mapping) and isinstance(own, Mapping):
        return {**base, **{name: on_top(base.get(name), entry) for name, entry in own.items()}}
    if isinstance(base, list) and isinstance(own, list) and all("name" in e for e in own if isinstance(e, Mapping)):
        return [*base, *own] if any(isinstance(e, Mapping) for e in own) else own
    return own


def beside(base: Any, more: Any) -> Any:
    """What two modules say of one entry: objects key by key, lists one after the other, anything else as the later
    says."""
    if isinstance(base, Mapping) and isinstance(more, Mapping):
        return {**base, **{name: beside(base.get(name), entry) for name, entry in more.items()}}
    return [*base, *more] if isinstance(base, list) and isinstance(more, list) else more


def in_order(content: Mapping[str, Any], patterns: Sequence[str]) -> dict[str, Any]:
    """The entries in the order of the patterns that match them, of several the most exact: the one with most letters;
    those that match none stand last. Entries of one pattern keep their order."""

    def place(name: str) -> int:
        found = [i for i, pattern in enumerate(patterns) if fnmatchcase(name, pattern)]
        return max(found, key=lambda i: len(patterns[i])) if found else len(patterns)

    return {name: content[name] for name in sorted(content, key=place)}


def in_order_throughout(hierarchy: Mapping[str, Any], patterns: Sequence[str]) -> dict[str, Any]:
    """As `in_order`, of a hierarchy, at every depth."""

    def inner(entry: Any) -> Any:
        child = _child(entry)
        return {**entry, "child": in_order_throughout(child, patterns)} if child is not None else entry

    return {name: inner(entry) for name, entry in in_order(hierarchy, patterns).items()}


def nested(hierarchy: Mapping[str, Any]) -> dict[str, Any]:
    """A hierarchy whose entries that say their `parent` stand under it, where it is there."""
    places: dict[str, dict[str, Any]] = {}

    def copied(entries: Mapping[str, Any]) -> dict[str, Any]:
        """As deep as there are entries, each noted by its name."""
        own = {name: dict(entry) if isinstance(entry, Mapping) else entry for name, entry in entries.items()}
        for name, entry in own.items():
            if isinstance(entry, dict):
                places.setdefault(_bare(name), entry)
            if (child := _child(entry)) is not None:
                entry["child"] = copied(child)
        return own

    content = copied(hierarchy)
    for name, entry in list(content.items()):
        host = places.get(_bare(str(entry.get("parent", "")))) if isinstance(entry, dict) else None
        if host is not None and host is not entry and isinstance(host.setdefault("child", {}), dict):
            host["child"][name] = entry
            del content[name], entry["parent"]
    return content


def _child(entry: Any) -> Mapping[str, Any] | None:
    """The entries below one, where it has some that are not names alone."""
    child = entry.get("child") if isinstance(entry, Mapping) else None
    return child if isinstance(child, Mapping) else None


def _bare(name: str) -> str:
    return name.removesuffix("[*]")
