"""Bodies that contacts did not find and names tell: a cylinder whose rod was not told is no reason to leave it to what
stands beside it. The machine that was found stays as it is; what is added is for a person to look at."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.assignment.directions import ALIKE, linkages_of
from yellowiron.alignment.assignment.machine_frame import MachineFrame
from yellowiron.alignment.assignment.sides import END, SIDE, twin_role
from yellowiron.alignment.assignment.weights import AS_GOOD
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.fusion.votes import CLEARLY
from yellowiron.alignment.structure.clusters import Cluster, Hinge, Structure
from yellowiron.alignment.structure.observation import Observation
from yellowiron.model.template import Template

WORDS = "that is what it is called: contacts do not show it"
CALLED = 0.4
"""Names of a missing body that speak of it so well call a part so: sizes and part numbers in a name thin it out."""
ASIDE = 0.01
"""What lies less than this share of the machine's size beside its middle is neither left nor right."""


def with_named(
    answer: Answer, observation: Observation, scores: Sequence[Mapping[str, float]], frame: MachineFrame | None
) -> tuple[Answer, dict[int, int], frozenset[str]]:
    """The answer with the bodies that it lacks and parts are clearly called, as far as one alone is meant; cluster →
    its number in that answer; and which bodies these are. Such parts are what most of a cluster of no body is, or are
    on no pin and were taken for parts of another body. `scores`: by solid, what its names say, that are to be believed;
    `frame`: where left and right are, which tells twins that are called alike."""
    structure, template = answer.structure, answer.template
    played = answer.solution.body_of
    missing = {r.name for r in template.roles if r.rigid and not r.many} - set(played.values())
    pinned = observation.evidence[-1].pinned if missing else {}
    groups: dict[str, list[int]] = {}
    astray: dict[str, set[int]] = {}
    for c, cluster in enumerate(structure.clusters if missing else ()):
        called = {
            i: body
            for i in sorted(cluster.members - structure.slight)
            if (body := _called(observation.solids[i], scores[i], missing, frame, observation.size)) is not None
        }
        area = {i: observation.solids[i].surface for i in cluster.members}
        half = 0.5 * sum(area[i] for i in sorted(area))
        for body in sorted(set(called.values())):
            own = [i for i in called if called[i] == body]
            most = sum(area[i] for i in own) > half
            if c not in played and most:
                groups.setdefault(body, []).append(c)
            elif c in played and not most and not cluster.kind:
                astray.setdefault(body, set()).update(i for i in own if not pinned.get(i))
    if not groups and not any(astray.values()):
        return answer, {c: c for c in range(len(structure.clusters))}, frozenset()
    first = {c: group[0] for group in groups.values() for c in group}
    kept = [c for c in range(len(structure.clusters)) if first.get(c, c) == c]
    number = {c: kept.index(first.get(c, c)) for c in range(len(structure.clusters))}
    named = {body: number[group[0]] for body, group in groups.items()}
    return (
        _renumbered(answer, number, named, {b: m for b, m in sorted(astray.items()) if m}),
        number,
        frozenset({*groups, *(body for body, members in astray.items() if members)}),
    )


def agreed(answer: Answer, observation: Observation, judged: Answer, wide: Observation) -> tuple[Answer, float, float]:
    """The contacts' `answer` without the bodies that the `judged` one says are others, the share on which both say the
    same of what both speak of, and how much of all that is drawn that is; left and right, front and rear taken as one:
    which is which a frame tells, and not the joints. `observation`, `wide`: what the answers are of."""
    told = {wide.solids[i].part.id: _plain(what.body) for i, what in (judged.judged or {}).items()}
    kept: dict[int, str] = {}
    alike = unlike = 0.0
    for c, body in answer.solution.body_of.items():
        solids = [observation.solids[i] for i in sorted(answer.structure.clusters[c].members)]
        same = sum(s.surface for s in solids if told.get(s.part.id) == _plain(body))
        other = sum(s.surface for s in solids if told.get(s.part.id, _plain(body)) != _plain(body))
        alike, unlike = alike + same, unlike + other
        if same >= other:
            kept[c] = body
    both, total = alike + unlike, sum(s.surface for s in wide.solids)
    return _only(answer, kept), alike / both if both else 0.0, both / total if total else 0.0


def without_misnamed(answer: Answer, observation: Observation, scores: Sequence[Mapping[str, float]]) -> Answer:
    """The answer without the bodies that hang on no more than half of their joints and of which most is clearly called
    one that it lacks: any piece on a pin or two is as good. `scores`: by solid, what its names say, that are to be
    believed."""
    found = {*answer.solution.hinge_of, *answer.solution.slide_of}
    played = {_plain(body) for body in answer.solution.body_of.values() if twin_role(body) is None}
    kept: dict[int, str] = {}
    for c, body in answer.solution.body_of.items():
        cluster = answer.structure.clusters[c]
        joints = [j.name for j in answer.template.joints if body in answer.template.bodies_of(j)]
        firm = cluster.kind or body == answer.template.root or 2 * len(found & {*joints}) > len(joints)
        solids = [observation.solids[i] for i in sorted(cluster.members)] if not firm else []
        other = sum(s.surface for s in solids if _speaks_of_others(scores[s.index], {_plain(body), *played}))
        if other <= 0.5 * sum(s.surface for s in solids):
            kept[c] = body
    return _only(answer, kept) if len(kept) < len(answer.solution.body_of) else answer


def _speaks_of_others(said: Mapping[str, float], bodies: Collection[str]) -> bool:
    best = max(said.values(), default=0.0)
    return best >= CLEARLY and all(_plain(b) not in bodies for b, score in said.items() if score > best - AS_GOOD)


