"""Unseen articulated dump trucks without names: every part in its body, whatever bogie and hitch they have."""

from __future__ import annotations

import pytest

from kit.machines.articulated_trucks import articulated_truck
from kit.machines.unseen import found_whole


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize(
    ("seed", "beams", "race"), [(501, True, False), (502, True, True), (503, False, False), (504, False, True)]
)
def test_every_part_is_in_its_body(seed: int, beams: bool, race: bool, triangles: bool) -> None:
    machine = articulated_truck(seed, beams=beams, race=race)
    found = found_whole(machine, "articulated_dump_truck", seed, triangles=triangles)
    assert found.choices == {"bogie": "beams" if beams else "fixed"}
