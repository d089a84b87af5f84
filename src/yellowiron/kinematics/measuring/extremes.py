"""Extremes: where, over the strokes of several actuators together, a quantity is greatest or least.

Working ranges are such extremes: the lowest a tooth comes over boom, arm and bucket. A lattice of poses finds the
valleys, a local search their bottoms; both are deterministic.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from scipy.optimize import brentq, least_squares, minimize

from yellowiron.kinematics.measuring.quantities import Unmeasurable
from yellowiron.kinematics.solver.chain import ClosedChain, Component, State
from yellowiron.kinematics.solver.pose_grid import explore
from yellowiron.kinematics.tolerances import MET
from yellowiron.model.geometry import Floats

POINTS = {1: 33, 2: 21, 3: 13, 4: 7}
"""Lattice points per actuator, by how many there are."""
_TRIES = 5
"""Valleys of the lattice that are searched."""
_STEP = 1e-6
"""Share of a stroke by which a slope is taken."""
_FINEST = 1e-8
"""Share of a stroke at which the search without slopes ends."""
_KEPT = 64
"""States that are kept, as slopes and subjects ask for the same again."""
_WALKED = 1e-3
"""Metres by which a stop of a level cut may be missed."""
_STOPS = 12
"""Poses between the ends of a level cut at which the tooth is looked for."""


class StrokeBench(Protocol):
    """What is needed of a bench: `range` gives a driven coordinate's two ends, `driven` the joint an actuator drives,
    `value` a quantity in a state (SI)."""

    chain: ClosedChain

    def range(self, name: str) -> tuple[float, float]: ...  # noqa: D102

    def driven(self, name: str) -> str: ...  # noqa: D102

    def value(self, quantity: Mapping[str, Any], state: State) -> float: ...  # noqa: D102


class Strokes:
    """The poses of several actuators over their strokes, all others as in `start`. Coordinates are shares (n,) of the
    strokes, 0 to 1, from the shorter end of each driven slide."""

    def __init__(self, bench: StrokeBench, actuators: Sequence[str], start: State) -> None:
        """`Unmeasurable` where an actuator is not there or has no stroke."""
        self._bench = bench
        self._chain = bench.chain
        self.joints = tuple(bench.driven(name) for name in actuators)
        ends = np.array([sorted(bench.range(name)) for name in actuators]).reshape(-1, 2)
        self._low, self._span = ends[:, 0], ends[:, 1] - ends[:, 0]
        for name, width in zip(actuators, self._span, strict=True):
            if not width > 0.0:
                raise Unmeasurable(f"the actuator '{name}' has no stroke between its ends")
        count = POINTS.get(len(actuators), 5)
        self.axis = np.linspace(0.0, 1.0, count)
        self.states = self._lattice(start, count)
        self._last = next(state for state in self.states.ravel() if state is not None)
        self._known: dict[bytes, State] = {}
        self._values: dict[str, Floats] = {}

    def _lattice(self, start: State, count: int) -> np.ndarray:
        """States (count, …), None where the linkage locks. Loops that share no coordinate are solved apart."""
        groups = self._groups()
        found = [self._explored(component, own, start, count) for component, own in groups]
        lattice = np.empty((count,) * len(self.joints), dtype=object)
        for chosen in itertools.product(*(sorted(own) for own in found)):
            state, index = start, [0] * len(self.joints)
            for (component, own), states, node in zip(groups, found, chosen, strict=True):
                state = self._chain.combined(states[node], component, state)
                for k, step in zip(own, node, strict=True):
                    index[k] = step
            lattice[tuple(index)] = state
        if all(state is None for state in lattice.ravel()):
            raise Unmeasurable("the linkage locks")
        return lattice

    def _groups(self) -> list[tuple[Component, list[int]]]:
        """The actuators, by number, that each component of the loops couples; one that is in no loop has a component
        of its own."""
        groups: list[tuple[Component, list[int]]] = []
        left = list(range(len(self.joints)))
        for component in self._chain.components():
            own = [k for k in left if self.joints[k] in component.drivers]
            if own:
                groups.append((component, own))
                left = [k for k in left if k not in own]
        return groups + [(Component((self.joints[k],), (), ()), [k]) for k in left]

    def _explored(self, component: Component, own: list[int], start: State, count: int) -> dict[tuple[int, ...], State]:
        """Node of a component's own lattice → its state; without those where the linkage locks."""
        ranges = {self.joints[k]: (self._low[k], self._low[k] + self._span[k]) for k in own}
        grid = explore(self._chain, ranges, points=count)
        steps = np.rint((grid.values - self._low[own]) / self._span[own] * (count - 1)).astype(int)
        # The grid is solved from the drawn pose: what else drives these loops is brought to where it stands.
        others = {n: self._chain.coordinate(start, n) for n in component.drivers if n not in ranges}
        away = {name: at for name, at in others.items() if at != 0.0}
        solved = [self._chain.reach(away, start=state) if away else (state, 1.0) for state in grid.states]
        nodes = map(tuple, steps.tolist())
        return {node: state for node, (state, way) in zip(nodes, solved, strict=True) if way == 1.0}

    def on_lattice(self, quantity: Mapping[str, Any]) -> Floats:
        """A quantity on the lattice (count, …); NaN where the linkage locks."""
        key = repr(quantity)
        if key not in self._values:
            value = self._bench.value
            flat = [math.nan if state is None else value(quantity, state) for state in self.states.ravel()]
            self._values[key] = np.array(flat).reshape(self.states.shape)
        return self._values[key]

    def at(self, shares: Floats) -> State:
        """The state at these shares; past a dead point the last one before it."""
        key = np.asarray(shares, dtype=np.float64).tobytes()
        if key in self._known:
            return self._known[key]
        targets = self._low + np.clip(shares, 0.0, 1.0) * self._span
        wanted = dict(zip(self.joints, targets.tolist(), strict=True))
        self._last, _ = self._chain.reach(wanted, start=self._last)
        if len(self._known) >= _KEPT:
            self._known.clear()
        self._known[key] = self._last
        return self._last

    def shares(self, state: State) -> Floats:
        """A state's shares (n,)."""
        at = np.array([self._chain.coordinate(state, name) for name in self.joints])
        return np.asarray((at - self._low) / self._span, dtype=np.float64)

    def measured(self, quantity: Mapping[str, Any]) -> Callable[[Floats], float]:
        """A quantity as a function of the shares."""
        return lambda shares: self._bench.value(quantity, self.at(shares))

    def begin(self, index: Sequence[int]) -> Floats:
        """The shares of a lattice point, from which the next state is reached."""
        self._last = self.states[tuple(index)]
        return np.asarray(self.axis[np.array(index)], dtype=np.float64)


