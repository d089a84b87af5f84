"""Finding the false weld: the weakest set of contacts that ties together what a pin says must turn, or what is low and
what is high on a machine."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Sequence

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import maximum_flow

from yellowiron.alignment.structure.contact_evidence import ContactEvidence
from yellowiron.alignment.structure.rigid_groups import Groups
from yellowiron.alignment.structure.welds import Pairs, axes_by_group

FIRM = 20_000_000
SCALE = 1e6
"""Capacity of a square metre of contact: square millimetres."""
LIGHTER = 0.8
"""A cut must be this much weaker than what was kept back."""


def strength(evidence: ContactEvidence, a: int, b: int) -> float:
    """Square metres over which two solids can hold each other: their flat contact, or the larger face of the box that
    both fill."""
    flat = evidence.area.get((a, b), 0.0)
    if flat > 0:
        return flat
    sa, sb = evidence.solids[a], evidence.solids[b]
    sides = np.sort(np.maximum(0.0, np.minimum(sa.high, sb.high) - np.maximum(sa.low, sb.low)))
    return float(sides[1] * sides[2])


def false_welds(groups: Groups, evidence: ContactEvidence, pairs: Pairs, refused: Pairs) -> set[tuple[int, int]]:
    """Pairs to leave apart, so that what careful welding kept back can hold.

    A kept-back pair would have joined all that turns about some axis. Then two of the parts on that axis are of
    different bodies, and the cheapest cut between any two of them is the false weld, unless the pair itself is cheaper.
    """
    on = axes_by_group(groups, evidence, without=evidence.bolted)
    result: set[tuple[int, int]] = set()
    done: set[tuple[int, int, int]] = set()
    graph = _graph(evidence, pairs)
    for a, b in refused:
        ga, gb = sorted((groups.find(a), groups.find(b)))
        if ga == gb or groups.kind(ga) or groups.kind(gb):
            continue
        own = [p for p in refused if sorted((groups.find(p[0]), groups.find(p[1]))) == [ga, gb]]
        limit = LIGHTER * sum(strength(evidence, *p) for p in own)
        for k in sorted(on.get(ga, set()) & on.get(gb, set())):
            if (ga, gb, k) in done:
                continue
            done.add((ga, gb, k))
            sides = [[i for i, axes in evidence.pinned.items() if k in axes and groups.find(i) == g] for g in (ga, gb)]
            cuts = [_cut(graph, pairs, i, j) for i in sides[0] for j in sides[1]]
            cuts = [c for c in cuts if c and sum(strength(evidence, *p) for p in c) < limit]
            if cuts:
                result |= min(cuts, key=lambda c: (sum(strength(evidence, *p) for p in c), sorted(c)))
    return result


def held_by(
    low: Collection[int], high: Collection[int], members: Collection[int], evidence: ContactEvidence
) -> frozenset[int]:
    """Of the solids `members` those on the `low` ones' side of the weakest contacts between these and the `high`; none
    where either of the two is empty. Pins hold nothing, nor does what may turn about a common axis."""
    if not low or not high:
        return frozenset()
    flat = {(min(f.a, f.b), max(f.a, f.b)) for f in evidence.welds}
    pins, about = evidence.fasteners, evidence.about
    touching = {p for p in evidence.near if not {*p} & pins and not about[p[0]] & about[p[1]] and evidence.touching(*p)}
    inside = set(members)
    start = len(evidence.solids)
    pairs = [p for p in sorted(flat | touching) if inside.issuperset(p)]
    ends = [*((i, start) for i in sorted(low)), *((i, start + 1) for i in sorted(high))]
    reached = _reached(_graph(evidence, pairs, ends), start, start + 1)
    return frozenset(reached & inside)


def _graph(evidence: ContactEvidence, pairs: Pairs, ends: Sequence[tuple[int, int]] = ()) -> csr_array:
    """Capacities between solids, both ways; `ends`: a solid and a node behind the solids that it is one with."""
    capacity = {p: max(1, min(FIRM, round(SCALE * strength(evidence, *p)))) for p in pairs}
    capacity |= dict.fromkeys([*((min(p), max(p)) for p in evidence.pressed), *ends], FIRM)
    rows = [a for a, _ in capacity] + [b for _, b in capacity]
    columns = [b for _, b in capacity] + [a for a, _ in capacity]
    values = np.array([*capacity.values(), *capacity.values()], dtype=np.int32)
    count = len(evidence.solids) + (2 if ends else 0)
    return csr_array((values, (rows, columns)), shape=(count, count))


def _cut(graph: csr_array, pairs: Pairs, start: int, end: int) -> set[tuple[int, int]]:
    """The minimum cut between two solids over the contacts that weld."""
    reached = _reached(graph, start, end)
    return set() if end in reached else {(a, b) for a, b in pairs if (a in reached) != (b in reached)}


def _reached(graph: csr_array, start: int, end: int) -> set[int]:
    """The nodes on the start's side of the minimum cut."""
    residual = csr_array(graph - maximum_flow(graph, start, end).flow)
    reached = {start}
    queue = deque([start])
    while queue:
        node = queue.popleft()
        for at in range(residual.indptr[node], residual.indptr[node + 1]):
            other = int(residual.indices[at])
            if residual.data[at] > 0 and other not in reached:
                reached.add(other)
                queue.append(other)
    return reached
