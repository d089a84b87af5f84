"""A swinging crane with boom and arm, each on a cylinder: no wheel loader, and turned away from the x axis."""

from __future__ import annotations

import math

import numpy as np
import pytest
from planar_zbar import direction, length, meet, point, side, turned, wrapped

from yellowiron.kinematics import ClosedChain, complete, lever_table, measure
from yellowiron.kinematics.measuring.bench import Bench
from yellowiron.kinematics.measuring.quantities import wheels
from yellowiron.kinematics.strength import carried
from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, Cylinder, Drive, Joint, Loop, Mechanism, Site
from yellowiron.model.template import MeasurementTemplate

# Drawn pins: boom foot A, boom ram C–D, arm pivot G, arm ram E–F, tip T.
A, C, D = point(0.5, 1.5), point(1.2, 1.0), point(2.5, 2.6)
G, E, F, T = point(5.0, 3.5), point(2.8, 3.2), point(4.6, 4.1), point(6.0, 0.9)
SWING = (0.0, 0.0, 1.0)
PITCH = (0.0, 1.0, 0.0)


def crane() -> Mechanism:
    bodies, joints, cylinders = [], [], []

    def at(p, y=0.0):
        return (float(p[0]), y, float(p[1]))

    def body(name, p, mass, *more):
        hull = np.array([at(p), *(at(q) for q in more)])
        bodies.append(Body(name, at(p), mass, tuple(hull.mean(axis=0)), 0.3 * mass * np.eye(3), (), hull))

    def ram(name, base, end, p, q, low, up):
        u = (q - p) / length(p, q)
        body(f"{name}_barrel", p, 100.0)
        body(f"{name}_rod", p, 80.0, q)
        joints.append(Joint(f"{name}_foot", "revolute", base, f"{name}_barrel", at(p), PITCH))
        drive = Drive("position", 0.0, 0.0, 3e5, 0.3)
        joints.append(
            Joint(name, "prismatic", f"{name}_barrel", f"{name}_rod", at(p), (u[0], 0.0, u[1]), low, up, drive=drive)
        )
        joints.append(Joint(f"{name}_eye", "revolute", f"{name}_rod", end, at(q), PITCH))
        drawn = length(p, q)
        sizes = (0.12, 0.08, up - low, drawn + low, drawn, 3e7, 3e5, 2e5, 0.3)
        cylinders.append(Cylinder(name, f"{name}_barrel", f"{name}_rod", name, f"{name}_foot", f"{name}_eye", *sizes))

    body("base", point(0.0, 0.0), 5000.0)
    body("house", point(0.0, 1.0), 8000.0)
    motor = Drive("velocity", 0.0, 0.0, 5e4, 1.0)
    joints.append(Joint("swing", "revolute", "base", "house", (0.0, 0.0, 1.0), SWING, drive=motor))
    ram("boom_ram", "house", "boom", C, D, -0.4, 0.5)
    body("boom", D, 1500.0, A, G, E)
    joints.append(Joint("boom_pin", "revolute", "house", "boom", at(A), PITCH, cut=True))
    ram("arm_ram", "boom", "arm", E, F, -0.3, 0.4)
    body("arm", F, 700.0, G, T)
    joints.append(Joint("arm_pin", "revolute", "boom", "arm", at(G), PITCH, cut=True))
    return Mechanism(
        "crane",
        "crane",
        "base",
        tuple(bodies),
        tuple(joints),
        tuple(cylinders),
        (
            Actuator("swing", "motor", (ActuatorJoint("swing"),)),
            Actuator("boom", "cylinder", (ActuatorJoint("boom_ram"),), ("boom_ram",)),
            Actuator("arm", "cylinder", (ActuatorJoint("arm_ram", -1),), ("arm_ram",)),
        ),
        (
            Loop(("boom_ram_foot", "boom_ram", "boom_ram_eye", "boom_pin"), "boom_pin"),
            Loop(("arm_ram_foot", "arm_ram", "arm_ram_eye", "arm_pin"), "arm_pin"),
        ),
        (Site("tip", "arm", at(T)),),
    )


def solved(boom: float, arm: float):
    """Turns of boom and arm, and the tip, at two strokes from the drawn pose."""
    d = meet(C, length(C, D) + boom, A, length(A, D), side(C, A, D))
    first = wrapped(direction(d - A) - direction(D - A))
    f = meet(E, length(E, F) + arm, G, length(G, F), side(E, G, F))  # in the drawn boom
    second = wrapped(direction(f - G) - direction(F - G))
    return first, second, A + turned(G + turned(T - G, second) - A, first)


