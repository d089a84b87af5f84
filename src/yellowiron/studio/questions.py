"""What a person is asked: not part by part, the most consequential first, with what else it could be."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from yellowiron.alignment import named_direction, twin_role
from yellowiron.model.alignment import Suggestion
from yellowiron.model.geometry import Floats
from yellowiron.model.specification import Specification, fold
from yellowiron.opinion.doubts import Doubt, doubts_of, size_of, spread
from yellowiron.report.words import counted, sentence, spoken, titled
from yellowiron.studio.joints import JointState
from yellowiron.studio.machine import together, ways_of
from yellowiron.studio.session import State

MOST_CANDIDATES = 9
"""As many as there are digits to choose them by."""
_WHOLE = 1000.0
"""What the whole machine weighs: before anything else."""
_LITTLE = 0.4
"""Doubts that weigh less are asked with others of their body: about a few bolts, or parts that are nearly sure."""
_PIN = 0.05
"""What a missing pin weighs: its joint has an axis without it."""
_AXIS = 50.0
"""What an axis weighs that is as uncertain as the machine is large."""
_UNITS = {"m": ("mm", 1e3), "rad": ("deg", 180.0 / np.pi), "kg": ("kg", 1.0), "Pa": ("MPa", 1e-6), "N": ("kN", 1e-3)}
"""SI unit → the one that a person reads, and what it is multiplied by."""


@dataclass(frozen=True)
class Candidate:
    """An answer: `answer` (a role, a part or a value), and `words` for a person."""

    answer: str
    words: str


@dataclass(frozen=True)
class Question:
    """One thing to settle. Of the `machine` as a whole: which way it faces, which variant it is; `yes` and the answers
    are what `align --machine` takes. Of `parts`: whether they play the roles that they were given. Of a `role`: which
    part plays it, or that neither it nor what else is in `absent` is drawn. Of a `value`: what it is, `parts` being
    those that it is about. Of a `joint`: where its axis is. `weight` says how much hangs on it, `known` what is known
    beside the reason."""

    kind: Literal["machine", "parts", "role", "value", "joint"]
    key: str
    title: str
    weight: float
    reason: str = ""
    parts: tuple[str, ...] = ()
    candidates: tuple[Candidate, ...] = ()
    known: tuple[str, ...] = ()
    page: int | None = None
    file: str = ""
    yes: str = ""
    absent: str = ""


def questions(state: State, boxes: Mapping[str, Floats], joints: Sequence[JointState] = ()) -> list[Question]:
    """What is to ask of a state and its joints, the most consequential first. `boxes`: part → its (2, 3) box in the CAD
    file's frame, metres, by which what is near is offered first."""
    found = [*_of_whole(state), *_of_parts(state, boxes), *_of_roles(state, boxes), *_of_joints(joints, boxes)]
    found += _of_values(state)
    return sorted(found, key=lambda q: (-q.weight, q.key))


def _of_whole(state: State) -> list[Question]:
    """Which way the machine faces, and which of the type's variants it is, where that is in doubt: parts follow."""
    found = []
    aligned = state.aligned
    if aligned.facing_doubt and "forward" not in aligned.machine:
        here = f"forward={named_direction(np.asarray(aligned.frame)[0, :3])}"
        found.append(Question(
            "machine", "machine:forward", "Is this its front?", _WHOLE + 1.0, sentence(aligned.facing_doubt),
            candidates=tuple(Candidate(way.answer, way.words) for way in ways_of(state)), yes=here,
        ))  # fmt: skip
    for name, others in aligned.open_choices.items():
        own = aligned.choices[name]
        found.append(Question(
            "machine", f"machine:{name}", f"{sentence(name)}: {spoken(own)}?", _WHOLE,
            f"What is drawn fits {' and '.join(spoken(c) for c in sorted((own, *others)))} as well.",
            candidates=tuple(Candidate(f"{name}={other}", sentence(other)) for other in others), yes=f"{name}={own}",
        ))  # fmt: skip
    return found


