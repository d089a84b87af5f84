"""A USD file in an engine as any user of it would open it: nothing of ours but the file."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdPhysics

STEP = {"newton": 0.001, "physx": 1.0 / 120.0}


def play(engine: str, stage: Usd.Stage, bodies: Iterable[str], seconds: float) -> Mapping[str, np.ndarray]:
    """Positions (3,) of rigid bodies, by path, after a time."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "world.usda"
        stage.GetRootLayer().Export(str(file))
        return {"newton": _newton, "physx": _physx}[engine](file, list(bodies), math.ceil(seconds / STEP[engine]))


def _newton(file: Path, bodies: list[str], steps: int) -> Mapping[str, np.ndarray]:
    import newton
    import warp

    with warp.ScopedDevice("cpu"):
        builder = newton.ModelBuilder()
        newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
        found = builder.add_usd(str(file))
        model = builder.finalize(device="cpu")
        solver = newton.solvers.SolverMuJoCo(model, use_mujoco_cpu=True)
        before, after, control = model.state(), model.state(), model.control()
        newton.eval_fk(model, model.joint_q, model.joint_qd, before)
        for _ in range(steps):
            solver.step(before, after, control, None, STEP["newton"])
            before, after = after, before
        poses = before.body_q.numpy()
    return {path: poses[found["path_body_map"][path], :3] for path in bodies}


def _physx(file: Path, bodies: list[str], steps: int) -> Mapping[str, np.ndarray]:
    import ovphysx
    import ovstage
    from ovphysx.types import SimObjectType

    from yellowiron.simulation.engines.physx import _prepare

    _prepare()
    physx, world = ovphysx.PhysX(), ovstage.Stage("plain")
    try:
        ovstage.population.open_usd(world, str(file), ordinal=1, domains=ovstage.PopulationDomain.ALL)
        world.advance_write_floor(ordinal=1).wait()
        physx.wait_task(physx.attach_ovstage(world, read_ordinal=1))
        for _ in range(steps):
            physx.step_sync(STEP["physx"])
        found = {
            **_read(physx, world, SimObjectType.ARTICULATION_LINK),
            **_read(physx, world, SimObjectType.RIGID_BODY),
        }
        return {path: found[path] for path in bodies}
    finally:
        physx.destroy()
        world.destroy()


def _read(physx: Any, world: Any, kind: Any) -> dict[str, np.ndarray]:
    """In a function of its own, since PhysX cannot go while somebody holds what was read."""
    import ovstage
    from ovphysx.types import ObjectScope

    found: dict[str, np.ndarray] = {}
    with physx.read_sync(kind, ["position"], scope=ObjectScope.ALL) as read:
        for group in read.groups:
            paths = list(ovstage.PathDictionary(world).get_path_strings(group.prim_list))
            rows = np.concatenate([np.array(t.numpy(), dtype=np.float64).reshape(-1, 3) for t in group.tensors])
            found.update(zip(paths[group.prim_offset :][: group.prim_count], rows, strict=True))
    return found


def world_with(machine: Path, gravity: np.ndarray) -> Usd.Stage:
    """A machine held by its root under `/World/machine`, in a scene where things fall along a unit vector."""
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetDefaultPrim(stage.DefinePrim("/World", "Xform"))
    scene = UsdPhysics.Scene.Define(stage, "/World/scene")
    scene.CreateGravityDirectionAttr(Gf.Vec3f(*map(float, gravity)))
    scene.CreateGravityMagnitudeAttr(9.81)
    prim = stage.DefinePrim("/World/machine", "Xform")
    prim.GetReferences().AddReference(str(machine))
    prim.GetVariantSet("Base").SetVariantSelection("fixed")
    return stage


def drop_ball(stage: Usd.Stage, place: np.ndarray, radius: float, mass: float) -> str:
    """A ball to fall from a place; its path."""
    ball = UsdGeom.Sphere.Define(stage, "/World/ball")
    ball.CreateRadiusAttr(radius)
    ball.AddTranslateOp().Set(Gf.Vec3d(*map(float, place)))
    UsdPhysics.CollisionAPI.Apply(ball.GetPrim())
    UsdPhysics.RigidBodyAPI.Apply(ball.GetPrim())
    UsdPhysics.MassAPI.Apply(ball.GetPrim()).CreateMassAttr(mass)
    return str(ball.GetPath())
