"""Wheels of a machine that steers on the spot: they roll, as open differentials and a driveline in neutral let them.

Held still instead, tyres drag over the ground, and a loaded loader's steering cylinder pushes against its own brakes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from yellowiron.kinematics import ClosedChain
from yellowiron.model.geometry import Floats
from yellowiron.simulation.commands import Motion, sampled
from yellowiron.simulation.driving.wheel import GroundWheel

_LEAST = 1e-6


def rolling(
    chain: ClosedChain,
    wheels: Sequence[GroundWheel],
    moves: Sequence[Motion],
    targets: Mapping[str, Floats],
    timestep: float,
) -> dict[str, Floats]:
    """By wheel joint, its speed (rad/s, one a step) at which no wheel slides while cylinders follow `targets`.

    The root moves so that no wheel's middle goes along its axle and all of them together go neither forward nor back
    (least squares, seen from above); each wheel then turns by what its middle goes forward. Empty where no cylinder
    moves a wheel.
    """
    paths = {m.joint: targets[m.joint] for m in moves if m.position and m.joint in targets}
    if not paths or not wheels:
        return {}
    count = max(len(values) for values in paths.values())
    steps = sampled(count, timestep)
    states = chain.sweep({joint: values[steps] for joint, values in paths.items()})
    if len(states) < 2:
        return {}
    # Hubs, the root at rest: (states, wheels, 4, 4).
    hubs = np.array([[chain.displacement(state, wheel.joint.body0) for wheel in wheels] for state in states])
    middles = np.einsum("swij,wj->swi", hubs, [[*wheel.middle, 1.0] for wheel in wheels])[..., :2]
    axes = np.einsum("swij,wj->swi", hubs[..., :3, :3], [wheel.axis for wheel in wheels])[..., :2]
    axes /= np.linalg.norm(axes, axis=2, keepdims=True)
    seconds = steps[: len(states)] * timestep
    drift = np.gradient(middles, seconds, axis=0)
    if float(np.abs(drift).max()) < _LEAST:
        return {}
    ahead = np.stack([axes[..., 1], -axes[..., 0]], axis=2)
    turning = np.stack([-middles[..., 1], middles[..., 0]], axis=2)
    speeds = np.array([axle_speeds(*rows) for rows in zip(drift, axes, ahead, turning, strict=True)])
    return {
        wheel.joint.name: np.interp(np.arange(count) * timestep, seconds, speeds[:, number] / wheel.radius)
        for number, wheel in enumerate(wheels)
    }


def axle_speeds(drift: Floats, axes: Floats, ahead: Floats, turning: Floats) -> Floats:
    """Forward speeds (wheels,) for drifts, axle directions, forward directions and what a turn of the root by 1 rad/s
    adds, each (wheels, 2)."""

    def along(directions: Floats) -> tuple[Floats, Floats]:
        root = np.column_stack([directions, np.einsum("wi,wi->w", directions, turning)])
        return root, np.einsum("wi,wi->w", directions, drift)

    (across, across_drift), (forward, forward_drift) = along(axes), along(ahead)
    rows = np.vstack([across, forward.sum(axis=0)])
    root, *_ = np.linalg.lstsq(rows, -np.append(across_drift, forward_drift.sum()), rcond=None)
    return np.asarray(forward @ root + forward_drift)
