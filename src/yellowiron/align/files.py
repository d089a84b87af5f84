"""alignment.json: what was found, for a person to read, correct, and hand back."""

from __future__ import annotations

import json
from collections.abc import Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import AlignmentError, OutputError
from yellowiron.model.rows import count_members
from yellowiron.model.template import Template

FORMAT = 1
_FRAME = "the frame, a row a line"


def write_alignment(alignment: Alignment, assembly: Assembly, path: str | Path) -> None:
    """Writes alignment.json: parts in CAD order, the doubtful ones listed first under `to_review`.

    A person changes `role` and nothing else; `solved` keeps what the program had found. `OutputError` if it cannot be
    written.
    """
    del assembly  # the parts of an alignment are already in CAD order
    document = {
        "format": FORMAT,
        "equipment_type": alignment.equipment_type,
        "frame": _FRAME,
        "choices": dict(sorted(alignment.choices.items())),
        **({"counts": dict(sorted(alignment.counts.items()))} if alignment.counts else {}),
        "to_review": list(alignment.to_review),
        "missing": list(alignment.missing),
        "parts": [_entry(p) for p in alignment.parts],
    }
    rows = ",\n".join("  " + json.dumps([float(v) for v in row]) for row in alignment.frame)
    text = json.dumps(document, ensure_ascii=False, indent=1) + "\n"
    text = text.replace(f'"{_FRAME}"', f"[\n{rows}\n ]", 1)
    target = Path(path)
    try:
        target.write_text(text, encoding="utf-8")
    except OSError as error:
        raise OutputError(
            f"The alignment cannot be written: {error.strerror or error}", where=str(target), hint="Check the folder."
        ) from error


def _entry(p: PartAssignment) -> dict[str, Any]:
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
    }


def read_alignment(path: str | Path, assembly: Assembly, template: Template) -> Alignment:
    """An alignment file, as `align` takes it for `edits`.

    A role that differs from `solved` is a person's, and so is one whose source is `edited`, or that has neither (an
    entry written by hand). Other entries say nothing that is not found again: those of parts that a revision of the CAD
    model took away are passed over. `AlignmentError` for a file that is not one or is another equipment type's, and for
    a person's role of a part that is not in the CAD model, or that is not in the template.
    """
    source = Path(path)
    document = _load(source)
    made_for = document.get("equipment_type", template.equipment_type)
    if made_for != template.equipment_type:
        raise AlignmentError(
            f"The alignment is of equipment type '{made_for}', not '{template.equipment_type}'", where=str(source),
            hint="Build that type, or delete the file: it is written anew.",
        )  # fmt: skip
    parts = {p.id for p in assembly.parts}
    roles = {r.name for r in template.roles}
    seen: set[str] = set()
    read = []
    for number, entry in enumerate(document["parts"]):
        where = f"{source}: parts[{number}]"
        if not isinstance(entry, Mapping) or not isinstance(entry.get("part"), str):
            raise AlignmentError("An entry has no part", where=where, hint='Each needs "part" and "role".')
        part, role, edited = entry["part"], entry.get("role"), _is_edit(entry)
        if not edited and (part not in parts or (role is not None and not template.knows(role))):
            continue
        if part not in parts:
            raise AlignmentError(
                f"The alignment names a part that is not in the CAD model: '{part}'", where=where,
                hint=f"{_near(part, parts)} Delete that entry if the part is gone, or the file to start anew.".strip(),
            )  # fmt: skip
        if part in seen:
            raise AlignmentError(f"The part '{part}' is there twice", where=where, hint="Keep one entry.")
        seen.add(part)
        if role is not None and not template.knows(role):
            raise AlignmentError(
                f"'{role}' is no role of the template {template.equipment_type}", where=where,
                hint=_near(str(role), roles) or "`yellowiron templates show TYPE` lists the roles.",
            )  # fmt: skip
        read.append(_assignment(entry, role, template, edited=edited))
    choices = document.get("choices", {})
    return Alignment(
        equipment_type=str(document.get("equipment_type", template.equipment_type)),
        frame=_frame(document.get("frame"), source),
        parts=tuple(read),
        choices={str(k): str(v) for k, v in choices.items()} if isinstance(choices, Mapping) else {},
        missing=_names(document.get("missing")),
        to_review=_names(document.get("to_review")),
        counts=count_members((p.role for p in read), template),
    )


