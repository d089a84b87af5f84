"""Alignment: which part plays which role. Reads as a method section; each step is a module of its own.

1. solids and their features
2. tracks: closed rows of equal parts, with what belongs to them; the rest goes on
3. contacts: shafts in bores, flat faces on each other
4. hydraulic cylinders
5. wheels
6. what each contact means
7. rigid clusters and the hinges between them
8. names, and the sheet's diameters, as weights
9. clusters to bodies by CP-SAT, one variant against the other
   where that finds too few joints: names, shapes, places and contacts judged together (`fusion`)
10. the machine's frame, then left and right
11. pins, hardware and all the rest
12. what a person said before
13. an estimate of the axis of every joint that was not found
"""

from __future__ import annotations

import functools
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.alignment.assignment.answer import (
    Answer,
    drawn_share,
    found_joints,
    held_share,
    is_whole,
    rivals_of,
    shows_what_is_special,
)
from yellowiron.alignment.assignment.collision import colliders
from yellowiron.alignment.assignment.cp_sat import solve
from yellowiron.alignment.assignment.machine_frame import MachineFrame, machine_frame
from yellowiron.alignment.assignment.names import name_scores
from yellowiron.alignment.assignment.root_fallback import with_root
from yellowiron.alignment.assignment.search import BELIEVED, Search, variants_of
from yellowiron.alignment.assignment.sheet_weights import sheet_findings
from yellowiron.alignment.assignment.sides import twin_role
from yellowiron.alignment.assignment.weights import ends_untold, side_weights
from yellowiron.alignment.axes.levers import without_lever
from yellowiron.alignment.axes.searched import searched_axes, shown_axes
from yellowiron.alignment.axes.unfound import axis_findings, lines_of, rough_axes, unfound_axes
from yellowiron.alignment.copies import copies_of
from yellowiron.alignment.facing import Facing
from yellowiron.alignment.features.distance import Touch, touch_of
from yellowiron.alignment.features.solids import solids_of
from yellowiron.alignment.features.tracks import Track
from yellowiron.alignment.files.decisions import decided
from yellowiron.alignment.files.heard import heard_of_whole, unlikely
from yellowiron.alignment.fusion.named_bodies import WORDS, agreed, with_named, without_misnamed
from yellowiron.alignment.fusion.reading import AS_GOOD, fused
from yellowiron.alignment.labelling.bystanders import among_strangers, doubted
from yellowiron.alignment.labelling.coupler import with_couplers
from yellowiron.alignment.labelling.fittings import fittings_of, sitting
from yellowiron.alignment.labelling.further_axles import axle_tubes, further_wheels, spare_of
from yellowiron.alignment.labelling.place import pin_role
from yellowiron.alignment.labelling.propagation import Propagation
from yellowiron.alignment.labelling.rams import with_rams
from yellowiron.alignment.labelling.result import Labels, to_alignment
from yellowiron.alignment.labelling.review import name_findings, review_findings
from yellowiron.alignment.labelling.suspects import (
    crossed_ends,
    maybe_unplayed,
    meagre,
    otherwise,
    suspect_bodies,
)
from yellowiron.alignment.labelling.track_places import (
    no_surer_than_frames,
    on_tracks,
    track_places,
    tracks_in,
    upright,
    without_tracks,
)
from yellowiron.alignment.labelling.undercut import regrounded, too_low, undercut
from yellowiron.alignment.machines import apart_from
from yellowiron.alignment.structure.ground_cut import parted
from yellowiron.alignment.structure.observation import Observation, observe
from yellowiron.alignment.tolerances import CONTACT
from yellowiron.alignment.undrawn import undrawn
from yellowiron.model.alignment import DECIDED, Alignment, Vector
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats
from yellowiron.model.rows import as_drawn
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template, choose
from yellowiron.support.caching.remembered import remembered

