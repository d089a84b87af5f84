"""Proposed templates: names, entries, actuators, and that they load and pass the lint."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from yellowiron import library
from yellowiron.library.proposal.naming import proposed_names
from yellowiron.model.found import FoundBody, FoundJoint, FoundMachine
from yellowiron.support.text import to_json

ACROSS, UP = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def body(kind: str, *labels: str, parts: int = 1) -> FoundBody:
    return FoundBody(tuple(f"{labels[0] if labels else kind}#{k}" for k in range(parts)), kind, labels, "found")


def hinge(
    a: int, b: int, *, pins: tuple[str, ...] = (), loop: bool = True, upright: bool = False, **more: Any
) -> FoundJoint:
    point = more.get("point", (float(a), 0.0, float(b)))
    return FoundJoint("revolute", a, b, point, UP if upright else ACROSS, 0.05, pins, "a pin", loop, upright)


def slide(a: int, b: int, point: tuple[float, float, float] = (0.0, 0.0, 0.0), *, loop: bool = True) -> FoundJoint:
    return FoundJoint("prismatic", a, b, point, (1.0, 0.0, 0.0), 0.03, (), "a rod", loop)


def machine(*labels: tuple[str, ...]) -> FoundMachine:
    """A base that turns on a foot, an arm on it, and two cylinders on either side of the arm's hinge; a free tool."""
    kinds = ("frame", "frame", "arm", "barrel", "rod", "barrel", "rod", "arm")
    named = [*labels, *([()] * (len(kinds) - len(labels)))]
    bodies = tuple(body(kind, *own) for kind, own in zip(kinds, named, strict=True))
    joints = (
        hinge(0, 1, loop=False, upright=True),
        hinge(1, 2, point=(0.0, 0.0, 0.0), pins=("PIN",)),
        hinge(1, 3),
        slide(3, 4, (0.0, 0.0, -1.0)),
        hinge(2, 4),
        hinge(1, 5),
        slide(5, 6, (0.0, 0.0, 1.0)),
        hinge(2, 6),
        hinge(2, 7, loop=False),
    )
    return FoundMachine("machine", bodies, 0, joints)


def test_names_that_mean_something() -> None:
    found, reasons = proposed_names(
        machine(
            ("UNDERCARRIAGE ASSY", "PLATE"),
            ("HOUSE",),
            ("Boom1__Boom1.stl",),
            ("LIFT CYL", "LIFT CYL TUBE"),
            ("LIFT CYL", "LIFT CYL ROD"),
            ("Part_012",),
            ("Mesh_22-mesh",),
            ("KübelGruppe",),
        )
    )
    assert found[:5] == ["undercarriage", "house", "boom1", "lift_cyl_tube", "lift_cyl_rod"]
    assert found[5:7] == ["boom1_cylinder_barrel", "boom1_piston_rod"]
    assert found[7] == "kubel_gruppe"
    assert reasons[0] == "named after 'UNDERCARRIAGE ASSY'"
    assert reasons[5] == "no name of its parts says what it is"


def test_names_that_mean_nothing() -> None:
    found, _ = proposed_names(machine(*((f"Object_{k:03d}",) for k in range(8))))
    assert found[0] == "base"
    assert len(set(found)) == len(found)
    assert found[3:5] == ["body_2_cylinder_barrel_1", "body_2_piston_rod_1"]


def test_a_machine_loads_and_is_sound(tmp_path: Path) -> None:
    proposal = library.propose(machine(("Foot",), ("House",), ("Arm",)), name="digger")
    for kind, document in proposal.documents.items():
        (tmp_path / f"{kind}.json").write_text(to_json(document), encoding="utf-8")
    template = library.load_template(tmp_path)
    assert (template.equipment_type, template.root) == ("digger", "foot")
    lint = library.lint(template)
    assert lint.sound
    assert lint.mobility[0].computed == lint.mobility[0].expected == 3
    assert (lint.counts["revolute"], lint.counts["prismatic"]) == (7, 2)
    cylinders = next(a for a in template.actuators if a.kind == "cylinder").cylinders
    assert [(c.sign, c.passive) for c in cylinders] == [(1, False), (-1, True)]
    swing = next(a for a in template.actuators if a.kind == "motor")
    assert swing.joints == ("foot2house_joint",)
    pin = template.joint("house2arm_joint")
    assert set(pin.parts) == {"arm", "arm_pin"}
    tool = template.joint("arm2body_7_joint")
    assert (tool.lower, tool.upper, tool.drive) == ("-Body 7 Angle Down", "Body 7 Angle Up", "angular")
    assert "| `arm` |" in proposal.words


def test_a_hoist_whose_rod_stands_on_the_chassis(tmp_path: Path) -> None:
    """The rod is nearer to the root than the barrel: the pivots are named by what they carry, not by the order."""
    bodies = tuple(body(kind, name) for kind, name in
                   (("frame", "Chassis"), ("arm", "Bed"), ("rod", "Hoist rod"), ("barrel", "Hoist tube")))  # fmt: skip
    joints = (hinge(0, 1, pins=("PIN",)), hinge(0, 2), slide(2, 3, (0.0, 0.0, -1.0)), hinge(1, 3))
    proposal = library.propose(FoundMachine("tipper", bodies, 0, joints), name="tipper")
    for kind, document in proposal.documents.items():
        (tmp_path / f"{kind}.json").write_text(to_json(document), encoding="utf-8")
    template = library.load_template(tmp_path)
    (cylinder,) = next(a for a in template.actuators if a.kind == "cylinder").cylinders
    assert "hoist_tube" in template.bodies_of(template.joint(cylinder.barrel_joint))
    assert "hoist_rod" in template.bodies_of(template.joint(cylinder.rod_joint))
    assert library.lint(template).sound


def test_no_part_is_left_out_of_the_words() -> None:
    found = machine(("Foot",))
    bodies = (body("frame", "Foot", parts=40), *found.bodies[1:])
    words = library.propose(FoundMachine("m", bodies, 0, found.joints), name="digger").words
    assert all(f"- Foot#{k}\n" in words for k in range(40))
    assert "and 35 more" in words


@pytest.mark.parametrize("tracks", [0, 2])
def test_tracks_have_their_rows(tmp_path: Path, tracks: int) -> None:
    found = machine(("Foot",))
    found = FoundMachine(found.name, found.bodies, 0, found.joints, tracks)
    proposal = library.propose(found, name="digger")
    rows = proposal.documents["hierarchy"]["digger"]["child"]["foot"]["child"]
    assert ("track_shoe_l[*]" in rows) is (tracks == 2)
