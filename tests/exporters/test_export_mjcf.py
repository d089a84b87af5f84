"""MJCF: what is written is the machine, the same bytes every time, and MuJoCo runs it."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest

from kit.machines import small_machine
from yellowiron.exporters import Geometry, actuator_names, export_mjcf, read_geometry
from yellowiron.model.errors import MechanismError, YellowironError
from yellowiron.model.mechanism import Drive, Joint, Mechanism
from yellowiron.usd import read_mechanism


@pytest.fixture(scope="module")
def model(mjcf_file: Path) -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_path(str(mjcf_file))


def test_bodies_have_their_mass_inertia_and_place(model: mujoco.MjModel, mechanism: Mechanism) -> None:
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("drawn").id)
    mujoco.mj_forward(model, data)
    for body in mechanism.bodies:
        index = model.body(body.name).id
        assert model.body_mass[index] == pytest.approx(body.mass)
        assert data.xpos[index] == pytest.approx(body.origin, abs=1e-9)
        assert data.xipos[index] == pytest.approx(body.center_of_mass, abs=1e-6)
        axes = data.ximat[index].reshape(3, 3)
        inertia = axes @ np.diag(model.body_inertia[index]) @ axes.T
        assert inertia == pytest.approx(np.asarray(body.inertia), rel=1e-6, abs=1e-6)


def test_joints_are_hinges_and_slides_with_their_limits(model: mujoco.MjModel, mechanism: Mechanism) -> None:
    for joint in mechanism.joints:
        if joint.cut:
            assert model.equality(joint.name).type == mujoco.mjtEq.mjEQ_CONNECT
            continue
        made = model.joint(joint.name)
        assert (
            made.type[0]
            == {"revolute": mujoco.mjtJoint.mjJNT_HINGE, "prismatic": mujoco.mjtJoint.mjJNT_SLIDE}[joint.type]
        )
        assert made.axis == pytest.approx(joint.axis, abs=1e-9)
        if joint.lower is not None:
            assert made.range == pytest.approx((joint.lower, joint.upper))


def hydraulic(mechanism: Mechanism) -> tuple[Mechanism, Drive]:
    """The machine with a slide that is weaker and faster one way, and that drive."""
    drive = mechanism.joint("slide").drive
    assert drive is not None
    drive = dataclasses.replace(drive, max_force=9e3, reverse_force=5e3, max_velocity=0.1, reverse_velocity=0.16)
    joints = tuple(dataclasses.replace(j, drive=drive) if j.name == "slide" else j for j in mechanism.joints)
    return dataclasses.replace(mechanism, joints=joints), drive


def test_actuators_carry_gains_and_forces(mechanism: Mechanism, tmp_path: Path) -> None:
    changed, drive = hydraulic(mechanism)
    model = mujoco.MjModel.from_xml_path(str(export_mjcf(changed, Geometry(), tmp_path)))
    names = actuator_names(changed)
    assert names["boom"] == {"boom": "slide"}
    assert names["drive"] == {f"drive.{wheel}_joint": f"{wheel}_joint" for wheel in small_machine.WHEELS}
    boom, damper, slide = model.actuator("boom"), model.actuator("boom.damping"), model.joint("slide")
    assert boom.gainprm[0] == pytest.approx(drive.stiffness)
    assert boom.biasprm[2] == 0.0 and -damper.biasprm[2] == pytest.approx(drive.damping)
    assert model.jnt_actfrcrange[slide.id] == pytest.approx((-5e3, 9e3))
    assert boom.forcerange == pytest.approx((-0.16 * drive.damping, 0.1 * drive.damping))
    # What does nothing comes after what does.
    controls = [model.actuator(number).name for number in range(model.nu)]
    assert controls == [*(c for own in names.values() for c in own), "boom.damping"]


def test_a_drive_whose_damping_cannot_bring_its_force_to_bear_keeps_its_force(model: mujoco.MjModel) -> None:
    """Gains that were stated: the servo has both, and no rated speed."""
    boom = model.actuator("boom")
    assert boom.biasprm[2] < 0.0 and boom.forcerange[1] > 0.0 and -boom.forcerange[0] == boom.forcerange[1]
    assert model.nu == 5


@pytest.mark.parametrize("way", [-1, 1])
def test_a_target_far_away_is_reached_at_rated_speed_and_no_load_moves_it_past_its_force(
    mechanism: Mechanism, tmp_path: Path, way: int
) -> None:
    """A step to the stroke's end: by area and flow; against a wall: by area and pressure, each way its own."""
    changed, drive = hydraulic(mechanism)
    joint = changed.joint("slide")
    assert joint.lower is not None and joint.upper is not None
    model = mujoco.MjModel.from_xml_path(str(export_mjcf(changed, Geometry(), tmp_path, base="fixed")))
    model.opt.gravity[:] = 0.0
    data, slide = mujoco.MjData(model), model.joint("slide")
    data.ctrl[model.actuator("boom").id] = joint.upper if way > 0 else joint.lower
    fastest = 0.0
    for _ in range(300):
        mujoco.mj_step(model, data)
        fastest = max(fastest, way * float(data.qvel[slide.dofadr[0]]))
    rated, force = drive.speeds[way > 0], drive.forces[way > 0]
    assert 0.98 * rated <= fastest <= 1.02 * rated
    model.dof_armature[slide.dofadr[0]] = 1e9  # a wall
    mujoco.mj_resetData(model, data)
    data.ctrl[model.actuator("boom").id] = joint.upper if way > 0 else joint.lower
    mujoco.mj_step(model, data)
    assert way * data.qfrc_actuator[slide.dofadr[0]] == pytest.approx(force, rel=1e-6)