def _only(answer: Answer, kept: Mapping[int, str]) -> Answer:
    """The answer with these bodies alone (cluster → body), and the joints between them."""
    bodies, template, solution = set(kept.values()), answer.template, answer.solution
    there = {j.name for j in template.joints if set(template.bodies_of(j)) <= bodies}
    solution = replace(
        solution,
        body_of=dict(kept),
        hinge_of={j: k for j, k in solution.hinge_of.items() if j in there},
        slide_of={j: k for j, k in solution.slide_of.items() if j in there},
    )
    return replace(answer, solution=solution)


def _plain(body: str) -> str:
    return SIDE.sub("", END.sub("", body))


def _called(
    solid: Solid, said: Mapping[str, float], missing: set[str], frame: MachineFrame | None, size: float
) -> str | None:
    """The one missing body that a part is called. Of twins called alike, the one whose side it is on; of wheels all
    called alike, the one that is missing there."""
    best = max(said.values(), default=0.0)
    meant = {b for b, score in said.items() if score > best - AS_GOOD} if best >= CALLED else set()
    if len({_plain(b) for b in meant}) != 1:
        return None
    left = [b for b in sorted(meant & missing) if len(meant) == 1 or _on_side(solid, b, frame, size)]
    return left[0] if len(left) == 1 else None


def _on_side(solid: Solid, body: str, frame: MachineFrame | None, size: float) -> bool:
    """Whether a solid lies on the side of the machine that a left or right body is on."""
    if frame is None or frame.doubts:
        return False
    left = float((frame.matrix @ np.append(0.5 * (solid.low + solid.high), 1.0))[1])
    return left > ASIDE * size if body.endswith("_l") else left < -ASIDE * size


def _renumbered(
    answer: Answer, number: Mapping[int, int], named: Mapping[str, int], astray: Mapping[str, set[int]]
) -> Answer:
    """The answer over clusters of which some are joined (`number`: cluster → its new one), some of them bodies by their
    names (`named`), to which parts go that are `astray` in others, with the joints that these are found to have."""
    old, solution = answer.structure, answer.solution
    members: dict[int, list[Cluster]] = {}
    for c, cluster in enumerate(old.clusters):
        members.setdefault(number[c], []).append(cluster)
    clusters = [
        group[0] if len(group) == 1 else Cluster(frozenset().union(*(g.members for g in group)))
        for _, group in sorted(members.items())
    ]
    moved = frozenset().union(*astray.values())
    clusters = [replace(c, members=c.members - moved) for c in clusters]
    bodies = {c: body for body, c in named.items()}
    for body, own in astray.items():
        at_home = named.get(body, len(clusters))
        bodies[at_home] = body
        if at_home == len(clusters):
            clusters.append(Cluster(frozenset(own)))
        else:
            clusters[at_home] = replace(clusters[at_home], members=clusters[at_home].members | own)
    hinges: dict[tuple[int, int, int], set[int]] = {}
    for hinge in old.hinges:
        a, b = sorted((number[hinge.a], number[hinge.b]))
        if a != b:
            hinges.setdefault((a, b, hinge.axis), set()).update(hinge.pins)
    keys = list(hinges)
    slides = [(number[a], number[b], k) for a, b, k in old.slides]
    structure = replace(
        old,
        clusters=tuple(clusters),
        hinges=tuple(Hinge(a, b, axis, tuple(sorted(hinges[a, b, axis]))) for a, b, axis in keys),
        slides=tuple(s for s in slides if s[0] != s[1]),
    )
    at = [(*sorted((number[h.a], number[h.b])), h.axis) for h in old.hinges]
    hinge_of = {joint: keys.index(at[k]) for joint, k in solution.hinge_of.items()}  # type: ignore[arg-type]
    slide_of = {joint: structure.slides.index(slides[k]) for joint, k in solution.slide_of.items()}
    body_of = {number[c]: body for c, body in solution.body_of.items()} | bodies
    hinge_of |= _joints_of(structure, answer.template, body_of, hinge_of)
    return replace(
        answer, structure=structure, solution=replace(solution, body_of=body_of, hinge_of=hinge_of, slide_of=slide_of),
        unary={(number[c], body): weight for (c, body), weight in answer.unary.items()},
        barred=frozenset((joint, keys.index(at[k])) for joint, k in answer.barred if at[k] in hinges),  # type: ignore[arg-type]
    )  # fmt: skip


def _joints_of(
    structure: Structure, template: Template, body_of: Mapping[int, str], known: Mapping[str, int]
) -> dict[str, int]:
    """Joint → hinge, for those that were not found whose bodies are there: that with the most pins, as the others of
    its linkage lie."""
    linkage_of, _, _ = linkages_of(template)
    lies = {linkage_of[j]: structure.hinges[k].axis for j, k in sorted(known.items()) if j in linkage_of}
    found: dict[str, int] = {}
    for joint in template.joints:
        pair = set(template.bodies_of(joint))
        if joint.type != "revolute" or joint.name in known:
            continue
        beside = lies.get(linkage_of.get(joint.name, -1))
        fits = [
            (-len(h.pins), k)
            for k, h in enumerate(structure.hinges)
            if {body_of.get(h.a), body_of.get(h.b)} == pair and k not in known.values() and k not in found.values()
            and (beside is None or _parallel(structure, h.axis, beside))
        ]  # fmt: skip
        if fits:
            found[joint.name] = min(fits)[1]
    return found


def _parallel(structure: Structure, one: int, other: int) -> bool:
    first, second = (np.asarray(structure.axes[k].direction) for k in (one, other))
    return abs(float(first @ second)) > ALIKE
