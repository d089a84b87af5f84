"""The judge: the labelling of pieces with bodies whose score is the greatest.

A labelling scores what the votes say of each piece and what the bonds say of each pair; `near` and `exact` once for
every joint that neighbours of its two bodies hold, or an exact axis; for every body that any piece plays `required`
where the type always has it, less half of what its joints count as neighbours: a body pays for itself only if its
joints are there. What each counts is learned (`weights`). That is a Markov random
field with counted joints: exact solvers take minutes for it where nothing is whole, so it is annealed (Geman & Geman
1984), piece by piece from its full conditional distribution and, now and then, two bodies changing places, which single
pieces could not do one after the other. The random numbers are fixed: the same labelling every time.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from yellowiron.alignment.assignment.directions import linkages_of
from yellowiron.alignment.assignment.weights import twin_role
from yellowiron.alignment.fusion.bonds import Bond
from yellowiron.alignment.fusion.votes import BARS, Features, joints_apart
from yellowiron.model.geometry import Floats
from yellowiron.model.template import JointTemplate, Template

Ints = np.ndarray[Any, np.dtype[np.int64]]
KINDS = ("slide", "hinge", "level", "turned")
"""What a joint is exactly held as: a slide; a hinge, one that lies across the machine, one that does not."""
NEVER = -1e6
HOT, COLD = 40.0, 2.0
"""Temperatures, in the score's units, that annealing begins and ends with."""
SWEEPS = 80
SWAPS = 12
"""So many changes of places of two bodies are tried after every sweep."""
SEED = 1


@dataclass(frozen=True, eq=False)
class Field:
    """The score as arrays. Labels are the `bodies`, and last: none. `unary` (pieces, labels). Bond k joins the pieces
    `ends[k]`; its `weights[k]` are what it counts for one body, for bodies that a joint joins, and for one body or left
    and right twins, which `twins` (labels, labels) are; it holds a joint
    nearly (`near[k]`), or exactly as each kind of joint (`exact[k]`: `KINDS`). `joint` (labels, labels): the joint
    between two labels, or the number of joints. `kind` (joints + 1,): which of `KINDS` a joint is. `played` (labels,):
    what each body counts that is there; `held` what a joint counts that is held nearly, and exactly. `astray` (pieces,
    pieces): what two pieces count that are both of one half of a hydraulic cylinder, `halves` (labels,), but not in
    line. `order` (bonds,): what it counts that the second end's body is farther from the root than the first's, by the
    scene's tree; `farther` (labels, labels): 1 where the second label is, -1 where the first is."""

    bodies: tuple[str, ...]
    unary: Floats
    ends: Ints
    weights: Floats
    near: Ints
    exact: Ints
    joint: Ints
    twins: NDArray[np.bool_]
    kind: Ints
    played: Floats
    held: tuple[float, float]
    astray: Floats
    halves: NDArray[np.bool_]
    order: Floats
    farther: Floats

    @property
    def joints(self) -> int:
        """How many joints there are."""
        return len(self.kind) - 1

    def exactly(self, held: Ints) -> Ints:
        """(bonds,) whether each bond holds exactly the joint that it would hold."""
        exact = self.exact[np.arange(len(held)), self.kind[held]]
        return np.where(held < self.joints, exact, 0)


