"""The wheels and sprockets that a machine drives on."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Joint, Mechanism, chained
from yellowiron.simulation.ground import standing_bodies

_LEVEL = 0.9
"""Least part across the machine of a wheel's unit axis."""


@dataclass(frozen=True, eq=False)
class GroundWheel:
    """A wheel on the ground: its joint, its body's place among the bodies, middle and unit axis (machine frame, drawn
    pose), radius and half its width (metres), the sign of its joint in the actuator's positive sense, and the
    `actuator`, "" where nothing drives it."""

    joint: Joint
    body: int
    middle: Floats
    axis: Floats
    radius: float
    half_width: float
    sign: int
    actuator: str


def driven_wheels(mechanism: Mechanism) -> tuple[GroundWheel, ...]:
    """The wheels that motors drive, on the ground in the drawn pose.

    `YellowironError` where there are fewer than three wheels (a drum counts for two), but for one on either side with a
    motor of its own: what has none (a crane) does not drive.
    """
    standing = standing_bodies(mechanism)
    found = [
        _wheel(mechanism, mechanism.joint(entry.joint), entry.sign, actuator.name)
        for actuator in mechanism.actuators
        for entry in (actuator.joints if actuator.kind == "motor" else ())
        if (drive := mechanism.joint(entry.joint).drive) is not None and drive.kind == "velocity"
        and mechanism.joint(entry.joint).body1 in standing
    ]  # fmt: skip
    every = (*found, *free_wheels(mechanism))
    if not found or (sum(2 if w.half_width > w.radius else 1 for w in every) < 3 and not sides(found)):
        raise YellowironError(
            "The machine has no driven wheels to drive on",
            where=mechanism.name,
            hint="Driving needs a motor actuator whose joints lead to wheels on the ground.",
        )
    return tuple(found)


def free_wheels(mechanism: Mechanism) -> tuple[GroundWheel, ...]:
    """The wheels that nothing drives, on the ground in the drawn pose."""
    standing = standing_bodies(mechanism)
    return tuple(
        _wheel(mechanism, joint, 1, "")
        for joint in mechanism.joints
        if joint.type == "revolute" and joint.free and joint.drive is None and not joint.cut
        and joint.lower is None and joint.upper is None
        and joint.body1 in standing and abs(joint.axis[1]) > _LEVEL
    )  # fmt: skip


def _wheel(mechanism: Mechanism, joint: Joint, sign: int, actuator: str) -> GroundWheel:
    axis = np.asarray(joint.axis, dtype=np.float64)
    offset = np.asarray(mechanism.body(joint.body1).hull) - np.asarray(joint.anchor)
    along = offset @ axis
    reach = float(np.linalg.norm(offset - np.outer(along, axis), axis=1).max())
    radius = (pitch_radius(mechanism, joint) or reach) if actuator else reach
    half, center = 0.5 * float(np.ptp(along)), 0.5 * (float(along.min()) + float(along.max()))
    number = next(k for k, body in enumerate(mechanism.bodies) if body.name == joint.body1)
    return GroundWheel(joint, number, np.asarray(joint.anchor) + center * axis, axis, radius, half, sign, actuator)


def sides(found: Sequence[GroundWheel]) -> tuple[tuple[GroundWheel, ...], ...]:
    """The wheels of the left and of the right where each side has an actuator of its own, else none."""
    each = [tuple(w for w in found if w.actuator == name) for name in dict.fromkeys(w.actuator for w in found)]
    places = [float(np.mean([w.middle[1] for w in side])) for side in each]
    if len(each) != 2 or places[0] * places[1] >= 0.0:
        return ()
    return tuple(each) if places[0] > 0.0 else (each[1], each[0])


def pitch_radius(mechanism: Mechanism, sprocket: Joint) -> float | None:
    """Radius on which the pins of a ring of track shoes run around a sprocket's axis; None where there is no ring on
    its side."""
    loose = chained(mechanism)
    anchor, axis = np.asarray(sprocket.anchor), np.asarray(sprocket.axis)
    pins = np.array([j.anchor for j in mechanism.joints if j.body1 in loose and j.anchor[1] * anchor[1] > 0.0])
    if not len(pins):
        return None
    return float(np.linalg.norm(np.cross(pins - anchor, axis), axis=1).min())


def top_speed(found: Sequence[GroundWheel], otherwise: float) -> float:
    """Speed at the ground of the slowest wheel's motor, m/s."""
    speeds = [w.joint.drive.max_velocity * w.radius for w in found if w.joint.drive is not None]
    return min(speed if math.isfinite(speed) else otherwise for speed in speeds)
