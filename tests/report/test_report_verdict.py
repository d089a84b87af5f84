"""What a machine can do, in one sentence: levers that move, those that do not, and why."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kit.machines import small_machine
from yellowiron.model.alignment import Alignment
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.template import ActuatorTemplate, CylinderTemplate, JointTemplate, Role, Template
from yellowiron.report.verdict import levers_of, verdict

ALIGNMENT = Alignment("wheel_loader", np.eye(4), ())


@pytest.fixture(scope="module")
def mechanism() -> Mechanism:
    return small_machine.make()[0]


def template(mechanism: Mechanism) -> Template:
    """As the small loader, with a bucket on a pivot that it lacks."""
    joints = tuple(JointTemplate(j.name, j.type, (j.body0, j.body1)) for j in mechanism.joints)
    tilt = JointTemplate("tilt_joint", "revolute", ("boom", "bucket"))
    wheels = tuple(j.name for j in mechanism.joints if j.name.endswith("wheel_joint"))
    lift = ActuatorTemplate("boom_lift", "cylinder", (CylinderTemplate("slide", "barrel_joint", "rod_joint"),))
    roles = (*(Role(b.name, None, True) for b in mechanism.bodies), Role("bucket", "frame", True))
    actuators = (
        lift,
        ActuatorTemplate("tilt", "motor", joints=("tilt_joint",)),
        ActuatorTemplate("drive", "motor", joints=wheels),
    )
    return Template("wheel_loader", "", "frame", roles, (*joints, tilt), actuators=actuators)


def test_what_moves_and_what_does_not(mechanism: Mechanism) -> None:
    names = [a.name for a in mechanism.actuators]
    given = template(mechanism)
    given = replace(given, actuators=(replace(given.actuators[0], name=names[0]), *given.actuators[1:2]))
    levers = levers_of(mechanism, given, replace(ALIGNMENT, missing=("bucket",)))
    assert [(one.name, one.moves) for one in levers] == [(names[0], True), ("tilt", False)]
    assert verdict(levers) == f"Moves: {names[0]}. Does not move: tilt (bucket is missing)."


def test_a_cylinder_in_no_loop_moves_nothing(mechanism: Mechanism) -> None:
    name = mechanism.actuators[0].name
    given = template(mechanism)
    given = replace(given, actuators=(replace(given.actuators[0], name=name),))
    broken = replace(mechanism, loops=(), joints=tuple(j for j in mechanism.joints if j.name != "rod_joint"))
    (lever,) = levers_of(broken, given, ALIGNMENT)
    assert (lever.moves, lever.why) == (False, "joint rod_joint is not found")


def test_estimated_axes_are_said(mechanism: Mechanism) -> None:
    name = mechanism.actuators[0].name
    given = template(mechanism)
    given = replace(given, actuators=(replace(given.actuators[0], name=name),))
    guess = Finding("ALN016", "warning", "barrel_joint", "estimated", "")
    (lever,) = levers_of(mechanism, given, replace(ALIGNMENT, findings=(guess,)))
    assert (lever.moves, lever.why) == (True, "an axis estimated")
    bare = replace(mechanism, findings=(*mechanism.findings, Finding("MEC013", "warning", name, "no cylinder", "")))
    (lever,) = levers_of(bare, given, ALIGNMENT)
    assert lever.why == "driven at its hinge, its cylinder is missing"