HELD = 0.7
"""Contacts that find this share of the type's joints have found the machine; below, every reading is asked."""
HELD_TOLD = 0.6
"""… and this share where a person said something: what is put right takes from what was found before, and the rest of
the machine should not turn into another for that."""
EXPLAINED = 0.9
"""… as have those that leave no more than this of what is drawn unexplained, whatever the type has besides."""
STRAINED = 0.6
"""… and those that leave more than the rest unexplained are heard against the names, and are for review: of 16 drawn
machines without pins or a cylinder they explained 0.96 to 0.99."""
LEFT_OVER = "its joints were found, but much of what is drawn is left over: it may be another body"
BETTER = 150.0
"""… unless names speak and the judge finds another reading better by so much …"""
FAR_BETTER = 0.6
"""… or none do, and it makes of the contacts less than this share of what it makes of another reading. Of what contacts
told rightly of six loaders' work equipment it made 0.77 to 1, of 741 parts of an artist that they told wrongly 0.41."""
AGREED, SPOKEN = 0.9, 0.7
"""Where names that are heard agree with the contacts' bodies on this share of what both speak of, and that is so much
of all that is drawn, these stand."""
HEARD = 0.9
"""Names trusted so far go before contacts that they contradict and that did not find the whole machine."""


@dataclass(frozen=True, eq=False)
class Reading:
    """What was `found` where the parts `apart` (part id → metres from the machine, 0 under it; of the model without
    copies, `single`) are none of the machine's; what the judge makes of it (`score`, its points), None where contacts
    found the machine."""

    found: Alignment
    single: Assembly
    apart: Mapping[str, float]
    score: float | None


