"""Cylinders whose linkage does not work stand as drawn, and what they move is driven at its hinge."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import numpy as np
from mechanism_machine import A, C, machine, specifications, template

from yellowiron import kinematics, usd
from yellowiron.checks import check
from yellowiron.mechanism import build_mechanism
from yellowiron.mechanism.build import _with_idle_held
from yellowiron.mechanism.joints.tree import Tree
from yellowiron.model.alignment import Alignment
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.template import Follows, JointTemplate, Role, Template
from yellowiron.stages import complete_mechanism
from yellowiron.support.vectors import triple


def solved(alignment: Alignment | None = None, plan: Template | None = None) -> Mechanism:
    assembly, found = machine()
    return complete_mechanism(assembly, plan or template(), alignment or found, specifications())


def with_axis(joint: str, at: Floats, axis: tuple[float, float, float]) -> Alignment:
    """The crane's alignment with one axis set by hand."""
    return replace(machine()[1], axes={joint: (triple(at), axis)}, by_hand=frozenset({joint}))


def told(mechanism: Mechanism, code: str) -> list[str]:
    return [f.where for f in mechanism.findings if f.code == code]


def test_a_sound_linkage_is_left_alone() -> None:
    mechanism = solved()
    assert [c.slide for c in mechanism.cylinders] == ["slide"]
    assert not {"MEC013", "MEC018", "MEC019"} & {f.code for f in mechanism.findings}


def test_a_cylinder_on_a_pin_along_its_linkage_stands_and_the_hinge_is_driven() -> None:
    """Its barrel's pin was taken for one upright: the loop would open by decimetres."""
    alignment = with_axis("base2barrel", C, (0.0, 0.0, 1.0))
    assembly, _ = machine()
    built = build_mechanism(assembly, template(), alignment, specifications(), name="crane")
    wrong = kinematics.unworkable(kinematics.complete(kinematics.calibrate(built)))
    assert wrong.keys() == {"slide"}

    mechanism = solved(alignment)
    (actuator,) = mechanism.actuators
    assert told(mechanism, "MEC018") == [actuator.name]
    assert not mechanism.cylinders and not mechanism.loops
    hinge = mechanism.joint("base2arm")
    assert [j.joint for j in actuator.joints] == ["base2arm"]
    assert hinge.drive is not None and hinge.drive.kind == "position"
    # What is left of the cylinder stays where it is drawn: the barrel on the base, the rod on the arm.
    assert {j.name for j in mechanism.joints if j.held} == {"base2barrel", "arm2rod"}
    assert mechanism.mobility is not None
    assert mechanism.mobility.computed == mechanism.mobility.expected == 1
    assert kinematics.unworkable(mechanism) == {}


def test_a_cylinder_whose_link_was_not_found_stands_and_the_hinge_is_driven() -> None:
    """A bucket whose link was not found stood welded to its arm while its cylinder turned a lever."""
    plan = template()
    lever = JointTemplate("base2lever", "revolute", ("base", "lever"))
    rod = JointTemplate("lever2rod", "revolute", ("lever", "cylinder_rod"))
    missing = (
        JointTemplate("rod2link", "revolute", ("cylinder_rod", "link")),
        JointTemplate("link2arm", "revolute", ("link", "arm")),
    )
    assembly, alignment = machine()
    # A pin of the base serves as the lever; the rod hangs on it, and the link to the arm is not drawn.
    parts = tuple(replace(a, role="lever", body="lever") if a.part.endswith("PIN L") else a for a in alignment.parts)
    roles = (*plan.roles, Role("lever", "base", True, "frame"), Role("link", "arm", True, "frame"))
    y = (0.0, 1.0, 0.0)
    axes = {"base2lever": ((0.9, 0.3, 0.5), y), "lever2rod": ((1.0, 0.0, 1.0), y), "base2arm": (triple(A), y)}
    alignment = replace(alignment, parts=parts, axes=axes, by_hand=frozenset(axes))
    joints = (lever, rod, *missing, *(j for j in plan.joints if j.name != "arm2rod"))
    cylinder = replace(plan.actuators[0].cylinders[0], rod_joint="lever2rod")
    actuator = replace(plan.actuators[0], cylinders=(cylinder,))
    mechanism = complete_mechanism(
        assembly, replace(plan, roles=roles, joints=joints, actuators=(actuator,)), alignment, specifications()
    )
    assert told(mechanism, "MEC018") == ["lift"]
    assert [j.joint for j in mechanism.actuators[0].joints] == ["base2arm"]
    assert mechanism.mobility is not None
    assert mechanism.mobility.computed == mechanism.mobility.expected == 1


def test_a_cylinder_whose_pivots_are_one_place_stands() -> None:
    """Its stroke was a thousandth of a millimetre."""
    mechanism = solved(with_axis("base2barrel", np.array([1.0, 0.0, 1.001]), (0.0, 1.0, 0.0)))
    assert told(mechanism, "MEC018") == ["lift"]
    assert [j.joint for j in mechanism.actuators[0].joints] == ["base2arm"]


