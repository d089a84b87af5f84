"""Sensors in MJCF, read in MuJoCo."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from yellowiron.exporters import Geometry, export_mjcf
from yellowiron.model.mechanism import Mechanism, Site
from yellowiron.model.sensor import PARAMETERS, Sensor
from yellowiron.usd import read_mechanism

AXES = {"x_axis": (0.6, 0.0, -0.8), "z_axis": (0.8, 0.0, 0.6)}


def sensor(name: str, kind: str, **more: object) -> Sensor:
    parameters = {key: p.default for key, p in PARAMETERS[kind].items()}
    return Sensor(name, kind, parameters=parameters, **more)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def mechanism(usd_file: Path) -> Mechanism:
    plain = read_mechanism(usd_file)
    cylinder = plain.cylinders[0]
    cut = next(j for j in plain.joints if j.cut)
    turning = next(j for j in plain.joints if j.type == "revolute" and not j.cut)
    return replace(
        plain,
        sites=(*plain.sites, Site("gnss", plain.root, (0.0, 0.0, 1.0))),
        sensors=(
            sensor("eye", "camera", body=plain.root, position=(0.2, 0.1, 3.0), **AXES),
            sensor("lidar", "lidar", body=plain.root, position=(0.0, 0.0, 4.0)),
            sensor("imu", "imu", body=plain.root, position=(0.0, 0.0, 1.0), **AXES),
            sensor("gnss", "gnss", body=plain.root, position=(0.1, 0.2, 3.0)),
            sensor("touch", "contact", body=plain.joint("front_wheel_l_joint").body1),
            sensor("angle", "joint_encoder", joint=turning.name),
            sensor("cut angle", "joint_encoder", joint=cut.name),
            sensor("stroke", "cylinder_encoder", joint=cylinder.slide, cylinder=cylinder.name),
            sensor("pressure", "cylinder_pressure", joint=cylinder.slide, cylinder=cylinder.name),
        ),
    )


@pytest.fixture(scope="module")
def model(mechanism: Mechanism, usd_file: Path, tmp_path_factory: pytest.TempPathFactory) -> mujoco.MjModel:
    """On the ground, lidar included."""
    file = export_mjcf(mechanism, usd_file, tmp_path_factory.mktemp("sensing"))
    both = file.with_name("both.xml")
    both.write_text('<mujoco><include file="scene.xml"/><include file="lidar.xml"/></mujoco>')
    return mujoco.MjModel.from_xml_path(str(both))


@pytest.fixture(scope="module")
def settled(model: mujoco.MjModel) -> mujoco.MjData:
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    for _ in range(1500):
        mujoco.mj_step(model, data)
    return data


def test_the_camera_looks_where_the_sensor_does(model: mujoco.MjModel, mechanism: Mechanism) -> None:
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    camera = data.camera("eye")
    axes = camera.xmat.reshape(3, 3)
    eye = mechanism.sensors[0]
    assert camera.xpos == pytest.approx(eye.position)
    assert -axes[:, 2] == pytest.approx(eye.x_axis)
    assert axes[:, 1] == pytest.approx(eye.z_axis)
    index = model.camera("eye").id
    assert tuple(model.cam_resolution[index]) == (eye.parameters["width"], eye.parameters["height"])
    assert model.cam_fovy[index] < np.degrees(eye.parameters["horizontal_fov"])


def test_at_rest_an_imu_feels_gravity_in_its_own_axes(model: mujoco.MjModel, settled: mujoco.MjData) -> None:
    axes = settled.site("imu").xmat.reshape(3, 3)
    upward = axes.T @ np.array([0.0, 0.0, 9.81])
    assert settled.sensor("imu.acceleration").data == pytest.approx(upward, abs=0.3)
    assert np.abs(settled.sensor("imu.rotation").data).max() < 0.05


def test_a_wheel_on_the_ground_is_touched(settled: mujoco.MjData) -> None:
    assert settled.sensor("touch").data[0] > 0.0


def test_encoders_read_their_joints(mechanism: Mechanism, settled: mujoco.MjData) -> None:
    joints = {s.name: s.joint for s in mechanism.sensors}
    for name in ("angle", "stroke"):
        assert settled.sensor(name).data[0] == pytest.approx(settled.joint(joints[name]).qpos[0])
    assert settled.sensor("cut angle").data[0] == pytest.approx(1.0, abs=0.02)


def test_a_cylinder_holds_its_load(settled: mujoco.MjData, mechanism: Mechanism) -> None:
    slide = next(s.joint for s in mechanism.sensors if s.name == "pressure")
    assert settled.sensor("pressure").data[0] == pytest.approx(settled.joint(slide).qfrc_actuator[0])


def test_antennas_and_beams(model: mujoco.MjModel, settled: mujoco.MjData) -> None:
    assert settled.sensor("gnss").data == pytest.approx(settled.site("gnss.sensor").xpos)
    assert sum(model.sensor(i).name.startswith("lidar.") for i in range(model.nsensor)) == 36


def test_the_machine_alone_has_no_beams(mechanism: Mechanism, tmp_path: Path) -> None:
    file = export_mjcf(mechanism, Geometry(), tmp_path)
    model = mujoco.MjModel.from_xml_path(str(file))
    assert not [i for i in range(model.nsensor) if model.sensor(i).name.startswith("lidar")]
    bare = export_mjcf(replace(mechanism, sensors=()), Geometry(), tmp_path / "bare")
    assert not bare.with_name("lidar.xml").exists()
    assert mujoco.MjModel.from_xml_path(str(bare)).nsensor == 0
