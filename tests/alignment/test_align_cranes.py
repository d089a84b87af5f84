"""Unseen mobile cranes without names: every part in its body, whatever the sections, the luffing cylinders and the
hook; which axle and which outriggers are in front is told by where they stand."""

from __future__ import annotations

import pytest

from kit.machines.cranes import crane
from kit.machines.unseen import found_whole
from yellowiron import library
from yellowiron.alignment.assignment.symmetries import alike_branches
from yellowiron.model.template import choose

BEAMS = ["front_outrigger_beam_l", "front_outrigger_beam_r", "rear_outrigger_beam_l", "rear_outrigger_beam_r"]


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize(
    ("seed", "sections", "twin", "hook"), [(10, 2, True, True), (13, 3, False, True), (16, 4, True, False)]
)
def test_every_part_is_in_its_body(seed: int, sections: int, twin: bool, hook: bool, triangles: bool) -> None:
    machine = crane(seed, sections=sections, twin=twin, hook=hook)
    found_whole(machine, "mobile_crane", seed, triangles=triangles)


def test_branches_that_may_change_places_are_looked_for_once() -> None:
    template = choose(library.load_template("mobile_crane"), {})
    assert alike_branches(template, {}) == [BEAMS, ["front_steering_piston_rod", "rear_steering_piston_rod"]]
    # What names say of one of them tells it from the others.
    assert alike_branches(template, {(3, "rear_outrigger_jack_l"): 40}) == [
        ["front_steering_piston_rod", "rear_steering_piston_rod"]
    ]
    telehandler = choose(library.load_template("telehandler"), {"stabilizers": "hinged"})
    assert alike_branches(telehandler, {}) == [["stabilizer_l", "stabilizer_r"]]
