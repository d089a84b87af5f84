"""alignment.json: what was found, for a person to read, correct, and hand back."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.alignment.files.explanation import near
from yellowiron.alignment.files.revisions import Print, match_parts, prints_of
from yellowiron.model.alignment import (
    LARGEST_FILE,
    UNSIGNED,
    Alignment,
    AssignmentSource,
    GivenValue,
    PartAssignment,
    RoleRule,
    Signature,
    Suggestion,
)
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import AlignmentError, OutputError
from yellowiron.model.finding import Finding
from yellowiron.model.rows import count_members
from yellowiron.model.template import Template
from yellowiron.support.files.inputs import read_input

FORMAT = 1
_RIGID, _FARTHEST = 1e-5, 1e6
"""How far a frame's axes may be from unit vectors at right angles, and its origin (m) from the CAD model's."""
_SIGNED = ("by", "date", "why")
_NUMBERS = re.compile(r"\[\n\s*([-+\d.e,\s]+?)\s*\]")


def write_alignment(alignment: Alignment, assembly: Assembly, path: str | Path) -> None:
    """Writes alignment.json: the doubtful parts first, most doubtful on top, then the rest by body, role and id; the
    order of the parts in the CAD model does not matter.

    A person changes `role`, or `source` to `confirmed`; `solved` keeps what the program had found; `shape` and `place`
    are what a part is known by in a later revision of the CAD model (`revisions.Print`). `rules`, `joints`, `values`,
    `machine` are a person's. `OutputError` if it cannot be written.
    """
    doubtful = set(alignment.to_review)

    def rank(p: PartAssignment) -> tuple[bool, float, str, str, str]:
        doubt = p.part in doubtful
        return (not doubt, p.confidence if doubt else 0.0, p.body or "~", p.role or "", p.part)

    prints = prints_of(assembly)
    document = {
        "format": FORMAT,
        "equipment_type": alignment.equipment_type,
        "frame": [[float(v) for v in row] for row in alignment.frame],
        "choices": dict(sorted(alignment.choices.items())),
        **({"counts": dict(sorted(alignment.counts.items()))} if alignment.counts else {}),
        "to_review": list(alignment.to_review),
        "missing": list(alignment.missing),
        **({"rules": [_rule_entry(r) for r in alignment.rules]} if alignment.rules else {}),
        **({"joints": dict(alignment.joints)} if alignment.joints else {}),
        **({"values": {n: _value_entry(v) for n, v in sorted(alignment.values.items())}} if alignment.values else {}),
        **({"machine": {n: _value_entry(v) for n, v in alignment.machine.items()}} if alignment.machine else {}),
        "parts": [_entry(p, prints.get(p.part)) for p in sorted(alignment.parts, key=rank)],
    }
    text = json.dumps(document, ensure_ascii=False, indent=1) + "\n"
    text = _NUMBERS.sub(lambda m: f"[{' '.join(m.group(1).split())}]", text)  # numbers of a list on one line
    target = Path(path)
    try:
        target.write_text(text, encoding="utf-8")
    except OSError as error:
        raise OutputError(
            f"The alignment cannot be written: {error.strerror or error}", where=str(target), hint="Check the folder."
        ) from error


def _entry(p: PartAssignment, known_by: Print | None) -> dict[str, Any]:
    solved = p.runner_up if p.source == "edited" and p.runner_up is not None else p.role
    return {
        "part": p.part,
        "role": p.role,
        "solved": solved,
        "body": p.body,
        "confidence": p.confidence,
        "reason": p.reason,
        "runner_up": p.runner_up,
        "source": p.source,
        **_signed(p.signature),
        **({"suggestion": asdict(p.suggestion)} if p.suggestion is not None else {}),
        **({"shape": list(known_by.shape), "place": list(known_by.place)} if known_by is not None else {}),
    }


def _rule_entry(rule: RoleRule) -> dict[str, Any]:
    return {"pattern": rule.pattern, "role": rule.role, **_signed(rule.signature)}


def _value_entry(value: GivenValue) -> dict[str, str]:
    return {"value": value.text, **_signed(value.signature)}


def _signed(signature: Signature) -> dict[str, str]:
    return {key: said for key in _SIGNED if (said := getattr(signature, key))}


def _signature(entry: Mapping[str, Any]) -> Signature:
    return Signature(*(str(entry.get(key) or "") for key in _SIGNED))


def read_alignment(path: str | Path, assembly: Assembly, template: Template) -> Alignment:
    """An alignment file, as `align` takes it for `edits`; its parts in CAD order.

    A role that differs from `solved` is a person's, and so is one whose source is `edited` or `confirmed`, or that has
    neither (an entry written by hand). Parts are known by shape and place where the entry has them (`revisions`), so
    that an edit survives a revision of the CAD model; where a person's part is gone or has another id, `findings` says
    so. Other entries of parts that are gone say nothing that is not found again, and are passed over. `AlignmentError`
    for a file that is not one or is another equipment type's, for a person's role that is not in the template, and for
    that of a part without shape and place that is not in the CAD model.
    """
    source = Path(path)
    document = _load(source)
    made_for = document.get("equipment_type", template.equipment_type)
    if made_for != template.equipment_type:
        raise AlignmentError(
            f"The alignment is of equipment type '{made_for}', not '{template.equipment_type}'", where=str(source),
            hint="Build that type, or delete the file: it is written anew.",
        )  # fmt: skip
    parts = {p.id: k for k, p in enumerate(assembly.parts)}
    again = _again(document["parts"], assembly)
    read: list[PartAssignment] = []
    findings: list[Finding] = []
    for where, entry in _known_entries(document["parts"], source, template):
        part, role, edited = entry["part"], entry.get("role"), _is_edit(entry)
        now = again.get(part) if _print(entry) is not None else part if part in parts else None
        if now is None and edited and _print(entry) is None:
            raise AlignmentError(
                f"The alignment names a part that is not in the CAD model: '{part}'", where=where,
                hint=f"{near(part, set(parts))} Delete that entry if the part is gone, or the file to start anew."
                .strip(),
            )  # fmt: skip
        if edited and now != part:
            findings.append(_moved(part, role, now))
        if now is not None:
            read.append(_assignment({**entry, "part": now}, role, template))
    choices = document.get("choices", {})
    return Alignment(
        equipment_type=str(document.get("equipment_type", template.equipment_type)),
        frame=_frame(document.get("frame"), source),
        parts=tuple(sorted(_alone(read), key=lambda p: parts[p.part])),
        choices={str(k): str(v) for k, v in choices.items()} if isinstance(choices, Mapping) else {},
        missing=_names(document.get("missing")),
        to_review=_names(document.get("to_review")),
        findings=tuple(findings),
        counts=count_members((p.role for p in read), template),
        rules=tuple(_rules(document, source)),
        joints=_joints(document, source),
        values=_values(document, source),
        machine=_values(document, source, "machine", '{"forward": {"value": "-x"}, …}'),
    )


def parts_in(path: str | Path) -> frozenset[str]:
    """The ids of the parts that an alignment file speaks of. `AlignmentError` for a file that is none."""
    entries = _load(Path(path))["parts"]
    return frozenset(str(entry["part"]) for entry in entries if isinstance(entry, Mapping) and "part" in entry)


def said_in(path: str | Path, template: Template) -> dict[str, Any]:
    """What a person says in an alignment file, as plain data, without what was found: two files of which this is the
    same lead to the same alignment. `AlignmentError` for a file that is none."""
    source = Path(path)
    document = _load(source)
    entries = [entry for _, entry in _known_entries(document["parts"], source, template)]
    edits = [
        {"confirmed": entry.get("source") == "confirmed", **{
            key: entry.get(key) for key in ("part", "role", "solved", "by", "date", "why")
        }} for entry in entries if _is_edit(entry)
    ]  # fmt: skip
    kept = {key: document.get(key) for key in ("equipment_type", "rules", "joints", "values", "machine")}
    if not edits and not any(list(kept.values())[1:]):
        return {}
    # Parts are found again among all those that there were, and say how the model was taken apart.
    prints = [[entry["part"], entry.get("shape"), entry.get("place")] for entry in entries]
    return {**kept, "edits": edits, "prints": prints}


def read_joints(path: str | Path) -> dict[str, Mapping[str, object]]:
    """The joints that a person wrote into an alignment file: name → entry, as a `--data` document of joints has it.
    Who said it, when and why is left out. `AlignmentError` for a file that is no alignment."""
    source = Path(path)
    return {
        name: {key: said for key, said in entry.items() if key not in _SIGNED}
        for name, entry in _joints(_load(source), source).items()
    }


def _joints(document: Mapping[str, Any], source: Path) -> dict[str, Mapping[str, object]]:
    joints = document.get("joints", {})
    if not isinstance(joints, Mapping) or not all(isinstance(entry, Mapping) for entry in joints.values()):
        raise AlignmentError(
            "`joints` is no object of joints", where=str(source), hint='Write {"joint": {"anchor": …, "axis": …}, …}.'
        )
    return {str(name): entry for name, entry in joints.items()}


def read_values(path: str | Path) -> dict[str, GivenValue]:
    """The values that a person wrote into an alignment file, by name. `AlignmentError` for a file that is none."""
    source = Path(path)
    return _values(_load(source), source)


def _values(
    document: Mapping[str, Any],
    source: Path,
    key: str = "values",
    example: str = '{"Boom Cylinder Stroke": {"value": "1400 mm"}, …}',
) -> dict[str, GivenValue]:
    values = document.get(key, {})
    said = {
        n: v if isinstance(v, Mapping) else {"value": v}
        for n, v in (values if isinstance(values, Mapping) else {}).items()
    }
    if not isinstance(values, Mapping) or not all(isinstance(v.get("value"), str) for v in said.values()):
        raise AlignmentError(
            f"`{key}` is no object of values", where=str(source), hint=f"Write {example}.",
        )  # fmt: skip
    return {str(name): GivenValue(entry["value"], _signature(entry)) for name, entry in said.items()}


def _rules(document: Mapping[str, Any], source: Path) -> Iterator[RoleRule]:
    rules = document.get("rules", [])
    for number, entry in enumerate(rules if isinstance(rules, list) else [rules]):
        role = entry.get("role", "") if isinstance(entry, Mapping) else ""
        if not isinstance(entry, Mapping) or not isinstance(entry.get("pattern"), str) or role == "":
            raise AlignmentError(
                "A rule has no pattern or no role", where=f"{source}: rules[{number}]",
                hint='Write {"pattern": "HITCH/*", "role": "hitch"}; role null leaves the parts out.',
            )  # fmt: skip
        yield RoleRule(entry["pattern"], None if role is None else str(role), _signature(entry))


def _known_entries(entries: list[Any], source: Path, template: Template) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """(where it is, entry) of the entries whose role the template has, a part once. A person's entry of another role,
    and a part that is there twice, are errors."""
    taken: set[str] = set()
    for number, entry in enumerate(entries):
        where = f"{source}: parts[{number}]"
        if not isinstance(entry, Mapping) or not isinstance(entry.get("part"), str):
            raise AlignmentError("An entry has no part", where=where, hint='Each needs "part" and "role".')
        part, role = entry["part"], entry.get("role")
        if not (template.knows(role) if isinstance(role, str) else role is None):
            if not _is_edit(entry):
                continue
            raise AlignmentError(
                f"'{role}' is no role of the template {template.equipment_type}", where=where,
                hint=near(str(role), {r.name for r in template.roles})
                or "`yellowiron templates show TYPE` lists the roles.",
            )  # fmt: skip
        if part in taken:
            raise AlignmentError(f"The part '{part}' is there twice", where=where, hint="Keep one entry.")
        taken.add(part)
        yield where, entry


def _again(entries: list[Any], assembly: Assembly) -> dict[str, str]:
    """Part id of the file → part id of the CAD model, for the entries with shape and place."""
    earlier = {str(e.get("part")): known for e in entries if isinstance(e, Mapping) and (known := _print(e))}
    return match_parts(earlier, prints_of(assembly)) if earlier else {}


def _print(entry: Mapping[str, Any]) -> Print | None:
    shape, place = entry.get("shape"), entry.get("place")
    if not isinstance(shape, list) or not isinstance(place, list) or (len(shape), len(place)) != (5, 3):
        return None
    if not all(isinstance(v, int | float) and np.isfinite(v) for v in (*shape, *place)):
        return None
    x, y, z = place
    return Print(tuple(shape), (x, y, z))


def _moved(part: str, role: str | None, now: str | None) -> Finding:
    said = f"The part '{part}', which a person set to {role or 'no role'},"
    if now is None:
        hint = "The CAD model was revised: set the role of the part that replaces it, if any."
        return Finding("ALN012", "warning", part, f"{said} is not in the CAD model any more", hint)
    hint = "It has the same shape or place; if it is another part, change its role in alignment.json."
    return Finding("ALN013", "info", now, f"{said} is taken to be '{now}' in this CAD model", hint)


def _alone(read: list[PartAssignment]) -> list[PartAssignment]:
    """One assignment a part; a person's wins (two entries may lead to one part: one known by its id alone)."""
    found: dict[str, PartAssignment] = {}
    for p in read:
        if p.part not in found or p.source in ("edited", "confirmed"):
            found[p.part] = p
    return list(found.values())


