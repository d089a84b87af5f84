"""Meshes: size against accuracy, orientation, normals, and the fast reader against the sure one."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from OCP.BRep import BRep_Tool
from OCP.BRepLib import BRepLib_ToolTriangulatedShape
from OCP.TopLoc import TopLoc_Location

from kit.cadfiles.step import box, cut, cylinder, faces_of, moved, pin_bracket, to_nurbs
from yellowiron.cad.brep import tessellate, to_shape
from yellowiron.cad.mesh import measures
from yellowiron.model.geometry import Mesh


def mesh(body: Any) -> Mesh:
    measured = to_shape.measure("x", body)
    tessellate.mesh_shapes([(measured.shape, measured.diagonal)])
    return tessellate.mesh_of(measured.faces)[0]


BODIES = {
    "pin": lambda: cylinder(5, 120),
    "tube": lambda: cut(cylinder(900, 600), cylinder(890, 600)),
    "bracket": pin_bracket,
    "freeform": lambda: to_nurbs(pin_bracket()),
    "mirrored": lambda: moved(pin_bracket(), np.diag([1.0, -1.0, 1.0, 1.0])),
}


@pytest.mark.parametrize("name", BODIES)
def test_mesh_encloses_the_body(name: str) -> None:
    body = BODIES[name]()
    result = mesh(body)
    exact = to_shape.measure("x", body)
    assert measures.is_closed(result)
    volume, centroid, inertia = measures.volume_properties(result)
    assert volume * 1e9 == pytest.approx(exact.volume, rel=0.02)
    assert np.allclose(centroid * 1e3, exact.centroid, atol=exact.diagonal * 1e-3)
    assert np.allclose(inertia * 1e15, exact.inertia, atol=0.04 * np.abs(exact.inertia).max())
    area, _ = measures.area_properties(result)
    assert area * 1e6 == pytest.approx(exact.area, rel=0.02)


@pytest.mark.parametrize("name", BODIES)
def test_normals_point_out(name: str) -> None:
    result = mesh(BODIES[name]())
    assert result.normals is not None
    assert np.allclose(np.linalg.norm(result.normals, axis=1), 1.0)
    a, b, c = (result.points[result.triangles[:, i]] for i in range(3))
    facet = np.cross(b - a, c - a)
    facet /= np.linalg.norm(facet, axis=1, keepdims=True)
    for corner in range(3):
        along = np.einsum("ij,ij->i", facet, result.normals[result.triangles[:, corner]])
        assert along.min() > math.cos(tessellate.ANGLE)


def test_deflection_follows_the_size() -> None:
    low, high = tessellate.DEFLECTION_RANGE
    assert tessellate.deflection(0.1) <= low < 2 * tessellate.deflection(0.1)
    assert tessellate.deflection(1e5) == high
    assert tessellate.deflection(100.0) == pytest.approx(0.125)
    # A thin pin is round, and a large tyre is rounder.
    assert len(mesh(cylinder(3, 40)).triangles) > 60
    assert len(mesh(cylinder(900, 600)).triangles) > 200


def test_mesh_does_not_depend_on_its_neighbours() -> None:
    alone = mesh(pin_bracket())
    body, others = to_shape.measure("x", pin_bracket()), [to_shape.measure("y", cylinder(r, 300)) for r in (10, 20, 40)]
    tessellate.mesh_shapes([(b.shape, b.diagonal) for b in (*others, body)])
    together = tessellate.mesh_of(body.faces)[0]
    assert np.array_equal(alone.points, together.points)
    assert np.array_equal(alone.triangles, together.triangles)


def test_pointer_and_loop_agree() -> None:
    body = to_shape.measure("x", pin_bracket())
    tessellate.mesh_shapes([(body.shape, body.diagonal)])
    assert tessellate.pointer_works()
    for face in body.faces:
        triangulation = BRep_Tool.Triangulation_s(face, TopLoc_Location())
        BRepLib_ToolTriangulatedShape.ComputeNormals_s(face, triangulation)
        fast, sure = tessellate.read_by_pointer(triangulation), tessellate.read_by_loop(triangulation)
        assert np.array_equal(fast[0], sure[0])
        assert np.array_equal(fast[1], sure[1])
        assert np.allclose(fast[2], sure[2], atol=1e-6)


def test_colours_a_face() -> None:
    faces = faces_of(box(10, 20, 30))
    body = to_shape.measure("x", box(10, 20, 30), face_colors=[(1.0, 0.0, 0.0)] + [None] * (len(faces) - 1))
    tessellate.mesh_shapes([(body.shape, body.diagonal)])
    colors = to_shape.finish(body)[0].mesh.triangle_colors
    assert colors is not None
    assert np.array_equal(colors, [[1, 0, 0]] * 2 + [[0.5] * 3] * 10)
    same = to_shape.measure("x", box(10, 20, 30), face_colors=[(1.0, 0.0, 0.0)] * len(faces))
    assert (same.color, same.face_colors) == ((1.0, 0.0, 0.0), None)


def test_open_mesh_is_not_closed() -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    closed = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], dtype=np.int32)
    tetrahedron = Mesh(points, closed)
    assert measures.is_closed(tetrahedron)
    assert not measures.is_closed(Mesh(points, closed[:3]))
    volume, centroid, _ = measures.volume_properties(tetrahedron)
    assert volume == pytest.approx(1 / 6)
    assert np.allclose(centroid, 0.25)
    assert measures.content_key(tetrahedron) == measures.content_key(Mesh(points * 1.0, closed.copy()))
