"""The backhoe loader example: its linkages meet what its sheet prints, it is drawn so, and it builds to a machine that
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

TYPE = "backhoe_loader"


# ---- linkages and drawing --------
def test_values_are_either_published_or_ours(values: ModuleType) -> None:
    assert_sourced(values, 19)


def test_the_linkages_meet_what_is_printed(values: ModuleType) -> None:
    known = {value.name: value.value for value in (*values.PUBLISHED, *values.EXAMPLE)}
    got = module(TYPE, "truth").measured()
    assert {values.DIG_DEPTH.name, values.GROUND_REACH.name, values.LOADING_HEIGHT.name} <= set(got)
    assert {values.DUMP_HEIGHT.name, values.FEET_CLEARANCE.name} <= set(got)
    for name, value in got.items():
        assert value == pytest.approx(known[name], abs=1e-4), name


def test_forces_are_about_those_printed(values: ModuleType) -> None:
    """Calculated ones, without weights; the dipper's with the dipper drawn in would be more than drawn out."""
    got = module(TYPE, "truth").forces()
    for value, bar in ((values.LOADER_FORCE, 0.05), (values.BUCKET_FORCE, 0.02)):
        assert got[value.name] == pytest.approx(value.value, rel=bar), value.name
    assert 0.6 * values.DIPPER_FORCE.value < got[values.DIPPER_FORCE.name] < values.DIPPER_FORCE.value


def test_the_bucket_stays_level_as_the_arms_rise() -> None:
    linkage = module(TYPE, "linkage")
    k = linkage.solve_loader()
    level = k.tilt_for_angle(k.lift_for_hinge(linkage.DEPTH), 0.0, linkage.TILTS)
    angles = [k.pose(float(lift), level).bucket_angle for lift in np.linspace(*linkage.LIFTS, 9)]
    assert np.degrees(np.abs(angles)).max() < 10.5


@pytest.mark.slow
def test_bodies_do_not_meet_as_drawn(made_once: MadeOnce) -> None:
    folder = drawn_example(TYPE, made_once)
    bodies = {path: part["body"] for path, part in truth_of(folder)["parts"].items()}
    assert met_as_drawn(folder / f"{TYPE}.step", bodies) == []


@pytest.mark.slow
def test_the_drawing_has_the_sheet_s_values(made_once: MadeOnce) -> None:
    assert_drawn_to(truth_of(drawn_example(TYPE, made_once)), 8)


@pytest.mark.slow
def test_every_value_is_read_off_the_sheet(values: ModuleType, made_once: MadeOnce) -> None:
    names = {
        "Wheelbase": values.WHEELBASE, "Swing Pivot to Rear Axle": values.SLEW_TO_AXLE,
        "Stabilizer Feet Clearance": values.FEET_CLEARANCE, "Kingpost Clearance": values.KINGPOST_CLEARANCE,
        "Cab Height": values.CAB_HEIGHT, "Rear Frame Width": values.FRAME_WIDTH,
        "Loader Bucket Width": values.SHOVEL_WIDTH, "Maximum Digging Depth": values.DIG_DEPTH,
        "Maximum Reach at Ground Line": values.GROUND_REACH, "Backhoe Loading Height": values.LOADING_HEIGHT,
        "Loader Dump Height": values.DUMP_HEIGHT, "Loader Hinge Pin Height": values.HINGE_HEIGHT,
        "Loader Dump Reach": values.DUMP_REACH, "Loader Digging Depth": values.LOADER_DEPTH,
        "Stabilizer Spread": values.SPREAD, "Ground Clearance": values.GROUND_CLEARANCE,
        "Tyre Diameter": values.TYRE_DIAMETER, "Extension Cylinder Stroke": values.EXTENSION_STROKE,
        "Swing Cylinder Rod Diameter": values.SWING_ROD, "Stabilizer Cylinder Stroke": values.STABILISER_STROKE,
        "Steering Cylinder Stroke": values.STEER_STROKE,
    }  # fmt: skip
    known = assert_read(TYPE, drawn_example(TYPE, made_once) / "specifications.pdf", names)
    forces = ((values.BUCKET_FORCE, "Bucket Digging Force"), (values.LOADER_FORCE, "Loader Breakout Force"))
    for value, name in forces:
        assert known[name].value == pytest.approx(1000.0 * value.value) and not known[name].example


# ---- the machine --------
@pytest.fixture(scope="module", params=[True, False], ids=["named", "nameless"])
def built(request: pytest.FixtureRequest, made_once: MadeOnce) -> Built:
    drawing = drawn_example(TYPE, made_once)
    return build_example(TYPE, drawing, made_once, named=request.param)


@pytest.mark.slow
def test_it_is_ready(built: Built) -> None:
    levers = {"steering", "drive", "loader_lift", "loader_bucket", "backhoe_swing", "boom", "dipper", "extension"}
    assert_ready(built, 15, levers | {"backhoe_bucket", "stabilizer_left", "stabilizer_right"})


@pytest.mark.slow
def test_what_is_measured_and_drawn_is_what_is_meant(built: Built) -> None:
    assert_measured(built.machine, 21)
    rams = {"front_axle2steering_piston_rod_joint"}
    truth = built.truth | {"cylinders": {k: c for k, c in built.truth["cylinders"].items() if k not in rams}}
    assert_as_drawn(built.machine, truth)


@pytest.mark.slow
def test_every_part_is_in_its_body_on_triangles_without_names(made_once: MadeOnce) -> None:
    recognised(TYPE, drawn_example(TYPE, made_once), "nameless", "triangles", made_once)
