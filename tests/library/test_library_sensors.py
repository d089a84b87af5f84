"""`sensors.json`: read, merged with a user's own, and every way it can be wrong."""

from __future__ import annotations

import json
import math
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from yellowiron import library
from yellowiron.model.errors import TemplateError
from yellowiron.model.sensor import FRAME_TYPES, PARAMETERS
from yellowiron.model.template import Template, choose

DATA = Path(__file__).resolve().parent.parent / "data" / "templates"


@pytest.fixture(scope="module")
def loader() -> Template:
    return library.load_template("wheel_loader")


def load(tmp_path: Path, sensors: dict[str, Any]) -> Template:
    folder = tmp_path / "lifter"
    shutil.copytree(DATA / "sound", folder)
    (folder / "sensors.json").write_text(json.dumps(sensors), encoding="utf-8")
    return library.load_template(folder)


def documents(tmp_path: Path, loader: Template, sensors: dict[str, Any]) -> Template:
    path = tmp_path / "mine.json"
    path.write_text(json.dumps(sensors), encoding="utf-8")
    return library.apply_sensors(loader, library.load_documents([path], loader))


def test_the_wheel_loader_has_one_of_every_type(loader: Template) -> None:
    assert {s.type for s in loader.sensors} == set(PARAMETERS)
    assert all(s.name for s in loader.sensors)


def test_units_and_spelling(tmp_path: Path) -> None:
    template = load(
        tmp_path,
        {"eye": {"Type": "Camera", "mount": {"Role": "BOOM", "position": ["100 mm", 0, 2], "orientation": [0, 90, 0]},
                 "parameters": {"Horizontal FOV": "60 deg", "far": 50}}},
    )  # fmt: skip
    (sensor,) = template.sensors
    assert (sensor.type, sensor.mount["role"]) == ("camera", "boom")
    assert sensor.mount["position"] == (0.1, 0.0, 2.0)
    assert sensor.mount["orientation"][1] == pytest.approx(math.pi / 2)
    assert sensor.parameters == {"horizontal_fov": pytest.approx(math.pi / 3), "far": 50.0}


def on_boom(**more: Any) -> dict[str, Any]:
    return {"eye": {"type": "camera", "mount": {"role": "boom"}, **more}}


WRONG = {
    "unknown type": ({"eye": {"type": "radar", "mount": {"role": "boom"}}}, "'radar'", "eye.type"),
    "no type": ({"eye": {"mount": {"role": "boom"}}}, "'type' is missing", "eye"),
    "no mount": ({"eye": {"type": "imu"}}, "'mount' is missing", "eye"),
    "unknown role": (on_boom(mount={"role": "bom"}), "no role 'bom'", "eye.mount.role"),
    "unknown site": (on_boom(mount={"site": "tip"}), "no site 'tip'", "eye.mount.site"),
    "a group": (on_boom(mount={"role": "lifter"}), "no role 'lifter'", "eye.mount.role"),
    "two places": (on_boom(mount={"role": "boom", "site": "tip"}), "names 2", "eye.mount"),
    "no place": (on_boom(mount={"at": [0, 0, 0]}), "names 0", "eye.mount"),
    "share": (on_boom(mount={"role": "boom", "at": [0, 0, 2]}), "at most 1", "eye.mount.at[2]"),
    "two positions": (on_boom(mount={"role": "boom", "at": [0, 0, 1], "position": [0, 0, 0]}), "either", "eye.mount"),
    "side": (on_boom(mount={"role": "boom", "on": "roof"}), "'roof'", "eye.mount.on"),
    "camera on a joint": (on_boom(mount={"joint": "base2boom_joint"}), "site or role", "eye.mount"),
    "position on a joint": (
        {"a": {"type": "joint_encoder", "mount": {"joint": "base2boom_joint", "at": [0, 0, 0]}}}, "no 'at'", "a.mount"),
    "slide that turns": (
        {"a": {"type": "cylinder_encoder", "mount": {"cylinder": "base2boom_joint"}}}, "slide", "a.mount.cylinder"),
    "unknown actuator": (
        {"a": {"type": "cylinder_pressure", "mount": {"actuator": "dig"}}}, "actuator", "a.mount.actuator"),
    "unknown parameter": (on_boom(parameters={"fov": 1}), "no parameter 'fov'", "eye.parameters.fov"),
    "out of range": (on_boom(parameters={"horizontal_fov": "200 deg"}), "170 degrees", "parameters.horizontal_fov"),
    "another dimension": (on_boom(parameters={"near": "2 kg"}), "'2 kg'", "eye.parameters.near"),
    "ends swapped": (on_boom(parameters={"near": 5, "far": 2}), "not below", "eye.parameters"),
    "unknown key": (on_boom(colour="red"), "'colour'", "eye"),
    "unknown variant": (on_boom(when={"booms": "two"}), "no variant 'booms'", "eye.when"),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_wrong_entries_are_one_sentence(case: str, tmp_path: Path) -> None:
    sensors, message, where = WRONG[case]
    with pytest.raises(TemplateError) as caught:
        load(tmp_path, sensors)
    assert message in caught.value.message
    assert caught.value.where.endswith(where)


def test_a_users_document_changes_and_adds(tmp_path: Path, loader: Template) -> None:
    template = documents(
        tmp_path,
        loader,
        {"Roof Lidar": {"parameters": {"channels": 64}},
         "tip_camera": {"type": "camera", "mount": {"site": "bucket_edge"}}},
    )  # fmt: skip
    before, after = ({s.name: s for s in t.sensors} for t in (loader, template))
    assert after["roof_lidar"].parameters == {**before["roof_lidar"].parameters, "channels": 64.0}
    assert after["roof_lidar"].mount == before["roof_lidar"].mount
    assert list(after) == [*before, "tip_camera"]


def test_a_document_that_gives_no_mount_to_a_new_sensor(tmp_path: Path, loader: Template) -> None:
    with pytest.raises(TemplateError, match="'mount' is missing"):
        documents(tmp_path, loader, {"eye": {"type": "camera"}})


def test_choices_keep_their_sensors(loader: Template) -> None:
    first, *others = loader.sensors
    one = replace(loader, sensors=(replace(first, when={"lift_cylinders": ("single",)}), *others))
    assert choose(one, {"lift_cylinders": "twin"}).sensors == tuple(others)
    assert len(choose(one, {"lift_cylinders": "single"}).sensors) == len(loader.sensors)


def test_a_place_that_some_choices_lack(loader: Template) -> None:
    """TPL018: twin cylinders' own joints are not there on a machine with a single one."""
    encoder = next(s for s in loader.sensors if s.type == "joint_encoder")
    mounted = replace(encoder, name="pin", mount={"joint": "boom2boom_piston_rod_l_joint"})
    report = library.lint(replace(loader, sensors=(mounted,)))
    assert {f.code for f in report.findings} == {"TPL018"}
    assert not library.lint(loader).findings


def test_defaults_lie_within_their_bounds() -> None:
    for parameters in PARAMETERS.values():
        for parameter in parameters.values():
            assert parameter.minimum <= parameter.default <= parameter.maximum
    assert set(FRAME_TYPES) < set(PARAMETERS)
