"""Unseen rigid dump trucks without names: every part in its body, twin tyres in one wheel."""

from __future__ import annotations

import pytest

from kit.machines.rigid_trucks import rigid_truck
from kit.machines.unseen import found_whole


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize("seed", [501, 502, 503])
def test_every_part_is_in_its_body(seed: int, triangles: bool) -> None:
    machine = rigid_truck(seed)
    found_whole(machine, "rigid_dump_truck", seed, triangles=triangles)
