"""Alignment: which part plays which role, how sure that is, and why."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats

Vector = tuple[float, float, float]
AssignmentSource = Literal["solved", "name", "edited", "confirmed", "rule", "data"]
DECIDED: frozenset[AssignmentSource] = frozenset(("edited", "confirmed", "rule", "data"))
"""Sources that no solver overrules: a person's role, a person's yes to a role that was found, a pattern of a person's,
and a document of the user's."""

LARGEST_FILE = 64 * 1024 * 1024
"""Bytes of an alignment.json: that of a model of a hundred thousand parts."""


@dataclass(frozen=True)
class Signature:
    """Who decided something, when (an ISO date) and why; each may be empty."""

    by: str = ""
    date: str = ""
    why: str = ""

    def __bool__(self) -> bool:
        return bool(self.by or self.date or self.why)


UNSIGNED = Signature()


@dataclass(frozen=True)
class RoleRule:
    """A person's word for all parts that fit a pattern over the CAD tree (`alignment.files.decisions.fits`); no role:
    not part of the machine."""

    pattern: str
    role: str | None
    signature: Signature = UNSIGNED


@dataclass(frozen=True)
class PartDecision:
    """A person's word for one part: `edited` (no role: not part of the machine), `confirmed`, or `solved`, which takes
    back what was said of it before."""

    role: str | None
    source: AssignmentSource
    signature: Signature = UNSIGNED


@dataclass(frozen=True)
class GivenValue:
    """A value that a person gives beside the sheet, as `--set` takes it: `1400 mm`."""

    text: str
    signature: Signature = UNSIGNED


@dataclass(frozen=True)
class Decisions:
    """What a person decides beside what an alignment file says: `rules`, patterns of parts whose role is `confirmed`,
    or of which every earlier decision is `forgotten`, and single `parts` by their ids, which go before all of these;
    `machine`: as an `Alignment`'s."""

    rules: tuple[RoleRule, ...] = ()
    confirmed: tuple[str, ...] = ()
    forgotten: tuple[str, ...] = ()
    signature: Signature = UNSIGNED
    parts: Mapping[str, PartDecision] = field(default_factory=dict)
    machine: Mapping[str, GivenValue] = field(default_factory=dict)


UNDECIDED = Decisions()


@dataclass(frozen=True)
class Suggestion:
    """Which body a language model points to for a part (None: none of those offered), and why in its words; `question`
    stands for what it was asked (a digest). It decides nothing."""

    body: str | None
    model: str
    question: str
    reason: str = ""


@dataclass(frozen=True)
class PartAssignment:
    """The role of one part.

    `role` is the template's most specific name for the part (a pin's role; else the role of its body), `body` the
    rigid role it moves with (None: left out of the machine). `confidence` in [0, 1] is the probability that it is
    right, which rests on the figures in `evidence` (see `align.confidence.grounds`); `reason` in words; what is
    `DECIDED` wins over every solver, signed by who decided it. A `suggestion` is to be read, and counts for nothing.
    """

    part: str
    role: str | None
    body: str | None
    confidence: float
    reason: str
    source: AssignmentSource = "solved"
    runner_up: str | None = None
    evidence: Mapping[str, float] = field(default_factory=dict, compare=False)
    signature: Signature = UNSIGNED
    suggestion: Suggestion | None = None

    @property
    def why(self) -> str:
        """The reason, and what a language model said of it."""
        said = self.suggestion
        if said is None:
            return self.reason
        other = f"points to {said.body}" if said.body is not None else "takes it for none of those offered"
        words = f"; {said.model} {'agrees' if said.body == self.body else other}"
        return self.reason + words + (f" ({said.reason})" if said.reason else "")


@dataclass(frozen=True, eq=False)
class Alignment:
    """Every part's role. `frame` (4, 4) takes CAD metres to the machine frame (+X forward, +Y left, +Z up).

    `choices` are the template's variants as found in the CAD (`{"lift_cylinders": "twin"}`); `missing` lists roles
    that the template requires and no part plays; `to_review` the part ids and roles a person should look at. `counts`:
    row of the template → how many parts it has (`rows.expand` makes them concrete). `axes`: joints that turn about no
    pin of their own → the axis found for them, a point (metres) and a unit vector in the CAD file's frame. `across`:
    those of them that are known roughly → how well across the axis, metres (one sigma). `calibrated`: those that the
    sheet's dimensions placed → by which, in words. `rules`: a person's, the last word of several. `joints`: name →
    what a person says of a joint, as an entry of a `--data` document of joints. `values`: name → what a person gives
    beside the sheet. `by_hand`: joints whose axis is a person's. `machine`: name → what a person says of the machine as
    a whole (`alignment.files.whole`). `open_choices`: variant → the choices that are nearly as good as the one found.
    `facing_doubt`: in words, why the machine may face otherwise.
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
    rules: tuple[RoleRule, ...] = ()
    joints: Mapping[str, Mapping[str, object]] = field(default_factory=dict)
    values: Mapping[str, GivenValue] = field(default_factory=dict)
    by_hand: frozenset[str] = frozenset()
    machine: Mapping[str, GivenValue] = field(default_factory=dict)
    open_choices: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    facing_doubt: str = ""

    def suggested(self, said: Mapping[str, Suggestion]) -> Alignment:
        """The same alignment with suggestions (part → suggestion) on its parts in place of those it had."""
        return replace(self, parts=tuple(replace(p, suggestion=said.get(p.part)) for p in self.parts))
