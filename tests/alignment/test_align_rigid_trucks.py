"""Unseen rigid dump trucks without names: every part in its body, twin tyres in one wheel; one of three axles."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kit.machines.rigid_trucks import rigid_truck
from kit.machines.synthetic import Machine, disguise
from kit.machines.unseen import found_whole
from yellowiron.alignment import align
from yellowiron.library import load_template
from yellowiron.model.geometry import Floats
from yellowiron.model.specification import Specifications


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize("seed", [501, 502, 503])
def test_every_part_is_in_its_body(seed: int, triangles: bool) -> None:
    machine = rigid_truck(seed)
    found_whole(machine, "rigid_dump_truck", seed, triangles=triangles)


def test_an_axle_that_the_type_does_not_have_stands_still_and_is_asked_about() -> None:
    """A third one, close behind the second: its wheels are no dump body, nor do they leave the front ones out."""
    machine = rigid_truck(5)
    radius = 0.5 * float(np.ptp(_points(machine, "front_tyre_l")[:, 2]))
    behind = np.eye(4)
    behind[0, 3] = -2.02 * radius
    for part in [p for p in machine.parts if machine.truth[p.id][1].startswith("rear_wheel")]:
        copy = replace(part, id=f"{part.id} third", transform=behind @ part.transform)
        machine.parts.append(copy)
        machine.truth[copy.id] = ("third", "chassis")
    assembly, truth, _ = disguise(machine, 5)
    found = align(assembly, load_template("rigid_dump_truck"), Specifications())
    assert [(truth[p.part], p.body) for p in found.parts if p.body != truth[p.part][1]] == []
    assert {part for part, (role, _) in truth.items() if role == "third"} <= set(found.to_review)


def _points(machine: Machine, role: str) -> Floats:
    (part,) = (p for p in machine.parts if machine.truth[p.id][0] == role)
    return machine.shapes[part.shape].mesh.points @ part.transform[:3, :3].T
