"""Chains that no joint ties to the machine: rings of track shoes. They lie on it and touch it, each a tree of its own
with one cut, and are no part of its articulation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from yellowiron.mechanism.joints.axes import Axis
from yellowiron.mechanism.joints.frames import JointFrame
from yellowiron.mechanism.joints.tree import Link, Tree, links, loose_bodies, span_tree
from yellowiron.mechanism.placement import Placement
from yellowiron.model.template import Template


def heads(placement: Placement, template: Template, frames: Mapping[str, JointFrame]) -> tuple[str, ...]:
    """The first body of every chain of a ring's bodies that no joint ties to the root, in template order."""
    members = [p for j in template.joints if j.ring for p in j.parts]
    present = [b for b in dict.fromkeys(members) if placement.has_body(b)]
    return loose_bodies(template.root, present, links(template, frames)) if present else ()


def span(root: str, floating: Sequence[str], edges: Sequence[Link]) -> Tree:
    """The machine's tree, and after it those of the floating chains, each from its first body on."""
    tree = span_tree(root, _tied(root, edges))
    for head in floating:
        ring = span_tree(head, _tied(head, edges))
        tree = Tree(
            bodies=(*tree.bodies, *ring.bodies),
            leading={**tree.leading, **ring.leading},
            sides={**tree.sides, **ring.sides},
            cuts={**tree.cuts, **dict.fromkeys(ring.cuts, "closes the ring")},
            loops=(*tree.loops, *ring.loops),
        )
    return tree


def pitch_radii(placement: Placement, template: Template, frames: Mapping[str, JointFrame]) -> dict[str, float]:
    """Sprocket → the radius on which a ring's pins run around it, metres: how far the track goes at a turn."""
    anchors = {j.name: frames[j.name].anchor for j in template.joints if j.ring and j.name in frames}
    found = {}
    for frame in frames.values():
        for body in frame.bodies:
            if template.role(body).kind == "sprocket" and anchors and placement.has_body(body):
                across = abs(frame.axis @ np.array([0.0, 1.0, 0.0]))
                line = Axis(frame.anchor, frame.axis)
                near = [a for a in anchors.values() if np.sign(a[1]) == np.sign(frame.anchor[1])]
                if near and across > 0.9:
                    found[body] = float(line.distance(np.array(near)).min())
    return found


def _tied(body: str, edges: Sequence[Link]) -> list[Link]:
    """The edges over which a body is reached, in order."""
    reached = {body}
    grown = True
    while grown:
        more = {b for e in edges if reached & set(e.bodies) for b in e.bodies} - reached
        reached |= more
        grown = bool(more)
    return [e for e in edges if reached & set(e.bodies)]
