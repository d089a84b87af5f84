"""Parking brakes on a slope of 20 degrees, on the ground, by each engine's own calls: how fast the machine goes down.

    python benchmarks/bench_slope.py FILE.usda … [--engines physx newton mujoco]

The machine is referenced into a scene with gravity, turned instead of the ground, and a plane of friction 0.7, its
variant `Brakes` released or set; nothing of `yellowiron.simulation` is used. PhysX at 120 Hz, Newton at 240 Hz with its
own settings and with those that a build writes into `scene.usda`, MuJoCo on the exported MJCF. Printed: mm/s of the
root between two and seven seconds.
"""

from __future__ import annotations

import argparse
import math
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade

from bench_defaults import physx_schemas, plain_scene
from bench_physics import creep

SLOPE = math.radians(20.0)
SEEN = (2.0, 7.0)
"""Seconds between which it is looked at."""
TOLD = {"mjc:option:cone": "elliptic", "mjc:option:impratio": 1000.0}
CASES = ("physx", "newton", "newton, told", "mujoco")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--engines", nargs="*", choices=("physx", "newton", "mujoco"))
    parser.add_argument("--one", nargs=2, metavar=("CASE", "BRAKES"), help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one:
        case, brakes = given.one
        print(1e3 * {"p": in_physx, "n": in_newton, "m": in_mujoco}[case[0]](given.files[0], case, brakes))
        return
    print("| engine | machine | released, mm/s | set, mm/s |\n|---|---|---|---|")
    for case in (c for c in CASES if not given.engines or c.split(",")[0] in given.engines):
        for file in given.files:
            cells = " | ".join(_of_a_process(file, case, brakes) for brakes in ("released", "set"))
            print(f"| {case} | {file.stem} | {cells} |", flush=True)


def _of_a_process(file: Path, case: str, brakes: str) -> str:
    command = [sys.executable, __file__, str(file), "--one", case, brakes]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    return f"{float(ran.stdout.split()[-1]):.3g}" if ran.returncode == 0 else "fails"


def scene(machine: Path, file: Path, *, hz: float, brakes: str, told: bool) -> Usd.Stage:
    stage, world = plain_scene(file, Gf.Vec3f(math.sin(SLOPE), 0.0, -math.cos(SLOPE)))
    prim = world.GetPrim()
    prim.AddAppliedSchema("PhysxSceneAPI")
    prim.CreateAttribute("physxScene:timeStepsPerSecond", Sdf.ValueTypeNames.UInt).Set(round(hz))
    if told:
        prim.AddAppliedSchema("MjcSceneAPI")
        for name, value in TOLD.items():
            kind = Sdf.ValueTypeNames.Double if isinstance(value, float) else Sdf.ValueTypeNames.Token
            prim.CreateAttribute(name, kind).Set(value)
    ground = UsdGeom.Plane.Define(stage, "/World/ground")
    ground.CreateAxisAttr("Z")
    UsdPhysics.CollisionAPI.Apply(ground.GetPrim())
    soil = UsdShade.Material.Define(stage, "/World/soil")
    friction = UsdPhysics.MaterialAPI.Apply(soil.GetPrim())
    friction.CreateStaticFrictionAttr(0.7)
    friction.CreateDynamicFrictionAttr(0.7)
    UsdShade.MaterialBindingAPI.Apply(ground.GetPrim()).Bind(soil, materialPurpose="physics")
    placed = stage.DefinePrim("/World/machine", "Xform")
    placed.GetReferences().AddReference(str(machine.resolve()))
    placed.GetVariantSet("Brakes").SetVariantSelection(brakes)
    stage.Save()
    return stage


def downhill(places: Callable[[], np.ndarray], step: Callable[[], None], hz: float) -> float:
    """Speed (m/s) of a place between the two instants."""
    seen = []
    for number in range(round(SEEN[1] * hz)):
        step()
        if number in (round(SEEN[0] * hz), round(SEEN[1] * hz) - 1):
            seen.append(np.array(places(), dtype=float))
    return float(np.linalg.norm(seen[1] - seen[0])) / (SEEN[1] - SEEN[0])


def in_newton(machine: Path, case: str, brakes: str) -> float:
    import newton
    import newton_usd_schemas  # noqa: F401
    import physx_usd_schemas  # noqa: F401
    import warp

    warnings.simplefilter("ignore")
    warp.config.quiet = True
    hz = 240.0
    with tempfile.TemporaryDirectory() as folder, warp.ScopedDevice("cpu"):
        stage = scene(machine, Path(folder) / "world.usda", hz=hz, brakes=brakes, told="told" in case)
        builder = newton.ModelBuilder()
        newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
        builder.add_usd(stage, load_visual_shapes=False)
        model = builder.finalize(device="cpu")
    solver = newton.solvers.SolverMuJoCo(model, use_mujoco_cpu=True)
    states, control = [model.state(), model.state()], model.control()
    newton.eval_fk(model, model.joint_q, model.joint_qd, states[0])

    def step() -> None:
        solver.step(states[0], states[1], control, None, 1.0 / hz)
        states.reverse()

    return downhill(lambda: states[0].body_q.numpy()[0, :3], step, hz)


def in_physx(machine: Path, case: str, brakes: str) -> float:
    import newton_usd_schemas  # noqa: F401
    import ovphysx
    import ovstage
    import physx_usd_schemas  # noqa: F401
    from ovphysx.types import TensorType

    hz = 120.0
    ovphysx.PhysX.set_cpu_mode(True)
    ovstage.population.register_usd_schemas([*physx_schemas(), str(ovphysx.newton_schema_root())])
    engine, stage = ovphysx.PhysX(), ovstage.Stage("slope")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "world.usda"
        written = scene(machine, file, hz=hz, brakes=brakes, told=False)
        root = next(str(p.GetPath()) for p in written.Traverse() if p.HasAPI(UsdPhysics.ArticulationRootAPI))
        ovstage.population.open_usd(stage, str(file), ordinal=1, domains=ovstage.PopulationDomain.ALL)
        stage.advance_write_floor(ordinal=1).wait()
        engine.wait_task(engine.attach_ovstage(stage, read_ordinal=1))
    engine.step_sync(1.0 / hz)
    links = engine.create_tensor_binding(prim_paths=[root], tensor_type=TensorType.ARTICULATION_LINK_POSE)
    poses = np.zeros(links.shape, np.float32)

    def place() -> np.ndarray:
        links.read(poses)
        return poses[0, 0, :3].copy()

    return downhill(place, lambda: engine.step_sync(1.0 / hz), hz)


def in_mujoco(machine: Path, case: str, brakes: str) -> float:
    with tempfile.TemporaryDirectory() as folder:
        command = [
            sys.executable,
            "-m",
            "yellowiron",
            "export",
            machine,
            "--to",
            "mjcf",
            "--out",
            Path(folder) / "mjcf",
        ]
        subprocess.run(command, check=True, capture_output=True)
        return creep(Path(folder) / "mjcf" / "scene.xml", brakes=brakes == "set")


if __name__ == "__main__":
    main()
