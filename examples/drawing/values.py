"""A value of an example's sheet."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Value:
    """One value of the sheet; `source` names the maker's fact, `location` where it is printed; `source` is None for a
    value of our own.

    `high`: upper end where the maker prints a range; `value` is then its lower end.
    """

    name: str
    value: float
    unit: str
    source: str | None = None
    location: str = ""
    high: float | None = None

    @property
    def published(self) -> bool:
        """True when the maker prints it; False for an example value."""
        return self.source is not None


def sorted_values(
    names: Mapping[str, object], others: Collection[Value] = ()
) -> tuple[tuple[Value, ...], tuple[Value, ...]]:
    """What the maker publishes, and what is ours and printed beside it, of a module's `names` (its `globals()`) and in
    their order; `others` are neither."""
    every = [value for value in list(names.values()) if isinstance(value, Value) and value not in others]
    return tuple(v for v in every if v.published), tuple(v for v in every if not v.published)
