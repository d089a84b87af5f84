"""What holds of a person's decisions, after some of them on top of what was decided before."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from yellowiron.model.alignment import Alignment, GivenValue, PartDecision, RoleRule, Signature
from yellowiron.studio.operations import NONE, SIGNED, Operation

_OWN = ("edited", "confirmed")
"""Sources of a part's own decision; a document's are not the studio's to change."""
_NAMED = 3
"""So many parts are named, the rest counted."""


@dataclass(frozen=True)
class Said:
    """What was decided of `parts` (by id), `values` and `joints` (by name), and by patterns (`rules`, the last word
    last); `machine`: of the whole, by name. `remarks`: which patterns went before what was said of single parts
    earlier, in words."""

    parts: Mapping[str, PartDecision] = field(default_factory=dict)
    values: Mapping[str, GivenValue] = field(default_factory=dict)
    joints: Mapping[str, Mapping[str, object]] = field(default_factory=dict)
    rules: tuple[RoleRule, ...] = ()
    machine: Mapping[str, GivenValue] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()

    def snapshot(self) -> dict[str, Any]:
        """It as the journal's first line has it."""
        parts, values, whole = sorted(self.parts.items()), sorted(self.values.items()), sorted(self.machine.items())
        return {
            "parts": {part: {"role": d.role, "source": d.source, **_of(d.signature)} for part, d in parts},
            "values": {name: {"value": v.text, **_of(v.signature)} for name, v in values},
            "joints": {name: dict(entry) for name, entry in sorted(self.joints.items())},
            "rules": [{"pattern": r.pattern, "role": r.role, **_of(r.signature)} for r in self.rules],
            **({"machine": {n: {"value": v.text, **_of(v.signature)} for n, v in whole}} if whole else {}),
        }


def said_in_file(alignment: Alignment) -> Said:
    """What a person says in an alignment file."""
    parts = {p.part: PartDecision(p.role, p.source, p.signature) for p in alignment.parts if p.source in _OWN}
    return Said(parts, alignment.values, alignment.joints, alignment.rules, alignment.machine)


def said_after(
    base: Mapping[str, Any], operations: Sequence[Operation], fitting: Callable[[str], Collection[str]]
) -> Said:
    """What holds after some operations on top of a snapshot; `fitting` gives the parts that fit a pattern. As on the
    command line, a pattern goes before what was said of its parts earlier, and a part's later decision before it."""
    parts = {
        part: PartDecision(entry["role"], entry["source"], _signature(entry))
        for part, entry in base.get("parts", {}).items()
    }
    given = {
        key: {name: GivenValue(entry["value"], _signature(entry)) for name, entry in base.get(key, {}).items()}
        for key in ("values", "machine")
    }
    joints = dict(base.get("joints", {}))
    rules = [RoleRule(entry["pattern"], entry["role"], _signature(entry)) for entry in base.get("rules", ())]
    remarks: dict[str, str] = {}
    for operation in operations:
        parts |= operation.decisions()
        if operation.kind in ("value", "machine"):
            some = given["values" if operation.kind == "value" else "machine"]
            some.pop(operation.name, None)
            value = operation.value()
            some |= {operation.name: value} if value is not None else {}
        if operation.kind == "joint":
            joints.pop(operation.name, None)
            joints |= {operation.name: {**operation.entry, **_of(operation.signature)}} if operation.entry else {}
        if operation.kind == "rule":
            rules = [rule for rule in rules if rule.pattern != operation.name]
            remarks.pop(operation.name, None)
            rule = operation.rule()
            if rule is not None:
                rules.append(rule)
                gone = {part: parts.pop(part) for part in fitting(rule.pattern) if part in parts}
                other = {part: one.role for part, one in gone.items() if one.source in _OWN and one.role != rule.role}
                remarks |= {rule.pattern: _overruled(rule.pattern, other)} if other else {}
    left = {part: one for part, one in parts.items() if one.source != "solved"}
    return Said(left, given["values"], joints, tuple(rules), given["machine"], tuple(remarks.values()))


def _overruled(pattern: str, parts: Mapping[str, str | None]) -> str:
    names = sorted(part.rsplit("/", 1)[-1] for part in parts)
    some = ", ".join(names[:_NAMED]) + (f" and {len(names) - _NAMED} more" if len(names) > _NAMED else "")
    roles = " or ".join(sorted({role or NONE for role in parts.values()})).replace("_", " ")
    return f"'{pattern}' goes before what was said of single parts earlier: {some} ({roles})"


def _of(signature: Signature) -> dict[str, str]:
    return {key: said for key in SIGNED if (said := getattr(signature, key))}


def _signature(entry: Mapping[str, Any]) -> Signature:
    return Signature(*(str(entry.get(key) or "") for key in SIGNED))
