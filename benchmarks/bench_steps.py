"""Steps of a target in PhysX and Newton, by plain calls on the file: how fast a cylinder goes, by its rated speed.

    python benchmarks/bench_steps.py [FILE.usda …] [--engines physx newton] [--each-way | --levers]

Default: both examples, built into a temporary folder. The machine is referenced into a plain scene with its base fixed
(`bench_defaults.py`); nothing of `yellowiron.simulation` is used. From the drawn pose, and from the one with all
cylinders at their farther ends, every cylinder is told one end of its stroke, and then the other; printed is its
greatest speed each way in per cent of flow over area. With `--each-way` PhysX is told limits before every step
(`yellowiron.each_way`). With `--levers` the file's variant `Actuation` is `hydraulic`, levers are pushed whole instead,
through `yellowiron.hydraulics`, one by one and then all at once, and the most power of all cylinders is printed (by
what their drives give at their positions and speeds). MuJoCo: `bench_physics.py`.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Sdf

from bench_defaults import MACHINE, built, physx_schemas, read, world
from yellowiron.each_way import EachWay
from yellowiron.hydraulics import Hydraulics
from yellowiron.model.mechanism import Drive as Rated
from yellowiron.model.mechanism import Mechanism
from yellowiron.usd import read_mechanism

HZ = {"physx": 120.0, "newton": 240.0}
FINE = 1000.0
"""Steps a second of Newton with `--levers`, its integrator Euler's: by its own, drives do work that is lost."""
REST = 1.0
"""Seconds before a step, and the time that a cylinder has to a pose."""
INTEGRATOR = "mjc:option:integrator"
LONGEST = 12.0
"""Seconds to an end."""
Drive = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]
"""One step with targets: where the slides are, and how fast they go."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--engines", nargs="*", choices=HZ, default=list(HZ))
    led = parser.add_mutually_exclusive_group()
    led.add_argument("--each-way", action="store_true")
    led.add_argument("--levers", action="store_true")
    parser.add_argument("--one", help=argparse.SUPPRESS)
    given = parser.parse_args()
    options = [option for option, on in (("--each-way", given.each_way), ("--levers", given.levers)) if on]
    if given.one:
        print(json.dumps(steps_in(given.one, given.files[0], options)))
        return
    with tempfile.TemporaryDirectory() as folder:
        for file in given.files or built(Path(folder), None):
            print(f"\n{file.parent.name}: greatest speed, of rated\n")
            print("| engine | cylinder | retracts | extends |\n|---|---|---|---|")
            for engine in given.engines:
                command = [sys.executable, __file__, str(file), "--one", engine, *options]
                ran = subprocess.run(command, capture_output=True, text=True, check=False)
                if ran.returncode:
                    print(f"| {engine} | fails | | |")
                    continue
                told = json.loads(ran.stdout.strip().splitlines()[-1])
                for name, (back, forth) in told["speeds"].items():
                    print(f"| {engine} | {name} | {back:.0%} | {forth:.0%} |", flush=True)
                if given.levers:
                    print(f"| {engine} | all at once: {1e-3 * told['power']:.0f} kW at most | | |", flush=True)


def steps_in(engine: str, file: Path, options: list[str]) -> dict[str, Any]:
    """`speeds`: slide → the greatest of its speeds each way, by its rated ones. `power`: the most of all, W."""
    warnings.simplefilter("ignore")
    mechanism = read_mechanism(file)
    with tempfile.TemporaryDirectory() as folder:
        stage = world(file, Path(folder) / "world.usda", hz=HZ["physx"])
        if "--levers" in options:
            stage.GetPrimAtPath(MACHINE).GetVariantSet("Actuation").SetVariantSelection("hydraulic")
            integrator = stage.GetPrimAtPath("/World/scene").CreateAttribute(INTEGRATOR, Sdf.ValueTypeNames.Token)
            integrator.Set("euler")
        _, slides = read(stage)
        stage.Save()
        scene = Path(folder) / "world.usda"
        if engine == "physx":
            drive = in_physx(scene, stage, slides, mechanism if "--each-way" in options else None)
        else:
            drive = in_newton(scene, slides, FINE if "--levers" in options else HZ[engine])
    names = [slide.path.rpartition("/")[2] for slide in slides]
    rated = [own for name in names if (own := mechanism.joint(name).drive) is not None]
    low, high = np.array([s.lower for s in slides]), np.array([s.upper for s in slides])
    worst = {name: [0.0, 0.0] for name in names}
    hz = HZ[engine]
    if "--levers" in options:
        return by_levers(mechanism, drive, names, rated, engine)

    def go(targets: np.ndarray, seconds: float, watched: int | None = None) -> None:
        for _ in range(round(seconds * hz)):
            at, speeds = drive(targets)
            if watched is None:
                continue
            faster(worst[names[watched]], float(speeds[watched]), rated[watched])
            if abs(float(at[watched] - targets[watched])) < 2e-3:
                return

    out = np.where(high > -low, 0.95 * high, 0.95 * low)
    for pose in (np.zeros(len(slides)), out):
        for number in range(len(slides)):
            go(pose, REST + LONGEST * float(np.abs(pose).max() > 0.0))
            for end in (low, high):
                told = pose.copy()
                told[number] = end[number]
                go(told, LONGEST, number)
    return {"speeds": worst}


def faster(seen: list[float], speed: float, rated: Rated) -> None:
    """Keeps the greatest of the speeds, by the rated one that way."""
    way = int(speed > 0.0)
    seen[way] = max(seen[way], abs(speed) / rated.speeds[way])


def by_levers(mechanism: Mechanism, drive: Drive, names: list[str], rated: list[Rated], engine: str) -> dict[str, Any]:
    """What the same come to with levers pushed whole, to one end and to the other: each alone, and all."""
    hz, implicit = {**HZ, "newton": FINE}[engine], engine == "physx"
    oil = Hydraulics(mechanism, implicit=implicit)
    circuits = {name: circuit for name, circuit in oil.circuits.items() if circuit.slide in names}
    worst, power = {name: [0.0, 0.0] for name in names}, 0.0
    at, forces = np.zeros(len(names)), np.zeros(len(names))
    for pushed in [[name] for name in circuits] + [list(circuits)]:
        for lever in (1.0, -1.0):
            for _ in range(round(LONGEST * hz)):
                known = [dict(zip(names, map(float, each), strict=True)) for each in (at, forces)]
                told = oil.step(dict.fromkeys(pushed, lever), known[0], 1.0 / hz, forces=known[1])
                targets = np.array([told.get(name, 0.0) for name in names])
                before = at
                at, speeds = drive(targets)
                pulled = at if implicit else before
                forces = np.array([given(*each) for each in zip(rated, targets, pulled, speeds, strict=True)])
                power = max(power, float(np.maximum(forces * speeds, 0.0).sum()))
                for number in (names.index(circuits[name].slide) for name in pushed):
                    faster(worst[names[number]], float(speeds[number]), rated[number])
    return {"speeds": worst, "power": power}


def given(rated: Rated, target: float, at: float, speed: float) -> float:
    """The force (N) of a position drive, its speed that at a step's end: both engines solve for that. Engines' own
    figures are none: Newton's is before that, and PhysX's what goes through the joint."""
    back, forth = rated.forces
    return max(-back, min(forth, rated.stiffness * (target - at) - rated.damping * speed))


def in_physx(file: Path, stage: Any, slides: list[Any], told: Mechanism | None) -> Drive:
    import newton_usd_schemas  # noqa: F401
    import ovphysx
    import ovstage
    import physx_usd_schemas  # noqa: F401
    from ovphysx.types import TensorType
    from pxr import UsdPhysics

    ovphysx.PhysX.set_cpu_mode(True)
    ovstage.population.register_usd_schemas([*physx_schemas(), str(ovphysx.newton_schema_root())])
    engine, scene = ovphysx.PhysX(), ovstage.Stage("steps")
    root = next(str(p.GetPath()) for p in stage.Traverse() if p.HasAPI(UsdPhysics.ArticulationRootAPI))
    ovstage.population.open_usd(scene, str(file), ordinal=1, domains=ovstage.PopulationDomain.ALL)
    scene.advance_write_floor(ordinal=1).wait()
    engine.wait_task(engine.attach_ovstage(scene, read_ordinal=1))
    engine.step_sync(1.0 / HZ["physx"])
    kinds = ("POSITION", "VELOCITY", "POSITION_TARGET", "MAX_FORCE", "MAX_VELOCITY")
    bound = {
        kind: engine.create_tensor_binding(prim_paths=[root], tensor_type=TensorType[f"ARTICULATION_DOF_{kind}"])
        for kind in kinds
    }
    columns = {name: number for number, name in enumerate(bound["POSITION"].dof_names)}
    own = [columns[slide.path.rpartition("/")[2]] for slide in slides]
    rows = {kind: np.zeros(binding.shape, np.float32) for kind, binding in bound.items()}
    limits = EachWay.of(told, bound["POSITION"].dof_names) if told is not None else None

    def step(targets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        rows["POSITION_TARGET"][0, own] = targets
        bound["POSITION_TARGET"].write(rows["POSITION_TARGET"])
        if limits is not None:
            at, moving, wanted = (rows[kind] for kind in kinds[:3])
            bound["MAX_FORCE"].write(_finite(limits.forces_now(wanted, at, moving)))
            bound["MAX_VELOCITY"].write(_finite(limits.speeds_now(wanted, at)))
        engine.step_sync(1.0 / HZ["physx"])
        for kind in kinds[:2]:
            bound[kind].read(rows[kind])
        return rows["POSITION"][0, own], rows["VELOCITY"][0, own]

    step.held = (engine, scene)  # type: ignore[attr-defined]  # neither may go while it is called
    return step


def _finite(limits: np.ndarray) -> np.ndarray:
    return np.minimum(limits, 1e9).astype(np.float32)


def in_newton(file: Path, slides: list[Any], hz: float) -> Drive:
    import newton
    import newton_usd_schemas  # noqa: F401
    import physx_usd_schemas  # noqa: F401
    import warp

    warp.config.quiet = True
    with warp.ScopedDevice("cpu"):
        builder = newton.ModelBuilder()
        newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
        found = builder.add_usd(str(file), load_visual_shapes=False)
        model = builder.finalize(device="cpu")
        solver = newton.solvers.SolverMuJoCo(model, use_mujoco_cpu=True)
        states, control = [model.state(), model.state()], model.control()
        newton.eval_fk(model, model.joint_q, model.joint_qd, states[0])
    numbers = [found["path_joint_map"][slide.path] for slide in slides]
    at, moving = (starts.numpy()[numbers] for starts in (model.joint_q_start, model.joint_qd_start))

    def step(targets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        control.joint_target_q.numpy()[at] = targets
        with warp.ScopedDevice("cpu"):
            solver.step(states[0], states[1], control, None, 1.0 / hz)
        states.reverse()
        return states[0].joint_q.numpy()[at], states[0].joint_qd.numpy()[moving]

    return step


if __name__ == "__main__":
    main()
