"""The machine as links and joints: the one table from which URDF, SDFormat and Drake's form of it are written.

Every link's frame has the machine's axes in the drawn pose and stands on the joint that leads to it, as URDF wants it;
metres, radians. Bodies of chains that no joint ties to the machine (rings of track shoes) hang on the root as drawn.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from yellowiron.exporters.assets import plain, unique
from yellowiron.exporters.values import axes_of, minus
from yellowiron.model.errors import MechanismError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, Drive, Joint, Mechanism, Site, Spring, Vector, chained, independent_joints
from yellowiron.model.sensor import Sensor
from yellowiron.model.template import by_first_leader
from yellowiron.support.spatial import idle_spins

LinkKind = Literal["fixed", "revolute", "prismatic", "spherical", "distance"]
BALL: tuple[tuple[str, Vector], ...] = (
    ("pitch", (0.0, 1.0, 0.0)),
    ("roll", (1.0, 0.0, 0.0)),
    ("yaw", (0.0, 0.0, 1.0)),
)
"""A ball as three pivots, in order: singular only where the second, the roll, is a quarter turn, which machines' balls
do not come near."""


@dataclass(frozen=True, eq=False)
class Link:
    """A body as a link; `origin` is its frame in the machine frame, drawn pose."""

    name: str
    body: Body
    origin: Vector


@dataclass(frozen=True)
class Edge:
    """A joint between two links, in the drawn pose: `anchor` in the machine frame. `name` is free among links and
    joints; `joint` the machine's. `follows`: (leader's name, ratio, offset), the leader one that follows nothing."""

    name: str
    joint: str
    kind: LinkKind
    parent: str
    child: str
    anchor: Vector
    axis: Vector
    lower: float | None = None
    upper: float | None = None
    drive: Drive | None = None
    follows: tuple[str, float, float] | None = None
    spring: Spring | None = None


@dataclass(frozen=True, eq=False)
class Frame:
    """A site's or a sensor's frame on a link: `position` (3,) from the link's frame, `axes` (3, 3; columns) in it."""

    name: str
    link: str
    position: Floats
    axes: Floats


@dataclass(frozen=True, eq=False)
class LinkTable:
    """`links` and `tree` from the root outwards (`links[0]` is the root body's); `cuts` close the loops; `given` are
    the names of the tree's joints whose coordinate is given, `actuators` what each lever moves: name → {joint: sign}.
    `still`: bodies of floating chains, which stay with the root."""

    name: str
    links: tuple[Link, ...]
    tree: tuple[Edge, ...]
    cuts: tuple[Edge, ...]
    given: tuple[str, ...]
    actuators: Mapping[str, Mapping[str, int]]
    still: tuple[str, ...] = ()
    spins: tuple[tuple[str, Vector], ...] = ()
    """(ball's name, line): links between two balls, which the kinematics carries without twist about that line."""
    frames: tuple[Frame, ...] = ()
    """Sites, then sensors that stand on a body."""


def links_of(mechanism: Mechanism) -> LinkTable:
    """The table of a mechanism. `MechanismError` where the joints are no tree with cuts, or a slide is cut."""
    loose = chained(mechanism)
    taken: set[str] = {"base_link", "world"}
    links = {b.name: unique(plain(b.name), taken) for b in mechanism.bodies}
    names = {j.name: unique(plain(j.name), taken) for j in mechanism.joints}
    following = {j.name: j.follows for j in mechanism.joints if j.follows is not None}

    def edge(joint: Joint) -> Edge:
        follows = None
        if joint.follows is not None:
            told = by_first_leader(joint.name, following)
            follows = (names[told.joint], told.ratio, told.offset)
        kind, lower, upper = joint.type, joint.lower, joint.upper
        if joint.body0 in loose or joint.body1 in loose:
            kind, follows, lower, upper = "fixed", None, None, None
        ends = (links[joint.body0], links[joint.body1])
        axis = np.asarray(joint.axis, dtype=np.float64)
        axis = axis / (float(np.linalg.norm(axis)) or 1.0)
        unit = (float(axis[0]), float(axis[1]), float(axis[2]))
        moved = Edge(names[joint.name], joint.name, kind, *ends, joint.anchor, unit, lower, upper, joint.drive, follows)
        return moved if joint.spring is None else replace(moved, spring=joint.spring)

    waiting = [edge(j) for j in mechanism.joints if not j.cut]
    root = links[mechanism.root]
    for head in mechanism.floating:
        name = unique(plain(f"{head}_as_drawn"), taken)
        waiting.append(Edge(name, "", "fixed", root, links[head], mechanism.body(head).origin, (0.0, 0.0, 1.0)))
    tree, reached = _outwards(root, waiting)
    for body in mechanism.bodies:
        if links[body.name] not in reached:
            raise MechanismError(
                "no joint leads to the body from the root", where=body.name, hint="Join it to another body."
            )
    cuts = tuple(edge(j) for j in mechanism.joints if j.cut and j.body0 not in loose and j.body1 not in loose)
    for cut in cuts:
        if cut.kind == "prismatic":
            raise MechanismError(
                "a slide is cut, and cylinders must stay in the tree", where=cut.joint, hint="Cut a pivot."
            )
    anchors = {e.child: e.anchor for e in tree}
    bodies = {links[b.name]: b for b in mechanism.bodies}
    placed = tuple(Link(n, bodies[n], anchors.get(n, bodies[n].origin)) for n in (root, *(e.child for e in tree)))
    given = [names[n] for n in independent_joints(mechanism)]
    moving = {e.name for e in tree if e.kind in ("revolute", "prismatic")}
    actuators = {
        a.name: {
            names[entry.joint]: entry.sign
            for entry in (a.joints[:1] if a.kind == "cylinder" else a.joints)
            if names.get(entry.joint) in moving
        }
        for a in mechanism.actuators
    }
    spins = tuple(
        (names[s.ball], (float(s.line[0]), float(s.line[1]), float(s.line[2])))
        for s in idle_spins(_without(mechanism, loose))
    )
    still = tuple(b.name for b in mechanism.bodies if b.name in loose)
    chosen = tuple(n for n in given if n in moving)
    origins = {link.name: link.origin for link in placed}
    standing: list[Site | Sensor] = [*mechanism.sites, *mechanism.sensors]
    frames = tuple(
        Frame(unique(plain(one.name), taken), link, minus(one.position, origins[link]), axes_of(one))
        for one in standing
        if (link := links.get(one.body)) is not None
    )
    return LinkTable(plain(mechanism.name), placed, tree, cuts, chosen, actuators, still, spins, frames)


