"""Unseen forklifts without names: every part in its body, whatever the mast."""

from __future__ import annotations

import pytest

from kit.machines.lift_trucks import lift_truck
from kit.machines.unseen import found_whole


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize(("seed", "mast"), [(301, "simplex"), (302, "duplex"), (303, "triplex")])
def test_every_part_is_in_its_body(seed: int, mast: str, triangles: bool) -> None:
    machine = lift_truck(seed, mast)
    found = found_whole(machine, "forklift", seed, triangles=triangles)
    assert found.choices == {"mast": mast}
