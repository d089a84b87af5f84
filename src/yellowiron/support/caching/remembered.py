"""What is asked of the same object again: answered once, and kept for as long as the object is in use."""

from __future__ import annotations

import functools
import weakref
from collections.abc import Callable, Hashable
from typing import Any, Concatenate, ParamSpec, TypeVar

Subject = TypeVar("Subject")
Rest = ParamSpec("Rest")
Answer = TypeVar("Answer")

_PLAIN = (str, bytes, int, float, frozenset, type(None))


class _This:
    """An object as a key: itself, whatever it may be equal to."""

    def __init__(self, value: object) -> None:
        self.value = value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _This) and other.value is self.value

    def __hash__(self) -> int:
        return id(self.value)


def remembered(function: Callable[Concatenate[Subject, Rest], Answer]) -> Callable[Concatenate[Subject, Rest], Answer]:
    """A pure function that answers the same question about the same object once. Its first argument and those that are
    no numbers, texts or frozen sets are known by identity, so they must never change; an answer must not hold on to the
    first argument, with which it is forgotten."""
    known: dict[int, tuple[weakref.ref[Any], dict[Hashable, Answer]]] = {}

    def ask(subject: Subject, /, *args: Rest.args, **kwargs: Rest.kwargs) -> Answer:
        number = id(subject)
        if number not in known:
            known[number] = (weakref.ref(subject, lambda _: known.pop(number, None)), {})
        answers = known[number][1]
        given = (*args, *(item for name in sorted(kwargs) for item in (name, kwargs[name])))
        key = tuple(a if isinstance(a, _PLAIN) else _This(a) for a in given)
        if key not in answers:
            answers[key] = function(subject, *args, **kwargs)
        return answers[key]

    return functools.update_wrapper(ask, function)
