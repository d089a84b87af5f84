"""Pin links: links on a slewed machine's cut pins, that the mechanism knows nothing of."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdPhysics

from kit.machines import small_machine
from yellowiron.checks import check
from yellowiron.model.mechanism import Mechanism
from yellowiron.usd import read_mechanism, write_machine
from yellowiron.usd.planning.pin_links import SHARE, slewed_cuts


@pytest.fixture(scope="module")
def slewed(tmp_path_factory: pytest.TempPathFactory) -> tuple[Mechanism, Path]:
    """The small machine with its boom and barrel on a body that a motor turns."""
    mechanism, assembly = small_machine.make()
    motor = next(j.drive for j in mechanism.joints if j.drive is not None and j.drive.kind == "velocity")
    joints = tuple(
        replace(j, drive=motor, lower=None, upper=None)
        if j.name == "axle_joint"
        else replace(j, body0="rear_axle")
        if j.name in ("barrel_joint", "boom_joint")
        else j
        for j in mechanism.joints
    )
    mechanism = replace(mechanism, joints=joints)
    folder = tmp_path_factory.mktemp("ends")
    write_machine(mechanism, assembly, folder, name="slewed")
    return mechanism, folder / "slewed.usda"


def test_only_what_a_motor_slews_has_pin_links(slewed: tuple[Mechanism, Path], tmp_path: Path) -> None:
    assert [j.name for j in slewed_cuts(slewed[0])] == ["boom_joint"]
    assert not slewed_cuts(small_machine.make()[0])
    stage = Usd.Stage.Open(str(small_machine.write(tmp_path)))
    assert not [p for p in stage.Traverse() if "_end" in p.GetName()]


@pytest.mark.parametrize(("degrees", "slews"), [(80.0, False), (150.0, True)])
def test_what_cylinders_turn_far_is_slewed_too(degrees: float, slews: bool) -> None:
    """As a backhoe; the front frame of a loader, which turns by 80°, is not."""
    mechanism, _ = small_machine.make()
    half = np.radians(degrees / 2)
    joints = tuple(
        replace(j, axis=(0.0, 0.0, 1.0), lower=-half, upper=half)
        if j.name == "axle_joint"
        else replace(j, body0="rear_axle")
        if j.name in ("barrel_joint", "boom_joint")
        else j
        for j in mechanism.joints
    )
    assert [j.name for j in slewed_cuts(replace(mechanism, joints=joints))] == (["boom_joint"] if slews else [])


def test_a_cut_joins_two_light_links_on_the_pin(slewed: tuple[Mechanism, Path]) -> None:
    mechanism, file = slewed
    stage = Usd.Stage.Open(str(file))
    cut = mechanism.joint("boom_joint")
    joint = UsdPhysics.Joint(stage.GetPrimAtPath("/slewed/joints/boom_joint"))
    for side, rel in enumerate((joint.GetBody0Rel(), joint.GetBody1Rel())):
        (path,) = rel.GetTargets()
        end = stage.GetPrimAtPath(path)
        matrix = UsdGeom.XformCache().GetLocalToWorldTransform(end)
        assert np.allclose(np.array(matrix), np.array(Gf.Matrix4d(1.0).SetTranslate(Gf.Vec3d(*cut.anchor))), atol=1e-12)
        mass = UsdPhysics.MassAPI(end)
        assert mass.GetMassAttr().Get() == pytest.approx(SHARE * sum(b.mass for b in mechanism.bodies), rel=1e-6)
        assert mass.GetCenterOfMassAttr().Get() == Gf.Vec3f(0.0)
        weld = UsdPhysics.FixedJoint(stage.GetPrimAtPath(f"/slewed/joints/boom_joint_end{side}"))
        body = (cut.body0, cut.body1)[side]
        assert weld.GetBody0Rel().GetTargets() == [f"/slewed/{body}"] and weld.GetBody1Rel().GetTargets() == [path]
        placed = np.array(weld.GetLocalPos0Attr().Get()) + mechanism.body(body).origin
        assert np.allclose(placed, cut.anchor, atol=1e-6)


@pytest.mark.parametrize("file", ["slewed.usda", "scene.usda"])
def test_the_mechanism_comes_back_without_them(slewed: tuple[Mechanism, Path], file: str) -> None:
    mechanism, path = slewed
    read = read_mechanism(path.parent / file)
    assert [b.name for b in read.bodies] == [b.name for b in mechanism.bodies]
    for found, built in zip(read.joints, mechanism.joints, strict=True):
        assert (found.name, found.body0, found.body1) == (built.name, built.body0, built.body1)
        assert found.anchor == pytest.approx(built.anchor, abs=1e-12)


def test_checks_ask_for_no_colliders_on_them(slewed: tuple[Mechanism, Path]) -> None:
    assert not [f for f in check(slewed[1]) if "_end" in f.where]
