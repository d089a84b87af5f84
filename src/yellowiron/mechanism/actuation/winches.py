"""Winches: what hangs on a rope goes as the rope does, divided by its falls, with the line's pull times the falls."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from yellowiron.mechanism.joints.frames import JointFrame
from yellowiron.mechanism.values import Known, default, known
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
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


def winch_falls(template: Template, specifications: Specifications) -> dict[str, int]:
    """How many lines of each winch's rope carry what it moves, by actuator; one where nothing says more."""
    found = {}
    for actuator in template.actuators:
        if actuator.kind == WINCH:
            falls = _value(actuator, "falls", specifications, [])
            found[actuator.name] = max(1, round(falls.value)) if falls is not None else 1
    return found


@dataclass(frozen=True, eq=False)
class _Raised:
    """What a winch raises: the `hinge`, the point that `end`s its boom's line, where the slide's two bodies are pinned
    (`pins`), and which of them, 0 or 1, hangs on the boom."""

    hinge: JointFrame
    end: Floats
    pins: tuple[Floats, Floats]
    hung: int


def winch_limits(
    template: Template, frames: Mapping[str, JointFrame], specifications: Specifications, findings: list[Finding]
) -> dict[str, tuple[float, float, dict[str, Any]]]:
    """How far the slide of a winch goes that raises a boom by a rope between two pins, by joint name: lower and upper
    limit (m, from the drawn place) and their evidence. They are where the boom has its least and its largest angle; the
    drawn place is always between them. None of a slide whose hinge, pins or angles are not known."""
    limits = {}
    for actuator in template.actuators:
        slide = next((frames[name] for name in actuator.joints if name in frames), None) if actuator.raises else None
        raised = _raised(actuator, slide, frames) if slide is not None else None
        if slide is None or raised is None:
            continue
        low, high = (_value(actuator, quantity, specifications, findings) for quantity in ("low_angle", "high_angle"))
        if low is None or high is None:
            continue
        ends = [_paid_out(slide, raised, angle.value) for angle in (low, high)]
        evidence = {"limits": f"the boom is between its least angle ({low.source}) and its largest ({high.source})"}
        limits[slide.joint.name] = (min(0.0, *ends), max(0.0, *ends), evidence)
    return limits


def _raised(actuator: ActuatorTemplate, slide: JointFrame, frames: Mapping[str, JointFrame]) -> _Raised | None:
    """What it raises; None where the hinge, the line's end or a pin is not there."""
    hinge = frames.get(actuator.raises[0])
    end = next((frames[name] for name in actuator.raises[1:] if name in frames), None)
    if hinge is None or end is None:
        return None
    pinned = {
        body: (other, frame.anchor)
        for frame in frames.values()
        for body, other in (frame.bodies, frame.bodies[::-1])
        if body in slide.bodies and other in hinge.bodies
    }
    boom = next((body for body in hinge.bodies if body in end.bodies), None)
    hung = [k for k, body in enumerate(slide.bodies) if body in pinned and pinned[body][0] == boom]
    if len(pinned) < 2 or len(hung) != 1:
        return None
    first, second = (pinned[body][1] for body in slide.bodies)
    return _Raised(hinge, end.anchor, (first, second), hung[0])


def _paid_out(slide: JointFrame, raised: _Raised, angle: float) -> float:
    """The slide's coordinate with which the line from the hinge to its end rises at `angle` (rad) from level."""
    foot, level = raised.hinge.anchor, np.cross(raised.hinge.axis, np.array([0.0, 0.0, 1.0]))
    level *= math.copysign(1.0, float(level @ (raised.end - foot))) / np.linalg.norm(level)
    plane = np.array([level, [0.0, 0.0, 1.0]])
    along, line = plane @ slide.axis, plane @ (raised.end - foot)
    pins = [plane @ (pin - foot) for pin in raised.pins]
    turn = angle - math.atan2(line[1], line[0])
    turned = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    before = pins[1] - pins[0]
    pins[raised.hung] = turned @ pins[raised.hung]
    after = pins[1] - pins[0]
    # The slide's line may pass beside its pins.
    aside = float(along[0] * before[1] - along[1] * before[0])
    lengths = [math.sqrt(max(0.0, float(way @ way) - aside**2)) for way in (before, after)]
    return math.copysign(1.0, float(along @ before)) * (lengths[1] - lengths[0])


def _value(
    actuator: ActuatorTemplate, quantity: str, specifications: Specifications, findings: list[Finding]
) -> Known | None:
    return known(specifications, actuator.specifications.get(quantity)) or default(actuator, quantity, findings)
