"""The machine's own physics, by plain engine calls on the exported MJCF: speed, force, stability, lag and brakes.

    python benchmarks/bench_physics.py [FILE.usda …]     (default: both examples, built into a temporary folder)

Nothing of `yellowiron.simulation` is used. Every control is stepped from rest at one end of its range to the other, the
root held; the speed is held against the cylinder's flow over area, the force against pressure times area, and the
longest stable time step against the file's own. The slope is gravity turned by 20 degrees about the machine's
transverse axis.
"""

from __future__ import annotations

import argparse
import math
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import mujoco
import numpy as np

from plain import built, set_brakes
from yellowiron.hydraulics import Hydraulics
from yellowiron.kinematics.strength import rated_load
from yellowiron.model.mechanism import Mechanism
from yellowiron.usd import read_mechanism

SLOPE = math.radians(20.0)
POSES = 30
WALL = 1e12
"""kg: an armature that nothing moves."""


def main() -> None:
    over_files(__doc__, bench)


def over_files(about: str | None, bench: Callable[[Path, Path], None]) -> None:
    """Calls `bench` with every file of the command line, or with both examples, built, and a folder for its MJCF."""
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path)
    files = parser.parse_args().files
    with tempfile.TemporaryDirectory() as folder:
        for file in files or built(Path(folder)):
            bench(file, Path(folder, f"{file.stem}.mjcf"))


def bench(file: Path, folder: Path) -> None:
    subprocess.run(
        [sys.executable, "-m", "yellowiron", "export", file, "--to", "mjcf", "--out", folder],
        check=True, capture_output=True,
    )  # fmt: skip
    mechanism = read_mechanism(file)
    scene = folder / "scene.xml"
    print(f"\n{file.stem}: {sum(b.mass for b in mechanism.bodies):.0f} kg")
    for name, joint in cylinders(scene):
        cylinder = next(c for c in mechanism.cylinders if c.slide == joint)
        drive = mechanism.joint(joint).drive
        assert drive is not None
        print(f"  {name}")
        for way, label in ((0, "retracts"), (1, "extends")):
            rated, force = drive.speeds[way], drive.forces[way]
            over, stronger = fastest(scene, name, way) / rated - 1.0, stalled(scene, name, way) / force - 1.0
            print(
                f"    {label}: fastest {over:+7.1%} of {rated:.3f} m/s; force {stronger:+6.1%} of {force / 1e3:.0f} kN "
                f"(one cylinder: {(cylinder.pull_force, cylinder.push_force)[way] / 1e3:.0f})"
            )
        print(f"    lag {1e3 * lag(scene, name):.0f} ms")
    drawn, least, poses = margin(scene)
    print(f"  longest stable step: {drawn:.2f} times the file's as drawn, {least:.2f} in the worst of {poses} poses")
    for label, oil in (("targets at the strokes' ends", None), ("levers, through the oil", Hydraulics(mechanism))):
        print(f"  all cylinders at once, {label}: {1e-3 * power(scene, mechanism, oil):.0f} kW at most")
    sunk = sinking(scene, mechanism)
    if sunk is not None:
        print(f"  rated load, a minute: the cylinder that gives most goes by {1e3 * sunk:.4f} mm")
    released, held = (creep(scene, brakes=brakes) for brakes in (False, True))
    for to, detail in (("mjcf", "full"), ("mjcf", "light"), ("mjcf-tendons", "light")):
        place = folder.with_name(f"{folder.name}.{to}.{detail}")
        subprocess.run(
            [sys.executable, "-m", "yellowiron", "export", file, "--to", to, "--detail", detail, "--out", place],
            check=True, capture_output=True,
        )  # fmt: skip
        touching, freedoms, rate = pace(place / "scene.xml")
        print(f"  {to}, {detail} detail: {touching} colliders, {freedoms} freedoms, {rate:.0f} steps a CPU second")
    print(f"  on 20 degrees: {1e3 * released:.1f} mm/s with its brakes released, {1e3 * held:.2f} with them set")


def load_scene(scene: Path) -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = mujoco.MjModel.from_xml_path(str(scene))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


def held(scene: Path) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """With its root held and nothing that touches: a boom that is let go takes a machine off the ground, and what lands
    opens a relief valve."""
    model, data = load_scene(scene)
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    model.dof_armature[:6] = WALL
    return model, data


