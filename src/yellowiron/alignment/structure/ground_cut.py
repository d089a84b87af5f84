"""What carries a slewing machine, apart from what it carries: by how high its tracks are, where no bearing is drawn.

No rigid body of a machine on tracks has parts between its tracks, near the ground, and others that are wholly above
them, but for what hangs on an arm. Where both are held together by contacts, the weakest of these are no weld
(Stoer & Wagner's minimum cut between the two).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.structure.min_cut import held_by
from yellowiron.alignment.structure.observation import Observation, slewing_joints
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template

BELOW = 0.3
"""Of the carrier's height: what it carries begins higher up on it, …"""
WITHIN = 0.75
"""… and what is lower than this, on the whole, is the carrier's where anything of it reaches so far down."""


def parted(observation: Observation, template: Template) -> Observation:
    """The observation with its contacts read so that nothing holds what is low between the tracks to what is wholly
    above them; as it is without tracks, where a bearing is drawn, and where no joint slews."""
    rows, evidence = observation.rows, observation.evidence
    if not rows or observation.up is None or not slewing_joints(template) or not evidence or evidence[-1].races:
        return observation
    up = upwards(observation)
    low, high = layers(observation.solids, rows, up)
    between, usual = _between(rows, up), evidence[-1]
    low = {i for i in low if _inside(observation.solids[i], between, up)}
    fallen = held_by(low, high, range(len(observation.solids)), usual)
    if not fallen:
        return observation

    def holds(a: int, b: int) -> bool:
        return (a in fallen) == (b in fallen)

    apart = replace(
        usual,
        welds=tuple(f for f in usual.welds if holds(f.a, f.b)),
        near=tuple(pair for pair in usual.near if holds(*pair)),
    )
    return replace(observation, evidence=(apart,))


def layers(solids: Sequence[Solid], base: Sequence[Solid], up: Floats) -> tuple[set[int], set[int]]:
    """Of some solids those that are low beside what carries the machine (`base`), on the whole, and those that are
    wholly above it."""
    _, bottom, top = heights(base, up)
    reach = {s.index: heights([s], up) for s in solids}
    low = {i for i, (middle, _, _) in reach.items() if middle < bottom + WITHIN * (top - bottom)}
    return low, {i for i, (_, lowest, _) in reach.items() if lowest >= top}


def upwards(observation: Observation) -> Floats:
    """The upright (3,) of the tracks, towards what most of the rest is. CAD frame."""
    up = np.asarray(observation.up)
    return up if heights(observation.solids, up)[0] > heights(observation.rows, up)[0] else -up


def heights(solids: Sequence[Solid], up: Floats) -> tuple[float, float, float]:
    """How high some solids are on the whole, by their surfaces, at their lowest and at their highest; metres along the
    upright."""
    runs = [solid.points @ up for solid in solids]
    weights = np.array([solid.surface for solid in solids]) + 1e-12
    middle = float(np.average([run.mean() for run in runs], weights=weights))
    return middle, min(float(run.min()) for run in runs), max(float(run.max()) for run in runs)


def _between(rows: Sequence[Solid], up: Floats) -> Floats:
    """(2, 3) the box about the tracks, as seen from above."""
    points = np.concatenate([s.points for s in rows])
    flat = points - np.outer(points @ up, up)
    return np.array([flat.min(axis=0), flat.max(axis=0)])


def _inside(solid: Solid, box: Floats, up: Floats) -> bool:
    flat = solid.points - np.outer(solid.points @ up, up)
    slack = 1e-3 * float(np.linalg.norm(box[1] - box[0]))
    return bool((flat >= box[0] - slack).all() and (flat <= box[1] + slack).all())
