"""The fused reading of a machine, as an answer that the rest of the alignment goes on with."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.alignment.assignment.answer import Answer, Judged, open_choices
from yellowiron.alignment.assignment.cp_sat import MISSING_WEIGHT, Solution
from yellowiron.alignment.assignment.directions import ALIKE, NOT_ACROSS, linkages_of, sections_of
from yellowiron.alignment.assignment.search import machine_of
from yellowiron.alignment.assignment.sides import twin_role
from yellowiron.alignment.facing import UNTOLD, Facing
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.fusion.annealing import CHAINS, HOT, SWEEPS, WARM, WARM_UP, against, labelled, leads
from yellowiron.alignment.fusion.best import CLEAR_LEAD, Best, field_of_leading, labels_in, lacking, standing_for
from yellowiron.alignment.fusion.bonds import Bond, out_of_line
from yellowiron.alignment.fusion.evidence import PIN, Evidence, across, evidence_of, ways_of
from yellowiron.alignment.fusion.interposed import interposed
from yellowiron.alignment.fusion.judge import field_of, score_of, weighed, weights
from yellowiron.alignment.fusion.limbs import on_limbs
from yellowiron.alignment.fusion.pieces import Piece
from yellowiron.alignment.fusion.played import beside_lost_arms, missing_bodies
from yellowiron.alignment.fusion.stance import Stance
from yellowiron.alignment.fusion.votes import (
    BARS,
    CLEARLY,
    Features,
    Votes,
    clearly_named,
    joints_apart,
    named,
)
from yellowiron.alignment.structure.clusters import Hinge, Structure, labelled_structure
from yellowiron.alignment.structure.observation import Observation, slewing_joints
from yellowiron.model.geometry import Floats
from yellowiron.model.rows import as_drawn
from yellowiron.model.template import JointTemplate, Template

GLANCE, FEW, LIKELY = SWEEPS // 2, 4, 4
"""So many sweeps of few chains tell which variants are the likeliest, and so many of these are judged with all."""
MANY = 32
"""So many chains settle the variant that was chosen."""
NEARLY = 2
"""A machine is nearly whole if no more bodies are missing between those that are there."""
TELLING = ("name", "said")
GROUND = 30.0
"""By so much names (or a person) speak more for a body than for any other where they tell which it is. Contacts that
did not find the machine tell nothing for certain."""
CONTRARY = 25.0
"""Where all but the names speak so much more for another body, names are not enough to go unasked."""
BESIDE = 0.05
"""What its name alone gives to a body is no farther from it, in machine sizes."""
AS_GOOD = 12.0
"""A variant by which a machine is judged less well by no more than this could as well be the one."""
COOL = 4.0
"""A variant's labels are mended from this temperature where they are another one's, with bodies that stand for its."""
BY_OTHERS = 1.0
"""… and takes over another one's labels where these are better by more than this."""


@dataclass(frozen=True, eq=False)
class Fused:
    """The fused `answer`, how the machine stands, how far its names were trusted (0 to 1), what the judge makes of it,
    and what it makes of the bodies that the `contacts` alone gave, however the machine stands; how much better it is
    than with its front behind (`ahead`: at first sight, the score's units)."""

    answer: Answer
    stance: Stance
    trust: float
    score: float
    contacts: float
    ahead: float = np.inf


