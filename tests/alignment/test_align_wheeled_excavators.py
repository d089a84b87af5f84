"""Unseen wheeled excavators without names: every part in its body, whatever the boom, the blade and the stabilizers."""

from __future__ import annotations

import pytest

from kit.machines.excavators import Features
from kit.machines.unseen import found_whole
from kit.machines.wheeled_excavators import wheeled_excavator

KINDS = {
    1310: (Features(two_piece=True, blade=1), True),
    1311: (Features("single", bearing="boss", tipping="welded"), True),
    1312: (Features(blade=2, bearing="spigot"), False),
}


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize("seed", KINDS)
def test_every_part_is_in_its_body(seed: int, triangles: bool) -> None:
    features, legs = KINDS[seed]
    machine = wheeled_excavator(seed, features, legs=legs)
    found = found_whole(machine, "wheeled_excavator", seed, triangles=triangles)
    expected = features.choices() | {"stabilizers": "hinged" if legs else "none"}
    assert {name: found.choices[name] for name in expected} == expected
