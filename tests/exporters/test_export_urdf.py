"""URDF: a ROS 2 package whose tree, with the positions that its helper gives, is the machine over its full strokes."""

from __future__ import annotations

import dataclasses
import json
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
import trimesh

from kit.export_poses import BAR, helper, worst_of_strokes
from kit.exported import frame, read_urdf, urdf_poses
from kit.machines import simple_machines as simple
from kit.machines import small_machine, spatial_machine
from yellowiron.exporters import Geometry, JointStates, export, links_of, read_geometry, unsaid
from yellowiron.exporters.ros.joint_states import LockedError
from yellowiron.exporters.ros.urdf import export_urdf, package_name
from yellowiron.kinematics import complete
from yellowiron.model.errors import MechanismError
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.template import Follows
from yellowiron.usd import read_mechanism


@pytest.fixture(scope="module")
def urdf(usd_file: Path, mechanism: Mechanism, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return export(mechanism, usd_file, tmp_path_factory.mktemp("urdf"), to="urdf")


def test_over_the_full_strokes_every_body_is_where_the_kinematics_has_it(urdf: Path, mechanism: Mechanism) -> None:
    worst, gap, count = worst_of_strokes(urdf, mechanism, steps=9)
    assert count > 5 and worst < BAR and gap < BAR


@pytest.mark.slow
@pytest.mark.parametrize("machine", ["blade", "two arms", "brace", "drawbar"])
def test_balls_are_three_pivots_each_and_as_exact(machine: str, tmp_path: Path) -> None:
    made = {
        "blade": lambda: spatial_machine.blade_machine(spatial_machine.blade()),
        "two arms": lambda: spatial_machine.push_arms(dual=True),
        "brace": lambda: spatial_machine.push_arms(dual=False),
        "drawbar": lambda: spatial_machine.drawbar_machine(*spatial_machine.drawbar()),
    }[machine]()
    completed = complete(made)
    worst, gap, count = worst_of_strokes(export_urdf(completed, Geometry(), tmp_path), completed, steps=3)
    assert count >= 4 and worst < BAR and gap < BAR
    balls = [j.name for j in completed.joints if j.type == "spherical" and not j.cut]
    assert any("no ball" in words and balls[0] in words for words in unsaid(completed, to="urdf"))


def test_what_follows_is_a_mimic_of_its_first_leader(tmp_path: Path) -> None:
    mast = _mast()
    file = export_urdf(mast, Geometry(), tmp_path)
    worst, _, count = worst_of_strokes(file, mast, steps=5)
    assert count == 6 and worst < BAR  # five places, and as drawn
    mimic = ET.parse(file).getroot().find("joint[@name='carriage']/mimic")
    assert mimic is not None and mimic.attrib["joint"] == "lift"
    assert float(mimic.attrib["multiplier"]) == pytest.approx(-1.0) and float(mimic.attrib["offset"]) == 0.7


def test_links_have_mass_inertia_and_the_file_its_meshes(urdf: Path, mechanism: Mechanism) -> None:
    robot = ET.parse(urdf).getroot()
    drawn = urdf_poses(read_urdf(urdf), dict.fromkeys((j.name for j in read_urdf(urdf)), 0.0))
    for body in mechanism.bodies:
        inertial = robot.find(f"link[@name='{body.name}']/inertial")
        assert float(inertial.find("mass").attrib["value"]) == pytest.approx(body.mass)
        center = [float(v) for v in inertial.find("origin").attrib["xyz"].split()]
        assert drawn[body.name] @ np.append(center, 1.0) == pytest.approx([*body.center_of_mass, 1.0], abs=1e-9)
        assert float(inertial.find("inertia").attrib["iyy"]) == pytest.approx(body.inertia[1, 1])
    package = ET.parse(urdf.parent.parent / "package.xml").getroot().findtext("name")
    files = {mesh.attrib["filename"] for mesh in robot.iter("mesh")}
    assert files and all((urdf.parent.parent / f.removeprefix(f"package://{package}/")).is_file() for f in files)


def test_what_is_seen_stands_where_the_machine_file_has_it_in_its_colour(urdf: Path, usd_file: Path) -> None:
    robot = ET.parse(urdf).getroot()
    drawn = urdf_poses(read_urdf(urdf), dict.fromkeys((j.name for j in read_urdf(urdf)), 0.0))
    geometry = read_geometry(usd_file)
    mechanism = read_mechanism(usd_file)
    for body in mechanism.bodies:
        expected = [
            v.mesh.points @ v.matrix[:3, :3].T + v.matrix[:3, 3] + body.origin
            for v in geometry.bodies[body.name].visuals
        ]
        seen = robot.findall(f"link[@name='{body.name}']/visual")
        assert len(seen) == len(expected)
        for visual, points in zip(seen, expected, strict=True):
            file = urdf.parent.parent / visual.find("geometry/mesh").attrib["filename"].split("/", 3)[3]
            place = drawn[body.name] @ frame(**visual.find("origin").attrib)
            found = trimesh.load_mesh(file).vertices @ place[:3, :3].T + place[:3, 3]
            assert found.min(axis=0) == pytest.approx(points.min(axis=0), abs=1e-5)
            assert found.max(axis=0) == pytest.approx(points.max(axis=0), abs=1e-5)
            assert robot.find(f"material[@name='{visual.find('material').attrib['name']}']/color") is not None


def test_sites_and_sensors_are_frames(urdf: Path, mechanism: Mechanism) -> None:
    joints = read_urdf(urdf)
    drawn = urdf_poses(joints, dict.fromkeys((j.name for j in joints), 0.0))
    standing = [one for one in (*mechanism.sites, *mechanism.sensors) if one.body]
    assert standing
    for one in standing:
        name = next(j.child for j in joints if j.parent == one.body and j.child.startswith(one.name))
        assert drawn[name][:3, 3] == pytest.approx(one.position, abs=1e-9)
        assert drawn[name][:3, 0] == pytest.approx(one.x_axis, abs=1e-9)
        assert drawn[name][:3, 2] == pytest.approx(one.z_axis, abs=1e-9)


def test_limits_and_ros2_control_are_the_drives(urdf: Path, mechanism: Mechanism) -> None:
    robot = ET.parse(urdf).getroot()
    slide = mechanism.joint("slide")
    limit = robot.find("joint[@name='slide']/limit").attrib
    assert slide.drive is not None
    assert [float(limit[k]) for k in ("lower", "upper", "effort", "velocity")] == pytest.approx(
        [slide.lower, slide.upper, slide.drive.max_force, slide.drive.max_velocity]
    )
    commands = {
        joint.attrib["name"]: [c.attrib["name"] for c in joint.findall("command_interface")]
        for joint in robot.findall("ros2_control/joint")
    }
    wheels = {f"{wheel}_joint": ["velocity"] for wheel in small_machine.WHEELS}
    assert commands == {"slide": ["position"], **wheels}
    assert all(robot.find(f"joint[@name='{name}']").attrib["type"] == "continuous" for name in wheels)


def test_the_same_bytes_every_time(urdf: Path, usd_file: Path, mechanism: Mechanism, tmp_path: Path) -> None:
    export(mechanism, usd_file, tmp_path, to="urdf")
    first, second = (
        {p.relative_to(f): p.read_bytes() for p in sorted(f.rglob("*")) if p.is_file() and p.suffix != ".pyc"}
        for f in (urdf.parent.parent, tmp_path)
    )
    assert first == second


def test_the_helper_runs_alone_and_says_what_is_wrong(urdf: Path, tmp_path: Path) -> None:
    script = urdf.parent.parent / "scripts" / "joint_states.py"
    assert not re.search(r"^(from|import) yellowiron", script.read_text(encoding="utf-8"), re.MULTILINE)
    said = subprocess.run(
        [sys.executable, "-I", str(script), "boom=0.05"], capture_output=True, text=True, check=True, cwd=tmp_path
    ).stdout
    positions = json.loads(said)
    assert positions["slide"] == 0.05
    assert positions == JointStates(script.with_name("joints.json")).positions({"boom": 0.05})
    states = JointStates(script.with_name("joints.json"))
    with pytest.raises(KeyError, match="'arm' is no lever"):
        states.positions({"arm": 0.1})
    states.positions({"boom": 0.05})
    with pytest.raises(LockedError, match="locks after"):
        states.positions({"boom": 50.0})
    assert states.positions({}) == pytest.approx(positions)
    wrong = subprocess.run([sys.executable, "-I", str(script), "boom=much"], capture_output=True, text=True)
    assert wrong.returncode == 1 and "Traceback" not in wrong.stderr


def test_a_wheel_far_on_is_there_at_once(urdf: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is on no loop is not stepped: a thousand turns are one solve."""
    states = JointStates(urdf.parent.parent / "scripts" / "joints.json")
    solved: list[int] = []
    close = states._close
    monkeypatch.setattr(states, "_close", lambda position: (solved.append(1), close(position))[1])
    positions = states.positions({"drive": 6283.0})
    assert len(solved) == 1 and positions["front_wheel_l_joint"] == 6283.0 and states.gap() < BAR


def test_a_levers_sign_turns_the_stroke_over(mechanism: Mechanism, tmp_path: Path) -> None:
    boom = mechanism.actuators[0]
    flipped = dataclasses.replace(boom, joints=(dataclasses.replace(boom.joints[0], sign=-1),))
    turned = dataclasses.replace(mechanism, actuators=(flipped, *mechanism.actuators[1:]))
    export_urdf(turned, Geometry(), tmp_path)
    states = helper(tmp_path / "scripts" / "joint_states.py").JointStates(tmp_path / "scripts" / "joints.json")
    assert states.positions({"boom": 0.05})["slide"] == -0.05


def test_names_are_free_and_the_package_is_named_as_ros_wants(mechanism: Mechanism) -> None:
    joints = (dataclasses.replace(j, name="boom") if j.name == "slide" else j for j in mechanism.joints)
    twice = dataclasses.replace(mechanism, joints=tuple(joints))
    table = links_of(dataclasses.replace(twice, actuators=(), cylinders=(), loops=()))
    names = [link.name for link in table.links] + [e.name for e in (*table.tree, *table.cuts)]
    assert len(set(names)) == len(names)
    assert package_name("Wheel-Loader 2") == "wheel_loader_2_description"
    assert package_name("320") == "machine_320_description"


def test_no_tree_is_said(mechanism: Mechanism, tmp_path: Path) -> None:
    uncut = dataclasses.replace(mechanism, joints=tuple(dataclasses.replace(j, cut=False) for j in mechanism.joints))
    with pytest.raises(MechanismError, match="two tree joints lead"):
        export_urdf(uncut, Geometry(), tmp_path)
    with pytest.raises(MechanismError, match="no joint leads"):
        export_urdf(dataclasses.replace(mechanism, joints=()), Geometry(), tmp_path)


@pytest.mark.parametrize("kind", ["fixed", "revolute", "prismatic", "spherical", "distance"])
def test_every_joint_type_is_written(kind: str, tmp_path: Path) -> None:
    made = simple.with_joint(kind)
    written = {joint.name: joint.kind for joint in read_urdf(export_urdf(made, Geometry(), tmp_path))}
    expected = {"fixed": "fixed", "revolute": "continuous", "prismatic": "prismatic", "distance": None}
    if kind == "spherical":
        assert {n for n in written if n.startswith("held")} == {"held_pitch", "held_roll", "held_yaw"}
    else:
        assert written.get("held") == expected[kind]


def test_others_read_it(urdf: Path) -> None:
    """Pinocchio, where it is installed, has the links where our reading has them."""
    pinocchio = pytest.importorskip("pinocchio", reason="pin is not installed")
    states = JointStates(urdf.parent.parent / "scripts" / "joints.json")
    positions = states.positions({"boom": 0.05, "drive": 0.4})
    model = pinocchio.buildModelFromUrdf(str(urdf))
    data, values = model.createData(), pinocchio.neutral(model)
    for name, value in positions.items():
        joint = model.joints[model.getJointId(name)]
        values[joint.idx_q : joint.idx_q + joint.nq] = [value] if joint.nq == 1 else [np.cos(value), np.sin(value)]
    pinocchio.framesForwardKinematics(model, data, values)
    for link, pose in urdf_poses(read_urdf(urdf), positions).items():
        assert data.oMf[model.getFrameId(link)].homogeneous == pytest.approx(pose, abs=1e-9)


def test_mujoco_reads_it(urdf: Path, mechanism: Mechanism, tmp_path: Path) -> None:
    """MuJoCo's own URDF reader, told where the meshes are: the same poses and the same mass."""
    import mujoco

    package = urdf.parent.parent
    words = urdf.read_text(encoding="utf-8").replace(f"package://{package_name(mechanism.name)}/meshes/", "")
    settings = f'<mujoco><compiler meshdir="{package / "meshes"}" fusestatic="false" discardvisual="true"/></mujoco>'
    words = re.sub(r"(<robot [^>]*>)", rf"\1{settings}", words, count=1)
    (tmp_path / "machine.urdf").write_text(words, encoding="utf-8")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "machine.urdf"))
    data = mujoco.MjData(model)
    positions = JointStates(package / "scripts" / "joints.json").positions({"boom": 0.05, "drive": 0.4})
    for name, value in positions.items():
        data.joint(name).qpos[0] = value
    mujoco.mj_kinematics(model, data)
    for link, pose in urdf_poses(read_urdf(urdf), positions).items():
        if link != "base_link":
            assert data.body(link).xpos == pytest.approx(pose[:3, 3], abs=1e-9)
            assert data.body(link).xmat.reshape(3, 3) == pytest.approx(pose[:3, :3], abs=1e-9)
    assert model.body_mass.sum() == pytest.approx(sum(body.mass for body in mechanism.bodies))


def _mast() -> Mechanism:
    from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, Drive, Joint

    def body(name: str) -> Body:
        return Body(name, (0.0, 0.0, 1.0), 100.0, (0.0, 0.0, 1.0), 10.0 * np.eye(3), (), np.zeros((0, 3)))

    up, names = (0.0, 0.0, 1.0), ("outer", "middle", "inner", "fork")
    drive = Drive("position", 1e6, 1e5, 1e5, 0.5)
    joints = (
        Joint("lift", "prismatic", "outer", "middle", (0, 0, 1), up, 0.0, 1.5, drive=drive),
        Joint("inner", "prismatic", "middle", "inner", (0, 0, 1), up, follows=Follows("lift", -2.0, 1.0)),
        Joint("carriage", "prismatic", "inner", "fork", (0, 0, 1), up, follows=Follows("inner", 0.5, 0.2)),
    )
    lift = Actuator("lift", "cylinder", (ActuatorJoint("lift"),))
    return Mechanism("mast", "mast", "outer", tuple(map(body, names)), joints, actuators=(lift,))
