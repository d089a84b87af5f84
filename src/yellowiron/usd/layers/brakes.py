"""Parking brakes, in a variant set of the machine: what holds the joints that motors turn, as strong as they are, and
the pads that tracks are then."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from pxr import Sdf, Vt

from yellowiron.model.mechanism import Body, Mechanism
from yellowiron.support.record import BRAKE_GIVES
from yellowiron.usd.authoring.stage import Types, apply_schemas, declare_variants, over, set_attribute
from yellowiron.usd.layers.base import collider_scope, shape_path, write_primitive
from yellowiron.usd.layers.drives import INSTANCES, per_usd_unit
from yellowiron.usd.layers.mujoco import SOLIMP, SOLREF
from yellowiron.usd.layers.physics import write_touching
from yellowiron.usd.planning.plan import Plan
from yellowiron.usd.planning.primitives import Primitive

BRAKES = ("released", "set")
"""Variants of the set `Brakes`, the first of them the one that a machine file selects."""


def has_brakes(mechanism: Mechanism) -> bool:
    """Whether a motor of the machine has a parking brake."""
    return any(joint.drive is not None and joint.drive.brake > 0.0 for joint in mechanism.joints)


def write_brakes(layer: Sdf.Layer, plan: Plan, engine: str) -> None:
    """What holds the joints while the brakes are set, in the words of `physx` or `newton`: N·m."""
    if not has_brakes(plan.mechanism):
        return
    declare_variants(over(layer, plan.root), "Brakes", BRAKES)
    for joint in plan.mechanism.joints:
        if joint.drive is None or not joint.drive.brake > 0.0:
            continue
        below = plan.joint_paths[joint.name][len(plan.root) + 1 :]
        spec = over(layer, f"{plan.root}{{Brakes=set}}{below}")
        {"newton": _newton, "physx": _physx}[engine](spec, joint.type, joint.drive.brake)


def write_pads(layer: Sdf.Layer, plan: Plan) -> None:
    """The pads that stand on the ground while the brakes are set, and hidden wheels that do not, as UsdPhysics says it.

    Colliders that are there in that variant alone: nobody counts or exports them who has the brakes released.
    """
    if not has_brakes(plan.mechanism) or not any(body.pads for body in plan.mechanism.bodies):
        return
    declare_variants(over(layer, plan.root), "Brakes", BRAKES)
    root = f"{plan.root}{{Brakes=set}}"
    for body in plan.mechanism.bodies:
        below = plan.body_paths[body.name][len(plan.root) + 1 :]
        for pad in body.pads:
            collider_scope(layer, f"{root}{below}")
            path = shape_path(f"{root}{below}", pad)
            primitive = Primitive.of(pad)
            write_primitive(layer, path, replace(primitive, center=primitive.center - np.asarray(body.origin)))
            write_touching(over(layer, path), pad.material, plan)
    for wheel in _rolling_on_pads(plan.mechanism):
        for shape in wheel.shapes:
            below = shape_path(plan.body_paths[wheel.name], shape)[len(plan.root) + 1 :]
            set_attribute(over(layer, f"{root}{below}"), "physics:collisionEnabled", Types.Bool, False)


def _rolling_on_pads(mechanism: Mechanism) -> Iterator[Body]:
    """The hidden wheels that pads stand for: without parts, on the body that has the pads."""
    padded = {body.name for body in mechanism.bodies if body.pads}
    for joint in mechanism.joints:
        body = mechanism.body(joint.body1)
        if joint.body0 in padded and not joint.cut and not body.parts:
            yield body


def _newton(spec: Sdf.PrimSpec, _: str, brake: float) -> None:
    apply_schemas(spec, "NewtonJointAPI", "MjcJointAPI")
    set_attribute(spec, "newton:friction", Types.Float, brake)
    # As hard as a cut: with MuJoCo's own, what it holds creeps by millimetres a second.
    for name, values in (("solreffriction", SOLREF), ("solimpfriction", SOLIMP)):
        set_attribute(spec, f"mjc:{name}", Types.DoubleArray, Vt.DoubleArray(values), uniform=True)


def _physx(spec: Sdf.PrimSpec, joint_type: str, brake: float) -> None:
    """Friction, and a spring to where the joint is as loaded: friction alone lets a loader on 20° go by 5 mm/s, at any
    gain of a drive without stiffness by 2 (120 Hz)."""
    instance = INSTANCES[joint_type]
    apply_schemas(spec, f"PhysxJointAxisAPI:{instance}")
    for kind in ("static", "dynamic"):
        set_attribute(spec, f"physxJointAxis:{instance}:{kind}FrictionEffort", Types.Float, brake)
    values = {"stiffness": brake / BRAKE_GIVES * per_usd_unit(joint_type), "maxForce": brake}
    for name, value in values.items():
        set_attribute(spec, f"drive:{instance}:physics:{name}", Types.Float, float(value))
