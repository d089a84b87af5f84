"""Unseen mobile cranes without names: every part in its body, whatever the sections, the luffing cylinders and the
hook; which axle and which outriggers are in front is told by where they stand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kit.machines.cranes import crane
from kit.machines.synthetic import Machine, disguise
from kit.machines.unseen import found_whole
from yellowiron import library
from yellowiron.alignment import align
from yellowiron.alignment.assignment.symmetries import alike_branches
from yellowiron.alignment.labelling.track_places import without_tracks
from yellowiron.model.specification import Specifications
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
    template = without_tracks(choose(library.load_template("mobile_crane"), {}))
    assert alike_branches(template, {}) == [BEAMS, ["front_steering_piston_rod", "rear_steering_piston_rod"]]
    # What names say of one of them tells it from the others.
    assert alike_branches(template, {(3, "rear_outrigger_jack_l"): 40}) == [
        ["front_steering_piston_rod", "rear_steering_piston_rod"]
    ]
    telehandler = choose(library.load_template("telehandler"), {"stabilizers": "hinged"})
    assert alike_branches(telehandler, {}) == [["stabilizer_l", "stabilizer_r"]]


@pytest.mark.slow
def test_an_axle_between_the_type_s_own_rolls_on_the_carrier() -> None:
    """As near to the front as to the rear one: the two at the ends are the type's, whose knuckles are drawn."""
    machine = crane(5)
    ahead = np.eye(4)
    ahead[0, 3] = 0.5 * (_middle(machine, "front_wheel_l") - _middle(machine, "rear_wheel_l"))
    for part in [p for p in machine.parts if machine.truth[p.id][1] in ("rear_wheel_l", "rear_wheel_r")]:
        copy = replace(part, id=f"{part.id} further", transform=ahead @ part.transform)
        machine.parts.append(copy)
        machine.truth[copy.id] = ("further", f"further_wheel_{machine.truth[part.id][1][-1]}_1")
    assembly, truth, _ = disguise(machine, 5)
    found = align(assembly, library.load_template("mobile_crane"), Specifications())
    assert [(truth[p.part], p.body) for p in found.parts if p.body != truth[p.part][1]] == []


def _middle(machine: Machine, body: str) -> float:
    """How far ahead a body's middle is, metres."""
    parts = [p for p in machine.parts if machine.truth[p.id][1] == body]
    ahead = [machine.shapes[p.shape].mesh.points @ p.transform[0, :3] + p.transform[0, 3] for p in parts]
    return 0.5 * float(np.concatenate(ahead).min() + np.concatenate(ahead).max())
