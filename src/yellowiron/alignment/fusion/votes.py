"""What speaks for a piece being a body: its names, what the contacts alone made of it, its shape."""

from __future__ import annotations

import functools
from collections.abc import Callable, Collection, Mapping, Sequence
from itertools import combinations

import networkx
import numpy as np

from yellowiron.alignment.assignment.answer import Answer, held_share
from yellowiron.alignment.assignment.sides import twin_role
from yellowiron.alignment.fusion.pieces import Piece
from yellowiron.alignment.fusion.stance import Stance
from yellowiron.model.template import Template
from yellowiron.model.usual import Usual
from yellowiron.support.caching.remembered import remembered
from yellowiron.support.vectors import triple

Features = Mapping[str, float]
"""What speaks for something, by name; what each counts is in `weights`."""
Votes = list[dict[str, Features]]
"""By piece: body → what speaks for and against it. A body that is absent cannot be the piece's."""
CLEARLY = 0.6
"""From here on a name speaks of a body and not of something beside it."""
BARS = ("barrel", "rod")
BULKY = 0.02
"""A piece of more than this share of the machine's surface that is no bar is no half of a cylinder."""
SIDEWAYS = 0.5
"""A bar that lies across the machine is a pin or an axle, no hydraulic cylinder (cosine to the left), …"""
ROOM = 0.4
"""… and hardly half of one that is usually no wider across than this share of its length."""
FARTHEST = 25.0
"""No more than so many squared deviations of a point count."""
MOST = 7.0
"""Nor so many nats of a piece: strangers draw machines as we did not."""
NINETY = 3.29
"""A box of 90 % is so many standard deviations wide."""
PLACE, LENGTH, AREA = np.array([0.03, 0.02, 0.03]), 0.35, 0.8
"""Deviations of strangers' bodies from those of the machines that were measured: forward, left and up in machine sizes;
of the logarithms of length and area."""
ROUND_AREA = 0.3
"""Deviation of the logarithm of a wheel's surface, against that of the machine's other wheels."""
FURTHER = np.array([0.02, 0.004, 0.02])
"""How much further a body may be with every joint between it and the root: arms are drawn in any pose. In 20 machines
of strangers the middles of 130 bodies were 0.05, 0.06, 0.08, 0.11 sizes off (root mean square, forward and up) with 1,
2, 3, 4 joints, and 0.015 to 0.03 sideways."""
LENT = 0.85
"""What a name counts for a body next to the one it names, where nothing bears the neighbour's own name."""


