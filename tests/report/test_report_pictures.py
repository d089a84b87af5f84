"""Pictures: the same bytes every time, things where they should be."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from hypothesis import example, given, settings
from hypothesis import strategies as st
from PIL import Image

from yellowiron.report.html.pictures import DrawnTriangles, encode, look_at, posed, render
from yellowiron.report.html.rays import blocked, first, piece_of


def triangles_of(*meshes: trimesh.Trimesh, colors: list[tuple[float, float, float]]) -> DrawnTriangles:
    points = np.concatenate([m.vertices for m in meshes]).astype(np.float32)
    before = np.cumsum([0, *(len(m.vertices) for m in meshes)])
    faces = np.concatenate([m.faces + n for m, n in zip(meshes, before, strict=False)]).astype(np.int32)
    normals = np.concatenate([np.repeat(m.face_normals[:, None], 3, axis=1) for m in meshes]).astype(np.float32)
    counts = [len(m.faces) for m in meshes]
    painted = np.repeat(np.array(colors, dtype=np.float32), counts, axis=0)
    return DrawnTriangles(points, faces, normals, painted, np.repeat(np.arange(len(meshes), dtype=np.int32), counts))


@pytest.fixture(scope="module")
def two_boxes() -> DrawnTriangles:
    left = trimesh.creation.box((1, 1, 1), transform=trimesh.transformations.translation_matrix((0, 1, 0.5)))
    right = trimesh.creation.box((1, 1, 1), transform=trimesh.transformations.translation_matrix((0, -1, 0.5)))
    return triangles_of(left, right, colors=[(1.0, 0.0, 0.0), (0.0, 0.0, 1.0)])


def test_a_box_is_where_the_camera_projects_it(two_boxes: DrawnTriangles) -> None:
    """Seen from the front (+X), the machine's left (+Y) is on the right of the picture."""
    camera = look_at(two_boxes.points, azimuth=0.0, elevation=0.2, width=320, height=180)
    pixels = np.asarray(render(two_boxes, camera)).astype(int)
    for center, channel in (((0.5, 1.0, 0.5), 0), ((0.5, -1.0, 0.5), 2)):
        x, y = camera.project(np.array([center]))[0]
        red, _, blue = pixels[round(y), round(x)]
        assert (red > blue + 60) if channel == 0 else (blue > red + 60)
    assert camera.project(np.array([[0.5, 1.0, 0.5]]))[0, 0] > 160


def test_the_same_scene_gives_the_same_bytes(two_boxes: DrawnTriangles) -> None:
    camera = look_at(two_boxes.points, width=160, height=90)
    assert encode(render(two_boxes, camera)) == encode(render(two_boxes, camera))


@settings(max_examples=50, deadline=None)
@example(1.0, 1.25, [(0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (1.0, 2.0, 0.0), (2.0, 0.0, 1.0)])
@given(
    st.floats(-math.pi, math.pi),
    st.floats(0.0, 1.3),
    st.lists(st.tuples(*[st.floats(-20, 20)] * 3), min_size=4, max_size=40),
)
def test_every_point_is_in_the_frame(
    azimuth: float, elevation: float, points: list[tuple[float, float, float]]
) -> None:
    cloud = np.array(points)
    # A flat or single-point cloud has no size to fit.
    if np.ptp(cloud, axis=0).min() < 0.1:
        return
    camera = look_at(cloud, azimuth=azimuth, elevation=elevation, width=400, height=300)
    pixels = camera.project(cloud)
    assert (pixels >= -1.0).all() and (pixels <= [401.0, 301.0]).all()


def test_what_is_drawn_finer_at_edges_alone_is_as_fine_as_a_picture_twice_the_size(two_boxes: DrawnTriangles) -> None:
    corners = two_boxes.points.astype(np.float64)
    camera = look_at(corners, width=320, height=200)
    twice = replace(camera, width=640, height=400, scale=2.0 * camera.scale)
    ours = np.asarray(render(two_boxes, camera), dtype=int)
    whole = render(two_boxes, twice, supersample=1).resize((320, 200), Image.Resampling.BOX)
    apart = np.abs(ours - np.asarray(whole, dtype=int)).max(axis=2)
    assert apart.mean() < 0.3 and (apart > 24).mean() < 2e-3


def in_spans(drawn: DrawnTriangles) -> DrawnTriangles:
    """Each of the two boxes is a body."""
    middle = len(drawn.triangles) // 2
    return replace(drawn, spans={"left": (0, middle), "right": (middle, 2 * middle)})


def test_a_machine_in_a_pose_is_drawn_as_if_it_were_built_there(two_boxes: DrawnTriangles) -> None:
    turn = trimesh.transformations.euler_matrix(0.3, -0.2, 0.5)
    turn[:3, 3] = (0.4, -0.7, 1.1)
    moved = posed(in_spans(two_boxes), {"left": turn})
    assert len(moved.pieces) == 2
    camera = look_at(moved.points.astype(np.float64), width=320, height=200)
    pieces, whole = (np.asarray(render(one, camera), dtype=int) for one in (moved, replace(moved, placed=())))
    apart = np.abs(pieces - whole).max(axis=2)
    assert (whole != whole[0, 0]).any()
    # Rounding may show at an edge.
    assert (apart > 8).mean() < 1e-3


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_pieces_are_met_wherever_they_are(seed: int) -> None:
    """What is left out because it does not come near a piece would not have met it."""
    random = np.random.default_rng(seed)
    points = random.normal(size=(60, 3)).astype(np.float32)
    triangles = np.arange(60, dtype=np.int32).reshape(20, 3)
    place = trimesh.transformations.random_rotation_matrix(random.random(3))
    place[:3, 3] = random.normal(size=3)
    numbers = [np.arange(8, dtype=np.int32), np.arange(8, 20, dtype=np.int32)]
    pieces = [piece_of(points, triangles, own).at(place) for own in numbers]
    there = (points @ place[:3, :3].T + place[:3, 3]).astype(np.float32)
    eye = random.normal(size=3) * random.choice([0.5, 4.0])
    ways = random.normal(size=(3, 500)).astype(np.float32)
    ways /= np.linalg.norm(ways, axis=0)
    ours, theirs = first(pieces, eye, ways), first([piece_of(there, triangles)], eye, ways)
    assert (ours.triangle != theirs.triangle).mean() < 0.01
    both = (ours.triangle == theirs.triangle) & (ours.triangle >= 0)
    assert np.allclose(ours.distance[both], theirs.distance[both], rtol=1e-3)
    starts = random.normal(size=(3, 500)).astype(np.float32)
    dark, meant = (blocked(one, starts, ways[:, 0]) for one in (pieces, [piece_of(there, triangles)]))
    assert (dark != meant).mean() < 0.01
