"""Bodies between two others, of variants that have one there: a mini excavator's swing bracket.

The judge pays for such a body dearly: with it come cylinders that a stranger did not draw, and the piece is often
called after the file or the mesh that it is in. Here the variant is compared fairly, one piece at a time: what is not
its own name says nothing of it, hydraulic cylinders that nothing plays are not missed on either side, and an exact
axis through the piece that no joint explains counts as one that a joint does.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.alignment.assignment.sides import twin_role
from yellowiron.alignment.fusion.annealing import labelled
from yellowiron.alignment.fusion.best import Best, drawn, field_of_leading, labels_in, whole_score
from yellowiron.alignment.fusion.bonds import Bond
from yellowiron.alignment.fusion.evidence import Evidence
from yellowiron.alignment.fusion.judge import KINDS, NEVER, Field, Ints, weights
from yellowiron.alignment.fusion.pieces import Piece
from yellowiron.alignment.fusion.played import missing_bodies
from yellowiron.alignment.fusion.votes import BARS, Features, Votes
from yellowiron.model.template import Template

BETTER = 12.0
"""By so much the reading with a body between must be the better one, in a fair comparison …"""
AS_GOOD = -25.0
"""… and from here on its piece is for a person to look at."""
HOPELESS = -100.0
"""What is so far behind is no nearer without the halves of hydraulic cylinders that are none."""
TYPED = (*BARS, "wheel")
Machine = tuple[dict[str, str], Template]


@dataclass(frozen=True, eq=False)
class _Place:
    """A body of a variant, between two bodies that hinge on each other where the variant is not chosen."""

    choices: dict[str, str]
    template: Template
    body: str
    near: str
    far: str


def interposed(best: Best, machines: Sequence[Machine], evidence: Evidence) -> tuple[Best, frozenset[int]]:
    """The best labelling, or one of a variant with a body between two that were found, where that is better; and the
    pieces that could as well be such a body. `machines`: the variants' choices, and the templates with them."""
    best, strays = _without_stray(best, machines, evidence)
    places = list(_places(best, machines))
    if strays or not places:
        return best, strays
    known = _without_idle_bars(evidence, labels_in(best.field, best, evidence.leading), best.field, best.template)
    told = whole_score(evidence, best.field, known, best.template)
    plain = replace(best, labels=known, score=told, leading=evidence.leading)
    tried = [one for place in places for one in _tried(place, plain, evidence)]
    lead, _, found = max(tried, key=lambda one: (one[0], -one[1]), default=(-np.inf, -1, best))
    if lead >= BETTER:
        return found, frozenset()
    return best, frozenset(k for lead, k, _ in tried if lead >= AS_GOOD)


def _without_stray(best: Best, machines: Sequence[Machine], evidence: Evidence) -> tuple[Best, frozenset[int]]:
    """The best labelling; or, where nothing of a body between two others is beside either of the two, one of a variant
    without that body, and the pieces that were it: a camera's bracket under an arm, called so, bears no boom."""
    labels = [best.field.bodies[n] if n < len(best.field.bodies) else "" for n in best.labels]
    bonds = {frozenset((labels[bond.a], labels[bond.b])) for bond in evidence.between if bond.beside or bond.hinge}
    plainer: list[tuple[int, int, set[str]]] = []
    for n, (choices, template) in enumerate(machines):
        between = list(_between(best.template, template, best.played))
        stray = {
            body
            for body, near, far in between
            if body in best.played and not {frozenset((body, near)), frozenset((body, far))} & bonds
        }
        if stray:
            plainer.append((_differ(choices, best.choices), n, stray))
    if not plainer:
        return best, frozenset()
    _, n, stray = min(plainer, key=lambda one: one[:2])
    choices, template = machines[n]
    votes = evidence.votes(template)
    field = field_of_leading(evidence, votes, template)
    found, _ = labelled(field, labels_in(field, best, evidence.leading), sweeps=0, chains=1)
    score = whole_score(evidence, field, found, template)
    strays = frozenset(k for k, body in zip(evidence.leading, labels, strict=True) if body in stray)
    return Best(score, choices, template, field, found, votes, evidence.leading), strays


def _places(best: Best, machines: Sequence[Machine]) -> Iterator[_Place]:
    """The bodies that other variants have between two that are played, of variants that differ as little as can be."""
    found: dict[str, list[tuple[int, _Place]]] = {}
    for choices, template in machines:
        for body, near, far in _between(template, best.template, best.played):
            place = _Place(choices, template, body, near, far)
            found.setdefault(body, []).append((_differ(choices, best.choices), place))
    for some in found.values():
        least = min(differs for differs, _ in some)
        yield from (place for differs, place in some if differs == least)


