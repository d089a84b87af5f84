"""Joints that follow others in the closed chain: where they are, what they weigh, how far they go."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from planar_zbar import sketch, strokes, zbar_mechanism

from yellowiron.kinematics import ClosedChain, complete, legal_start, lever_table, measure, pose_tables
from yellowiron.kinematics.gains import RATE, RATIO
from yellowiron.model.geometry import Floats
from yellowiron.model.machine_tests import PayloadTemplate, RatedLoad
from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, Drive, Joint, Mechanism, Site
from yellowiron.model.template import Follows, MeasurementTemplate

UP = (0.0, 0.0, 1.0)
MASSES = (500.0, 300.0, 200.0)


def body(name: str, mass: float, place: tuple[float, float, float] = (0.0, 0.0, 1.0)) -> Body:
    return Body(name, place, mass, place, 10.0 * np.eye(3), parts=(), hull=np.zeros((0, 3)))


def mast(inner: Follows, carriage: Follows) -> Mechanism:
    """Three slides, each in the one before, upright; the first is driven from 0 to 1.5 m."""
    bodies = (body("outer", 1000.0), *(body(n, m) for n, m in zip(("middle", "inner", "fork"), MASSES, strict=True)))
    drive = Drive("position", 1e6, 1e5, 1e5, 0.5)
    joints = (
        Joint("lift", "prismatic", "outer", "middle", (0, 0, 1), UP, 0.0, 1.5, drive=drive),
        Joint("inner", "prismatic", "middle", "inner", (0, 0, 1), UP, follows=inner),
        Joint("carriage", "prismatic", "inner", "fork", (0, 0, 1), UP, follows=carriage),
    )
    lift = Actuator("lift", "cylinder", (ActuatorJoint("lift"),))
    return Mechanism("mast", "mast", "outer", bodies, joints, actuators=(lift,))


@given(st.floats(0.0, 1.5), st.floats(-2.0, 2.0).filter(lambda r: abs(r) > 1e-2), st.floats(0.1, 2.0))
def test_followers_go_their_ratio(lift: float, first: float, second: float) -> None:
    chain = ClosedChain(mast(Follows("lift", first), Follows("inner", second)))
    assert (chain.independent, chain.dependent, chain.idle) == (("lift",), ("inner", "carriage"), ())
    assert chain.degrees_of_freedom == 1
    state = chain.solve({"lift": lift})
    assert chain.coordinate(state, "inner") == pytest.approx(first * lift, abs=1e-9)
    assert chain.coordinate(state, "carriage") == pytest.approx(second * first * lift, abs=1e-9)
    height = chain.displacement(state, "fork")[2, 3]
    assert height == pytest.approx(lift * (1.0 + first + second * first), abs=1e-9)
    assert state.closure < 1e-9


def test_the_drive_feels_what_the_chains_lift() -> None:
    """Speeds of 1, 2 and 3 times the drive's: inertia goes with their squares, weight with themselves."""
    chain = ClosedChain(mast(Follows("lift"), Follows("inner")))
    a, b, c = MASSES
    assert chain.effective_mass(chain.drawn, "lift") == pytest.approx(a + 4.0 * b + 9.0 * c)
    assert chain.raised_mass(chain.drawn, "lift") == pytest.approx(a + 2.0 * b + 3.0 * c)


def test_mobility_and_ranges_follow() -> None:
    done = complete(mast(Follows("lift"), Follows("inner", -0.5)))
    assert done.mobility is not None
    assert (done.mobility.computed, done.mobility.expected, done.mobility.grubler) == (1, 1, 1)
    inner, carriage = done.joint("inner"), done.joint("carriage")
    assert (inner.lower, inner.upper) == pytest.approx((-0.002, 1.502))
    assert (carriage.lower, carriage.upper) == pytest.approx((-0.752, 0.002))
    assert done.findings == ()


def test_a_limit_that_the_leader_passes_is_found() -> None:
    short = mast(Follows("lift"), Follows("inner"))
    joints = tuple(replace(j, lower=0.0, upper=1.0) if j.name == "inner" else j for j in short.joints)
    assert [(f.code, f.where) for f in complete(replace(short, joints=joints)).findings] == [("KIN006", "inner")]


def test_pose_tables_have_the_followers() -> None:
    (table,) = pose_tables(complete(mast(Follows("lift"), Follows("inner", 2.0)))).tables
    assert (table.drivers, table.dependent) == (("lift",), ("inner", "carriage"))
    lifts: Floats = table.axes[0]
    assert table.values == pytest.approx(np.column_stack([lifts, 2.0 * lifts]), abs=1e-9)


def test_an_offset_is_where_the_machine_starts() -> None:
    off = mast(Follows("lift", 1.0, 0.2), Follows("inner"))
    start = legal_start(off)
    assert start is not None and start.closed
    assert start.coordinates["inner"] == pytest.approx(0.2)
    assert start.displacements["fork"][2, 3] == pytest.approx(0.4)
    assert [(f.code, f.severity, f.where) for f in start.findings] == [("KIN012", "info", "inner")]
    assert legal_start(mast(Follows("lift"), Follows("inner"))) is None


