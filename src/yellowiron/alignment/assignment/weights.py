"""What speaks for a cluster being a body besides its joints: names, a person's word, and the side it is on.

A found joint counts `solve.JOINT_WEIGHT`; everything here counts less, save a person's word.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence

import numpy as np

from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.alignment.assignment.machine_frame import MachineFrame
from yellowiron.alignment.assignment.sides import END, SIDE, twin_role
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template

Weights = dict[tuple[int, str], int]
"""(cluster, body) → weight."""
NAME_WEIGHT = 40
EXACT_WEIGHT = 70
EDIT_WEIGHT = 250
MOSTLY = 0.5
"""More than this share of a cluster's surface speaks for all of it, where a person speaks."""
CRUMB = 0.25
"""What has less than this share of a body's usual surface is not what that body mainly is."""
SIDE_WEIGHT = 80
SIZE_WEIGHT = 12
LONGER = 1.3
"""Of two cylinders that hang alike, one that usually is so many times longer than the other is told by it."""
CROSSED = 0.2
"""The cosine by which two cylinders are more nearly mirror images than either is of a third, where that tells them: the
cylinder that tilts a blade lies across between those that angle it."""
AS_GOOD = 0.1
"""Bodies that a name speaks of this nearly as much as of the one it speaks of most are meant as well."""
TRUSTING = 6
"""So many parts must contradict their names as clearly as if so many more agreed: names are mostly right."""
_ORDER = ("front", "middle", "rear")
"""The words of `END` as they stand behind each other."""


def name_weights(
    solids: tuple[Solid, ...],
    structure: Structure,
    template: Template,
    scores: list[dict[str, float]],
    edited: Mapping[str, str],
) -> Weights:
    """Weights from what the parts are called (`scores`, by solid) and from what a person said (part id → role)."""
    unary: Weights = {}
    bodies = {r.name for r in template.roles if r.rigid}
    total = sum(s.surface for s in solids) or 1.0
    for c, cluster in enumerate(structure.clusters):
        members = sorted(cluster.members)
        telling = [i for i in members if scores[i]]
        votes: dict[str, float] = {}
        for i in telling:
            for body, score in scores[i].items():
                votes[body] = votes.get(body, 0.0) + score / len(telling)
        for body in sorted(votes):
            if body in bodies:
                exact = votes[body] > 1
                unary[c, body] = round(EXACT_WEIGHT if exact else NAME_WEIGHT * votes[body])
        for body, share in decided_shares(solids, members, template, edited).items():
            said = EDIT_WEIGHT * (1.0 if share > MOSTLY else share)
            main = _mainly(body, sum(solids[i].surface for i in members) / total, template)
            unary[c, body] = unary.get((c, body), 0) + round(said * main)
            # A crumb of a body is no other body, and leaves what the body mainly is to a larger cluster.
            for other in sorted(bodies - {body}) if main < 1.0 and share > MOSTLY else ():
                unary[c, other] = unary.get((c, other), 0) - round(said * (1.0 - main))
    return unary


def _mainly(body: str, share: float, template: Template) -> float:
    """How far a cluster with this share of the machine's surface can be what a body mainly is, 0 to 1."""
    usual = template.usual.get(body)
    return min(1.0, share / (CRUMB * usual.area)) if usual is not None and usual.area > 0.0 else 1.0


def decided_shares(
    solids: tuple[Solid, ...], members: Collection[int], template: Template, edited: Mapping[str, str]
) -> dict[str, float]:
    """Body → the share of a cluster's surface that a person said is of it. A part that is put elsewhere takes the rest
    of its cluster along only if it is most of it."""
    known = {r.name for r in template.roles}
    total = sum(solids[i].surface for i in sorted(members)) or 1.0
    found: dict[str, float] = {}
    for i in sorted(members):
        role = edited.get(solids[i].part.id)
        body = template.body_of(role) if role in known and role is not None else None
        if body is not None:
            found[body] = found.get(body, 0.0) + solids[i].surface / total
    return found


