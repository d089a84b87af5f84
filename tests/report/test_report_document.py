"""The report document: counts before cuts, what is missing, and what makes a build fall short."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Body, Drive, Joint, Measurement, Mechanism, Mobility
from yellowiron.model.specification import Candidate, Evidence, Specification, Specifications
from yellowiron.model.template import JointTemplate, Role, Template
from yellowiron.pipeline import Machine
from yellowiron.report import (
    BuildFacts,
    build_summary,
    causes,
    fell_short,
    page,
    report_document,
    tally,
    within_tolerance,
)

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


def opened(**more: Any) -> dict[str, Any]:
    """A document with what is said to be open in it."""
    return {**document(), **more}


def finding(code: str, where: str, message: str, *, severity: str = "warning", hint: str = "") -> dict[str, str]:
    return {"code": code, "severity": severity, "where": where, "message": message, "hint": hint}


def test_missing_strokes_are_one_line_with_what_to_paste() -> None:
    names = [f"{name} Stroke" for name in ("Boom", "Arm", "Press")]
    told = [finding("MEC050", f"slide_{k}", f"Its upper limit '{name}' is not known.") for k, name in enumerate(names)]
    (cause,) = causes(opened(missing=names, findings=told))
    assert cause.words == "3 strokes missing: Boom Stroke, Arm Stroke, Press Stroke"
    assert cause.block.endswith('--set "Press Stroke=… mm"') and cause.block.count("--set") == 3


def test_findings_of_one_code_are_one_line_the_gravest_first() -> None:
    told = [
        finding("MEC029", "boom_slide", "No bore: 110 mm was taken.", hint='--set "Boom Bore=… mm"'),
        finding("MEC029", "arm_slide", "No bore: 147 mm was taken.", hint='--set "Arm Bore=… mm"'),
        finding("USD005", "/press/Geometry/rod_1", "The body /press/Geometry/rod_1 has no mass.", severity="error"),
        finding("MEC999", "pin", "scaled", severity="info"),
    ]
    document_ = opened(findings=told)
    first, second = causes(document_)
    assert (first.severity, first.words) == ("error", "USD005 rod_1: The body rod_1 has no mass")
    assert second.words.startswith("MEC029 boom_slide, arm_slide: No bore: 110 mm was taken")
    assert second.block == '--set "Boom Bore=… mm" --set "Arm Bore=… mm"'
    assert tally(document_) == "1 error, 1 warning, 1 note"


def test_notes_of_a_simulation_leave_nothing_to_do() -> None:
    told = [finding("SIM011", "together", "It falls over.", severity="info")]
    noted = opened(simulation={"mujoco": {"findings": told}})
    assert causes(noted) == [] and fell_short(noted) == [] and tally(noted) == "1 note"
    warned = opened(simulation={"mujoco": {"findings": [finding("SIM005", "slide", "It ended away.")]}})
    assert [cause.severity for cause in causes(warned)] == ["warning"] and len(fell_short(warned)) == 1


def test_terminal_and_page_say_the_same_and_no_title_promises_what_is_not_so() -> None:
    from rich.console import Console

    told = [finding("MEC010", "pin", "Its axis is off.")]
    short, ready = opened(findings=told), document()
    corners = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]])
    seen = replace(MECHANISM, bodies=tuple(replace(b, hull=corners) for b in MECHANISM.bodies))
    nothing = Assembly("press", "step", 1.0, (), {})
    for one, state in ((short, "not ready: 1 warning"), (ready, "Ready")):
        console = Console(width=200)
        with console.capture() as captured:
            console.print(build_summary(one, fell_short(one), "out"))
        made = page(one, seen, nothing, ALIGNMENT)
        heading = made[made.index("<h1>") : made.index("</header>")]
        assert state in captured.get() and state in heading
        assert ("simulation-ready" in heading) is False
        assert [cause.words in captured.get() and cause.words in heading for cause in causes(one)] in ([True], [])
    assert "not ready: 1 warning" in page(short, seen, nothing, ALIGNMENT)


def test_a_machine_in_a_notebook_fits_a_screen() -> None:
    told = [finding(f"MEC{k:03}", f"joint_{k}", "Its axis is <off>.") for k in range(60)]
    one = opened(findings=told)
    model = Assembly("press", "STEP", 1.0, (), {})
    machine = Machine(MECHANISM, ALIGNMENT, Specifications({}), (), one, Path("out"), tuple(fell_short(one)), model)
    assert repr(machine) == "<Machine press: 3 bodies in out: not ready (60 warnings)>"
    html = machine._repr_html_()
    assert html.count("<br>") <= 12 and "&lt;off&gt;" in html and "report.html" in html
    assert repr(replace(machine, document=document(), fell_short=())).endswith("in out: ready>")
