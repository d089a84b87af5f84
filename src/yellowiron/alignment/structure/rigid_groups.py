"""Groups of solids that know what must stay apart."""

from __future__ import annotations

from collections.abc import Iterable

from yellowiron.support.graphs import LedSets


class Groups:
    """Groups of solids. Two labelled groups (wheel, barrel, rod) never join, nor do two that are kept apart; wheels
    take nothing in."""

    def __init__(self, count: int) -> None:
        self._sets = LedSets(range(count))
        self._label: dict[int, tuple[str, int]] = {}
        self._apart: dict[int, set[int]] = {}

    def find(self, i: int) -> int:
        """The group of a solid: its smallest member so far."""
        return self._sets.leader(i)

    def tag(self, members: Iterable[int], label: tuple[str, int]) -> None:
        """Makes one labelled group of solids."""
        first, *rest = sorted(members)
        for other in rest:
            self._unite(self.find(first), self.find(other))
        self._label[self.find(first)] = label

    def keep_apart(self, i: int, j: int) -> None:
        """Two solids' groups slide on each other, and never join."""
        a, b = self.find(i), self.find(j)
        self._apart.setdefault(a, set()).add(b)
        self._apart.setdefault(b, set()).add(a)

    def label(self, i: int) -> tuple[str, int]:
        """(kind, number) of a solid's group; ("", -1) without one."""
        return self._label.get(self.find(i), ("", -1))

    def kind(self, i: int) -> str:
        """`wheel`, `barrel`, `rod` or ""."""
        return self.label(i)[0]

    def may_join(self, i: int, j: int) -> bool:
        """False for two labelled groups, for wheels, and for what is kept apart."""
        kinds = self.kind(i), self.kind(j)
        return "wheel" not in kinds and not all(kinds) and self.find(j) not in self._apart.get(self.find(i), ())

    def join(self, i: int, j: int) -> bool:
        """Joins two solids' groups if they may be; True if they are one now."""
        a, b = self.find(i), self.find(j)
        if a == b:
            return True
        if not self.may_join(a, b):
            return False
        a, b = min(a, b), max(a, b)
        label = self._label.pop(b, None) or self._label.get(a)
        self._unite(a, b)
        if label is not None:
            self._label[a] = label
        return True

    def _unite(self, a: int, b: int) -> None:
        """Two groups become one, kept apart from what either was."""
        a, b = min(a, b), max(a, b)
        self._sets.join(a, b)
        apart = self._apart.pop(a, set()) | self._apart.pop(b, set())
        for other in apart - {a, b}:
            self._apart[other] -= {a, b}
            self.keep_apart(a, other)
