"""Steered wheels of a machine that is drawn without what steers them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from kit.machines.backhoes import backhoe
from kit.machines.lift_trucks import lift_truck
from kit.machines.partly_drawn import without
from kit.machines.rollers import roller
from kit.machines.synthetic import Machine
from yellowiron.kinematics import ClosedChain
from yellowiron.library import load_template
from yellowiron.model.mechanism import independent_joints
from yellowiron.model.template import Template

LINKAGE = ("tie_rod", "steering")
AXLE = ("axle", "knuckle", *LINKAGE)


CASES = [
    pytest.param("forklift", lambda: lift_truck(3, "simplex"), "rear", -1.0, 45.0, id="forklift"),
    pytest.param("backhoe_loader", lambda: backhoe(3), "front", 1.0, 37.0, id="backhoe loader", marks=pytest.mark.slow),
]


@pytest.mark.parametrize(("kind", "draw", "end", "way", "most"), CASES)
def test_wheels_are_steered_where_no_knuckle_is_drawn(
    kind: str, draw: Callable[[], Machine], end: str, way: float, most: float
) -> None:
    built = without(draw(), kind, AXLE)
    left, right = (next(j for j in built.joints if j.body1 == f"knuckle_{side}") for side in "lr")
    wheels = [built.joint(f"{end}_wheel_{side}_joint") for side in "lr"]
    assert {f.code for f in built.findings} >= {"MEC017", "MEC038"}
    assert not [f for f in built.findings if f.severity == "error" and "steer" in f.where]
    assert [(w.body0, w.body1) for w in wheels] == [(f"knuckle_{s}", f"{end}_wheel_{s}") for s in "lr"]
    for hinge, wheel in zip((left, right), wheels, strict=True):
        assert hinge.body0 == "chassis"
        assert hinge.axis == pytest.approx((0.0, 0.0, way))
        assert hinge.anchor == pytest.approx(wheel.anchor)
    assert left.drive is not None and math.isfinite(left.drive.max_force) and right.drive is None
    assert np.degrees([left.lower, left.upper]) == pytest.approx([-most, most])  # type: ignore[list-item]
    assert right.follows is not None and (right.follows.joint, right.follows.ratio) == (left.name, 1.0)
    assert next(a for a in built.actuators if a.name == "steering").joints[0].joint == left.name
    assert built.mobility is not None and built.mobility.computed == built.mobility.expected
    # Both wheels turn, and roll on all the same.
    chain = ClosedChain(built)
    state, _ = chain.reach({left.name: 0.4})
    for wheel in wheels:
        turned = chain.displacement(state, wheel.body0)[:3, :3] @ np.asarray(wheel.axis)
        assert math.acos(abs(turned @ np.asarray(wheel.axis))) == pytest.approx(0.4, abs=1e-9)
        assert wheel.name in independent_joints(built)
    # What a knuckle weighs its wheel weighs less, as it would without one.
    for side in "lr":
        knuckle, wheel_body = built.body(f"knuckle_{side}"), built.body(f"{end}_wheel_{side}")
        assert not knuckle.parts and not knuckle.shapes
        share = knuckle.mass / (knuckle.mass + wheel_body.mass)
        assert share == pytest.approx(0.1)
        assert np.all(np.linalg.eigvalsh(wheel_body.inertia) > 0.0)


@pytest.mark.parametrize(("kind", "draw", "end", "way", "most"), CASES)
def test_knuckles_without_their_linkage_turn_together(
    kind: str, draw: Callable[[], Machine], end: str, way: float, most: float
) -> None:
    built = without(draw(), kind, LINKAGE)
    hinges = [j for j in built.joints if {j.body0, j.body1} & {"knuckle_l", "knuckle_r"} and "wheel" not in j.name]
    driven = next(j for j in hinges if j.drive is not None)
    other = next(j for j in hinges if j is not driven)
    assert len(hinges) == 2
    assert not {f.where for f in built.findings if f.code in ("MEC011", "MEC019")} & {h.name for h in hinges}
    assert np.degrees([driven.lower, driven.upper]) == pytest.approx([-most, most])  # type: ignore[list-item]
    assert other.follows is not None and other.follows.joint == driven.name
    assert np.asarray(other.axis) @ np.asarray(driven.axis) > 0.9


@pytest.mark.parametrize(("kind", "draw", "end", "way", "most"), CASES)
def test_a_linkage_that_reaches_no_knuckle_steers_nothing(
    kind: str, draw: Callable[[], Machine], end: str, way: float, most: float
) -> None:
    built = without(draw(), kind, ("knuckle",))
    wheels = [built.joint(f"{end}_wheel_{side}_joint") for side in "lr"]
    assert [w.body0 for w in wheels] == ["knuckle_l", "knuckle_r"]
    assert "MEC038" in {f.code for f in built.findings}
    # The cylinder stands as drawn; no loop is left that could lock the wheels.
    steering = next(a for a in built.actuators if a.name == "steering")
    assert not steering.cylinders and steering.joints[0].joint.endswith("knuckle_l_joint")
    assert not any("tie_rod" in j.name and "knuckle" in j.name for j in built.joints)
    assert built.mobility is not None and built.mobility.computed == built.mobility.expected


def test_one_knuckle_of_two_keeps_its_linkage() -> None:
    built = without(lift_truck(3, "simplex"), "forklift", ("knuckle_r", "tie_rod_r"))
    assert "MEC038" not in {f.code for f in built.findings}
    assert built.joint("rear_wheel_l_joint").body0 == "knuckle_l"
    assert built.joint("rear_wheel_r_joint").body0 == "steer_axle"
    assert next(a for a in built.actuators if a.name == "steering").cylinders


def test_what_is_drawn_whole_is_steered_by_its_cylinder() -> None:
    built = without(lift_truck(3, "simplex"), "forklift", ())
    assert "MEC038" not in {f.code for f in built.findings}
    assert next(a for a in built.actuators if a.name == "steering").cylinders


def test_a_document_s_limit_of_a_kingpin_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    """The finding asks for it, and it was dropped."""
    from kit.machines import partly_drawn

    def limited(kind: str) -> Template:
        template = load_template(kind)
        joints = tuple(
            replace(j, lower=-0.5, upper=0.6, max_force=7e4) if j.name == "steer_axle2knuckle_l_joint" else j
            for j in template.joints
        )
        return replace(template, joints=joints)

    monkeypatch.setattr(partly_drawn, "load_template", limited)
    joint = without(lift_truck(3, "simplex"), "forklift", AXLE).joint("steer_axle2knuckle_l_joint")
    assert (joint.lower, joint.upper) == pytest.approx((-0.5, 0.6))
    assert joint.drive is not None and joint.drive.max_force == 7e4


def test_a_drum_in_a_frame_that_is_not_drawn_has_no_kingpin() -> None:
    built = without(roller(4, tandem=False), "roller", ("front_frame", "hitch", "steering", "articulation_pin"))
    assert "MEC038" not in {f.code for f in built.findings}
