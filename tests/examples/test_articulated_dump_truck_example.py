"""The articulated dump truck example: its layout meets what its sheet prints, it is drawn so, and it builds to a
machine that is ready, with and without names, from surfaces and from triangles."""

from __future__ import annotations

import math
from types import ModuleType

import numpy as np
import pytest
from example_file import gaps, module, read_step, solids_of

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

TYPE = "articulated_dump_truck"


@pytest.fixture(scope="module")
def layout() -> ModuleType:
    return module(TYPE, "layout")


# ---- the layout --------
def test_values_are_either_published_or_ours(values: ModuleType) -> None:
    assert_sourced(values, 8)


def test_the_layout_meets_what_is_printed(layout: ModuleType, values: ModuleType) -> None:
    known = {value.name: value.value for value in (*values.PUBLISHED, *values.EXAMPLE)}
    got = layout.measured()
    assert {values.WHEELBASE.name, values.TURNING_RADIUS.name, values.DUMP_ANGLE.name} <= set(got)
    for name, value in got.items():
        assert value == pytest.approx(known[name], abs=1e-6), name


def test_cylinders_keep_off_their_dead_points(layout: ModuleType) -> None:
    steering, hoist = layout.solve_steering(), layout.solve_hoist()
    assert min(steering.lever(angle) for angle in np.linspace(-layout.LOCK, layout.LOCK, 21)) > 200.0
    lengths = [hoist.length(raised) for raised in np.linspace(0.0, layout.TIPPER.dump, 41)]
    assert min(np.diff(lengths)) > 0.5 * (lengths[-1] - lengths[0]) / 40


# ---- the drawing --------
@pytest.mark.slow
def test_bodies_do_not_meet_as_drawn_nor_at_the_ends(layout: ModuleType, made_once: MadeOnce) -> None:
    """As drawn; bent to either side; the body lowered and raised. Pins and cylinders are left out where they move."""
    folder = drawn_example(TYPE, made_once)
    parts, leaves = truth_of(folder)["parts"], read_step(folder / f"{TYPE}.step")
    solids, bodies = solids_of(leaves), [parts[leaf.path]["body"] for leaf in leaves]
    frame = np.array(truth_of(folder)["frame"])
    frame[:3, 3] *= 1000.0
    rear = [b.startswith(("hitch", "rear_frame", "bogie", "middle", "rear_wheel", "dump_body")) for b in bodies]
    cylinders = ["cylinder" in b or "piston" in b for b in bodies]

    def turned(axis: tuple[float, float, float], angle: float, at: tuple[float, float, float]) -> np.ndarray:
        """Machine frame."""
        k = np.array([[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
        m = np.eye(4)
        m[:3, :3] += math.sin(angle) * k + (1.0 - math.cos(angle)) * k @ k
        m[:3, 3] = np.array(at) - m[:3, :3] @ np.array(at)
        return np.linalg.inv(frame) @ m @ frame

    hinge = (float(layout.TIPPER.hinge[0]), 0.0, float(layout.TIPPER.hinge[1]))
    drawn = module(TYPE, "draw").raised()
    for steer, raised in ((0.0, drawn), (layout.LOCK, 0.0), (-layout.LOCK, 0.0), (0.0, layout.TIPPER.dump)):
        bend = turned((0.0, 0.0, 1.0), steer, (0.0, 0.0, 0.0))
        tip = turned((0.0, 1.0, 0.0), drawn - raised, hinge)
        moves = [(bend if behind else np.eye(4)) @ (tip if body == "dump_body" else np.eye(4))
                 for body, behind in zip(bodies, rear, strict=True)]  # fmt: skip
        still = steer == 0.0 and raised == drawn
        met = [
            (leaves[i].path, leaves[j].path)
            for (i, j), gap in gaps(solids, moves, 0.01).items()
            if bodies[i] != bodies[j] and gap == 0.0 and (still or not (cylinders[i] or cylinders[j]))
            and not any("PINS" in leaves[k].path for k in (i, j))
        ]  # fmt: skip
        assert met == [], (steer, raised)


@pytest.mark.slow
def test_the_drawing_has_the_sheet_s_values(made_once: MadeOnce) -> None:
    assert_drawn_to(truth_of(drawn_example(TYPE, made_once)), 11)


@pytest.mark.slow
def test_every_value_is_read_off_the_sheet(values: ModuleType, made_once: MadeOnce) -> None:
    names = {
        "Overall Length": values.LENGTH, "Overall Width": values.OVERALL_WIDTH, "Overall Height": values.HEIGHT,
        "Body Raised Height": values.RAISED_HEIGHT, "Loading Height": values.LOADING_HEIGHT,
        "Dump Clearance": values.DUMP_CLEARANCE, "Body Width Outside": values.BODY_WIDTH,
        "Bogie Axle Spacing": values.BOGIE_SPACING, "Front Tread": values.FRONT_TREAD,
        "Rear Tread": values.REAR_TREAD, "Front Overhang": values.FRONT_OVERHANG,
        "Ground Clearance": values.GROUND_CLEARANCE, "Tyre Diameter": values.TYRE_DIAMETER,
        "Turning Radius": values.TURNING_RADIUS, "Front Axle to Bogie": values.WHEELBASE,
        "Hoist Cylinder Bore": values.HOIST_BORE, "Hoist Cylinder Rod Diameter": values.HOIST_ROD,
        "Hoist Cylinder Stroke": values.HOIST_STROKE, "Steering Cylinder Bore": values.STEER_BORE,
        "Steering Cylinder Rod Diameter": values.STEER_ROD, "Steering Cylinder Stroke": values.STEER_STROKE,
    }  # fmt: skip
    known = assert_read(TYPE, drawn_example(TYPE, made_once) / "specifications.pdf", names, rel=1e-4)
    for name, value in (("Articulation Angle", values.ARTICULATION), ("Body Dump Angle", values.DUMP_ANGLE),
                        ("Approach Angle", values.APPROACH_ANGLE)):  # fmt: skip
        assert known[name].value == pytest.approx(math.radians(value.value)), name
    assert known["Rated Payload"].value == values.PAYLOAD.value and not known["Rated Payload"].example
    assert known["Main Relief Pressure"].value == pytest.approx(1e6 * values.PRESSURE.value)


# ---- the machine --------
@pytest.fixture(scope="module", params=[True, False], ids=["named", "nameless"])
def built(request: pytest.FixtureRequest, made_once: MadeOnce) -> Built:
    drawing = drawn_example(TYPE, made_once)
    return build_example(TYPE, drawing, made_once, named=request.param)


@pytest.mark.slow
def test_it_is_ready(built: Built) -> None:
    assert_ready(built, 11, {"steering", "hoist", "drive"})
    assert built.machine.alignment.choices == {"bogie": "beams"}


@pytest.mark.slow
def test_every_value_is_measured(built: Built) -> None:
    assert_measured(built.machine, 18)


@pytest.mark.slow
def test_joints_and_cylinders_are_as_they_are_drawn(built: Built) -> None:
    assert_as_drawn(built.machine, built.truth)


@pytest.mark.slow
def test_every_part_is_in_its_body_on_triangles_without_names(made_once: MadeOnce) -> None:
    recognised(TYPE, drawn_example(TYPE, made_once), "nameless", "triangles", made_once)
