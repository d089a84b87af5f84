"""Rigid clusters and the hinges between them.

What welds: flat contact, a ring in a bore, and two distinct pin lines in common. What never welds alone: contact across
a shared pin line (it may turn). A barrel, a rod or a wheel is never welded to another of these. Parts that only touch,
or are drawn into each other, are joined where the machine is not whole without (`weak`); a weld that would leave a pin
with nothing to turn is refused (`careful`) as long as the machine is whole without.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from yellowiron.alignment.features.contacts import Fit, SharedAxis
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.features.wheels import Wheel
from yellowiron.alignment.structure.contact_evidence import ContactEvidence, runs_across
from yellowiron.alignment.structure.min_cut import false_welds, strength
from yellowiron.alignment.structure.rigid_groups import Groups
from yellowiron.alignment.structure.welds import Pairs, axes_by_group, join_doubly_pinned, weld
from yellowiron.alignment.tolerances import PARALLEL, ROUND_ARC

ROUNDS = 4
"""How often a careful reading starts again without the false welds it found."""
OWN = 0.05
"""A cluster of which a cylinder's half is less than this share of the surface is what carries it: a frame that a barrel
was found to be fast on is still a frame, and a cylinder half is a ram's."""
LONG = 6.0
"""A part that reaches this many pin radii from the pin's axis is no ring, boss or keeper."""


@dataclass(frozen=True)
class Cluster:
    """Solids that move as one. `kind`: `wheel`, `barrel`, `rod` or ""; `number` of that wheel or cylinder."""

    members: frozenset[int]
    kind: str = ""
    number: int = -1


@dataclass(frozen=True)
class Hinge:
    """Clusters `a` < `b` turn against each other about axis `axis`; `pins` are the solids through both."""

    a: int
    b: int
    axis: int
    pins: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Structure:
    """What geometry alone says: clusters, hinges between them, slides (barrel, rod, number of the hydraulic
    cylinder; then sections in each other, numbered on from how many `cylinders` there are),
    axes (the wheels' axes behind those of the evidence), for each pin and bolt its hosts, and the pairs of solids that
    touch but were not welded, since a pin would have nothing to turn on, with the strength of their contact;
    and the hoses and such that hold nothing; axis → the races of a slewing bearing on it; and
    which of the wheels' numbers are drums'."""

    clusters: tuple[Cluster, ...] = ()
    hinges: tuple[Hinge, ...] = ()
    slides: tuple[tuple[int, int, int], ...] = ()
    cylinders: int = 0
    axes: tuple[SharedAxis, ...] = ()
    hosts: dict[int, tuple[Fit, ...]] = field(default_factory=dict)
    refused: tuple[tuple[int, int, float], ...] = ()
    slight: frozenset[int] = frozenset()
    races: dict[int, tuple[int, ...]] = field(default_factory=dict)
    drums: frozenset[int] = frozenset()


def structure_of(evidence: ContactEvidence, *, leaves: bool, weak: bool, careful: bool) -> Structure:
    """Clusters and hinges. `leaves`: the template has bodies that hang on a single hinge, so that a spacer on one pin
    may be one. A careful reading looks for false welds and starts again without them; so does one of a type that has
    cylinders without pins, where one that was to hang on pins turns out to be fast on something far larger."""
    groups, refused = _grouped(evidence, weak=weak, careful=careful)
    while evidence.rams and (carried := _carried(groups, evidence)):
        fixed = [replace(c, fixed=c.fixed or k in carried) for k, c in enumerate(evidence.cylinders)]
        evidence = replace(evidence, cylinders=tuple(fixed))
        groups, refused = _grouped(evidence, weak=weak, careful=careful)
    _absorb_leaves(groups, evidence, leaves=leaves)
    if weak:
        _absorb_bosses(groups, evidence)
    return _collected(groups, evidence, refused)


def _grouped(evidence: ContactEvidence, *, weak: bool, careful: bool) -> tuple[Groups, Pairs]:
    """What is welded, and the pairs that touch but were not."""
    flat = list(dict.fromkeys((f.a, f.b) for f in evidence.welds))
    apart: set[tuple[int, int]] = set()
    for _ in range(ROUNDS if careful else 1):
        groups = _tagged(evidence)
        pairs = [p for p in flat if p not in apart]
        refused = weld(groups, evidence, pairs, careful=careful)
        _attach_eyes(groups, evidence)
        join_doubly_pinned(groups, evidence)
        if weak:
            touching = [p for p in _touching(groups, evidence) if p not in apart]
            refused = weld(groups, evidence, [*refused, *touching], careful=careful)
            pairs += touching
        found = false_welds(groups, evidence, list(dict.fromkeys(pairs)), refused) if refused else set()
        if not found:
            break
        apart |= found
    return groups, [*refused, *sorted(apart)]


