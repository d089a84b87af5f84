"""Poses between solved ones, as engines' runs are held against: led over as well as solved."""

from __future__ import annotations

import numpy as np
import pytest
from planar_zbar import sketch, strokes, zbar_mechanism

from yellowiron.kinematics import ClosedChain
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.simulation.strokes.comparison import Agreement, Comparison
from yellowiron.simulation.strokes.expected import led_over


@pytest.fixture(scope="module")
def mechanism() -> Mechanism:
    z = sketch()
    return zbar_mechanism(z, strokes(z))


def _run(chain: ClosedChain, noise: float, steps: int = 2000) -> Floats:
    """Coordinates at 1 ms: both cylinders and the steering to and fro, started and stopped at once, and as unsteady as
    an engine's."""
    (l0, l1), (t0, t1) = strokes(sketch())
    share = np.clip(np.linspace(-0.1, 1.1, steps), 0.0, 1.0)
    wave = 0.5 - 0.5 * np.cos(4.0 * np.pi * share)
    given = {"lift_l": l0 + (l1 - l0) * share, "tilt": t0 + (t1 - t0) * wave, "steering_l": 0.15 * np.sin(9.0 * share)}
    table = np.array([given.get(name, np.zeros(steps)) for name in chain.independent]).T
    return np.asarray(table + noise * np.random.default_rng(7).normal(size=table.shape))


def _held(mechanism: Mechanism, table: Floats, stride: int, off: float = 0.0) -> Agreement:
    """The kinematics' own poses, one pin moved by `off` in one step, held against a comparison."""
    chain = ClosedChain(mechanism)
    rows = {name: table[:, column] for column, name in enumerate(chain.independent)}
    rotations, origins = chain.placements(chain.sweep(rows))
    bodies = [chain.body_index(body.name) for body in mechanism.bodies]
    poses, places = rotations[:, bodies], origins[:, bodies].copy()
    places[777, [body.name for body in mechanism.bodies].index("bucket"), 2] += off
    return Comparison(mechanism, stride).compare(table, poses, places)


@pytest.mark.slow
@pytest.mark.parametrize("noise", [0.0, 1e-5])
def test_between_solved_poses_are_those_that_solving_finds(mechanism: Mechanism, noise: float) -> None:
    table = _run(ClosedChain(mechanism), noise)
    agreed = _held(mechanism, table, 8)
    assert agreed.followed and len(agreed.pins) == len(table)
    assert agreed.pin.value < 3e-7 and agreed.angle.value < 3e-7
    exact = _held(mechanism, table, 1)
    assert exact.pin.value < 1e-9
    assert agreed.sines == pytest.approx(exact.sines, abs=1e-7)


def test_a_pin_that_is_off_in_one_step_is_seen(mechanism: Mechanism) -> None:
    agreed = _held(mechanism, _run(ClosedChain(mechanism), 0.0), 8, off=2e-4)
    assert agreed.pin.step == 777
    assert agreed.pin.value == pytest.approx(2e-4, abs=1e-6)


def test_where_steps_between_solved_ones_lock_it_ends(mechanism: Mechanism) -> None:
    """The linkage can stand at each solved step, and at none of the four before the last."""
    chain = ClosedChain(mechanism)
    table = np.repeat(_run(chain, 0.0, 400)[:1], 17, axis=0)
    table[12:16, chain.independent.index("lift_l")] += 50.0
    rotations, origins = chain.placements([chain.drawn] * 17)
    bodies = [chain.body_index(body.name) for body in mechanism.bodies]
    assert len(led_over(chain, table, chain.drawn, 8)) == 17
    agreed = Comparison(mechanism, 8).compare(table, rotations[:, bodies], origins[:, bodies])
    assert not agreed.followed and len(agreed.pins) == 12


def test_what_cannot_be_led_over_is_solved_as_far_as_it_goes(mechanism: Mechanism) -> None:
    chain = ClosedChain(mechanism)
    table = _run(chain, 0.0, 400)
    assert led_over(chain, table, chain.drawn, 1) == [] and led_over(chain, table[:10], chain.drawn, 8) == []
    solved_ones = sum(np.isfinite(state.closure) for state in led_over(chain, table, chain.drawn, 8))
    assert solved_ones == 51
    rotations, origins = chain.placements([chain.drawn] * 400)
    bodies = [chain.body_index(body.name) for body in mechanism.bodies]
    table[200:, chain.independent.index("lift_l")] += 50.0
    agreed = Comparison(mechanism, 8).compare(table, rotations[:, bodies], origins[:, bodies])
    assert not agreed.followed and len(agreed.pins) == 200
