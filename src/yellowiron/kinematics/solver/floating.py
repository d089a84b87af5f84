"""What the kinematics leaves out: chains that no joint ties to the machine (rings of track shoes)."""

from __future__ import annotations

from dataclasses import replace

from yellowiron.model.mechanism import Mechanism, chained


def attached(mechanism: Mechanism) -> Mechanism:
    """The mechanism without its floating chains: their bodies, joints and loops. They touch it, and what they do is the
    dynamics' concern."""
    loose = chained(mechanism)
    if not loose:
        return mechanism
    joints = tuple(j for j in mechanism.joints if j.body0 not in loose and j.body1 not in loose)
    names = {j.name for j in joints}
    return replace(
        mechanism,
        bodies=tuple(b for b in mechanism.bodies if b.name not in loose),
        joints=joints,
        loops=tuple(loop for loop in mechanism.loops if loop.cut in names),
        sites=tuple(s for s in mechanism.sites if s.body not in loose),
        floating=(),
    )