def _tagged(evidence: ContactEvidence) -> Groups:
    """Groups of what is certain: barrels, rods, wheels, rings in their bores."""
    groups = Groups(len(evidence.solids))
    for k, cylinder in enumerate(evidence.cylinders):
        for half, kind in ((cylinder.barrel, "barrel"), (cylinder.rod, "rod")):
            if not cylinder.fixed:
                groups.tag(half, (kind, k))
            else:
                for other in half - {min(half)}:
                    groups.join(min(half), other)
        if cylinder.fixed:
            groups.keep_apart(min(cylinder.barrel), min(cylinder.rod))
    for k, wheel in enumerate(evidence.wheels):
        groups.tag(wheel.members, ("wheel", k))
    for ring, around in evidence.pressed:
        groups.join(ring, around)
    join_doubly_pinned(groups, evidence)
    return groups


def loose_ends(structure: Structure) -> int:
    """How many clusters take part in hinges or slides: far more than the template has bodies means broken welds."""
    return len({i for h in structure.hinges for i in (h.a, h.b)} | {i for s in structure.slides for i in s[:2]})


def _touching(groups: Groups, evidence: ContactEvidence) -> list[tuple[int, int]]:
    """Pairs in different groups whose meshes touch and that lie about no common axis, nor slide in each other."""
    sliding = {(min(n.outer, n.inner), max(n.outer, n.inner)) for n in evidence.nests}
    halves = (pair for c in evidence.cylinders if c.fixed for pair in itertools.product(c.barrel, c.rod))
    sliding |= {(min(pair), max(pair)) for pair in halves}
    return [
        (a, b)
        for a, b in evidence.near
        if groups.find(a) != groups.find(b)
        and groups.may_join(a, b)
        and not evidence.about[a] & evidence.about[b]
        and not {a, b} & (evidence.fasteners | (evidence.slight - evidence.sheets))
        and (a, b) not in sliding
        and evidence.touching(a, b)
    ]


def _attach_eyes(groups: Groups, evidence: ContactEvidence) -> None:
    """A barrel or rod without a pin line across it takes the touching group that has one."""
    for cylinder in (c for c in evidence.cylinders if not c.fixed):
        for part in (cylinder.barrel,) if cylinder.apart else (cylinder.barrel, cylinder.rod):
            root = groups.find(min(part))
            mine = {s.index for s in evidence.solids if groups.find(s.index) == root}
            if any(runs_across(evidence.axes[k], cylinder) for i in mine for k in evidence.pinned[i]):
                continue
            beside = {(a, b) if b in mine else (b, a) for a, b in evidence.near if (a in mine) != (b in mine)}
            for other, own in sorted(beside):
                if other in evidence.fasteners or not any(
                    runs_across(evidence.axes[k], cylinder) for k in evidence.pinned[other]
                ):
                    continue
                if groups.may_join(own, other) and evidence.touching(own, other) and groups.join(own, other):
                    break


def _beside(s: Solid, wheel: Wheel) -> bool:
    """True if a part has a cylinder about a wheel's axis, near that wheel."""
    for c in s.cylinders:
        if c.arc < ROUND_ARC or abs(float(c.direction @ wheel.direction)) < PARALLEL:
            continue
        low, high = c.interval(wheel.center, wheel.direction)
        if low < wheel.width and high > -wheel.width and c.off(wheel.center) < 0.02 * wheel.radius:
            return True
    return False


def _about_ends(evidence: ContactEvidence, wheel: Wheel, cluster_of: dict[int, int]) -> set[int]:
    """The clusters that touch a drum where nothing round is drawn about its axis: its journals end in plain plates."""
    pairs = [(a, b) for a, b in evidence.near if (a in wheel.members) != (b in wheel.members)]
    others = {b if a in wheel.members else a for a, b in pairs if evidence.touching(a, b)}
    return {cluster_of[i] for i in others if i in cluster_of}


