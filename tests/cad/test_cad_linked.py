"""Pieces of graphs, against scipy's."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from yellowiron.cad.mesh.components import linked


@pytest.mark.parametrize("seed", range(20))
def test_pieces_are_scipys(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 200))
    pairs = rng.integers(0, count, (int(rng.integers(0, 2 * count)), 2))
    graph = coo_array((np.ones(len(pairs), dtype=np.int8), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    assert np.array_equal(linked(pairs, count), connected_components(graph, directed=False)[1])


@pytest.mark.parametrize("order", ["along", "back", "mixed"])
def test_long_chains_are_one_piece(order: str) -> None:
    number = np.arange(5000)
    if order == "mixed":
        number = np.random.default_rng(3).permutation(number)
    pairs = np.stack([number[:-1], number[1:]], axis=1)
    assert not linked(pairs[::-1] if order == "back" else pairs, 5000).any()


def test_nothing_tied_is_all_apart() -> None:
    assert linked(np.zeros((0, 2), dtype=np.int64), 3).tolist() == [0, 1, 2]
