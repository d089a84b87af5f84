"""Unseen wheeled excavators without names: every part in its body, whatever the boom, the blade and the stabilizers."""

from __future__ import annotations

import numpy as np
import pytest

from kit.machines.defects import spoiled
from kit.machines.excavators import Features
from kit.machines.solids import Array
from kit.machines.synthetic import Machine
from kit.machines.unseen import found_whole
from kit.machines.wheeled_excavators import WheeledDigger, wheeled_excavator
from yellowiron.alignment.structure.rigid_groups import Groups

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


@pytest.mark.slow
@pytest.mark.parametrize(
    "seed", [pytest.param(1401, marks=pytest.mark.slow), 1403, pytest.param(1404, marks=pytest.mark.slow)]
)
def test_plates_in_each_other_and_wide_bearings_are_told_apart(seed: int) -> None:
    # Plates drawn into each other show little flat contact; the bearing of 1403 is as large as its wheels; where parts
    # only touch, the rod of a steering cylinder that hangs on no pins touches its barrel.
    machine = spoiled("wheeled_excavator", seed, "sound", triangles=False)
    found_whole(machine, "wheeled_excavator", seed, triangles=False)


@pytest.mark.parametrize("tagged", [False, True])
def test_what_slides_on_each_other_never_joins(tagged: bool) -> None:
    groups = Groups(4)
    groups.keep_apart(1, 2)
    if tagged:
        groups.tag({0, 1}, ("wheel", 0))
        groups.tag({2, 3}, ("wheel", 1))
    else:
        assert groups.join(1, 0) and groups.join(3, 2)
    assert not groups.may_join(0, 3) and not groups.may_join(3, 0)
    assert not groups.join(0, 3)
    assert groups.find(0) != groups.find(3)


@pytest.mark.parametrize("seed", [1300, 1303, 1306])
def test_the_drawn_machine_steers_and_bends_without_a_dead_point(seed: int) -> None:
    features = Features(two_piece=True, hoses=0)
    digger = WheeledDigger(seed, features, legs=False, embedded=False)
    machine = digger.draw()

    P = digger.P
    along = (P["S"] - P["R"]) / np.hypot(*(P["S"] - P["R"]))
    gland, piston = (
        (corners_of(machine, f"adjust {name}")[:, [0, 2]] - P["R"]) @ along for name in ("gland", "piston")
    )
    left = gland.min() - piston.max()
    longest = np.hypot(*(P["S"] - P["R"])) + left
    assert left > -1e-6
    assert longest < 0.98 * sum(np.hypot(*(P[k] - P["Q"])) for k in "RS")

    at = {
        role: 0.5 * (corners_of(machine, role).min(axis=0) + corners_of(machine, role).max(axis=0))
        for role in ("knuckle_l_pin", "tie_rod_l_pin")
    }
    arm = at["tie_rod_l_pin"] - at["knuckle_l_pin"]
    meets = at["knuckle_l_pin"] - arm * at["knuckle_l_pin"][1] / arm[1]
    assert meets[0] == pytest.approx(digger.rear_x, abs=0.01 * digger.s)


def corners_of(machine: Machine, role: str) -> Array:
    """The corners of the part with a name or a role, machine frame."""
    part = next(p for p in machine.parts if role in (p.name, machine.truth[p.id][0]))
    points = machine.shapes[part.shape].mesh.points
    return np.asarray(points @ part.transform[:3, :3].T + part.transform[:3, 3])
