"""Convex solids: against a collision library's boxes and against trimesh; what is merged stays near what it was."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from yellowiron.support.convex.solids import (
    CORNERS,
    OBLONG,
    THINNEST,
    Convex,
    convex,
    interpenetrate,
    merged,
    uncovered,
    with_few_corners,
)

CUBE = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])


def block(low: tuple[float, float, float], high: tuple[float, float, float]) -> Convex:
    return convex((CUBE + 0.5) * (np.array(high) - low) + low)


def test_boxes_against_fcl() -> None:
    fcl = pytest.importorskip("fcl")
    generator = np.random.default_rng(3)
    hits = 0
    for number in range(150):
        centers, halves = generator.uniform(-1.0, 1.0, (2, 3)), generator.uniform(0.05, 0.8, (2, 3))
        turns = Rotation.random(2, rng=generator).as_matrix() if number >= 20 else np.stack([np.eye(3)] * 2)
        one, other = (convex(2.0 * CUBE * halves[k] @ turns[k].T + centers[k]) for k in (0, 1))
        objects = [
            fcl.CollisionObject(fcl.Box(*(2.0 * halves[k])), fcl.Transform(np.ascontiguousarray(turns[k]), centers[k]))
            for k in (0, 1)
        ]
        expected = fcl.collide(*objects, fcl.CollisionRequest(), fcl.CollisionResult()) > 0
        assert interpenetrate(one, other, 0.0) == expected
        hits += expected
    assert 0.2 < hits / 150 < 0.9


@given(
    st.tuples(st.floats(0.5, 6.0), st.floats(0.05, 1.0), st.floats(1e-4, 0.05)),
    st.permutations(range(3)),
    st.booleans(),
)
@settings(max_examples=60, deadline=None)
def test_no_hull_is_too_thin_or_too_oblong_to_be_cooked(
    edges: tuple[float, float, float], order: list[int], turned: bool
) -> None:
    """Rails and plates along the axes are what PhysX measures as oblong; what lies across them it measures shorter."""
    drawn = CUBE * np.array(edges)[order]
    if turned:
        drawn = drawn @ Rotation.from_euler("xyz", [0.1, 0.2, 0.7]).as_matrix().T
    made = convex(drawn)
    mesh = trimesh.Trimesh(made.corners, made.triangles, process=False)
    breadths = np.ptp(made.corners @ made.planes[:, :3].T, axis=0)
    assert breadths.min() > THINNEST - 1e-9
    radius = -made.beyond(mesh.center_mass[None])[0]
    axis = int(np.argmax(made.high - made.low))
    box = CUBE * np.where(np.arange(3) == axis, 200.0 * radius, 2.0 * radius / np.sqrt(3.0))
    assert made.beyond(box + mesh.center_mass).max() > 0.0
    # No more than that takes.
    more = np.ptp(made.corners, axis=0) - np.ptp(drawn, axis=0)
    assert more.max() < max(THINNEST, 2.0 * np.ptp(drawn, axis=0).max() / OBLONG)


@given(
    st.integers(0, 10_000),
    st.integers(1, 12),
    st.integers(0, 2),
    st.sampled_from((0.01, 0.2, 5.0)),
    st.sampled_from((0.0, 1e-12, 6e-12, 1e-9, 1e-7, 1e-5)),
)
@example(9, 9, 1, 0.01, 1e-12)
@settings(max_examples=150, deadline=None)
def test_what_is_flat_a_line_or_a_point_gets_a_hull(
    seed: int, count: int, dimensions: int, size: float, rough: float
) -> None:
    """Pieces of a decomposition may be points in one plane, or nearly: `rough` metres off it, as rounding leaves
    them."""
    generator = np.random.default_rng(seed)
    drawn = size * generator.uniform(-1.0, 1.0, (count, 3)) * (np.arange(3) < dimensions)
    drawn += rough * generator.uniform(-1.0, 1.0, (count, 3))
    points = drawn @ Rotation.random(rng=generator).as_matrix().T + generator.uniform(-2.0, 2.0, 3)
    made = convex(points)
    assert np.isfinite(made.corners).all()
    assert np.isfinite(made.planes).all()
    assert made.volume > 0.0
    assert made.beyond(points).max() < 1e-8 * max(1.0, size) + 4.0 * rough
    assert np.ptp(made.corners @ made.planes[:, :3].T, axis=0).min() > THINNEST - 1e-8 * max(1.0, size)
    few = with_few_corners(made, 8)
    assert np.isfinite(few.corners).all()


def test_a_slanted_strip_whose_plane_is_rounded_has_a_rim() -> None:
    """Two parallelograms in one plane, 6e-12 m out of it: their hull has two sides and no face along its longest
    edge."""
    run, across = np.array([0.011, 0.0, 0.005]), np.array([0.0, 0.155, 0.0])
    corners = np.array(
        [i * run + j * across + k * 0.035 / 0.155 * across for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    )
    corners[::3] += 6e-12 * np.array([-0.43, 0.0, 0.9])
    made = convex(corners + np.array([0.9145786, -0.2466, 0.937433]))
    assert np.isfinite(made.corners).all()
    assert np.ptp(made.corners, axis=0).max() < 0.2


@given(st.integers(0, 10_000), st.integers(8, 200))
@settings(max_examples=40, deadline=None)
def test_a_hull_is_what_it_is_of(seed: int, count: int) -> None:
    points = np.random.default_rng(seed).normal(size=(count, 3))
    made = convex(points)
    mesh = trimesh.Trimesh(made.corners, made.triangles, process=False)
    assert mesh.is_watertight
    assert made.volume == pytest.approx(mesh.volume, rel=1e-9)
    assert made.volume == pytest.approx(trimesh.convex.convex_hull(points).volume, rel=1e-6)
    assert made.beyond(points).max() < 1e-8
    shift = np.array([1.0, -2.0, 3.0])
    moved = made.shifted(shift)
    assert moved.beyond(points + shift) == pytest.approx(made.beyond(points), abs=1e-8)


@pytest.mark.slow
@given(st.integers(0, 10_000))
@settings(max_examples=20, deadline=None)
def test_few_corners_are_enough(seed: int) -> None:
    points = np.random.default_rng(seed).normal(size=(3000, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    made = with_few_corners(convex(points))
    assert len(made.corners) <= CORNERS
    assert made.beyond(points).max() < 0.12  # of a ball, the worst there is
    assert convex(points).beyond(made.corners).max() < 1e-8
    assert made.volume > 0.85 * 4.0 / 3.0 * np.pi


def test_what_is_flat_gets_a_thickness() -> None:
    flat = 0.4 * np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)])
    above = flat + np.array([0.0, 0.0, 0.002])
    for points in (flat, np.concatenate([flat, above])):
        assert np.ptp(convex(points).corners[:, 2]) == pytest.approx(THINNEST)


def test_points_are_covered_by_several_together() -> None:
    halves = [block((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), block((1.0, 0.0, 0.0), (2.0, 1.0, 1.0))]
    points = np.array([(0.5, 0.5, 0.5), (1.5, 0.5, 0.5), (2.05, 0.5, 0.5), (3.0, 0.5, 0.5)])
    assert uncovered(points, halves, 0.0).tolist() == [False, False, True, True]
    assert uncovered(points, halves, 0.1).tolist() == [False, False, False, True]


def test_what_lies_in_a_row_becomes_one_and_a_trough_stays_hollow() -> None:
    row = [block((k * 0.5, 0.0, 0.0), (k * 0.5 + 0.49, 0.3, 0.2)) for k in range(4)]
    assert len(merged(row, 0.02)) == 1
    trough = [
        block((0.0, 0.0, 0.0), (1.0, 1.0, 0.02)),
        block((0.0, 0.0, 0.0), (0.02, 1.0, 0.6)),
        block((0.98, 0.0, 0.0), (1.0, 1.0, 0.6)),
    ]
    made = merged(trough, 0.05)
    assert len(made) == 3
    assert uncovered(np.array([(0.5, 0.5, 0.3)]), [solid for solid, _ in made], 0.05).all()


@given(st.integers(0, 10_000), st.floats(0.01, 0.1))
@settings(max_examples=25, deadline=None)
def test_merging_keeps_all_and_adds_little(seed: int, within: float) -> None:
    generator = np.random.default_rng(seed)
    low = generator.uniform(0.0, 1.0, (8, 3))
    blocks = [block(tuple(a), tuple(a + generator.uniform(0.05, 0.4, 3))) for a in low]
    made = merged(blocks, within)
    assert sorted(i for _, members in made for i in members) == list(range(8))
    for one in blocks:
        assert not uncovered(one.corners, [solid for solid, _ in made], 1e-8).any()
    for solid, members in made:
        if len(members) == 2:
            # Two merged: no point of the hull is farther from them than was said, but between the points looked at.
            away = np.min([blocks[i].beyond(solid.surface(0.02)) for i in members], axis=0)
            assert away.max() <= 1.5 * within
