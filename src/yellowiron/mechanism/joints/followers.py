"""Joints that follow others: chains, gears and ropes between the machine's joints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from yellowiron.mechanism.joints.axes import machine_sense
from yellowiron.mechanism.joints.frames import RAM, JointFrame
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Joint
from yellowiron.model.template import Template
from yellowiron.support.vectors import clean_triple

_ASIDE = 0.1
"""Cosine of the angle between two slides below which neither points along the other."""


def with_followers(
    joints: Sequence[Joint], template: Template, frames: Mapping[str, JointFrame], findings: list[Finding]
) -> tuple[Joint, ...]:
    """The joints, those that follow another with what they follow and their senses told by their leaders.

    A slide's sense is told by its cylinder, where that hangs on pins: it extends. One that leads or follows has none as
    a rule: the first of all leads in the sense of the machine (up, left, forward), and a slide beside its leader points
    the same way, so that a ratio above 0 says that both move alike. A leader that is not there, or that is cut, leads
    nothing (MEC037).
    """
    made = {joint.name: joint for joint in joints}
    leads = {j.name: j.follows for j in template.joints if j.follows is not None and j.name in made}
    for name, follows in leads.items():
        lost = next((n for n in (follows.joint, name) if n not in made or made[n].cut), None)
        if lost is not None:
            what = "is cut from the tree" if lost in made else "was not found"
            words = f"'{lost}' {what}, so that nothing leads this joint."
            hint = f"It follows '{follows.joint}': give that joint its parts in the alignment."
            findings.append(Finding("MEC037", "error", name, words, hint))
        else:
            made[name] = replace(made[name], follows=follows)
    followed = {j.follows.joint for j in made.values() if j.follows is not None}
    settled: dict[str, Joint] = {}

    def settle(name: str) -> Joint:
        """A joint after its leader: leaders lead in no circle, which loading a template sees to."""
        if name not in settled:
            joint = made[name]
            leader = settle(joint.follows.joint) if joint.follows is not None else None
            if joint.type == "prismatic" and (leader is not None or name in followed):
                joint = _sensed(joint, leader, template, frames)
            settled[name] = joint
        return settled[name]

    return tuple(settle(joint.name) for joint in joints)


def _sensed(joint: Joint, leader: Joint | None, template: Template, frames: Mapping[str, JointFrame]) -> Joint:
    """A slide that leads or follows, pointing the way that its coupling means."""
    axis = np.asarray(joint.axis, dtype=np.float64)
    cylinders = [c for a in template.actuators for c in a.cylinders if c.slide == joint.name]
    if leader is not None and any(c.barrel_joint for c in cylinders):
        return joint
    if leader is not None and abs(axis @ np.asarray(leader.axis)) > _ASIDE:
        outwards = axis if axis @ np.asarray(leader.axis) > 0.0 else -axis
    elif cylinders or any(template.role(body).kind in RAM for body in frames[joint.name].bodies):
        return joint
    else:
        outwards = machine_sense(axis)
    return replace(joint, axis=clean_triple(outwards))