def _between(template: Template, other: Template, played: Collection[str]) -> Iterator[tuple[str, str, str]]:
    """The bodies that a template has between two that are played, and that hinge on each other in the `other` one: each
    with these two."""
    theirs, own = _hinges(template), _plain(other)
    # Of twins one alone is none.
    for body in sorted(b for b in _plain(template) - own if twin_role(b) is None):
        beside = sorted({str(b) for pair in theirs if body in pair for b in pair - {body}} & own & {*played})
        for near, far in ((a, b) for a in beside for b in beside if template.depth(a) < template.depth(b)):
            if frozenset((near, far)) in _hinges(other) - theirs:
                yield body, near, far


def _differ(choices: Mapping[str, str], others: Mapping[str, str]) -> int:
    return sum(others.get(name) != choice for name, choice in choices.items())


def _plain(template: Template) -> set[str]:
    """The bodies that are told neither by their shape nor by their number."""
    return {r.name for r in template.roles if r.rigid and not (r.optional or r.many) and r.kind not in TYPED}


def _hinges(template: Template) -> set[frozenset[str | None]]:
    return {frozenset(template.bodies_of(j)) for j in template.joints if j.type in ("revolute", "spherical")}


def _tried(place: _Place, best: Best, evidence: Evidence) -> Iterator[tuple[float, int, Best]]:
    """By how much the variant is better with each piece that may be the body, which that is, and the labelling."""
    votes = evidence.votes(place.template)
    field = field_of_leading(evidence, votes, place.template)
    start = labels_in(field, best, evidence.leading)
    body, near, far = (field.bodies.index(b) for b in (place.body, place.near, place.far))
    chief = _largest(evidence, best.labels, len(best.field.bodies))
    none, known = len(field.bodies), {r.name for r in best.template.roles}
    rams = [b for b, name in enumerate(field.bodies) if field.halves[b] and name not in known]
    rest = field.unary.copy()
    rest[best.labels == len(best.field.bodies), :none] = NEVER
    for n, k in enumerate(evidence.leading):
        piece = evidence.pieces[k]
        around = [(m, bond) for m, bond in _around(evidence, n) if bond.beside or bond.hinge]
        if piece.kind or place.body not in votes[k] or n in chief:
            continue
        if not {near, far} <= {int(start[n]), *(int(start[m]) for m, _ in around)}:
            continue
        if not _in_place(place, votes[k], best.votes[k], best.field.bodies, int(best.labels[n])):
            continue
        if not any(bond.hinge or _is_bar(evidence.pieces[evidence.leading[m]]) for m, bond in around):
            continue
        # What is nothing of the machine stays so, but for the body's own cylinder beside it.
        unary = rest.copy()
        for m, _ in around:
            unary[m, rams] = field.unary[m, rams]
        unary[n] = NEVER
        unary[n, body] = field.unary[n, body]
        held = replace(field, unary=unary)
        labels = np.where(np.arange(len(start)) == n, body, start)
        labels, _ = labelled(held, labels, sweeps=0, chains=1)
        if _lead(place, best, evidence, field, votes, labels, n) < HOPELESS:
            continue
        labels = _without_idle_bars(evidence, labels, held, place.template)
        if not _moves(evidence, field, labels, n, (near, body), best.template):
            continue
        lead = _lead(place, best, evidence, field, votes, labels, n)
        score = whole_score(evidence, field, labels, place.template)
        why = {k: f"stands between {place.near} and {place.far}"}
        yield lead, k, Best(score, place.choices, place.template, field, labels, votes, evidence.leading, why)


def _lead(
    place: _Place, best: Best, evidence: Evidence, field: Field, votes: Votes, labels: Ints, n: int
) -> float:  # fmt: skip
    """By how much the labels with a leading piece as the body are better than the best ones, in a fair comparison."""
    lead = whole_score(evidence, field, labels, place.template) - best.score
    lead += _unseen(evidence, field, labels, place.template, best.template)
    lead -= _unseen(evidence, best.field, best.labels, best.template, place.template)
    lead += weights()["exact"] * (_idle(evidence, best.field, best.labels, n) - _idle(evidence, field, labels, n))
    k, was = evidence.leading[n], int(best.labels[n])
    if k in evidence.shared | evidence.borne | evidence.namesakes and was < len(best.field.bodies):
        named = best.votes[k].get(best.field.bodies[was], {}).get("name", 0.0)
        lead += weights()["name"] * max(0.0, named - votes[k][place.body].get("name", 0.0))
    return lead


