"""The physics layer: UsdPhysics opinions over the base layer, and nothing that belongs to one engine."""

from __future__ import annotations

import numpy as np
from pxr import Gf, Sdf

from yellowiron.model.mechanism import Body, chained, rolling
from yellowiron.usd.authoring.materials import write_physics_material
from yellowiron.usd.authoring.rotation import principal_axes
from yellowiron.usd.authoring.stage import Types, apply_schemas, define, over, set_attribute, set_targets
from yellowiron.usd.layers.articulation import articulation_roots
from yellowiron.usd.layers.base import shape_path, solid_paths
from yellowiron.usd.layers.joints import write_joints
from yellowiron.usd.planning.overlap import overlapping_bodies
from yellowiron.usd.planning.pin_links import write_pin_links
from yellowiron.usd.planning.plan import COLLIDERS, MATERIALS, MESH, PIECE, PlacedPart, Plan


def write_physics(layer: Sdf.Layer, base: Sdf.Layer, plan: Plan) -> None:
    """Articulation root, rigid bodies with mass, colliders, materials, joints and filtered pairs. `base` tells which
    colliders are meshes."""
    if plan.material_paths:
        define(layer, f"{plan.root}/{MATERIALS}", "Scope")
        for name, path in plan.material_paths.items():
            write_physics_material(layer, path, plan.mechanism.materials[name])
    for body in plan.mechanism.bodies:
        spec = over(layer, plan.body_paths[body.name])
        apply_schemas(spec, "PhysicsRigidBodyAPI", "PhysicsMassAPI")
        write_mass(spec, body)
        for placed in plan.parts[body.name]:
            if placed.collides:
                _write_collider(layer, base, f"{spec.path}/{COLLIDERS}/{placed.name}", placed, plan)
        for path, solid in solid_paths(plan, body.name):
            write_touching(over(layer, path), solid.data.material, plan)
            if solid.data.primitive is None:
                _write_approximation(over(layer, path), "convexHull")
        for shape in body.shapes:
            write_touching(over(layer, shape_path(str(spec.path), shape)), shape.material, plan)
    _write_filtered_pairs(layer, plan)
    write_joints(layer, plan)
    write_pin_links(layer, plan.pin_links, plan.mechanism, plan.body_paths)
    for spec in articulation_roots(layer, plan):
        apply_schemas(spec, "PhysicsArticulationRootAPI")


def write_mass(spec: Sdf.PrimSpec, body: Body) -> None:
    """Explicit mass properties: nothing is left to a collider's volume. In the body's frame, kg and kg·m²."""
    moments, axes = principal_axes(np.asarray(body.inertia, dtype=np.float64))
    center = np.asarray(body.center_of_mass) - np.asarray(body.origin)
    set_attribute(spec, "physics:mass", Types.Float, float(body.mass))
    set_attribute(spec, "physics:centerOfMass", Types.Point3f, Gf.Vec3f(*center.tolist()))
    set_attribute(spec, "physics:diagonalInertia", Types.Float3, Gf.Vec3f(*moments))
    set_attribute(spec, "physics:principalAxes", Types.Quatf, Gf.Quatf(Gf.Quatd(*axes)))


def _write_collider(layer: Sdf.Layer, base: Sdf.Layer, path: str, placed: PlacedPart, plan: Plan) -> None:
    """A collider with its approximation. Of one in pieces each piece collides as its hull, in every engine alike; the
    part's own mesh says what was asked for, and collides only for who applies `PhysicsCollisionAPI` to it."""
    if placed.pieces:
        _write_approximation(over(layer, f"{path}/{MESH}"), placed.approximation.usd)
    for piece in [f"{path}/{PIECE}{n}" for n in range(1, len(placed.pieces) + 1)] or [path]:
        spec = over(layer, piece)
        write_touching(spec, placed.data.material, plan)
        if placed.pieces or base.GetPrimAtPath(path).typeName == "Mesh":
            _write_approximation(spec, "convexHull" if placed.pieces else placed.approximation.usd)


def write_touching(spec: Sdf.PrimSpec, material: str, plan: Plan) -> None:
    """A collider, of a material where one is named."""
    apply_schemas(spec, "PhysicsCollisionAPI")
    path = plan.material_paths.get(material)
    if path is not None:
        apply_schemas(spec, "MaterialBindingAPI")
        set_targets(spec, "material:binding:physics", path)


def _write_approximation(spec: Sdf.PrimSpec, token: str) -> None:
    apply_schemas(spec, "PhysicsMeshCollisionAPI")
    if token != "none":
        set_attribute(spec, "physics:approximation", Types.Token, token, uniform=True)


def filtered_pairs(plan: Plan) -> dict[str, list[str]]:
    """Body → the bodies after it that it must not collide with: those it is jointed to, and those it overlaps in the
    drawn pose; but a track's shoes lie against the wheels that it runs on."""
    order = {body.name: index for index, body in enumerate(plan.mechanism.bodies)}
    pairs = {tuple(sorted((j.body0, j.body1), key=order.__getitem__)) for j in plan.mechanism.joints}
    loose = chained(plan.mechanism)
    wheels = rolling(plan.mechanism)
    pairs |= {
        (a, b)
        for a, b in overlapping_bodies(plan)
        if not ((a in loose and b in wheels) or (a in wheels and b in loose))
    }
    filtered: dict[str, list[str]] = {}
    for first, second in sorted(pairs, key=lambda p: (order[p[0]], order[p[1]])):
        filtered.setdefault(first, []).append(second)
    return filtered


def _write_filtered_pairs(layer: Sdf.Layer, plan: Plan) -> None:
    for body, others in filtered_pairs(plan).items():
        spec = over(layer, plan.body_paths[body])
        apply_schemas(spec, "PhysicsFilteredPairsAPI")
        set_targets(spec, "physics:filteredPairs", *(plan.body_paths[other] for other in others))
