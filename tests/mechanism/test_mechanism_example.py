"""The example wheel loader with its true alignment: joints against `truth.json`, cylinders, cuts, sites, weights."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mechanism_machine import specification

from yellowiron.cad import read_cad
from yellowiron.library import load_template
from yellowiron.mechanism import build_mechanism
from yellowiron.model.alignment import Alignment, PartAssignment
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
def built(truth: dict[str, Any], example: Path) -> Mechanism:
    assembly = read_cad(example / "wheel_loader.step")
    parts = tuple(PartAssignment(p, t["role"], t["body"], 1.0, "truth") for p, t in truth["parts"].items())
    # The sheet's strokes and weights, by their wanted names.
    lengths = {
        "Lift Cylinder Stroke": "boom_",
        "Tilt Cylinder Stroke": "bucket_",
        "Steering Cylinder Stroke": "steering_",
    }
    values = [
        specification(name, next(c["stroke"] for slide, c in truth["cylinders"].items() if slide.startswith(start)))
        for name, start in lengths.items()
    ]
    values += [specification("Operating Weight", 25510.0, "kg"), specification("Bucket Weight", 2196.0, "kg")]
    return build_mechanism(
        assembly,
        choose(load_template("wheel_loader"), {}),
        Alignment("wheel_loader", np.array(truth["frame"]), parts),
        Specifications({v.name: v for v in values}),
        name="wheel_loader",
    )


def test_every_joint_is_where_it_was_drawn(built: Mechanism, truth: dict[str, Any]) -> None:
    frame = np.array(truth["frame"])
    assert {j.name for j in built.joints} == set(truth["joints"])
    for name, drawn in truth["joints"].items():
        joint = built.joint(name)
        axis = frame[:3, :3] @ drawn["axis"]
        axis /= np.linalg.norm(axis)
        apart = np.array(joint.anchor) - (frame[:3, :3] @ drawn["anchor"] + frame[:3, 3])
        assert np.linalg.norm(np.cross(joint.axis, axis)) < math.sin(ANGLE), name
        assert np.linalg.norm(apart - (apart @ axis) * axis) < OFFSET, name
        assert {joint.body0, joint.body1} == {drawn["body0"], drawn["body1"]}, name
        assert np.dot(joint.axis, axis) > 0.0, name


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
