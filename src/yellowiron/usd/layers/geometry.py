"""The geometry layer: one prototype a distinct shape and look, its material inside it. Metres, shapes' own frames."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Vt

from yellowiron.model.geometry import Floats, Ints, Mesh, Shape
from yellowiron.usd.authoring.materials import bind, look_path, write_look
from yellowiron.usd.authoring.merge_points import Singles, distinct, weld
from yellowiron.usd.authoring.stage import (
    Types,
    add_reference,
    define,
    identifier,
    over,
    set_attribute,
    set_display_name,
)
from yellowiron.usd.planning.plan import MESH, PIECE, SOLIDS, PlacedPart, Plan, Prototype

CREASE_ANGLE = np.radians(30.0)
"""Facets that meet at less than this angle are shaded as one smooth surface, where the CAD reader gave no normals."""

MIRRORED, PIECES, MIRRORED_PIECES = "/Mirrored", "/Pieces", "/MirroredPieces"


def write_prototypes(layer: Sdf.Layer, prototypes: Iterable[Prototype], textures: Mapping[str, str]) -> None:
    """Every prototype: an Xform with its mesh and its material. A shape with a second look refers to the first mesh."""
    for prototype in prototypes:
        spec = define(layer, prototype.path, "Xform")
        set_display_name(spec, prototype.shape.name)
        mesh_path = f"{prototype.path}/mesh"
        if prototype.mesh == mesh_path:
            write_mesh(define(layer, mesh_path, "Mesh"), prototype.shape, prototype.shape.mesh)
        else:
            add_reference(define(layer, mesh_path), "", prototype.mesh)
        if prototype.look.texture is not None:
            _write_box_mapping(layer.GetPrimAtPath(mesh_path), prototype.shape.mesh)
        write_look(layer, prototype.path, prototype.look, textures)
        if prototype.look.faces:
            _write_subsets(layer, mesh_path, prototype)


def _write_subsets(layer: Sdf.Layer, mesh_path: str, prototype: Prototype) -> None:
    """The triangles of every look, as subsets of the mesh that are bound to its material."""
    mesh = prototype.shape.mesh
    finishes = mesh.triangle_finishes
    if finishes is None:
        return
    set_attribute(
        over(layer, mesh_path), "subsetFamily:materialBind:familyType", Types.Token, "nonOverlapping", uniform=True
    )
    rows = finishes[weld(mesh)[2]]
    for number, look in enumerate(prototype.look.faces):
        chosen = np.flatnonzero(rows == number).astype(np.int32)
        if not len(chosen):
            continue
        path = look_path(prototype.path, look)
        subset = define(layer, f"{mesh_path}/{identifier(look.name)}", "GeomSubset")
        set_attribute(subset, "elementType", Types.Token, "face", uniform=True)
        set_attribute(subset, "familyName", Types.Token, "materialBind", uniform=True)
        set_attribute(subset, "indices", Types.IntArray, Vt.IntArray.FromNumpy(chosen))
        bind(subset, path)


def write_mirrored(layer: Sdf.Layer, placed: Iterable[PlacedPart]) -> None:
    """For colliders of mirrored occurrences: the mesh reflected at its own yz plane, so that the collider's transform
    is proper (engines read a negative scale in different ways)."""
    for item in placed:
        if layer.GetPrimAtPath(MIRRORED) is None:
            define(layer, MIRRORED, "Scope")
        path = mirrored_path(item.prototype)
        if layer.GetPrimAtPath(path) is None:
            mesh = item.prototype.shape.mesh
            flip = np.array([-1.0, 1.0, 1.0])
            normals = None if mesh.normals is None else mesh.normals * flip
            write_mesh(
                define(layer, path, "Mesh"),
                item.prototype.shape,
                Mesh(mesh.points * flip, mesh.triangles[:, ::-1], normals),
            )


def mirrored_path(prototype: Prototype) -> str:
    """Where the reflected mesh of a prototype's shape is."""
    return f"{MIRRORED}/{_home(prototype)}"


def _home(prototype: Prototype) -> str:
    return str(Sdf.Path(prototype.mesh).GetParentPath().name)


def pieces_path(prototype: Prototype, mirrored: bool) -> str:
    """Where the convex pieces of a prototype's shape are, or those of its mirror image."""
    return f"{MIRRORED_PIECES if mirrored else PIECES}/{_home(prototype)}"


