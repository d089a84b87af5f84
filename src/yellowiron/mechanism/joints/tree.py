"""Loops and cuts: which joints make the articulation's tree, and the one joint of each loop that is cut.

The tree is the cheapest spanning tree of the joint graph (Kruskal), so that what closes a loop is always the joint
least fit to be in it. What stays first, as engines hold loops best (docs/architecture.md):

1. slides and welds: a slide is never cut;
2. motors, what follows another joint and what leads it, then both pins of every driven cylinder: they carry the load;
3. the pin on which a passive cylinder's barrel hangs;
4. structural pins, the farthest from the root first: those a driven cylinder bridges, nearer to the root, close the
loops; 5. the rod pin of a passive cylinder.

A cut is held at a point. In a planar loop the other pins keep what that leaves of a pivot; where a loop has balls
nothing does, so its pivots come right after the slides and a ball is cut.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from yellowiron.mechanism.joints.frames import JointFrame
from yellowiron.model.mechanism import Loop
from yellowiron.model.template import Template
from yellowiron.support.graphs import blocks, spanning_forest

LinkKind = Literal["weld", "slide", "motor", "driven", "hung", "pin", "loose"]
_PLACE: Mapping[LinkKind, int] = {"weld": 0, "slide": 0, "motor": 1, "driven": 2, "hung": 3, "pin": 4, "loose": 5}
_STRUCTURE: tuple[LinkKind, ...] = ("weld", "motor", "pin")
_WHY_CUT: Mapping[LinkKind, str] = {
    "loose": "rod pin of a passive cylinder, which follows its driven twin",
    "pin": "structural pin: the driven cylinders stay in the tree and carry the load",
}


@dataclass(frozen=True)
class Link:
    """A joint as an edge between two bodies, and what kind it is for the choice of cuts; `kept`: a pivot on loops with
    balls, which must not be cut."""

    name: str
    bodies: tuple[str, str]
    kind: LinkKind
    kept: bool = False


@dataclass(frozen=True)
class Tree:
    """The articulation: `bodies` from the root outwards, `leading` the joint that leads to each body but the root,
    `sides` (body0, body1) of every joint, `cuts` the cut joints with the reason, `loops` one for each cut."""

    bodies: tuple[str, ...]
    leading: Mapping[str, str]
    sides: Mapping[str, tuple[str, str]]
    cuts: Mapping[str, str]
    loops: tuple[Loop, ...]


def links(template: Template, frames: Mapping[str, JointFrame]) -> tuple[Link, ...]:
    """The joints that were found, as edges, in template order."""
    driven = [c for a in template.actuators for c in a.cylinders if not c.passive]
    passive = [c for a in template.actuators for c in a.cylinders if c.passive]
    kinds: dict[str, LinkKind] = {}
    kinds.update((c.barrel_joint, "hung") for c in passive if c.barrel_joint is not None)
    kinds.update((c.rod_joint, "loose") for c in passive if c.rod_joint is not None)
    kinds.update((name, "driven") for c in driven for name in c.pins)
    kinds.update((name, "motor") for a in template.actuators for name in a.joints)
    # What follows, and what it follows, are coordinates of the tree: engines couple no others.
    led = [j for j in template.joints if j.follows is not None]
    kinds.update((name, "motor") for j in led for name in (j.name, j.follows.joint if j.follows else ""))

    def kind(frame: JointFrame) -> LinkKind:
        if frame.joint.type == "fixed":
            return "weld"
        return "slide" if frame.joint.type == "prismatic" else kinds.get(frame.joint.name, "pin")

    kept = _beside_balls(frames)
    return tuple(Link(name, frame.bodies, kind(frame), name in kept) for name, frame in frames.items())


def _beside_balls(frames: Mapping[str, JointFrame]) -> set[str]:
    """The pivots that share loops with balls."""
    if not any(frame.joint.type == "spherical" for frame in frames.values()):
        return set()
    looped = blocks({name: frame.bodies for name, frame in frames.items()})
    kinds = {name: frame.joint.type for name, frame in frames.items()}
    beside = (names for names in looped if len(names) > 1 and any(kinds[n] == "spherical" for n in names))
    return {name for names in beside for name in names if kinds[name] == "revolute"}


def span_tree(root: str, edges: Sequence[Link]) -> Tree:
    """The tree from `root` over all joints, with its cuts and loops. Every body named must be reachable from the
    root."""
    structure = _distances(root, [e for e in edges if e.kind in _STRUCTURE])
    far = len(edges) + 1

    def reach(edge: Link) -> int:
        return min(structure.get(b, far) for b in edge.bodies)

    order = {e.name: i for i, e in enumerate(edges)}
    fittest = sorted(edges, key=lambda e: (min(_PLACE[e.kind], 1 if e.kept else 9), -reach(e), order[e.name]))
    kept, closing = spanning_forest(fittest, lambda e: e.bodies)
    kept.sort(key=lambda e: order[e.name])
    depth = _distances(root, kept)

    bodies = tuple(depth)
    leading = {_outer(e, depth): e.name for e in kept}
    sides = {e.name: _inward_first(e, [depth]) for e in kept}
    sides |= {e.name: _inward_first(e, [depth, structure]) for e in closing}
    parents = {_outer(e, depth): (e.name, _inward_first(e, [depth])[0]) for e in kept}
    closing.sort(key=lambda e: order[e.name])
    return Tree(
        bodies=bodies,
        leading={b: leading[b] for b in bodies if b != root},
        sides={e.name: sides[e.name] for e in edges},
        cuts={e.name: _WHY_CUT.get(e.kind, "closes a loop that has no better joint to cut") for e in closing},
        loops=tuple(Loop((*_path(*sides[e.name], parents), e.name), e.name) for e in closing),
    )


def loose_bodies(root: str, bodies: Sequence[str], edges: Sequence[Link]) -> tuple[str, ...]:
    """The first body, in the order given, of every group of bodies that no joint ties to the root."""
    reached = set(_distances(root, edges))
    first = []
    for body in bodies:
        if body not in reached:
            first.append(body)
            reached |= set(_distances(body, edges))
    return tuple(first)


def planar_loops(loops: Sequence[Loop], frames: Mapping[str, JointFrame]) -> tuple[Loop, ...]:
    """The loops without a ball, whose pivots must be parallel."""
    return tuple(loop for loop in loops if not any(frames[name].joint.type == "spherical" for name in loop.joints))


def loop_groups(loops: Sequence[Loop]) -> tuple[frozenset[str], ...]:
    """Joints of loops that share a joint, together: what must move as one closed mechanism."""
    groups: list[frozenset[str]] = []
    for loop in loops:
        joined = frozenset(loop.joints)
        apart = []
        for group in groups:
            if group & joined:
                joined |= group
            else:
                apart.append(group)
        groups = [*apart, joined]
    return tuple(groups)


def _distances(root: str, edges: Sequence[Link]) -> dict[str, int]:
    """Bodies reachable from the root, nearest first, with the number of joints between; ties in the order of the
    edges."""
    neighbours: dict[str, list[str]] = {}
    for edge in edges:
        a, b = edge.bodies
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    distance = {root: 0}
    queue = deque([root])
    while queue:
        body = queue.popleft()
        for other in neighbours.get(body, ()):
            if other not in distance:
                distance[other] = distance[body] + 1
                queue.append(other)
    return distance


def _outer(edge: Link, depth: Mapping[str, int]) -> str:
    return max(edge.bodies, key=lambda b: depth[b])


def _inward_first(edge: Link, depths: Sequence[Mapping[str, int]]) -> tuple[str, str]:
    """An edge's bodies, the one nearer the root first; ties go to the next measure, then to the template's order."""
    far = 1 << 30
    a, b = edge.bodies
    nearness_a = [d.get(a, far) for d in depths]
    nearness_b = [d.get(b, far) for d in depths]
    return (b, a) if nearness_b < nearness_a else (a, b)


def _path(start: str, end: str, parents: Mapping[str, tuple[str, str]]) -> tuple[str, ...]:
    """Joints of the tree between two bodies, in order."""

    def upwards(body: str) -> list[tuple[str, str]]:
        chain = []
        while body in parents:
            joint, body = parents[body]
            chain.append((joint, body))
        return chain

    up, down = upwards(start), upwards(end)
    while up and down and up[-1][0] == down[-1][0]:
        up.pop()
        down.pop()
    return (*(joint for joint, _ in up), *(joint for joint, _ in reversed(down)))
