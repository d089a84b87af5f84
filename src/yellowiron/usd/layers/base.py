"""The base layer: bodies as a flat list of Xforms with their visuals, collider shapes and sites; no physics."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Vt

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, BodyShape, Site
from yellowiron.support.record import DETAIL, DETAILS
from yellowiron.usd.authoring.metadata import describe_body, describe_collider, describe_part, describe_site, set_custom
from yellowiron.usd.authoring.rotation import quaternion_of
from yellowiron.usd.authoring.stage import (
    Types,
    add_reference,
    declare_variants,
    define,
    identifier,
    over,
    set_attribute,
    set_display_name,
    set_placement,
    set_transform,
)
from yellowiron.usd.layers.geometry import mirrored_path, pieces_path
from yellowiron.usd.planning.pin_links import write_pin_frames
from yellowiron.usd.planning.plan import (
    COLLIDERS,
    GEOMETRY_FILE,
    HULL,
    VISUALS,
    PlacedPart,
    Plan,
    Solid,
)
from yellowiron.usd.planning.primitives import Primitive, fit_primitive

SITE_RADIUS = 0.02
"""Of the ball that marks a site, metres."""

_PRIMITIVE_TYPES = {"cylinder": "Cylinder", "capsule": "Capsule", "box": "Cube", "sphere": "Sphere"}


def write_bodies(layer: Sdf.Layer, plan: Plan) -> None:
    """Every body under the machine's prim: its frame at the body's origin, axes parallel to the machine's."""
    define(layer, plan.root, "Xform")
    primitives = functools.cache(fit_primitive)
    sites: dict[str, list[Site]] = {}
    for site in plan.mechanism.sites:
        sites.setdefault(site.body, []).append(site)
    for body in plan.mechanism.bodies:
        path = plan.body_paths[body.name]
        spec = define(layer, path, "Xform")
        set_display_name(spec, body.name)
        set_placement(spec, body.origin)
        set_custom(spec, describe_body(body))
        _write_visuals(layer, path, plan.parts[body.name])
        _write_colliders(layer, path, plan.parts[body.name], primitives)
        _write_shapes(layer, path, body)
        _write_solids(layer, plan, body.name)
        if len(body.hull):
            add_reference(define(layer, f"{path}/{HULL}"), f"./{GEOMETRY_FILE}", plan.hull_paths[body.name])
        for site in sites.get(body.name, ()):
            write_site(layer, plan.site_paths[site.name], site, body)
    write_pin_frames(layer, plan.pin_links)


def _write_solids(layer: Sdf.Layer, plan: Plan, body: str) -> None:
    """The colliders that stand for several parts, each in its variant; in that of what is seen alone, none is active.
    The machine's file selects."""
    scope = f"{plan.body_paths[body]}/{COLLIDERS}"
    found = list(solid_paths(plan, body))
    if found:
        collider_scope(layer, plan.body_paths[body])
    if layer.GetPrimAtPath(scope) is None:
        return
    declare_variants(over(layer, plan.root), DETAIL, DETAILS)
    for path, solid in found:
        if solid.data.primitive is not None:
            write_primitive(layer, path, solid.data.primitive)
        else:
            add_reference(define(layer, path, "Mesh"), f"./{GEOMETRY_FILE}", solid.path)
        set_custom(over(layer, path), describe_collider(solid.data.parts))
    over(layer, in_detail(plan, "visual", scope)).SetInfo("active", False)


def solid_paths(plan: Plan, body: str) -> Iterator[tuple[str, Solid]]:
    """The prims of a body's colliders that stand for several parts, inside the variants that they are of."""
    for detail, solids in plan.solids.items():
        for solid in solids[body]:
            yield in_detail(plan, detail, f"{plan.body_paths[body]}/{COLLIDERS}/{solid.name}"), solid


def in_detail(plan: Plan, detail: str, path: str) -> str:
    """A path under the machine's prim, inside that variant of `Detail`."""
    return f"{plan.root}{{{DETAIL}={detail}}}{path[len(plan.root) + 1 :]}"


def _write_visuals(layer: Sdf.Layer, body: str, parts: tuple[PlacedPart, ...]) -> None:
    """Instanceable references to the prototypes; each says which CAD part it is."""
    define(layer, f"{body}/{VISUALS}", "Scope")
    for placed in parts:
        spec = define(layer, f"{body}/{VISUALS}/{placed.name}", "Xform")
        set_display_name(spec, placed.part.name)
        set_transform(spec, placed.matrix)
        spec.SetInfo("instanceable", True)
        add_reference(spec, f"./{GEOMETRY_FILE}", placed.prototype.path)
        set_custom(spec, describe_part(placed.data))


