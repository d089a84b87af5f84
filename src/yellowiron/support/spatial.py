"""Joints in space: how many ways bodies can move, by the rank of the constraint Jacobian (six columns a body, five rows
a pivot or slide, three a ball, one a distance), which links only spin about their own line, and what holds too much.

Bodies and joints by name, a joint with a point and a direction; metres, any one frame.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.support.graphs import components

FREEDOMS: Mapping[str, int] = {"fixed": 0, "distance": 5, "spherical": 3, "revolute": 1, "prismatic": 1}
"""Joint type → its degrees of freedom in space."""
_FREER: Mapping[str, str] = {"revolute": "spherical", "spherical": "distance"}
"""What a joint that holds too much could be instead."""
_MOST = 24
"""Joints of which pairs are still tried."""
_SHORT = 1e-6
"""Metres between two balls that give no line."""
_RANK = 1e-7
"""Singular values below this share of the greatest are 0."""


@dataclass(frozen=True, eq=False)
class SpatialJoint:
    """A joint between two bodies: `anchor` (3,) a point on the unit vector `axis` (3,); of a distance joint the axis is
    the line between its two ends. `follows`: (leader, ratio)."""

    name: str
    type: str
    bodies: tuple[str, str]
    anchor: Floats
    axis: Floats
    follows: tuple[str, float] | None = None


@dataclass(frozen=True)
class IdleLink:
    """Bodies that hang between two balls and nothing else, sliding in each other at most: they can spin about the line
    of these balls, which moves nothing else."""

    bodies: tuple[str, ...]
    balls: tuple[str, str]


def idle_links(root: str, ends: Mapping[str, tuple[str, str]], types: Mapping[str, str]) -> tuple[IdleLink, ...]:
    """The links that spin idly, in the order of the bodies. `ends`: joint → its two bodies (welds taken for one body),
    `types`: joint → its type."""
    bodies = dict.fromkeys(body for pair in ends.values() for body in pair)
    found = []
    for group in components(bodies, (pair for name, pair in ends.items() if types[name] == "prismatic")):
        inside = set(group)
        if root in inside:
            continue
        holding = [name for name, pair in ends.items() if len(inside.intersection(pair)) == 1]
        within = [name for name, pair in ends.items() if inside.issuperset(pair)]
        hung = len(holding) == 2 and all(types[n] == "spherical" for n in holding)
        if hung and all(types[n] == "prismatic" for n in within):
            found.append(IdleLink(group, (holding[0], holding[1])))
    return tuple(found)


def freedom(joints: Sequence[SpatialJoint], *, held: Collection[str] = ()) -> int:
    """In how many ways the bodies of these joints move against each other, the joints `held` not moving; spins of idle
    links included."""
    bodies = list(dict.fromkeys(body for joint in joints for body in joint.bodies))
    matrix = _jacobian(bodies, joints, held)
    if not matrix.size:
        return 6 * (len(bodies) - 1)
    values = np.linalg.svd(matrix, compute_uv=False)
    return 6 * (len(bodies) - 1) - int(np.count_nonzero(values > _RANK * max(1.0, float(values[0]))))


def grubler(joints: Sequence[SpatialJoint]) -> int:
    """The count 6(n−1) − Σ(6−f), less 1 for each joint that follows."""
    bodies = {body for joint in joints for body in joint.bodies}
    count = 6 * (len(bodies) - 1) - sum(6 - FREEDOMS[joint.type] for joint in joints)
    return count - sum(joint.follows is not None for joint in joints)


def superfluous(joints: Sequence[SpatialJoint]) -> dict[str, str]:
    """Joint → what would do in its place, where the others hold what it holds already: "" (nothing), a distance joint
    or a ball. None of it changes how the bodies move."""
    before = freedom(joints)
    found = {}
    for index, joint in enumerate(joints):
        if joint.type not in _FREER:
            continue
        rest = [*joints[:index], *joints[index + 1 :]]
        if {b for j in rest for b in j.bodies} >= set(joint.bodies) and freedom(rest) == before:
            found[joint.name] = ""
            continue
        kind = joint.type
        while kind in _FREER and freedom(_with_types(joints, {index: _FREER[kind]})) == before:
            kind = _FREER[kind]
        if kind != joint.type:
            found[joint.name] = kind
    return found


def unlocking(joints: Sequence[SpatialJoint], given: Collection[str]) -> tuple[dict[str, str], ...]:
    """The smallest changes with which the joints `given` can all move as they like, joint → the type it would be: those
    of one joint first, then of two of one type that are none of these. Driven cylinders stay on their pins."""
    driven = {body for j in joints if j.name in given and j.type == "prismatic" for body in j.bodies}
    places = [
        i
        for i, joint in enumerate(joints)
        if joint.type in _FREER and joint.name not in given and not driven.intersection(joint.bodies)
    ]
    alone = [(i,) for i in places if _frees(joints, (i,), given)]
    rest = [i for i in places if (i,) not in alone]
    pairs = [
        pair
        for pair in (itertools.combinations(rest, 2) if len(rest) <= _MOST else ())
        if joints[pair[0]].type == joints[pair[1]].type and _frees(joints, pair, given)
    ]
    return tuple({joints[i].name: _FREER[joints[i].type] for i in way} for way in (*alone, *pairs))


def _frees(joints: Sequence[SpatialJoint], indices: Iterable[int], given: Collection[str]) -> bool:
    changed = _with_types(joints, {i: _FREER[joints[i].type] for i in indices})
    wanted = sum(FREEDOMS[joint.type] for joint in joints if joint.name in given)
    return freedom(changed) - freedom(changed, held=given) == wanted


def _with_types(joints: Sequence[SpatialJoint], types: Mapping[int, str]) -> list[SpatialJoint]:
    return [replace(j, type=types[i]) if i in types else j for i, j in enumerate(joints)]


def _jacobian(bodies: Sequence[str], joints: Iterable[SpatialJoint], held: Collection[str]) -> Floats:
    """Rows: velocity constraints; columns: the twist (angular, then linear at the origin) of every body but the
    first."""
    number = {body: index for index, body in enumerate(bodies)}
    rows: list[Floats] = []
    moved: dict[str, Floats] = {}

    def apart(local: Floats, joint: SpatialJoint) -> Floats:
        made = np.zeros((len(local), 6 * len(bodies)))
        for body, sign in zip(joint.bodies, (-1.0, 1.0), strict=True):
            made[:, 6 * number[body] : 6 * number[body] + 6] += sign * local
        return made

    joints = list(joints)
    for joint in joints:
        x, y, z = joint.anchor
        # The velocity of a body's point there, of its twist; the turning alone.
        point = np.hstack([np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]), np.eye(3)])
        turn = np.hstack([np.eye(3), np.zeros((3, 3))])
        across = _normals(joint.axis)
        if joint.name in held or joint.type == "fixed":
            local = np.vstack([turn, point])
        elif joint.type == "spherical":
            local = point
        elif joint.type == "revolute":
            local = np.vstack([point, across @ turn])
        elif joint.type == "prismatic":
            local = np.vstack([turn, across @ point])
        else:
            local = joint.axis[None] @ point
        rows.append(apart(local, joint))
        moved[joint.name] = apart(joint.axis[None] @ (point if joint.type == "prismatic" else turn), joint)
    for joint in joints:
        if joint.follows is not None and joint.follows[0] in moved:
            rows.append(moved[joint.name] - joint.follows[1] * moved[joint.follows[0]])
    return np.vstack(rows)[:, 6:] if rows else np.zeros((0, 6 * len(bodies) - 6))


def _normals(axis: Floats) -> Floats:
    """Two unit vectors (2, 3) across an axis."""
    helper = np.eye(3)[int(np.argmin(np.abs(axis)))]
    one = np.cross(axis, helper)
    one /= np.linalg.norm(one)
    return np.array([one, np.cross(axis, one) / np.linalg.norm(axis)])


@dataclass(frozen=True, eq=False)
class IdleSpin:
    """A link that can spin: its `bodies`, the `ball` of the tree that leads to it, and its `line`, a unit vector in the
    drawn pose."""

    bodies: tuple[str, ...]
    ball: str
    line: Floats


def idle_spins(mechanism: Mechanism) -> tuple[IdleSpin, ...]:
    """The idle spins of a mechanism, in the order of its bodies. The kinematics carries
    such links without twist: each goes from its drawn direction to its present one by the shortest turn."""
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
