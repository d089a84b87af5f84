"""The machine's joints as a person settles them: how each is known, what else its axis could be, what was said."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from yellowiron.model.mechanism import Joint
from yellowiron.model.template import JointTemplate
from yellowiron.report.html.joints import joint_evidence
from yellowiron.report.rows import in_rows
from yellowiron.report.words import titled
from yellowiron.studio.axes import RoundLine, lines_near, plain
from yellowiron.studio.operations import SIGNED
from yellowiron.studio.session import State

MOST_LINES = 8
"""Other axes that are offered for a joint."""
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


def _others(state: State, joint: JointTemplate, size: float) -> tuple[tuple[str, str], ...]:
    """Lines about which something of the joint's two bodies is round, along its axis: what both have first, then the
    nearest."""
    point, direction = (np.array(v) for v in state.aligned.axes[joint.name])
    wanted = state.template.bodies_of(joint)
    bodies = {p.part: titled(p.body) for p in state.aligned.parts if p.body is not None and p.body in wanted}
    parts = [part for part in state.aligned_model.parts if part.id in bodies]

    def away(line: RoundLine) -> float:
        offset = line.point - point
        return float(np.linalg.norm(offset - (offset @ direction) * direction))

    near = [
        line for line in lines_near(parts, state.aligned_model, direction=direction)
        if _HERE < away(line) < _FAR * size
    ]  # fmt: skip
    near.sort(key=lambda line: (-len({bodies[part] for part in line.radii}), away(line)))
    listed = []
    for line in near[:MOST_LINES]:
        names = " and ".join(sorted({bodies[part] for part in line.radii}))
        words = f"Round of {2e3 * min(line.radii.values()):.3g} mm in {names}, {1e3 * away(line):.0f} mm from there"
        listed.append((json.dumps(_entry((line.point, line.direction))), words))
    return tuple(listed)
