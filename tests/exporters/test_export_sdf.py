"""SDFormat for Gazebo and for Drake: the same bodies and joints, loops closed by joints, by welds, by constraints."""

from __future__ import annotations

import json
import math
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from kit.builds import console
from kit.exported import read_sdf
from kit.machines import simple_machines as simple
from kit.machines import spatial_machine
from yellowiron.exporters import Geometry, JointStates, export, unsaid
from yellowiron.exporters.link_table import joints_document, links_of
from yellowiron.exporters.sdf.drake import export_drake
from yellowiron.exporters.sdf.gazebo import export_sdf
from yellowiron.kinematics import complete
from yellowiron.model.mechanism import Mechanism

NAMESPACE = "{http://drake.mit.edu}"


@pytest.fixture(scope="module")
def sdf(usd_file: Path, mechanism: Mechanism, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return export(mechanism, usd_file, tmp_path_factory.mktemp("sdf"), to="sdf")


@pytest.fixture(scope="module")
def drake(usd_file: Path, mechanism: Mechanism, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return export(mechanism, usd_file, tmp_path_factory.mktemp("drake"), to="drake")


@pytest.mark.parametrize("machine", ["small", "blade"])
def test_every_joint_cuts_too_is_where_the_machine_has_it(
    machine: str, sdf: Path, mechanism: Mechanism, tmp_path: Path
) -> None:
    made = mechanism if machine == "small" else complete(spatial_machine.blade_machine(spatial_machine.blade()))
    joints, poses = read_sdf(sdf if machine == "small" else export_sdf(made, Geometry(), tmp_path))
    read = {joint.name: joint for joint in joints}
    assert set(read) == {joint.name for joint in made.joints}
    kinds = {"revolute": "revolute", "prismatic": "prismatic", "spherical": "ball", "fixed": "fixed"}
    for joint in made.joints:
        found = read[joint.name]
        assert (found.kind, found.parent, found.child) == (kinds[joint.type], joint.body0, joint.body1)
        place = poses[found.child] @ found.place
        assert place[:3, 3] == pytest.approx(joint.anchor, abs=1e-9)
        if joint.type in ("revolute", "prismatic"):
            assert place[:3, :3] @ found.axis == pytest.approx(joint.axis, abs=1e-9)
            if joint.lower is not None:
                assert found.limits == pytest.approx((joint.lower, joint.upper))


def test_masses_meshes_friction_and_controllers(sdf: Path, mechanism: Mechanism) -> None:
    model = ET.parse(sdf).getroot().find("model")
    for body in mechanism.bodies:
        link = model.find(f"link[@name='{body.name}']")
        assert float(link.findtext("inertial/mass")) == pytest.approx(body.mass)
    assert float(model.findtext("link[@name='front_wheel_l']/collision/surface/friction/ode/mu")) == pytest.approx(0.8)
    files = [uri.text for uri in model.iter("uri")]
    assert files and all((sdf.parent / file).is_file() for file in files)
    drive = mechanism.joint("slide").drive
    assert drive is not None
    position = model.find("plugin[@name='gz::sim::systems::JointPositionController']")
    assert position.findtext("joint_name") == "slide"
    assert float(position.findtext("p_gain")) == pytest.approx(drive.stiffness)
    assert float(position.findtext("cmd_max")) == pytest.approx(drive.max_force)
    assert len(model.findall("plugin[@name='gz::sim::systems::JointController']")) == 4
    config = ET.parse(sdf.with_name("model.config")).getroot()
    assert config.findtext("sdf") == "model.sdf"


def test_the_welded_model_is_a_tree_whose_welds_close_the_same_loops(sdf: Path, mechanism: Mechanism) -> None:
    model = ET.parse(sdf.with_name("model_welds.sdf")).getroot().find("model")
    children = [joint.findtext("child") for joint in model.findall("joint")]
    assert len(set(children)) == len(children) == len(model.findall("link")) - 1
    _, poses = read_sdf(sdf.with_name("model_welds.sdf"))
    parents = {joint.findtext("child"): joint for joint in model.findall("joint")}
    welds = model.findall("plugin[@name='gz::sim::systems::DetachableJoint']")
    cuts = [joint for joint in mechanism.joints if joint.cut]
    assert len(welds) == len(cuts)
    for cut, weld in zip(cuts, welds, strict=True):
        pin = weld.findtext("parent_link")
        assert poses[pin][:3, 3] == pytest.approx(cut.anchor, abs=1e-9)
        assert parents[pin].findtext("parent") == cut.body0 and weld.findtext("child_link") == cut.body1


def test_drakes_constraints_hold_each_cut_at_its_pin(drake: Path, mechanism: Mechanism) -> None:
    model = ET.parse(drake).getroot().find("model")
    _, poses = read_sdf(drake)
    cuts = [joint for joint in mechanism.joints if joint.cut]
    held = model.findall(f"{NAMESPACE}ball_constraint")
    assert len(held) == len(cuts)
    for cut, constraint in zip(cuts, held, strict=True):
        for body, side, point in ((cut.body0, "A", "p_AP"), (cut.body1, "B", "p_BQ")):
            assert constraint.findtext(f"{NAMESPACE}ball_constraint_body_{side}") == body
            numbers = constraint.findtext(f"{NAMESPACE}ball_constraint_{point}").split()
            place = poses[body] @ np.array([*map(float, numbers), 1.0])
            assert place[:3] == pytest.approx(cut.anchor, abs=1e-9)


@pytest.mark.parametrize("kind", ["fixed", "revolute", "prismatic", "spherical", "distance"])
def test_every_joint_type_is_written_or_said_to_be_left_out(kind: str, tmp_path: Path) -> None:
    made = simple.with_joint(kind)
    names = {joint.name for joint in read_sdf(export_sdf(made, Geometry(), tmp_path))[0]}
    assert ("held" in names) == (kind != "distance")
    for to in ("sdf", "drake"):
        assert any("no distance joint" in words for words in unsaid(made, to=to)) == (kind == "distance")


@pytest.mark.parametrize("to", ["sdf", "drake"])
def test_the_same_bytes_every_time(to: str, usd_file: Path, mechanism: Mechanism, tmp_path: Path) -> None:
    for folder in ("one", "other"):
        export(mechanism, usd_file, tmp_path / folder, to=to)
    first, second = (
        {p.relative_to(f): p.read_bytes() for p in sorted(f.rglob("*")) if p.is_file()}
        for f in (tmp_path / "one", tmp_path / "other")
    )
    assert first == second


@pytest.mark.parametrize("machine", ["small", "blade"])
def test_drake_has_the_bodies_there_and_holds_the_loops(
    machine: str, drake: Path, mechanism: Mechanism, tmp_path: Path
) -> None:
    """Drake, where it is installed: poses to a micrometre; after a tenth of a second of its SAP solver pins are within
    a hundredth of a millimetre."""
    pydrake = pytest.importorskip("pydrake.all", reason="drake is not installed")
    made = mechanism if machine == "small" else complete(spatial_machine.blade_machine(spatial_machine.blade()))
    file = drake if machine == "small" else export_drake(made, Geometry(), tmp_path)
    document = joints_document(links_of(made))
    builder = pydrake.DiagramBuilder()
    plant, _ = pydrake.AddMultibodyPlantSceneGraph(builder, 0.001)
    plant.set_discrete_contact_approximation(pydrake.DiscreteContactApproximation.kSap)
    parser = pydrake.Parser(plant)
    parser.package_map().AddPackageXml(str(file.with_name("package.xml")))
    (model,) = parser.AddModels(str(file))
    plant.WeldFrames(plant.world_frame(), plant.GetFrameByName(document["root"]))
    plant.Finalize()
    assert plant.num_constraints() == len([cut for cut in made.joints if cut.cut])
    diagram = builder.Build()
    simulator = pydrake.Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.get_actuation_input_port().FixValue(context, np.zeros(plant.num_actuators()))
    wanted = plant.get_desired_state_input_port(model)
    wanted.FixValue(context, np.zeros(wanted.size()))
    simulator.AdvanceTo(0.1)
    frames = {
        link.name: plant.EvalBodyPoseInWorld(context, plant.GetBodyByName(link.name)).GetAsMatrix4()
        for link in links_of(made).links
    }
    for cut in document["cuts"]:
        ends = [frames[cut[s]] @ np.append(cut[f"in_{s}"], 1.0) for s in ("parent", "child")]
        assert math.dist(*ends) < 1e-5
    if machine == "small":
        states = JointStates(document)
        for name, value in states.positions({"boom": 0.05}).items():
            joint = plant.GetJointByName(name)
            (joint.set_translation if joint.type_name() == "prismatic" else joint.set_angle)(context, value)
        poses = states.poses()
        root = poses[document["root"]]
        for link, pose in poses.items():
            found = plant.EvalBodyPoseInWorld(context, plant.GetBodyByName(link)).GetAsMatrix4()
            assert root @ found == pytest.approx(pose, abs=1e-6)


def test_the_command_says_what_the_format_cannot(usd_file: Path, tmp_path: Path) -> None:
    plain = console("export", usd_file, "--to", "sdf", "--out", tmp_path / "plain", cwd=tmp_path)
    assert plain.returncode == 0 and "model_welds.sdf closes them" in " ".join(plain.stdout.split())
    told = console("export", usd_file, "--to", "urdf", "--out", tmp_path / "told", "--json", cwd=tmp_path)
    document = json.loads(told.stdout)
    assert Path(document["machine"]).is_file()
    assert [words for words in document["unsaid"] if words.startswith("URDF has no loops")]


def test_sdformats_own_reader_takes_both_models(sdf: Path) -> None:
    """libsdformat, which Drake has inside, where it is installed; Drake itself then takes no loops of joints."""
    pydrake = pytest.importorskip("pydrake.all", reason="drake is not installed")
    for name in ("model.sdf", "model_welds.sdf"):
        plant = pydrake.MultibodyPlant(0.001)
        assert len(pydrake.Parser(plant).AddModels(str(sdf.with_name(name)))) == 1
        assert plant.HasJointNamed("slide")
