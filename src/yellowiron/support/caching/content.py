"""A digest of a value's content: equal values have the same, whatever they are made of and share.

A machine has 100 000 values, and is asked for its digest at every stage: a frozen dataclass that was asked for, or was
read together with its digest, is looked through once while it lives.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import marshal
import operator
import weakref
from collections.abc import Callable, Hashable, Iterable, Mapping, Set
from dataclasses import fields, is_dataclass
from pathlib import PurePath
from typing import Any, get_args, get_type_hints

import numpy as np

Known = dict[int, tuple[bytes, Any]]
_MARSHAL = 2
"""The last of its formats that does not tell what shares an object from what is equal."""

_remembered: dict[int, tuple[weakref.ref[Any], bytes]] = {}
"""Digests of values that live, by their identity."""


def content_of(value: object) -> bytes:
    """The digest (32 bytes) of plain data, arrays of numbers, paths, and dataclasses of these. A mapping has an order.
    `TypeError` for anything else."""
    known: Known = {}
    digest = _digest(value, known)
    for whole in wholes(value):
        if id(whole) in known:
            remember_content(whole, known[id(whole)][0])
    return digest


def wholes(value: object) -> list[Any]:
    """The frozen dataclasses that a value is, or has directly: in order, the same of equal values."""
    inside: list[Any] = [value, *value] if isinstance(value, (list, tuple)) else [value]
    if _is_frozen(value):
        inside += [getattr(value, field.name) for field in fields(value)]  # type: ignore[arg-type]
    return [one for one in inside if _is_frozen(one)]


def remember_content(value: object, digest: bytes) -> None:
    """`content_of` a frozen dataclass, which need not be made out again."""
    number = id(value)

    def forget(gone: weakref.ref[Any]) -> None:
        _remembered.pop(number, None)

    _remembered[number] = (weakref.ref(value, forget), digest)


def _is_frozen(value: object) -> bool:
    return not isinstance(value, type) and getattr(getattr(value, "__dataclass_params__", None), "frozen", False)


def _digest(value: Any, known: Known) -> bytes:
    if value is None or isinstance(value, (str, int, float, bytes, bytearray, PurePath, np.generic)):
        return _of(type(value).__name__, [_plain(value)])
    told = _remembered.get(id(value))
    if told is not None and told[0]() is value:
        known[id(value)] = (told[1], value)
    if id(value) not in known:
        # The value is kept beside its digest: its number could else be another's.
        known[id(value)] = (_of_many(value, known), value)
    return known[id(value)][0]


def _of_many(value: Any, known: Known) -> bytes:
    if isinstance(value, np.ndarray):
        if value.dtype.kind not in "biuf":
            raise TypeError(f"an array of {value.dtype} has no content")
        return _of(f"array {value.dtype.str} {value.shape}", [np.ascontiguousarray(value).data])
    if isinstance(value, (list, tuple)) and value and all(type(one) is str for one in value):
        return _of("texts", [repr(list(value)).encode("utf-8", "surrogatepass")])
    if isinstance(value, (list, tuple)):
        kind: Any = type(value[0]) if value else None
        if (row_of := _rows(kind)) is not None and all(type(one) is kind for one in value):
            # What holds something else than it says is looked through.
            with contextlib.suppress(ValueError):
                rows = marshal.dumps([row_of(one) for one in value], _MARSHAL)
                return _of(f"rows {kind.__module__}:{kind.__qualname__}", [rows])
        return _of("list", [_digest(one, known) for one in value])
    if isinstance(value, Mapping):
        return _of("mapping", [_digest(one, known) for pair in value.items() for one in pair])
    if isinstance(value, Set):
        return _of("set", sorted(_digest(one, known) for one in value))
    if is_dataclass(value):
        kind = type(value)
        return _of(f"{kind.__module__}:{kind.__qualname__}", [
            _digest(getattr(value, field.name), known) for field in fields(value)
        ])  # fmt: skip
    raise TypeError(f"{type(value).__module__}.{type(value).__qualname__} has no content")


@functools.cache
def _rows(kind: Hashable) -> Callable[[Any], Any] | None:
    """What gives the fields of a dataclass of nothing but numbers, texts and tuples of these, of which a machine has
    100 000; None for another type."""
    if not isinstance(kind, type) or not is_dataclass(kind) or not fields(kind):
        return None
    try:
        hints = get_type_hints(kind)
    except NameError:  # it names what only a type checker imports
        return None
    flat = all(_is_flat(hints[field.name]) for field in fields(kind))
    return operator.attrgetter(*(field.name for field in fields(kind))) if flat else None


def _is_flat(hint: Any) -> bool:
    inside = [one for one in get_args(hint) if one is not Ellipsis]
    return hint in (float, int, bool, str, type(None)) or (bool(inside) and all(_is_flat(one) for one in inside))


def _plain(value: Any) -> bytes:
    if isinstance(value, (bytes, bytearray)):
        return bytes(value)
    return (repr(value) if not isinstance(value, (str, PurePath)) else str(value)).encode("utf-8", "surrogatepass")


def _of(kind: str, pieces: Iterable[bytes | memoryview]) -> bytes:
    """Of the digests of a value's pieces, or its bytes: the kind says how many."""
    digest = hashlib.sha256(f"{kind}\0".encode())
    for piece in pieces:
        digest.update(piece)
    return digest.digest()
