"""The middle of a turn, and which machines stand on the ground by default."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, Joint, Mechanism, scrubbing
from yellowiron.simulation.driving.result import DrivingResult, driving_findings
from yellowiron.simulation.driving.turning import crabs, turning_centre
from yellowiron.simulation.ground import usual_base

LEFT, ORIGIN = (0.0, 1.0), (0.0, 0.0, 0.0)


def steered(angle: float) -> tuple[float, float]:
    return -math.sin(angle), math.cos(angle)


def test_two_axles_turn_about_where_their_lines_meet() -> None:
    places = np.array([[0.0, 1.0], [0.0, -1.0], [3.0, 1.0], [3.0, -1.0]])
    axes = np.array([LEFT, LEFT, steered(0.5), steered(0.5)])
    # The front axle is steered about its own middle.
    places[2:] = np.array([3.0, 0.0]) + np.array([[1.0], [-1.0]]) * axes[2]
    assert turning_centre(places, axes) == pytest.approx([0.0, 3.0 / math.tan(0.5)])


def test_of_a_bogie_the_last_axle_does_not_slide() -> None:
    """Sliding on either of two equal axles takes as much; about the last one it takes it over a longer way."""
    places = np.array([[x, y] for x in (-1.0, 1.0, 5.0) for y in (1.0, -1.0)])
    axes = np.array([LEFT] * 4 + [steered(0.4)] * 2)
    places[4:] = np.array([5.0, 0.0]) + np.array([[1.0], [-1.0]]) * axes[4]
    assert turning_centre(places, axes) == pytest.approx([-1.0, 6.0 / math.tan(0.4)])


def test_what_goes_straight_turns_nowhere_in_particular() -> None:
    places, axes = np.array([[0.0, 1.0], [0.0, -1.0], [3.0, 1.0]]), np.array([LEFT] * 3)
    assert np.isfinite(turning_centre(places, axes)).all()


def test_wheels_turned_one_way_go_that_way() -> None:
    assert crabs(np.array([0.5, 0.42, 0.5, 0.42])) and crabs(np.array([-0.5, -0.42]))
    assert not crabs(np.array([0.5, 0.42, 0.0, 0.0]))  # steered in front alone
    assert not crabs(np.array([0.5, 0.42, -0.5, -0.42]))  # all wheels
    assert not crabs(np.zeros(4))


def test_a_steering_that_its_tyres_hold_is_told_instead_of_its_turn() -> None:
    stuck = DrivingResult(
        engine="mujoco", dt=0.001, payload=0.0, sunk=0.0, creep=0.0, forward=5.0, backward=5.0, sideways=0.0,
        steered=0.04, turning_radius=48.6, geometry_radius=74.4,
    )  # fmt: skip
    (finding,) = driving_findings(stuck)
    assert finding.where == "steering" and "4 % of its way" in finding.message
    crabbing = dataclasses.replace(stuck, turning_radius=None, geometry_radius=None, crab=0.0, crab_geometry=0.5)
    assert [f.where for f in driving_findings(crabbing)] == ["steering"]
    assert [f.where for f in driving_findings(dataclasses.replace(crabbing, steered=1.0))] == ["way crabwise"]
    assert list(driving_findings(dataclasses.replace(crabbing, steered=1.0, crab=0.49))) == []


def test_a_machine_whose_trailer_rolls_freely_stands_on_the_ground(mechanism: Mechanism) -> None:
    assert usual_base(mechanism) == "fixed"
    wheel = next(j for j in mechanism.joints if j.type == "revolute" and j.lower is None)
    rolling = dataclasses.replace(wheel, axis=(1.0, 0.0, 0.0), free=True, drive=None)
    joints = tuple(rolling if j is wheel else j for j in mechanism.joints)
    assert usual_base(dataclasses.replace(mechanism, joints=joints)) == "floating"


def _driven(name: str, actuators: int, places: list[tuple[float, float]]) -> Mechanism:
    """A root with driven wheels at places (x, y), dealt out to actuators in turn."""
    wheels = [f"wheel_{k}" for k in range(len(places))]
    joints = tuple(
        Joint(f"{w}_joint", "revolute", "chassis", w, anchor=(x, y, 0.4), axis=(0.0, 1.0, 0.0))
        for w, (x, y) in zip(wheels, places, strict=True)
    )
    motors = tuple(
        Actuator(f"drive_{k}", "motor", tuple(ActuatorJoint(j.name) for j in joints[k::actuators]))
        for k in range(actuators)
    )
    bodies = tuple(Body(b, ORIGIN, 1.0, ORIGIN, np.eye(3), (), np.zeros((0, 3))) for b in ("chassis", *wheels))
    return Mechanism(name, "", "chassis", bodies, joints, actuators=motors)


def test_tyres_scrub_where_two_stand_behind_each_other_on_either_side() -> None:
    skid = [(0.0, 0.8), (0.0, -0.8), (1.2, 0.8), (1.2, -0.8)]
    assert scrubbing(_driven("skid steer", 2, skid)) == {"wheel_0", "wheel_1", "wheel_2", "wheel_3"}
    # All wheels on one motor (a loader), an axle of each of two motors, one sprocket a side (tracks): none.
    assert not scrubbing(_driven("loader", 1, skid))
    assert not scrubbing(_driven("two axles", 2, [(0.0, 0.8), (1.2, 0.8), (0.0, -0.8), (1.2, -0.8)]))
    assert not scrubbing(_driven("tracks", 2, skid[:2]))
