"""Hinges that are driven directly, where the CAD model has no cylinder to do it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

from yellowiron.mechanism.joints.frames import JointFrame
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import PROVISIONAL, STATED, Drive
from yellowiron.model.template import ActuatorTemplate, CylinderTemplate, JointTemplate, Template

_LONGEST = 6
"""Joints from a barrel round to its rod, at most."""


def with_direct_hinges(
    template: Template, frames: Mapping[str, JointFrame], findings: list[Finding]
) -> tuple[Template, frozenset[str]]:
    """The template with a hinge in the place of the cylinders of every actuator that has none in the CAD model, and the
    names of those hinges.

    The hinge is the first on the shortest way from the barrel round to the rod, over the template's joints, that the
    CAD model has and no other actuator moves.
    """
    claimed = {name for actuator in template.actuators for name in actuator.joints}
    actuators: list[ActuatorTemplate] = []
    direct: list[str] = []
    for actuator in template.actuators:
        whole = any({c.slide, c.barrel_joint, c.rod_joint} <= frames.keys() for c in actuator.cylinders)
        hinge = None if whole or not actuator.cylinders else _hinge(template, actuator, frames, claimed)
        if hinge is not None:
            words = f"The CAD model has none of its cylinders: '{hinge}' is driven directly, with unlimited force."
            hint = "Give the hinge's Limit and max_force in a joints document (--data), or the cylinders in CAD."
            findings.append(Finding("MEC013", "warning", actuator.name, words, hint))
            claimed.add(hinge)
            direct.append(hinge)
            actuator = replace(actuator, kind="motor", cylinders=(), joints=(hinge,))
        actuators.append(actuator)
    if not direct:
        return template, frozenset()
    joints = tuple(replace(j, drive="angular") if j.name in direct else j for j in template.joints)
    return replace(template, actuators=tuple(actuators), joints=joints), frozenset(direct)


def direct_drives(direct: frozenset[str], frames: Mapping[str, JointFrame]) -> dict[str, Drive]:
    """The position drives of hinges that are driven directly, by joint name."""
    drives = {}
    for name in sorted(direct):
        joint = frames[name].joint
        force = joint.max_force if joint.max_force is not None else math.inf
        speed = joint.max_velocity if joint.max_velocity is not None else math.inf
        stiffness, damping = joint.stiffness or 0.0, joint.damping or 0.0
        stated = [key for key, value in (("stiffness", stiffness), ("damping", damping)) if value]
        source = f"driven directly, without its cylinder; {PROVISIONAL}"
        source += f"; {STATED}{', '.join(stated)}" if stated else ""
        drives[name] = Drive("position", stiffness, damping, force, speed, source)
    return drives


def _hinge(
    template: Template, actuator: ActuatorTemplate, frames: Mapping[str, JointFrame], claimed: set[str]
) -> str | None:
    # What a barrel or a rod hangs on moves nothing but that.
    own = {name for c in actuator.cylinders for name in (c.barrel_joint, c.rod_joint)}
    for cylinder in actuator.cylinders:
        for way in sorted(_ways(template, cylinder), key=len):
            for joint in way:
                if joint.type == "revolute" and joint.name in frames and joint.name not in claimed | own:
                    return joint.name
    return None


def _ways(template: Template, cylinder: CylinderTemplate) -> Iterator[list[JointTemplate]]:
    """Joints from a cylinder's barrel to its rod, without its slide: every way that passes no body twice."""
    by_name = {j.name: j for j in template.joints}
    slide, hung = by_name.get(cylinder.slide), by_name.get(cylinder.barrel_joint)
    if slide is None or hung is None:
        return
    ends = template.bodies_of(slide)
    barrel = next((b for b in ends if b in template.bodies_of(hung)), ends[0])
    rod = next((b for b in ends if b != barrel), None)
    beside: dict[str | None, list[tuple[JointTemplate, str | None]]] = {}
    for joint in template.joints:
        if joint.name != cylinder.slide:
            a, b = template.bodies_of(joint)
            beside.setdefault(a, []).append((joint, b))
            beside.setdefault(b, []).append((joint, a))
    stack: list[tuple[str | None, list[JointTemplate], frozenset[str | None]]] = [(barrel, [], frozenset({barrel}))]
    while stack:
        body, way, passed = stack.pop()
        if body == rod:
            yield way
            continue
        if len(way) < _LONGEST:
            for joint, other in beside.get(body, []):
                if other is not None and other not in passed:
                    stack.append((other, [*way, joint], passed | {other}))
