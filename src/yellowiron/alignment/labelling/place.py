"""The place of a part: what labelling knows of it so far."""

from __future__ import annotations

from dataclasses import dataclass

from yellowiron.model.template import JointTemplate, Template

DOUBTFUL = 0.4
"""Confidence of what a person should look at."""


@dataclass(frozen=True)
class Place:
    """What is known of one part: role, body, strength of the evidence (0 to 1, no probability: see `confidence`),
    reason, runner-up (a body), whether a name decided it, and what it was found by: `joints`, `pin`, `bores`, `flat`,
    `ring`, `touch`, `near`, `name` or `track`. `said`: how much more its names speak of the body than of any other;
    `lead`: how many more of its joints hold than of the runner-up's, as a share."""

    role: str
    body: str
    confidence: float
    reason: str
    runner_up: str | None = None
    by_name: bool = False
    how: str = "joints"
    said: float = 0.0
    lead: float = 1.0


def pin_role(joint: JointTemplate, template: Template) -> str | None:
    """The role of a joint's pin: the one of its two parts that is no body."""
    for name in joint.parts:
        if not template.role(name.partition("[")[0]).rigid:
            return name
    return None
