"""Which hinges of a type lie alike, and which across each other, whatever way the machine stands.

The hinges of one closed linkage are parallel: it moves in a plane. A frame turns on a frame about the upright, or rolls
about the long axis: across the hinges of every linkage that works a tool. What steers wheels works none. So a bucket's
linkage is not taken for two frames with their steering.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import networkx as nx
import numpy as np

from yellowiron.alignment.assignment.sides import twin_role
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template
from yellowiron.support.caching.remembered import remembered

ALIKE = 0.94
"""Hinges drawn this far from parallel (20°), by its cosine, are not of one linkage."""
NOT_ACROSS = 0.7
"""… and this near to it (45°) are not across each other."""


@remembered
def linkages_of(template: Template) -> tuple[Mapping[str, int], frozenset[int], frozenset[int]]:
    """Hinge → the linkage of the type that it is in, for hinges in a closed one and between frames; which of the
    linkages turn frames on each other; and which of the others work tools: not those that steer wheels, which turn
    about the upright, too."""
    kinds = {r.name: r.kind for r in template.roles}
    pairs = {j.name: template.bodies_of(j) for j in template.joints if j.type in ("revolute", "prismatic")}
    moving = [template.joint(n) for n, pair in pairs.items() if None not in pair and len(set(pair)) == 2]
    graph = nx.Graph([template.bodies_of(j) for j in moving])
    blocks = [frozenset(frozenset(edge) for edge in edges) for edges in nx.biconnected_component_edges(graph)]
    blocks.sort(key=lambda edges: sorted(sorted(str(b) for b in e) for e in edges))
    found: dict[str, int] = {}
    upright: set[int] = set()
    for joint in moving:
        pair = frozenset(template.bodies_of(joint))
        number = next(k for k, edges in enumerate(blocks) if pair in edges)
        frames = all(kinds[str(b)] == "frame" for b in pair)
        if joint.type == "revolute" and (frames or len(blocks[number]) > 1):
            found[joint.name] = number
            upright |= {number} if frames else set()
    rolling = {b for b, kind in kinds.items() if kind == "wheel"}
    steered = {str(b) for edge in graph.edges if rolling & set(edge) for b in edge if kinds[str(b)] != "frame"}
    steered -= rolling
    steers = {k for k, edges in enumerate(blocks) if len(edges) > 1 and any(steered & edge for edge in edges)}
    return found, frozenset(upright), frozenset(found.values()) - upright - steers


def steering_joints(template: Template) -> frozenset[str]:
    """The hinges of the closed linkages that steer wheels."""
    linkage_of, frames, tools = linkages_of(template)
    return frozenset(joint for joint, number in linkage_of.items() if number not in frames | tools)


@remembered
def twin_linkages(template: Template, linkage_of: Mapping[str, int]) -> frozenset[tuple[int, int]]:
    """The pairs of linkages of which one is the other's mirror image, such as two stabilizers': they lie alike."""
    by_pair = {frozenset(template.bodies_of(j)): linkage_of[j.name] for j in template.joints if j.name in linkage_of}
    found = {(k, by_pair.get(frozenset(twin_role(str(b)) or b for b in pair), k)) for pair, k in by_pair.items()}
    return frozenset((k, other) for k, other in found if k < other)


@remembered
def direction_classes(structure: Structure) -> tuple[Sequence[int], Sequence[Floats]]:
    """The hinges of a structure by their direction: the number of each one's class, and what each class is about
    parallel to."""
    firsts: list[Floats] = []
    found = []
    for hinge in structure.hinges:
        direction = np.asarray(structure.axes[hinge.axis].direction)
        known = next((k for k, first in enumerate(firsts) if abs(float(first @ direction)) > ALIKE), len(firsts))
        if known == len(firsts):
            firsts.append(direction)
        found.append(known)
    return found, firsts


def never_together(firsts: Sequence[Floats]) -> list[tuple[int, int]]:
    """The pairs of directions, both ways round, that are not across each other."""
    every = range(len(firsts))
    return [(a, b) for a in every for b in every if abs(float(firsts[a] @ firsts[b])) > NOT_ACROSS]


@remembered
def sections_of(template: Template) -> tuple[frozenset[str], ...]:
    """The bodies of arms that slide in each other, each boom or mast by itself."""
    arms = {role.name for role in template.roles if role.kind == "arm"}
    pairs = [tuple(str(b) for b in template.bodies_of(j)) for j in template.joints if j.type == "prismatic"]
    graph = nx.Graph([pair for pair in pairs if set(pair) <= arms])
    return tuple(frozenset(group) for group in sorted(nx.connected_components(graph), key=sorted))
