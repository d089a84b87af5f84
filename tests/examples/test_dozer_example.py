"""The dozer example: its linkage in space meets what its sheet prints, it is drawn so, and it builds to a machine that
is ready, with and without names, from surfaces and from triangles."""

from __future__ import annotations

import itertools
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
from yellowiron.kinematics import ClosedChain

TYPE = "dozer"
LIFT, TILT, ANGLE = (
    "lift_cylinder_barrel_l2lift_piston_rod_l_joint",
    "tilt_cylinder_barrel2tilt_piston_rod_joint",
    "angle_cylinder_barrel_l2angle_piston_rod_l_joint",
)


@pytest.fixture(scope="module")
def linkage() -> ModuleType:
    return module("dozer", "linkage")


# ---- the linkage --------
def test_values_are_either_published_or_ours(values: ModuleType) -> None:
    assert_sourced(values, 10)


def test_the_linkage_meets_what_the_sheet_prints(linkage: ModuleType, values: ModuleType) -> None:
    got = module("dozer", "truth").measured(linkage.solve(), linkage.turn_for(linkage.LIFTED))
    known = {value.name: value.value for value in (*values.PUBLISHED, *values.EXAMPLE)}
    assert len(got) == 4
    for name, value in got.items():
        assert value == pytest.approx(known[name], abs=1e-6), name


def test_the_blade_is_turned_by_a_rotation(linkage: ModuleType) -> None:
    k = linkage.solve()
    for tilt, angle in itertools.product((-60.0, 0.0, 60.0), (-250.0, 0.0, 230.0)):
        matrix = k.blade(tilt, angle)
        assert np.abs(matrix.T @ matrix - np.eye(3)).max() < 1e-12 and np.linalg.det(matrix) > 0.0


# ---- the drawing --------
@pytest.mark.slow
def test_the_drawing_has_the_sheet_s_values(made_once: MadeOnce) -> None:
    assert_drawn_to(truth_of(drawn_example(TYPE, made_once)), 8)


@pytest.mark.slow
def test_every_value_is_read_off_the_sheet(values: ModuleType, made_once: MadeOnce) -> None:
    names = {
        "Track Gauge": values.TRACK_GAUGE, "Shoe Width": values.SHOE_WIDTH, "Width over Tracks": values.WIDTH,
        "Track Length on Ground": values.TRACK_ON_GROUND, "Ground Clearance": values.GROUND_CLEARANCE,
        "Overall Height": values.HEIGHT, "Length Without Blade": values.BARE_LENGTH,
        "Blade Width": values.BLADE_WIDTH, "Blade Lift Height": values.LIFT_HEIGHT,
        "Blade Digging Depth": values.DIG_DEPTH, "Maximum Blade Tilt": values.MAX_TILT,
        "Blade Lift Cylinder Stroke": values.LIFT_STROKE, "Blade Lift Cylinder Bore": values.LIFT_BORE,
        "Blade Tilt Cylinder Stroke": values.TILT_STROKE, "Blade Angle Cylinder Stroke": values.ANGLE_STROKE,
        "Blade Angle Cylinder Rod Diameter": values.ANGLE_ROD,
    }  # fmt: skip
    known = assert_read(TYPE, drawn_example(TYPE, made_once) / "specifications.pdf", names, rel=1e-4)
    assert known["Blade Angle"].value == pytest.approx(np.radians(values.BLADE_ANGLE.value))
    assert known["Operating Weight"].value == pytest.approx(values.OPERATING_WEIGHT.value, abs=0.5)


# ---- the machine --------
@pytest.fixture(scope="module", params=[True, False], ids=["named", "nameless"])
def built(request: pytest.FixtureRequest, made_once: MadeOnce) -> Built:
    return build_example(TYPE, drawn_example(TYPE, made_once), made_once, named=request.param)


@pytest.mark.slow
def test_it_is_ready(built: Built) -> None:
    levers = {"blade_lift", "blade_tilt", "blade_angle", "travel_left", "travel_right"}
    assert_ready(built, 9, levers)
    assert {n: c for n, c in built.machine.alignment.choices.items() if n != "tracks"} == {
        "blade": "pat",
        "tilt": "single",
        "ripper": "none",
        "track_frames": "fixed",
    }


@pytest.mark.slow
def test_every_value_is_measured(built: Built) -> None:
    assert_measured(built.machine, 11)


@pytest.mark.slow
def test_joints_and_cylinders_are_as_they_are_drawn(built: Built) -> None:
    """But for the hidden wheels, which no drawing has."""
    assert_as_drawn(built.machine, built.truth, besides="track_")


@pytest.mark.slow
def test_the_blade_goes_where_the_independent_solution_has_it(built: Built, linkage: ModuleType) -> None:
    """Every corner of the strokes: the ends of the cutting edge, to 10 µm (the frame is found from the drawing)."""
    k, chain = linkage.solve(), ClosedChain(built.mechanism)
    up = linkage.turn_for(linkage.LIFTED)
    sites = {site.name: np.array([*site.position, 1.0]) for site in built.mechanism.sites}
    drawn = [np.array(p) for p in linkage.corners(np.eye(3))]
    origin = sites["blade_corner_l"][:3] - np.array(linkage.raised(up, drawn[0])) / 1000.0
    angle = chain.mechanism.joint(ANGLE)
    for lift, tilt, turn in itertools.product((-0.2, 0.25), (-0.06, 0.06), (angle.lower, 0.0, angle.upper)):
        state = chain.solve({LIFT: lift, TILT: tilt, ANGLE: turn})
        moved = chain.displacement(state, "blade")
        # The tree holds the lift cylinder by its rod.
        ahead = k.turn_at(k.lift_length(up) + 1000.0 * lift)
        matrix = k.blade(1000.0 * tilt, 1000.0 * turn)
        for name, place in zip(("blade_corner_l", "blade_corner_r"), linkage.corners(matrix), strict=True):
            expected = np.array(linkage.raised(ahead, place)) / 1000.0 + origin
            assert np.abs((moved @ sites[name])[:3] - expected).max() < 1e-5, (name, lift, tilt, turn)


@pytest.mark.slow
@pytest.mark.parametrize("names", ["", "nameless"])
def test_every_part_is_in_its_body_on_triangles_too(names: str, made_once: MadeOnce) -> None:
    found = recognised(TYPE, drawn_example(TYPE, made_once), names, "triangles", made_once)
    assert found.choices["blade"] == "pat"


@pytest.mark.slow
def test_bodies_do_not_meet_as_drawn(made_once: MadeOnce) -> None:
    folder = drawn_example(TYPE, made_once)
    bodies = {path: entry["body"] for path, entry in truth_of(folder)["parts"].items()}
    met = met_as_drawn(folder / "dozer.step", bodies)
    # Shoes lie on wheels and on each other; a ball's facets touch those of its socket, 0.2 mm around it.
    tracks = ("track_", "sprocket_", "idler_", "carrier_", "main_frame")
    others = [pair for pair in met if not all(bodies[part].startswith(tracks) for part in pair)]
    assert [pair for pair in others if not any("BALL STUD" in part for part in pair)] == []
