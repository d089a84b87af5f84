"""An answer is given once for an object, not for its equals, and forgotten with it; or once for equal values."""

from __future__ import annotations

import gc
import weakref
from dataclasses import dataclass

import pytest

from yellowiron.support.caching.recent import recent
from yellowiron.support.caching.remembered import remembered


@dataclass(frozen=True)
class Thing:
    size: float


class Made:
    """An answer that can be watched."""


def test_the_same_object_is_asked_once_and_its_equal_again() -> None:
    asked: list[tuple[float, float, str]] = []

    @remembered
    def ask(thing: Thing, by: float, *, word: str = "") -> float:
        asked.append((thing.size, by, word))
        return thing.size * by

    one, other = Thing(2.0), Thing(2.0)
    assert [ask(one, 3.0), ask(one, 3.0), ask(one, 4.0), ask(other, 3.0), ask(one, 3.0, word="x")] == [6, 6, 8, 6, 6]
    assert asked == [(2.0, 3.0, ""), (2.0, 4.0, ""), (2.0, 3.0, ""), (2.0, 3.0, "x")]


def test_further_objects_are_known_by_identity() -> None:
    @remembered
    def ask(thing: Thing, other: dict[str, int]) -> int:
        return other["n"]

    thing, first, second = Thing(1.0), {"n": 1}, {"n": 1}
    assert ask(thing, first) == ask(thing, second) == 1


@pytest.mark.slow
def test_an_answer_is_forgotten_with_its_object() -> None:
    @remembered
    def ask(thing: Thing) -> Made:
        return Made()

    thing = Thing(1.0)
    answer = weakref.ref(ask(thing))
    gc.collect()
    assert answer() is not None
    del thing
    gc.collect()
    assert answer() is None


def test_equal_values_are_asked_once_and_the_last_few_kept() -> None:
    asked: list[float] = []

    def ask(thing: Thing) -> float:
        asked.append(thing.size)
        return 2.0 * thing.size

    lately = recent(ask, most=2)
    assert [lately(Thing(size)) for size in (1.0, 1.0, 2.0, 1.0, 3.0, 1.0, 2.0)] == [2, 2, 4, 2, 6, 2, 4]
    assert asked == [1.0, 2.0, 3.0, 2.0]


def test_a_failure_is_not_kept() -> None:
    asked: list[float] = []

    @recent
    def ask(thing: Thing) -> float:
        asked.append(thing.size)
        return 1.0 / thing.size

    for _ in range(2):
        with pytest.raises(ZeroDivisionError):
            ask(Thing(0.0))
    assert asked == [0.0, 0.0]
