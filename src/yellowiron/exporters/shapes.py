"""Shapes as documents write them: convex meshes of a collider, a mesh with its place."""

from __future__ import annotations

import numpy as np

from yellowiron.exporters.values import quaternion
from yellowiron.model.geometry import Floats, Mesh
from yellowiron.support.convex import convex_pieces, hull


class ConvexPieces:
    """Convex meshes of colliders; those of a shape that several have are made once."""

    def __init__(self) -> None:
        self._pieces: dict[tuple[bytes, bytes, str], tuple[Mesh, ...]] = {}

    def of(self, mesh: Mesh, token: str) -> tuple[Mesh, ...]:
        """Convex meshes for a collider's approximation; whatever may be hollow is cut into pieces."""
        key = (mesh.points.tobytes(), mesh.triangles.tobytes(), token)
        if key not in self._pieces:
            if token == "boundingCube":
                low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
                corners = np.array([[(low, high)[bit >> k & 1][k] for k in range(3)] for bit in range(8)])
                self._pieces[key] = (hull(corners),)
            elif token == "boundingSphere":
                self._pieces[key] = (_ball(mesh.points),)
            elif token == "convexHull":
                self._pieces[key] = (hull(mesh.points),)
            else:
                self._pieces[key] = convex_pieces(mesh)
        return self._pieces[key]


def placed(mesh: Mesh, matrix: Floats) -> tuple[Mesh, Floats, Floats]:
    """A mesh with its position and rotation (w, x, y, z). What no rotation can do, a scale or a mirror image, is done
    to its points."""
    linear = matrix[:3, :3]
    if np.abs(linear.T @ linear - np.eye(3)).max() < 1e-9 and np.linalg.det(linear) > 0.0:
        return mesh, matrix[:3, 3], quaternion(linear)
    triangles = mesh.triangles[:, ::-1] if np.linalg.det(linear) < 0.0 else mesh.triangles
    return Mesh(mesh.points @ linear.T, triangles), matrix[:3, 3], np.array([1.0, 0.0, 0.0, 0.0])


def _ball(points: Floats) -> Mesh:
    from trimesh.creation import icosphere

    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    ball = icosphere(subdivisions=2, radius=float(np.linalg.norm(points - middle, axis=1).max()))
    return Mesh(np.asarray(ball.vertices) + middle, np.asarray(ball.faces, dtype=np.int32))
