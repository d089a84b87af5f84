"""Convex pieces: plates exactly, hollow things hollow, small things simply."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

import small_machine
from yellowiron.export.convex import convex_pieces, hull
from yellowiron.model.geometry import Mesh


def as_mesh(mesh: trimesh.Trimesh) -> Mesh:
    return Mesh(np.array(mesh.vertices, dtype=np.float64), np.array(mesh.faces, dtype=np.int32))


def volume(pieces: tuple[Mesh, ...]) -> float:
    return sum(trimesh.Trimesh(p.points, p.triangles).volume for p in pieces)


def inside(pieces: tuple[Mesh, ...], point: tuple[float, float, float]) -> bool:
    def holds(piece: Mesh) -> bool:
        made = trimesh.Trimesh(piece.points, piece.triangles, process=False)
        depth = np.einsum("ij,ij->i", np.asarray(point) - made.triangles_center, made.face_normals)
        return bool(np.all(depth < 1e-9))

    return any(holds(piece) for piece in pieces)


def test_a_hull_faces_outwards() -> None:
    made = hull(np.random.default_rng(1).normal(size=(40, 3)))
    body = trimesh.Trimesh(made.points, made.triangles, process=False)
    assert body.is_watertight and body.volume > 0.0


def test_a_flat_cloud_gets_a_thickness() -> None:
    flat = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)])
    made = hull(flat)
    assert trimesh.Trimesh(made.points, made.triangles).volume == pytest.approx(0.002, rel=1e-6)


def test_an_open_box_stays_hollow() -> None:
    pieces = convex_pieces(as_mesh(small_machine.open_box(0.9, 1.2, 0.4, 0.02)))
    assert len(pieces) == 3
    assert not inside(pieces, (0.0, 0.0, 0.1))
    assert inside(pieces, (0.0, 0.0, -0.19))


def test_a_tube_stays_hollow() -> None:
    tube = trimesh.creation.annulus(0.2, 0.25, 1.0, sections=48)
    pieces = convex_pieces(as_mesh(tube))
    assert not inside(pieces, (0.0, 0.0, 0.0))
    assert volume(pieces) == pytest.approx(tube.volume, rel=0.04)


def test_a_plate_with_a_bore_keeps_it() -> None:
    plate = trimesh.creation.annulus(0.3, 0.5, 0.05, sections=32)
    assert not inside(convex_pieces(as_mesh(plate)), (0.0, 0.0, 0.0))


def test_a_closed_shell_that_is_no_profile_stays_hollow() -> None:
    outer, inner = trimesh.creation.icosphere(2, 0.5), trimesh.creation.icosphere(2, 0.48)
    inner.invert()
    pieces = convex_pieces(as_mesh(trimesh.util.concatenate([outer, inner])))
    assert not inside(pieces, (0.0, 0.0, 0.0))
    assert inside(pieces, (0.495, 0.0, 0.0)) or inside(pieces, (0.0, 0.0, 0.49))


def test_small_and_full_parts_are_their_hull() -> None:
    assert len(convex_pieces(as_mesh(trimesh.creation.annulus(0.01, 0.03, 0.02)))) == 1
    assert len(convex_pieces(as_mesh(trimesh.creation.icosphere(2, 0.5)))) == 1


@settings(max_examples=25, deadline=None)
@given(
    size=st.tuples(*[st.floats(0.3, 2.0)] * 3),
    wall=st.floats(0.01, 0.05),
    angle=st.floats(0.0, 6.28),
    axis=st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda a: np.linalg.norm(a) > 0.1),
)
def test_boxes_of_any_size_and_pose_stay_hollow(
    size: tuple[float, float, float], wall: float, angle: float, axis: tuple[float, float, float]
) -> None:
    box = small_machine.open_box(*size, wall)
    box.apply_transform(trimesh.transformations.rotation_matrix(angle, axis))
    pieces = convex_pieces(as_mesh(box))
    assert not inside(pieces, (0.0, 0.0, 0.0))
    assert volume(pieces) == pytest.approx(box.volume, rel=0.05)


def test_the_same_pieces_every_time() -> None:
    tube = as_mesh(trimesh.creation.annulus(0.2, 0.25, 1.0, sections=48))
    first, second = convex_pieces(tube), convex_pieces(tube)
    assert [p.points.tobytes() for p in first] == [p.points.tobytes() for p in second]
