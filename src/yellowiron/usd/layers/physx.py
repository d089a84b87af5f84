"""The PhysX layer: schemas by name and plain attributes, so that writing needs no PhysX.

The attributes and their defaults are those of `physx-usd-schemas`; a joint's largest velocity is written in both its
forms, Isaac Sim's `PhysxJointAPI` and the per-axis `PhysxJointAxisAPI` that replaced it.
"""

from __future__ import annotations

from pxr import Sdf

from yellowiron.model.mechanism import Joint, Mechanism, rolling
from yellowiron.model.template import by_first_leader
from yellowiron.support.record import ENDLESS
from yellowiron.usd.authoring.stage import Types, apply_schemas, over, set_attribute
from yellowiron.usd.layers.actuation import limited
from yellowiron.usd.layers.articulation import articulation_roots
from yellowiron.usd.layers.drives import INSTANCES, physx_names
from yellowiron.usd.planning.pin_links import slewed_cuts
from yellowiron.usd.planning.plan import COLLIDERS, MESH, Plan

POSITION_ITERATIONS = 255
"""Solver iterations of the articulation, PhysX's most. They cost next to nothing where a single machine's step is spent
elsewhere, and a pin of a loader that holds its payload errs at 120 Hz by 1.5 mm with 32, by 0.53 with 64, by 0.20 with
128 and by 0.08 with 255."""

RING_ITERATIONS = 32
"""Of a machine that lies in rings of track shoes: each is pressed between heavy machine and ground by many contacts,
and more iterations shake them. An excavator of 139 bodies drives on its shoes with 16 and 32 (at 120, 240 and 1000 Hz),
trembles with 64 and 128, and with 255 stands still after 0.14 m."""
ITERATIONS = "physxArticulation:solverPositionIterationCount"

LOOPS_LAST = "physxScene:solveArticulationContactLast"
"""A scene's attribute: contacts and cut joints of articulations are solved after everything else. An excavator's worst
pin then errs by 0.09 instead of 0.25 mm at 120 Hz, its boom lowered with a full bucket. Drives give way a fifth more: a
loader's tilt cylinder with its rated payload ended 6.5 instead of 3.6 mm from its target, and its pins need it not."""

CONTACT_TIME = 0.01
"""Seconds in which a contact gives way, critically damped and by the mass on it: what lies there sinks by g t², 1 mm.
MuJoCo's and Newton's contacts take 0.02 s, PhysX's own none: what stops a bucket that strikes the ground acts within
one step, on its cylinders too, and a boom went 15 % faster than its oil; 7 % so, and by 0.005 to 0.02 s. Tyres stay
rigid: braked on a slope of 20° they would creep by 0.3 mm/s."""

_VALUE_TYPES = {bool: Types.Bool, int: Types.Int, float: Types.Float}


def loops_last(mechanism: Mechanism) -> bool:
    """Whether a machine's scene should solve its loops last: where a motor turns a body that loops hang on, as an
    excavator's swing does, and no ring of track shoes hangs on a sprocket, which then gives way by an eighth."""
    return not mechanism.floating and bool(slewed_cuts(mechanism))


def iterations(mechanism: Mechanism) -> int:
    """Position iterations of a machine's articulation."""
    return RING_ITERATIONS if mechanism.floating else POSITION_ITERATIONS


def endless(mechanism: Mechanism) -> tuple[str, ...]:
    """The pivots without limits that follow another or lead one."""
    told = {joint.name: joint.follows for joint in mechanism.joints if joint.follows is not None}
    coupled = told.keys() | {by_first_leader(name, told).joint for name in told}
    free = (j for j in mechanism.joints if j.type == "revolute" and j.lower is None and j.upper is None)
    return tuple(j.name for j in free if j.name in coupled)


def write_physx(layer: Sdf.Layer, base: Sdf.Layer, plan: Plan) -> None:
    """Articulation settings, joint velocities and the collision parameters UsdPhysics has no word for."""
    for root in articulation_roots(layer, plan):
        apply_schemas(root, "PhysxArticulationAPI")
        set_attribute(root, "physxArticulation:enabledSelfCollisions", Types.Bool, False)
        set_attribute(root, ITERATIONS, Types.Int, iterations(plan.mechanism))
    for joint in plan.mechanism.joints:
        for spec, limit in limited(layer, plan.root, plan.joint_paths[joint.name], joint):
            _write_joint(spec, joint, "maxJointVelocity", limit)
        if (armature := joint.armature if joint.drive is None else joint.drive.armature) > 0.0:
            _write_joint(over(layer, plan.joint_paths[joint.name]), joint, "armature", armature)
    for name in endless(plan.mechanism):
        spec = over(layer, plan.joint_paths[name])
        set_attribute(spec, "physics:lowerLimit", Types.Float, -ENDLESS)
        set_attribute(spec, "physics:upperLimit", Types.Float, ENDLESS)
    tyres = _of_wheels_alone(plan)
    for name, path in plan.material_paths.items():
        combine = plan.mechanism.materials[name].friction_combine
        if combine is not None or name not in tyres:
            spec = over(layer, path)
            apply_schemas(spec, "PhysxMaterialAPI")
        if combine is not None:
            set_attribute(spec, "physxMaterial:frictionCombineMode", Types.Token, combine, uniform=True)
        if name not in tyres:
            # By the mass on it, not in newtons a metre: the same for a bucket, a stone in it and the whole machine.
            set_attribute(spec, "physxMaterial:compliantContactAccelerationSpring", Types.Bool, True)
            set_attribute(spec, "physxMaterial:compliantContactStiffness", Types.Float, CONTACT_TIME**-2)
            set_attribute(spec, "physxMaterial:compliantContactDamping", Types.Float, 2.0 / CONTACT_TIME)
    for body in plan.mechanism.bodies:
        for placed in plan.parts[body.name]:
            path = f"{plan.body_paths[body.name]}/{COLLIDERS}/{placed.name}"
            chosen = placed.approximation
            if not placed.collides or not chosen.physx_schema:
                continue
            if not placed.pieces and base.GetPrimAtPath(path).typeName != "Mesh":
                continue
            spec = over(layer, f"{path}/{MESH}" if placed.pieces else path)
            apply_schemas(spec, chosen.physx_schema)
            if chosen.physx_usd:
                set_attribute(spec, "physics:approximation", Types.Token, chosen.physx_usd, uniform=True)
            for name, value in chosen.physx_values.items():
                set_attribute(spec, name, _VALUE_TYPES[type(value)], value)


def _of_wheels_alone(plan: Plan) -> set[str]:
    """The materials that no part has but those of what rolls."""
    wheels = rolling(plan.mechanism)
    rolls, rests = (
        {placed.data.material for body, parts in plan.parts.items() if (body in wheels) is on for placed in parts}
        for on in (True, False)
    )
    return rolls - rests


def _write_joint(spec: Sdf.PrimSpec, joint: Joint, name: str, value: float) -> None:
    apply_schemas(spec, "PhysxJointAPI", f"PhysxJointAxisAPI:{INSTANCES[joint.type]}")
    for each in physx_names(joint, name):
        set_attribute(spec, each, Types.Float, value)
