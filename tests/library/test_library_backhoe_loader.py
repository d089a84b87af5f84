"""The backhoe loader's template: mobility in every variant, its twins, and sites on either kind of dipper."""

from __future__ import annotations

import itertools

import pytest

from yellowiron import library
from yellowiron.model.template import Template, choose

LOADER = {"parallel": 2, "z_bar": 1}
"""Cylinders of the loader's bucket."""


@pytest.fixture(scope="module")
def template() -> Template:
    return library.load_template("backhoe_loader")


def test_it_moves_as_it_should(template: Template) -> None:
    report = library.lint(template)
    assert [f for f in report.findings if f.severity != "info"] == []
    for found in report.mobility:
        # Axle, steering, four wheels, loader 2, backhoe 4 and its dipper's extension, two stabilizers; the rear wheels'
        # steering unless it follows.
        expected = 14 + (found.choices["dipper_type"] == "extending")
        expected += found.choices["rear_axle"] == "steered" and found.choices["steering_mode"] == "front"
        assert (found.computed, found.expected) == (expected, expected), found.choices
    # 24 with a fast rear axle, and three steering modes of as many with a steered one.
    assert len(report.mobility) == 96


@pytest.mark.parametrize(("linkage", "dipper"), itertools.product(LOADER, ["fixed", "extending"]))
def test_every_choice_has_its_cylinders(template: Template, linkage: str, dipper: str) -> None:
    chosen = choose(template, {"loader_linkage": linkage, "dipper_type": dipper})
    cylinders = {a.name: [(c.sign, c.passive) for c in a.cylinders] for a in chosen.actuators}
    assert len(cylinders["loader_bucket"]) == LOADER[linkage] and len(cylinders["backhoe_bucket"]) == 1
    assert len(cylinders.get("extension", [])) == (dipper == "extending")
    assert cylinders["backhoe_swing"] == [(1, False), (-1, True)]
    assert cylinders["loader_lift"] == [(1, False), (1, True)]


@pytest.mark.parametrize("mode", ["front", "all", "crab"])
def test_a_rear_axle_is_fast_or_steered(template: Template, mode: str) -> None:
    fast, steered = (choose(template, {"rear_axle": axle, "steering_mode": mode}) for axle in ("fixed", "steered"))
    assert [a.name for a in fast.actuators if "steering" in a.name] == ["steering"]
    assert {r.name for r in fast.roles if r.name.startswith("rear_") and r.rigid} == {"rear_wheel_l", "rear_wheel_r"}
    assert fast.bodies_of(fast.joint("rear_wheel_l_joint")) == ("chassis", "rear_wheel_l")
    assert steered.bodies_of(steered.joint("rear_wheel_l_joint")) == ("rear_knuckle_l", "rear_wheel_l")
    (cylinder,) = next(a for a in steered.actuators if a.name == "rear_steering").cylinders
    assert cylinder.passive is (mode != "front")
    follows = steered.joint(cylinder.slide).follows
    assert (follows.ratio if follows else None) == {"front": None, "all": -1.0, "crab": 1.0}[mode]


@pytest.mark.parametrize("stabilizers", ["hinged", "sliding"])
def test_stabilizers_are_hinged_or_slide(template: Template, stabilizers: str) -> None:
    chosen = choose(template, {"stabilizers": stabilizers})
    lever = next(a for a in chosen.actuators if a.name == "stabilizer_left")
    (cylinder,) = lever.cylinders
    assert bool(cylinder.rams) is (stabilizers == "sliding")
    assert chosen.role("stabilizer_piston_rod_l").rigid is (stabilizers == "hinged")


def test_a_site_may_name_several_joints(template: Template) -> None:
    rules = {site.name: site.rule for site in template.sites}
    joints = ("dipper2backhoe_bucket_joint", "dipper_extension2backhoe_bucket_joint")
    assert rules["backhoe_tip"]["edge_from"] == joints


@pytest.mark.parametrize(("drive", "driven"), [("rear", {"rear"}), ("all", {"rear", "front"}), ("none", set())])
def test_which_wheels_are_driven(template: Template, drive: str, driven: set[str]) -> None:
    chosen = choose(template, {"wheel_drive": drive})
    for end, side in itertools.product(("front", "rear"), "lr"):
        assert (chosen.joint(f"{end}_wheel_{side}_joint").drive is not None) is (end in driven)
