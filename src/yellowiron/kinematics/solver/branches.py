"""Assembly branches: by which triangle of pivots a flip of a loop is known."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from yellowiron.kinematics.solver.chain import ClosedChain, State
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Joint, Loop, Mechanism

_PIVOTS = ("revolute", "spherical")
_ACROSS = 0.7
"""Cosine between a pivot's axis and a triangle's normal from which on it lies across the triangle."""
Pivots = tuple[str, str, str]


def branch_pivots(mechanism: Mechanism) -> dict[str, Pivots]:
    """Cut joint of each loop → its triangle of pivots (far, near, closing).

    The two links far–near and near–closing make the dyad that closes the loop: on a cylinder's loop barrel pivot, rod
    pivot and structural pivot. Its corner at `near` is straight at the loop's dead point, and changes its sign where
    the loop flips to the other branch. A loop without such a triangle is absent. Of a loop with balls the triangle is
    looked at along a pivot of its own, else square to where it is drawn (`_normal`).
    """
    by_name = {joint.name: joint for joint in mechanism.joints}
    used: set[frozenset[str]] = set()
    found: dict[str, Pivots] = {}
    for loop in sorted(mechanism.loops, key=lambda each: len(each.joints)):
        pivots = _cylinder_triangle(mechanism, loop, by_name) or _dyad(loop, by_name, used)
        if pivots is not None:
            used.add(frozenset(pivots[:2]))
            found[loop.cut] = pivots
    return {loop.cut: found[loop.cut] for loop in mechanism.loops if loop.cut in found}


def branch_sine(chain: ClosedChain, state: State, pivots: Pivots) -> float:
    """Signed sine of a triangle's corner at its `near` pivot: 0 at the dead point, its sign is the branch."""
    rotations, origins = chain.placements((state,))
    return float(branch_sines(chain, pivots, rotations, origins)[0])


def branch_sines(chain: ClosedChain, pivots: Pivots, rotations: Floats, origins: Floats) -> Floats:
    """`branch_sine` (n,) for n states at once, from their `ClosedChain.placements`."""
    joints = {joint.name: joint for joint in chain.mechanism.joints}
    frames = {body.name: np.array(body.origin) for body in chain.mechanism.bodies}

    def at(joint: Joint) -> Floats:
        index = chain.body_index(joint.body0)
        local = np.array(joint.anchor) - frames[joint.body0]
        return np.asarray(rotations[:, index] @ local + origins[:, index], dtype=np.float64)

    far, near, closing = (joints[name] for name in pivots)
    carrier, drawn = _normal(chain, far, near, closing)
    normal = rotations[:, chain.body_index(carrier)] @ drawn
    one, two = at(far) - at(near), at(closing) - at(near)
    one -= np.sum(one * normal, axis=1, keepdims=True) * normal
    two -= np.sum(two * normal, axis=1, keepdims=True) * normal
    lengths = np.linalg.norm(one, axis=1) * np.linalg.norm(two, axis=1)
    area = np.sum(np.cross(one, two) * normal, axis=1)
    return np.divide(area, lengths, out=np.zeros_like(area), where=lengths > 1e-9)


def _normal(chain: ClosedChain, far: Joint, near: Joint, closing: Joint) -> tuple[str, Floats]:
    """The direction across a triangle of pivots, as drawn, and the body that carries it: the axis of the corner's
    pivot; where there are balls the axis of a pivot that lies across the triangle, else the normal of the drawn
    triangle, on a body that does not spin idly."""
    triangle = (near, closing, far)
    if all(pivot.type == "revolute" for pivot in triangle):
        return near.body0, np.array(near.axis, dtype=np.float64)
    corner = np.array(near.anchor)
    normal = np.cross(np.array(far.anchor) - corner, np.array(closing.anchor) - corner)
    length = float(np.linalg.norm(normal))
    normal = normal / length if length > 0.0 else np.array([0.0, 0.0, 1.0])
    for pivot in triangle:
        axis = np.array(pivot.axis, dtype=np.float64)
        if pivot.type == "revolute" and abs(float(axis @ normal)) > _ACROSS:
            return pivot.body0, axis
    idle = {body for spin in chain.spins for body in spin.bodies}
    bodies = [body for joint in (far, closing, near) for body in (joint.body0, joint.body1)]
    return next((body for body in bodies if body not in idle), near.body0), normal


def _cylinder_triangle(mechanism: Mechanism, loop: Loop, joints: Mapping[str, Joint]) -> Pivots | None:
    """Where a cylinder's own pin is cut: barrel pivot, rod pivot, and the pivot between the bodies they stand on."""
    for cylinder in mechanism.cylinders:
        if loop.cut not in cylinder.pins:
            continue
        hung, held = cylinder.pins
        ends = [joints[hung], joints[held]]
        own = {cylinder.barrel, cylinder.rod}
        outer = {name for joint in ends for name in (joint.body0, joint.body1)} - own
        for joint in mechanism.joints:
            if joint.type in _PIVOTS and {joint.body0, joint.body1} == outer:
                return (hung, held, joint.name)
    return None


def _dyad(loop: Loop, joints: Mapping[str, Joint], used: set[frozenset[str]]) -> Pivots | None:
    """The two pivots that follow the cut around the loop, from the side that no shorter loop has used."""
    cut = joints[loop.cut]
    balls = any(joints[name].type == "spherical" for name in loop.joints)
    for start in (cut.body1, cut.body0):
        body, rest, pivots = start, [name for name in loop.joints if name != loop.cut], list[str]()
        while rest and len(pivots) < 2:
            following = next((n for n in rest if body in (joints[n].body0, joints[n].body1)), None)
            if following is None:
                break
            rest.remove(following)
            joint = joints[following]
            body = joint.body1 if joint.body0 == body else joint.body0
            # Crossed pins are one place, as a ball is.
            crossed = balls and any(joints[name].anchor == joint.anchor for name in pivots)
            if joint.type in _PIVOTS and not crossed:
                pivots.append(following)
        if len(pivots) == 2 and frozenset(pivots) not in used:
            return (pivots[1], pivots[0], loop.cut)
    return None
