"""Cylinders whose halves are fixed, beside what looks like one, and how they hold together."""

from __future__ import annotations

import numpy as np
import pytest

from kit.machines.solids import place, tube
from yellowiron.alignment.features.contacts import neighbours
from yellowiron.alignment.features.cylinders import cylinders_of
from yellowiron.alignment.features.solids import Solid, solids_of
from yellowiron.alignment.structure.clusters import structure_of
from yellowiron.alignment.structure.contact_evidence import Contacts, evidence_of
from yellowiron.model.assembly import Assembly, Part

TOLERANCE = 4e-4


def along(**bars: tuple[float, float, float, float]) -> tuple[Solid, ...]:
    """Tubes about one axis: outer and inner radius (0: a bar), from where to where."""
    shapes = {name: tube(name, outer, inner, high - low) for name, (outer, inner, low, high) in bars.items()}
    parts = tuple(
        Part(name, name, ("A",), name, place((0.0, 0.0, low), (0.0, 0.0, 1.0))) for name, (_, _, low, _) in bars.items()
    )
    return solids_of(Assembly("a", "synthetic", 1.0, parts, shapes))


def through(out: float) -> tuple[Solid, ...]:
    """A ram whose rod comes out at both ends, drawn `out` of its middle."""
    return along(
        barrel=(0.05, 0.04, -0.15, 0.15),
        gland=(0.04, 0.02275, 0.11, 0.15),
        rod=(0.0225, 0.0, out - 0.33, out + 0.33),
        piston=(0.03975, 0.0225, out - 0.02, out + 0.02),
    )


@pytest.mark.parametrize("out", [0.0, 0.08])
def test_a_rod_through_both_ends_is_a_ram_s(out: float) -> None:
    solids = through(out)
    (found,) = cylinders_of(solids, TOLERANCE, fixed=True)
    ids = [s.part.id for s in solids]
    assert found.fixed
    assert {ids[i] for i in found.barrel} == {"barrel", "gland"} and {ids[i] for i in found.rod} == {"rod", "piston"}


def test_a_wide_ram_between_pins_hangs_on_none_of_them() -> None:
    """A crane's steering cylinder, knuckles' pins to its left and right: it was told by its rod for bores of up to
    95 mm, and with 100 mm the whole crane was read as another."""
    ram = along(barrel=(0.06, 0.05, -0.15, 0.15), rod=(0.019, 0.0, -0.29, 0.29))
    eyes = {name: place((0.0, 0.0, z), (1.0, 0.0, 0.0)) for name, z in (("left", -0.35), ("right", 0.35))}
    shape = tube("eye", 0.03, 0.015, 0.04)
    parts = (*(s.part for s in ram), *(Part(name, name, ("A",), "eye", where) for name, where in eyes.items()))
    shapes = {"barrel": tube("barrel", 0.06, 0.05, 0.3), "rod": tube("rod", 0.019, 0.0, 0.58), "eye": shape}
    (found,) = cylinders_of(solids_of(Assembly("a", "synthetic", 1.0, parts, shapes)), TOLERANCE, fixed=True)
    assert found.fixed


@pytest.mark.parametrize(("boss", "pin"), [(0.222, 0.28), (0.16, 0.25), (0.16, 0.22)])
def test_a_pin_in_a_boss_that_is_wider_between_its_bushes_is_no_ram(boss: float, pin: float) -> None:
    """An excavator's boom foot, arm hinge and bucket link."""
    solids = along(
        boss=(0.125, 0.06, -boss, boss),
        near=(0.06, 0.0502, -boss, 0.1 - boss),
        far=(0.06, 0.0502, boss - 0.1, boss),
        pin=(0.05, 0.0, -pin, pin),
    )
    assert cylinders_of(solids, TOLERANCE, fixed=True) == []


def test_the_halves_of_a_ram_that_touch_still_slide() -> None:
    """Drawn with less play than the tolerance, in a model whose parts hold together only where they touch."""
    solids = through(0.0)
    near = neighbours(solids, TOLERANCE)
    cylinders = cylinders_of(solids, TOLERANCE, fixed=True)
    contacts = Contacts(solids, [], [], [], cylinders, [], near, lambda a, b: True, TOLERANCE)
    structure = structure_of(evidence_of(contacts), leaves=True, weak=True, careful=False)
    (found,) = cylinders
    clusters = [np.flatnonzero([s.index in c.members for s in solids]).tolist() for c in structure.clusters]
    assert sorted(clusters) == sorted([sorted(found.barrel), sorted(found.rod)])