def fused(
    observation: Observation,
    template: Template,
    variants: Sequence[dict[str, str]],
    scores: Sequence[Mapping[str, float]],
    answer: Answer,
    edited: Mapping[int, str],
    facing: Facing = UNTOLD,
) -> Fused:
    """The answer that names, shapes, places and contacts give together.

    `template` with its variants open, `variants` the choices to try; `scores`: by solid, what its names say; `answer`:
    what the contacts alone gave; `edited`: solid → the body a person gave it; `facing`: which way a person
    said that the machine faces. The solution's joints are those that the contacts show an exact axis of."""
    evidence = evidence_of(observation, scores, answer, edited, template, facing)

    found_so_far: dict[tuple[Evidence, int], Best] = {}

    def tried(
        chosen: dict[str, str],
        resolved: Template,
        evidence: Evidence,
        sweeps: int = SWEEPS,
        chains: int = CHAINS,
        start: Best | None = None,
    ) -> Best:
        last = found_so_far.get((evidence, id(resolved)))
        votes = last.votes if last is not None else evidence.votes(resolved)
        field = last.field if last is not None else field_of_leading(evidence, votes, resolved)
        first = labels_in(field, start, evidence.leading) if start is not None else None
        hot = HOT if start is None else WARM_UP
        labels, score = labelled(field, first, hot=hot, sweeps=sweeps, chains=chains)
        score += lacking(evidence, field.bodies, labels, resolved)
        found = Best(score, chosen, resolved, field, labels, votes, evidence.leading)
        # A longer annealing may end beside what a shorter one had found.
        found_so_far[evidence, id(resolved)] = max(last or found, found, key=lambda b: b.score)
        return found_so_far[evidence, id(resolved)]

    machines = [(chosen, machine_of(template, chosen)) for chosen in variants]
    ways = ways_of(evidence, template, bool(observation.rows))
    looked = [(tried(*machines[0], e, GLANCE, FEW), e) for e in ways]
    first, evidence = max(looked, key=lambda one: one[0].score)
    if template.root not in first.played:
        # A machine without its base is read wrongly: its sides may be its ends.
        turned = [(tried(*machines[0], e, GLANCE, FEW), e) for e in across(evidence, observation, template)]
        looked += [(best, e) for best, e in turned if template.root in best.played]
        ways = [e for _, e in looked]
        first, evidence = max(looked, key=lambda one: one[0].score)
    behind = [other.score for other, e in looked if e.stance.rotation[0] @ evidence.stance.rotation[0] < 0.0]
    ahead = first.score - max(behind, default=-np.inf)
    others = [tried(*machine, evidence, WARM, FEW, first) for machine in machines[1:]]
    glanced = sorted((first, *others), key=lambda b: -b.score)
    likely = [tried(b.choices, b.template, evidence) for b in glanced[:LIKELY]]
    bare = [(b, as_drawn(b.template, b.played)) for b in likely]
    likely += [tried(b.choices, shown, evidence) for b, shown in bare if shown is not b.template]
    likely = [_by_any_labels(b, likely, evidence) for b in likely]
    found_so_far |= {(evidence, id(b.template)): b for b in likely}
    best = max(likely, key=lambda b: b.score)
    best = tried(best.choices, best.template, evidence, chains=MANY)
    of_contacts = [(_of_contacts(answer, way), way) for way in ways]
    told, way = max(of_contacts, key=lambda one: one[0].score)
    if told.score > best.score:
        # Annealing did not come by what the contacts found, or at a glance the machine stood otherwise.
        turned = way.stance.rotation[0] @ evidence.stance.rotation[0] < 0.0
        ahead = told.score - best.score if turned else ahead
        warmed = tried(told.choices, told.template, way, WARM, start=told)
        best, evidence = max(told, warmed, key=lambda b: b.score), way
        likely.append(best)
    if more := _between_found(best, evidence):
        # What is small is added to the machine that was found: alone it could outweigh what leads.
        wider = replace(evidence, leading=tuple(sorted({*evidence.leading, *more})))
        best = tried(best.choices, best.template, wider, 0, 1, best)
        evidence = wider
    unsaid = _unsaid(best, evidence)
    best, doubtful = interposed(best, machines, evidence)
    best, evidence = on_limbs(best, evidence)
    tried_so = [(b.choices, b.score) for b in likely]
    as_good = open_choices(best.choices, tried_so, max(b.score for b in likely) - AS_GOOD)
    contacts = max(_unsaid(found, way) for found, way in of_contacts)
    pieces, trust = evidence.pieces, evidence.trust
    judged = _judged(best, evidence, doubtful)
    sections = {i for p in pieces if p.spread[0] >= PIN * observation.size for i in p.members}
    judged = {
        i: what for i, what in judged.items() if i in sections or not _is_pin(i, what, observation, best.template)
    }
    judged |= _by_name_alone(observation, pieces, scores, trust, judged)
    judged = judged or _all_root(pieces, best.template)
    answer = replace(_answer(observation, best, judged, answer, evidence.stance), open_choices=as_good)
    return Fused(answer, evidence.stance, trust, unsaid, contacts, ahead)


