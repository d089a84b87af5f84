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

import functools
import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.align.clusters import Structure, loose_ends, structure_of
from yellowiron.align.doubts import doubts, one_sided
from yellowiron.align.frame import MachineFrame, machine_frame
from yellowiron.align.islands import islands
from yellowiron.align.names import name_scores
from yellowiron.align.report import reported
from yellowiron.align.seen import CONTACT, Seen, see, slewing_joints
from yellowiron.align.sheet import sheet_findings, sheet_weights
from yellowiron.align.solids import solids_of
from yellowiron.align.solve import MISSING_WEIGHT, Solution, solve
from yellowiron.align.spread import Spreader
from yellowiron.align.tracks import Track, track_places, tracks_of, without_tracks
from yellowiron.align.weights import Weights, name_weights, side_weights, size_weights
from yellowiron.model.alignment import Alignment, Vector
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import AlignmentError
from yellowiron.model.geometry import Floats
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template, choose

FORBIDDEN = 10_000
"""What an assignment loses that is tried without."""
MARGIN = 20
"""An assignment is doubtful if the best without it scores this little less: less than a name is worth."""
UPRIGHT = 0.98
"""A line whose cosine to the upright is less is not upright."""
SIDED_WEIGHT = 4 * MISSING_WEIGHT
"""What a variant loses for a cylinder that stands to one side where it should be in the middle."""


@dataclass(frozen=True, eq=False)
class _Answer:
    """One reading of the welds and one variant of the template, solved."""

    structure: Structure
    choices: dict[str, str]
    template: Template
    solution: Solution
    unary: Weights
    sided: tuple[str, ...]
    barred: frozenset[tuple[str, int]]

    @property
    def score(self) -> int:
        """What variants and readings are compared by: a cylinder at the wrong place is worse than a missing one."""
        return self.solution.score - SIDED_WEIGHT * len(self.sided)


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
    apart = islands(assembly, [part for part, role in edited.items() if role])
    machine = replace(assembly, parts=tuple(p for p in assembly.parts if p.id not in apart))
    tracked, tracks = _tracked(machine, template)
    of_tracks = set(tracked.values())
    machine = replace(machine, parts=tuple(p for p in machine.parts if p.id not in of_tracks))
    plain = without_tracks(template)
    rungs = []
    for contact in CONTACT:
        seen = replace(see(machine, plain, contact), up=_upright(tracks))
        scores = name_scores(tuple(s.part for s in seen.solids), plain)
        rungs.append((_best(seen, plain, specifications, choices or {}, scores, edited), seen, scores))
        if _whole(rungs[-1][0]):
            break
    answer, seen, scores = max(rungs, key=lambda rung: (_whole(rung[0]), rung[0].score))
    structure, resolved, solution = answer.structure, answer.template, answer.solution
    frame = machine_frame(seen.solids, structure, solution, seen.wheels, resolved, tracks) if seen.solids else None
    if frame is not None and solution.body_of:
        sided = side_weights(seen.solids, structure, resolved, solution, frame, answer.unary)
        if sided != answer.unary:
            solution = solve(structure, resolved, unary=sided, barred=answer.barred)
            frame = machine_frame(seen.solids, structure, solution, seen.wheels, resolved, tracks)
    answer = replace(answer, solution=solution)
    rivals = {} if _whole(answer) else _rivals(answer)
    spreader = Spreader(
        seen.solids,
        structure,
        solution,
        resolved,
        seen.flats,
        seen.near,
        seen.touch,
        scores,
        seen.size,
        frame.matrix[2, :3] if frame is not None else np.array([0.0, 0.0, 1.0]),
        rivals,
    )
    places = spreader.run(seen.wheels)
    apart |= {seen.solids[i].part.id: metres for i, metres in spreader.apart.items()}
    by_id = {seen.solids[i].part.id: place for i, place in places.items()}
    whole = choose(template, answer.choices)
    by_id |= track_places(tracks, tracked, frame.matrix, whole) if frame is not None else {}
    documents = {item.part: item.reason for item in edits.parts if item.source == "data"} if edits is not None else {}
    return reported(
        assembly,
        whole,
        solution,
        by_id,
        edited,
        answer.choices,
        frame or MachineFrame(np.eye(4)),
        documents=documents,
        apart=apart,
        axes=_axes(structure, solution),
        remarks=[
            *sheet_findings(structure, seen.rams, resolved, specifications, solution),
            *doubts(
                seen.solids,
                structure,
                solution,
                resolved,
                answer.sided,
                spreader.loose,
                {part: metres for part, metres in apart.items() if part not in edited},
                frozenset(p.role for p in places.values()) | frozenset(edited.values()),
                frozenset(edited),
            ),
        ],
    )


