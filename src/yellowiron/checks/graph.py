"""Bodies as nodes and joints as edges: what hangs together, the articulation's trees, and the loops.

A loop is a cycle of the graph (a fundamental one: a closing joint and the tree's path between its bodies). Distance
joints and joints of unknown kinds only hold things together: they take part in no loop.
"""

from __future__ import annotations

import functools
import itertools
from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from yellowiron.checks.motion import Motion
from yellowiron.checks.view import WORLD, Body, Joint, extent, union
from yellowiron.model.geometry import Floats

_SINGLE = ("revolute", "prismatic")
_OTHER_AXIS = 0.02
"""Sine of the angle from which two axes are two axes."""
KINDS = ("fixed", "revolute", "prismatic", "spherical", "generic")


@dataclass(frozen=True, eq=False)
class Step:
    """A joint passed on the way around a loop; `sign` is +1 from its first body to its second."""

    joint: Joint
    sign: int


@dataclass(frozen=True, eq=False)
class Loop:
    """A cycle: its joints in order."""

    steps: tuple[Step, ...]

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The joints around it."""
        return tuple(s.joint for s in self.steps)


@dataclass(frozen=True, eq=False)
class Island:
    """Bodies that enabled joints hold together, in the file's order, and those joints. `roots` are the articulation
    roots that it falls under: prims at or above its bodies, and joints of its own; `trees` its bodies as the uncut
    joints connect them."""

    bodies: tuple[Body, ...]
    joints: tuple[Joint, ...]
    roots: tuple[str, ...]
    trees: tuple[tuple[str, ...], ...]
    loops: tuple[Loop, ...]
    uncut: tuple[Joint, ...]

    @property
    def where(self) -> str:
        """The prim to name for it: its root, else its first body."""
        return self.roots[0] if self.roots else self.bodies[0].path

    @property
    def floating(self) -> bool:
        """Whether the build meant it to be held by nothing: a ring of track shoes, which lies on the machine."""
        return any(j.record.get("floating") for j in self.joints)

    @functools.cached_property
    def size(self) -> float:
        """The diagonal of the box around its geometry and its pins, metres."""
        boxes = [b.bounds for b in self.bodies if b.bounds is not None]
        boxes += [np.stack([p, p]) for j in self.joints for p in [j.sides[0].position]]
        boxes = [b for b in boxes if np.isfinite(b).all()]
        return extent(union(boxes))

    @functools.cached_property
    def center(self) -> Floats:
        """The mean of its pins, (3,)."""
        points = [j.sides[0].position for j in self.joints if np.isfinite(j.sides[0].position).all()]
        return np.mean(points, axis=0) if points else np.zeros(3)

    @functools.cached_property
    def mass(self) -> float:
        """The sum of the authored masses, kg."""
        return float(sum(b.mass for b in self.bodies if b.mass is not None and np.isfinite(b.mass)))

    @functools.cached_property
    def motion(self) -> Motion | None:
        """How its loops let it move at once from the drawn pose; None where a frame is not a number."""
        return Motion.of(self.loops, center=self.center, size=self.size)

    @functools.cached_property
    def in_loops(self) -> frozenset[str]:
        """Paths of the joints that are part of a loop."""
        return frozenset(j.path for loop in self.loops for j in loop.joints)

    def beyond(self, joint: Joint) -> tuple[Body, ...]:
        """The bodies that would come off with `joint` removed, on its second side; () for a joint of a loop."""
        first, second = joint.bodies
        reached = {second}
        queue = deque([second])
        while queue:
            body = queue.popleft()
            for other in self.joints:
                if other is not joint and body in other.bodies:
                    following = other.bodies[1] if other.bodies[0] == body else other.bodies[0]
                    if following not in reached:
                        reached.add(following)
                        queue.append(following)
        if first in reached:
            return ()
        return tuple(b for b in self.bodies if b.path in reached)


def build_islands(bodies: Mapping[str, Body], joints: Iterable[Joint], roots: Iterable[str]) -> tuple[Island, ...]:
    """Every island that has a joint, in the file's order. The world joins nothing: two robots on one floor are two."""
    edges = [
        j
        for j in joints
        if j.enabled and j.bodies[0] != j.bodies[1] and not any(s.missing or len(s.targets) > 1 for s in j.sides)
    ]
    groups = _components([b for b in bodies if any(b in j.bodies for j in edges)], edges)
    return tuple(_island(group, bodies, edges, tuple(roots)) for group in groups)


def _components(nodes: list[str], edges: list[Joint]) -> list[tuple[str, ...]]:
    """Nodes by connection, not through the world, in the nodes' order."""
    parent = {n: n for n in nodes}

    def find(node: str) -> str:
        while parent[node] != node:
            parent[node] = parent[parent[node]]
            node = parent[node]
        return node

    for edge in edges:
        first, second = edge.bodies
        if first in parent and second in parent:
            parent[find(second)] = find(first)
    groups: dict[str, list[str]] = {}
    for node in nodes:
        groups.setdefault(find(node), []).append(node)
    return [tuple(g) for g in groups.values()]


