"""A value of an example's sheet."""

from __future__ import annotations

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
