"""The telehandler example: its linkage meets what its sheet prints, it is drawn so, and it builds to a machine that is
ready, with and without names, from surfaces and from triangles; with a boom of three sections, too."""

from __future__ import annotations

from types import ModuleType

import numpy as np
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

TYPE = "telehandler"
LEVERS = {"steering", "rear_steering", "drive", "lift", "telescope", "tilt"}


# ---- linkage and drawing --------
def test_values_are_either_published_or_ours(values: ModuleType) -> None:
    assert_sourced(values, 23)


def test_the_linkage_meets_what_is_printed(values: ModuleType) -> None:
    known = {value.name: value.value for value in (*values.PUBLISHED, *values.EXAMPLE)}
    got = module(TYPE, "truth").calculated(module(TYPE, "draw").drawn(2))
    assert {values.LIFT_HEIGHT.name, values.HEIGHT_REACH.name, values.FORWARD_REACH.name} <= set(got)
    assert {values.FORK_FACE.name, values.TURNING_RADIUS.name, values.STEER_ANGLE.name} <= set(got)
    for name, value in got.items():
        bar = {values.LIFT_TIME.name: 0.01, values.EXTEND_TIME.name: 0.01}.get(name, 1e-4)
        assert value == pytest.approx(known[name], abs=bar), name


def test_the_pump_s_flow_gives_the_times_that_are_printed(values: ModuleType) -> None:
    """Strokes and bores are ours: they are those with which flow over area is the published time."""
    for bore, stroke, time in (
        (values.LIFT_BORE, values.LIFT_STROKE, values.LIFT_TIME),
        (values.TELESCOPE_BORE, values.TELESCOPE_STROKE, values.EXTEND_TIME),
    ):
        litres = np.pi / 4 * bore.value**2 * stroke.value * 1e-6
        assert 60.0 * litres / values.FLOW.value == pytest.approx(time.value, rel=0.001), time.name


def test_a_third_section_reaches_as_much_farther_again() -> None:
    linkage = module(TYPE, "linkage")
    two, three = linkage.solve(2), linkage.solve(3)
    assert three.travel == pytest.approx(2.0 * two.travel)
    out = [three.pose(0.0, share, 0.0).N[0] - three.pose(0.0, 0.0, 0.0).N[0] for share in (0.5, 1.0)]
    assert out == pytest.approx([two.travel, 2.0 * two.travel])


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["two", "three"])
def test_bodies_do_not_meet_as_drawn(kind: str, made_once: MadeOnce) -> None:
    folder = drawn_example(TYPE, made_once, kind)
    bodies = {path: part["body"] for path, part in truth_of(folder)["parts"].items()}
    assert met_as_drawn(folder / f"{TYPE}.step", bodies) == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["two", "three"])
def test_the_drawing_has_the_sheet_s_values(kind: str, made_once: MadeOnce) -> None:
    assert_drawn_to(truth_of(drawn_example(TYPE, made_once, kind)), 5)


@pytest.mark.slow
def test_every_value_is_read_off_the_sheet(values: ModuleType, made_once: MadeOnce) -> None:
    names = {
        "Maximum Lift Height": values.LIFT_HEIGHT, "Reach at Maximum Height": values.HEIGHT_REACH,
        "Maximum Forward Reach": values.FORWARD_REACH, "Length to Fork Face": values.FORK_FACE,
        "Overall Height": values.OVERALL_HEIGHT, "Overall Width": values.OVERALL_WIDTH, "Wheelbase": values.WHEELBASE,
        "Ground Clearance": values.GROUND_CLEARANCE, "Turning Radius": values.TURNING_RADIUS,
        "Fork Length": values.FORK_LENGTH, "Tyre Diameter": values.TYRE_DIAMETER,
        "Lift Cylinder Stroke": values.LIFT_STROKE, "Lift Cylinder Rod Diameter": values.LIFT_ROD,
        "Telescoping Cylinder Stroke": values.TELESCOPE_STROKE,
        "Telescoping Cylinder Rod Diameter": values.TELESCOPE_ROD, "Tilt Cylinder Stroke": values.TILT_STROKE,
        "Compensation Cylinder Stroke": values.COMPENSATION_STROKE, "Steering Cylinder Stroke": values.STEER_STROKE,
    }  # fmt: skip
    known = assert_read(TYPE, drawn_example(TYPE, made_once, "two") / "specifications.pdf", names)
    for name, value in (
        ("Boom Lift Time", values.LIFT_TIME), ("Boom Lower Time", values.LOWER_TIME),
        ("Boom Extend Time", values.EXTEND_TIME), ("Boom Retract Time", values.RETRACT_TIME),
        ("Maximum Lift Capacity", values.CAPACITY), ("Capacity at Maximum Height", values.HEIGHT_CAPACITY),
        ("Capacity at Maximum Reach", values.REACH_CAPACITY), ("Operating Weight", values.WEIGHT),
    ):  # fmt: skip
        assert known[name].value == pytest.approx(value.value) and not known[name].example, name


# ---- the machine --------
@pytest.fixture(scope="module", params=[True, False], ids=["named", "nameless"])
def built(request: pytest.FixtureRequest, made_once: MadeOnce) -> Built:
    drawing = drawn_example(TYPE, made_once, "two")
    return build_example(TYPE, drawing, made_once, named=request.param)


@pytest.mark.slow
def test_it_is_ready(built: Built) -> None:
    assert_ready(built, 10, LEVERS)


@pytest.mark.slow
def test_what_is_measured_and_drawn_is_what_is_meant(built: Built) -> None:
    assert_measured(built.machine, 14)
    assert_as_drawn(built.machine, _with_pins(built.truth))


@pytest.mark.slow
@pytest.mark.parametrize("named", [True, False], ids=["named", "nameless"])
def test_three_sections_on_a_levelled_frame_are_ready(named: bool, made_once: MadeOnce) -> None:
    drawing = drawn_example(TYPE, made_once, "three")
    built = build_example(TYPE, drawing, made_once, named=named)
    assert_ready(built, 13, LEVERS | {"levelling", "stabilizer_left", "stabilizer_right"})
    assert_measured(built.machine, 16)
    assert_as_drawn(built.machine, _with_pins(built.truth))


def _with_pins(truth: dict[str, object]) -> dict[str, object]:
    """The truth without the cylinders that have no pins, and so no closed length."""
    cylinders = truth["cylinders"]
    assert isinstance(cylinders, dict)
    return truth | {"cylinders": {k: c for k, c in cylinders.items() if "closed_length" in c}}


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["two", "three"])
def test_every_part_is_in_its_body_on_triangles_without_names(kind: str, made_once: MadeOnce) -> None:
    recognised(TYPE, drawn_example(TYPE, made_once, kind), "nameless", "triangles", made_once)
