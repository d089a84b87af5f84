"""Values printed inside another value's label: the 2.44 m of "digging depth, 2.44 m level bottom"."""

from __future__ import annotations

from collections.abc import Sequence

from yellowiron.model.specification import Specification
from yellowiron.model.template import Wanted
from yellowiron.specs.language.decimal_style import DecimalStyle
from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.quantities import Quantity
from yellowiron.specs.values.contention import Match
from yellowiron.specs.values.decision import Sheets, evidence_of, missing, specified
from yellowiron.specs.values.requested import usual


def in_label(wanted: Wanted, matches: Sequence[Match], sheets: Sheets, style: DecimalStyle) -> Specification:
    """The quantity in the labels of another value's matches; `missing` where they hold none within the plausible
    range, or different ones."""
    found: list[tuple[Match, Quantity]] = []
    for match in matches:
        quantity = _quantity(wanted, match.claim.statement.label, style)
        if quantity is not None:
            found.append((match, quantity))
    if not found:
        return missing(wanted)
    first, quantity = found[0]
    if any(abs(other.si_value - quantity.si_value) > 1e-9 for _, other in found):
        return missing(wanted, reason="the labels of the sheets differ")
    return specified(
        wanted,
        quantity.si_value,
        "ok",
        evidence=evidence_of(first, sheets),
        text=quantity.text,
        confidence=round(first.score, 3),
        reason=f"in the label of {first.wanted.name}",
    )


def _quantity(wanted: Wanted, label: str, style: DecimalStyle) -> Quantity | None:
    """The first quantity of the wanted dimension in a label, metric where it is in both systems."""
    for reading in read(label, style=style):
        both = (*reading.numbers, *reading.partner)
        fitting = [q for q in both if q.dimension == wanted.dimension and usual(wanted, q.si_value)]
        metric = [q for q in fitting if q.printed is not None and q.printed.system == "metric"]
        if fitting:
            return (metric or fitting)[0]
    return None
