"""Groups, loops and spanning forests against their definitions, on any small graph."""

from __future__ import annotations

from collections.abc import Mapping

from hypothesis import given
from hypothesis import strategies as st

from yellowiron.support.graphs import blocks, bridges, components, spanning_forest

Edges = dict[str, tuple[int, int]]
PAIRS = st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), max_size=10)
GRAPHS = PAIRS.map(lambda pairs: {f"e{number}": pair for number, pair in enumerate(pairs)})


def connected(start: int, goal: int, edges: Mapping[str, tuple[int, int]]) -> bool:
    """By the definition: a walk along edges."""
    seen = {start}
    for _ in edges:
        seen |= {n for pair in edges.values() if seen & set(pair) for n in pair}
    return goal in seen


def without(edges: Edges, *names: str) -> Edges:
    return {name: pair for name, pair in edges.items() if name not in names}


@given(GRAPHS)
def test_components_are_what_edges_hold_together(edges: Edges) -> None:
    groups = components(range(7), edges.values())
    assert sorted(n for g in groups for n in g) == list(range(7))
    assert [g[0] for g in groups] == sorted(g[0] for g in groups)
    assert all(list(g) == sorted(g) for g in groups)
    place = {n: g for g in groups for n in g}
    assert all((place[a] is place[b]) == connected(a, b, edges) for a in range(7) for b in range(7))


def test_an_edge_to_no_node_counts_for_nothing() -> None:
    assert components("ab", [("a", "x"), ("x", "b")]) == [("a",), ("b",)]


@given(GRAPHS)
def test_a_bridge_parts_its_ends(edges: Edges) -> None:
    assert bridges(edges) == {n for n, (a, b) in edges.items() if not connected(a, b, without(edges, n))}


@given(GRAPHS)
def test_blocks_are_the_edges_by_common_loops(edges: Edges) -> None:
    """Two edges share a simple loop exactly if no single node parts them and none is a bridge."""
    found = blocks(edges)
    assert sorted(n for block in found for n in block) == sorted(edges)
    order = list(edges)
    assert all([order.index(n) for n in block] == sorted(order.index(n) for n in block) for block in found)
    for block in found:
        if len(block) > 1:
            inside = {n: edges[n] for n in block}
            assert not bridges(inside)
            assert all(a != b for a, b in inside.values())
    kept, closing = spanning_forest(edges, edges.__getitem__)
    nodes = {n for pair in edges.values() for n in pair}
    assert len(kept) == len(nodes) - len(components(nodes, edges.values()))
    assert all(connected(*edges[name], {k: edges[k] for k in kept}) for name in closing)


def test_two_edges_between_two_nodes_are_a_loop() -> None:
    assert blocks({"p": ("a", "b"), "q": ("b", "a"), "r": ("b", "c")}) == [("p", "q"), ("r",)]
    two = {"p": ("a", "b"), "q": ("b", "c"), "r": ("c", "a"), "s": ("a", "d"), "t": ("d", "e"), "u": ("e", "a")}
    assert blocks(two) == [("p", "q", "r"), ("s", "t", "u")]


def test_the_forest_takes_edges_as_they_come() -> None:
    edges = {"p": ("a", "b"), "q": ("b", "c"), "r": ("c", "a")}
    assert spanning_forest(["r", "q", "p"], edges.__getitem__) == (["r", "q"], ["p"])


def test_blocks_split_at_a_shared_body_and_keep_single_joints() -> None:
    ends = {
        "a": ("0", "1"), "b": ("1", "2"), "c": ("2", "0"),  # a loop
        "d": ("2", "3"), "e": ("3", "4"), "f": ("4", "2"),  # another, hanging on body 2
        "g": ("4", "5"), "h": ("5", "6"),  # a chain
        "i": ("6", "7"), "j": ("7", "6"),  # two joints between the same bodies
    }  # fmt: skip
    assert blocks(ends) == [("a", "b", "c"), ("d", "e", "f"), ("g",), ("h",), ("i", "j")]
