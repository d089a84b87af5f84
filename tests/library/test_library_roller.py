"""The roller's template: mobility, names and limits, with one drum and driven wheels or with two drums."""

from __future__ import annotations

import pytest

from yellowiron import library
from yellowiron.model.template import Template, choose


@pytest.fixture(scope="module")
def template() -> Template:
    return library.load_template("roller")


def test_it_moves_as_it_should_on_one_drum_and_on_two(template: Template) -> None:
    report = library.lint(template)
    assert [f for f in report.findings if f.severity != "info"] == []
    # Steering, oscillation, the drum and two wheels; or two drums; or two yokes and two drums, the rear yoke no
    # freedom where both steer.
    assert [(m.computed, m.expected) for m in report.mobility] == [(5, 5)] * 4 + [(4, 4)] * 6 + [(3, 3)] * 4


@pytest.mark.parametrize("mode", ["front", "all", "crab"])
def test_drums_steer_in_yokes(template: Template, mode: str) -> None:
    chosen = choose(
        template, {"drums": "tandem", "steering_cylinders": "single", "steered_by": "yokes", "steering_mode": mode}
    )
    assert {r.name for r in chosen.roles if r.kind == "frame" and r.rigid} == {"rear_frame", "front_yoke", "rear_yoke"}
    assert chosen.bodies_of(chosen.joint("rear_drum_joint")) == ("rear_yoke", "rear_drum")
    (cylinder,) = next(a for a in chosen.actuators if a.name == "rear_steering").cylinders
    assert cylinder.passive is (mode != "front") and cylinder.rod_joint == "rear_yoke2rear_steering_piston_rod_joint"
    follows = chosen.joint(cylinder.slide).follows
    assert (follows.ratio if follows else None) == {"front": None, "all": 1.0, "crab": -1.0}[mode]
    assert ("Crab Offset" in {m.name for m in chosen.measurements}) is (mode == "crab")
    assert [f for f in library.lint(chosen).findings if f.severity != "info"] == []
    bent = choose(template, {"drums": "tandem"})
    assert bent.bodies_of(bent.joint("rear_drum_joint")) == ("rear_frame", "rear_drum")
    assert bent.bodies_of(bent.joint("front_drum_joint")) == ("front_frame", "front_drum")
    assert [a.name for a in bent.actuators] == ["steering", "drive"]
    assert [f for f in library.lint(bent).findings if f.severity != "info"] == []


@pytest.mark.parametrize(
    ("drums", "rolling"),
    [("single", {"front_drum", "rear_wheel_l", "rear_wheel_r"}), ("tandem", {"front_drum", "rear_drum"})],
)
def test_what_rolls_is_of_the_choice_and_driven(template: Template, drums: str, rolling: set[str]) -> None:
    chosen = choose(template, {"drums": drums})
    assert {r.name for r in chosen.roles if r.kind == "wheel"} == rolling
    assert all(chosen.joint(f"{body}_joint").drive is not None for body in rolling)
    idle = choose(template, {"drums": drums, "drum_drive": "rolling"})
    assert idle.joint("front_drum_joint").drive is None


def test_a_drum_is_a_wheel_that_is_known_as_a_drum(template: Template) -> None:
    assert {r.name for r in template.roles if r.drum} == {"front_drum", "rear_drum"}
    assert {r.kind for r in template.roles if r.drum} == {"wheel"}


def test_one_cylinder_pushes_as_the_other_pulls_to_steer(template: Template) -> None:
    steering = next(a for a in template.actuators if a.name == "steering")
    # The third is the only one where there is one, the fourth that of a front yoke.
    assert [(c.sign, c.passive) for c in steering.cylinders] == [(1, False), (-1, True), (1, False), (1, False)]
