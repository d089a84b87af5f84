"""What would let a locked linkage with balls move, by the rank on the drawn geometry."""

from __future__ import annotations

import numpy as np

from yellowiron.model.mechanism import Joint, Mechanism, independent_joints
from yellowiron.support.graphs import blocks
from yellowiron.support.spatial import SpatialJoint, freedom, unlocking
from yellowiron.support.text import with_article

_SHOWN = 6
"""Ways that are told."""


def locked_hint(mechanism: Mechanism) -> str:
    """Which joints to free where a group of loops with balls moves in fewer ways than it is driven; else that a pivot
    is missing."""
    joints = {j.name: j for j in mechanism.joints if j.type != "fixed"}
    given = set(independent_joints(mechanism))
    for names in blocks({name: (j.body0, j.body1) for name, j in joints.items()}):
        if len(names) == 1 or not any(joints[n].type == "spherical" for n in names):
            continue
        members = [_in_space(joints[n]) for n in names]
        own = given.intersection(names)
        if freedom(members) - freedom(members, held=own) < len(own) and (ways := unlocking(members, own)):
            told = [
                " and ".join(f"{name} as {with_article(kind)} joint" for name, kind in way.items())
                for way in ways[:_SHOWN]
            ]
            return f"Its loops hold each other. It moves with {', or with '.join(told)}."
    return "A pivot is missing: a loop is locked."


def _in_space(joint: Joint) -> SpatialJoint:
    follows = (joint.follows.joint, joint.follows.ratio) if joint.follows is not None else None
    anchor, axis = np.array(joint.anchor, dtype=np.float64), np.array(joint.axis, dtype=np.float64)
    return SpatialJoint(joint.name, joint.type, (joint.body0, joint.body1), anchor, axis, follows)
