"""What a guarded child answers, as bytes that are read without trust: its reader has worked on somebody's file.

They are a pickle that may name nothing: the one function it calls makes arrays of numbers, paths, our own values
(frozen dataclasses) and our own errors, after looking at each. numpy's own pickles would not do: what they say of a
type of numbers may make pointers of them.
"""

from __future__ import annotations

import functools
import io
import pickle
import sys
from collections.abc import Hashable
from dataclasses import fields, is_dataclass
from importlib import import_module
from pathlib import Path, PurePath
from typing import Any

from yellowiron.model.errors import YellowironError

_OURS = "yellowiron."
_NUMBERS = frozenset(("|b1", "|i1", "|u1", *(f"<{kind}{size}" for kind in "iuf" for size in (2, 4, 8))))
"""The types of arrays, as numpy writes them."""


def dumps(value: Any) -> bytes:
    """The bytes of a value made of plain data, arrays of numbers, paths, frozen dataclasses and errors of this package.
    `TypeError` for anything else."""
    buffer = io.BytesIO()
    _Pickler(buffer, protocol=5).dump(value)
    return buffer.getvalue()


def loads(data: bytes) -> Any:
    """The value of such bytes. `pickle.UnpicklingError`, or whatever else they break on, for bytes that are none."""
    return _Unpickler(io.BytesIO(data)).load()


class _Pickler(pickle.Pickler):
    def reducer_override(self, value: Any) -> Any:
        """How a value that is no plain data is made again."""
        numpy = sys.modules.get("numpy")
        kind: Any = type(value)
        if numpy is not None and isinstance(value, (numpy.ndarray, numpy.generic)):
            if value.dtype.str not in _NUMBERS:
                raise TypeError(f"an array of {value.dtype} is no answer")
            how = "array" if isinstance(value, numpy.ndarray) else "number"
            return make, (how, value.dtype.str, value.shape, bytearray(value.tobytes()))
        if isinstance(value, YellowironError):
            # An error of another package is what it is made of.
            ours = next(k for k in kind.__mro__ if k.__module__.startswith(_OURS))
            return make, ("error", _name(ours), value.message, value.where, value.hint)
        if isinstance(value, PurePath):
            return make, ("path", str(value))
        if value is make:
            return "make"
        if _is_value(kind):
            return make, ("value", _name(kind), *(getattr(value, name) for name in _fields(kind)))
        raise TypeError(f"{kind.__module__}.{kind.__qualname__} is no answer")


class _Unpickler(pickle.Unpickler):
    def find_class(self, module: str, name: str) -> Any:
        """The one function that there is."""
        if (module, name) != (__name__, "make"):
            raise pickle.UnpicklingError(f"an answer has no use for {module}.{name}")
        # One that is thrown away: a pickle may set attributes of what it gets.
        return lambda *words: make(*words)


def make(how: str, *words: Any) -> Any:
    """What an answer says that it holds; `pickle.UnpicklingError` where it may not hold that."""
    if how in ("array", "number"):
        import numpy as np

        kind, shape, data = words
        if kind not in _NUMBERS or type(data) is not bytearray:
            raise pickle.UnpicklingError("no array of numbers")
        array = np.frombuffer(data, dtype=kind).reshape(shape)
        return array if how == "array" else array[()]
    if how == "path":
        return Path(str(words[0]))
    found = _found(words[0])
    if how == "error" and issubclass(found, YellowironError):
        message, where, hint = map(str, words[1:])
        return found(message, where=where, hint=hint)
    if how == "value" and _is_value(found):
        value: Any = object.__new__(found)
        for name, content in zip(_fields(found), words[1:], strict=True):
            object.__setattr__(value, name, content)
        return value
    raise pickle.UnpicklingError(f"nothing is made of {how}")


@functools.cache
def _is_value(kind: Hashable) -> bool:
    """Whether a class is a frozen dataclass of this package."""
    frozen = getattr(getattr(kind, "__dataclass_params__", None), "frozen", False)
    return isinstance(kind, type) and is_dataclass(kind) and kind.__module__.startswith(_OURS) and bool(frozen)


@functools.cache
def _fields(kind: Any) -> tuple[str, ...]:
    return tuple(field.name for field in fields(kind))


@functools.cache
def _name(kind: Any) -> str:
    return f"{kind.__module__}:{kind.__qualname__}"


@functools.cache
def _found(name: str) -> type:
    """The class of this package that has a name."""
    module, _, title = name.partition(":")
    if not module.startswith(_OURS) or not title.isidentifier():
        raise pickle.UnpicklingError(f"{name} is none of ours")
    found = vars(import_module(module)).get(title)
    if not isinstance(found, type) or found.__module__ != module:
        raise pickle.UnpicklingError(f"{name} is no class")
    return found
