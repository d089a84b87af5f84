"""The mobile crane example: its linkages meet what its sheet prints, it is drawn so, and it builds to a machine that is
ready, on its outriggers and in road order, with names and without, from surfaces and from triangles."""

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
    recognised,
)
from kit.machines.forklifts import truth_of

TYPE = "mobile_crane"
LEVERS = {"steering", "rear_steering", "drive", "slew", "luffing", "telescope", "hoist"} | {
    f"{end}_outrigger_{part}_{side}"
    for end in ("front", "rear") for part in ("beam", "jack") for side in ("left", "right")
}  # fmt: skip
KINDS = ["working", "road"]


# ---- linkage and drawing --------
def test_values_are_either_published_or_ours(values: ModuleType) -> None:
    assert_sourced(values, 25)


def test_the_linkages_meet_what_is_printed(values: ModuleType) -> None:
    known = {value.name: value.value for value in (*values.PUBLISHED, *values.EXAMPLE)}
    got = module(TYPE, "linkage").values()
    assert {values.RADIUS_OUT.name, values.LIFT_HEIGHT.name, values.BOOM_OUT.name, values.TURNING.name} <= set(got)
    for name, value in got.items():
        bar = 0.05 if name == values.LUFFING_TIME.name else 1e-4
        assert value == pytest.approx(known[name], abs=bar), name


def test_the_hook_s_speed_is_the_line_s_over_the_falls(values: ModuleType) -> None:
    assert values.LINE_SPEED.value / values.FALLS.value == pytest.approx(15.0)  # as the maker prints it
    assert values.LINE_PULL.value * values.FALLS.value / 9.81 > values.CAPACITY.value / 1000.0


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_bodies_do_not_meet_as_drawn(kind: str, made_once: MadeOnce) -> None:
    folder = drawn_example(TYPE, made_once, kind)
    bodies = {path: part["body"] for path, part in truth_of(folder)["parts"].items()}
    assert met_as_drawn(folder / f"{TYPE}.step", bodies) == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_the_drawing_has_the_sheet_s_values(kind: str, made_once: MadeOnce) -> None:
    assert_drawn_to(truth_of(drawn_example(TYPE, made_once, kind)), 6)


@pytest.mark.slow
def test_every_value_is_read_off_the_sheet(values: ModuleType, made_once: MadeOnce) -> None:
    names = {
        "Boom Length Retracted": values.BOOM_IN, "Boom Length Extended": values.BOOM_OUT,
        "Maximum Working Radius": values.RADIUS_OUT, "Maximum Tip Height": values.LIFT_HEIGHT,
        "Radius at Maximum Capacity": values.CAPACITY_RADIUS, "Tail Swing Radius": values.TAIL,
        "Outrigger Spread Lateral": values.SPREAD, "Outrigger Spread Longitudinal": values.BASE,
        "Overall Length": values.LENGTH, "Overall Width": values.WIDTH, "Overall Height": values.HEIGHT,
        "Wheelbase": values.WHEELBASE, "Ground Clearance": values.CLEARANCE, "Turning Radius": values.TURNING,
        "Luffing Cylinder Stroke": values.LUFFING_STROKE, "Telescoping Cylinder Stroke": values.TELESCOPE_STROKE,
        "Outrigger Beam Cylinder Stroke": values.BEAM_STROKE, "Outrigger Jack Cylinder Stroke": values.JACK_STROKE,
    }  # fmt: skip
    known = assert_read(TYPE, drawn_example(TYPE, made_once, "working") / "specifications.pdf", names)
    for name, value in (
        ("Number of Part Lines", values.FALLS), ("Boom Luffing Time", values.LUFFING_TIME),
        ("Boom Telescoping Time", values.TELESCOPE_TIME), ("Maximum Lifting Capacity", values.CAPACITY),
        ("Operating Weight", values.WEIGHT), ("Boom Sections", values.SECTIONS),
    ):  # fmt: skip
        assert known[name].value == pytest.approx(value.value) and not known[name].example, name
    assert known["Main Winch Line Speed"].value == pytest.approx(2.0)
    assert known["Main Winch Line Pull"].value == pytest.approx(35_300.0)


# ---- the machine --------
@pytest.fixture(scope="module", params=[True, False], ids=["named", "nameless"])
def built(request: pytest.FixtureRequest, made_once: MadeOnce) -> Built:
    return build_example(TYPE, drawn_example(TYPE, made_once, "working"), made_once, named=request.param)


@pytest.mark.slow
def test_it_is_ready(built: Built) -> None:
    assert_ready(built, 21, LEVERS)


@pytest.mark.slow
def test_what_is_measured_and_drawn_is_what_is_meant(built: Built) -> None:
    assert_measured(built.machine, 16)
    cylinders = {k: c for k, c in built.truth["cylinders"].items() if "closed_length" in c}
    assert_as_drawn(built.machine, built.truth | {"cylinders": cylinders})


@pytest.mark.slow
def test_the_winch_pulls_with_all_its_falls(built: Built) -> None:
    drive = built.mechanism.joint("hoist_rope2hook_block_joint").drive
    assert drive is not None and drive.kind == "position"
    assert drive.max_force == pytest.approx(8 * 35_300.0) and drive.max_velocity == pytest.approx(0.25)
    assert not [c for c in built.mechanism.cylinders if "hook" in c.slide]
    hoist = next(a for a in built.mechanism.actuators if a.name == "hoist")
    assert hoist.cylinders == () and [e.sign for e in hoist.joints] == [-1]


@pytest.mark.slow
@pytest.mark.parametrize("named", [True, False], ids=["named", "nameless"])
def test_in_road_order_it_is_ready_too(named: bool, made_once: MadeOnce) -> None:
    built = build_example(TYPE, drawn_example(TYPE, made_once, "road"), made_once, named=named)
    assert_ready(built, 21, LEVERS)
    assert_measured(built.machine, 16)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_every_part_is_in_its_body_on_triangles_without_names(kind: str, made_once: MadeOnce) -> None:
    recognised(TYPE, drawn_example(TYPE, made_once, kind), "nameless", "triangles", made_once)
