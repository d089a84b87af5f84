"""MuJoCo alone against MuJoCo as `simulate` steps it, and the whole run with every pose compared.

Run from the repository's root: `python benchmarks/bench_simulate.py MACHINE.usda [STEPS]`. Both step the same compiled
machine; "read" sets every target and reads every pose and coordinate at every step, as a run does.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "src"))

import mujoco  # noqa: E402

from yellowiron.kinematics import ClosedChain  # noqa: E402
from yellowiron.simulate import rated_payload, simulate  # noqa: E402
from yellowiron.simulate.engine import Setup, standing_bodies  # noqa: E402
from yellowiron.simulate.mujoco import load  # noqa: E402
from yellowiron.usd import read_machine  # noqa: E402

ROUNDS = 5


def rate(act: Callable[[], object], steps: int) -> float:
    """Calls a second."""
    start = time.perf_counter()
    for _ in range(steps):
        act()
    return steps / (time.perf_counter() - start)


def main(file: Path, steps: int) -> None:
    mechanism = read_machine(file)
    measured = ClosedChain(mechanism).independent
    for base in ("fixed", "floating"):
        engine = load(Setup(file, mechanism, base, 0.001, measured, standing=standing_bodies(mechanism)))
        data = mujoco.MjData(engine.model)
        mujoco.mj_resetDataKeyframe(engine.model, data, 0)
        targets = {j.name: 0.0 for j in mechanism.joints if j.drive is not None and not j.cut}

        def alone(model: mujoco.MjModel = engine.model, data: mujoco.MjData = data) -> None:
            mujoco.mj_step(model, data)

        def read(engine: object = engine, targets: dict[str, float] = targets) -> None:
            engine.set_targets(targets)
            engine.step()
            engine.coordinates()
            engine.poses()

        # In turns, and the best of each: the machine that runs this is shared.
        rounds = [(rate(alone, steps), rate(engine.step, steps), rate(read, steps)) for _ in range(ROUNDS)]
        bare, stepped, whole = (max(column) for column in zip(*rounds, strict=True))
        print(
            f"{base:9s} MuJoCo alone {bare:8.0f} steps/s   stepped {stepped:8.0f} ({stepped / bare:.2f})   "
            f"read {whole:8.0f} ({whole / bare:.2f})"
        )
        engine.close()
        start = time.perf_counter()
        result = simulate(file, engine="mujoco", base=base, payload_kg=rated_payload(mechanism).mass)
        wall = time.perf_counter() - start
        print(
            f"{base:9s} {result.steps} steps in {wall:.1f} s with every pose compared: "
            f"{1e3 * result.pin_error:.3f} mm, branches kept: {result.branches_kept}"
        )


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 5000)
