"""Each engine alone against the engine as `simulate` uses it, on the same machine in the same motion.

Run from the repository's root: `python benchmarks/bench_simulate.py MACHINE.usda [ENGINE …]` (default: all installed).
Every cylinder swings by 10 mm, so that nothing falls asleep. "alone" is the time that the engine's own step function
takes; "loop" is the whole of a run: targets set, stepped, every coordinate and every body's pose read. The two take
turns of a few steps each, so that other work on the machine slows both alike. Of wall time the median turn counts,
since other work stretches some. Processor time is that of all turns.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "src"))

import numpy as np  # noqa: E402

from yellowiron.kinematics import ClosedChain  # noqa: E402
from yellowiron.simulation import rated_payload, simulate  # noqa: E402
from yellowiron.simulation.engine import Setup  # noqa: E402
from yellowiron.simulation.ground import standing_bodies  # noqa: E402
from yellowiron.simulation.registry import ENGINES, installed_engines, load_engine  # noqa: E402
from yellowiron.simulation.strokes.run import play  # noqa: E402
from yellowiron.usd import read_mechanism  # noqa: E402

SWINGS = 12
SECONDS = 0.5
"""Of machine time, a swing."""
TURNS = {"mujoco": 50, "newton": 50, "physx": 5}
"""Steps at a turn."""


def own_step(name: str, engine: Any) -> Callable[[], object]:
    """The engine's own step function, as its documentation has one call it."""
    if name == "mujoco":
        import mujoco

        return lambda: mujoco.mj_step(engine.model, engine.data)
    if name == "physx":
        return lambda: engine._physx.step_sync(engine._timestep)

    def newton() -> None:
        before, after = engine._states
        engine._solver.step(before, after, engine._control, None, engine._timestep)
        engine._states = [after, before]
        engine._rows.reverse()

    return newton


def timed(work: Callable[[], object]) -> np.ndarray:
    """Wall and processor time (2,) that it takes, seconds, with some of the clocks' own."""
    start, begun = time.perf_counter(), time.process_time()
    work()
    spent, passed = time.process_time() - begun, time.perf_counter() - start
    return np.array([passed, spent])


def times(name: str, file: Path, base: Any) -> tuple[np.ndarray, np.ndarray]:
    """Seconds a step, wall and processor time (2,), of the engine alone and of the loop."""
    mechanism, entry = read_mechanism(file), ENGINES[name]
    measured, standing = ClosedChain(mechanism).independent, standing_bodies(mechanism)
    engine = load_engine(name, Setup(file, mechanism, base, entry.timestep, measured, standing=standing))
    alone = own_step(name, engine)
    slides = [j.name for j in mechanism.joints if j.drive is not None and j.drive.kind == "position" and not j.cut]
    driven = [j.name for j in mechanism.joints if j.drive is not None and not j.cut]
    swing = 0.01 * np.sin(np.linspace(0.0, 2.0 * np.pi, round(SECONDS / entry.timestep)))
    rows = np.outer(np.tile(swing, SWINGS), [name in slides for name in driven])
    turns = [rows[start : start + TURNS[name]] for start in range(0, len(rows), TURNS[name])]
    clocks = np.median([timed(lambda: None) for _ in range(1000)], axis=0)
    alones, loops = [], []
    for turn, other in zip(turns[2::2], turns[3::2], strict=False):
        spent = np.zeros(2)
        for _ in engine.targets(driven, turn):
            spent += timed(alone) - clocks
        alones.append(spent / len(turn))
        loops.append(timed(lambda: play(engine, driven, other)) / len(other))  # noqa: B023
    engine.close()
    return _typical(np.array(alones)), _typical(np.array(loops))


def _typical(turns: np.ndarray) -> np.ndarray:
    return np.array([np.median(turns[:, 0]), np.mean(turns[:, 1])])


def main(file: Path, names: list[str]) -> None:
    for name in names or installed_engines():
        for base in ("fixed", "floating"):
            alone, loop = times(name, file, base)
            ratio = alone / loop
            print(
                f"{name:7s} {base:9s} alone {1.0 / alone[0]:8.0f} steps/s   loop {1.0 / loop[0]:8.0f} steps/s   "
                f"ratio {ratio[0]:.2f}, by processor time {ratio[1]:.2f}"
            )
    payload = rated_payload(read_mechanism(file)).mass
    start = time.perf_counter()
    result = simulate(file, engine="mujoco", base="fixed", payload_kg=payload)
    print(
        f"mujoco  fixed     {result.steps} steps in {time.perf_counter() - start:.1f} s with every pose compared: "
        f"{1e3 * result.pin_error:.3f} mm, branches kept: {result.branches_kept}"
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
