"""A hydraulic cylinder has a lever: none of the three hinges of its triangle is on another's axis.

Two bodies are hinged, a cylinder's barrel hangs on the one and its rod on the other. What is drawn best, a cylinder's
foot with its pin, is near both bodies as often as not; taken for their hinge too it would leave a loop that cannot
move. Then one of the two is elsewhere, the one for which that says less.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from yellowiron.alignment.axes.values import AxisEstimate, Candidate
from yellowiron.model.alignment import Vector
from yellowiron.model.template import JointTemplate, Template
from yellowiron.support.vectors import distance_from_line

APART = 0.006
"""Hinges of a triangle are further apart than this share of the machine's size: the shortest lever of 24 machines, a
bucket's tipping link, has 0.02."""
LEFT = 0.1
"""What speaks for a line must be this much for a hinge to be taken there."""


def triangles_of(template: Template, joints: Collection[str]) -> tuple[tuple[str, str], ...]:
    """(hinge of two bodies, hinge of a cylinder's end on one of them), for each end of every cylinder between two
    bodies that are hinged, where both are among the joints of those names."""
    turning = [j for j in template.joints if j.type == "revolute"]
    ends = {j.name: frozenset(str(b) for b in template.bodies_of(j)) for j in turning}
    pairs = []
    for slide in (j for j in template.joints if j.type == "prismatic"):
        one, other = (str(b) for b in template.bodies_of(slide))
        feet = [[(n, *(e - {b})) for n, e in ends.items() if b in e and len(e) == 2] for b in (one, other)]
        for name, held in ((n, e) for n, e in ends.items() if one not in e and other not in e):
            for first, at in feet[0]:
                pairs += [
                    (name, end) for second, far in feet[1] if {at, far} == held for end in (first, second)
                ]  # fmt: skip
    return tuple(pair for pair in dict.fromkeys(pairs) if set(pair) <= set(joints))


def with_levers(
    hinges: Mapping[str, Sequence[Candidate]], template: Template, linkage: Sequence[JointTemplate], size: float
) -> dict[str, list[Candidate]]:
    """The candidates of a linkage's hinges, the best first, so that the best of no triangle's hinges coincide, as far
    as there are others to choose from. `size`: the machine's, metres."""
    found = {name: list(candidates) for name, candidates in hinges.items()}
    pairs = triangles_of(template, {j.name for j in linkage} & hinges.keys())
    for hinge in dict.fromkeys(h for h, _ in pairs):
        ends = [end for h, end in pairs if h == hinge and _together(found[h][0], found[end][0], size)]
        if not ends:
            continue
        here = found[hinge][0]
        away = {name: _elsewhere(found[name], here, size) for name in (hinge, *ends)}
        lost = here.quality - _quality(away[hinge])
        kept = sum(found[end][0].quality - _quality(away[end]) for end in ends)
        moved = [hinge] if lost < kept else ends
        for name in moved:
            best = away[name]
            if best is not None and best.quality > LEFT:
                found[name] = [best, *(c for c in found[name] if c is not best and not _together(c, here, size))]
    return found


def without_lever(
    searched: Mapping[str, tuple[Vector, Vector]],
    estimates: Mapping[str, AxisEstimate],
    template: Template,
    size: float,
) -> set[str]:
    """Of the hinges that were `searched` for, with a point and a direction of their axes, those on the axis of another
    hinge of their triangle that an estimate puts elsewhere."""
    lines = {name: (e.origin, e.direction) for name, e in estimates.items()}
    lines |= {name: (np.asarray(o), np.asarray(d)) for name, (o, d) in searched.items()}
    found: set[str] = set()
    for pair in triangles_of(template, lines.keys()):
        (origin, _), other = (lines[name] for name in pair)
        if distance_from_line(origin, *other) < APART * size:
            found |= {
                n for n in pair
                if n in searched and n in estimates and estimates[n].quality > LEFT
                and distance_from_line(estimates[n].origin, *lines[n]) > APART * size
            }  # fmt: skip
    return found


def _elsewhere(candidates: Sequence[Candidate], taken: Candidate, size: float) -> Candidate | None:
    return next((c for c in candidates if not _together(c, taken, size)), None)


def _quality(candidate: Candidate | None) -> float:
    return candidate.quality if candidate is not None else 0.0


def _together(one: Candidate, other: Candidate, size: float) -> bool:
    """Whether two parallel lines are one."""
    return bool(distance_from_line(one.origin, np.asarray(other.origin), np.asarray(other.direction)) < APART * size)
