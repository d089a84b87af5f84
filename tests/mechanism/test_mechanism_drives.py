"""Drives: what the template states wins, motors turn speeds on the ground into their own, what nothing limits is
told."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from mechanism_machine import machine, pin, specifications, template

from yellowiron.mechanism import build_mechanism
from yellowiron.mechanism.actuation.proportion import WEAKEST, Proportion
from yellowiron.mechanism.values import Known
from yellowiron.model.alignment import PartAssignment
from yellowiron.model.assembly import Part
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.template import ActuatorTemplate, JointTemplate, Material, Role, Template, Wanted


def codes(built: Mechanism) -> set[str]:
    return {f.code for f in built.findings}


def build(plan: Template, **values: float) -> Mechanism:
    assembly, alignment = machine()
    return build_mechanism(assembly, plan, alignment, specifications(**values), name="crane")


def test_what_the_template_s_joint_states_wins_and_is_named() -> None:
    plan = template()
    joints = tuple(replace(j, stiffness=1e6, max_force=5e3) if j.name == "slide" else j for j in plan.joints)
    drive = build(replace(plan, joints=joints)).joint("slide").drive
    assert drive is not None
    assert (drive.stiffness, drive.max_force) == (1e6, 5e3)
    assert drive.source.endswith("template states stiffness, max_force")
    assert "gains provisional" in drive.source


def test_a_cylinder_without_pressure_has_no_force_limit_and_says_so() -> None:
    plan = template()
    built = build(replace(plan, actuators=(replace(plan.actuators[0], defaults={}),)))
    drive = built.joint("slide").drive
    assert drive is not None and math.isinf(drive.max_force)
    assert "MEC027" in codes(built)


def test_a_slide_without_a_drive_in_the_template_gets_none() -> None:
    plan = template()
    joints = tuple(replace(j, drive=None) for j in plan.joints)
    assert build(replace(plan, joints=joints)).joint("slide").drive is None


@pytest.mark.parametrize(("dimension", "expected"), [("speed", 8.0), ("angular_speed", 4.0)])
def test_a_motor_s_speed_on_the_ground_becomes_its_own(dimension: str, expected: float) -> None:
    """A wheel of 0.5 m radius on an axle of the base: 4 m/s on the ground are 8 rad/s."""
    plan = template()
    motor = ActuatorTemplate("drive", "motor", joints=("wheel_joint",), specifications={"speed": "Speed"},
                             defaults={"speed": 4.0, "torque": 800.0})  # fmt: skip
    plan = replace(
        plan,
        roles=(*plan.roles, Role("wheel", "base", True, "wheel"), Role("axle", "base", False, "pin")),
        joints=(*plan.joints, JointTemplate("wheel_joint", "revolute", ("wheel", "axle"), drive="angular", free=True)),
        actuators=(*plan.actuators, motor),
        wanted=(Wanted("Speed", dimension),),
    )
    assembly, alignment = machine()
    side = np.array([[1.0, 0, 0, 0], [0, 0, 1.0, 0.5], [0, -1.0, 0, -1.0], [0, 0, 0, 1.0]])
    shapes = {"wheel": pin("wheel", 0.5, 0.2), "axle": pin("axle", 0.05, 0.4)}
    parts = tuple(Part(name, name, (), name, side) for name in shapes)
    assigned = (
        PartAssignment("wheel", "wheel", "wheel", 1.0, ""),
        PartAssignment("axle", "axle", "base", 1.0, ""),
    )
    built = build_mechanism(
        replace(assembly, parts=assembly.parts + parts, shapes={**assembly.shapes, **shapes}),
        plan,
        replace(alignment, parts=alignment.parts + assigned),
        specifications(),
        name="crane",
    )
    joint = built.joint("wheel_joint")
    assert joint.axis == (0.0, 1.0, 0.0)
    assert joint.anchor == pytest.approx((0.0, 0.5, -1.0))
    assert joint.free and (joint.body0, joint.body1) == ("base", "wheel")
    assert joint.drive is not None
    assert joint.drive.kind == "velocity" and joint.drive.stiffness == 0.0
    assert joint.drive.max_velocity == pytest.approx(expected)
    assert joint.drive.max_force == 800.0
    assert built.actuators[-1].kind == "motor"


def test_the_hint_on_an_assumed_value_says_what_can_be_given() -> None:
    plan = template()
    motor = ActuatorTemplate("swing", "motor", joints=("base2arm",), specifications={"speed": "Swing Speed"},
                             defaults={"torque": 5e3, "speed": 1.0})  # fmt: skip
    built = build(replace(plan, actuators=(*plan.actuators, motor)))
    hints = {f.message.partition(":")[0]: f.hint for f in built.findings if f.code == "MEC025" and f.where == "swing"}
    assert hints == {
        "No specification gives its torque": 'State "max_force" of base2arm in a joints document (--data).',
        "No sheet gives 'Swing Speed'": '--set "Swing Speed=…"',
    }


@pytest.mark.parametrize(("given", "torque"), [({}, 2e3), ({"Rimpull": 8e3}, 8e3 * math.hypot(2.0, 0.05))])
def test_a_pull_at_the_ground_becomes_a_torque(given: dict[str, float], torque: float) -> None:
    """The arm's box ends 2 m from its pivot, ± 0.05 m: that is its rim. The default is a torque already."""
    plan = template()
    motor = ActuatorTemplate("swing", "motor", joints=("base2arm",), specifications={"torque": "Rimpull"},
                             defaults={"torque": 2e3})  # fmt: skip
    plan = replace(plan, actuators=(*plan.actuators, motor), wanted=(*plan.wanted, Wanted("Rimpull", "force")))
    drive = build(plan, **given).joint("base2arm").drive
    assert drive is not None and drive.max_force == pytest.approx(torque)


