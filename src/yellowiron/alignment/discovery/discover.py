"""A machine of no known type: the bodies and joints that geometry finds, for a template to be made from.

1. everything that a template could ask for is looked for: hydraulic cylinders, wheels, slewing bearings, pins
2. the welds are read in every way; that reading is best in which every closed chain has as many freedoms as slides
3. rings, keepers and doors are left out: bodies are what slides, rolls, or reaches far out from a pivot
4. of the pairs that a pin joins, as many as it takes to join all; what hangs on nothing is joined by a weld, said so
5. the root is the body on the wheels, else the largest of those that stand on the ground
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.alignment.discovery.description import across, describe, surface
from yellowiron.alignment.features.separate_parts import separate_parts
from yellowiron.alignment.features.solids import solids_of
from yellowiron.alignment.features.tracks import Track, tracks_of
from yellowiron.alignment.structure.clusters import LONG, Structure, reaches_out, structure_of
from yellowiron.alignment.structure.loops import Edge, bridges, components, freedoms
from yellowiron.alignment.structure.observation import Observation, observe
from yellowiron.alignment.tolerances import CONTACT, UPRIGHT
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import AlignmentError
from yellowiron.model.found import FoundMachine
from yellowiron.model.geometry import Floats
from yellowiron.model.template import JointTemplate, Role, Template

MOST_WHEELS = 24
NOTHING = 1000
"""The rank of a reading without a single joint."""
HALF = 0.05
"""A slewing bearing has at least this share of the machine's surface on either side."""
STOUT = 0.5
"""A pivot is at least this share of the machine's usual pin radius: thinner ones are of doors and levers."""


@dataclass(frozen=True, eq=False)
class _Reading:
    """One way to read the welds: the clusters that are bodies, and the joints between them."""

    structure: Structure
    bodies: tuple[int, ...]
    edges: tuple[Edge, ...]
    slewing: int

    @property
    def rank(self) -> tuple[int, int, int, int]:
        """Smaller is better: freedoms that nothing drives and pieces that nothing joins; doubled slides; slewing
        bearings, of which more are better; bodies."""
        wrong, doubled = freedoms(self.edges)
        pieces = len(components(self.edges))
        return (wrong + pieces - 1 if pieces else NOTHING), doubled, -self.slewing, len(self.bodies)


def discover(assembly: Assembly) -> FoundMachine:
    """The bodies and joints of a CAD model of no known type.

    `AlignmentError` where it has no parts, or nothing in it turns or slides. Tracks go with the body that carries them.
    Findings: ALN020 … ALN023.
    """
    if not assembly.parts:
        raise AlignmentError(
            "The CAD model has no parts", where=assembly.name, hint="Check that the file holds solids."
        )
    apart = separate_parts(assembly, grounds=False)
    machine = replace(assembly, parts=tuple(p for p in assembly.parts if p.id not in apart))
    solids = solids_of(machine)
    tracks = tracks_of(solids)
    of_tracks = {
        solids[i].part.id for t in tracks for group in (*t.shoes, *(w.members for w in t.wheels)) for i in group
    }
    machine = replace(machine, parts=tuple(p for p in machine.parts if p.id not in of_tracks))
    best: tuple[Observation, _Reading] | None = None
    for contact in CONTACT:
        observation = _observed(machine, contact)
        for reading in _readings(observation, _upright(observation, tracks)):
            if best is None or reading.rank < best[1].rank:
                best = (observation, reading)
        if best is not None and best[1].rank[0] == 0:
            break
    if best is None or not best[1].edges:
        raise AlignmentError(
            "Nothing in the CAD model turns or slides on another part",
            where=assembly.name,
            hint="Pins, bores or hydraulic cylinders are what joints are found by; or copy a template and edit it.",
        )
    observation, reading = best
    return describe(assembly.name, observation, reading.structure, reading.edges, tracks, len(apart))


def _observed(assembly: Assembly, contact: float) -> Observation:
    """What geometry shows where everything is asked for; wheels only where all of them stand on one plane."""
    for count in (MOST_WHEELS, 0):
        observation = observe(assembly, _anything(count), contact)
        if not observation.wheels or _rolling(observation):
            break
    return observation


def _anything(wheels: int) -> Template:
    """A template that asks for all that can be looked for."""
    bodies = [("base", "frame"), ("top", "frame"), ("section", "arm"), ("barrel", "barrel"), ("rod", "rod")]
    bodies += [(f"wheel_{k}", "wheel") for k in range(wheels)]
    roles = tuple(Role(name, None if name == "base" else "base", True, kind) for name, kind in bodies)
    swing = JointTemplate("base2top_joint", "revolute", ("base", "top"), drive="angular")
    section = JointTemplate("base2section_joint", "prismatic", ("base", "section"))
    return Template("machine", "", "base", roles, (swing, section))


def _rolling(observation: Observation) -> bool:
    """True if the equal round things are wheels: all reach down to one plane that nothing goes through."""
    centers = np.array([w.center for w in observation.wheels])
    axis = observation.wheels[0].direction
    if len(centers) < 2 or any(abs(float(w.direction @ axis)) < 0.7 for w in observation.wheels):
        return False
    spread = np.linalg.svd(centers - centers.mean(axis=0))
    normal = spread[2][2] if len(centers) > 2 and spread[1][1] > 0.2 * spread[1][0] else across(axis)
    radius = min(w.radius for w in observation.wheels)
    level = centers @ normal
    inside = {i for w in observation.wheels for i in w.members}
    others = [s for s in observation.solids if s.index not in inside]
    if np.ptp(level) > 0.2 * radius or not others:
        return False
    depth = min(float((s.points @ normal).min()) for s in others) - float(level.mean())
    height = float(level.mean()) - max(float((s.points @ normal).max()) for s in others)
    return max(depth, height) > -radius


