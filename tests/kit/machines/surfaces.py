"""What converters, artists and games do to surfaces: damages of meshes, the parts and their bodies stay as they are.

Each takes a machine as drawn and a generator of random numbers and gives back another machine. Only the meshes of its
shapes are right afterwards, not their features: `kit.scene` reads them as a file's.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import trimesh

from kit.machines.solids import Array
from kit.machines.synthetic import Machine
from yellowiron.model.assembly import Part
from yellowiron.model.geometry import Mesh

Rng = np.random.Generator
LEAST = 8
"""Triangles that a decimated mesh keeps at least."""


def with_meshes(
    machine: Machine, change: Callable[[Mesh], Mesh], *, of: Callable[[Part], bool] | None = None
) -> Machine:
    """The machine with another mesh for each shape, or for those of some parts."""
    chosen = sorted({p.shape for p in machine.parts if of is None or of(p)})
    shapes = dict(machine.shapes)
    names = {}
    for key in chosen:
        names[key] = f"{key}+"
        shapes[f"{key}+"] = replace(shapes[key], key=f"{key}+", mesh=change(shapes[key].mesh))
    parts = [
        replace(p, shape=names[p.shape]) if p.shape in names and (of is None or of(p)) else p for p in machine.parts
    ]
    used = {p.shape for p in parts}
    return replace(machine, parts=parts, shapes={k: s for k, s in shapes.items() if k in used})


def normals(mesh: Mesh) -> tuple[Array, Array]:
    """(m, 3) unit normals and (m,) areas of a mesh's triangles."""
    a, b, c = (mesh.points[mesh.triangles[:, i]] for i in range(3))
    across = np.cross(b - a, c - a)
    twice = np.linalg.norm(across, axis=1)
    return across / np.maximum(twice, 1e-300)[:, None], twice / 2


def _compact(points: Array, triangles: Array) -> Mesh:
    used, index = np.unique(triangles, return_inverse=True)
    return Mesh(np.asarray(points[used]), index.reshape(-1, 3).astype(np.int32))


def decimated(share: float) -> Callable[[Machine, Rng], Machine]:
    """Every mesh brought to that share of its triangles by quadric decimation (Garland and Heckbert, 1997)."""

    def change(mesh: Mesh) -> Mesh:
        from fast_simplification import simplify

        if share * len(mesh.triangles) < LEAST:
            return mesh
        points, triangles = simplify(
            mesh.points.astype(np.float32), mesh.triangles.astype(np.int32), target_reduction=1.0 - share
        )
        found = Mesh(np.asarray(points, dtype=np.float64), np.asarray(triangles, dtype=np.int32))
        areas = normals(found)[1]
        found = _compact(found.points, found.triangles[areas > 1e-12])
        return found if len(found.triangles) >= 4 else mesh

    return lambda machine, rng: with_meshes(machine, change)


def opened(machine: Machine, rng: Rng) -> Machine:
    """Every shell with a hole: without one of its smaller flat faces, or without one to three triangles."""

    def change(mesh: Mesh) -> Mesh:
        solid = trimesh.Trimesh(mesh.points, mesh.triangles, process=False)
        solid.merge_vertices()
        gone = np.zeros(len(mesh.triangles), dtype=bool)
        pieces = trimesh.graph.connected_components(solid.face_adjacency, nodes=np.arange(len(gone)), min_len=1)
        facets = [f for f in solid.facets if len(f) > 1]
        for piece in pieces:
            inside = set(piece.tolist())
            total = float(solid.area_faces[piece].sum())
            caps = [f for f in facets if int(f[0]) in inside and float(solid.area_faces[f].sum()) < 0.35 * total]
            if caps and rng.random() < 0.5:
                gone[caps[int(rng.integers(len(caps)))]] = True
            else:
                gone[rng.choice(piece, size=min(int(rng.integers(1, 4)), max(1, len(piece) - 4)), replace=False)] = True
        return _compact(mesh.points, mesh.triangles[~gone])

    return with_meshes(machine, change)


def is_pin(machine: Machine, part: Part) -> bool:
    role = machine.truth[part.id][0]
    return role.endswith("_pin") and part.name == role


def open_pins(machine: Machine, rng: Rng) -> Machine:
    """Pins are tubes without ends."""

    def change(mesh: Mesh) -> Mesh:
        return _compact(mesh.points, mesh.triangles[np.abs(normals(mesh)[0][:, 2]) < 0.5])

    return with_meshes(machine, change, of=lambda p: is_pin(machine, p))


def loose_pins(machine: Machine, rng: Rng) -> Machine:
    """Pins up to 15 % thinner or thicker than drawn."""
    parts = []
    for part in machine.parts:
        thicker = np.eye(4)
        if is_pin(machine, part):
            thicker[0, 0] = thicker[1, 1] = rng.uniform(0.85, 1.15)
        parts.append((part, thicker))
    return _turned_into_meshes(machine, parts)


