"""Where the kinematics has a machine at the strokes that an engine measures: solved every few steps, and between them
led over smoothly, with what is measured there taken into account and what comes out held against the loops."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

from yellowiron.kinematics import ClosedChain, State
from yellowiron.kinematics.solver.positions import moved, normalized
from yellowiron.model.geometry import Floats


def solved(chain: ClosedChain, coordinates: Floats, start: State) -> tuple[State, ...]:
    """The states of n steps, each solved on from `start`: `coordinates` (n, independent), metres or radians in the
    chain's order. Fewer where the linkage locks."""
    if not chain.independent:
        return (start,) * len(coordinates)
    return chain.sweep({name: coordinates[:, i] for i, name in enumerate(chain.independent)}, start=start)


def led_over(chain: ClosedChain, coordinates: Floats, start: State, stride: int) -> list[State]:
    """Like `solved`, but only each `stride`-th step and the last are: between them all coordinates run along a cubic
    spline through the solved ones, and where the given ones leave it, the others go with them along the tangents.
    Empty where that cannot be done: `solved` says how far it goes. How well loops close between the solved steps is for
    the caller to see: the `closure` of the states there is infinite."""
    count = len(coordinates)
    if stride < 2 or count < 2 * stride or not chain.independent:
        return []
    knots = np.unique(np.append(np.arange(0, count, stride), count - 1))
    states = solved(chain, coordinates[knots], start)
    if len(states) < len(knots):
        return []
    tangents = np.array([chain.tangents(state) for state in states])
    steps = np.arange(count)
    positions = CubicSpline(knots, np.array([state.position for state in states]))(steps)
    aside = coordinates - CubicSpline(knots, coordinates[knots])(steps)
    before = np.minimum(np.searchsorted(knots, steps, side="right") - 1, len(knots) - 2)
    share = ((steps - knots[before]) / (knots[before + 1] - knots[before]))[:, None]
    ways = [
        weight * np.einsum("nij,nj->ni", tangents[here], aside)
        for here, weight in ((before, 1.0 - share), (before + 1, share))
    ]
    if chain.plain:
        positions = positions + ways[0] + ways[1]
    else:
        positions = moved(normalized(positions, chain.balls), ways[0] + ways[1], chain.balls)
    between = [State(position, float("inf")) for position in positions]
    for knot, state in zip(knots.tolist(), states, strict=True):
        between[knot] = state
    return between
