"""Drives and actuators: what moves a joint, and how hard it can push.

Gains of slides are provisional here; the kinematics sets them from the mass that the cylinder moves. The template's own
gains win over both.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Literal

from yellowiron.mechanism.actuation.cylinders import FittedCylinder
from yellowiron.mechanism.actuation.proportion import Proportion
from yellowiron.mechanism.joints.axes import Axis
from yellowiron.mechanism.joints.frames import JointFrame
from yellowiron.mechanism.placement import Placement
from yellowiron.mechanism.values import Known, default, known
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import DEFAULT, PROVISIONAL, STATED, Actuator, ActuatorJoint, Drive
from yellowiron.model.specification import Specifications, fold
from yellowiron.model.template import ActuatorTemplate, JointTemplate, Template

_FREQUENCY = 2.0
"""Natural frequency of a position drive, Hz, critically damped."""
_SAG = 0.01
"""Provisional stiffness: the full force at this error, metres or radians."""
_SLIP = 0.05
"""A velocity drive reaches its full torque when it is this share of its top speed too slow."""


def slide_drives(
    template: Template,
    fitted: Mapping[str, Sequence[FittedCylinder]],
    proportion: Proportion,
    findings: list[Finding],
) -> dict[str, Drive]:
    """The drive of every driven cylinder's slide, by joint name. It carries its passive twins' share; under the
    template's pressure it is no stronger than suits the machine."""
    drives = {}
    for actuator in template.actuators:
        cylinders = fitted.get(actuator.name, ())
        driven = [f for f in cylinders if not f.cylinder.passive]
        twins = [f for f in cylinders if f.cylinder.passive]
        for one in driven:
            joint = template.joint(one.cylinder.slide)
            if joint.drive is not None:
                carried = twins if one is driven[0] else []
                drives[joint.name] = _cylinder_drive(joint, one, carried, actuator, proportion, findings)
    return drives


def _cylinder_drive(
    joint: JointTemplate,
    one: FittedCylinder,
    twins: Sequence[FittedCylinder],
    actuator: ActuatorTemplate,
    proportion: Proportion,
    findings: list[Finding],
) -> Drive:
    out = one.cylinder.push_force + sum(
        t.cylinder.push_force if t.sign == one.sign else t.cylinder.pull_force for t in twins
    )
    back = one.cylinder.pull_force + sum(
        t.cylinder.pull_force if t.sign == one.sign else t.cylinder.push_force for t in twins
    )
    share = f" with {len(twins)} passive twin(s)" if twins else ""
    source = f"pressure times area{share}: {out / 1e3:.1f} kN extending, {back / 1e3:.1f} kN retracting"
    if one.cylinder.sources.get("pressure", "").startswith(DEFAULT):
        most, limited = proportion.force(max(out, back), actuator.name, findings)
        out, back = min(out, most), min(back, most)
        source += limited
    source += f"; {PROVISIONAL}"
    if out <= 0.0 or back <= 0.0:
        _no_limit(actuator, "bore or pressure", findings)
        out = back = math.inf
    stiffness = out / _SAG if math.isfinite(out) else 1e8
    damping = 2.0 * stiffness / (2.0 * math.pi * _FREQUENCY)
    extending, retracting = one.cylinder.speed or math.inf, one.retract_speed or math.inf
    return _overridden(
        joint,
        Drive("position", stiffness, damping, out, extending, source, reverse_force=back, reverse_velocity=retracting),
    )


