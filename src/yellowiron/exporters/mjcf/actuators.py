"""MJCF's actuators: position and velocity servos with the forces and speeds of the machine's drives."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from xml.etree import ElementTree as ET

from yellowiron.exporters.mjcf.hardness import SOLIMP, SOLREF
from yellowiron.exporters.tendons import Tendon
from yellowiron.exporters.values import row, text
from yellowiron.model.mechanism import Actuator, ActuatorJoint, Drive, Joint, Mechanism, Spring

DAMPING = ".damping"
"""Ends the name of the actuator that damps another's joint; its control does nothing."""


def actuator_names(mechanism: Mechanism) -> dict[str, dict[str, str]]:
    """Actuator → its controls in MJCF, each with its joint: one control named as the actuator, or `actuator.joint` for
    each joint of a motor with several. Every control is positive in the actuator's positive sense. They are the first
    of the model's controls; those after them are the dampers of `DAMPING`, which do nothing."""
    joints = {joint.name: joint for joint in mechanism.joints}
    return {
        actuator.name: {name: entry.joint for name, entry in _controls(actuator, joints).items()}
        for actuator in mechanism.actuators
    }


def section(mechanism: Mechanism, tendons: Sequence[Tendon] = ()) -> ET.Element:
    """The `actuator` element: every control, then the dampers. `tendons` stand for slides that are no joints."""
    made = ET.Element("actuator")
    pulled = {tendon.slide.name: tendon for tendon in tendons}
    joints = {joint.name: joint for joint in (*mechanism.joints, *(tendon.slide for tendon in tendons))}
    driven = [
        (name, entry.sign, joints[entry.joint])
        for actuator in mechanism.actuators
        for name, entry in _controls(actuator, joints).items()
    ]
    for name, sign, joint in driven:
        if joint.drive is not None:
            servo = dict(_servo(joint, joint.drive, sign))
            if joint.name in pulled:
                servo = {"tendon": joint.name, **_of_length(servo, sign * pulled[joint.name].length)}
                ET.SubElement(made, "general", {"name": name, **servo})
            else:
                ET.SubElement(made, joint.drive.kind, {"name": name, "joint": joint.name, **servo})
    for name, _, joint in driven:
        if joint.drive is not None and joint.drive.rated:
            values = {"tendon" if joint.name in pulled else "joint": joint.name, "ctrlrange": "0 1", "gainprm": "0"}
            values |= {"biastype": "affine", "biasprm": row((0.0, 0.0, -joint.drive.damping))}
            ET.SubElement(made, "general", {"name": name + DAMPING, **values})
    return made


def _of_length(servo: Mapping[str, str], drawn: float) -> dict[str, str]:
    """A position servo's attributes as those of one that is told a length less the drawn one."""
    stiffness, damping = float(servo["kp"]), float(servo.get("kv", 0.0))
    left = {key: value for key, value in servo.items() if key not in ("kp", "kv")}
    bias = row((stiffness * drawn, -stiffness, -damping))
    return {"gainprm": servo["kp"], "biastype": "affine", "biasprm": bias, **left}


def brakes(mechanism: Mechanism) -> ET.Element:
    """The `custom` element: for every motor's joint with a parking brake, `JOINT.brake`, N·m. The brakes are released;
    set, they are that much `frictionloss`, which can be given to the compiled model at any time."""
    made = ET.Element("custom")
    for joint in mechanism.joints:
        if joint.drive is not None and joint.drive.brake > 0.0:
            ET.SubElement(made, "numeric", name=f"{joint.name}.brake", data=text(joint.drive.brake))
    return made


def limits(drive: Drive) -> dict[str, str]:
    """What a driven joint's own element says of its drive: armature, and for a rated one the force of its servo and
    its damper together."""
    values = {"armature": text(drive.armature)} if drive.armature > 0.0 else {}
    if drive.brake > 0.0:
        # Friction that is given later: as hard as a cut, else what it holds creeps by millimetres a second.
        values |= {"solreffriction": row(SOLREF), "solimpfriction": row(SOLIMP)}
    if drive.rated and math.isfinite(drive.strongest):
        values["actuatorfrcrange"] = row((-drive.forces[0], drive.forces[1]))
    return values


def spring(held: Spring, base: str) -> dict[str, str]:
    """What a joint's own element says of its spring; it rests where a machine with that base has it rest."""
    values = {"stiffness": held.stiffness, "springref": held.rest_of(base), "damping": held.damping}
    return {name: text(value) for name, value in values.items() if value != 0.0}


def _controls(actuator: Actuator, joints: Mapping[str, Joint]) -> dict[str, ActuatorJoint]:
    entries = actuator.joints[:1] if actuator.kind == "cylinder" else actuator.joints
    driven = [entry for entry in entries if joints[entry.joint].drive is not None and not joints[entry.joint].cut]
    if len(driven) == 1:
        return {actuator.name: driven[0]}
    return {f"{actuator.name}.{entry.joint}": entry for entry in driven}


def _servo(joint: Joint, drive: Drive, sign: int) -> Iterator[tuple[str, str]]:
    """Attributes in the actuator's sense: where its sign is negative, so are its coordinate and its force."""
    force = drive.forces
    if drive.kind == "position":
        yield "kp", text(drive.stiffness)
        if drive.rated:
            force = drive.damping * drive.speeds[0], drive.damping * drive.speeds[1]
        else:
            yield "kv", text(drive.damping)
        if joint.lower is not None and joint.upper is not None:
            yield "ctrlrange", row(sorted((sign * joint.lower, sign * joint.upper)))
    else:
        yield "kv", text(drive.damping)
        if 0.0 < drive.slowest < math.inf:
            yield "ctrlrange", row(_turned(drive.speeds, sign))
    if sign < 0:
        yield "gear", "-1"
    if 0.0 < force[0] < math.inf and 0.0 < force[1] < math.inf:
        yield "forcerange", row(_turned(force, sign))


def _turned(both: tuple[float, float], sign: int) -> tuple[float, float]:
    """(least, most) by what holds in the negative and in the positive direction."""
    negative, positive = both if sign > 0 else (both[1], both[0])
    return -negative, positive
