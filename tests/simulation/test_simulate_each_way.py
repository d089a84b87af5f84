"""Forces and speeds of a cylinder in engines whose drives know one limit: with `EachWay` each way its own."""

from __future__ import annotations

import tempfile
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from in_engines import need
from plain_engines import world_with
from pxr import Usd, UsdPhysics

from kit.machines.simple_machines import write
from yellowiron.each_way import EachWay
from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, Drive, Joint, Mechanism
from yellowiron.support.record import CATCHING_UP
from yellowiron.usd import read_mechanism

PUSH, PULL, MASS, SLIDE = 8000.0, 5000.0, 400.0, "barrel2rod"
AHEAD = 0.4
"""Metres: so far that no drive of it leaves its limit."""


def cylinder() -> Mechanism:
    """A rod on a level slide."""

    def body(name: str, x: float) -> Body:
        return Body(name, (x, 0.0, 1.0), MASS, (x, 0.0, 1.0), 10.0 * np.eye(3), (), np.zeros((0, 3)))

    drive = Drive("position", 2e5, 1e3, PUSH, np.inf, reverse_force=PULL)
    slide = Joint(SLIDE, "prismatic", "barrel", "rod", (0, 0, 1), (1, 0, 0), -0.5, 0.5, drive=drive)
    return Mechanism(
        name="cylinder",
        equipment_type="test",
        root="barrel",
        bodies=(body("barrel", 0.0), body("rod", 0.5)),
        joints=(slide,),
        actuators=(Actuator("cylinder", "cylinder", (ActuatorJoint(SLIDE),)),),
    )


def test_the_limit_is_that_of_the_way_it_pushes() -> None:
    limits = EachWay.of(cylinder(), ["free", SLIDE, f"_World_machine_joints_{SLIDE}"])
    assert limits.ranges.tolist() == [[-np.inf, np.inf], [-PULL, PUSH], [-PULL, PUSH]]
    rest = np.zeros(3)
    two = limits.forces_now([[0.0, 0.1, -0.1], [0.0, -0.1, 0.1]], rest, rest)
    assert two.tolist() == [[np.inf, PUSH, PULL], [np.inf, PULL, PUSH]]
    # Its damping may pull where its spring pushes.
    assert limits.forces_now(rest + 0.01, rest, rest + 10.0)[1] == PULL


def test_a_coordinate_is_the_joint_whose_whole_name_it_ends_in() -> None:
    """A free joint whose name ends as a driven one's is not that one."""
    held = replace(cylinder().joints[0], name=f"other_{SLIDE}", drive=None)
    limits = EachWay.of(replace(cylinder(), joints=(*cylinder().joints, held)), [f"/joints/other_{SLIDE}", SLIDE])
    assert limits.forces.tolist() == [[np.inf, np.inf], [PULL, PUSH]]


def test_a_motor_is_told_speeds() -> None:
    motor = replace(cylinder().joints[0], drive=Drive("velocity", 0.0, 1e3, 300.0, 2.0, reverse_force=200.0))
    limits = EachWay.of(replace(cylinder(), joints=(motor,)), [SLIDE])
    assert limits.forces_now([1.0], [9.0], [2.0]).tolist() == [200.0]
    assert limits.forces_now([1.0], [-9.0], [0.0]).tolist() == [300.0]
    assert limits.speeds_now([-1.0], [-9.0]).tolist() == [2.0]


def test_the_speed_is_that_of_the_way_to_the_target() -> None:
    drive = Drive("position", 2e5, 1e3, PUSH, 0.3, reverse_velocity=0.5)
    limits = EachWay.of(replace(cylinder(), joints=(replace(cylinder().joints[0], drive=drive),)), [SLIDE, "free"])
    assert limits.speeds_now([[0.1, 0.0], [-0.1, 0.0]], [0.0, 0.0]).tolist() == [
        [CATCHING_UP * 0.3, np.inf],
        [CATCHING_UP * 0.5, np.inf],
    ]