def votes_of(
    pieces: Sequence[Piece],
    template: Template,
    scores: Sequence[Mapping[str, float]],
    trust: Sequence[float],
    answer: Answer,
    stance: Stance,
    edited: Mapping[int, str],
    total: float,
) -> Votes:
    """What speaks for every body a piece could be. `scores`: by solid, what its names say; `trust` in them, by piece,
    0 to 1; `answer`: what the contacts alone gave; `stance`: how the machine stands; `edited`: solid → the body that a
    person gave it; `total`: the machine's surface, m²."""
    kinds = {r.name: "drum" if r.drum else r.kind for r in template.roles if r.rigid}
    largest = max((p.area for p in pieces), default=1.0)
    solved = _solved(answer)
    apart = joints_apart(template)
    saids = borrowed([named(piece, scores) for piece in pieces], template)
    odd = odd_wheels([p.area for p in pieces if p.kind == "wheel"], template)
    anywhere = _anywhere(tuple(template.usual.values())) if template.usual else None
    areas: dict[str, float] = {}
    for piece in pieces:
        for body in {b for i in piece.members for b in solved.get(i, ())}:
            areas[body] = areas.get(body, 0.0) + piece.area
    twins = {body: twin_role(body) or body for body in kinds}
    depths = {body: apart.get((template.root, body), 0) for body in kinds}
    votes: Votes = []
    for piece, said, worth in zip(pieces, saids, trust, strict=True):
        mine: dict[str, Features] = {}
        told = {edited[i] for i in piece.members if i in edited}
        meant = {kinds[b] for b, score in said.items() if score > 0.0 and b in kinds}
        shapes = {
            (kind, named_so): _shape(piece, kind, named_so, total, largest, stance)
            for kind in {*kinds.values()}
            for named_so in (False, True)
        }
        # Contacts see two sides, but not which is the left: where a piece lies, and its names, tell that. All of a
        # cluster is one guess of theirs, and counts once.
        contacts: dict[str, float] = {}
        for i in piece.members & solved.keys():
            for body, share in solved[i].items():
                contacts[body] = max(contacts.get(body, 0.0), share * piece.area / areas[body])
        for body, kind in kinds.items():
            name = said.get(body, 0.0)
            shape = shapes[kind, name > 0 or body in told]
            if shape is None:
                continue
            usual = template.usual.get(body, anywhere)
            lies_across = piece.slender and kind in BARS and piece.kind not in BARS and _across(piece, stance)
            if lies_across and not name and body not in told and usual is not None and not _has_room(usual):
                shape = {"no bar": 1.0, "crosswise": 1.0}
            if meant and meant <= set(BARS) and kind not in BARS and not told:
                # Its names speak of hydraulic cylinders alone, if not of which.
                shape = {**shape, "unlike": max(worth * max(said.values()), shape.get("unlike", 0.0))}
            contact = max(contacts.get(body, 0.0), contacts.get(twins[body], 0.0))
            found = {"name": worth * name, "contacts": contact, "said": float(body in told), **shape}
            if usual is not None:
                found |= _unusual(stance, piece, usual, stance.drawn * piece.area / total, depths[body])
            if kind == piece.kind == "wheel" and body in odd:
                found["odd"] = odd[body](piece.area)
            mine[body] = {key: value for key, value in found.items() if value}
        votes.append(mine)
    return votes


def odd_wheels(areas: Sequence[float], template: Template) -> dict[str, Callable[[float], float]]:
    """By wheel of the template: what speaks against it for one of these surfaces (m²), in nats. Against all of a
    machine's wheels, those in front are small on one type, and those behind are twins on another."""
    usual = {r.name: np.log(template.usual[r.name].area) for r in template.roles
             if r.kind == "wheel" and not r.drum and r.name in template.usual}  # fmt: skip
    if not usual or not areas:
        return {}
    scale = float(np.mean(np.log(areas)) - np.mean([*usual.values()]))

    def against(own: float) -> Callable[[float], float]:
        return lambda area: min(0.5 * ((float(np.log(area)) - own - scale) / ROUND_AREA) ** 2, MOST)

    return {name: against(float(own)) for name, own in usual.items()}


def named(piece: Piece, scores: Sequence[Mapping[str, float]]) -> dict[str, float]:
    """Body → how clearly the names of a piece's solids speak of it, the mean over those that say anything."""
    telling = [scores[i] for i in sorted(piece.members) if scores[i]]
    found: dict[str, float] = {}
    for said in telling:
        for body, score in said.items():
            found[body] = found.get(body, 0.0) + score / len(telling)
    return found


def clearly_named(pieces: Sequence[Piece], scores: Sequence[Mapping[str, float]]) -> dict[int, str]:
    """Piece → the body that its names speak of, where they do so clearly."""
    said: dict[int, str] = {}
    for k, piece in enumerate(pieces):
        found = named(piece, scores)
        if found and max(found.values()) >= CLEARLY:
            said[k] = max(sorted(found), key=lambda b: found[b])
    return said


