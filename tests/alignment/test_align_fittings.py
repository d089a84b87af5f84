"""Machines with fittings by the hundred: found as quickly and as well as without, and each bolt on what it sits on."""

from __future__ import annotations

import numpy as np
import pytest

from kit.machines.defects import crowded
from kit.machines.solids import bolt, box
from kit.machines.synthetic import disguise, loader
from yellowiron.alignment import align
from yellowiron.alignment.features.distance import touch_of
from yellowiron.alignment.features.solids import solids_of
from yellowiron.alignment.labelling.fittings import MANY, fittings_of, sitting
from yellowiron.alignment.labelling.place import DOUBTFUL, Place
from yellowiron.library import load_template
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.specification import Specifications


def test_few_small_parts_are_parts_like_others() -> None:
    assembly, _, _ = disguise(loader(1), 1)
    assert fittings_of(assembly) == set()


def test_no_pin_and_no_part_of_a_cylinder_is_a_fitting() -> None:
    machine = loader(1)
    sound = len(machine.parts)
    assembly, truth, _ = disguise(crowded(machine, sound + MANY + 50), 1)
    fittings = fittings_of(assembly)
    assert len(fittings) >= MANY + 50
    pins = {r.name for r in load_template("wheel_loader").roles if r.kind == "pin"}
    assert not {truth[p][0] for p in fittings} & pins


@pytest.mark.parametrize(("room", "sure"), [(0.2, True), (0.0, False)], ids=["free", "in a shoe"])
def test_a_bolt_is_of_the_plate_that_its_shank_is_in(room: float, sure: bool) -> None:
    """No corner of it is in the plate, which it goes right through; its head may be drawn into what is beside."""
    shapes = {s.key: s for s in (box("plate", 1.0, 1.0, 0.02), box("shoe", 0.5, 0.5, 0.1), bolt("bolt", 0.01, 0.04))}
    high = {"plate": 0.0, "shoe": 0.065 + room, "bolt": 0.01}
    parts = []
    for key, shape in shapes.items():
        place = np.eye(4)
        place[2, 3] = high[shape.name]
        parts.append(Part(shape.name, shape.name, (), key, place))
    assembly = Assembly("some", "synthetic", 1.0, tuple(parts), shapes)
    found = {name: Place(name, name, 0.95, "") for name in ("plate", "shoe")}
    solids = solids_of(assembly)
    place = sitting(found, {"bolt"}, solids, touch_of(assembly, 1e-3))["bolt"]
    assert place.body == "plate"
    assert (place.confidence > DOUBTFUL) == sure


@pytest.mark.slow
def test_a_crowd_of_bolts_hides_nothing() -> None:
    template = load_template("wheel_loader")
    machine = loader(1)
    assembly, truth, _ = disguise(crowded(machine, len(machine.parts) + 600), 1)
    found = align(assembly, template, Specifications())
    assert found.missing == ()
    bolts = {p for p in fittings_of(assembly) if truth[p][1]}
    wrong = [p.part for p in found.parts if p.part in bolts and p.body != truth[p.part][1]]
    assert len(wrong) < 0.03 * len(bolts)  # a bolt through a gap between two bodies holds to both
    silent = set(wrong) - set(found.to_review)
    assert len(silent) < 0.015 * len(bolts)
    assert all(p.reason for p in found.parts if p.part in bolts)
