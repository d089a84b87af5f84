"""A labelling of a machine's leading pieces, what it was judged by, and what it scores; and how it is mended by the
surface that each body has.

With twice or half of its usual surface a body is still itself, with a tenth it is a piece of itself, and the rest was
taken for another's. Of 23 models of strangers, 126 frames, arms, links and tools have 0.95 times the usual surface
(the logarithms' mean; their deviation is 0.48). It says little where a body is one piece, and much where it is shells
by the dozen.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from dataclasses import field as made

import numpy as np

from yellowiron.alignment.fusion.bonds import out_of_line
from yellowiron.alignment.fusion.evidence import Evidence
from yellowiron.alignment.fusion.judge import Field, Ints, field_of, score_of, scores_of, weighed, weights
from yellowiron.alignment.fusion.pieces import largeness
from yellowiron.alignment.fusion.played import drawn_bodies, lacks
from yellowiron.alignment.fusion.votes import AREA, BARS, MOST, Votes
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template
from yellowiron.support.caching.remembered import remembered

CLEAR_LEAD = 12.0
"""A small piece whose body is better than any other by less than this goes with what it touches."""
ROUNDS = 40
"""So many times at most some pieces become another body."""
CLEARLY = 3.0
"""… each time by a labelling that is better by more than this, …"""
FITTER = 9.0
"""… and whose surfaces are, by more than this: what else speaks for a body has been heard."""


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


def by_surface(best: Best, evidence: Evidence) -> Best:
    """The labelling mended by the surface that each body usually has: pieces, with what is beside them of their body
    and with their mirror images, become another body as long as that is better for it. No body is lost for that, and
    what was chosen to be between two others stays that. The score, by which variants compare, is as it was."""
    surface = Surfaces(best.field, best.template, evidence, best.leading)
    pieces, field = len(best.labels), best.field
    if pieces <= len(field.bodies) or not surface.known.any():
        return best
    kept = [n for n, k in enumerate(best.leading) if k in best.between]
    labels, none = best.labels, len(field.bodies)
    cost = surface.cost(labels[None])[0]
    reached = score_of(field, labels) + cost + lacking(evidence, field.bodies, labels, best.template)
    for _ in range(ROUNDS):
        others = _changed(field, labels)
        costs = surface.cost(others)
        played = [(others == n).any(axis=1) for n in np.unique(labels[labels < none]).tolist()]
        may_be = (costs > cost + FITTER) & (others[:, kept] == labels[kept]).all(axis=1) & np.all(played, axis=0)
        if not may_be.any():
            break
        others, costs = others[may_be], costs[may_be]
        found = scores_of(field, others) + costs
        chosen = int(np.argmax(found))
        score = float(found[chosen]) + lacking(evidence, field.bodies, others[chosen], best.template)
        if score <= reached + CLEARLY:
            break
        labels, reached, cost = others[chosen], score, costs[chosen]
    return best if labels is best.labels else replace(best, labels=labels)


class Surfaces:
    """What the leading pieces have of the machine's surface, and what bodies usually have of it (`known`: of which
    that is known)."""

    def __init__(self, field: Field, template: Template, evidence: Evidence, leading: tuple[int, ...]) -> None:
        usual = [template.usual.get(body) for body in field.bodies]
        # Halves of cylinders are one piece or two, and thick or thin.
        self.known = np.array([u is not None and u.area > 0.0 for u in usual]) & ~field.halves[:-1]
        self._usual = np.array([1.0 if u is None or u.area <= 0.0 else u.area for u in usual])
        areas = np.array([evidence.pieces[k].area for k in leading])
        # What does not lead is spread over the bodies; tracks, which are no pieces, are the root's.
        apart = max(0.0, 1.0 - sum(p.area for p in evidence.pieces) / evidence.surface)
        self._share = evidence.stance.drawn * (1.0 - apart) * areas / max(float(areas.sum()), 1e-300)
        self._rest = evidence.stance.drawn * apart * np.array([b == template.root for b in field.bodies])

    def cost(self, labels: Ints) -> Floats:
        """(n,) what speaks against labellings (n, pieces), in the score's points."""
        count = len(self._usual)
        rows = np.arange(len(labels))[:, None] * (count + 1)
        held = np.bincount(
            (labels + rows).ravel(), np.tile(self._share, len(labels)), minlength=len(labels) * (count + 1)
        ).reshape(len(labels), -1)[:, :count]
        least, most = np.log(np.maximum(held, 1e-12) / self._usual), np.log((held + self._rest) / self._usual + 1e-12)
        off = np.where(least > 0.0, least, np.minimum(most, 0.0)) / AREA
        against = np.where(self.known & (held > 0.0), np.minimum(0.5 * off * off, MOST), 0.0)
        return np.asarray(weights()["surface"] * against.sum(axis=1))


def _changed(field: Field, labels: Ints) -> Ints:
    """(n, pieces) the labels with some pieces as another body: one, or all of its body that are beside it, or all that
    hang together with it, each with their mirror images or without."""
    pieces, count = field.unary.shape
    beside = np.eye(pieces, dtype=bool)
    ends = field.ends[field.nearly]
    beside[ends[:, 0], ends[:, 1]] = beside[ends[:, 1], ends[:, 0]] = True
    image = np.eye(pieces, dtype=bool)
    image[field.mirrored[:, 0], field.mirrored[:, 1]] = image[field.mirrored[:, 1], field.mirrored[:, 0]] = True
    same = labels[:, None] == labels
    groups = [np.eye(pieces, dtype=bool), beside & same]
    hanging = groups[-1]
    while (wider := (hanging @ groups[1])).sum() > hanging.sum():
        hanging = wider
    groups.append(hanging)
    groups += [(group @ image) & same for group in groups]
    each = np.unique(np.concatenate(groups), axis=0)
    own = labels[np.argmax(each, axis=1)]
    into, of = np.meshgrid(np.arange(count), np.arange(len(each)))
    chosen = (into != own[:, None]).ravel()
    changed = np.where(each[of.ravel()[chosen]], into.ravel()[chosen][:, None], labels)
    return np.asarray(changed, dtype=np.int64)