def write_pieces(layer: Sdf.Layer, placed: Iterable[tuple[PlacedPart, bool]]) -> None:
    """Of parts that collide as convex pieces (and whether mirrored): the pieces, and beside them the mesh itself."""
    for item, mirrored in placed:
        path = pieces_path(item.prototype, mirrored)
        if layer.GetPrimAtPath(path) is not None:
            continue
        scope = str(Sdf.Path(path).GetParentPath())
        if layer.GetPrimAtPath(scope) is None:
            define(layer, scope, "Scope")
        define(layer, path, "Xform")
        whole = mirrored_path(item.prototype) if mirrored else item.prototype.mesh
        add_reference(define(layer, f"{path}/{MESH}", "Mesh"), "", whole)
        for number, piece in enumerate(item.pieces, start=1):
            made = Mesh(piece.points * (-1.0, 1.0, 1.0), piece.triangles[:, ::-1]) if mirrored else piece
            write_mesh(define(layer, f"{path}/{PIECE}{number}", "Mesh"), item.prototype.shape, made)


def write_solids(layer: Sdf.Layer, plan: Plan) -> None:
    """The meshes of the colliders that stand for several parts, in their bodies' frames."""
    for by_body in plan.solids.values():
        for solids in by_body.values():
            for solid in solids:
                if solid.data.primitive is None:
                    if layer.GetPrimAtPath(SOLIDS) is None:
                        define(layer, SOLIDS, "Scope")
                    _write_surface(define(layer, solid.path, "Mesh"), solid.data.solid.mesh)


def _write_surface(spec: Sdf.PrimSpec, mesh: Mesh) -> None:
    """A triangle mesh that nobody sees, each triangle flat."""
    points = mesh.points.astype(np.float32)
    set_attribute(spec, "points", Types.Point3fArray, Vt.Vec3fArray.FromNumpy(points))
    counts = np.full(len(mesh.triangles), 3, dtype=np.int32)
    set_attribute(spec, "faceVertexCounts", Types.IntArray, Vt.IntArray.FromNumpy(counts))
    indices = np.ascontiguousarray(mesh.triangles, dtype=np.int32).ravel()
    set_attribute(spec, "faceVertexIndices", Types.IntArray, Vt.IntArray.FromNumpy(indices))
    set_attribute(spec, "subdivisionScheme", Types.Token, "none", uniform=True)
    a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    crossed = np.cross(b - a, c - a)
    flat = crossed / np.maximum(np.linalg.norm(crossed, axis=1, keepdims=True), 1e-12)
    set_attribute(spec, "normals", Types.Normal3fArray, _single(flat), interpolation="uniform")
    extent = Vt.Vec3fArray([Gf.Vec3f(*points.min(axis=0).tolist()), Gf.Vec3f(*points.max(axis=0).tolist())])
    set_attribute(spec, "extent", Types.Float3Array, extent)


def write_hulls(layer: Sdf.Layer, plan: Plan) -> None:
    """The hull corners of every body relative to its origin, at full precision, for extents and ground contact."""
    for body in plan.mechanism.bodies:
        spec = define(layer, plan.hull_paths[body.name], "Scope")
        corners = np.asarray(body.hull, dtype=np.float64).reshape(-1, 3) - np.asarray(body.origin)
        set_attribute(spec, "yellowiron:points", Types.Double3Array, Vt.Vec3dArray.FromNumpy(corners), custom=True)


def write_mesh(spec: Sdf.PrimSpec, shape: Shape, mesh: Mesh) -> None:
    """A triangle mesh: points, topology, extent, normals (the reader's, else creased), per-triangle colours.

    Points that coincide in single precision become one, so that a closed shape is a closed mesh: CAD meshes repeat them
    along every edge between two faces. Triangles that thereby lose a corner are left out.
    """
    points, triangles, kept = weld(mesh)
    set_attribute(spec, "points", Types.Point3fArray, Vt.Vec3fArray.FromNumpy(points))
    counts = np.full(len(triangles), 3, dtype=np.int32)
    set_attribute(spec, "faceVertexCounts", Types.IntArray, Vt.IntArray.FromNumpy(counts))
    set_attribute(spec, "faceVertexIndices", Types.IntArray, Vt.IntArray.FromNumpy(triangles.ravel()))
    set_attribute(spec, "subdivisionScheme", Types.Token, "none", uniform=True)
    if len(points):
        extent = Vt.Vec3fArray([Gf.Vec3f(*points.min(axis=0).tolist()), Gf.Vec3f(*points.max(axis=0).tolist())])
        set_attribute(spec, "extent", Types.Float3Array, extent)
    if not shape.closed:
        set_attribute(spec, "doubleSided", Types.Bool, True, uniform=True)
    if mesh.normals is None:
        values = _single(creased_normals(points, triangles))
        set_attribute(spec, "normals", Types.Normal3fArray, values, interpolation="faceVarying")
    elif len(points) == len(mesh.points):
        set_attribute(spec, "normals", Types.Normal3fArray, _single(mesh.normals), interpolation="vertex")
    else:
        normals, ranks = distinct(mesh.normals)
        indices = ranks[mesh.triangles[kept]]
        _write_indexed(spec, "normals", Types.Normal3fArray, Vt.Vec3fArray.FromNumpy(normals), indices)
    if mesh.uvs is not None:
        _write_coordinates(spec, mesh.uvs[kept].reshape(-1, 2))
    if mesh.triangle_colors is not None:
        colors = _single(mesh.triangle_colors[kept])
        set_attribute(spec, "primvars:displayColor", Types.Color3fArray, colors, interpolation="uniform")


