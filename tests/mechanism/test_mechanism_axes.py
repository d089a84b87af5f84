"""Lines through coaxial cylinders: exact for exact ones, whatever the pose; steady for noisy ones."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import cast

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from yellowiron.mechanism.joints.axes import coaxial_groups, fit_axis, machine_sense, on_axis, symmetry_axis
from yellowiron.mechanism.joints.bearings import pin_bearing, slide_bearing
from yellowiron.mechanism.placement import Features, Placement

coordinate = st.floats(-5.0, 5.0)
vectors = st.tuples(coordinate, coordinate, coordinate)
directions = vectors.filter(lambda v: math.hypot(*v) > 0.1)


def features(center: np.ndarray, direction: np.ndarray, length: np.ndarray, *, exact: bool = True) -> Features:
    n = len(length)
    return Features(
        center=center,
        direction=direction / np.linalg.norm(direction, axis=1)[:, None],
        radius=np.full(n, 0.04),
        length=length,
        area=length * 0.25,
        inner=np.zeros(n, dtype=bool),
        exact=np.full(n, exact),
        part=np.arange(n),
    )


@settings(deadline=None)
@given(
    point=vectors,
    direction=directions,
    places=st.lists(st.tuples(st.floats(-2, 2), st.floats(0.01, 0.5), st.booleans()), min_size=1, max_size=6),
)
def test_exact_segments_of_one_axis_give_it(
    point: tuple[float, float, float],
    direction: tuple[float, float, float],
    places: list[tuple[float, float, bool]],
) -> None:
    axis = np.array(direction) / np.linalg.norm(direction)
    at = np.array([p for p, _, _ in places])
    length = np.array([ln for _, ln, _ in places])
    sense = np.array([1.0 if s else -1.0 for _, _, s in places])
    line = fit_axis(np.array(point) + at[:, None] * axis, sense[:, None] * axis, length, length)
    assert np.linalg.norm(np.cross(line.direction, axis)) < 1e-9
    assert line.distance(np.array([point]))[0] < 1e-9


def test_two_halves_of_a_pin_steady_each_other() -> None:
    """Fitted halves that lean a twentieth of a degree, a metre apart: the common axis leans a tenth of that."""
    lean = math.radians(0.05)
    center = np.array([[0.0, -0.5, 0.0], [0.0, 0.5, 0.0]])
    direction = np.array([[lean, 1.0, 0.0], [lean, 1.0, 0.0]])
    line = fit_axis(center, direction, np.array([0.1, 0.1]), np.array([1.0, 1.0]))
    assert math.asin(np.linalg.norm(np.cross(line.direction, [0, 1, 0]))) < 0.1 * lean


def test_groups_part_axes_that_differ_and_keep_those_that_do_not() -> None:
    center = np.array([[0, 0, 0], [0, 1, 0], [0.002, 0, 0], [0, 0, 0]], dtype=float)
    direction = np.array([[0, 1, 0], [0, -1, 0], [0, 1, 0], [1, 0, 0]], dtype=float)
    groups = coaxial_groups(features(center, direction, np.array([0.4, 0.3, 0.2, 0.1])))
    assert [sorted(g.tolist()) for g in groups] == [[0, 1], [2], [3]]


def test_a_fitted_feature_may_miss_by_more_the_farther_it_is() -> None:
    table = features(np.array([[0.0008, 1.0, 0.0]]), np.array([[0.0, 1.0, 0.0]]), np.array([0.1]))
    line = fit_axis(np.zeros((1, 3)), np.array([[0.0, 1.0, 0.0]]), np.array([0.2]), np.array([1.0]))
    assert not on_axis(table, line).any()
    loose = features(table.center, table.direction, table.length, exact=False)
    assert on_axis(loose, line).all()


@pytest.mark.parametrize(
    ("given", "wanted"),
    [
        ((0, -1, 0), (0, 1, 0)),
        ((0.1, 0, -1), (-0.1, 0, 1)),
        ((-1, 0.2, 0), (1, -0.2, 0)),
        ((1, -1, 0), (-1, 1, 0)),
        ((1e-15, 1, 0), (0, 1, 0)),
    ],
)
def test_axes_point_the_way_of_the_machine(given: tuple[float, ...], wanted: tuple[float, ...]) -> None:
    expected = np.array(wanted) / np.linalg.norm(wanted)
    assert machine_sense(np.array(given) / np.linalg.norm(given)) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("height", [0.05, 3.0])
def test_a_round_part_without_features_still_has_an_axis(height: float) -> None:
    angle = np.linspace(0, 2 * math.pi, 36, endpoint=False)
    ring = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    rise = np.array([0, 0, height / 2])
    points = np.concatenate([ring - rise, ring + rise])[:, [0, 2, 1]]
    assert abs(symmetry_axis(points + 3.0).direction[1]) == pytest.approx(1.0)


def test_a_pin_turns_on_its_shaft_and_not_on_the_bolts_of_its_flange() -> None:
    """The holes of a flange's bolts are in line with holes of both bodies, and still no hinge."""
    along = np.tile([0.0, 1.0, 0.0], (2, 1))
    rows = {
        "pin": features(np.array([[0, 0, 0], [0.1, 0.4, 0]]), along, np.array([1.0, 0.05])),
        "bodies": features(np.array([[0.1, 0.4, 0], [0.1, 0.45, 0]]), along, np.array([0.05, 0.05])),
    }

    class Drawn:
        bodies = ("a", "b", "a")

        def features(self, which: Iterable[int]) -> Features:
            return rows["pin"] if list(which) == [2] else rows["bodies"]

        def rows_of_body(self, body: str) -> tuple[int, ...]:
            return {"a": (0,), "b": (1,)}[body]

    bearing = pin_bearing(cast(Placement, Drawn()), [2], ("a", "b"))
    assert bearing is not None
    assert bearing.line.distance(np.zeros((1, 3)))[0] == pytest.approx(0.0, abs=1e-9)


def test_a_slide_without_a_bore_is_in_its_own_cylinder() -> None:
    """Twin cylinders on common pins: the pivots' points are in the middle of the machine, the cylinders are not."""
    box = np.array([[0.0, 0.4, 0.0], [1.0, 0.5, 0.1], [0.5, 0.4, 0.1]])

    class Boxes:
        def features(self, rows: tuple[int, ...] = ()) -> Features:
            return features(np.zeros((1, 3)), np.ones((1, 3)), np.ones(1)).take(np.zeros(1, dtype=bool))

        def points_of(self, rows: tuple[int, ...]) -> np.ndarray:
            return box[: len(rows) * 2]

    ends, across = (np.zeros(3), np.array([2.0, 0.1, 0.0])), np.array([0.0, 1.0, 0.0])
    found = slide_bearing(cast(Placement, Boxes()), ((0,), (1,)), ends, across)
    assert found is not None
    assert found.line.distance(np.array([[1.0, 0.45, 0.0]])) == pytest.approx(0.0, abs=1e-12)
    assert abs(found.line.direction @ across) < 1e-12