def _of_parts(state: State, boxes: Mapping[str, Floats]) -> list[Question]:
    """Doubted parts together where they were given the same body and could be the same other one; those on which little
    hangs together with all such of their body, and of its twin on the other side: one look tells whether they are."""
    said = {p.part: p.suggestion for p in state.alignment.parts if p.suggestion is not None}
    groups: dict[str, list[Doubt]] = {}
    for doubt in doubts_of(state.alignment, state.template, boxes):
        body = doubt.body or ""
        alone = f"parts:{body}:{doubt.runner_up or ''}"
        little = f"parts:{min(body, twin_role(body) or body)}"
        groups.setdefault(little if body and doubt.weight < _LITTLE else alone, []).append(doubt)
    found = []
    for key, doubts in groups.items():
        first = max(doubts, key=lambda doubt: doubt.weight)
        bodies = list(dict.fromkeys(doubt.body for doubt in doubts))
        parts = tuple(sorted(part for doubt in doubts for part in doubt.parts))
        called = titled(first.body) if first.body else "No part of the machine"
        called = f"{called[:-2]}, left and right" if len(bodies) > 1 else called
        count = f", {len(parts)} parts" if len(parts) > 1 else ""
        others = dict.fromkeys(role for doubt in doubts for role in doubt.others)
        # Of both sides none is another's left or right.
        listed = [role for role in others if len(bodies) == 1 or twin_role(role) is None]
        listed = [role for role in listed if role not in bodies]
        found.append(Question(
            "parts", key, f"{called}{count}?", first.weight, first.reason, parts,
            tuple(Candidate(role, titled(role)) for role in listed[:MOST_CANDIDATES]),
            tuple(_suggested([said[part] for part in parts if part in said])),
        ))  # fmt: skip
    return found


def _suggested(said: Sequence[Suggestion]) -> Iterator[str]:
    """What language models that were asked say, in words."""
    for (model, body), number in Counter((one.model, one.body) for one in said).items():
        called = titled(body) if body is not None else "none of those offered"
        yield f"{model} says, and decides nothing: {called} ({counted(number, 'part')})."


def _of_roles(state: State, boxes: Mapping[str, Floats]) -> list[Question]:
    """A required role that no part plays: which one does, those that could be it first. Not a pin whose joint has its
    axis all the same (nothing hangs on it, and many models have none), or lacks a body (of which is asked first)."""
    made = {joint.name for joint in state.solved.mechanism.joints} if state.solved is not None else set()
    lacking = set(state.alignment.missing)
    idle = {
        part
        for joint in state.template.joints
        if joint.name in made or not lacking.isdisjoint(state.template.bodies_of(joint))
        for part in joint.parts
    }
    joints = Counter(body for joint in state.template.joints for body in state.template.bodies_of(joint))
    found = []
    asked = [role for role in state.alignment.missing if role not in idle or joints[role]]
    for group in together(asked, state.template):
        role = group[0]
        could = [p.part for p in state.alignment.parts if p.runner_up == role]
        loose = [p.part for p in state.alignment.parts if p.role is None and p.part in boxes]
        loose = sorted(loose, key=lambda part: (-spread(boxes[part]), part))
        listed = list(dict.fromkeys([*could, *loose]))[:MOST_CANDIDATES]
        weight = 2.0 + joints[role] if joints[role] else _PIN
        found.append(Question(
            "role", f"role:{role}", f"Which part is the {titled(role).lower()}?", weight,
            "Nothing was found for it.", known=_others_too(group), absent=",".join(group),
            candidates=tuple(Candidate(p, p.rsplit("/", 1)[-1]) for p in listed),
        ))  # fmt: skip
    return found


def _others_too(group: Sequence[str]) -> tuple[str, ...]:
    others = ", ".join(titled(role).lower() for role in group[1:4]) + (" …" if len(group) > 4 else "")
    return (f"Nor for: {others}.",) if others else ()


