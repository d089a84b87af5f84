"""The closed chain against closed-form planar kinematics."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from planar_zbar import ZBar, sketch, strokes, wrapped, zbar_mechanism

from yellowiron.kinematics import ClosedChain, KinematicsError
from yellowiron.model.errors import MechanismError
from yellowiron.model.mechanism import Loop

BAR = 1e-9


def worst_errors(z: ZBar, travel, paths) -> tuple[float, float]:
    """Largest error in metres (pins, passive slides) and radians (every pivot) along paths of lift, tilt, steering."""
    mechanism = zbar_mechanism(z, travel)
    chain = ClosedChain(mechanism)
    lift, tilt, steer = paths
    states = chain.sweep({"lift_l": lift, "tilt": tilt, "steering_l": steer})
    assert len(states) == len(lift)
    metres = radians = 0.0
    for state, a, b, s in zip(states, lift, tilt, steer, strict=True):
        p = z.pose(z.lift + a, z.tilt + b)
        yaw, right = z.steering(z.steer + s)
        angles = {
            "boom_pin": -p["boom"],
            "rocker_pin": p["boom"] - p["rocker"],
            "bucket_pin": p["boom"] - p["bucket"],
            "lift_rod_l_joint": p["lift"] - p["boom"],
            "lift_barrel_r_joint": -p["lift"],
            "tilt_barrel_joint": -p["tilt"],
            "tilt_rod_joint": p["tilt"] - p["rocker"],
            "rocker_link_pin": p["rocker"] - p["link"],
            "link_bucket_pin": p["link"] - p["bucket"],
            "articulation": yaw,
        }
        for joint, angle in angles.items():
            radians = max(radians, abs(wrapped(chain.coordinate(state, joint) - angle)))
        metres = max(metres, state.closure)
        metres = max(metres, abs(chain.coordinate(state, "lift_r") - a))
        metres = max(metres, abs(chain.coordinate(state, "steering_r") - (right - z.steer)))
        # The edge in space: the planar point, yawed with the front frame about the articulation.
        moved = chain.displacement(state, "bucket") @ [z.T[0], 1.5, z.T[1], 1.0]
        c, n = np.cos(yaw), np.sin(yaw)
        want = [c * p["T"][0] - n * 1.5, n * p["T"][0] + c * 1.5, p["T"][1]]
        metres = max(metres, float(np.max(np.abs(moved[:3] - want))))
    return metres, radians


def paths(travel, n: int, turns: float = 2.3):
    """Lift once through its stroke, the tilt cylinder and the steering to and fro meanwhile; ends touched."""
    (l0, l1), (t0, t1) = travel
    wave = 0.5 - 0.5 * np.cos(2.0 * np.pi * turns * np.linspace(0.0, 1.0, n))
    return np.linspace(l0, l1, n), t0 + (t1 - t0) * wave, 0.15 * np.sin(np.linspace(0.0, 9.0, n))


def test_full_strokes_agree_with_the_planar_solution():
    z = sketch()
    travel = strokes(z)
    metres, radians = worst_errors(z, travel, paths(travel, 300))
    assert metres <= BAR and radians <= BAR


def test_corners_of_the_strokes_agree_with_the_planar_solution():
    z = sketch()
    travel = strokes(z)
    corners = [(a, b) for a in travel[0] for b in travel[1]]
    lift, tilt = np.array(corners).T
    metres, radians = worst_errors(z, travel, (lift, tilt, np.array([0.15, -0.15, 0.15, -0.15])))
    assert metres <= BAR and radians <= BAR


@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
@given(
    wobble=st.lists(st.floats(-1.0, 1.0), min_size=14, max_size=14),
    boom=st.floats(-0.6, 0.2),
    scale=st.sampled_from([0.5, 1.0, 3.0]),
)
def test_any_linkage_agrees_with_the_planar_solution(wobble, boom, scale):
    try:
        unit = sketch(1.0, np.array(wobble), boom)
        z = sketch(scale, np.array(wobble), boom)
        travel = strokes(z, steps=6)
    except ValueError:
        assume(False)
    assume(unit.margin(unit.lift, unit.tilt) > 0.25)
    lift, tilt, steer = paths(travel, 25)
    metres, radians = worst_errors(z, travel, (lift, tilt, scale * steer))
    assert metres <= BAR * max(1.0, scale) and radians <= BAR


def test_mobility_and_coordinates():
    z = sketch()
    chain = ClosedChain(zbar_mechanism(z, strokes(z)))
    assert chain.degrees_of_freedom == 8
    assert set(chain.independent) == {
        *("axle_joint", "steering_l", "lift_l", "tilt"),
        *(f"{e}_wheel_{s}_joint" for e in ("front", "rear") for s in "lr"),
    }
    assert chain.idle == ()
    assert [set(c.drivers) for c in chain.components()] == [{"steering_l"}, {"lift_l", "tilt"}]


def test_dead_point_keeps_the_last_good_state():
    z = sketch()
    chain = ClosedChain(zbar_mechanism(z, strokes(z)))
    with pytest.raises(KinematicsError) as caught:
        chain.solve({"lift_l": 2.0})
    reached = chain.coordinate(caught.value.reached, "lift_l")
    # C, A and D in line: the longest lift cylinder that the pins allow.
    longest = np.hypot(*(z.D - z.A)) + np.hypot(*(z.A - z.C)) - z.lift
    assert 0.0 < reached <= longest + 1e-9
    assert caught.value.reached.closure <= 1e-12
    assert "lift_l" in caught.value.where
    states = chain.sweep({"lift_l": np.linspace(0.0, 2.0, 50)})
    assert len(states) < 50 and chain.coordinate(states[-1], "lift_l") <= longest


def test_dead_point_is_where_the_circles_stop_to_meet():
    z = sketch()
    chain = ClosedChain(zbar_mechanism(z, strokes(z)))
    shortest = abs(np.hypot(*z.Q) - np.hypot(*z.P)) - z.steer
    state, _ = chain.reach({"steering_l": 2.0 * shortest})
    assert chain.coordinate(state, "steering_l") == pytest.approx(shortest, abs=1e-4)
    assert chain.coordinate(state, "steering_l") >= shortest - 1e-9


def test_there_and_back_is_the_same_pose():
    z = sketch()
    travel = strokes(z)
    chain = ClosedChain(zbar_mechanism(z, travel))
    away = chain.solve({"lift_l": travel[0][1], "tilt": travel[1][0], "steering_l": 0.15})
    back = chain.solve({"lift_l": 0.0, "tilt": 0.0, "steering_l": 0.0}, start=away)
    assert np.max(np.abs(back.position)) <= 1e-11
    assert all(np.max(np.abs(pose - np.eye(4))) <= 1e-11 for pose in chain.pose(back).values())


def test_coordinates_that_are_not_named_stay():
    z = sketch()
    chain = ClosedChain(zbar_mechanism(z, strokes(z)))
    first = chain.solve({"steering_l": 0.1, "axle_joint": 0.05})
    second = chain.solve({"lift_l": 0.1}, start=first)
    assert chain.coordinate(second, "steering_l") == 0.1
    assert chain.coordinate(second, "axle_joint") == 0.05


def test_dependent_coordinates_cannot_be_given():
    z = sketch()
    chain = ClosedChain(zbar_mechanism(z, strokes(z)))
    with pytest.raises(MechanismError, match="follows from the loops"):
        chain.solve({"tilt_rod_joint": 0.1})
    with pytest.raises(MechanismError, match="no such joint"):
        chain.solve({"flux_joint": 0.1})


def test_rates_are_the_derivatives():
    z = sketch()
    chain = ClosedChain(zbar_mechanism(z, strokes(z)))
    state = chain.solve({"lift_l": 0.1, "tilt": -0.05, "steering_l": 0.08})
    for driven in ("lift_l", "tilt", "steering_l"):
        here, h = chain.coordinate(state, driven), 1e-6
        ends = [chain.solve({driven: here + s * h}, start=state) for s in (1, -1)]
        tangent = chain.tangent(state, driven)
        for joint in ("boom_pin", "bucket_pin", "rocker_pin", "articulation", "lift_r", "tilt_rod_joint"):
            numeric = (chain.coordinate(ends[0], joint) - chain.coordinate(ends[1], joint)) / (2 * h)
            assert chain.rate(state, joint, tangent) == pytest.approx(numeric, abs=1e-6)


def test_a_wrong_tree_is_refused():
    z = sketch()
    mechanism = zbar_mechanism(z, strokes(z))

    def changed(name: str, **change):
        joints = tuple(replace(j, **change) if j.name == name else j for j in mechanism.joints)
        return replace(mechanism, joints=joints)

    with pytest.raises(MechanismError, match="two tree joints lead to"):
        ClosedChain(changed("boom_pin", cut=False))
    with pytest.raises(MechanismError, match="a slide is cut"):
        ClosedChain(changed("tilt", cut=True))
    with pytest.raises(MechanismError, match="no joint leads to"):
        ClosedChain(changed("axle_joint", cut=True))
    with pytest.raises(MechanismError, match="does not exist"):
        ClosedChain(changed("tilt", body1="nothing"))


@pytest.mark.parametrize("document", ["", "mine.json"])
def test_a_loop_that_is_held_rigid_names_what_holds_it(document: str):
    z = sketch()
    mechanism = zbar_mechanism(z, strokes(z))
    plate = replace(mechanism.body("boom"), name="plate")
    pin = mechanism.joint("boom_pin")
    weld = replace(pin, name="weld", type="fixed", body0="boom", body1="plate", cut=False, drive=None,
                   source={"document": document} if document else {})  # fmt: skip
    twice = replace(pin, name="twice", body0="boom", body1="plate", cut=True, drive=None)
    rigid = replace(
        mechanism,
        bodies=(*mechanism.bodies, plate),
        joints=(*mechanism.joints, weld, twice),
        loops=(*mechanism.loops, Loop(("weld", "twice"), "twice")),
    )
    with pytest.raises(MechanismError, match="cannot move against each other") as caught:
        ClosedChain(rigid)
    assert caught.value.where == "twice" and "held by weld" in caught.value.hint
    assert ("'weld' of mine.json" in caught.value.hint) == bool(document)


def test_bodies_without_mass_and_spherical_cuts_are_fine():
    z = sketch()
    mechanism = zbar_mechanism(z, strokes(z))
    ball = replace(
        mechanism,
        bodies=tuple(replace(b, mass=0.0, inertia=np.zeros((3, 3))) for b in mechanism.bodies),
        joints=tuple(replace(j, type="spherical") if j.cut else j for j in mechanism.joints),
    )
    one, other = ClosedChain(mechanism), ClosedChain(ball)
    target = {"lift_l": 0.2, "tilt": 0.1}
    assert np.max(np.abs(one.solve(target).position - other.solve(target).position)) <= 1e-11
