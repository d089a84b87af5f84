"""Many machines at once in MuJoCo Warp, by the exported MJCF: loops intact, every world its own targets.

    yellowiron export out/excavator/excavator.usda --to mjcf --out out/mjcf
    python examples/learning/many_worlds_mujoco.py out/mjcf/excavator.xml [--worlds 256] [--seconds 0.5]

The machine is held by its root and its meshes are left out: nothing is there to touch. It needs `mujoco-warp` (the
extra `newton`); with a GPU, `--device cuda:0`.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import mujoco
import mujoco_warp
import numpy as np
import warp

SHARE, PERIOD = 0.3, 4.0
"""Of what is left to it a cylinder goes to either side of where it is drawn; seconds."""


def main() -> None:
    """Steps the worlds and prints how fast, and how well the loops hold."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("machine", type=Path)
    parser.add_argument("--worlds", type=int, default=256)
    parser.add_argument("--seconds", type=float, default=0.5)
    parser.add_argument("--device", default="cpu")
    given = parser.parse_args()
    warp.config.quiet = True
    model = held(given.machine)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    own = [n for n in range(model.nu) if model.actuator_gainprm[n, 0] > 0.0 and model.actuator_ctrllimited[n]]
    own = [n for n in own if model.jnt_type[model.actuator_trnid[n, 0]] == mujoco.mjtJoint.mjJNT_SLIDE]
    way = SHARE * np.minimum(-model.actuator_ctrlrange[own, 0], model.actuator_ctrlrange[own, 1])
    phase = np.arange(given.worlds)[:, None] * 2.0 * np.pi / given.worlds
    with warp.ScopedDevice(given.device):
        many, worlds = mujoco_warp.put_model(model), mujoco_warp.put_data(model, data, nworld=given.worlds)
        step, steps, spent, worst = float(model.opt.timestep), round(given.seconds / model.opt.timestep), 0.0, 0.0
        for number in range(steps):
            seconds = (number + 1) * step
            told = np.zeros((given.worlds, model.nu), dtype=np.float32)
            told[:, own] = way * min(1.0, seconds) * np.sin(2.0 * np.pi * seconds / PERIOD + phase)
            worlds.ctrl.assign(told)
            begun = time.perf_counter()
            mujoco_warp.step(many, worlds)
            warp.synchronize()
            spent += time.perf_counter() - begun if number else 0.0  # the first step compiles
            if number % 20 == 0 or number == steps - 1:
                worst = max(worst, gap(model, worlds.xpos.numpy(), worlds.xquat.numpy()))
    rate = given.worlds * (steps - 1) / spent
    print(f"{given.worlds} worlds, {steps} steps of {step:g} s on {given.device}: {rate:.0f} world-steps/s")
    print(f"pins apart by {1e3 * worst:.3g} mm at most, in any world")


def held(file: Path) -> mujoco.MjModel:
    """The machine without its free joint, its geoms and its sensors."""
    spec = mujoco.MjSpec.from_file(str(file))
    for things in (spec.keys, spec.sensors, spec.geoms, spec.excludes):
        for each in list(things):
            spec.delete(each)
    for joint in [each for each in spec.joints if each.type == mujoco.mjtJoint.mjJNT_FREE]:
        spec.delete(joint)
    return spec.compile()


def gap(model: mujoco.MjModel, positions: np.ndarray, quaternions: np.ndarray) -> float:
    """The widest gap (m) of any loop's pin in any world: (worlds, bodies, 3) and (worlds, bodies, 4), w first."""
    worst = 0.0
    for number in range(model.neq):
        if model.eq_type[number] != mujoco.mjtEq.mjEQ_CONNECT:
            continue
        ends = (model.eq_obj1id[number], model.eq_obj2id[number])
        one, other = (
            positions[:, body] + turned(quaternions[:, body], model.eq_data[number, 3 * side : 3 * side + 3])
            for side, body in enumerate(ends)
        )
        worst = max(worst, float(np.nan_to_num(np.linalg.norm(one - other, axis=1), nan=np.inf).max()))
    return worst


def turned(quaternions: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """A vector by quaternions (n, 4), w x y z."""
    w, axis = quaternions[:, :1], quaternions[:, 1:]
    across = 2.0 * np.cross(axis, vector)
    return vector + w * across + np.cross(axis, across)


if __name__ == "__main__":
    main()