@pytest.mark.parametrize("engine", ["physx", pytest.param("newton", marks=pytest.mark.slow)])
def test_an_engine_pushes_and_pulls_as_the_cylinder_does(tmp_path: Path, engine: str) -> None:
    need(engine)
    file = write(tmp_path, cylinder())
    limits = EachWay.of(read_mechanism(file), [SLIDE])
    run = {"physx": in_physx, "newton": in_newton}[engine]
    for target, alone, told in ((AHEAD, PUSH, PUSH), (-AHEAD, -PUSH, -PULL)):
        for given, expected in ((None, alone), (limits, told)):
            assert MASS * run(file, target, given) == pytest.approx(expected, rel=0.02)


def in_physx(file: Path, target: float, limits: EachWay | None) -> float:
    """Acceleration (m/s²) over twelve steps from rest."""
    import ovphysx
    import ovstage
    from ovphysx.types import TensorType

    from yellowiron.simulation.engines.physx import _prepare

    _prepare()
    physx, stage = ovphysx.PhysX(), ovstage.Stage("forces")
    with tempfile.TemporaryDirectory() as folder:
        scene, root = _scene(file, Path(folder))
        ovstage.population.open_usd(stage, str(scene), ordinal=1, domains=ovstage.PopulationDomain.ALL)
        stage.advance_write_floor(ordinal=1).wait()
        physx.wait_task(physx.attach_ovstage(stage, read_ordinal=1))
    kinds = ("POSITION", "VELOCITY", "POSITION_TARGET", "MAX_FORCE")
    step = 1.0 / 240.0
    physx.step_sync(step)
    try:
        return _pushed(
            {
                kind: physx.create_tensor_binding(prim_paths=[root], tensor_type=TensorType[f"ARTICULATION_DOF_{kind}"])
                for kind in kinds
            },
            lambda: physx.step_sync(step),
            step,
            target,
            limits,
        )
    finally:
        physx.destroy()
        stage.destroy()


def _pushed(
    bound: dict[str, object], step: Callable[[], None], seconds: float, target: float, limits: EachWay | None
) -> float:
    """In a function of its own, since PhysX cannot go while somebody holds what was read."""
    rows = {kind: np.zeros(binding.shape, np.float32) for kind, binding in bound.items()}  # type: ignore[attr-defined]
    rows["POSITION_TARGET"][:] = target
    bound["POSITION_TARGET"].write(rows["POSITION_TARGET"])  # type: ignore[attr-defined]
    speeds = []
    for _ in range(12):
        for kind in ("POSITION", "VELOCITY"):
            bound[kind].read(rows[kind])  # type: ignore[attr-defined]
        speeds.append(float(rows["VELOCITY"][0, 0]))
        if limits is not None:
            now = limits.forces_now(rows["POSITION_TARGET"], rows["POSITION"], rows["VELOCITY"])
            bound["MAX_FORCE"].write(now.astype(np.float32))  # type: ignore[attr-defined]
        step()
    return (speeds[-1] - speeds[0]) / (11 * seconds)


def in_newton(file: Path, target: float, limits: EachWay | None) -> float:
    """Acceleration (m/s²) over twelve steps from rest."""
    import newton
    import warp

    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as folder, warp.ScopedDevice("cpu"):
        scene, _ = _scene(file, Path(folder))
        builder = newton.ModelBuilder()
        newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
        builder.add_usd(str(scene))
        model = builder.finalize(device="cpu")
        solver = newton.solvers.SolverMuJoCo(model, use_mujoco_cpu=True)
        states, control = [model.state(), model.state()], model.control()
        newton.eval_fk(model, model.joint_q, model.joint_qd, states[0])
        if limits is not None:
            solver.mj_model.jnt_actfrcrange[:] = limits.ranges
        control.joint_target_q.numpy()[-1] = target
        speeds = []
        for _ in range(12):
            speeds.append(float(states[0].joint_qd.numpy()[-1]))
            solver.step(states[0], states[1], control, None, 1.0 / 240.0)
            states.reverse()
    return (speeds[-1] - speeds[0]) / (11 / 240.0)


def _scene(file: Path, folder: Path) -> tuple[Path, str]:
    stage: Usd.Stage = world_with(file, np.array([0.0, 0.0, -1.0]))
    stage.GetRootLayer().Export(str(folder / "world.usda"))
    root = next(str(p.GetPath()) for p in stage.Traverse() if p.HasAPI(UsdPhysics.ArticulationRootAPI))
    return folder / "world.usda", root
