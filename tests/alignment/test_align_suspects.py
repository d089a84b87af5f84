"""Whom a missing body casts doubt on: its neighbours, unless the whole chain is not drawn."""

from __future__ import annotations

import pytest

from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.alignment.labelling.suspects import meagre, suspect_bodies
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


def usual_surface(template: Template) -> dict[str, float]:
    """Body → the surface (m²) that it usually has of a machine of 100 m²."""
    return {body: 100.0 * usual.area for body, usual in template.usual.items() if usual.area > 0.0}


def test_a_body_of_which_hardly_anything_is_found_left_its_parts_to_others(template: Template) -> None:
    surface = usual_surface(template)
    unlinked = without(template, "bucket_link")
    usual = suspect_bodies(unlinked, template, surface)
    doubted = suspect_bodies(unlinked, template, {**surface, "rear_frame": 0.05 * surface["rear_frame"]})
    assert meagre(template, surface) == set()
    assert meagre(template, {**surface, "rear_frame": 0.05 * surface["rear_frame"]}) == {"rear_frame"}
    assert "front_frame" not in usual and "of rear_frame hardly anything is found" in doubted["front_frame"]


def test_a_machine_all_of_whose_joints_are_found_is_what_it_is(template: Template) -> None:
    surface = usual_surface(template)
    assert suspect_bodies(without(template), template, {**surface, "bucket": 0.05 * surface["bucket"]}) == {}