def _of_contacts(answer: Answer, evidence: Evidence) -> Best:
    """The labelling that the contacts alone gave, as the judge scores it; a piece is of the body that most of it is
    of."""
    template = answer.template
    votes = evidence.votes(template)
    field = field_of_leading(evidence, votes, template)
    none = len(field.bodies)
    solved = {
        i: field.bodies.index(body)
        for c, body in sorted(answer.solution.body_of.items())
        for i in answer.structure.clusters[c].members
    }
    # Whatever the contacts say, a person's word holds in the end.
    told = {i: field.bodies.index(body) for i, body in evidence.edited.items() if body in field.bodies}
    labels = np.full(len(evidence.leading), none, dtype=np.int64)
    for n, k in enumerate(evidence.leading):
        members = evidence.pieces[k].members
        known = [told[i] for i in sorted(members & told.keys())] or [solved.get(i, none) for i in members]
        counts = np.bincount(known, minlength=none + 1)
        labels[n] = int(np.argmax(counts))
    score = score_of(field, labels) + lacking(evidence, field.bodies, labels, template)
    return Best(score, dict(answer.choices), template, field, labels, votes, evidence.leading)


def _unsaid(best: Best, evidence: Evidence) -> float:
    """What a labelling scores without what a person said."""
    return best.score - _said(evidence, best.votes, best.field.bodies, best.labels)


def _said(evidence: Evidence, votes: Votes, bodies: Sequence[str], labels: np.ndarray) -> float:
    """What a labelling scores for what a person said: no reading is the better for being told more."""
    led = zip(evidence.leading, labels, strict=True)
    told = sum(votes[k].get(bodies[n], {}).get("said", 0.0) for k, n in led if n < len(bodies))
    return weights()["said"] * told


def _by_any_labels(best: Best, others: Sequence[Best], evidence: Evidence) -> Best:
    """A variant with its own labels, or with those of another one where it scores better by them: annealing does not
    know what a body costs that nothing plays, and may leave one out that another variant has. What one variant has a
    single hydraulic cylinder of, the other has twins of: such labels are mended a little."""
    field, leading = best.field, evidence.leading

    def scored(told: np.ndarray) -> float:
        return score_of(field, told) + lacking(evidence, field.bodies, told, best.template)

    told = [labels_in(field, other, leading) for other in others if other is not best]
    for other in others:
        if standing := standing_for(other.template, best.template):
            told.append(
                labelled(field, labels_in(field, other, leading, standing), hot=COOL, sweeps=WARM, chains=FEW)[0]
            )
    labels = max(told, key=scored, default=best.labels)
    score = scored(labels)
    return replace(best, score=score, labels=labels) if score > best.score + BY_OTHERS else best


def _between_found(best: Best, evidence: Evidence) -> set[int]:
    """The pieces too small to lead that lie between bodies which a body joins that nothing plays, where only a few of
    such bodies are missing: links are small."""
    bodies, template = best.field.bodies, best.template
    body_of = {k: bodies[n] for k, n in zip(evidence.leading, best.labels, strict=True) if n < len(bodies)}
    played, apart = set(body_of.values()), joints_apart(template)
    missing = [m for m in missing_bodies(template, played) if sum(apart.get((m, b), 9) == 1 for b in played) > 1]
    beside: dict[int, set[str]] = {}
    for bond in evidence.bonds if len(missing) <= NEARLY else ():
        for own, other in ((bond.a, bond.b), (bond.b, bond.a)):
            if bond.beside and own not in body_of and own not in evidence.pins and other in body_of:
                beside.setdefault(own, set()).add(body_of[other])
    # Three bodies on one pin are two joints: the outer ones are neighbours too.
    return {
        k
        for k, near in beside.items()
        for body in missing
        if min(apart.get((body, b), 9) for b in near) == 1 and sum(apart.get((body, b), 9) <= 2 for b in near) > 1
    }


def _all_root(pieces: Sequence[Piece], template: Template) -> dict[int, Judged]:
    """A machine of which nothing could be told stands as one thing on its root: doubtful, but it can be looked at."""
    words = f"no body could be told from another: all of it stands as {template.root}"
    return {i: Judged(template.root, 0.0, None, words, False) for p in pieces for i in sorted(p.members)}


def _is_pin(i: int, what: Judged, observation: Observation, template: Template) -> bool:
    """True for a bar in bores that is no half of a hydraulic cylinder: its role hangs on the joint it is the pin of."""
    return i in observation.evidence[-1].fasteners and template.role(what.body).kind not in BARS


