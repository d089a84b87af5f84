"""What a machine stands on is no part of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kit.machines.damages import EXTRA, damaged
from kit.machines.defects import drawn
from kit.machines.solids import box
from kit.machines.synthetic import Machine, disguise
from yellowiron.alignment import align
from yellowiron.alignment.features.ground import grounds_of
from yellowiron.alignment.features.separate_parts import separate_parts
from yellowiron.library import load_template
from yellowiron.model.specification import Specifications


def _standing(machine: Machine, wider: float) -> tuple[Machine, str]:
    """The machine on a slab so many times as long and wide, and the slab's id."""
    points = np.concatenate([machine.assembly().points_of(p) for p in machine.parts])
    low, high = points.min(axis=0), points.max(axis=0)
    length, width = wider * (high - low)[:2]
    slab = replace(machine, parts=list(machine.parts), shapes=dict(machine.shapes), truth=dict(machine.truth))
    place = np.eye(4)
    place[:3, 3] = [*(0.5 * (low + high))[:2], low[2] - 0.05]
    slab.pose = np.eye(4)
    slab.add("slab", "", "", box("slab", length, width, 0.1), place)
    return slab, slab.parts[-1].id


@pytest.mark.parametrize("kind", ["loader", "excavator"])
def test_a_slab_under_the_machine_is_the_ground(kind: str) -> None:
    machine, slab = _standing(drawn(kind, 3), 1.5)
    assert separate_parts(machine.assembly()) == {slab: 0.0}
    assert separate_parts(machine.assembly(), [slab]) == {}
    assert separate_parts(machine.assembly(), grounds=False) == {}


def test_a_slab_narrower_than_the_machine_may_be_a_part_of_it() -> None:
    machine, _ = _standing(drawn("loader", 3), 0.8)
    assert separate_parts(machine.assembly()) == {}


def test_a_model_of_few_parts_may_have_a_base() -> None:
    machine, _ = _standing(drawn("loader", 3), 1.5)
    points = [machine.assembly().points_of(p) for p in machine.parts]
    assert grounds_of(points) == [len(points) - 1]
    assert grounds_of(points[-6:]) == []


def test_a_machine_on_a_slab_is_told_as_without() -> None:
    machine, slab = _standing(drawn("loader", 3), 1.5)
    assembly, truth, _ = disguise(machine, 3)
    found = align(assembly, load_template("wheel_loader"), Specifications())
    ground = [p for p in found.parts if p.reason.startswith("lies under")]
    assert [(p.role, p.body, truth[p.part][0]) for p in ground] == [(None, None, "")]
    assert "ALN009" in {f.code for f in found.findings}
    assert slab in machine.truth
    assert all(p.body == truth[p.part][1] for p in found.parts if truth[p.part][1])


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "seed"), [("excavator", 4), ("loader", 4), ("loader", 5)])
def test_a_smaller_machine_and_a_trailer_beside_it_are_no_parts_of_it(kind: str, seed: int) -> None:
    """The smaller machine may have more parts, and both stand nearer than what is far for all that is drawn."""
    machine = damaged(kind, seed, "extras")
    beside = {part for part, (role, _) in machine.truth.items() if role == EXTRA}
    driver = {p.id for p in machine.parts if p.name.startswith("Driver")}
    assert set(separate_parts(machine.assembly())) == beside - driver
    assert separate_parts(damaged(kind, seed, "sound").assembly()) == {}


def test_a_block_that_only_a_thin_plate_is_near_is_near_the_machine_and_asked_about() -> None:
    """No second machine, and too large to be taken for a part of what is nearest without a look."""
    machine, _ = _standing(drawn("excavator", 3), 1.5)
    machine.parts.pop()
    every = [machine.assembly().points_of(p) for p in machine.parts]
    rear = min(every, key=lambda points: float(points[:, 0].min()))
    points = np.concatenate(every)
    low, size = points.min(axis=0), float(np.linalg.norm(np.ptp(points, axis=0)))
    middle, away = 0.5 * (rear.min(axis=0) + rear.max(axis=0)), 0.1 * size
    for name, along, across, up, x in (
        ("plate", 0.8 * away, 0.2 * size, 0.00005 * size, low[0] - 0.5 * away),
        ("block", 0.2 * size, 0.2 * size, 0.2 * size, low[0] - away - 0.1 * size),
    ):
        place = np.eye(4)
        place[:3, 3] = [x, middle[1], middle[2] + 0.05 * size]
        machine.add(name, "", "", box(name, along, across, up), place)
    block = machine.parts[-1].id
    assert separate_parts(machine.assembly()) == {}
    found = align(machine.assembly(), load_template("excavator"), Specifications())
    (part,) = (p for p in found.parts if p.part == block)
    assert part.reason.startswith("floats")
    assert block in found.to_review
