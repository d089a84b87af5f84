"""The MuJoCo and Newton layer: how a cut is closed, and what Newton calls its own.

A cut is a `connect` equality (`MjcEqualityConnectAPI`, which Newton reads too): one soft constraint of three rows,
stiff enough at time steps of a millisecond. Newton closes a revolute cut by two of them, which is forty times worse.
What a joint follows is one as well: as stiff, for Newton's own stiffness lets chains give by 2 mm. PhysX reads it here.
"""

from __future__ import annotations

import math
from collections.abc import Container

from pxr import Sdf, Vt

from yellowiron.model.mechanism import Body, Joint, Mechanism, scrubbing
from yellowiron.model.template import Follows, by_first_leader
from yellowiron.support.record import SCRUBS
from yellowiron.usd.authoring.stage import Types, apply_schemas, over, set_attribute, set_targets
from yellowiron.usd.layers.actuation import limited
from yellowiron.usd.layers.articulation import articulation_roots
from yellowiron.usd.layers.base import shape_path, solid_paths
from yellowiron.usd.layers.drives import INSTANCES, to_usd_unit
from yellowiron.usd.layers.joints import usd_type
from yellowiron.usd.planning.plan import COLLIDERS, Plan

SOLREF = (0.002, 1.0)
"""Time constant (s) and damping ratio of a cut: twice a step of 1 ms, the stiffest that stays stable."""
SOLIMP = (0.9999, 0.9999, 0.001, 0.5, 2.0)
"""As hard as MuJoCo takes it from the first micrometre on: with 0.999 there, pins err by half as much again."""

STOP = (0.02, 1.0)
"""Time constant (s) and damping ratio of an end stop, MuJoCo's own. Newton's is a spring of 10 kN/m, whatever hangs on
it: a dump truck's loaded body sank through the ends of its cylinders, whose push is but 5 % more than its weight
there."""

DAMPED = 1e-3
"""Seconds: a position drive of a machine with loops has an inertia of its own of so many times its damping, in Newton.
Its default integrator, `implicitfast`, adds damping times step to what a drive moves after the loops' forces were found
without it, and a cylinder alone weighs little: an excavator's pins err at 240 Hz by 1.9 mm without, by 0.16 with it."""
SPUN_UP = 0.05
"""… and no more than its force brings to its speed in so many seconds."""

RULING = ("min", "multiply")
"""Ways to combine friction that MuJoCo does not know: its colliders of such a material rule by priority."""

MIMIC, MIMIC_NAMES = "NewtonMimicAPI", "newton:mimic"
"""The schema of a joint that follows another, and how the names of its attributes begin."""

_EQUALITIES = {"spherical": "MjcEqualityConnectAPI", "fixed": "MjcEqualityWeldAPI"}


def write_mujoco(layer: Sdf.Layer, base: Sdf.Layer, plan: Plan) -> None:
    """Equalities on the cuts, self-collision off, velocity limits, sites, signed distance fields. `base` is the layer
    of the colliders."""
    for root in articulation_roots(layer, plan):
        apply_schemas(root, "NewtonArticulationRootAPI")
        set_attribute(root, "newton:selfCollisionEnabled", Types.Bool, False)
    follows = {joint.name: joint.follows for joint in plan.mechanism.joints if joint.follows is not None}
    for joint in plan.mechanism.joints:
        if joint.cut and (equality := _EQUALITIES.get(usd_type(joint))) is not None:
            _write_equality(over(layer, plan.joint_paths[joint.name]), equality)
        elif joint.name in follows:
            spec = over(layer, plan.joint_paths[joint.name])
            _write_follows(spec, joint, by_first_leader(joint.name, follows), plan)
        else:
            _write_newton_joint(layer, joint, plan)
        if not joint.cut and joint.type in INSTANCES and (joint.lower is not None or joint.upper is not None):
            spec = over(layer, plan.joint_paths[joint.name])
            apply_schemas(spec, "MjcJointAPI")
            set_attribute(spec, "mjc:solreflimit", Types.DoubleArray, Vt.DoubleArray(STOP), uniform=True)
    for path in plan.site_paths.values():
        apply_schemas(over(layer, path), "NewtonSiteAPI")
    scrubs = scrubbing(plan.mechanism)
    ruling = {name for name, m in plan.mechanism.materials.items() if m.friction_combine in RULING}
    for body in plan.mechanism.bodies:
        _write_contacts(layer, plan, body, ruling, body.name in scrubs)
        for placed in plan.parts[body.name]:
            path = f"{plan.body_paths[body.name]}/{COLLIDERS}/{placed.name}"
            if placed.approximation.newton_schema and base.GetPrimAtPath(path).typeName == "Mesh":
                apply_schemas(over(layer, path), placed.approximation.newton_schema)


