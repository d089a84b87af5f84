"""Overlapping bodies."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from yellowiron.usd.planning.overlap import overlapping_bodies
from yellowiron.usd.planning.plan import make_plan


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