def test_a_motor_without_torque_is_not_limited() -> None:
    plan = template()
    motor = ActuatorTemplate("swing", "motor", joints=("base2arm",))
    built = build(replace(plan, actuators=(*plan.actuators, motor)))
    drive = built.joint("base2arm").drive
    assert drive is not None and math.isinf(drive.max_force) and math.isfinite(drive.damping)
    assert "MEC027" in codes(built)
    assert not built.joint("base2arm").cut, "a driven pivot stays in the tree"


def test_a_stated_drive_needs_no_actuator() -> None:
    """A template without actuators (the papers' JSON-4 and Fig. A1) still drives what it says it drives."""
    plan = template()
    driven = [j.name for j in plan.joints if j.drive is not None]
    built = build(replace(plan, actuators=()))
    assert driven and [a.name for a in built.actuators] == driven
    for name in driven:
        drive = built.joint(name).drive
        assert drive is not None and drive.kind == "position" and math.isinf(drive.max_force)
    assert "MEC027" in codes(built)


def test_a_drive_without_limits_or_stiffness_holds_a_speed() -> None:
    plan = template()
    spun = tuple(replace(j, lower=None, upper=None) if j.drive else j for j in plan.joints)
    for joint in build(replace(plan, actuators=(), joints=spun)).joints:
        assert joint.drive is None or joint.drive.kind == "velocity"


def test_defaults_of_a_usual_machine_are_limited_on_a_light_one() -> None:
    """0.05 of weight times diagonal for motors, 20 times the weight for cylinders; what a sheet gives stays."""
    plan = template()
    motor = ActuatorTemplate("swing", "motor", joints=("base2arm",), specifications={"torque": "Swing Torque"},
                             defaults={"torque": 70e3, "speed": 1.0})  # fmt: skip
    plan = replace(plan, actuators=(*plan.actuators, motor), wanted=(*plan.wanted, Wanted("Swing Torque", "torque")))
    built = build(plan)
    mass = sum(body.mass for body in built.bodies)
    drive = built.joint("base2arm").drive
    assert drive is not None and drive.max_force < 70e3
    assert drive.max_force / (mass * 9.81) == pytest.approx(0.05 * built_diagonal())
    assert "limited to what suits" in drive.source
    assert [f.where for f in built.findings if f.code == "MEC036"] == ["swing"]
    given = build(plan, **{"Swing Torque": 70e3})
    stated = given.joint("base2arm").drive
    assert stated is not None and stated.max_force == 70e3 and "MEC036" not in codes(given)


def test_a_default_torque_is_no_less_than_suits_a_large_machine() -> None:
    """Excavators of hundreds of tonnes, which artists draw, did not swing with what turns one of twenty."""
    machine, findings = Proportion(5e6, 20.0), list[Finding]()
    raised = machine.torque(Known(70e3, "template's default"), "swing", findings)
    assert raised.value == pytest.approx(WEAKEST * 5e6 * 20.0)
    assert "raised to what suits" in raised.source and [f.code for f in findings] == ["MEC036"]
    assert Proportion(2e5, 10.0).torque(Known(70e3, "default"), "swing", findings).value == 70e3
    assert Proportion(0.0, 10.0).torque(Known(70e3, "default"), "swing", findings).value == 70e3
    assert len(findings) == 1


def test_a_cylinder_under_default_pressure_is_no_stronger_than_twenty_machines() -> None:
    plan = template()
    whole = build(plan)
    heavy = sum(body.mass for body in whole.bodies)
    light = replace(plan, materials={"*": Material("foam", density=1.0)})
    built = build(light)
    mass = sum(body.mass for body in built.bodies)
    assert mass < 1e-2 * heavy
    drive = built.joint("slide").drive
    assert drive is not None and drive.max_force == pytest.approx(20.0 * mass * 9.81)
    assert "MEC036" in codes(built) and "gains provisional" in drive.source


def test_default_flow_takes_a_stroke_at_least_a_second() -> None:
    plan = template()
    fast = replace(plan.actuators[0], defaults={**plan.actuators[0].defaults, "flow": 1.0}, specifications={})
    built = build(replace(plan, actuators=(fast,)))
    (cylinder,) = built.cylinders
    assert cylinder.speed == pytest.approx(cylinder.stroke / 1.0)


def built_diagonal() -> float:
    """The diagonal of the machine's box, metres."""
    assembly, _ = machine()
    points = np.concatenate([assembly.points_of(p) for p in assembly.parts])
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def test_default_flow_takes_a_stroke_no_longer_than_the_type_says() -> None:
    """A public excavator in a unit that made it 1800 t heavy took three minutes for a stroke: it seemed dead."""
    plan = template()
    defaults = {**plan.actuators[0].defaults, "flow": 1e-9}
    slow = replace(plan.actuators[0], defaults=defaults, specifications={})
    bounded = replace(slow, defaults={**defaults, "extend_time": 6.0})
    built, unbounded = (build(replace(plan, actuators=(a,))).joint("slide") for a in (bounded, slow))
    assert built.drive is not None and unbounded.drive is not None
    assert built.lower is not None and built.upper is not None
    assert built.drive.max_velocity == pytest.approx((built.upper - built.lower) / 6.0)
    assert built.drive.reverse_velocity in (None, pytest.approx(built.drive.max_velocity))
    assert unbounded.drive.max_velocity < 1e-3 * built.drive.max_velocity
