"""A dozer's parallelogram rippers, adjustable (two freedoms) and fixed (one): their poses against a solution by
circles, what is measured of them."""

from __future__ import annotations

import cmath
import itertools
import math

import numpy as np
import pytest

from kit.circles import meet, strokes
from kit.machines.dozers import dozer
from kit.machines.partly_drawn import without
from kit.machines.unseen import found_whole
from yellowiron.kinematics import ClosedChain, measure
from yellowiron.model.mechanism import Mechanism

CHOICES = {"blade": "pat", "tilt": "single", "ripper": "parallel"}
LIFT = "ripper_lift_cylinder_barrel_l2ripper_lift_piston_rod_l_joint"
TIP = "ripper_tip_cylinder_barrel_l2ripper_tip_piston_rod_l_joint"


@pytest.fixture(scope="module")
def built() -> Mechanism:
    return without(dozer(621, "pat", dual=False, high=False, ripper="parallel"), "dozer", (), choices=CHOICES)


class Circles:
    """The ripper in the plane y = 0, as complex numbers (x, z): the link is where the lift cylinder's circle meets its
    own about the link's pivot, the beam where the tip cylinder's meets its own about the link's end."""

    def __init__(self, mechanism: Mechanism) -> None:
        def at(name: str) -> complex:
            anchor = mechanism.joint(name).anchor
            return complex(anchor[0], anchor[2])

        self.pivot, self.beam = at("main_frame2ripper_link_joint"), at("ripper_link2ripper_beam_joint")
        self.foot, self.eye = (
            at(f"{body}2ripper_lift_{half}_l_joint")
            for body, half in (("main_frame", "cylinder_barrel"), ("ripper_link", "piston_rod"))
        )
        self.top, self.end = (
            at(f"{body}2ripper_tip_{half}_l_joint")
            for body, half in (("main_frame", "cylinder_barrel"), ("ripper_beam", "piston_rod"))
        )

    def moved(self, lift: float, tip: float, point: complex) -> complex:
        """Where a point of the beam is at two strokes from the drawn pose."""
        eye = meet(self.foot, abs(self.eye - self.foot) + lift, self.pivot, abs(self.eye - self.pivot), self.eye)
        turn = (eye - self.pivot) / (self.eye - self.pivot)
        beam = self.pivot + turn * (self.beam - self.pivot)
        radius, near = abs(self.end - self.beam), beam + turn * (self.end - self.beam)
        end = meet(self.top, abs(self.end - self.top) + tip, beam, radius, near)
        return beam + (end - beam) / (self.end - self.beam) * (point - self.beam)


@pytest.mark.slow
def test_it_moves_two_ways(built: Mechanism) -> None:
    fixed = without(
        dozer(621, "pat", dual=False, high=False, ripper=False), "dozer", (), choices={**CHOICES, "ripper": "none"}
    )
    assert built.mobility is not None and fixed.mobility is not None
    assert built.mobility.computed == built.mobility.expected == fixed.mobility.computed + 2
    assert {"ripper_lift", "ripper_tip"} <= {a.name for a in built.actuators}


def test_it_goes_where_two_circles_say(built: Mechanism) -> None:
    chain, circles = ClosedChain(built), Circles(built)
    site = next(s for s in built.sites if s.name == "ripper_tip")
    lifts, tips = strokes(built, LIFT, 9), strokes(built, TIP, 9)
    worst = 0.0
    for lift, tip in itertools.product(lifts, tips):
        state = chain.solve({LIFT: lift, TIP: tip})
        moved = chain.displacement(state, "ripper_beam") @ [*site.position, 1.0]
        expected = circles.moved(lift, tip, complex(site.position[0], site.position[2]))
        worst = max(worst, abs(complex(moved[0], moved[2]) - expected), abs(moved[1] - site.position[1]))
    assert worst <= 1e-9


