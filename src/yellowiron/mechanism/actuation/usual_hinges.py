"""How hinges that are driven directly usually move: over which angles, how fast, how hard. For machines whose cylinders
are not drawn.

An angle is that from the line of what a hinge is on to the line of what it turns, so that it is the same on machines
that are drawn in other poses: from the hinge to the middle of the body's hull; of what stands on the ground, or turns
about another direction, forward.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.mechanism.actuation.proportion import Proportion
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import ESTIMATE, GRAVITY, Actuator, ActuatorJoint, Body, Joint, Vector
from yellowiron.model.template import COMMON_HINGE, Template, UsualHinge

FORWARD, LEFT = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
_LEVER = 0.1
"""Of a body's size: its middle is farther than this from its hinge where that shows how it is turned."""
_MISREAD = math.radians(60.0)
"""An angle that is so far out of the usual range is no machine's."""
CARRIES = 1.5
"""Times what hangs on a hinge, stretched out: what it is driven with at least. Cylinders lift a load besides."""
_ALIKE = 0.9
"""Cosine of the angle between two axes that turn about one direction."""


@dataclass(frozen=True, eq=False)
class Turned:
    """A hinge: a point on its axis and the unit axis (3,), machine frame, and the bodies before and after it."""

    anchor: Floats
    axis: Floats
    before: str
    after: str


def angle_of(name: str, hinges: Mapping[str, Turned], points_of: Callable[[str], Floats]) -> float | None:
    """The angle (rad) at which a hinge is drawn, about its axis as `sense` turns it; None where a body lies about its
    own axis, so that its line says nothing. `hinges`: every hinge of the tree; `points_of`: points (n, 3) of a body,
    machine frame."""
    hinge = hinges[name]
    axis = sense(hinge.axis) * hinge.axis
    below = next((h for h in hinges.values() if h.after == hinge.before), None)
    if below is not None and abs(float(below.axis @ axis)) > _ALIKE:
        first = _line(points_of(hinge.before), below)
    else:
        first = LEFT if abs(float(axis @ FORWARD)) > _ALIKE else FORWARD
    second = _line(points_of(hinge.after), hinge)
    if first is None or second is None:
        return None
    return math.atan2(float(axis @ np.cross(first, second)), float(first @ second))


def sense(axis: Floats) -> float:
    """1 or −1: which way an axis is counted, along the machine's nearest direction (forward, left, up)."""
    return 1.0 if float(axis[int(np.argmax(np.abs(axis)))]) >= 0.0 else -1.0


def _line(points: Floats, hinge: Turned) -> Floats | None:
    """From a hinge, square to its axis, to the middle of the hull of points (n, 3): (3,)."""
    from scipy.spatial import QhullError
    from trimesh.convex import convex_hull

    if not len(points):
        return None
    try:
        middle = np.asarray(convex_hull(points).center_mass)
    except QhullError:
        middle = points.mean(axis=0)
    way = middle - hinge.anchor
    way = way - (way @ hinge.axis) * hinge.axis
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    return np.asarray(way) if float(np.linalg.norm(way)) > _LEVER * size else None


def carried_moment(joint: Joint, joints: Sequence[Joint], bodies: Mapping[str, Body]) -> float:
    """The moment (N·m) about a joint of the tree of all that hangs on it, each body held out as far as the hinges
    between let it be, slides as drawn. About an upright axis nothing."""
    axis = np.asarray(joint.axis, float)
    level = math.sqrt(max(0.0, 1.0 - float(axis[2]) ** 2))

    def way(a: Vector, b: Vector) -> float:
        step = np.subtract(b, a)
        return float(np.linalg.norm(step - (step @ axis) * axis))

    moment, held = 0.0, [(joint, 0.0)]
    while held:
        by, far = held.pop()
        body = bodies[by.body1]
        moment += GRAVITY * body.mass * (far + way(by.anchor, body.center_of_mass))
        held += [(j, far + way(by.anchor, j.anchor)) for j in joints if j.body0 == by.body1 and not j.cut]
    return level * moment


