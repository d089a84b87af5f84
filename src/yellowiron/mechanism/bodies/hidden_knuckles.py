"""Hidden knuckles: bodies that no CAD part plays, between steered wheels and what carries these. Each is a ball in the
middle of its wheel that weighs a share of it and touches nothing; the wheel is lighter by it, so that the machine's
mass, centre and inertia stay what they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.mechanism.bodies.hidden_wheels import lighter
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body
from yellowiron.support.vectors import clean_triple

SHARE = 0.1
"""Of its wheel's mass: with a tyre of 400 kg a knuckle, its hub and its bearings weigh about as much as 40 kg."""
SIZE = 0.3
"""Of its wheel's radius: as large a ball it is."""


@dataclass(frozen=True, eq=False)
class HiddenKnuckle:
    """One of them: its name, its wheel's, and the wheel's middle (3,), metres, machine frame."""

    role: str
    wheel: str
    center: Floats


def with_knuckles(
    bodies: Sequence[Body], knuckles: Mapping[str, HiddenKnuckle], findings: list[Finding]
) -> tuple[Body, ...]:
    """The bodies, the knuckles behind them."""
    by_name = {body.name: body for body in bodies}
    for name, knuckle in knuckles.items():
        wheel = by_name[knuckle.wheel]
        ball = _ball(knuckle, wheel)
        by_name[knuckle.wheel] = lighter(wheel, [ball], findings, what="hidden knuckles")
        by_name[name] = ball
    return tuple(by_name.values())


def _ball(knuckle: HiddenKnuckle, wheel: Body) -> Body:
    extent = wheel.hull.max(axis=0) - wheel.hull.min(axis=0)
    radius = SIZE * 0.5 * float(np.sort(extent)[1])
    mass = SHARE * wheel.mass
    center = clean_triple(knuckle.center)
    corners = knuckle.center + radius * np.concatenate([np.eye(3), -np.eye(3)])
    inertia = 0.4 * mass * radius * radius * np.eye(3)
    source = f"hidden knuckle: {SHARE:g} of its wheel's mass, as a ball"
    return Body(knuckle.role, center, mass, center, inertia, (), corners, source)
