"""Unseen forklifts without names: every part in its body, whatever the mast."""

from __future__ import annotations

import pytest

from kit.machines.lift_trucks import lift_truck
from kit.machines.synthetic import disguise
from kit.machines.unseen import found_whole
from yellowiron.alignment.readings import align
from yellowiron.library import load_template
from yellowiron.model.specification import Specifications


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize(("seed", "mast"), [(301, "simplex"), (302, "duplex"), (303, "triplex")])
def test_every_part_is_in_its_body(seed: int, mast: str, triangles: bool) -> None:
    machine = lift_truck(seed, mast)
    found = found_whole(machine, "forklift", seed, triangles=triangles)
    assert found.choices == {"mast": mast}


@pytest.mark.slow
@pytest.mark.parametrize("seed", [77101, 77103])
def test_a_fitting_that_is_sunk_in_two_bodies_is_for_review(seed: int) -> None:
    """A port of a tilt cylinder, 11 mm long, that reaches into the chassis as far."""
    assembly, truth, _ = disguise(lift_truck(seed), seed)
    found = align(assembly, load_template("forklift"), Specifications())
    wrong = {p.part: p.runner_up for p in found.parts if p.body != truth[p.part][1]}
    assert set(wrong) <= set(found.to_review) and len(found.to_review) <= 1
    assert all(second == truth[part][1] for part, second in wrong.items())
