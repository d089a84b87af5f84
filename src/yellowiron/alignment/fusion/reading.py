"""The fused reading of a machine, as an answer that the rest of the alignment goes on with."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.alignment.assignment.answer import Answer, Judged
from yellowiron.alignment.assignment.cp_sat import MISSING_WEIGHT, Solution
from yellowiron.alignment.fusion.bonds import Bond, bonds_of
from yellowiron.alignment.fusion.judge import Field, field_of, labelled, leads, weighed
from yellowiron.alignment.fusion.pieces import Piece, leading, pieces_of
from yellowiron.alignment.fusion.stance import Stance, stance_of
from yellowiron.alignment.fusion.votes import BARS, CLEARLY, Features, Votes, joints_apart, named, votes_of
from yellowiron.alignment.fusion.weights import weights
from yellowiron.alignment.structure.clusters import Structure, labelled_structure
from yellowiron.alignment.structure.observation import Observation
from yellowiron.model.template import Template, choose

MISSING = 60.0
"""What a variant loses for every body of its own that nothing plays."""
EXPLAINED = {0: 1.0, 1: 1.0, 2: 0.5}
"""How well names explain that two pieces are neighbours, by the joints between the bodies that they name."""
BELIEVED = 0.45
"""Names that explain less than this share of what they could of who is beside whom are not believed at all."""
TRUSTED = 0.7
"""… and from this share on, wholly."""
TELLING = ("name", "said")
GROUND = 30.0
"""By so much names (or a person) speak more for a body than for any other where they tell which it is. Contacts that
did not find the machine tell nothing for certain."""
CLEAR_LEAD = 12.0
"""A small piece whose body is better than any other by less than this goes with what it touches."""


@dataclass(frozen=True, eq=False)
class _Best:
    """The best labelling so far: its score, the variants chosen, the template with them, the labels of the leading
    pieces, and what they were judged by."""

    score: float
    choices: dict[str, str]
    template: Template
    field: Field
    labels: np.ndarray
    votes: Votes


@dataclass(frozen=True, eq=False)
class Evidence:
    """What a machine is judged by: its pieces, which of them can be what a body mainly is (`leading`), all bonds, how
    far names are trusted, how the machine stands, what the names say of each solid, what the contacts gave, and
    what a person said."""

    pieces: tuple[Piece, ...]
    leading: tuple[int, ...]
    bonds: tuple[Bond, ...]
    trust: float
    stance: Stance
    scores: Sequence[Mapping[str, float]]
    answer: Answer
    edited: Mapping[int, str]

    @property
    def between(self) -> list[Bond]:
        """The bonds of the leading pieces, numbered as these are."""
        number = {k: n for n, k in enumerate(self.leading)}
        return [replace(b, a=number[b.a], b=number[b.b]) for b in self.bonds if b.a in number and b.b in number]

    def votes(self, template: Template) -> Votes:
        """What speaks for every piece and body of a template with its variants decided."""
        return votes_of(self.pieces, template, self.scores, self.trust, self.answer, self.stance, self.edited)


@dataclass(frozen=True, eq=False)
class Fused:
    """The fused `answer`, how the machine stands, and how far its names were trusted (0 to 1)."""

    answer: Answer
    stance: Stance
    trust: float


def evidence_of(
    observation: Observation,
    scores: Sequence[Mapping[str, float]],
    answer: Answer,
    edited: Mapping[int, str],
    template: Template,
) -> Evidence:
    """Everything that is known before anything is judged; the arguments are those of `fused`."""
    directions = [np.asarray(axis.direction) for axis in observation.evidence[0].axes] if observation.evidence else []
    stance = stance_of(observation.solids, observation.size, directions)
    pieces = pieces_of(observation, frozenset(i for i, said in enumerate(scores) if said) | frozenset(edited))
    bonds = tuple(bonds_of(observation, pieces, answer.structure, stance))
    trust = trust_in_names(pieces, bonds, scores, choose(template, {}))
    leads = tuple(leading(pieces, observation.size))
    return Evidence(pieces, leads, bonds, trust, stance, scores, answer, edited)


def fused(
    observation: Observation,
    template: Template,
    variants: Sequence[dict[str, str]],
    scores: Sequence[Mapping[str, float]],
    answer: Answer,
    edited: Mapping[int, str],
) -> Fused:
    """The answer that names, shapes, places and contacts give together.

    `template` with its variants open, `variants` the choices to try; `scores`: by solid, what its names say; `answer`:
    what the contacts alone gave; `edited`: solid → the body a person gave it. The solution's joints are those that the
    contacts show an exact axis of."""
    evidence = evidence_of(observation, scores, answer, edited, template)

    def tried(chosen: dict[str, str], evidence: Evidence) -> _Best:
        resolved = choose(template, chosen)
        votes = evidence.votes(resolved)
        field = field_of([votes[k] for k in evidence.leading], evidence.between, resolved, weights())
        labels, score = labelled(field)
        played = {field.bodies[n] for n in labels if n < len(field.bodies)}
        score -= MISSING * sum(1 for r in resolved.roles if r.rigid and not r.optional and r.name not in played)
        return _Best(score, chosen, resolved, field, labels, votes)

    # Which end is the front is a guess so far.
    turned = replace(evidence, stance=evidence.stance.turned())
    evidence = max((evidence, turned), key=lambda e: tried(variants[0], e).score)
    best = max((tried(chosen, evidence) for chosen in variants), key=lambda b: b.score)
    pieces, chief, bonds, trust = evidence.pieces, evidence.leading, evidence.bonds, evidence.trust
    judged = _judged(best, pieces, chief, bonds)
    judged = {i: what for i, what in judged.items() if not _is_pin(i, what, observation, best.template)}
    judged |= _by_name_alone(observation, pieces, scores, trust, judged)
    return Fused(_answer(observation, best, judged or _all_root(pieces, best.template), answer), evidence.stance, trust)


def _all_root(pieces: Sequence[Piece], template: Template) -> dict[int, Judged]:
    """A machine of which nothing could be told stands as one thing on its root: doubtful, but it can be looked at."""
    words = f"no body could be told from another: all of it stands as {template.root}"
    return {i: Judged(template.root, 0.0, None, words, False) for p in pieces for i in sorted(p.members)}


def trust_in_names(
    pieces: Sequence[Piece], bonds: Sequence[Bond], scores: Sequence[Mapping[str, float]], template: Template
) -> float:
    """How far a machine's names are to be believed, 0 to 1: neighbours should be one body, or two that a joint joins,
    much more often than any two pieces are (the chance taken off, as in Cohen's kappa); two joints count
    half."""
    apart = joints_apart(template)
    said: dict[int, str] = {}
    for k, piece in enumerate(pieces):
        found = named(piece, scores)
        if found and max(found.values()) >= CLEARLY:
            said[k] = max(sorted(found), key=lambda b: found[b])

    def explained(a: int, b: int) -> float:
        return EXPLAINED.get(apart.get((said[a], said[b]), 99), 0.0)

    near = [explained(b.a, b.b) for b in bonds if b.beside and b.a in said and b.b in said]
    every = [explained(a, b) for a, b in itertools.combinations(sorted(said), 2)]
    if not near or min(every) == 1.0:
        return 1.0
    chance = float(np.mean(every))
    kappa = (float(np.mean(near)) - chance) / (1.0 - chance)
    kappa = (len(near) * kappa + 4.0) / (len(near) + 4.0)  # names are mostly right: so many more agreed before
    return float(np.clip((kappa - BELIEVED) / (TRUSTED - BELIEVED), 0.0, 1.0))


def _is_pin(i: int, what: Judged, observation: Observation, template: Template) -> bool:
    """True for a bar in bores that is no half of a hydraulic cylinder: its role hangs on the joint it is the pin of."""
    return i in observation.evidence[-1].fasteners and template.role(what.body).kind not in BARS


def _judged(best: _Best, pieces: Sequence[Piece], chief: Sequence[int], bonds: Sequence[Bond]) -> dict[int, Judged]:
    """Solid → what it was judged to be: the leading pieces first, then the others among the bodies these play."""
    bodies = best.field.bodies
    none = len(bodies)
    label_of = {k: int(best.labels[n]) for n, k in enumerate(chief)}
    played = {bodies[n] for n in label_of.values() if n < none}
    votes: list[dict[str, Features]] = []
    for k, mine in enumerate(best.votes):
        kept = bodies[label_of[k]] if label_of.get(k, none) < none else None
        if k not in label_of:
            votes.append({body: features for body, features in mine.items() if body in played})
        else:
            votes.append({kept: {**mine[kept], "said": 100.0}} if kept is not None else {})
    field = field_of(votes, bonds, best.template, weights())
    field = replace(field, exact=np.zeros_like(field.exact), played=np.zeros_like(field.played))
    start = np.array([label_of.get(k, none) for k in range(len(pieces))], dtype=np.int64)
    labels, _ = labelled(field, start, sweeps=0)
    lead, second = leads(best.field, best.labels)
    lead_all, second_all = leads(field, labels)
    found: dict[int, Judged] = {}
    for k, piece in enumerate(pieces):
        if labels[k] == none:
            continue
        body = bodies[labels[k]]
        if k in label_of:
            n = list(chief).index(k)
            margin, other = float(lead[n]), int(second[n])
        else:
            margin, other = float(lead_all[k]), int(second_all[k])
            if margin < CLEAR_LEAD:
                continue
        vote = best.votes[k][body]
        words = _words(body, margin, bodies[other] if other < none else None, vote)
        for i in piece.members:
            found[i] = Judged(
                body, margin, bodies[other] if other < none else None, words, _grounded(body, best.votes[k])
            )
    return found


def _grounded(body: str, votes: Mapping[str, Features]) -> bool:
    """True where a piece's names or a person tell its body from every other."""
    told = {b: weighed({n: f[n] for n in TELLING if n in f}, weights()) for b, f in votes.items()}
    return told[body] - max((t for b, t in told.items() if b != body), default=0.0) >= GROUND


def _words(body: str, lead: float, other: str | None, features: Features) -> str:
    """Why a piece is of a body: what spoke for it, and how far ahead it is."""
    parts = [f"{name} {weights()[name] * value:+.0f}" for name, value in features.items()]
    return f"{body} by {', '.join(parts) or 'its neighbours'}; {lead:.0f} ahead of {other or 'no body at all'}"


def _by_name_alone(
    observation: Observation,
    pieces: Sequence[Piece],
    scores: Sequence[Mapping[str, float]],
    trust: float,
    judged: Mapping[int, Judged],
) -> dict[int, Judged]:
    """Solid → body, for those too small to be pieces whose names say clearly which of the bodies found they are of."""
    inside = {i for p in pieces for i in p.members}
    played = {j.body for j in judged.values()}
    found = {}
    for solid in observation.solids:
        said = {b: s for b, s in scores[solid.index].items() if b in played}
        if solid.index in inside or not said or trust < 1.0:
            continue
        best, *others = sorted(said, key=lambda b: (-said[b], b))
        lead = 100.0 * (said[best] - (said[others[0]] if others else 0.0))
        if said[best] >= CLEARLY and lead >= CLEAR_LEAD:
            words = f"{best} by its name alone, which says so with {said[best]:.2f}"
            found[solid.index] = Judged(best, lead, others[0] if others else None, words, True)
    return found


def _answer(observation: Observation, best: _Best, judged: Mapping[int, Judged], answer: Answer) -> Answer:
    """The labelling as clusters, hinges and slides: one cluster a body."""
    kinds = {r.name: r.kind for r in best.template.roles if r.rigid}
    bodies: dict[str, list[int]] = {}
    for i, what in sorted(judged.items()):
        bodies.setdefault(what.body, []).append(i)
    structure, body_of = labelled_structure(observation.evidence[-1], bodies, kinds)
    solution = _solution(structure, body_of, best)
    return Answer(
        answer.contact, structure, best.choices, best.template, solution, {}, (), frozenset(), dict(judged)
    )  # fmt: skip


def _solution(structure: Structure, body_of: Mapping[int, str], best: _Best) -> Solution:
    """The joints that exact axes are there for: of several between two bodies the one that most pins run through."""
    hinge_of: dict[str, int] = {}
    slide_of: dict[str, int] = {}
    for joint in best.template.joints:
        pair = set(best.template.bodies_of(joint))
        if joint.type == "prismatic":
            found = [k for k, s in enumerate(structure.slides) if {body_of.get(s[0]), body_of.get(s[1])} == pair]
            slide_of |= {joint.name: found[0]} if found else {}
        elif joint.type in ("revolute", "spherical"):
            hinges = [
                (-len(h.pins), k)
                for k, h in enumerate(structure.hinges)
                if {body_of.get(h.a), body_of.get(h.b)} == pair
            ]
            hinge_of |= {joint.name: min(hinges)[1]} if hinges else {}
    missing = sum(1 for r in best.template.roles if r.rigid and not r.optional and r.name not in set(body_of.values()))
    score = round(best.score) - MISSING_WEIGHT * missing
    return Solution(dict(body_of), hinge_of, slide_of, score, round(best.score), True)
