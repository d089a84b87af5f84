"""What a person can decide in the studio, one operation at a time."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from yellowiron.alignment import ABSENT, whole
from yellowiron.model.alignment import UNSIGNED, GivenValue, PartDecision, RoleRule, Signature
from yellowiron.model.errors import YellowironError
from yellowiron.model.template import Template

Kind = Literal["role", "confirm", "forget", "rule", "value", "joint", "machine"]
KINDS: tuple[Kind, ...] = ("role", "confirm", "forget", "rule", "value", "joint", "machine")
NONE = "none"
"""As a pattern's role: its parts are not part of the machine."""
SIGNED = ("by", "date", "why")
_SOURCE = {"role": "edited", "confirm": "confirmed", "forget": "solved"}
_SAID = {
    "anchor": "its axis",
    "through": "its axis",
    "Limit": "its stops",
    "joint_type": "its type",
    "Body": "its bodies",
}
_LONGEST = 200
"""Letters of a value, a name or a reason."""
LARGEST_TEXT = 4000
"""Letters of what is said of a joint, and of a pattern."""


@dataclass(frozen=True)
class Operation:
    """One decision: `role` gives `parts` (id → role; None: not part of the machine) theirs, `confirm` says that they
    are right, `forget` takes back what was said of them; `rule` gives all parts that fit the pattern `name`
    (`alignment.files.decisions.fits`) the role `text` (`NONE`; empty: takes the pattern back); `value` gives `name` the
    `text` (empty: takes it back); `joint` says of the joint `name` what is in `entry`, as a `--data` document of joints
    has it (empty: takes all of it back); `machine` says `text` of the whole machine under a `name`, as `align
    --machine` does (empty: takes it back)."""

    kind: Kind
    parts: Mapping[str, str | None] = field(default_factory=dict)
    name: str = ""
    text: str = ""
    entry: Mapping[str, Any] = field(default_factory=dict)
    signature: Signature = UNSIGNED

    def decisions(self) -> dict[str, PartDecision]:
        """What it says of each part."""
        if self.kind not in _SOURCE:
            return {}
        source = _SOURCE[self.kind]
        return {part: PartDecision(role, source, self.signature) for part, role in self.parts.items()}  # type: ignore[arg-type]

    def value(self) -> GivenValue | None:
        """The value that it gives; None where it takes one back, or is about parts."""
        return GivenValue(self.text, self.signature) if self.kind in ("value", "machine") and self.text else None

    def rule(self) -> RoleRule | None:
        """The pattern with its role; None where it takes one back, or is about something else."""
        role = None if self.text == NONE else self.text
        return RoleRule(self.name, role, self.signature) if self.kind == "rule" and self.text else None


def words(operation: Operation) -> str:
    """An operation in a line of the history."""
    if operation.kind == "value":
        return f"{operation.name} = {operation.text}" if operation.text else f"{operation.name} as the sheet has it"
    if operation.kind == "machine":
        return whole_words(operation.name, operation.text)
    if operation.kind == "joint":
        said = ", ".join(_SAID[key] for key in _SAID if key in operation.entry)
        return f"{operation.name.replace('_', ' ')}: {said or 'taken back'}"
    if operation.kind == "rule":
        role = "no part of the machine" if operation.text == NONE else operation.text.replace("_", " ")
        return f"All that is named {operation.name} → {role}" if role else f"{operation.name}: pattern taken back"
    names = [part.rsplit("/", 1)[-1] for part in operation.parts]
    some = ", ".join(names[:2]) + (f" and {len(names) - 2} more" if len(names) > 2 else "")
    roles = sorted({(role or "no part of the machine").replace("_", " ") for role in operation.parts.values()})
    listed = ", ".join(roles[:3]) + (", …" if len(roles) > 3 else "")
    return {"role": f"{some} → {listed}", "confirm": f"{some}: {listed}, yes", "forget": f"{some}: taken back"}[
        operation.kind
    ]


def whole_words(name: str, text: str) -> str:
    """What is said of the whole machine, as a person reads it."""
    plain = name.replace("_", " ")
    if not text:
        return f"{plain}: taken back"
    if name in ("forward", "up"):
        return f"{plain.capitalize()} is {text} of the CAD file"
    return f"Not drawn: {plain}" if text == ABSENT else f"{plain.capitalize()}: {text.replace('_', ' ')}"


def to_entry(operation: Operation) -> dict[str, Any]:
    """An operation as the journal has it."""
    signed = {k: v for k in SIGNED if (v := getattr(operation.signature, k))}
    if operation.kind in ("value", "rule", "machine"):
        return {"kind": operation.kind, "name": operation.name, "text": operation.text, **signed}
    if operation.kind == "joint":
        return {"kind": "joint", "name": operation.name, "entry": dict(operation.entry), **signed}
    return {"kind": operation.kind, "parts": dict(operation.parts), **signed}


def from_entry(entry: object, parts: Collection[str], template: Template) -> Operation:
    """An operation that the page sent, or the journal has. `YellowironError` for one that is none, and for parts and
    roles that there are not."""
    if not isinstance(entry, Mapping) or entry.get("kind") not in KINDS:
        raise _broken(f"It is none of: {', '.join(KINDS)}")
    signature = Signature(*(_text(entry, key) for key in SIGNED))
    kind: Kind = entry["kind"]
    if kind == "value":
        name = _text(entry, "name")
        if not name or "=" in name:
            raise _broken("A value has no name")
        return Operation("value", name=name, text=_text(entry, "text").strip(), signature=signature)
    if kind == "machine":
        name, text = _text(entry, "name").strip(), _text(entry, "text").strip()
        if not name:
            raise _broken("It has no name")
        if text:
            whole({name: GivenValue(text)}, template)
        return Operation("machine", name=name, text=text, signature=signature)
    if kind == "rule":
        name, text = _text(entry, "name", most=LARGEST_TEXT).strip(), _text(entry, "text").strip()
        if not name:
            raise _broken("It has no pattern")
        if text not in ("", NONE) and not template.knows(text):
            raise _broken(f"'{text}' is no role of the template {template.equipment_type}")
        return Operation("rule", name=name, text=text, signature=signature)
    if kind == "joint":
        name, told = _text(entry, "name"), entry.get("entry", {})
        if not name or not isinstance(told, Mapping) or len(json.dumps(told)) > LARGEST_TEXT:
            raise _broken("It says nothing of a joint")
        return Operation("joint", name=name, entry=dict(told), signature=signature)
    said = entry.get("parts")
    if not isinstance(said, Mapping) or not said:
        raise _broken("It names no part")
    for part, role in said.items():
        if part not in parts:
            raise _broken(f"It names a part that is not in the CAD model: '{str(part)[:_LONGEST]}'")
        if role is not None and (not isinstance(role, str) or not template.knows(role)):
            raise _broken(f"'{str(role)[:_LONGEST]}' is no role of the template {template.equipment_type}")
    return Operation(kind, parts={str(p): r for p, r in said.items()}, signature=signature)


def _text(entry: Mapping[str, Any], key: str, *, most: int = _LONGEST) -> str:
    value = entry.get(key, "")
    if not isinstance(value, str) or len(value) > most or not value.isprintable():
        raise _broken(f"'{key}' is no short text")
    return value


def _broken(words: str) -> YellowironError:
    return YellowironError(f"The decision cannot be taken. {words}", where="studio", hint="Reload the page.")
