"""Joints and drives as a physics engine reads them: frames, axes, limits, cuts, gains."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from pxr import Gf, Usd, UsdGeom, UsdPhysics

from yellowiron.usd.authoring.rotation import axis_of, principal_axes, quaternion_of, quaternion_to
from yellowiron.usd.layers.mujoco import armature
from yellowiron.usd.write import write_machine

UNIT = st.tuples(*(st.floats(-1, 1) for _ in range(3))).filter(lambda v: np.linalg.norm(v) > 1e-3)


@pytest.fixture(scope="module")
def stage(written: Path) -> Usd.Stage:
    return Usd.Stage.Open(str(written / "test_machine.usda"))


def joint_prim(stage: Usd.Stage, name: str) -> Usd.Prim:
    return next(p for p in stage.Traverse() if p.GetCustomDataByKey("yellowiron:name") == name)


def world_frame(stage: Usd.Stage, prim: Usd.Prim, side: int) -> tuple[np.ndarray, np.ndarray]:
    """Anchor and axes (columns) of one of a joint's two frames in the world."""
    joint = UsdPhysics.Joint(prim)
    relation = joint.GetBody0Rel() if side == 0 else joint.GetBody1Rel()
    (target,) = relation.GetTargets()
    body = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(stage.GetPrimAtPath(target))).T
    position = (joint.GetLocalPos0Attr() if side == 0 else joint.GetLocalPos1Attr()).Get()
    rotation = (joint.GetLocalRot0Attr() if side == 0 else joint.GetLocalRot1Attr()).Get()
    axes = np.array(Gf.Matrix3d(Gf.Rotation(Gf.Quatd(rotation)))).T
    return body[:3, :3] @ np.array(position) + body[:3, 3], body[:3, :3] @ axes


def test_both_frames_agree_and_carry_the_axis(stage: Usd.Stage, machine) -> None:
    for joint in machine.mechanism.joints:
        prim = joint_prim(stage, joint.name)
        (anchor0, axes0), (anchor1, axes1) = (world_frame(stage, prim, side) for side in (0, 1))
        assert np.abs(anchor0 - anchor1).max() < 1e-6
        assert np.abs(axes0 - axes1).max() < 1e-6
        assert np.abs(anchor0 - joint.anchor).max() < 1e-6
        assert np.abs(axes0[:, 0] - joint.axis).max() < 1e-6
        axis = prim.GetAttribute("physics:axis")
        assert not axis or axis.Get() == "X"


def test_types(stage: Usd.Stage) -> None:
    types = {
        "arm_joint": "PhysicsRevoluteJoint",
        "slide": "PhysicsPrismaticJoint",
        "铲斗 joint": "PhysicsSphericalJoint",
        "rope": "PhysicsDistanceJoint",
        "cab_joint": "PhysicsFixedJoint",
        "rod_joint": "PhysicsSphericalJoint",
    }
    assert {name: joint_prim(stage, name).GetTypeName() for name in types} == types


def test_limits_in_usd_units(stage: Usd.Stage) -> None:
    arm = UsdPhysics.RevoluteJoint(joint_prim(stage, "arm_joint"))
    assert arm.GetLowerLimitAttr().Get() == pytest.approx(math.degrees(-1 / 3))
    assert arm.GetUpperLimitAttr().Get() == pytest.approx(math.degrees(2 / 3))
    slide = UsdPhysics.PrismaticJoint(joint_prim(stage, "slide"))
    assert slide.GetLowerLimitAttr().Get() == pytest.approx(-1 / 7)
    assert slide.GetUpperLimitAttr().Get() == pytest.approx(1 / 3)
    rope = UsdPhysics.DistanceJoint(joint_prim(stage, "rope"))
    assert (rope.GetMinDistanceAttr().Get(), rope.GetMaxDistanceAttr().Get()) == (0.0, 0.25)
    ball = UsdPhysics.SphericalJoint(joint_prim(stage, "铲斗 joint"))
    assert ball.GetConeAngle0LimitAttr().Get() == pytest.approx(math.degrees(0.5))


