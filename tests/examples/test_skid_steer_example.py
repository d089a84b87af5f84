"""The skid steer example: its linkage meets what its sheet publishes, it is drawn so, and it builds to a machine that
is ready, with and without names, from surfaces and from triangles."""

from __future__ import annotations

import itertools
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from example_file import module
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps

from kit.builds import MadeOnce, reading_once, without_pages, without_usd
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
from yellowiron.pipeline import build

TYPE = "skid_steer"


@pytest.fixture(scope="module")
def linkage() -> ModuleType:
    return module("skid_steer", "linkage")


# ---- the linkage --------
def test_values_are_either_published_or_ours(values: ModuleType) -> None:
    assert_sourced(values, 10)


def test_the_linkage_meets_what_is_published(linkage: ModuleType, values: ModuleType) -> None:
    got = module("skid_steer", "truth").measured(linkage.solve())
    known = {value.name: value.value for value in (*values.PUBLISHED, *values.EXAMPLE)}
    assert {values.HINGE_HEIGHT.name, values.REACH.name, values.TURNING_RADIUS.name} <= set(got)
    for name, value in got.items():
        assert value == pytest.approx(known[name], abs=1e-6), name


def test_the_bucket_rises_nearly_upright(linkage: ModuleType) -> None:
    """Links lift the pin far ahead of a pivot's circle: above half its height it keeps its reach to 70 mm."""
    vertical, radial = (linkage.solve(path) for path in ("vertical", "radial"))
    high = [vertical.carry(turn, vertical.B) for turn in np.linspace(0.0, vertical.turn, 60)]
    ahead = [float(p[0]) for p in high if p[1] > 0.5 * high[-1][1]]
    assert max(ahead) - min(ahead) < 70.0
    assert vertical.carry(vertical.turn, vertical.B)[0] > radial.carry(radial.turn, radial.B)[0] + 500.0


def test_cylinders_keep_off_their_dead_points(linkage: ModuleType, values: ModuleType) -> None:
    from drawing.planar import rot, sine

    for path in ("vertical", "radial"):
        k = linkage.solve(path)
        lifted = [k.lift(turn) for turn in np.linspace(0.0, k.turn, 40)]
        assert min(np.diff(lifted)) > 0.2 * (lifted[-1] - lifted[0]) / 39
        for tilt in np.linspace(0.0, 1.0, 9):
            angle = k.angle(values.TILT_CLOSED.value + tilt * values.TILT_STROKE.value)
            assert abs(sine(k.E, k.B, k.B + rot(angle, k.J))) > 0.3


# ---- the drawing --------
@pytest.mark.slow
@pytest.mark.parametrize("path", ["vertical", "radial"])
def test_bodies_do_not_meet_wherever_the_arms_are(path: str, linkage: ModuleType) -> None:
    from drawing.product import Occurrence, occurrences
    from drawing.solids import moved

    draw, equipment = module("skid_steer", "draw"), module("skid_steer", "equipment")
    k = linkage.solve(path)
    leaves = occurrences(draw.draw_machine(path))
    back = equipment.carried(k, draw.pose(k)[0]).Inverted()

    def meeting(a: Occurrence, b: Occurrence, turn: float) -> float:
        """Common volume, mm³, with the first part's arms turned so far."""
        one = moved(moved(a.part.shape, a.place), equipment.carried(k, turn).Multiplied(back))
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(BRepAlgoAPI_Common(one, moved(b.part.shape, b.place)).Shape(), properties)
        return float(properties.Mass())

    arms = [leaf for leaf in leaves if leaf.body == "boom" and not leaf.part.name.startswith("PIN")]
    fixed = [leaf for leaf in leaves if leaf.body == "chassis" or leaf.role.startswith(("front_tyre", "rear_tyre"))]
    fixed = [leaf for leaf in fixed if not leaf.part.name.startswith("PIN")]
    for turn in (0.0, 0.5 * k.turn, k.turn):
        for a, b in itertools.product(arms, fixed):
            assert meeting(a, b, turn) < 1.0, (turn, a.path, b.path)


@pytest.mark.slow
def test_the_drawing_has_the_sheet_s_values(made_once: MadeOnce) -> None:
    assert_drawn_to(truth_of(drawn_example("skid_steer", made_once, "vertical")), 8)


