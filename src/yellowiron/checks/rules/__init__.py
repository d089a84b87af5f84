"""The rules, in the order of their codes: `View` → remarks, each with a stable code.

A topic a module, a rule a function under `@rule`: a rule is added by writing it in its topic's module, a topic by
naming its module here.
"""

from __future__ import annotations

from collections.abc import Iterable
from types import ModuleType

from yellowiron.checks.rule import Rule
from yellowiron.checks.rules import (
    articulation,
    bodies,
    collision,
    drives,
    followers,
    frames,
    joints,
    limits,
    loops,
    mass,
    materials,
    records,
    references,
    stage,
)

TOPICS = (
    stage,
    references,
    bodies,
    mass,
    joints,
    frames,
    limits,
    drives,
    articulation,
    loops,
    followers,
    collision,
    materials,
    records,
)


def rules_of(topics: Iterable[ModuleType]) -> tuple[Rule, ...]:
    """The rules that modules define, in the order in which they are written."""
    return tuple(value for topic in topics for value in vars(topic).values() if isinstance(value, Rule))


RULES = tuple(sorted(rules_of(TOPICS), key=lambda rule: rule.code))

_OF_STAGES = {"CHK067", "CHK098"}
"""Not of URDF and its like: the zero of their joints, where they are read, is no pose that a machine stands in, and a
slide may follow a pivot."""
EXCHANGED = tuple(
    rule
    for rule in sorted(rules_of((mass, joints, frames, limits, drives, loops, followers)), key=lambda rule: rule.code)
    if rule.code not in _OF_STAGES
)
"""The rules of files of which links and joints alone are read."""
