"""The bundled wheel loader's files: validators, the way back, and the time it takes to write them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdPhysics
from test_usd_read import assert_same
from test_usd_validators import omniverse_errors, openusd_errors

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def loader(built_loader):
    """The mechanism of the example, and the folder it was written to."""
    return built_loader.mechanism, built_loader.folder


def test_no_error(loader) -> None:
    pytest.importorskip("physx_usd_schemas")
    pytest.importorskip("newton_usd_schemas")
    assert not openusd_errors(loader[1] / "scene.usda")
    assert not omniverse_errors(loader[1] / "scene.usda", variants=False)


def test_it_reads_back(loader) -> None:
    mechanism, out = loader
    assert_same(usd_read(out), mechanism)


def usd_read(out: Path):
    from yellowiron.usd import read_mechanism

    return read_mechanism(out / "wheel_loader.usda")


def test_joint_frames_agree_and_one_cut_a_loop(loader) -> None:
    mechanism, out = loader
    stage = Usd.Stage.Open(str(out / "wheel_loader.usda"))
    cache = UsdGeom.XformCache()
    joints = [UsdPhysics.Joint(p) for p in stage.Traverse() if p.IsA(UsdPhysics.Joint)]
    for joint in joints:
        frames = []
        for rel, position, rotation in (
            (joint.GetBody0Rel(), joint.GetLocalPos0Attr(), joint.GetLocalRot0Attr()),
            (joint.GetBody1Rel(), joint.GetLocalPos1Attr(), joint.GetLocalRot1Attr()),
        ):
            local = Gf.Matrix4d(Gf.Rotation(Gf.Quatd(rotation.Get())), Gf.Vec3d(position.Get()))
            frames.append(np.array(local * cache.GetLocalToWorldTransform(stage.GetPrimAtPath(rel.GetTargets()[0]))))
        assert np.abs(frames[0] - frames[1]).max() < 1e-6
    cuts = sum(bool(j.GetExcludeFromArticulationAttr().Get()) for j in joints)
    assert cuts == len(mechanism.loops) == len(joints) - (len(mechanism.bodies) - 1)


def test_it_stands_on_the_ground(loader) -> None:
    stage = Usd.Stage.Open(str(loader[1] / "scene.usda"))
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), ["default"])
    machine = stage.GetPrimAtPath("/World/wheel_loader")
    assert abs(cache.ComputeWorldBound(machine).ComputeAlignedRange().GetMin()[2]) < 1e-3
