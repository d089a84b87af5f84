"""What was found in a machine completed by its mirror image, told of the half that is drawn."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from yellowiron.alignment.labelling.result import is_required
from yellowiron.model.alignment import Alignment
from yellowiron.model.finding import Finding
from yellowiron.model.rows import as_drawn, count_members
from yellowiron.model.template import Template, choose


def of_drawn(found: Alignment, drawn: Collection[str], template: Template) -> Alignment:
    """The alignment of the `drawn` parts (ids) alone; what only mirror images play is missing, and said (ALN029)."""
    chosen = choose(template, found.choices)
    parts = tuple(p for p in found.parts if p.part in drawn)
    images = {p.part for p in found.parts} - set(drawn)
    played, everywhere = ({word for p in some for word in (p.role, p.body)} for some in (parts, found.parts))
    lost = tuple(r.name for r in chosen.roles if r.name in everywhere - played and is_required(r.name, chosen))
    bodies = {p.body for p in parts}
    joints = as_drawn(chosen, {p.body for p in found.parts if p.body is not None})
    words = (
        "Only one half of the machine is drawn. It was completed by its mirror image to find what each part is; "
        "the machine has what is drawn"
    )
    told = Finding("ALN029", "warning", found.equipment_type, words, "--mirror builds the whole machine.")
    return replace(
        found,
        parts=parts,
        missing=(*found.missing, *lost),
        to_review=(*found.missing, *lost, *(i for i in found.to_review if i not in images and i not in found.missing)),
        findings=(told, *(f for f in found.findings if f.where not in images)),
        counts=count_members((p.role for p in parts), chosen),
        axes={j: line for j, line in found.axes.items() if bodies.issuperset(joints.bodies_of(joints.joint(j)))},
    )
