"""Pose tables against the solver: exact where they were solved, near enough to look at between."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from planar_zbar import sketch, strokes, zbar_mechanism
from pose_reference import pose

from yellowiron.kinematics import ClosedChain, pose_tables

BETWEEN = 2e-3
"""Metres between the solver's pose and an interpolated one, anywhere on a body."""
AT_NODES = 1e-9


@pytest.fixture(scope="module")
def loader():
    z = sketch()
    return zbar_mechanism(z, strokes(z))


def gap(chain, tables, given) -> float:
    """Largest distance in metres of any body's hull between the tables' pose and the solver's."""
    solved, read = chain.pose(chain.solve(given)), pose(chain.mechanism, tables, given)
    return max(
        float(np.abs(np.c_[b.hull, np.ones(len(b.hull))] @ (solved[b.name] - read[b.name]).T).max())
        for b in chain.mechanism.bodies
    )


def test_nodes_are_exact_and_groups_combine(loader):
    chain, tables = ClosedChain(loader), pose_tables(loader)
    assert sorted(len(table.drivers) for table in tables.tables) == [1, 2]
    random = np.random.default_rng(3)
    for _ in range(10):
        given = {
            driver: float(random.choice(axis))
            for table in tables.tables
            for driver, axis in zip(table.drivers, table.axes, strict=True)
        }
        assert gap(chain, tables, given) <= AT_NODES


def test_between_nodes_it_is_near_with_everything_moved(loader):
    chain, tables = ClosedChain(loader), pose_tables(loader)
    looped = {driver for table in tables.tables for driver in table.drivers}
    random = np.random.default_rng(4)
    for _ in range(30):
        given = {name: float(random.uniform(-1.0, 1.0)) for name in tables.independent if name not in looped}
        for table in tables.tables:
            given |= {d: float(random.uniform(a[0], a[-1])) for d, a in zip(table.drivers, table.axes, strict=True)}
        assert gap(chain, tables, given) <= BETWEEN


def test_the_drawn_pose_is_where_it_was_drawn(loader):
    assert gap(ClosedChain(loader), pose_tables(loader), {}) <= BETWEEN


def test_a_drawn_pose_beyond_a_stop_is_where_it_was_drawn(loader):
    """Else what is read off it, such as a stop set where the machine stands, is the old stop's."""
    slides = {c.slide: 0.02 for c in loader.cylinders}
    joints = tuple(replace(j, lower=slides[j.name]) if j.name in slides else j for j in loader.joints)
    beyond = replace(loader, joints=joints)
    tables = pose_tables(beyond)
    assert [axis[0] for table in tables.tables for axis in table.axes if axis[0] == 0.0]
    assert gap(ClosedChain(beyond), tables, {}) <= AT_NODES


def test_what_cannot_be_reached_repeats_its_neighbour(loader):
    """The lift cylinder may now go far past the dead point."""
    joints = tuple(replace(j, upper=j.upper + 2.0) if j.name == "lift_l" else j for j in loader.joints)
    tables = pose_tables(replace(loader, joints=joints))
    (table,) = (t for t in tables.tables if "lift_l" in t.drivers)
    assert table.clamped > 0
    assert np.isfinite(table.values).all()
    lift = table.drivers.index("lift_l")
    ends = np.take(table.values, [-2, -1], axis=lift)
    assert np.array_equal(*np.moveaxis(ends, lift, 0))


def test_without_limits_there_is_no_table(loader):
    joints = tuple(replace(j, lower=None, upper=None) if j.name == "lift_l" else j for j in loader.joints)
    assert all("lift_l" not in table.drivers for table in pose_tables(replace(loader, joints=joints)).tables)


def test_ball_joints_are_read_as_quaternions(loader):
    """A rod that ends in a ball joint follows as one with a pin does."""
    name = next(j.name for j in loader.joints if not j.cut and j.type == "revolute" and "rod_l" in j.name)
    joints = tuple(replace(j, type="spherical") if j.name == name else j for j in loader.joints)
    ball = replace(loader, joints=joints)
    chain, tables = ClosedChain(ball), pose_tables(ball)
    (table,) = (t for t in tables.tables if name in t.dependent)
    given = {d: float(a[len(a) // 3]) for d, a in zip(table.drivers, table.axes, strict=True)}
    assert gap(chain, tables, given) <= AT_NODES
