"""Unseen telehandlers without names: every part in its body, whatever the boom's sections, its lift cylinders, its
stabilizers and its front axle."""

from __future__ import annotations

import pytest

from kit.machines.telehandlers import telehandler
from kit.machines.unseen import found_whole
from kit.scene import scene
from kit.scoring import score
from yellowiron import library
from yellowiron.alignment.assignment.weights import between_twins
from yellowiron.library import load_template
from yellowiron.model.specification import Specifications
from yellowiron.model.template import choose
from yellowiron.stages import find_roles


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize(
    ("seed", "sections", "twin", "legs", "levelled"),
    [(1110, 2, False, False, False), (1111, 3, True, False, True), (1112, 4, False, True, True)],
)
def test_every_part_is_in_its_body(
    seed: int, sections: int, twin: bool, legs: bool, levelled: bool, triangles: bool
) -> None:
    machine = telehandler(seed, sections=sections, twin=twin, legs=legs, levelled=levelled)
    found_whole(machine, "telehandler", seed, triangles=triangles)


def test_a_cylinder_between_twins_is_told_by_where_it_stands() -> None:
    """Two lift cylinders and the one that levels the forks hang on the same two bodies."""
    template = library.load_template("telehandler")
    halves = ("lift_cylinder_barrel", "compensation_cylinder_barrel"), ("lift_piston_rod", "compensation_piston_rod")
    twin = choose(template, {"lift_cylinders": "twin"})
    assert sorted(between_twins(twin)) == sorted((f"{lift}_l", middle, f"{lift}_r") for lift, middle in halves)
    assert between_twins(choose(template, {"lift_cylinders": "single"})) == []


ON_BALLS = {"dozer": ["tilt_piston_rod"], "grader": ["centre_shift_piston_rod"]}
"""What tilts a blade lies between two that angle it, what shifts a drawbar between two that lift it."""


@pytest.mark.parametrize(
    "name", [n for n in library.list_templates() if n != "telehandler" and not library.is_sheet_only(n)]
)
def test_other_types_have_no_such_three_but_on_balls(name: str) -> None:
    found = between_twins(choose(library.load_template(name), {}))
    assert [middle for _, middle, _ in found if "rod" in middle] == ON_BALLS.get(name, [])
    assert len(found) == 2 * len(ON_BALLS.get(name, []))


@pytest.mark.slow
@pytest.mark.parametrize("seed", [9300, 9301])
def test_axles_are_not_exchanged_in_silence(seed: int) -> None:
    """Of few triangles an axle may be fast on the chassis by its contacts: the arms say which one is ahead."""
    drawn = scene("telehandler", seed, "decimated 30", names="without")
    template = load_template(drawn.type)
    assembly, alignment = find_roles(drawn.assembly, template, Specifications())
    found = score(assembly, alignment, None, drawn.truth, drawn.joints, drawn.height, template)
    assert found.right / found.area > 0.9
    assert found.silent / found.area < 0.005
