"""Joints that follow others (mimics): what leads them is there, of their type, and the only thing that moves them."""

from __future__ import annotations

from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.values import leaf
from yellowiron.checks.view import View


@rule(
    "CHK097",
    "error",
    "Name one joint of the stage that is switched on, in newton:mimicJoint; or remove the mimic.",
)
def no_leader(view: View) -> Remarks:
    """A joint follows nothing."""
    there = {j.path for j in view.joints if j.enabled}
    for joint in view.joints:
        if joint.leader is not None and joint.enabled and joint.leader not in there:
            what = f"'{leaf(joint.leader)}' is no joint that is on" if joint.leader else "its mimic names no joint"
            yield joint.path, f"Nothing leads it: {what}."


@rule(
    "CHK098",
    "error",
    "Couple two joints of one type that are both in the tree: engines couple no others.",
)
def unlike_leader(view: View) -> Remarks:
    """A joint cannot follow its leader."""
    joints = {j.path: j for j in view.joints}
    for joint in view.joints:
        leader = joints.get(joint.leader or "")
        if leader is None:
            continue
        if leader is joint:
            yield joint.path, "It follows itself."
        elif leader.type != joint.type:
            yield joint.path, f"It is {joint.type}, and '{leader.name}', which it follows, is {leader.type}."
        elif joint.cut or leader.cut:
            lost = joint if joint.cut else leader
            yield joint.path, f"It follows '{leader.name}', and '{lost.name}' is excluded from the articulation."


@rule(
    "CHK099",
    "warning",
    "Remove its drive and drive the leader: the two pull against each other.",
)
def driven_follower(view: View) -> Remarks:
    """A joint that follows another is driven."""
    for joint in view.joints:
        if joint.leader and (joint.actuated or any(d.acts for d in joint.drives)):
            yield joint.path, f"It follows '{leaf(joint.leader)}' and has a drive of its own."
