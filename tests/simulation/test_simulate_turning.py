"""The middle of a turn, and which machines stand on the ground by default."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from yellowiron.model.mechanism import Mechanism
from yellowiron.simulation.driving.turning import turning_centre
from yellowiron.simulation.ground import usual_base

LEFT = (0.0, 1.0)


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


def test_a_machine_whose_trailer_rolls_freely_stands_on_the_ground(mechanism: Mechanism) -> None:
    assert usual_base(mechanism) == "fixed"
    wheel = next(j for j in mechanism.joints if j.type == "revolute" and j.lower is None)
    rolling = dataclasses.replace(wheel, axis=(1.0, 0.0, 0.0), free=True, drive=None)
    joints = tuple(rolling if j is wheel else j for j in mechanism.joints)
    assert usual_base(dataclasses.replace(mechanism, joints=joints)) == "floating"
