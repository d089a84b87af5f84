"""The judge: what a labelling of pieces with bodies scores.

A labelling scores what the votes say of each piece and what the bonds say of each pair; `near` and `exact` once for
every joint that neighbours of its two bodies hold, or an exact axis; for every body that any piece plays `required`
where the type always has it, less half of what its joints count as neighbours: a body pays for itself only if its
joints are there. What each counts is learned (`weights`). That is a Markov random field with counted joints, whose best
labelling `annealing` looks for.
"""

from __future__ import annotations

import functools
import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib import resources
from types import MappingProxyType
from typing import Any

import networkx
import numpy as np
from numpy.typing import NDArray

from yellowiron.alignment.assignment.directions import linkages_of
from yellowiron.alignment.assignment.sides import twin_role
from yellowiron.alignment.fusion.bonds import Bond
from yellowiron.alignment.fusion.votes import BARS, Features, joints_apart
from yellowiron.model.geometry import Floats
from yellowiron.model.template import JointTemplate, Template

Ints = np.ndarray[Any, np.dtype[np.int64]]
KINDS = ("slide", "hinge", "level", "turned")
"""What a joint is exactly held as: a slide; a hinge, one that lies across the machine, one that does not."""
NEVER = -1e6
AT_ONCE = 25_000
"""So many bonds, of all labellings, are scored at once: what is larger costs more to make room for than to reckon."""


@dataclass(frozen=True, eq=False)
class Field:
    """The score as arrays. Labels are the `bodies`, and last: none. `unary` (pieces, labels). Bond k joins the pieces
    `ends[k]`; its `weights[k]` are what it counts for one body, for bodies that a joint joins, and for one body or left
    and right twins, which `twins` (labels, labels) are, and for `unpaired` bodies; it holds a joint nearly (`near[k]`),
    or exactly as each kind of joint (`exact[k]`: `KINDS`). `joint` (labels, labels): the joint between two labels, or
    the number of joints. `kind` (joints + 1,): which of `KINDS` a joint is. `played` (labels,): what each body counts
    that is there; `held` what a joint counts that is held nearly, and exactly. `astray` (pieces, pieces): what two
    pieces count that are both of one half of a hydraulic cylinder, `halves` (labels,), but not in line; `cylinder`
    (labels,): which one they are of, twins as one. `order` (bonds,): what it counts that the second end's body is
    farther from the root than the first's, by the scene's tree; `farther` (labels, labels): 1 where the second label
    is, -1 where the first is. `off` (n, 2): the pairs of `astray`. `sides`: (labels,) each, the labels with what is
    joined of the left and of the right in each other's place; `twin` (labels,): the label of the other side, or the
    same. `mirrored` (n, 2): the pieces that are mirror images of each other."""

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
    cylinder: Ints
    order: Floats
    farther: Floats
    off: Ints
    sides: tuple[Ints, ...]
    twin: Ints
    mirrored: Ints

    @property
    def joints(self) -> int:
        """How many joints there are."""
        return len(self.kind) - 1

    @cached_property
    def nearly(self) -> Ints:
        """The bonds that hold a joint nearly."""
        return np.flatnonzero(self.near)

    @cached_property
    def exactly(self) -> tuple[Ints, Ints]:
        """The bonds that may hold a joint exactly, and where their `exact` begin."""
        bonds = np.flatnonzero(self.exact.any(axis=1))
        return bonds, bonds * len(KINDS)

    @cached_property
    def numbers(self) -> tuple[Ints, Ints, Ints]:
        """Where a piece's labels begin; the pieces at either end of the bonds."""
        pieces, count = self.unary.shape
        first, second = np.ascontiguousarray(self.ends.T)
        return np.arange(pieces) * count, first, second

    @cached_property
    def unpaired(self) -> NDArray[np.bool_]:
        """(labels, labels) whether they are halves of two hydraulic cylinders that are no twins."""
        return (self.halves[:, None] & self.halves) & (self.cylinder[:, None] != self.cylinder)

    @cached_property
    def by_bond(self) -> tuple[tuple[Ints | None, Floats, Floats], ...]:
        """What bonds count of what two labels are to each other (one body, joined, one body or twins, `unpaired`,
        `farther`): which bonds (None: all of them), what each counts, and (labels * labels,) what the labels are."""
        same = np.eye(len(self.joint))
        same[-1, -1] = 0.0
        told = (same, self.joint < self.joints, self.twins, self.unpaired, self.farther)
        found: list[tuple[Ints | None, Floats, Floats]] = []
        for counts, of_labels in zip([*self.weights.T, self.order], told, strict=True):
            bonds = np.flatnonzero(counts)
            some = None if 2 * len(bonds) > len(counts) else bonds
            if len(bonds):
                found.append((some, counts if some is None else counts[bonds], of_labels.ravel().astype(np.float64)))
        return tuple(found)


