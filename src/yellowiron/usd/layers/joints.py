"""Joints: UsdPhysics prims whose two frames agree in the drawn pose, axis token X with both rotations carrying it."""

from __future__ import annotations

import math

import numpy as np
from pxr import Gf, Sdf

from yellowiron.model.errors import MechanismError
from yellowiron.model.mechanism import Joint, chained
from yellowiron.support.text import with_article
from yellowiron.usd.authoring.metadata import describe_joint, set_custom
from yellowiron.usd.authoring.rotation import quaternion_to
from yellowiron.usd.authoring.stage import (
    Types,
    declare_variants,
    define,
    over,
    set_attribute,
    set_display_name,
    set_targets,
)
from yellowiron.usd.layers.articulation import BASES
from yellowiron.usd.layers.drives import INSTANCES, to_usd_unit, write_drive, write_rest, write_spring
from yellowiron.usd.planning.plan import BASE_JOINT, JOINTS, Plan

PRIM_TYPES = {
    "fixed": "PhysicsFixedJoint",
    "distance": "PhysicsDistanceJoint",
    "spherical": "PhysicsSphericalJoint",
    "revolute": "PhysicsRevoluteJoint",
    "prismatic": "PhysicsPrismaticJoint",
}


def usd_type(joint: Joint) -> str:
    """The type a joint is written as: its own, but a cut pivot is spherical (a revolute cut becomes two soft connects
    in Newton; PhysX and MuJoCo do not mind). Its modelled type stays in `customData`."""
    return "spherical" if joint.cut and joint.type == "revolute" else joint.type


def write_joints(layer: Sdf.Layer, plan: Plan) -> None:
    """Every joint in the joints scope, and the joint to the world that variant Base=fixed has."""
    define(layer, f"{plan.root}/{JOINTS}", "Scope")
    loose = chained(plan.mechanism)
    for joint in plan.mechanism.joints:
        floating = joint.body0 in loose
        spec = define(layer, plan.joint_paths[joint.name], PRIM_TYPES[usd_type(joint)])
        set_display_name(spec, joint.name)
        _write_frames(spec, joint, plan)
        _write_limits(spec, joint)
        if joint.cut or floating:
            set_attribute(spec, "physics:excludeFromArticulation", Types.Bool, True, uniform=True)
        if joint.drive is not None and not joint.cut:
            if joint.type not in INSTANCES:
                raise MechanismError(
                    f"{with_article(joint.type).capitalize()} joint cannot be driven",
                    where=joint.name,
                    hint="Drive a revolute or prismatic one.",
                )
            write_drive(spec, joint, joint.drive)
        if joint.spring is not None and not joint.cut:
            write_spring(spec, joint, joint.spring)
        set_custom(spec, describe_joint(joint, floating=floating))
    _write_base_joint(layer, plan)
    _write_rests(layer, plan)


def _write_rests(layer: Sdf.Layer, plan: Plan) -> None:
    """Where springs rest. What holds a machine as drawn carries less where its root is fixed: each variant of `Base`
    has a rest of its own."""
    sprung = [(joint, joint.spring) for joint in plan.mechanism.joints if joint.spring is not None and not joint.cut]
    if sprung:
        declare_variants(over(layer, plan.root), "Base", BASES)
    for joint, spring in sprung:
        below = plan.joint_paths[joint.name][len(plan.root) + 1 :]
        for base in BASES:
            write_rest(over(layer, f"{plan.root}{{Base={base}}}{below}"), joint, spring.rest_of(base))


def _write_frames(spec: Sdf.PrimSpec, joint: Joint, plan: Plan) -> None:
    """Body relationships and local frames. Bodies' axes are parallel to the machine's, so one rotation serves both."""
    rotation = Gf.Quatf(Gf.Quatd(*quaternion_to(joint.axis)))
    ends = {link.side: link for link in plan.pin_links if link.joint is joint}
    for side, name in enumerate((joint.body0, joint.body1)):
        set_targets(spec, f"physics:body{side}", ends[side].path if side in ends else plan.body_paths[name])
        origin = joint.anchor if side in ends else plan.mechanism.body(name).origin
        offset = np.asarray(joint.anchor) - np.asarray(origin)
        local = Gf.Vec3f(*offset.tolist())
        if local != Gf.Vec3f(0.0):
            set_attribute(spec, f"physics:localPos{side}", Types.Point3f, local)
        if rotation != Gf.Quatf(1.0):
            set_attribute(spec, f"physics:localRot{side}", Types.Quatf, rotation)


def _write_limits(spec: Sdf.PrimSpec, joint: Joint) -> None:
    """Limits in USD's units: degrees for pivots. A ball's upper limit is its cone's half angle about the axis, a
    distance joint's limits are its least and greatest distance."""
    written = usd_type(joint)
    if written == "spherical" and joint.type == "spherical" and joint.upper is not None:
        for cone in ("coneAngle0Limit", "coneAngle1Limit"):
            set_attribute(spec, f"physics:{cone}", Types.Float, math.degrees(joint.upper))
    names = {
        "distance": ("physics:minDistance", "physics:maxDistance"),
        "revolute": ("physics:lowerLimit", "physics:upperLimit"),
        "prismatic": ("physics:lowerLimit", "physics:upperLimit"),
    }.get(written)
    if names is not None:
        for name, value in zip(names, (joint.lower, joint.upper), strict=True):
            if value is not None:
                set_attribute(spec, name, Types.Float, float(value) * to_usd_unit(joint.type))


def _write_base_joint(layer: Sdf.Layer, plan: Plan) -> None:
    """Fixes the root body to the world where the machine stands: no body0 is the world. It holds the root at the
    machine's origin, so it is written in the machine's own frame: the machine's prim is body0."""
    mechanism = plan.mechanism
    spec = define(layer, f"{plan.root}{{Base=fixed}}{JOINTS}/{BASE_JOINT}", "PhysicsFixedJoint")
    set_targets(spec, "physics:body0", plan.root)
    set_targets(spec, "physics:body1", plan.body_paths[mechanism.root])
    origin = Gf.Vec3f(*map(float, mechanism.body(mechanism.root).origin))
    if origin != Gf.Vec3f(0.0):
        set_attribute(spec, "physics:localPos0", Types.Point3f, origin)
