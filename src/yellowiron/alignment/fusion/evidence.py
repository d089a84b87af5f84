"""What a machine is judged by: its pieces and what speaks for each of them, and the ways it may stand."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import networkx
import numpy as np

from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.assignment.names import borne_by_others
from yellowiron.alignment.assignment.search import machine_of
from yellowiron.alignment.facing import UNTOLD, Facing
from yellowiron.alignment.features.solids import size_of
from yellowiron.alignment.fusion.bonds import Bond, bonds_of, stem_of
from yellowiron.alignment.fusion.pieces import Piece, leading, pieces_of
from yellowiron.alignment.fusion.stance import Stance, on_wheels, stance_of
from yellowiron.alignment.fusion.trust import trust_in_names, worth_of_name
from yellowiron.alignment.fusion.votes import BARS, Votes, clearly_named, joints_apart, votes_of
from yellowiron.alignment.structure.observation import Observation
from yellowiron.model.assembly import Part
from yellowiron.model.template import Template
from yellowiron.support.vectors import triple

SEVERAL = 3
"""A name that so many pieces bear, but for its number, is an assembly's: two may be the left and the right one."""
_NUMBERED = re.compile(r"(?<!\d)0?[2-9]$")
"""A name that ends in a number as sections are given; what a modelling tool adds has three digits."""
PIN = 0.35
"""A pin, or a shaft, is shorter than this share of the machine's size: what lies in its like and is longer may be the
section of a boom."""
PARTS = (1, 2)
"""What begins so many joints from the root may be all that is drawn."""


@dataclass(frozen=True, eq=False)
class Evidence:
    """What a machine is judged by: its pieces, which of them can be what a body mainly is (`leading`), all bonds, how
    far names are trusted, which pieces share theirs with others (solids of one mesh), how the machine stands, what the
    names say of each solid, what the contacts gave, what a person said, which pieces are bars in bores: pins, if they
    are not halves of hydraulic cylinders, the `surface` of all that is drawn, tracks too, m², and which pieces have no
    name but that of a part which they hang on in the tree (`borne`), or one that, but for its number, several bear, as
    all that is of one file does (`namesakes`). `further`: those whose name numbers them beyond the first of several."""

    pieces: tuple[Piece, ...]
    leading: tuple[int, ...]
    bonds: tuple[Bond, ...]
    trust: float
    shared: frozenset[int]
    stance: Stance
    scores: Sequence[Mapping[str, float]]
    answer: Answer
    edited: Mapping[int, str]
    pins: frozenset[int]
    surface: float
    borne: frozenset[int] = frozenset()
    namesakes: frozenset[int] = frozenset()
    further: frozenset[int] = frozenset()

    @property
    def between(self) -> list[Bond]:
        """The bonds of the leading pieces, numbered as these are."""
        number = {k: n for n, k in enumerate(self.leading)}
        return [replace(b, a=number[b.a], b=number[b.b]) for b in self.bonds if b.a in number and b.b in number]

    @property
    def crowding(self) -> float:
        """What speaks against a machine that is so much larger than what is drawn, in nats: places are told in machine
        sizes, and the larger it is the nearer to each other they are, whatever is there."""
        return 3.0 * float(np.log(self.stance.larger)) * len(self.leading)

    def votes(self, template: Template) -> Votes:
        """What speaks for every piece and body of a template with its variants decided."""
        trust = [
            self.trust * worth_of_name(piece, shared=k in self.shared, borne=k in self.borne)
            for k, piece in enumerate(self.pieces)
        ]
        votes = votes_of(self.pieces, template, self.scores, trust, self.answer, self.stance, self.edited, self.surface)
        halves = {r.name for r in template.roles if r.kind in BARS}
        absent = self.stance.absent - set(self.edited.values())
        return [
            {body: what for body, what in mine.items() if body not in absent and (k not in self.pins or body in halves)}
            for k, mine in enumerate(votes)
        ]