def field_of(
    votes: Sequence[Mapping[str, Features]],
    bonds: Sequence[Bond],
    template: Template,
    weights: Features,
    astray: NDArray[np.bool_] | None = None,
    large: Floats | None = None,
) -> Field:
    """The score of a machine's pieces under a resolved template. `votes`: by piece, the bodies it can be; `astray`:
    (pieces, pieces) whether two are not in line (`bonds.out_of_line`); `large`: (pieces,) how large each is
    (`pieces.largeness`): what is large is not left out lightly."""
    bodies = tuple(r.name for r in template.roles if r.rigid)
    at = {b: k for k, b in enumerate(bodies)}
    none = len(bodies)
    unary = np.full((len(votes), none + 1), NEVER)
    unary[:, none] = 0.0 if large is None else weights["left out"] * large
    for p, mine in enumerate(votes):
        for body, features in mine.items():
            unary[p, at[body]] = weighed(features, weights)
    linkage_of, _, tools = linkages_of(template)
    joints = [
        (_kind(j, linkage_of, tools), at[str(a)], at[str(b)])
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
    lined = np.zeros((len(votes), len(votes)), dtype=np.bool_) if astray is None else astray
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
                    weights["unpaired"] * b.paired,
                )
                for b in bonds
            ],
            dtype=np.float64,
        ).reshape(-1, 4),
        np.array([b.beside for b in bonds], dtype=np.int64),
        np.array([(b.slide, b.hinge, b.level, b.turned) for b in bonds], dtype=np.int64).reshape(-1, len(KINDS)),
        joint,
        twins,
        np.array([kind for kind, _, _ in joints] + [0], dtype=np.int64),
        played,
        (near, weights["exact"]),
        np.asarray(weights["astray"] * lined, dtype=np.float64),
        np.array([template.role(b).kind in BARS for b in bodies] + [False]),
        _cylinders(bodies, template),
        weights["ordered"] * np.array([b.branch for b in bonds], dtype=np.float64),
        _farther(bodies, template),
        np.argwhere(np.triu(lined)),
        _sides(bodies, template),
        np.array([at.get(twin_role(b) or b, k) for b, k in at.items()] + [none], dtype=np.int64),
        np.array([(b.a, b.b) for b in bonds if b.alike], dtype=np.int64).reshape(-1, 2),
    )


def _cylinders(bodies: Sequence[str], template: Template) -> Ints:
    """(labels,) the number of the hydraulic cylinder that each body is half of, of left and right twins one; 0 for what
    is none."""
    halves = [b for b in bodies if template.role(b).kind in BARS]
    slides = [template.bodies_of(j) for j in template.joints if j.type == "prismatic"]
    graph = networkx.Graph([pair for pair in slides if set(pair) <= set(halves)])
    graph.add_nodes_from(halves)
    graph.add_edges_from((b, twin_role(b)) for b in halves if twin_role(b) in halves)
    groups = sorted(networkx.connected_components(graph), key=sorted)
    number = {b: k for k, group in enumerate(groups, 1) for b in group}
    return np.array([number.get(b, 0) for b in bodies] + [0], dtype=np.int64)


def _farther(bodies: Sequence[str], template: Template) -> Floats:
    """(labels, labels) 1 where more joints lead from the root to the second body than to the first, -1 where fewer do;
    0 for one as far, and for none."""
    apart = joints_apart(template)
    depths = np.array([apart.get((template.root, b), 0) for b in bodies])
    found = np.zeros((len(bodies) + 1, len(bodies) + 1))
    found[:-1, :-1] = np.sign(depths[None, :] - depths[:, None])
    return found