def read(
    assembly: Assembly,
    template: Template,
    specifications: Specifications,
    edits: Alignment | None,
    choices: Mapping[str, str] | None,
    square: Floats | None,
    way: Mapping[str, float] | None,
) -> Reading:
    """`readings.align`, its arguments and errors, of a model that has parts, where the parts of `way` (part id → metres
    from the machine) are none of the machine's; None where that is to be found out."""
    decisions, told = decided(assembly, template, edits)
    edited = {part: decision.role or "" for part, decision in decisions.items()}
    said, heard = heard_of_whole(edits, edited, assembly, template, choices or {})
    every, template, choices = template, undrawn(template, said.absent), said.choices
    facing = said.facing if square is None else said.facing.turned(square)
    bumpers = colliders(assembly) - edited.keys()
    drawn = _without(assembly, bumpers)
    copies = {copy: first for copy, first in copies_of(drawn).items() if copy not in edited}
    single = _without(drawn, copies)
    wanted = frozenset(part for part, role in edited.items() if role)
    alone = way if way is not None else apart_from(single, template, wanted)
    apart = dict(alone)
    tracking = _without(single, apart)
    tracked, tracks = tracks_in(tracking, template)
    machine = _without(tracking, set(tracked.values()))
    fittings = fittings_of(machine) - edited.keys()
    machine = _without(machine, fittings)
    plain = without_tracks(template)
    further = [w for w in spare_of(machine, plain) if not w.parts & edited.keys()]
    machine = _without(machine, frozenset().union(*(w.parts for w in further)))
    up = upright(tracks)
    rows = tuple(solids_of(tracking)[i] for i in tracked)

    @functools.cache
    def look(contact: float) -> Observation:
        return parted(replace(observe(machine, plain, contact), up=up, rows=rows), plain)

    search = Search(look, plain, specifications, choices, edited)
    answer, observation, scores = search.run()
    answer, fallen = regrounded(observation, answer)
    agreement = search.agreement
    held = held_share(answer) >= (HELD_TOLD if edited else HELD) and shows_what_is_special(answer, plain)
    share = drawn_share(answer, observation.solids)
    # A body of which hardly anything is found lies in another's, welded to it; of a machine that faces otherwise than
    # its ends lie, one end was welded to the root.
    torn = not is_whole(answer) and bool(meagre(answer.template, _surfaces(observation, answer)))
    framed = _framed(answer, observation, tracks, facing)
    torn = torn or (framed[1] is not None and bool(crossed_ends(observation, framed[0], framed[1])))
    held = held and not torn
    explained = held or (share >= EXPLAINED and not torn)
    contradicted = agreement < BELIEVED and not is_whole(answer)
    # Joints that are held while much of what is drawn is left over may be another machine's.
    strained = held and share < STRAINED and not is_whole(answer)
    judged: _Judged | None = None
    told_so: Answer | None = None
    if not held or contradicted or (strained and any(scores)):
        wide = look(CONTACT[-1])
        named = name_scores(tuple(s.part for s in wide.solids), plain, template)
        judged = _fused(answer, wide, named, plain, choices, edited, tracks, facing)
        _, same, spoken = agreed(answer, observation, judged.answer, wide)
        if held and judged.trust >= HEARD and same >= AGREED and spoken >= SPOKEN and any(named):
            # Two readings that agree are one: it is no other machine that the contacts found.
            strained, agreement, told_so, judged = False, max(agreement, judged.trust), judged.answer, None
    if judged is not None and (not explained or judged.goes_before(answer, held=held, named=any(named))):
        answer, frame, agreement = judged.answer, judged.frame, judged.trust
        observation, scores = wide, named
    else:
        answer, frame = framed
        named = name_scores(tuple(s.part for s in observation.solids), plain, template)
    rivals = {} if is_whole(answer) or answer.judged is not None else rivals_of(answer)
    added: frozenset[str] = frozenset()
    if answer.judged is None and agreement >= BELIEVED and not strained and not is_whole(answer):
        if told_so is not None:
            answer, *_ = agreed(answer, observation, told_so, wide)
        answer = without_misnamed(answer, observation, named)
        answer, number, added = with_named(answer, observation, named, frame)
        rivals = {number[c]: body for c, body in rivals.items()}
    low = undercut(observation, answer)
    propagation = Propagation(
        observation,
        answer,
        scores,
        frame.matrix[2, :3] if frame is not None else np.array([0.0, 0.0, 1.0]),
        never=too_low(observation, answer),
        doubts=fallen if answer.judged is None else {},
        rivals=rivals,
        suspects={}
        if answer.judged is not None
        else {
            **suspect_bodies(answer.solution, answer.template, _surfaces(observation, answer)),
            **(crossed_ends(observation, answer, frame) if frame is not None else {}),
            **dict.fromkeys(low, "what is carried reaches as low as its carrier: parts of one are the other's"),
            **(dict.fromkeys(answer.solution.body_of.values(), LEFT_OVER) if strained else {}),
            **dict.fromkeys(sorted(added), WORDS),
        },
    )
    places = with_couplers(propagation.run(), observation.solids, answer)
    places = with_rams(places, observation, answer, frame)
    places = among_strangers(places, observation.solids) if answer.judged is not None else places
    if told_so is not None:
        told_of = {wide.solids[i].part.id: what.body for i, what in (told_so.judged or {}).items()}
        places = otherwise(places, observation.solids, told_of)
    played = {place.body for place in places.values()} - added
    heeded = named if agreement >= BELIEVED else [{} for _ in observation.solids]
    places = maybe_unplayed(places, observation.solids, heeded, observation.wheels, answer.template, played)
    apart |= {observation.solids[i].part.id: metres for i, metres in propagation.apart.items()}
    by_id = {observation.solids[i].part.id: place for i, place in places.items()}
    whole = as_drawn(choose(template, answer.choices), set(answer.solution.body_of.values()))
    if tracks and frame is not None:
        solids = solids_of(_without(tracking, fittings))
        on_track = track_places(tracks, tracked, frame.matrix, whole)
        on_track = no_surer_than_frames(on_track, by_id, solids, whole.root)
        by_id |= on_tracks(by_id, on_track, solids, Touch(solids, answer.contact * observation.size)) | on_track
    if fittings:
        solids = solids_of(tracking)
        by_id |= sitting(by_id, fittings, solids, touch_of(tracking, answer.contact * observation.size))
    present = set(answer.solution.body_of.values())
    on_further = further_wheels(further, by_id, whole, present, frame.matrix if frame is not None else None)
    if further:
        solids = solids_of(tracking)
        touch = touch_of(tracking, answer.contact * observation.size)
        tubes = axle_tubes(further, on_further, by_id, solids, touch, whole)
        apart = {part: metres for part, metres in apart.items() if part not in tubes}
        by_id = {**by_id, **on_further.places, **tubes}
    by_id |= {copy: by_id[first] for copy, first in copies.items() if first in by_id}
    apart |= {copy: apart[first] for copy, first in copies.items() if first in apart}
    found = to_alignment(
        assembly,
        whole,
        answer,
        Labels(by_id, apart, bumpers, decisions),
        frame or MachineFrame(np.eye(4)),
        axes={**shown_axes(answer, observation), **on_further.axes},
        told=choices.keys(),
        remarks=[
            *told,
            *heard,
            # What reading the file found; the rest was of an earlier model.
            *(f for f in (edits.findings if edits is not None else ()) if f.code in ("ALN012", "ALN013")),
            *name_findings(agreement, BELIEVED, template.equipment_type),
            *sheet_findings(answer.structure, observation.cylinders, answer.template, specifications, answer.solution),
            *review_findings(
                observation.solids,
                answer,
                loose=propagation.loose,
                apart={part: metres for part, metres in apart.items() if part not in edited},
                played=frozenset(p.role for p in places.values()) | frozenset(edited.values()),
                settled=frozenset(edited),
                bumpers=bumpers,
            ),
        ],
    )
    found = doubted(found, assembly.parts)
    if edits is not None:
        found = replace(found, rules=edits.rules, joints=edits.joints, values=edits.values, machine=edits.machine)
        scored = name_scores(assembly.parts, every) if said.absent else []
        called = dict(zip((part.id for part in assembly.parts), scored, strict=False))
        against = unlikely(said, called, found, every, len(observation.cylinders)) if edits.machine else ()
        found = replace(found, findings=(*found.findings, *against))
    drawn_axles = as_drawn(whole, {p.body for p in found.parts if p.body is not None})
    aside = {*fittings, *on_further.places}
    found = _with_all_axes(found, _without(assembly, aside), drawn_axles, answer, observation, frame)
    score = judged.score if judged is not None and answer.judged is not None else None
    return Reading(found, single, alone, score)


