"""Contacts of geometry as it comes: coarse bores, loose pins, parts drawn twice, shoes of slightly different sizes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kit.machines.damages import damaged
from kit.machines.defects import drawn, merged_bodies, no_pins
from kit.machines.solids import plate, tube
from kit.machines.synthetic import Machine, disguise
from yellowiron.alignment import align
from yellowiron.alignment.copies import copies_of
from yellowiron.alignment.features.contacts import fits_of
from yellowiron.alignment.features.distance import Touch
from yellowiron.alignment.features.solids import Cyl, coaxial, solids_of
from yellowiron.alignment.features.tracks import tracks_of
from yellowiron.alignment.features.undrilled import rimmed_fits_of
from yellowiron.library import load_template
from yellowiron.model.specification import Specifications

OUTLINE = np.array([[-0.2, -0.1], [0.2, -0.1], [0.2, 0.1], [-0.2, 0.1]])


def _pinned(radius: float) -> Machine:
    """Two plates with bores of 50 mm radius, and a pin through both."""
    machine = Machine(False)
    for k, z in enumerate((0.0, 0.05)):
        place = np.eye(4)
        place[2, 3] = z
        machine.add(f"plate{k}", "plate", "plate", plate(f"plate{k}", OUTLINE, 0.04, [(0.0, 0.0, 0.05)]), place)
    place = np.eye(4)
    place[2, 3] = -0.03
    machine.add("pin", "pin", "pin", tube("pin", radius, 0.0, 0.12), place)
    return machine


@pytest.mark.parametrize(("ratio", "held"), [(0.7, 0), (0.86, 2), (0.995, 2), (1.1, 2), (1.15, 2), (1.3, 0)])
def test_a_pin_up_to_15_percent_off_its_bores_is_in_them(ratio: float, held: int) -> None:
    solids = solids_of(_pinned(0.05 * ratio).assembly())
    assert len(fits_of(solids, 1e-5)) == held


def test_a_boss_right_through_an_empty_bore_that_is_too_narrow_is_in_it() -> None:
    solids = solids_of(_pinned(0.05 * 1.3).assembly())
    # The same bar, as a boss of a larger part.
    parts = tuple(replace(s, shaft=None) if s.part.name == "pin" else s for s in solids)
    assert len(fits_of(parts, 1e-5)) == 2


def test_a_hole_that_is_no_bore_holds_the_pin_through_it() -> None:
    machine = _pinned(0.05)
    shape = machine.shapes["plate1"]
    machine.shapes["plate1"] = replace(shape, cylinders=())
    solids = solids_of(machine.assembly())
    fits = fits_of(solids, 1e-5)
    more = rimmed_fits_of(solids, fits, Touch(solids, 1e-5))
    names = [(solids[f.inner].part.name, solids[f.outer].part.name) for f in (*fits, *more)]
    assert names == [("pin", "plate0"), ("pin", "plate1")]
    assert more[0].overlap == pytest.approx(0.04)


def test_axes_are_compared_within_what_is_known_of_them() -> None:
    one = Cyl(np.zeros(3), np.array([0.0, 0.0, 1.0]), 0.05, 0.1, 6.28, True)
    off = replace(one, center=np.array([0.0015, 0.0, 0.0]), inner=False)
    assert not coaxial(one, off, 0.02)
    assert coaxial(one, replace(off, error=0.001), 0.02)
    tilted = replace(one, direction=np.array([0.0, np.sin(0.01), np.cos(0.01)]))
    assert not coaxial(one, tilted, 0.02)
    assert coaxial(one, replace(tilted, error=0.001), 0.02)


def test_parts_drawn_twice_follow_the_first() -> None:
    machine = drawn("loader", 5)
    moved = np.eye(4)
    moved[:3, 3] = (1e-4, -2e-4, 1e-4)
    first = [p for p in machine.parts if machine.truth[p.id][1]][::7]
    again = [replace(p, id=f"{p.id}~again", transform=moved @ p.transform) for p in first]
    twice = replace(machine, parts=[*machine.parts, *again], truth=dict(machine.truth))
    twice.truth.update({f"{p.id}~again": machine.truth[p.id] for p in first})
    assert copies_of(machine.assembly()) == {}
    assert copies_of(twice.assembly()) == {f"{p.id}~again": p.id for p in first}
    assembly, truth, _ = disguise(twice, 5)
    found = align(assembly, load_template("wheel_loader"), Specifications())
    assert {p.part for p in found.parts} == set(truth)
    assert all(p.body == truth[p.part][1] for p in found.parts if truth[p.part][1])


def test_shoes_that_were_scaled_one_by_one_are_a_track() -> None:
    sound, slipped = drawn("excavator", 1), damaged("excavator", 1, "scale slips")
    rows = [[len(t.shoes) for t in tracks_of(solids_of(m.assembly()))] for m in (sound, slipped)]
    assert rows[0] == rows[1]
    assert len(rows[0]) == 2


@pytest.mark.parametrize("kind", ["loader", pytest.param("excavator", marks=pytest.mark.slow)])
def test_empty_bores_in_a_cylinders_own_part_are_its_eyes(kind: str) -> None:
    """Half of the bodies are one part each, barrels and rods with their eyes among them, and no pin is drawn."""
    rng = np.random.default_rng([0, 91])
    machine = no_pins(merged_bodies(drawn(kind, 0), rng), rng)
    assembly, truth, _ = disguise(machine, 0)
    template = load_template({"loader": "wheel_loader", "excavator": "excavator"}[kind])
    found = align(assembly, template, Specifications())
    assert all(p.body == truth[p.part][1] for p in found.parts if truth[p.part][1])
