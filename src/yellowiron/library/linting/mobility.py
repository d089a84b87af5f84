"""How a template's mechanism can move, before any geometry is known: Grübler's counts and the generic rank.

Joints that lie on common loops form a group. A group without balls is planar: its pivots are parallel, its slides lie
in the plane across them, as in steering and most working equipment. One with a ball is spatial (a dozer's blade): its
joints are anywhere, save what the template says of their directions and sides. Joints in no loop move on their own.
"""

from __future__ import annotations

import functools
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from yellowiron.library.linting.generic_placement import placed
from yellowiron.library.linting.halves import halves_of_one
from yellowiron.model.geometry import Floats
from yellowiron.model.rows import split_index
from yellowiron.model.template import JointTemplate, Template
from yellowiron.support import spatial as in_space
from yellowiron.support.graphs import blocks, components
from yellowiron.support.spatial import FREEDOMS, IdleLink, idle_links

_PLANAR_FREEDOM: Mapping[str, int] = {"distance": 2, "spherical": 1, "revolute": 1, "prismatic": 1}
_SAMPLES = 3
"""Random poses looked at: one already has the generic rank with probability 1."""
_RANK_TOLERANCE = 1e-9
"""Singular values below it are 0: of the library's types the least that is not is 3e-3, and round-off 1e-15."""


@dataclass(frozen=True)
class Group:
    """Joints on common loops, with the bodies between them. `grubler` is the planar count 3(n−1) − Σ(3−f), negative
    where the group is locked more than once; `computed` the degrees of freedom by the rank of the constraint Jacobian
    in general position; `expected` the driven and free coordinates among its joints; `undetermined` the degrees of
    freedom that are left when all of those are held.

    Of a `spatial` group `grubler` is the count 6(n−1) − Σ(6−f). Its `idle` links spin about their own line: `computed`
    is without these. `superfluous`: joint → what would do in its place ("": nothing); `unlocking`: changes of type that
    would let a locked one move. `halves`: pairs of bodies, left and right, that would let a locked planar one move if
    each pair were one body."""

    bodies: tuple[str, ...]
    joints: tuple[str, ...]
    grubler: int
    computed: int
    expected: int
    undetermined: int = 0
    spatial: bool = False
    idle: tuple[IdleLink, ...] = ()
    superfluous: Mapping[str, str] = field(default_factory=dict)
    unlocking: tuple[Mapping[str, str], ...] = ()
    halves: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class TemplateMobility:
    """Degrees of freedom relative to the root under one set of `choices`: `computed` by the generic rank, `expected`
    the driven and free coordinates (three of a free ball), `planar` and `spatial` by Grübler's count (a planar loop
    counts 3 too few in space; `planar` has a spatial group's own). A joint that follows another takes 1 from each
    count, an idle spin none. `loose` are joints in no loop that are neither driven nor free, and follow none."""

    choices: Mapping[str, str]
    computed: int
    expected: int
    planar: int
    spatial: int
    groups: tuple[Group, ...] = ()
    loose: tuple[str, ...] = ()


