"""Meshes taken apart: solids that touch, hollows, sheets whose edges do not match, and copies written out."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from kit.machines.solids import box, lathe, tube
from yellowiron.cad.mesh import copies, mending, shells
from yellowiron.cad.mesh.measures import compacted, volume_properties
from yellowiron.model.geometry import Floats, Mesh


def soup(*meshes: Mesh) -> Mesh:
    """All triangles of meshes with corners of their own, in single precision, as in an STL file."""
    corners = np.concatenate([m.points[m.triangles].reshape(-1, 3) for m in meshes])
    points = corners.astype(np.float32).astype(np.float64)
    return compacted(Mesh(points, np.arange(len(corners), dtype=np.int32).reshape(-1, 3)))


def moved(mesh: Mesh, offset: tuple[float, float, float] = (0.0, 0.0, 0.0), turn: Floats | None = None) -> Mesh:
    matrix = np.eye(3) if turn is None else turn
    return Mesh(mesh.points @ matrix.T + np.array(offset), mesh.triangles)


def counted(mesh: Mesh) -> list[int]:
    return np.bincount(shells.solids(mesh)).tolist()


PLATE = lathe("plate", [(0.03, -0.02), (0.1, -0.02), (0.1, 0.02), (0.03, 0.02)]).mesh
PIN = moved(tube("pin", 0.03, 0.0, 0.04).mesh, (0.0, 0.0, -0.02))
"""As long as the plate is thick, and as wide as its bore: every corner of its mantle is one of the bore's."""


@pytest.mark.parametrize("place", [(0.0, 0.0, 0.0), (3.0, -2.0, 5.0)])
def test_pin_flush_in_its_bore_is_two_solids(place: tuple[float, float, float]) -> None:
    both = soup(moved(PLATE, place), moved(PIN, place))
    label = shells.solids(both)
    assert sorted(np.bincount(label)) == sorted([len(compacted(PLATE).triangles), len(compacted(PIN).triangles)])
    assert len(set(label[: len(compacted(PLATE).triangles)])) == 1


def test_stacked_plates_are_as_many() -> None:
    block = box("block", 0.3, 0.2, 0.02).mesh
    stack = [moved(block, (0.0, 0.0, 0.02 * k)) for k in range(4)]
    assert counted(soup(*stack)) == [len(block.triangles)] * 4


def test_blocks_that_touch_along_an_edge_are_two() -> None:
    block = box("block", 0.2, 0.2, 0.2).mesh
    assert len(counted(soup(block, moved(block, (0.2, 0.2, 0.0))))) == 2


def test_hollow_belongs_to_what_is_around_it_and_a_loose_part_inside_out_does_not() -> None:
    outer, inner = box("outer", 0.4, 0.4, 0.4).mesh, box("inner", 0.2, 0.2, 0.2).mesh
    hollow = Mesh(inner.points, inner.triangles[:, ::-1])
    assert len(counted(soup(outer, hollow))) == 1
    ring = lathe("ring", [(0.1, -0.05), (0.2, -0.05), (0.2, 0.05), (0.1, 0.05)]).mesh
    bolt = tube("bolt", 0.03, 0.0, 0.08).mesh
    assert len(counted(soup(ring, Mesh(bolt.points, bolt.triangles[:, ::-1])))) == 2


def test_sheet_whose_edges_do_not_match_stays_one() -> None:
    """Two halves of a sheet: one edge on the left, two half as long on the right."""
    points = np.array([[-1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, 0], [1, 0, 0]], dtype=np.float64)
    mesh = Mesh(points, np.array([[0, 1, 2], [1, 4, 3], [3, 4, 2]], dtype=np.int32))
    assert counted(mesh) == [3]


def test_volume_of_a_hollow_block() -> None:
    outer, inner = box("outer", 0.4, 0.4, 0.4).mesh, box("inner", 0.2, 0.2, 0.2).mesh
    whole = mending.mended(soup(outer, Mesh(inner.points, inner.triangles[:, ::-1])))
    assert whole.closed
    assert volume_properties(whole.filled)[0] == pytest.approx(0.4**3 - 0.2**3, rel=1e-5)


def test_copies_turned_and_moved_are_one() -> None:
    turn = Rotation.from_euler("xyz", (0.3, -1.1, 2.0)).as_matrix()
    mirrored = Mesh(PLATE.points * np.array([1.0, 1.0, -1.0]), PLATE.triangles[:, ::-1])
    meshes = [soup(m) for m in (PLATE, moved(PLATE, (4.0, -3.0, 1.0), turn), PIN, moved(PLATE, (0.0, 9.0, 0.0)))]
    found = copies.originals([*meshes, soup(mirrored), Mesh(PLATE.points * 1.001, PLATE.triangles)])
    assert [first for first, _ in found] == [0, 0, 2, 0, 4, 5]
    transform = found[1][1]
    assert transform is not None
    assert transform[:3, :3] == pytest.approx(turn, abs=1e-5)
    assert transform[:3, 3] == pytest.approx([4.0, -3.0, 1.0], abs=2e-6)
    assert np.linalg.det(transform) == pytest.approx(1.0, abs=1e-12)


def test_no_copy_of_what_is_no_number() -> None:
    broken = Mesh(np.where(PLATE.points == PLATE.points.max(), math.nan, PLATE.points), PLATE.triangles)
    assert [first for first, _ in copies.originals([broken, broken, PLATE])] == [0, 1, 2]
