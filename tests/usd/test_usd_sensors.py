"""Sensors in USD: where they are, what Isaac Sim finds, and the way back."""

from __future__ import annotations

import math
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom

from yellowiron.model.sensor import Sensor
from yellowiron.usd import read_mechanism, write_machine

MACHINE = "/test_machine"


@pytest.fixture(scope="module")
def stage(written: Path) -> Usd.Stage:
    return Usd.Stage.Open(str(written / "test_machine.usda"))


@pytest.fixture(scope="module")
def by_name(machine) -> dict[str, Sensor]:
    return {s.name: s for s in machine.mechanism.sensors}


def prim_of(stage: Usd.Stage, name: str) -> Usd.Prim:
    found = [
        p
        for p in stage.Traverse()
        if (data := p.GetCustomDataByKey("yellowiron")) and (data.get("kind"), data.get("name")) == ("sensor", name)
    ]
    assert len(found) == 1
    return found[0]


def world(prim: Usd.Prim) -> tuple[np.ndarray, np.ndarray]:
    """Rotation (columns are axes) and position."""
    matrix = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(Usd.TimeCode.Default())
    return np.array(matrix.ExtractRotationMatrix()).T, np.array(matrix.ExtractTranslation())


def test_a_camera_looks_where_the_sensor_does(stage: Usd.Stage, by_name: dict[str, Sensor]) -> None:
    sensor = by_name["tip"]
    prim = prim_of(stage, "tip")
    assert prim.IsA(UsdGeom.Camera)
    axes, position = world(prim)
    assert np.allclose(position, sensor.position, atol=1e-12)
    assert np.allclose(-axes[:, 2], sensor.x_axis, atol=1e-9)
    assert np.allclose(axes[:, 1], sensor.z_axis, atol=1e-9)


def test_a_cameras_optics_are_real(stage: Usd.Stage, by_name: dict[str, Sensor]) -> None:
    parameters = by_name["tip"].parameters
    camera = UsdGeom.Camera(prim_of(stage, "tip")).GetCamera(Usd.TimeCode.Default())
    assert camera.GetFieldOfView(Gf.Camera.FOVHorizontal) == pytest.approx(
        math.degrees(parameters["horizontal_fov"]), rel=1e-5
    )
    assert camera.aspectRatio == pytest.approx(parameters["width"] / parameters["height"], rel=1e-6)
    assert camera.focalLength == pytest.approx(parameters["focal_length"] * 10.0)
    assert (camera.clippingRange.min, camera.clippingRange.max) == pytest.approx(
        (parameters["near"], parameters["far"])
    )


@pytest.mark.parametrize(
    ("name", "device"),
    [("roof lidar", "OmniLidar"), ("imu", "IsaacImuSensor"), ("斗 contact", "IsaacContactSensor"), ("gnss", None)],
)
def test_other_sensors_are_xforms_with_isaacs_prim_inside(
    stage: Usd.Stage, by_name: dict[str, Sensor], name: str, device: str | None
) -> None:
    prim = prim_of(stage, name)
    axes, position = world(prim)
    assert prim.GetTypeName() == "Xform"
    assert np.allclose(position, by_name[name].position, atol=1e-12)
    assert np.allclose(axes[:, 0], by_name[name].x_axis, atol=1e-9)
    assert np.allclose(axes[:, 2], by_name[name].z_axis, atol=1e-9)
    assert [c.GetTypeName() for c in prim.GetChildren()] == ([device] if device else [])


def test_the_lidars_scan_rate_is_its_tick_rate(stage: Usd.Stage) -> None:
    (device,) = prim_of(stage, "roof lidar").GetChildren()
    assert device.GetMetadata("apiSchemas").GetAppliedItems() == ["OmniSensorGenericLidarCoreAPI"]
    rates = [device.GetAttribute(f"omni:sensor:{n}").Get() for n in ("tickRate", "Core:scanRateBaseHz")]
    assert rates == [10.0, 10]