def _absorb_leaves(groups: Groups, evidence: ContactEvidence, *, leaves: bool) -> None:
    """Rings and spacers on a single axis go with the only group they lie against."""
    on = axes_by_group(groups, evidence)
    partners = _turning_partners(groups, evidence)
    members: dict[int, list[int]] = {}
    wheels: dict[int, set[int]] = {}
    for s in evidence.solids:
        group = groups.find(s.index)
        members.setdefault(group, []).append(s.index)
        if groups.kind(group) != "wheel" and s.index not in evidence.fasteners:
            wheels.setdefault(group, set()).update(k for k, w in enumerate(evidence.wheels) if _beside(s, w))
    slewing = {k for k, _ in evidence.races}
    for group in sorted(partners):
        if groups.kind(group) or groups.find(group) != group:
            continue
        axes, own_wheels = on.get(group, set()), wheels.get(group, set())
        rings = all(evidence.solids[i].axis is not None for i in members[group])
        if axes & slewing and not rings:
            continue  # what stands on a slewing bearing reaches no further than it, and turns
        if any(reaches_out(evidence.solids, members[group], evidence.axes[k]) for k in axes):
            continue
        found = {groups.find(p) for p in partners[group]} - {group}
        leaf = len(axes) + len(own_wheels) <= 1 and (rings or not (leaves or own_wheels))
        if leaf and len(found) == 1:
            groups.join(group, found.pop())


def _turning_partners(groups: Groups, evidence: ContactEvidence) -> dict[int, set[int]]:
    """Group → those that it lies against and may turn on, wheels left out."""
    partners: dict[int, set[int]] = {}
    for flat in evidence.turning:
        a, b = groups.find(flat.a), groups.find(flat.b)
        if a != b and "wheel" not in (groups.kind(a), groups.kind(b)):
            partners.setdefault(a, set()).add(b)
            partners.setdefault(b, set()).add(a)
    return partners


def _absorb_bosses(groups: Groups, evidence: ContactEvidence) -> None:
    """A ring on a single pin line that is drawn into another part, and touches one group only, goes with it."""
    on = axes_by_group(groups, evidence)
    beside: dict[int, set[int]] = {}
    for a, b in evidence.near:
        if groups.find(a) != groups.find(b) and not {a, b} & (evidence.fasteners | evidence.slight):
            beside.setdefault(a, set()).add(b)
            beside.setdefault(b, set()).add(a)
    for s in evidence.solids:
        group = groups.find(s.index)
        alone = s.axis is not None and not groups.kind(group) and len(on.get(group, ())) == 1
        if not alone or any(groups.find(o.index) == group for o in evidence.solids if o is not s):
            continue
        found = {groups.find(j) for j in sorted(beside.get(s.index, ())) if evidence.touching(s.index, j)} - {group}
        if len(found) == 1:
            groups.join(group, found.pop())


def reaches_out(solids: tuple[Solid, ...], members: Iterable[int], axis: SharedAxis) -> bool:
    """True for solids that reach far out from a pin's axis: no rings and spacers on it, but something that turns."""
    points = np.concatenate([solids[i].points for i in sorted(members)]) - axis.origin
    off = np.linalg.norm(points - np.outer(points @ axis.direction, axis.direction), axis=1)
    return float(off.max()) > LONG * axis.radius


def labelled_structure(
    evidence: ContactEvidence, bodies: Mapping[str, Sequence[int]], kinds: Mapping[str, str]
) -> tuple[Structure, dict[int, str]]:
    """The clusters and hinges of solids whose bodies are known (`bodies`: body → solids; `kinds`: body → its kind), and
    cluster → body. What is of no body is a cluster of its own."""
    body_of_solid = {i: body for body, members in bodies.items() for i in members}
    groups = Groups(len(evidence.solids))
    whole = [(k, c) for k, c in enumerate(evidence.cylinders) if not (c.apart or c.fixed)]
    halves = {frozenset(c.barrel): ("barrel", k) for k, c in whole}
    halves |= {frozenset(c.rod): ("rod", k) for k, c in whole}
    wheels = {w.tyre: k for k, w in enumerate(evidence.wheels)}
    for body, members in sorted(bodies.items()):
        own = set(members)
        label: tuple[str, int] | None = None
        if kinds.get(body) in ("barrel", "rod"):
            label = next((tag for half, tag in halves.items() if half <= own and tag[0] == kinds[body]), None)
        elif kinds.get(body) == "wheel":
            label = next((("wheel", wheels[i]) for i in sorted(own) if i in wheels), None)
        if label is not None:
            groups.tag(members, label)
        else:
            first, *rest = sorted(members)
            for other in rest:
                groups.join(first, other)
    fasteners = evidence.fasteners - set(body_of_solid)
    structure = _collected(groups, replace(evidence, fasteners=fasteners), [])
    body_of = {
        c: body_of_solid[min(cluster.members & set(body_of_solid))]
        for c, cluster in enumerate(structure.clusters)
        if cluster.members & set(body_of_solid)
    }
    return structure, body_of


