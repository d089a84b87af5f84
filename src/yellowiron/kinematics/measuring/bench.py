"""The measuring bench: moves actuators as a measurement's steps say, within their strokes."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from scipy.optimize import brentq, least_squares

from yellowiron.kinematics.measuring.extremes import Strokes, extreme, level_cut
from yellowiron.kinematics.measuring.quantities import Hulls, Posed, Unmeasurable, evaluate, wheels
from yellowiron.kinematics.measuring.sheet import specified
from yellowiron.kinematics.solver.chain import ClosedChain, KinematicsError, State
from yellowiron.kinematics.solver.pose_grid import PoseGrid, explore
from yellowiron.kinematics.tolerances import REACHED
from yellowiron.model.mechanism import Actuator, Mechanism
from yellowiron.support.units import parse_quantity

_AT_END = 1e-9
"""Metres or radians by which a value may lie beyond the end of a stroke."""
_SAMPLES = 17
"""Poses over a stroke between which a root is looked for."""


class Bench:
    """Poses and measures one mechanism. `ranges` (driven joint → lower, upper) replaces its limits, for calibration."""

    def __init__(
        self,
        mechanism: Mechanism,
        *,
        chain: ClosedChain | None = None,
        ranges: Mapping[str, tuple[float, float]] | None = None,
    ) -> None:
        self.chain = chain if chain is not None else ClosedChain(mechanism)
        self.mechanism = mechanism
        self._actuators = {actuator.name: actuator for actuator in mechanism.actuators}
        self._ranges = dict(ranges or {})
        self._joints = {joint.name: joint for joint in mechanism.joints}
        self._cylinders = {cylinder.name: cylinder for cylinder in mechanism.cylinders}
        self._wheels = wheels(mechanism)
        self._hulls = Hulls(self.chain)
        self._grids: dict[tuple[str, ...], PoseGrid] = {}
        self._strokes: dict[tuple[tuple[str, ...], bytes], Strokes] = {}
        self._states: dict[str, State] = {}
        self._straight: State | None = None

    # ---- coordinates ------------------------------------------------------------------------------------------------
    def actuator(self, name: str) -> Actuator:
        """The actuator of that name; `Unmeasurable` if the machine has none."""
        if name not in self._actuators or not self._actuators[name].joints:
            raise Unmeasurable(f"the machine has no actuator '{name}'")
        return self._actuators[name]

    def driven(self, name: str) -> str:
        """The joint that an actuator drives."""
        return self.actuator(name).joints[0].joint

    def range(self, name: str) -> tuple[float, float]:
        """An actuator's driven joint coordinate at its `min` and `max`: the ends in the actuator's own sense."""
        entry = self.actuator(name).joints[0]
        joint = self._joints[entry.joint]
        lower, upper = self._ranges.get(entry.joint, (joint.lower, joint.upper))
        if lower is None or upper is None:
            raise Unmeasurable(f"the actuator '{name}' has no end of stroke")
        return (lower, upper) if entry.sign > 0 else (upper, lower)

    def straight(self, joint: str) -> float:
        """A joint's coordinate in the straight machine: where the cylinders of every antagonistic pair are equally long
        (a drawing may show the machine steered)."""
        if self._straight is None:
            state = self.chain.drawn
            for actuator in self.mechanism.actuators:
                if len({entry.sign for entry in actuator.joints}) == 2 and len(actuator.cylinders) == 2:
                    state = self._straighten(actuator, state)
            self._straight = state
        return self.chain.coordinate(self._straight, joint)

    def _straighten(self, actuator: Actuator, start: State) -> State:
        driven = actuator.joints[0].joint
        pair = [self._cylinders[name] for name in actuator.cylinders]

        def difference(state: State) -> float:
            one, two = (c.drawn_length + self.chain.coordinate(state, c.slide) for c in pair)
            return one - two

        if abs(difference(start)) <= 1e-12:
            return start
        return self._root(driven, self.range(actuator.name), start, difference, 0.0, f"'{actuator.name}' straight")

    # ---- steps ------------------------------------------------------------------------------------------------------
    def pose(self, steps: Sequence[Mapping[str, Any]]) -> State:
        """The state after steps, from the drawn pose; `Unmeasurable` where one cannot be made."""
        state, key = self.chain.drawn, ""
        for step in steps:
            key += repr(step)
            if key not in self._states:
                self._states[key] = self._step(step, state)
            state = self._states[key]
        return state

    def value(self, quantity: Mapping[str, Any], state: State) -> float:
        """A quantity in a state, SI."""

        def after(steps: Sequence[Mapping[str, Any]]) -> State:
            moved = state
            for step in steps:
                moved = self._step(step, moved)
            return moved

        posed = Posed(self.chain, self.mechanism, state, self.straight, self._wheels, self._hulls, after)
        return evaluate(quantity, posed)

    def _step(self, step: Mapping[str, Any], state: State) -> State:
        if "set" in step:
            for name, where in step["set"].items():
                state = self._set(name, where, state)
        if "solve" in step:
            state = self._solve(step["solve"], state)
        if "extreme" in step:
            state = self._extreme(step["extreme"], state)
        if "level_cut" in step:
            state = self._level_cut(step["level_cut"], state)
        return state

    def _set(self, name: str, where: object, state: State) -> State:
        actuator = self.actuator(name)
        driven = actuator.joints[0].joint
        if where == "straight":
            if len(actuator.cylinders) != 2:
                raise Unmeasurable(f"the actuator '{name}' has no pair of cylinders to be straight by")
            return self._straighten(actuator, state)
        if where == "drawn":
            target = 0.0
        elif isinstance(where, str) and where not in ("min", "max"):
            target = actuator.joints[0].sign * _number(where)
        else:
            low, high = self.range(name)
            share = {"min": 0.0, "max": 1.0}.get(str(where))
            target = low + (high - low) * (share if share is not None else float(str(where)))
        try:
            return self.chain.solve({driven: target}, start=state)
        except KinematicsError as error:
            raise Unmeasurable(f"the linkage locks on the way to {name} {where}") from error

    def _solve(self, conditions: Sequence[Mapping[str, Any]], state: State) -> State:
        names = list(dict.fromkeys(str(condition["actuator"]) for condition in conditions))
        if len(names) != len(conditions):
            raise Unmeasurable("a solve step needs one condition for each of its actuators")
        conditions = [self._known(condition) for condition in conditions]
        words = " and ".join(_words(condition) for condition in conditions)
        if len(names) == 1:
            (condition,) = conditions
            return self._root(
                self.driven(names[0]),
                self.range(names[0]),
                state,
                lambda each: self.value(condition["quantity"], each),
                _number(condition["value"]),
                words,
                condition["quantity"],
            )
        return self._roots(names, conditions, state, words)

    def _known(self, condition: Mapping[str, Any]) -> Mapping[str, Any]:
        """A condition with the value that a sheet gives for its specification, times its factor, where it does."""
        value = specified(self.mechanism, str(condition.get("specification", "")))[0]
        return condition if value is None else {**condition, "value": float(condition.get("factor", 1)) * value}

    def _extreme(self, wanted: Mapping[str, Any], state: State) -> State:
        subjects = [(each["quantity"], _number(each["value"])) for each in wanted.get("subject", ())]
        strokes = self._over(wanted.get("actuators") or [wanted["actuator"]], state)
        return extreme(strokes, wanted["quantity"], greatest=wanted.get("of", "max") == "max", subjects=subjects)[0]

    def _level_cut(self, wanted: Mapping[str, Any], state: State) -> State:
        entry = wanted["length"]
        length = specified(self.mechanism, str(entry.get("specification", "")))[0] or _number(entry["value"])
        return level_cut(self._over(wanted["actuators"], state), wanted["height"], wanted["reach"], length)[0]

    def _over(self, actuators: Sequence[str], state: State) -> Strokes:
        """The poses over these actuators' strokes, the others as in `state`."""
        key = (tuple(actuators), state.position.tobytes())
        if key not in self._strokes:
            self._strokes[key] = Strokes(self, actuators, state)
        return self._strokes[key]

    def _root(
        self,
        driven: str,
        ends: tuple[float, float],
        start: State,
        measured: Any,
        value: float,
        words: str,
        quantity: Mapping[str, Any] | None = None,
    ) -> State:
        """One coordinate by bracketing over its range: the solution nearest to where it stands."""
        here = min(max(self.chain.coordinate(start, driven), min(ends)), max(ends))
        path = np.linspace(min(ends), max(ends), _SAMPLES)
        ahead = self.chain.sweep({driven: [here, *path[path > here]]}, start=start)
        behind = self.chain.sweep({driven: path[path < here][::-1]}, start=ahead[0] if ahead else start)
        states = [*behind[::-1], *ahead]
        errors = [measured(state) - value for state in states]
        spans = [k for k in range(len(states) - 1) if errors[k] * errors[k + 1] <= 0.0 and abs(errors[k]) < math.inf]
        # A jump by a full turn is no root.
        spans = [k for k in spans if abs(errors[k] - errors[k + 1]) < math.pi or quantity is None]
        nearest = min(range(len(states)), key=lambda k: abs(errors[k]), default=None)
        if not spans and nearest is not None and abs(errors[nearest]) < _AT_END:
            return states[nearest]  # the value is that of an end of the stroke, and round-off missed it
        if not spans:
            found = sorted(error + value for error in errors)
            ranged = f"within the strokes it goes from {_shown(found[0], quantity)} to {_shown(found[-1], quantity)}"
            raise Unmeasurable(f"{words} cannot be reached: {ranged}" if found else f"{words} cannot be reached")
        at = [self.chain.coordinate(state, driven) for state in states]
        k = min(spans, key=lambda span: abs(0.5 * (at[span] + at[span + 1]) - here))

        def error(coordinate: float) -> float:
            return float(measured(self.chain.solve({driven: coordinate}, start=states[k])) - value)

        try:
            root = float(brentq(error, at[k], at[k + 1], xtol=1e-14, rtol=1e-14))
            return self.chain.solve({driven: root}, start=states[k])
        except KinematicsError as locked:
            raise Unmeasurable(f"{words} cannot be reached: the linkage locks") from locked

    def _roots(self, names: list[str], conditions: Sequence[Mapping[str, Any]], start: State, words: str) -> State:
        """Several coordinates at once: least squares within the strokes, from the best of a lattice of poses."""
        driven = [self.driven(name) for name in names]
        low, high = np.array([sorted(self.range(name)) for name in names]).T
        for name, width in zip(names, high - low, strict=True):
            if not width > 0.0:
                raise Unmeasurable(f"{words} cannot be reached: the actuator '{name}' has no stroke between its ends")

        def errors(state: State) -> np.ndarray:
            return np.array([self.value(c["quantity"], state) - _number(c["value"]) for c in conditions])

        # The lattice is solved from the drawn pose; the other actuators are brought to where they stand afterwards.
        key = tuple(driven)
        if key not in self._grids:
            ranges = dict(zip(driven, zip(low.tolist(), high.tolist(), strict=True), strict=True))
            self._grids[key] = explore(self.chain, ranges, points=5)
        others = {
            name: self.chain.coordinate(start, name)
            for name in self.chain.independent
            if name not in driven and self.chain.coordinate(start, name) != 0.0
        }
        starts = [self.chain.reach(others, start=state) for state in self._grids[key].states]
        states = [state for state, fraction in starts if fraction == 1.0]
        if not states:
            raise Unmeasurable(f"{words} cannot be reached: the linkage locks")
        best = min(states, key=lambda state: float(np.sum(errors(state) ** 2)))
        at = np.array([self.chain.coordinate(best, name) for name in driven])
        last = best

        def residual(x: np.ndarray) -> np.ndarray:
            nonlocal last
            state, fraction = self.chain.reach(dict(zip(driven, x.tolist(), strict=True)), start=best)
            last = state
            return errors(state) + (1.0 - fraction) * 10.0

        span = np.maximum(high - low, 1e-6)
        inside = np.clip(at, low + 1e-9 * span, high - 1e-9 * span)
        solved = least_squares(
            residual, inside, bounds=(low, high), x_scale=span, method="dogbox", xtol=1e-15, ftol=1e-15, gtol=1e-15
        )
        worst = float(np.max(np.abs(residual(solved.x))))
        if worst > REACHED:
            raise Unmeasurable(
                f"{words} cannot be reached together within the strokes (nearest: {1e3 * worst:.3g}e-3 off)"
            )
        return last


def _number(value: object) -> float:
    """A condition's value in SI: a number already is; a text carries its unit."""
    return parse_quantity(value)[0] if isinstance(value, str) else float(value)  # type: ignore[arg-type]


def _words(condition: Mapping[str, Any]) -> str:
    quantity = condition["quantity"]
    return f"{quantity.get('kind')} {_shown(_number(condition['value']), quantity)} of {_subject(quantity)}"


def _subject(quantity: Mapping[str, Any]) -> str:
    named = [quantity[key] for key in ("site", "joint", "joints", "bodies") if key in quantity]
    texts = [text for each in named for text in ([each] if isinstance(each, str) else each)]
    return ", ".join(texts) or "the machine"


def _shown(value: float, quantity: Mapping[str, Any] | None) -> str:
    angular = quantity is not None and ("angle" in str(quantity.get("kind")) or quantity.get("kind") == "joint_range")
    return f"{math.degrees(value):.2f}°" if angular else f"{1e3 * value:.1f} mm"
