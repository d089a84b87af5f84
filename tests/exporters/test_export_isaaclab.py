"""The configuration for Isaac Lab, read by stand-ins of its classes: joints, limits and gains are the machine's."""

from __future__ import annotations

import dataclasses
import math
import re
import runpy
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest
from pxr import Usd, UsdGeom

from kit.machines import small_machine
from yellowiron.exporters import export
from yellowiron.exporters.registry import unsaid
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.sensor import PARAMETERS, Sensor
from yellowiron.usd import read_mechanism, write_machine


class Cfg(SimpleNamespace):
    """Whatever Isaac Lab's configuration classes are given."""

    InitialStateCfg = OffsetCfg = SimpleNamespace


@pytest.fixture
def isaaclab(monkeypatch: pytest.MonkeyPatch) -> None:
    classes = {
        "sim": ["UsdFileCfg"],
        "actuators": ["ImplicitActuatorCfg"],
        "assets": ["ArticulationCfg"],
        "sensors": ["CameraCfg", "ContactSensorCfg", "ImuCfg"],
    }
    monkeypatch.setitem(sys.modules, "isaaclab", top := ModuleType("isaaclab"))
    for name, members in classes.items():
        module = ModuleType(f"isaaclab.{name}")
        for member in members:
            setattr(module, member, type(member, (Cfg,), {}))
        setattr(top, name, module)
        monkeypatch.setitem(sys.modules, f"isaaclab.{name}", module)


@pytest.fixture
def made(isaaclab: None, usd_file: Path, tmp_path: Path) -> dict[str, Any]:
    return runpy.run_path(str(export(read_mechanism(usd_file), usd_file, tmp_path / "lab", to="isaaclab")))


def test_every_joint_of_the_tree_is_in_one_group_as_isaac_lab_matches_them(
    made: dict[str, Any], mechanism: Mechanism
) -> None:
    robot = made["articulation"]("/there/machine.usda", base="fixed")
    assert robot.spawn.usd_path == "/there/machine.usda" and robot.spawn.variants == {"Base": "fixed", "Physics": "on"}
    tree = {j.name: j for j in mechanism.joints if not j.cut and j.type != "fixed"}
    owners: dict[str, list[str]] = {name: [] for name in tree}
    for group, actuator in robot.actuators.items():
        for expression in actuator.joint_names_expr:
            matched = [name for name in owners if re.fullmatch(expression, name)]
            assert matched
            for name in matched:
                owners[name].append(group)
    assert all(len(groups) == 1 for groups in owners.values())
    assert {name for name, (group,) in owners.items() if group == "passive"} == {
        name for name, joint in tree.items() if joint.drive is None
    }
    assert robot.actuators["boom"].stiffness is None and robot.init_state.joint_pos == {".*": 0.0}


def test_the_tables_are_the_machine_s(made: dict[str, Any], mechanism: Mechanism) -> None:
    drive = mechanism.joint("slide").drive
    assert drive is not None
    rated = made["RATED"]["slide"]
    assert rated["force"] == pytest.approx(list(drive.forces)) and rated["speed"] == pytest.approx(list(drive.speeds))
    assert (rated["stiffness"], rated["damping"]) == pytest.approx((drive.stiffness, drive.damping))
    assert made["LIMITS"]["slide"] == pytest.approx([mechanism.joint("slide").lower, mechanism.joint("slide").upper])
    assert made["CUTS"] == [j.name for j in mechanism.joints if j.cut]
    assert made["LEVERS"]["boom"] == {"slide": 1}


def test_sensors_are_prims_of_the_file(isaaclab: None, mechanism: Mechanism, tmp_path: Path) -> None:
    seen = {name: parameter.default for name, parameter in PARAMETERS["camera"].items()}
    turning = {name: parameter.default for name, parameter in PARAMETERS["imu"].items()}
    touched = {name: parameter.default for name, parameter in PARAMETERS["contact"].items()}
    sensed = dataclasses.replace(
        mechanism,
        sensors=(
            Sensor("eye", "camera", "boom", (0.5, 0.0, 1.0), parameters=seen),
            Sensor("ear", "imu", "frame", (0.1, 0.2, 0.9), (0.0, 1.0, 0.0), parameters=turning),
            Sensor("finger", "contact", "boom", parameters=touched),
        ),
    )
    file = write_machine(sensed, small_machine.make()[1], tmp_path / "usd", name="sensed")[0]
    made = runpy.run_path(str(export(read_mechanism(file), file, tmp_path / "lab", to="isaaclab")))
    stage = Usd.Stage.Open(str(file))
    sensors = made["sensors"](str(stage.GetDefaultPrim().GetPath()))
    assert list(sensors) == ["eye", "ear", "finger"]
    assert all(stage.GetPrimAtPath(sensor.prim_path) for sensor in sensors.values())
    assert stage.GetPrimAtPath(sensors["eye"].prim_path).IsA(UsdGeom.Camera)
    assert (sensors["eye"].width, sensors["eye"].height) == (1280, 720)
    frame = np.asarray(mechanism.body("frame").origin)
    assert frame + sensors["ear"].offset.pos == pytest.approx([0.1, 0.2, 0.9])
    assert np.abs(sensors["ear"].offset.rot) == pytest.approx([math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)])  # w, x, y, z


def test_what_it_cannot_say_is_said(mechanism: Mechanism) -> None:
    said = unsaid(mechanism, to="isaaclab")
    assert any("RATED" in sentence for sentence in said) and any("CUTS" in sentence for sentence in said)


def test_the_same_machine_gives_the_same_file(mechanism: Mechanism, usd_file: Path, tmp_path: Path) -> None:
    files = [export(mechanism, usd_file, tmp_path / name, to="isaaclab") for name in ("one", "two")]
    assert files[0].read_bytes() == files[1].read_bytes()
