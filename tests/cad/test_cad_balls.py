"""Balls and sockets: from B-rep surfaces and from triangles, and what is none."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import trimesh
from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS_Shape

from drawing.product import Assembly, Part, write_step
from drawing.solids import Z, ball, box, cut, fuse, moved, rod, turn
from kit.machines.defects import on_triangles
from yellowiron.cad import read_cad
from yellowiron.cad.mesh.features.facets import find
from yellowiron.model.geometry import Mesh, Shape

CENTER, RADIUS = (120.0, -40.0, 300.0), 60.0


def read(shape: TopoDS_Shape, folder: Path, surfaces: str) -> Shape:
    root = Assembly("ONE")
    root.add(Part("PART", shape), "part")
    write_step(root, folder / "part.step", cad=gp_Trsf())
    shapes = read_cad(folder / "part.step").shapes
    return next(iter((on_triangles(shapes) if surfaces == "triangles" else shapes).values()))


def stud() -> TopoDS_Shape:
    x, y, z = CENTER
    return fuse(rod((x, y, z - 250.0), Z, 28.0, 250.0), ball(CENTER, RADIUS), box(0, 240, -160, 80, 30, 60))


def socket() -> TopoDS_Shape:
    x, y, z = CENTER
    return cut(box(x - 90, x + 90, y - 90, y + 90, z - 20, z + 90), ball(CENTER, RADIUS))


@pytest.mark.slow
@pytest.mark.parametrize("surfaces", ["exact", "triangles"])
@pytest.mark.parametrize(("shape", "inner"), [(stud, False), (socket, True)])
def test_a_ball_and_a_socket_are_found(surfaces: str, shape: object, inner: bool, tmp_path: Path) -> None:
    made = moved(shape(), turn((1.0, 2.0, 0.5), 37.0, CENTER))  # type: ignore[operator]
    (found,) = read(made, tmp_path, surfaces).spheres
    assert found.inner is inner
    assert found.radius == pytest.approx(RADIUS / 1000.0, abs=1e-5)
    assert np.abs(np.array(found.center) - np.array(CENTER) / 1000.0).max() < 1e-5
    assert 0.3 * 4.0 * math.pi * found.radius**2 < found.area < 4.0 * math.pi * found.radius**2


@pytest.mark.slow
@pytest.mark.parametrize("surfaces", ["exact", "triangles"])
def test_a_pin_has_no_ball(surfaces: str, tmp_path: Path) -> None:
    assert read(rod((0, 0, 0), Z, 30.0, 200.0), tmp_path, surfaces).spheres == ()


@pytest.mark.parametrize(
    "mesh",
    [
        trimesh.creation.torus(0.3, 0.08),
        trimesh.creation.cylinder(0.1, 0.6, sections=48),
        trimesh.creation.icosphere(subdivisions=3, radius=0.2).apply_scale((1.0, 1.0, 0.8)),
        trimesh.creation.box((0.2, 0.3, 0.4)),
    ],
    ids=["torus", "cylinder", "ellipsoid", "box"],
)
def test_what_is_bent_otherwise_is_no_ball(mesh: trimesh.Trimesh) -> None:
    assert find(Mesh(np.asarray(mesh.vertices), np.asarray(mesh.faces, dtype=np.int32))).spheres == ()


def test_a_coarse_ball_is_one() -> None:
    mesh = trimesh.creation.uv_sphere(radius=0.1, count=[10, 14])
    mesh.apply_translation((1.0, 2.0, 3.0))
    (found,) = find(Mesh(np.asarray(mesh.vertices), np.asarray(mesh.faces, dtype=np.int32))).spheres
    assert found.radius == pytest.approx(0.1, abs=1e-9)
    assert np.abs(np.array(found.center) - (1.0, 2.0, 3.0)).max() < 1e-9