def _single(values: Floats) -> Vt.Vec3fArray:
    return Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(values, dtype=np.float32))


def _write_indexed(
    spec: Sdf.PrimSpec, name: str, type_name: Sdf.ValueTypeName, values: Any, indices: NDArray[np.int32]
) -> None:
    """A face-varying primvar with its indices, one a corner."""
    set_attribute(spec, f"primvars:{name}", type_name, values, interpolation="faceVarying")
    array = Vt.IntArray.FromNumpy(np.ascontiguousarray(indices, dtype=np.int32).ravel())
    set_attribute(spec, f"primvars:{name}:indices", Types.IntArray, array)


def creased_normals(points: Floats | Singles, triangles: Ints, angle: float = CREASE_ANGLE) -> Floats:
    """(3m, 3) unit normals, one a corner: the area-weighted mean of the facets around the corner's point that lie
    within `angle` (radians) of the corner's own facet. A facet without area gets its neighbours' mean, else +Z."""
    corners = points[triangles]
    facet = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(facet, axis=1, keepdims=True)
    unit = np.divide(facet, size, out=np.zeros_like(facet), where=size > 0.0)
    # All ordered pairs of corners that share a point: corners sorted by point, each group's members times its size.
    flat = triangles.ravel()
    order = np.argsort(flat, kind="stable")
    _, starts, counts = np.unique(flat[order], return_index=True, return_counts=True)
    group = np.repeat(np.arange(len(counts)), counts)
    repeat = counts[group]
    first = np.repeat(order, repeat)
    within = np.arange(len(first)) - np.repeat(np.cumsum(repeat) - repeat, repeat)
    second = order[np.repeat(starts[group], repeat) + within]
    smooth = np.einsum("ij,ij->i", unit[first // 3], unit[second // 3]) >= np.cos(angle)
    lonely = size[first // 3, 0] <= 0.0
    keep = smooth | lonely
    total = np.zeros((len(flat), 3))
    np.add.at(total, first[keep], facet[second[keep] // 3])
    length = np.linalg.norm(total, axis=1, keepdims=True)
    up = np.broadcast_to(np.array([0.0, 0.0, 1.0]), total.shape).copy()
    return np.divide(total, length, out=up, where=length > 0.0)


def _write_box_mapping(spec: Sdf.PrimSpec, mesh: Mesh) -> None:
    """Texture coordinates by projection along each facet's largest normal component; one repeat a metre."""
    points, triangles, _ = weld(mesh)
    corners = points[triangles]
    facet = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    drop = np.abs(facet).argmax(axis=1)
    kept = np.array([[1, 2], [0, 2], [0, 1]])[drop]
    values = np.take_along_axis(corners, np.broadcast_to(kept[:, None, :], (*corners.shape[:2], 2)), axis=2)
    _write_coordinates(spec, values.reshape(-1, 2))


def _write_coordinates(spec: Sdf.PrimSpec, values: Floats | Singles) -> None:
    """Texture coordinates (3m, 2), one a corner, in place of any that are there."""
    for name in ("primvars:st", "primvars:st:indices"):
        if name in spec.attributes:
            spec.RemoveProperty(spec.attributes[name])
    unique, indices = np.unique(values.astype(np.float32), axis=0, return_inverse=True)
    array = Vt.Vec2fArray.FromNumpy(np.ascontiguousarray(unique, dtype=np.float32))
    _write_indexed(spec, "st", Types.TexCoord2fArray, array, indices.astype(np.int32))