@pytest.mark.parametrize("swing", [0.0, 1.2, math.pi / 2, 2.5, -3.0])
def test_loops_close_wherever_the_house_points(swing):
    chain = ClosedChain(crane())
    for boom, arm in ((-0.4, 0.4), (0.5, -0.3), (0.2, 0.1)):
        state = chain.solve({"swing": swing, "boom_ram": boom, "arm_ram": arm})
        first, second, tip = solved(boom, arm)
        assert chain.coordinate(state, "boom_pin") == pytest.approx(-first, abs=1e-9)
        assert chain.coordinate(state, "arm_pin") == pytest.approx(-second, abs=1e-9)
        moved = chain.displacement(state, "arm") @ [T[0], 0.0, T[1], 1.0]
        want = [tip[0] * math.cos(swing), tip[0] * math.sin(swing), tip[1]]
        assert np.max(np.abs(moved[:3] - want)) <= 1e-9


def test_loops_along_a_chain_are_solved_apart_and_completed():
    chain = ClosedChain(crane())
    assert [c.drivers for c in chain.components()] == [("boom_ram",), ("arm_ram",)]
    done = complete(crane())
    assert done.findings == ()
    assert done.mobility.computed == done.mobility.expected == 3
    assert all(loop.branch for loop in done.loops)
    assert wheels(done) == ()


def test_a_load_is_as_heavy_to_a_drive_as_it_is_fast():
    """Against the way that the site makes over a little of the coordinate's."""
    chain, step = ClosedChain(crane()), 1e-4
    load = Site("hook", "arm", (T[0], 0.0, T[1]))
    for targets in ({"boom_ram": 0.3, "arm_ram": -0.2}, {"boom_ram": -0.2, "arm_ram": 0.35}):
        state = chain.solve(targets)
        for ram in targets:
            ends = [chain.solve({ram: targets[ram] + way}, start=state) for way in (-step, step)]
            low, high = ((chain.displacement(end, "arm") @ [*load.position, 1.0])[:3] for end in ends)
            speed = np.linalg.norm(high - low) / (2.0 * step)
            assert carried(chain, state, ram, load, 500.0) == pytest.approx(500.0 * speed**2, rel=1e-5)


def test_measures_without_wheels():
    tip = {"kind": "height", "site": "tip"}
    level = {"actuator": "boom", "quantity": tip, "value": "1.2 m"}
    templates = (
        MeasurementTemplate("deepest", "deepest", {**tip, "factor": -1}, ({"set": {"boom": "min", "arm": "min"}},)),
        MeasurementTemplate("reach", "reach", {"kind": "reach", "site": "tip"}),
        MeasurementTemplate("level", "level", {"kind": "joint_angle", "joint": "boom_pin"}, ({"solve": [level]},)),
    )
    found = {m.name: m for m in measure(Mechanism(**{**crane().__dict__, "measurements": templates}))}
    assert found["deepest"].model == pytest.approx(-solved(-0.4, 0.4)[2][1], abs=1e-9)
    assert "no wheels" in found["reach"].reason
    assert found["level"].model is not None and found["level"].model < 0.0


def test_a_motor_turns_so_far_from_the_drawn_pose():
    tip = {"kind": "height", "site": "tip"}
    for angle, words in ((math.pi / 2, "90 deg"), (-0.3, "-0.3 rad")):
        bench = Bench(crane())
        state = bench.pose(({"set": {"swing": words}},))
        assert bench.chain.coordinate(state, "swing") == pytest.approx(angle, abs=1e-9)
        assert bench.value(tip, state) == pytest.approx(T[1], abs=1e-9)
    # Of a lever with a negative sign, in its own sense; metres with their unit.
    state = bench.pose(({"set": {"arm": "100 mm"}},))
    assert bench.chain.coordinate(state, "arm_ram") == pytest.approx(-0.1, abs=1e-9)


def test_lever_table_of_an_actuator_with_a_negative_sign():
    table = lever_table(crane(), "arm", n=3)
    assert table["stroke"] == pytest.approx([0.4, 0.05, -0.3])
    assert list(table["pivots"]) == ["arm_pin"]
    assert lever_table(crane(), "swing") == {}
