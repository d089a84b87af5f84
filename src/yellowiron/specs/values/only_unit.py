"""The unit that a sheet leaves unsaid where it has no other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from yellowiron.specs.values.claims import Claim

_FEWEST = 8
"""Lengths that must be printed in it."""
_LEAST = 100.0
"""What is less may count something."""


def in_only_unit(claims: Sequence[Claim]) -> list[Claim]:
    """The bare numbers of a sheet in mm, where all its lengths of such a size are in mm and none is in inches or feet:
    "Tread width 1,474" among them is no 1,474 of anything else."""
    lengths = [q for c in claims for q in (c.quantity, c.partner) if q is not None and q.dimension == "length"]
    large = [q for q in lengths if q.value >= _LEAST]
    if len(large) < _FEWEST or any(q.printed and q.printed.system == "imperial" for q in lengths):
        return []
    if {q.unit for q in large} != {"mm"}:
        return []
    table = [c for c in claims if not c.statement.running]  # in a sentence it may be a model
    bare = [c for c in table if not c.quantity.unit and not c.quantity.sign and c.quantity.value >= _LEAST]
    return [replace(claim, quantity=replace(claim.quantity, unit="mm")) for claim in bare]
