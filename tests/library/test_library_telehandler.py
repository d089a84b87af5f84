"""The telehandler's template: mobility in every variant, sections that follow on chains, rear wheels that follow the
front ones, the cylinder that no lever moves."""

from __future__ import annotations

import itertools

import pytest

from yellowiron import library
from yellowiron.model.template import Template, choose

SECTIONS = ["two", "three", "four"]


@pytest.fixture(scope="module")
def template() -> Template:
    return library.load_template("telehandler")


@pytest.mark.slow
def test_it_moves_as_it_should(template: Template) -> None:
    report = library.lint(template)
    assert [f for f in report.findings if f.severity != "info"] == []
    for found in report.mobility:
        # Rear axle, four wheels, front steering; lift, telescope and tilt, however many sections there are.
        expected = 9
        expected += 2 * (found.choices["stabilizers"] == "hinged") + (found.choices["frame_levelling"] == "cylinder")
        expected += found.choices["steering_mode"] == "front"
        expected -= found.choices["fork_levelling"] == "oil"
        assert (found.computed, found.expected) == (expected, expected), found.choices
    assert len(report.mobility) == 432


@pytest.mark.parametrize(("sections", "followers"), zip(SECTIONS, [0, 1, 2], strict=True))
def test_inner_sections_follow_on_chains(template: Template, sections: str, followers: int) -> None:
    chosen = choose(template, {"sections": sections})
    follows = [j.follows for j in chosen.joints if j.follows is not None and j.follows.kind == "chain"]
    assert len(follows) == followers and all(f.ratio == 1.0 for f in follows)
    (telescope,) = next(a for a in chosen.actuators if a.name == "telescope").cylinders
    led = "inner_boom" if sections == "two" else "middle_boom"
    assert telescope.rod_joint == f"{led}2telescope_piston_rod_joint"


@pytest.mark.parametrize(("mode", "ratio"), [("front", None), ("all", -1.0), ("crab", 1.0)])
def test_the_rear_wheels_are_steered_alone_or_follow_by_oil(template: Template, mode: str, ratio: float | None) -> None:
    chosen = choose(template, {"steering_mode": mode})
    follows = [j.follows for j in chosen.joints if j.follows is not None and j.follows.kind == "oil"]
    assert [f.ratio for f in follows] == ([] if ratio is None else [ratio])
    assert ("rear_steering" in {a.name for a in chosen.actuators if not a.slave}) is (ratio is None)
    (rear,) = next(a for a in chosen.actuators if a.name == "rear_steering").cylinders
    assert rear.passive is (ratio is not None) and rear.rod_through and rear.rams


@pytest.mark.parametrize("levelling", ["lever", "oil"])
def test_no_lever_moves_the_cylinder_that_levels_the_forks(template: Template, levelling: str) -> None:
    chosen = choose(template, {"fork_levelling": levelling})
    assert [a.name for a in chosen.actuators if a.slave] == ["compensation"]
    led = [j for j in chosen.joints if j.follows is not None and "compensation" in j.follows.joint]
    assert len(led) == (levelling == "oil") and ("tilt" in {a.name for a in chosen.actuators}) is not bool(led)


@pytest.mark.parametrize(("lift", "levelling"), itertools.product(["single", "twin"], ["none", "cylinder"]))
def test_every_choice_has_its_cylinders(template: Template, lift: str, levelling: str) -> None:
    chosen = choose(template, {"lift_cylinders": lift, "frame_levelling": levelling})
    cylinders = {a.name: [(c.sign, c.passive) for c in a.cylinders] for a in chosen.actuators}
    assert cylinders["lift"] == [(1, False), (1, True)][: 1 + (lift == "twin")]
    assert len(cylinders.get("levelling", [])) == (levelling == "cylinder")
    assert chosen.role("front_axle").rigid is (levelling == "cylinder")


@pytest.mark.parametrize(("drive", "driven"), [("all", {"front", "rear"}), ("rear", {"rear"}), ("none", set())])
def test_which_wheels_are_driven(template: Template, drive: str, driven: set[str]) -> None:
    chosen = choose(template, {"wheel_drive": drive})
    for end, side in itertools.product(("front", "rear"), "lr"):
        assert (chosen.joint(f"{end}_wheel_{side}_joint").drive is not None) is (end in driven)
