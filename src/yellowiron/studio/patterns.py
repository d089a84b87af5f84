"""Patterns over the CAD tree that mean what a person selected: the assemblies around it, and what its names share."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from yellowiron.model.alignment import RoleRule
from yellowiron.model.assembly import Assembly

_LEAST = 3
"""Letters that names share, from which on they are offered as a pattern."""
_NUMBER = re.compile(r"[\s_.:#-]*\d*$")
Fitting = Callable[[str], Sequence[str]]


@dataclass(frozen=True)
class Pattern:
    """A pattern, the `parts` that fit it, and what was said of it: `ruled`, and then its `role` (None: not part of the
    machine)."""

    pattern: str
    parts: tuple[str, ...]
    ruled: bool = False
    role: str | None = None


def patterns_of(
    selected: Sequence[str], assembly: Assembly, fitting: Fitting, rules: Sequence[RoleRule]
) -> list[Pattern]:
    """What a person may mean who selected these parts, the innermost assembly first, then what was said by patterns
    before. `fitting` gives the parts that fit a pattern (`alignment.fits`)."""
    offered = [*_around(selected, assembly, fitting), *_alike(selected, assembly)] if selected else []
    found = []
    for pattern in dict.fromkeys(offered):
        parts = fitting(pattern)
        if set(selected) <= set(parts) and len(parts) < len(assembly.parts):
            found.append(pattern)
    return [pattern_of(pattern, fitting, rules) for pattern in dict.fromkeys((*found, *(r.pattern for r in rules)))]


def pattern_of(pattern: str, fitting: Fitting, rules: Sequence[RoleRule]) -> Pattern:
    """A pattern with its parts, and what was said of it."""
    said = next((rule for rule in rules if rule.pattern == pattern), None)
    return Pattern(pattern, tuple(fitting(pattern)), said is not None, said.role if said is not None else None)


def _around(selected: Sequence[str], assembly: Assembly, fitting: Fitting) -> Iterator[str]:
    """The assemblies around all of the parts: each by as little of its path as means it and no other."""
    paths = [part.split("/")[:-1] for part in selected]
    shared = 0
    while all(len(path) > shared and path[shared] == paths[0][shared] for path in paths):
        shared += 1
    ids = [part.id for part in assembly.parts]
    for depth in range(shared, 0, -1):
        steps = paths[0][:depth]
        inside = {part for part in ids if part.startswith("/".join(steps) + "/")}
        tails = ("/".join(steps[depth - kept :]) + "/*" for kept in range(1, depth + 1))
        short = next((tail for tail in tails if set(fitting(tail)) == inside), None)
        if short is not None:
            yield short


def _alike(selected: Sequence[str], assembly: Assembly) -> Iterator[str]:
    """What the parts' names begin with, without the number at its end."""
    names = [assembly.part(part).name for part in selected]
    letters = 0
    while all(len(name) > letters and name[letters].lower() == names[0][letters].lower() for name in names):
        letters += 1
    stem = _NUMBER.sub("", names[0][:letters])
    if len(stem) >= _LEAST:
        yield f"{stem}*"