def cylinders(scene: Path) -> Iterator[tuple[str, str]]:
    """Every control of a slide, and that slide."""
    model, _ = load_scene(scene)
    for number in range(model.nu):
        name, joint = model.actuator(number).name, int(model.actuator_trnid[number, 0])
        if not name.endswith(".damping") and model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_SLIDE:
            yield name, model.joint(joint).name


def address(model: mujoco.MjModel, name: str) -> tuple[int, int, int, float]:
    """Of a control: its number, its joint's position and velocity index, and its sign."""
    number = model.actuator(name).id
    joint = int(model.actuator_trnid[number, 0])
    return number, int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint]), float(model.actuator_gear[number, 0])


def end_of(model: mujoco.MjModel, number: int, sign: float, way: int) -> float:
    low, high = model.actuator_ctrlrange[number]
    return float(high if (way == 1) == (sign > 0) else low)


def fastest(scene: Path, name: str, way: int) -> float:
    """The greatest speed (m/s) after a step from end to end of the stroke, at rest before."""
    model, data = held(scene)
    number, position, velocity, sign = address(model, name)
    top = 0.0
    for to in (1 - way, way):
        data.ctrl[number] = end = end_of(model, number, sign, to)
        top = 0.0
        for _ in range(8000):
            mujoco.mj_step(model, data)
            top = max(top, (2 * to - 1) * float(data.qvel[velocity]))
            if abs(sign * data.qpos[position] - end) < 1e-3:
                break
        mujoco.mj_step(model, data, 500)
    return top


def stalled(scene: Path, name: str, way: int) -> float:
    """The force (N) against a wall, the target at the end of the stroke."""
    model, data = load_scene(scene)
    number, _, velocity, sign = address(model, name)
    model.dof_armature[velocity] = WALL
    data.ctrl[number] = end_of(model, number, sign, way)
    mujoco.mj_step(model, data)
    return (2 * way - 1) * float(data.qfrc_actuator[velocity])


def lag(scene: Path, name: str) -> float:
    """Seconds by which a target is followed that moves at a quarter of the slower rated speed, from half a second to a
    whole one, from the middle of the stroke: at its ends a linkage may be near a dead point, where much mass moves."""
    model, data = held(scene)
    number, position, _, sign = address(model, name)
    damper = next((n for n in range(model.nu) if model.actuator(n).name == f"{name}.damping"), None)
    if damper is None:
        return math.nan
    slower = float(np.abs(model.actuator_forcerange[number]).min()) / -float(model.actuator_biasprm[damper, 2])
    at, step, speed = float(model.actuator_ctrlrange[number].mean()), model.opt.timestep, 0.25 * slower
    data.ctrl[number] = at
    mujoco.mj_step(model, data, 8000)
    behind = []
    for count in range(1, 1001):
        data.ctrl[number] = at + speed * count * step
        behind.append(float(data.ctrl[number]) - sign * float(data.qpos[position]))
        mujoco.mj_step(model, data)
    return float(np.mean(behind[500:]) / speed - step)


def margin(scene: Path) -> tuple[float, float, int]:
    """The longest stable step in units of the file's: as drawn, the least of poses over the strokes, and of how many.

    Stable is a step whose derivative (`mjd_transitionFD`) has no eigenvalue beyond −1, where one that is too long for a
    spring or a damper takes it; what falls over grows by another. Contacts and limits, which have no derivative where
    they begin, are off. A pose is one that the drives reach in two seconds, told places between their ends."""
    model, data = load_scene(scene)
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    model.opt.gravity[:] = 0.0
    drawn = _longest(model, data)
    chosen, least = np.random.default_rng(21), drawn
    own = [i for i in range(model.nu) if model.actuator_ctrllimited[i]]
    low, high = model.actuator_ctrlrange[own].T
    for number in range(POSES):
        shares = chosen.random(len(own)) if number > 1 else np.full(len(own), float(number))
        mujoco.mj_resetDataKeyframe(model, data, 0)
        for step in range(2000):
            data.ctrl[own] = np.minimum(1.0, step / 1500) * (low + (high - low) * shares)
            mujoco.mj_step(model, data)
        least = min(least, _longest(model, data))
    return drawn, least, POSES