def _rivals(answer: _Answer) -> dict[int, str | None]:
    """Clusters that could as well be another body (or none), and which: where a machine is not whole, its joints alone
    may not tell."""
    found = {}
    solution = answer.solution
    for cluster, body in sorted(solution.body_of.items()):
        without = {**answer.unary, (cluster, body): -FORBIDDEN}
        other = solve(answer.structure, answer.template, unary=without, barred=answer.barred)
        if solution.score - other.score < MARGIN and other.body_of.get(cluster) != body:
            found[cluster] = other.body_of.get(cluster)
    return found


def _axes(structure: Structure, solution: Solution) -> dict[str, tuple[Vector, Vector]]:
    """Joint → its axis, for the joints that no pin is drawn for and that no wheel turns on."""
    found = {}
    for joint, number in sorted(solution.hinge_of.items()):
        hinge = structure.hinges[number]
        if not hinge.pins and not any(structure.clusters[c].kind == "wheel" for c in (hinge.a, hinge.b)):
            line = structure.lines[hinge.line]
            found[joint] = (_vector(line.origin), _vector(line.direction))
    return found


def _vector(values: Floats) -> Vector:
    x, y, z = (float(v) for v in values)
    return (x, y, z)


def _best(
    seen: Seen,
    template: Template,
    specifications: Specifications,
    choices: Mapping[str, str],
    scores: list[dict[str, float]],
    edited: Mapping[str, str],
) -> _Answer:
    """The reading of the welds, and the variant, that the template fits best; the first that fits wholly is taken."""
    best: _Answer | None = None
    for structure in _structures(seen, template):
        for group in _by_cylinders(_variants(template, choices), template, len(structure.slides)):
            for chosen in group:
                resolved = choose(template, chosen)
                unary = name_weights(seen.solids, structure, resolved, scores, edited)
                for more in (
                    sheet_weights(structure, seen.rams, resolved, specifications),
                    size_weights(seen.solids, structure, resolved),
                ):
                    for key, weight in more.items():
                        unary[key] = unary.get(key, 0) + weight
                barred = _barred(structure, resolved, seen.up)
                solution = solve(structure, resolved, unary=unary, barred=barred)
                sided = one_sided(seen.solids, structure, solution, seen.rams, template, resolved)
                answer = _Answer(structure, chosen, resolved, solution, unary, sided, barred)
                if best is None or (_whole(answer), answer.score) > (_whole(best), best.score):
                    best = answer
            if best is not None and _whole(best) and not edited:
                break
        if best is not None and _whole(best):
            break
    assert best is not None
    return best


def _by_cylinders(variants: list[dict[str, str]], template: Template, drawn: int) -> list[list[dict[str, str]]]:
    """The variants in groups: first those with as many hydraulic cylinders as are drawn. If one of these fits wholly,
    no variant with fewer or more can score as high."""
    groups: dict[int, list[dict[str, str]]] = {}
    for chosen in variants:
        count = sum(1 for r in choose(template, chosen).roles if r.rigid and r.kind == "barrel")
        groups.setdefault(abs(count - drawn), []).append(chosen)
    return [groups[apart] for apart in sorted(groups)]