def field_of(
    votes: Sequence[Mapping[str, Features]],
    bonds: Sequence[Bond],
    template: Template,
    weights: Features,
    astray: NDArray[np.bool_] | None = None,
) -> Field:
    """The score of a machine's pieces under a resolved template. `votes`: by piece, the bodies it can be; `astray`:
    (pieces, pieces) whether two are not in line (`bonds.out_of_line`)."""
    bodies = tuple(r.name for r in template.roles if r.rigid)
    at = {b: k for k, b in enumerate(bodies)}
    none = len(bodies)
    unary = np.full((len(votes), none + 1), NEVER)
    unary[:, none] = 0.0
    for p, mine in enumerate(votes):
        for body, features in mine.items():
            unary[p, at[body]] = weighed(features, weights)
    linkage_of, frames = linkages_of(template)
    joints = [
        (_kind(j, linkage_of, frames), at[str(a)], at[str(b)])
        for j in template.joints
        for a, b in [template.bodies_of(j)]
        if j.type in ("revolute", "spherical", "prismatic") and a in at and b in at and a != b
    ]
    joint = np.full((none + 1, none + 1), len(joints), dtype=np.int64)
    for k, (_, a, b) in enumerate(joints):
        joint[a, b] = joint[b, a] = k
    twins = np.eye(none + 1, dtype=np.bool_)
    twins[none, none] = False
    for body, k in at.items():
        if (other := at.get(twin_role(body) or "")) is not None:
            twins[k, other] = True
    near = weights["near"]
    played = np.array([0.0 if template.role(b).optional else weights["required"] for b in bodies] + [0.0])
    for _, a, b in joints:
        played[[a, b]] -= 0.5 * near
    return Field(
        bodies,
        unary,
        np.array([(b.a, b.b) for b in bonds], dtype=np.int64).reshape(-1, 2),
        np.array(
            [
                (
                    weighed(b.same, weights),
                    weights["joined"] * b.beside + weights["branched"] * abs(b.branch),
                    weights["alike"] * b.alike,
                )
                for b in bonds
            ],
            dtype=np.float64,
        ).reshape(-1, 3),
        np.array([b.beside for b in bonds], dtype=np.int64),
        np.array([(b.slide, b.hinge, b.level, b.turned) for b in bonds], dtype=np.int64).reshape(-1, len(KINDS)),
        joint,
        twins,
        np.array([kind for kind, _, _ in joints] + [0], dtype=np.int64),
        played,
        (near, weights["exact"]),
        np.asarray(weights["astray"] * (np.zeros((len(votes), len(votes))) if astray is None else astray), np.float64),
        np.array([template.role(b).kind in BARS for b in bodies] + [False]),
        weights["ordered"] * np.array([b.branch for b in bonds], dtype=np.float64),
        _farther(bodies, template),
    )


def _farther(bodies: Sequence[str], template: Template) -> Floats:
    """(labels, labels) 1 where more joints lead from the root to the second body than to the first, -1 where fewer do;
    0 for one as far, and for none."""
    apart = joints_apart(template)
    depths = np.array([apart.get((template.root, b), 0) for b in bodies])
    found = np.zeros((len(bodies) + 1, len(bodies) + 1))
    found[:-1, :-1] = np.sign(depths[None, :] - depths[:, None])
    return found


def _kind(joint: JointTemplate, linkage_of: Mapping[str, int], frames: Collection[int]) -> int:
    """Which of `KINDS` a joint is."""
    if joint.type == "prismatic":
        return KINDS.index("slide")
    if joint.name not in linkage_of:
        return KINDS.index("hinge")
    return KINDS.index("turned" if linkage_of[joint.name] in frames else "level")


def weighed(features: Features, weights: Features) -> float:
    """What features count together."""
    return sum(weights[name] * value for name, value in features.items())


def score_of(field: Field, labels: Ints) -> float:
    """What a labelling (pieces,) scores."""
    none, joints = len(field.bodies), field.joints
    a, b = labels[field.ends[:, 0]], labels[field.ends[:, 1]]
    held = field.joint[a, b]
    same = (a == b) & (a != none)
    total = field.unary[np.arange(len(labels)), labels].sum()
    for weight, counted in zip(field.weights.T, (same, held < joints, field.twins[a, b]), strict=True):
        total += weight @ counted
    near = np.bincount(held, weights=field.near, minlength=joints + 1)[:joints]
    exact = np.bincount(held, weights=field.exactly(held), minlength=joints + 1)[:joints]
    played = np.bincount(labels, minlength=none + 1)[:none]
    one_half = field.halves[labels][:, None] & (labels[:, None] == labels)
    return float(
        total
        + field.order @ field.farther[a, b]
        + 0.5 * field.astray[one_half].sum()
        + field.held[0] * (near > 0).sum()
        + field.held[1] * (exact > 0).sum()
        + field.played[:none] @ (played > 0)
    )


