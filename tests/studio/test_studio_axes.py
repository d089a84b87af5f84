"""What clicks on a machine mean: axes of bores, edges, points and circles."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import CylinderFeature, Mesh, Shape
from yellowiron.studio.axes import FoundAxis, Pick, axis_of, lines_near, read_picks

BOX = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 2.0) for z in (0.0, 3.0)])
FACES = np.array([
    [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
    [1, 5, 7], [1, 7, 3],
])  # fmt: skip
BORE = CylinderFeature((0.5, 0.0, 1.0), (0.0, 1.0, 0.0), 0.04, 0.0, 2.0, 2.0 * math.pi, inner=True)
TURN = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])


def assembly(*places: tuple[str, np.ndarray[Any, Any]]) -> Assembly:
    mesh = Mesh(BOX, FACES)
    shape = Shape("box", "box", mesh, 6.0, 22.0, BOX.mean(axis=0), np.eye(3), cylinders=(BORE,))
    parts = tuple(Part(name, name, (), "box", place) for name, place in places)
    return Assembly("model", "STEP", 1.0, parts, {"box": shape})


def placed(turn: Any = TURN, at: Any = (10.0, 0.0, 0.0), scale: float = 1.0) -> np.ndarray[Any, Any]:
    place = np.eye(4)
    place[:3, :3], place[:3, 3] = scale * np.asarray(turn), at
    return place


def line(found: FoundAxis) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """A point and a unit direction of what an entry says, as the document's reader has them."""
    entry = found.entry
    if "anchor" in entry:
        return np.array(entry["anchor"]), np.array(entry["axis"])
    one, other = (np.array(p) for p in entry["through"][:2])
    return 0.5 * (one + other), (other - one) / np.linalg.norm(other - one)


def test_a_bore_that_is_clicked_is_the_axis() -> None:
    model = assembly(("plate", placed()))
    found = axis_of([Pick("plate", np.array([0.54, 0.3, 1.0]))], model)
    point, direction = line(found)
    assert found.words == "Bore of 80 mm in plate"
    np.testing.assert_allclose(np.abs(direction), [1.0, 0.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(point, [9.0, 0.5, 1.0], atol=1e-9)  # the middle of the bore, turned and moved
    np.testing.assert_allclose(found.point, [0.5, 1.0, 1.0], atol=1e-9)  # in the part's own frame


def test_its_rim_and_a_scaled_part() -> None:
    model = assembly(("plate", placed(scale=0.5)))
    found = axis_of([Pick("plate", np.array([0.5, 2.0, 1.041]))], model)
    assert found.words == "Bore of 40 mm in plate"
    assert np.linalg.norm(found.entry["axis"]) == pytest.approx(1.0)


def test_nothing_is_round_there() -> None:
    with pytest.raises(YellowironError, match="Nothing is round there"):
        axis_of([Pick("plate", np.array([0.0, 1.0, 2.0]))], assembly(("plate", placed())))


def test_two_round_things_give_the_line_through_their_middles() -> None:
    model = assembly(("left", placed(np.eye(3), (0.0, 0.0, 0.0))), ("right", placed(np.eye(3), (3.0, 0.0, 0.0))))
    on_rim = np.array([0.54, 1.0, 1.0])
    found = axis_of([Pick("left", on_rim), Pick("right", on_rim)], model)
    point, direction = line(found)
    np.testing.assert_allclose(point, [2.0, 1.0, 1.0], atol=1e-9)
    np.testing.assert_allclose(direction, [1.0, 0.0, 0.0], atol=1e-9)


def test_two_points_and_one_point_twice() -> None:
    model = assembly(("plate", placed(np.eye(3), (0.0, 0.0, 0.0))))
    one, other = np.array([0.0, 0.0, 0.0]), np.array([0.0, 0.0, 3.0])
    np.testing.assert_allclose(line(axis_of([Pick("plate", one), Pick("plate", other)], model))[1], [0.0, 0.0, 1.0])
    with pytest.raises(YellowironError, match="one, or on one line"):
        axis_of([Pick("plate", one), Pick("plate", one)], model)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.floats(0.0, 2.0 * math.pi), min_size=3, max_size=3), st.floats(0.05, 2.0))
def test_three_points_of_a_circle(angles: list[float], radius: float) -> None:
    points = [np.array([radius * math.cos(a), 0.7, radius * math.sin(a)]) for a in angles]
    apart = min(np.linalg.norm(points[i] - points[j]) for i, j in ((0, 1), (0, 2), (1, 2)))
    if apart < 0.05 * radius:
        return
    model = assembly(("plate", placed(np.eye(3), (0.0, 0.0, 0.0))))
    found = axis_of([Pick("plate", p) for p in points], model)
    np.testing.assert_allclose(found.point, [0.0, 0.7, 0.0], atol=1e-5 * radius)
    assert abs(found.direction[1]) == pytest.approx(1.0, abs=1e-9)


def test_an_edge() -> None:
    model = assembly(("plate", placed(np.eye(3), (0.0, 0.0, 0.0))))
    found = axis_of([Pick("plate", np.array([0.0, 0.02, 1.4]), edge=True)], model)
    point, direction = line(found)
    np.testing.assert_allclose(np.abs(direction), [0.0, 0.0, 1.0], atol=1e-9)
    np.testing.assert_allclose(point[:2], [0.0, 0.0], atol=1e-9)
    # The diagonal of a face is no edge.
    diagonal = axis_of([Pick("plate", np.array([0.5, 0.0, 1.5]), edge=True)], model)
    assert max(np.abs(diagonal.direction)) == pytest.approx(1.0)


def test_round_things_about_one_line_are_one() -> None:
    model = assembly(("left", placed(np.eye(3), (0.0, 0.0, 0.0))), ("right", placed(np.eye(3), (0.0, 2.5, 0.001))),
                     ("away", placed(np.eye(3), (0.0, 0.0, 0.5))))  # fmt: skip
    lines = lines_near(model.parts, model)
    assert sorted(sorted(one.radii) for one in lines) == [["away"], ["left", "right"]]
    assert lines_near(model.parts, model, direction=np.array([1.0, 0.0, 0.0])) == []


@pytest.mark.parametrize("entry", [
    None, {}, {"picks": []}, {"picks": [1]}, {"picks": [{"part": "plate"}]},
    {"picks": [{"part": "x", "point": [0, 0, 0]}]},
    {"picks": [{"part": "plate", "point": [0, 0, float("nan")]}]}, {"picks": [{"part": "plate", "point": ["a", 0, 0]}]},
    {"picks": [{"part": "plate", "point": [0, 0, 0]}] * 4}, {"picks": [{"part": ["plate"], "point": [0, 0, 0]}]},
])  # fmt: skip
def test_what_are_no_clicks(entry: object) -> None:
    with pytest.raises(YellowironError):
        read_picks(entry, assembly(("plate", placed())))
