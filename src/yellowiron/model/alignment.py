"""Alignment: which part plays which role, how sure that is, and why."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats

Vector = tuple[float, float, float]
AssignmentSource = Literal["solved", "name", "edited", "data"]


@dataclass(frozen=True)
class PartAssignment:
    """The role of one part.

    `role` is the template's most specific name for the part (a pin's role; else the role of its body), `body` the
    rigid role it moves with (None: left out of the machine). `confidence` in [0, 1] is the probability that it is
    right, which rests on the figures in `evidence` (see `align.confidence.grounds`); `reason` in words; `edited` parts
    were set by a person and win over every solver.
    """

    part: str
    role: str | None
    body: str | None
    confidence: float
    reason: str
    source: AssignmentSource = "solved"
    runner_up: str | None = None
    evidence: Mapping[str, float] = field(default_factory=dict, compare=False)


@dataclass(frozen=True, eq=False)
class Alignment:
    """Every part's role. `frame` (4, 4) takes CAD metres to the machine frame (+X forward, +Y left, +Z up).

    `choices` are the template's variants as found in the CAD (`{"lift_cylinders": "twin"}`); `missing` lists roles
    that the template requires and no part plays; `to_review` the part ids and roles a person should look at. `counts`:
    row of the template → how many parts it has (`rows.expand` makes them concrete). `axes`: joints that turn about no
    pin of their own → the axis found for them, a point (metres) and a unit vector in the CAD file's frame. `across`:
    those of them that are known roughly → how well across the axis, metres (one sigma). `calibrated`: those that the
    sheet's dimensions placed → by which, in words.
    """

    equipment_type: str
    frame: Floats
    parts: tuple[PartAssignment, ...]
    choices: Mapping[str, str] = field(default_factory=dict)
    missing: tuple[str, ...] = ()
    to_review: tuple[str, ...] = ()
    findings: tuple[Finding, ...] = ()
    counts: Mapping[str, int] = field(default_factory=dict)
    axes: Mapping[str, tuple[Vector, Vector]] = field(default_factory=dict)
    across: Mapping[str, float] = field(default_factory=dict)
    calibrated: Mapping[str, str] = field(default_factory=dict)