def _readings(observation: Observation, up: Floats | None) -> Iterator[_Reading]:
    read = functools.cache(functools.partial(structure_of, leaves=True))
    known = set()
    for careful in (True, False):
        for weak in (False, True):
            for evidence in observation.evidence:
                structure = read(evidence, weak=weak, careful=careful)
                if (key := (structure.clusters, structure.hinges, structure.slides)) not in known:
                    known.add(key)
                    yield _reading(observation, structure, up)


def _reading(observation: Observation, structure: Structure, up: Floats | None) -> _Reading:
    """The joints of a structure: hinges of bodies, and slides."""
    slides = [Edge(a, b, -1, k, True, k < len(observation.cylinders)) for a, b, k in structure.slides if a != b]
    pivots = _pivots(observation, structure)
    bodies = _bodies(observation, structure, pivots)
    hinges = [e for e in pivots if e.a in bodies and e.b in bodies]
    sliding = {frozenset((e.a, e.b)) for e in slides}
    hinges = [e for e in hinges if frozenset((e.a, e.b)) not in sliding]
    edges = (*slides, *_independent(observation, structure, hinges))
    return _Reading(structure, tuple(sorted(bodies)), edges, _slewing(observation, structure, edges, up))


def _slewing(observation: Observation, structure: Structure, edges: tuple[Edge, ...], up: Floats | None) -> int:
    """How many slewing bearings there are: upright races, in no chain, between two large halves of the machine."""
    total = sum(surface(observation, structure, c) for c in range(len(structure.clusters)))
    found = 0
    for edge in bridges(edges):
        if edge.slide or edge.axis not in structure.races:
            continue
        turning = up is None or abs(float(structure.axes[edge.axis].direction @ up)) > UPRIGHT
        rest = components([e for e in edges if e is not edge]) if turning else []
        halves = [{c for piece in rest if end in piece for c in piece} | {end} for end in (edge.a, edge.b)]
        found += (
            turning and min(sum(surface(observation, structure, c) for c in half) for half in halves) > HALF * total
        )
    return found


def _upright(observation: Observation, tracks: list[Track]) -> Floats | None:
    """The direction across the tracks, or the plane of three wheels or more; None where there are none."""
    if tracks:
        return np.asarray(np.cross(tracks[0].axis, tracks[0].along), dtype=np.float64)
    if len(observation.wheels) < 3:
        return None
    centers = np.array([w.center for w in observation.wheels])
    return np.asarray(np.linalg.svd(centers - centers.mean(axis=0))[2][2], dtype=np.float64)


def _pivots(observation: Observation, structure: Structure) -> list[Edge]:
    """The hinges on axes stout enough to be a pivot of the machine's, not of a door's or a bolt."""
    used = {h.axis for h in structure.hinges}
    wheels = {
        h.axis for h in structure.hinges if "wheel" in (structure.clusters[h.a].kind, structure.clusters[h.b].kind)
    }
    ends = {c for s in structure.slides for c in s[:2]}
    own = [structure.axes[h.axis].radius for h in structure.hinges if {h.a, h.b} & ends]
    usual = float(np.median(own or [structure.axes[k].radius for k in sorted(used - wheels)] or [0.0]))
    return [
        Edge(h.a, h.b, h.axis, k, False)
        for k, h in enumerate(structure.hinges)
        if h.axis in wheels or structure.axes[h.axis].radius >= STOUT * usual
    ]


def _bodies(observation: Observation, structure: Structure, pivots: list[Edge]) -> set[int]:
    """Clusters that are bodies: halves of cylinders, wheels, what is on two axes, and what hangs far out from one."""
    axes: dict[int, set[int]] = {}
    for edge in pivots:
        for c in (edge.a, edge.b):
            axes.setdefault(c, set()).add(edge.axis)
    found = {c for s in structure.slides for c in s[:2]}
    for c, on in axes.items():
        cluster = structure.clusters[c]
        reach = any(reaches_out(observation.solids, cluster.members, structure.axes[k]) for k in on)
        wide = any(structure.axes[k].radius * LONG > 0.1 * observation.size for k in on)
        if cluster.kind or len(on) > 1 or reach or wide:
            found.add(c)
    return found


def _independent(observation: Observation, structure: Structure, hinges: list[Edge]) -> list[Edge]:
    """Of the pairs that share an axis, as many as join all bodies on it: each with the largest, which has the pin."""
    by_axis: dict[int, list[Edge]] = {}
    for edge in hinges:
        by_axis.setdefault(edge.axis, []).append(edge)
    kept = []
    for axis in sorted(by_axis):
        on = sorted(
            {c for e in by_axis[axis] for c in (e.a, e.b)}, key=lambda c: (-_carrying(observation, structure, c), c)
        )
        joined = {on[0]}
        for c in on[1:]:
            found = [e for hub in on if hub in joined for e in by_axis[axis] if {e.a, e.b} == {hub, c}]
            kept += found[:1]
            joined.add(c)
    return kept


def _carrying(observation: Observation, structure: Structure, c: int) -> float:
    """The surface of a cluster; hydraulics and wheels count nothing: they carry no pin of others."""
    return 0.0 if structure.clusters[c].kind else surface(observation, structure, c)
