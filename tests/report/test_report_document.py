"""The report document: counts before cuts, what is missing, and what makes a build fall short."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Body, Drive, Joint, Measurement, Mechanism, Mobility
from yellowiron.model.specification import Candidate, Evidence, Specification, Specifications
from yellowiron.model.template import JointTemplate, Role, Template
from yellowiron.report import BuildFacts, fell_short, report_document, within_tolerance

TEMPLATE = Template(
    equipment_type="press",
    folder="",
    root="frame",
    roles=(Role("frame", None, True), Role("barrel", "frame", True), Role("rod", "frame", True)),
    joints=(
        JointTemplate("pin", "revolute", ("frame", "barrel")),
        JointTemplate("slide", "prismatic", ("barrel", "rod"), lower=0.0, upper="Press Stroke", drive="linear"),
    ),
)


def body(name: str) -> Body:
    return Body(name, (0, 0, 0), 10.0, (0, 0, 0), np.eye(3), (), np.zeros((0, 3)))


MECHANISM = Mechanism(
    name="press",
    equipment_type="press",
    root="frame",
    bodies=(body("frame"), body("barrel"), body("rod")),
    joints=(
        Joint("pin", "revolute", "frame", "barrel", (0, 0, 0), (0, 1, 0), cut=True),
        Joint("slide", "prismatic", "barrel", "rod", (0, 0, 0), (1, 0, 0), 0.0, 0.5,
              drive=Drive("position", 1.0, 1.0, 1.0, 1.0)),
    ),
    mobility=Mobility(1, 1, 1),
)  # fmt: skip
ALIGNMENT = Alignment("press", np.eye(4), (PartAssignment("a", "frame", "frame", 1.0, "seen"),))
STROKE = Specification("Press Stroke", 0.5, "m", "ok", evidence=Evidence("s.pdf", 1, "Press stroke 500 mm"))


def document(specification: Specification = STROKE, *, mechanism: Mechanism = MECHANISM, measurements=()):  # type: ignore[no-untyped-def]
    values = Specifications({specification.name: specification})
    return report_document(BuildFacts(mechanism, TEMPLATE, ALIGNMENT, values, measurements))


def test_a_sound_build_leaves_nothing() -> None:
    report = document()
    assert fell_short(report) == []
    assert report["missing"] == []
    assert (report["counts"]["revolute"], report["counts"]["prismatic"]) == (1, 1)
    assert report["counts"]["linear_drives"] == 1
    assert report["specifications"][0]["quote"] == "Press stroke 500 mm"


@pytest.mark.parametrize("status", ["missing", "conflict", "review", "unreadable"])
def test_a_limit_without_a_sure_value_is_missing(status: str) -> None:
    candidates = (Candidate(0.5, "m", Evidence("s.pdf", 1, "x")),)
    report = document(replace(STROKE, value=None, status=status, candidates=candidates))
    assert report["missing"] == ["Press Stroke"]
    assert any("Press Stroke" in reason for reason in fell_short(report))


def test_errors_warnings_and_wrong_mobility_fall_short_and_remarks_do_not() -> None:
    noted = replace(MECHANISM, findings=(Finding("MEC999", "info", "pin", "scaled"),))
    assert fell_short(document(mechanism=noted)) == []
    for severity in ("warning", "error"):
        failed = replace(MECHANISM, findings=(Finding("MEC998", severity, "pin", "gone"),))  # type: ignore[arg-type]
        assert fell_short(document(mechanism=failed)) == ["MEC998 pin: gone"]
    stuck = replace(MECHANISM, mobility=Mobility(0, 1, 0))
    assert fell_short(document(mechanism=stuck)) == ["mobility 0, expected 1"]


def measured(spec: float, model: float, unit: str = "m", role: str = "checked") -> Measurement:
    return Measurement("Height", "Height", spec, model, unit, 100 * (model - spec) / spec, role)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("measurement", "held"),
    [
        (measured(4.370, 4.378), True),
        (measured(4.370, 4.380), False),
        (measured(math.radians(40), math.radians(40.09), "rad"), True),
        (measured(math.radians(40), math.radians(40.11), "rad"), False),
    ],
)
def test_the_bar_is_two_per_mille_or_a_tenth_of_a_degree(measurement: Measurement, held: bool) -> None:
    assert within_tolerance(measurement) is held
    assert bool(fell_short(document(measurements=[measurement]))) is not held


def test_only_published_values_are_held_against_the_machine() -> None:
    assert fell_short(document(measurements=[measured(1.0, 2.0, role="example")])) == []
    assert fell_short(document(measurements=[measured(1.0, 2.0, role="calibrated")])) == []
