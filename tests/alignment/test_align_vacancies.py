"""A machine whose root nothing was found for: it may be read across, what is left over may be the root, and what goes
with a neighbour for want of it is for a person to look at."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import trimesh

from yellowiron.alignment import align
from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.alignment.assignment.root_fallback import with_root
from yellowiron.alignment.features.solids import solids_of
from yellowiron.alignment.fusion import evidence, reading
from yellowiron.alignment.fusion.stance import Stance, stance_of
from yellowiron.alignment.labelling.suspects import Vacancies
from yellowiron.alignment.structure.clusters import Cluster, Hinge, Structure
from yellowiron.cad.mesh.assembly import Occurrence, assemble
from yellowiron.library import load_template
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Mesh
from yellowiron.model.specification import Specifications
from yellowiron.model.template import choose


def block(size: tuple[float, float, float], at: tuple[float, float, float]) -> trimesh.Trimesh:
    return trimesh.creation.box(size, transform=trimesh.transformations.translation_matrix(at))


def crane(aside: float) -> Assembly:
    """A truck crane of four meshes, the boom so many metres to the left: a nameless base with axles and outriggers in
    one mesh, and what stands on it, named."""
    axles = [block((1.2, 2.4, 0.6), (x, 0.0, 0.4)) for x in (-4.6, -1.5, 1.5, 4.6)]
    beams = [block((0.5, 5.5, 0.4), (x, 0.0, 0.25)) for x in (-3.2, 3.2)]
    drawn = {
        "base": trimesh.util.concatenate([block((11.0, 2.4, 1.2), (0.0, 0.0, 1.2)), *axles, *beams]),
        "superstructure": block((4.4, 2.5, 1.9), (-2.0, 0.0, 2.75)),
        "boom": block((10.0, 0.9, 1.0), (0.0, aside, 4.2)),
        "inner_boom": block((10.4, 0.6, 0.7), (0.0, aside, 4.2)),
    }
    parts = [
        Occurrence(name, ("crane",), Mesh(np.asarray(m.vertices), np.asarray(m.faces, dtype=np.int32)), np.eye(4))
        for name, m in drawn.items()
    ]
    return assemble(parts, name="crane", format="test", unit=1.0, path="")


def base_of(found: Alignment) -> PartAssignment:
    return next(p for p in found.parts if p.part.endswith("/base"))


def read(aside: float) -> Alignment:
    return align(crane(aside), load_template("mobile_crane"), Specifications())


def across(*given: Any, **more: Any) -> Stance:
    """As the machine stands, taken to face across, where nobody says which way it faces."""
    found = stance_of(*given, **more)
    forward, left, up = found.rotation
    return found if found.told else replace(found, rotation=np.array([left, -forward, up]))


@pytest.mark.slow
def test_a_machine_without_its_base_is_looked_at_the_other_way(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[Stance] = []
    look = reading.across

    def spied(*given: Any) -> list[evidence.Evidence]:
        found = look(*given)
        seen.extend(one.stance for one in found)
        return found

    monkeypatch.setattr(evidence, "stance_of", across)
    monkeypatch.setattr(reading, "across", spied)
    read(0.0)
    forward, behind = (stance.rotation for stance in seen)
    assert abs(forward[0, 0]) == pytest.approx(1.0, abs=0.01)
    assert behind[0] == pytest.approx(-forward[0])
    assert forward[2] == pytest.approx((0.0, 0.0, 1.0), abs=0.01)
    assert not any(stance.told for stance in seen)


@pytest.mark.slow
def test_what_is_left_over_is_the_root_for_want_of_one() -> None:
    """The boom far aside makes the machine less alike to the left and right than in front and behind."""
    found = read(0.9)
    base = base_of(found)
    assert base.body == "carrier"
    assert base.reason.startswith("the largest that is left over")
    assert base.part in found.to_review


@pytest.mark.slow
def test_what_may_be_the_missing_root_is_no_sure_part_of_its_neighbour(monkeypatch: pytest.MonkeyPatch) -> None:
    """More than half of the surface was silently the superstructure's, because it lies flat against it."""
    monkeypatch.setattr(Vacancies, "root", lambda _: {})
    found = read(0.9)
    base = base_of(found)
    assert base.body == "superstructure"
    assert base.reason == "lies flat against superstructure; but it may be carrier, which is not found"
    assert base.runner_up == "carrier"
    assert base.part in found.to_review


@pytest.mark.parametrize(("crumb", "held", "root"), [(0.05, False, 2), (0.05, True, 0), (1.0, False, 0)])
def test_a_crumb_that_no_joint_holds_is_no_root(crumb: float, held: bool, root: int) -> None:
    """A shell of a boom's mesh had become the undercarriage of a public excavator, whose tracks went with its house."""
    drawn = [
        block((crumb, crumb, crumb), (3.0, 0.0, 3.0)),  # in the boom
        block((4.0, 2.5, 2.0), (0.0, 0.0, 2.2)),  # left over of the house
        block((4.0, 0.6, 1.0), (0.0, 1.2, 0.5)), block((1.0, 0.6, 1.0), (0.0, -1.2, 0.5)),  # on the ground
        block((5.0, 0.5, 0.5), (3.0, 0.0, 3.0)),
    ]  # fmt: skip
    meshes = [Mesh(np.asarray(m.vertices), np.asarray(m.faces, dtype=np.int32)) for m in drawn]
    placed = [Occurrence(f"part {k}", (), mesh, np.eye(4)) for k, mesh in enumerate(meshes)]
    solids = solids_of(assemble(placed, name="machine", format="test", unit=1.0, path=""))
    template = choose(load_template("excavator"), {"boom_cylinders": "single", "boom_type": "mono", "blade": "none"})
    number = {s.part.name: s.index for s in solids}
    structure = Structure(tuple(Cluster(frozenset({number[f"part {k}"]})) for k in range(len(solids))))
    hinges = {"undercarriage2upperstructure_joint": 0} if held else {}
    structure = replace(structure, hinges=(Hinge(0, 1, 0, ()),) if held else ())
    told = Solution({0: template.root, 4: "boom"}, hinges, {}, 0, 0, True)
    found = with_root(told, structure, solids, template, np.array([0.0, 0.0, 1.0]))
    assert [c for c, body in found.body_of.items() if body == template.root] == [root]
    assert found.body_of[4] == "boom"
