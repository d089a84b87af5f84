"""Shapes as documents write them: convex meshes of a collider, a mesh with its place, all shapes of a link."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from yellowiron.exporters.assets import Assets, unique
from yellowiron.exporters.geometry import BodyGeometry, Collider, Geometry, Kind
from yellowiron.exporters.values import quaternion
from yellowiron.model.geometry import Color, Floats, Mesh
from yellowiron.support.convex.pieces import convex_pieces, hull
from yellowiron.support.convex.solids import Convex, convex


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


def solids_of(body: BodyGeometry) -> tuple[Convex, ...]:
    """What a body collides as, in its own frame."""
    pieces = ConvexPieces()
    found = []
    for collider in body.colliders:
        if collider.mesh is not None:
            meshes: tuple[Mesh, ...] = pieces.of(collider.mesh, collider.approximation)
        else:
            meshes = (_analytic(collider),)
        found += [
            convex(mesh.points @ collider.matrix[:3, :3].T + collider.matrix[:3, 3])
            for mesh in meshes
            if len(mesh.triangles)
        ]
    return tuple(found)


def drawn_of(body: BodyGeometry) -> Floats:
    """The triangles (n, 3, 3) that are seen of a body, in its own frame."""
    found = [
        (visual.mesh.points @ visual.matrix[:3, :3].T + visual.matrix[:3, 3])[visual.mesh.triangles]
        for visual in body.visuals
    ]
    return np.concatenate(found) if found else np.zeros((0, 3, 3))


def _analytic(collider: Collider) -> Mesh:
    """The corners of a box, and of what is round a likeness."""
    from trimesh import creation

    if collider.kind == "box":
        made = creation.box(collider.size)
    elif collider.kind == "sphere":
        made = creation.icosphere(subdivisions=2, radius=collider.size[0])
    else:
        of = creation.capsule if collider.kind == "capsule" else creation.cylinder
        made = of(radius=collider.size[0], height=collider.size[1])
    return Mesh(np.asarray(made.vertices, dtype=np.float64), np.asarray(made.faces, dtype=np.int32))


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


@dataclass(frozen=True, eq=False)
class Shape:
    """A shape of a link: a `kind` with its `size` (as `Collider` has them), or the file of a mesh, placed by `matrix`
    (4, 4; a proper rotation) in the link. `color` is linear RGB, of what is seen alone."""

    name: str
    matrix: Floats
    kind: Kind
    size: tuple[float, ...] = ()
    file: str = ""
    color: Color | None = None
    friction: float | None = None


class Shapes:
    """The shapes of links, their meshes written into a folder as files that are used again. `hulls`: where those that
    collide go, if not among `assets`."""

    def __init__(self, geometry: Geometry, assets: Assets, *, hulls: Assets | None = None) -> None:
        self._geometry = geometry
        self._assets = assets
        self._hulls = hulls or assets
        self._pieces = ConvexPieces()

    def seen(self, body: str, shift: Floats) -> list[Shape]:
        """What is to be seen of a body; `shift` (3,) is its frame's origin in the link's frame."""
        found: list[Shape] = []
        taken: set[str] = set()
        for visual in self._of(body).visuals:
            for file, matrix in _files(self._assets, visual.name, visual.mesh, visual.matrix, shift):
                found.append(Shape(unique(visual.name, taken), matrix, "mesh", (), file, visual.color))
        return found

    def touched(self, body: str, shift: Floats, *, capsules: bool = True) -> list[Shape]:
        """What collides of a body: simple shapes and convex meshes. Without `capsules` each is a cylinder between two
        spheres, which is the same."""
        found: list[Shape] = []
        taken: set[str] = set()
        for one in self._of(body).colliders:
            name, friction = f"{one.name}_collision", one.friction
            if one.mesh is not None:
                for piece in self._pieces.of(placed(one.mesh, one.matrix)[0], one.approximation):
                    at = one.matrix if _proper(one.matrix) else _moved(one.matrix)
                    for file, matrix in _files(self._hulls, f"{one.name}_hull", piece, at, shift):
                        found.append(Shape(unique(name, taken), matrix, "mesh", (), file, None, friction))
                continue
            matrix = one.matrix.copy()
            matrix[:3, 3] += shift
            if one.kind != "capsule" or capsules:
                found.append(Shape(unique(name, taken), matrix, one.kind, one.size, "", None, friction))
                continue
            radius, height = one.size
            found.append(Shape(unique(name, taken), matrix, "cylinder", one.size, "", None, friction))
            for end in (-0.5 * height, 0.5 * height):
                cap = matrix.copy()
                cap[:3, 3] += end * matrix[:3, 2]
                found.append(Shape(unique(name, taken), cap, "sphere", (radius,), "", None, friction))
        return found

    def _of(self, body: str) -> BodyGeometry:
        return self._geometry.bodies.get(body, BodyGeometry())


def _files(assets: Assets, name: str, mesh: Mesh, matrix: Floats, shift: Floats) -> list[tuple[str, Floats]]:
    """The files that hold a mesh, with its place in the link."""
    drawn, position, _ = placed(mesh, matrix)
    at = np.eye(4)
    at[:3, :3] = matrix[:3, :3] if _proper(matrix) else np.eye(3)
    at[:3, 3] = position + shift
    return [(assets.files[asset], at) for asset in assets.add(name, drawn)]


def _proper(matrix: Floats) -> bool:
    linear = matrix[:3, :3]
    return bool(np.abs(linear.T @ linear - np.eye(3)).max() < 1e-9 and np.linalg.det(linear) > 0.0)


def _moved(matrix: Floats) -> Floats:
    """A place without its turn."""
    made = np.eye(4)
    made[:3, 3] = matrix[:3, 3]
    return made
