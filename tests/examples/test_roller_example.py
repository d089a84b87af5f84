"""The roller example, a tandem and a soil compactor of one drum: its layout meets what its sheet prints, it is drawn
so, and it builds to a machine that is ready, with and without names, from surfaces and from triangles."""

from __future__ import annotations

import itertools
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

TYPE = "roller"
KINDS = ("tandem", "single")


@pytest.fixture(scope="module")
def layout() -> ModuleType:
    return module(TYPE, "layout")


# ---- the layout --------
def test_values_are_either_published_or_ours(values: ModuleType) -> None:
    assert_sourced(values, 4)
    assert not any(value.published for value in values.SINGLE.values)


@pytest.mark.parametrize("kind", KINDS)
def test_the_layout_meets_what_is_printed(layout: ModuleType, values: ModuleType, kind: str) -> None:
    machine = values.MACHINES[kind]
    known = {value.name: value.value for value in machine.values}
    got = layout.measured(machine)
    assert {machine.turning_radius.name, values.ARTICULATION.name} <= set(got)
    for name, value in got.items():
        assert value == pytest.approx(known[name], abs=1e-6), name


def test_the_steering_keeps_off_its_dead_points(layout: ModuleType) -> None:
    steering = layout.solve_steering()
    assert min(steering.lever(angle) for angle in np.linspace(-layout.LOCK, layout.LOCK, 21)) > 150.0


# ---- the drawing --------
@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_bodies_do_not_meet_as_drawn_bent_and_rolled(
    layout: ModuleType, values: ModuleType, made_once: MadeOnce, kind: str
) -> None:
    """Pins and cylinders are left out where they move."""
    folder = drawn_example(TYPE, made_once, kind)
    parts, leaves = truth_of(folder)["parts"], read_step(folder / f"{TYPE}.step")
    solids, bodies = solids_of(leaves), [parts[leaf.path]["body"] for leaf in leaves]
    frame = np.array(truth_of(folder)["frame"])
    frame[:3, 3] *= 1000.0
    cylinders = ["cylinder" in b or "piston" in b for b in bodies]

    def turned(axis: int, angle: float, height: float) -> np.ndarray:
        """About x or z through a height over the articulation; machine frame."""
        m, c, s = np.eye(4), math.cos(angle), math.sin(angle)
        i, j = (1, 2) if axis == 0 else (0, 1)
        m[i, i], m[i, j], m[j, i], m[j, j] = c, -s, s, c
        at = np.array([0.0, 0.0, height])
        m[:3, 3] = at - m[:3, :3] @ at
        return m

    roll = math.radians(values.OSCILLATION.value)
    for steer, rolled in ((0.0, 0.0), (layout.LOCK, 0.0), (-layout.LOCK, 0.0), (0.0, roll), (0.0, -roll)):
        bend, tilt = turned(2, steer, 0.0), turned(0, rolled, layout.ROLL_Z)
        of = {"hitch": bend, "front_frame": bend @ tilt, "front_drum": bend @ tilt}
        moves = [np.linalg.inv(frame) @ of.get(body, np.eye(4)) @ frame for body in bodies]
        still = steer == 0.0 and rolled == 0.0
        met = [
            (leaves[i].path, leaves[j].path)
            for (i, j), gap in gaps(solids, moves, 0.01).items()
            if bodies[i] != bodies[j] and gap == 0.0 and (still or not (cylinders[i] or cylinders[j]))
            and not any("PINS" in leaves[k].path or (rolled and "ROLL BEARING" in leaves[k].path) for k in (i, j))
        ]  # fmt: skip
        assert met == [], (steer, rolled)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_the_drawing_has_the_sheet_s_values(made_once: MadeOnce, kind: str) -> None:
    assert_drawn_to(truth_of(drawn_example(TYPE, made_once, kind)), 7)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_every_value_is_read_off_the_sheet(values: ModuleType, made_once: MadeOnce, kind: str) -> None:
    m = values.MACHINES[kind]
    names = {
        "Overall Length": m.length, "Overall Width": m.width, "Overall Height": m.height, "Wheelbase": m.wheelbase,
        "Turning Radius": m.turning_radius, "Inner Turning Radius": m.inner_radius, "Ground Clearance": m.ground,
        "Curb Clearance": values.CURB_CLEARANCE, "Drum Width": m.own(values.DRUM_WIDTH),
        "Drum Diameter": m.own(values.DRUM_DIAMETER), "Steering Cylinder Bore": values.STEER_BORE,
        "Steering Cylinder Rod Diameter": values.STEER_ROD, "Steering Cylinder Stroke": values.STEER_STROKE,
    }  # fmt: skip
    known = assert_read(TYPE, drawn_example(TYPE, made_once, kind) / "specifications.pdf", names, rel=1e-4)
    for name, value in (("Articulation Angle", values.ARTICULATION), ("Oscillation Angle", values.OSCILLATION)):
        assert known[name].value == pytest.approx(math.radians(value.value)), name
    assert known["Steering Relief Pressure"].value == pytest.approx(1e6 * values.PRESSURE.value)
    assert known["Operating Weight"].value == m.weight.value


# ---- the machine --------
@pytest.fixture(scope="module", params=itertools.product(KINDS, (True, False)), ids=lambda p: f"{p[0]}-{p[1]}")
def built(request: pytest.FixtureRequest, made_once: MadeOnce) -> Built:
    kind, named = request.param
    return build_example(TYPE, drawn_example(TYPE, made_once, kind), made_once, named=named)


@pytest.mark.slow
def test_it_is_ready(built: Built) -> None:
    single = "rear_wheel_l_joint" in built.truth["joints"]
    assert_ready(built, 5 if single else 4, {"steering", "drive"})
    drums = "single" if single else "tandem"
    assert built.machine.alignment.choices == {
        "drums": drums, "steered_by": "articulation", "steering_cylinders": "twin",
    }  # fmt: skip


@pytest.mark.slow
def test_every_value_is_measured(built: Built) -> None:
    assert_measured(built.machine, 12 if "rear_wheel_l_joint" in built.truth["joints"] else 11)


@pytest.mark.slow
def test_joints_and_cylinders_are_as_they_are_drawn(built: Built) -> None:
    assert_as_drawn(built.machine, built.truth)
    rolling = built.mechanism.joint("hitch2front_frame_joint")
    assert (rolling.lower, rolling.upper) == pytest.approx((-math.radians(10.0), math.radians(10.0)))


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_every_part_is_in_its_body_on_triangles_without_names(kind: str, made_once: MadeOnce) -> None:
    recognised(TYPE, drawn_example(TYPE, made_once, kind), "nameless", "triangles", made_once)
