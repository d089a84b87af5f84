"""Statics: what a posed machine bears, against balances worked by hand."""

from __future__ import annotations

import dataclasses
import math
import time

import numpy as np
import pytest

from yellowiron.kinematics import ClosedChain, weight
from yellowiron.kinematics.measuring.quantities import Unmeasurable
from yellowiron.model.mechanism import GRAVITY, Drive, Mechanism
from yellowiron.simulation.machine_tests.rig import locked
from yellowiron.simulation.machine_tests.statics import (
    actuator_area,
    actuator_force,
    motion,
    place,
    supports,
    tipping_force,
)

DOWN = np.array([0.0, 0.0, -1.0])


def balance(mechanism: Mechanism) -> tuple[float, float]:
    """Weight (N) and its moment (N·m) about the front wheels' line, x = 1."""
    total = GRAVITY * sum(b.mass for b in mechanism.bodies)
    return total, sum(GRAVITY * b.mass * (1.0 - b.center_of_mass[0]) for b in mechanism.bodies)


def test_it_stands_on_both_edges_of_its_wheels(mechanism: Mechanism) -> None:
    chain = ClosedChain(mechanism)
    under = supports(mechanism, chain, chain.drawn)
    assert len(under) == 8
    assert np.array([p for _, p in under])[:, 2] == pytest.approx(0.0, abs=0.01)
    assert sorted({round(float(abs(p[1])), 2) for _, p in under}) == [0.55, 0.85]


def test_a_ball_bears_under_its_middle(mechanism: Mechanism) -> None:
    """A track's hidden wheel: a crawler crane stood on the sides of its balls, outside of its shoes."""
    chain = ClosedChain(mechanism)
    wheel = next(b for b in mechanism.bodies if b.name == supports(mechanism, chain, chain.drawn)[0][0])
    hull = np.asarray(wheel.hull)
    middle, radius = 0.5 * (hull.min(axis=0) + hull.max(axis=0)), 0.5 * float(np.ptp(hull[:, 2]))
    turns = np.linspace(0.0, 2.0 * np.pi, 33)[:-1]
    rings = [np.stack([np.cos(a) * np.cos(turns), np.full(32, np.sin(a)), np.cos(a) * np.sin(turns)], axis=1)
             for a in np.linspace(-0.5 * np.pi, 0.5 * np.pi, 33)]  # fmt: skip
    ball = dataclasses.replace(wheel, hull=middle + radius * np.concatenate(rings))
    rolled = dataclasses.replace(mechanism, bodies=tuple(ball if b.name == wheel.name else b for b in mechanism.bodies))
    under = [p for name, p in supports(rolled, ClosedChain(rolled), chain.drawn) if name == wheel.name]
    assert len(under) == 1 and float(under[0][1]) == pytest.approx(float(middle[1]), abs=1e-6)


def test_a_load_ahead_tips_it_over_the_front_wheels(mechanism: Mechanism) -> None:
    chain = ClosedChain(mechanism)
    _, moment = balance(mechanism)
    found = tipping_force(mechanism, chain, chain.drawn, np.array([3.0, 0.0, 1.0]), DOWN)
    assert found == pytest.approx(moment / 2.0, rel=1e-6)


def test_a_free_axle_bears_no_roll(mechanism: Mechanism) -> None:
    """Beside the machine a load tips it about the line from a front wheel to the axle's pivot, not over two wheels."""
    chain = ClosedChain(mechanism)
    point = np.array([1.0, 2.0, 1.0])
    free = tipping_force(mechanism, chain, chain.drawn, point, DOWN)
    stiff = dataclasses.replace(
        mechanism,
        joints=tuple(dataclasses.replace(j, free=False) if j.name == "axle_joint" else j for j in mechanism.joints),
    )
    fixed = tipping_force(stiff, ClosedChain(stiff), chain.drawn, point, DOWN)
    assert free < 0.8 * fixed


def test_what_lies_between_the_wheels_tips_nothing(mechanism: Mechanism) -> None:
    chain = ClosedChain(mechanism)
    with pytest.raises(Unmeasurable, match="no load tips"):
        tipping_force(mechanism, chain, chain.drawn, np.array([0.5, 0.0, 1.0]), DOWN)


def test_a_machine_that_does_not_stand_is_said(mechanism: Mechanism) -> None:
    heavy = tuple(dataclasses.replace(b, mass=1e5) if b.name == "boom" else b for b in mechanism.bodies)
    fallen = dataclasses.replace(mechanism, bodies=heavy)
    chain = ClosedChain(fallen)
    with pytest.raises(Unmeasurable, match="does not stand"):
        tipping_force(fallen, chain, chain.drawn, np.array([3.0, 0.0, 1.0]), DOWN)


def test_a_sites_motion_and_the_weight_agree(mechanism: Mechanism) -> None:
    """Virtual work: a load's weight at a site, by the site's motion, is what its cylinder feels more of."""
    chain = ClosedChain(mechanism)
    site = next(s for s in mechanism.sites if s.name == "load")
    boom = mechanism.body("boom")
    both = np.asarray(boom.center_of_mass) * boom.mass + 500.0 * np.asarray(site.position)
    center = tuple(float(v) for v in both / (boom.mass + 500.0))
    heavy = dataclasses.replace(boom, mass=boom.mass + 500.0, center_of_mass=center)  # type: ignore[arg-type]
    loaded = dataclasses.replace(mechanism, bodies=tuple(heavy if b.name == "boom" else b for b in mechanism.bodies))
    more = weight(ClosedChain(loaded), chain.drawn, "slide") - weight(chain, chain.drawn, "slide")
    rise = float(motion(chain, chain.drawn, "slide", site)[2])
    assert more == pytest.approx(500.0 * GRAVITY * rise, rel=1e-4)
    moved = place(chain, chain.drawn, site, 0.1) - place(chain, chain.drawn, site)
    assert moved == pytest.approx([0.1, 0.0, 0.0])


def test_force_and_area_go_with_the_sense(mechanism: Mechanism) -> None:
    assert actuator_force(mechanism, "boom", positive=True) == 2e5
    assert actuator_force(mechanism, "boom", positive=False) == 1.3e5
    assert actuator_area(mechanism, "boom", positive=True) == pytest.approx(math.pi / 4 * 0.1**2)
    assert actuator_area(mechanism, "boom", positive=False) == pytest.approx(math.pi / 4 * (0.1**2 - 0.06**2))


def test_a_foot_of_many_corners_is_quick(mechanism: Mechanism) -> None:
    """A track's belt has thousands: looking for the lowest once for each took minutes."""
    around = np.linspace(0.0, 2.0 * math.pi, 20_000, endpoint=False)
    disk = np.column_stack([np.cos(around), np.sin(around), np.zeros_like(around)])
    bodies = tuple(dataclasses.replace(b, hull=disk) if b.name == mechanism.root else b for b in mechanism.bodies)
    footed = dataclasses.replace(mechanism, bodies=bodies)
    chain = ClosedChain(footed)
    start = time.thread_time()  # not the process's: what works in the background is none of its work
    under = supports(footed, chain, chain.drawn)
    assert len([name for name, _ in under if name == mechanism.root]) == len(disk)
    assert time.thread_time() - start < 1.0


def test_a_locked_cylinder_keeps_its_damping() -> None:
    """Twice of it made an empty excavator bucket, a tenth of the mass it was sized for, buzz at 1 ms."""
    drive = Drive("position", 1e7, 1e6, 4e5, 0.5)
    held = locked(drive)
    assert held.damping == drive.damping and held.stiffness == 4.0 * drive.stiffness and held.max_force > 1e8
