"""What is no part of the machine: a pallet beside it, a second machine in the same file, the ground it stands on."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from yellowiron.alignment.features.ground import grounds_of
from yellowiron.alignment.tolerances import FAR
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats
from yellowiron.support.caching.remembered import remembered

MACHINE = 0.25
"""A group of so many of the parts may be another machine."""
TRAILED = 1.5
"""What is so many times as far away as is far for the machine alone is no part of it, however few parts it has."""


@remembered
def separate_parts(
    assembly: Assembly, wanted: frozenset[str] = frozenset(), *, grounds: bool = True
) -> dict[str, float]:
    """Part id → metres (between boxes) to the machine, for the parts that stand apart from it.

    The machine is the largest group of parts of which each is near another, among those of many parts; groups that
    hold one of the `wanted` parts belong to it too. Parts without a mesh are never apart. With `grounds`, what all of
    the machine stands on is none of it, 0 m away.
    """
    parts = [p for p in assembly.parts if len(assembly.shape_of(p).mesh.points)]
    if not parts:
        return {}
    points = [assembly.points_of(p) for p in parts]
    under = [k for k in grounds_of(points) if parts[k].id not in wanted] if grounds else []
    found = {parts[k].id: 0.0 for k in under}
    points = [p for k, p in enumerate(points) if k not in under]
    parts = [p for k, p in enumerate(parts) if k not in under]
    low = np.array([p.min(axis=0) for p in points])
    high = np.array([p.max(axis=0) for p in points])
    main = np.ones(len(parts), dtype=bool)
    while True:
        group = groups(low, high, FAR * size_of_boxes(low[main], high[main]))
        mine = _largest(group, low, high)
        if mine.sum() >= main.sum():
            group, mine = _without_neighbours(group, main, low, high)
            if mine.sum() >= main.sum():
                break
        main = mine
    kept = {g for g, p in zip(group.tolist(), parts, strict=True) if p.id in wanted}
    main = main | np.isin(group, sorted(kept))
    return found | {
        parts[i].id: float(gaps(low[i], high[i], low[main], high[main]).min()) for i in np.flatnonzero(~main)
    }


def _without_neighbours(
    group: NDArray[np.int64], main: NDArray[np.bool_], low: Floats, high: Floats
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """The groups, and (n,) the machine among them, where another machine or a trailer is near it for their common size
    but not for its own; else as they are."""
    core = _largest(groups(low, high, 0.5 * FAR * size_of_boxes(low[main], high[main])), low, high)
    own = FAR * size_of_boxes(low[core], high[core])
    for limit, least in ((TRAILED * own, 1.0), (own, MACHINE * main.sum())):
        finer = groups(low, high, limit)
        mine = _largest(finer, low, high)
        others = [int((finer == g).sum()) for g in set(finer[main & ~mine].tolist())]
        if max(others, default=0) >= least:
            return finer, mine
    return group, main


def size_of_boxes(low: Floats, high: Floats) -> float:
    """The diagonal of boxes, metres."""
    return float(np.linalg.norm(high.max(axis=0) - low.min(axis=0)))


def _largest(group: NDArray[np.int64], low: Floats, high: Floats) -> NDArray[np.bool_]:
    """(n,) the largest of the groups that have at least half as many parts as any."""
    counts = {g: int((group == g).sum()) for g in set(group.tolist())}
    many = [g for g, count in counts.items() if 2 * count >= max(counts.values())]
    best = max(many, key=lambda g: (round(size_of_boxes(low[group == g], high[group == g]), 6), counts[g], -g))
    return np.asarray(group == best)


def gaps(low: Floats, high: Floats, lows: Floats, highs: Floats) -> Floats:
    """(n,) distances of one box, (3,) corners, from others, (n, 3) corners; metres."""
    apart = np.maximum(0.0, np.maximum(lows - high, low - highs))
    return np.asarray(np.sqrt(np.einsum("ij,ij->i", apart, apart)))


def groups(low: Floats, high: Floats, limit: float) -> NDArray[np.int64]:
    """(n,) numbers of the groups of boxes, of which each is within `limit` of another: that of its first box."""
    group = np.full(len(low), -1, dtype=np.int64)
    free = np.arange(len(low))
    while len(free):
        start = free[0]
        front, free = [start], free[1:]
        group[start] = start
        while front and len(free):
            i = front.pop()
            near = gaps(low[i], high[i], low[free], high[free]) <= limit
            if near.any():
                group[free[near]] = start
                front += free[near].tolist()
                free = free[~near]
    return group