def _with_all_axes(
    found: Alignment,
    assembly: Assembly,
    template: Template,
    answer: Answer,
    observation: Observation,
    frame: MachineFrame | None,
) -> Alignment:
    """The alignment with an estimate for every joint that the search did not find though both its bodies are there."""
    declared = _declared(found, assembly, template)
    known = _standing(found, answer, observation) | declared
    lent = _unplayed_axes(found, template, answer)
    sure = frame.matrix if frame is not None and not frame.doubts else None
    # Where contacts did not find the machine, what they take for a hinge without a pin may be none.
    turning = {j.name for j in template.joints if j.type == "revolute"} if answer.judged is not None else set()
    rough = {j: found.axes[j] for j in (known - declared) & turning if j in found.axes}
    searched = searched_axes(answer)
    pinned = {j: searched[j] for j in (known - declared) & turning if j in searched and j not in {*lent, *rough}}
    estimates = unfound_axes(
        solids_of(assembly),
        found.parts,
        template,
        found=known - lent.keys() - rough.keys() - pinned.keys(),
        size=observation.size,
        frame=sure,
        assembly=assembly,
        ways={j: way for j, (_, way) in searched.items() if j in known},
    )
    # A pin that would leave a cylinder without a lever is another hinge's.
    idle = without_lever(pinned, estimates, template, observation.size)
    found = _unpinned(found, idle, template)
    estimates = {j: e for j, e in estimates.items() if j in idle or j not in pinned}
    # Of two that say the same the search's is the more exact.
    same = {j for j, e in estimates.items() if j in lent and j in known and e.holds(*lent[j])}
    same |= {j for j, e in estimates.items() if j in rough and not e.beats(*rough[j])}
    estimates = {j: e for j, e in estimates.items() if j not in same}
    return replace(
        found,
        axes={**lent, **found.axes, **lines_of(estimates)},
        across=rough_axes(estimates, template, observation.size),
        findings=(*found.findings, *axis_findings(estimates, observation.size)),
    )


