"""The wheel loader example in MuJoCo, against the bars."""

from __future__ import annotations

import math
from pathlib import Path

import mujoco
import numpy as np
import pytest

from yellowiron.export import actuator_names, export_mjcf
from yellowiron.model.mechanism import Mechanism
from yellowiron.simulate import rated_payload, simulate
from yellowiron.simulate.driving import drive
from yellowiron.simulate.engine import Base
from yellowiron.usd import read_machine

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def loader(wheel_loader: Path) -> Mechanism:
    return read_machine(wheel_loader)


@pytest.mark.parametrize(("base", "bar"), [("fixed", 5e-5), ("floating", 1e-4)])
def test_full_strokes_with_the_rated_payload(wheel_loader: Path, loader: Mechanism, base: Base, bar: float) -> None:
    payload = rated_payload(loader)
    assert payload.mass > 5000.0
    result = simulate(wheel_loader, engine="mujoco", base=base, payload_kg=payload.mass, payload_source=payload.source)
    assert result.completed and result.branches_kept and len(result.branches) == 6
    assert result.pin_error <= bar
    assert result.angle_error <= math.radians(0.01)
    assert not result.findings, result.findings


def test_it_drives_turns_and_climbs(wheel_loader: Path) -> None:
    result = drive(wheel_loader, engine="mujoco")
    assert result.forward == pytest.approx(5.0, rel=0.03)
    assert result.backward == pytest.approx(5.0, rel=0.03)
    assert result.lock is not None and math.degrees(result.lock) == pytest.approx(40.0, abs=1.0)
    assert result.turning_radius == pytest.approx(result.geometry_radius, rel=0.05)
    assert result.axle_angle == pytest.approx(result.axle_geometry, rel=0.05)
    assert result.highest_wheel is not None and result.highest_wheel < 0.02


def test_the_bucket_is_hollow(wheel_loader: Path, loader: Mechanism, tmp_path: Path) -> None:
    """A ball dropped into the racked bucket stays in it."""
    file = export_mjcf(loader, wheel_loader, tmp_path, base="fixed")
    spec = mujoco.MjSpec.from_file(str(file))
    ball = spec.worldbody.add_body(name="ball")
    ball.add_freejoint(name="ball")
    ball.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.15, 0.0, 0.0), mass=30.0)
    model = spec.compile()
    data = mujoco.MjData(model)
    (control, joint), *_ = actuator_names(loader)["bucket"].items()
    data.ctrl[model.actuator(control).id] = loader.joint(joint).upper
    bucket = model.body("bucket").id
    local = np.asarray(loader.body("bucket").hull) - np.asarray(loader.body("bucket").origin)
    middle = 0.5 * (local.min(axis=0) + local.max(axis=0))
    place, speed = model.joint("ball").qposadr[0], model.joint("ball").dofadr[0]
    for _ in range(2500):
        over = data.xpos[bucket] + data.xmat[bucket].reshape(3, 3) @ middle + (0.0, 0.3, 1.2)
        data.qpos[place : place + 3], data.qvel[speed : speed + 6] = over, 0.0
        mujoco.mj_step(model, data)
    mujoco.mj_step(model, data, 4000)
    inside = data.xmat[bucket].reshape(3, 3).T @ (data.body("ball").xpos - data.xpos[bucket])
    assert np.all(inside > local.min(axis=0)) and np.all(inside < local.max(axis=0))
    assert float(np.linalg.norm(data.qvel[speed : speed + 3])) < 0.5