def name_agreement(structure: Structure, solution: Solution, scores: list[dict[str, float]]) -> float:
    """How far the names of a machine are to be believed, 0 to 1: Cohen's kappa of what the parts are called and what
    the joints make of them, their agreement beyond that of names dealt out at random (Cohen 1960)."""
    pairs: list[tuple[frozenset[str], str]] = []
    for c, body in sorted(solution.body_of.items()):
        for i in sorted(structure.clusters[c].members):
            if scores[i]:
                best = max(scores[i].values())
                pairs.append((frozenset(b for b, s in scores[i].items() if s >= best - AS_GOOD), body))
    if not pairs:
        return 1.0
    share = {body: 1 / len(pairs) * sum(1 for _, b in pairs if b == body) for _, body in pairs}
    agreed = sum(body in said for said, body in pairs) / len(pairs)
    chance = sum(share.get(b, 0.0) for said, _ in pairs for b in said) / len(pairs)
    kappa = (agreed - chance) / (1 - chance) if chance < 1 else 1.0
    return max(0.0, (len(pairs) * kappa + TRUSTING) / (len(pairs) + TRUSTING))


def size_weights(solids: tuple[Solid, ...], structure: Structure, template: Template) -> Weights:
    """Weights for the machine's frames, which are its largest things, and for the tool, which is larger than links.
    Of what nothing hinges on, size alone says nothing."""
    linked = {c for h in structure.hinges for c in (h.a, h.b)}
    sizes = [sum(float(solids[i].shape.area) for i in sorted(c.members)) for c in structure.clusters]
    ranked = sorted(sizes)
    frames = [r.name for r in template.roles if r.rigid and r.kind == "frame"]
    tools = {template.body_of(r.name) for r in template.roles if r.kind == "edge"} - {None, *frames}
    largest = ranked[-1] if ranked else 0.0
    others = ranked[-1 - len(frames)] if len(ranked) > len(frames) else 0.0
    found: Weights = {}
    for c, size in enumerate(sizes):
        if structure.clusters[c].kind or largest <= 0.0 or c not in linked:
            continue
        for name in frames:
            found[c, name] = round(SIZE_WEIGHT * size / largest)
        for tool in sorted(str(t) for t in tools):
            found[c, tool] = round(0.5 * SIZE_WEIGHT * min(1.0, size / others)) if others > 0.0 else 0
    return found


def interchangeable(
    template: Template, *, joints: bool = True, found: Collection[str] | None = None
) -> list[frozenset[str]]:
    """Groups of bodies whose names differ in front, middle, rear, left, right alone and which the joints do not tell
    apart: a machine's four wheels on one chassis, and what steers two axles alike. Only where they stand tells which is
    which. Without `joints`, whatever they hang on: where a person said what is ahead, that tells as much. `found`: the
    names of the joints that tell anything; all, if it is not given."""
    rigid = [r.name for r in template.roles if r.rigid]
    plain = {name: SIDE.sub("", END.sub("", name)) for name in rigid}
    joined: dict[str, list[tuple[str, str]]] = {name: [] for name in rigid}
    for joint in template.joints:
        a, b = template.bodies_of(joint)
        if a in joined and b in joined and (found is None or joint.name in found):
            joined[a].append((joint.type, b))
            joined[b].append((joint.type, a))
    # Bodies that are joined alike to bodies that are joined alike, and so on.
    alike = dict(plain)
    kinds = 0
    while joints and len(set(alike.values())) > kinds:
        kinds = len(set(alike.values()))
        beside = {n: sorted((kind, END.sub("", b), alike[b]) for kind, b in joined[n]) for n in rigid}
        held = {name: (alike[name], tuple(beside[name])) for name in rigid}
        numbers = {key: number for number, key in enumerate(dict.fromkeys(held.values()))}
        alike = {name: f"{numbers[held[name]]:06d}" for name in rigid}
    groups: dict[tuple[str, str], set[str]] = {}
    for name in rigid:
        if END.search(name):
            groups.setdefault((plain[name], alike[name] if joints else ""), set()).add(name)
    return [frozenset(g) for g in groups.values() if len({END.findall(name)[0] for name in g}) > 1]


