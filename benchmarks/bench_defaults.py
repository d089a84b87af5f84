"""What opens a machine with an engine's own settings: how far its pins come apart at the engine's usual time steps.

    python benchmarks/bench_defaults.py [FILE.usda …] [--engines physx newton mujoco] [--full]

Default: both examples, built into a temporary folder, and with `--data FOLDER` the ZX120 that it holds. Each engine is
called by its own documentation and nothing of `yellowiron.simulation` is used: the machine is referenced into a plain
scene (MuJoCo opens the exported MJCF), its base is fixed, every cylinder goes slowly to 2 and to 98 % of its stroke and
back, alone and then all together. A gap is the distance of the two halves of a cut pin, in mm; the worst of all loops
and instants counts. One engine a process: what has burst may not be let go by the engine.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
import tempfile
import time
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdPhysics

ROOT = Path(__file__).resolve().parent.parent
EXAMPLES = ("wheel_loader", "excavator")
MACHINE = "/World/machine"
COLLIDERS = "colliders"
LEG = 3.0
"""Seconds of a leg at least: drawn to low, low to high, high to drawn."""
SLOW = 0.12
"""m/s that no cylinder exceeds: less than the slowest's rated speed."""
REST = 1.0
"""Seconds before the first leg."""
GONE = 1e3
"""Metres: what is farther apart has burst."""

PHYSX = {
    "60 Hz": (60.0, None),
    "120 Hz": (120.0, None),
    "240 Hz": (240.0, None),
    "1 kHz": (1000.0, None),
    "60 Hz, 4 iterations": (60.0, 4),
    "120 Hz, 4 iterations": (120.0, 4),
}
NEWTON = {
    "60 Hz": (60.0, 1),
    "120 Hz": (120.0, 1),
    "240 Hz": (240.0, 1),
    "1 kHz": (1000.0, 1),
    "60 Hz x 4": (60.0, 4),
    "60 Hz x 10": (60.0, 10),
    "60 Hz x 4, Euler": (60.0, 4),
    "60 Hz x 10, Euler": (60.0, 10),
}
MUJOCO = {"60 Hz": 60.0, "120 Hz": 120.0, "240 Hz": 240.0, "1 kHz": 1000.0}
CASES: dict[str, dict[str, Any]] = {"physx": PHYSX, "newton": NEWTON, "mujoco": MUJOCO}
LONG = ("1 kHz",)
"""Left out without `--full`, in PhysX."""


