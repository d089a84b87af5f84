"""Meshes as they come, mended for measuring: doubled, inverted and missing triangles."""

from __future__ import annotations

import math

import numpy as np
import pytest

from kit.machines.solids import box, plate, tube
from yellowiron.cad.mesh.assembly import shape_of
from yellowiron.cad.mesh.measures import compacted
from yellowiron.model.geometry import Ints, Mesh

PIN = compacted(tube("pin", 0.04, 0.0, 0.3).mesh)
PLATE = compacted(plate("plate", np.array([[0, 0], [0.4, 0], [0.4, 0.3], [0, 0.3]]), 0.03, [(0.2, 0.15, 0.05)]).mesh)
FLIPPED = np.random.default_rng(5).random(len(PLATE.triangles)) < 0.5


def _without(mesh: Mesh, rows: Ints) -> Mesh:
    return Mesh(mesh.points, np.delete(mesh.triangles, rows, axis=0))


def _walls(mesh: Mesh) -> Mesh:
    """Without the faces at both ends along z."""
    heights = mesh.points[mesh.triangles][:, :, 2]
    return Mesh(mesh.points, mesh.triangles[np.ptp(heights, axis=1) > 1e-6])


@pytest.mark.parametrize(
    "triangles",
    [
        np.concatenate([PLATE.triangles, PLATE.triangles]),
        np.concatenate([PLATE.triangles, PLATE.triangles[:, ::-1]]),
        PLATE.triangles[:, ::-1],
        np.where(FLIPPED[:, None], PLATE.triangles[:, ::-1], PLATE.triangles),
    ],
    ids=["twice", "from both sides", "inside out", "at random"],
)
def test_doubled_and_inverted_triangles_leave_a_solid_what_it_is(triangles: Ints) -> None:
    sound, found = shape_of(PLATE, "plate"), shape_of(Mesh(PLATE.points, triangles.astype(np.int32)), "plate")
    assert found.closed
    assert found.volume == pytest.approx(sound.volume, rel=1e-9)
    assert found.area == pytest.approx(sound.area, rel=1e-9)
    assert found.inertia == pytest.approx(sound.inertia, rel=1e-9)
    assert [(c.radius, c.inner) for c in found.cylinders] == [(pytest.approx(0.05), True)]
    assert len(found.planes) == len(sound.planes) == 6
    assert len(found.mesh.triangles) == len(triangles)


def test_a_bar_without_its_ends_has_the_volume_and_inertia_of_the_bar() -> None:
    sound, found = shape_of(PIN, "pin"), shape_of(_walls(PIN), "pin")
    assert not found.closed
    assert found.volume == pytest.approx(sound.volume, rel=1e-9)
    assert found.centroid == pytest.approx(sound.centroid, abs=1e-12)
    assert found.inertia == pytest.approx(sound.inertia, rel=1e-9)
    assert not found.cylinders[0].inner


def test_a_bar_without_its_ends_and_inside_out_is_a_bar() -> None:
    walls = _walls(PIN)
    found = shape_of(Mesh(walls.points, walls.triangles[:, ::-1]), "pin")
    assert [c.inner for c in found.cylinders] == [False]


def test_missing_triangles_change_the_volume_little() -> None:
    rng = np.random.default_rng(3)
    gone = rng.choice(len(PLATE.triangles), len(PLATE.triangles) // 20, replace=False)
    sound, found = shape_of(PLATE, "plate"), shape_of(_without(PLATE, gone), "plate")
    assert not found.closed
    assert found.volume == pytest.approx(sound.volume, rel=0.03)
    assert math.isclose(found.cylinders[0].radius, 0.05, rel_tol=1e-6)


def test_a_flat_sheet_holds_nothing_and_faces_as_drawn() -> None:
    sheet = Mesh(np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float),
                 np.array([[0, 2, 1], [0, 3, 2]], dtype=np.int32))  # fmt: skip
    found = shape_of(sheet, "sheet")
    assert not found.closed
    assert found.volume == 0.0
    assert found.centroid == pytest.approx([0.5, 0.5, 0.0])
    assert (found.mesh.triangles == sheet.triangles).all()


def test_corners_that_nearly_meet_are_one() -> None:
    """A solid whose triangles were written apart, each corner off by some thousandth of a millimetre."""
    solid = compacted(box("block", 0.4, 0.3, 0.2, [(0.0, 0.0, 0.05)]).mesh)
    corners = solid.points[solid.triangles].reshape(-1, 3)
    corners = corners + np.random.default_rng(1).uniform(-4e-6, 4e-6, corners.shape)
    found = shape_of(Mesh(corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3)), "block")
    assert found.closed
    assert found.volume == pytest.approx(shape_of(solid, "block").volume, rel=1e-4)
    assert [c.radius for c in found.cylinders] == [pytest.approx(0.05, rel=1e-3)]
