"""Unseen forklifts without names: every part in its body, whatever the mast."""

from __future__ import annotations

from dataclasses import replace

import pytest

from kit.machines.defects import on_triangles
from kit.machines.lift_trucks import lift_truck
from kit.machines.synthetic import disguise
from yellowiron import library
from yellowiron.alignment.pipeline import align
from yellowiron.model.specification import Specifications


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize(("seed", "mast"), [(301, "simplex"), (302, "duplex"), (303, "triplex")])
def test_every_part_is_in_its_body(seed: int, mast: str, triangles: bool) -> None:
    machine = lift_truck(seed, mast)
    if triangles:
        machine = replace(machine, shapes=on_triangles(machine.shapes))
    assembly, truth, back = disguise(machine, seed)
    found = align(assembly, library.load_template("forklift"), Specifications())
    assert found.choices == {"mast": mast}
    wrong = [(truth[p.part], p.body) for p in found.parts if p.body != truth[p.part][1]]
    assert wrong == [] and not found.missing
    turned = found.frame[:3, :3] @ back[:3, :3].T
    assert abs(turned[0, 0] - 1.0) < 1e-3 and abs(turned[2, 2] - 1.0) < 1e-3
