"""Inertia of their own for hinges that nothing drives, so that engines which iterate hold the loops they are in.

A cylinder's rod and the links of a bucket weigh next to nothing, and carry the load of the whole equipment: solvers
that go from constraint to constraint (PhysX) come nearer to the answer the less bodies that hang on each other differ.
An armature adds no weight, and turns with the hinge alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from yellowiron.kinematics.solver.chain import ClosedChain, State
from yellowiron.kinematics.solver.pose_grid import PoseGrid
from yellowiron.model.mechanism import Joint, Mechanism

SHARE = 0.1
"""What a hinge's armature adds to the mass that any lever moves, at most, in any pose: a skid steer's pins, loaded, err
in PhysX at 120 Hz by 0.66 mm without and by 0.25 mm with it, an excavator's by 0.14 and 0.06. Weights, forces and rated
speeds stay."""
_POSES = 25
"""Of each grid's poses, so many are looked at."""
_STILL = 1e-6
"""Radians per metre or radian of a lever at which a hinge is not moved by it."""


def steady(chain: ClosedChain, grids: Sequence[PoseGrid], joints: dict[str, Joint]) -> None:
    """Gives the hinges of rods and links in loops of `joints` their armature, by the masses in poses of `grids`."""
    hinges = _hinges(chain.mechanism, joints)
    least = np.full(len(hinges), np.inf)
    for state in _poses(chain, grids) if hinges else ():
        try:
            moved = np.diag(chain.masses(state)[0])
            tangents = chain.tangents(state)
        except np.linalg.LinAlgError:  # a dead point
            continue
        for number, name in enumerate(hinges):
            rates = np.array([chain.rate(state, name, tangent) for tangent in tangents.T])
            moving = np.abs(rates) > _STILL
            felt = moved[moving] / rates[moving] ** 2
            least[number] = min(least[number], float(felt.min(initial=np.inf)))
    for name, mass in zip(hinges, least.tolist(), strict=True):
        if np.isfinite(mass):
            joints[name] = replace(joints[name], armature=SHARE * mass)


def _poses(chain: ClosedChain, grids: Sequence[PoseGrid]) -> Iterator[State]:
    """The drawn pose, and some all over each grid."""
    yield chain.drawn
    for grid in grids:
        yield from grid.states[:: max(1, len(grid.states) // _POSES)]


def _hinges(mechanism: Mechanism, joints: Mapping[str, Joint]) -> list[str]:
    """The tree's hinges in loops that nothing drives, springs or frees, but those that a cylinder's nearer half turns
    on: the cylinder alone hangs on them."""
    looped = {name for loop in mechanism.loops for name in loop.joints}
    nearer = {joints[c.slide].body0 for c in mechanism.cylinders}
    return [
        j.name
        for j in joints.values()
        if j.type == "revolute" and j.name in looped and not (j.cut or j.free or j.held)
        and j.drive is None and j.spring is None and j.follows is None and j.body1 not in nearer
    ]  # fmt: skip
