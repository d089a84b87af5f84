"""Commands: targets that drives can follow, over whole strokes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from yellowiron.kinematics import ClosedChain, weight
from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Mechanism
from yellowiron.simulation.commands import RAMP, Pace, motions, phases, travel
from yellowiron.simulation.loads import paces


@given(
    start=st.floats(-2.0, 2.0),
    way=st.floats(1e-3, 3.0),
    speed=st.floats(0.02, 1.0),
    limit=st.floats(0.02, 5.0),
    back=st.booleans(),
)
def test_travel_keeps_speed_and_acceleration_and_arrives(
    start: float, way: float, speed: float, limit: float, back: bool
) -> None:
    end = start - way if back else start + way
    step = 0.005
    path = np.concatenate([[start], travel(start, end, speed, step, Pace(np.array([-9.0, 9.0]), np.full(2, limit)))])
    rates = np.diff(path) / step
    assert path[-1] == pytest.approx(end, abs=1e-9)
    assert np.abs(rates).max() <= speed * (1.0 + 1e-6)
    allowed = min(limit, speed / RAMP)
    assert np.abs(np.diff(rates)).max(initial=0.0) <= 1.01 * allowed * step + 1e-9
    assert np.all(np.diff(path) * (end - start) >= -1e-12)


@given(
    start=st.floats(-0.5, 0.5),
    way=st.floats(0.05, 0.8),
    speed=st.floats(0.05, 1.0),
    growth=st.floats(-6.0, 6.0),
    back=st.booleans(),
)
def test_travel_asks_for_no_more_force_where_the_mass_changes(
    start: float, way: float, speed: float, growth: float, back: bool
) -> None:
    """F = m·a + ½·m'·v²: a loaded loader's steering cylinder feels ten times the mass at one end of what it feels at
    the other, and what the change takes was left out: in PhysX its front swung on past its target, to and fro."""
    end, step = (start - way if back else start + way), 0.002
    places = np.linspace(-1.5, 1.5, 301)
    masses, force = np.exp(growth * places), 0.3
    path = np.concatenate([[start], travel(start, end, speed, step, Pace(places, force / masses, None, masses))])
    rates = np.diff(path) / step
    energy = 0.5 * np.interp(0.5 * (path[1:] + path[:-1]), places, masses) * rates**2
    way_between = np.abs(0.5 * (path[2:] - path[:-2]))
    creeping = 2e-3 * speed / RAMP * masses.max()
    # The last step is a shorter one.
    assert np.all(np.abs(np.diff(energy))[:-1] <= 1.05 * force * way_between[:-1] + creeping * step + 1e-6)
    assert path[-1] == pytest.approx(end)


def test_motions_are_two_to_ninety_eight_percent_at_rated_speed(mechanism: Mechanism) -> None:
    boom, *motors = motions(mechanism)
    assert (boom.low, boom.high) == pytest.approx((-0.1 + 0.008, 0.3 - 0.008))
    assert boom.speed == 0.2
    assert len(motors) == 4 and not any(m.position for m in motors)


def test_an_actuator_that_is_not_there_is_said(mechanism: Mechanism) -> None:
    with pytest.raises(YellowironError, match="no actuator 'arm'"):
        motions(mechanism, ["arm"])


def test_phases_go_to_both_ends_and_come_back(mechanism: Mechanism) -> None:
    moves = motions(mechanism)
    made = list(phases(moves, 0.01, on_ground=False))
    assert [phase.name for phase in made] == ["settle", "boom", "drive", "together"]
    for phase in made[1:]:
        assert all(len(values) == phase.steps for values in phase.targets.values())
        assert all(values[-1] == 0.0 for values in phase.targets.values())
    slide = made[1].targets["slide"]
    assert (slide.min(), slide.max()) == pytest.approx((moves[0].low, moves[0].high))
    assert [slide[hold] for hold in made[1].holds] == pytest.approx([moves[0].low, moves[0].high, 0.0])


def test_a_weak_drive_gets_gentle_targets(mechanism: Mechanism) -> None:
    moves = motions(mechanism)
    pace = paces(ClosedChain(mechanism), moves)["slide"]
    assert np.all(pace.limits > 0.0) and np.all(np.isfinite(pace.limits))


def test_weight_is_the_force_of_virtual_work(mechanism: Mechanism) -> None:
    """The boom's weight over the cylinder's lever, by hand from the pins."""
    chain = ClosedChain(mechanism)
    boom_pin, barrel_pin, rod_pin = (
        np.array(mechanism.joint(n).anchor) for n in ("boom_joint", "barrel_joint", "rod_joint")
    )
    along = (rod_pin - barrel_pin) / np.linalg.norm(rod_pin - barrel_pin)
    lever = abs(np.cross(rod_pin - boom_pin, along)[1])
    boom, rod, barrel = (mechanism.body(name) for name in ("boom", "rod", "barrel"))
    moment = 9.81 * boom.mass * (boom.center_of_mass[0] - boom_pin[0])
    own = 9.81 * (rod.mass + barrel.mass) * np.linalg.norm(rod_pin - barrel_pin)
    assert weight(chain, chain.drawn, "slide") == pytest.approx(moment / lever, abs=own)


def test_a_target_creeps_on_where_no_force_moves_it() -> None:
    """At a dead point the mass that a drive feels has no end: a build failed there, its way took for ever."""
    dead = Pace(np.array([-1.0, 0.0, 1.0]), np.array([0.0, 0.0, 5.0]))
    path = travel(-1.0, 1.0, 0.5, 1e-3, dead)
    assert path[-1] == pytest.approx(1.0)
    assert (np.diff(path) >= 0.0).all()
    assert 4.0 < 1e-3 * len(path) < 120.0
