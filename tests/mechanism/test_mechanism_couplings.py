"""Dozers whose couplings are not drawn: what they carry moves with what is."""

from __future__ import annotations

import numpy as np
import pytest

from kit.machines.dozers import dozer
from kit.machines.partly_drawn import without
from yellowiron.library import load_template
from yellowiron.model.rows import as_drawn
from yellowiron.model.template import choose

ARMS = {"blade": "push_arms", "tilt": "dual", "ripper": "none"}
YOKES = ("push_arm_yoke", "tag_link")


@pytest.mark.slow
@pytest.mark.parametrize("dual", [True, False])
def test_a_blade_tilts_on_push_arms_without_their_yokes_and_tag_link(dual: bool) -> None:
    machine = dozer(5, "push_arms", dual=dual, ripper=False)
    choices = ARMS if dual else {**ARMS, "tilt": "single"}
    whole = without(machine, "dozer", (), choices=choices)
    built = without(machine, "dozer", YOKES, choices=choices)
    assert whole.mobility is not None and built.mobility is not None
    assert built.mobility.computed == built.mobility.expected == whole.mobility.expected
    # The one arm on a plain hinge, which keeps the blade from swaying, the other on two that cross.
    assert built.joint("push_arm_l2blade_joint").type == "revolute"
    assert {a.name for a in built.actuators} == {a.name for a in whole.actuators}
    assert {f.where for f in built.findings if f.code == "MEC017"} == {"push_arm_yoke_l", "push_arm_yoke_r"}
    if dual:
        crossed = [built.joint(n).axis for n in ("push_arm_r2push_arm_yoke_r_joint", "push_arm_yoke_r2blade_joint")]
        assert abs(np.dot(*crossed)) < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize(
    ("absent", "joints"),
    [
        (("pitch_link", "angle"), {"c_frame2blade_joint": "revolute"}),
        (("pitch_link",), {"c_frame2blade_cross_joint": "revolute", "blade_cross2blade_joint": "revolute"}),
        (("pitch_link", "angle", "tilt"), {"c_frame2blade_joint": "fixed"}),
    ],
)
def test_a_blade_turns_on_its_ball_as_the_cylinders_that_are_drawn_turn_it(
    absent: tuple[str, ...], joints: dict[str, str]
) -> None:
    built = without(dozer(4, "pat", ripper=False), "dozer", absent, choices={"blade": "pat"})
    assert built.mobility is not None and built.mobility.computed == built.mobility.expected
    pairs = {frozenset(("c_frame", "blade")), *(frozenset((b, "blade_cross")) for b in ("c_frame", "blade"))}
    assert {j.name: j.type for j in built.joints if frozenset((j.body0, j.body1)) in pairs} == joints
    assert "MEC073" in {f.code for f in built.findings}


def test_what_an_absent_coupling_carries_is_one_with_its_arms_where_no_cylinder_is_between_them() -> None:
    chosen = choose(load_template("dozer"), ARMS)
    bodies = {r.name for r in chosen.roles if r.rigid}
    assert as_drawn(chosen, bodies) is chosen
    bare = as_drawn(chosen, {b for b in bodies if not any(w in b for w in (*YOKES, "arm_tilt"))})
    assert [bare.joint(f"push_arm_{side}2blade_joint").type for side in "lr"] == ["fixed", "fixed"]
    built = without(dozer(5, "push_arms", dual=True, ripper=False), "dozer", (*YOKES, "arm_tilt"), choices=ARMS)
    told = {f.where: f.message for f in built.findings if f.code == "MEC017"}
    assert "'blade' and 'push_arm_l' move as one" in told["push_arm_yoke_l"]
    assert built.mobility is not None and built.mobility.computed == built.mobility.expected
    # A coupling beside another that is drawn stays what it is.
    assert as_drawn(chosen, bodies - {"push_arm_yoke_l"}).role("push_arm_yoke_l").rigid
