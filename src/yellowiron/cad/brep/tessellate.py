"""B-rep shapes to triangle meshes: Open CASCADE meshes, numpy reads its memory. Millimetres in, metres out."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepLib import BRepLib_ToolTriangulatedShape
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.IMeshTools import IMeshTools_Parameters
from OCP.Poly import Poly_Triangle, Poly_Triangulation
from OCP.TopAbs import TopAbs_REVERSED
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Compound

from yellowiron.model.geometry import Color, Floats, Ints, Mesh

ANGLE = 0.3
"""Largest turn between neighbouring facets, radians: 21 to a circle at least."""
RELATIVE_DEFLECTION = 2e-3
"""Largest distance between mesh and surface, as a part of the shape's diagonal …"""
DEFLECTION_RANGE = (0.02, 1.0)
"""… within these bounds, millimetres."""

MILLIMETRE = 1e-3
_FACELESS = Mesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int32))


def mesh_shapes(shapes: Iterable[tuple[Any, float]]) -> None:
    """Meshes shapes in place. Each comes with its diagonal in millimetres, which its deflection is scaled to.

    Shapes of like size are meshed as one compound, so that many small faces share the processor's cores; the
    deflection is a power of two, so that a shape's mesh does not depend on what it is meshed with.
    """
    classes: dict[float, list[Any]] = {}
    for shape, diagonal in shapes:
        classes.setdefault(deflection(diagonal), []).append(shape)
    for size in sorted(classes):
        parameters = IMeshTools_Parameters()
        parameters.Deflection = parameters.DeflectionInterior = size
        parameters.Angle = parameters.AngleInterior = ANGLE
        parameters.InParallel = True
        parameters.AllowQualityDecrease = True
        BRepMesh_IncrementalMesh(compound(classes[size]), parameters)


def compound(shapes: Iterable[Any]) -> Any:
    """One compound of shapes."""
    result, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(result)
    for shape in shapes:
        builder.Add(result, shape)
    return result


def deflection(diagonal: float) -> float:
    """The deflection in mm for a diagonal in mm: two thousandths of it, rounded to a power of two, within bounds."""
    low, high = DEFLECTION_RANGE
    wanted = min(max(diagonal * RELATIVE_DEFLECTION, low), high)
    return float(2.0 ** math.floor(math.log2(wanted)))


def mesh_of(faces: Sequence[Any], colors: Sequence[Color | None] | None = None) -> tuple[Mesh, int]:
    """The mesh of meshed faces, metres, with surface normals; and the number of faces that have none.

    Points on an edge are there once for every face that meets in it, since their normals differ. `colors`, one a
    face, gives the triangles their colours; None among them is grey.
    """
    points: list[Floats] = []
    normals: list[Floats] = []
    triangles: list[Ints] = []
    triangle_colors: list[Floats] = []
    offset = missing = 0
    location = TopLoc_Location()
    for index, face in enumerate(faces):
        triangulation = BRep_Tool.Triangulation_s(face, location)
        if triangulation is None or triangulation.NbTriangles() == 0:
            missing += 1
            continue
        BRepLib_ToolTriangulatedShape.ComputeNormals_s(face, triangulation)
        xyz, ijk, directions = _READ(triangulation)
        flip = face.Orientation() == TopAbs_REVERSED
        if not location.IsIdentity():
            trsf = location.Transformation()
            matrix = np.array([[trsf.Value(i, j) for j in (1, 2, 3, 4)] for i in (1, 2, 3)])
            xyz = xyz @ matrix[:, :3].T + matrix[:, 3]
            directions = directions @ (matrix[:, :3].T / trsf.ScaleFactor())
            flip ^= trsf.IsNegative()
        if face.Orientation() == TopAbs_REVERSED:
            directions = -directions
        points.append(xyz)
        normals.append(directions)
        triangles.append((ijk[:, ::-1] if flip else ijk) + np.int32(offset - 1))
        offset += len(xyz)
        if colors is not None:
            triangle_colors.append(np.tile(np.array(colors[index] or (0.5, 0.5, 0.5)), (len(ijk), 1)))
    if not points:
        return _FACELESS, missing
    mesh = Mesh(
        points=np.concatenate(points) * MILLIMETRE,
        triangles=np.concatenate(triangles).astype(np.int32),
        normals=_unit(np.concatenate(normals)),
        triangle_colors=np.concatenate(triangle_colors) if triangle_colors else None,
    )
    return mesh, missing