def mobility(template: Template, choices: Mapping[str, str]) -> TemplateMobility:
    """The mobility of a template whose variants are decided, as the `choices` say. Rings are left out, and rows
    that are not expanded."""
    joints = [j for j in template.joints if not j.ring and not any(split_index(p)[1] for p in j.parts)]
    ends = welded_ends(template, joints)
    coordinates = _coordinates_of(template)
    leaders = {j.name: j.follows.joint for j in joints if j.follows is not None}
    idle = idle_links(template.root, ends, {n: template.joint(n).type for n in ends})
    groups, loose = [], []
    computed = planar = 0
    for names in blocks(ends):
        members = [template.joint(n) for n in names]
        if len(members) == 1:
            alone = FREEDOMS[members[0].type] if names[0] not in leaders else 0
            computed += alone
            planar += alone
            loose += [n for n in names if n not in coordinates and n not in leaders]
            continue
        # What follows a joint elsewhere stands still while that does.
        led = frozenset(n for n in names if n in leaders and leaders[n] not in names)
        bodies = tuple(dict.fromkeys(b for n in names for b in ends[n]))
        if any(j.type == "spherical" for j in members):
            groups.append(_spatial_group(template, bodies, members, ends, coordinates, idle, led))
            computed += groups[-1].computed
            planar += groups[-1].grubler
            continue
        count = 3 * (len(bodies) - 1) - sum(3 - _PLANAR_FREEDOM[j.type] for j in members)
        count -= sum(n in leaders for n in names)
        free = _generic_freedom(bodies, members, ends, held=led)
        given = frozenset(names) & frozenset(coordinates)
        left = _generic_freedom(bodies, members, ends, held=given | led)
        halves = _halves(template, members, ends, given, led) if free < len(given) else ()
        groups.append(Group(bodies, names, count, free, len(given), left, halves=halves))
        computed += free
        planar += count
    bodies = tuple(dict.fromkeys(b for pair in ends.values() for b in pair))
    spatial = 6 * (len(bodies) - 1) - sum(6 - FREEDOMS[template.joint(n).type] for n in ends)
    spatial -= sum(n in ends for n in leaders)
    expected = sum(FREEDOMS[template.joint(n).type] for n in coordinates)
    return TemplateMobility(choices, computed, expected, planar, spatial, tuple(groups), tuple(loose))


def _spatial_group(
    template: Template,
    bodies: tuple[str, ...],
    members: Sequence[JointTemplate],
    ends: Mapping[str, tuple[str, str]],
    coordinates: Collection[str],
    idle: Sequence[IdleLink],
    led: frozenset[str],
) -> Group:
    """A group with balls: its mobility by the six-dimensional rank."""
    random = np.random.default_rng(20240607)
    samples = [placed(template, members, ends, random) for _ in range(_SAMPLES)]
    # The most constrained of them is the generic one.
    joints = min(samples, key=lambda sample: in_space.freedom(sample, held=led))
    names = tuple(j.name for j in members)
    idle = tuple(link for link in idle if set(link.balls) <= set(names))
    given = frozenset(names).intersection(coordinates)
    free = in_space.freedom(joints, held=led) - len(idle)
    left = in_space.freedom(joints, held=given | led) - len(idle)
    expected = sum(FREEDOMS[j.type] for j in members if j.name in given)
    count = in_space.grubler(joints) - len(idle)
    redundant: Mapping[str, str] = {}
    unlocking: tuple[Mapping[str, str], ...] = ()
    if free < expected:
        unlocking = in_space.unlocking(joints, given)
    elif free > count:
        redundant = in_space.superfluous(joints)
    return Group(bodies, names, count, free, expected, left, True, idle, redundant, unlocking)


def _halves(
    template: Template,
    members: Sequence[JointTemplate],
    ends: Mapping[str, tuple[str, str]],
    given: frozenset[str],
    led: frozenset[str],
) -> tuple[tuple[str, str], ...]:
    """The halves of a locked planar group that move as one: so told, it moves as often as it is driven or free."""

    def moves(kept: Sequence[JointTemplate], merged: Mapping[str, tuple[str, str]]) -> bool:
        bodies = tuple(dict.fromkeys(b for j in kept for b in merged[j.name]))
        return _generic_freedom(bodies, kept, merged, held=led) == sum(j.name in given for j in kept)

    return halves_of_one(template, members, ends, moves)


def _coordinates_of(template: Template) -> tuple[str, ...]:
    """The joints whose coordinates are given from outside: the driven cylinders' slides (not their passive twins'),
    motor joints, and free joints."""
    slides = [c.slide for a in template.actuators for c in a.cylinders if not c.passive]
    passive = {c.slide for a in template.actuators for c in a.cylinders if c.passive}
    given = {*slides, *(j for a in template.actuators for j in a.joints)}
    return tuple(
        j.name
        for j in template.joints
        if not j.ring
        and j.follows is None
        and (j.name in given or (j.drive and j.name not in passive) or (j.free and not j.drive))
    )


