"""Where the articulation's root is: on a link that no loop is cut at, or on the joint to the world."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from pxr import Usd, UsdPhysics

from kit.machines import small_machine
from yellowiron.usd.layers.articulation import root_link
from yellowiron.usd.layers.physx import loops_last


@pytest.fixture(scope="module")
def usd_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return small_machine.write(tmp_path_factory.mktemp("usd"))


@pytest.mark.parametrize("base", ["floating", "fixed"])
def test_one_root_with_its_settings(usd_file: Path, base: str) -> None:
    stage = Usd.Stage.Open(str(usd_file))
    machine = stage.GetDefaultPrim()
    machine.GetVariantSet("Base").SetVariantSelection(base)
    (root,) = (p for p in stage.Traverse() if p.HasAPI(UsdPhysics.ArticulationRootAPI))
    link = root_link(small_machine.make()[0])
    assert root.GetPath() == machine.GetPath().AppendPath(link if base == "floating" else "joints/base_joint")
    assert root.GetAttribute("physxArticulation:solverPositionIterationCount").Get() == 255
    assert root.GetAttribute("newton:selfCollisionEnabled").Get() is False
    machine.GetVariantSet("Physics").SetVariantSelection("off")
    assert not any(p.HasAPI(UsdPhysics.ArticulationRootAPI) for p in stage.Traverse())


def test_the_root_link_is_one_that_no_cut_touches() -> None:
    mechanism, _ = small_machine.make()
    touched = {b for j in mechanism.joints if j.cut for b in (j.body0, j.body1)}
    link = root_link(mechanism)
    assert touched and link not in touched
    whole = replace(mechanism, joints=tuple(replace(j, cut=False) for j in mechanism.joints if not j.cut))
    assert root_link(whole) == mechanism.root


def test_where_every_body_is_touched_it_is_the_root() -> None:
    mechanism, _ = small_machine.make()
    cut = next(j for j in mechanism.joints if j.cut)
    more = [replace(cut, name=f"cut_{b.name}", body0=mechanism.root, body1=b.name) for b in mechanism.bodies[1:]]
    assert root_link(replace(mechanism, joints=(*mechanism.joints, *more))) == mechanism.root


def test_loops_are_solved_last_where_a_motor_slews_them() -> None:
    mechanism, _ = small_machine.make()
    assert not loops_last(mechanism)
    slewed = tuple(replace(j, body0="front_wheel_l") if j.cut else j for j in mechanism.joints)
    assert loops_last(replace(mechanism, joints=slewed))
