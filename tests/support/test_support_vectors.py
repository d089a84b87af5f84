"""Vectors: tuples, angles and distances by their definitions."""

from __future__ import annotations

import math

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from yellowiron.support.vectors import (
    Wound,
    angle_between,
    angle_between_lines,
    clean_triple,
    distance_from_line,
    triple,
    unit,
    winding,
)

ANGLES = st.floats(0.0, math.pi)
NUMBERS = st.floats(-1e3, 1e3)


def turned(angle: float) -> np.ndarray:
    return np.array([math.cos(angle), 0.6 * math.sin(angle), 0.8 * math.sin(angle)])


@given(ANGLES, st.floats(1e-3, 1e3))
def test_angles(angle: float, length: float) -> None:
    """As exact where the angle is tiny as elsewhere: an arc cosine would be out by 1e-8."""
    assert angle_between((1.0, 0.0, 0.0), length * turned(angle)) == pytest.approx(angle, abs=1e-12)
    assert angle_between_lines(turned(angle), (length, 0.0, 0.0)) == pytest.approx(
        min(angle, math.pi - angle), abs=1e-12
    )


@given(ANGLES, NUMBERS, st.floats(0.0, 1e3))
def test_distance_from_a_line(angle: float, along: float, away: float) -> None:
    direction = turned(angle)
    across = np.array([0.0, 0.8, -0.6])
    origin = np.array([3.0, -2.0, 5.0])
    point = origin + along * direction + away * across
    assert distance_from_line(point, origin, direction) == pytest.approx(away, abs=1e-9)


@given(st.tuples(NUMBERS, NUMBERS, NUMBERS).filter(lambda v: max(map(abs, v)) > 1e-6))
def test_units_are_one_long(values: tuple[float, float, float]) -> None:
    one = unit(np.array(values))
    assert np.linalg.norm(one) == pytest.approx(1.0, abs=1e-12)
    assert np.linalg.norm(np.cross(one, values)) <= 1e-9 * np.linalg.norm(values)


def test_triples_are_plain_floats() -> None:
    found = triple(np.array([1, -0.0, 2.5], dtype=np.float32))
    assert found == (1.0, 0.0, 2.5) and all(type(v) is float for v in found)
    assert math.copysign(1.0, triple((0.0, -0.0, 1.0))[1]) == -1.0
    assert math.copysign(1.0, clean_triple((0.0, -0.0, 1.0))[1]) == 1.0
    with pytest.raises(ValueError, match="unpack"):
        triple((1.0, 2.0))


@pytest.mark.parametrize("closed", [True, False])
def test_patches_are_wound_as_their_triangles_are(closed: bool) -> None:
    ball = trimesh.creation.icosphere(5)
    triangles = np.asarray(ball.triangles)[: None if closed else 15000] * (1.0, 2.0, 0.3)
    points = np.random.default_rng(3).uniform(-2.2, 2.2, (60, 3)) * (0.5, 1.0, 0.2)
    points[0] = triangles[0].mean(axis=0) * 0.999
    exact = winding(points, triangles)
    assert Wound.of(triangles).around(points) == pytest.approx(exact, abs=0.02)
    assert np.abs(exact).max() > 0.9
    assert Wound.of(triangles[:5]).around(points) == pytest.approx(winding(points, triangles[:5]), abs=0.02)
    assert Wound.of(triangles[:0]).around(points) == pytest.approx(np.zeros(60))
