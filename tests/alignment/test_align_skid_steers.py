"""Unseen skid steers without names: every part in its body, whichever way they lift."""

from __future__ import annotations

from dataclasses import replace

import pytest

from kit.machines.defects import on_triangles
from kit.machines.skid_steers import skid_steer
from kit.machines.synthetic import disguise
from yellowiron import library
from yellowiron.alignment.pipeline import align
from yellowiron.model.specification import Specifications


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize(
    ("seed", "path", "single"),
    [(201, "vertical", False), (202, "radial", False), (203, "vertical", True), (204, "radial", True)],
)
def test_every_part_is_in_its_body(seed: int, path: str, single: bool, triangles: bool) -> None:
    machine = skid_steer(seed, path, single_tilt=single)
    if triangles:
        machine = replace(machine, shapes=on_triangles(machine.shapes))
    assembly, truth, back = disguise(machine, seed)
    found = align(assembly, library.load_template("skid_steer"), Specifications())
    assert found.choices == {"lift_path": path, "tilt_cylinders": "single" if single else "twin"}
    wrong = [(truth[p.part], p.body) for p in found.parts if p.body != truth[p.part][1]]
    assert wrong == [] and not found.missing
    turned = found.frame[:3, :3] @ back[:3, :3].T
    assert abs(turned[0, 0] - 1.0) < 1e-3 and abs(turned[2, 2] - 1.0) < 1e-3
