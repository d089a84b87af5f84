"""The forklift example: drawing, sheet and truth agree; it builds to a machine that is ready, with and without names,
with every kind of mast."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from example_drawn import differences
from example_file import EXAMPLES

from kit.builds import MadeOnce, reading_once, without_pages, without_usd
from kit.machines.drawn_examples import Built, assert_read, assert_ready, build_example
from kit.machines.forklifts import drawn, truth_of
from yellowiron.kinematics import ClosedChain
from yellowiron.pipeline import build

TYPE = "forklift"
FOLDER = EXAMPLES / "forklift"


# ---- drawing and sheet --------
@pytest.mark.slow
def test_the_truth_is_drawn_the_same_again(made_once: MadeOnce) -> None:
    assert differences(drawn("simplex", made_once) / "truth.json", FOLDER / "truth.json") == []


def test_the_drawing_has_the_sheet_s_values() -> None:
    for name, value in truth_of(FOLDER)["values"].items():
        assert value["drawn"] == pytest.approx(value["target"], abs=0.01), name


def test_the_sheet_is_written_the_same_again(tmp_path: Path) -> None:
    subprocess.run([sys.executable, "-m", "forklift.sheet", str(tmp_path)], cwd=EXAMPLES, check=True)
    assert (tmp_path / "specifications.pdf").read_bytes() == (FOLDER / "specifications.pdf").read_bytes()


def test_every_value_is_read_off_the_sheet(values: ModuleType) -> None:
    names = {
        "Lift Cylinder Bore": values.LIFT_BORE, "Lift Cylinder Stroke": values.LIFT_STROKE,
        "Lift Cylinder Rod Diameter": values.LIFT_ROD, "Tilt Cylinder Bore": values.TILT_BORE,
        "Tilt Cylinder Stroke": values.TILT_STROKE, "Tilt Cylinder Rod Diameter": values.TILT_ROD,
        "Steering Cylinder Bore": values.STEER_BORE, "Steering Cylinder Stroke": values.STEER_STROKE,
        "Steering Cylinder Rod Diameter": values.STEER_ROD, "Lift Height": values.LIFT_HEIGHT,
        "Lowered Mast Height": values.LOWERED_HEIGHT, "Extended Mast Height": values.EXTENDED_HEIGHT,
        "Overhead Guard Height": values.GUARD_HEIGHT, "Length to Fork Face": values.LENGTH_TO_FORK,
        "Overall Length": values.OVERALL_LENGTH, "Overall Width": values.OVERALL_WIDTH, "Wheelbase": values.WHEELBASE,
        "Load Distance": values.LOAD_DISTANCE, "Fork Carriage Width": values.CARRIAGE_WIDTH,
        "Front Tread": values.FRONT_TREAD, "Rear Tread": values.REAR_TREAD, "Tyre Diameter": values.TYRE_DIAMETER,
        "Ground Clearance Below Mast": values.MAST_CLEARANCE,
    }  # fmt: skip
    known = assert_read("forklift", FOLDER / "specifications.pdf", names)
    assert np.degrees(known["Mast Tilt Forward"].value or 0.0) == pytest.approx(values.TILT_FORWARD.value)
    assert np.degrees(known["Mast Tilt Backward"].value or 0.0) == pytest.approx(values.TILT_BACKWARD.value)
    assert known["Rated Capacity"].value == values.RATED_CAPACITY.value
    assert known["Operating Weight"].value == values.SERVICE_WEIGHT.value


# ---- the machine --------
@pytest.fixture(scope="module", params=[True, False], ids=["named", "nameless"])
def built(request: pytest.FixtureRequest, made_once: MadeOnce) -> Built:
    drawing = drawn("simplex", made_once)
    return build_example("forklift", drawing, made_once, named=request.param, sheet=FOLDER / "specifications.pdf")


@pytest.mark.slow
def test_it_is_ready(built: Built) -> None:
    assert_ready(built, 8, {"lift", "tilt", "steering", "drive"})


@pytest.mark.slow
def test_every_value_is_measured(built: Built) -> None:
    known = {m.name: m for m in built.machine.measurements}
    assert len(known) == 16
    for name, found in known.items():
        assert found.spec is not None and found.model is not None, name
        if found.unit == "rad":
            assert np.degrees(found.model) == pytest.approx(np.degrees(found.spec), abs=0.2), name
        else:
            assert found.model == pytest.approx(found.spec, rel=3e-3), name
        assert found.role != "calibrated"


@pytest.mark.slow
def test_joints_are_where_they_are_drawn(built: Built) -> None:
    frame = built.machine.alignment.frame
    assert {j.name for j in built.mechanism.joints} == set(built.truth["joints"])
    for name, drawn_joint in built.truth["joints"].items():
        joint = built.mechanism.joint(name)
        axis = frame[:3, :3] @ np.array(drawn_joint["axis"])
        assert joint.type == drawn_joint["type"]
        assert np.linalg.norm(np.cross(axis, joint.axis)) < 1e-6, name
        if joint.type == "revolute":
            apart = frame[:3, :3] @ np.array(drawn_joint["anchor"]) + frame[:3, 3] - np.array(joint.anchor)
            assert np.linalg.norm(np.cross(axis, apart)) < 5e-5, name
        else:
            assert np.dot(axis, joint.axis) > 0.0, name


@pytest.mark.slow
def test_rams_are_as_they_are_drawn(built: Built) -> None:
    for slide, drawn_cylinder in built.truth["cylinders"].items():
        found = next(c for c in built.mechanism.cylinders if c.slide == slide)
        assert found.bore == pytest.approx(drawn_cylinder["bore"])
        assert found.stroke == pytest.approx(drawn_cylinder["stroke"])
        if "extension" in drawn_cylinder:
            assert found.extension == pytest.approx(drawn_cylinder["extension"], abs=1e-6)
        else:
            assert found.closed_length == pytest.approx(drawn_cylinder["closed_length"], abs=1e-6)
    lift = next(c for c in built.mechanism.cylinders if c.slide == "outer_mast2inner_mast_joint")
    # Two rams of 80 mm at 19.1 MPa, and 160 L/min between them.
    assert lift.push_force == pytest.approx(2 * np.pi / 4 * 0.08**2 * 19.1e6, rel=1e-6)
    assert lift.speed == pytest.approx(160e-3 / 60 / (2 * np.pi / 4 * 0.08**2), rel=1e-6)


@pytest.mark.slow
def test_the_rod_steers_as_the_ties_have_it(built: Built) -> None:
    chain = ClosedChain(built.mechanism)
    for end, words in ((0.11, "rod to the left"), (-0.11, "rod to the right")):
        state = chain.solve({"steer_axle2steering_piston_rod_joint": end})
        for angle, side in zip(built.truth["knuckles"][words], "lr", strict=True):
            turned = np.degrees(chain.coordinate(state, f"steer_axle2knuckle_{side}_joint"))
            assert turned == pytest.approx(angle, abs=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("names", ["named", "nameless"])
@pytest.mark.parametrize("kind", ["duplex", "triplex"])
def test_other_masts_are_told_by_what_is_drawn(kind: str, names: str, made_once: MadeOnce, tmp_path: Path) -> None:
    """Every part is right; strokes and chains give the lift that the manual prints for these strokes."""
    folder = drawn(kind, made_once)
    truth = truth_of(folder)
    cad = folder / "forklift.step" if names == "named" else folder / "nameless" / "forklift.step"
    with without_pages(), without_usd(), reading_once(made_once, folder):
        machine = build("forklift", cad, tmp_path / "out")
    assert machine.alignment.choices["mast"] == kind
    for part, (path, right) in zip(machine.alignment.parts, truth["parts"].items(), strict=True):
        assert part.body == right["body"], path
    known = {m.name: m.model for m in machine.measurements}
    lift = {"duplex": 1.5 + 2 * 0.73, "triplex": 2 * (0.73 + 1.27)}[kind]
    assert known["Lift Height"] == pytest.approx(lift, abs=1e-6)
    assert known["Free Lift Height"] == pytest.approx(2 * 0.73, abs=1e-6)
    mobility = machine.mechanism.mobility
    assert mobility is not None and (mobility.computed, mobility.expected) == (9, 9)
