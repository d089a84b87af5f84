"""How much of a machine's surface each body has, whatever it is made of: with twice or half of what is usual a body is
still itself, with a tenth it is a piece of itself, and the rest was taken for another's.

Of 22 machines of strangers, 126 frames, arms, links and tools have 0.95 times the usual surface (the logarithms' mean;
their deviation is 0.48). It says little where a body is one piece, and much where it is shells by the dozen.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from yellowiron.alignment.fusion.best import Best, lacking
from yellowiron.alignment.fusion.evidence import Evidence
from yellowiron.alignment.fusion.judge import Field, Ints, score_of, scores_of, weights
from yellowiron.alignment.fusion.votes import AREA, MOST
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template

ROUNDS = 40
"""So many times at most some pieces become another body."""
CLEARLY = 3.0
"""… each time by a labelling that is better by more than this, …"""
FITTER = 9.0
"""… and whose surfaces are, by more than this: what else speaks for a body has been heard."""


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