def test_a_side_without_limit_has_no_attribute(stage: Usd.Stage) -> None:
    chain = UsdPhysics.RevoluteJoint(joint_prim(stage, "chain_joint"))
    assert not chain.GetLowerLimitAttr().HasAuthoredValue()
    assert chain.GetUpperLimitAttr().Get() == pytest.approx(math.degrees(0.1))
    wheel = UsdPhysics.RevoluteJoint(joint_prim(stage, "wheel_l_joint"))
    assert not wheel.GetLowerLimitAttr().HasAuthoredValue()
    assert not wheel.GetUpperLimitAttr().HasAuthoredValue()


def test_cut_is_a_spherical_connect_that_remembers_its_pin(stage: Usd.Stage) -> None:
    prim = joint_prim(stage, "rod_joint")
    assert UsdPhysics.Joint(prim).GetExcludeFromArticulationAttr().Get() is True
    assert "MjcEqualityConnectAPI" in prim.GetMetadata("apiSchemas").GetAppliedItems()
    assert tuple(prim.GetAttribute("mjc:solref").Get()) == (0.002, 1.0)
    assert tuple(prim.GetAttribute("mjc:solimp").Get()) == (0.9999, 0.9999, 0.001, 0.5, 2.0)
    data = prim.GetCustomDataByKey("yellowiron")
    assert (data["type"], data["lower"], data["upper"]) == ("revolute", -0.5, 0.5)
    assert tuple(data["axis"]) == (0.0, 1.0, 0.0)


def test_evidence_is_readable(stage: Usd.Stage) -> None:
    source = joint_prim(stage, "arm_joint").GetCustomDataByKey("yellowiron:source")
    assert source["method"] == "pin"
    assert list(source["parts"]) == ["MACHINE/ARM/bolt"]
    assert source["upper"]["page"] == 3


def test_position_drive_of_a_slide(stage: Usd.Stage) -> None:
    prim = joint_prim(stage, "slide")
    drive = UsdPhysics.DriveAPI(prim, "linear")
    assert prim.HasAPI(UsdPhysics.DriveAPI, "linear")
    assert drive.GetStiffnessAttr().Get() == pytest.approx(1e6 / 3)
    assert drive.GetDampingAttr().Get() == pytest.approx(1e4 / 7)
    assert drive.GetMaxForceAttr().Get() == pytest.approx(2.5e5)
    assert drive.GetTypeAttr().Get() == "force"
    assert prim.GetAttribute("physxJoint:maxJointVelocity").Get() == pytest.approx(1.05 * 0.31)
    assert prim.GetAttribute("physxJointAxis:linear:maxJointVelocity").Get() == pytest.approx(1.05 * 0.31)
    assert prim.GetAttribute("newton:velocityLimit").Get() == pytest.approx(1.05 * 0.31)


def test_who_leads_a_cylinder_is_a_variant(machine: Any, tmp_path: Path) -> None:
    """By targets it keeps to its slower way's speed in engines that know one, by levers to its faster way's."""
    made = machine.mechanism
    joints = tuple(
        replace(j, drive=replace(j.drive, reverse_velocity=0.5)) if j.name == "slide" and j.drive else j
        for j in made.joints
    )
    other = replace(made, joints=joints)
    file, *_ = write_machine(
        other, machine.assembly, tmp_path, name="machine", texture_folders=[machine.texture_folder]
    )
    stage = Usd.Stage.Open(str(file))
    chosen = stage.GetDefaultPrim().GetVariantSet("Actuation")
    assert chosen.GetVariantNames() == ["hydraulic", "position"] and chosen.GetVariantSelection() == "position"
    names = ("physxJoint:maxJointVelocity", "physxJointAxis:linear:maxJointVelocity", "newton:velocityLimit")
    for choice, speed in (("position", 0.31), ("hydraulic", 0.5)):
        chosen.SetVariantSelection(choice)
        limits = [joint_prim(stage, "slide").GetAttribute(name).Get() for name in names]
        assert limits == pytest.approx([1.05 * speed] * 3)


def test_velocity_drive_of_a_wheel_is_per_degree(stage: Usd.Stage) -> None:
    prim = joint_prim(stage, "wheel_l_joint")
    drive = UsdPhysics.DriveAPI(prim, "angular")
    assert not drive.GetStiffnessAttr().HasAuthoredValue()
    assert drive.GetDampingAttr().Get() == pytest.approx(500 / 3 * math.pi / 180)
    assert drive.GetMaxForceAttr().Get() == pytest.approx(9e3)
    assert prim.GetAttribute("physxJoint:maxJointVelocity").Get() == pytest.approx(math.degrees(4 / 3))


