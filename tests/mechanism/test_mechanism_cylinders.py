"""Cylinders: closed length, stroke, forces and speeds, by sheet, by geometry and by default."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from mechanism_machine import (
    BORE,
    EXTENSION,
    LENGTH,
    PRESSURE,
    ROD,
    STROKE,
    box,
    machine,
    specification,
    specifications,
    template,
)

from yellowiron.mechanism import build_mechanism
from yellowiron.mechanism.actuation.cylinder_geometry import CylinderGeometry
from yellowiron.mechanism.actuation.cylinders import WALL, _Sizes, _usual_stroke
from yellowiron.mechanism.values import Known
from yellowiron.model.assembly import Assembly
from yellowiron.model.mechanism import Cylinder, Mechanism
from yellowiron.model.specification import Specifications
from yellowiron.model.template import CylinderTemplate, JointTemplate, Role, Template


def build(*, extension: float = EXTENSION, plan: Template | None = None, **values: float) -> Mechanism:
    assembly, alignment = machine(extension=extension)
    return build_mechanism(assembly, plan or template(), alignment, specifications(**values), name="crane")


def codes(built: Mechanism) -> set[str]:
    return {f.code for f in built.findings}


def only(built: Mechanism) -> Cylinder:
    (cylinder,) = built.cylinders
    return cylinder


@pytest.mark.parametrize("extension", [0.0, 0.02, 0.15, 0.4])
def test_extension_is_how_far_the_piston_is_off_the_base(extension: float) -> None:
    built = build(extension=extension)
    cylinder, slide = only(built), built.joint("slide")
    assert cylinder.drawn_length == pytest.approx(LENGTH)
    assert cylinder.extension == pytest.approx(extension, abs=1e-9)
    assert (slide.lower, slide.upper) == pytest.approx((-extension, STROKE - extension), abs=1e-9)
    assert not codes(built) & {"MEC020", "MEC021", "MEC022", "MEC023", "MEC024"}


def test_sizes_come_from_the_geometry_and_forces_from_the_sizes() -> None:
    cylinder = only(build(Pressure=PRESSURE))
    assert (cylinder.bore, cylinder.rod_diameter) == pytest.approx((BORE, ROD))
    assert cylinder.push_force == pytest.approx(PRESSURE * math.pi / 4 * BORE**2)
    assert cylinder.pull_force == pytest.approx(PRESSURE * math.pi / 4 * (BORE**2 - ROD**2))
    assert cylinder.sources["bore"].startswith("geometry")


def test_the_sheet_wins_and_the_difference_is_told() -> None:
    built = build(Bore=0.12)
    assert only(built).bore == 0.12
    assert "MEC020" in codes(built)


def test_a_printed_closed_length_wins_and_the_geometry_is_compared() -> None:
    plan = template()
    lift = replace(plan.actuators[0], specifications={**plan.actuators[0].specifications, "closed_length": "Closed"})
    built = build(plan=replace(plan, actuators=(lift,)), Closed=0.8)
    assert only(built).closed_length == 0.8
    assert "piston against base" in only(built).sources["closed_length"]


def test_a_stroke_that_the_piston_cannot_travel_is_a_finding() -> None:
    assert "MEC021" in codes(build(Stroke=0.41))


def test_a_missing_stroke_is_the_piston_s_travel() -> None:
    assembly, alignment = machine()
    built = build_mechanism(assembly, template(), alignment, Specifications(), name="crane")
    assert only(built).stroke == pytest.approx(STROKE)
    assert built.joint("slide").upper == pytest.approx(STROKE - EXTENSION)
    assert "MEC023" in codes(built)


def test_a_stroke_that_nothing_shows_is_what_cylinders_of_that_length_have() -> None:
    """Of six cylinders of the examples (bore, closed length, stroke in mm): within a bore and a half of the rest."""
    known = [
        (140, 2180, 1490),
        (120, 1690, 1105),
        (130, 1930, 1334),
        (180, 1130, 540),
        (150, 1240, 764),
        (95, 745, 441),
    ]
    for bore, closed, stroke in known:
        sizes = _Sizes(
            template().actuators[0].cylinders[0], "b", "r", CylinderGeometry(to_eye=0.1), Known(bore, ""), Known(0, "")
        )
        assert _usual_stroke(sizes, closed + 0.1) == pytest.approx(stroke, abs=1.5 * bore)
        no_bore = replace(sizes, bore=Known(0.0, ""), geometry=CylinderGeometry())
        assert _usual_stroke(no_bore, closed + 0.5 * stroke) == pytest.approx(stroke, rel=0.35)


def limited(upper: float | str, document: str = "") -> Template:
    plan = template()
    said = {"limit": document} if document else {}
    joints = (replace(j, upper=upper, documents=said) if j.name == "slide" else j for j in plan.joints)
    return replace(plan, joints=tuple(joints))


def test_a_document_s_limit_is_the_stroke_and_names_the_document() -> None:
    assembly, alignment = machine()
    for sheet in (Specifications(), specifications()):
        built = build_mechanism(assembly, limited(0.35, "mine.json"), alignment, sheet, name="crane")
        cylinder, slide = only(built), built.joint("slide")
        assert cylinder.stroke == 0.35 and cylinder.sources["stroke"].startswith("data: mine.json: limit of slide")
        assert (slide.lower, slide.upper) == pytest.approx((-EXTENSION, 0.35 - EXTENSION))
        assert slide.source["limits"] == "data: mine.json"
        assert "MEC023" not in codes(built)


def test_a_stroke_set_by_hand_wins_over_a_limit_that_is_a_number() -> None:
    assembly, alignment = machine()
    by_hand = Specifications({"Stroke": replace(specification("Stroke", STROKE), source="set", evidence=None)})
    built = build_mechanism(assembly, limited(0.35, "mine.json"), alignment, by_hand, name="crane")
    assert only(built).stroke == STROKE
    assert built.joint("slide").upper == pytest.approx(STROKE - EXTENSION)
    assert built.joint("slide").source["upper_source"] == "set"


def test_a_template_s_own_number_yields_to_the_sheet_and_stands_in_for_it() -> None:
    assembly, alignment = machine()
    alone = build_mechanism(assembly, limited(0.35), alignment, Specifications(), name="crane")
    assert only(alone).sources["stroke"].startswith("template: limit of slide") and "MEC023" not in codes(alone)
    assert only(build(plan=limited(0.35))).stroke == STROKE


def test_a_drawn_pose_outside_the_limits_is_a_finding() -> None:
    built = build(extension=0.3, Stroke=0.2)
    assert "MEC024" in codes(built)
    assert built.joint("slide").upper == pytest.approx(-0.1)


def without_features(assembly: Assembly, *names: str) -> Assembly:
    shapes = {k: replace(s, cylinders=()) if k in names else s for k, s in assembly.shapes.items()}
    return replace(assembly, shapes=shapes)


def test_nothing_shown_is_mid_stroke_and_says_so() -> None:
    assembly, alignment = machine()
    built = build_mechanism(
        without_features(assembly, "barrel", "rod"), template(), alignment, specifications(), name="crane"
    )
    assert only(built).extension == pytest.approx(STROKE / 2)
    assert only(built).sources["closed_length"].startswith("unknown")
    assert {"MEC003", "MEC022"} <= codes(built)
    assert built.joint("slide").axis == pytest.approx(np.array([0.7, 0.0, 0.6]) / math.hypot(0.7, 0.6))


def test_a_barrel_that_shows_nothing_round_is_as_thick_as_it_is_drawn() -> None:
    """It had no bore, and 0 N: its actuator stood still."""
    assembly, alignment = machine()
    boxed = {"barrel": box("barrel", (0.12, 0.16, 0.6), at=(0.0, 0.0, 0.3))}
    assembly = replace(without_features(assembly, "rod"), shapes={**assembly.shapes, **boxed})
    built = build_mechanism(assembly, template(), alignment, specifications(), name="crane")
    assert only(built).bore == pytest.approx(WALL * 0.12)
    assert only(built).push_force == pytest.approx(PRESSURE * math.pi / 4 * (WALL * 0.12) ** 2)
    assert "MEC029" in codes(built)


def test_what_is_as_thick_as_it_is_long_gives_no_bore() -> None:
    assembly, alignment = machine()
    lump = {"barrel": box("barrel", (0.3, 0.3, 0.4), at=(0.0, 0.0, 0.3))}
    assembly = replace(without_features(assembly, "rod"), shapes={**assembly.shapes, **lump})
    built = build_mechanism(assembly, template(), alignment, specifications(), name="crane")
    assert only(built).bore == 0.0


def test_speed_is_flow_over_area_or_the_cycle_time() -> None:
    assert only(build(Flow=0.002)).speed == pytest.approx(0.002 / (math.pi / 4 * BORE**2))
    plan = template()
    lift = replace(plan.actuators[0], specifications={**plan.actuators[0].specifications, "extend_time": "Raise Time"})
    timed = only(build(plan=replace(plan, actuators=(lift,)), Flow=0.002, Raise_Time=5.0))
    assert timed.speed == pytest.approx(STROKE / 5.0)
    assert "by flow" in timed.sources["speed"]


def twin_template(sign: int) -> Template:
    """The crane with a second cylinder beside the first: same parts again, passive."""
    plan = template()
    roles = (
        *plan.roles,
        Role("twin_barrel_pin", "base", False, "pin"),
        Role("twin_rod_pin", "arm", False, "pin"),
        Role("twin_barrel", "base", True, "barrel"),
        Role("twin_rod", "arm", True, "rod"),
    )
    joints = (
        *plan.joints,
        JointTemplate("base2twin", "revolute", ("twin_barrel", "twin_barrel_pin")),
        JointTemplate("arm2twin", "revolute", ("twin_rod", "twin_rod_pin")),
        JointTemplate("twin_slide", "prismatic", ("twin_barrel", "twin_rod"), "0", "Stroke", "linear"),
    )
    second = CylinderTemplate("twin_slide", "base2twin", "arm2twin", sign=sign, passive=True)
    lift = replace(plan.actuators[0], cylinders=(second, *plan.actuators[0].cylinders))
    return replace(plan, roles=roles, joints=joints, actuators=(lift,))


def build_twin(sign: int, *, alone: bool = False, misplaced: bool = False) -> Mechanism:
    """The twin's parts are the first cylinder's, moved 0.2 m aside; `alone`: nobody plays the first cylinder;
    `misplaced`: both of its pivots were found in one place."""
    assembly, alignment = machine()
    aside = np.eye(4)
    aside[1, 3] = 0.2
    copied = [p for p in assembly.parts if p.name in ("PIN C", "PIN D", "BARREL", "ROD")]
    parts = tuple(replace(p, id=p.id + "#2", transform=aside @ p.transform) for p in copied)
    rename = {"barrel_pin": "twin_barrel_pin", "rod_pin": "twin_rod_pin"}
    bodies = {"cylinder_barrel": "twin_barrel", "cylinder_rod": "twin_rod"}
    rename |= bodies
    assigned = {a.part: a for a in alignment.parts}
    more = tuple(
        replace(a, part=a.part + "#2", role=rename[str(a.role)], body=bodies.get(str(a.body), a.body))
        for a in (assigned[p.id] for p in copied)
    )
    first = alignment.parts
    if alone:
        first = tuple(replace(a, role=None, body=None) if a.body in bodies else a for a in first)
    axes = {"base2barrel": ((1.0, 0.0, 1.001), (0.0, 1.0, 0.0))} if misplaced else {}
    return build_mechanism(
        replace(assembly, parts=assembly.parts + parts),
        twin_template(sign),
        replace(alignment, parts=first + more, axes=axes, by_hand=frozenset(axes)),
        Specifications(
            {s.name: s for s in (specification("Stroke", STROKE), specification("Pressure", PRESSURE, "Pa"))}
        ),
        name="crane",
    )


@pytest.mark.parametrize("sign", [1, -1])
def test_the_driven_twin_carries_both_and_the_passive_follows(sign: int) -> None:
    built = build_twin(sign)
    driven, passive = (next(c for c in built.cylinders if c.passive is p) for p in (False, True))
    drive = built.joint("slide").drive
    assert drive is not None and built.joint("twin_slide").drive is None
    other = passive.push_force if sign > 0 else passive.pull_force
    assert drive.max_force == pytest.approx(driven.push_force + other)
    assert built.actuators[0].joints[0].joint == "slide"
    assert built.joint("arm2twin").cut
    assert not built.joint("twin_slide").cut
    wide = built.joint("twin_slide")
    assert wide.lower is not None and wide.lower < -passive.extension


@pytest.mark.parametrize("how", ["alone", "misplaced"])
def test_a_twin_left_alone_is_driven_in_its_place(how: str) -> None:
    built = build_twin(1, **{how: True})
    (left,) = built.cylinders
    assert left.slide == "twin_slide" and not left.passive
    drive = built.joint("twin_slide").drive
    assert drive is not None and drive.max_force == pytest.approx(left.push_force)
    assert built.joint("base2arm").cut, "its loop is cut at the structural pin, as any driven cylinder's"
    assert "MEC028" in {f.code for f in built.findings}