def test_penetration_and_clearance_are_those_of_its_tips(built: Mechanism) -> None:
    site = next(s for s in built.sites if s.name == "ripper_tip")
    circles, point = Circles(built), complex(site.position[0], site.position[2])
    heights = [circles.moved(lift, 0.0, point).imag for lift in strokes(built, LIFT, 401)]
    found = {m.name: m.model for m in measure(built)}
    assert found["Ripper Penetration"] == pytest.approx(-min(heights), abs=1e-5)
    assert found["Ripper Lift Height"] == pytest.approx(max(heights), abs=1e-5)
    assert min(heights) < 0.0 < max(heights)


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "blade"), [(622, "push_arms"), pytest.param(621, "pat", marks=pytest.mark.slow)])
def test_nameless_every_part_is_in_its_body(seed: int, blade: str) -> None:
    """Its link was an arm, and a machine's arms are at its front: the machine of seed 622 was taken for turned round,
    with left and right exchanged and nothing for review."""
    machine = dozer(seed, blade, dual=False, high=False, ripper="parallel")
    assert found_whole(machine, "dozer", seed, triangles=False).choices["ripper"] == "parallel"


@pytest.fixture(scope="module")
def fixed() -> Mechanism:
    choices = {**CHOICES, "ripper_links": "plates"}
    return without(dozer(621, "pat", dual=False, high=False, ripper="fixed_parallel"), "dozer", (), choices=choices)


@pytest.mark.slow
def test_a_fixed_one_moves_one_way_and_its_shanks_keep_their_angle(fixed: Mechanism) -> None:
    """Its pins are no exact parallelogram: the upper link's circle about its pivot meets that of the beam's pin."""
    assert fixed.mobility is not None and fixed.mobility.computed == fixed.mobility.expected
    assert "ripper_lift" in {a.name for a in fixed.actuators} and "ripper_tip" not in {a.name for a in fixed.actuators}
    chain = ClosedChain(fixed)

    def at(name: str) -> complex:
        anchor = fixed.joint(name).anchor
        return complex(anchor[0], anchor[2])

    pivot, beam = at("main_frame2ripper_link_joint"), at("ripper_link2ripper_beam_joint")
    foot = at("main_frame2ripper_lift_cylinder_barrel_l_joint")
    eye = at("ripper_link2ripper_lift_piston_rod_l_joint")
    top, end = at("main_frame2ripper_upper_link_joint"), at("ripper_upper_link2ripper_beam_joint")
    site = next(s for s in fixed.sites if s.name == "ripper_tip")
    point = complex(site.position[0], site.position[2])
    worst, turned = 0.0, 0.0
    for lift in strokes(fixed, LIFT, 17):
        state = chain.solve({LIFT: lift})
        moved = chain.displacement(state, "ripper_beam") @ [*site.position, 1.0]
        up = meet(foot, abs(eye - foot) + lift, pivot, abs(eye - pivot), eye)
        turn = (up - pivot) / (eye - pivot)
        hung = pivot + turn * (beam - pivot)
        held = meet(top, abs(end - top), hung, abs(end - beam), hung + (end - beam))
        expected = hung + (held - hung) / (end - beam) * (point - beam)
        worst = max(worst, abs(complex(moved[0], moved[2]) - expected))
        turned = max(turned, abs(math.degrees(cmath.phase((held - hung) / (end - beam)))))
    assert worst <= 1e-9
    assert turned < 10.0


def test_the_tip_of_a_tall_carrier_is_its_shanks(fixed: Mechanism) -> None:
    """The farthest point from the beam's pin was the top of a carrier that reaches farther up than its shanks down."""
    site = next(s for s in fixed.sites if s.name == "ripper_tip")
    hull = np.asarray(fixed.body("ripper_beam").hull)
    assert site.position[2] == pytest.approx(float(hull[:, 2].min()), abs=1e-6)


def test_nameless_a_fixed_one_is_whole() -> None:
    machine = dozer(623, "pat", dual=False, high=False, ripper="fixed_parallel")
    choices = {"ripper_links": "plates"}
    assert found_whole(machine, "dozer", 623, triangles=False, choices=choices).choices["ripper"] == "parallel"
