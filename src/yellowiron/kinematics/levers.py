"""Stroke ↔ angle ↔ lever arm: a cut pivot is no coordinate in an engine, but its angle follows from the stroke."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from yellowiron.kinematics.measuring.bench import Bench
from yellowiron.kinematics.measuring.quantities import Unmeasurable
from yellowiron.kinematics.solver.chain import ClosedChain, State
from yellowiron.model.mechanism import Mechanism

_STILL = 1e-9
"""Radians a metre of stroke below which a pivot stands still."""


def lever_table(
    mechanism: Mechanism, actuator: str, *, n: int = 21, chain: ClosedChain | None = None
) -> dict[str, Any]:
    """The way from an actuator's stroke to the angles it makes, at `n` strokes from its `min` to its `max`, the other
    actuators as drawn.

    `joint`: the driven slide; `stroke` its coordinate in metres from the drawn pose; `extension` the cylinder's, metres
    from closed; `pivots`: joint name → `angle`, radians from the drawn pose, and `lever`, metres: stroke speed by
    angular speed, so that torque = force × lever (None where the pivot stands still). Pivots that do not turn and the
    cylinders' own pins are left out. Empty for a motor, an actuator that is not there and one without ends of stroke;
    shorter than `n` where the linkage locks.
    """
    bench = Bench(mechanism, chain=chain)
    try:
        entry = bench.actuator(actuator).joints[0]
        low, high = bench.range(actuator)
    except Unmeasurable:
        return {}
    chain = bench.chain
    reached, _ = chain.reach({entry.joint: low})
    path = np.linspace(chain.coordinate(reached, entry.joint), high, n)
    states = chain.sweep({entry.joint: path}, start=reached)
    strokes = [float(value) for value in path[: len(states)]]
    extension = next((c.extension for c in mechanism.cylinders if c.slide == entry.joint), None)
    return {
        "joint": entry.joint,
        "stroke": strokes,
        "extension": [stroke + extension for stroke in strokes] if extension is not None else [],
        "pivots": _pivots(mechanism, chain, entry.joint, states),
    }


def _pivots(mechanism: Mechanism, chain: ClosedChain, slide: str, states: Sequence[State]) -> dict[str, Any]:
    """Angles and lever arms of the pivots that turn with a slide, in those states."""
    component = next((c for c in chain.components() if slide in c.drivers), None)
    pins = {name for cylinder in mechanism.cylinders for name in cylinder.pins}
    joints = {joint.name: joint for joint in mechanism.joints}
    tangents = [chain.tangent(state, slide) for state in states]
    pivots: dict[str, Any] = {}
    for name in (*component.dependent, *component.cuts) if component else ():
        if joints[name].type != "revolute" or name in pins:
            continue
        rates = [chain.rate(state, name, tangent) for state, tangent in zip(states, tangents, strict=True)]
        if max(map(abs, rates), default=0.0) <= _STILL:
            continue
        angles = np.unwrap([0.0, *(chain.coordinate(state, name) for state in states)])[1:]
        pivots[name] = {
            "angle": [float(angle) for angle in angles],
            "lever": [1.0 / rate if abs(rate) > _STILL else None for rate in rates],
        }
    return pivots
