"""Another type's template, lent to a machine that is like it: its roles for parts, its entries for joints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from yellowiron.library.composing.documents import template_documents
from yellowiron.library.load import load_template
from yellowiron.library.parsing.wanted import complete
from yellowiron.library.type_folders import find_template
from yellowiron.model.alignment import Alignment
from yellowiron.model.template import choose

SHARE = 0.6
"""A body plays a role if this share of its parts are aligned with it …"""
SURE = 0.5
"""… and one of them as surely as this."""
Json = dict[str, Any]


@dataclass(frozen=True, eq=False)
class Likeness:
    """What may be taken over: `parts` part id → (role, body, confidence); the type's documents as they are written,
    `joints` and `actuators` for the variants found only. Empty: nothing."""

    equipment_type: str = ""
    parts: Mapping[str, tuple[str, str, float]] = field(default_factory=dict)
    ends: Mapping[str, tuple[str, frozenset[str]]] = field(default_factory=dict)
    roles: Mapping[str, str] = field(default_factory=dict)
    joints: Json = field(default_factory=dict)
    actuators: Json = field(default_factory=dict)
    wanted: Json = field(default_factory=dict)
    materials: Json = field(default_factory=dict)
    collision: Json = field(default_factory=dict)

    def body(self, parts: Sequence[str], kind: str) -> str | None:
        """The body that most of some parts are aligned with, if it is of their kind (barrels, rods, wheels)."""
        votes: dict[str, float] = {}
        sure: dict[str, float] = {}
        for part in parts:
            _, body, confidence = self.parts.get(part, ("", "", 0.0))
            if body:
                votes[body] = votes.get(body, 0.0) + 1.0 / len(parts)
                sure[body] = max(sure.get(body, 0.0), confidence)
        best = max(sorted(votes), key=lambda b: votes[b], default=None)
        if best is None or votes[best] < SHARE or sure[best] < SURE:
            return None
        typed = ("barrel", "rod", "wheel")
        other = self.roles.get(best, "")
        return best if (other if other in typed else "") == (kind if kind in typed else "") else None

    def kind(self, role: str) -> str:
        """The kind of one of its bodies."""
        return self.roles.get(role, "")

    def pin(self, parts: Sequence[str]) -> str | None:
        """The role that all of some pin parts play, which is no body."""
        roles = {self.parts[p][0] for p in parts if p in self.parts}
        role = roles.pop() if len(roles) == 1 else None
        return role if role is not None and role not in self.roles else None

    def joint(self, a: str, b: str, kind: str) -> str | None:
        """The name of its joint of that type between two bodies."""
        return next((n for n, (t, ends) in self.ends.items() if t == kind and ends == {a, b}), None)

    def joint_entry(self, name: str) -> Json | None:
        """What its entry for a joint says of limits and drive."""
        entry = self.joints.get(name)
        if entry is None:
            return None
        other = ("joint_type", "Body", "when", "drive_when", "rest_when", "source", "ring")
        return {k: v for k, v in entry.items() if k not in other}

    def actuator(self, slides: Sequence[str]) -> tuple[str, Json] | None:
        """Its actuator with exactly these slides: (name, entry)."""
        for name, entry in self.actuators.items():
            cylinders = [
                {k: v for k, v in c.items() if k != "when"}
                for c in entry.get("cylinders", ())
                if c["slide"] in slides and {c[k] for k in ("barrel_joint", "rod_joint") if k in c} <= self.ends.keys()
            ]
            if cylinders and sorted(c["slide"] for c in cylinders) == sorted(slides):
                return name, {**entry, "cylinders": cylinders}
        return None

    def motors(self, joints: Sequence[str]) -> dict[str, Json]:
        """Its motors, with those of their joints that are there."""
        found = {}
        for name, entry in self.actuators.items():
            own = [j for j in entry.get("joints", ()) if j in joints and j in self.joints]
            if own:
                found[name] = {**entry, "joints": own}
        return found


def likeness(equipment_type: str | Path, alignment: Alignment) -> Likeness:
    """What a library type (or a template folder) lends to a model that was aligned with it. Errors: those of loading a
    template."""
    folder = find_template(equipment_type)
    template = choose(load_template(equipment_type), alignment.choices)
    present = {a.body for a in alignment.parts}
    ends = {
        j.name: (j.type, frozenset(str(b) for b in template.bodies_of(j)))
        for j in template.joints
        if set(template.bodies_of(j)) <= present
    }

    written = template_documents(folder) if folder.is_dir() else {}

    def document(kind: str) -> Json:
        if kind not in written:
            return {}
        return dict((complete(written[kind]) if kind == "wanted" else written[kind]).data)

    return Likeness(
        template.equipment_type,
        {a.part: (a.role, a.body, a.confidence) for a in alignment.parts if a.role and a.body},
        ends,
        {r.name: r.kind for r in template.roles if r.rigid},
        {n: e for n, e in document("joints").items() if n in ends},
        document("actuators"),
        document("wanted"),
        document("materials"),
        document("collision"),
    )
