"""The machine's joints as a person settles them: how each is known, what else its axis could be, what was said."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Joint
from yellowiron.model.template import JointTemplate
from yellowiron.report.html.joints import joint_evidence
from yellowiron.report.rows import in_rows
from yellowiron.report.words import titled
from yellowiron.studio.axes import FoundAxis, RoundLine, found_axis, lines_near, plain
from yellowiron.studio.operations import SIGNED
from yellowiron.studio.session import State

MOST_LINES, MOST_ROUNDS = 8, 60
"""Other axes that are offered for a joint in doubt; round things to choose from while its axis is pointed at."""
_FAR = 0.2
"""Of the machine's size: an axis farther off is not offered."""
_HERE = 1e-3
"""Metres: a line so near is the axis that the joint has."""
_KINDS = ("revolute", "prismatic", "spherical")
Known = Literal["found", "guess", "given", "none"]


@dataclass(frozen=True)
class JointState:
    """A joint: how its axis is `known`, why (`reason`), what a person said of it (`entry`), its `axis` as it would be
    confirmed, and other axes, each an entry and words for it. `doubt`: metres by which it may be off, where that is
    much. `limits` count from the pose that is shown undriven, which is `began` metres or radians from the drawn one."""

    name: str
    title: str
    type: str
    bodies: tuple[str, str]
    known: Known
    reason: str
    entry: Mapping[str, Any]
    axis: Mapping[str, Any]
    others: tuple[tuple[str, str], ...]
    doubt: float
    began: float
    limits: tuple[float | None, float | None]


def joints_of(state: State, size: float) -> list[JointState]:
    """The joints that turn or slide, in the template's order; `size` is the machine's, metres."""
    solved = state.solved
    made = {joint.name: joint for joint in solved.mechanism.joints} if solved is not None else {}
    started = solved.started if solved is not None else {}
    guessed = {f.where: f.message for f in state.aligned.findings if f.code == "ALN016"}
    names = [joint.name for joint in state.template.joints]
    # Of a counted row, such as track rollers, there is nothing to settle one by one.
    alone = {names[places[0]] for places in in_rows(names).values() if len(places) == 1}
    return [
        _joint(joint, state, made.get(joint.name), guessed, started.get(joint.name, 0.0), size)
        for joint in state.template.joints if joint.type in _KINDS and joint.name in alone
    ]  # fmt: skip


def _joint(
    joint: JointTemplate, state: State, made: Joint | None, guessed: Mapping[str, str], began: float, size: float
) -> JointState:
    bodies = state.template.bodies_of(joint)
    axis = state.aligned.axes.get(joint.name)
    doubt = state.aligned.across.get(joint.name, 0.0)
    known: Known
    if joint.name in state.aligned.by_hand:
        known, reason, doubt = "given", "A person gave its axis.", 0.0
    elif joint.name in guessed:
        known, reason = "guess", guessed[joint.name]
    elif made is not None:
        known, reason = "found", joint_evidence(made.source, {})
    else:
        known, reason = "none", "Nothing shows it."
    return JointState(
        joint.name, titled(joint.name.removesuffix("_joint")), joint.type, (bodies[0] or "", bodies[1] or ""),
        known, reason, {k: v for k, v in state.aligned.joints.get(joint.name, {}).items() if k not in SIGNED},
        _entry(axis) if axis is not None else {}, _others(state, joint, size) if doubt > 0.0 else (), doubt, began,
        (made.lower, made.upper) if made is not None else (None, None),
    )  # fmt: skip


def _entry(axis: tuple[Any, Any]) -> dict[str, Any]:
    point, direction = axis
    return {"anchor": plain(point), "axis": plain(direction)}


def rounds_of(state: State, name: str) -> list[FoundAxis]:
    """Lines about which something of a joint's two bodies is round, as a click on it would give them: what both have
    first, then the nearest to its axis, or to where the bodies meet. No more than `MOST_ROUNDS`."""
    joint = next((joint for joint in state.template.joints if joint.name == name), None)
    if joint is None:
        return []
    listed = []
    for away, line, names in _near(state, joint)[:MOST_ROUNDS]:
        part, radius = min(line.radii.items(), key=lambda each: (each[1], each[0]))
        there = f", {1e3 * away:.0f} mm from there" if away > _HERE else ""
        words = f"Round of {2e3 * radius:.3g} mm in {names}{there}"
        listed.append(found_axis(_entry((line.point, line.direction)), words, state.aligned_model.part(part), line))
    return listed


def _others(state: State, joint: JointTemplate, size: float) -> tuple[tuple[str, str], ...]:
    """Other lines along the joint's axis that it could be."""
    near = [one for one in _near(state, joint, along=True) if _HERE < one[0] < _FAR * size]
    return tuple(
        (
            json.dumps(_entry((line.point, line.direction))),
            f"Round of {2e3 * min(line.radii.values()):.3g} mm in {names}, {1e3 * away:.0f} mm from there",
        )
        for away, line, names in near[:MOST_LINES]
    )


def _near(state: State, joint: JointTemplate, *, along: bool = False) -> list[tuple[float, RoundLine, str]]:
    """Lines about which something of a joint's two bodies is round, what both have first, then the nearest: metres from
    its axis (or from where the bodies meet), the line, its bodies in words. `along`: only those along its axis."""
    wanted = state.template.bodies_of(joint)
    bodies = {p.part: titled(p.body) for p in state.aligned.parts if p.body is not None and p.body in wanted}
    parts = [part for part in state.aligned_model.parts if part.id in bodies]
    axis = state.aligned.axes.get(joint.name)
    if not parts or (along and axis is None):
        return []
    point = np.array(axis[0]) if axis is not None else _meeting(parts, state.aligned_model, bodies)
    direction = np.array(axis[1]) if axis is not None and along else None

    def away(line: RoundLine) -> float:
        offset = line.point - point
        return float(np.linalg.norm(offset - (offset @ line.direction) * line.direction))

    lines = lines_near(parts, state.aligned_model, direction=direction)
    named = [(away(line), line, sorted({bodies[part] for part in line.radii})) for line in lines]
    named.sort(key=lambda one: (-len(one[2]), one[0]))
    return [(far, line, " and ".join(names)) for far, line, names in named]


def _meeting(parts: Sequence[Part], assembly: Assembly, bodies: Mapping[str, str]) -> Floats:
    """(3,) the middle of what the boxes of two bodies share, or of the gap between them, CAD file's frame."""
    lows, highs = [], []
    for body in sorted(set(bodies.values())):
        points = np.concatenate([assembly.points_of(part) for part in parts if bodies[part.id] == body])
        lows.append(points.min(axis=0, initial=np.inf))
        highs.append(points.max(axis=0, initial=-np.inf))
    middle = 0.5 * (np.max(lows, axis=0) + np.min(highs, axis=0))
    return np.nan_to_num(middle, posinf=0.0, neginf=0.0)
