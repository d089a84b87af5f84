"""Meshes: welding, normals, extents."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from pxr import Usd, UsdGeom

from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Mesh, Shape
from yellowiron.usd import write_assembly
from yellowiron.usd.layers.geometry import creased_normals


def split_box() -> Mesh:
    """A box as CAD kernels mesh it: four points of its own a face, normals of the face."""
    box = trimesh.creation.box((1.0, 2.0, 3.0))
    corners = box.vertices[box.faces].reshape(-1, 3)
    return Mesh(
        np.array(corners),
        np.arange(36, dtype=np.int32).reshape(-1, 3),
        np.repeat(np.array(box.face_normals), 3, axis=0),
    )


def written_mesh(mesh: Mesh, folder: Path, *, closed: bool = True) -> UsdGeom.Mesh:
    shape = Shape("k", "box", mesh, 6.0, 22.0, np.zeros(3), np.eye(3), closed=closed)
    part = Part("box", "box", (), "k", np.eye(4))
    assembly = Assembly("a", "step", 1.0, (part,), {"k": shape})
    written_mesh.stage = Usd.Stage.Open(str(write_assembly(assembly, folder / "mesh.usda")))  # keeps it open
    return UsdGeom.Mesh(written_mesh.stage.GetPrimAtPath("/a/box/mesh"))


def corner_normals(mesh: UsdGeom.Mesh) -> np.ndarray:
    primvar = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("normals")
    if primvar:
        return np.array(primvar.ComputeFlattened())
    normals = np.array(mesh.GetNormalsAttr().Get())
    if mesh.GetNormalsInterpolation() == "vertex":
        return normals[np.array(mesh.GetFaceVertexIndicesAttr().Get())]
    return normals


def test_repeated_points_become_one_and_normals_stay(tmp_path: Path) -> None:
    mesh = written_mesh(split_box(), tmp_path)
    assert len(mesh.GetPointsAttr().Get()) == 8
    triangles = np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
    assert trimesh.Trimesh(np.array(mesh.GetPointsAttr().Get()), triangles, process=False).is_watertight
    assert np.allclose(corner_normals(mesh), split_box().normals, atol=1e-6)
    assert not mesh.GetDoubleSidedAttr().HasAuthoredValue()
    assert np.allclose(mesh.GetExtentAttr().Get(), [(-0.5, -1.0, -1.5), (0.5, 1.0, 1.5)])
    assert mesh.GetSubdivisionSchemeAttr().Get() == "none"


def test_missing_normals_are_creased(tmp_path: Path) -> None:
    mesh = written_mesh(replace(split_box(), normals=None), tmp_path)
    assert np.allclose(corner_normals(mesh), split_box().normals, atol=1e-6)


def test_triangles_without_corners_are_left_out_with_their_colours(tmp_path: Path) -> None:
    box = split_box()
    points = np.concatenate([box.points, box.points[:1] + 1e-12])
    triangles = np.concatenate([box.triangles, np.array([[0, 36, 1]], dtype=np.int32)])
    colours = np.tile([[0.1, 0.2, 0.3]], (13, 1))
    mesh = written_mesh(Mesh(points, triangles, None, colours), tmp_path)
    assert len(mesh.GetFaceVertexCountsAttr().Get()) == 12
    assert len(UsdGeom.PrimvarsAPI(mesh).GetPrimvar("displayColor").Get()) == 12


def test_open_sheets_show_both_sides(tmp_path: Path) -> None:
    assert written_mesh(split_box(), tmp_path, closed=False).GetDoubleSidedAttr().Get() is True


def test_smooth_parts_are_smooth_and_edges_sharp() -> None:
    cylinder = trimesh.creation.cylinder(1.0, 2.0, sections=36)
    normals = creased_normals(np.array(cylinder.vertices), np.array(cylinder.faces, dtype=np.int32))
    facets = np.repeat(np.array(cylinder.face_normals), 3, axis=0)
    corners = np.array(cylinder.vertices)[np.array(cylinder.faces).ravel()]
    caps = np.abs(facets[:, 2]) > 0.9
    assert np.allclose(normals[caps], facets[caps])
    radial = corners[~caps] * (1.0, 1.0, 0.0)
    assert np.allclose(np.einsum("ij,ij->i", normals[~caps], radial), 1.0, atol=2e-3)


@pytest.mark.parametrize("points", [[[0, 0, 0], [1, 0, 0], [2, 0, 0]]])
def test_a_facet_without_area_still_has_a_normal(points) -> None:
    normals = creased_normals(np.array(points, dtype=float), np.array([[0, 1, 2]], dtype=np.int32))
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0)