def evidence_of(
    observation: Observation,
    scores: Sequence[Mapping[str, float]],
    answer: Answer,
    edited: Mapping[int, str],
    template: Template,
    facing: Facing = UNTOLD,
) -> Evidence:
    """Everything that is known before anything is judged; the arguments are those of `reading.fused`."""
    directions = [np.asarray(axis.direction) for axis in observation.evidence[0].axes] if observation.evidence else []
    drawn = (*observation.solids, *observation.rows)
    stance = on_wheels(stance_of(drawn, size_of(drawn), directions, facing), observation.wheels)
    pieces = pieces_of(observation, frozenset(i for i, said in enumerate(scores) if said) | frozenset(edited))
    bonds = tuple(bonds_of(observation, pieces, answer.structure, stance))
    parts = [[observation.solids[i].part for i in sorted(piece.members)] for piece in pieces]
    called = [frozenset((part.path, part.name) for part in mine) for mine in parts]
    trust = trust_in_names(pieces, bonds, scores, template, called)
    leads = tuple(leading(pieces, observation.size, clearly_named(pieces, scores) if trust > 0.0 else {}))
    bars = observation.evidence[-1].fasteners if observation.evidence else frozenset()
    pins = frozenset(
        k for k, p in enumerate(pieces)
        if not p.kind and p.members <= bars and not p.members & edited.keys() and p.spread[0] < PIN * observation.size
    )  # fmt: skip
    borne = Counter(name for names in called for name in names)
    shared = frozenset(k for k, names in enumerate(called) if any(borne[name] > 1 for name in names))
    hung = borne_by_others(tuple(s.part for s in observation.solids), template)
    hanging = frozenset(k for k, p in enumerate(pieces) if p.members <= hung)
    surface = sum(s.surface for s in drawn) or 1.0
    return Evidence(
        pieces, leads, bonds, trust, shared, stance, scores, answer, edited, pins, surface, hanging, _namesakes(parts),
        frozenset(k for k, mine in enumerate(parts) if any(_NUMBERED.search(part.name) for part in mine)),
    )  # fmt: skip


def _namesakes(parts: Sequence[Sequence[Part]]) -> frozenset[int]:
    """The pieces whose names are those of `SEVERAL` pieces and more, but for their numbers."""
    stems = [{stem_of(part.name) for part in mine} for mine in parts]
    counts = Counter(stem for mine in stems for stem in mine)
    return frozenset(k for k, mine in enumerate(stems) if all(counts[stem] >= SEVERAL for stem in mine))


def ways_of(evidence: Evidence, template: Template, tracked: bool) -> list[Evidence]:
    """How the machine may stand: which end is the front is a guess so far, and so are where it stands, if that is short
    and wide, and whether all of it is drawn. What has tracks (`tracked`), or wheels to stand on, has a root."""
    whole = tracked or evidence.stance.wheeled
    return [
        replace(evidence, stance=stance)
        for way in (evidence.stance, *(() if evidence.stance.told else (evidence.stance.turned(),)))
        for stance in (way, *way.elsewhere(), *(() if whole else _as_parts(way, evidence, template)))
    ]


def across(evidence: Evidence, observation: Observation, template: Template) -> list[Evidence]:
    """How a machine that is as much alike in front and behind as to the left and right may stand besides: with its
    front where its sides were taken to be. None where a person said where its front is."""
    stance = evidence.stance
    if stance.told:
        return []
    quarter = Facing(forward=triple(stance.rotation[1]), up=triple(stance.rotation[2]))
    turned = evidence_of(observation, evidence.scores, evidence.answer, evidence.edited, template, quarter)
    stances = [replace(turned.stance, told=False), replace(turned.stance.turned(), told=False)]
    return [replace(turned, stance=stance) for stance in stances]


def _as_parts(stance: Stance, evidence: Evidence, template: Template) -> list[Stance]:
    """How the machine would stand if only what is so many joints (`PARTS`) from the root, or more, were drawn of it:
    all above its carrier, its work equipment. None where what it would lack is named."""
    resolved = machine_of(template, {})
    depths = {b: n for (a, b), n in joints_apart(resolved).items() if a == resolved.root}
    ends = [tuple(map(str, resolved.bodies_of(j))) for j in resolved.joints]
    total = sum(usual.area for usual in resolved.usual.values()) or 1.0
    points = np.concatenate([p.samples for p in evidence.pieces]) if evidence.pieces else np.zeros((0, 3))
    said = clearly_named(evidence.pieces, evidence.scores) if evidence.trust > 0.0 else {}
    nearest = min((depths[b] for b in said.values() if b in depths), default=len(depths))
    rigid = {r.name for r in resolved.roles if r.rigid}

    def surface(bodies: set[str]) -> float:
        return sum(resolved.usual[b].area for b in sorted(bodies) if b in resolved.usual)

    found = []
    for depth in (d for d in PARTS if d <= nearest):
        far = networkx.Graph([pair for pair in ends if min(depths.get(b, 0) for b in pair) >= depth])
        groups: list[set[str]] = list(networkx.connected_components(far))
        # Nobody draws a steered axle alone: what is drawn of a machine is the most of it that hangs together.
        bodies = max(groups, key=lambda some: (surface(some), len(some), sorted(some)), default=set[str]())
        usual = [resolved.usual[b] for b in sorted(bodies) if b in resolved.usual]
        if usual and len(points):
            low, high = np.min([u.low for u in usual], axis=0), np.max([u.high for u in usual], axis=0)
            found.append(stance.as_part(points, low, high, sum(u.area for u in usual) / total, rigid - bodies))
    return found
