"""Suspect bodies: whom to mistrust in an answer that is not whole. A body that was not found has left its parts to
others, a joint that was not found may be a false weld, and what nothing found joins to the root may be another part of
the machine. And suspect parts: what may be a body that was not found, by its name, or as wheels look; and what may be a
frame that was not found, by its size."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.alignment.assignment.answer import MOVING, Answer
from yellowiron.alignment.assignment.cp_sat import TYPED, Solution
from yellowiron.alignment.assignment.machine_frame import MachineFrame
from yellowiron.alignment.assignment.sides import END
from yellowiron.alignment.assignment.weights import AS_GOOD
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.features.wheels import FLAT, TREAD, Wheel
from yellowiron.alignment.labelling.place import DOUBTFUL, Place
from yellowiron.alignment.structure.observation import Observation
from yellowiron.model.template import Template

AROUND = 2
"""Parts of a body that was not found may be taken for bodies that are this many joints away."""
PUNY = 0.02
"""A frame of less than this share of the largest body's surface is none, and its parts are elsewhere."""
MEAGRE = 0.1
"""What has less than this part of the surface that the body usually has is a piece of it, and the rest is elsewhere. Of
126 frames, arms, links and tools of 23 models of strangers the logarithms deviate by 0.48: this is 4.8 of that."""
SPEAKS = 0.4
"""Names that speak this well of missing bodies, and less of the part's own, leave it in doubt."""
SQUARE = 0.1
"""What is as high as it is long, to this share, may be a wheel that is not drawn round, …"""
LEAST = 0.75
"""… if it is at least so many times as large as another one, …"""
THIN = 0.3
"""… unless it is of less than this share of another's width."""
MARGIN = 0.05
"""What reaches out of an outline by no more than this share of its size is within it."""
TURNS = 12
"""In so many directions an outline is looked at."""
CROSSED = 0.1
"""What is called the front is behind what is called the rear if it is so by this share of the machine's size."""
HALF = 0.5
"""Of a frame's usual share of the surface: what has as much may be it."""


@dataclass(frozen=True)
class _Joints:
    """The template's joints between bodies as they were found or not. `beside`: body → those it has a joint with, where
    both are plain (neither optional nor told by shape); `linked`: by a joint that was found; `apart`: (body, other,
    joint) of hinges of plain bodies that were not found, both ways round."""

    beside: Mapping[str, set[str]]
    linked: Mapping[str, set[str]]
    apart: Sequence[tuple[str, str, str]]


def suspect_bodies(
    solution: Solution, template: Template, surface: Mapping[str, float] | None = None
) -> dict[str, str]:
    """Body → why it is doubtful. Barrels, rods and wheels are told by their shape: one that is missing casts no doubt
    on others. `surface`: body → m², for those that were found."""
    kinds = {r.name: r.kind for r in template.roles if r.rigid}
    special = {r.name for r in template.roles if r.optional} | {b for b, kind in kinds.items() if kind in TYPED}
    joints = _joints(solution, template, kinds, special)
    reached = _within(template.root, joints.linked)
    words = {b: "nothing that was found joins it to the rest of the machine" for b in kinds if b not in reached}
    puny = _puny_frames(kinds, surface or {})
    words |= dict.fromkeys(sorted(puny), "it is too small for a frame")
    jointed = {b for b, others in joints.linked.items() if others} - puny
    undrawn = _undrawn(template, set(kinds) - jointed - puny, kinds)
    for own, other, joint in joints.apart:
        if not {own, other} & undrawn:
            words[own] = f"{joint} is not found: parts of {other} may be among its parts"
    elsewhere = special | jointed | undrawn
    for body in kinds:
        if body not in elsewhere:
            around = _within(body, joints.beside, steps=AROUND) - {body}
            words |= dict.fromkeys(sorted(around), f"{body} is not found: its parts may be among these")
    whole = {j.name for j in template.joints if j.type in MOVING} <= {*solution.hinge_of, *solution.slide_of}
    for body in sorted(meagre(template, surface or {}) - special) if not whole else ():
        around = _within(body, joints.beside, steps=AROUND)
        words |= dict.fromkeys(sorted(around), f"of {body} hardly anything is found: its parts may be among these")
    return words


def meagre(template: Template, surface: Mapping[str, float]) -> set[str]:
    """The bodies that have next to nothing of the surface which is usually theirs, among those that were found."""
    usual = {b: template.usual[b].area for b in surface if b in template.usual and template.usual[b].area > 0.0}
    whole, found = sum(usual.values()), sum(surface[b] for b in usual)
    return {b for b, share in usual.items() if surface[b] * whole < MEAGRE * share * found}