def _island(group: tuple[str, ...], bodies: Mapping[str, Body], edges: list[Joint], roots: tuple[str, ...]) -> Island:
    members = set(group)
    joints = [j for j in edges if members.intersection(j.bodies)]
    links = [j for j in joints if j.type in KINDS]
    ends = _in_series([j for j in links if not j.cut]) | {j.path: j.bodies for j in links if j.cut}
    tree, closing = _spanning_tree([*(j for j in links if not j.cut), *(j for j in links if j.cut)], ends)
    return Island(
        bodies=tuple(bodies[b] for b in group),
        joints=tuple(joints),
        roots=tuple(
            r for r in roots if any(b == r or b.startswith(f"{r}/") for b in group) or any(j.path == r for j in joints)
        ),
        trees=tuple(_components(list(group), [j for j in links if not j.cut])),
        loops=tuple(_loop(joint, tree, ends) for joint in closing),
        uncut=tuple(j for j in closing if not j.cut),
    )


def _in_series(joints: list[Joint]) -> dict[str, tuple[str, str]]:
    """Joint → the nodes it connects. MuJoCo's way of writing a joint of several freedoms is several joints between the
    same two bodies, each about or along another axis: these follow each other by nodes of their own. Two hinges on
    one axis are two pins of a loop."""
    pairs: dict[frozenset[str], list[Joint]] = {}
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


def _differ(a: Joint, b: Joint) -> bool:
    """Whether two hinges or slides move their bodies differently."""
    return a.type != b.type or float(np.linalg.norm(np.cross(a.axis, b.axis))) > _OTHER_AXIS


def _spanning_tree(joints: list[Joint], ends: Mapping[str, tuple[str, str]]) -> tuple[list[Joint], list[Joint]]:
    """A spanning forest that takes the joints in order, and the joints that close loops."""
    nodes = list(dict.fromkeys(n for j in joints for n in ends[j.path]))
    parent = {n: n for n in nodes}

    def find(node: str) -> str:
        while parent[node] != node:
            parent[node] = parent[parent[node]]
            node = parent[node]
        return node

    tree, closing = [], []
    for joint in joints:
        a, b = (find(n) for n in ends[joint.path])
        if a == b:
            closing.append(joint)
        else:
            parent[b] = a
            tree.append(joint)
    return tree, closing


def _loop(closing: Joint, tree: list[Joint], ends: Mapping[str, tuple[str, str]]) -> Loop:
    """The closing joint from its first body to its second, and back along the tree."""
    goal, start = ends[closing.path]
    came: dict[str, Step | None] = {start: None}
    queue = deque([start])
    while queue and goal not in came:
        node = queue.popleft()
        for joint in tree:
            if node in ends[joint.path]:
                forward = ends[joint.path][0] == node
                following = ends[joint.path][1] if forward else ends[joint.path][0]
                if following not in came:
                    came[following] = Step(joint, 1 if forward else -1)
                    queue.append(following)
    steps: list[Step] = []
    node = goal
    while (step := came[node]) is not None:
        steps.append(step)
        node = ends[step.joint.path][0 if step.sign > 0 else 1]
    return Loop((Step(closing, 1), *reversed(steps)))


def cylinders(island: Island) -> Iterator[tuple[Joint, Joint, Joint]]:
    """Slides between two pins of a loop, each once, with these pins."""
    seen = set()
    for loop in island.loops:
        joints = loop.joints
        for index, joint in enumerate(joints if len(joints) >= 4 else ()):
            before, after = joints[index - 1], joints[(index + 1) % len(joints)]
            pinned = all(p.type in ("revolute", "spherical") for p in (before, after))
            if joint.type == "prismatic" and pinned and joint.path not in seen:
                seen.add(joint.path)
                yield joint, before, after


def root_body(island: Island, tree: tuple[str, ...], recorded: str = "") -> str:
    """The body a tree hangs from: the recorded one, the one on the world, else the one that fewest joints contradict
    (of equals the one with the articulation root; elsewhere that root says only which link PhysX integrates)."""
    joints = [j for j in island.joints if not j.cut and j.type in KINDS]
    if recorded in tree:
        return recorded
    for joint in joints:
        for near, far in (joint.bodies, joint.bodies[::-1]):
            if near == WORLD and far in tree:
                return far
    return min(tree, key=lambda body: (len(reversed_joints(joints, body)), body not in island.roots))


def reversed_joints(joints: Iterable[Joint], root: str) -> list[Joint]:
    """Joints of the tree whose second body is nearer to `root` than their first."""
    joints = list(joints)
    reached, queue, found = {root, WORLD}, deque([root]), []
    while queue:
        body = queue.popleft()
        for joint in joints:
            if body not in joint.bodies:
                continue
            other = joint.bodies[1] if joint.bodies[0] == body else joint.bodies[0]
            if other not in reached:
                reached.add(other)
                queue.append(other)
                if joint.bodies[1] == body:
                    found.append(joint)
    return found