@dataclass(frozen=True, eq=False)
class _Around:
    """The bonds of one piece: their numbers, the pieces at their other ends, what they count for one body, for bodies
    that a joint joins, for twins, and for the piece's body being the `farther` one; whether each is `near`, and `exact`
    as each of `KINDS`."""

    bonds: Ints
    others: Ints
    same: Floats
    joined: Floats
    alike: Floats
    farther: Floats
    near: Ints
    exact: Ints

    @classmethod
    def of(cls, field: Field, p: int) -> _Around:
        bonds = np.flatnonzero((field.ends == p).any(axis=1))
        others = np.where(field.ends[bonds, 0] == p, field.ends[bonds, 1], field.ends[bonds, 0])
        weights, exact = field.weights[bonds], field.exact[bonds]
        same, joined, alike = weights.T
        farther = np.where(field.ends[bonds, 1] == p, 1.0, -1.0) * field.order[bonds]
        return cls(bonds, others, same, joined, alike, farther, field.near[bonds], exact)


class Annealing:
    """The state of one search: labels, and how often each joint is held and each body played."""

    def __init__(self, field: Field, labels: Ints) -> None:
        self.field = field
        self.labels = labels.copy()
        self.around = [_Around.of(field, p) for p in range(len(labels))]
        self._joints = field.joints
        joined = field.joint < self._joints
        self._joined = joined.astype(np.float64)
        # Of two labels there is one joint at most: what holds it can be summed up by the other end's label.
        self._kinds = [joined & (field.kind[field.joint] == kind) for kind in range(len(KINDS))]
        self._count()

    def _count(self) -> None:
        field, joints = self.field, self.field.joints
        held = field.joint[self.labels[field.ends[:, 0]], self.labels[field.ends[:, 1]]]
        self.near = np.bincount(held, weights=field.near, minlength=joints + 1)
        self.exact = np.bincount(held, weights=field.exactly(held), minlength=joints + 1)
        self.played = np.bincount(self.labels, minlength=len(field.bodies) + 1)

    def _add(self, p: int, sign: int) -> None:
        """Counts a piece, with its label, or (-1) no longer."""
        field, around = self.field, self.around[p]
        if len(around.bonds):
            held = field.joint[self.labels[p], self.labels[around.others]]
            exact = around.exact[np.arange(len(held)), field.kind[held]]
            self.near += sign * np.bincount(held, weights=around.near, minlength=self._joints + 1)
            self.exact += sign * np.bincount(held, weights=exact, minlength=self._joints + 1)
        self.played[self.labels[p]] += sign

    def _free(self, count: np.ndarray[Any, np.dtype[Any]], weight: float) -> Floats:
        """(joints + 1,) what holding each joint would add: nothing where one is held; the last is no joint."""
        gain = np.where(count <= 0, weight, 0.0)
        gain[-1] = 0.0
        return gain

    def conditional(self, p: int) -> Floats:
        """(labels,) what each label of piece p would score, all others as they are, up to a constant. The counts are
        left without the piece; `put` adds it again."""
        field, around = self.field, self.around[p]
        self._add(p, -1)
        scores = field.unary[p].copy()
        scores[:-1] += field.played[:-1] * (self.played[:-1] == 0)
        scores += field.halves * np.bincount(self.labels, weights=field.astray[p], minlength=len(scores))
        if len(around.bonds):
            theirs, n = self.labels[around.others], len(scores)
            same = np.bincount(theirs, weights=around.same, minlength=n)
            same[-1] = 0.0
            scores += same + self._joined @ np.bincount(theirs, weights=around.joined, minlength=n)
            scores += field.twins @ np.bincount(theirs, weights=around.alike, minlength=n)
            scores += np.bincount(theirs, weights=around.farther, minlength=n) @ field.farther
            near = np.minimum(np.bincount(theirs, weights=around.near, minlength=n), 1.0)
            scores += self._free(self.near, field.held[0])[field.joint] @ near
            for kind, exact in zip(self._kinds, around.exact.T, strict=True):
                if exact.any():
                    there = np.minimum(np.bincount(theirs, weights=exact, minlength=n), 1.0)
                    scores += (self._free(self.exact, field.held[1])[field.joint] * kind) @ there
        return np.asarray(scores)

    def put(self, p: int, label: int) -> None:
        """Gives piece p a label, after `conditional`."""
        self.labels[p] = label
        self._add(p, 1)

    def sweep(self, temperature: float, rng: np.random.Generator) -> None:
        """Every piece once, in a random order; without temperature: to its best label."""
        for p in rng.permutation(len(self.labels)).tolist():
            scores = self.conditional(p)
            if temperature > 0:
                scores = scores + temperature * rng.gumbel(size=len(scores))
            self.put(p, int(np.argmax(scores)))

    def swap(self, temperature: float, rng: np.random.Generator, score: float) -> float:
        """Tries two bodies in each other's place (Metropolis); returns the labels' score, which was `score`."""
        played = np.flatnonzero(self.played[:-1] > 0)
        if len(played) < 1:
            return score
        a = int(rng.choice(played))
        b = int(rng.integers(len(self.field.bodies)))
        other = self.labels.copy()
        other[self.labels == a], other[self.labels == b] = b, a
        changed = score_of(self.field, other)
        gain = changed - score
        if gain > 0 or (temperature > 0 and np.log(rng.random()) < gain / temperature):
            self.labels = other
            self._count()
            return changed
        return score


