"""Sampling: the poses a group of coupled actuators can take, as a lattice of solved states over their strokes."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from yellowiron.kinematics.solver.chain import ClosedChain, State
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Joint

_POINTS = {1: 41, 2: 15, 3: 7}
_TURN = 2.0 * np.pi


@dataclass(frozen=True, eq=False)
class PoseGrid:
    """Solved states over a lattice of the drivers' ranges. `values` (n, drivers) are their coordinates, `parents` (n,)
    the state each was solved from (−1: the drawn pose), `corners` the indices of the range's corners among the
    states, `unreachable` the lattice points (coordinates) that no step led to."""

    drivers: tuple[str, ...]
    states: tuple[State, ...]
    values: Floats
    parents: tuple[int, ...]
    corners: tuple[int, ...]
    unreachable: tuple[tuple[float, ...], ...]


def explore(chain: ClosedChain, ranges: Mapping[str, tuple[float, float]], *, points: int | None = None) -> PoseGrid:
    """The lattice of `points` per driver (default: fewer the more drivers there are), each state solved from a solved
    neighbour, outwards from the drawn pose."""
    drivers = tuple(ranges)
    count = points or _POINTS.get(len(drivers), 3)
    axes = [np.linspace(low, high, count) for low, high in ranges.values()]
    shape = (count,) * len(drivers)
    drawn = np.array([chain.coordinate(chain.drawn, name) for name in drivers])
    first = tuple(int(np.argmin(np.abs(axis - at))) for axis, at in zip(axes, drawn, strict=True))
    number: dict[tuple[int, ...], int] = {}
    states: list[State] = []
    values: list[Floats] = []
    parents: list[int] = []

    def attempt(node: tuple[int, ...], parent: int) -> bool:
        target = {name: float(axis[i]) for name, axis, i in zip(drivers, axes, node, strict=True)}
        state, fraction = chain.reach(target, start=states[parent] if parent >= 0 else chain.drawn)
        if fraction < 1.0:
            return False
        number[node] = len(states)
        states.append(state)
        values.append(np.array(list(target.values())))
        parents.append(parent)
        return True

    waiting: deque[tuple[int, ...]] = deque()
    if attempt(first, -1):
        waiting.append(first)
    while waiting:
        node = waiting.popleft()
        for driver in range(len(drivers)):
            for way in (-1, 1):
                index = node[driver] + way
                neighbour = (*node[:driver], index, *node[driver + 1 :])
                if 0 <= index < count and neighbour not in number and attempt(neighbour, number[node]):
                    waiting.append(neighbour)
    lattice = list(np.ndindex(*shape))
    return PoseGrid(
        drivers,
        tuple(states),
        np.array(values).reshape(len(states), len(drivers)),
        tuple(parents),
        tuple(number[node] for node in lattice if set(node) <= {0, count - 1} and node in number),
        tuple(
            tuple(float(axis[i]) for axis, i in zip(axes, node, strict=True)) for node in lattice if node not in number
        ),
    )


def joint_values(chain: ClosedChain, grid: PoseGrid, joint: Joint, rotations: Floats) -> Floats:
    """A joint's coordinate (n,) in every state of a grid; a cut pivot's is followed from state to state, so that it may
    pass half a turn. `rotations` as from `ClosedChain.placements`."""
    if not joint.cut:
        return np.array([chain.coordinate(state, joint.name) for state in grid.states])
    axes = chain.joint_axes(joint.name)
    base, moved = rotations[:, chain.body_index(joint.body0)], rotations[:, chain.body_index(joint.body1)]
    turned = np.einsum("nji,nj->ni", base, moved @ axes[1])
    angles = np.arctan2(turned @ axes[2], turned @ axes[1])
    for index, parent in enumerate(grid.parents):
        before = angles[parent] if parent >= 0 else 0.0
        angles[index] += _TURN * np.round((before - angles[index]) / _TURN)
    return np.asarray(angles, dtype=np.float64)