Subject = tuple[Mapping[str, Any], float]
"""A quantity and the value it must have."""


def extreme(
    strokes: Strokes, quantity: Mapping[str, Any], *, greatest: bool, subjects: Sequence[Subject] = ()
) -> tuple[State, float]:
    """The state, and the value in SI, where a quantity is greatest or least over the strokes while every subject has
    its value (within `MET`). `Unmeasurable` where no pose meets the subjects."""
    sign = -1.0 if greatest else 1.0
    found: list[tuple[float, Floats]] = []
    for start in _starts(strokes, sign * strokes.on_lattice(quantity), subjects):
        shares = strokes.begin(start)
        shares = _descend(strokes, quantity, sign, subjects, shares)
        if all(abs(_off(q, strokes.measured(q)(shares), value)) <= MET for q, value in subjects):
            if not subjects:
                shares = _feel(strokes, quantity, sign, shares)
            found.append((sign * strokes.measured(quantity)(shares), shares))
    if not found:
        raise Unmeasurable("no pose within the strokes meets what the extreme is subject to")
    # Equal valleys: the first, so that rounding does not choose.
    least = min(value for value, _ in found)
    value, shares = next(each for each in found if each[0] <= least + 1e-9)
    return strokes.at(shares), sign * value


def level_cut(
    strokes: Strokes, height: Mapping[str, Any], reach: Mapping[str, Any], length: float
) -> tuple[State, float]:
    """The farther end of the deepest level cut of that length (metres), and its height: the lowest height at which the
    reach can go through `length` without a gap. `Unmeasurable` where there is none."""
    bottom, lowest = extreme(strokes, height, greatest=False)
    ends = [strokes.shares(bottom), strokes.shares(bottom)]

    def spare(z: float) -> float:
        """The cut at this height, followed from the last one, less the length."""
        if z <= lowest:
            return -length
        for k, sign in enumerate((1.0, -1.0)):
            ends[k] = _descend(strokes, reach, sign, [(height, z)], ends[k])
        near, far = (strokes.measured(reach)(end) for end in ends)
        return far - near - length

    rise = 1e-2 * length
    while spare(lowest + rise) < 0.0:
        rise *= 2.0
        if rise > 8.0 * length:
            raise Unmeasurable(f"no level cut of {length:.3g} m can be made within the strokes")
    try:
        z = float(brentq(spare, lowest, lowest + rise, xtol=1e-7))
    except ValueError as error:
        # On a linkage that is put together wrongly the same height has another cut, depending on the way there.
        raise Unmeasurable("the level cut jumps from one linkage pose to another") from error
    state, far = extreme(strokes, reach, greatest=True, subjects=[(height, z)])
    _walk(strokes, height, reach, z, strokes.shares(state), np.linspace(far, far - length, _STOPS + 2)[1:-1])
    return state, z


