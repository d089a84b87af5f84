"""Joints that the CAD file declares, beside those found."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from kit.machines import small_machine
from yellowiron.mechanism import compare_declared, declared_findings
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, DeclaredJoint
from yellowiron.model.mechanism import Mechanism

LINKED = "link_"
"""A link of the file is called so, and the body after it."""


@pytest.fixture(scope="module")
def machine() -> tuple[Mechanism, Assembly, Alignment]:
    """The small loader as a robot description: a link a body, every joint declared as it is."""
    mechanism, assembly = small_machine.make()
    body_of = {p.part: b.name for b in mechanism.bodies for p in b.parts}
    parts = tuple(replace(p, path=("robot", LINKED + body_of[p.id])) for p in assembly.parts)
    joints = tuple(
        DeclaredJoint(f"j_{j.name}", j.type, (LINKED + j.body0, LINKED + j.body1), j.anchor, j.axis, j.lower, j.upper)
        for j in mechanism.joints
    )
    roles = tuple(PartAssignment(p.id, body_of[p.id], body_of[p.id], 1.0, "") for p in parts)
    return mechanism, replace(assembly, parts=parts, joints=joints), Alignment("loader", np.eye(4), roles)


def changed(machine: tuple[Mechanism, Assembly, Alignment], name: str, **new: Any) -> Any:
    """What comes of it where one joint is declared otherwise."""
    mechanism, assembly, alignment = machine
    joints = tuple(replace(j, **new) if j.name == name else j for j in assembly.joints)
    compared = compare_declared(mechanism, replace(assembly, joints=joints), alignment)
    return next(c for c in compared if c.name == name), declared_findings(compared, "x")


def test_all_agree(machine: tuple[Mechanism, Assembly, Alignment]) -> None:
    compared = compare_declared(*machine)
    assert [c.joint for c in compared] == [j.name for j in machine[0].joints]
    assert all(c.agrees for c in compared)
    assert max(c.angle or 0.0 for c in compared) < 1e-7
    assert max(c.distance or 0.0 for c in compared) < 1e-9
    (finding,) = declared_findings(compared, "x")
    assert finding.code == "MEC080"
    assert finding.message.startswith(f"{len(compared)} of {len(compared)} joints")


def test_an_axis_that_leans(machine: tuple[Mechanism, Assembly, Alignment]) -> None:
    lean = math.radians(2.0)
    one, findings = changed(machine, "j_barrel_joint", axis=(0.0, -math.cos(lean), math.sin(lean)))
    assert one.agrees is False
    assert one.angle == pytest.approx(lean, abs=1e-6)
    assert "2.00°" in next(f.message for f in findings if f.code == "MEC081")


def test_an_anchor_beside(machine: tuple[Mechanism, Assembly, Alignment]) -> None:
    x, y, z = small_machine.BARREL_PIN
    assert changed(machine, "j_barrel_joint", anchor=(x, y, z + 1e-3))[0].agrees
    # Along its axis a hinge may be anchored anywhere.
    one, _ = changed(machine, "j_barrel_joint", anchor=(x + 0.03, y + 3.0, z + 0.04))
    assert one.agrees is False
    assert one.distance == pytest.approx(0.05)


def test_another_type(machine: tuple[Mechanism, Assembly, Alignment]) -> None:
    one, findings = changed(machine, "j_barrel_joint", type="fixed")
    assert (one.agrees, one.found) == (False, "revolute")
    assert [f.code for f in findings] == ["MEC080", "MEC081"]


def test_a_point_that_closes_a_loop_stands_for_a_hinge(machine: tuple[Mechanism, Assembly, Alignment]) -> None:
    assert changed(machine, "j_boom_joint", type="spherical", axis=(1.0, 0.0, 0.0))[0].agrees


def test_bodies_that_are_one_or_draw_nothing(machine: tuple[Mechanism, Assembly, Alignment]) -> None:
    mechanism, assembly, alignment = machine
    first = assembly.joints[0].bodies
    split = DeclaredJoint("tool", "revolute", (first[0], "tool frame"), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    weld = DeclaredJoint("weld", "fixed", (first[0], "camera"), (0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    inside = DeclaredJoint("inside", "revolute", ("camera", first[0]), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    world = DeclaredJoint("root", "free", ("", first[0]), (0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    more = replace(assembly, joints=(*assembly.joints, split, weld, inside, world))
    compared = {c.name: c for c in compare_declared(mechanism, more, alignment)}
    assert compared["tool"].agrees is None
    assert compared["inside"].agrees is False  # the camera is welded to the body that it is said to turn on
    assert not {"weld", "root"} & set(compared)
    codes = [f.code for f in declared_findings(list(compared.values()), "x")]
    assert codes == ["MEC080", "MEC081", "MEC082"]


def test_bodies_on_one_pin_with_a_third(machine: tuple[Mechanism, Assembly, Alignment]) -> None:
    mechanism, assembly, alignment = machine
    pin = mechanism.joint("rod_joint")
    shared = replace(pin, name="shared", body0="boom", body1="rear_axle")
    bodies = LINKED + "rod", LINKED + "rear_axle"
    declared = DeclaredJoint("across", "revolute", bodies, pin.anchor, pin.axis)
    more = replace(mechanism, joints=(*mechanism.joints, shared))
    (one,) = compare_declared(more, replace(assembly, joints=(declared,)), alignment)
    assert one.agrees
    (alone,) = compare_declared(mechanism, replace(assembly, joints=(declared,)), alignment)
    assert alone.agrees is False
