"""What a person can say of the whole machine: which way it faces, which variant it is, what is not drawn of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.alignment import ABSENT, named_direction, twin_role
from yellowiron.model.template import Template
from yellowiron.report.words import sentence, spoken, titled
from yellowiron.studio.operations import whole_words
from yellowiron.studio.session import State


@dataclass(frozen=True)
class Answer:
    """What can be said: `answer` as `align --machine` takes it (with nothing behind the `=`: what was said is taken
    back), and `words` for a person."""

    answer: str
    words: str


def ways_of(state: State) -> list[Answer]:
    """How the machine may face instead, told from how it faces on the page."""
    forward, left, up = np.asarray(state.aligned.frame)[:3, :3]
    ways = (
        ("forward", -forward, "The other end is its front"),
        ("forward", left, "Its left side is its front"),
        ("forward", -left, "Its right side is its front"),
        ("up", -up, "It is upside down"),
        ("up", forward, "What is ahead here is up"),
        ("up", -forward, "What is ahead here is down"),
    )
    return [Answer(f"{name}={named_direction(way)}", words) for name, way, words in ways]


def all_of(state: State, template: Template) -> list[Answer]:
    """Everything that can be said of the machine, what was said first. `template`: with all of its variants."""
    said = state.aligned.machine
    back = [Answer(f"{name}=", f"{whole_words(name, value.text)} · take back") for name, value in said.items()]
    here = Answer(f"forward={named_direction(np.asarray(state.aligned.frame)[0, :3])}", "Its front is as shown")
    variants = [
        Answer(f"{v.name}={choice}", f"{sentence(v.name)}: {spoken(choice)}")
        for v in template.variants for choice in v.choices
    ]  # fmt: skip
    roles = [r for r in state.template.roles if (r.rigid or r.kind == "pin") and not r.many and not r.row]
    pins = [r.name for r in roles if r.kind == "pin"]
    absent = [Answer(f"*_pin={ABSENT}", "Not drawn: all pins")] if len(pins) > 1 else []
    absent += [Answer(f"{role.name}={ABSENT}", f"Not drawn: {titled(role.name).lower()}") for role in roles]
    return [*back, here, *ways_of(state), *variants, *absent]


def together(missing: Sequence[str], template: Template) -> list[list[str]]:
    """Missing roles, together what is drawn or not as one: all halves of an actuator's cylinders, left and right, the
    pins of a type of which none was found."""
    halves: dict[str, str] = {}
    for actuator in template.actuators:
        for cylinder in actuator.cylinders:
            bodies = template.bodies_of(template.joint(cylinder.slide))
            halves |= {body: actuator.name for body in bodies if body is not None}
    pins = {role.name for role in template.roles if role.kind == "pin"}
    none = pins <= set(missing)
    groups: dict[tuple[str, str], list[str]] = {}
    for role in missing:
        twin = twin_role(role) or role
        key = ("halves", halves[role]) if role in halves else ("role", min(role, twin))
        groups.setdefault(("pins", "") if none and role in pins else key, []).append(role)
    return list(groups.values())
