"""The motor grader: drawbar, leaning axle and tandems, whose mobilities are those of the machine."""

from __future__ import annotations

import pytest

from yellowiron import library
from yellowiron.library.linting.lint import LintReport
from yellowiron.model.template import Template, choose

SADDLE = {"drawn", "left_1", "left_2", "left_3", "right_1", "right_2", "right_3"}


@pytest.fixture(scope="module")
def grader() -> Template:
    return library.load_template("grader")


@pytest.fixture(scope="module")
def report(grader: Template) -> LintReport:
    return library.lint(grader)


def test_every_grader_moves_as_it_is_driven(report: LintReport) -> None:
    """Drawbar 3, circle, tip and side shift; the axle swings, leans and steers; two frames, two tandems, four wheels
    that turn on their own, for the rear ones follow the middle ones."""
    assert {m.choices["saddle"] for m in report.mobility} == SADDLE
    for mobility in report.mobility:
        freedom = 6 + 3 + 1 + 2 + 4 + (mobility.choices["ripper"] == "fitted")
        assert (mobility.computed, mobility.expected) == (freedom, freedom), mobility.choices
        assert not any(g.undetermined for g in mobility.groups) and not mobility.loose, mobility.choices
    spatial = [g for g in report.mobility[0].groups if g.spatial]
    assert sorted((g.computed, len(g.idle)) for g in spatial) == [(2, 5), (3, 3)]
    assert report.sound and {f.severity for f in report.findings} == {"info"}


def test_links_between_balls_are_said_to_spin(report: LintReport) -> None:
    said = " ".join(f.message for f in report.findings if f.code == "TPL022")
    for link in ("leaning_bar", "tie_rod", "blade_lift_cylinder_barrel_l with blade_lift_piston_rod_l", "centre_shift"):
        assert link in said
    assert "lean_yoke" not in said and "blade_tip" not in said


def test_both_wheels_of_a_tandem_turn_alike(grader: Template) -> None:
    for side in "lr":
        rear = grader.joint(f"rear_wheel_{side}_joint")
        assert rear.follows is not None and (rear.follows.joint, rear.follows.ratio) == (
            f"middle_wheel_{side}_joint",
            1.0,
        )
        assert rear.drive is None
    driven = next(a for a in grader.actuators if a.name == "drive").joints
    assert not any(name.startswith("rear_wheel") for name in driven)


@pytest.mark.parametrize(("hole", "there"), [("drawn", False), ("right_3", True)])
def test_a_bank_cut_is_measured_in_the_outermost_hole(grader: Template, hole: str, there: bool) -> None:
    chosen = choose(grader, {"saddle": hole})
    assert ("Bank Cut Angle" in {m.name for m in chosen.measurements}) is there


@pytest.mark.parametrize("ripper", ["none", "fitted"])
def test_a_ripper_brings_its_own_site_and_measurements(grader: Template, ripper: str) -> None:
    chosen = choose(grader, {"ripper": ripper})
    there = ripper == "fitted"
    assert ("ripper_tip" in {site.name for site in chosen.sites}) is there
    assert ("Ripper Penetration" in {m.name for m in chosen.measurements}) is there


@pytest.mark.parametrize(("drive", "count"), [("tandem", 2), ("all", 4), ("none", 0)])
def test_which_wheels_are_driven(grader: Template, drive: str, count: int) -> None:
    joints = choose(grader, {"wheel_drive": drive}).joints
    assert sum(j.drive is not None and "wheel" in j.name and j.type == "revolute" for j in joints) == count
