"""Few colliders against all parts, on rough ground: does the machine come to rest on the same places?

    python benchmarks/bench_rough.py [FILE.usda …]     (default: both examples, built into a temporary folder)

MuJoCo alone, and nothing of `yellowiron.simulation`. Each exported machine is let down onto ground of random hills
(0.3 m from top to bottom, 1.5 m apart), in several places and headings, its cylinders on their way, held over its place
as by a crane, free to sink, to pitch and to roll; once with the colliders that the file has, and once with every part
that may collide in their place, as its own convex hull (hidden wheels stay: their track's parts collide in neither).
Printed for each place: how far apart the two come to rest, and which bodies bear in the one and not in the other.
"""

from __future__ import annotations

import math
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

import mujoco
import numpy as np
from pxr import Usd

from bench_physics import over_files

PLACES = 8
SIDE, HIGH, CELL = 24.0, 0.3, 0.1
"""Metres: the ground's edge, its highest hill over its lowest valley, and the distance of its points."""
APART = 1.5
"""Metres between hills."""
SETTLED = 6.0
"""Seconds."""
HELD = 200.0
"""1/s: by that share of its momentum it is slowed in the plane, and about the upright."""
BEARS = 0.01
"""Of the machine's weight: what bears less is not counted."""


def main() -> None:
    over_files(__doc__, bench)


def bench(file: Path, folder: Path) -> None:
    command = [sys.executable, "-m", "yellowiron", "export", file, "--to", "mjcf", "--out", folder]
    subprocess.run(command, check=True, capture_output=True)
    parts = touching(file)
    found = {False: model_of(folder / f"{file.stem}.xml"), True: model_of(folder / f"{file.stem}.xml", parts)}
    counts = {drawn: int(np.sum(model.geom_contype != 0)) - 1 for drawn, model in found.items()}
    print(f"\n{file.stem}: {counts[False]} colliders, {counts[True]} parts\n")
    print(
        "| place | apart, mm | leaning, degrees | bear in the file alone | … with parts alone |\n|---|---|---|---|---|"
    )
    chosen = np.random.default_rng(21)
    for place in range(PLACES):
        x, y, heading = (*chosen.uniform(-6.0, 6.0, 2), chosen.uniform(-math.pi, math.pi))
        rests = {drawn: at_rest(model, x, y, heading) for drawn, model in found.items()}
        (one, few), (other, all_) = rests[False], rests[True]
        leaning = 2.0 * math.degrees(math.acos(min(1.0, abs(float(one[3:7] @ other[3:7])))))
        apart = 1e3 * float(np.linalg.norm(one[:3] - other[:3]))
        print(f"| {place + 1} | {apart:.1f} | {leaning:.2f} | {named(few - all_)} | {named(all_ - few)} |", flush=True)


def named(bodies: Iterable[str]) -> str:
    return ", ".join(sorted(bodies)) or "–"


def touching(file: Path) -> frozenset[str]:
    """Names of the visuals whose part may collide."""
    stage = Usd.Stage.Open(str(file))
    records = ((p.GetName(), p.GetCustomDataByKey("yellowiron")) for p in stage.Traverse())
    return frozenset(name for name, told in records if told and told.get("collision", "none") != "none")


def hills() -> np.ndarray:
    """Heights (n, n), 0 to 1, smooth over `APART`."""
    points = round(SIDE / CELL) + 1
    coarse = np.random.default_rng(7).random((round(SIDE / APART) + 1,) * 2)
    at = np.linspace(0.0, len(coarse) - 1.0, points)
    low = np.minimum(at.astype(int), len(coarse) - 2)
    share = 0.5 - 0.5 * np.cos(math.pi * (at - low))
    rows = coarse[low] * (1.0 - share)[:, None] + coarse[low + 1] * share[:, None]
    return rows[:, low] * (1.0 - share) + rows[:, low + 1] * share


def model_of(file: Path, parts: frozenset[str] = frozenset()) -> mujoco.MjModel:
    """The machine over rough ground; with `parts`, these collide in the place of the file's colliders."""
    spec = mujoco.MjSpec.from_file(str(file))
    heights = hills()
    field = spec.add_hfield(name="hills", nrow=len(heights), ncol=len(heights), userdata=heights.ravel())
    field.size = [0.5 * SIDE, 0.5 * SIDE, HIGH, 0.5]
    ground = {"hfieldname": "hills", "friction": [0.7, 0.005, 1e-4]}
    spec.worldbody.add_geom(name="ground", type=mujoco.mjtGeom.mjGEOM_HFIELD, **ground)
    for key in list(spec.keys):
        spec.delete(key)
    for body in spec.bodies if parts else ():
        own = {name: [g for g in body.geoms if g.classname.name == name] for name in ("visual", "collision")}
        if not own["visual"]:  # a hidden wheel
            continue
        for geom in own["visual"]:
            if parts.intersection(geom.name.split(".")):
                geom.contype, geom.conaffinity = 1, 0
                geom.friction, geom.priority = own["collision"][0].friction, own["collision"][0].priority
        for geom in own["collision"]:
            geom.contype = 0
    return spec.compile()


def at_rest(model: mujoco.MjModel, x: float, y: float, heading: float) -> tuple[np.ndarray, set[str]]:
    """Where the root comes to rest (position, w x y z), and the bodies that bear there."""
    data = mujoco.MjData(model)
    turn = np.array([math.cos(0.5 * heading), 0.0, 0.0, math.sin(0.5 * heading)])
    moved = np.zeros(3)
    mujoco.mju_rotVecQuat(moved, data.qpos[:3].copy(), turn)
    data.qpos[:3] = moved + np.array([x, y, HIGH])
    mujoco.mju_mulQuat(data.qpos[3:7], turn, data.qpos[3:7].copy())
    model.dof_frictionloss[:] = 0.0
    for number in range(model.nnumeric):
        name = model.numeric(number).name
        if name.endswith(".brake"):
            model.dof_frictionloss[model.joint(name.removesuffix(".brake")).dofadr[0]] = model.numeric(number).data[0]
    own = [n for n in range(model.nu) if model.actuator_ctrllimited[n]]
    held = [0, 1, 5]
    mujoco.mj_forward(model, data)
    mass = np.zeros(6)
    for k in held:
        unit = np.zeros(model.nv)
        unit[k] = 1.0
        moved_by = np.zeros(model.nv)
        mujoco.mj_mulM(model, data, moved_by, unit)
        mass[k] = moved_by[k]
    steps = round(SETTLED / model.opt.timestep)
    for step in range(steps):
        # Each cylinder by a fifth of its stroke towards its nearer end: the attachment goes down, or up; both bear.
        share = min(1.0, 2.0 * step / steps)
        for n in own:
            low, high = model.actuator_ctrlrange[n]
            data.ctrl[n] = 0.2 * share * (low if -low > high else high)
        data.qfrc_applied[held] = -HELD * mass[held] * data.qvel[held]
        mujoco.mj_step(model, data)
    weight, force, bears = float(model.body_mass.sum() * 9.81), np.zeros(6), dict.fromkeys(range(model.nbody), 0.0)
    for number, contact in enumerate(data.contact):
        mujoco.mj_contactForce(model, data, number, force)
        for geom in (contact.geom1, contact.geom2):
            bears[int(model.geom_bodyid[geom])] += float(force[0])
    return data.qpos[:7].copy(), {model.body(b).name for b, f in bears.items() if b and f > BEARS * weight}


if __name__ == "__main__":
    main()
