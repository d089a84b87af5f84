"""What of a template may change places without any joint telling: four outriggers that hang on one carrier, two axles
that steer alike."""

from __future__ import annotations

from collections.abc import Mapping

import networkx as nx

from yellowiron.alignment.assignment.sides import END, SIDE
from yellowiron.model.template import Template


def alike_branches(template: Template, unary: Mapping[tuple[int, str], int]) -> list[list[str]]:
    """Groups of bodies, one of each branch that hangs on the root and on nothing else, where the branches are joined
    alike and their names differ in front, middle, rear, left and right alone; without those of which something that is
    said of clusters (`unary`: names, a sheet) tells one from another."""
    rigid = {r.name: r for r in template.roles if r.rigid}
    graph = nx.MultiGraph()
    graph.add_nodes_from(rigid)
    for joint in template.joints:
        a, b = template.bodies_of(joint)
        if a in rigid and b in rigid:
            graph.add_edge(a, b, kind=joint.type)
    groups: dict[tuple[tuple[str, ...], ...], list[str]] = {}
    for branch in nx.connected_components(graph.subgraph(sorted(set(rigid) - {template.root}))):
        plain = {name: SIDE.sub("", END.sub("", name)) for name in branch}
        once = [name for name in sorted(branch) if list(plain.values()).count(plain[name]) == 1]
        if not once or not any(END.search(name) or SIDE.search(name) for name in once):
            continue
        edges = (
            (*sorted((plain.get(a, a), plain.get(b, b))), kind)
            for a, b, kind in graph.edges(sorted(branch), data="kind")
        )
        first = min(once, key=lambda name: plain[name])
        groups.setdefault(tuple(sorted(edges)), []).append(first)
    said: dict[int, dict[str, int]] = {}
    for (cluster, body), weight in unary.items():
        said.setdefault(cluster, {})[body] = weight
    found = []
    for names in groups.values():
        bases = {SIDE.sub("", END.sub("", name)) for name in names}
        hung = [_branch(graph, template.root, name) for name in names]
        if len(names) > 1 and len(bases) == 1 and not any(_told(of, hung) for of in said.values()):
            found.append(sorted(names))
    return sorted(found)


def _branch(graph: nx.MultiGraph, root: str, name: str) -> set[str]:
    rest = graph.subgraph(set(graph) - {root})
    return set(nx.node_connected_component(rest, name))


def _told(weights: Mapping[str, int], branches: list[set[str]]) -> bool:
    """Whether what is said of one cluster tells such branches, or the sides in them, apart."""
    seen: dict[str, set[int]] = {}
    for branch in branches:
        for name in branch:
            seen.setdefault(SIDE.sub("", END.sub("", name)), set()).add(weights.get(name, 0))
    return any(len(values) > 1 for values in seen.values())