def _structures(seen: Seen, template: Template) -> Iterator[Structure]:
    """Readings of the welds, likeliest first: flat contact alone, unless that leaves far more pieces than bodies; then
    also what touches; both first without, then with the welds that lock a pin; each first with wide round things fast
    in their bores, then turning in them. None twice."""
    if not seen.evidence:
        yield Structure()
        return
    leaves = _has_leaves(template)
    read = functools.cache(functools.partial(structure_of, leaves=leaves))
    bodies = sum(1 for r in choose(template, {}).roles if r.rigid)
    broken = loose_ends(read(seen.evidence[0], weak=False, careful=True)) > 1.3 * bodies + 4
    known = set()
    for careful in (True, False):
        for weak in (broken, not broken):
            for evidence in seen.evidence:
                structure = read(evidence, weak=weak, careful=careful)
                if (key := (structure.clusters, structure.hinges, structure.slides)) not in known:
                    known.add(key)
                    yield structure


def _whole(answer: _Answer) -> bool:
    """True where every body is played and every joint found, each at a place it may have, and no hydraulic cylinder is
    left over."""
    found = {*answer.solution.hinge_of, *answer.solution.slide_of}
    joints = {j.name for j in answer.template.joints if j.type in ("revolute", "prismatic")}
    bodies = {r.name for r in answer.template.roles if r.rigid and not r.optional}
    rams = {c for slide in answer.structure.slides for c in slide[:2]}
    played = answer.solution.body_of
    return not answer.sided and joints <= found and bodies <= set(played.values()) and rams <= set(played)


def _upright(tracks: list[Track]) -> Floats | None:
    """The direction across the tracks and their length."""
    return np.asarray(np.cross(tracks[0].axis, tracks[0].along), dtype=np.float64) if tracks else None


def _barred(structure: Structure, template: Template, up: Floats | None) -> frozenset[tuple[str, int]]:
    """A machine slews about the upright: the hinges that lie otherwise are none of its slewing joints."""
    if up is None:
        return frozenset()
    lying = [
        k
        for k, hinge in enumerate(structure.hinges)
        if abs(float(structure.lines[hinge.line].direction @ up)) < UPRIGHT
    ]
    return frozenset((name, k) for name in slewing_joints(template) for k in lying)


def _tracked(assembly: Assembly, template: Template) -> tuple[dict[int, str], list[Track]]:
    """The parts of tracks, solid → id, and the tracks, where the template has any."""
    if not any(r.kind == "shoe" for r in template.roles):
        return {}, []
    solids = solids_of(assembly)
    tracks = tracks_of(solids)
    inside = {i for t in tracks for group in (*t.shoes, *(w.members for w in t.wheels)) for i in group}
    return {i: solids[i].part.id for i in sorted(inside)}, tracks


def _has_leaves(template: Template) -> bool:
    """True if a body other than a wheel hangs on a single joint."""
    degree: dict[str, int] = {r.name: 0 for r in template.roles if r.rigid}
    for joint in template.joints:
        for body in template.bodies_of(joint):
            if body is not None:
                degree[body] += 1
    kinds = {r.name: r.kind for r in template.roles}
    return any(n == 1 and kinds[b] != "wheel" and b != template.root for b, n in degree.items())


def _variants(template: Template, choices: Mapping[str, str]) -> list[dict[str, str]]:
    """Every combination of the choices that geometry decides; what `choices` fixes is fixed."""
    known = {v.name: v for v in template.variants}
    for name, value in choices.items():
        if name in known and value not in known[name].choices:
            raise AlignmentError(
                f"'{value}' is no choice of {name}",
                where=template.equipment_type,
                hint=f"Choose one of: {', '.join(known[name].choices)}.",
            )
    fixed = {n: v for n, v in choices.items() if n in known}
    open_ones = [v for v in template.variants if v.decided_by == "geometry" and v.name not in fixed]
    ordered = [[v.default, *(c for c in v.choices if c != v.default)] for v in open_ones]
    return [
        {**fixed, **dict(zip((v.name for v in open_ones), combination, strict=True))}
        for combination in itertools.product(*ordered)
    ]


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
