"""The alignment as a value: every part's role in CAD order, what is missing, what is doubtful."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from yellowiron.alignment.assignment.answer import Answer, is_whole
from yellowiron.alignment.assignment.machine_frame import MachineFrame
from yellowiron.alignment.files.decisions import Decision, doubts
from yellowiron.alignment.labelling.confidence import REVIEW, grounds, probability
from yellowiron.alignment.labelling.place import Place, pin_role
from yellowiron.alignment.tolerances import CONTACT
from yellowiron.model.alignment import Alignment, PartAssignment, Vector
from yellowiron.model.assembly import Assembly
from yellowiron.model.finding import Finding
from yellowiron.model.rows import count_members
from yellowiron.model.template import Template

APART = 0.6
"""Confidence that a part which stands apart is no part of the machine: one remark speaks for all of them."""
MOSTLY = 0.5
"""Where contacts leave more than this share of the surface in doubt, they are not sure of the rest either."""
LEFT_OUT = 0.1
"""What stands apart is for review where it has more than this share of the surface: it may be the machine's own."""
CLEARLY = 0.95
"""From this probability on it is told that a person decided otherwise."""


@dataclass(frozen=True, eq=False)
class Labels:
    """What is known of the parts, by part id: their `places`; metres from the rest of those that stand `apart` and are
    left out; those that are only collision meshes (`bumpers`); and what was `decided`, which wins."""

    places: Mapping[str, Place]
    apart: Mapping[str, float]
    bumpers: Collection[str]
    decided: Mapping[str, Decision]


def to_alignment(
    assembly: Assembly,
    template: Template,
    answer: Answer,
    labels: Labels,
    frame: MachineFrame,
    *,
    axes: Mapping[str, tuple[Vector, Vector]],
    told: Collection[str],
    remarks: Sequence[Finding],
) -> Alignment:
    """The alignment. `template` has the answer's choices, with its tracks; `axes`: the alignment's; `told`: the
    variants that a person decided; `remarks`: further findings."""
    whole, rung = is_whole(answer), CONTACT.index(answer.contact)
    parts = [_assignment(part.id, template, labels, whole=whole, rung=rung) for part in assembly.parts]
    doubted = {p.id for p in assembly.parts if _is_doubted(p.id, labels)}
    if answer.judged is None and _share(doubted, assembly) > MOSTLY:
        # What hangs on bodies that are in doubt is in doubt itself.
        doubted |= {p.id for p in assembly.parts if p.id in labels.places and p.id not in labels.decided}
    beside = {part for part, metres in labels.apart.items() if metres and part not in labels.decided}
    if _share(beside, assembly) > LEFT_OUT:
        doubted |= beside
    played = {p.role for p in parts} | {p.body for p in parts}
    missing = tuple(r.name for r in template.roles if is_required(r.name, template) and r.name not in played)
    doubtful = tuple(p.part for p in sorted(parts, key=lambda p: p.confidence) if p.part in doubted)
    against = doubts(labels.decided, _against(labels, whole=whole, rung=rung))
    as_good = {name: others for name, others in answer.open_choices.items() if name not in told}
    findings = (*_findings(template, answer, missing, frame, labels.decided, as_good), *against, *remarks)
    return Alignment(
        template.equipment_type,
        frame.matrix,
        tuple(parts),
        dict(answer.choices),
        missing,
        (*missing, *doubtful),
        findings,
        count_members((p.role for p in parts), template),
        dict(axes),
        open_choices=as_good,
        facing_doubt=frame.facing_doubt,
    )