def _walk(
    strokes: Strokes, height: Mapping[str, Any], reach: Mapping[str, Any], z: float, shares: Floats, stops: Floats
) -> None:
    """`Unmeasurable` unless every stop of the cut can be reached, from the one before or from a pose of the lattice."""
    high, out = strokes.on_lattice(height), strokes.on_lattice(reach)
    for stop in stops:

        def miss(at: Floats, stop: float = stop) -> list[float]:
            return [strokes.measured(height)(at) - z, strokes.measured(reach)(at) - stop]

        for start in _tries(strokes, np.hypot(high - z, out - stop), shares):
            inside = np.clip(start, 1e-6, 1.0 - 1e-6)
            shares = least_squares(miss, inside, bounds=(0.0, 1.0), diff_step=[_STEP] * len(inside)).x
            if max(abs(each) for each in miss(shares)) <= _WALKED:
                break
        else:
            raise Unmeasurable(f"the level cut has a gap at {stop:.3g} m")


def _tries(strokes: Strokes, away: Floats, shares: Floats) -> Iterator[Floats]:
    """These shares, then those of the lattice's nearest points."""
    yield shares
    for index in _best(np.isfinite(away), away):
        yield strokes.begin(index)


def _starts(strokes: Strokes, values: Floats, subjects: Sequence[Subject]) -> list[tuple[int, ...]]:
    """Lattice points to search from, the most promising first: the valleys of `values`; with subjects the points next
    to where these are met."""
    if not subjects:
        lowest = np.where(np.isnan(values), math.inf, values)
        valley = np.isfinite(lowest)
        for axis in range(values.ndim):
            for way in (-1, 1):
                valley &= lowest <= _shifted(lowest, axis, way, math.inf)
        return _best(valley, lowest)
    meets = np.ones(values.shape, dtype=bool)
    for quantity, value in subjects:
        off = _off(quantity, strokes.on_lattice(quantity), value)
        crossed = np.abs(off) <= MET
        for axis in range(values.ndim):
            for way in (-1, 1):
                beside = _shifted(off, axis, way, math.nan)
                # An angle that jumps by a turn crosses nothing.
                crossed |= (off * beside <= 0.0) & (np.abs(off - beside) < math.pi)
        meets &= crossed
    if not meets.any():
        total = sum(np.abs(_off(q, strokes.on_lattice(q), value)) for q, value in subjects)
        return _best(np.isfinite(total), np.asarray(total))
    return _best(meets & np.isfinite(values), values)


def _best(where: np.ndarray, values: Floats) -> list[tuple[int, ...]]:
    """The lowest of the marked points, none beside another."""
    marked = [tuple(int(i) for i in index) for index in np.argwhere(where)]
    picked: list[tuple[int, ...]] = []
    for index in sorted(marked, key=lambda each: (values[each], each)):
        if all(max(abs(a - b) for a, b in zip(index, other, strict=True)) > 1 for other in picked):
            picked.append(index)
            if len(picked) == _TRIES:
                break
    return picked


def _shifted(values: Floats, axis: int, way: int, beyond: float) -> Floats:
    """Each point's neighbour along an axis; `beyond` outside."""
    moved = np.roll(values, -way, axis=axis)
    edge = [slice(None)] * values.ndim
    edge[axis] = slice(-1, None) if way > 0 else slice(0, 1)
    moved[tuple(edge)] = beyond
    return moved


def _off(quantity: Mapping[str, Any], measured: Any, value: float) -> Any:
    """How far a quantity is from its value; an angle by no more than half a turn."""
    away = measured - value
    if quantity.get("kind") not in ("angle", "joint_angle"):
        return away
    return away - 2.0 * math.pi * np.round(away / (2.0 * math.pi))


def _descend(
    strokes: Strokes, quantity: Mapping[str, Any], sign: float, subjects: Sequence[Subject], shares: Floats
) -> Floats:
    """Sequential quadratic programming within the strokes."""
    measured = strokes.measured(quantity)

    def missed(at: Floats) -> Floats:
        return np.array([float(_off(q, strokes.measured(q)(at), value)) for q, value in subjects])

    options = {"ftol": 1e-11, "eps": _STEP, "maxiter": 60}
    constraints = [{"type": "eq", "fun": missed}] if subjects else []
    solve: Any = minimize  # its types know no plain arrays
    solved = solve(
        lambda at: sign * measured(at),
        shares,
        method="SLSQP",
        bounds=[(0.0, 1.0)] * len(shares),
        constraints=constraints,
        options=options,
    )
    return np.clip(np.asarray(solved.x, dtype=np.float64), 0.0, 1.0)


def _feel(strokes: Strokes, quantity: Mapping[str, Any], sign: float, shares: Floats) -> Floats:
    """One stroke after the other, both ways, by ever smaller steps: an extent has kinks that no slope sees."""
    measured = strokes.measured(quantity)
    best, step = sign * measured(shares), 0.02
    while step > _FINEST:
        better = False
        for k in range(len(shares)):
            for way in (-step, step):
                tried = shares.copy()
                tried[k] = min(max(tried[k] + way, 0.0), 1.0)
                value = sign * measured(tried)
                if value < best - 1e-12:
                    best, shares, better = value, tried, True
        step *= 1.0 if better else 0.5
    return shares
