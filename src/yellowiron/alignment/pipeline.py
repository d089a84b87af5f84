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
10. the machine's frame, then left and right
11. pins, hardware and all the rest
12. what a person said before
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np

from yellowiron.alignment.assignment.answer import Answer, is_whole, rivals_of
from yellowiron.alignment.assignment.cp_sat import solve
from yellowiron.alignment.assignment.machine_frame import MachineFrame, machine_frame
from yellowiron.alignment.assignment.root_fallback import with_root
from yellowiron.alignment.assignment.search import BELIEVED, Search
from yellowiron.alignment.assignment.sheet_weights import sheet_findings
from yellowiron.alignment.assignment.weights import side_weights
from yellowiron.alignment.features.copies import copies_of
from yellowiron.alignment.features.distance import Touch
from yellowiron.alignment.features.separate_parts import separate_parts
from yellowiron.alignment.features.solids import solids_of
from yellowiron.alignment.features.telescopes import Nest
from yellowiron.alignment.features.tracks import Track, tracks_of
from yellowiron.alignment.labelling.coupler import with_couplers
from yellowiron.alignment.labelling.propagation import Propagation
from yellowiron.alignment.labelling.result import Labels, to_alignment
from yellowiron.alignment.labelling.review import name_findings, review_findings
from yellowiron.alignment.labelling.suspects import suspect_bodies
from yellowiron.alignment.labelling.track_places import on_tracks, track_places, without_tracks
from yellowiron.alignment.structure.observation import Observation, observe
from yellowiron.model.alignment import Alignment, Vector
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import AlignmentError
from yellowiron.model.geometry import Floats
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template, choose
from yellowiron.support.vectors import triple


def align(
    assembly: Assembly,
    template: Template,
    specifications: Specifications,
    *,
    edits: Alignment | None = None,
    choices: Mapping[str, str] | None = None,
) -> Alignment:
    """Roles for the parts of a CAD model.

    `template` may carry variants: those `decided_by` geometry are tried and the best is taken, unless `choices` fixes
    them. `edits` is an earlier alignment, as a person left it (`read_alignment`): its parts with source `edited` keep
    their role, and so do those with source `data`, which a document of the user's placed. `AlignmentError` for an
    assembly without parts, for an unknown choice, and for edits that name parts or roles that do not exist. The
    result does not depend on the order, names (beyond their weight) or frame of the parts.
    """
    if not assembly.parts:
        raise AlignmentError(
            "The CAD model has no parts", where=assembly.name, hint="Check that the file holds solids."
        )
    edited = _edited(assembly, template, edits)
    copies = {copy: first for copy, first in copies_of(assembly).items() if copy not in edited}
    single = _without(assembly, copies)
    apart = separate_parts(single, [part for part, role in edited.items() if role])
    tracking = _without(single, apart)
    tracked, tracks = _tracked(tracking, template)
    machine = _without(tracking, set(tracked.values()))
    plain = without_tracks(template)
    up = _upright(tracks)
    search = Search(
        lambda contact: replace(observe(machine, plain, contact), up=up), plain, specifications, choices or {}, edited
    )
    answer, observation, scores = search.run()
    answer, frame = _framed(answer, observation, tracks)
    propagation = Propagation(
        observation,
        answer,
        scores,
        frame.matrix[2, :3] if frame is not None else np.array([0.0, 0.0, 1.0]),
        rivals={} if is_whole(answer) else rivals_of(answer),
        suspects=suspect_bodies(answer.solution, answer.template, _surfaces(observation, answer)),
    )
    places = with_couplers(propagation.run(), observation.solids, answer)
    apart |= {observation.solids[i].part.id: metres for i, metres in propagation.apart.items()}
    by_id = {observation.solids[i].part.id: place for i, place in places.items()}
    whole = choose(template, answer.choices)
    if tracks and frame is not None:
        rows = track_places(tracks, tracked, frame.matrix, whole)
        solids = solids_of(tracking)
        by_id |= on_tracks(by_id, rows, solids, Touch(solids, answer.contact * observation.size)) | rows
    by_id |= {copy: by_id[first] for copy, first in copies.items() if first in by_id}
    apart |= {copy: apart[first] for copy, first in copies.items() if first in apart}
    documents = {item.part: item.reason for item in edits.parts if item.source == "data"} if edits is not None else {}
    return to_alignment(
        assembly,
        whole,
        answer,
        Labels(by_id, apart, edited, documents),
        frame or MachineFrame(np.eye(4)),
        axes=_axes(answer, observation),
        remarks=[
            # What reading the file found; the rest was of an earlier model.
            *(f for f in (edits.findings if edits is not None else ()) if f.code in ("ALN012", "ALN013")),
            *name_findings(search.agreement, BELIEVED, template.equipment_type),
            *sheet_findings(answer.structure, observation.cylinders, answer.template, specifications, answer.solution),
            *review_findings(
                observation.solids,
                answer,
                loose=propagation.loose,
                apart={part: metres for part, metres in apart.items() if part not in edited},
                played=frozenset(p.role for p in places.values()) | frozenset(edited.values()),
                settled=frozenset(edited),
            ),
        ],
    )


