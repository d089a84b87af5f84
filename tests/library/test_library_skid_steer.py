"""The skid steer's template: mobility and names with both lift paths and one or two tilt cylinders."""

from __future__ import annotations

import itertools
from dataclasses import replace

import pytest

from yellowiron import library
from yellowiron.alignment.assignment.weights import interchangeable
from yellowiron.model.template import Role, Template, choose

PATHS, TILTS = ("vertical", "radial"), ("twin", "single")


@pytest.fixture(scope="module")
def template() -> Template:
    return library.load_template("skid_steer")


def test_it_moves_as_it_should_however_it_lifts(template: Template) -> None:
    report = library.lint(template)
    assert [f for f in report.findings if f.severity != "info"] == []
    # Arms and bucket, as the rank of the Jacobian has it for either path, and four wheels.
    assert {(m.computed, m.expected) for m in report.mobility} == {(6, 6)}
    assert len(report.mobility) == 8


def test_vertical_lift_has_links_and_radial_lift_a_pivot(template: Template) -> None:
    for path, tilt in itertools.product(PATHS, TILTS):
        chosen = choose(template, {"lift_path": path, "tilt_cylinders": tilt})
        roles = {r.name for r in chosen.roles}
        assert ({"rear_link", "front_link"} <= roles) == (path == "vertical")
        assert ("boom_pin" in roles) == (path == "radial")
        barrels = [r.name for r in chosen.roles if r.kind == "barrel"]
        assert len(barrels) == (4 if tilt == "twin" else 3)


def test_links_on_either_side_that_are_said_to_be_two_bodies_are_told_to_be_one(template: Template) -> None:
    """However the links are drawn, one on either side is one body; two hold the arms twice."""
    assert not any(r.side for r in template.roles if "link" in r.name)

    def split(name: str, side: str) -> str:
        return name.replace("_link", f"_link_{side}")

    def sides(name: str) -> tuple[str, ...]:
        return tuple("lr") if "_link" in name else ("",)

    def half(role: Role, side: str) -> Role:
        return replace(role, name=split(role.name, side), side=side, parent=split(role.parent or "", side) or None)

    roles = tuple(half(r, side) if side else r for r in template.roles for side in sides(r.name))
    joints = tuple(
        replace(j, name=split(j.name, side), parts=tuple(split(p, side) for p in j.parts)) if side else j
        for j in template.joints
        for side in sides(j.name)
    )
    report = library.lint(replace(template, roles=roles, joints=joints, measurements=(), sensors=(), tests=()))
    (error,) = (f for f in report.findings if f.severity == "error")
    assert error.code == "TPL002" and "boom is locked" in error.message
    assert "'front_link' for 'front_link_l' and 'front_link_r'" in error.hint
    assert "'rear_link' for 'rear_link_l' and 'rear_link_r'" in error.hint and "knuckle" not in error.hint


def test_the_bucket_rolls_back_as_its_cylinders_retract(template: Template) -> None:
    for tilt in TILTS:
        bucket = next(a for a in choose(template, {"tilt_cylinders": tilt}).actuators if a.name == "bucket")
        assert {c.sign for c in bucket.cylinders} == {-1}
        assert [c.passive for c in bucket.cylinders] == [False, True][: len(bucket.cylinders)]


def test_each_side_s_lever_turns_both_of_its_wheels(template: Template) -> None:
    for side in ("left", "right"):
        lever = next(a for a in template.actuators if a.name == f"drive_{side}")
        assert list(lever.joints) == [f"front_wheel_{side[0]}_joint", f"rear_wheel_{side[0]}_joint"]


def test_only_places_tell_its_wheels_and_links_apart(template: Template) -> None:
    wheels = frozenset(f"{end}_wheel_{side}" for end in ("front", "rear") for side in "lr")
    links = frozenset({"rear_link", "front_link"})
    assert set(interchangeable(choose(template, {"lift_path": "vertical"}))) == {wheels, links}
    assert set(interchangeable(choose(template, {"lift_path": "radial"}))) == {wheels}


@pytest.mark.parametrize("kind", ["wheel_loader", "excavator", "forklift"])
def test_other_types_joints_tell_front_from_rear(kind: str) -> None:
    assert interchangeable(choose(library.load_template(kind), {})) == []
