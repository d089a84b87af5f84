"""What a CAD reader returns: parts, placed, and the shapes they share."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Shape

T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Part:
    """One occurrence of a shape in the CAD model.

    `id` is unique and stable: the tree path joined by '/', repeated paths numbered '#2', '#3' in tree order
    (`WHEEL LOADER/FRONT FRAME ASSY/BOLT M24#3`). `path` holds the names of the assemblies above it, outermost
    first. `transform` (4, 4) takes the shape's frame to the CAD file's, metres; its determinant may be negative
    (a mirrored instance) and its scale differ from 1. `node` is the number of the one in `Assembly.nodes` that carries
    it, where the file has a tree of nodes.
    """

    id: str
    name: str
    path: tuple[str, ...]
    shape: str
    transform: Floats
    color: Color | None = None
    node: int | None = None


@dataclass(frozen=True, eq=False)
class Node:
    """A node of the file's scene tree, with or without a mesh: an object, a group, an empty, a bone.

    `parent` is its number in `Assembly.nodes`, where parents stand before their children; None for a root.
    `transform` (4, 4) takes the node's frame to the CAD file's, metres; it may mirror, scale and shear. Its origin is
    the point that the node turns about: where a format knows a pivot apart from the origin (FBX, USD), that one. Of a
    bone it is the head. `bone` is set for the joints of a skeleton.
    """

    name: str
    parent: int | None
    transform: Floats
    bone: bool = False

    @property
    def origin(self) -> Floats:
        """(3,) the point that the node turns about, CAD frame, metres."""
        return self.transform[:3, 3]


@dataclass(frozen=True)
class DeclaredJoint:
    """A joint that a robot description declares, in the pose it is drawn in: `type` as in a template (or `free`,
    `planar`), the names of the bodies it joins (parent, child; '' is the world), anchor (metres) and unit axis in the
    file's frame, limits in metres or radians from that pose. A body is called by its name in its parts' paths, or by
    the whole path to it. A `spherical` joint that the file closes a loop with holds a point: it says no axis."""

    name: str
    type: str
    bodies: tuple[str, str]
    anchor: tuple[float, float, float]
    axis: tuple[float, float, float]
    lower: float | None = None
    upper: float | None = None


PARALLEL_HINGES = 0.999
"""Cosine from which two hinges of a loop are parallel (2.6°): descriptions print angles with few digits."""


def loop_axis(point: DeclaredJoint, joints: Sequence[DeclaredJoint]) -> tuple[float, float, float] | None:
    """The axis of the hinge that a declared point stands for, where it closes a planar loop: the direction that a hinge
    of the one body has in common with one of the other. A slide does not turn, so either half's hinges count."""
    slides = [j.bodies for j in joints if j.type == "prismatic"]
    hinges = []
    for body in point.bodies:
        halves = {body, *(end for pair in slides if body in pair for end in pair)} - {""}
        hinges.append([j for j in joints if j.type == "revolute" and halves & set(j.bodies)])
    pairs = ((one.axis, other.axis) for one in hinges[0] for other in hinges[1])
    return next((one for one, other in pairs if abs(float(np.dot(one, other))) > PARALLEL_HINGES), None)


@dataclass(frozen=True, eq=False)
class Assembly:
    """A CAD model in metres, in the CAD file's own frame. `unit` is the file's own unit in metres (0.001: mm); `joints`
    are those that the file declares, where it is a robot description; `nodes` are its scene tree, where it has one."""

    name: str
    format: str
    unit: float
    parts: tuple[Part, ...]
    shapes: Mapping[str, Shape]
    findings: tuple[Finding, ...] = ()
    declared_occurrences: int | None = None
    joints: tuple[DeclaredJoint, ...] = ()
    nodes: tuple[Node, ...] = ()

    def part(self, part_id: str) -> Part:
        """The part with that id; `KeyError` if there is none."""
        for part in self.parts:
            if part.id == part_id:
                return part
        raise KeyError(part_id)

    def links(self) -> dict[str, tuple[Part, ...]]:
        """Body of the declared joints → its parts, in CAD order: a part is of the innermost such body above it."""
        names = {name for joint in self.joints for name in joint.bodies if name}
        found: dict[str, list[Part]] = {}
        for part in self.parts if names else ():
            tree = (*part.path, part.name)
            above = (tree[:k] for k in range(len(tree), 0, -1))
            link = next((n for t in above for n in ("/".join(t), t[-1]) if n in names), None)
            if link is not None:
                found.setdefault(link, []).append(part)
        return {link: tuple(parts) for link, parts in found.items()}

    def over_welds(self, known: Mapping[str, T]) -> dict[str, T]:
        """What is known of declared bodies, and of those that fixed joints tie to them."""
        spread = dict(known)
        welds = [j.bodies for j in self.joints if j.type == "fixed" and "" not in j.bodies]
        for _ in welds:
            for one, other in (*welds, *((b, a) for a, b in welds)):
                if one not in spread and other in spread:
                    spread[one] = spread[other]
        return spread

    def played(self, body_of: Mapping[str, str | None]) -> dict[str, str | None]:
        """Body of the declared joints → the machine's body that most of its surface is, by part id `body_of`; one that
        draws nothing is what it is welded to."""
        played: dict[str, str | None] = {}
        for link, parts in self.links().items():
            area: dict[str, float] = {}
            for part in parts:
                body = body_of.get(part.id)
                if body is not None:
                    area[body] = area.get(body, 0.0) + self.shape_of(part).area
            played[link] = max(sorted(area), key=lambda b: area[b]) if area else None
        return self.over_welds(played)

    def nodes_above(self, number: int | None) -> tuple[int, ...]:
        """A node and those above it, innermost first; () for None."""
        found: list[int] = []
        while number is not None:
            found.append(number)
            number = self.nodes[number].parent
        return tuple(found)

    def shape_of(self, part: Part) -> Shape:
        """The shape that a part is an occurrence of."""
        return self.shapes[part.shape]

    def points_of(self, part: Part) -> Floats:
        """(n, 3) mesh points of a part in the CAD frame, metres."""
        points = self.shapes[part.shape].mesh.points
        return np.asarray(points @ part.transform[:3, :3].T + part.transform[:3, 3], dtype=np.float64)
