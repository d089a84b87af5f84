"""The same machine in another file: what a stranger may have done to a real model without making another machine of it.

    shaken(scene, "turned", up)      # the scene, turned in its file; its truth with it

A reading that does not stand such a change was right by luck. Nothing of a model is kept.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import trimesh

from kit.machines.solids import Array
from kit.scene import Scene, Surface, centres_of
from strangers_renamed import half_named, other_sides, otherwise_named
from yellowiron.alignment import twin_role
from yellowiron.alignment.square import turned
from yellowiron.cad.mesh import measures
from yellowiron.cad.mesh.assembly import Occurrence, assemble
from yellowiron.cad.mesh.shells import components
from yellowiron.model.assembly import Part
from yellowiron.model.geometry import Mesh

ASKEW_DEG = 37.0
SCALE = 0.37
LOOSE, LOOSE_DEG = 0.001, 0.25
"""By how much each part is moved, of the machine's height, and turned."""
SMALL = 0.001
"""Shells of less than this share of the surface are bolts, pins and clamps."""
LARGE, GONE = 0.01, 0.2
"""Of the shells smaller than this share of the surface so many are not drawn."""


@dataclass(frozen=True, eq=False)
class Piece:
    """A part or a shell of one: its mesh in the CAD frame, and the label of each triangle."""

    part: Part
    mesh: Mesh
    label: Array


def shaken(scene: Scene, how: str, up: Array) -> Scene:
    """A scene after one of `SHAKES`; `up` (3,) in the CAD frame."""
    return SHAKES[how](scene, up)


def _turned(scene: Scene, up: Array) -> Scene:
    """At an angle in its file, beside the origin."""
    whole = trimesh.transformations.rotation_matrix(np.radians(ASKEW_DEG), up)
    rotation, away = whole[:3, :3], np.array([0.7, 1.4, 2.1]) * scene.height
    assembly = turned(scene.assembly, rotation)
    move = np.eye(4)
    move[:3, 3] = away
    assembly = replace(
        assembly,
        parts=tuple(replace(p, transform=move @ p.transform) for p in assembly.parts),
        nodes=tuple(replace(n, transform=move @ n.transform) for n in assembly.nodes),
        joints=tuple(replace(j, anchor=tuple(np.array(j.anchor) + away)) for j in assembly.joints),
    )
    joints = tuple(
        replace(j, point=tuple(rotation @ j.point + away), axis=tuple(rotation @ j.axis)) for j in scene.joints
    )
    truth = replace(scene.truth, points=scene.truth.points @ rotation.T + away)
    return replace(scene, assembly=assembly, truth=truth, joints=joints)


def _scaled(scene: Scene, up: Array) -> Scene:
    """In a unit of nobody's."""
    sized = [
        replace(piece, mesh=replace(piece.mesh, points=SCALE * piece.mesh.points, normals=None))
        for piece in _pieces(scene)
    ]
    joints = tuple(
        replace(
            j, point=tuple(SCALE * np.array(j.point)), tolerance=None if j.tolerance is None else SCALE * j.tolerance
        )
        for j in scene.joints
    )
    nodes = tuple(replace(n, transform=_sized(n.transform)) for n in scene.assembly.nodes)
    assembly = replace(scene.assembly, nodes=nodes)
    return _drawn(replace(scene, assembly=assembly, joints=joints, height=SCALE * scene.height), sized)


def _sized(transform: Array) -> Array:
    found = transform.copy()
    found[:3, 3] *= SCALE
    return found


def _reversed(scene: Scene, up: Array) -> Scene:
    """Its parts the other way round in the file."""
    return _drawn(scene, list(_pieces(scene))[::-1])


def _loose(scene: Scene, up: Array) -> Scene:
    """Every part a little out of its place."""
    rng = np.random.default_rng(5)
    moved = []
    for piece in _pieces(scene):
        middle = 0.5 * (piece.mesh.points.min(axis=0) + piece.mesh.points.max(axis=0))
        rotation = trimesh.transformations.rotation_matrix(np.radians(LOOSE_DEG), rng.normal(size=3))[:3, :3]
        points = (piece.mesh.points - middle) @ rotation.T + middle + rng.normal(size=3) * LOOSE * scene.height
        moved.append(replace(piece, mesh=replace(piece.mesh, points=points, normals=None)))
    return _drawn(scene, moved)


def _bare(scene: Scene, up: Array) -> Scene:
    """Without its bolts, pins and clamps."""
    least = SMALL * float(scene.truth.areas.sum())
    return _drawn(scene, _with_shells(scene, lambda area: area > least))


def _thinned(scene: Scene, up: Array) -> Scene:
    """Without a fifth of what is small, whatever it is."""
    rng, large = np.random.default_rng(5), LARGE * float(scene.truth.areas.sum())
    return _drawn(scene, _with_shells(scene, lambda area: area > large or rng.random() > GONE))


def _one_mesh(scene: Scene, up: Array) -> Scene:
    """All of it one nameless mesh."""
    pieces = list(_pieces(scene))
    first = np.cumsum([0, *(len(p.mesh.points) for p in pieces)])
    points = np.concatenate([p.mesh.points for p in pieces])
    triangles = np.concatenate([p.mesh.triangles + k for p, k in zip(pieces, first, strict=False)])
    whole = replace(pieces[0].part, id="Object", name="Object", path=(), node=None)
    label = np.concatenate([p.label for p in pieces])
    return _drawn(scene, [Piece(whole, Mesh(points, triangles.astype(np.int32)), label)], whole=False)