def motor_drives(
    template: Template,
    frames: Mapping[str, JointFrame],
    sides: Mapping[str, tuple[str, str]],
    placement: Placement,
    specifications: Specifications,
    findings: list[Finding],
    *,
    proportion: Proportion,
    radii: Mapping[str, float] | None = None,
) -> dict[str, Drive]:
    """The velocity drive of every motor joint, by joint name. `sides` gives each joint's (body0, body1); `radii` are
    those of bodies whose parts do not show it, metres. A default torque is no more than suits the machine."""
    drives = {}
    pulling = _pulling(template, frames)
    for actuator in template.actuators:
        turning_joints = actuator.joints if actuator.kind == "motor" else ()
        joints = [frames[name] for name in turning_joints if name in frames]
        torque = _value(actuator, "torque", specifications, findings) if joints else None
        top = _value(actuator, "speed", specifications, findings) if joints else None
        for frame in joints:
            moved = sides[frame.joint.name][1]
            rim = (radii or {}).get(moved) or _rim(frame, placement, moved)
            speed = _angular(top, actuator, template, rim)
            share = pulling.get(fold(actuator.specifications.get("torque", "")), len(joints))
            turning = _share_of_pull(torque, share, actuator, template, rim)
            if turning is not None and turning.source == DEFAULT and template.role(moved).hidden:
                # The default is the one motor's whose place they take together.
                turning = Known(turning.value / len(joints), DEFAULT)
            if turning is not None and turning.source == DEFAULT:
                turning = proportion.torque(turning, actuator.name, findings)
            drives[frame.joint.name] = _motor_drive(frame.joint, turning, speed, actuator, findings)
    return drives


def _motor_drive(
    joint: JointTemplate,
    torque: Known | None,
    speed: Known | None,
    actuator: ActuatorTemplate,
    findings: list[Finding],
) -> Drive:
    if torque is None:
        _no_limit(actuator, "torque", findings)
    limit = torque.value if torque is not None else math.inf
    top = speed.value if speed is not None else math.inf
    damping = limit / (_SLIP * top) if math.isfinite(limit) and math.isfinite(top) else 1e4
    words = f"torque {torque.source if torque else 'not limited'}; speed {speed.source if speed else 'not limited'}"
    return _overridden(joint, Drive("velocity", 0.0, damping, limit, top, words))


def stated_drives(template: Template, frames: Mapping[str, JointFrame], findings: list[Finding]) -> dict[str, Drive]:
    """The drive of every joint that the template drives and no actuator claims (JSON-4; a template without actuators),
    by joint name: a position drive where the joint has limits or a stiffness, else a velocity drive."""
    claimed = {c.slide for a in template.actuators for c in a.cylinders} | {
        j for a in template.actuators for j in a.joints
    }
    drives = {}
    for frame in frames.values():
        joint = frame.joint
        if joint.drive is None or joint.name in claimed:
            continue
        holds = joint.stiffness is not None or joint.lower is not None or joint.upper is not None
        source = "stated in the template"
        if holds:
            drive = Drive("position", 0.0, 0.0, math.inf, math.inf, f"{source}; {PROVISIONAL}")
        else:
            drive = Drive("velocity", 0.0, 1e4, math.inf, math.inf, source)
        if joint.max_force is None:
            words = "Nothing gives its force: it moves with unlimited force."
            findings.append(Finding("MEC027", "warning", joint.name, words, "State max_force in the joint's entry."))
        drives[joint.name] = _overridden(joint, drive)
    return drives


def actuators(
    template: Template,
    frames: Mapping[str, JointFrame],
    fitted: Mapping[str, Sequence[FittedCylinder]],
    stated: Mapping[str, Drive],
    findings: list[Finding],
    *,
    winches: Mapping[str, Sequence[ActuatorJoint]],
) -> tuple[Actuator, ...]:
    """The template's actuators that have something left to move, then one for every joint whose drive is `stated`.
    `winches`: what each moves; to the engines they are cylinders without oil."""
    result = []
    for entry in template.actuators:
        cylinders = fitted.get(entry.name, ())
        if entry.kind == "cylinder":
            joints = tuple(ActuatorJoint(f.cylinder.slide, f.sign) for f in cylinders)
            moves = any(not f.cylinder.passive for f in cylinders)
        else:
            given = winches.get(entry.name) or [ActuatorJoint(name) for name in entry.joints]
            joints = tuple(each for each in given if each.joint in frames)
            moves = bool(joints)
        if moves and not entry.slave:
            moved_by: Literal["cylinder", "motor"] = "motor" if entry.kind == "motor" else "cylinder"
            result.append(Actuator(entry.name, moved_by, joints, tuple(f.cylinder.name for f in cylinders)))
        elif not entry.slave:
            words = "None of the actuator's driven joints was found: it is left out."
            hint = "Check its cylinders' parts in the alignment."
            findings.append(Finding("MEC026", "error", entry.name, words, hint))
    for name in stated:
        kind: Literal["cylinder", "motor"] = "cylinder" if frames[name].joint.type == "prismatic" else "motor"
        result.append(Actuator(name, kind, (ActuatorJoint(name),)))
    return tuple(result)