def _unit(vectors: Floats) -> Floats:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(np.where(length > 0.0, vectors / np.maximum(length, 1e-30), (0.0, 0.0, 1.0)))


Arrays = tuple[Floats, Ints, Floats]


def read_by_loop(triangulation: Any) -> Arrays:
    """Points (n, 3), triangles (m, 3) counted from 1 and normals (n, 3) through the public interface: slow, sure."""
    count = triangulation.NbNodes()
    xyz = np.array([triangulation.Node(i).Coord() for i in range(1, count + 1)], dtype=np.float64)
    ijk = np.array([triangulation.Triangle(i).Get() for i in range(1, triangulation.NbTriangles() + 1)], dtype=np.int32)
    normals = np.zeros((count, 3))
    if triangulation.HasNormals():
        normals = np.array([triangulation.Normal(i).Coord() for i in range(1, count + 1)], dtype=np.float64)
    return xyz.reshape(-1, 3), ijk.reshape(-1, 3), normals.reshape(-1, 3)


def read_by_pointer(triangulation: Any) -> Arrays:
    """The same from the arrays' memory: six times as fast. Trusted only after `pointer_works`."""
    count = triangulation.NbNodes()
    node_type, width = (np.float64, 24) if triangulation.IsDoublePrecision() else (np.float32, 12)
    xyz = _copy(_words(triangulation.InternalNodes(), 1)[0], count * width, node_type)
    ijk = _copy(_words(triangulation.InternalTriangles(), 4)[3], triangulation.NbTriangles() * 12, np.int32)
    normals = np.zeros((count, 3))
    if triangulation.HasNormals():
        normals = _copy(_words(triangulation.InternalNormals(), 4)[3], count * 12, np.float32).astype(np.float64)
    return xyz.astype(np.float64), ijk, normals


def _words(wrapped: Any, count: int) -> Sequence[int]:
    """The first machine words of the C++ object behind a binding; pybind11 keeps its address after the object head."""
    address = ctypes.c_void_p.from_address(id(wrapped) + object.__basicsize__).value
    if address is None:
        raise ValueError("no object behind the binding")
    return np.frombuffer(ctypes.string_at(address, 8 * count), dtype=np.uint64).tolist()


def _copy(address: int, size: int, kind: type[Any]) -> NDArray[Any]:
    return np.frombuffer(ctypes.string_at(address, size), dtype=kind).reshape(-1, 3)


def pointer_works() -> bool:
    """True where this build's memory looks as `read_by_pointer` expects: tried on a triangulation of known content."""
    sample = Poly_Triangulation(3, 2, False, True)
    for index, xyz in enumerate(((0.5, -1.25, 2.0), (3.0, 4.5, -5.0), (6.25, 7.0, 8.5)), start=1):
        sample.SetNode(index, _point(xyz))
        sample.SetNormal(index, _direction(xyz))
    sample.SetTriangle(1, Poly_Triangle(1, 2, 3))
    sample.SetTriangle(2, Poly_Triangle(3, 2, 1))
    # The words hold an array's length and a plausible pointer before any pointer is followed.
    triangles, normals = _words(sample.InternalTriangles(), 4), _words(sample.InternalNormals(), 4)
    nodes = _words(sample.InternalNodes(), 2)
    lengths = triangles[2] == 2 and normals[2] == 3 and nodes[1] == (3 << 32 | 24)
    pointers = (triangles[3], normals[3], nodes[0])
    if not lengths or any(pointer % 4 or not 0x1000 < pointer < 1 << 48 for pointer in pointers):
        return False
    # Normals are kept in single precision and come out of the interface as unit vectors of doubles.
    by_loop, by_pointer = read_by_loop(sample), read_by_pointer(sample)
    return all(bool(np.allclose(by_loop[i], by_pointer[i], atol=1e-6)) for i in range(3))


def _point(xyz: Sequence[float]) -> Any:
    from OCP.gp import gp_Pnt

    return gp_Pnt(*xyz)


def _direction(xyz: Sequence[float]) -> Any:
    from OCP.gp import gp_Dir

    return gp_Dir(*xyz)


_READ = read_by_pointer if pointer_works() else read_by_loop
