"""The rules, in the order of their codes. A topic a module, a rule a function."""

from __future__ import annotations

from yellowiron.checks.rules import (
    articulation,
    bodies,
    collision,
    drives,
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

RULES = (
    *stage.RULES,
    *references.RULES,
    *bodies.RULES,
    *mass.RULES,
    *joints.RULES,
    *frames.RULES,
    *limits.RULES,
    *drives.RULES,
    *articulation.RULES,
    *loops.RULES,
    *collision.RULES,
    *materials.RULES,
    *records.RULES,
)
