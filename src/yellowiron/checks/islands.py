"""What joints hold together: islands of bodies, and the articulation's trees and loops in each."""

from __future__ import annotations

import functools
from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from yellowiron.checks.loops import KINDS, StageLoop, find_loops
from yellowiron.checks.motion import LoopMotion
from yellowiron.checks.values import WORLD, StageBody, StageJoint, extent, union
from yellowiron.model.geometry import Floats
from yellowiron.support.graphs import components


@dataclass(frozen=True, eq=False)
class Island:
    """Bodies that enabled joints hold together, in the file's order, and those joints. `roots` are the articulation
    roots that it falls under: prims at or above its bodies, and joints of its own; `trees` its bodies as the uncut
    joints connect them."""

    bodies: tuple[StageBody, ...]
    joints: tuple[StageJoint, ...]
    roots: tuple[str, ...]
    trees: tuple[tuple[str, ...], ...]
    loops: tuple[StageLoop, ...]

    @property
    def uncut(self) -> tuple[StageLoop, ...]:
        """Its loops that no cut joint closes."""
        return tuple(loop for loop in self.loops if not loop.closing.cut)

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
    def motion(self) -> LoopMotion | None:
        """How its loops let it move at once from the drawn pose; None where a frame is not a number."""
        return LoopMotion.of(self.loops, center=self.center, size=self.size)

    @functools.cached_property
    def in_loops(self) -> frozenset[str]:
        """Paths of the joints that are part of a loop."""
        return frozenset(j.path for loop in self.loops for j in loop.joints)

    def beyond(self, joint: StageJoint) -> tuple[StageBody, ...]:
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


def build_islands(
    bodies: Mapping[str, StageBody], joints: Iterable[StageJoint], roots: Iterable[str]
) -> tuple[Island, ...]:
    """Every island that has a joint, in the file's order. The world joins nothing: two robots on one floor are two."""
    edges = [
        j
        for j in joints
        if j.enabled and j.bodies[0] != j.bodies[1] and not any(s.missing or len(s.targets) > 1 for s in j.sides)
    ]
    groups = components([b for b in bodies if any(b in j.bodies for j in edges)], (j.bodies for j in edges))
    return tuple(_island(group, bodies, edges, tuple(roots)) for group in groups)


def _island(
    group: tuple[str, ...], bodies: Mapping[str, StageBody], edges: list[StageJoint], roots: tuple[str, ...]
) -> Island:
    members = set(group)
    joints = [j for j in edges if members.intersection(j.bodies)]
    links = [j for j in joints if j.type in KINDS]
    return Island(
        bodies=tuple(bodies[b] for b in group),
        joints=tuple(joints),
        roots=tuple(
            r for r in roots if any(b == r or b.startswith(f"{r}/") for b in group) or any(j.path == r for j in joints)
        ),
        trees=tuple(components(group, (j.bodies for j in links if not j.cut))),
        loops=find_loops(links),
    )


def cylinders(island: Island) -> Iterator[tuple[StageJoint, StageJoint, StageJoint]]:
    """Slides between two pins of a loop, each once, with these pins: what they join hangs on nothing else (a steering
    rod with a tie at either end is no cylinder's half)."""
    seen = set()
    pins: dict[str, int] = {}
    for joint in island.joints:
        if joint.type in ("revolute", "spherical"):
            pins.update({body: pins.get(body, 0) + 1 for body in joint.bodies})
    for loop in island.loops:
        joints = loop.joints
        for index, joint in enumerate(joints if len(joints) >= 4 else ()):
            before, after = joints[index - 1], joints[(index + 1) % len(joints)]
            pinned = all(p.type in ("revolute", "spherical") for p in (before, after))
            alone = all(pins.get(body) == 1 for body in joint.bodies)
            if joint.type == "prismatic" and pinned and alone and joint.path not in seen:
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


def reversed_joints(joints: Iterable[StageJoint], root: str) -> list[StageJoint]:
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