def test_a_pivot_may_follow_one_that_a_cylinder_turns() -> None:
    """A wheel on a loader's frame, geared to the pin of its rocker, which is of a loop: turns with it, at any stroke,
    and has its lever."""
    z = sketch()
    loader = zbar_mechanism(z, strokes(z))
    leader = next(
        j for j in loader.joints if j.type == "revolute" and not j.cut and j.name in ClosedChain(loader).dependent
    )
    wheel = Joint(
        "wheel", "revolute", loader.root, "wheel", (0, 3, 1), (0, 1, 0), follows=Follows(leader.name, -3.0, kind="gear")
    )
    geared = replace(loader, bodies=(*loader.bodies, body("wheel", 10.0, (0, 3, 1))), joints=(*loader.joints, wheel))
    before, chain = ClosedChain(loader), ClosedChain(geared)
    assert chain.degrees_of_freedom == before.degrees_of_freedom
    assert chain.independent == before.independent
    for driver in before.independent:
        joint = loader.joint(driver)
        if joint.type != "prismatic" or joint.upper is None:
            continue
        state, old = chain.solve({driver: 0.5 * joint.upper}), before.solve({driver: 0.5 * joint.upper})
        turned = chain.coordinate(state, "wheel")
        assert turned == pytest.approx(-3.0 * before.coordinate(old, leader.name), abs=1e-9)
    component = next(c for c in chain.components() if "wheel" in c.dependent)
    assert leader.name in component.dependent
    name = next(a.name for a in geared.actuators if a.joints[0].joint in component.drivers)
    pivots = lever_table(complete(geared), name, n=5)["pivots"]
    if leader.name in pivots:
        assert pivots["wheel"]["angle"] == pytest.approx([-3.0 * a for a in pivots[leader.name]["angle"]], abs=1e-8)
    assert math.isfinite(chain.effective_mass(chain.drawn, chain.independent[0]))


def test_a_wheel_geared_to_a_motor_has_no_ends_and_needs_none() -> None:
    """The wheels of a tandem: one chain, no limits, no loop that could flip."""
    motor = Drive("velocity", 0.0, 1e3, 1e4, 3.0)
    bodies = (body("axle", 100.0), body("front", 10.0), body("rear", 10.0))
    joints = (
        Joint("front_wheel", "revolute", "axle", "front", (1, 0, 1), (0, 1, 0), drive=motor),
        Joint("rear_wheel", "revolute", "axle", "rear", (-1, 0, 1), (0, 1, 0), follows=Follows("front_wheel")),
    )
    drive = Actuator("drive", "motor", (ActuatorJoint("front_wheel"),))
    done = complete(Mechanism("tandem", "tandem", "axle", bodies, joints, actuators=(drive,)))
    assert done.findings == ()
    rear = done.joint("rear_wheel")
    assert (rear.lower, rear.upper) == (None, None)
    chain = ClosedChain(done)
    assert chain.coordinate(chain.solve({"front_wheel": 7.0}), "rear_wheel") == pytest.approx(7.0)


def test_a_rise_is_counted_from_where_its_steps_lead() -> None:
    """The fork rises three times as far as the first slide goes, wherever the mast is drawn."""
    template = MeasurementTemplate(
        "Lift",
        "Lift",
        {"kind": "rise", "site": "fork", "above": ({"set": {"lift": "min"}},)},
        ({"set": {"lift": 0.5}},),
    )
    machine = replace(
        mast(Follows("lift"), Follows("inner")),
        sites=(Site("fork", "fork", (1.0, 0.0, 0.2)),),
        measurements=(template,),
    )
    (found,) = measure(machine)
    assert found.model == pytest.approx(3 * 0.5 * 1.5, abs=1e-9)


def laden(kilograms: float) -> Mechanism:
    machine = mast(Follows("lift"), Follows("inner"))
    joints = tuple(
        replace(j, drive=replace(j.drive, stiffness=0.0, damping=0.0)) if j.drive is not None else j
        for j in machine.joints
    )
    return replace(
        machine,
        joints=joints,
        sites=(Site("fork", "fork", (1.0, 0.0, 0.2)),),
        payload=PayloadTemplate("fork", (RatedLoad("Rated Capacity", 1.0),)),
        specifications={"Rated Capacity": {"value": kilograms, "status": "ok"}},
    )


def test_a_drive_that_lifts_mostly_load_does_not_ring_with_it() -> None:
    """The chain ties the fork to three times the slide's way, its load to nine times its mass."""
    empty = MASSES[0] + 4.0 * MASSES[1] + 9.0 * MASSES[2]
    for load, seen in ((1000.0, empty), (10e3, empty + 9.0 * 10e3)):
        done = complete(replace(laden(load), joints=tuple(
            replace(j, drive=replace(j.drive, max_force=1e9)) if j.drive is not None else j for j in laden(load).joints
        )))  # fmt: skip
        drive = done.joint("lift").drive
        assert drive is not None
        rate = min(RATE, drive.damping / (4.0 * RATIO**2 * (seen + drive.armature)))
        assert drive.stiffness == pytest.approx(rate * drive.damping, rel=1e-6)
