"""What a built machine can do and what it cannot, lever by lever, in one sentence."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from yellowiron.model.alignment import Alignment
from yellowiron.model.mechanism import Actuator, Mechanism
from yellowiron.model.template import ActuatorTemplate, Template
from yellowiron.report.words import spoken
from yellowiron.support.graphs import blocks

_GUESS = "ALN016"
_BARE = {
    "MEC013": "driven at its hinge, its cylinder is missing",
    "MEC018": "driven at its hinge, its cylinder does not work as it was found",
    "MEC038": "at its wheels, no knuckle is drawn",
}


@dataclass(frozen=True)
class Lever:
    """One of the template's actuators: whether it moves what it should, and `why` it does not, or what is to be known
    of how it does."""

    name: str
    moves: bool
    why: str = ""


def levers_of(mechanism: Mechanism, template: Template, alignment: Alignment) -> tuple[Lever, ...]:
    """Every actuator of a template with its variants decided, as the mechanism has it. A cylinder that closes no loop
    moves nothing but itself."""
    edges = {j.name: template.bodies_of(j) for j in template.joints}
    together = {name: block for block in blocks(edges) for name in block}
    built = {a.name: a for a in mechanism.actuators}
    looped = {name for loop in mechanism.loops for name in loop.joints}
    told = {(f.code, f.where) for f in (*alignment.findings, *mechanism.findings) if f.severity != "info"}
    found = []
    for wanted in template.actuators:
        if wanted.slave:
            continue
        slides = [c.slide for c in wanted.cylinders if c.slide in edges]
        joints = tuple(dict.fromkeys(j for name in (*slides, *wanted.joints) for j in together.get(name, (name,))))
        actuator = built.get(wanted.name)
        # What a winch moves hangs on it, in no loop.
        idle = actuator is None or (wanted.kind != "winch" and _idle(actuator, mechanism, looped))
        if idle:
            found.append(Lever(wanted.name, False, _why_not(wanted, joints, template, mechanism, alignment)))
            continue
        guessed = [j for j in joints if (_GUESS, j) in told]
        words = [said for code, said in _BARE.items() if (code, wanted.name) in told]
        words += (
            [f"{len(guessed)} of its axes estimated" if len(guessed) > 1 else "an axis estimated"] if guessed else []
        )
        found.append(Lever(wanted.name, True, ", ".join(words)))
    return tuple(found)


def verdict(levers: Sequence[Lever]) -> str:
    """`Moves: swing, boom (an axis estimated). Does not move: bucket (bucket link is missing).`"""
    moving = [_said(one) for one in levers if one.moves]
    still = [_said(one) for one in levers if not one.moves]
    words = [f"Moves: {', '.join(moving)}."] if moving else []
    words += [f"Does not move: {', '.join(still)}."] if still else []
    return " ".join(words)


def _said(lever: Lever) -> str:
    return f"{spoken(lever.name)} ({lever.why})" if lever.why else spoken(lever.name)


def _idle(actuator: Actuator, mechanism: Mechanism, looped: Collection[str]) -> bool:
    """True for an actuator that has lost its joints, or drives slides that close no loop, save those of cylinders
    without pins: what they push needs none."""
    looped = {*looped, *(c.slide for c in mechanism.cylinders if not c.pins)}
    kinds = {j.name: j.type for j in mechanism.joints}
    joints = [j.joint for j in actuator.joints if j.joint in kinds]
    return not any(kinds[j] != "prismatic" or j in looped for j in joints)


def _why_not(
    wanted: ActuatorTemplate, joints: Sequence[str], template: Template, mechanism: Mechanism, alignment: Alignment
) -> str:
    missing = [r for r in alignment.missing if template.role(r).rigid]
    bodies = dict.fromkeys(str(b) for j in joints for b in template.bodies_of(template.joint(j)))
    gone = [spoken(b) for b in bodies if b in missing]
    if gone:
        return f"{' and '.join(gone[:2])} {'is' if len(gone) == 1 else 'are'} missing" + (
            f", with {len(gone) - 2} more" if len(gone) > 2 else ""
        )
    there = {j.name for j in mechanism.joints}
    lost = [j for j in joints if j not in there]
    return f"joint {lost[0]} is not found" if lost else "nothing drives it"
