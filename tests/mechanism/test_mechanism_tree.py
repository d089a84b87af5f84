"""Loops and cuts on the joint graphs of real machines, driven cylinders stay, structural pins go."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from yellowiron.mechanism.joints.tree import Link, LinkKind, Tree, loop_groups, loose_bodies, span_tree


def cylinder(name: str, base: str, tip: str, *, passive: bool = False) -> list[Link]:
    """A cylinder's three joints between two bodies."""
    kinds: tuple[LinkKind, LinkKind] = ("hung", "loose") if passive else ("driven", "driven")
    return [
        Link(f"{name}_barrel_pin", (base, f"{name}_barrel"), kinds[0]),
        Link(f"{name}_slide", (f"{name}_rod", f"{name}_barrel"), "slide"),
        Link(f"{name}_rod_pin", (f"{name}_rod", tip), kinds[1]),
    ]


LOADER = [
    Link("articulation", ("front", "rear"), "pin"),
    Link("rear_axle_pin", ("axle", "rear"), "pin"),
    Link("wheel", ("axle", "wheel"), "motor"),
    *cylinder("steer_r", "rear", "front"),
    *cylinder("steer_l", "rear", "front", passive=True),
    Link("arm_pin", ("boom", "front"), "pin"),
    *cylinder("lift_l", "front", "boom"),
    *cylinder("lift_r", "front", "boom", passive=True),
    *cylinder("tilt", "front", "rocker"),
    Link("rocker_pin", ("boom", "rocker"), "pin"),
    Link("rocker_link_pin", ("rocker", "link"), "pin"),
    Link("link_bucket_pin", ("link", "bucket"), "pin"),
    Link("bucket_pin", ("boom", "bucket"), "pin"),
]
EXCAVATOR = [
    Link("swing", ("undercarriage", "house"), "motor"),
    Link("boom_pin", ("house", "boom"), "pin"),
    *cylinder("boom_l", "house", "boom"),
    *cylinder("boom_r", "house", "boom", passive=True),
    Link("arm_pin", ("boom", "arm"), "pin"),
    *cylinder("arm", "boom", "arm"),
    *cylinder("bucket", "arm", "tipping_link"),
    Link("tipping_link_arm_pin", ("arm", "tipping_link"), "pin"),
    Link("tipping_link_pin", ("tipping_link", "bucket_link"), "pin"),
    Link("bucket_link_pin", ("bucket_link", "bucket"), "pin"),
    Link("bucket_pin", ("arm", "bucket"), "pin"),
]
MACHINES = {
    "loader": (
        LOADER,
        "rear",
        {"articulation", "arm_pin", "rocker_pin", "bucket_pin", "steer_l_rod_pin", "lift_r_rod_pin"},
    ),
    "excavator": (
        EXCAVATOR,
        "undercarriage",
        {"boom_pin", "arm_pin", "bucket_pin", "tipping_link_arm_pin", "boom_r_rod_pin"},
    ),
}


def check(tree: Tree, edges: list[Link], root: str) -> None:
    """What holds of every tree: spanning, rooted, one cut a loop, loops closed."""
    bodies = {b for e in edges for b in e.bodies}
    assert set(tree.bodies) == bodies
    assert tree.bodies[0] == root
    assert set(tree.leading) == bodies - {root}
    assert len(tree.cuts) == len(edges) - len(bodies) + 1 == len(tree.loops)
    assert set(tree.leading.values()) | set(tree.cuts) == {e.name for e in edges}
    for body, joint in tree.leading.items():
        assert tree.sides[joint][1] == body
    ends = {e.name: set(e.bodies) for e in edges}
    for loop in tree.loops:
        assert [j for j in loop.joints if j in tree.cuts] == [loop.cut]
        around = [body for joint in loop.joints for body in ends[joint]]
        assert all(around.count(body) == 2 for body in around), "every body on the way has two joints"


@pytest.mark.parametrize("machine", MACHINES)
def test_cuts_are_those_that_ran_best(machine: str) -> None:
    edges, root, cuts = MACHINES[machine]
    tree = span_tree(root, edges)
    check(tree, edges, root)
    assert set(tree.cuts) == cuts


@pytest.mark.parametrize("machine", MACHINES)
@settings(deadline=None)
@given(st.randoms(use_true_random=False))
def test_cuts_do_not_hang_on_the_order_of_the_template(machine: str, random: object) -> None:
    edges, root, cuts = MACHINES[machine]
    shuffled = list(edges)
    random.shuffle(shuffled)  # type: ignore[attr-defined]
    tree = span_tree(root, shuffled)
    check(tree, shuffled, root)
    assert set(tree.cuts) == cuts


def test_a_parallel_linkage_without_cylinders_is_cut_once() -> None:
    edges = [
        Link("a", ("base", "crank"), "motor"),
        Link("b", ("crank", "coupler"), "pin"),
        Link("c", ("coupler", "lever"), "pin"),
        Link("d", ("lever", "base"), "pin"),
    ]
    tree = span_tree("base", edges)
    check(tree, edges, "base")
    assert set(tree.cuts) == {"d"}


def test_a_body_that_hangs_only_on_a_passive_cylinder_keeps_its_pins() -> None:
    edges = cylinder("damper", "base", "hood", passive=True)
    assert not span_tree("base", edges).cuts


def test_loops_that_share_a_joint_move_together() -> None:
    tree = span_tree("rear", LOADER)
    groups = loop_groups(tree.loops)
    assert len(groups) == 2
    assert {"articulation" in g for g in groups} == {True, False}
    assert not any("arm_pin" in g and "articulation" in g for g in groups)


def test_loose_bodies_come_one_a_group() -> None:
    edges = [Link("a", ("x", "y"), "pin"), Link("b", ("root", "z"), "pin")]
    assert loose_bodies("root", ("root", "x", "y", "z", "alone"), edges) == ("x", "alone")
