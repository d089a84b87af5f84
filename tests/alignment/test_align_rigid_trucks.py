"""Unseen rigid dump trucks without names: every part in its body, twin tyres in one wheel; one of three axles."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kit.machines.rigid_trucks import rigid_truck
from kit.machines.synthetic import Machine, disguise
from kit.machines.unseen import found_whole
from yellowiron.alignment import align
from yellowiron.alignment.labelling.further_axles import FurtherWheel, further_wheels
from yellowiron.alignment.labelling.place import DOUBTFUL, Place
from yellowiron.library import load_template
from yellowiron.model.geometry import Floats
from yellowiron.model.specification import Specifications
from yellowiron.model.template import choose


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize("seed", [501, 502, 503])
def test_every_part_is_in_its_body(seed: int, triangles: bool) -> None:
    machine = rigid_truck(seed)
    found_whole(machine, "rigid_dump_truck", seed, triangles=triangles)


@pytest.mark.parametrize("count", [1, 2])
def test_axles_that_the_type_does_not_have_roll_on_its_frame(count: int) -> None:
    """Further ones, close behind the rear one: their wheels are no dump body, nor do they leave the front ones out."""
    machine = rigid_truck(5)
    radius = 0.5 * float(np.ptp(_points(machine, "front_tyre_l")[:, 2]))
    rear = [p for p in machine.parts if machine.truth[p.id][1] in ("rear_wheel_l", "rear_wheel_r")]
    rear += [p for p in machine.parts if "rear axle case" in p.id]
    for number in range(1, count + 1):
        behind = np.eye(4)
        behind[0, 3] = -2.02 * radius * number
        for part in rear:
            copy = replace(part, id=f"{part.id} further {number}", transform=behind @ part.transform)
            body = machine.truth[part.id][1].replace("rear", "further")
            machine.parts.append(copy)
            machine.truth[copy.id] = ("further", f"{body}_{number}" if "wheel" in body else "chassis")
    assembly, truth, _ = disguise(machine, 5)
    found = align(assembly, load_template("rigid_dump_truck"), Specifications())
    assert [(truth[p.part], p.body) for p in found.parts if p.body != truth[p.part][1]] == []
    rows = [f"further_{kind}_{side}" for kind in ("tyre", "wheel") for side in "lr"]
    assert found.counts == dict.fromkeys(rows, count)
    assert not {part for part, (role, _) in truth.items() if role == "further"} & set(found.to_review)
    assert {f"further_wheel_{side}_joint_{count}" for side in "lr"} <= found.axes.keys()


@pytest.mark.parametrize("sure", [0.95, DOUBTFUL])
def test_a_further_wheel_is_no_surer_than_the_wheel_beside_it(sure: float) -> None:
    """A truck that was read back to front had all but these for review: 7.5 % of it was wrong without a word."""
    template = choose(load_template("rigid_dump_truck"), {})
    wheel = FurtherWheel(frozenset({"tyre", "rim"}), frozenset({"tyre"}), np.zeros(3), np.array([0.0, 1, 0]), "rear")
    beside = {"rear": Place("rear_tyre_l", "rear_wheel_l", sure, "a ring")}
    found = further_wheels([wheel], beside, template, {"chassis", "rear_wheel_l"}, np.eye(4))
    assert {place.confidence for place in found.places.values()} == {min(sure, 0.9)}
    assert all(("in doubt" in place.reason) == (sure == DOUBTFUL) for place in found.places.values())


def _points(machine: Machine, role: str) -> Floats:
    (part,) = (p for p in machine.parts if machine.truth[p.id][0] == role)
    return machine.shapes[part.shape].mesh.points @ part.transform[:3, :3].T
