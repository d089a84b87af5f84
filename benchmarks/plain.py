"""A machine's file in PhysX, Newton and MuJoCo by their own documented calls, for the benchmarks that audit the file.

Nothing of `yellowiron.simulation` is used: a plain scene refers to the machine (MuJoCo opens the exported MJCF), and an
engine steps it. One engine a process: what has burst may not be let go by the engine. SI; quaternions x y z w.
"""

from __future__ import annotations

import contextlib
import io
import json
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib import metadata
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade

from yellowiron.each_way import EachWay

ROOT = Path(__file__).resolve().parent.parent
EXAMPLES = ("wheel_loader", "excavator")
MACHINE = "/World/machine"
FRICTION = 0.7
GRAVITY = 9.81
HELD = 10.0
HZ: Mapping[str, float] = {"physx": 120.0, "newton": 240.0, "mujoco": 1000.0}
"""Steps a second that an engine is asked for where nothing else is said."""


@dataclass(frozen=True)
class World:
    """A user's own scene. `hz` steps a second; `down` the direction of gravity, a unit vector or none; `told` what the
    scene says; `iterations` of PhysX's articulation, if not the file's; `options` of Newton's solver."""

    hz: float
    base: str = "fixed"
    ground: bool = False
    down: tuple[float, float, float] = (0.0, 0.0, -1.0)
    variants: Mapping[str, str] = field(default_factory=dict)
    told: Mapping[str, str | float] = field(default_factory=dict)
    iterations: int | None = None
    options: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Pin:
    """A cut pin: the paths of its two bodies and its place in their frames."""

    name: str
    bodies: tuple[str, str]
    places: tuple[np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Slide:
    """A driven slide, its limits in metres from the drawn pose."""

    path: str
    lower: float
    upper: float

    @property
    def name(self) -> str:
        return self.path.rpartition("/")[2]


class Engine(Protocol):
    """One machine in one engine. `pins` and `slides` are read off the file; poses are rows of `bodies`, by path, of
    which `root` is the articulation's where the base is free."""

    hz: float
    root: str
    pins: Sequence[Pin]
    slides: Sequence[Slide]
    bodies: Mapping[str, int]

    def tell(self, targets: np.ndarray) -> None:
        """Targets (s,) of the slides, metres from the drawn pose, until others are told."""

    def push(self, path: str, force: np.ndarray, place: np.ndarray) -> None:
        """A force (3,) on a body at a place (3,) of the world, in the next step alone."""

    def burden(self, slide: int, mass: float) -> None:
        """Gives a slide an armature of so many kg."""

    def hold(self) -> None:
        """From now on a cylinder bears ten times its force, as one whose valves are shut."""

    def pace(self, hz: float) -> None:
        """From now on so many steps a second."""

    def step(self) -> None: ...

    def strokes(self) -> np.ndarray: ...

    def speeds(self) -> np.ndarray: ...

    def poses(self) -> np.ndarray:
        """Of bodies (b, 7)."""


def started(engine: str, machine: Path, world: World) -> Engine:
    """The machine of a USD file, as drawn and at rest."""
    warnings.simplefilter("ignore")
    return {"physx": PhysX, "newton": Newton, "mujoco": MuJoCo}[engine](machine, world)


def of_a_process(script: str, file: Path, *options: str) -> Any:
    """What a benchmark's `script` prints last, as JSON, of a file in a process of its own. `RuntimeError` with its last
    words where it fails."""
    ran = subprocess.run([sys.executable, script, str(file), *options], capture_output=True, text=True, check=False)
    if ran.returncode:
        last = ran.stderr.strip().splitlines() or ["?"]
        raise RuntimeError(f"fails: {last[-1][:80]} ({ran.returncode})")
    return json.loads(ran.stdout.strip().splitlines()[-1])


def turned(quaternions: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Vectors (n, 3) by quaternions (n, 4)."""
    axis, w = quaternions[:, :3], quaternions[:, 3:]
    across = 2.0 * np.cross(axis, vectors)
    return vectors + w * across + np.cross(axis, across)


def built(folder: Path, data: Path | None = None) -> list[Path]:
    """Both examples, built; with `data`, a folder with `zx120/zx120.glb`, that machine without a sheet, too."""
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


# ---- the scene -------------------------------------------------------------------------------------------------------
def stage_of(machine: Path, file: Path, world: World) -> Usd.Stage:
    """The scene, written to `file`: the machine, gravity, and ground if it stands on some."""
    stage = Usd.Stage.CreateNew(str(file))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    stage.SetDefaultPrim(stage.DefinePrim("/World", "Xform"))
    scene = UsdPhysics.Scene.Define(stage, "/World/scene")
    scene.CreateGravityDirectionAttr(Gf.Vec3f(*world.down))
    scene.CreateGravityMagnitudeAttr(GRAVITY if any(world.down) else 0.0)
    prim = scene.GetPrim()
    prim.AddAppliedSchema("PhysxSceneAPI")
    prim.CreateAttribute("physxScene:timeStepsPerSecond", Sdf.ValueTypeNames.UInt).Set(round(world.hz))
    if world.told:
        prim.AddAppliedSchema("MjcSceneAPI")
    for name, value in world.told.items():
        kind = Sdf.ValueTypeNames.Double if isinstance(value, float) else Sdf.ValueTypeNames.Token
        prim.CreateAttribute(name, kind).Set(value)
    if world.ground:
        _ground(stage)
    placed = stage.DefinePrim(MACHINE, "Xform")
    placed.GetReferences().AddReference(str(machine.resolve()))
    for name, choice in {"Base": world.base, **world.variants}.items():
        if choice:
            placed.GetVariantSet(name).SetVariantSelection(choice)
    if world.iterations is not None:
        name = "physxArticulation:solverPositionIterationCount"
        for each in (e for e in Usd.PrimRange(placed) if e.HasAPI(UsdPhysics.ArticulationRootAPI)):
            each.CreateAttribute(name, Sdf.ValueTypeNames.Int).Set(world.iterations)
    if not world.ground:
        # The base stands still and nothing else is there to touch: colliders have nothing to do.
        for path in [each.GetPath() for each in Usd.PrimRange(placed) if each.GetName() == "colliders"]:
            stage.GetPrimAtPath(path).SetActive(False)
    stage.Save()
    return stage


def _ground(stage: Usd.Stage) -> None:
    ground = UsdGeom.Plane.Define(stage, "/World/ground")
    ground.CreateAxisAttr("Z")
    UsdPhysics.CollisionAPI.Apply(ground.GetPrim())
    soil = UsdShade.Material.Define(stage, "/World/soil")
    friction = UsdPhysics.MaterialAPI.Apply(soil.GetPrim())
    friction.CreateStaticFrictionAttr(FRICTION)
    friction.CreateDynamicFrictionAttr(FRICTION)
    UsdShade.MaterialBindingAPI.Apply(ground.GetPrim()).Bind(soil, materialPurpose="physics")


def root_of(stage: Usd.Stage) -> str:
    """The articulation's: a body, or the joint that holds it."""
    return next(str(p.GetPath()) for p in stage.Traverse() if p.HasAPI(UsdPhysics.ArticulationRootAPI))


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


# ---- the engines -----------------------------------------------------------------------------------------------------
class PhysX:
    """Through `ovphysx`, on the CPU."""

    KINDS = ("POSITION", "VELOCITY", "POSITION_TARGET", "MAX_FORCE", "MAX_VELOCITY", "ARMATURE")

    def __init__(self, machine: Path, world: World) -> None:
        import newton_usd_schemas  # noqa: F401
        import ovphysx
        import ovstage
        import physx_usd_schemas  # noqa: F401
        from ovphysx.types import TensorType

        self.hz = world.hz
        ovphysx.PhysX.set_cpu_mode(True)
        # PhysX's schemas, which its stage asks for by name.
        found = metadata.distribution("physx-usd-schemas")
        names = ("PhysxSchema", "OmniUsdPhysicsDeformableSchema")
        own = [str(found.locate_file(f"physx_usd_schemas/{name}/resources")) for name in names]
        ovstage.population.register_usd_schemas([*own, str(ovphysx.newton_schema_root())])
        self._engine, self._stage = ovphysx.PhysX(), ovstage.Stage("plain")
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "world.usda"
            stage = stage_of(machine, file, world)
            self.pins, self.slides = read(stage)
            self.root = root_of(stage)
            paths = {p.GetName(): str(p.GetPath()) for p in stage.Traverse() if p.HasAPI(UsdPhysics.RigidBodyAPI)}
            ovstage.population.open_usd(self._stage, str(file), ordinal=1, domains=ovstage.PopulationDomain.ALL)
            self._stage.advance_write_floor(ordinal=1).wait()
            self._engine.wait_task(self._engine.attach_ovstage(self._stage, read_ordinal=1))
        # A step of full length first: what binds tensors takes one of a nanosecond else, over which rounding is speed.
        self._pushed = False
        self.step()

        def bound(kind: str) -> Any:
            return self._engine.create_tensor_binding(
                prim_paths=[self.root], tensor_type=TensorType[f"ARTICULATION_{kind}"]
            )

        self._links, self._pushes = bound("LINK_POSE"), bound("LINK_WRENCH")
        self._values = {kind: bound(f"DOF_{kind}") for kind in self.KINDS}
        self.rows = {kind: np.zeros(binding.shape, np.float32) for kind, binding in self._values.items()}
        self.dofs: Sequence[str] = self._values["POSITION"].dof_names
        columns = {name: number for number, name in enumerate(self.dofs)}
        self._own = [columns[slide.name] for slide in self.slides]
        self.bodies = {paths[name]: number for number, name in enumerate(self._links.body_names)}
        self._poses, self._wrenches = (np.zeros(b.shape, np.float32) for b in (self._links, self._pushes))

    def tell(self, targets: np.ndarray) -> None:
        self.rows["POSITION_TARGET"][0, self._own] = targets
        self.write("POSITION_TARGET")

    def limit(self, limits: EachWay) -> None:
        """Tells forces and speeds of the way that each joint goes now."""
        for kind in ("POSITION", "VELOCITY"):
            self._values[kind].read(self.rows[kind])
        at, moving, wanted = (self.rows[kind] for kind in ("POSITION", "VELOCITY", "POSITION_TARGET"))
        self.rows["MAX_FORCE"][:] = limits.forces_now(wanted, at, moving)
        self.rows["MAX_VELOCITY"][:] = limits.speeds_now(wanted, at)
        self.write("MAX_FORCE")
        self.write("MAX_VELOCITY")

    def write(self, kind: str) -> None:
        """What `rows` has of a kind; infinite limits as what the engine takes for one."""
        self._values[kind].write(np.minimum(self.rows[kind], 1e9).astype(np.float32))

    def push(self, path: str, force: np.ndarray, place: np.ndarray) -> None:
        self._wrenches[0, self.bodies[path]] = np.concatenate([force, np.zeros(3), place])
        self._pushed = True

    def burden(self, slide: int, mass: float) -> None:
        self._values["ARMATURE"].read(self.rows["ARMATURE"])
        self.rows["ARMATURE"][0, self._own[slide]] = mass
        self.write("ARMATURE")

    def hold(self) -> None:
        self._values["MAX_FORCE"].read(self.rows["MAX_FORCE"])
        self.rows["MAX_FORCE"][0, self._own] *= HELD
        self.write("MAX_FORCE")

    def pace(self, hz: float) -> None:
        self.hz = hz

    def step(self) -> None:
        if self._pushed:
            self._pushes.write(self._wrenches)
        self._engine.step_sync(1.0 / self.hz)
        if self._pushed:
            self._wrenches[:], self._pushed = 0.0, False

    def strokes(self) -> np.ndarray:
        return self._seen("POSITION")

    def speeds(self) -> np.ndarray:
        return self._seen("VELOCITY")

    def _seen(self, kind: str) -> np.ndarray:
        self._values[kind].read(self.rows[kind])
        return self.rows[kind][0, self._own].astype(float)

    def poses(self) -> np.ndarray:
        self._links.read(self._poses)
        return self._poses[0].astype(float)


class Newton:
    """Through `SolverMuJoCo`, on the CPU; a step is one of the solver's."""

    def __init__(self, machine: Path, world: World) -> None:
        import newton
        import newton_usd_schemas  # noqa: F401
        import physx_usd_schemas  # noqa: F401
        import warp

        self.hz = world.hz
        warp.config.quiet = True
        self._device = lambda: warp.ScopedDevice("cpu")
        with (
            tempfile.TemporaryDirectory() as folder,
            contextlib.redirect_stdout(io.StringIO()),
            self._device(),
        ):
            stage = stage_of(machine, Path(folder) / "world.usda", world)
            self.pins, self.slides = read(stage)
            self.root = root_of(stage)
            builder = newton.ModelBuilder()
            newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
            found = builder.add_usd(stage, load_visual_shapes=False)
            model = builder.finalize(device="cpu")
            self.solver: Any = newton.solvers.SolverMuJoCo(model, use_mujoco_cpu=True, **world.options)
            self._states, self._control = [model.state(), model.state()], model.control()
            newton.eval_fk(model, model.joint_q, model.joint_qd, self._states[0])
        self.bodies: Mapping[str, int] = found["path_body_map"]
        joints = [found["path_joint_map"][slide.path] for slide in self.slides]
        self._at, self._moving = (s.numpy()[joints] for s in (model.joint_q_start, model.joint_qd_start))
        self._centers = model.body_com.numpy().astype(float)

    def tell(self, targets: np.ndarray) -> None:
        self._control.joint_target_q.numpy()[self._at] = targets

    def push(self, path: str, force: np.ndarray, place: np.ndarray) -> None:
        number = self.bodies[path]
        pose = self.poses()[number]
        center = pose[:3] + turned(pose[None, 3:], self._centers[None, number])[0]
        self._states[0].body_f.numpy()[number] = np.concatenate([force, np.cross(place - center, force)])

    def burden(self, slide: int, mass: float) -> None:
        model = self.solver.mj_model
        model.dof_armature[model.joint(self.slides[slide].path.replace("/", "_")).dofadr[0]] = mass

    def hold(self) -> None:
        model = self.solver.mj_model
        _held(model, [model.joint(slide.path.replace("/", "_")).id for slide in self.slides])

    def pace(self, hz: float) -> None:
        self.hz = hz

    def step(self) -> None:
        with self._device():
            self._states[1].body_f.zero_()
            self.solver.step(self._states[0], self._states[1], self._control, None, 1.0 / self.hz)
        self._states.reverse()

    def strokes(self) -> np.ndarray:
        return self._states[0].joint_q.numpy()[self._at].astype(float)

    def speeds(self) -> np.ndarray:
        return self._states[0].joint_qd.numpy()[self._moving].astype(float)

    def poses(self) -> np.ndarray:
        return self._states[0].body_q.numpy().astype(float)


class MuJoCo:
    """On the exported MJCF; ground and gravity as its `scene.xml` has them, or none, and its base fixed."""

    def __init__(self, machine: Path, world: World) -> None:
        import mujoco

        self.hz = world.hz
        with tempfile.TemporaryDirectory() as folder:
            stage = stage_of(machine, Path(folder) / "world.usda", world)
            _, self.slides = read(stage)
            self.root = root_of(stage)
            paths = [str(p.GetPath()) for p in stage.Traverse() if p.HasAPI(UsdPhysics.RigidBodyAPI)]
            command: list[Any] = [sys.executable, "-m", "yellowiron", "export", machine, "--to", "mjcf"]
            subprocess.run([*command, "--out", Path(folder) / "mjcf"], check=True, capture_output=True)
            home = Path(folder) / "mjcf"
            if world.ground:
                spec = mujoco.MjSpec.from_file(str(home / "scene.xml"))
            else:
                spec = mujoco.MjSpec.from_file(
                    str(next(f for f in home.glob("*.xml") if f.name not in ("scene.xml", "lidar.xml")))
                )
                # The file's machine stands free; in the air it is held by its root.
                for joint in [j for j in spec.joints if j.type == mujoco.mjtJoint.mjJNT_FREE]:
                    spec.delete(joint)
                for key in list(spec.keys):
                    spec.delete(key)
            spec.option.timestep = 1.0 / world.hz
            spec.option.gravity = GRAVITY * np.array(world.down)
            self.model = model = spec.compile()
        self.data = mujoco.MjData(model)
        if world.ground:
            mujoco.mj_resetDataKeyframe(model, self.data, 0)
        if world.variants.get("Brakes") == "set":
            set_brakes(model)
        names = {model.body(n).name: n for n in range(model.nbody)}
        self.bodies = {path: names[end] for path in paths if (end := path.rpartition("/")[2]) in names}
        by_number = {number: path for path, number in self.bodies.items()}
        connects = [n for n in range(model.neq) if model.eq_type[n] == mujoco.mjtEq.mjEQ_CONNECT]
        self.pins = [
            Pin(
                model.equality(n).name,
                (by_number[int(model.eq_obj1id[n])], by_number[int(model.eq_obj2id[n])]),
                (model.eq_data[n, :3].copy(), model.eq_data[n, 3:6].copy()),
            )
            for n in connects
        ]
        # Slides go by the names of their prims; a control is in the lever's sense.
        joints = [model.joint(slide.name) for slide in self.slides]
        self._servos = [
            next(n for n in range(model.nu) if model.actuator_trnid[n, 0] == j.id and model.actuator_gainprm[n, 0] > 0)
            for j in joints
        ]
        self._signs = np.array([model.actuator_gear[n, 0] for n in self._servos])
        self._at = [int(j.qposadr[0]) for j in joints]
        self._moving = [int(j.dofadr[0]) for j in joints]
        self._step = mujoco.mj_step

    def tell(self, targets: np.ndarray) -> None:
        self.data.ctrl[self._servos] = self._signs * targets

    def push(self, path: str, force: np.ndarray, place: np.ndarray) -> None:
        number = self.bodies[path]
        torque = np.cross(place - self.data.xipos[number], force)
        self.data.xfrc_applied[number] = np.concatenate([force, torque])

    def burden(self, slide: int, mass: float) -> None:
        self.model.dof_armature[self._moving[slide]] = mass

    def hold(self) -> None:
        _held(self.model, [self.model.joint(slide.name).id for slide in self.slides])

    def pace(self, hz: float) -> None:
        self.hz = hz
        self.model.opt.timestep = 1.0 / hz

    def step(self) -> None:
        self._step(self.model, self.data)
        self.data.xfrc_applied[:] = 0.0

    def strokes(self) -> np.ndarray:
        return self.data.qpos[self._at].copy()

    def speeds(self) -> np.ndarray:
        return self.data.qvel[self._moving].copy()

    def poses(self) -> np.ndarray:
        return np.hstack([self.data.xpos, np.roll(self.data.xquat, -1, axis=1)])


def _held(model: Any, joints: list[int]) -> None:
    """MuJoCo's limits of force of these joints and of what drives them."""
    model.jnt_actfrcrange[joints] *= HELD
    model.actuator_forcerange[np.isin(model.actuator_trnid[:, 0], joints)] *= HELD


def set_brakes(model: Any) -> None:
    """As `docs/simulate.md` says: friction of the braked joints, and pads that touch."""
    for number in range(model.nnumeric):
        name = model.numeric(number).name
        if name.endswith(".brake"):
            dof = int(model.joint(name.removesuffix(".brake")).dofadr[0])
            model.dof_frictionloss[dof] = float(model.numeric(number).data[0])
    for number in range(model.ngeom):
        if model.geom(number).name.endswith(".pad"):
            model.geom_contype[number] = 1
