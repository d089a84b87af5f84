"""Places along a limb: links and cylinders are small and near each other, and in the machine's frame an arm that is
drawn in another pose has them anywhere; on the arm itself they are always at the same places.

Strangers' links and bucket cylinders were found within 0.05 of an arm's length of where they are on drawn ones.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.alignment.fusion.annealing import WARM, WARM_UP, labelled, leads
from yellowiron.alignment.fusion.best import CLEAR_LEAD, Best, field_of_leading, labels_in
from yellowiron.alignment.fusion.evidence import Evidence
from yellowiron.alignment.fusion.judge import NEVER
from yellowiron.alignment.fusion.pieces import Piece
from yellowiron.alignment.fusion.played import missing_bodies
from yellowiron.alignment.fusion.stance import Stance
from yellowiron.alignment.fusion.votes import FARTHEST, MOST, NINETY, Features, Votes, joints_apart
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template
from yellowiron.model.usual import AlongLimb
from yellowiron.support.vectors import unit

OFF = np.array([0.06, 0.04, 0.06])
"""Deviations of strangers' bodies from those that were measured: along the limb, left and across, in its lengths."""
ENDS = 0.02
"""This share of a limb's surface is beyond its length at either end."""
LEFT = np.array([0.0, 1.0, 0.0])
SMALLER = 0.3
"""What is smaller than this share of a body's largest piece does not tell how the body lies."""


@dataclass(frozen=True, eq=False)
class Limb:
    """How a limb lies in the machine's frame, in machine sizes: its middle, its `axes` (rows: along it, left, across
    both), its length."""

    middle: Floats
    axes: Floats
    length: float

    def place(self, points: Floats) -> Floats:
        """(n, 3) places in the machine's frame as places on the limb."""
        return (points - self.middle) @ self.axes.T / self.length


def limb_of(own: Floats, toward: Floats) -> Limb:
    """How a limb lies: `own` (n, 3) points of its surface, and (m, 3) of what its end carries, as `Stance.place` has
    them."""
    middle = np.median(own, axis=0)
    flat = own - middle
    flat = flat - np.outer(flat @ LEFT, LEFT)
    along = unit(np.linalg.svd(flat, full_matrices=False)[2][0])
    along = along if float((np.median(toward, axis=0) - middle) @ along) > 0.0 else -along
    low, high = np.quantile(flat @ along, [ENDS, 1.0 - ENDS])
    return Limb(middle + 0.5 * (low + high) * along, np.array([along, LEFT, np.cross(along, LEFT)]), float(high - low))


def limbs_in(pieces: Sequence[Piece], bodies: Mapping[int, str], template: Template, stance: Stance) -> dict[str, Limb]:
    """Body that hangs on a limb → this, where that and what it carries are played. `bodies`: piece → its body."""
    found, known = {}, dict[tuple[str, str], Limb]()
    for body, along in _hanging(template).items():
        ends = along.limb, along.toward
        if not {*ends} <= {*bodies.values()}:
            continue
        if ends not in known:
            known[ends] = limb_of(*(_points(pieces, bodies, end, stance) for end in ends))
        found[body] = known[ends]
    return found


def along_limbs(
    votes: Sequence[Mapping[str, Features]],
    pieces: Sequence[Piece],
    limbs: Mapping[str, Limb],
    template: Template,
    stance: Stance,
) -> Votes:
    """The votes with places on their limb for the bodies that hang on one."""
    hanging = _hanging(template)
    return [
        {b: {**what, "place": _surprise(stance, piece, hanging[b], limbs[b])} if b in limbs else what
         for b, what in mine.items()}
        for piece, mine in zip(pieces, votes, strict=True)
    ]  # fmt: skip


def _hanging(template: Template) -> dict[str, AlongLimb]:
    bodies = {r.name for r in template.roles if r.rigid}
    return {b: usual.along for b, usual in template.usual.items() if b in bodies and usual.along is not None}


def _points(pieces: Sequence[Piece], bodies: Mapping[int, str], body: str, stance: Stance) -> Floats:
    """Points of the surface of a body's larger pieces."""
    own = [pieces[k] for k, b in sorted(bodies.items()) if b == body]
    largest = max(p.area for p in own)
    return np.concatenate([stance.place(p.samples) for p in own if p.area >= SMALLER * largest])


def _surprise(stance: Stance, piece: Piece, along: AlongLimb, limb: Limb) -> float:
    """What speaks against a piece's place on a limb, in nats, as `votes` has it of places in the machine."""
    low, high = np.array(along.low), np.array(along.high)
    # What is drawn with a cylinder to one side of the middle has it on the other as often.
    aside = max(-low[1], high[1])
    low[1], high[1] = -aside, aside
    spread = np.hypot((high - low) / NINETY, OFF)
    off = (limb.place(stance.place(piece.samples)) - 0.5 * (low + high)) / spread
    near = 0.5 * float(np.mean(np.minimum((off * off).sum(axis=1), FARTHEST)))
    return min(near + float(np.log(10 * limb.length * spread).sum()), MOST)


def on_limbs(best: Best, evidence: Evidence) -> tuple[Best, Evidence]:
    """The labelling once the limbs are known: links and cylinders by where they are on these, small pieces with the
    large ones, warmed from what was found. Frames, limbs and tools stay what they are, or become such a body; one that
    nothing plays yet may be played where what it joins is there. The score, by which variants compare, is as it was."""
    pieces, bodies, none = evidence.pieces, best.field.bodies, len(best.field.bodies)
    own = {k: bodies[n] if n < none else "" for k, n in zip(evidence.leading, best.labels.tolist(), strict=True)}
    limbs = limbs_in(pieces, {k: body for k, body in own.items() if body}, best.template, evidence.stance)
    apart = joints_apart(best.template)
    missing = missing_bodies(best.template, best.played)
    open_ones = best.played | {m for m in missing if sum(apart.get((m, b), 9) == 1 for b in best.played) > 1}
    hung = limbs.keys() & open_ones
    if not hung:
        return best, evidence
    votes = along_limbs(best.votes, pieces, limbs, best.template, evidence.stance)
    pins = evidence.pins - own.keys()

    def may_be(k: int) -> Collection[str]:
        """Which bodies a piece may be of now: what is one of them may be another that nothing plays."""
        if k in pins:
            return ()
        if k in best.between:
            return {own[k]}
        if k not in own:
            return open_ones
        return open_ones | limbs.keys() if own[k] in hung else {own[k]} | hung

    told = [{b: what for b, what in mine.items() if b in may_be(k)} for k, mine in enumerate(votes)]
    everything = replace(evidence, leading=tuple(range(len(pieces))))
    field = field_of_leading(everything, told, best.template)
    field.unary[sorted(k for k, body in own.items() if body and body not in hung), none] = NEVER
    labels, _ = labelled(field, labels_in(field, best, everything.leading), hot=WARM_UP, sweeps=WARM)
    lead, _ = leads(field, labels)
    names = [bodies[n] if n < none else "" for n in labels.tolist()]
    chosen = {k for k, body in enumerate(names) if k in own or (body in limbs and lead[k] >= CLEAR_LEAD)}
    wider = replace(evidence, leading=tuple(sorted(chosen)))
    field = field_of_leading(wider, votes, best.template)
    return replace(best, field=field, labels=labels[list(wider.leading)], votes=votes, leading=wider.leading), wider
