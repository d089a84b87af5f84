"""Closed chains of bodies and joints: which joints are in one, and how many freedoms are left over."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Edge:
    """A joint of clusters `a` and `b`: a hinge (`number`) on a shared `axis`, or a slide of that hydraulic cylinder
    (`driven`) or of that section in another."""

    a: int
    b: int
    axis: int
    number: int
    slide: bool
    driven: bool = False


def blocks(edges: Sequence[Edge]) -> list[list[Edge]]:
    """The edges in groups that closed chains hold together; an edge of no chain is alone (Tarjan's biconnected
    components)."""
    beside: dict[int, list[int]] = {}
    for k, e in enumerate(edges):
        beside.setdefault(e.a, []).append(k)
        beside.setdefault(e.b, []).append(k)
    order: dict[int, int] = {}
    low: dict[int, int] = {}
    found: list[list[Edge]] = []
    stack: list[int] = []
    done: set[int] = set()
    for start in sorted(beside):
        if start in order:
            continue
        order[start] = low[start] = len(order)
        path = [(start, -1, iter(beside[start]))]
        while path:
            node, by, rest = path[-1]
            k = next(rest, -1)
            if k < 0:
                path.pop()
                if path:
                    above = path[-1][0]
                    low[above] = min(low[above], low[node])
                    if low[node] >= order[above]:
                        cut = stack.index(by)
                        found.append([edges[i] for i in sorted(stack[cut:])])
                        del stack[cut:]
                continue
            if k in done:
                continue
            done.add(k)
            stack.append(k)
            other = edges[k].b if edges[k].a == node else edges[k].a
            if other in order:
                low[node] = min(low[node], order[other])
            else:
                order[other] = low[other] = len(order)
                path.append((other, k, iter(beside[other])))
    return found


def bridges(edges: Sequence[Edge]) -> set[Edge]:
    """The joints of no closed chain."""
    return {block[0] for block in blocks(edges) if len(block) == 1}


def freedoms(edges: Sequence[Edge]) -> tuple[int, int]:
    """Over all groups of chains, seen as planar linkages (joints less three for each loop): how many freedoms no slide
    drives or are missing altogether, and how many slides are more than the freedoms (twins). A slide in no chain moves
    nothing and counts with the first."""
    wrong = doubled = 0
    for block in blocks(edges):
        slides = sum(e.driven for e in block)
        if len(block) == 1:
            wrong += slides
            continue
        bodies = {c for e in block for c in (e.a, e.b)}
        free = len(block) - 3 * (len(block) - len(bodies) + 1)
        wrong += max(0, free - slides) + max(0, 1 - free)
        doubled += max(0, slides - free)
    return wrong, doubled


def components(edges: Sequence[Edge]) -> list[set[int]]:
    """The bodies in groups that joints hold together, in the order of their least."""
    group: dict[int, set[int]] = {}
    for e in edges:
        one, other = group.setdefault(e.a, {e.a}), group.setdefault(e.b, {e.b})
        if one is not other:
            one |= other
            group.update(dict.fromkeys(other, one))
    return sorted({id(g): g for g in group.values()}.values(), key=min)
