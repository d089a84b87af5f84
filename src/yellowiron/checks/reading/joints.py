"""Joints of a stage, as values."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

import numpy as np
from pxr import Gf, Usd, UsdPhysics

from yellowiron.checks.reading.attributes import axis_token, number, quaternion, token, vector
from yellowiron.checks.reading.bodies import Poses, body_of, record_of, rotation_and_scale
from yellowiron.checks.reading.spans import span
from yellowiron.checks.values import ANGULAR, LINEAR, Side, StageDrive, StageJoint, Units, direction
from yellowiron.support.record import ENDLESS

_TYPES = {
    "PhysicsFixedJoint": "fixed",
    "PhysicsRevoluteJoint": "revolute",
    "PhysicsPrismaticJoint": "prismatic",
    "PhysicsSphericalJoint": "spherical",
    "PhysicsDistanceJoint": "distance",
    "PhysicsJoint": "generic",
}
_ANGULAR_DRIVES = ("angular", *ANGULAR)
_VELOCITY_LIMITS = ("physxJoint:maxJointVelocity", "newton:velocityLimit")
_RESISTANCE = (
    "physxJoint:jointFriction",
    "newton:friction",
    "newton:springStiffness",
    "mjc:frictionloss",
    "mjc:stiffness",
)
_DAMPING = ("newton:damping", "mjc:damping")
_MIMICS = ("PhysxMimicJointAPI", "NewtonMimicAPI")
_LEADERS = {"NewtonMimicAPI": "newton:mimicJoint", "PhysxMimicJointAPI": "physxMimicJoint:{}:referenceJoint"}
_EQUALITIES = "MjcEqualityJointAPI"
_ACTUATORS = {"MjcActuator": "mjc:target", "NewtonActuator": "newton:targets"}
_TENDON = "mjc:path"


def read_joints(prims: list[Usd.Prim], poses: Poses, units: Units) -> tuple[StageJoint, ...]:
    """Every joint, in the stage's order."""
    moved = _actuated(prims)
    return tuple(_read_joint(p, poses, units, moved) for p in prims if p.IsA(UsdPhysics.Joint))


def _actuated(prims: Iterable[Usd.Prim]) -> set[str]:
    """Joints that an engine's actuator prims move, directly or by a tendon."""
    found: set[str] = set()
    for prim in prims:
        kind = str(prim.GetTypeName())
        relation = _ACTUATORS.get(kind)
        if relation is None:
            continue
        for name in (relation, "newton:target"):
            targets = prim.GetRelationship(name).GetTargets() if prim.GetRelationship(name) else []
            for target in targets:
                found.add(str(target))
                tendon = prim.GetStage().GetPrimAtPath(target)
                if tendon and tendon.GetRelationship(_TENDON):
                    found.update(str(t) for t in tendon.GetRelationship(_TENDON).GetTargets())
    return found


def _read_joint(prim: Usd.Prim, poses: Poses, units: Units, actuated: set[str]) -> StageJoint:
    api = UsdPhysics.Joint(prim)
    kind = _TYPES.get(str(prim.GetTypeName()), "other")
    freedoms = _freedoms(prim, kind)
    drives = tuple(_read_drive(prim, i, units) for i in _instances(prim, "PhysicsDriveAPI"))
    lower, upper = _limits(prim, kind, freedoms, units)
    schemas = _applied(prim)
    offset = number(prim, "newton:mimicCoef0") or 0.0
    ratio = number(prim, "newton:mimicCoef1")
    sides = (_read_side(prim, 0, poses), _read_side(prim, 1, poses))
    return StageJoint(
        path=str(prim.GetPath()),
        type=_as_simple(kind, freedoms),
        sides=sides,
        enabled=api.GetJointEnabledAttr().Get() is not False,
        cut=bool(api.GetExcludeFromArticulationAttr().Get()),
        freedoms=freedoms,
        lower=lower,
        upper=upper,
        drives=drives,
        velocity_limits=_velocity_limits(prim),
        held=any((number(prim, n) or 0.0) > 0.0 for n in _RESISTANCE)
        or any(s.split(":")[0] in (*_MIMICS, _EQUALITIES) for s in schemas),
        damped=any((number(prim, n) or 0.0) > 0.0 for n in _DAMPING),
        actuated=str(prim.GetPath()) in actuated,
        leader=_leader(prim),
        ratio=1.0 if ratio is None else ratio,
        spans=_spans(prim, sides, freedoms, poses),
        offset=offset * (units.meters_per_unit if freedoms[:1] and freedoms[0] in LINEAR else math.radians(1.0)),
        record=record_of(prim),
    )


def _spans(
    prim: Usd.Prim, sides: tuple[Side, Side], freedoms: tuple[str, ...], poses: Poses
) -> tuple[tuple[float, float] | None, tuple[float, float] | None]:
    """How far the two bodies of a slide reach along its axis."""
    if len(freedoms) != 1 or freedoms[0] not in LINEAR or not all(side.body for side in sides):
        return None, None
    axis = direction(sides[0].rotation, freedoms[0])
    bodies = [prim.GetStage().GetPrimAtPath(side.body) for side in sides]
    return span(bodies[0], axis, poses), span(bodies[1], axis, poses)


def _applied(prim: Usd.Prim) -> list[str]:
    """Applied schemas, with those that nothing here has registered: USD knows them by the metadata alone."""
    written = prim.GetMetadata("apiSchemas")
    return list(dict.fromkeys([*prim.GetAppliedSchemas(), *(written.GetAppliedItems() if written else ())]))


