"""Unseen articulated dump trucks without names: every part in its body, whatever bogie and hitch they have."""

from __future__ import annotations

from dataclasses import replace

import pytest

from kit.machines.articulated_trucks import articulated_truck
from kit.machines.defects import on_triangles
from kit.machines.synthetic import disguise
from yellowiron import library
from yellowiron.alignment.pipeline import align
from yellowiron.model.specification import Specifications


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize(
    ("seed", "beams", "race"), [(501, True, False), (502, True, True), (503, False, False), (504, False, True)]
)
def test_every_part_is_in_its_body(seed: int, beams: bool, race: bool, triangles: bool) -> None:
    machine = articulated_truck(seed, beams=beams, race=race)
    if triangles:
        machine = replace(machine, shapes=on_triangles(machine.shapes))
    assembly, truth, back = disguise(machine, seed)
    found = align(assembly, library.load_template("articulated_dump_truck"), Specifications())
    assert found.choices == {"bogie": "beams" if beams else "fixed"}
    wrong = [(truth[p.part], p.body) for p in found.parts if p.body != truth[p.part][1]]
    assert wrong == [] and not found.missing
    turned = found.frame[:3, :3] @ back[:3, :3].T
    assert abs(turned[0, 0] - 1.0) < 1e-3 and abs(turned[2, 2] - 1.0) < 1e-3