def crossed_ends(observation: Observation, answer: Answer, frame: MachineFrame) -> dict[str, str]:
    """Body → why it is doubtful, of the bodies of a machine's front and rear (and its root, which they hang on) where
    those of the front lie behind those of the rear, as the machine faces by its arms or a person's word."""
    solids, ends = observation.solids, dict[str, list[float]]()
    for c, body in sorted(answer.solution.body_of.items()):
        for end in set(END.findall(body)) & {"front", "rear"}:
            for i in sorted(answer.structure.clusters[c].members):
                middle = 0.5 * (solids[i].low + solids[i].high)
                ends.setdefault(end, []).append(float(frame.matrix[0, :3] @ middle))
    if len(ends) < 2 or np.mean(ends["front"]) > np.mean(ends["rear"]) - CROSSED * observation.size:
        return {}
    named = [b for b in answer.solution.body_of.values() if END.search(b)]
    return dict.fromkeys(
        sorted({*named, answer.template.root}), "its front and rear lie the other way round than it faces"
    )


def _joints(solution: Solution, template: Template, kinds: Mapping[str, str], special: set[str]) -> _Joints:
    found = {*solution.hinge_of, *solution.slide_of}
    apart: list[tuple[str, str, str]] = []
    joints = _Joints({b: set() for b in kinds}, {b: set() for b in kinds}, apart)
    for joint in template.joints:
        bodies = [b for b in template.bodies_of(joint) if b is not None]
        if len(bodies) != 2 or not set(bodies) <= set(kinds):
            continue
        plain = not special & set(bodies)
        for own, other in (bodies, bodies[::-1]):
            if plain:
                joints.beside[own].add(other)
            if joint.name in found:
                joints.linked[own].add(other)
            elif plain and joint.type == "revolute":
                apart.append((own, other, joint.name))
    return joints


def _within(start: str, joints: Mapping[str, set[str]], *, steps: int | None = None) -> set[str]:
    """The bodies that so many joints lead to from a body; without `steps`, however many."""
    reached, front = {start}, [start]
    while front and steps != 0:
        front = [b for own in front for b in sorted(joints[own]) if b not in reached]
        reached.update(front)
        steps = None if steps is None else steps - 1
    return reached


def _puny_frames(kinds: Mapping[str, str], surface: Mapping[str, float]) -> set[str]:
    """Frames whose surface is next to nothing beside the largest body's."""
    least = PUNY * max(surface.values(), default=0.0)
    return {b for b, kind in kinds.items() if kind == "frame" and surface.get(b, least) < least}


def _undrawn(template: Template, absent: set[str], kinds: dict[str, str]) -> set[str]:
    """Those of the absent bodies that hang together with an absent hydraulic cylinder: a whole chain that is not drawn,
    whose parts are nowhere, and not one body that was welded to another."""
    pairs = [bodies for j in template.joints if set(bodies := template.bodies_of(j)) <= absent]
    undrawn = {b for b in absent if kinds[b] in ("barrel", "rod")}
    grown = True
    while grown:
        more = {b for pair in pairs for b in pair if b is not None and undrawn & set(pair)}
        grown = not more <= undrawn
        undrawn |= more
    return undrawn


def maybe_unplayed(
    places: Mapping[int, Place],
    solids: Sequence[Solid],
    scores: Sequence[Mapping[str, float]],
    wheels: Sequence[Wheel],
    template: Template,
    played: Collection[str],
) -> dict[int, Place]:
    """The places, solid → place, those doubtful of what may be a body of which nothing is `played`. `scores`: by solid,
    what its names say, as far as they are to be believed; `wheels`: those that were found."""
    missing = {r.name for r in template.roles if r.rigid and not r.many} - set(played)
    rolling = {r.name for r in template.roles if r.kind == "wheel" and not r.drum}
    found = dict(places)
    outlines = [
        solids[i]
        for i, place in places.items()
        if missing & rolling and place.body not in rolling and any(_like(solids[i], wheel) for wheel in wheels)
    ]
    for i, place in places.items() if missing else ():
        said = scores[i]
        best = max(said.values(), default=0.0)
        meant = {b for b, score in said.items() if score > best - AS_GOOD}
        if best >= SPEAKS and place.body in meant:
            continue
        if best >= SPEAKS and meant & missing:
            words = f"by its name it may be {min(meant & missing)}, which is not found"
        elif place.body not in rolling and any(_inside(solids[i], outline) for outline in outlines):
            words = f"it may be {min(missing & rolling)}, which is not found"
        else:
            continue
        sure = min(place.confidence, DOUBTFUL)
        found[i] = replace(place, confidence=sure, reason=f"{place.reason}; but {words}")
    return found