def test_free_and_passive_joints_have_no_drive(stage: Usd.Stage) -> None:
    for name in ("wheel_r_joint", "arm_joint", "rod_joint"):
        assert not [s for s in joint_prim(stage, name).GetAppliedSchemas() if s.startswith("PhysicsDriveAPI")]


def test_only_what_differs_from_the_schema_is_written(stage: Usd.Stage) -> None:
    for prim in stage.Traverse():
        for attribute in prim.GetAuthoredAttributes():
            name = attribute.GetName()
            # Mass properties are explicit, and a vector of zeros there is not the schema's "compute it".
            if name.startswith(("physics:", "drive:")) and prim.IsA(UsdPhysics.Joint):
                fallback = prim.GetPrimDefinition().GetAttributeFallbackValue(name)
                assert attribute.Get() != fallback, f"{prim.GetPath()}.{name}"


@given(UNIT)
def test_quaternion_to_axis(vector) -> None:
    axis = np.array(vector) / np.linalg.norm(vector)
    assert np.allclose(axis_of(quaternion_to(axis)), axis, atol=1e-9)


@pytest.mark.parametrize("axis", [*np.eye(3).tolist(), *(-np.eye(3)).tolist()])
def test_quaternions_to_the_frames_axes_are_exact_in_single_precision(axis) -> None:
    quaternion = quaternion_to(axis)
    assert set(map(abs, quaternion)) <= {0.0, 0.5, 1.0}
    assert axis_of(quaternion) == tuple(axis)


@given(st.lists(st.floats(-2, 2), min_size=9, max_size=9))
@example([0.0] * 7 + [1.0, 2.2947354899008246e-08])
def test_principal_axes_give_the_inertia_back(numbers) -> None:
    spread = np.array(numbers).reshape(3, 3)
    inertia = np.trace(spread.T @ spread) * np.eye(3) - spread.T @ spread
    moments, quaternion = principal_axes(inertia)
    # Not through Gf.Rotation: its arc cosine rounds a small turn to 3e-8 rad.
    axes = np.array(Gf.Matrix3d().SetRotate(Gf.Quatd(*quaternion))).T
    assert np.allclose(axes @ np.diag(moments) @ axes.T, inertia, atol=1e-9)
    assert np.linalg.det(axes) > 0


def test_principal_axes_of_a_diagonal_inertia_are_its_own() -> None:
    assert principal_axes(np.diag([3.0, 1.0, 2.0])) == ((3.0, 1.0, 2.0), (1.0, 0.0, 0.0, 0.0))


def test_quaternion_of_rotation_has_positive_first_component() -> None:
    half_turn = np.diag([-1.0, -1.0, 1.0])
    assert quaternion_of(half_turn) == pytest.approx((0.0, 0.0, 0.0, 1.0))


def test_position_drives_of_loops_have_an_inertia_that_newton_s_integrator_bears(stage: Usd.Stage, machine) -> None:
    """A millisecond of their damping, no more than their force brings to speed in 50 ms; nothing where no loop is."""
    slide = machine.mechanism.joint("slide")
    damped = replace(slide.drive, damping=4e6, max_force=1e5, max_velocity=0.5, reverse_velocity=None, armature=0.0)
    assert armature(replace(slide, drive=damped), machine.mechanism) == pytest.approx(4e3)
    weak = replace(damped, max_force=1e4)
    assert armature(replace(slide, drive=weak), machine.mechanism) == pytest.approx(0.05 * 1e4 / 0.5)
    heavy = replace(damped, armature=9e3)
    assert armature(replace(slide, drive=heavy), machine.mechanism) == 9e3
    motor = replace(damped, kind="velocity")
    assert armature(replace(slide, drive=motor), machine.mechanism) == 0.0
    tree = replace(machine.mechanism, joints=tuple(j for j in machine.mechanism.joints if not j.cut))
    assert armature(replace(slide, drive=damped), tree) == 0.0
    written = joint_prim(stage, "slide").GetAttribute("newton:armature")
    assert (written.Get() if written else 0.0) == pytest.approx(armature(slide, machine.mechanism))