def _without(assembly: Assembly, parts: Collection[str]) -> Assembly:
    """The assembly without the parts of these ids."""
    return replace(assembly, parts=tuple(p for p in assembly.parts if p.id not in parts))


def _framed(answer: Answer, observation: Observation, tracks: list[Track]) -> tuple[Answer, MachineFrame | None]:
    """The machine's frame, and the answer solved again with what that says of left and right; with a root in any case.
    No frame where the model has no solids."""
    solids, structure, template, solution = observation.solids, answer.structure, answer.template, answer.solution
    frame = machine_frame(solids, structure, solution, observation.wheels, template, tracks) if solids else None
    if frame is not None and solution.body_of:
        sided = side_weights(solids, structure, template, solution, frame, answer.unary)
        if sided != answer.unary:
            solution = solve(structure, template, unary=sided, barred=answer.barred) or solution
            frame = machine_frame(solids, structure, solution, observation.wheels, template, tracks)
    return replace(answer, solution=with_root(solution, structure, solids, template)), frame


def _surfaces(observation: Observation, answer: Answer) -> dict[str, float]:
    """Body → the surface of its cluster, m²."""
    clusters = answer.structure.clusters
    return {
        b: sum(observation.solids[i].surface for i in sorted(clusters[c].members))
        for c, b in answer.solution.body_of.items()
    }


def _axes(answer: Answer, observation: Observation) -> dict[str, tuple[Vector, Vector]]:
    """Joint → its axis, for the joints that no pin is drawn for and that no wheel turns on, for the slides whose rod is
    not drawn in its barrel, and for sections in each other."""
    structure, cylinders = answer.structure, observation.cylinders
    found = {}
    for joint, slide in sorted(answer.solution.slide_of.items()):
        number = structure.slides[slide][2]
        drawn = cylinders[number] if number < len(cylinders) else observation.nests[number - len(cylinders)]
        if isinstance(drawn, Nest) or drawn.apart:
            found[joint] = (triple(drawn.origin), triple(drawn.direction))
    for joint, number in sorted(answer.solution.hinge_of.items()):
        hinge = structure.hinges[number]
        if not hinge.pins and not any(structure.clusters[c].kind == "wheel" for c in (hinge.a, hinge.b)):
            axis = structure.axes[hinge.axis]
            found[joint] = (triple(axis.origin), triple(axis.direction))
    return found


def _upright(tracks: list[Track]) -> Floats | None:
    """The direction across the tracks and their length."""
    return np.asarray(np.cross(tracks[0].axis, tracks[0].along), dtype=np.float64) if tracks else None


def _tracked(assembly: Assembly, template: Template) -> tuple[dict[int, str], list[Track]]:
    """The parts of tracks, solid → id, and the tracks, where the template has any."""
    if not any(r.kind == "shoe" for r in template.roles):
        return {}, []
    solids = solids_of(assembly)
    tracks = tracks_of(solids)
    inside = {i for t in tracks for group in (*t.shoes, *(w.members for w in t.wheels)) for i in group}
    return {i: solids[i].part.id for i in sorted(inside)}, tracks


def _edited(assembly: Assembly, template: Template, edits: Alignment | None) -> dict[str, str]:
    """Part id → role, for the parts a person set, in the alignment or in a document of theirs."""
    if edits is None:
        return {}
    parts = {p.id for p in assembly.parts}
    found = {}
    for item in edits.parts:
        if item.source not in ("edited", "data"):
            continue
        if item.part not in parts:
            raise AlignmentError(
                f"The alignment names a part that is not in the CAD model: '{item.part}'",
                where=item.part,
                hint="Remove that entry, or align the CAD model it was made for.",
            )
        if item.role is not None and not template.knows(item.role):
            raise AlignmentError(
                f"'{item.role}' is no role of the template {template.equipment_type}",
                where=item.part,
                hint="`yellowiron templates show TYPE` lists the roles.",
            )
        found[item.part] = item.role or ""
    return found