def with_usual(
    joint: Joint, usual: UsualHinge, drawn: float | None, proportion: Proportion, kind: str, *, carried: float = 0.0
) -> Joint:
    """A joint that is driven directly, with what is usual where nothing is stated: limits, as it is drawn at the angle
    `drawn`, a torque that suits the machine and what is `carried` (N·m), a speed. What is drawn beyond the usual range
    may go there: no machine is moved for what is usual. Far beyond it, the angle was misread, and is the range's
    end."""
    drive = joint.drive
    assert drive is not None
    middle = 0.5 * (usual.low + usual.high)
    where = "about as drawn" if drawn is None else ""
    drawn = middle if drawn is None else drawn
    drawn = middle + math.remainder(drawn - middle, 2.0 * math.pi)
    beyond = drawn - min(max(drawn, usual.low), usual.high)
    low, high = usual.low, usual.high
    if abs(beyond) > _MISREAD:
        low, high = low + beyond, high + beyond
    low, high = min(low, drawn), max(high, drawn)
    ends = low - drawn, high - drawn
    lower, upper = ends if sense(np.asarray(joint.axis)) > 0.0 else (-ends[1], -ends[0])
    place = where or f"drawn at {math.degrees(drawn):.0f}°"
    place += " (misread, or no machine stands so)" if abs(beyond) > _MISREAD else ""
    words = f"{ESTIMATE}: usual of {kind}, {place} of {math.degrees(usual.low):.0f} to {math.degrees(usual.high):.0f}°"
    source = dict(joint.source)
    if joint.lower is None and joint.upper is None:
        source["limits"] = words
        joint = replace(joint, lower=lower, upper=upper, source=source)
    torque, speed = drive.max_force, drive.max_velocity
    said, told = [], drive.source
    if math.isinf(torque) and proportion.weight > 0.0:
        torque, least = usual.torque * proportion.weight * proportion.length, CARRIES * carried
        if torque < least:
            torque = least
            told += f"; torque: {ESTIMATE}, {CARRIES:g} times what hangs on it, stretched out"
        else:
            said.append("torque")
    if math.isinf(speed):
        speed = usual.speed
        said.append("speed")
    told += f"; {' and '.join(said)}: {ESTIMATE}, usual of {kind}" if said else ""
    drive = replace(drive, max_force=torque, max_velocity=speed, source=told)
    return replace(joint, drive=drive)


def hinges_driven_directly(
    template: Template,
    joints: tuple[Joint, ...],
    direct: Mapping[str, str],
    points_of: Callable[[str], Floats],
    proportion: Proportion,
    bodies: Sequence[Body],
) -> tuple[Joint, ...]:
    """The joints, those of `direct` (hinge → actuator) with what is usual of the type's. `points_of`: points (n, 3) of
    a body, metres, machine frame as drawn."""
    by_name = {body.name: body for body in bodies}
    turned = {
        j.name: Turned(np.asarray(j.anchor), np.asarray(j.axis), j.body0, j.body1)
        for j in joints
        if j.type == "revolute" and not j.cut
    }
    kind = template.equipment_type.replace("_", " ") + "s"
    made = []
    for joint in joints:
        if joint.name in direct and joint.name in turned and joint.drive is not None:
            usual = template.hinges.get(direct[joint.name], COMMON_HINGE)
            drawn = None if usual.from_drawn else angle_of(joint.name, turned, points_of)
            carried = carried_moment(joint, joints, by_name)
            whose = "machines" if usual.common else kind
            joint = with_usual(joint, usual, drawn, proportion, whose, carried=carried)
        made.append(joint)
    return tuple(made)


def with_senses(
    template: Template, actuators: Sequence[Actuator], joints: Sequence[Joint], direct: Mapping[str, str]
) -> tuple[Actuator, ...]:
    """The actuators, those whose hinges are driven in the place of their cylinders (`direct`) moving them the way that
    the cylinders would: positive raises a boom."""
    axes = {j.name: np.asarray(j.axis) for j in joints}

    def turned(each: ActuatorJoint) -> ActuatorJoint:
        if each.joint not in direct:
            return each
        usual = template.hinges.get(direct[each.joint], COMMON_HINGE)
        return replace(each, sign=usual.sense * int(sense(axes[each.joint])))

    return tuple(replace(a, joints=tuple(turned(each) for each in a.joints)) for a in actuators)