def test_a_negative_sign_turns_the_control_over(mechanism: Mechanism, tmp_path: Path) -> None:
    boom = mechanism.actuators[0]
    flipped = dataclasses.replace(boom, joints=(dataclasses.replace(boom.joints[0], sign=-1),))
    turned = dataclasses.replace(mechanism, actuators=(flipped, *mechanism.actuators[1:]))
    model = mujoco.MjModel.from_xml_path(str(export_mjcf(turned, Geometry(), tmp_path, base="fixed")))
    data = mujoco.MjData(model)
    model.opt.gravity[:] = 0.0
    data.ctrl[model.actuator("boom").id] = 0.05
    mujoco.mj_step(model, data, 2000)
    assert data.qpos[model.joint("slide").qposadr[0]] == pytest.approx(-0.05, abs=1e-4)


def test_the_same_bytes_every_time(mjcf_file: Path, usd_file: Path, tmp_path: Path) -> None:
    export_mjcf(read_mechanism(usd_file), usd_file, tmp_path)
    first = {
        p.relative_to(mjcf_file.parent): p.read_bytes() for p in sorted(mjcf_file.parent.rglob("*")) if p.is_file()
    }
    second = {p.relative_to(tmp_path): p.read_bytes() for p in sorted(tmp_path.rglob("*")) if p.is_file()}
    assert first == second


def test_equal_meshes_share_a_file(mjcf_file: Path) -> None:
    files = [p.read_bytes() for p in (mjcf_file.parent / "assets").iterdir()]
    assert len(set(files)) == len(files)


def test_wheels_are_cylinders_with_the_tyres_friction(model: mujoco.MjModel) -> None:
    geom = model.geom("front_wheel_l.WHEEL.collision")
    assert geom.type[0] == mujoco.mjtGeom.mjGEOM_CYLINDER
    assert geom.size[:2] == pytest.approx((small_machine.RADIUS, small_machine.WIDTH / 2))
    assert geom.friction[0] == pytest.approx(0.8)


def test_the_machine_does_not_collide_with_itself_and_can_be_made_to(mjcf_file: Path) -> None:
    document = ElementTree.parse(mjcf_file).getroot()
    collision = document.find(".//default[@class='collision']/geom")
    assert collision is not None and collision.get("conaffinity") == "0"
    excluded = {frozenset((e.get("body1"), e.get("body2"))) for e in document.iter("exclude")}
    assert frozenset(("frame", "boom")) in excluded


def test_the_scene_stands_still(mjcf_file: Path) -> None:
    model = mujoco.MjModel.from_xml_path(str(mjcf_file.with_name("scene.xml")))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("drawn").id)
    mujoco.mj_step(model, data, 3000)
    assert abs(data.qpos[2]) < 0.005
    assert np.abs(data.qvel[:6]).max() < 1e-3
    assert {model.geom(c.geom[0]).name for c in data.contact} == {"ground"}


def test_a_ball_dropped_into_the_box_stays_in(mjcf_file: Path, usd_file: Path, tmp_path: Path) -> None:
    file = export_mjcf(read_mechanism(usd_file), usd_file, tmp_path, base="fixed")
    spec = mujoco.MjSpec.from_file(str(file))
    ball = spec.worldbody.add_body(name="ball", pos=(3.0, 0.2, 2.2))
    ball.add_freejoint()
    ball.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.1, 0.0, 0.0), mass=20.0)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 3000)
    boom = model.body("boom").id
    inside = data.xmat[boom].reshape(3, 3).T @ (data.body("ball").xpos - data.xpos[boom]) + small_machine.ROD_PIN
    assert np.all(inside > (2.45, -0.6, 1.3)) and np.all(inside < (3.35, 0.6, 1.7))


def test_a_fixed_base_has_no_free_joint(usd_file: Path, tmp_path: Path) -> None:
    model = mujoco.MjModel.from_xml_path(str(export_mjcf(read_mechanism(usd_file), usd_file, tmp_path, base="fixed")))
    assert mujoco.mjtJoint.mjJNT_FREE not in model.jnt_type
    assert model.nkey == 1


