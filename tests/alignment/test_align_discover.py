"""Bodies and joints of machines of no known type, by geometry alone."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from kit.machines.crawler import merged
from kit.machines.excavators import any_features, excavator
from kit.machines.solids import box, tube
from kit.machines.synthetic import disguise, loader
from kit.machines.telescope import crane
from yellowiron.alignment import discover
from yellowiron.library import load_template
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.errors import AlignmentError
from yellowiron.model.found import FoundMachine
from yellowiron.model.geometry import Shape
from yellowiron.model.template import choose

TRACKS = ("sprocket", "idler", "track", "carrier")
Pairs = set[tuple[frozenset[str], str]]


def bodies(found: FoundMachine, truth: dict[str, str]) -> list[str]:
    """The true body of each one found: that of most of its parts; none is found twice, and none holds two."""
    named = []
    for body in found.bodies:
        inside = {truth[p] for p in body.parts} - {""}
        assert len(inside) == 1, inside
        named += inside
    assert [b for b, n in Counter(named).items() if n > 1] == []
    return named


def joined(found: FoundMachine, named: list[str]) -> Pairs:
    return {(frozenset((named[j.a], named[j.b])), j.type) for j in found.joints}


def wanted(equipment_type: str, choices: dict[str, str], there: set[str]) -> Pairs:
    template = choose(load_template(equipment_type), choices)
    pairs = set()
    for joint in template.joints:
        ends = frozenset(str(b) for b in template.bodies_of(joint))
        if ends <= there and not any(b.startswith(TRACKS) for b in ends):
            pairs.add((ends, joint.type))
    return pairs


def check(found: FoundMachine, truth: dict[str, str], wanted: Pairs) -> None:
    """Every wanted joint and no other; where three bodies are on one pin, two of the three pairs will do."""
    named = bodies(found, truth)
    got = joined(found, named)
    on: dict[tuple[object, ...], set[str]] = {}
    for joint in found.joints:
        if joint.type == "revolute":
            on.setdefault(joint.pins or joint.point, set()).update((named[joint.a], named[joint.b]))
    three = [group for group in on.values() if len(group) > 2]
    assert [p for p in wanted - got if not any(p[0] <= group for group in three)] == []
    assert [p for p in got - wanted if not any(p[0] <= group for group in three)] == []


@pytest.mark.parametrize("seed", [6])
def test_a_nameless_loader(seed: int) -> None:
    machine = loader(seed)
    assembly, roles, _ = disguise(machine, seed)
    truth = {part: body for part, (_, body) in roles.items()}
    twin = "boom_cylinder_barrel_l" in truth.values()
    found = discover(assembly)
    check(found, truth, wanted("wheel_loader", {"lift_cylinders": "twin" if twin else "single"}, set(truth.values())))
    assert bodies(found, truth)[found.root] == "rear_frame"
    assert found.findings == ()


@pytest.mark.parametrize("seed", [4])
def test_a_nameless_excavator(seed: int) -> None:
    assembly, roles, _ = disguise(excavator(seed), seed)
    truth = {part: body for part, (_, body) in roles.items()}
    found = discover(assembly)
    check(found, truth, wanted("excavator", any_features(seed).choices(), set(truth.values())))
    assert bodies(found, truth)[found.root] == "undercarriage"
    assert found.tracks == 2
    assert [f.code for f in found.findings] == ["ALN022"]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40, 46))
def test_unseen(seed: int) -> None:
    test_a_nameless_loader(seed)
    test_a_nameless_excavator(seed)


def test_a_telescopic_boom() -> None:
    """Sections are slides of their own; the lift cylinder's chain is closed, the turntable upright."""
    assembly, truth = crane()
    found = discover(assembly)
    named = bodies(found, truth)
    assert joined(found, named) == {
        (frozenset(("chassis", "tower")), "revolute"), (frozenset(("tower", "section_0")), "revolute"),
        (frozenset(("tower", "barrel")), "revolute"), (frozenset(("section_0", "rod")), "revolute"),
        (frozenset(("barrel", "rod")), "prismatic"), (frozenset(("section_0", "section_1")), "prismatic"),
        (frozenset(("section_1", "section_2")), "prismatic"),
    }  # fmt: skip
    for joint in found.joints:
        if "section_1" in (named[joint.a], named[joint.b]):
            assert joint.direction == pytest.approx((1.0, 0.0, 0.0), abs=1e-9)
            assert joint.point[1:] == pytest.approx((0.0, 2.3), abs=1e-9)
    assert [j.loop for j in found.joints].count(True) == 4
    assert [named[j.b] for j in found.joints if j.upright] == ["tower"]


def test_a_rod_that_is_not_in_its_barrel() -> None:
    """Drawn out at the back: the slide is found along the barrel, and that the rod hangs on nothing is said."""
    assembly, truth = crane()
    along = next(p for p in assembly.parts if p.name == "BARREL TUBE").transform[:3, 2]
    away = np.eye(4)
    away[:3, 3] = -1.2 * along
    thick = tube("thick", 0.069, 0.0, 0.75)
    placed: dict[str, list[tuple[Shape, np.ndarray]]] = {"barrel": [], "rod": []}
    for part in assembly.parts:
        if (body := truth[part.id]) in placed:
            shape = thick if part.name == "ROD BAR" else assembly.shape_of(part)
            placed[body].append((shape, part.transform if body == "barrel" else away @ part.transform))
    kept = tuple(p for p in assembly.parts if truth[p.id] not in placed and p.name != "ROD PIN")
    drawn = {body: merged(body, *pieces) for body, pieces in placed.items()}
    whole = tuple(Part(f"CRANE/{body}", body, ("CRANE",), body, np.eye(4)) for body in drawn)
    found = discover(Assembly("crane", "synthetic", 1.0, (*kept, *whole), {**assembly.shapes, **drawn}))
    named = bodies(found, {**truth, "CRANE/barrel": "barrel", "CRANE/rod": "rod"})
    slide = next(j for j in found.joints if {named[j.a], named[j.b]} == {"barrel", "rod"})
    assert slide.type == "prismatic"
    assert np.asarray(slide.direction) == pytest.approx(along, abs=1e-9)
    assert "beside its bore" in slide.reason
    assert "ALN021" in {f.code for f in found.findings}


def test_nothing_turns() -> None:
    block = box("block", 1.0, 1.0, 1.0)
    parts = tuple(Part(f"A/{k}", str(k), ("A",), "block", np.eye(4)) for k in range(2))
    with pytest.raises(AlignmentError, match="turns or slides"):
        discover(Assembly("blocks", "synthetic", 1.0, parts, {"block": block}))
    with pytest.raises(AlignmentError, match="no parts"):
        discover(Assembly("empty", "synthetic", 1.0, (), {}))