def _shells(scene: Scene, up: Array) -> Scene:
    """Every shell a nameless mesh by itself."""
    count = iter(range(1_000_000))
    found = []
    for piece in _pieces(scene):
        for rows in _shells_of(piece.mesh):
            part = replace(piece.part, name=f"Object_{next(count):04d}", path=(), node=None)
            found.append(Piece(part, _some(piece.mesh, rows), piece.label[rows]))
    return _drawn(scene, found, whole=False)


def _mirrored(scene: Scene, up: Array) -> Scene:
    """Its own mirror image: what was left is right, and is called so."""
    across = int(np.argmin(np.abs(up)))
    mirror = np.eye(4)
    mirror[across, across] = -1.0
    sign = np.diag(mirror)[:3]
    pieces = [
        replace(piece, mesh=Mesh(sign * piece.mesh.points, piece.mesh.triangles[:, ::-1])) for piece in _pieces(scene)
    ]
    nodes = tuple(replace(n, transform=mirror @ n.transform @ mirror) for n in scene.assembly.nodes)
    joints = tuple(
        replace(
            j, point=tuple(sign * j.point), axis=tuple(sign * j.axis), bodies=tuple(_twin(b) for b in j.bodies),
            others=tuple(tuple(_twin(b) for b in end) for end in j.others),
        )
        for j in scene.joints
    )  # fmt: skip
    labels = tuple((_twin(role), "|".join(_twin(b) for b in body.split("|"))) for role, body in scene.truth.labels)
    assembly = replace(scene.assembly, nodes=nodes)
    truth = replace(scene.truth, labels=labels)
    return other_sides(_drawn(replace(scene, assembly=assembly, joints=joints, truth=truth), pieces))


def _twin(name: str) -> str:
    return twin_role(name) or name


def _half_named(scene: Scene, up: Array) -> Scene:
    """Half of its names lost."""
    return half_named(scene)


def _otherwise_named(scene: Scene, up: Array) -> Scene:
    """Its names in other spellings."""
    return otherwise_named(scene)


SHAKES: dict[str, Callable[[Scene, Array], Scene]] = {
    "turned": _turned, "scaled": _scaled, "reversed": _reversed, "loose": _loose, "bare": _bare, "thinned": _thinned,
    "one mesh": _one_mesh, "shells": _shells, "mirrored": _mirrored, "half named": _half_named,
    "other names": _otherwise_named,
}  # fmt: skip


def _pieces(scene: Scene) -> Iterator[Piece]:
    first = 0
    for part in scene.assembly.parts:
        mesh = Mesh(scene.assembly.points_of(part), scene.assembly.shape_of(part).mesh.triangles)
        yield Piece(part, mesh, scene.truth.label[first : first + len(mesh.triangles)])
        first += len(mesh.triangles)


def _shells_of(mesh: Mesh) -> list[Array]:
    label = components(mesh, measures.welded(mesh))
    return [np.flatnonzero(label == k) for k in np.unique(label)]


def _with_shells(scene: Scene, keep: Callable[[float], bool]) -> list[Piece]:
    """The pieces with those of their shells whose area is to be kept."""
    found = []
    for piece in _pieces(scene):
        areas = centres_of(piece.mesh)[1]
        kept = [rows for rows in _shells_of(piece.mesh) if keep(float(areas[rows].sum()))]
        if kept:
            rows = np.sort(np.concatenate(kept))
            found.append(Piece(piece.part, _some(piece.mesh, rows), piece.label[rows]))
    return found


def _some(mesh: Mesh, rows: Array) -> Mesh:
    used, triangles = np.unique(mesh.triangles[rows], return_inverse=True)
    return Mesh(mesh.points[used], triangles.reshape(-1, 3).astype(np.int32))


def _drawn(scene: Scene, pieces: Sequence[Piece], *, whole: bool = True) -> Scene:
    """A scene of these pieces as a file of triangles in single precision gives them; `whole`: each is a part of the
    scene before, or what is left of one."""
    single = [replace(p.mesh, points=p.mesh.points.astype(np.float32).astype(np.float64)) for p in pieces]
    nodes = scene.assembly.nodes if whole else ()
    placed = [
        Occurrence(p.part.name, p.part.path, mesh, np.eye(4), p.part.color, (), p.part.node)
        for p, mesh in zip(pieces, single, strict=True)
    ]
    assembly = assemble(
        placed, name="machine", format="shaken", unit=scene.assembly.unit, path="machine.glb", nodes=nodes
    )
    centres, areas = zip(*(centres_of(mesh) for mesh in single), strict=True)
    ids = {part.id for part in assembly.parts}
    truth = Surface(
        np.concatenate(centres), np.concatenate(areas), np.concatenate([p.label for p in pieces]), scene.truth.labels,
        {part: labels for part, labels in scene.truth.whole.items() if part in ids} if whole else {},
        scene.truth.ties if whole else {},
    )  # fmt: skip
    return replace(scene, assembly=assembly, truth=truth)
