"""Joints: that each joins two things that are there."""

from __future__ import annotations

from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.values import WORLD
from yellowiron.checks.view import View

_ENDS = ("body0", "body1")


@rule(
    "CHK040",
    "error",
    "Name its bodies in physics:body0 and physics:body1; one may be left out for the world.",
)
def no_bodies(view: View) -> Remarks:
    """A joint joins nothing."""
    for joint in view.joints:
        if not any(s.targets for s in joint.sides):
            yield joint.path, "Neither body0 nor body1 is given."


@rule(
    "CHK041",
    "error",
    "Correct the path, or remove the joint.",
)
def no_such_body(view: View) -> Remarks:
    """A joint's body does not exist."""
    for joint in view.joints:
        for end, side in zip(_ENDS, joint.sides, strict=True):
            for path in side.missing:
                yield joint.path, f"Its {end} is {path}, which is not there, or is deactivated."


@rule(
    "CHK042",
    "error",
    "Name the two bodies that it joins.",
)
def same_body(view: View) -> Remarks:
    """A joint joins a body to itself."""
    for joint in view.joints:
        first, second = joint.bodies
        if first == second and (first != WORLD or joint.sides[0].targets == joint.sides[1].targets != ()):
            yield joint.path, f"Both its ends are on {first or joint.sides[0].targets[0]}."


@rule(
    "CHK043",
    "error",
    "Name one body; make a joint for each pair.",
)
def several_bodies(view: View) -> Remarks:
    """A joint names several bodies at one end."""
    for joint in view.joints:
        for end, side in zip(_ENDS, joint.sides, strict=True):
            if len(side.targets) > 1:
                yield joint.path, f"Its {end} names {', '.join(side.targets)}."


@rule(
    "CHK044",
    "warning",
    "Apply PhysicsRigidBodyAPI to the link; a joint to the world leaves the end out.",
)
def no_rigid_body(view: View) -> Remarks:
    """A joint holds to something that is no rigid body."""
    for joint in view.joints:
        if joint.type == "fixed" or not view.bodies:
            continue
        for end, side, other in zip(_ENDS, joint.sides, joint.bodies[::-1], strict=True):
            if not side.targets or side.missing or side.body != WORLD or side.targets[0] in view.bodies:
                continue
            if not _holds(side.targets[0], other):
                yield joint.path, f"Its {end} {side.targets[0]} is no rigid body, so it holds to the world."


def _holds(path: str, body: str) -> bool:
    """Whether a prim is above a body: the machine's own prim stands for where the machine is."""
    return body.startswith(f"{path}/") or path == "/"


@rule(
    "CHK045",
    "info",
    "Switch it on, or remove it.",
)
def disabled(view: View) -> Remarks:
    """A joint is switched off."""
    for joint in view.joints:
        if not joint.enabled:
            yield joint.path, "jointEnabled is false."
