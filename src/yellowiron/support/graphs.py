"""Graphs of bodies and joints, as all stages need them: what hangs together, what closes loops. Results are in
the order of what was given, so that they are the same in every run."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from typing import Generic, TypeVar

Node = TypeVar("Node", bound=Hashable)
Edge = TypeVar("Edge")
Name = TypeVar("Name", bound=Hashable)


class LedSets(Generic[Node]):
    """Disjoint sets, each with the leader that the joins gave it (libraries' own leave the leader to chance)."""

    def __init__(self, nodes: Iterable[Node] = ()) -> None:
        self._above = {node: node for node in nodes}

    def __contains__(self, node: object) -> bool:
        return node in self._above

    def leader(self, node: Node) -> Node:
        """The leader of a node's set; a node that was not known is a set of its own."""
        above = self._above
        lead = above.setdefault(node, node)
        while lead != node:
            above[node] = node = above[lead]
            lead = above[node]
        return node

    def join(self, leading: Node, other: Node) -> bool:
        """Makes one set of two, led by the first's leader; False where they are one already."""
        first, second = self.leader(leading), self.leader(other)
        self._above[second] = first
        return first != second

    def sets(self) -> list[tuple[Node, ...]]:
        """All sets, by their first nodes, each in the nodes' order."""
        found: dict[Node, list[Node]] = {}
        for node in self._above:
            found.setdefault(self.leader(node), []).append(node)
        return [tuple(members) for members in found.values()]


def components(nodes: Iterable[Node], edges: Iterable[tuple[Node, Node]]) -> list[tuple[Node, ...]]:
    """The nodes in groups that edges hold together, groups by their first nodes, each in the nodes' order. An edge to
    what is no node counts for nothing."""
    sets = LedSets(nodes)
    for a, b in edges:
        if a in sets and b in sets:
            sets.join(a, b)
    return sets.sets()


def spanning_forest(
    edges: Iterable[Edge], ends: Callable[[Edge], tuple[Hashable, Hashable]]
) -> tuple[list[Edge], list[Edge]]:
    """(edges of a spanning forest, edges that close a loop), the forest taking the edges in the order given
    (J. B. Kruskal, Proc. AMS 7, 1956)."""
    sets: LedSets[Hashable] = LedSets()
    kept: list[Edge] = []
    closing: list[Edge] = []
    for edge in edges:
        (kept if sets.join(*ends(edge)) else closing).append(edge)
    return kept, closing


def blocks(edges: Mapping[Name, tuple[Node, Node]]) -> list[tuple[Name, ...]]:
    """The edges by common loops (the graph's biconnected components), each block in the given order, blocks by their
    first edges; an edge in no loop is a block of its own.

    Several edges may join the same two nodes: every edge is a node of its own between its ends, so two of them are a
    loop.
    """
    import networkx as nx  # a fifth of a second, which not every command has to spend

    graph = nx.Graph()
    for name, pair in edges.items():
        graph.add_edges_from(((False, node), (True, name)) for node in pair)
    order = {name: number for number, name in enumerate(edges)}
    found: set[tuple[Name, ...]] = set()
    looped: set[Name] = set()
    for block in nx.biconnected_components(graph):
        names = tuple(sorted((name for is_edge, name in block if is_edge), key=order.__getitem__))
        if len(names) > 1:
            found.add(names)
            looped.update(names)
    found.update((name,) for name in edges if name not in looped)
    return sorted(found, key=lambda names: order[names[0]])


def bridges(edges: Mapping[Name, tuple[Node, Node]]) -> set[Name]:
    """The edges in no loop: without them their two ends are not connected."""
    return {block[0] for block in blocks(edges) if len(block) == 1 and edges[block[0]][0] != edges[block[0]][1]}
