"""Many machines at once in Newton: `replicate`, loops intact, every world its own targets.

    python examples/learning/many_worlds.py out/excavator/excavator.usda [--worlds 256] [--seconds 2] [--device cpu]

The file is read once and replicated; nothing of ours is used but the file. Every world's cylinders go to and fro with a
phase of their own. Printed: world-steps a second, and the widest gap of any cut pin in any world. It needs the extra
`newton`; with a GPU, `--device cuda:0`.
"""

from __future__ import annotations

import argparse
import time
import warnings
from pathlib import Path

import newton
import newton_usd_schemas  # noqa: F401  registers its schemas before a stage opens
import numpy as np
import physx_usd_schemas  # noqa: F401  likewise
import warp
from pxr import Usd, UsdPhysics

SHARE, PERIOD = 0.3, 4.0
"""Of its stroke a cylinder swings to either side of the middle of what is left to it; seconds."""


def main() -> None:
    """Steps the worlds and prints how fast, and how well the loops hold."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("machine", type=Path)
    parser.add_argument("--worlds", type=int, default=256)
    parser.add_argument("--seconds", type=float, default=2.0)
    parser.add_argument("--hz", type=float, default=240.0)
    parser.add_argument("--device", default="cpu")
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    warp.config.quiet = True
    stage = held(given.machine)
    pins, slides = read(stage)
    with warp.ScopedDevice(given.device):
        one = newton.ModelBuilder()
        newton.solvers.SolverMuJoCo.register_custom_attributes(one)
        found = one.add_usd(stage, load_visual_shapes=False)
        many = newton.ModelBuilder()
        newton.solvers.SolverMuJoCo.register_custom_attributes(many)
        many.replicate(one, given.worlds)
        model = many.finalize(device=given.device)
        solver = newton.solvers.SolverMuJoCo(model)
        before, after, control = model.state(), model.state(), model.control()
        newton.eval_fk(model, model.joint_q, model.joint_qd, before)
        bodies, coordinates = one.body_count, len(one.joint_q)
        starts = model.joint_q_start.numpy()
        own = np.array([starts[found["path_joint_map"][path]] for path, _, _ in slides])
        places = (np.arange(given.worlds)[:, None] * coordinates + own).ravel()
        phase = np.arange(given.worlds)[:, None] * 2.0 * np.pi / given.worlds
        low, high = (np.array([ends[k] for ends in slides], dtype=float) for k in (1, 2))
        way = SHARE * np.minimum(-low, high)
        steps, spent, worst = round(given.seconds * given.hz), 0.0, 0.0
        told = control.joint_target_q.numpy().copy()
        for step in range(steps):
            seconds = (step + 1) / given.hz
            # Every world starts as it is drawn, and reaches its own phase within a second.
            wave = way * min(1.0, seconds) * np.sin(2.0 * np.pi * seconds / PERIOD + phase)
            told[places] = wave.ravel()
            control.joint_target_q.assign(told)
            begun = time.perf_counter()
            solver.step(before, after, control, None, 1.0 / given.hz)
            warp.synchronize()
            spent += time.perf_counter() - begun if step else 0.0  # the first step compiles
            before, after = after, before
            if step % 12 == 0 or step == steps - 1:
                worst = max(worst, gap(before.body_q.numpy().reshape(given.worlds, bodies, 7), pins, found))
    rate = given.worlds * (steps - 1) / spent
    print(f"{given.worlds} worlds, {steps} steps of 1/{given.hz:g} s on {given.device}: {rate:.0f} world-steps/s")
    print(f"pins apart by {1e3 * worst:.3g} mm at most, in any world")


def held(machine: Path) -> Usd.Stage:
    """The machine alone, its base fixed and without colliders: nothing is there to touch."""
    stage = Usd.Stage.CreateInMemory()
    UsdPhysics.Scene.Define(stage, "/scene")
    stage.SetMetadata("metersPerUnit", 1.0)
    stage.SetMetadata("upAxis", "Z")
    prim = stage.DefinePrim("/machine", "Xform")
    prim.GetReferences().AddReference(str(machine.resolve()))
    prim.GetVariantSet("Base").SetVariantSelection("fixed")
    for path in [p.GetPath() for p in Usd.PrimRange(prim) if p.GetName() == "colliders"]:
        stage.GetPrimAtPath(path).SetActive(False)
    return stage


def read(stage: Usd.Stage) -> tuple[list[tuple[tuple[str, str], np.ndarray]], list[tuple[str, float, float]]]:
    """Cut pins (bodies, their two places) and driven slides (path, lower, upper)."""
    pins, slides = [], []
    for prim in stage.Traverse():
        if not prim.IsA(UsdPhysics.Joint):
            continue
        joint = UsdPhysics.Joint(prim)
        ends = [relation.GetTargets() for relation in (joint.GetBody0Rel(), joint.GetBody1Rel())]
        if joint.GetExcludeFromArticulationAttr().Get() and all(ends):
            places = np.array([joint.GetLocalPos0Attr().Get(), joint.GetLocalPos1Attr().Get()], dtype=float)
            pins.append(((str(ends[0][0]), str(ends[1][0])), places))
        elif prim.IsA(UsdPhysics.PrismaticJoint) and prim.HasAPI(UsdPhysics.DriveAPI, "linear"):
            slide = UsdPhysics.PrismaticJoint(prim)
            slides.append((str(prim.GetPath()), slide.GetLowerLimitAttr().Get(), slide.GetUpperLimitAttr().Get()))
    return pins, slides


def gap(poses: np.ndarray, pins: list[tuple[tuple[str, str], np.ndarray]], found: dict[str, dict[str, int]]) -> float:
    """The widest gap (m) of any pin in any world; poses (worlds, bodies, 7)."""
    worst = 0.0
    for bodies, places in pins:
        one, other = (
            poses[:, found["path_body_map"][body], :3] + turned(poses[:, found["path_body_map"][body], 3:], place)
            for body, place in zip(bodies, places, strict=True)
        )
        worst = max(worst, float(np.nan_to_num(np.linalg.norm(one - other, axis=1), nan=np.inf).max()))
    return worst


def turned(quaternions: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """A vector by quaternions (n, 4), x y z w."""
    axis, w = quaternions[:, :3], quaternions[:, 3:]
    across = 2.0 * np.cross(axis, vector)
    return vector + w * across + np.cross(axis, across)


if __name__ == "__main__":
    main()