def borrowed(saids: list[dict[str, float]], template: Template) -> list[dict[str, float]]:
    """What names say, where a body that no name speaks of clearly borrows those of a neighbour of its kind: of two arms
    both called arm, one is the boom; a cylinder is as often called after the arm it stands on as after the one it
    moves; where no name tells barrels, what is called a piston may be all of a cylinder; and the left one may be the
    right one."""
    spoken = {body for said in saids for body, score in said.items() if score >= CLEARLY}
    lent = {own: {(other, LENT) for other in others} for own, others in _lent_by_cylinders(spoken, template).items()}
    for own, others in _lent_by_arms(spoken, template).items():
        lent.setdefault(own, set()).update(others)
    kinds = {r.name: r.kind for r in template.roles}
    told = {kinds[body] for said in saids for body in said if body in kinds}
    for own, half in _rods(template).items():
        if "barrel" not in told:
            lent.setdefault(own, set()).add((half, LENT))
    # Which side is the left is as often said from before the machine as from its seat.
    for own in (b for b in kinds if twin_role(b) in kinds):
        lent.setdefault(own, set()).add((str(twin_role(own)), LENT))
    return [
        said
        | {
            own: max(said.get(own, 0.0), *(part * said.get(other, 0.0) for other, part in sorted(others)))
            for own, others in lent.items()
            if said.keys() & {own, *(other for other, _ in others)}
        }
        for said in saids
    ]


def _lent_by_arms(spoken: Collection[str], template: Template) -> dict[str, set[tuple[str, float]]]:
    """Arm that no name speaks of → those of the nearest arms that some do, and what they count for it: less by `LENT`
    for each joint between them. Links on one rod are as near as if they were joined."""
    arms = {r.name for r in template.roles if r.rigid and r.kind == "arm"}
    rods = {r.name for r in template.roles if r.rigid and r.kind == "rod"}
    joined = networkx.Graph([ends for j in template.joints if set(ends := template.bodies_of(j)) <= arms | rods])
    shared = (pair for rod in sorted(rods & set(joined)) for pair in combinations(sorted(set(joined[rod]) & arms), 2))
    graph = networkx.Graph(joined.subgraph(arms))
    graph.add_edges_from(shared)
    lent = {}
    for own in sorted(arms & set(graph) - set(spoken)):
        reached = networkx.single_source_shortest_path_length(graph, own)
        far = {other: n for other, n in reached.items() if other in spoken}
        if far:
            lent[own] = {(other, LENT**n) for other, n in far.items() if n == min(far.values())}
    return lent


def _lent_by_cylinders(spoken: Collection[str], template: Template) -> dict[str, set[str]]:
    """Half of a hydraulic cylinder that no name speaks of → those that do of the arm it stands on."""
    lent: dict[str, set[str]] = {}
    inner = _cylinders_before(template)
    for own in (b for b in sorted(inner) if b not in spoken):
        # What is lent is missed by its owner, who may have to borrow in turn.
        owing: str | None = own
        while owing is not None and inner.get(owing, frozenset()) & set(spoken) and owing not in lent:
            lent[owing] = set(inner[owing] & set(spoken))
            owing = min(lent[owing])
    return lent


def _rods(template: Template) -> dict[str, str]:
    """Barrel → its rod."""
    pairs = [tuple(map(str, template.bodies_of(j))) for j in template.joints if j.type == "prismatic"]
    kinds = {r.name: r.kind for r in template.roles}
    return {
        own: rod for a, b in pairs for own, rod in ((a, b), (b, a)) if (kinds[own], kinds[rod]) == ("barrel", "rod")
    }


def _cylinders_before(template: Template) -> dict[str, frozenset[str]]:
    """Barrel or rod → those of the cylinders that move the body which its own cylinder stands on: an arm."""
    apart, arms = joints_apart(template), {r.name for r in template.roles if r.kind == "arm"}
    ends: dict[tuple[str, str], list[str]] = {}
    for one in (c for a in template.actuators for c in a.cylinders):
        joints = {j.name: j for j in template.joints}
        if not one.pins or not {*one.joints} <= joints.keys():
            continue
        halves = [str(b) for b in template.bodies_of(joints[one.slide])]
        around = [str(b) for n in one.pins for b in template.bodies_of(joints[n])]
        around = sorted((b for b in around if b not in halves), key=lambda b: apart.get((template.root, b), 0))
        ends[halves[0], halves[1]] = around
    found: dict[str, frozenset[str]] = {}
    for own, around in ends.items():
        before = [other for other, theirs in ends.items() if other != own and theirs[-1] == around[0] in arms]
        for k, half in enumerate(own):
            if before:
                found[half] = frozenset(other[k] for other in before)
    return found


