"""The alignment as a value: every part's role in CAD order, what is missing, what is doubtful."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.alignment.assignment.machine_frame import MachineFrame
from yellowiron.alignment.labelling.confidence import REVIEW, grounds, probability
from yellowiron.alignment.labelling.place import Place, pin_role
from yellowiron.model.alignment import Alignment, PartAssignment, Vector
from yellowiron.model.assembly import Assembly
from yellowiron.model.finding import Finding
from yellowiron.model.rows import count_members
from yellowiron.model.template import Template

APART = 0.6
"""Confidence that a part which stands apart is no part of the machine: one remark speaks for all of them."""


def reported(
    assembly: Assembly,
    template: Template,
    solution: Solution,
    places: Mapping[str, Place],
    edited: Mapping[str, str],
    chosen: Mapping[str, str],
    frame: MachineFrame,
    *,
    documents: Mapping[str, str] | None = None,
    apart: Mapping[str, float] | None = None,
    remarks: Sequence[Finding] = (),
    axes: Mapping[str, tuple[Vector, Vector]] | None = None,
    whole: bool = True,
    rung: int = 0,
) -> Alignment:
    """The alignment. `places` by part id; `edited`: part id → the role a person gave it ("": none), which wins;
    `documents`: part id → why, for those of them that a document placed; `apart`: part id → metres from the rest, for
    those left out; `remarks`: further findings; `axes`: the alignment's; `whole`, `rung`: see `confidence.grounds`."""
    parts: list[PartAssignment] = []
    doubted: set[str] = set()
    for part in assembly.parts:
        place = places.get(part.id)
        if part.id in edited:
            said = edited[part.id] or None
            body = template.body_of(said) if said is not None and template.knows(said) else None
            before = place.role if place is not None and place.role != said else None
            if documents is not None and part.id in documents:
                parts.append(PartAssignment(part.id, said, body, 1.0, documents[part.id], "data", before))
            else:
                parts.append(PartAssignment(part.id, said, body, 1.0, "set by a person", "edited", before))
        elif apart is not None and part.id in apart:
            words = f"stands {apart[part.id]:.3g} m from every part of the machine"
            parts.append(PartAssignment(part.id, None, None, APART, words))
        elif place is None:
            parts.append(PartAssignment(part.id, None, None, 0.0, "nothing speaks for any role"))
            doubted.add(part.id)
        else:
            if place.confidence < REVIEW:
                doubted.add(part.id)
            evidence = grounds(place, whole=whole, rung=rung)
            confidence = round(probability(evidence), 3)
            parts.append(
                PartAssignment(
                    part.id,
                    place.role,
                    place.body,
                    confidence,
                    place.reason,
                    "name" if place.by_name else "solved",
                    place.runner_up,
                    evidence,
                )
            )
    played = {p.role for p in parts} | {p.body for p in parts}
    missing = tuple(r.name for r in template.roles if _required(r.name, template) and r.name not in played)
    doubtful = tuple(p.part for p in sorted(parts, key=lambda p: p.confidence) if p.part in doubted)
    findings = (*_findings(template, solution, missing, frame, edited), *remarks)
    return Alignment(
        template.equipment_type,
        frame.matrix,
        tuple(parts),
        dict(chosen),
        missing,
        (*missing, *doubtful),
        findings,
        count_members((p.role for p in parts), template),
        dict(axes or {}),
    )


def _required(name: str, template: Template) -> bool:
    role = template.role(name)
    if role.optional or role.many or role.kind in ("group", "tyre", "edge"):
        return False
    return role.rigid or name in {pin_role(j, template) for j in template.joints}


def _findings(
    template: Template,
    solution: Solution,
    missing: tuple[str, ...],
    frame: MachineFrame,
    edited: Mapping[str, str],
) -> tuple[Finding, ...]:
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
        findings.append(Finding("ALN003", "warning", where, text, "Check the frame in alignment.json."))
    if not solution.proven and solution.body_of:
        text = "The search for the best assignment was cut short"
        findings.append(Finding("ALN004", "warning", where, text, "Review the roles."))
    for part, role in sorted(edited.items()):
        if role and not template.knows(role):
            text = f"The role {role}, set by a person, exists only under another choice of the template's variants"
            findings.append(Finding("ALN005", "warning", part, text, "Fix the choice, or change the role."))
    return tuple(findings)