def test_a_document_s_joint_is_obeyed() -> None:
    """Somebody wrote where the pin is: the linkage stays as he has it, and what is wrong with it is told."""
    plan = template()
    joints = tuple(replace(j, documents={"joint": "mine.json"}) if j.name == "base2barrel" else j for j in plan.joints)
    mechanism = solved(with_axis("base2barrel", C, (0.0, 0.0, 1.0)), replace(plan, joints=joints))
    assert [c.slide for c in mechanism.cylinders] == ["slide"]
    assert not told(mechanism, "MEC018")
    near = with_axis("base2barrel", np.array([1.0, 0.0, 1.001]), (0.0, 1.0, 0.0))
    assert not told(solved(near, replace(plan, joints=joints)), "MEC018")


def test_the_hinge_between_the_largest_bodies_is_driven() -> None:
    """A second way round, over a short link, is not taken, though it has as few joints."""
    plan = template()
    link = JointTemplate("base2link", "revolute", ("base", "link"))
    rod = JointTemplate("link2rod", "revolute", ("link", "cylinder_rod"))
    assembly, alignment = machine()
    # The pin of the barrel serves as the link: it is small.
    parts = tuple(replace(a, role="link", body="link") if a.part.endswith("PIN L") else a for a in alignment.parts)
    roles = (*plan.roles, Role("link", "base", True, "frame"))
    axes = {
        "base2link": ((0.0, 0.3, 1.0), (0.0, 1.0, 0.0)),
        "link2rod": ((1.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
        "base2barrel": ((0.3, 0.0, 0.4), (0.0, 0.0, 1.0)),
        "base2arm": (triple(A), (0.0, 1.0, 0.0)),
    }
    alignment = replace(alignment, parts=parts, axes=axes, by_hand=frozenset(axes))
    mechanism = complete_mechanism(
        assembly, replace(plan, roles=roles, joints=(link, rod, *plan.joints)), alignment, specifications()
    )
    (actuator,) = mechanism.actuators
    assert [j.joint for j in actuator.joints] == ["base2arm"]


def test_a_barrel_without_its_rod_does_not_swing_freely() -> None:
    alignment = machine()[1]
    parts = tuple(replace(a, role=None, body=None) if a.part.split("/")[-1] == "ROD" else a for a in alignment.parts)
    mechanism = solved(replace(alignment, parts=parts))
    assert told(mechanism, "MEC019") == ["base2barrel"]
    assert mechanism.joint("base2barrel").held
    assert mechanism.mobility is not None
    assert mechanism.mobility.computed == mechanism.mobility.expected


def test_what_follows_a_joint_that_stands_stands() -> None:
    """A boom's sections of which nothing drives the first: the next would follow what is no coordinate."""
    slide = solved().joint("slide")
    first, free = replace(slide, name="first", drive=None), replace(slide, name="first", drive=None, free=True)
    second = replace(slide, name="second", drive=None, follows=Follows("first"))
    third = replace(second, name="third", follows=Follows("second"))
    tree = cast(Tree, SimpleNamespace(loops=()))
    held = _with_idle_held((first, second, third), tree, [])
    assert all(joint.held and joint.follows is None for joint in held)
    assert _with_idle_held((free, second, third), tree, []) == (free, second, third)


def test_a_barrel_without_its_rod_does_not_dangle_from_a_ball(tmp_path: Path) -> None:
    """As on a pin; in the file it is welded too."""
    assembly, alignment = machine()
    parts = tuple(replace(a, role=None, body=None) if a.part.split("/")[-1] == "ROD" else a for a in alignment.parts)
    plan = template()
    joints = tuple(replace(j, type="spherical") if j.name == "base2barrel" else j for j in plan.joints)
    mechanism = solved(replace(alignment, parts=parts), replace(plan, joints=joints))
    assert told(mechanism, "MEC019") == ["base2barrel"]
    assert mechanism.joint("base2barrel").held
    assert mechanism.mobility is not None
    assert mechanism.mobility.computed == mechanism.mobility.expected
    usd.write_machine(mechanism, assembly, tmp_path, name="crane", frame=alignment.frame)
    assert usd.read_mechanism(tmp_path / "crane.usda").joint("base2barrel").type == "fixed"
    assert {f.code for f in check(tmp_path / "crane.usda") if f.severity == "error"} == set()


def test_engines_get_welds_for_what_is_held(tmp_path: Path) -> None:
    """Limits give way in engines: in the file the left-over cylinder is welded, and the whole checks out."""
    assembly, _ = machine()
    alignment = with_axis("base2barrel", C, (0.0, 0.0, 1.0))
    mechanism = complete_mechanism(assembly, template(), alignment, specifications())
    usd.write_machine(mechanism, assembly, tmp_path, name="crane", frame=alignment.frame)
    read = usd.read_mechanism(tmp_path / "crane.usda")
    assert {j.name for j in read.joints if j.type == "fixed"} == {"base2barrel", "arm2rod"}
    assert {f.code for f in check(tmp_path / "crane.usda") if f.severity == "error"} == set()
