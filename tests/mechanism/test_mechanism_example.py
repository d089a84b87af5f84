"""The example wheel loader with its true alignment: joints against `truth.json`, cylinders, cuts, sites, weights."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mechanism_machine import specification

from yellowiron.library import load_template
from yellowiron.mechanism import build_mechanism
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import CylinderFeature
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.specification import Specifications
from yellowiron.model.template import choose

pytestmark = pytest.mark.slow
ANGLE, OFFSET = math.radians(0.01), 1e-5
"""The bar: 0.01° and 0.01 mm."""


@pytest.fixture(scope="module")
def truth(example: Path) -> dict[str, Any]:
    if not (example / "truth.json").exists() or not (example / "wheel_loader.step").exists():
        pytest.skip("the example is not drawn")
    document: dict[str, Any] = json.loads((example / "truth.json").read_text(encoding="utf-8"))
    return document


@pytest.fixture(scope="module")
def assembly(truth: dict[str, Any], loader_assembly: Assembly) -> Assembly:
    return loader_assembly


def build(assembly: Assembly, truth: dict[str, Any]) -> Mechanism:
    """The mechanism by the true alignment, with the sheet's strokes and weights by their wanted names."""
    parts = tuple(PartAssignment(p, t["role"], t["body"], 1.0, "truth") for p, t in truth["parts"].items())
    starts = {"Lift Cylinder Stroke": "boom_", "Tilt Cylinder Stroke": "bucket_", "Steering Cylinder Stroke": "steer"}
    values = [
        specification(name, next(c["stroke"] for slide, c in truth["cylinders"].items() if slide.startswith(start)))
        for name, start in starts.items()
    ]
    values += [specification("Operating Weight", 25510.0, "kg"), specification("Bucket Weight", 2196.0, "kg")]
    return build_mechanism(
        assembly,
        choose(load_template("wheel_loader"), {}),
        Alignment("wheel_loader", np.array(truth["frame"]), parts),
        Specifications({v.name: v for v in values}),
        name="wheel_loader",
    )


@pytest.fixture(scope="module")
def built(assembly: Assembly, truth: dict[str, Any]) -> Mechanism:
    return build(assembly, truth)


def errors(built: Mechanism, truth: dict[str, Any], name: str) -> tuple[float, float]:
    """A joint's axis error in radians, and its anchor's across the axis in metres."""
    frame, drawn, joint = np.array(truth["frame"]), truth["joints"][name], built.joint(name)
    axis = frame[:3, :3] @ drawn["axis"]
    axis /= np.linalg.norm(axis)
    apart = np.array(joint.anchor) - (frame[:3, :3] @ drawn["anchor"] + frame[:3, 3])
    assert np.dot(joint.axis, axis) > 0.0, name
    return math.asin(np.linalg.norm(np.cross(joint.axis, axis))), float(np.linalg.norm(apart - (apart @ axis) * axis))


def test_every_joint_is_where_it_was_drawn(built: Mechanism, truth: dict[str, Any]) -> None:
    assert {j.name for j in built.joints} == set(truth["joints"])
    for name, drawn in truth["joints"].items():
        angle, offset = errors(built, truth, name)
        assert angle < ANGLE and offset < OFFSET, name
        assert {built.joint(name).body0, built.joint(name).body1} == {drawn["body0"], drawn["body1"]}, name


def test_cylinders_are_as_drawn(built: Mechanism, truth: dict[str, Any]) -> None:
    assert {c.slide for c in built.cylinders} == set(truth["cylinders"])
    for cylinder in built.cylinders:
        for quantity, drawn in truth["cylinders"][cylinder.slide].items():
            assert getattr(cylinder, quantity) == pytest.approx(drawn, abs=1e-5), (cylinder.name, quantity)
    codes = {f.code for f in built.findings}
    assert not codes & {"MEC020", "MEC021", "MEC022", "MEC023", "MEC024"}


def test_structural_pins_and_the_twins_rod_pins_are_cut(built: Mechanism) -> None:
    passive = {c.rod_joint for c in built.cylinders if c.passive}
    pins = {"rear2front_joint", "front_frame2boom_joint", "boom2rocker_joint", "boom2bucket_joint"}
    assert {j.name for j in built.joints if j.cut} == pins | passive
    assert len(passive) == 2


def test_the_edge_is_the_teeth_and_lies_as_drawn(built: Mechanism, truth: dict[str, Any]) -> None:
    edge = next(s for s in built.sites if s.name == "bucket_edge")
    angle = math.degrees(math.atan2(edge.x_axis[2], edge.x_axis[0]))
    assert angle == pytest.approx(truth["drawn"]["bucket_angle"], abs=1e-3)
    assert edge.position[1] == pytest.approx(0.0, abs=1e-9)
    foremost = built.body("bucket").hull[:, 0].max()
    assert edge.position[0] == pytest.approx(foremost, abs=0.01)


def test_weights_and_inertias(built: Mechanism) -> None:
    assert built.body("bucket").mass == pytest.approx(2196.0)
    assert sum(b.mass for b in built.bodies) == pytest.approx(25510.0)
    for body in built.bodies:
        small, middle, large = np.linalg.eigvalsh(body.inertia)
        assert small > 0.0 and large <= small + middle
    assert min(b.hull[:, 2].min() for b in built.bodies) == pytest.approx(0.0, abs=1e-3)


def test_nothing_is_wrong_with_it(built: Mechanism) -> None:
    assert [f for f in built.findings if f.severity != "info"] == []


def test_facets_do_nearly_as_well(assembly: Assembly, truth: dict[str, Any]) -> None:
    """Features as fitted to triangles: 0.02° and 4 µm off (1 σ); no planes."""
    random = np.random.default_rng(1)

    def blurred(cylinder: CylinderFeature) -> CylinderFeature:
        direction = np.array(cylinder.direction) + random.normal(0.0, math.radians(0.02), 3)
        x, y, z = np.array(cylinder.center) + random.normal(0.0, 4e-6, 3)
        u, v, w = direction / np.linalg.norm(direction)
        half = cylinder.length / 2.0
        return replace(cylinder, point=(x, y, z), direction=(u, v, w), lower=-half, upper=half, exact=False)

    shapes = {
        key: replace(shape, planes=(), exact=False, cylinders=tuple(blurred(c) for c in shape.cylinders))
        for key, shape in assembly.shapes.items()
    }
    built = build(replace(assembly, shapes=shapes), truth)
    assert {j.name for j in built.joints} == set(truth["joints"])
    for joint in built.joints:
        angle, offset = errors(built, truth, joint.name)
        # A slide may lie beside its line; only its direction moves anything.
        assert angle < 0.5 * ANGLE and (joint.type == "prismatic" or offset < 3.0 * OFFSET), joint.name
    for cylinder in built.cylinders:
        assert cylinder.closed_length == pytest.approx(truth["cylinders"][cylinder.slide]["closed_length"], abs=1e-4)
    edge = next(s for s in built.sites if s.name == "bucket_edge")
    angle = math.degrees(math.atan2(edge.x_axis[2], edge.x_axis[0]))
    assert angle == pytest.approx(truth["drawn"]["bucket_angle"], abs=0.01)
