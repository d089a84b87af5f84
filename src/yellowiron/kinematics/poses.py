"""Pose tables: the loops solved once on a grid over the strokes, for pages and tools that have no solver."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping

import numpy as np

from yellowiron.kinematics.measuring.bench import Bench
from yellowiron.kinematics.measuring.quantities import Unmeasurable
from yellowiron.kinematics.solver.chain import ClosedChain, Component, KinematicsError, State
from yellowiron.kinematics.solver.pose_grid import explore
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Joint, Mechanism
from yellowiron.model.poses import PoseTable, PoseTables

POINTS = {1: 41, 2: 21, 3: 9, 4: 6}
"""Grid points per driver, by how many drivers a group of loops has; groups with more get no table and stay as drawn."""


def pose_tables(mechanism: Mechanism, *, chain: ClosedChain | None = None) -> PoseTables:
    """The coordinates of all joints that follow from the loops, over the strokes of the joints that drive them, and to
    the drawn pose where that is beyond one.

    Groups whose drivers have no limits, or that have more than four drivers, get no table. Raises `MechanismError`
    where the joints are no tree with cuts.
    """
    bench = Bench(mechanism, chain=chain)
    chain = bench.chain
    joints = {joint.name: joint for joint in mechanism.joints}
    components = chain.components()
    tables = [_table(chain, component, joints) for component in components]
    straight: dict[str, float] = {}
    for component in components:
        for name in (*component.dependent, *component.cuts):
            if joints[name].type == "revolute":
                try:
                    straight[name] = bench.straight(name)
                except Unmeasurable:
                    straight[name] = 0.0
    return PoseTables(chain.independent, tuple(table for table in tables if table is not None), straight)


def _table(chain: ClosedChain, component: Component, joints: Mapping[str, Joint]) -> PoseTable | None:
    ranges = {}
    for name in component.drivers:
        lower, upper = joints[name].lower, joints[name].upper
        if lower is None or upper is None or not lower < upper:
            return None
        # A drawing may stand a little beyond a stop: where it stands is on the table too.
        ranges[name] = (min(lower, 0.0), max(upper, 0.0))
    if len(ranges) not in POINTS:
        return None
    count = POINTS[len(ranges)]
    grid = explore(chain, ranges, points=count)
    if not grid.states:
        return None
    axes = tuple(np.linspace(low, high, count) for low, high in ranges.values())
    rows = np.array([_row(chain, state, component, joints) for state in grid.states])
    # Distances in steps of the grid; of equally near states the first found is taken.
    steps = np.array([axis[1] - axis[0] for axis in axes])
    lattice = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))
    apart = np.linalg.norm((lattice[:, None, :] - grid.values[None, :, :]) / steps, axis=2)
    values = rows[apart.argmin(axis=1)].reshape(*(count for _ in axes), -1)
    return PoseTable(component.drivers, axes, component.dependent, values, len(grid.unreachable))


def _row(chain: ClosedChain, state: State, component: Component, joints: Mapping[str, Joint]) -> Floats:
    columns: list[float] = []
    for name in component.dependent:
        if joints[name].type == "spherical":
            columns += chain.quaternion(state, name).tolist()
        else:
            columns.append(chain.coordinate(state, name))
    return np.array(columns)


def stroke_poses(
    mechanism: Mechanism, *, steps: int = 3, most: int = 100
) -> Iterator[tuple[Mapping[str, float], Mapping[str, Floats]]]:
    """Poses over the full strokes, the drawn one first: the driven joints' coordinates (m or rad from the drawn pose),
    and for each body its displacement (4, 4) from the drawn pose, in the machine frame.

    A lattice of `steps` places from end to end of every stroke; where that is more than `most` poses, so many drawn of
    it by a fixed seed, both ends of all among them. Joints without ends go on by a tenth of a radian or metre a pose.
    What a linkage cannot do together is left out. Errors as in `ClosedChain`.
    """
    chain = ClosedChain(mechanism)
    joints = {joint.name: joint for joint in mechanism.joints}
    ends = {n: (joints[n].lower, joints[n].upper) for n in chain.independent}
    axes = {n: np.linspace(low, high, steps) for n, (low, high) in ends.items() if low is not None and high is not None}
    rows = itertools.product(*axes.values()) if steps ** len(axes) <= most else _drawn_of(list(axes.values()), most)
    yield {}, chain.pose(chain.solve({}))
    for number, row in enumerate(rows, 1):
        strokes = dict.fromkeys(chain.independent, 0.1 * number) | dict(zip(axes, map(float, row), strict=True))
        try:
            state = chain.solve(strokes)
        except KinematicsError:
            continue
        yield strokes, chain.pose(state)


def _drawn_of(axes: list[Floats], count: int) -> Iterator[tuple[float, ...]]:
    """Both ends of all, then places drawn by a fixed seed."""
    chosen = np.random.default_rng(22)
    yield tuple(float(axis[0]) for axis in axes)
    yield tuple(float(axis[-1]) for axis in axes)
    for _ in range(count - 2):
        yield tuple(float(chosen.choice(axis)) for axis in axes)