def ends_untold(template: Template, solution: Solution, unary: Weights) -> bool:
    """Whether a machine without arms is built alike in front and at the rear, and what is known of its bodies besides
    their joints (`unary`) tells hardly better which is which: then either end may be the front."""
    pairs = [sorted(names) for names in interchangeable(template) if len(names) == 2]
    other = {a: b for pair in pairs for a, b in (pair, pair[::-1])}
    ended = {b for b in solution.body_of.values() if END.search(b) and b != template.root}
    if not ended or not ended <= other.keys() or any(r.kind == "arm" and r.rigid for r in template.roles):
        return False
    told = sum(
        unary.get((c, b), 0) - unary.get((c, other[b]), 0) for c, b in sorted(solution.body_of.items()) if b in other
    )
    return told < NAME_WEIGHT


def between_twins(template: Template) -> list[tuple[str, str, str]]:
    """Barrels, and rods, of three cylinders between the same two bodies, (left, middle, right), of which two are twins:
    a boom's lift cylinders and the one that levels its forks. Only where they stand tells which is which."""
    found = []
    for names in _hung_alike(template):
        left = [name for name in names if SIDE.findall(name) == ["l"] and twin_role(name) in names]
        middle = [name for name in names if twin_role(name) is None]
        if len(names) == 3 and len(left) == len(middle) == 1:
            found.append((left[0], middle[0], str(twin_role(left[0]))))
    return found


def told_by_length(template: Template) -> list[tuple[str, str]]:
    """Barrels, and rods, of two cylinders between the same two bodies of which one usually is clearly longer, that one
    first; and links between the same two bodies, no two of which are each other's twins."""
    usual, found = template.usual, []
    alike = [names for names in _hung_alike(template) if all(twin_role(name) is None for name in names)]
    for names in (*alike, *_linked_alike(template)):
        if len(names) == 2 and all(name in usual for name in names):
            short, long = sorted(names, key=lambda name: usual[name].length)
            if usual[long].length > LONGER * usual[short].length:
                found.append((long, short))
    return found


def _linked_alike(template: Template) -> list[list[str]]:
    """Links that hang on the same two bodies and on nothing else, on one side, whatever their joints: a push arm's yoke
    and its brace."""
    kinds, beside = {r.name: r.kind for r in template.roles if r.rigid}, dict[str, list[str]]()
    for joint in template.joints:
        a, b = template.bodies_of(joint)
        if a in kinds and b in kinds:
            beside.setdefault(str(a), []).append(str(b))
            beside.setdefault(str(b), []).append(str(a))
    held: dict[frozenset[str], list[str]] = {}
    for name, others in sorted(beside.items()):
        if not kinds[name] and len(others) == len(set(others)) == 2 and not END.search(name):
            held.setdefault(frozenset(others), []).append(name)
    return [names for names in held.values() if not {twin_role(name) for name in names} & set(names)]


def _hung_alike(template: Template) -> list[list[str]]:
    """Barrels, and rods, of the cylinders between the same two bodies."""
    kinds, ends = {r.name: r.kind for r in template.roles if r.rigid}, dict[str, set[str]]()
    for joint in template.joints:
        a, b = template.bodies_of(joint)
        if joint.type in ("revolute", "spherical") and a is not None and b is not None:
            for own, other in ((a, b), (b, a)):
                ends.setdefault(own, set()).add(other)
    held: dict[tuple[str, frozenset[str], frozenset[str]], list[str]] = {}
    for joint in template.joints:
        halves = template.bodies_of(joint)
        if joint.type == "prismatic" and {kinds.get(b or "") for b in halves} == {"barrel", "rod"}:
            pair = sorted((str(b) for b in halves), key=lambda b: kinds[b])
            hung, held_by = (frozenset(ends.get(half, ())) for half in pair)
            for half in pair:
                held.setdefault((kinds[half], hung, held_by), []).append(half)
    return list(held.values())


def _ranks_of_trio(found: Sequence[tuple[Floats, Floats]]) -> list[float]:
    """The ranks of cylinders (their places and directions), of which two are each other's mirror image: from left to
    right, the one that is no twin in the middle. Where all three lie alike, it is the one between the others."""
    across = [-float(place[1]) for place, _ in found]
    if len(found) != 3:
        return across
    flip = np.array([1.0, -1.0, 1.0])
    alike = {k: abs(float(found[k - 2][1] @ (flip * found[k - 1][1]))) for k in range(3)}
    best, second = sorted(alike, key=lambda k: -alike[k])[:2]
    if alike[best] - alike[second] > CROSSED:
        others = [across[k] for k in range(3) if k != best]
        across[best] = 0.5 * (others[0] + others[1])
    return across


