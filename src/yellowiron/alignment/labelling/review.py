"""What a person should know of an answer that looks whole: a cylinder to one side, parts that could turn but have no
body, parts that stand apart, wheels without tyres."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.features.wheels import Wheel
from yellowiron.alignment.structure.clusters import Structure, reaches_out
from yellowiron.model.finding import Finding
from yellowiron.model.template import Template

STURDY = 0.7
"""Pins of at least this share of the thinnest of the machine's are pivots, not those of a door."""
RIM = 0.65
"""A ring whose next inner part has this share of its radius is a rim: a tyre is thicker."""
SECOND = 0.2
"""So many parts that stand apart, for each of the machine's own, are a machine of their own."""
SOME = 6


def solids_without_a_body(solids: tuple[Solid, ...], structure: Structure, solution: Solution) -> frozenset[int]:
    """Solids of clusters that no body of the template is left for, though they could move: halves of a hydraulic
    cylinder, and what hangs far out from a pin as sturdy as the machine's own."""
    pivots = [structure.axes[structure.hinges[h].axis].radius for h in solution.hinge_of.values()]
    least = STURDY * min((r for r in pivots if r > 0), default=0.0)
    axes: dict[int, set[int]] = {}
    for hinge in structure.hinges:
        for c in (hinge.a, hinge.b):
            axes.setdefault(c, set()).add(hinge.axis)
    found: set[int] = set()
    for c, cluster in enumerate(structure.clusters):
        if c in solution.body_of or cluster.kind == "wheel":
            continue
        on = [structure.axes[k] for k in sorted(axes.get(c, set()))]
        if cluster.kind or any(axis.radius >= least and reaches_out(solids, cluster.members, axis) for axis in on):
            found |= cluster.members
    return frozenset(found)


def next_bodies(structure: Structure, template: Template, solution: Solution) -> dict[int, tuple[str | None, float]]:
    """Cluster → the body it could best be instead, all others as they are, and by how large a share fewer of that
    body's joints hold than of its own (1: none holds; 0: as many; the joints' shares are compared)."""
    pairs = {frozenset((h.a, h.b)) for h in structure.hinges}
    slides = {frozenset(s[:2]) for s in structure.slides}
    cluster_of = {b: c for c, b in solution.body_of.items()}
    kinds = {r.name: r.kind if r.kind in ("barrel", "rod", "wheel") else "" for r in template.roles if r.rigid}
    ends: dict[str, list[tuple[str, str]]] = {b: [] for b in kinds}
    for joint in template.joints:
        first, second = template.bodies_of(joint)
        if first in ends and second in ends and first != second:
            ends[str(first)].append((joint.type, str(second)))
            ends[str(second)].append((joint.type, str(first)))

    def share(cluster: int, body: str) -> float:
        held = 0
        for kind, other in ends[body]:
            there = cluster_of.get(other)
            known = slides if kind == "prismatic" else pairs
            held += there is not None and there != cluster and frozenset((cluster, there)) in known
        return held / len(ends[body]) if ends[body] else 0.0

    found: dict[int, tuple[str | None, float]] = {}
    for cluster, body in sorted(solution.body_of.items()):
        like = [b for b, kind in kinds.items() if kind == kinds[body] and b != body]
        best = max(like, key=lambda b: (share(cluster, b), b), default=None)
        rival = share(cluster, best) if best is not None else 0.0
        found[cluster] = (best if rival > 0 else None, max(0.0, share(cluster, body) - rival))
    return found


def has_tyre(wheel: Wheel, solids: tuple[Solid, ...]) -> bool:
    """True if the outermost ring of a wheel is thick enough for a tyre, or is all there is."""
    inner = max((solids[i].reach for i in wheel.members if i != wheel.tyre), default=0.0)
    return inner < RIM * wheel.radius