def _turned_into_meshes(machine: Machine, changes: list[tuple[Part, Array]]) -> Machine:
    """Parts whose mesh is changed by a (4, 4) matrix in its own frame; their transforms stay."""
    shapes, parts = dict(machine.shapes), []
    for k, (part, matrix) in enumerate(changes):
        if np.array_equal(matrix, np.eye(4)):
            parts.append(part)
            continue
        mesh = machine.shapes[part.shape].mesh
        points = mesh.points @ matrix[:3, :3].T + matrix[:3, 3]
        turned = mesh.triangles if np.linalg.det(matrix[:3, :3]) > 0 else mesh.triangles[:, ::-1]
        key = f"{part.shape}+{k}"
        shapes[key] = replace(machine.shapes[part.shape], key=key, mesh=Mesh(points, np.ascontiguousarray(turned)))
        parts.append(replace(part, shape=key))
    return replace(machine, parts=parts, shapes=shapes)


def duplicate_faces(machine: Machine, rng: Rng) -> Machine:
    """Three triangles of ten are there twice."""

    def change(mesh: Mesh) -> Mesh:
        again = mesh.triangles[rng.random(len(mesh.triangles)) < 0.3]
        return Mesh(mesh.points, np.concatenate([mesh.triangles, again]))

    return with_meshes(machine, change)


def inverted_faces(machine: Machine, rng: Rng) -> Machine:
    """Of four meshes one is inside out, and one has three triangles of ten turned over."""

    def change(mesh: Mesh) -> Mesh:
        draw = rng.random()
        over = np.full(len(mesh.triangles), draw < 0.25)
        if 0.25 <= draw < 0.5:
            over = rng.random(len(mesh.triangles)) < 0.3
        return Mesh(mesh.points, np.where(over[:, None], mesh.triangles[:, ::-1], mesh.triangles))

    return with_meshes(machine, change)


def double_sided(machine: Machine, rng: Rng) -> Machine:
    """Every triangle twice, once for each side, with corners of its own."""

    def change(mesh: Mesh) -> Mesh:
        points = np.concatenate([mesh.points, mesh.points])
        return Mesh(points, np.concatenate([mesh.triangles, mesh.triangles[:, ::-1] + len(mesh.points)]))

    return with_meshes(machine, change)


def scale_slips(machine: Machine, rng: Rng) -> Machine:
    """Every part up to 1 % larger or smaller about the middle of its box."""
    changes = []
    for part in machine.parts:
        points = machine.shapes[part.shape].mesh.points
        factor = 1.0 + float(rng.uniform(-0.01, 0.01))
        matrix = np.diag([factor, factor, factor, 1.0])
        matrix[:3, 3] = (1.0 - factor) * 0.5 * (points.min(axis=0) + points.max(axis=0))
        changes.append(replace(part, transform=part.transform @ matrix))
    return replace(machine, parts=changes)


def _renoded(machine: Machine, matrices: list[Array]) -> Machine:
    """The same machine, its meshes changed by matrices in their own frames and its transforms by the inverse."""
    changed = _turned_into_meshes(machine, list(zip(machine.parts, matrices, strict=True)))
    parts = [
        replace(p, transform=p.transform @ np.linalg.inv(matrix))
        for p, matrix in zip(changed.parts, matrices, strict=True)
    ]
    return replace(changed, parts=parts)


def mirrored(machine: Machine, rng: Rng) -> Machine:
    """Half of the parts are mirrored instances: the same in the world, the determinant of their transform is −1."""
    flip = np.diag([-1.0, 1.0, 1.0, 1.0])
    return _renoded(machine, [flip if rng.random() < 0.5 else np.eye(4) for _ in machine.parts])


def node_scale(machine: Machine, rng: Rng) -> Machine:
    """Meshes in inches, millimetres and whatever, in nodes whose scale makes them metres."""
    factors = rng.choice([1.0, 1000.0, 100.0, 1 / 0.0254, 0.01], size=len(machine.parts))
    return _renoded(machine, [np.diag([f, f, f, 1.0]) for f in factors.tolist()])


def in_unit(factor: float) -> Callable[[Machine, Rng], Machine]:
    """Every number of the file in a unit of which a metre has `factor`, and no word about it."""

    def change(machine: Machine, rng: Rng) -> Machine:
        larger = with_meshes(machine, lambda mesh: Mesh(mesh.points * factor, mesh.triangles))
        parts = []
        for part in larger.parts:
            matrix = part.transform.copy()
            matrix[:3, 3] *= factor
            parts.append(replace(part, transform=matrix))
        frame = machine.frame @ np.diag([1 / factor, 1 / factor, 1 / factor, 1.0])
        return replace(larger, parts=parts, frame=frame)

    return change


def z_fighting(machine: Machine, rng: Rng) -> Machine:
    """A fifth of the parts is there twice, the copy up to 0.2 mm beside it."""
    parts, truth = list(machine.parts), dict(machine.truth)
    for part in machine.parts:
        if rng.random() < 0.2:
            matrix = part.transform.copy()
            matrix[:3, 3] += rng.uniform(-2e-4, 2e-4, size=3)
            parts.append(replace(part, id=f"{part.id}.copy", transform=matrix))
            truth[f"{part.id}.copy"] = machine.truth[part.id]
    return replace(machine, parts=parts, truth=truth)