def _sides(bodies: Sequence[str], template: Template) -> tuple[Ints, ...]:
    """What joints join of the left (a hydraulic cylinder; a wheel) and its twin of the right, as they exchange."""
    at = {b: k for k, b in enumerate(bodies)}
    twin = {b: str(twin_role(b)) for b in bodies if twin_role(b) in at}
    graph = networkx.Graph([ends for j in template.joints if set(ends := template.bodies_of(j)) <= twin.keys()])
    graph.add_nodes_from(twin)
    found, done = [], set[str]()
    for group in sorted(networkx.connected_components(graph), key=lambda g: sorted(g)):
        if not group & done:
            done |= group | {twin[b] for b in group}
            order = np.arange(len(bodies) + 1)
            for body in group | {twin[b] for b in group}:
                order[at[body]] = at[twin[body]]
            found.append(order)
    return tuple(found)


def _kind(joint: JointTemplate, linkage_of: Mapping[str, int], tools: Collection[int]) -> int:
    """Which of `KINDS` a joint is."""
    if joint.type == "prismatic":
        return KINDS.index("slide")
    if joint.name not in linkage_of:
        return KINDS.index("hinge")
    return KINDS.index("level" if linkage_of[joint.name] in tools else "turned")


@functools.cache
def weights() -> Mapping[str, float]:
    """Evidence → what it counts, in points: data, fitted to machines whose truth is known (`data/fusion.json`, made by
    `benchmarks/fit_fusion.py`)."""
    text = resources.files("yellowiron.alignment").joinpath("data/fusion.json").read_text(encoding="utf-8")
    return MappingProxyType(dict(json.loads(text)["weights"]))


def weighed(features: Features, weights: Features) -> float:
    """What features count together."""
    return sum(weights[name] * value for name, value in features.items())


def scores_of(field: Field, labels: Ints) -> Floats:
    """(n,) what each of several labellings (n, pieces) scores."""
    if len(labels) > (some := max(1, AT_ONCE // max(1, len(field.ends)))):
        return np.concatenate([scores_of(field, labels[k : k + some]) for k in range(0, len(labels), some)])
    rows, (_, count) = np.arange(len(labels))[:, None], field.unary.shape
    (of_piece, first, second), (exactly, of_bond) = field.numbers, field.exactly
    pairs = labels.take(first, axis=1)
    pairs *= count
    pairs += labels.take(second, axis=1)
    held = field.joint.ravel().take(pairs)
    total = field.unary.ravel().take(of_piece + labels).sum(axis=1)
    for bonds, counts, told in field.by_bond:
        total += told.take(pairs if bonds is None else pairs.take(bonds, axis=1)) @ counts
    # The last column is no joint, or no body.
    from_row = (field.joints + 1) * rows
    there = np.zeros((2, len(labels), field.joints + 1), dtype=np.bool_)
    there[0].reshape(-1)[held.take(field.nearly, axis=1) + from_row] = True
    own = held.take(exactly, axis=1)
    exact = field.exact.ravel().take(of_bond + field.kind.take(own)) > 0
    own += from_row
    there[1].reshape(-1)[own[exact]] = True
    near_held, exactly_held = there[:, :, :-1].sum(axis=2)
    played = np.zeros((len(labels), count), dtype=np.bool_)
    played.reshape(-1)[labels + count * rows] = True
    total += field.held[0] * near_held + field.held[1] * exactly_held
    total += played[:, :-1] @ field.played[:-1]
    if len(field.off):
        # Few pieces are halves, and fewer of them of one body: these stand one after the other.
        row, piece = np.nonzero(field.halves.take(labels))
        own = row * count + labels[row, piece]
        order = np.argsort(own, kind="stable")
        own, row, piece = own[order], row[order], piece[order]
        for later in range(1, len(own)):
            like = np.flatnonzero(own[later:] == own[:-later])
            if not len(like):
                break
            astray = field.astray[piece[like], piece[like + later]]
            total += np.bincount(row[like], weights=astray, minlength=len(labels))
    return np.asarray(total)


def score_of(field: Field, labels: Ints) -> float:
    """What a labelling (pieces,) scores."""
    return float(scores_of(field, labels[None])[0])