class Vacancies:
    """Which solids may be a frame of which nothing was found, by their size; frames that may be absent leave none."""

    def __init__(self, solids: Sequence[Solid], answer: Answer) -> None:
        judged, template = answer.judged, answer.template
        found = {*answer.solution.body_of.values()} if judged is None else {what.body for what in judged.values()}
        missing = [
            r.name for r in template.roles
            if r.rigid and r.kind == "frame" and not r.optional and r.name not in found and r.name in template.usual
        ]  # fmt: skip
        self._answer = answer
        self._least = {b: HALF * template.usual[b].area for b in missing}
        pairs = [set(template.bodies_of(joint)) for joint in template.joints]
        # The root first: no machine lacks it.
        order = sorted(missing, key=lambda b: (b != template.root, b))
        self._beside = {r.name: [m for m in order if {m, r.name} in pairs] for r in template.roles if r.rigid}
        total = sum(s.surface for s in solids) or 1.0
        meshes: dict[str, float] = {}
        for solid in solids:
            meshes[solid.part.id] = meshes.get(solid.part.id, 0.0) + solid.surface / total
        self._share = {s.index: meshes[s.part.id] for s in solids}
        for cluster in answer.structure.clusters:
            whole = sum(solids[i].surface for i in sorted(cluster.members)) / total
            self._share |= {i: max(self._share[i], whole) for i in sorted(cluster.members)}

    def beside(self, body: str, solid: int) -> str | None:
        """The frame beside `body` that a solid which goes with it may be: the mesh that it is of, or what it is rigid
        with, is large enough."""
        return next((m for m in self._beside.get(body, ()) if self._share[solid] >= self._least[m]), None)

    def root(self) -> dict[int, Place]:
        """Solid → its place, of what was left over by the judge and is the root for want of one (`with_root`), where it
        is large enough for that: for a person to look at."""
        root, judged = self._answer.template.root, self._answer.judged
        if judged is None or root not in self._least:
            return {}
        words = f"the largest that is left over, and nothing else is {root}"
        left = [i for c, b in self._answer.solution.body_of.items() if b == root
                for i in sorted(self._answer.structure.clusters[c].members - judged.keys())]  # fmt: skip
        return {
            i: Place(root, root, DOUBTFUL, words, how="judged") for i in left if self._share[i] >= self._least[root]
        }


def otherwise(places: Mapping[int, Place], solids: Sequence[Solid], told: Mapping[str, str]) -> dict[int, Place]:
    """The places, solid → place, those doubtful of which another reading says another body; `told`: part id → that."""
    found = dict(places)
    for i, place in places.items():
        other = told.get(solids[i].part.id, place.body)
        if other != place.body:
            words = f"{place.reason}; but names, place and shape together say {other}"
            found[i] = replace(place, confidence=min(place.confidence, DOUBTFUL), reason=words, runner_up=other)
    return found


def _inside(solid: Solid, outline: Solid) -> bool:
    """Whether a solid is the outline of a wheel, or wholly within it: rims, hubs, bolts."""
    margin = MARGIN * (outline.high - outline.low)
    return bool((solid.low >= outline.low - margin).all() and (solid.high <= outline.high + margin).all())


def _like(solid: Solid, wheel: Wheel) -> bool:
    """Whether a solid has about the outline of a wheel that has its axis along that one's."""
    across = np.linalg.svd(wheel.direction[None, :])[2][1:]
    turns = np.linspace(0.0, 0.5 * np.pi, TURNS, endpoint=False)
    ways = np.array([[[np.cos(t), np.sin(t)], [-np.sin(t), np.cos(t)]] for t in turns]) @ across
    flat = solid.points @ ways.reshape(-1, 3).T
    sides = np.ptp(flat, axis=0).reshape(-1, 2)
    # As it lies: the outline is the least there.
    high, long = sides[int(np.argmin(np.round(sides.max(axis=1), 9)))]
    radius, width = 0.5 * float(max(high, long)), float(np.ptp(solid.points @ wheel.direction))
    square = abs(high - long) <= SQUARE * max(high, long)
    as_large = LEAST * wheel.radius < radius < TREAD * wheel.radius
    return bool(square and as_large and THIN * wheel.width < width < FLAT * radius)