def _judged(best: Best, evidence: Evidence, doubtful: frozenset[int]) -> dict[int, Judged]:
    """Solid → what it was judged to be: the leading pieces first, then the others among the bodies these play;
    `doubtful` pieces are for review."""
    pieces, chief, bonds = evidence.pieces, evidence.leading, evidence.bonds
    bodies = best.field.bodies
    none = len(bodies)
    label_of = {k: int(best.labels[n]) for n, k in enumerate(chief)}
    label_of |= _with_twins(label_of, best, bonds)
    played = {bodies[n] for n in label_of.values() if n < none}
    votes: list[dict[str, Features]] = []
    for k, mine in enumerate(best.votes):
        kept = bodies[label_of[k]] if label_of.get(k, none) < none else None
        if k not in label_of:
            votes.append({body: features for body, features in mine.items() if body in played})
        else:
            votes.append({kept: {**mine[kept], "said": 100.0}} if kept is not None else {})
    field = field_of(votes, bonds, best.template, weights(), out_of_line(pieces))
    field = replace(field, exact=np.zeros_like(field.exact), played=np.zeros_like(field.played))
    start = np.array([label_of.get(k, none) for k in range(len(pieces))], dtype=np.int64)
    labels, _ = labelled(field, start, sweeps=0, chains=1)
    lead, second = leads(best.field, best.labels)
    lead_all, second_all = leads(field, labels)
    unsure = beside_lost_arms(best.template, played)
    contrary = against(best.field, best.labels, _told([best.votes[k] for k in chief], bodies))
    alone = _one_name(evidence)
    sections = frozenset[str]().union(*sections_of(best.template))
    found: dict[int, Judged] = {}
    for k, piece in enumerate(pieces):
        if labels[k] == none:
            continue
        body = bodies[labels[k]]
        if k in label_of:
            n = list(chief).index(k)
            margin, other = float(lead[n]), int(second[n])
            doubted = contrary[n] > CONTRARY or body in unsure or k in best.between or k in doubtful
        else:
            doubted = False
            margin, other = float(lead_all[k]), int(second_all[k])
            if margin < CLEAR_LEAD:
                continue
        vote = best.votes[k][body]
        words = _words(body, margin, bodies[other] if other < none else None, vote)
        words = f"{words}; it {best.between[k]}" if k in best.between else words
        words = f"{words}; but it could be a body between two others" if k in doubtful else words
        # What a mesh is called is true of no more than two of three of its solids, and what carries a part is not it.
        # Nor does "boom 4" tell the boom from its fourth section.
        own = (
            not alone and k not in evidence.shared | evidence.borne and not (k in evidence.further and body in sections)
        )
        own = own or "said" in vote
        grounded = own and not doubted and _grounded(body, best.votes[k], named(piece, evidence.scores), evidence.trust)
        for i in piece.members:
            found[i] = Judged(body, margin, bodies[other] if other < none else None, words, grounded)
    return found


def _with_twins(label_of: Mapping[int, int], best: Best, bonds: Sequence[Bond]) -> dict[int, int]:
    """Piece → label, for those judged to be nothing whose mirror image is of a body that has no twin: a link's other
    plate."""
    bodies = best.field.bodies
    single = {
        n for n, b in enumerate(bodies) if twin_role(b) is None and best.template.role(b).kind not in (*BARS, "wheel")
    }
    found = {}
    for bond in bonds:
        for own, other in ((bond.a, bond.b), (bond.b, bond.a)):
            alike = bond.alike and label_of.get(own) == len(bodies) and label_of.get(other) in single
            if alike and bodies[label_of[other]] in best.votes[own]:
                found[own] = label_of[other]
    return found


def _told(votes: Sequence[Mapping[str, Features]], bodies: Sequence[str]) -> Floats:
    """(pieces, bodies) what names say."""
    return np.array([[weights()["name"] * mine.get(b, {}).get("name", 0.0) for b in bodies] for mine in votes])


def _one_name(evidence: Evidence) -> bool:
    """Whether names speak of one body alone, and call most of the machine so: nothing beside it can contradict them."""
    said = clearly_named(evidence.pieces, evidence.scores)
    most = sum(evidence.pieces[k].area for k in sorted(said)) > 0.5 * evidence.surface
    return most and len(said) > 1 and len(set(said.values())) == 1