def labelled(
    field: Field, start: Ints | None = None, *, hot: float = HOT, sweeps: int = SWEEPS, tries: int = 1
) -> tuple[Ints, float]:
    """The best labelling found (pieces,) in so many tries, and its score. From a `start`, it is only warmed to `hot`
    first."""
    found = [_annealed(field, start, hot, sweeps, SEED + k) for k in range(tries)]
    return max(found, key=lambda one: one[1])


def _annealed(field: Field, start: Ints | None, hot: float, sweeps: int, seed: int) -> tuple[Ints, float]:
    rng = np.random.default_rng(seed)
    state = Annealing(field, np.argmax(field.unary, axis=1) if start is None else start)
    best, score = state.labels.copy(), score_of(field, state.labels)
    for temperature in [*np.geomspace(hot, COLD, sweeps), *[0.0] * 6]:
        state.sweep(temperature, rng)
        reached = score_of(field, state.labels)
        for _ in range(SWAPS):
            reached = state.swap(temperature, rng, reached)
        if reached > score:
            best, score = state.labels.copy(), reached
    return best, score


def leads(field: Field, labels: Ints) -> tuple[Floats, Ints]:
    """(pieces,) by how much each label is better than the piece's next best, all others as they are; and that one."""
    state = Annealing(field, labels)
    lead, second = np.zeros(len(labels)), np.zeros(len(labels), dtype=np.int64)
    for p in range(len(labels)):
        scores = state.conditional(p)
        own = scores[labels[p]]
        scores[labels[p]] = -np.inf
        second[p] = int(np.argmax(scores))
        lead[p] = own - scores[second[p]]
        state.put(p, int(labels[p]))
    return lead, second


def against(field: Field, labels: Ints, told: Floats) -> Floats:
    """(pieces,) by how much another label would be better than a piece's own, all others as they are, if what it was
    `told` (pieces, labels) did not count; below 0, everything else agrees."""
    state = Annealing(field, labels)
    found = np.zeros(len(labels))
    for p in range(len(labels)):
        scores = state.conditional(p)
        scores[:-1] -= told[p]
        own = scores[labels[p]]
        scores[labels[p]] = -np.inf
        found[p] = scores.max() - own
        state.put(p, int(labels[p]))
    return found
