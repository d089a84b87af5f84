"""How a machine goes over the ground on wheels that cannot all roll: by dry friction, alike in any direction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from yellowiron.kinematics import ClosedChain, State
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.simulation.driving.wheel import GroundWheel

_ACROSS = 9
"""Places across a wheel at which it stands: a drum carries along its whole width, not on its ends."""
_SMOOTHED = (1e-1, 1e-2, 1e-3, 1e-4)
"""Shares of the wheels' speeds below which sliding counts as its square: each begins where the last ended."""
_STEPS, _STILL, _HALVINGS = 60, 1e-10, 40


@dataclass(frozen=True, eq=False)
class Standing:
    """Places on the ground (n, 2) under wheels, seen from above, each with the unit direction `ahead` (n, 2) in which
    its wheel rolls, that wheel's number (n,), the share (n,) of the weight that it bears, and whether nothing drives
    the wheel (n,), so that it rolls as it likes."""

    places: Floats
    ahead: Floats
    wheel: NDArray[np.int_]
    loads: Floats
    free: NDArray[np.bool_]


def center_of_mass(chain: ClosedChain, mechanism: Mechanism, state: State) -> Floats:
    """(3,), metres, machine frame, in a state."""
    mass = sum(body.mass for body in mechanism.bodies)
    moved = [
        b.mass * (chain.displacement(state, b.name) @ np.append(b.center_of_mass, 1.0))[:3] for b in mechanism.bodies
    ]
    return np.asarray(np.sum(moved, axis=0) / mass)


def standing(wheels: Sequence[GroundWheel], middles: Floats, axes: Floats, centre: Floats) -> Standing:
    """Where `wheels` stand with their `middles` (n, 2) and unit `axes` (n, 2) seen from above, the centre of mass (2,)
    above them. Weight lies on them evenly along any line, and as much to all sides as balances it."""
    across = np.linspace(-1.0, 1.0, _ACROSS)
    half = np.array([wheel.half_width for wheel in wheels])
    places = (middles[:, None] + (half[:, None] * across)[..., None] * axes[:, None]).reshape(-1, 2)
    forward = np.column_stack([axes[:, 1], -axes[:, 0]])
    forward *= np.where(forward[:, :1] < 0.0, -1.0, 1.0)
    rows = np.vstack([np.ones(len(places)), places.T])
    loads, *_ = np.linalg.lstsq(rows, np.array([1.0, *centre]), rcond=None)
    loads = np.maximum(loads, 0.0)
    number = np.repeat(np.arange(len(wheels)), _ACROSS)
    free = np.array([not wheel.actuator for wheel in wheels])
    return Standing(places, forward[number], number, loads / loads.sum(), free[number])


def least_sliding(under: Standing, rolled: Floats) -> Floats:
    """(3,): how the machine goes along x and y and turns to the left, while its wheels roll by `rolled` (wheels,)
    metres.

    Of all ways that one on which friction takes least work: there what it pushes balances, in both directions and in
    moment. How hard the ground's friction is does not matter.
    """
    one, zero = np.ones(len(under.places)), np.zeros(len(under.places))
    along = np.stack(
        [np.column_stack([one, zero, -under.places[:, 1]]), np.column_stack([zero, one, under.places[:, 0]])]
    )
    told = (under.ahead * rolled[under.wheel][:, None]).T
    # What nothing drives slides across its way alone.
    counts = np.eye(2) - under.free[:, None, None] * np.einsum("pk,pl->pkl", under.ahead, under.ahead)
    along, told = np.einsum("pkl,lpi->kpi", counts, along), np.einsum("pkl,lp->kp", counts, told)
    scale = float(np.abs(rolled).max())
    if scale <= 0.0:
        return np.zeros(3)
    way, *_ = np.linalg.lstsq(along.reshape(-1, 3), told.ravel(), rcond=None)

    def work(tried: Floats, smooth: float) -> float:
        slides = along @ tried - told
        return float(under.loads @ np.sqrt((slides**2).sum(axis=0) + smooth**2))

    for share in _SMOOTHED:
        smooth = share * scale
        for _ in range(_STEPS):
            slides = along @ way - told
            size = np.sqrt((slides**2).sum(axis=0) + smooth**2)
            slope = np.einsum("p,kpi,kp->i", under.loads / size, along, slides)
            pulled = np.einsum("kpi,kp->pi", along, slides)
            bend = np.einsum("p,kpi,kpj->ij", under.loads / size, along, along)
            bend -= np.einsum("p,pi,pj->ij", under.loads / size**3, pulled, pulled)
            step, *_ = np.linalg.lstsq(bend, -slope, rcond=None)
            length = 1.0
            for _ in range(_HALVINGS):
                if work(way + length * step, smooth) <= work(way, smooth):
                    break
                length *= 0.5
            way = way + length * step
            if float(np.abs(length * step).max()) < _STILL * scale:
                break
    return np.asarray(way)
