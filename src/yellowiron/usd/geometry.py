"""The geometry layer: one prototype a distinct shape and look, its material inside it. Metres, shapes' own frames."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Vt

from yellowiron.model.geometry import Floats, Mesh, Shape
from yellowiron.usd.materials import write_look
from yellowiron.usd.plan import PlacedPart, Plan, Prototype
from yellowiron.usd.stage import Types, add_reference, define, set_attribute, set_display_name

CREASE_ANGLE = np.radians(30.0)
"""Facets that meet at less than this angle are shaded as one smooth surface, where the CAD reader gave no normals."""

MIRRORED = "/Mirrored"


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


def write_mirrored(layer: Sdf.Layer, placed: Iterable[PlacedPart]) -> None:
    """For colliders of mirrored occurrences: the mesh reflected at its own yz plane, so that the collider's transform
    is proper (engines read a negative scale in different ways)."""
    for item in placed:
        path = mirrored_path(item.prototype)
        if layer.GetPrimAtPath(path) is None:
            mesh = item.prototype.shape.mesh
            reflected = Mesh(mesh.points * (-1.0, 1.0, 1.0), mesh.triangles[:, ::-1])
            write_mesh(define(layer, path, "Mesh"), item.prototype.shape, reflected, normals=False)


def mirrored_path(prototype: Prototype) -> str:
    """Where the reflected mesh of a prototype's shape is."""
    return f"{MIRRORED}/{Sdf.Path(prototype.mesh).GetParentPath().name}"


def write_hulls(layer: Sdf.Layer, plan: Plan) -> None:
    """The hull corners of every body relative to its origin, at full precision, for extents and ground contact."""
    for body in plan.mechanism.bodies:
        spec = define(layer, plan.hull_paths[body.name], "Scope")
        corners = np.asarray(body.hull, dtype=np.float64).reshape(-1, 3) - np.asarray(body.origin)
        set_attribute(spec, "yellowiron:points", Types.Double3Array, Vt.Vec3dArray.FromNumpy(corners), custom=True)


def write_mesh(spec: Sdf.PrimSpec, shape: Shape, mesh: Mesh, *, normals: bool = True) -> None:
    """A triangle mesh: points, topology, extent, normals (the reader's, else creased), per-triangle colours."""
    points = mesh.points.astype(np.float32)
    triangles = np.ascontiguousarray(mesh.triangles, dtype=np.int32)
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
    if normals:
        _write_normals(spec, mesh)
        if mesh.triangle_colors is not None:
            colors = Vt.Vec3fArray.FromNumpy(mesh.triangle_colors.astype(np.float32))
            set_attribute(spec, "primvars:displayColor", Types.Color3fArray, colors, interpolation="uniform")


def _write_normals(spec: Sdf.PrimSpec, mesh: Mesh) -> None:
    if mesh.normals is not None:
        values, interpolation = mesh.normals, "vertex"
    else:
        values, interpolation = creased_normals(mesh.points, mesh.triangles), "faceVarying"
    array = Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(values, dtype=np.float32))
    set_attribute(spec, "normals", Types.Normal3fArray, array, interpolation=interpolation)


def creased_normals(points: Floats, triangles: NDArray[np.int32], angle: float = CREASE_ANGLE) -> Floats:
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
    corners = mesh.points[mesh.triangles]
    facet = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    drop = np.abs(facet).argmax(axis=1)
    kept = np.array([[1, 2], [0, 2], [0, 1]])[drop]
    values = np.take_along_axis(corners, np.broadcast_to(kept[:, None, :], (*corners.shape[:2], 2)), axis=2)
    array = Vt.Vec2fArray.FromNumpy(np.ascontiguousarray(values.reshape(-1, 2), dtype=np.float32))
    set_attribute(spec, "primvars:st", Types.TexCoord2fArray, array, interpolation="faceVarying")
