"""The dozer: linkages in space, whose mobilities are those of the machines."""

from __future__ import annotations

import pytest

from yellowiron import library
from yellowiron.library.linting.lint import LintReport
from yellowiron.model.template import Template, choose

BLADE = {("pat", "single"): 3, ("push_arms", "single"): 2, ("push_arms", "dual"): 3}
"""(blade, tilt) → freedoms of the blade."""
RIPPER = {"none": 0, "radial": 1, "parallel": 2}


@pytest.fixture(scope="module")
def dozer() -> Template:
    return library.load_template("dozer")


@pytest.fixture(scope="module")
def report(dozer: Template) -> LintReport:
    return library.lint(dozer)


@pytest.mark.slow
def test_every_blade_and_ripper_moves_as_it_is_driven(report: LintReport) -> None:
    seen = set()
    for mobility in report.mobility:
        choices = mobility.choices
        blade = BLADE[choices["blade"], choices["tilt"]]
        # An equaliser bar turns, and nothing drives it.
        freedom = blade + RIPPER[choices["ripper"]] + (choices["track_frames"] == "oscillating")
        # Plates for tip cylinders.
        freedom -= choices["ripper_links"] == "plates"
        if choices["tracks"] == "fixed":
            assert (mobility.computed, mobility.expected) == (freedom, freedom), choices
        assert not any(g.undetermined for g in mobility.groups) and not mobility.loose, choices
        if choices["track_frames"] == "fixed":
            assert [g.spatial for g in mobility.groups][-1] == (choices["ripper"] == "none"), choices
        seen.add(tuple(choices[name] for name in ("blade", "tilt", "ripper", "ripper_links", "track_frames")))
    assert len(seen) == 24
    assert {f.severity for f in report.findings} == {"info"}


def test_links_between_balls_are_said_to_spin(report: LintReport) -> None:
    said = " ".join(f.message for f in report.findings if f.code == "TPL022")
    links = ("pitch_link", "tag_link", "tilt_brace", "tilt_cylinder_barrel with tilt_piston_rod", "equalizer_link_l")
    for link in links:
        assert link in said
    assert "push_arm" not in said


def test_an_angling_cylinder_follows_the_other(dozer: Template) -> None:
    left, right = next(a for a in dozer.actuators if a.name == "blade_angle").cylinders
    assert (left.passive, left.sign, right.passive) == (False, -1, True)


@pytest.mark.parametrize("ripper", ["none", "parallel", "radial"])
def test_a_ripper_brings_its_own_site_and_measurements(dozer: Template, ripper: str) -> None:
    chosen = choose(dozer, {"ripper": ripper})
    there = ripper != "none"
    assert ("ripper_tip" in {site.name for site in chosen.sites}) is there
    measured = {m.name for m in chosen.measurements}
    assert measured >= {"Ripper Penetration", "Ripper Lift Height"} if there else not measured & {"Ripper Penetration"}
    assert len(chosen.sites) == 6 + there
