"""What speaks for a piece being a body: its names, what the contacts alone made of it, its shape."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.fusion.pieces import Piece
from yellowiron.alignment.fusion.stance import Stance
from yellowiron.model.template import Template, Usual

Votes = list[dict[str, "Vote"]]
"""By piece: body → what speaks for it. A body that is absent cannot be the piece's."""
SAID = 1000.0
"""What a person's word counts."""
NAMED = 100.0
"""What a name counts that says a body as clearly as can be; everything else is measured against it."""
SOLVED = 110.0
"""What the contacts count for a body all of whose joints they found."""
CLEARLY = 0.6
"""From here on a name speaks of a body and not of something beside it."""
BARS = ("barrel", "rod")
BAR = 15.0
"""A slender round piece for a barrel or a rod; one that is not, against it."""
BULKY = 0.02
"""A piece of more than this share of the machine's surface that is no bar is no half of a cylinder."""
FRAME = 25.0
"""The largest piece for a frame; smaller ones less, as the root of their surface."""
NOT_ROUND = 60.0
SIDEWAYS = 0.5
"""A bar that lies across the machine is a pin or an axle, no hydraulic cylinder (cosine to the left)."""
UNUSUAL = 12.0
"""What it counts against a body, for each nat of surprise, that a piece is where the body usually is not, or larger."""
FARTHEST = 25.0
"""No more than so many squared deviations of a point count."""
MOST = 7.0
"""Nor so many nats of a piece: strangers draw machines as we did not."""
NINETY = 3.29
"""A box of 90 % is so many standard deviations wide."""
PLACE, LENGTH, AREA = np.array([0.05, 0.05, 0.03]), 0.35, 0.8
"""Deviations beyond those of the machines that were measured: forward, left and up in machine sizes; of the logarithms
of length and area."""
FURTHER = np.array([0.03, 0.01, 0.03])
"""How much further a body may be with every joint between it and the root: arms are drawn in any pose."""
LENT = 0.75
"""What a name counts for a body next to the one it names, where nothing bears the neighbour's own name."""


@dataclass(frozen=True)
class Vote:
    """What speaks for a piece being a body: `names`, what the `contacts` alone gave, its `shape` and place, and a
    person's word (`said`)."""

    names: float
    contacts: float
    shape: float
    said: float = 0.0

    @property
    def weight(self) -> float:
        """All of it."""
        return self.names + self.contacts + self.shape + self.said


def votes_of(
    pieces: Sequence[Piece],
    template: Template,
    scores: Sequence[Mapping[str, float]],
    trust: float,
    answer: Answer,
    stance: Stance,
    edited: Mapping[int, str],
) -> Votes:
    """Weights for every body a piece could be. `scores`: by solid, what its names say; `trust` in them, 0 to 1;
    `answer`: what the contacts alone gave; `stance`: how the machine stands; `edited`: solid → the body that a person
    gave it."""
    kinds = {r.name: r.kind for r in template.roles if r.rigid}
    total = sum(p.area for p in pieces) or 1.0
    largest = max((p.area for p in pieces), default=1.0)
    solved = _solved(answer)
    depth = _depths(template)
    saids = borrowed([named(piece, scores) for piece in pieces], template)
    votes: Votes = []
    for piece, said in zip(pieces, saids, strict=True):
        mine: dict[str, Vote] = {}
        told = {edited[i] for i in piece.members if i in edited}
        for body, kind in kinds.items():
            name = said.get(body, 0.0)
            shape = _shape(piece, kind, name > 0 or body in told, total, largest, stance)
            if shape is None:
                continue
            if body in template.usual:
                shape -= _unusual(piece, template.usual[body], piece.area / total, stance, depth[body])
            contact = max((solved[i].get(body, 0.0) for i in piece.members if i in solved), default=0.0)
            mine[body] = Vote(NAMED * trust * name, SOLVED * contact, shape, SAID * (body in told))
        votes.append(mine)
    return votes


