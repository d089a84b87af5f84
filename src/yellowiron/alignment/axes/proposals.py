"""Hinges between two groups of solids of which nothing is known yet: for the search, before there are labels."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from yellowiron.alignment.axes.bodies import PIVOT, Body
from yellowiron.alignment.axes.hinges import LEAST_QUALITY, hinge_candidates
from yellowiron.alignment.axes.values import Candidate, Frame
from yellowiron.alignment.features.solids import Solid
from yellowiron.model.geometry import Floats

REACH = 0.02
"""Groups whose boxes are further apart than this share of the machine's size are hinged on nothing."""
WAYS = 3
"""Directions that are tried, those that most round faces are along."""
SAME_WAY = math.cos(math.radians(4.0))


def group(solids: Sequence[Solid], rows: Sequence[int], size: float) -> Body:
    """A group of solids by their indices, in a machine of `size` metres; keep it as long as it is asked about: what is
    computed of it is kept with it."""
    return Body("", tuple(solids[i] for i in sorted(rows)), size)


def hinge_proposals(a: Body, b: Body, *, frame: Frame | None = None, most: int = 3) -> list[Candidate]:
    """Up to `most` lines that two groups may be hinged about, the best first; none where nothing round says so.

    Tried are the machine's directions that `frame` knows, and those that most of what is round where the groups meet
    is along. `quality` of a candidate: from about 0.9 for bores in both on one line, over 0.6 for a bore or a pin of
    one within the other, to 0.2 for a round end beside the other.
    """
    gap = np.maximum(np.maximum(a.low - b.high, b.low - a.high), 0.0)
    if float(np.linalg.norm(gap)) > REACH * a.size:
        return []
    found: list[Candidate] = []
    for way in _ways(a, b, frame or Frame()):
        found += [c for c in hinge_candidates(a, b, way) if c.quality >= LEAST_QUALITY and c.rests_on_round]
    kept: list[Candidate] = []
    for c in sorted(found, key=lambda c: -round(c.quality, 9)):
        if all(_differ(c, k) for k in kept):
            kept.append(c)
    return kept[:most]


def _ways(a: Body, b: Body, frame: Frame) -> list[Floats]:
    """Directions to try, each once."""
    low, high = np.maximum(a.low, b.low) - REACH * a.size, np.minimum(a.high, b.high) + REACH * a.size
    ways, weights = [], []
    for body in (a, b):
        for solid in body.solids:
            for face in (*solid.cylinders, *solid.knuckles):
                near = (face.center > low - face.radius).all() and (face.center < high + face.radius).all()
                if near and PIVOT[0] < face.radius / a.size < PIVOT[1] and face.arc > 1.2:
                    ways.append(face.direction)
                    weights.append(face.radius * min(face.arc, 2 * math.pi))
    found = [w for w in (frame.left, frame.up, frame.forward) if w is not None]
    left = list(range(len(ways)))
    for _ in range(WAYS):
        if not left:
            break
        rest, heavy = np.array([ways[k] for k in left]), np.array([weights[k] for k in left])
        alike = np.abs(rest @ rest.T) > SAME_WAY
        best = int(np.argmax(np.round(alike @ heavy, 9)))
        if all(abs(float(rest[best] @ f)) < SAME_WAY for f in found):
            found.append(rest[best])
        left = [k for k, same in zip(left, alike[best], strict=True) if not same]
    return found


def _differ(one: Candidate, other: Candidate) -> bool:
    delta = one.origin - other.origin
    apart = float(np.linalg.norm(delta - (delta @ other.direction) * other.direction))
    return abs(float(one.direction @ other.direction)) < SAME_WAY or apart > 3.0 * (one.across + other.across)
