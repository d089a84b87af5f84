"""The scene's tree as its maker's idea of what carries what: in an animated model a node moves with the one above."""

from __future__ import annotations

from collections.abc import Sequence

from yellowiron.alignment.features.solids import Solid
from yellowiron.model.assembly import Assembly


def branches_of(assembly: Assembly, solids: Sequence[Solid]) -> tuple[tuple[int, int], ...]:
    """Pairs of solids, child and parent: what moves with a node, and what moves with the next node above it that
    anything moves with. A part is of its own node where the tree goes on below that, else of the one above; of several
    parts of a node its own mesh stands for it, else the largest. None where the tree is flat."""
    nodes = assembly.nodes
    above = {s.index: list(assembly.nodes_above(s.part.node)) for s in solids}
    count: dict[int, int] = {}
    for chain in above.values():
        for number in chain:
            count[number] = count.get(number, 0) + 1
    own: dict[int, int] = {}
    for s in solids:
        if s.part.node is not None:
            own[s.part.node] = own.get(s.part.node, 0) + 1
    chief: dict[int, int] = {}
    for s in solids:  # the largest first
        node = s.part.node
        if node is None:
            continue
        goes_on = count[node] > own[node]
        parent = nodes[node].parent
        place = node if goes_on or parent is None else parent
        if place not in chief or (place == node and solids[chief[place]].part.node != node):
            chief[place] = s.index
    pairs = []
    for place, child in sorted(chief.items()):
        at: int | None = nodes[place].parent
        while at is not None and at not in chief:
            at = nodes[at].parent
        if at is not None and chief[at] != child:
            pairs.append((child, chief[at]))
    return tuple(pairs)
