"""Robot descriptions as machines: their joints compared with those found, as a template, and as a source of limits."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import yellowiron
from kit.builds import MadeOnce, reading_once
from kit.machines import small_machine
from yellowiron import cad, library, new_template
from yellowiron.alignment.discovery.robot import robot
from yellowiron.model.assembly import Assembly, DeclaredJoint

pytestmark = pytest.mark.usefixtures("no_pages", "cad_read_once")


def described(closing: str = "spherical") -> Assembly:
    """The small loader as a robot description: a link a body, its loop closed by a point, a camera frame on the boom,
    links without a shape between."""
    mechanism, assembly = small_machine.make()
    link = {p.part: f"{b.name}_link" for b in mechanism.bodies for p in b.parts}
    parts = tuple(replace(p, path=("robot", link[p.id])) for p in assembly.parts)
    joints = [
        DeclaredJoint(
            f"{j.name}_of_file", closing if j.cut else j.type, (f"{j.body0}_link", f"{j.body1}_link"), j.anchor,
            (1.0, 0.0, 0.0) if j.cut else j.axis, j.lower, j.upper,
        )
        for j in mechanism.joints
    ]  # fmt: skip
    nowhere, x = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)
    joints += [
        DeclaredJoint("base", "free", ("", "frame_link"), nowhere, x),
        DeclaredJoint("camera", "fixed", ("boom_link", "camera_link"), nowhere, x),
        DeclaredJoint("pan", "revolute", ("camera_link", "lens_link"), nowhere, x),
    ]
    return replace(assembly, parts=parts, joints=tuple(joints))


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> Callable[[Assembly], None]:
    """Stands in for the CAD file."""
    monkeypatch.setattr(cad, "check_file", lambda file: None)
    return lambda assembly: monkeypatch.setattr(cad, "read_cad", lambda file: assembly)


def test_bodies_and_joints_are_those_declared() -> None:
    machine = robot(described(), None)
    assert machine is not None
    kinds = {b.name: b.kind for b in machine.bodies}
    wheels = {f"{name}_link": "wheel" for name in small_machine.WHEELS}
    rest = {"frame_link": "frame", "rear_axle_link": "arm", "boom_link": "arm"}
    assert kinds == {**wheels, **rest, "barrel_link": "barrel", "rod_link": "rod"}
    assert machine.bodies[machine.root].name == "frame_link"
    assert sum(len(b.parts) for b in machine.bodies) == len(described().parts)
    assert {j.name for j in machine.joints} == {j.name for j in described().joints if j.name.endswith("_of_file")}
    closing = next(j for j in machine.joints if j.name == "boom_joint_of_file")
    assert closing.type == "revolute"
    assert abs(closing.direction[1]) == pytest.approx(1.0)
    loop = {f"{name}_of_file" for name in ("barrel_joint", "boom_joint", "slide", "rod_joint")}
    assert {j.name for j in machine.joints if j.loop} == loop
    assert [f.code for f in machine.findings] == ["ALN024"]


def test_without_joints_between_bodies_there_is_no_robot() -> None:
    assembly = described()
    fixed = tuple(replace(j, type="fixed") for j in assembly.joints)
    assert robot(replace(assembly, joints=fixed), None) is None


def test_a_template_from_declared_joints(drawn: Callable[[Assembly], None], tmp_path: Path) -> None:
    drawn(described())
    document = new_template("robot.urdf", tmp_path / "new")
    template = library.load_template(tmp_path / "new")
    assert library.lint(template).sound
    assert {r.name for r in template.roles if r.rigid} == {b["role"] for b in document["bodies"]}
    assert "boom_link" in {r.name for r in template.roles}
    assert {j.name for j in template.joints} == {j["name"] for j in document["joints"]}
    slide = template.joint("slide_of_file")
    assert slide.type == "prismatic"
    actuators = {a.name: a for a in template.actuators}
    assert [a.kind for a in actuators.values()] == ["cylinder", "motor"]
    joints = json.loads((tmp_path / "new" / "joints.json").read_text(encoding="utf-8"))
    assert joints["slide_of_file"]["source"].startswith("declared by the file")


@pytest.mark.slow
def test_a_robot_builds_with_its_own_axes_and_limits(drawn: Callable[[Assembly], None], tmp_path: Path) -> None:
    """Nothing is drawn but boxes: axes are where the file declares them, limits those of its joints."""
    drawn(described())
    new_template("robot.urdf", tmp_path / "new")
    machine = yellowiron.build(tmp_path / "new", Path("robot.urdf"), tmp_path / "out")
    mechanism, _ = small_machine.make()
    report = machine.document
    assert [f for f in report["findings"] if f["severity"] == "error"] == []
    assert report["mobility"]["computed"] == report["mobility"]["expected"]
    frame = np.array(report["frame"])
    found = {j["name"]: j for j in report["joints"]}
    for joint in mechanism.joints:
        one = found[f"{joint.name}_of_file"]
        axis = frame[:3, :3] @ np.array(joint.axis)
        assert np.linalg.norm(np.cross(one["axis"], axis)) < 1e-6, joint.name
        if joint.type == "revolute":
            anchor = frame[:3, :3] @ np.array(joint.anchor) + frame[:3, 3]
            assert np.linalg.norm(np.cross(np.subtract(one["anchor"], anchor), axis)) < 1e-6, joint.name
    slide = found["slide_of_file"]
    assert (slide["lower"], slide["upper"]) == pytest.approx((-0.1, small_machine.STROKE - 0.1))
    axle = found["axle_joint_of_file"]
    assert (axle["lower"], axle["upper"]) == pytest.approx((-0.25, 0.25))
    codes = {f["code"] for f in report["findings"]}
    assert {"MEC016", "MEC080", "MEC083"} <= codes
    assert all(d["agrees"] for d in report["declared_joints"] if d["name"] != "pan")


@pytest.mark.slow
def test_the_example_through_mjcf(built_loader: Any, made_once: MadeOnce, tmp_path: Path) -> None:
    """Exported as MJCF and read back: every joint agrees, a template from it is sound and builds."""
    from yellowiron.alignment import discover_declared
    from yellowiron.exporters import export_mjcf

    built = built_loader.mechanism
    robot_file = export_mjcf(built, built_loader.folder / "wheel_loader.usda", tmp_path / "mjcf")
    with reading_once(made_once, robot_file.parent):
        assert discover_declared(cad.read_cad(robot_file)).bodies[0].name == built.root
        new = new_template(robot_file, tmp_path / "new")
        machine = yellowiron.build(tmp_path / "new", robot_file, tmp_path / "out")
    assert {b["role"] for b in new["bodies"]} == {b.name for b in built.bodies}
    assert library.lint(library.load_template(tmp_path / "new")).sound
    report = machine.document
    assert [f for f in report["findings"] if f["severity"] == "error"] == []
    assert len(report["declared_joints"]) == len(built.joints)
    for one in report["declared_joints"]:
        assert one["agrees"], one
        assert (one["angle"] or 0.0) < math.radians(0.001)
        assert (one["distance"] or 0.0) < 1e-6
    cylinders = {c["slide"]: c for c in report["cylinders"]}
    for cylinder in built.cylinders:
        assert cylinders[cylinder.slide]["bore"] == pytest.approx(cylinder.bore, rel=1e-3)


@pytest.mark.slow
def test_a_robot_that_nobody_here_wrote(shared_data: Path, tmp_path: Path) -> None:
    """ZX120: ten joints are where they are found, two welds are hinges of its cylinders, and its loops are closed."""
    file = shared_data / "zx120" / "original" / "zx120.urdf"
    document = new_template(file, tmp_path / "new")
    assert {b["role"] for b in document["bodies"]} == {f"link{k}" for k in range(1, 14)}
    assert library.lint(library.load_template(tmp_path / "new")).sound
    report: dict[str, Any] = yellowiron.build(tmp_path / "new", file, tmp_path / "out").document
    assert [f for f in report["findings"] if f["severity"] == "error"] == []
    assert report["mobility"]["computed"] == report["mobility"]["expected"] == 4
    differ = {d["name"]: d["found"] for d in report["declared_joints"] if not d["agrees"]}
    assert differ == {"joint7": "revolute", "joint9": "revolute"}
    assert max(d["distance"] or 0.0 for d in report["declared_joints"]) < 1e-3