def welded_ends(template: Template, joints: Iterable[JointTemplate]) -> dict[str, tuple[str, str]]:
    """Joint → its two bodies, bodies that fixed joints weld together being one; without the fixed joints."""
    joints = tuple(joints)
    pairs = {}
    for joint in joints:
        first, second = template.bodies_of(joint)
        if first is not None and second is not None:
            pairs[joint.name] = (first, second)
    fixed = {joint.name for joint in joints if joint.type == "fixed"}
    bodies = (body for pair in pairs.values() for body in pair)
    groups = components(bodies, (pair for name, pair in pairs.items() if name in fixed))
    one = {body: group[0] for group in groups for body in group}
    welded = {name: (one[a], one[b]) for name, (a, b) in pairs.items() if name not in fixed}
    return {name: pair for name, pair in welded.items() if pair[0] != pair[1]}


class _Link(NamedTuple):
    """A joint of a planar group: the numbers of its bodies, whether it is held, and the number of the joint that it
    follows, None where that is not in the group."""

    type: str
    ends: tuple[int, int]
    held: bool
    leader: int | None
    ratio: float


def _generic_freedom(
    bodies: tuple[str, ...],
    joints: Sequence[JointTemplate],
    ends: Mapping[str, tuple[str, str]],
    *,
    held: frozenset[str] = frozenset(),
) -> int:
    """`_freedom` of a group's joints; those `held` do not move."""
    body = {name: number for number, name in enumerate(bodies)}
    joint = {j.name: number for number, j in enumerate(joints)}
    return _freedom(
        len(bodies),
        tuple(
            _Link(
                j.type,
                (body[ends[j.name][0]], body[ends[j.name][1]]),
                j.name in held,
                joint.get(j.follows.joint) if j.follows is not None else None,
                j.follows.ratio if j.follows is not None else 0.0,
            )
            for j in joints
        ),
    )


@functools.lru_cache(maxsize=1024)
def _freedom(bodies: int, links: tuple[_Link, ...]) -> int:
    """Degrees of freedom of a planar group in general position, its first body not moving: pivots at random points,
    slides in random directions (any such set is a closed pose of links of some shape). The least of a few samples,
    which is the generic value with probability 1. Most sets of choices have most groups in common."""
    random = np.random.default_rng(20240607)
    ranks = [int(np.linalg.matrix_rank(_jacobian(bodies, links, random), tol=_RANK_TOLERANCE)) for _ in range(_SAMPLES)]
    return 3 * (bodies - 1) - max(ranks)


def _jacobian(bodies: int, links: Sequence[_Link], random: np.random.Generator) -> Floats:
    """Rows: velocity constraints; columns: (vx, vy, ω) of every body but the first. Unit lengths."""
    rows: list[Floats] = []
    moved: list[Floats] = []
    for link in links:
        x, y = random.uniform(-1.0, 1.0, 2)
        angle = random.uniform(0.0, 2.0 * np.pi)
        along = np.array([np.cos(angle), np.sin(angle)])
        across = np.array([-along[1], along[0]])
        at = np.array([[1.0, 0.0, -y], [0.0, 1.0, x]])
        if link.held:
            local = np.eye(3)
        elif link.type == "prismatic":
            local = np.vstack([across @ at, [0.0, 0.0, 1.0]])
        elif link.type == "distance":
            local = (along @ at)[None, :]
        else:
            local = at

        def block(of: Floats, ends: tuple[int, int] = link.ends) -> Floats:
            made = np.zeros((len(of), 3 * bodies))
            for body, sign in zip(ends, (1.0, -1.0), strict=True):
                made[:, 3 * body : 3 * body + 3] += sign * of
            return made

        rows.append(block(local))
        moved.append(block((along @ at)[None, :] if link.type == "prismatic" else np.eye(3)[2:]))
    rows += [
        own - link.ratio * moved[link.leader] for own, link in zip(moved, links, strict=True) if link.leader is not None
    ]
    return np.vstack(rows)[:, 3:]
