"""The crawler crane's template: mobility in every variant, its winches, how far the boom is raised."""

from __future__ import annotations

import math

import numpy as np
import pytest

from yellowiron import library
from yellowiron.mechanism.actuation.winches import winch_limits, with_winches
from yellowiron.mechanism.joints.frames import JointFrame
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template, choose


@pytest.fixture(scope="module")
def template() -> Template:
    return library.load_template("crawler_crane")


def test_it_moves_as_it_should(template: Template) -> None:
    report = library.lint(template)
    assert [f for f in report.findings if f.severity != "info"] == []
    # Slewing, boom; the hook's three ways to swing and its rope; both tracks, with what their rows have besides.
    tracks = {"belt": 6, "shoes": 12, "fixed": 0}
    for found in report.mobility:
        expected = 2 + tracks[found.choices["tracks"]] + 4 * (found.choices["hoist"] == "hook")
        assert (found.computed, found.expected) == (expected, expected), found.choices
    assert len(report.mobility) == 6


def test_winches_move_boom_and_hook(template: Template) -> None:
    winches = {a.name: a for a in template.actuators if a.kind == "winch"}
    assert set(winches) == {"luffing", "hoist"} and not winches["hoist"].raises
    assert winches["luffing"].raises[0] == "superstructure2boom_joint"
    assert winches["luffing"].defaults["high_angle"] == pytest.approx(math.radians(80.0))


def _frames(template: Template, angle: float, turned: bool) -> dict[str, JointFrame]:
    """A boom of 10 m on a foot at the origin, pendants on its head, the gantry's head 3 m behind and 3 m up; the slide
    written from the one body to the other."""
    head = 10.0 * np.array([math.cos(angle), 0.0, math.sin(angle)])
    gantry, left = np.array([-3.0, 0.0, 3.0]), np.array([0.0, 1.0, 0.0])
    along = (head - gantry) / np.linalg.norm(head - gantry)
    places = {
        "superstructure2boom_joint": (("superstructure", "boom"), np.zeros(3), left),
        "superstructure2boom_hoist_rope_joint": (("superstructure", "boom_hoist_rope"), gantry, left),
        "boom2boom_pendant_joint": (("boom", "boom_pendant"), head, left),
        "boom2hoist_rope_joint": (("boom", "hoist_rope"), head, left),
        "boom_hoist_rope2boom_pendant_joint": (("boom_hoist_rope", "boom_pendant"), gantry, along),
    }
    frames = {}
    for name, (bodies, anchor, axis) in places.items():
        joint = template.joint(name)
        if turned and joint.type == "prismatic":
            bodies, axis = bodies[::-1], -axis
        frames[name] = JointFrame(joint, bodies, anchor, axis, 1.0, {})
    return frames


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("angle", [25.0, 60.0, 79.0])
def test_the_boom_s_angles_say_how_far_the_rope_goes(template: Template, angle: float, turned: bool) -> None:
    chosen, _ = with_winches(choose(template, {}))
    frames = _frames(chosen, math.radians(angle), turned)
    lower, upper, _ = winch_limits(chosen, frames, Specifications(), [])["boom_hoist_rope2boom_pendant_joint"]

    def length(degrees: float) -> float:
        way = math.radians(degrees)
        return math.hypot(10.0 * math.cos(way) + 3.0, 10.0 * math.sin(way) - 3.0)

    assert lower == pytest.approx(length(80.0) - length(angle), abs=1e-9)
    assert upper == pytest.approx(length(20.0) - length(angle), abs=1e-9)


def test_without_its_hinge_a_winch_has_the_joint_s_own_limits(template: Template) -> None:
    chosen, _ = with_winches(choose(template, {}))
    frames = _frames(chosen, 1.0, False)
    del frames["superstructure2boom_joint"]
    assert winch_limits(chosen, frames, Specifications(), []) == {}
