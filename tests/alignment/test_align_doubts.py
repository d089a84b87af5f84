"""Answers that look whole and are not: a cylinder short, parts beside the machine, a second machine, bare wheels."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kit.machines.solids import Array, box, place
from kit.machines.synthetic import Machine, disguise, loader
from yellowiron.alignment import align
from yellowiron.alignment.labelling.propagation import Propagation
from yellowiron.library import load_template
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template

NOTHING = Specifications()
LIFT = ("boom_cylinder_barrel_l", "boom_piston_rod_l")


@pytest.fixture(scope="module")
def template() -> Template:
    return load_template("wheel_loader")


def without(machine: Machine, *roles: str) -> Machine:
    """The machine without the parts of some roles or bodies."""
    machine.parts[:] = [p for p in machine.parts if not set(machine.truth[p.id]) & set(roles)]
    return machine


def codes(found: Alignment) -> set[str]:
    return {f.code for f in found.findings if f.severity == "warning"}


@pytest.mark.parametrize(
    "gone",
    [
        pytest.param(LIFT, id="cylinder"),
        pytest.param(LIFT[1:], id="rod", marks=pytest.mark.slow),
        pytest.param(LIFT[:1], id="barrel", marks=pytest.mark.slow),
    ],
)
@pytest.mark.slow
def test_half_a_pair_is_no_single(template: Template, gone: tuple[str, ...]) -> None:
    assembly, truth, _ = disguise(without(loader(3, twin=True), *gone), 3)
    found = align(assembly, template, NOTHING)
    assert found.choices["lift_cylinders"] == "twin"
    assert set(LIFT) <= set(found.missing)
    rest = {part for part, (_, body) in truth.items() if body in set(LIFT) - set(gone)}
    assert rest <= set(found.to_review)
    assert {p.part for p in found.parts if p.body != truth[p.part][1]} == rest
    assert ("ALN007" in codes(found)) is bool(rest)


@pytest.mark.slow
def test_a_pair_taken_for_a_single(template: Template) -> None:
    assembly, truth, _ = disguise(loader(3, twin=True), 3)
    found = align(assembly, template, NOTHING, choices={"lift_cylinders": "single"})
    assert {"ALN007", "ALN008"} <= codes(found)
    rams = {part for part, (_, body) in truth.items() if body.startswith(("boom_cylinder_barrel", "boom_piston_rod"))}
    played = {p.part for p in found.parts if p.body in ("boom_cylinder_barrel", "boom_piston_rod")}
    assert played
    assert rams - played <= set(found.to_review)


@pytest.mark.parametrize("seed", [5, pytest.param(1002, marks=pytest.mark.slow)])
def test_a_single_in_the_middle(template: Template, seed: int) -> None:
    found = align(disguise(loader(seed, twin=False), seed)[0], template, NOTHING)
    assert found.choices["lift_cylinders"] == "single"
    assert (found.missing, found.to_review, codes(found)) == ((), (), set())


def beside(machine: Machine, gap: float) -> str:
    """Adds a crate behind the machine, `gap` metres from its hindmost point."""
    assembly = machine.assembly()
    points = np.concatenate([assembly.points_of(p) for p in assembly.parts])
    low = points.min(axis=0)
    at = (float(low[0]) - gap - 0.3, 0.0, float(low[2]) + 0.8)
    machine.add("crate", "", "", box("crate", 0.6, 0.6, 0.6), place(at, (0, 0, 1)))
    return machine.parts[-1].id


@pytest.mark.slow
def test_a_crate_far_away(template: Template) -> None:
    machine = loader(3)
    crate = beside(machine, 2.0)
    found = align(machine.assembly(), template, NOTHING)
    mine = next(p for p in found.parts if p.part == crate)
    assert (mine.role, mine.body) == (None, None)
    assert crate in next(f.message for f in found.findings if f.code == "ALN009")
    assert codes(found) == {"ALN009"}
    bodies = [p.body == machine.truth[p.part][1] for p in found.parts if p.part != crate]
    assert all(bodies)
    for role in ("rear_frame", None):  # a person knows better
        edits = replace(found, parts=(PartAssignment(crate, role, role, 1.0, "", "edited"),))
        again = align(machine.assembly(), template, NOTHING, edits=edits)
        assert next(p for p in again.parts if p.part == crate).body == role
        assert codes(again) == set()


def test_a_crate_nearby(template: Template) -> None:
    machine = loader(3)
    crate = beside(machine, 0.25)
    found = align(machine.assembly(), template, NOTHING)
    assert found.to_review == (crate,)
    assert next(p for p in found.parts if p.part == crate).body is not None


def test_what_floats_is_no_surer_than_what_it_floats_beside(
    template: Template, monkeypatch: pytest.MonkeyPatch
) -> None:
    machine = loader(3)
    crate = beside(machine, 0.01)

    def doubtful(self: Propagation) -> None:
        self.places = {i: replace(place, confidence=0.3) for i, place in self.places.items()}

    sure = align(machine.assembly(), template, NOTHING)
    assert crate not in sure.to_review
    monkeypatch.setattr(Propagation, "_torn", doubtful)
    found = align(machine.assembly(), template, NOTHING)
    mine = next(p for p in found.parts if p.part == crate)
    assert mine.reason.startswith("floats")
    assert crate in found.to_review


def test_two_machines_side_by_side(template: Template) -> None:
    """Their pins are on the same lines, as far as these go."""
    assembly = loader(3, steered=False).assembly()
    aside: Array = np.eye(4)
    aside[1, 3] = 7.0
    second = tuple(replace(p, id=f"B/{p.id}", transform=aside @ p.transform) for p in assembly.parts)
    found = align(Assembly("two", "synthetic", 1.0, (*assembly.parts, *second), assembly.shapes), template, NOTHING)
    alone = align(assembly, template, NOTHING)
    assert codes(found) == {"ALN009", "ALN010"}
    own = {p.part: (p.role, p.body) for p in alone.parts}
    assert {p.part: (p.role, p.body) for p in found.parts if p.body is not None} == own
    assert (found.frame == alone.frame).all()


def test_no_wheels_no_ground(template: Template) -> None:
    sides = [f"{e}_{s}" for e in ("front_wheel", "rear_wheel") for s in "lr"]
    found = align(disguise(without(loader(0), *sides), 0)[0], template, NOTHING)
    assert "ALN003" in codes(found)
    assert set(sides) <= set(found.missing)


def test_no_tyres(template: Template) -> None:
    tyres = [f"{e}_{s}" for e in ("front_tyre", "rear_tyre") for s in "lr"]
    found = align(disguise(without(loader(0), *tyres), 0)[0], template, NOTHING)
    assert codes(found) == {"ALN011"}
    assert found.missing == ()
    assert not {p.role for p in found.parts} & set(tyres)
