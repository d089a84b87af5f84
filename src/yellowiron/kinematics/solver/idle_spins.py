"""Links between two balls: they can spin about the line of these, which moves nothing else. The kinematics carries them
without twist: each goes from its drawn direction to its present one by the shortest turn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.support.graphs import components
from yellowiron.support.spatial import idle_links

_SHORT = 1e-6
"""Metres between two balls that give no line."""


@dataclass(frozen=True, eq=False)
class IdleSpin:
    """A link that can spin: its `bodies`, the `ball` of the tree that leads to it, and its `line`, a unit vector in the
    drawn pose."""

    bodies: tuple[str, ...]
    ball: str
    line: Floats


def idle_spins(mechanism: Mechanism) -> tuple[IdleSpin, ...]:
    """The idle spins of a mechanism, in the order of its bodies."""
    joints = {joint.name: joint for joint in mechanism.joints}
    if not any(joint.type == "spherical" for joint in mechanism.joints):
        return ()
    welds = [(j.body0, j.body1) for j in mechanism.joints if j.type == "fixed"]
    welded = components([body.name for body in mechanism.bodies], welds)
    one = {body: group[0] for group in welded for body in group}
    ends = {j.name: (one[j.body0], one[j.body1]) for j in mechanism.joints if one[j.body0] != one[j.body1]}
    found = []
    for link in idle_links(one[mechanism.root], ends, {name: joints[name].type for name in ends}):
        line = np.subtract(joints[link.balls[1]].anchor, joints[link.balls[0]].anchor)
        length = float(np.linalg.norm(line))
        inside = tuple(body for group in welded if group[0] in link.bodies for body in group)
        leading = next((n for n in link.balls if not joints[n].cut and joints[n].body1 in inside), None)
        if leading is not None and length > _SHORT:
            found.append(IdleSpin(inside, leading, line / length))
    return tuple(found)
