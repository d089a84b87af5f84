"""Closed chains of bodies and joints: which joints are in one, and how many freedoms are left over."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from yellowiron.support import graphs


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
    """The edges in groups that closed chains hold together; an edge of no chain is alone."""
    return [[edges[k] for k in block] for block in graphs.blocks({k: (e.a, e.b) for k, e in enumerate(edges)})]


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
    bodies = sorted({body for e in edges for body in (e.a, e.b)})
    return [set(group) for group in graphs.components(bodies, ((e.a, e.b) for e in edges))]
