"""Convex pieces: plates exactly, hollow things hollow, small things simply."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from kit.machines import small_machine
from yellowiron.model.geometry import Mesh
from yellowiron.support.caching.disk import VARIABLE, cache_folder
from yellowiron.support.convex import pieces as cutting
from yellowiron.support.convex.pieces import MOST, convex_pieces, hull


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


@pytest.mark.slow
def test_a_fine_curved_shell_gets_few_pieces_and_stays_hollow() -> None:
    outer, inner = trimesh.creation.icosphere(4, 0.5), trimesh.creation.icosphere(4, 0.48)
    inner.invert()
    pieces = convex_pieces(as_mesh(trimesh.util.concatenate([outer, inner])))
    assert 10 < len(pieces) <= MOST
    assert not inside(pieces, (0.0, 0.0, 0.0)) and not inside(pieces, (0.2, 0.2, 0.2))


def test_a_finely_meshed_plate_gets_few_pieces() -> None:
    tube = trimesh.creation.annulus(0.4, 0.5, 1.0, sections=64).subdivide().subdivide()
    pieces = convex_pieces(as_mesh(tube))
    assert len(pieces) <= MOST and not inside(pieces, (0.0, 0.0, 0.0))
    assert volume(pieces) == pytest.approx(tube.volume, rel=0.1)


def test_a_box_of_sheets_without_a_lid_stays_open() -> None:
    box = trimesh.creation.box((1.0, 1.0, 1.0))
    open_faces = box.faces[box.face_normals[:, 2] < 0.5]
    pieces = convex_pieces(Mesh(np.array(box.vertices), np.array(open_faces, dtype=np.int32)))
    assert len(pieces) == 5 and not inside(pieces, (0.0, 0.0, 0.2))


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(VARIABLE, str(tmp_path / "cache"))
    return tmp_path / "cache"


def content(pieces: tuple[Mesh, ...]) -> list[tuple[bytes, str, bytes, str]]:
    return [(p.points.tobytes(), p.points.dtype.str, p.triangles.tobytes(), p.triangles.dtype.str) for p in pieces]


def never(*_: object) -> tuple[Mesh, ...]:
    raise AssertionError("the mesh was cut again")


def test_pieces_are_kept_by_content(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    box = as_mesh(small_machine.open_box(0.9, 1.2, 0.4, 0.02))
    made = content(convex_pieces(box))
    assert len(list(cache.rglob("*.kept"))) == 1
    monkeypatch.setattr(cutting, "_cut", never)
    assert content(convex_pieces(Mesh(box.points.copy(), box.triangles.copy()))) == made
    with pytest.raises(AssertionError, match="cut again"):
        convex_pieces(as_mesh(small_machine.open_box(0.9, 1.2, 0.4, 0.03)))


def test_a_damaged_entry_is_made_anew(cache: Path) -> None:
    box = as_mesh(small_machine.open_box(0.9, 1.2, 0.4, 0.02))
    made = content(convex_pieces(box))
    (entry,) = cache.rglob("*.kept")
    good = entry.read_bytes()
    flipped = bytearray(good)
    flipped[len(good) // 3] ^= 0xFF
    # Whole by its digest, and yet no entry: nothing, and bytes that mean nothing.
    others = [data + hashlib.sha256(data).digest() for data in (b"", b"no entry", good[:100])]
    for damage in (b"", b"no entry", good[: len(good) // 2], bytes(flipped), *others):
        entry.write_bytes(damage)
        assert content(convex_pieces(box)) == made
        assert entry.read_bytes() == good


def test_without_a_cache_folder_it_works_all_the_same(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    box = as_mesh(small_machine.open_box(0.9, 1.2, 0.4, 0.02))
    (tmp_path / "file").write_text("in the way")
    for folder in (tmp_path / "file" / "cache", Path("/proc/nothing")):
        monkeypatch.setenv(VARIABLE, str(folder))
        assert len(convex_pieces(box)) == 3
    monkeypatch.setenv(VARIABLE, "off")
    assert cache_folder() is None
    assert len(convex_pieces(box)) == 3


def test_where_the_cache_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(VARIABLE)
    monkeypatch.setenv("XDG_CACHE_HOME", "/var/somewhere")
    assert cache_folder() == Path("/var/somewhere/yellowiron")
    monkeypatch.setenv("XDG_CACHE_HOME", "relative")
    assert cache_folder() == Path.home() / ".cache" / "yellowiron"
