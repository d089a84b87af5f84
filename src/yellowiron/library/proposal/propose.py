"""A template for a machine that the library does not have: documents from the bodies and joints found in a CAD model.

Every body is a role, every joint an entry whose `source` says what it was found by. Slides and their pivots are
actuators, twins together; wheels and what turns about the upright are motors; a hinge of no closed chain is driven by
itself. Limits are names of values that a sheet is asked for, or `--set` gives.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from yellowiron.library.notation.role_keys import matches
from yellowiron.library.proposal.actuators import add_cylinders, add_motors
from yellowiron.library.proposal.description import described
from yellowiron.library.proposal.draft import Draft, Json
from yellowiron.library.proposal.hierarchy import add_pins, hierarchy
from yellowiron.library.proposal.joints import entry_of, joint_name
from yellowiron.library.proposal.likeness import Likeness
from yellowiron.library.proposal.naming import proposed_names
from yellowiron.model.found import FoundMachine

STEEL = {
    "name": "structural steel", "density": 7850, "elasticity": 2.1e11, "static friction": 0.6, "dynamic friction": 0.5,
    "restitution": 0.1,
    "source": {
        "density, elasticity": "nominal for structural steel (EN 1993-1-1, 3.2.6)",
        "friction, restitution": "typical handbook range of steel on steel or rock",
    },
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Proposal:
    """A template's `documents` by file name without suffix; `roles` of the bodies found and names of the `joints`, in
    their order; and the reasons, in `words` (Markdown)."""

    documents: Mapping[str, Json]
    roles: tuple[str, ...]
    joints: tuple[str, ...]
    words: str


def propose(machine: FoundMachine, *, name: str, like: Likeness | None = None) -> Proposal:
    """A template's documents for a machine that was found.

    `name` is the equipment type's; `like` says which roles of another type the parts play, and lends its entries.
    """
    names, reasons = proposed_names(machine)
    like = like or Likeness()
    _take_over(names, reasons, machine, like)
    draft = Draft(machine, names, reasons, like)
    for joint in machine.joints:
        draft.joint_names.append(joint_name(draft, joint))
    add_pins(draft)
    add_cylinders(draft)
    for k, joint in enumerate(machine.joints):
        draft.joints[draft.joint_names[k]] = entry_of(draft, k, joint)
    add_motors(draft)
    roles = [*draft.names, *draft.pins]

    def of_roles(entries: Json) -> Json:
        return {key: entry for key, entry in entries.items() if any(matches(role, key) for role in roles)}

    documents: dict[str, Json] = {
        "hierarchy": {name: {"rigid body": "N", "kind": "group", "child": hierarchy(draft, machine.root)}},
        "joints": draft.joints,
        "materials": of_roles(like.materials) or {"*": STEEL},
        "collision": of_roles(like.collision) or _collision(draft),
    }
    documents |= {"wanted": draft.wanted} if draft.wanted else {}
    documents |= {"actuators": draft.actuators} if draft.actuators else {}
    return Proposal(documents, tuple(draft.names), tuple(draft.joint_names), described(draft, name))


def _take_over(names: list[str], reasons: list[str], machine: FoundMachine, like: Likeness) -> None:
    """Names of another type's bodies for those that its alignment found among the parts."""
    found = {k: like.body(body.parts, body.kind) for k, body in enumerate(machine.bodies)}
    for k, role in found.items():
        if role is not None and list(found.values()).count(role) == 1:
            names[k], reasons[k] = role, f"plays the role {role} of the type {like.equipment_type}"
    kept = {k for k, reason in enumerate(reasons) if reason.startswith("plays the role")}
    for k in range(len(names)):
        while k not in kept and names.count(names[k]) > 1:
            names[k] += "_other"


def _collision(draft: Draft) -> Json:
    kinds = {"barrel": "analytic", "rod": "analytic", "wheel": "analytic"}
    shaped = {n: kinds[b.kind] for n, b in zip(draft.names, draft.machine.bodies, strict=True) if b.kind in kinds}
    return {"*": "convexHull", **shaped, **({"*_pin": "analytic"} if draft.pins else {})}