def named(piece: Piece, scores: Sequence[Mapping[str, float]]) -> dict[str, float]:
    """Body → how clearly the names of a piece's solids speak of it, the mean over those that say anything."""
    telling = [scores[i] for i in sorted(piece.members) if scores[i]]
    found: dict[str, float] = {}
    for said in telling:
        for body, score in said.items():
            found[body] = found.get(body, 0.0) + score / len(telling)
    return found


def borrowed(saids: list[dict[str, float]], template: Template) -> list[dict[str, float]]:
    """What names say, where a body that no name speaks of clearly borrows those of the bodies of its kind that it has a
    joint with: of two arms both called arm, one is the boom."""
    spoken = {body for said in saids for body, score in said.items() if score >= CLEARLY}
    kinds = {r.name: r.kind for r in template.roles if r.rigid}
    lent: dict[str, set[str]] = {}
    for joint in template.joints:
        for own, other in (template.bodies_of(joint), template.bodies_of(joint)[::-1]):
            alike = own != other and kinds.get(str(own)) == kinds.get(str(other)) == "arm"
            if alike and own not in spoken and other in spoken:
                lent.setdefault(str(own), set()).add(str(other))
    return [
        {
            **said,
            **{b: max(said.get(b, 0.0), LENT * max(said.get(o, 0.0) for o in others)) for b, others in lent.items()},
        }
        for said in saids
    ]


def _depths(template: Template) -> dict[str, int]:
    """Body → how many joints lead to it from the root."""
    depth = {template.root: 0}
    pairs = [template.bodies_of(j) for j in template.joints]
    grown = True
    while grown:
        grown = False
        for a, b in (*pairs, *((b, a) for a, b in pairs)):
            if a in depth and b is not None and depth.get(b, 99) > depth[str(a)] + 1:
                depth[b] = depth[str(a)] + 1
                grown = True
    return {r.name: depth.get(r.name, 0) for r in template.roles}


def _solved(answer: Answer) -> dict[int, dict[str, float]]:
    """Solid → the body that the contacts gave it, and the share of that body's joints that they found, squared: one
    joint of three is nothing, all are nearly certain."""
    solution, template = answer.solution, answer.template
    found: dict[int, dict[str, float]] = {}
    for c, body in sorted(solution.body_of.items()):
        joints = [j.name for j in template.joints if body in template.bodies_of(j)]
        held = sum(j in solution.hinge_of or j in solution.slide_of for j in joints)
        share = held / len(joints) if joints else 0.0
        for i in answer.structure.clusters[c].members:
            found[i] = {body: share * share}
    return found


def _unusual(piece: Piece, usual: Usual, share: float, stance: Stance, depth: int) -> float:
    """What speaks against a piece being of a body: how far its surface is from where the body usually is, and how much
    longer and larger it is than the whole body usually is."""
    low, high = np.array(usual.low), np.array(usual.high)
    spread = (high - low) / NINETY + PLACE + FURTHER * depth
    off = (stance.place(piece.samples) - 0.5 * (low + high)) / spread
    # Surprise of a normal distribution, in nats; far is far.
    against = 0.5 * float(np.mean(np.minimum((off * off).sum(axis=1), FARTHEST))) + float(np.log(10 * spread).sum())
    against += 0.5 * (max(0.0, float(np.log(piece.spread[0] / stance.size / usual.length))) / LENGTH) ** 2
    against += 0.5 * (max(0.0, float(np.log(share / usual.area))) / AREA) ** 2
    return UNUSUAL * min(against, MOST)


def _shape(piece: Piece, kind: str, named_so: bool, total: float, largest: float, stance: Stance) -> float | None:
    """What a piece's shape says for a body of a kind; None where it cannot be one."""
    share = piece.area / total
    if kind == "wheel" or piece.kind == "wheel":
        if kind == piece.kind:
            return 40.0
        return -NOT_ROUND if named_so else None
    if kind in BARS:
        if piece.kind in BARS:
            return 40.0 if piece.kind == kind else None
        if piece.slender and abs(float(piece.axes[0] @ stance.left)) < SIDEWAYS:
            return BAR
        if share > BULKY and not named_so:
            return None
        return -BAR
    if piece.kind in BARS:
        return -NOT_ROUND
    if kind == "frame":
        return FRAME * float(np.sqrt(piece.area / largest))
    return 0.0
