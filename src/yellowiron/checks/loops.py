"""The loops of a graph with bodies as nodes and joints as edges.

A loop is a cycle of the graph (a fundamental one: a closing joint and the tree's path between its bodies). Distance
joints and joints of unknown kinds only hold things together: they take part in no loop.
"""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from yellowiron.checks.values import StageJoint
from yellowiron.support.graphs import spanning_forest

_SINGLE = ("revolute", "prismatic")
_OTHER_AXIS = 0.02
"""Sine of the angle from which two axes are two axes."""
KINDS = ("fixed", "revolute", "prismatic", "spherical", "generic")


@dataclass(frozen=True, eq=False)
class LoopStep:
    """A joint passed on the way around a loop; `sign` is +1 from its first body to its second."""

    joint: StageJoint
    sign: int


@dataclass(frozen=True, eq=False)
class StageLoop:
    """A cycle: its joints in order."""

    steps: tuple[LoopStep, ...]

    @property
    def closing(self) -> StageJoint:
        """The joint that closes it."""
        return self.steps[0].joint

    @property
    def joints(self) -> tuple[StageJoint, ...]:
        """The joints around it."""
        return tuple(s.joint for s in self.steps)


def find_loops(joints: Iterable[StageJoint]) -> tuple[StageLoop, ...]:
    """The loops that joints of the kinds `KINDS` close, each by its first joint. The tree is of uncut joints as far as
    they reach: a loop is closed by a cut joint where it has one."""
    joints = list(joints)
    uncut, cut = [j for j in joints if not j.cut], [j for j in joints if j.cut]
    ends = _in_series(uncut) | {j.path: j.bodies for j in cut}
    tree, closing = spanning_forest([*uncut, *cut], lambda joint: ends[joint.path])
    return tuple(_loop(joint, tree, ends) for joint in closing)


def _in_series(joints: list[StageJoint]) -> dict[str, tuple[str, str]]:
    """Joint → the nodes it connects. MuJoCo's way of writing a joint of several freedoms is several joints between the
    same two bodies, each about or along another axis: these follow each other by nodes of their own. Two hinges on
    one axis are two pins of a loop."""
    pairs: dict[frozenset[str], list[StageJoint]] = {}
    for joint in joints:
        pairs.setdefault(frozenset(joint.bodies), []).append(joint)
    ends: dict[str, tuple[str, str]] = {}
    for group in pairs.values():
        chained = len(group) > 1 and all(
            a.type in _SINGLE and b.type in _SINGLE and _differ(a, b) for a, b in itertools.combinations(group, 2)
        )
        first, second = group[0].bodies
        nodes = [first, *(f"{j.path}:" for j in group[:-1]), second]
        for joint, near, far in zip(group, nodes[:-1], nodes[1:], strict=True):
            forward = joint.bodies == group[0].bodies
            ends[joint.path] = ((near, far) if forward else (far, near)) if chained else joint.bodies
    return ends


def _differ(a: StageJoint, b: StageJoint) -> bool:
    """Whether two hinges or slides move their bodies differently."""
    return a.type != b.type or float(np.linalg.norm(np.cross(a.axis, b.axis))) > _OTHER_AXIS


def _loop(closing: StageJoint, tree: list[StageJoint], ends: Mapping[str, tuple[str, str]]) -> StageLoop:
    """The closing joint from its first body to its second, and back along the tree."""
    goal, start = ends[closing.path]
    came: dict[str, LoopStep | None] = {start: None}
    queue = deque([start])
    while queue and goal not in came:
        node = queue.popleft()
        for joint in tree:
            if node in ends[joint.path]:
                forward = ends[joint.path][0] == node
                following = ends[joint.path][1] if forward else ends[joint.path][0]
                if following not in came:
                    came[following] = LoopStep(joint, 1 if forward else -1)
                    queue.append(following)
    steps: list[LoopStep] = []
    node = goal
    while (step := came[node]) is not None:
        steps.append(step)
        node = ends[step.joint.path][0 if step.sign > 0 else 1]
    return StageLoop((LoopStep(closing, 1), *reversed(steps)))
