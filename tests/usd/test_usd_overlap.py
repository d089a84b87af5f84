"""Overlapping bodies: oriented boxes against a collision library's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from yellowiron.usd.planning.overlap import _boxes_overlap, overlapping_bodies
from yellowiron.usd.planning.plan import make_plan


def test_boxes_against_fcl() -> None:
    fcl = pytest.importorskip("fcl")
    generator = np.random.default_rng(3)
    count = 300
    centers = generator.uniform(-1.0, 1.0, size=(2 * count, 3))
    halves = generator.uniform(0.05, 0.8, size=(2 * count, 3))
    axes = Rotation.random(2 * count, rng=generator).as_matrix()
    axes[:40] = np.eye(3)  # parallel edges, whose cross products vanish
    first, second = np.arange(0, 2 * count, 2), np.arange(1, 2 * count, 2)
    found = _boxes_overlap(centers, axes, halves, first, second, 0.0)
    for hit, i, j in zip(found, first, second, strict=True):
        objects = [
            fcl.CollisionObject(fcl.Box(*(2.0 * halves[k])), fcl.Transform(np.ascontiguousarray(axes[k]), centers[k]))
            for k in (i, j)
        ]
        assert bool(hit) == (fcl.collide(*objects, fcl.CollisionRequest(), fcl.CollisionResult()) > 0)
    assert 0.2 < found.mean() < 0.9


def test_bodies_that_overlap_and_bodies_that_do_not(machine) -> None:
    pairs = set(overlapping_bodies(make_plan(machine.mechanism, machine.assembly, np.eye(4), "m")))
    assert ("frame", "cab") in pairs
    assert ("barrel", "rod") not in pairs  # drawn apart, though jointed
    assert not any("chain" in pair and "frame" in pair for pair in pairs)


def test_parts_without_collider_do_not_count(machine) -> None:
    bodies = tuple(
        replace(b, parts=tuple(replace(p, collision="none") for p in b.parts)) for b in machine.mechanism.bodies
    )
    plan = make_plan(replace(machine.mechanism, bodies=bodies), machine.assembly, np.eye(4), "m")
    assert overlapping_bodies(plan) == []
