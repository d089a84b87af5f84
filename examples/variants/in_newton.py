"""Variants that `yellowiron vary` wrote, side by side in one model of Newton's: `python in_newton.py FOLDER`.

Each variant is a world of its own; names, bodies, joints and their order are the same in all, masses, limits and drives
are each one's. Boom cylinders are told to extend, and the script says how far they came.
"""

from __future__ import annotations

import argparse
import csv
import time
import warnings
from pathlib import Path

import newton
import newton_usd_schemas  # noqa: F401 - registers its schemas before a stage opens
import numpy as np
import physx_usd_schemas  # noqa: F401 - likewise
import warp
from pxr import Usd

COLLIDERS = [r".*/colliders/.*"]
STEP = 0.001


def main() -> None:
    """Reads the layers, makes the model and moves it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--count", type=int, default=256)
    parser.add_argument("--steps", type=int, default=200)
    parser.add_argument("--device", default="cuda:0" if warp.is_cuda_available() else "cpu")
    parser.add_argument("--collide", action="store_true", help="With colliders, which take most of the memory.")
    arguments = parser.parse_args()
    warnings.simplefilter("ignore")
    warp.config.quiet = True
    with (arguments.folder / "variants.csv").open(encoding="utf-8") as file:
        layers = [arguments.folder / row["file"] for row in csv.DictReader(file) if row["file"]][: arguments.count]
    begun = time.perf_counter()
    with warp.ScopedDevice(arguments.device):
        builder = newton.ModelBuilder(up_axis=newton.Axis.Z)
        newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
        for layer in layers:
            one = newton.ModelBuilder(up_axis=newton.Axis.Z)
            newton.solvers.SolverMuJoCo.register_custom_attributes(one)
            stage = Usd.Stage.Open(str(layer))
            # Held by its base: this is about levers, not about ground.
            stage.GetDefaultPrim().GetVariantSet("Base").SetVariantSelection("fixed")
            found = one.add_usd(stage, load_visual_shapes=False, ignore_paths=[] if arguments.collide else COLLIDERS)
            builder.add_world(one)
        model = builder.finalize(device=arguments.device)
        print(f"{len(layers)} variants in one model: {model.body_count} bodies, {model.joint_count} joints, "
              f"{time.perf_counter() - begun:.1f} s")  # fmt: skip
        solver = newton.solvers.SolverMuJoCo(model, integrator="euler", cone="elliptic")
        before, after, control = model.state(), model.state(), model.control()
        newton.eval_fk(model, model.joint_q, model.joint_qd, before)
        joints = [path for path in found["path_joint_map"] if "boom_cylinder" in path and "boom_piston_rod" in path]
        driven = next(
            path for path in joints if "PhysicsDriveAPI:linear" in stage.GetPrimAtPath(path).GetAppliedSchemas()
        )
        starts = model.joint_q_start.numpy()[:-1].reshape(len(layers), -1)
        place = found["path_joint_map"][driven]
        masses = model.body_mass.numpy().reshape(len(layers), -1).sum(axis=1)
        print(f"masses from {1e-3 * masses.min():.2f} to {1e-3 * masses.max():.2f} t")
        targets = control.joint_target_q.numpy()
        begun = time.perf_counter()
        for step in range(arguments.steps):
            targets[starts[:, place]] = 0.1 * STEP * step
            control.joint_target_q.assign(targets)
            solver.step(before, after, control, None, STEP)
            before, after = after, before
        moved = before.joint_q.numpy()[starts[:, place]]
        rate = arguments.steps * len(layers) / (time.perf_counter() - begun)
        print(f"{rate:.0f} steps/s of one machine; strokes {1e3 * moved.min():.2f} to {1e3 * moved.max():.2f} mm")
        if not np.isfinite(before.body_q.numpy()).all():
            raise SystemExit("a variant went astray")


if __name__ == "__main__":
    main()
