"""The crawler crane example: its linkage meets what its sheet prints, it is drawn so, and it builds to a machine that
is ready, with its boom up and lowered, with names and without."""

from __future__ import annotations

from types import ModuleType

import pytest
from example_file import met_as_drawn, module

from kit.builds import MadeOnce
from kit.machines.drawn_examples import (
    Built,
    assert_as_drawn,
    assert_drawn_to,
    assert_measured,
    assert_read,
    assert_ready,
    assert_sourced,
    build_example,
    drawn_example,
)
from kit.machines.forklifts import truth_of

TYPE = "crawler_crane"
LEVERS = {"travel_left", "travel_right", "slew", "luffing", "hoist"}


# ---- linkage and drawing --------
def test_values_are_either_published_or_ours(values: ModuleType) -> None:
    assert_sourced(values, 13)


def test_the_linkage_meets_what_is_printed(values: ModuleType) -> None:
    known = {value.name: value.value for value in (*values.PUBLISHED, *values.EXAMPLE)}
    linkage = module(TYPE, "linkage")
    for name, value in linkage.values().items():
        assert value == pytest.approx(known[name], rel=1e-3), name
    low, high = linkage.Pose(linkage.LOW), linkage.Pose(linkage.HIGH)
    assert high.rope == pytest.approx(linkage.CLOSE) and low.rope > high.rope
    assert linkage.Pose(linkage.boom_at(values.CAPACITY_RADIUS.value)).head[0] == pytest.approx(3_800.0)


def test_its_winches_hold_what_they_are_to(values: ModuleType) -> None:
    assert values.LINE_PULL.value * values.FALLS.value / 9.81 > values.CAPACITY.value / 1000.0


@pytest.mark.slow
def test_bodies_do_not_meet_as_drawn(made_once: MadeOnce) -> None:
    folder = drawn_example(TYPE, made_once, "working")
    truth = truth_of(folder)
    carried = set(truth["undercarriage_with"])
    bodies = {p: "undercarriage" if x["body"] in carried else x["body"] for p, x in truth["parts"].items()}
    assert met_as_drawn(folder / f"{TYPE}.step", bodies) == []


@pytest.mark.slow
def test_every_value_is_read_off_the_sheet(values: ModuleType, made_once: MadeOnce) -> None:
    folder = drawn_example(TYPE, made_once, "working")
    assert_drawn_to(truth_of(folder), 8)
    names = {
        "Boom Length": values.BOOM, "Maximum Boom Length": values.BOOM_LONGEST,
        "Maximum Tip Height": values.LIFT_HEIGHT,
        "Radius at Maximum Capacity": values.CAPACITY_RADIUS, "Tail Swing Radius": values.TAIL,
        "Boom Foot Height": values.FOOT, "Gantry Height": values.GANTRY, "Overall Width": values.WIDTH,
        "Track Length": values.TRACK, "Track Length on Ground": values.ON_GROUND, "Track Gauge": values.GAUGE,
        "Shoe Width": values.SHOE, "Ground Clearance": values.CLEARANCE,
    }  # fmt: skip
    known = assert_read(TYPE, folder / "specifications.pdf", names)
    for name, value in (
        ("Number of Part Lines", values.FALLS), ("Boom Hoist Part Lines", values.BOOM_FALLS),
        ("Maximum Lifting Capacity", values.CAPACITY), ("Operating Weight", values.WEIGHT),
        ("Counterweight", values.COUNTERWEIGHT),
    ):  # fmt: skip
        assert known[name].value == pytest.approx(value.value) and known[name].example is not value.published, name
    assert known["Boom Hoist Line Speed"].value == pytest.approx(1.0)
    assert known["Main Winch Line Pull"].value == pytest.approx(63_700.0)


# ---- the machine --------
@pytest.mark.slow
@pytest.mark.parametrize(("kind", "named"), [("working", True), ("working", False), ("lowered", True)])
def test_it_is_ready(kind: str, named: bool, made_once: MadeOnce) -> None:
    built: Built = build_example(TYPE, drawn_example(TYPE, made_once, kind), made_once, named=named)
    assert_ready(built, 12, LEVERS)
    assert_measured(built.machine, 12)
    joints = {name: true for name, true in built.truth["joints"].items() if "when" not in true}
    assert_as_drawn(built.machine, built.truth | {"joints": joints}, besides="track_")
    linkage = module(TYPE, "linkage")
    rope = built.mechanism.joint("boom_hoist_rope2boom_pendant_joint")
    let_out = 1e-3 * (linkage.Pose(linkage.LOW).rope - linkage.Pose(linkage.HIGH).rope)
    assert rope.lower is not None and rope.upper is not None
    assert rope.upper - rope.lower == pytest.approx(let_out, rel=1e-3)
    drive = rope.drive
    assert drive is not None and drive.max_force == pytest.approx(600_000.0)
    assert drive.max_velocity == pytest.approx(0.1)
