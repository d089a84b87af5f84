"""A machine at work in an engine, to be looked at: each actuator through its stroke, at a few moments of it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.poses import Snapshot
from yellowiron.simulation.commands import Motion, Phase, motions, phases
from yellowiron.simulation.engine import Engine, Setup
from yellowiron.simulation.ground import standing_bodies
from yellowiron.simulation.loads import carried, paces
from yellowiron.simulation.registry import find_engine, import_engine, load_engine
from yellowiron.simulation.strokes.comparison import Comparison
from yellowiron.simulation.strokes.held import held_machine
from yellowiron.simulation.strokes.recording import poses_of, share_of
from yellowiron.simulation.strokes.run import play


def watched(
    usd_path: str | Path,
    engine: str,
    actuators: Sequence[str],
    shares: Sequence[float],
    progress: Callable[[str], None] = lambda words: None,
) -> dict[str, tuple[Snapshot, ...]]:
    """Actuator → the machine as it is driven from its drawn pose to the stroke's low end, to its high one, and back,
    in the air, on the engine's own step, at these `shares` (0 … 1, rising) of each of the three ways.

    `YellowironError` for an engine or an actuator that is not there, and where the run breaks down (the poses are none
    that the measured strokes allow).
    """
    import_engine(engine)
    timestep = find_engine(engine).timestep
    mechanism, changed = held_machine(usd_path, "fixed")
    moves = tuple(move for move in motions(mechanism, actuators) if move.position)
    comparison = Comparison(mechanism)
    setup = Setup(
        usd_path=Path(usd_path), mechanism=mechanism, base="fixed", timestep=timestep, measured=comparison.measured,
        heavier=changed, standing=standing_bodies(mechanism),
    )  # fmt: skip
    seen: dict[str, tuple[Snapshot, ...]] = {}
    loaded = load_engine(engine, setup)
    try:
        for phase in phases(moves, timestep, on_ground=False, paces=paces(comparison.chain, moves)):
            if phase.holds and phase.name not in actuators:
                break  # all together, the last one
            progress(f"Working in {engine}: {phase.name}")
            snapshots = _played(loaded, comparison, phase, moves, timestep, shares)
            seen |= {phase.name: snapshots} if phase.holds else {}
    finally:
        loaded.close()
    return seen


def _played(
    engine: Engine,
    comparison: Comparison,
    phase: Phase,
    moves: Sequence[Motion],
    timestep: float,
    shares: Sequence[float],
) -> tuple[Snapshot, ...]:
    told = carried(comparison.chain, moves, phase.targets, timestep)
    joints, rows = tuple(told), np.column_stack(list(told.values()))
    snapshots: list[Snapshot] = []
    done = 0
    for step in (*_steps(phase, shares).tolist(), phase.steps - 1):
        if step < done:
            continue
        read = play(engine, joints, rows[done : step + 1])
        done = step + 1
        coordinates, rotations, origins = (values[-1:] for values in read)
        if not comparison.compare(coordinates, rotations, origins).followed:
            raise YellowironError(
                f"The machine breaks down in motion, after {done * timestep:.1f} s",
                where=phase.name,
                hint="Try a smaller time step, and check gains, masses and limits.",
            )
        share = None
        if (move := next((m for m in moves if m.joint in phase.targets), None)) is not None:
            share = float(share_of(move, coordinates[:, comparison.measured.index(move.joint)])[0])
        poses = poses_of(comparison.chain.mechanism, rotations[0], origins[0])
        snapshots.append(Snapshot(done * timestep, share, poses))
    return tuple(snapshots[: 3 * len(shares)])


def _steps(phase: Phase, shares: Sequence[float]) -> NDArray[np.int64]:
    """The steps at which what moves first is at these shares of each way; of a phase of no way, none."""
    if not phase.holds:
        return np.zeros(0, dtype=np.int64)
    target: Floats = next(iter(phase.targets.values()))
    steps, first = [], 0
    for hold in phase.holds:
        way = np.abs(np.diff(target[first : hold + 1], prepend=target[first - 1] if first else 0.0)).cumsum()
        steps.append(first + np.searchsorted(way, np.asarray(shares) * way[-1] - 1e-12))
        first = hold + 1
    return np.concatenate(steps).astype(np.int64)