def _grounded(body: str, votes: Mapping[str, Features], said: Mapping[str, float], trust: float) -> bool:
    """True where a piece's names or a person tell its body from every other, of other variants (`said` by the names)
    as well."""
    told = {b: weights()["name"] * trust * score for b, score in said.items() if b not in votes}
    told |= {b: weighed({n: f[n] for n in TELLING if n in f}, weights()) for b, f in votes.items()}
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
    """Solid → body, for those too small to be pieces whose names say clearly which of the bodies found they are of. A
    name that another body was judged to bear means something else here: levers may be a boom and an arm."""
    inside = {i for p in pieces for i in p.members}
    played = {j.body for j in judged.values()}
    mistaken = {
        observation.solids[i].part.name
        for i, what in judged.items()
        if scores[i] and max(scores[i].values()) - scores[i].get(what.body, 0.0) >= CLEARLY
    }
    found = {}
    for solid in observation.solids:
        said = {b: s for b, s in scores[solid.index].items() if b in played}
        if solid.index in inside or not said or trust < 1.0 or solid.part.name in mistaken:
            continue
        best, *others = sorted(said, key=lambda b: (-said[b], b))
        lead = 100.0 * (said[best] - (said[others[0]] if others else 0.0))
        if said[best] >= CLEARLY and lead >= CLEAR_LEAD and _is_beside(solid, best, judged, observation):
            words = f"{best} by its name alone, which says so with {said[best]:.2f}"
            found[solid.index] = Judged(best, lead, others[0] if others else None, words, True)
    return found


def _is_beside(solid: Solid, body: str, judged: Mapping[int, Judged], observation: Observation) -> bool:
    """Whether a solid is near something that was judged to be of a body: a lever in the cab is no link of a bucket."""
    own = [observation.solids[i] for i in sorted(judged) if judged[i].body == body]
    gaps = (float(np.linalg.norm(np.maximum(0, np.maximum(s.low - solid.high, solid.low - s.high)))) for s in own)
    return min(gaps, default=np.inf) <= BESIDE * observation.size


def _answer(
    observation: Observation, best: Best, judged: Mapping[int, Judged], answer: Answer, stance: Stance
) -> Answer:
    """The labelling as clusters, hinges and slides: one cluster a body."""
    kinds = {r.name: r.kind for r in best.template.roles if r.rigid}
    bodies: dict[str, list[int]] = {}
    for i, what in sorted(judged.items()):
        bodies.setdefault(what.body, []).append(i)
    structure, body_of = labelled_structure(observation.evidence[-1], bodies, kinds)
    solution = _solution(structure, body_of, best, stance)
    return Answer(
        answer.contact, structure, best.choices, best.template, solution, {}, (), frozenset(), dict(judged)
    )  # fmt: skip


def _solution(structure: Structure, body_of: Mapping[int, str], best: Best, stance: Stance) -> Solution:
    """The joints that exact axes are there for, in a direction that they may have: of several between two bodies the
    one that most pins run through."""
    linkage_of, _, tools = linkages_of(best.template)
    slewing = slewing_joints(best.template)

    def may_be(joint: JointTemplate, hinge: Hinge) -> bool:
        along, across, upright = np.abs(stance.rotation @ structure.axes[hinge.axis].direction)
        if joint.direction is not None and joint.type == "revolute":
            return bool({"lengthwise": along, "lateral": across, "vertical": upright}[joint.direction] > ALIKE)
        if joint.name in slewing:
            return bool(upright > ALIKE)
        level = linkage_of.get(joint.name) in tools
        return joint.name not in linkage_of or bool(across > ALIKE if level else across < NOT_ACROSS)

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
                if {body_of.get(h.a), body_of.get(h.b)} == pair and may_be(joint, h)
            ]
            hinge_of |= {joint.name: min(hinges)[1]} if hinges else {}
    missing = sum(1 for r in best.template.roles if r.rigid and not r.optional and r.name not in set(body_of.values()))
    score = round(best.score) - MISSING_WEIGHT * missing
    return Solution(dict(body_of), hinge_of, slide_of, score, round(best.score), True)
