"""Left and right halves that a template says are two bodies, and that move as one: each holds what the other holds."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence

from yellowiron.model.template import JointTemplate, Template

Ends = Mapping[str, tuple[str, str]]
_APART = frozenset({"barrel", "rod", "wheel"})
"""Kinds of which a left and a right one are never one body."""
_MOST = 5
"""Pairs that are tried together, in any combination."""


def halves_of_one(
    template: Template,
    joints: Sequence[JointTemplate],
    ends: Ends,
    moves: Callable[[Sequence[JointTemplate], Ends], bool],
) -> tuple[tuple[str, str], ...]:
    """The fewest pairs of bodies, left and right, of a locked group that let it move where each pair is one body:
    `moves` tells of joints and their bodies whether they do. Nothing where none do."""
    bodies = {body for joint in joints for body in ends[joint.name]}
    pairs = [(left, right) for left in sorted(bodies) if (right := other_half(template, left)) in bodies]
    for count in range(1, min(len(pairs), _MOST) + 1):
        for chosen in itertools.combinations(pairs, count):
            kept, merged = _merged(joints, ends, {right: left for left, right in chosen})
            if len(kept) < len(joints) and moves(kept, merged):
                return chosen
    return ()


def other_half(template: Template, body: str) -> str:
    """The body on the right that a body on the left is a twin of; "" where there is none, or these are of a kind of
    which either side has its own."""
    role = template.role(body)
    if role.side != "l" or not body.endswith("_l") or role.kind in _APART:
        return ""
    other = f"{body[:-1]}r"
    return other if any(r.name == other and r.rigid and r.side == "r" for r in template.roles) else ""


def _merged(joints: Sequence[JointTemplate], ends: Ends, one: Mapping[str, str]) -> tuple[list[JointTemplate], Ends]:
    """The joints where each body of `one` is the other, with their bodies; without those that are then there twice."""
    kept: list[JointTemplate] = []
    merged: dict[str, tuple[str, str]] = {}
    # Each half has its pivots on what carries both, and on what both carry: of one body they are there once.
    known: set[tuple[str, frozenset[str]]] = set()
    halves = {*one, *one.values()}
    for joint in joints:
        first, second = ends[joint.name]
        pair = (one.get(first, first), one.get(second, second))
        key = (joint.type, frozenset(pair))
        if pair[0] == pair[1] or (halves & {*pair} and key in known):
            continue
        kept.append(joint)
        merged[joint.name] = pair
        known.add(key)
    return kept, merged
