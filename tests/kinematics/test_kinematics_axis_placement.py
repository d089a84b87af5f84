"""Axes that the drawing leaves open, placed by what the sheet publishes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from planar_arm import Arm, arm_mechanism

from yellowiron.kinematics import OpenAxis, measure, place_axes
from yellowiron.kinematics.measuring.measurement import CALIBRATED
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism, Site
from yellowiron.model.template import MeasurementTemplate

ARM = Arm()
OVER = ["boom", "arm", "bucket"]
TRUE = np.array([ARM.x + ARM.boom, 0.0, ARM.z])
"""Where the arm's pin is."""


def extreme(name: str, kind: str, of: str, factor: float = 1.0) -> MeasurementTemplate:
    quantity = {"kind": kind, "site": "tip", **({"from": "swing"} if kind == "reach" else {})}
    steps = ({"extreme": {"actuators": OVER, "quantity": quantity, "of": of}},)
    return MeasurementTemplate(name, name, {**quantity, "factor": factor}, steps)


def length(name: str, one: str, other: str) -> MeasurementTemplate:
    return MeasurementTemplate(name, name, {"kind": "distance", "sites": [one, other]})


MEASUREMENTS = (
    extreme("Maximum Reach", "reach", "max"), extreme("Maximum Digging Depth", "height", "min", -1.0),
    extreme("Maximum Digging Height", "height", "max"), length("Boom Length", "boom_pin", "arm_pin"),
    length("Arm Length", "arm_pin", "bucket_pin"),
)  # fmt: skip


def drawn(pin: Floats, published: Mapping[str, float]) -> Mechanism:
    """The arm whose pin is at a place, on a sheet."""
    mechanism = arm_mechanism(ARM)
    joints = tuple(
        replace(j, anchor=(float(pin[0]), 0.0, float(pin[2]))) if j.name == "arm_joint" else j for j in mechanism.joints
    )
    sites = (
        Site("boom_pin", "boom", (ARM.x, 0.0, ARM.z)),
        Site("arm_pin", "arm", (float(pin[0]), 0.0, float(pin[2]))),
        Site("bucket_pin", "bucket", (ARM.x + ARM.boom + ARM.arm, 0.0, ARM.z)),
    )
    sheet = {name: {"value": value, "status": "ok"} for name, value in published.items()}
    return replace(
        mechanism, joints=joints, sites=(*mechanism.sites, *sites), measurements=MEASUREMENTS, specifications=sheet
    )


def published() -> dict[str, float]:
    found = measure(drawn(TRUE, {}))
    return {m.specification: m.model for m in found if m.model is not None}


@pytest.mark.slow
@pytest.mark.parametrize("off", [(0.05, 0.0, 0.04), (-0.08, 0.0, 0.02)])
def test_a_pin_that_is_guessed_goes_where_the_published_dimensions_put_it(off: tuple[float, float, float]) -> None:
    sheet, guess = published(), TRUE + np.array(off)
    axis = OpenAxis("arm_joint", np.array([0.0, 1.0, 0.0]), 0.07)
    placed = place_axes([axis], lambda shifts: drawn(guess + shifts.get("arm_joint", np.zeros(3)), sheet))
    after = guess + placed.shifts["arm_joint"]
    # Lengths along the arm tell its place along it; up and down, only ranges do, and less.
    assert abs(after[0] - TRUE[0]) < 0.01
    assert np.linalg.norm(after - TRUE) < 2.0 * placed.across["arm_joint"] < 0.14
    assert placed.shifts["arm_joint"][1] == 0.0
    assert placed.sources["arm_joint"].startswith(CALIBRATED)
    assert "Boom Length" in placed.sources["arm_joint"]
    assert [f.code for f in placed.findings] == ["KIN013"]


def test_what_placed_an_axis_is_told_as_calibrated() -> None:
    sheet = published()
    mechanism = drawn(TRUE, sheet)
    by = {**mechanism.joint("arm_joint").source, "axis": f"{CALIBRATED}Boom Length; Arm Length"}
    joints = tuple(replace(j, source=by) if j.name == "arm_joint" else j for j in mechanism.joints)
    roles = {m.name: m.role for m in measure(replace(mechanism, joints=joints))}
    assert (roles["Boom Length"], roles["Arm Length"]) == ("calibrated", "calibrated")
    assert roles["Maximum Reach"] == "checked"


def test_a_sheet_that_cannot_be_met_is_contradicted_and_places_nothing() -> None:
    sheet = {name: 1.4 * value for name, value in published().items()}
    axis = OpenAxis("arm_joint", np.array([0.0, 1.0, 0.0]), 0.07)
    placed = place_axes([axis], lambda shifts: drawn(TRUE + shifts.get("arm_joint", np.zeros(3)), sheet))
    assert placed.shifts == {}
    assert {f.code for f in placed.findings} == {"KIN014"}


def test_one_wrong_value_is_named_and_the_others_place_the_axis() -> None:
    sheet, guess = published(), TRUE + np.array([0.05, 0.0, 0.0])
    sheet["Maximum Digging Depth"] += 0.6
    axis = OpenAxis("arm_joint", np.array([0.0, 1.0, 0.0]), 0.07)
    placed = place_axes([axis], lambda shifts: drawn(guess + shifts.get("arm_joint", np.zeros(3)), sheet))
    assert abs((guess + placed.shifts["arm_joint"])[0] - TRUE[0]) < 0.02
    assert {f.where for f in placed.findings if f.code == "KIN014"} == {"Maximum Digging Depth"}
    assert "Maximum Digging Depth" not in placed.sources["arm_joint"]


def test_without_a_sheet_nothing_is_built_twice() -> None:
    built = []

    def build(shifts: Mapping[str, Floats]) -> Mechanism:
        built.append(shifts)
        return drawn(TRUE, {})

    assert place_axes([], build).shifts == {} and built == []
    assert place_axes([OpenAxis("arm_joint", np.array([0.0, 1.0, 0.0]), 0.07)], build).shifts == {}
    assert len(built) == 1
