"""Articulated machines whose hitch is not drawn: they bend as they are steered."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from kit.machines.articulated_trucks import articulated_truck
from kit.machines.partly_drawn import without
from kit.machines.rollers import roller
from kit.machines.synthetic import Machine
from yellowiron.library import load_template
from yellowiron.model.rows import as_drawn
from yellowiron.model.template import choose

CASES = [
    pytest.param("roller", lambda: roller(4, tandem=False), "rear_frame2hitch_joint", "front_frame", id="roller"),
    pytest.param(
        "articulated_dump_truck",
        lambda: articulated_truck(4),
        "front_frame2hitch_joint",
        "rear_frame",
        id="articulated dump truck",
    ),
]


@pytest.mark.parametrize(("kind", "draw", "name", "behind"), CASES)
def test_the_frames_turn_on_each_other_where_no_hitch_is_drawn(
    kind: str, draw: Callable[[], Machine], name: str, behind: str
) -> None:
    whole = without(draw(), kind, ())
    built = without(draw(), kind, ("hitch", "steering", "articulation_pin"), upright=(name,))
    joint, before = built.joint(name), whole.joint(name)
    assert {joint.body0, joint.body1} == {before.body0, behind}
    assert abs(joint.axis[2]) > 0.99
    assert joint.drive is not None and joint.lower is not None and joint.upper is not None
    assert joint.lower < -0.3 < 0.3 < joint.upper
    assert not [j for j in built.joints if "hitch" in j.name and j is not joint]
    assert {f.code for f in built.findings if f.where == "hitch"} == {"MEC017"}
    assert "MEC011" not in {f.code for f in built.findings}


def test_a_hitch_that_is_drawn_stays_and_one_between_nothing_too() -> None:
    chosen = choose(load_template("roller"), {})
    bodies = {r.name for r in chosen.roles if r.rigid}
    assert as_drawn(chosen, bodies).role("hitch").rigid
    bare = as_drawn(chosen, bodies - {"hitch"})
    assert not bare.role("hitch").rigid and bare.body_of("hitch") == "front_frame"
    assert "hitch2front_frame_joint" not in {j.name for j in bare.joints}