def _of_joints(joints: Sequence[JointState], boxes: Mapping[str, Floats]) -> list[Question]:
    """Joints whose axis is a rough guess: whether it is right, and which others there are."""
    size = size_of(boxes)
    return [
        Question(
            "joint", f"joint:{joint.name}", f"{joint.title}: is its axis there?",
            1.0 + min(_AXIS * joint.doubt / size, 2.0), joint.reason,
            candidates=tuple(Candidate(entry, words) for entry, words in joint.others),
        )
        for joint in joints if joint.doubt > 0.0
    ]  # fmt: skip


def _of_values(state: State) -> list[Question]:
    """Values that a limit needs and nothing gives, and those of the sheet that are in doubt."""
    missing = set(state.document.get("missing", ()))
    found = []
    for name in sorted(missing | {s.name for s in state.specifications if s.status in ("review", "conflict")}):
        said = state.specifications.get(name)
        offered = [] if said is None else _offered(said)
        drawn, known, parts = _of_machine(name, state)
        reason = (said.reason or said.hint) if said is not None else "It is on no sheet, and was not given."
        evidence = said.evidence if said is not None else None
        page, file = (evidence.page, evidence.file) if evidence is not None else (None, "")
        found.append(Question(
            "value", f"value:{name}", f"{name}?", 3.0 if name in missing else 0.5, reason, parts,
            candidates=(*offered, *drawn)[:MOST_CANDIDATES], known=known, page=page, file=file,
        ))  # fmt: skip
    return found


def _offered(said: Specification) -> list[Candidate]:
    """What a sheet offers for a value in doubt."""
    values = [(said.value, said.unit, said.evidence)] if said.value is not None else []
    values += [(c.value, c.unit, c.evidence) for c in said.candidates]
    found: dict[str, Candidate] = {}
    for value, unit, evidence in values:
        text = in_words(value, unit)
        where = f"page {evidence.page}: {evidence.quote}" if evidence is not None else ""
        found.setdefault(text, Candidate(text, f"{text}  {where}".strip()))
    return list(found.values())[:MOST_CANDIDATES]


def _of_machine(name: str, state: State) -> tuple[list[Candidate], tuple[str, ...], tuple[str, ...]]:
    """What the machine itself says of a limit: the strokes that its cylinders have now, each with where that comes
    from, how the cylinders are drawn, and their parts."""
    if state.solved is None:
        return [], (), ()
    slides = {
        joint.name
        for joint in state.template.joints
        for limit in (joint.lower, joint.upper)
        if isinstance(limit, str) and fold(limit.lstrip("-− ")) == fold(name)
    }
    found: dict[str, Candidate] = {}
    known, bodies = [], set()
    for cylinder in state.solved.mechanism.cylinders:
        if cylinder.slide not in slides:
            continue
        bodies |= {cylinder.barrel, cylinder.rod}
        if np.isfinite(cylinder.stroke) and cylinder.stroke > 0.0:
            text = in_words(cylinder.stroke, "m")
            source = cylinder.sources.get("stroke", "").replace("geometry: ", "in the CAD model, ")
            source = source.removesuffix(f", {text}")
            found.setdefault(text, Candidate(text, f"{text}: {source}" if source else text))
        if np.isfinite(cylinder.drawn_length):
            known.append(f"{titled(cylinder.name)}: pins {1e3 * cylinder.drawn_length:.0f} mm apart as drawn.")
    parts = tuple(sorted(p.part for p in state.alignment.parts if p.body in bodies))
    return list(found.values()), tuple(dict.fromkeys(known)), parts


def in_words(value: float, unit: str) -> str:
    """A value as a person writes it, and as `--set` takes it."""
    shown, factor = _UNITS.get(unit, (unit, 1.0))
    return f"{value * factor:.6g} {shown}" if shown != "1" else f"{value:.6g}"
