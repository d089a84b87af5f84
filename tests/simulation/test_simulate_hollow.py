"""A ball dropped into the bucket stays in it, in every engine: with nothing of ours but the file."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest
from in_engines import need
from plain_engines import drop_ball, play, world_with

from yellowiron.exporters import export_mjcf
from yellowiron.kinematics import ClosedChain
from yellowiron.simulation.payload import tool
from yellowiron.simulation.registry import ENGINES
from yellowiron.usd import read_mechanism

pytestmark = pytest.mark.slow

RADIUS, MASS = 0.15, 30.0


def _fall(engine: str, file: Path, place: np.ndarray, gravity: np.ndarray, seconds: float, folder: Path) -> np.ndarray:
    need(engine)
    if engine != "mujoco":
        stage = world_with(file, gravity)
        ball = drop_ball(stage, place, RADIUS, MASS)
        return play(engine, stage, [ball], seconds)[ball]
    spec = mujoco.MjSpec.from_file(str(export_mjcf(read_mechanism(file), file, folder, base="fixed")))
    spec.option.gravity = 9.81 * gravity
    body = spec.worldbody.add_body(name="ball", pos=place)
    body.add_freejoint()
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(RADIUS, 0.0, 0.0), mass=MASS)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, round(seconds / model.opt.timestep))
    return np.array(data.body("ball").xpos)


def drop(engine: str, file: Path, folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Where the ball starts and where it is after three seconds, in the bucket's frame as drawn, from the lowest corner
    of its box. Gravity is turned instead of the bucket: it acts as on one that is rolled back."""
    mechanism = read_mechanism(file)
    bucket = tool(mechanism)
    (actuator,) = (a for a in mechanism.actuators if a.name == bucket.name)
    slide = mechanism.joint(actuator.joints[0].joint)
    chain = ClosedChain(mechanism)
    state, _ = chain.reach({slide.name: slide.upper})
    gravity = chain.displacement(state, bucket.name)[:3, :3].T @ (0.0, 0.0, -1.0)
    points = np.asarray(bucket.hull)
    low, high = points.min(axis=0), points.max(axis=0)
    # Half a radius off the middle, so as not to fall on an edge between two pieces.
    start = 0.5 * (low + high) + (0.0, 0.5 * RADIUS, 0.0) - 0.5 * gravity
    return start - low, _fall(engine, file, start, gravity, 3.0, folder) - low


@pytest.mark.parametrize("engine", list(ENGINES))
def test_the_bucket_is_hollow(engine: str, wheel_loader: Path, tmp_path: Path) -> None:
    size = np.ptp(np.asarray(tool(read_mechanism(wheel_loader)).hull), axis=0)
    start, rest = drop(engine, wheel_loader, tmp_path)
    assert np.all(rest > 0.0) and np.all(rest < size)
    assert abs(rest[1] - start[1]) < RADIUS
    # At the back of its floor, where it is lowest when rolled back, and not on a lid over its mouth or before it.
    assert rest[2] < 2.0 * RADIUS and rest[0] < 0.5 * size[0]
