"""Winches: what hangs on a rope goes as the rope does, divided by its falls, with the line's pull times the falls."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from yellowiron.mechanism.joints.frames import JointFrame
from yellowiron.mechanism.values import Known, default, known
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import PROVISIONAL, STATED, ActuatorJoint, Drive
from yellowiron.model.specification import Specifications
from yellowiron.model.template import ActuatorTemplate, Template

WINCH = "winch"


def with_winches(template: Template) -> tuple[Template, dict[str, tuple[ActuatorJoint, ...]]]:
    """The template in which no winch has cylinders any more but joints, and what each moves: its slides, with the sign
    of the lever. To the alignment a rope in its block is a rod in its bore; it has no oil."""
    moved = {
        actuator.name: tuple(ActuatorJoint(c.slide, c.sign) for c in actuator.cylinders)
        for actuator in template.actuators
        if actuator.kind == WINCH
    }
    actuators = tuple(
        replace(a, cylinders=(), joints=tuple(j.joint for j in moved[a.name])) if a.name in moved else a
        for a in template.actuators
    )
    return replace(template, actuators=actuators) if moved else template, moved


def winch_drives(
    template: Template, frames: Mapping[str, JointFrame], specifications: Specifications, findings: list[Finding]
) -> dict[str, Drive]:
    """The position drive of every slide that a winch moves, by joint name: as strong as the line's pull times the
    falls, as fast as the line over them. What the joint states itself wins."""
    drives = {}
    for actuator in template.actuators:
        joints = [name for name in actuator.joints if name in frames] if actuator.kind == WINCH else []
        if not joints:
            continue
        pull, speed, falls = (
            _value(actuator, quantity, specifications, findings) for quantity in ("line_pull", "line_speed", "falls")
        )
        lines = falls.value if falls is not None else 1.0
        force = pull.value * lines if pull is not None else math.inf
        top = speed.value / lines if speed is not None else math.inf
        if pull is None:
            words = "Nothing gives its pull: it moves with unlimited force."
            hint = "Give it with --set or in the template's defaults."
            findings.append(Finding("MEC027", "warning", actuator.name, words, hint))
        said = f"{lines:g} falls ({falls.source if falls else 'one, as nothing says more'})"
        source = f"line pull {pull.source if pull else 'not limited'}, line speed "
        source += f"{speed.source if speed else 'not limited'}, {said}; {PROVISIONAL}"
        for name in joints:
            joint = template.joint(name)
            stated = {
                key: value
                for key in ("stiffness", "damping", "max_force", "max_velocity")
                if (value := getattr(joint, key)) is not None
            }
            words = source + (f"; {STATED}{', '.join(stated)}" if stated else "")
            drives[name] = replace(Drive("position", 0.0, 0.0, force, top, words), **stated)
    return drives


def _value(
    actuator: ActuatorTemplate, quantity: str, specifications: Specifications, findings: list[Finding]
) -> Known | None:
    return known(specifications, actuator.specifications.get(quantity)) or default(actuator, quantity, findings)
