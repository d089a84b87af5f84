"""What is found of a drawn machine whose names are taken, turned and shuffled: all of it, or the test fails."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

from kit.machines.defects import on_triangles
from kit.machines.synthetic import Machine, disguise
from yellowiron import library
from yellowiron.alignment.readings import align
from yellowiron.model.alignment import Alignment
from yellowiron.model.specification import Specifications


def found_whole(
    machine: Machine,
    equipment_type: str,
    seed: int,
    *,
    triangles: bool,
    choices: Mapping[str, str] | None = None,
    spare: Collection[str] = (),
) -> Alignment:
    """Its alignment, every part in its body, nothing missing but what may be (`spare`), the front ahead and up above
    (0.001 of a unit vector); from surfaces or from triangles alone, a person's `choices` made."""
    if triangles:
        machine = replace(machine, shapes=on_triangles(machine.shapes))
    assembly, truth, back = disguise(machine, seed)
    found = align(assembly, library.load_template(equipment_type), Specifications(), choices=choices)
    wrong = [(truth[p.part], p.body) for p in found.parts if p.body != truth[p.part][1]]
    assert wrong == [] and set(found.missing) <= set(spare)
    turned = found.frame[:3, :3] @ back[:3, :3].T
    assert abs(turned[0, 0] - 1.0) < 1e-3 and abs(turned[2, 2] - 1.0) < 1e-3
    return found