@dataclass(frozen=True)
class Pin:
    """A cut pin: the two bodies and its place in their frames."""

    name: str
    bodies: tuple[str, str]
    places: tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Slide:
    """A driven slide, its limits in metres."""

    path: str
    lower: float
    upper: float


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--engines", nargs="*", choices=CASES, default=list(CASES))
    parser.add_argument("--cases", nargs="*", help="only those settings, by their names in the table")
    parser.add_argument("--data", type=Path, help="a folder with zx120/zx120.glb")
    parser.add_argument("--full", action="store_true", help="PhysX at 1 kHz as well, which takes minutes")
    parser.add_argument("--one", nargs=2, metavar=("ENGINE", "CASE"), help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one:
        engine, case = given.one
        print(json.dumps({"physx": physx, "newton": newton, "mujoco": in_mujoco}[engine](given.files[0], case)))
        return
    with tempfile.TemporaryDirectory() as folder:
        files = given.files or built(Path(folder), given.data)
        for engine in given.engines:
            names = [n for n in CASES[engine] if n in (given.cases or CASES[engine])]
            if engine == "physx" and not (given.full or given.cases):
                names = [name for name in names if name not in LONG]
            table(engine, names, files)


def built(folder: Path, data: Path | None) -> list[Path]:
    homes = {name: ROOT / "examples" / name for name in EXAMPLES}
    wanted = [(name, name, next(home.glob("*.step")), [*home.glob("*.pdf")]) for name, home in homes.items()]
    if data is not None:
        wanted.append(("zx120", "excavator", data / "zx120" / "zx120.glb", []))
    made = []
    for name, kind, cad, sheets in wanted:
        command: list[Any] = [sys.executable, "-m", "yellowiron", "build", kind, "--cad", cad, "--out", folder / name]
        subprocess.run([*command, *(w for s in sheets for w in ("--specs", s))], capture_output=True, check=False)
        made.append(folder / name / f"{kind}.usda")
    return made


def table(engine: str, cases: list[str], files: list[Path]) -> None:
    print(f"\n{engine}: pins' gaps, mm\n\n| | {' | '.join(f.parent.name for f in files)} |\n|---|{'---|' * len(files)}")
    for case in cases:
        found = [apart(engine, case, file) for file in files]
        print(f"| {case} | {' | '.join(found)} |", flush=True)


def apart(engine: str, case: str, file: Path) -> str:
    """The worst gap and where, by a process of its own."""
    command = [sys.executable, __file__, str(file), "--one", engine, case]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    if ran.returncode:
        last = ran.stderr.strip().splitlines() or ["?"]
        return f"fails: {last[-1][:80]} ({ran.returncode})"
    found = json.loads(ran.stdout.strip().splitlines()[-1])
    gap = found["gap"]
    return f"{gap:.3g} ({found['pin']}; {found['rate']:.0f} steps/s)" if gap < GONE * 1e3 else "bursts"


# ---- what is done ----------------------------------------------------------------------------------------------------
def targets(slides: list[Slide], hz: float) -> Iterator[np.ndarray]:
    """A row of targets a step, metres from the drawn pose."""
    now = np.zeros(len(slides))
    for _ in range(round(REST * hz)):
        yield now
    ways = [[i] for i in range(len(slides))]
    for moved in [*ways, list(range(len(slides)))] if len(slides) > 1 else ways:
        for share in (0.02, 0.98, None):
            end = now.copy()
            for i in moved:
                low, high = slides[i].lower, slides[i].upper
                end[i] = 0.0 if share is None else low + share * (high - low)
            steps = math.ceil(hz * max(LEG, 0.5 * math.pi * float(np.abs(end - now).max()) / SLOW))
            for step in range(1, steps + 1):
                yield now + (end - now) * (0.5 - 0.5 * math.cos(math.pi * step / steps))
            now = end
        for _ in range(round(0.5 * hz)):
            yield now


def plain_scene(file: Path, down: Gf.Vec3f) -> tuple[Usd.Stage, UsdPhysics.Scene]:
    """A stage in metres and kilograms, and its physics scene with gravity that way."""
    stage = Usd.Stage.CreateNew(str(file))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    stage.SetDefaultPrim(stage.DefinePrim("/World", "Xform"))
    scene = UsdPhysics.Scene.Define(stage, "/World/scene")
    scene.CreateGravityDirectionAttr(down)
    scene.CreateGravityMagnitudeAttr(9.81)
    return stage, scene


def world(machine: Path, file: Path, *, hz: float | None = None, iterations: int | None = None) -> Usd.Stage:
    """A user's own scene: the machine referenced with its base fixed, gravity, and nothing else."""
    stage, scene = plain_scene(file, Gf.Vec3f(0.0, 0.0, -1.0))
    if hz is not None:
        from pxr import Sdf

        scene.GetPrim().AddAppliedSchema("PhysxSceneAPI")
        rate = scene.GetPrim().CreateAttribute("physxScene:timeStepsPerSecond", Sdf.ValueTypeNames.UInt)
        rate.Set(round(hz))
    prim = stage.DefinePrim(MACHINE, "Xform")
    prim.GetReferences().AddReference(str(machine.resolve()))
    prim.GetVariantSet("Base").SetVariantSelection("fixed")
    if iterations is not None:
        from pxr import Sdf

        name = "physxArticulation:solverPositionIterationCount"
        for each in Usd.PrimRange(prim):
            if each.HasAPI(UsdPhysics.ArticulationRootAPI):
                each.CreateAttribute(name, Sdf.ValueTypeNames.Int).Set(iterations)
    # The base stands still and nothing else is there to touch: colliders have nothing to do.
    for path in [each.GetPath() for each in Usd.PrimRange(prim) if each.GetName() == COLLIDERS]:
        stage.GetPrimAtPath(path).SetActive(False)
    stage.Save()
    return stage


def read(stage: Usd.Stage) -> tuple[list[Pin], list[Slide]]:
    """Cut pins and driven slides, as UsdPhysics has them."""
    pins, slides = [], []
    for prim in Usd.PrimRange(stage.GetPrimAtPath(MACHINE)):
        if not prim.IsA(UsdPhysics.Joint):
            continue
        joint = UsdPhysics.Joint(prim)
        ends = [relation.GetTargets() for relation in (joint.GetBody0Rel(), joint.GetBody1Rel())]
        if joint.GetExcludeFromArticulationAttr().Get() and all(ends):
            places = (joint.GetLocalPos0Attr().Get(), joint.GetLocalPos1Attr().Get())
            pins.append(Pin(prim.GetName(), tuple(str(e[0]) for e in ends), tuple(np.array(p, float) for p in places)))
        elif prim.IsA(UsdPhysics.PrismaticJoint) and prim.HasAPI(UsdPhysics.DriveAPI, "linear"):
            slide = UsdPhysics.PrismaticJoint(prim)
            low, high = (float(a.Get()) for a in (slide.GetLowerLimitAttr(), slide.GetUpperLimitAttr()))
            slides.append(Slide(str(prim.GetPath()), low, high))
    return pins, slides


def turned(quaternions: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Vectors (n, 3) by quaternions (n, 4), x y z w."""
    axis, w = quaternions[:, :3], quaternions[:, 3:]
    across = 2.0 * np.cross(axis, vectors)
    return vectors + w * across + np.cross(axis, across)


class Worst:
    """Of pins, the widest gap so far. Poses come as positions and quaternions (x y z w) of numbered bodies."""

    def __init__(self, pins: list[Pin], numbers: dict[str, int]) -> None:
        self._names = [pin.name for pin in pins]
        self._bodies = [np.array([numbers[pin.bodies[side]] for pin in pins]) for side in (0, 1)]
        self._places = [np.array([pin.places[side] for pin in pins]) for side in (0, 1)]
        self.gap, self.pin = 0.0, ""

    def see(self, positions: np.ndarray, quaternions: np.ndarray) -> bool:
        """Whether all are still somewhere."""
        one, other = (positions[b] + turned(quaternions[b], p) for b, p in zip(self._bodies, self._places, strict=True))
        gaps = np.linalg.norm(one - other, axis=1)
        if not np.isfinite(gaps).all():
            self.gap = math.inf
            return False
        if gaps.max() > self.gap:
            self.gap, self.pin = float(gaps.max()), self._names[int(gaps.argmax())]
        return self.gap < GONE

    def told(self, steps: int, seconds: float) -> dict[str, Any]:
        return {"gap": min(1e3 * self.gap, 1e9), "pin": self.pin, "rate": steps / max(seconds, 1e-9)}


# ---- PhysX -----------------------------------------------------------------------------------------------------------
def physx_schemas() -> list[str]:
    """The folders of PhysX's schemas, which its stage asks for by name."""
    from importlib import metadata

    schemas = metadata.distribution("physx-usd-schemas")
    names = ("PhysxSchema", "OmniUsdPhysicsDeformableSchema")
    return [str(schemas.locate_file(f"physx_usd_schemas/{name}/resources")) for name in names]


def physx(machine: Path, case: str) -> dict[str, Any]:
    import newton_usd_schemas  # noqa: F401
    import ovphysx
    import ovstage
    import physx_usd_schemas  # noqa: F401
    from ovphysx.types import TensorType

    warnings.simplefilter("ignore")
    hz, iterations = PHYSX[case]
    ovphysx.PhysX.set_cpu_mode(True)
    ovstage.population.register_usd_schemas([*physx_schemas(), str(ovphysx.newton_schema_root())])
    engine, scene = ovphysx.PhysX(), ovstage.Stage("defaults")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "world.usda"
        stage = world(machine, file, hz=hz, iterations=iterations)
        pins, slides = read(stage)
        root = next(str(p.GetPath()) for p in stage.Traverse() if p.HasAPI(UsdPhysics.ArticulationRootAPI))
        ovstage.population.open_usd(scene, str(file), ordinal=1, domains=ovstage.PopulationDomain.ALL)
        scene.advance_write_floor(ordinal=1).wait()
        engine.wait_task(engine.attach_ovstage(scene, read_ordinal=1))
    # A step of full length first: what binds tensors takes one of a nanosecond else, over which rounding is speed.
    engine.step_sync(1.0 / hz)
    links = engine.create_tensor_binding(prim_paths=[root], tensor_type=TensorType.ARTICULATION_LINK_POSE)
    told = engine.create_tensor_binding(prim_paths=[root], tensor_type=TensorType.ARTICULATION_DOF_POSITION_TARGET)
    numbers = {name: number for number, name in enumerate(links.body_names)}
    paths = {path: numbers[path.rpartition("/")[2]] for pin in pins for path in pin.bodies}
    columns = {name: number for number, name in enumerate(told.dof_names)}
    own = [columns[slide.path.rpartition("/")[2]] for slide in slides]
    worst, poses, row = Worst(pins, paths), np.zeros(links.shape, np.float32), np.zeros(told.shape, np.float32)
    begun, steps = time.process_time(), 0
    for wanted in targets(slides, hz):
        row[0, own] = wanted
        told.write(row)
        engine.step_sync(1.0 / hz)
        steps += 1
        links.read(poses)
        if not worst.see(poses[0, :, :3].astype(float), poses[0, :, 3:].astype(float)):
            break
    return worst.told(steps, time.process_time() - begun)


# ---- Newton ----------------------------------------------------------------------------------------------------------
def newton(machine: Path, case: str) -> dict[str, Any]:
    import contextlib
    import io

    import newton as engine
    import newton_usd_schemas  # noqa: F401
    import physx_usd_schemas  # noqa: F401
    import warp

    warnings.simplefilter("ignore")
    hz, substeps = NEWTON[case]
    warp.config.quiet = True
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
        stage = world(machine, Path(folder) / "world.usda")
        pins, slides = read(stage)
        with warp.ScopedDevice("cpu"):
            builder = engine.ModelBuilder()
            engine.solvers.SolverMuJoCo.register_custom_attributes(builder)
            found = builder.add_usd(stage, load_visual_shapes=False)
            model = builder.finalize(device="cpu")
            more = {"integrator": "euler", "cone": "elliptic"} if "Euler" in case else {}
            solver = engine.solvers.SolverMuJoCo(model, use_mujoco_cpu=True, **more)
            before, after, control = model.state(), model.state(), model.control()
            engine.eval_fk(model, model.joint_q, model.joint_qd, before)
    places = model.joint_q_start.numpy()
    own = [int(places[found["path_joint_map"][slide.path]]) for slide in slides]
    worst, told = Worst(pins, found["path_body_map"]), control.joint_target_q.numpy()
    begun, steps = time.process_time(), 0
    for wanted in targets(slides, hz):
        told[own] = wanted
        for _ in range(substeps):
            solver.step(before, after, control, None, 1.0 / hz / substeps)
            before, after = after, before
            steps += 1
        poses = before.body_q.numpy().astype(float)
        if not worst.see(poses[:, :3], poses[:, 3:]):
            break
    return worst.told(steps, time.process_time() - begun)


# ---- MuJoCo ----------------------------------------------------------------------------------------------------------
def in_mujoco(machine: Path, case: str) -> dict[str, Any]:
    import mujoco

    hz = MUJOCO[case]
    with tempfile.TemporaryDirectory() as folder:
        stage = world(machine, Path(folder) / "world.usda")
        _, slides = read(stage)
        command: list[Any] = [sys.executable, "-m", "yellowiron", "export", machine, "--to", "mjcf", "--out", folder]
        subprocess.run(command, check=True, capture_output=True)
        file = next(f for f in Path(folder).glob("*.xml") if f.name not in ("scene.xml", "lidar.xml"))
        spec = mujoco.MjSpec.from_file(str(file))
        # The file's machine stands free; in the air it is held by its root.
        for joint in list(spec.joints):
            if joint.type == mujoco.mjtJoint.mjJNT_FREE:
                spec.delete(joint)
        for key in list(spec.keys):
            spec.delete(key)
        spec.option.timestep = 1.0 / hz
        model = spec.compile()
    data = mujoco.MjData(model)
    connects = [n for n in range(model.neq) if model.eq_type[n] == mujoco.mjtEq.mjEQ_CONNECT]
    ids = {str(n): n for n in range(model.nbody)}
    pins = [
        Pin(
            model.equality(n).name,
            (str(model.eq_obj1id[n]), str(model.eq_obj2id[n])),
            (model.eq_data[n, :3], model.eq_data[n, 3:6]),
        )
        for n in connects
    ]
    # Slides go by the names of their prims' last parts; a control is in the lever's sense.
    places = [model.joint(slide.path.rpartition("/")[2]).id for slide in slides]
    servos = [
        next(n for n in range(model.nu) if model.actuator_trnid[n, 0] == p and model.actuator_gainprm[n, 0] > 0.0)
        for p in places
    ]
    signs = np.array([model.actuator_gear[n, 0] for n in servos])
    worst = Worst(pins, ids)
    begun, steps = time.process_time(), 0
    for wanted in targets(slides, hz):
        data.ctrl[servos] = signs * wanted
        mujoco.mj_step(model, data)
        steps += 1
        if not worst.see(data.xpos, np.roll(data.xquat, -1, axis=1)):
            break
    return worst.told(steps, time.process_time() - begun)


if __name__ == "__main__":
    main()