def _declared(found: Alignment, assembly: Assembly, template: Template) -> set[str]:
    """The joints between two bodies that the CAD file declares a joint of: no guess is better."""
    played = assembly.played({p.part: p.body for p in found.parts})
    pairs = {frozenset(played.get(b) for b in j.bodies) for j in assembly.joints if j.type != "fixed"}
    return {j.name for j in template.joints if frozenset(template.bodies_of(j)) in pairs}


def _unpinned(found: Alignment, joints: Collection[str], template: Template) -> Alignment:
    """The alignment in which the pins of these joints are no pins of theirs: they move with their bodies, and are
    listed for review."""
    roles = {pin_role(template.joint(j), template) for j in joints} - {None}
    pins = {p.part for p in found.parts if p.role in roles and p.source not in DECIDED}
    if not pins:
        return found
    words = "its joint would leave a cylinder without a lever: it is no pin of that"
    parts = tuple(
        replace(p, role=p.body, confidence=min(p.confidence, 0.5), reason=f"{p.reason}; but {words}")
        if p.part in pins
        else p
        for p in found.parts
    )
    return replace(found, parts=parts, to_review=tuple(dict.fromkeys((*found.to_review, *sorted(pins)))))


def _unplayed_axes(found: Alignment, template: Template, answer: Answer) -> dict[str, tuple[Vector, Vector]]:
    """Joint → the axis that the search has for it, for those on a pin that has another role than theirs, or none."""
    roles, hinges = {p.role for p in found.parts}, answer.structure.hinges
    wanted = {j.name for j in template.joints}
    return {
        j: line
        for j, line in searched_axes(answer).items()
        if j in wanted
        and hinges[answer.solution.hinge_of[j]].pins
        and pin_role(template.joint(j), template) not in roles
    }


def _standing(found: Alignment, answer: Answer, observation: Observation) -> set[str]:
    """The joints that the search found, of bodies that the alignment has where the search had them: a person's edits,
    names and what followed may have put others there."""
    body_of = {p.part: p.body for p in found.parts}
    structure, solution, template = answer.structure, answer.solution, answer.template
    clusters = {j: (structure.hinges[h].a, structure.hinges[h].b) for j, h in solution.hinge_of.items()}
    clusters |= {j: structure.slides[s][:2] for j, s in solution.slide_of.items()}

    def stands(cluster: int, bodies: set[str | None]) -> bool:
        members = sorted(structure.clusters[cluster].members)
        return sum(body_of.get(observation.solids[i].part.id) in bodies for i in members) > 0.5 * len(members)

    return {
        joint
        for joint, pair in clusters.items()
        if all(stands(c, {*template.bodies_of(template.joint(joint))}) for c in pair)
    }


def _without(assembly: Assembly, parts: Collection[str]) -> Assembly:
    """The assembly without the parts of these ids; the same object for the same ids."""
    return _left(assembly, frozenset(parts))


@remembered
def _left(assembly: Assembly, parts: frozenset[str]) -> Assembly:
    return replace(assembly, parts=tuple(p for p in assembly.parts if p.id not in parts))