def _write_colliders(
    layer: Sdf.Layer, body: str, parts: tuple[PlacedPart, ...], primitives: functools._lru_cache_wrapper[Any]
) -> None:
    """Colliders of parts by themselves: analytic ones as their own prims, the others as references to meshes."""
    colliding = [placed for placed in parts if placed.collides]
    if not colliding:
        return
    collider_scope(layer, body)
    for placed in colliding:
        path = f"{body}/{COLLIDERS}/{placed.name}"
        primitive = None
        if placed.approximation.token == "analytic" and (fitted := primitives(placed.prototype.shape)) is not None:
            primitive = fitted.placed(placed.matrix)
        if primitive is not None:
            write_primitive(layer, path, primitive)
        else:
            _write_mesh_collider(layer, path, placed)


def collider_scope(layer: Sdf.Layer, body: str) -> None:
    """The scope of a body's colliders, hidden as guides."""
    if layer.GetPrimAtPath(f"{body}/{COLLIDERS}") is None:
        scope = define(layer, f"{body}/{COLLIDERS}", "Scope")
        set_attribute(scope, "purpose", Types.Token, "guide", uniform=True)


def _write_shapes(layer: Sdf.Layer, path: str, body: Body) -> None:
    """A body's own colliders, which no CAD part has: balls and boxes."""
    if not body.shapes:
        return
    collider_scope(layer, path)
    for shape in body.shapes:
        primitive = Primitive.of(shape)
        own = replace(primitive, center=primitive.center - np.asarray(body.origin))
        write_primitive(layer, shape_path(path, shape), own)


def shape_path(body: str, shape: BodyShape) -> str:
    """The prim of a body's own collider."""
    return f"{body}/{COLLIDERS}/{identifier(shape.name)}"


def is_mirrored(matrix: Floats) -> bool:
    """Whether a transform turns a right hand into a left one."""
    return _determinant(matrix) < 0.0


def _determinant(matrix: Floats) -> float:
    a, b, c = matrix[:3, :3].tolist()
    return float(
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def _write_mesh_collider(layer: Sdf.Layer, path: str, placed: PlacedPart) -> None:
    """The part's mesh, or a group of its pieces. Of a mirrored part the mirror image, so that no transform reflects."""
    spec = define(layer, path, "Xform" if placed.pieces else "Mesh")
    mirrored = is_mirrored(placed.matrix)
    if placed.pieces:
        source = pieces_path(placed.prototype, mirrored)
    else:
        source = mirrored_path(placed.prototype) if mirrored else placed.prototype.mesh
    add_reference(spec, f"./{GEOMETRY_FILE}", source)
    set_transform(spec, placed.matrix @ np.diag([-1.0, 1.0, 1.0, 1.0]) if mirrored else placed.matrix)


def write_primitive(layer: Sdf.Layer, path: str, primitive: Primitive) -> None:
    """An analytic collider in its body's frame."""
    spec = define(layer, path, _PRIMITIVE_TYPES[primitive.kind])
    center, size = primitive.center, primitive.size
    quaternion = quaternion_of(primitive.rotation) if primitive.kind != "sphere" else None
    if primitive.kind == "box":
        set_attribute(spec, "size", Types.Double, 1.0)
        set_placement(spec, center, quaternion, (size[0], size[1], size[2]))
        half = (0.5, 0.5, 0.5)
    else:
        set_attribute(spec, "radius", Types.Double, size[0])
        half = (size[0], size[0], size[0])
        if primitive.kind != "sphere":
            set_attribute(spec, "height", Types.Double, size[1])
            half = (size[0], size[0], 0.5 * size[1] + (size[0] if primitive.kind == "capsule" else 0.0))
        set_placement(spec, center, quaternion)
    extent = Vt.Vec3fArray([Gf.Vec3f(*(-h for h in half)), Gf.Vec3f(*half)])
    set_attribute(spec, "extent", Types.Float3Array, extent)


def write_site(layer: Sdf.Layer, path: str, site: Site, body: Body) -> None:
    """A named frame: a small ball among the guides, since Newton takes only a Gprim for a site."""
    spec = define(layer, path, "Sphere")
    set_display_name(spec, site.name)
    set_attribute(spec, "purpose", Types.Token, "guide", uniform=True)
    set_attribute(spec, "radius", Types.Double, SITE_RADIUS)
    half = Gf.Vec3f(SITE_RADIUS)
    set_attribute(spec, "extent", Types.Float3Array, Vt.Vec3fArray([-half, half]))
    x, z = np.asarray(site.x_axis), np.asarray(site.z_axis)
    rotation = np.column_stack([x, np.cross(z, x), z])
    set_placement(spec, np.asarray(site.position) - np.asarray(body.origin), quaternion_of(rotation))
    set_custom(spec, describe_site(site))
