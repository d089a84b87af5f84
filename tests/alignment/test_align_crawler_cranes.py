"""Unseen crawler cranes without names: every part in its body, whatever the boom's sections, the falls and the ring."""

from __future__ import annotations

import pytest

from kit.machines.defects import spoiled
from kit.machines.unseen import found_whole


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize("seed", [301, 304])
def test_every_part_is_in_its_body(seed: int, triangles: bool) -> None:
    found_whole(spoiled("crawler_crane", seed, "sound"), "crawler_crane", seed, triangles=triangles)


def test_bodies_drawn_as_one_solid_each_are_found() -> None:
    found_whole(spoiled("crawler_crane", 303, "merged"), "crawler_crane", 303, triangles=False)