def _pulling(template: Template, frames: Mapping[str, JointFrame]) -> dict[str, int]:
    """Specification of a torque → how many joints share it: those of all the motors that name it (both tracks')."""
    joints: dict[str, set[str]] = {}
    for actuator in template.actuators:
        name = fold(actuator.specifications.get("torque", ""))
        joints.setdefault(name, set()).update(j for j in actuator.joints if j in frames)
    return {name: len(found) for name, found in joints.items()}


def _angular(top: Known | None, actuator: ActuatorTemplate, template: Template, radius: float) -> Known | None:
    """A motor's top speed in rad/s: as it is, or that of the ground under the moved body's rim where it is wanted as
    such."""
    if top is None or not _wanted_as(actuator, "speed", "speed", template):
        return top
    return Known(top.value / radius, f"{top.source}, at a radius of {radius:.3f} m") if radius > 0.0 else None


def _share_of_pull(
    torque: Known | None,
    joints: int,
    actuator: ActuatorTemplate,
    template: Template,
    radius: float,
) -> Known | None:
    """A motor's torque: as it is, or its share of a pull at the ground (rimpull) where it is wanted as such."""
    if torque is None or torque.source == DEFAULT or not _wanted_as(actuator, "torque", "force", template):
        return torque
    return Known(torque.value * radius / joints, f"{torque.source}, 1/{joints} of it at a radius of {radius:.3f} m")


def _wanted_as(actuator: ActuatorTemplate, quantity: str, dimension: str, template: Template) -> bool:
    """Whether the specification that gives a quantity has that dimension."""
    name = fold(actuator.specifications.get(quantity, ""))
    return any(fold(w.name) == name and w.dimension == dimension for w in template.wanted)


def _rim(frame: JointFrame, placement: Placement, moved: str) -> float:
    """The largest radius of a body about a joint's axis, metres."""
    line = Axis(frame.anchor, frame.axis)
    return max(float(line.distance(placement.points(row)).max()) for row in placement.rows_of_body(moved))


def _value(
    actuator: ActuatorTemplate, quantity: str, specifications: Specifications, findings: list[Finding]
) -> Known | None:
    printed = known(specifications, actuator.specifications.get(quantity))
    return printed or default(actuator, quantity, findings)


def _overridden(joint: JointTemplate, drive: Drive) -> Drive:
    """The drive with what the template's joint states itself."""
    stated = {
        name: value
        for name in ("stiffness", "damping", "max_force", "max_velocity")
        if (value := getattr(joint, name)) is not None
    }
    if not stated:
        return drive
    # A stated limit holds both ways.
    return replace(
        drive,
        **stated,
        reverse_force=None if "max_force" in stated else drive.reverse_force,
        reverse_velocity=None if "max_velocity" in stated else drive.reverse_velocity,
        source=f"{drive.source}; {STATED}{', '.join(stated)}",
    )


def _no_limit(actuator: ActuatorTemplate, what: str, findings: list[Finding]) -> None:
    words = f"Nothing gives its {what}: it moves with unlimited force."
    hint = "Give it with --set or in the template's defaults."
    findings.append(Finding("MEC027", "warning", actuator.name, words, hint))
