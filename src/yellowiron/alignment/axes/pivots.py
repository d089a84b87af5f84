"""Pivots of the scene's tree: the origins of nodes that an artist, or an animation, turns a body about."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from yellowiron.alignment.axes.hinges import AT_PIVOT
from yellowiron.alignment.axes.values import Candidate
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template
from yellowiron.support.vectors import distance_from_line

HELD = 0.8
"""A node carries a body if at least this share of its surface is under it, …"""
STRAY = 0.05
"""… and does not carry one of which no more than this is."""
SAME = 1e-4
"""Origins this close, in machine sizes, are one."""
MIDDLE = 0.03
"""An origin this close to the middle of what is under it, as a share of that's extent, is where a program put it."""

USUAL = 28 / 30
"""Of so many pivots of five models where two bodies meet these were their hinge."""
DRAWN = 0.4
"""Quality from which a hinge is drawn, so that it tells whether its pivots are right."""


def trust_in_pivots(drawn: Mapping[str, Sequence[Candidate]], pivots: Mapping[str, Floats], size: float) -> float:
    """How much a machine's pivots are to be believed, in [0, 1]: the share of its hinges that are `drawn` (found
    without pivots, the best candidate first) and have one on their axis, begun with one usual hinge.

    An artist either turns all bodies about their nodes, or has left the nodes where they came to be: of eight
    hinges of a model none, or all of sixteen.
    """
    near = AT_PIVOT * size
    known = [
        min(distance_from_line(p, best[0].origin, best[0].direction) for p in pivots[name]) < near
        for name, best in drawn.items()
        if name in pivots and best[0].quality > DRAWN and best[0].across < near
    ]
    return (sum(known) + USUAL) / (len(known) + 1.0)


def pivots_of(assembly: Assembly, body_of: Mapping[str, str], template: Template) -> dict[str, Floats]:
    """Hinge → (n, 3) origins of the scene's nodes that carry one of its bodies and not the other, CAD frame; bones that
    carry nothing are told for every hinge.

    `body_of`: part id → body. Left out is what says nothing: an origin that a node above both bodies has too, and one
    in the middle of what is under it.
    """
    nodes = assembly.nodes
    bodies = sorted(set(body_of.values()))
    column = {body: k for k, body in enumerate(bodies)}
    held = np.zeros((len(nodes), len(bodies)))
    low, high = np.full((len(nodes), 3), np.inf), np.full((len(nodes), 3), -np.inf)
    for part in assembly.parts:
        above = list(assembly.nodes_above(part.node))
        if not above:
            continue
        points = assembly.points_of(part)
        low[above] = np.minimum(low[above], points.min(axis=0))
        high[above] = np.maximum(high[above], points.max(axis=0))
        if part.id in body_of:
            scale = abs(float(np.linalg.det(part.transform[:3, :3]))) ** (2 / 3)
            held[above, column[body_of[part.id]]] += assembly.shape_of(part).area * scale
    if not held.any():
        return {}
    roots = np.array([node.parent is None for node in nodes])
    held /= np.maximum(held[roots].sum(axis=0), 1e-300)
    origin = np.array([node.origin for node in nodes])
    full = np.isfinite(low).all(axis=1)
    low[~full], high[~full] = origin[~full], origin[~full]
    size = float(np.linalg.norm(high.max(axis=0) - low.min(axis=0)))
    central = full & (np.linalg.norm(origin - 0.5 * (low + high), axis=1) < MIDDLE * np.linalg.norm(high - low, axis=1))
    idle = np.array([node.bone for node in nodes]) & ~held.any(axis=1)
    found = {}
    for joint in template.joints:
        a, b = (column.get(str(body)) for body in template.bodies_of(joint))
        if joint.type != "revolute" or joint.ring or a is None or b is None:
            continue
        one, other = held[:, a], held[:, b]
        carries = ((one >= HELD) & (other <= STRAY)) | ((other >= HELD) & (one <= STRAY))
        told = origin[(carries & ~central) | idle]
        # The scene's own origin says nothing, whoever has it.
        above = np.r_[np.zeros((1, 3)), origin[(one > STRAY) & (other > STRAY)]]
        apart = np.linalg.norm(told[:, None] - above[None], axis=2).min(axis=1)
        told = told[apart > SAME * size]
        if len(told):
            found[joint.name] = np.unique(np.round(told / (SAME * size)), axis=0) * SAME * size
    return found