def review_findings(
    solids: Sequence[Solid],
    answer: Answer,
    *,
    loose: frozenset[int],
    apart: Mapping[str, float],
    played: frozenset[str],
    settled: frozenset[str],
    bumpers: Collection[str],
) -> list[Finding]:
    """The remarks: ALN007 (`loose` solids), ALN008 (the answer's barrels to one side), ALN009 and ALN010 (`apart`: part
    id → metres from the rest), ALN011, ALN017 (`bumpers`: ids of collision meshes). `played` are the roles that parts
    have; `settled` part ids are a person's, of which nothing is said."""
    return [
        *_without_a_body([solids[i].part.id for i in sorted(loose)], {*settled, *apart}, answer.template),
        *_to_one_side(answer.sided),
        *_standing_apart(apart, len(solids), answer.template),
        *_without_tyres(answer, played),
        *_bumping(sorted(bumpers), answer.template),
    ]


def _bumping(parts: Sequence[str], template: Template) -> Iterator[Finding]:
    if parts:
        text = f"{len(parts)} parts are collision meshes by their names, and left out: {_some(parts)}"
        hint = "The machine gets colliders of its own; set a part's role in alignment.json if it is one."
        yield Finding("ALN017", "info", template.equipment_type, text, hint)


def _without_a_body(loose: Sequence[str], settled: set[str], template: Template) -> Iterator[Finding]:
    left = [part for part in loose if part not in settled]
    if left:
        text = f"No body is left for {len(left)} parts that could move on their own: {_some(left)}"
        hint = "Set their roles in alignment.json, choose another variant, or complete the hydraulic cylinder in CAD."
        yield Finding("ALN007", "warning", template.equipment_type, text, hint)


def _to_one_side(barrels: Sequence[str]) -> Iterator[Finding]:
    for barrel in barrels:
        text = f"{barrel} is to one side of the machine, where the variant has one in the middle"
        hint = "Choose the variant with a left and a right one, or check whether the CAD model lacks the other."
        yield Finding("ALN008", "warning", barrel, text, hint)


def _standing_apart(apart: Mapping[str, float], count: int, template: Template) -> Iterator[Finding]:
    where = template.equipment_type
    hint = "They are left out of the machine; set their role in alignment.json (null: left out)."
    under = sorted(part for part, metres in apart.items() if not metres)
    if under:
        text = f"The whole machine stands on what is taken for the ground: {_some(under)}"
        yield Finding("ALN009", "warning", where, text, hint)
    apart = {part: metres for part, metres in apart.items() if metres}
    if apart:
        least = min(apart.values())
        text = f"{len(apart)} parts stand {least:.3g} m or more from the machine: {_some(sorted(apart))}"
        yield Finding("ALN009", "warning", where, text, hint)
    if len(apart) > SECOND * count:
        text = f"The CAD model seems to hold more than one machine: {len(apart)} parts stand apart"
        hint = "Hand in one machine a file; the parts of the others are left out."
        yield Finding("ALN010", "warning", where, text, hint)


def _without_tyres(answer: Answer, played: frozenset[str]) -> Iterator[Finding]:
    tyres = {r.name for r in answer.template.roles if r.kind == "tyre"}
    rolling = [c for c in answer.solution.body_of if answer.structure.clusters[c].kind == "wheel"]
    if tyres and rolling and not tyres & played:
        text = "The wheels have no tyres: the ground is taken under the rims"
        hint = "Check that the CAD model has the tyres."
        yield Finding("ALN011", "warning", answer.template.equipment_type, text, hint)


def name_findings(agreement: float, believed: float, where: str) -> list[Finding]:
    """ALN015 for names that agree with the joints (`weights.name_agreement`) less than is `believed`."""
    if agreement >= believed:
        return []
    text = f"The parts' names contradict the joints (they agree to {agreement:.0%}, chance taken off): they have no say"
    return [Finding("ALN015", "info", where, text, "Check the names if they should be right, or the equipment type.")]


def _some(names: Sequence[str]) -> str:
    return ", ".join(names[:SOME]) + (", …" if len(names) > SOME else "")