def _write_newton_joint(layer: Sdf.Layer, joint: Joint, plan: Plan) -> None:
    """Rated speed, metres or degrees a second, and armature, kg or kg·m² (per radian, whatever the other units)."""
    path = plan.joint_paths[joint.name]
    said = [(spec, "velocityLimit", limit) for spec, limit in limited(layer, plan.root, path, joint)]
    if (inertia := armature(joint, plan.mechanism)) > 0.0:
        said.append((over(layer, path), "armature", inertia))
    for spec, name, value in said:
        apply_schemas(spec, "NewtonJointAPI")
        set_attribute(spec, f"newton:{name}", Types.Float, value)


def armature(joint: Joint, mechanism: Mechanism) -> float:
    """The inertia of a joint's drive that Newton's own integrator wants, kg or kg·m²: the drive's, or more where loops
    are to hold. 0 for none."""
    drive = joint.drive
    if drive is None:
        return 0.0
    looped = any(other.cut or other.follows is not None for other in mechanism.joints)
    if not looped or joint.cut or drive.kind != "position" or not 0.0 < drive.slowest < math.inf:
        return drive.armature
    return max(drive.armature, min(DAMPED * drive.damping, SPUN_UP * drive.strongest / drive.slowest))


def _write_equality(joint: Sdf.PrimSpec, equality: str) -> None:
    """The constraint that closes a cut, or that holds a joint to what its `NewtonMimicAPI` says."""
    apply_schemas(joint, equality)
    set_attribute(joint, "mjc:solref", Types.DoubleArray, Vt.DoubleArray(SOLREF), uniform=True)
    set_attribute(joint, "mjc:solimp", Types.DoubleArray, Vt.DoubleArray(SOLIMP), uniform=True)


def _write_follows(spec: Sdf.PrimSpec, joint: Joint, follows: Follows, plan: Plan) -> None:
    """What it follows, as `NewtonMimicAPI`, which PhysX and Newton both hold (PhysX ignores its own
    `PhysxMimicJointAPI` on slides). `follows` names the first leader of the chain: Newton takes no leader that follows
    another itself. The offset is in the joint's units: metres, degrees."""
    apply_schemas(spec, MIMIC)
    _write_equality(spec, "MjcEqualityJointAPI")
    set_targets(spec, f"{MIMIC_NAMES}Joint", plan.joint_paths[follows.joint])
    if follows.offset:
        set_attribute(spec, f"{MIMIC_NAMES}Coef0", Types.Float, follows.offset * to_usd_unit(joint.type))
    if follows.ratio != 1.0:
        set_attribute(spec, f"{MIMIC_NAMES}Coef1", Types.Float, float(follows.ratio))


def _write_contacts(layer: Sdf.Layer, plan: Plan, body: Body, ruling: Container[str], scrubs: bool) -> None:
    """Colliders of a body whose material is a `ruling` one, or which `scrubs`, rule by priority."""
    home = plan.body_paths[body.name]
    own = [(shape_path(home, s), s.material) for s in body.shapes]
    drawn = [(f"{home}/{COLLIDERS}/{p.name}", p.data.material) for p in plan.parts[body.name] if p.collides]
    pooled = [(path, solid.data.material) for path, solid in solid_paths(plan, body.name)]
    for path, material in (*own, *drawn, *pooled):
        if material in ruling or scrubs:
            spec = over(layer, path)
            apply_schemas(spec, "MjcCollisionAPI")
            set_attribute(spec, "mjc:priority", Types.Int, 1, uniform=True)
            for name, values in SCRUBS.items() if scrubs else ():
                set_attribute(spec, f"mjc:{name}", Types.DoubleArray, Vt.DoubleArray(values), uniform=True)