def _assignment(part: str, template: Template, labels: Labels, *, whole: bool, rung: int) -> PartAssignment:
    """The role of a part: a person's, none for one that stands apart, else that of its place. `whole`, `rung`: see
    `confidence.grounds`."""
    place = labels.places.get(part)
    if part in labels.decided:
        decision = labels.decided[part]
        said = decision.role
        body = template.body_of(said) if said is not None and template.knows(said) else None
        before = place.role if place is not None and place.role != said else None
        return PartAssignment(
            part, said, body, 1.0, decision.reason, decision.source, before, signature=decision.signature
        )
    if part in labels.apart:
        metres = labels.apart[part]
        words = f"stands {metres:.3g} m from every part of the machine" if metres else "lies under the whole machine"
        return PartAssignment(part, None, None, APART, words)
    if part in labels.bumpers:
        return PartAssignment(part, None, None, APART, "a collision mesh, by its name: no part of the machine")
    if place is None:
        return PartAssignment(part, None, None, 0.0, "nothing speaks for any role")
    evidence = grounds(place, whole=whole, rung=rung)
    return PartAssignment(
        part, place.role, place.body, round(probability(evidence), 3), place.reason,
        "name" if place.by_name else "solved", place.runner_up, evidence,
    )  # fmt: skip


def _share(parts: Collection[str], assembly: Assembly) -> float:
    """The share of a model's surface that some of its parts have."""
    areas = {p.id: assembly.shape_of(p).area for p in assembly.parts}
    return sum(areas[p] for p in sorted(parts)) / (sum(areas.values()) or 1.0)


def _against(labels: Labels, *, whole: bool, rung: int) -> list[PartAssignment]:
    """What the parts would be that were decided against what clearly speaks for another body."""
    found = []
    for part, decision in labels.decided.items():
        place = labels.places.get(part)
        if place is None or place.body is None or place.role == decision.role:
            continue
        sure = probability(grounds(place, whole=whole, rung=rung))
        if sure >= CLEARLY and decision.source != "data":
            found.append(PartAssignment(part, place.role, place.body, sure, place.reason))
    return found


def _is_doubted(part: str, labels: Labels) -> bool:
    """True for what a person should look at: a part without a place, or with a weak one."""
    if part in labels.decided or part in labels.apart or part in labels.bumpers:
        return False
    place = labels.places.get(part)
    return place is None or place.confidence < REVIEW


def is_required(name: str, template: Template) -> bool:
    """Whether a machine lacks something where no part plays a role."""
    role = template.role(name)
    if role.optional or role.many or role.kind in ("group", "tyre", "edge"):
        return False
    return role.rigid or name in {pin_role(j, template) for j in template.joints}


def _findings(
    template: Template,
    answer: Answer,
    missing: tuple[str, ...],
    frame: MachineFrame,
    decided: Mapping[str, Decision],
    as_good: Mapping[str, tuple[str, ...]],
) -> tuple[Finding, ...]:
    solution = answer.solution
    pins = {pin_role(j, template): j.name for j in template.joints}
    findings = []
    for name in missing:
        if pins.get(name) in solution.hinge_of:
            text = f"No part of its own plays {name}; its joint {pins[name]} is found all the same"
            hint = "Its axis is that of the bores, or of the pin, that the two bodies share."
            findings.append(Finding("ALN002", "info", name, text, hint))
        else:
            hint = "Set the role of the right part in alignment.json, or check that the CAD model has it."
            findings.append(Finding("ALN001", "warning", name, f"No part plays {name}", hint))
    where = template.equipment_type
    for doubt in frame.doubts:
        text = f"The machine's frame is partly a guess: {doubt}"
        findings.append(Finding("ALN003", "warning", where, text, "Say it: `yellowiron align … --machine forward=-x`."))
    for name, others in as_good.items():
        text = f"The variant {name} is taken to be {answer.choices[name]}; as good is {' or '.join(others)}"
        hint = f"Say which it is: `yellowiron align … --machine {name}={others[0]}`."
        findings.append(Finding("ALN032", "info", name, text, hint))
    for words in frame.against:
        hint = "It is done as decided; look at it once more, or take the decision back."
        findings.append(Finding("ALN028", "info", where, words[0].upper() + words[1:], hint))
    if not solution.proven and solution.body_of:
        text = "The search for the best assignment was cut short"
        findings.append(Finding("ALN004", "warning", where, text, "Review the roles."))
    for part, role in sorted((part, decision.role) for part, decision in decided.items()):
        if role is not None and not template.knows(role):
            text = f"The role {role}, set by a person, exists only under another choice of the template's variants"
            findings.append(Finding("ALN005", "warning", part, text, "Fix the choice, or change the role."))
    return tuple(findings)