@pytest.mark.slow
def test_every_value_is_read_off_the_sheet(values: ModuleType, made_once: MadeOnce) -> None:
    names = {
        "Length with Bucket": values.LENGTH, "Length Without Attachment": values.BARE_LENGTH,
        "Overall Width": values.OVERALL_WIDTH, "Bucket Width": values.BUCKET_WIDTH, "Overall Height": values.HEIGHT,
        "Hinge Pin Height at Maximum Lift": values.HINGE_HEIGHT, "Dumping Reach": values.REACH,
        "Turning Radius with Bucket": values.TURNING_RADIUS, "Turning Radius Rear": values.REAR_RADIUS,
        "Wheelbase": values.WHEELBASE, "Ground Clearance": values.GROUND_CLEARANCE,
        "Tyre Diameter": values.TYRE_DIAMETER, "Digging Depth": values.DIG_DEPTH,
        "Lift Cylinder Bore": values.LIFT_BORE,
        "Lift Cylinder Rod Diameter": values.LIFT_ROD, "Lift Cylinder Stroke": values.LIFT_STROKE,
        "Tilt Cylinder Bore": values.TILT_BORE, "Tilt Cylinder Rod Diameter": values.TILT_ROD,
        "Tilt Cylinder Stroke": values.TILT_STROKE,
    }  # fmt: skip
    known = assert_read(
        "skid_steer", drawn_example("skid_steer", made_once, "vertical") / "specifications.pdf", names, rel=1e-4
    )
    assert known["Operating Weight"].value == pytest.approx(values.OPERATING_WEIGHT.value, abs=0.5)
    assert known["Rated Operating Capacity"].value == values.CAPACITY.value
    assert known["Main Relief Pressure"].value == pytest.approx(1e6 * values.PRESSURE.value)


# ---- the machine --------
@pytest.fixture(scope="module", params=[True, False], ids=["named", "nameless"])
def built(request: pytest.FixtureRequest, made_once: MadeOnce) -> Built:
    drawing = drawn_example("skid_steer", made_once, "vertical")
    return build_example("skid_steer", drawing, made_once, named=request.param)


@pytest.mark.slow
def test_it_is_ready(built: Built) -> None:
    assert_ready(built, 6, {"boom", "bucket", "drive_left", "drive_right"})
    assert built.machine.alignment.choices == {"lift_path": "vertical", "tilt_cylinders": "twin"}


@pytest.mark.slow
def test_every_value_is_measured(built: Built) -> None:
    assert_measured(built.machine, 15)


@pytest.mark.slow
def test_joints_and_cylinders_are_as_they_are_drawn(built: Built) -> None:
    assert_as_drawn(built.machine, built.truth)


@pytest.mark.slow
def test_the_links_carry_the_arms_as_they_were_solved(built: Built, linkage: ModuleType) -> None:
    k, chain = linkage.solve(), ClosedChain(built.machine.mechanism)
    slide = chain.mechanism.joint("boom_cylinder_barrel_l2boom_piston_rod_l_joint")
    hinge = chain.mechanism.joint("boom2bucket_joint")
    for joint_end, turn in ((slide.lower, 0.0), (slide.upper, k.turn)):
        state = chain.solve({slide.name: joint_end})
        at = chain.displacement(state, "boom") @ np.array([*hinge.anchor, 1.0])
        assert 1000.0 * at[2] == pytest.approx(k.carry(turn, k.B)[1], abs=0.01)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("path", "names", "surfaces"),
    [
        ("vertical", "", "triangles"),
        ("vertical", "nameless", "triangles"),
        ("radial", "", "exact"),
        ("radial", "nameless", "exact"),
        ("radial", "nameless", "triangles"),
    ],
)
def test_every_part_is_in_its_body(path: str, names: str, surfaces: str, made_once: MadeOnce) -> None:
    found = recognised("skid_steer", drawn_example("skid_steer", made_once, path), names, surfaces, made_once)
    assert found.choices["lift_path"] == path


@pytest.mark.slow
@pytest.mark.parametrize("names", ["", "nameless"])
def test_radial_lift_builds_too(names: str, made_once: MadeOnce, tmp_path: Path) -> None:
    folder = drawn_example("skid_steer", made_once, "radial")
    with without_pages(), without_usd(), reading_once(made_once, folder):
        machine = build("skid_steer", folder / names / "skid_steer.step", tmp_path / "out")
    mobility = machine.mechanism.mobility
    assert mobility is not None and (mobility.computed, mobility.expected) == (6, 6)
    known = {m.name: m.model for m in machine.measurements}
    values = truth_of(folder)["values"]
    for name, value in (
        ("Hinge Pin Height at Maximum Lift", "Height to bucket hinge pin"),
        ("Dumping Reach", "Reach at maximum height"),
        ("Turning Radius with Bucket", "Turning radius"),
    ):
        assert known[name] == pytest.approx(values[value]["linkage"] / 1000.0, abs=1e-4), name
