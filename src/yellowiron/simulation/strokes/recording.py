"""What is kept of a run to be looked at: thinned, the same for the same run."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.poses import Snapshot, Sweep, Trace
from yellowiron.simulation.commands import Motion, Phase

POINTS = 240
"""Times kept of a sweep."""
SNAPSHOTS = 5
"""Poses kept of a sweep, from low to high."""


def record(
    phase: Phase,
    moves: Sequence[Motion],
    mechanism: Mechanism,
    timestep: float,
    measured: Floats,
    rotations: Floats,
    origins: Floats,
    errors: tuple[Floats, Floats],
) -> Sweep:
    """A phase as a sweep. `measured` (n, moves) are coordinates in the order of `moves`; `rotations` (n, bodies, 3, 3)
    and `origins` (n, bodies, 3) the engine's poses; `errors`: pins (metres) and angles (radians), as many steps as were
    compared."""
    pins, angles = errors
    count = len(pins)
    ends = np.unique(np.linspace(0, count - 1, min(POINTS, count)).round().astype(np.int64)) if count else _NONE
    starts = np.concatenate([[0], ends[:-1] + 1]) if count else _NONE
    return Sweep(
        name=phase.name,
        times=np.asarray((ends + 1) * timestep, dtype=np.float64),
        pin_error=_worst(pins, starts),
        angle_error=_worst(angles, starts),
        traces=tuple(
            _trace(motion, phase.targets[motion.joint], measured[:, column], ends, timestep)
            for column, motion in enumerate(moves)
            if motion.joint in phase.targets
        ),
        snapshots=tuple(
            Snapshot((step + 1) * timestep, share, poses_of(mechanism, rotations[step], origins[step]))
            for step, share in _steps(phase, moves, measured[:count])
        ),
    )


_NONE = np.zeros(0, dtype=np.int64)


def _worst(values: Floats, starts: NDArray[np.int64]) -> Floats:
    return np.maximum.reduceat(values, starts) if len(starts) else np.zeros(0)


def _trace(motion: Motion, targets: Floats, values: Floats, ends: NDArray[np.int64], timestep: float) -> Trace:
    if motion.position:
        return Trace(motion.joint, "position", share_of(motion, targets[ends]), share_of(motion, values[ends]))
    # A speed between two kept times, against the mean target between them.
    begins = np.concatenate([[0], ends[:-1]]) if len(ends) else ends
    gone = np.maximum(ends - begins, 1)
    sums = np.concatenate([[0.0], np.cumsum(targets)])
    wanted = (sums[ends + 1] - sums[begins + 1]) / gone
    return Trace(motion.joint, "velocity", wanted, (values[ends] - values[begins]) / (gone * timestep))


def share_of(motion: Motion, values: Floats) -> Floats:
    """Of the whole stroke; the ends that it is sent to lie inside by equal shares."""
    middle = 0.5 * (motion.low + motion.high)
    return 0.5 + (values - middle) / motion.stroke if motion.stroke else np.zeros(len(values))


def _steps(phase: Phase, moves: Sequence[Motion], measured: Floats) -> list[tuple[int, float | None]]:
    """The steps to keep of the leg from low to high: evenly over the way, of motors evenly in time."""
    if len(phase.holds) < 2 or phase.holds[1] >= len(measured):
        return []
    first, last = phase.holds[0], phase.holds[1]
    shares = [
        share_of(motion, measured[first : last + 1, column])
        for column, motion in enumerate(moves)
        if motion.joint in phase.targets and motion.position
    ]
    if not shares:
        return [(int(step), None) for step in np.linspace(first, last, SNAPSHOTS).round()]
    way = np.mean(shares, axis=0)
    wanted = np.linspace(way[0], way[-1], SNAPSHOTS)
    return [(first + at, float(way[at])) for at in (int(np.abs(way - share).argmin()) for share in wanted)]


def poses_of(mechanism: Mechanism, rotations: Floats, origins: Floats) -> dict[str, Floats]:
    """Body → (4, 4) displacement from the drawn pose, of rotations (bodies, 3, 3) and origins (bodies, 3)."""
    poses = {}
    for index, body in enumerate(mechanism.bodies):
        pose = np.eye(4)
        pose[:3, :3] = rotations[index]
        pose[:3, 3] = origins[index] - rotations[index] @ np.asarray(body.origin)
        poses[body.name] = pose
    return poses