@remembered
def joints_apart(template: Template) -> Mapping[tuple[str, str], int]:
    """(body, body) → how many joints lead from one to the other; pairs that none lead between are left out."""
    graph = networkx.Graph([template.bodies_of(j) for j in template.joints])
    reached = networkx.all_pairs_shortest_path_length(graph)
    return {(str(a), str(b)): n for a, ends in reached for b, n in ends.items()}


def _solved(answer: Answer) -> dict[int, dict[str, float]]:
    """Solid → the body that the contacts gave it, and the share of that body's joints that they found, squared: one
    joint of three is nothing, all are nearly certain where most of the machine's are found."""
    solution, template = answer.solution, answer.template
    whole = held_share(answer) ** 2
    found: dict[int, dict[str, float]] = {}
    for c, body in sorted(solution.body_of.items()):
        joints = [j.name for j in template.joints if body in template.bodies_of(j)]
        held = sum(j in solution.hinge_of or j in solution.slide_of for j in joints)
        share = held / len(joints) if joints else 0.0
        for i in answer.structure.clusters[c].members:
            found[i] = {body: whole * share * share}
    return found


@functools.cache
def _anywhere(known: tuple[Usual, ...]) -> Usual:
    """Where a body may be of which nobody has measured where it usually is: where any other of its type is, as long and
    as large as the machine. If its place cost nothing, it would fit every piece best."""
    low, high = np.min([u.low for u in known], axis=0), np.max([u.high for u in known], axis=0)
    return Usual(triple(low), triple(high), 1.0, 1.0)


@remembered
def _unusual(stance: Stance, piece: Piece, usual: Usual, share: float, depth: int) -> Features:
    """What speaks against a piece being of a body, in nats: how far its surface is from where the body usually is, and
    how much longer and larger it is than the whole body usually is."""
    low, high = np.array(usual.low), np.array(usual.high)
    spread = np.hypot((high - low) / NINETY, PLACE + FURTHER * depth)
    off = (stance.place(piece.samples) - 0.5 * (low + high)) / spread
    # Surprise of a normal distribution; far is far.
    place = 0.5 * float(np.mean(np.minimum((off * off).sum(axis=1), FARTHEST))) + float(np.log(10 * spread).sum())
    longer = 0.5 * (max(0.0, float(np.log(piece.spread[0] / stance.size / usual.length))) / LENGTH) ** 2
    larger = 0.5 * (max(0.0, float(np.log(share / usual.area))) / AREA) ** 2
    return {"place": min(place, MOST), "longer": min(longer, MOST), "larger": min(larger, MOST)}


def _across(piece: Piece, stance: Stance) -> bool:
    """Whether a piece lies across the machine."""
    return abs(float(piece.axes[0] @ stance.left)) >= SIDEWAYS


def _has_room(usual: Usual) -> bool:
    """Whether a body is ever wide enough across the machine to lie so."""
    return usual.high[1] - usual.low[1] >= ROOM * usual.length


def _shape(
    piece: Piece, kind: str, named_so: bool, total: float, largest: float, stance: Stance
) -> dict[str, float] | None:
    """What a piece's shape says for a body of a kind; None where it cannot be one."""
    share = piece.area / total
    if {kind, piece.kind} & {"wheel", "drum"}:
        if kind == piece.kind:
            return {"seen": 1.0}
        return {"unlike": 1.0} if named_so else None
    if kind in BARS:
        if piece.kind in BARS:
            return {"seen": 1.0} if piece.kind == kind else None
        if piece.slender and not _across(piece, stance):
            return {"bar": 1.0}
        return None if share > BULKY and not named_so else {"no bar": 1.0}
    if piece.kind in BARS:
        return {"unlike": 1.0}
    return {"frame": float(np.sqrt(piece.area / largest))} if kind == "frame" else {}
