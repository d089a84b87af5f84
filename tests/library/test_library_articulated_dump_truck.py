"""The articulated dump truck's template: mobility, names and places, with a bogie of beams or fast axles."""

from __future__ import annotations

import itertools

import pytest

from yellowiron import library
from yellowiron.alignment.assignment.weights import interchangeable
from yellowiron.model.template import Template, choose

WHEELS = [f"{end}_wheel_{side}" for end in ("front", "middle", "rear") for side in "lr"]


@pytest.fixture(scope="module")
def template() -> Template:
    return library.load_template("articulated_dump_truck")


def test_it_moves_as_it_should_with_and_without_beams(template: Template) -> None:
    report = library.lint(template)
    assert [f for f in report.findings if f.severity != "info"] == []
    # Steering, body, roll and six wheels; two beams, with pads or without.
    assert [(m.computed, m.expected) for m in report.mobility] == [(11, 11)] * 6 + [(9, 9)] * 6


def test_fast_axles_are_of_the_rear_frame_and_need_no_beam(template: Template) -> None:
    fixed = choose(template, {"bogie": "fixed"})
    for side, end in itertools.product("lr", ("middle", "rear")):
        assert fixed.bodies_of(fixed.joint(f"{end}_wheel_{side}_joint")) == ("rear_frame", f"{end}_wheel_{side}")
        assert fixed.role(f"bogie_beam_{side}").optional
    assert not choose(template, {"bogie": "beams"}).role("bogie_beam_l").optional


def test_one_cylinder_pushes_as_the_other_pulls_to_steer(template: Template) -> None:
    steering = next(a for a in template.actuators if a.name == "steering")
    assert [(c.sign, c.passive) for c in steering.cylinders] == [(1, False), (-1, True)]
    hoist = next(a for a in template.actuators if a.name == "hoist")
    assert [(c.sign, c.passive) for c in hoist.cylinders] == [(1, False), (1, True)]


@pytest.mark.parametrize(("drive", "count"), [("all", 6), ("front_and_middle", 4), ("none", 0)])
def test_which_wheels_are_driven(template: Template, drive: str, count: int) -> None:
    chosen = choose(template, {"wheel_drive": drive})
    assert sum(chosen.joint(f"{wheel}_joint").drive is not None for wheel in WHEELS) == count


def test_only_places_tell_the_bogie_s_wheels_apart(template: Template) -> None:
    beams = [{f"middle_wheel_{side}", f"rear_wheel_{side}"} for side in "lr"]
    assert sorted(map(sorted, interchangeable(choose(template, {"bogie": "beams"})))) == sorted(map(sorted, beams))
    assert interchangeable(choose(template, {"bogie": "fixed"})) == [frozenset().union(*beams)]
