"""A stranger's machine in named assemblies, without a pin or a bore, under a template that was written by hand."""

from __future__ import annotations

from collections import Counter

import pytest

from kit.machines.dump_truck import BODIES, HIERARCHY, JOINTS, dump_truck
from kit.small import write_type
from yellowiron.library import lint, load_template
from yellowiron.model.alignment import Alignment, Decisions, PartDecision
from yellowiron.model.assembly import Assembly
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template
from yellowiron.stages import find_roles


@pytest.fixture(scope="module")
def template(tmp_path_factory: pytest.TempPathFactory) -> Template:
    return load_template(write_type(tmp_path_factory.mktemp("type") / "dumper", hierarchy=HIERARCHY, joints=JOINTS))


@pytest.fixture(scope="module")
def found(template: Template) -> tuple[Assembly, Alignment]:
    return find_roles(dump_truck(), template, Specifications())


def test_the_template_is_sound(template: Template) -> None:
    assert not [f for f in lint(template).findings if f.severity == "error"]


@pytest.mark.slow
def test_parts_are_in_their_bodies(found: tuple[Assembly, Alignment]) -> None:
    """An eye between the two halves of its cylinder is a guess, and asked."""
    _, alignment = found
    wrong = {p.part: p.body for p in alignment.parts if p.body != BODIES[p.part]}
    assert alignment.missing == ()
    assert len(wrong) <= 2
    assert all(part.endswith("EYE") for part in wrong)
    assert wrong.keys() <= set(alignment.to_review)
    counts = Counter(p.body for p in alignment.parts)
    assert counts["dump_body"] == 13 and counts["hitch"] == 2


def test_what_lies_against_another_assembly_goes_with_its_own(found: tuple[Assembly, Alignment]) -> None:
    """The hoists' feet lie flat against the chassis, five millimetres from it, and are in the cylinders' assemblies."""
    bodies = {p.part: p.body for p in found[1].parts}
    for side in "LR":
        assert bodies[f"DUMPER D30/HOIST CYLINDER {side}/FOOT EYE"] == f"tip_cyl_tube_{side.lower()}"


@pytest.mark.slow
def test_three_decisions_place_everything(found: tuple[Assembly, Alignment], template: Template) -> None:
    assembly, alignment = found
    wrong = [p.part for p in alignment.parts if p.body != BODIES[p.part]]
    decided = Decisions(parts={part: PartDecision(BODIES[part], "edited") for part in wrong})
    assert len(wrong) <= 3
    _, again = find_roles(assembly, template, Specifications(), decisions=decided)
    assert {p.part: p.body for p in again.parts} == BODIES