def _leader(prim: Usd.Prim) -> str | None:
    """The joint that a mimic names, "" where it names none that is there; None without a mimic that is on."""
    for applied in _applied(prim):
        schema, _, instance = applied.partition(":")
        enabled = prim.GetAttribute("newton:mimicEnabled")
        off = schema == "NewtonMimicAPI" and enabled and enabled.Get() is False
        if schema in _LEADERS and not off:
            relation = prim.GetRelationship(_LEADERS[schema].format(instance))
            targets = relation.GetTargets() if relation else []
            there = [t for t in targets if (found := prim.GetStage().GetPrimAtPath(t)) and found.IsActive()]
            return str(there[0]) if len(targets) == len(there) == 1 else ""
    return None


def _instances(prim: Usd.Prim, schema: str) -> list[str]:
    """Instance names of an applied schema, unknown ones too."""
    names = (s.split(":", 1) for s in prim.GetAppliedSchemas() if s.startswith(f"{schema}:"))
    return list(dict.fromkeys(parts[1] for parts in names))


def _freedoms(prim: Usd.Prim, kind: str) -> tuple[str, ...]:
    axis = axis_token(prim, "physics:axis", "X")
    if kind == "revolute":
        return (f"rot{axis}",)
    if kind == "prismatic":
        return (f"trans{axis}",)
    if kind == "spherical":
        return ANGULAR
    if kind != "generic":
        return () if kind == "fixed" else (*LINEAR, *ANGULAR)
    locked = set()
    for instance in _instances(prim, "PhysicsLimitAPI"):
        low, high = (number(prim, f"limit:{instance}:physics:{end}") for end in ("low", "high"))
        if low is not None and high is not None and low > high:
            locked.add(instance)
    return tuple(f for f in (*ANGULAR, *LINEAR) if f not in locked)


def _as_simple(kind: str, freedoms: tuple[str, ...]) -> str:
    """A generic joint with one freedom is a hinge or a slide, with none it is fixed."""
    if kind != "generic" or len(freedoms) > 1:
        return kind
    if not freedoms:
        return "fixed"
    return "revolute" if freedoms[0].startswith("rot") else "prismatic"


def _limits(prim: Usd.Prim, kind: str, freedoms: tuple[str, ...], units: Units) -> tuple[float | None, float | None]:
    """Limits of a hinge (rad) or slide (m); None for infinite ones, and for those of a hinge that it never comes to."""
    if len(freedoms) != 1:
        return None, None
    factor = math.radians(1.0) if freedoms[0].startswith("rot") else units.meters_per_unit
    names = ("physics:lowerLimit", "physics:upperLimit")
    if kind == "generic":
        names = (f"limit:{freedoms[0]}:physics:low", f"limit:{freedoms[0]}:physics:high")
    values = [number(prim, n) for n in names]
    lower, upper = (None if v is None or abs(v) >= ENDLESS else v * factor for v in values)
    return lower, upper


def _read_drive(prim: Usd.Prim, instance: str, units: Units) -> StageDrive:
    def value(name: str, default: float) -> float:
        found = number(prim, f"drive:{instance}:physics:{name}")
        return default if found is None else found

    kilograms, meters = units.kilograms_per_unit, units.meters_per_unit
    angular = instance in _ANGULAR_DRIVES
    gain = kilograms * meters**2 * math.degrees(1.0) if angular else kilograms
    target = math.radians(1.0) if angular else meters
    return StageDrive(
        instance=instance,
        stiffness=value("stiffness", 0.0) * gain,
        damping=value("damping", 0.0) * gain,
        max_force=value("maxForce", math.inf) * kilograms * (meters**2 if angular else meters),
        target_position=value("targetPosition", 0.0) * target,
        target_velocity=value("targetVelocity", 0.0) * target,
        acceleration=token(prim, f"drive:{instance}:physics:type") == "acceleration",
    )


def _velocity_limits(prim: Usd.Prim) -> Mapping[str, float]:
    """Authored largest velocities by attribute, in the attribute's units."""
    names = [*_VELOCITY_LIMITS]
    names += [f"physxJointAxis:{i}:maxJointVelocity" for i in _instances(prim, "PhysxJointAxisAPI")]
    found = {n: number(prim, n) for n in names}
    return {n: v for n, v in found.items() if v is not None}


def _read_side(prim: Usd.Prim, index: int, poses: Poses) -> Side:
    stage = prim.GetStage()
    relation = prim.GetRelationship(f"physics:body{index}")
    targets = tuple(str(t) for t in relation.GetTargets()) if relation else ()
    # A prim that is deactivated is still found by its path.
    missing = tuple(t for t in targets if not (stage.GetPrimAtPath(t) and stage.GetPrimAtPath(t).IsActive()))
    target = stage.GetPrimAtPath(targets[0]) if targets and not missing else None
    matrix = poses.matrix(target) if target else Gf.Matrix4d(1.0)
    position = vector(prim, f"physics:localPos{index}") or Gf.Vec3d(0.0)
    written = quaternion(prim, f"physics:localRot{index}") or Gf.Quatd(1.0)
    norm = written.GetLength()
    turn = Gf.Matrix3d(written.GetNormalized()) if norm > 0.0 and math.isfinite(norm) else Gf.Matrix3d(1.0)
    return Side(
        targets=targets,
        missing=missing,
        body=body_of(target) if target else "",
        position=np.array(matrix.Transform(position)) * poses.meters,
        rotation=rotation_and_scale(matrix)[0] @ np.array(turn, dtype=np.float64).T,
        norm=norm,
    )
