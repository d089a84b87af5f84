"""References: that they lead somewhere, on every computer, and that physics stays in its layers."""

from __future__ import annotations

from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.view import View


@rule(
    "CHK010",
    "error",
    "Keep the file together with what it refers to, or correct the path.",
)
def broken_reference(view: View) -> Remarks:
    """A reference leads nowhere."""
    yield from view.broken


@rule(
    "CHK011",
    "warning",
    "Put the file where the path says, or correct the path.",
)
def missing_asset(view: View) -> Remarks:
    """A texture or other asset is missing."""
    for text in view.missing_assets:
        where, _, path = text.partition(": ")
        yield where, f"There is no '{path}'."


@rule(
    "CHK012",
    "warning",
    "Write it relative to its layer, so that the file opens from any folder.",
)
def absolute_path(view: View) -> Remarks:
    """A path is absolute."""
    for layer, path in view.absolute_paths:
        yield layer, f"It refers to '{path}', which only this computer has."


@rule(
    "CHK013",
    "warning",
    "Move it to a layer that the variant Physics=on brings, so that Physics=off has none.",
)
def stray_physics(view: View) -> Remarks:
    """Physics is written outside the physics layers."""
    if view.stray_physics:
        first, count = view.stray_physics[0], len(view.stray_physics)
        yield first, f"With Physics=off, {count} prim(s) still have physics, this one first."
