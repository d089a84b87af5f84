"""Finding the false weld: the weakest set of contacts that ties together what a pin says must turn."""

from __future__ import annotations

from collections import deque

import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import maximum_flow

from yellowiron.align.evidence import Evidence
from yellowiron.align.groups import Groups
from yellowiron.align.welds import Pairs, lines_by_group

FIRM = 2_000_000_000
SCALE = 1e7
"""Capacity of a square metre of contact: tenths of a square millimetre."""


def strength(evidence: Evidence, a: int, b: int) -> float:
    """Square metres over which two solids can hold each other: their flat contact, or the larger face of the box that
    both fill."""
    flat = evidence.area.get((a, b), 0.0)
    if flat > 0:
        return flat
    sa, sb = evidence.solids[a], evidence.solids[b]
    sides = np.sort(np.maximum(0.0, np.minimum(sa.high, sb.high) - np.maximum(sa.low, sb.low)))
    return float(sides[1] * sides[2])


def false_welds(groups: Groups, evidence: Evidence, pairs: Pairs, refused: Pairs) -> set[tuple[int, int]]:
    """Pairs to leave apart, so that what careful welding kept back can hold: for each such pair on a common line, the
    cheapest contacts that part the line's two sides; empty where the pair itself is the cheapest."""
    on = lines_by_group(groups, evidence, without=evidence.bolted)
    result: set[tuple[int, int]] = set()
    done: set[tuple[int, int, int]] = set()
    for a, b in refused:
        ga, gb = groups.find(a), groups.find(b)
        if ga == gb or groups.kind(ga) or groups.kind(gb):
            continue
        for k in sorted(on.get(ga, set()) & on.get(gb, set())):
            if (min(ga, gb), max(ga, gb), k) in done:
                continue
            done.add((min(ga, gb), max(ga, gb), k))
            sides = [
                [i for i, lines in evidence.pinned.items() if k in lines and groups.find(i) == g] for g in (ga, gb)
            ]
            cut = _cheapest(evidence, pairs, sides[0], sides[1])
            own = {p for p in refused if {groups.find(p[0]), groups.find(p[1])} == {ga, gb}}
            if cut and not cut <= own:
                result |= cut
    return result


def _cheapest(evidence: Evidence, pairs: Pairs, sources: list[int], sinks: list[int]) -> set[tuple[int, int]]:
    """The minimum cut between two sets of solids over the contacts that weld."""
    count = len(evidence.solids) + 2
    start, end = count - 2, count - 1
    capacity: dict[tuple[int, int], int] = {}
    for a, b in pairs:
        capacity[a, b] = max(1, min(FIRM // 100, round(SCALE * strength(evidence, a, b))))
    for a, b in evidence.pressed:
        capacity[min(a, b), max(a, b)] = FIRM // 10
    for i in sources:
        capacity[i, start] = FIRM
    for i in sinks:
        capacity[i, end] = FIRM
    rows = [a for a, b in capacity] + [b for a, b in capacity]
    columns = [b for a, b in capacity] + [a for a, b in capacity]
    values = [*capacity.values(), *capacity.values()]
    graph = csr_matrix((np.array(values, dtype=np.int32), (rows, columns)), shape=(count, count))
    flow = maximum_flow(graph, start, end).flow
    residual = (graph - flow).tocsr()
    reached = {start}
    queue = deque([start])
    while queue:
        node = queue.popleft()
        for at in range(residual.indptr[node], residual.indptr[node + 1]):
            other = int(residual.indices[at])
            if residual.data[at] > 0 and other not in reached:
                reached.add(other)
                queue.append(other)
    if end in reached:
        return set()
    return {(a, b) for a, b in pairs if (a in reached) != (b in reached)}
