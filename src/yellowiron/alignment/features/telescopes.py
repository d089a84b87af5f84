"""Boxes that slide in boxes: the sections of a telescopic boom, by their flat walls."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from yellowiron.alignment.features.contacts import Flat
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.tolerances import PARALLEL_WALLS
from yellowiron.model.geometry import Floats

SQUARE = 0.02
"""Cosine up to which two walls, or a wall and the boom's end, are square to each other."""
LONG = 2.5
"""A section is this many times longer than wide …"""
SIZED = 0.04
"""… and at least this share of the machine long."""
LOOSE = 0.12
"""The gap between two sections' walls is at most this share of the inner one's width."""
INSIDE = 0.3
"""A section is in the other over at least this many of its widths."""
WALLS = 3
"""So many of the four walls show that one section is in another."""


@dataclass(frozen=True, eq=False)
class Nest:
    """Section `inner` slides in section `outer` (indices of solids) along the line through `origin` (metres, CAD frame)
    in the unit `direction`, which points out of the outer one."""

    outer: int
    inner: int
    origin: Floats
    direction: Floats


def nests_of(solids: tuple[Solid, ...], size: float, tolerance: float) -> list[Nest]:
    """Every long part whose flat walls are close inside those of another, the tightest outer one for each."""
    frames = {s.index: frame for s in solids if (frame := _section(s, size)) is not None}
    best: dict[int, tuple[float, Nest]] = {}
    for a, axes in sorted(frames.items()):
        for b, others in sorted(frames.items()):
            if a == b or abs(float(axes[0] @ others[0])) < PARALLEL_WALLS:
                continue
            gap = _gap(solids[a], solids[b], axes, tolerance)
            if gap is not None and (b not in best or gap < best[b][0]):
                best[b] = (gap, Nest(a, b, *_line(solids[a], solids[b], axes)))
    return [best[b][1] for b in sorted(best)]


def _section(solid: Solid, size: float) -> Floats | None:
    """A long prism's axes (3, 3), the long one first, then across two of its walls; None for what is none."""
    normals = solid.plane_normals
    if len(normals) < 4 or solid.size < SIZED * size:
        return None
    long = np.linalg.svd(solid.points - solid.points.mean(axis=0), full_matrices=False)[2][0]
    walls = normals[np.abs(normals @ long) < 5 * SQUARE]
    if len(walls) < 4:
        return None
    u = walls[int(np.argmax((np.abs(walls @ walls.T) > PARALLEL_WALLS).sum(axis=1)))]
    square = walls[np.abs(walls @ u) < SQUARE]
    if not len(square):
        return None
    v = square[0] - (square[0] @ u) * u
    v /= np.linalg.norm(v)
    axes = np.array([np.cross(u, v), u, v])
    along = solid.points @ axes.T
    spread = np.ptp(along, axis=0)
    return axes if spread[0] > LONG * spread[1:].max() and spread[0] > SIZED * size else None


def _gap(outer: Solid, inner: Solid, axes: Floats, tolerance: float) -> float | None:
    """The widest gap between the walls of a section and of the one inside, metres; None where it is not inside."""
    one, other = outer.points @ axes.T, inner.points @ axes.T
    width = np.ptp(other[:, 1:], axis=0)
    overlap = min(one[:, 0].max(), other[:, 0].max()) - max(one[:, 0].min(), other[:, 0].min())
    if overlap < INSIDE * width.max():
        return None
    gaps, sides = [], set()
    for k in (1, 2):
        for sign in (1.0, -1.0):
            normal = sign * axes[k]
            edge = _wall(inner, normal)
            if edge is None:
                continue
            heights = outer.plane_points[outer.plane_normals @ normal < -PARALLEL_WALLS] @ normal
            near = heights[(heights > edge - tolerance) & (heights < edge + LOOSE * width.max())]
            if len(near):
                gaps.append(max(0.0, float(min(near)) - edge))
                sides.add(k)
    return max(gaps) if len(gaps) >= WALLS and len(sides) == 2 else None


def _wall(solid: Solid, normal: Floats) -> float | None:
    """How far out the outermost wall of a section is that faces a way."""
    facing = solid.plane_normals @ normal > PARALLEL_WALLS
    return float((solid.plane_points[facing] @ normal).max()) if facing.any() else None


def _line(outer: Solid, inner: Solid, axes: Floats) -> tuple[Floats, Floats]:
    one, other = outer.points @ axes.T, inner.points @ axes.T
    middle = 0.5 * (other.min(axis=0) + other.max(axis=0))
    ahead = float(other[:, 0].max() - one[:, 0].max()) >= float(one[:, 0].min() - other[:, 0].min())
    return np.asarray(middle @ axes), axes[0] if ahead else -axes[0]


def sliding_pairs(nests: Iterable[Nest], flats: Iterable[Flat]) -> set[tuple[int, int]]:
    """Pairs of solids (a < b) that lie on each other and slide: two sections, and what is between two sections, which
    goes with the outer one, and the inner."""
    found = set()
    flats = list(flats)
    touching = {(f.a, f.b) for f in flats} | {(f.b, f.a) for f in flats}
    for nest in nests:
        between = {b for a, b in touching if a == nest.outer} & {b for a, b in touching if a == nest.inner}
        for other in (nest.outer, *between):
            found.add((min(other, nest.inner), max(other, nest.inner)))
    return found
