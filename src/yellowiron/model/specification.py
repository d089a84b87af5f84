"""Specifications: the values of a sheet, with their evidence and status."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Literal

from yellowiron.model.finding import Finding

Status = Literal["ok", "review", "conflict", "missing", "unreadable"]
Source = Literal["template", "sheet", "data", "set", "calibrated", "geometry"]

_SHARE = re.compile(r"^\s*([-+]?[0-9]+(?:\.[0-9]+)?)\s*%\s*of\s+(\S.*?)\s*$")


@dataclass(frozen=True)
class Evidence:
    """Where a value was read: file name (no folder), page (1 = first), quote, box (x0, top, x1, bottom in points)."""

    file: str
    page: int
    quote: str
    box: tuple[float, float, float, float] | None = None


@dataclass(frozen=True)
class SheetPage:
    """A page of a sheet to look at: its `picture` as WebP bytes, its `size`, width and height in points, as `box`es are
    in."""

    file: str
    page: int
    size: tuple[float, float]
    picture: bytes


@dataclass(frozen=True)
class Candidate:
    """One value that a sheet offers for a wanted name, in SI units; `configuration` is its column or variant."""

    value: float
    unit: str
    evidence: Evidence
    configuration: str = ""
    confidence: float = 0.0
    reason: str = ""


@dataclass(frozen=True)
class Specification:
    """One wanted value. `value` is in SI (`unit`: m, rad, kg, Pa, m^3/s, m^3, N, N*m, W, m/s, rad/s, s, 1) or None.

    `status` other than `ok` means that nothing may rely on it without a person; `example` marks a value that
    its sheet prints as the publisher's "example value", reported apart. `text` is the value as printed.
    """

    name: str
    value: float | None
    unit: str
    status: Status
    source: Source = "sheet"
    evidence: Evidence | None = None
    text: str = ""
    example: bool = False
    confidence: float = 0.0
    reason: str = ""
    hint: str = ""
    candidates: tuple[Candidate, ...] = ()


@dataclass(frozen=True)
class Specifications:
    """All wanted values by name; names are compared without regard to case, `_` or spaces."""

    values: Mapping[str, Specification] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()

    def get(self, name: str) -> Specification | None:
        """The specification of that name, or None."""
        wanted = fold(name)
        for key, value in self.values.items():
            if fold(key) == wanted:
                return value
        return None

    def number(self, name: str) -> float | None:
        """The SI value, if its status is `ok`; else None."""
        found = self.get(name)
        return found.value if found is not None and found.status == "ok" else None

    def __iter__(self) -> Iterator[Specification]:
        return iter(self.values.values())

    def __len__(self) -> int:
        return len(self.values)


@functools.lru_cache(maxsize=65536)
def fold(name: str) -> str:
    """A name without case, underscores, hyphens and spaces: how template keys and values are compared."""
    return "".join(c for c in name.casefold() if c not in " _-\t\n")


def share_of(text: object) -> tuple[float, str] | None:
    """'46 % of Telescoping Cylinder Stroke' → (0.46, the specification's name); None for anything else."""
    found = _SHARE.match(text) if isinstance(text, str) else None
    return (0.01 * float(found[1]), " ".join(found[2].split())) if found is not None else None
