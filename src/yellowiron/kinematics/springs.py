"""Where springs rest that are to hold the machine as drawn: stretched by what their joints carry there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import product

import numpy as np
from scipy.optimize import nnls

from yellowiron.kinematics.solver.chain import ClosedChain
from yellowiron.kinematics.strength import weight
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import GRAVITY, Joint

_TOUCHING = 0.02
"""Metres: a body that comes this near to the ground as drawn stands on it."""
_FOOT = 0.002
"""Metres above its lowest point within which a body touches the ground."""
_ROLLING = 0.9
"""Least part crosswise of a wheel's unit axis."""
_EVEN = 1e-6
"""Of two ways to stand, forces on the ground that are more even are preferred: how much, beside the balance."""
_BALANCED = 0.01
"""Share of the machine's weight that may be missing in the balance."""


def set_rests(chain: ClosedChain, joints: dict[str, Joint]) -> tuple[Finding, ...]:
    """Gives, in `joints`, the springs that are `as_drawn` their rests: on the ground, with the forces under wheels,
    tracks and feet that balance the machine, and with the root fixed. A finding where nothing balances it as drawn."""
    springs = {n: j.spring for n, j in joints.items() if j.spring is not None and j.spring.as_drawn}
    sprung = [name for name in springs if name in chain.independent]
    if not sprung:
        return ()
    mechanism, drawn = chain.mechanism, chain.drawn
    feet = list(_feet(chain))
    rolling = {joint.name for joint in joints.values() if _rolls(joint, {body for body, _ in feet})}
    moves = {
        name: np.array([chain.point_velocity(drawn, name, body, point)[2] for body, point in feet])
        for name in chain.independent
        if name in sprung or (joints[name].free and joints[name].drive is None and name not in rolling)
    }
    held = {name: weight(chain, drawn, name) for name in moves}

    # The machine as a whole, and whatever moves on its own without a spring, is balanced.
    total = GRAVITY * sum(body.mass for body in mechanism.bodies)
    middle = GRAVITY * np.sum([b.mass * np.asarray(b.center_of_mass) for b in mechanism.bodies], axis=0) / total
    loose = [name for name in moves if name not in springs]
    points = np.array([point for _, point in feet]).reshape(-1, 3)
    rows = np.vstack([np.ones(len(feet)), points[:, :2].T, *(moves[name] for name in loose)])
    sums = np.array([total, *(total * middle[:2]), *(held[name] for name in loose)]) / total
    forces = np.zeros(len(feet))
    if feet:
        even = np.vstack([rows, _EVEN * np.eye(len(feet))])
        forces = nnls(even, np.concatenate([sums, np.zeros(len(feet))]))[0]
    balanced = bool(np.abs(rows @ forces - sums).max() < _BALANCED)
    findings = []
    for name in sprung:
        spring = springs[name]
        if not spring.stiffness > 0.0:
            continue
        hanging = held[name]
        standing = hanging - total * float(moves[name] @ forces) if balanced else hanging
        source = f"{spring.source}; carries {standing:.6g} as drawn" if balanced else spring.source
        rest, above = standing / spring.stiffness, hanging / spring.stiffness
        joints[name] = replace(joints[name], spring=replace(spring, rest=rest, hanging=above, source=source))
        if not balanced:
            words = "As drawn the machine does not stand on the ground: the spring holds what hangs on it alone"
            findings.append(Finding("KIN019", "warning", name, words, "Draw its wheels on one plane, or state a rest."))
    return tuple(findings)


def _feet(chain: ClosedChain) -> Iterator[tuple[str, Floats]]:
    """(body, point (3,)) under every body that stands on the ground: the corners of the box around where it does."""
    for body in chain.mechanism.bodies:
        hull = np.asarray(body.hull, dtype=np.float64)
        if not len(hull) or hull[:, 2].min() >= _TOUCHING:
            continue
        near = hull[hull[:, 2] < hull[:, 2].min() + _FOOT]
        ends = [sorted({float(near[:, k].min()), float(near[:, k].max())}) for k in (0, 1)]
        for x, y in product(*ends):
            yield body.name, np.array([x, y, float(near[:, 2].min())])


def _rolls(joint: Joint, standing: set[str]) -> bool:
    """Whether a joint is that of a wheel on the ground, which bears no moment."""
    endless = joint.type == "revolute" and joint.lower is None and joint.upper is None
    return endless and joint.body1 in standing and abs(joint.axis[1]) > _ROLLING
