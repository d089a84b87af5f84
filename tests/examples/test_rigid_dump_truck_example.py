"""The rigid dump truck example: its layout meets what its sheet prints, it is drawn so, and it builds to a machine that
is ready, with and without names, from surfaces and from triangles."""

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

TYPE = "rigid_dump_truck"


# ---- layout and drawing --------
def test_values_are_either_published_or_ours(values: ModuleType) -> None:
    assert_sourced(values, 15)


def test_the_layout_meets_what_is_printed(values: ModuleType) -> None:
    known = {value.name: value.value for value in (*values.PUBLISHED, *values.EXAMPLE)}
    got = module(TYPE, "truth").measured()
    assert {values.RAISED_HEIGHT.name, values.DUMP_CLEARANCE.name, values.STEER_STROKE.name} <= set(got)
    for name, value in got.items():
        assert value == pytest.approx(known[name], abs=1e-6), name


def test_the_inner_wheel_turns_farther() -> None:
    layout = module(TYPE, "layout")
    assert np.degrees(layout.outer(layout.LOCK)) == pytest.approx(30.9, abs=0.1)


@pytest.mark.slow
def test_bodies_do_not_meet_as_drawn(made_once: MadeOnce) -> None:
    folder = drawn_example(TYPE, made_once)
    bodies = {path: part["body"] for path, part in truth_of(folder)["parts"].items()}
    assert met_as_drawn(folder / f"{TYPE}.step", bodies) == []


@pytest.mark.slow
def test_the_drawing_has_the_sheet_s_values(made_once: MadeOnce) -> None:
    assert_drawn_to(truth_of(drawn_example(TYPE, made_once)), 14)


@pytest.mark.slow
def test_every_value_is_read_off_the_sheet(values: ModuleType, made_once: MadeOnce) -> None:
    names = {
        "Overall Length": values.LENGTH, "Body Length Overall": values.BODY_LENGTH, "Overall Height": values.HEIGHT,
        "Front Canopy Height": values.CANOPY_HEIGHT, "Body Raised Height": values.RAISED_HEIGHT,
        "Loading Height": values.LOADING_HEIGHT, "Dump Clearance": values.DUMP_CLEARANCE,
        "Overall Width": values.TYRES_WIDTH, "Canopy Width": values.CANOPY_WIDTH,
        "Body Width Outside": values.BODY_WIDTH, "Front Tread": values.FRONT_TREAD, "Rear Tread": values.REAR_TREAD,
        "Wheelbase": values.WHEELBASE, "Rear Overhang": values.REAR_OVERHANG, "Tyre Diameter": values.TYRE_DIAMETER,
        "Rear Axle Clearance": values.AXLE_CLEARANCE, "Hoist Cylinder Stroke": values.HOIST_STROKE,
        "Steering Cylinder Stroke": values.STEER_STROKE,
    }  # fmt: skip
    known = assert_read(TYPE, drawn_example(TYPE, made_once) / "specifications.pdf", names)
    assert known["Rated Payload"].value == values.PAYLOAD.value and known["Rated Payload"].example


# ---- the machine --------
@pytest.fixture(scope="module", params=[True, False], ids=["named", "nameless"])
def built(request: pytest.FixtureRequest, made_once: MadeOnce) -> Built:
    drawing = drawn_example(TYPE, made_once)
    return build_example(TYPE, drawing, made_once, named=request.param)


@pytest.mark.slow
def test_it_is_ready(built: Built) -> None:
    assert_ready(built, 6, {"steering", "hoist", "drive"})


@pytest.mark.slow
def test_what_is_measured_and_drawn_is_what_is_meant(built: Built) -> None:
    assert_measured(built.machine, 17)
    assert_as_drawn(built.machine, built.truth)


@pytest.mark.slow
def test_every_part_is_in_its_body_on_triangles_without_names(made_once: MadeOnce) -> None:
    recognised(TYPE, drawn_example(TYPE, made_once), "nameless", "triangles", made_once)
