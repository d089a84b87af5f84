"""A crawler of 150 bodies and 640 parts: its page stays one that people can read."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import trimesh

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Mesh, Shape
from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, BodyPart, Drive, Joint, Mechanism
from yellowiron.model.poses import PoseTables
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Role, Template
from yellowiron.report import BuildFacts, page, report_document
from yellowiron.report.html.viewer import NOT_BUNDLED

SHOES, ROLLERS, BOLTS = 49, 9, 4
LENGTH, HIGH = 3.6, 0.9


def loop(share: float) -> tuple[float, float, float]:
    """A point of a track, x and z, and its direction: two straights and two half circles."""
    radius = HIGH / 2
    straight, bend = LENGTH, math.pi * radius
    way = share * 2.0 * (straight + bend)
    if way < straight:
        return way - straight / 2, 0.0, 0.0
    if way < straight + bend:
        angle = (way - straight) / radius
        return straight / 2 + radius * math.sin(angle), radius - radius * math.cos(angle), angle
    if way < 2 * straight + bend:
        return straight / 2 - (way - straight - bend), HIGH, math.pi
    angle = (way - 2 * straight - bend) / radius + math.pi
    return -straight / 2 + radius * math.sin(angle), radius - radius * math.cos(angle), angle


@pytest.fixture(scope="module")
def crawler() -> tuple[Mechanism, Assembly, Alignment]:
    shapes, parts, bodies, joints = {}, [], [], []
    for name, size in {"BODY": (4.0, 2.0, 1.2), "ARM": (5.0, 0.4, 0.5), "SHOE": (0.17, 0.6, 0.05),
                       "ROLLER": (0.16, 0.4, 0.16), "BOLT": (0.02, 0.02, 0.05)}.items():  # fmt: skip
        box = trimesh.creation.box(size)
        mesh = Mesh(np.array(box.vertices), np.array(box.faces, dtype=np.int32))
        shapes[name] = Shape(name, name, mesh, 1.0, 1.0, np.zeros(3), np.eye(3))

    def body(name: str, at: tuple[float, float, float], *content: str, angle: float = 0.0) -> None:
        place = np.eye(4)
        place[:3, :3] = trimesh.transformations.rotation_matrix(-angle, (0, 1, 0))[:3, :3]
        place[:3, 3] = at
        own = []
        for number, shape in enumerate(content):
            identity = f"CRAWLER/{name}/{shape}#{number}"
            parts.append(Part(identity, shape, ("CRAWLER", name), shape, place))
            own.append(BodyPart(identity, name, "steel", "none", 1.0))
        points = shapes[content[0]].mesh.points @ place[:3, :3].T + place[:3, 3]
        bodies.append(Body(name, at, 10.0, at, np.eye(3), tuple(own), points))

    def hinge(name: str, one: str, other: str, at: tuple[float, float, float], **more: Any) -> None:
        joints.append(Joint(name, "revolute", one, other, at, more.pop("axis", (0, 1, 0)), **more))

    motor = Drive("velocity", 0.0, 1.0, 4e4, 1.2)
    body("undercarriage", (0, 0, 0.6), "BODY")
    body("upperstructure", (0, 0, 1.9), "BODY")
    hinge("swing_joint", "undercarriage", "upperstructure", (0, 0, 1.2), axis=(0, 0, 1), drive=motor)
    body("boom", (3.0, 0, 2.5), "ARM")
    hinge("upperstructure2boom_joint", "upperstructure", "boom", (0.6, 0, 2.2), lower=-0.4, upper=0.9)
    for side, y in (("l", 1.3), ("r", -1.3)):
        for number in range(1, ROLLERS + 1):
            at = (-1.5 + 3.0 * (number - 1) / (ROLLERS - 1), y, 0.2)
            body(f"track_roller_{side}_{number}", at, "ROLLER")
            hinge(f"undercarriage2track_roller_{side}_joint_{number}", "undercarriage",
                  f"track_roller_{side}_{number}", at, free=True)  # fmt: skip
        for number in range(1, SHOES + 1):
            x, z, angle = loop((number - 1) / SHOES)
            body(f"track_shoe_{side}_{number}", (x, y, z + 0.03), "SHOE", *["BOLT"] * BOLTS, angle=angle)
            before = f"track_shoe_{side}_{number - 1}" if number > 1 else f"track_roller_{side}_1"
            hinge(f"track_shoe_{side}2track_shoe_{side}_joint_{number}", before, f"track_shoe_{side}_{number}",
                  (x, y, z + 0.03), free=True)  # fmt: skip
    for number in range(100):
        parts.append(Part(f"CRAWLER/spare#{number}", "spare", ("CRAWLER",), "BOLT", np.eye(4)))
    mechanism = Mechanism(
        "crawler", "crawler", "undercarriage", tuple(bodies), tuple(joints),
        actuators=(Actuator("swing", "motor", (ActuatorJoint("swing_joint"),)),),
    )  # fmt: skip
    owner = {bp.part: b.name for b in bodies for bp in b.parts}
    alignment = Alignment(
        "crawler", np.eye(4),
        tuple(PartAssignment(p.id, owner.get(p.id), owner.get(p.id), 0.9, "seen") for p in parts),
    )  # fmt: skip
    return mechanism, Assembly("CRAWLER", "step", 1.0, tuple(parts), shapes), alignment


def made(crawler: tuple[Mechanism, Assembly, Alignment]) -> str:
    mechanism, assembly, alignment = crawler
    template = Template("crawler", "", "undercarriage", (Role("undercarriage", None, True),), ())
    document = report_document(BuildFacts(mechanism, template, alignment, Specifications({})))
    tables = PoseTables(tuple(joint.name for joint in mechanism.joints), ())
    return page(document, mechanism, assembly, alignment, tables=lambda: tables)


@pytest.mark.slow
def test_rows_of_a_track_are_read_as_one(crawler: tuple[Mechanism, Assembly, Alignment]) -> None:
    mechanism, assembly, _ = crawler
    assert len(mechanism.bodies) > 110 and len(assembly.parts) > 600
    text = made(crawler)
    names = re.search(r'<ol class="names">(.*?)</ol>', text, re.S)
    assert names and names.group(1).count("<li>") == 6
    assert "track_shoe_l2track_shoe_l_joint_1 … _49" in names.group(1).replace("<wbr>", "")
    assert text.count('<g class="mark') == 6
    assert text.count('class="dot"') == len(mechanism.joints)
    bodies = re.search(r'<div class="bodies">(.*?)<h2', text, re.S)
    assert bodies and bodies.group(1).count("<details") == 3 + 4 + 1
    assert "49 bodies, 245 parts" in bodies.group(1)
    assert "left out of the machine" in bodies.group(1)
    assert text == made(crawler)


def test_a_report_whose_view_was_not_bundled_says_so(
    crawler: tuple[Mechanism, Assembly, Alignment], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("yellowiron.report.html.page.script", lambda package, name: "")
    text = made(crawler)
    assert f'<figcaption id="viewer-caption">As drawn in the CAD model. {NOT_BUNDLED}' in text
    assert "<script" not in text and '<img alt="The machine in the drawn pose"' in text


def test_only_what_a_person_would_set_has_a_slider(crawler: tuple[Mechanism, Assembly, Alignment]) -> None:
    from yellowiron.report.html.viewer import _readouts, _sliders

    mechanism, *_ = crawler
    names = tuple(joint.name for joint in mechanism.joints)
    tables = PoseTables(names, (), dict.fromkeys(names, 0.0))
    assert [slider["name"] for slider in _sliders(mechanism, tables)] == ["swing", "upperstructure2boom_joint"]
    # A body that nobody sees, and that carries nothing, is nothing to turn by hand.
    at = (0.0, 0.0, 0.3)
    support = Body("track_support_l_1", at, 1.0, at, np.eye(3), (), np.zeros((0, 3)))
    axle = Joint("undercarriage2track_support_l_joint_1", "revolute", "undercarriage", support.name, at, (0, 1, 0))
    hidden = replace(mechanism, bodies=(*mechanism.bodies, support), joints=(*mechanism.joints, axle))
    assert len(_sliders(hidden, replace(tables, independent=(*names, axle.name)))) == 2
    assert _readouts(mechanism, tables) == ["swing_joint", "upperstructure2boom_joint"]
