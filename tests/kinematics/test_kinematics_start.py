"""Machines drawn outside their limits: where they start, and the CAD model moved there."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from test_kinematics_crane import crane

from yellowiron.kinematics import ClosedChain, legal_start, started
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.mechanism import Drive, Mechanism
from yellowiron.model.template import JointTemplate, Role, Template


def limited(name: str, lower: float, upper: float) -> Mechanism:
    mechanism = crane()
    joints = tuple(replace(j, lower=lower, upper=upper) if j.name == name else j for j in mechanism.joints)
    return replace(mechanism, joints=joints)


def test_a_legal_drawn_pose_stays() -> None:
    assert legal_start(crane()) is None


def test_a_slide_goes_just_inside_its_nearer_limit() -> None:
    mechanism = limited("boom_ram", 0.1, 0.5)
    start = legal_start(mechanism)
    assert start is not None
    assert start.coordinates == pytest.approx({"boom_ram": 0.104})
    assert [f.code for f in start.findings] == ["KIN012"]
    chain = ClosedChain(mechanism)
    state = chain.solve({"boom_ram": 0.104})
    assert np.allclose(start.displacements["arm"], chain.displacement(state, "arm"))
    assert np.allclose(start.displacements["base"], np.eye(4))
    assert not np.allclose(start.displacements["boom"], np.eye(4))


def test_what_cannot_be_reached_is_said() -> None:
    start = legal_start(limited("boom_ram", 3.0, 3.5))
    assert start is not None
    assert [f.severity for f in start.findings] == ["warning", "error"]


def test_the_cad_model_moves_along() -> None:
    """A swing that may only be between 30° and 90°: parts, axes and limits count from there."""
    mechanism = limited("swing", math.radians(30), math.radians(90))
    motor = Drive("position", 0.0, 0.0, 5e4, 1.0)
    joints = tuple(replace(j, drive=motor) if j.name == "swing" else j for j in mechanism.joints)
    start = legal_start(replace(mechanism, joints=joints))
    assert start is not None
    by = start.coordinates["swing"]
    assert by == pytest.approx(math.radians(30.6))
    frame = np.eye(4)
    frame[:3, 3] = (5.0, 0.0, 0.0)
    place = np.eye(4)
    place[:3, 3] = (-4.0, 0.0, 0.0)  # a metre ahead of the swing axis, in the machine's frame
    parts = (Part("HOUSE", "HOUSE", (), "s", place), Part("SIGN", "SIGN", (), "s", place))
    assembly = Assembly("m", "STEP", 1.0, parts, {})
    template = Template(
        "crane", "", "base", (Role("base", None, True), Role("house", "base", True)),
        (JointTemplate("swing", "revolute", ("house", "base"), math.radians(30), math.radians(90)),),
    )  # fmt: skip
    said = (PartAssignment("HOUSE", "house", "house", 1.0, ""), PartAssignment("SIGN", None, None, 0.0, ""))
    alignment = Alignment(
        "crane", frame, said,
        axes={"swing": ((-5.0, 0.0, 0.0), (0.0, 0.0, 1.0))},
    )  # fmt: skip
    moved, changed, turned = started(assembly, template, alignment, start)
    assert np.allclose(moved.parts[0].transform[:3, 3], (math.cos(by) - 5.0, math.sin(by), 0.0))
    assert np.allclose(moved.parts[1].transform, place)
    joint = changed.joint("swing")
    assert (joint.lower, joint.upper) == pytest.approx((math.radians(30) - by, math.radians(90) - by))
    assert np.allclose(turned.axes["swing"], alignment.axes["swing"], atol=1e-12)
