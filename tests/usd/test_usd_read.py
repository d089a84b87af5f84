"""A machine read back: what was written, what was edited since, and files that are none."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdPhysics

from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Mechanism
from yellowiron.usd import read_mechanism
from yellowiron.usd.authoring.metadata import to_json


def assert_same(found: Mechanism, expected: Mechanism) -> None:
    """Equal to 1e-9, all of it."""

    def compare(a, b, path: str) -> None:
        if isinstance(b, dict):
            assert a.keys() == b.keys(), path
            for key in b:
                compare(a[key], b[key], f"{path}.{key}")
        elif isinstance(b, list):
            assert len(a) == len(b), path
            for index, (x, y) in enumerate(zip(a, b, strict=True)):
                compare(x, y, f"{path}[{index}]")
        elif isinstance(b, float):
            assert a == pytest.approx(b, rel=1e-12, abs=1e-12), path
        else:
            assert a == b, path

    compare(json.loads(to_json(found)), json.loads(to_json(expected)), "mechanism")


@pytest.fixture
def copy(written: Path, tmp_path: Path) -> Path:
    folder = tmp_path / "copy"
    shutil.copytree(written, folder)
    return folder


@pytest.mark.parametrize("file", ["test_machine.usda", "scene.usda"])
def test_round_trip(written: Path, machine, file: str) -> None:
    assert_same(read_mechanism(written / file), machine.mechanism)


def test_round_trip_where_physics_is_switched_off(copy: Path, machine) -> None:
    stage = Usd.Stage.Open(str(copy / "test_machine.usda"))
    stage.GetDefaultPrim().GetVariantSet("Physics").SetVariantSelection("off")
    stage.GetDefaultPrim().GetVariantSet("Base").SetVariantSelection("fixed")
    stage.Save()
    assert_same(read_mechanism(copy / "test_machine.usda"), machine.mechanism)


def test_round_trip_of_a_moved_machine(copy: Path, machine) -> None:
    stage = Usd.Stage.Open(str(copy / "scene.usda"))
    from pxr import UsdGeom

    UsdGeom.XformCommonAPI(stage.GetPrimAtPath("/World/test_machine")).SetTranslate((100.0, 20.0, 3.0))
    UsdGeom.XformCommonAPI(stage.GetPrimAtPath("/World/test_machine")).SetRotate((0.0, 0.0, 30.0))
    stage.Save()
    assert_same(read_mechanism(copy / "scene.usda"), machine.mechanism)


def test_edited_attributes_win(copy: Path, machine) -> None:
    stage = Usd.Stage.Open(str(copy / "test_machine.usda"))
    joints = stage.GetDefaultPrim().GetChild("joints")
    UsdPhysics.RevoluteJoint(joints.GetChild("arm_joint")).GetUpperLimitAttr().Set(90.0)
    UsdPhysics.Joint(joints.GetChild("arm_joint")).GetLocalPos0Attr().Set((1.5, 0.0, 1.25))
    UsdPhysics.DriveAPI(joints.GetChild("wheel_l_joint"), "angular").GetDampingAttr().Set(10.0)
    UsdPhysics.MassAPI(stage.GetDefaultPrim().GetChild("cab")).GetMassAttr().Set(5.0)
    UsdPhysics.MassAPI(stage.GetDefaultPrim().GetChild("cab")).GetDiagonalInertiaAttr().Set((1.0, 1.0, 1.0))
    stage.Save()
    found = read_mechanism(copy / "test_machine.usda")
    assert found.joint("arm_joint").upper == pytest.approx(np.pi / 2, abs=1e-6)
    assert found.joint("arm_joint").lower == machine.mechanism.joint("arm_joint").lower
    assert found.joint("arm_joint").anchor == (1.5, 0.0, 1.25)
    assert found.joint("wheel_l_joint").drive.damping == pytest.approx(10.0 * 180 / np.pi)
    assert found.body("cab").mass == 5.0
    assert np.allclose(found.body("cab").inertia, np.eye(3))


def test_a_joint_that_was_deactivated_is_gone(copy: Path, machine) -> None:
    stage = Usd.Stage.Open(str(copy / "test_machine.usda"))
    stage.GetDefaultPrim().GetChild("joints").GetChild("rope").SetActive(False)
    stage.Save()
    found = read_mechanism(copy / "test_machine.usda")
    assert len(found.joints) == len(machine.mechanism.joints) - 1


def fails(path: Path, message: str) -> YellowironError:
    with pytest.raises(YellowironError, match=message) as raised:
        read_mechanism(path)
    assert raised.value.where
    assert raised.value.hint
    return raised.value


def test_no_such_file(tmp_path: Path) -> None:
    fails(tmp_path / "none.usda", "no such file")
    fails(tmp_path, "is a folder")


def test_no_usd(tmp_path: Path) -> None:
    (tmp_path / "a.usda").write_text("ISO-10303-21;")
    fails(tmp_path / "a.usda", "cannot be read as USD")
    (tmp_path / "a.usdc").write_bytes(b"PXR-USDC" + bytes(40))
    fails(tmp_path / "a.usdc", "cannot be read as USD")
    (tmp_path / "empty.usda").write_text("")
    fails(tmp_path / "empty.usda", "cannot be read as USD")
    (tmp_path / "a.step").write_text("")
    fails(tmp_path / "a.step", "not a USD file")


def test_usd_that_is_no_machine(tmp_path: Path) -> None:
    (tmp_path / "a.usda").write_text('#usda 1.0\ndef Xform "World" {}\n')
    fails(tmp_path / "a.usda", "no yellowiron machine")


@pytest.mark.parametrize("file", ["geometry.usdc", "base.usda", "physics.usda"])
def test_missing_payload(copy: Path, file: str, capfd: pytest.CaptureFixture[str]) -> None:
    (copy / "payloads" / file).unlink()
    error = fails(copy / "test_machine.usda", "refers to something that is not there")
    assert file in error.hint
    assert not capfd.readouterr().err, "USD's own lines, one a reference, drown the sentence"


def test_truncated_payload(copy: Path) -> None:
    path = copy / "payloads" / "physics.usda"
    path.write_text(path.read_text(encoding="utf-8")[:2000], encoding="utf-8")
    fails(copy / "test_machine.usda", "refers to something that is not there")


def test_another_format(copy: Path) -> None:
    path = copy / "test_machine.usda"
    path.write_text(path.read_text(encoding="utf-8").replace("int format = 1", "int format = 99"), encoding="utf-8")
    fails(path, "form 99")


def test_damaged_data(copy: Path) -> None:
    path = copy / "test_machine.usda"
    path.write_text(path.read_text(encoding="utf-8").replace('"barrel": "barrel"', '"barrel": '), encoding="utf-8")
    fails(path, "stored data is damaged")


def test_a_joint_to_nowhere(copy: Path) -> None:
    path = copy / "payloads" / "physics.usda"
    text = path.read_text(encoding="utf-8").replace("body1 = </test_machine/arm>", "body1 = </test_machine/leg>")
    path.write_text(text, encoding="utf-8")
    fails(copy / "test_machine.usda", "does not join two bodies")


def test_random_damage_is_an_error_of_ours_or_none(copy: Path) -> None:
    generator = np.random.default_rng(11)
    files = ["payloads/geometry.usdc", "payloads/base.usda", "payloads/physics.usda", "test_machine.usda"]
    for round_ in range(40):
        path = copy / files[round_ % len(files)]
        whole = path.read_bytes()
        data = np.frombuffer(whole, dtype=np.uint8).copy()
        data[generator.integers(0, len(data), size=10)] = generator.integers(0, 256, size=10)
        path.write_bytes(data.tobytes()[: generator.integers(1, len(data)) if round_ % 3 == 0 else None])
        try:
            read_mechanism(copy / "test_machine.usda")
        except YellowironError as error:
            assert error.where and error.hint
        path.write_bytes(whole)


def test_a_body_without_its_data(copy: Path) -> None:
    path = copy / "payloads" / "base.usda"
    path.write_text(
        path.read_text(encoding="utf-8").replace("double3 centerOfMass", "double3 centre"), encoding="utf-8"
    )
    fails(copy / "test_machine.usda", "data is damaged")