def test_encoders_and_pressure_are_on_their_joint(stage: Usd.Stage) -> None:
    data = stage.GetPrimAtPath(f"{MACHINE}/joints/slide").GetCustomDataByKey("yellowiron")
    assert {k: v["type"] for k, v in data["sensors"].items()} == {
        "stroke": "cylinder_encoder",
        "pressure": "cylinder_pressure",
    }
    assert data["type"] == "prismatic"


def test_a_layer_of_their_own_without_physics(written: Path) -> None:
    layer = Sdf.Layer.FindOrOpen(str(written / "payloads" / "sensors.usda"))
    names: list[str] = []
    layer.Traverse(Sdf.Path.absoluteRootPath, lambda path: names.append(str(path)))
    assert not [n for n in names if ".physics:" in n or ".physx" in n]
    contact = Sdf.Layer.FindOrOpen(str(written / "payloads" / "physx.usda")).GetPrimAtPath(f"{MACHINE}/铲斗")
    assert "PhysxContactReportAPI" in contact.GetInfo("apiSchemas").prependedItems


@pytest.mark.parametrize("physics", ["on", "off"])
def test_sensors_do_not_depend_on_the_variants(written: Path, machine, physics: str) -> None:
    stage = Usd.Stage.Open(str(written / "test_machine.usda"), Usd.Stage.LoadAll)
    stage.SetEditTarget(stage.GetSessionLayer())
    stage.GetDefaultPrim().GetVariantSet("Physics").SetVariantSelection(physics)
    found = [p for p in stage.Traverse() if (p.GetCustomDataByKey("yellowiron") or {}).get("kind") == "sensor"]
    assert len(found) == sum(bool(s.body) for s in machine.mechanism.sensors)


def test_a_machine_without_sensors_has_no_layer_for_them(machine, tmp_path: Path) -> None:
    bare = replace(machine.mechanism, sensors=())
    files = write_machine(bare, machine.assembly, tmp_path, name="bare", texture_folders=[machine.texture_folder])
    assert "sensors.usda" not in {f.name for f in files}
    assert read_mechanism(tmp_path / "bare.usda").sensors == ()


@pytest.fixture
def edited(written: Path, tmp_path: Path) -> Callable[[Callable[[Usd.Stage], None]], dict[str, Sensor]]:
    """The sensors that are read after a person's edit of the machine's file."""

    def _edit(change: Callable[[Usd.Stage], None]) -> dict[str, Sensor]:
        shutil.copytree(written, tmp_path / "out")
        path = tmp_path / "out" / "test_machine.usda"
        stage = Usd.Stage.Open(str(path))
        change(stage)
        stage.GetRootLayer().Export(str(tmp_path / "out" / "edited.usda"))
        return {s.name: s for s in read_mechanism(tmp_path / "out" / "edited.usda").sensors}

    return _edit


def test_a_moved_sensor_is_read_where_it_is(edited, by_name: dict[str, Sensor]) -> None:
    def move(stage: Usd.Stage) -> None:
        prim_of(stage, "imu").GetAttribute("xformOp:translate").Set(Gf.Vec3d(1.0, 2.0, 3.0))

    found = edited(move)
    assert found.pop("imu").position == (1.0, 2.0, 3.0)
    assert found == {name: s for name, s in by_name.items() if name != "imu"}


def test_a_changed_lens_is_read(edited, by_name: dict[str, Sensor]) -> None:
    def zoom(stage: Usd.Stage) -> None:
        camera = UsdGeom.Camera(prim_of(stage, "tip"))
        camera.GetFocalLengthAttr().Set(2.0 * camera.GetFocalLengthAttr().Get())

    before, after = by_name["tip"].parameters, edited(zoom)["tip"].parameters
    assert math.tan(after["horizontal_fov"] / 2) == pytest.approx(math.tan(before["horizontal_fov"] / 2) / 2, rel=1e-5)
    assert {k: v for k, v in after.items() if k not in ("horizontal_fov", "focal_length")} == {
        k: v for k, v in before.items() if k not in ("horizontal_fov", "focal_length")
    }


def test_a_removed_sensor_is_gone(edited, by_name: dict[str, Sensor]) -> None:
    found = edited(lambda stage: prim_of(stage, "gnss").SetActive(False))
    assert set(found) == set(by_name) - {"gnss"}