def _in_place(
    place: _Place, votes: Mapping[str, Features], before: Mapping[str, Features], bodies: Sequence[str], was: int
) -> bool:
    """Whether a piece is where the body usually is as much as where the two beside it are, and what it was so far."""
    others = [votes[b].get("place", 0.0) for b in (place.near, place.far) if b in votes]
    others += [before[bodies[was]].get("place", 0.0)] if was < len(bodies) else []
    return votes[place.body].get("place", 0.0) <= min(others, default=np.inf)


def _is_bar(piece: Piece) -> bool:
    return piece.slender or piece.kind in BARS


def _largest(evidence: Evidence, labels: np.ndarray, none: int) -> set[int]:
    """The leading pieces that are the largest of their bodies: what a body mainly is stays it, unless that is all."""
    first: dict[int, int] = {}
    counts = np.bincount(labels, minlength=none + 1)
    for n, k in enumerate(evidence.leading):
        label = int(labels[n])
        if label != none and counts[label] > 1:
            known = first.setdefault(label, n)
            if evidence.pieces[evidence.leading[known]].area < evidence.pieces[k].area:
                first[label] = n
    return set(first.values())


def _around(evidence: Evidence, n: int) -> Iterator[tuple[int, Bond]]:
    """The leading pieces that a leading piece has bonds with, by number, and the bonds."""
    for bond in evidence.between:
        if n in (bond.a, bond.b):
            yield bond.b if bond.a == n else bond.a, bond


def _moves(evidence: Evidence, field: Field, labels: Ints, n: int, joint: tuple[int, int], other: Template) -> bool:
    """Whether anything shows that a piece turns on what bears it: an exact axis through both that the `joint` of the
    two labels may have, or a hydraulic cylinder of its own, which the `other` template has not, beside it."""
    bearer, _ = joint
    number = int(field.joint[joint])
    kind = KINDS[int(field.kind[number])]
    known = {r.name for r in other.roles}
    for m, bond in _around(evidence, n):
        label = int(labels[m])
        if label == bearer and bond.hinge and (kind == "hinge" or getattr(bond, kind)):
            return True
        ram = label < len(field.bodies) and field.halves[label] and field.bodies[label] not in known
        if ram and (bond.beside or bond.hinge):
            return True
    return False


def _idle(evidence: Evidence, field: Field, labels: Ints, n: int) -> int:
    """How many exact axes, one across the machine and one that is not, run through a piece without being a joint."""
    found = set()
    for k, bond in enumerate(evidence.between):
        if n not in (bond.a, bond.b) or not bond.hinge:
            continue
        other = evidence.pieces[evidence.leading[bond.b if bond.a == n else bond.a]]
        joint = int(field.joint[labels[bond.a], labels[bond.b]])
        held = joint < field.joints and field.exact[k][field.kind[joint]]
        if not held and other.kind not in BARS:
            found |= {name for name in ("level", "turned") if getattr(bond, name)}
    return len(found)


def _unseen(evidence: Evidence, field: Field, labels: Ints, template: Template, other: Template) -> float:
    """What a variant pays for halves of hydraulic cylinders that the `other` has not and nothing plays."""
    known = {r.name for r in other.roles if r.rigid}
    there = drawn(evidence, field.bodies, labels, template)
    lost = {r.name for r in template.roles if r.rigid and r.kind in BARS and not r.optional} - known - there
    missed = lost & set(missing_bodies(template, there)) - evidence.stance.absent
    return -weights()["more"] * len(lost - evidence.stance.absent) - weights()["missing"] * len(missed)


def _without_idle_bars(evidence: Evidence, labels: Ints, field: Field, template: Template) -> Ints:
    """The labels without the halves of hydraulic cylinders that cost more than they bring: annealing does not know that
    with the first of them all others are missed."""
    score, none = whole_score(evidence, field, labels, template), len(field.bodies)
    while True:
        halves = sorted({int(n) for n in labels if n < none and field.halves[n]})
        groups = [[n] for n in halves] + ([np.flatnonzero(field.halves).tolist()] if halves else [])
        tried = [_relabelled(field, labels, group) for group in groups]
        scores = [whole_score(evidence, field, other, template) for other in tried]
        if not scores or max(scores) <= score + 1.0:
            return labels
        labels, score = tried[int(np.argmax(scores))], max(scores)


def _relabelled(field: Field, labels: Ints, gone: Sequence[int]) -> Ints:
    """The labels, mended piece by piece, with pieces of these bodies being something else."""
    unary = field.unary.copy()
    unary[:, list(gone)] = NEVER
    start = np.where(np.isin(labels, gone), np.argmax(unary, axis=1), labels)
    return labelled(replace(field, unary=unary), start, sweeps=0, chains=1)[0]
