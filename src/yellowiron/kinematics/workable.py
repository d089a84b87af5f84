"""Cylinders whose linkage, as it was found, does not work: what they would move is better driven at its hinge."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from yellowiron.kinematics.solver.chain import ClosedChain, Component
from yellowiron.kinematics.solver.independence import suspects
from yellowiron.model.mechanism import Mechanism

APART = 0.01
"""Loops whose pins come farther apart over the strokes than this share of the loop's size are wrong, not inaccurate."""
SHORT = 0.05
"""A linkage that locks within this share of its cylinder's stroke moves nothing."""
_SIGNS = frozenset({"KIN001", "KIN003", "KIN005", "KIN008"})
"""Without one of these findings every linkage works."""


def unworkable(mechanism: Mechanism) -> dict[str, str]:
    """Driven slides of a completed mechanism whose linkages do not work, and why: its pins come apart (by more than
    1 % of its size), or it locks at once (within 5 % of the stroke). Linkages with a joint of a user's document are
    left as they were told."""
    if not _SIGNS & {f.code for f in mechanism.findings}:
        return {}
    chain = ClosedChain(mechanism)
    slides = {c.slide: c.stroke for c in mechanism.cylinders}
    found: dict[str, str] = {}
    for component in chain.components():
        reason = next(_faults(component, chain, slides), None)
        if reason is not None and not suspects(mechanism, (*component.drivers, *component.dependent, *component.cuts)):
            found |= {name: reason for name in component.drivers if name in slides}
    return found


def _faults(component: Component, chain: ClosedChain, strokes: dict[str, float]) -> Iterator[str]:
    joints = {j.name: j for j in chain.mechanism.joints}
    anchors = np.array([joints[name].anchor for name in (*component.drivers, *component.dependent, *component.cuts)])
    size = float(np.linalg.norm(np.ptp(anchors, axis=0)))
    for name in component.drivers:
        joint = joints[name]
        if name not in strokes or joint.lower is None or joint.upper is None:
            continue
        if joint.upper - joint.lower < SHORT * strokes[name]:
            yield f"the linkage locks after {1e3 * (joint.upper - joint.lower):.0f} mm"
        gap = max(chain.reach({name: end})[0].closure for end in (joint.lower, joint.upper))
        if gap > APART * size:
            yield f"the pins of the linkage come {1e3 * gap:.0f} mm apart"
