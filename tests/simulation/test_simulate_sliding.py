"""Wheels that cannot all roll: how the machine goes by dry friction."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from yellowiron.model.geometry import Floats
from yellowiron.simulation.driving.sliding import Standing, least_sliding


def _four(base: float, tread: float, loads: tuple[float, float, float, float]) -> Standing:
    """Front left, rear left, front right, rear right; the rear axle at x = 0."""
    places = np.array([[x, y] for y in (0.5 * tread, -0.5 * tread) for x in (base, 0.0)])
    return Standing(places, np.tile([1.0, 0.0], (4, 1)), np.arange(4), np.asarray(loads), np.zeros(4, dtype=bool))


def test_wheels_that_can_roll_do() -> None:
    under = _four(1.2, 1.5, (0.25, 0.25, 0.25, 0.25))
    assert least_sliding(under, np.full(4, 2.0)) == pytest.approx([2.0, 0.0, 0.0], abs=1e-6)
    assert least_sliding(under, np.zeros(4)) == pytest.approx([0.0, 0.0, 0.0])


def test_alike_under_all_four_a_machine_turns_by_what_the_moments_leave() -> None:
    """What wheels push along and across balances at 1 / (1 + (wheelbase / tread)²), about the middle."""
    base, tread, rolled = 1.2, 1.5, 0.6
    x, y, turn = least_sliding(_four(base, tread, (0.25,) * 4), rolled * np.array([-1.0, -1.0, 1.0, 1.0]))
    assert turn == pytest.approx(rolled / (0.5 * tread) / (1.0 + (base / tread) ** 2), rel=1e-4)
    assert x == pytest.approx(0.0, abs=1e-6)
    assert -y / turn == pytest.approx(0.5 * base, abs=1e-3)


def test_where_two_carry_most_it_turns_about_them_as_far_as_they_roll() -> None:
    rolled, tread = 0.6, 1.5
    _, y, turn = least_sliding(_four(1.2, tread, (0.1, 0.4, 0.1, 0.4)), rolled * np.array([-1.0, -1.0, 1.0, 1.0]))
    assert turn == pytest.approx(rolled / (0.5 * tread), rel=0.01)
    assert -y / turn == pytest.approx(0.0, abs=0.01)


def test_what_nothing_drives_rolls_as_it_likes() -> None:
    """Two driven wheels behind, two castors held straight in front: on the spot, the front ones only slide across."""
    under = dataclasses.replace(_four(1.2, 1.5, (0.1, 0.4, 0.1, 0.4)), free=np.array([True, False, True, False]))
    assert least_sliding(under, np.full(4, 2.0) * [0.0, 1.0, 5.0, 1.0]) == pytest.approx([2.0, 0.0, 0.0], abs=1e-6)


def test_no_other_way_takes_less_work() -> None:
    rng = np.random.default_rng(5)
    ahead = np.column_stack([np.cos(a := rng.uniform(-0.6, 0.6, 12)), np.sin(a)])
    loads = np.full(12, 1.0 / 12.0)
    under = Standing(rng.uniform(-2.0, 2.0, (12, 2)), ahead, np.arange(12), loads, np.zeros(12, dtype=bool))
    rolled = rng.uniform(0.5, 1.5, 12)

    def work(way: Floats) -> float:
        slides = np.column_stack([way[0] - way[2] * under.places[:, 1], way[1] + way[2] * under.places[:, 0]])
        return float(loads @ np.linalg.norm(slides - ahead * rolled[:, None], axis=1))

    way = least_sliding(under, rolled)
    assert all(work(way) < work(way + rng.normal(0.0, size, 3)) for size in (1e-2, 0.1, 1.0) for _ in range(50))
