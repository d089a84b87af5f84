"""Variants that `yellowiron vary --to mjcf` wrote, in MuJoCo, on all cores: `python in_mujoco.py FOLDER`.

Every variant's boom is told to go all the way up at its rated speed; the script says how long that takes each of them
and how much force it needs, beside what was sampled.
"""

from __future__ import annotations

import argparse
import csv
import multiprocessing
import os
from pathlib import Path

import mujoco
import numpy as np

from yellowiron.fleet.variants import spec_of


def raised(file: Path) -> tuple[str, float, float, float]:
    """A variant's name and mass (kg), the seconds its boom takes to the end of its stroke, and the largest force, N."""
    spec = spec_of(file)
    # Held by its base: this is about levers, not about ground.
    for joint in [joint for joint in spec.joints if joint.type == mujoco.mjtJoint.mjJNT_FREE]:
        spec.delete(joint)
    for key in list(spec.keys):
        spec.delete(key)
    model = spec.compile()
    data = mujoco.MjData(model)
    boom = model.actuator("boom")
    low, high = model.actuator_ctrlrange[boom.id]
    joint = model.actuator_trnid[boom.id, 0]
    place, drive = model.jnt_qposadr[joint], model.jnt_dofadr[joint]
    most, rate = 0.0, 0.12
    while data.time < 30.0 and data.qpos[place] < high - 0.01 * (high - low):
        data.ctrl[boom.id] = min(high, rate * data.time)
        mujoco.mj_step(model, data)
        most = max(most, abs(float(data.qfrc_actuator[drive])))
    return file.stem, float(model.body_mass.sum()), float(data.time), most


def main() -> None:
    """Gives every variant to a process, and says what came of it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--count", type=int, default=64)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    with (arguments.folder / "variants.csv").open(encoding="utf-8") as table:
        files = [arguments.folder / row["file"] for row in csv.DictReader(table) if row["file"]][: arguments.count]
    with multiprocessing.get_context("spawn").Pool(arguments.jobs) as pool:
        made = pool.map(raised, files, chunksize=1)
    print("variant      mass  to the top     force")
    for name, mass, seconds, force in made:
        print(f"{name:<8} {1e-3 * mass:7.2f} t   {seconds:7.2f} s {1e-3 * force:7.0f} kN")
    times = np.array([seconds for _, _, seconds, _ in made])
    print(f"{len(made)} variants: {times.min():.2f} to {times.max():.2f} s")


if __name__ == "__main__":
    main()