@dataclass(frozen=True, eq=False)
class _Judged:
    """What names, shapes, places and contacts say together: the answer; the machine's frame, that of its joints, or as
    the machine stands where these leave it open; how far the names are to be believed (0 to 1); what the judge makes of
    it, and of what the contacts alone say."""

    answer: Answer
    frame: MachineFrame | None
    trust: float
    score: float
    contacts: float

    def goes_before(self, contacts: Answer, *, held: bool, named: bool) -> bool:
        """Whether it goes before contacts that explain what is drawn. Where these found most of the type's joints
        (`held`), names are heard if they explain who is beside whom; where they found a part of a machine, a clearly
        better reading is, and where nothing is `named` one that finds more joints for that, or is much better."""
        if held:
            return self.trust >= HEARD
        more = named or len(found_joints(self.answer)) > len(found_joints(contacts))
        return (more and self.score - self.contacts >= BETTER) or (
            not named and self.contacts < FAR_BETTER * self.score
        )


def _framed(
    answer: Answer, observation: Observation, tracks: list[Track], facing: Facing
) -> tuple[Answer, MachineFrame | None]:
    """The machine's frame, and the answer solved again with what that says of left and right; with a root in any case.
    No frame where the model has no solids."""
    solids, structure, template, solution = observation.solids, answer.structure, answer.template, answer.solution
    frame = machine_frame(solids, structure, solution, observation.wheels, template, tracks, facing) if solids else None
    if frame is not None and solution.body_of:
        sided = side_weights(solids, structure, template, solution, frame, answer.unary)
        if sided != answer.unary:
            # Where several bodies could as well be one, it stays what it was.
            stays = {(c, b) for c, b in solution.body_of.items() if twin_role(b) is None}
            sided = {**sided, **{key: sided.get(key, 0) + 1 for key in stays}}
            told = solve(structure, template, unary=sided, barred=answer.barred)
            if told is not None and told.body_of:
                more = len(stays & set(told.body_of.items()))
                solution = replace(told, score=told.score - more, objective=told.objective - more)
            # What spoke against a person's word is not solved away by obeying it.
            against = frame.against
            frame = machine_frame(solids, structure, solution, observation.wheels, template, tracks, facing)
            frame = replace(frame, against=against or frame.against)
    if frame is not None and not frame.told and ends_untold(template, solution, answer.unary):
        frame = replace(frame, doubts=(*frame.doubts, "front and rear are built alike, and no name tells them apart"))
    up = frame.matrix[2, :3] if frame is not None else None
    return replace(answer, solution=with_root(solution, structure, solids, template, up)), frame


def _fused(
    answer: Answer,
    observation: Observation,
    scores: list[dict[str, float]],
    template: Template,
    choices: Mapping[str, str],
    edited: Mapping[str, str],
    tracks: list[Track],
    facing: Facing,
) -> _Judged:
    """What names, shapes, places and contacts say together."""
    solids = observation.solids
    if not solids:
        return _Judged(answer, None, 1.0, 0.0, 0.0)
    told = {s.index: template.body_of(edited[s.part.id]) for s in solids if template.knows(edited.get(s.part.id, ""))}
    said = {i: body for i, body in told.items() if body is not None}
    found = fused(observation, template, variants_of(template, choices), scores, answer, said, facing)
    answer, solution = found.answer, found.answer.solution
    frame = machine_frame(solids, answer.structure, solution, observation.wheels, answer.template, tracks, facing)
    if frame.doubts:
        read = "it is read off how the machine stands"
        frame = MachineFrame(found.stance.matrix(), () if found.stance.told else (read,), told=found.stance.told)
    elif found.ahead < AS_GOOD:
        frame = replace(frame, doubts=("its front could as well be behind",))
    answer = replace(answer, solution=with_root(solution, answer.structure, solids, answer.template))
    return _Judged(answer, frame, found.trust, found.score, found.contacts)


def _surfaces(observation: Observation, answer: Answer) -> dict[str, float]:
    """Body → the surface of its cluster, m²."""
    clusters = answer.structure.clusters
    return {
        b: sum(observation.solids[i].surface for i in sorted(clusters[c].members))
        for c, b in answer.solution.body_of.items()
    }
