"""Fittings: bolts, nuts, clips and nipples by the hundred, each far smaller than any pin.

They say nothing of the machine that the parts they sit on do not say, and together they take most of the time: the
machine is found without them, and each then goes with what it sits on.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from yellowiron.alignment.features.distance import Touch
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.labelling.place import DOUBTFUL, Place
from yellowiron.model.assembly import Assembly
from yellowiron.support.caching.remembered import remembered

SMALL = 0.01
"""The diagonal of a fitting, as a share of the machine's: 10 cm on 10 m. The smallest pins have 1.7 %."""
ALIKE, SMALLISH = 24, 0.02
"""What is there so many times is a fitting up to this share: no machine has as many pins of one kind."""
MANY = 300
"""So many fittings are left out; fewer stay with the others, as they cost nothing."""
SITTING = 0.92
"""Confidence of what sits on parts of one body, as a share of theirs."""


@remembered
def fittings_of(assembly: Assembly) -> set[str]:
    """The ids of an assembly's fittings; none where they are not many."""
    parts = [p for p in assembly.parts if len(assembly.shape_of(p).mesh.points)]
    if len(parts) <= MANY:
        return set()
    points = [assembly.points_of(p) for p in parts]
    low, high = np.array([p.min(axis=0) for p in points]), np.array([p.max(axis=0) for p in points])
    machine = float(np.linalg.norm(high.max(axis=0) - low.min(axis=0)))
    share = np.linalg.norm(high - low, axis=1) / machine
    kinds = [round(math.log(assembly.shape_of(p).area + 1e-12), 2) for p in parts]
    count = Counter(k for k, s in zip(kinds, share.tolist(), strict=True) if s < SMALLISH)
    found = {
        p.id
        for p, kind, s in zip(parts, kinds, share.tolist(), strict=True)
        if s < SMALL or (s < SMALLISH and count[kind] >= ALIKE)
    }
    return found if len(found) > MANY else set()


def sitting(
    found: Mapping[str, Place], fittings: Collection[str], solids: Sequence[Solid], touch: Touch
) -> dict[str, Place]:
    """Fitting's id → place: that of the part it touches, and is deepest in where it touches parts of several bodies;
    what touches only other fittings goes with these, and what touches nothing, doubtfully, with the nearest part.
    `found`: the places of the other parts, by id."""
    placed = {s.index: found[s.part.id] for s in solids if s.part.id in found and s.part.id not in fittings}
    waiting = [s.index for s in solids if s.part.id in fittings]
    result: dict[str, Place] = {}
    while waiting:
        grown = {i: place for i in waiting if (place := _on(i, placed, touch)) is not None}
        if not grown:
            break
        placed |= grown
        waiting = [i for i in waiting if i not in grown]
    hosts = sorted(placed)
    low = np.array([solids[j].low for j in hosts])
    high = np.array([solids[j].high for j in hosts])
    for i in waiting if hosts else ():
        # Between boxes, of all hosts at once: thousands of loose bolts stand among thousands of parts.
        gaps = np.maximum(0.0, np.maximum(solids[i].low - high, low - solids[i].high))
        nearest = placed[hosts[int(np.argmin((gaps * gaps).sum(axis=1)))]]
        words = f"a fitting that touches nothing; nearest is {nearest.body}"
        placed[i] = Place(nearest.body, nearest.body, DOUBTFUL, words, how="near")
    for s in solids:
        if s.part.id in fittings and s.index in placed:
            result[s.part.id] = placed[s.index]
    return result


def _on(i: int, placed: Mapping[int, Place], touch: Touch) -> Place | None:
    """The place of a fitting among those that are placed; None where it touches none of them."""
    hosts = [j for j in touch.near(i) if j in placed and touch.touching(i, j)]
    if not hosts:
        return None
    bodies = {placed[j].body for j in hosts}
    if len(bodies) == 1:
        host = placed[max(hosts, key=lambda j: (placed[j].confidence, -j))]
        return _as(host, SITTING * host.confidence)
    # Between bodies it counts how deep it is in each.
    depth = {b: max(touch.buried(i, j) for j in hosts if placed[j].body == b) for b in sorted(bodies)}
    best, second = sorted(depth, key=lambda b: (-depth[b], b))[:2]
    host = next(placed[j] for j in hosts if placed[j].body == best)
    clear = depth[best] > 2.0 * depth[second] and depth[best] > 0.0
    confidence = SITTING * host.confidence if clear else min(DOUBTFUL, host.confidence)
    return replace(_as(host, confidence), runner_up=second)


def _as(host: Place, confidence: float) -> Place:
    return Place(host.body, host.body, confidence, f"a fitting on {host.body}", how="touch")