def _without(mechanism: Mechanism, loose: frozenset[str]) -> Mechanism:
    return replace(
        mechanism,
        bodies=tuple(b for b in mechanism.bodies if b.name not in loose),
        joints=tuple(j for j in mechanism.joints if j.body0 not in loose and j.body1 not in loose),
        floating=(),
    )


def _outwards(root: str, waiting: list[Edge]) -> tuple[tuple[Edge, ...], set[str]]:
    """The tree's joints, parents before children, and the links that they reach."""
    children: dict[str, list[Edge]] = {}
    for one in waiting:
        children.setdefault(one.parent, []).append(one)
    found: list[Edge] = []
    reached, queue = {root}, [root]
    while queue:
        link = queue.pop(0)
        for one in children.get(link, ()):
            if one.kind == "distance":
                raise MechanismError(
                    "a distance joint cannot hold a body in the tree", where=one.joint, hint="Mark it as a cut."
                )
            if one.child in reached:
                raise MechanismError(
                    f"two tree joints lead to the body '{one.child}'", where=one.joint, hint="Cut one of them."
                )
            reached.add(one.child)
            found.append(one)
            queue.append(one.child)
    return tuple(found), reached


def names_of(table: LinkTable) -> set[str]:
    """The names of links, frames and joints in small letters, for `unique`."""
    names = [*(n.name for n in table.links), *(n.name for n in table.frames), *(n.name for n in table.tree)]
    return {name.lower() for name in (*names, *(cut.name for cut in table.cuts))}


def with_pivots(table: LinkTable) -> tuple[tuple[Edge, ...], dict[str, tuple[str, str, str]]]:
    """The tree with every ball as three pivots, and ball → the names of these; the links between are `NAME_pitch` and
    `NAME_roll`."""
    taken = names_of(table)
    edges: list[Edge] = []
    balls: dict[str, tuple[str, str, str]] = {}
    for one in table.tree:
        if one.kind != "spherical":
            edges.append(one)
            continue
        first, second = (unique(f"{one.name}_{word}_link", taken) for word in ("pitch", "roll"))
        ends = ((one.parent, first), (first, second), (second, one.child))
        names = [unique(f"{one.name}_{word}", taken) for word, _ in BALL]
        for name, (_, axis), (parent, child) in zip(names, BALL, ends, strict=True):
            edges.append(Edge(name, one.joint, "revolute", parent, child, one.anchor, axis))
        balls[one.name] = (names[0], names[1], names[2])
    return tuple(edges), balls


def joints_document(table: LinkTable) -> dict[str, Any]:
    """What `joint_states.py` reads: the tree of pivots and slides, the cuts, and which coordinates are given."""
    tree, balls = with_pivots(table)
    origins = {link.name: link.origin for link in table.links}
    for one in tree:
        origins.setdefault(one.child, one.anchor)

    def local(point: Vector, link: str) -> list[float]:
        return [float(a - b) + 0.0 for a, b in zip(point, origins[link], strict=True)]

    joints = [
        {
            "name": e.name,
            "joint": e.joint,
            "type": e.kind,
            "parent": e.parent,
            "child": e.child,
            "origin": local(e.anchor, e.parent),
            "axis": list(e.axis),
            "lower": e.lower,
            "upper": e.upper,
        }
        for e in tree
    ]
    cuts = [
        {
            "name": e.name,
            "joint": e.joint,
            "type": e.kind,
            "parent": e.parent,
            "child": e.child,
            "in_parent": local(e.anchor, e.parent),
            "in_child": local(e.anchor, e.child),
            "axis": list(e.axis),
        }
        for e in table.cuts
    ]
    return {
        "format": 1,
        "machine": table.name,
        "root": table.links[0].name,
        "origin": [float(v) for v in table.links[0].origin],
        "given": list(table.given),
        "actuators": {name: dict(moved) for name, moved in table.actuators.items()},
        "joints": joints,
        "follows": [
            {"joint": e.name, "leader": e.follows[0], "ratio": e.follows[1], "offset": e.follows[2]}
            for e in tree
            if e.follows is not None
        ],
        "cuts": cuts,
        "untwisted": [{"joints": list(balls[ball]), "line": list(line)} for ball, line in table.spins if ball in balls],
    }