def _collected(groups: Groups, evidence: ContactEvidence, refused: Pairs) -> Structure:
    """The structure that groups make: every group but the fasteners' is a cluster."""
    gathered = _gathered(groups, evidence)
    roots = sorted(gathered)
    clusters = tuple(_cluster(frozenset(gathered[r]), groups.label(r), evidence) for r in roots)
    cluster_of = {i: k for k, r in enumerate(roots) for i in gathered[r]}
    pins = _pinned_pairs(evidence, cluster_of)
    for number, wheel in enumerate(evidence.wheels, len(evidence.axes)):
        own = cluster_of[wheel.tyre]
        beside = {c for i, c in cluster_of.items() if _beside(evidence.solids[i], wheel)} - {own}
        if wheel.drum and not beside:
            beside = _about_ends(evidence, wheel, cluster_of) - {own}
        for other in sorted(beside):
            if clusters[other].kind != "wheel":
                pins.setdefault((min(own, other), max(own, other), number), set())
    races: dict[int, tuple[int, ...]] = {}
    for k, fit in evidence.races:
        races[k] = (*races.get(k, ()), fit.inner, fit.outer)
    return Structure(
        clusters,
        hinges=tuple(Hinge(a, b, k, tuple(sorted(p))) for (a, b, k), p in sorted(pins.items())),
        slides=_slides(evidence, cluster_of),
        cylinders=len(evidence.cylinders),
        axes=(*evidence.axes, *(SharedAxis(w.center, w.direction, w.radius, ()) for w in evidence.wheels)),
        hosts=dict(evidence.hosts),
        refused=tuple((a, b, strength(evidence, a, b)) for a, b in refused if groups.find(a) != groups.find(b)),
        slight=evidence.slight,
        races=races,
        drums=frozenset(k for k, wheel in enumerate(evidence.wheels) if wheel.drum),
    )


def _gathered(groups: Groups, evidence: ContactEvidence) -> dict[int, set[int]]:
    """The members of every group, without the fasteners."""
    gathered: dict[int, set[int]] = {}
    for s in evidence.solids:
        if s.index not in evidence.fasteners:
            gathered.setdefault(groups.find(s.index), set()).add(s.index)
    return gathered


def _cluster(members: frozenset[int], label: tuple[str, int], evidence: ContactEvidence) -> Cluster:
    """A cluster of the kind that its label says, unless that is a cylinder's half and most of it is something else."""
    return Cluster(members) if _is_carried(members, label, evidence) else Cluster(members, *label)


def _is_carried(members: frozenset[int], label: tuple[str, int], evidence: ContactEvidence) -> bool:
    """Whether a cluster is labelled as a cylinder's half and is mostly what that half is fast on."""
    kind, number = label
    if kind not in ("barrel", "rod"):
        return False
    half = evidence.cylinders[number].barrel if kind == "barrel" else evidence.cylinders[number].rod
    own, every = (sum(evidence.solids[i].surface for i in sorted(some)) for some in (half, members))
    return own < OWN * every


def _carried(groups: Groups, evidence: ContactEvidence) -> frozenset[int]:
    """The numbers of the cylinders of which a half is fast on something far larger."""
    gathered = _gathered(groups, evidence)
    whole = [(frozenset(members), groups.label(root)) for root, members in sorted(gathered.items())]
    return frozenset(label[1] for members, label in whole if _is_carried(members, label, evidence))


def _pinned_pairs(evidence: ContactEvidence, cluster_of: dict[int, int]) -> dict[tuple[int, int, int], set[int]]:
    """(cluster, cluster, axis) of what turns on each other → the pins through both; none for a part's own shaft."""
    pins: dict[tuple[int, int, int], set[int]] = {}
    for pin, around in evidence.hosts.items():
        found = sorted({cluster_of[f.outer] for f in around if f.outer not in evidence.fasteners})
        for k in evidence.axes_of[pin]:
            for a, b in itertools.combinations(found, 2):
                pins.setdefault((a, b, k), set()).add(pin)
    for k, fit in evidence.direct:
        a, b = sorted((cluster_of[fit.inner], cluster_of[fit.outer]))
        if a != b:
            pins.setdefault((a, b, k), set())
    return pins


def _slides(evidence: ContactEvidence, cluster_of: dict[int, int]) -> tuple[tuple[int, int, int], ...]:
    """Barrels and rods, then sections in each other, as `Structure` has them."""
    slides = [(cluster_of[min(c.barrel)], cluster_of[min(c.rod)], k) for k, c in enumerate(evidence.cylinders)]
    sections = [(cluster_of[n.outer], cluster_of[n.inner]) for n in evidence.nests]
    return (*slides, *((a, b, len(slides) + k) for k, (a, b) in enumerate(sections) if a != b))
