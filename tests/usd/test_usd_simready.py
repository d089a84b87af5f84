"""SimReady and Isaac rules that the validators miss (docs/validators.md names them)."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdPhysics


@pytest.fixture(scope="module", params=["floating", "fixed"])
def stage(written: Path, request: pytest.FixtureRequest) -> Usd.Stage:
    stage = Usd.Stage.Open(str(written / "test_machine.usda"))
    stage.SetEditTarget(stage.GetSessionLayer())
    stage.GetDefaultPrim().GetVariantSet("Base").SetVariantSelection(request.param)
    return stage


def joints(stage: Usd.Stage) -> list[UsdPhysics.Joint]:
    return [UsdPhysics.Joint(p) for p in stage.Traverse() if p.IsA(UsdPhysics.Joint)]


def drives(stage: Usd.Stage) -> list[tuple[Usd.Prim, str]]:
    found = []
    for joint in joints(stage):
        for schema in (
            joint.GetPrim().GetMetadata("apiSchemas").GetAppliedItems()
            if joint.GetPrim().HasMetadata("apiSchemas")
            else []
        ):
            if schema.startswith("PhysicsDriveAPI:"):
                found.append((joint.GetPrim(), schema.split(":")[1]))
    assert found
    return found


def bodies(stage: Usd.Stage) -> list[Usd.Prim]:
    return [p for p in stage.Traverse() if p.HasAPI(UsdPhysics.RigidBodyAPI)]


def test_ba001_one_articulation_root(stage: Usd.Stage) -> None:
    assert sum(p.HasAPI(UsdPhysics.ArticulationRootAPI) for p in stage.Traverse()) == 1


def test_dj001_force_and_dj005_velocity_are_positive(stage: Usd.Stage) -> None:
    for prim, instance in drives(stage):
        assert 0 < UsdPhysics.DriveAPI(prim, instance).GetMaxForceAttr().Get() < math.inf
        for name in ("physxJoint:maxJointVelocity", "newton:velocityLimit"):
            assert 0 < prim.GetAttribute(name).Get() < math.inf


def test_dj003_joint_frames_agree(stage: Usd.Stage) -> None:
    cache = UsdGeom.XformCache()
    for joint in joints(stage):
        frames = []
        for rel, position, rotation in (
            (joint.GetBody0Rel(), joint.GetLocalPos0Attr(), joint.GetLocalRot0Attr()),
            (joint.GetBody1Rel(), joint.GetLocalPos1Attr(), joint.GetLocalRot1Attr()),
        ):
            local = Gf.Matrix4d(Gf.Rotation(Gf.Quatd(rotation.Get())), Gf.Vec3d(position.Get()))
            frames.append(np.array(local * cache.GetLocalToWorldTransform(stage.GetPrimAtPath(rel.GetTargets()[0]))))
        assert np.abs(frames[0] - frames[1]).max() < 1e-6


def test_rb006_bodies_are_not_nested(stage: Usd.Stage) -> None:
    for body in bodies(stage):
        parent = body.GetParent()
        while parent:
            assert not parent.HasAPI(UsdPhysics.RigidBodyAPI)
            parent = parent.GetParent()


def test_bodies_are_neither_scaled_nor_sheared(stage: Usd.Stage) -> None:
    cache = UsdGeom.XformCache()
    for body in bodies(stage):
        matrix = np.array(cache.GetLocalToWorldTransform(body))[:3, :3]
        assert np.allclose(matrix @ matrix.T, np.eye(3), atol=1e-12)


def test_drive_fits_its_joint(stage: Usd.Stage) -> None:
    expected = {"PhysicsPrismaticJoint": "linear", "PhysicsRevoluteJoint": "angular"}
    for prim, instance in drives(stage):
        assert instance == expected[prim.GetTypeName()]


def test_limits_are_ordered_and_slides_limited(stage: Usd.Stage) -> None:
    for joint in joints(stage):
        prim = joint.GetPrim()
        if prim.GetTypeName() in ("PhysicsPrismaticJoint", "PhysicsRevoluteJoint"):
            lower, upper = (prim.GetAttribute(f"physics:{side}Limit").Get() for side in ("lower", "upper"))
            assert lower < upper
            if prim.GetTypeName() == "PhysicsPrismaticJoint":
                assert max(abs(lower), abs(upper)) < 20.0


def test_mass_properties_are_explicit_and_possible(stage: Usd.Stage) -> None:
    for body in bodies(stage):
        api = UsdPhysics.MassAPI(body)
        assert api.GetMassAttr().Get() > 0
        for attribute in (api.GetCenterOfMassAttr(), api.GetPrincipalAxesAttr(), api.GetDiagonalInertiaAttr()):
            assert attribute.HasAuthoredValue()
        first, second, third = sorted(api.GetDiagonalInertiaAttr().Get())
        assert first > 0
        assert third <= (first + second) * (1 + 1e-5)
        assert abs(api.GetPrincipalAxesAttr().Get().GetLength() - 1.0) < 1e-6


def test_every_body_has_a_collider(stage: Usd.Stage) -> None:
    for body in bodies(stage):
        assert any(p.HasAPI(UsdPhysics.CollisionAPI) for p in Usd.PrimRange(body))


def test_every_loop_has_one_cut_and_the_tree_spans_all_bodies(stage: Usd.Stage) -> None:
    tree, cuts, distance = [], [], []
    for joint in joints(stage):
        ends = [str(r.GetTargets()[0]) for r in (joint.GetBody0Rel(), joint.GetBody1Rel())]
        if joint.GetExcludeFromArticulationAttr().Get():
            cuts.append(ends)
        elif str(stage.GetDefaultPrim().GetPath()) not in ends:
            (distance if joint.GetPrim().GetTypeName() == "PhysicsDistanceJoint" else tree).append(ends)
    assert len({child for _, child in tree}) == len(tree)  # no body has two parents
    assert len(tree) + len(distance) == len(bodies(stage)) - 1
    assert len(cuts) == 1


def test_nothing_is_nan(stage: Usd.Stage) -> None:
    for prim in stage.Traverse():
        for attribute in prim.GetAuthoredAttributes():
            value = attribute.Get()
            if isinstance(value, float):
                assert not math.isnan(value), attribute.GetPath()