@pytest.mark.parametrize(("kind", "rows"), [("spherical", 3), ("fixed", 6), ("revolute", 3)])
def test_every_cut_closes_its_loop(mechanism: Mechanism, tmp_path: Path, kind: str, rows: int) -> None:
    joints = tuple(dataclasses.replace(j, type=kind) if j.cut else j for j in mechanism.joints)
    file = export_mjcf(dataclasses.replace(mechanism, joints=joints), Geometry(), tmp_path, base="fixed")
    model = mujoco.MjModel.from_xml_path(str(file))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 500)
    assert data.ne == rows
    assert np.abs(data.efc_pos[:3]).max() < 1e-4


def test_a_distance_joint_is_a_tendon_of_its_greatest_length(mechanism: Mechanism, tmp_path: Path) -> None:
    rope = Joint("rope", "distance", "frame", "boom", (2.0, 0.0, 1.5), (0, 0, 1), 0.0, 0.1, cut=True)
    slack = dataclasses.replace(mechanism.joint("slide"), drive=None)
    joints = tuple(slack if j.name == "slide" else j for j in mechanism.joints)
    loose = dataclasses.replace(mechanism, joints=(*joints, rope))
    model = mujoco.MjModel.from_xml_path(str(export_mjcf(loose, Geometry(), tmp_path, base="fixed")))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 3000)
    assert data.ten_length[0] == pytest.approx(0.1, abs=0.02)


def test_balls_and_welds_in_the_tree(mechanism: Mechanism, tmp_path: Path) -> None:
    kinds = {"axle_joint": "fixed", "front_wheel_l_joint": "spherical"}
    joints = tuple(
        dataclasses.replace(j, type=kinds[j.name], drive=None) if j.name in kinds else j for j in mechanism.joints
    )
    model = mujoco.MjModel.from_xml_path(
        str(export_mjcf(dataclasses.replace(mechanism, joints=joints), Geometry(), tmp_path))
    )
    assert model.joint("front_wheel_l_joint").type[0] == mujoco.mjtJoint.mjJNT_BALL
    assert model.nq == 7 + 4 + 3 + 3


@pytest.mark.parametrize("kind", ["prismatic", "distance"])
def test_what_no_tree_can_be_made_of_is_said(mechanism: Mechanism, tmp_path: Path, kind: str) -> None:
    name = "boom_joint" if kind == "prismatic" else "barrel_joint"
    joints = tuple(dataclasses.replace(j, type=kind) if j.name == name else j for j in mechanism.joints)
    with pytest.raises(MechanismError, match=name):
        export_mjcf(dataclasses.replace(mechanism, joints=joints), Geometry(), tmp_path)


def test_a_body_without_a_joint_is_said(mechanism: Mechanism, tmp_path: Path) -> None:
    joints = tuple(j for j in mechanism.joints if j.name != "axle_joint")
    with pytest.raises(MechanismError, match="rear_axle"):
        export_mjcf(dataclasses.replace(mechanism, joints=joints), Geometry(), tmp_path)


def test_geometry_has_its_colliders_whatever_variant_is_chosen(usd_file: Path, tmp_path: Path) -> None:
    from pxr import Usd

    stage = Usd.Stage.CreateNew(str(tmp_path / "off.usda"))
    prim = stage.DefinePrim("/machine")
    prim.GetReferences().AddReference(str(usd_file))
    prim.GetVariantSet("Physics").SetVariantSelection("off")
    stage.GetRootLayer().Save()
    chosen, default = read_geometry(tmp_path / "off.usda"), read_geometry(usd_file)
    counts = [{n: len(g.colliders) for n, g in each.bodies.items()} for each in (chosen, default)]
    assert counts[0] == counts[1] and sum(counts[0].values()) > 5


@pytest.mark.parametrize("content", [None, "#usda 1.0\n", "no USD at all"])
def test_what_is_no_machine_is_said(tmp_path: Path, content: str | None) -> None:
    file = tmp_path / "machine.usda"
    if content is not None:
        file.write_text(content)
    with pytest.raises(YellowironError, match=r"machine\.usda"):
        read_geometry(file)


def test_what_is_seen_fills_the_bodies_extents(model: mujoco.MjModel, mechanism: Mechanism) -> None:
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    for body in mechanism.bodies:
        points = []
        for geom in range(model.ngeom):
            if model.geom_bodyid[geom] == model.body(body.name).id and model.geom_group[geom] == 2:
                mesh = model.geom_dataid[geom]
                first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
                turn = data.geom_xmat[geom].reshape(3, 3)
                points.append(model.mesh_vert[first : first + count] @ turn.T + data.geom_xpos[geom])
        seen, hull = np.concatenate(points), np.asarray(body.hull)
        assert seen.min(axis=0) == pytest.approx(hull.min(axis=0), abs=1e-5)
        assert seen.max(axis=0) == pytest.approx(hull.max(axis=0), abs=1e-5)
