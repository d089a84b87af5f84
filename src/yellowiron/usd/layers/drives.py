"""Drives (JSON-4): PhysicsDriveAPI with gains in USD's units — per degree for pivots."""

from __future__ import annotations

import math

from pxr import Sdf

from yellowiron.model.mechanism import Drive, Joint, Spring
from yellowiron.support.record import CATCHING_UP
from yellowiron.usd.authoring.stage import Types, apply_schemas, set_attribute

INSTANCES = {"revolute": "angular", "prismatic": "linear"}
"""Joint type → the instance of PhysicsDriveAPI that drives its one coordinate."""


def per_usd_unit(joint_type: str) -> float:
    """Factor from a gain per metre or radian to one per USD's unit (metre, degree)."""
    return math.radians(1.0) if joint_type == "revolute" else 1.0


def to_usd_unit(joint_type: str) -> float:
    """Factor from metres or radians to USD's unit (metres, degrees)."""
    return math.degrees(1.0) if joint_type == "revolute" else 1.0


def physx_names(joint: Joint, name: str) -> tuple[str, str]:
    """What PhysX calls a value of a joint's one axis, in both schemas that know it: the newer one may be missing."""
    return f"physxJoint:{name}", f"physxJointAxis:{INSTANCES[joint.type]}:{name}"


def speed_names(joint: Joint) -> tuple[str, ...]:
    """What engines call a joint's largest speed."""
    return *physx_names(joint, "maxJointVelocity"), "newton:velocityLimit"


def speed_limits(joint: Joint) -> tuple[float, float]:
    """The largest speed of a joint's coordinate the slower and the faster way, in metres or degrees a second, and a
    little to catch up by; infinite where there is none."""
    drive = joint.drive
    if drive is None or joint.cut or not 0.0 < drive.slowest < math.inf:
        return math.inf, math.inf
    spare = CATCHING_UP if drive.kind == "position" else 1.0
    slower, faster = (spare * speed * to_usd_unit(joint.type) for speed in (drive.slowest, max(drive.speeds)))
    return slower, faster


def write_spring(spec: Sdf.PrimSpec, joint: Joint, spring: Spring) -> None:
    """A spring as a drive that no lever commands: its gains. Its target is where it rests (`write_rest`)."""
    instance, factor = INSTANCES[joint.type], per_usd_unit(joint.type)
    apply_schemas(spec, f"PhysicsDriveAPI:{instance}")
    for name, value in (("stiffness", spring.stiffness), ("damping", spring.damping)):
        if value != 0.0:
            set_attribute(spec, f"drive:{instance}:physics:{name}", Types.Float, float(value * factor))


def write_rest(spec: Sdf.PrimSpec, joint: Joint, rest: float) -> None:
    """Where a spring rests, m or rad, in USD's units."""
    name = f"drive:{INSTANCES[joint.type]}:physics:targetPosition"
    set_attribute(spec, name, Types.Float, float(rest * to_usd_unit(joint.type)))


def write_drive(spec: Sdf.PrimSpec, joint: Joint, drive: Drive) -> None:
    """Stiffness, damping and the largest force. A velocity drive has no stiffness; every target is the default, 0."""
    instance = INSTANCES[joint.type]
    factor = per_usd_unit(joint.type)
    apply_schemas(spec, f"PhysicsDriveAPI:{instance}")
    values = {
        "stiffness": drive.stiffness * factor if drive.kind == "position" else 0.0,
        "damping": drive.damping * factor,
    }
    for name, value in values.items():
        if value != 0.0:
            set_attribute(spec, f"drive:{instance}:physics:{name}", Types.Float, float(value))
    if math.isfinite(drive.strongest):
        set_attribute(spec, f"drive:{instance}:physics:maxForce", Types.Float, float(drive.strongest))