def _longest(model: mujoco.MjModel, seen: mujoco.MjData) -> float:
    own, flags, size = float(model.opt.timestep), int(model.opt.disableflags), 2 * model.nv + model.na
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_LIMIT)
    matrix, longest = np.zeros((size, size)), 0.0
    for factor in np.arange(1.0, 5.01, 0.25):
        model.opt.timestep = factor * own
        data = mujoco.MjData(model)
        data.qpos[:], data.ctrl[:] = seen.qpos, seen.ctrl
        mujoco.mj_forward(model, data)
        mujoco.mjd_transitionFD(model, data, 1e-6, True, matrix, None, None, None)
        if not np.linalg.eigvals(matrix).real.min() > -1.001:
            break
        longest = float(factor)
    model.opt.timestep, model.opt.disableflags = own, flags
    return longest


def pace(scene: Path) -> tuple[int, int, float]:
    """Colliders of the machine, its degrees of freedom, and steps a CPU second on the ground: the best of four runs."""
    model, data = load_scene(scene)
    mujoco.mj_step(model, data, 1000)
    best = 0.0
    for _ in range(4):
        begun = time.process_time()
        mujoco.mj_step(model, data, 1500)
        best = max(best, 1500 / (time.process_time() - begun))
    return int(np.sum(model.geom_contype != 0)) - 1, int(model.nv), best


def power(scene: Path, mechanism: Mechanism, oil: Hydraulics | None) -> float:
    """The most (W) that all cylinders do at once, to one end of their strokes and to the other."""
    model, data = load_scene(scene)
    mujoco.mj_step(model, data, 1500)
    circuits = Hydraulics(mechanism).circuits
    places = {c.slide: address(model, name) for name, c in circuits.items()}
    dofs = [velocity for _, _, velocity, _ in places.values()]
    most = 0.0
    for lever in (1.0, -1.0):
        for _ in range(4000):
            if oil is None:
                told = {c.slide: (c.lower, c.upper)[lever * c.sign > 0.0] for c in circuits.values()}
            else:
                strokes = {slide: float(data.qpos[position]) for slide, (_, position, _, _) in places.items()}
                forces = {s: float(data.qfrc_actuator[velocity]) for s, (_, _, velocity, _) in places.items()}
                levers = dict.fromkeys(circuits, lever)
                told = oil.step(levers, strokes, model.opt.timestep, forces=forces)
            for slide, (number, _, _, sign) in places.items():
                data.ctrl[number] = sign * told[slide]
            mujoco.mj_step(model, data)
            most = max(most, float(np.maximum(data.qfrc_actuator[dofs] * data.qvel[dofs], 0.0).sum()))
    return most


def sinking(scene: Path, mechanism: Mechanism) -> float | None:
    """The farthest (m) that a cylinder goes in a minute under the rated load, on the ground, after ten seconds; None
    for a machine without one."""
    load = rated_load(mechanism)
    if load is None:
        return None
    site, mass = load
    model, data = load_scene(scene)
    body = model.body(site.body).id
    place = np.array(site.position) - np.array(mechanism.body(site.body).origin)
    joints = [int(model.joint(slide).qposadr[0]) for _, slide in cylinders(scene)]
    seen = []
    for seconds in (10.0, 60.0):
        for _ in range(round(seconds / model.opt.timestep)):
            force = np.array([0.0, 0.0, -9.81 * mass])
            arm = data.xpos[body] + data.xmat[body].reshape(3, 3) @ place - data.xipos[body]
            data.xfrc_applied[body] = np.concatenate([force, np.cross(arm, force)])
            mujoco.mj_step(model, data)
        seen.append(data.qpos[joints].copy())
    return float(np.abs(seen[1] - seen[0]).max())


def creep(scene: Path, *, brakes: bool) -> float:
    """How fast (m/s) the root moves on the slope, between two and seven seconds."""
    model, data = load_scene(scene)
    model.opt.gravity[:] = 9.81 * np.array([math.sin(SLOPE), 0.0, -math.cos(SLOPE)])
    if brakes:
        set_brakes(model)
    places = []
    for seconds in (2.0, 5.0):
        mujoco.mj_step(model, data, int(seconds / model.opt.timestep))
        places.append(data.qpos[:3].copy())
    return float(np.linalg.norm(places[1] - places[0])) / 5.0


if __name__ == "__main__":
    main()
