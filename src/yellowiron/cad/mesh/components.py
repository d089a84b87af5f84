"""What hangs together: the connected components of a graph, for graphs so many and so small that making a sparse matrix
of each would take longer than all the rest."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Indices = NDArray[np.int64]


def linked(pairs: Indices, count: int) -> Indices:
    """(count,) the number of the piece that each of `count` things is in, pieces in the order of their first things;
    `pairs` (k, 2) are tied together.

    Every piece is joined to the smallest of its neighbours until none is left (Borůvka's way: half of those that can
    be joined are gone each time).
    """
    root = np.arange(count)
    one, other = pairs[:, 0], pairs[:, 1]
    while len(one):
        one, other = root[one], root[other]
        apart = one != other
        one, other = one[apart], other[apart]
        np.minimum.at(root, np.maximum(one, other), np.minimum(one, other))
        above = root[root]
        while (above != root).any():
            root, above = above, above[above]
    return np.asarray((np.cumsum(root == np.arange(count)) - 1)[root], dtype=np.int64)