def _is_edit(entry: Mapping[str, Any]) -> bool:
    """True for an entry that a person wrote, changed or confirmed."""
    if entry.get("source") in ("edited", "confirmed"):
        return True
    if "solved" in entry:
        return bool(entry.get("role") != entry["solved"])
    return "role" in entry and "source" not in entry


def _assignment(entry: Mapping[str, Any], role: str | None, template: Template) -> PartAssignment:
    confidence, edited, said = entry.get("confidence"), _is_edit(entry), entry.get("source")
    # A role that was confirmed and then changed is an edit.
    confirmed = said == "confirmed" and entry.get("solved", role) == role
    kept: AssignmentSource = "name" if said == "name" else "rule" if said == "rule" else "solved"
    runner_up = entry.get("solved") if edited and not confirmed else entry.get("runner_up")
    return PartAssignment(
        part=entry["part"],
        role=role,
        body=template.body_of(role) if role is not None else None,
        confidence=1.0 if edited else float(confidence) if isinstance(confidence, int | float) else 0.0,
        reason="set by a person" if edited else str(entry.get("reason", "")),
        source="confirmed" if confirmed else "edited" if edited else kept,
        runner_up=runner_up if isinstance(runner_up, str) else None,
        signature=_signature(entry) if edited else UNSIGNED,
        suggestion=_suggestion(entry.get("suggestion"), template),
    )


