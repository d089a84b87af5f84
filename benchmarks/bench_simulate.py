"""Each engine alone against the engine as `simulate` uses it, on the same machine in the same motion.

Run from the repository's root: `python benchmarks/bench_simulate.py MACHINE.usda [ENGINE …]` (default: all installed).
Every cylinder swings by 10 mm, so that nothing falls asleep. "alone" is the time that the engine's own step function
takes; "loop" is the whole of a step: targets set, stepped, every coordinate and every body's pose read. The two are
taken in turns, and the best of each, because the machine that runs this is shared.
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
from yellowiron.simulate import rated_payload, simulate  # noqa: E402
from yellowiron.simulate.engine import ENGINES, Setup, installed_engines, load_engine, standing_bodies  # noqa: E402
from yellowiron.usd import read_machine  # noqa: E402

ROUNDS = 6
SECONDS = 0.5
"""Of machine time in each round."""


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

    return newton


def rates(name: str, file: Path, base: Any) -> tuple[float, float]:
    """Steps a second: the engine alone, and the loop."""
    mechanism, entry = read_machine(file), ENGINES[name]
    measured, standing = ClosedChain(mechanism).independent, standing_bodies(mechanism)
    engine = load_engine(name, Setup(file, mechanism, base, entry.timestep, measured, standing=standing))
    alone, count = own_step(name, engine), round(SECONDS / entry.timestep)
    slides = [j.name for j in mechanism.joints if j.drive is not None and j.drive.kind == "position" and not j.cut]
    swing = 0.01 * np.sin(np.linspace(0.0, 2.0 * np.pi, count))
    best = [0.0, 0.0]
    for _ in range(ROUNDS):
        spent = 0.0
        for value in swing.tolist():
            engine.set_targets(dict.fromkeys(slides, value))
            start = time.perf_counter()
            alone()
            spent += time.perf_counter() - start
        begun = time.perf_counter()
        for value in swing.tolist():
            engine.set_targets(dict.fromkeys(slides, value))
            engine.step()
            engine.coordinates()
            engine.poses()
        best = [max(best[0], count / spent), max(best[1], count / (time.perf_counter() - begun))]
    engine.close()
    return best[0], best[1]


def main(file: Path, names: list[str]) -> None:
    for name in names or installed_engines():
        for base in ("fixed", "floating"):
            alone, loop = rates(name, file, base)
            print(f"{name:7s} {base:9s} alone {alone:8.0f} steps/s   loop {loop:8.0f} steps/s   {loop / alone:.2f}")
    payload = rated_payload(read_machine(file)).mass
    start = time.perf_counter()
    result = simulate(file, engine="mujoco", base="fixed", payload_kg=payload)
    print(
        f"mujoco  fixed     {result.steps} steps in {time.perf_counter() - start:.1f} s with every pose compared: "
        f"{1e3 * result.pin_error:.3f} mm, branches kept: {result.branches_kept}"
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