def _is_edit(entry: Mapping[str, Any]) -> bool:
    """True for an entry that a person wrote or changed."""
    if entry.get("source") == "edited":
        return True
    if "solved" in entry:
        return bool(entry.get("role") != entry["solved"])
    return "role" in entry and "source" not in entry


def _assignment(entry: Mapping[str, Any], role: str | None, template: Template, *, edited: bool) -> PartAssignment:
    confidence = entry.get("confidence")
    runner_up = entry.get("solved") if edited else entry.get("runner_up")
    return PartAssignment(
        part=entry["part"],
        role=role,
        body=template.body_of(role) if role is not None else None,
        confidence=1.0 if edited else float(confidence) if isinstance(confidence, int | float) else 0.0,
        reason="set by a person" if edited else str(entry.get("reason", "")),
        source="edited" if edited else "name" if entry.get("source") == "name" else "solved",
        runner_up=runner_up if isinstance(runner_up, str) else None,
    )


def _load(source: Path) -> dict[str, Any]:
    hint = "Hand in the alignment.json that an earlier run wrote."
    try:
        document = json.loads(source.read_text(encoding="utf-8"))
    except OSError as error:
        raise AlignmentError(
            f"The alignment cannot be read: {error.strerror or error}", where=str(source), hint=hint
        ) from error
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
    if frame.shape != (4, 4) or not np.isfinite(frame).all():
        raise AlignmentError(
            "`frame` is no 4 by 4 matrix", where=str(source), hint="Leave it as the last run wrote it."
        )
    return frame


def _names(value: object) -> tuple[str, ...]:
    return tuple(str(v) for v in value) if isinstance(value, list) else ()


def _near(name: str, known: set[str]) -> str:
    close = get_close_matches(name, sorted(known), n=1)
    return f"Did you mean '{close[0]}'?" if close else ""


def explain(alignment: Alignment, role_or_part: str) -> str:
    """Why a role has its parts, or a part its role, in sentences.

    A part is named by its id, or by the end of it (its name, say) where that leaves no doubt. `AlignmentError` for a
    name that is neither, or that several parts end with.
    """
    chosen = [p for p in alignment.parts if role_or_part in (p.part, p.role)]
    if not chosen:
        chosen = [p for p in alignment.parts if p.body == role_or_part]
    if not chosen and role_or_part not in alignment.missing:
        chosen = _ending(alignment, role_or_part)
    if not chosen:
        if role_or_part in alignment.missing:
            return f"{role_or_part}: no part plays it."
        known = {p.part for p in alignment.parts} | {p.part.rpartition("/")[2] for p in alignment.parts}
        known |= {r for p in alignment.parts for r in (p.role, p.body) if r}
        raise AlignmentError(
            f"'{role_or_part}' is neither a role nor a part of this alignment", where=role_or_part,
            hint=_near(role_or_part, known) or "Name a role of the template or a part id.",
        )  # fmt: skip
    return "\n".join(_sentence(p) for p in sorted(chosen, key=lambda p: p.confidence))


def _ending(alignment: Alignment, name: str) -> list[PartAssignment]:
    """The one part whose id ends with these names; as they are written, else without regard to case."""
    for fold in (str, str.casefold):
        found = [p for p in alignment.parts if f"/{fold(p.part)}".endswith(f"/{fold(name.strip('/'))}")]
        if len(found) > 1:
            some = ", ".join(f"'{p.part}'" for p in found[:4]) + (", …" if len(found) > 4 else "")
            raise AlignmentError(
                f"{len(found)} parts are named '{name}'", where=name, hint=f"Say more of the path: {some}."
            )
        if found:
            return found
    return []


def _sentence(p: PartAssignment) -> str:
    text = f"{p.part}: {p.role or 'no role'} ({p.confidence:.0%}, {p.source}): {p.reason}."
    moves = f" Moves with {p.body}." if p.body not in (None, p.role) else ""
    rival = f" Otherwise: {p.runner_up}." if p.runner_up else ""
    return text + moves + rival
