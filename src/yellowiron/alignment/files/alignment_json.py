"""alignment.json: what was found, for a person to read, correct, and hand back."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.alignment.files.revisions import Print, match_parts, prints_of
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import AlignmentError, OutputError
from yellowiron.model.finding import Finding
from yellowiron.model.rows import count_members
from yellowiron.model.template import Template
from yellowiron.support.files.inputs import MEGABYTE, read_input

FORMAT = 1
_LARGEST = 64 * MEGABYTE
"""Bytes of a file: that of a model of a hundred thousand parts."""
_RIGID, _FARTHEST = 1e-5, 1e6
"""How far a frame's axes may be from unit vectors at right angles, and its origin (m) from the CAD model's."""
_NUMBERS = re.compile(r"\[\n\s*([-+\d.e,\s]+?)\s*\]")


def write_alignment(alignment: Alignment, assembly: Assembly, path: str | Path) -> None:
    """Writes alignment.json: the doubtful parts first, most doubtful on top, then the rest by body, role and id; the
    order of the parts in the CAD model does not matter.

    A person changes `role` and nothing else; `solved` keeps what the program had found; `shape` and `place` are what a
    part is known by in a later revision of the CAD model (`revisions.Print`). `OutputError` if it cannot be written.
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
        **({"shape": list(known_by.shape), "place": list(known_by.place)} if known_by is not None else {}),
    }


def read_alignment(path: str | Path, assembly: Assembly, template: Template) -> Alignment:
    """An alignment file, as `align` takes it for `edits`; its parts in CAD order.

    A role that differs from `solved` is a person's, and so is one whose source is `edited`, or that has neither (an
    entry written by hand). Parts are known by shape and place where the entry has them (`revisions`), so that an edit
    survives a revision of the CAD model; where a person's part is gone or has another id, `findings` says so. Other
    entries of parts that are gone say nothing that is not found again, and are passed over. `AlignmentError` for a file
    that is not one or is another equipment type's, for a person's role that is not in the template, and for that of a
    part without shape and place that is not in the CAD model.
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
                hint=f"{_near(part, set(parts))} Delete that entry if the part is gone, or the file to start anew."
                .strip(),
            )  # fmt: skip
        if edited and now != part:
            findings.append(_moved(part, role, now))
        if now is not None:
            read.append(_assignment({**entry, "part": now}, role, template, edited=edited))
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
    )


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
                hint=_near(str(role), {r.name for r in template.roles})
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
        if p.part not in found or p.source == "edited":
            found[p.part] = p
    return list(found.values())


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
    data = read_input(source, what="The alignment", most=_LARGEST, error=AlignmentError)
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


def _near(name: str, known: set[str]) -> str:
    close = get_close_matches(name, sorted(known), n=1)
    return f"Did you mean '{close[0]}'?" if close else ""


def explain(alignment: Alignment, role_or_part: str) -> str:
    """Why a role has its parts, the doubtful ones first, or a part its role, in sentences: how probable it is, what it
    was found by, what else it could be; for a single part also the figures that its probability rests on.

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
    chosen = sorted(chosen, key=lambda p: p.confidence)
    if len(chosen) == 1:
        return "\n".join([_sentence(chosen[0]), *_figures(chosen[0])])
    sure = f"{chosen[0].confidence:.0%} to {chosen[-1].confidence:.0%} sure"
    review = [p.part for p in chosen if p.part in alignment.to_review]
    doubt = f", {len(review)} to review" if review else ""
    return "\n".join([f"{role_or_part}: {len(chosen)} parts, {sure}{doubt}.", *(_sentence(p) for p in chosen)])


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


_FIGURES = {
    "whole": "the whole machine was found: {0:g} (1: every body and joint)",
    "rung": "contact tolerance widened {0:g} times",
    "names for": "its names speak for it by {0:g}",
    "names against": "its names speak for another body by {0:g}",
    "lead": "joints ahead of the runner-up's: {0:.0%}",
}


def _figures(p: PartAssignment) -> list[str]:
    """What a probability rests on, a line each; what plays no part is left out."""
    by = [f"  found by: {name.removeprefix('by ')}" for name in p.evidence if name.startswith("by ")]
    odds = p.evidence.get("strength")
    by += [f"  strength of that: {1 / (1 + float(np.exp(-odds))):.2f}"] if odds is not None else []
    return by + [f"  {_FIGURES[n].format(v)}" for n, v in p.evidence.items() if n in _FIGURES and (v or n == "whole")]


def _sentence(p: PartAssignment) -> str:
    text = f"{p.part}: {p.role or 'no role'} ({p.confidence:.0%}, {p.source}): {p.reason}."
    moves = f" Moves with {p.body}." if p.body not in (None, p.role) else ""
    rival = f" Otherwise: {p.runner_up}." if p.runner_up else ""
    return text + moves + rival
