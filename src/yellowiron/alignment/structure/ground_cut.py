"""What carries a slewing machine, apart from what it carries: by how high its tracks are, where no bearing is drawn.

No rigid body of a machine on tracks has parts between its tracks, near the ground, and others that are wholly above
them, but for what hangs on an arm. Where both are held together by contacts, the weakest of these are no weld
(Stoer & Wagner's minimum cut between the two).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

import networkx
import numpy as np

from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.structure.contact_evidence import ContactEvidence
from yellowiron.alignment.structure.min_cut import strength
from yellowiron.alignment.structure.observation import Observation, slewing_joints
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template

BELOW = 0.3
"""Of the carrier's height: what it carries begins higher up on it, …"""
WITHIN = 0.75
"""… and what is lower than this, on the whole, is the carrier's where anything of it reaches so far down."""
TIE = 1e-6
"""Square metres: two solids that touch in a point hold each other a little."""


def parted(observation: Observation, template: Template) -> Observation:
    """The observation with its contacts read so that nothing holds what is low between the tracks to what is wholly
    above them; as it is without tracks, where a bearing is drawn, and where no joint slews."""
    rows, evidence = observation.rows, observation.evidence
    if not rows or observation.up is None or not slewing_joints(template) or not evidence or evidence[-1].races:
        return observation
    up = upwards(observation)
    _, bottom, top = heights(rows, up)
    reach = {s.index: heights([s], up) for s in observation.solids}
    between = _between(rows, up)
    low = {
        s.index
        for s in observation.solids
        if reach[s.index][0] < bottom + WITHIN * (top - bottom) and _inside(s, between, up)
    }
    high = {i for i, (_, lowest, _) in reach.items() if lowest >= top}
    usual = evidence[-1]
    fallen = held_by(low, high, reach.keys(), usual)
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


def held_by(
    low: Collection[int], high: Collection[int], members: Collection[int], evidence: ContactEvidence
) -> frozenset[int]:
    """Of `members` those on the `low` ones' side of the weakest contacts between these and the `high`; none where
    either of the two is empty. Pins hold nothing, nor does what may turn about a common axis."""
    graph = networkx.Graph()
    graph.add_nodes_from(members)
    flat = {(min(f.a, f.b), max(f.a, f.b)) for f in evidence.welds}
    pins, about = evidence.fasteners, evidence.about
    touching = {p for p in evidence.near if not {*p} & pins and not about[p[0]] & about[p[1]] and evidence.touching(*p)}
    for a, b in sorted(flat | touching):
        if a in graph and b in graph:
            graph.add_edge(a, b, capacity=max(TIE, strength(evidence, a, b)))
    if not low or not high:
        return frozenset()
    for name, side in (("ground", low), ("deck", high)):
        graph.add_edges_from((name, i) for i in side)
    return frozenset(networkx.minimum_cut(graph, "ground", "deck")[1][0]) - {"ground"}


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