def _told(sided: Weights, names: Sequence[str], cluster_of: Mapping[str, int], rank: Callable[[int], float]) -> None:
    """Weights that give clusters, by their rank, the names in their order."""
    there = sorted((cluster_of[name] for name in names if name in cluster_of), key=rank)
    for cluster, fits in zip(there, names, strict=True) if len(there) == len(names) else ():
        for name in names:
            sided[cluster, name] = sided.get((cluster, name), 0) + (SIDE_WEIGHT if name == fits else -SIDE_WEIGHT)


def side_weights(
    solids: tuple[Solid, ...],
    structure: Structure,
    template: Template,
    solution: Solution,
    frame: MachineFrame,
    unary: Weights,
) -> Weights:
    """Weights that put the left one of each mirrored pair on +Y, and the front one of each pair that the joints do not
    tell apart on +X: of each pair, where a person said what is ahead."""
    sided = dict(unary)
    cluster_of = {b: c for c, b in solution.body_of.items()}

    def place(cluster: int) -> Floats:
        members = [solids[i] for i in sorted(structure.clusters[cluster].members)]
        middle = np.mean([0.5 * (s.low + s.high) for s in members], axis=0)
        return np.asarray(frame.matrix[:3, :3] @ middle + frame.matrix[:3, 3], dtype=np.float64)

    ends = interchangeable(template, joints=not frame.told)
    if not frame.told and any(r.kind == "arm" and r.rigid for r in template.roles):
        # What was not found (a levelling cylinder at one of two axles) tells nothing apart; the arms are ahead.
        ends += interchangeable(template, found={*solution.hinge_of, *solution.slide_of})
    alike = {names | {twin_role(name) or name for name in names} for names in ends}
    for names in sorted(alike, key=sorted):
        there = {name: place(cluster_of[name]) for name in names if name in cluster_of}
        middle = np.mean(list(there.values()), axis=0) if there else np.zeros(3)
        foremost = min((END.findall(name)[0] for name in names), key=_ORDER.index)
        for found, at in there.items():
            ahead, leftward = (bool(at[axis] > middle[axis]) for axis in (0, 1))
            for name in names:
                ends, sides = END.findall(name), SIDE.findall(name)
                fits = (ends[0] == foremost) == ahead and (not sides or (sides[0] == "l") == leftward)
                where = (cluster_of[found], name)
                sided[where] = sided.get(where, 0) + (SIDE_WEIGHT if fits else -SIDE_WEIGHT)

    def long(cluster: int) -> float:
        members = [solids[i] for i in sorted(structure.clusters[cluster].members)]
        return float(
            np.linalg.norm(np.max([s.high for s in members], axis=0) - np.min([s.low for s in members], axis=0))
        )

    def along(cluster: int) -> Floats:
        corners = np.concatenate([solids[i].points for i in sorted(structure.clusters[cluster].members)])
        way = np.linalg.svd(corners - corners.mean(axis=0), full_matrices=False)[2][0]
        return np.asarray(frame.matrix[:3, :3] @ way, dtype=np.float64)

    between = between_twins(template)
    for trio in between:
        three = [cluster_of[name] for name in trio if name in cluster_of]
        ranks = _ranks_of_trio([(place(c), along(c)) for c in three])
        _told(sided, trio, cluster_of, dict(zip(three, ranks, strict=True)).__getitem__)
    for pair in told_by_length(template):
        _told(sided, pair, cluster_of, lambda cluster: -long(cluster))

    for name in sorted(cluster_of.keys() - frozenset().union(*alike, *between)):
        match = SIDE.search(name)
        twin = twin_role(name)
        if match is None or twin is None or not any(r.name == twin for r in template.roles):
            continue
        own = cluster_of[name]
        other = cluster_of.get(twin)
        is_left = float(place(own)[1] - (place(other)[1] if other is not None else 0.0)) > 0
        left, right = (name, twin) if match.group(1) == "l" else (twin, name)
        key = (own, left if is_left else right)
        sided[key] = sided.get(key, 0) + SIDE_WEIGHT
        wrong = (own, right if is_left else left)
        sided[wrong] = sided.get(wrong, 0) - SIDE_WEIGHT
    return sided
