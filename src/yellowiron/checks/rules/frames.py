"""Joint frames: both ends must agree in the drawn pose, up to what the joint leaves free."""

from __future__ import annotations

import math

import numpy as np

from yellowiron.checks.loops import KINDS
from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.tolerances import FRAMES_APART
from yellowiron.checks.values import LINEAR, StageJoint, direction
from yellowiron.checks.view import View

_TURNED = 1e-3
"""Radians."""
_UNIT = 1e-3
_AT_ZERO = (1e-3, 1e-3)
"""Radians and metres within which a joint is drawn at its zero."""
_MOST = 4


def _joined(view: View) -> list[StageJoint]:
    """Joints whose both ends are somewhere, with frames that are numbers."""
    return [
        j
        for j in view.joints
        if j.type in KINDS
        and any(s.targets for s in j.sides)
        and not any(s.missing for s in j.sides)
        and all(np.isfinite(s.position).all() and np.isfinite(s.rotation).all() for s in j.sides)
    ]


@rule(
    "CHK050",
    "error",
    "Give localPos0 and localPos1 the same point of the drawn pose: an engine pulls the bodies together at its "
    "first step.",
)
def apart(view: View) -> Remarks:
    """A joint's two frames are apart."""
    for joint in _joined(view):
        offset = joint.sides[1].position - joint.sides[0].position
        for freedom in joint.freedoms:
            if freedom in LINEAR:
                axis = direction(joint.sides[0].rotation, freedom)
                offset = offset - (offset @ axis) * axis
        distance = float(np.linalg.norm(offset))
        reach = float(np.abs(joint.sides[0].position).max())
        if distance > FRAMES_APART * max(1.0, reach / 10.0):
            beside = " beside its axis" if joint.type == "prismatic" else ""
            yield joint.path, f"Its frames are {1e3 * distance:.4g} mm apart{beside}."


@rule(
    "CHK051",
    "error",
    "Give localRot0 and localRot1 the same directions in the drawn pose.",
)
def turned(view: View) -> Remarks:
    """A joint's two frames are turned against each other."""
    for joint in _joined(view):
        if joint.type == "revolute":
            angle, what = joint.tilt, "axes"
        elif joint.type in ("prismatic", "fixed"):
            relative = joint.sides[0].rotation.T @ joint.sides[1].rotation
            angle, what = math.acos(max(-1.0, min(1.0, (float(np.trace(relative)) - 1.0) / 2.0))), "frames"
        else:
            continue
        if angle > _TURNED:
            yield joint.path, f"Its two {what} differ by {math.degrees(angle):.4g}°."


@rule(
    "CHK052",
    "error",
    "Write a quaternion of length 1, real part first.",
)
def no_rotation(view: View) -> Remarks:
    """A joint frame's rotation is no rotation."""
    for joint in view.joints:
        for end, side in enumerate(joint.sides):
            if abs(side.norm - 1.0) > _UNIT:
                yield joint.path, f"localRot{end} is a quaternion of length {side.norm:.4g}."


@rule(
    "CHK053",
    "warning",
    "Turn its frames so that the drawn pose is zero like that of all others, or its limits and targets mean "
    "something else.",
)
def odd_zero(view: View) -> Remarks:
    """One joint alone is drawn away from its zero."""
    for island in view.islands:
        joints = [j for j in _joined(view) if j in island.joints and j.type in ("revolute", "prismatic")]
        off = [j for j in joints if abs(j.coordinate) > _AT_ZERO[j.type == "prismatic"]]
        if len(off) == 1 and len(joints) >= _MOST:
            joint = off[0]
            value = (
                f"{1e3 * joint.coordinate:.4g} mm"
                if joint.type == "prismatic"
                else f"{math.degrees(joint.coordinate):.4g}°"
            )
            yield joint.path, f"It is drawn at {value}, all others at 0."
