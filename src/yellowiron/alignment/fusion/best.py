"""A labelling of a machine's leading pieces, what it was judged by, and what it scores."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from dataclasses import field as made

import numpy as np

from yellowiron.alignment.fusion.bonds import out_of_line
from yellowiron.alignment.fusion.evidence import Evidence
from yellowiron.alignment.fusion.judge import Field, field_of, score_of, weighed, weights
from yellowiron.alignment.fusion.pieces import largeness
from yellowiron.alignment.fusion.played import drawn_bodies, lacks
from yellowiron.alignment.fusion.votes import BARS, Votes
from yellowiron.model.template import Template
from yellowiron.support.caching.remembered import remembered

CLEAR_LEAD = 12.0
"""A small piece whose body is better than any other by less than this goes with what it touches."""


@dataclass(frozen=True, eq=False)
class Best:
    """The best labelling so far: its score, the variants chosen, the template with them, the labels of the leading
    pieces (their numbers: `leading`), and what they were judged by. `between`: piece → why it is a body between two
    others, where a variant was chosen for that (`interposed`)."""

    score: float
    choices: dict[str, str]
    template: Template
    field: Field
    labels: np.ndarray
    votes: Votes
    leading: tuple[int, ...]
    between: Mapping[int, str] = made(default_factory=dict)

    @property
    def played(self) -> set[str]:
        """The bodies that a piece is of."""
        return {self.field.bodies[n] for n in self.labels if n < len(self.field.bodies)}


def field_of_leading(evidence: Evidence, votes: Votes, resolved: Template) -> Field:
    """The score of the leading pieces."""
    pieces = [evidence.pieces[k] for k in evidence.leading]
    told = [votes[k] for k in evidence.leading]
    return field_of(told, evidence.between, resolved, weights(), out_of_line(pieces), largeness(pieces))


def labels_in(
    field: Field, other: Best, leading: Sequence[int], standing: Mapping[str, str] | None = None
) -> np.ndarray:
    """Another variant's labels as those of a field of the `leading` pieces: of the same bodies, of those that are
    `standing` for them, or of none, as are pieces that it did not have."""
    place = {body: n for n, body in enumerate(field.bodies)}
    told = [place.get((standing or {}).get(body, body), len(place)) for body in other.field.bodies]
    labels = dict(zip(other.leading, np.array([*told, len(place)])[other.labels].tolist(), strict=True))
    return np.array([labels.get(k, len(place)) for k in leading], dtype=np.int64)


@remembered
def standing_for(other: Template, own: Template) -> Mapping[str, str]:
    """Half of a hydraulic cylinder that another variant has and a variant has not → that of the variant's cylinder
    which is hinged on the same two bodies: a single one's for either of twins, the left twin's for a single one."""
    halves = {r.name: r.kind for r in own.roles if r.rigid and r.kind in BARS}
    held = {_between(own, name): name for name in reversed(halves)}
    extra = [r.name for r in other.roles if r.rigid and r.kind in BARS and r.name not in halves]
    return {name: held[ends] for name in extra if (ends := _between(other, name)) in held}


def _between(template: Template, half: str) -> tuple[str, frozenset[str]]:
    """Which half of a hydraulic cylinder a body is, and the bodies that the cylinder is hinged on."""
    pairs = [(j.type, {str(b) for b in template.bodies_of(j)}) for j in template.joints]
    halves = {b for kind, pair in pairs if kind == "prismatic" and half in pair for b in pair} | {half}
    ends = {b for kind, pair in pairs if kind != "prismatic" and pair & halves for b in pair} - halves
    return str(template.role(half).kind), frozenset(ends)


def drawn(evidence: Evidence, bodies: Sequence[str], labels: np.ndarray, template: Template) -> set[str]:
    """The bodies that the labels show as drawn."""
    return drawn_bodies([evidence.pieces[k] for k in evidence.leading], labels, bodies, template, evidence.surface)


def lacking(evidence: Evidence, bodies: Sequence[str], labels: np.ndarray, template: Template) -> float:
    """What a labelling loses by what the variant has and nothing plays."""
    lost = lacks(template, drawn(evidence, bodies, labels, template), evidence.stance.absent, len(evidence.leading))
    return weighed({**lost, "place": evidence.crowding}, weights())


def whole_score(evidence: Evidence, field: Field, labels: np.ndarray, template: Template) -> float:
    """What a labelling scores with what the variant has and nothing plays."""
    return score_of(field, labels) + lacking(evidence, field.bodies, labels, template)