def _suggestion(entry: object, template: Template) -> Suggestion | None:
    """A suggestion as it was written; None for what is none, or is of a body that there is not."""
    said = entry if isinstance(entry, Mapping) else {}
    body, *words = (said.get(key) for key in ("body", "model", "question", "reason"))
    known = body is None or (isinstance(body, str) and template.knows(body))
    return Suggestion(body, *(str(word or "") for word in words)) if said and known else None


def _load(source: Path) -> dict[str, Any]:
    hint = "Hand in the alignment.json that an earlier run wrote."
    data = read_input(source, what="The alignment", most=LARGEST_FILE, error=AlignmentError)
    try:
        document = json.loads(data.decode("utf-8-sig"))
    except RecursionError as error:
        raise AlignmentError("The alignment is nested too deep", where=str(source), hint=hint) from error
    except ValueError as error:
        raise AlignmentError(f"The alignment is no JSON: {error}", where=str(source), hint=hint) from error
    if not isinstance(document, dict) or not isinstance(document.get("parts"), list):
        raise AlignmentError("The file is no alignment: it has no list of parts", where=str(source), hint=hint)
    if document.get("format", FORMAT) != FORMAT:
        raise AlignmentError(
            f"The alignment has format {document['format']}; this program reads {FORMAT}", where=str(source), hint=hint
        )
    return document


def _frame(value: object, source: Path) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    if value is None:
        return np.eye(4)
    try:
        frame = np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        frame = np.zeros(0)
    hint = "Leave it as the last run wrote it."
    if frame.shape != (4, 4) or not np.isfinite(frame).all():
        raise AlignmentError("`frame` is no 4 by 4 matrix", where=str(source), hint=hint)
    turn = frame[:3, :3]
    with np.errstate(over="ignore", invalid="ignore"):
        rigid = np.allclose(turn @ turn.T, np.eye(3), rtol=0.0, atol=_RIGID) and np.linalg.det(turn) > 0.0
    if not rigid or not np.allclose(frame[3], (0.0, 0.0, 0.0, 1.0), rtol=0.0, atol=_RIGID):
        raise AlignmentError(
            "`frame` does more than turn and move: it mirrors, shears, scales or flattens", where=str(source), hint=hint
        )
    if np.abs(frame[:3, 3]).max() > _FARTHEST:
        raise AlignmentError(f"`frame` moves by more than {_FARTHEST:g} m", where=str(source), hint=hint)
    return frame


def _names(value: object) -> tuple[str, ...]:
    return tuple(str(v) for v in value) if isinstance(value, list) else ()
