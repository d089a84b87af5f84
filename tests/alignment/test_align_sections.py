"""Sections of a boom or a mast: a name tells which of several a thing is only beside the others."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from yellowiron.alignment import align
from yellowiron.alignment.assignment.directions import sections_of
from yellowiron.alignment.assignment.names import name_scores
from yellowiron.alignment.fusion.evidence import _NUMBERED
from yellowiron.cad.mesh.assembly import Occurrence, assemble
from yellowiron.library import load_template
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Mesh
from yellowiron.model.specification import Specifications
from yellowiron.model.template import choose


@pytest.mark.parametrize("name", ["BoomSection4", "boom_2", "Mast 03", "boom.5"])
def test_what_is_numbered_is_one_of_several(name: str) -> None:
    """ "BoomSection4", the only one left of four, was the boom without a word: 4.6 % of a crane."""
    assert _NUMBERED.search(name)


@pytest.mark.parametrize("name", ["Boom", "boom_1", "Boom.004", "Object_571", "boom2_left", "cat 320"])
def test_what_a_tool_numbers_is_not(name: str) -> None:
    assert not _NUMBERED.search(name)


def test_sections_slide_on_each_other() -> None:
    crane = choose(load_template("mobile_crane"), {"sections": "three"})
    assert sections_of(crane) == (frozenset({"boom", "middle_boom", "inner_boom"}),)
    assert not sections_of(choose(load_template("excavator"), {}))


def test_numbered_sections_may_each_be_any() -> None:
    """A crane's `BoomSection2` to `BoomSection4` were the boom: 82 → 99 % of the surface, 2 → 5 of 5 joints."""
    crane = load_template("mobile_crane")
    names = ("BoomSection1", "BoomSection2", "BoomSection3", "CraneCab")
    said = name_scores(tuple(Part(n, n, (), "", np.eye(4)) for n in names), crane)
    assert all(len({s[b] for b in ("boom", "middle_boom", "inner_boom")}) == 1 for s in said[:3])
    assert "boom" not in said[3]
    (alone,) = name_scores((Part("b", "BoomSection1", (), "", np.eye(4)),), crane)
    assert alone["boom"] > alone["inner_boom"]


def _crane_of_blocks() -> Assembly:
    """A carrier on four wheels, what turns on it, and three round sections run into each other, metres."""
    placed = trimesh.transformations.translation_matrix
    lying = trimesh.transformations.rotation_matrix(0.5 * np.pi, [0.0, 1.0, 0.0])
    rolling = trimesh.transformations.rotation_matrix(0.5 * np.pi, [1.0, 0.0, 0.0])
    found = [
        ("Chassis", trimesh.creation.box((9.0, 2.4, 0.6)), placed((0.0, 0.0, 1.2))),
        ("Cab", trimesh.creation.box((2.6, 1.6, 1.2)), placed((-1.5, 0.0, 2.15))),
    ]
    for number, (bore, radius) in enumerate(((0.42, 0.5), (0.36, 0.42), (0.0, 0.36)), 1):
        section = trimesh.creation.cylinder(radius, 8.0, sections=24)
        section = trimesh.creation.annulus(bore, radius, 8.0, sections=24) if bore else section
        found.append((f"Arm_{number}", section, placed((2.0 + 0.15 * number, 0.0, 3.3)) @ lying))
    for x in (-3.0, 3.0):
        for y in (-1.2, 1.2):
            wheel = trimesh.creation.cylinder(0.6, 0.4, sections=24)
            found.append(("Wheel", wheel, placed((x, y, 0.6)) @ rolling))
    meshes = [
        (n, Mesh(np.asarray(shape.vertices), np.asarray(shape.faces, dtype=np.int32)), at) for n, shape, at in found
    ]
    items = [Occurrence(name, (), mesh, at) for name, mesh, at in meshes]
    return assemble(items, name="crane", format="synthetic", unit=1.0, path="crane.glb")


def test_round_sections_in_each_other_are_no_pins() -> None:
    """Three of a public crane's were one cylinder and its rod: 87 → 99 % of the surface, nameless."""
    model = _crane_of_blocks()
    found = {p.part: p.body for p in align(model, load_template("mobile_crane"), Specifications()).parts}
    arms = [found[p.id] for p in model.parts if p.name.startswith("Arm")]
    assert len(set(arms)) == 3
    assert set(arms) <= {"boom", "middle_boom", "inner_boom"}
