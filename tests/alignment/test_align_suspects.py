"""Whom a missing body casts doubt on: its neighbours, unless the whole chain is not drawn."""

from __future__ import annotations

import pytest

from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.alignment.labelling.suspects import suspect_bodies
from yellowiron.library import load_template
from yellowiron.model.template import Template, choose


@pytest.fixture(scope="module")
def template() -> Template:
    return choose(load_template("wheel_loader"), {"lift_cylinders": "twin"})


def without(template: Template, *gone: str) -> Solution:
    """Everything found but the joints of some bodies."""
    kept = [j for j in template.joints if not set(gone) & set(template.bodies_of(j))]
    slides = {j.name: 0 for j in kept if j.type == "prismatic"}
    return Solution({}, {j.name: 0 for j in kept if j.name not in slides}, slides, 0, 0, True)


def test_nothing_is_missing(template: Template) -> None:
    assert suspect_bodies(without(template), template) == {}


def test_a_body_that_was_welded_to_another(template: Template) -> None:
    doubted = suspect_bodies(without(template, "bucket"), template)
    assert {"boom", "bucket_link"} <= set(doubted)
    assert "rear_frame" not in doubted


def test_a_cylinder_that_is_not_drawn(template: Template) -> None:
    doubted = suspect_bodies(without(template, "steering_cylinder_barrel_l", "steering_piston_rod_l"), template)
    assert set(doubted) == {"steering_cylinder_barrel_l", "steering_piston_rod_l"}


def test_a_chain_that_is_not_drawn(template: Template) -> None:
    chain = ("bucket_cylinder_barrel", "bucket_piston_rod", "rocker", "bucket_link")
    doubted = suspect_bodies(without(template, *chain), template)
    assert not {"boom", "bucket", "front_frame"} & set(doubted)
