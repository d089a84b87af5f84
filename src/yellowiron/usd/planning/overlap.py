"""Bodies whose colliders overlap in the drawn pose, by the oriented boxes of their parts."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.usd.planning.plan import PlacedPart, Plan

TOLERANCE = 1e-3
"""Boxes that interpenetrate by less than this (metres) only touch."""


def overlapping_bodies(plan: Plan, tolerance: float = TOLERANCE) -> list[tuple[str, str]]:
    """Pairs of bodies, in the mechanism's order, that have overlapping collider boxes.

    Boxes enclose their parts, so no overlapping pair is missed; a part that only sits inside another's box may be
    filtered needlessly, which costs a contact that self-collision would have found.
    """
    bodies = plan.mechanism.bodies
    colliding = [
        (index, placed, body.origin)
        for index, body in enumerate(bodies)
        for placed in plan.parts[body.name]
        if placed.approximation.usd and len(placed.prototype.shape.mesh.points)
    ]
    balls = [(index, shape) for index, body in enumerate(bodies) for shape in body.shapes]
    if not colliding:
        return []
    owner = np.array([index for index, *_ in (*colliding, *balls)])
    centers, axes, halves = _boxes([placed for _, placed, _ in colliding], np.array([o for _, _, o in colliding]))
    if balls:
        centers = np.concatenate([centers, [shape.center for _, shape in balls]])
        axes = np.concatenate([axes, np.broadcast_to(np.eye(3), (len(balls), 3, 3))])
        halves = np.concatenate([halves, [0.5 * np.array(s.size or [2.0 * s.radius] * 3) for _, s in balls]])
    first, second = np.nonzero(owner[:, None] < owner[None, :])
    hit = _boxes_overlap(centers, axes, halves, first, second, tolerance)
    pairs = sorted({(int(owner[i]), int(owner[j])) for i, j in zip(first[hit], second[hit], strict=True)})
    return [(bodies[i].name, bodies[j].name) for i, j in pairs]


def _boxes(parts: Sequence[PlacedPart], origins: Floats) -> tuple[Floats, Floats, Floats]:
    """Centres (n, 3), axes (n, 3, 3; columns) and half edges (n, 3) of the parts' boxes, machine frame. A sheared part
    keeps its first axis."""
    bounds = {}
    for placed in parts:
        shape = placed.prototype.shape
        if shape.key not in bounds:
            bounds[shape.key] = np.stack([shape.mesh.points.min(axis=0), shape.mesh.points.max(axis=0)])
    limits = np.array([bounds[placed.prototype.shape.key] for placed in parts])
    matrices = np.array([placed.matrix for placed in parts])
    axes, triangular = np.linalg.qr(matrices[:, :3, :3])
    middle, half = limits.mean(axis=1), 0.5 * (limits[:, 1] - limits[:, 0])
    centers = np.einsum("nij,nj->ni", matrices[:, :3, :3], middle) + matrices[:, :3, 3] + origins
    # The linear part is axes @ triangular: a box's half edges along the axes are |triangular| times its own.
    return centers, axes, np.einsum("nij,nj->ni", np.abs(triangular), half)


def _boxes_overlap(
    centers: Floats,
    axes: Floats,
    halves: Floats,
    first: np.ndarray[tuple[int], np.dtype[np.intp]],
    second: np.ndarray[tuple[int], np.dtype[np.intp]],
    tolerance: float,
) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Separating axis test of oriented boxes, all pairs at once (Gottschalk, Lin, Manocha 1996: 15 axes)."""
    radius = np.linalg.norm(halves, axis=1)
    gap = np.linalg.norm(centers[first] - centers[second], axis=1) - radius[first] - radius[second]
    hit: np.ndarray[tuple[int], np.dtype[np.bool_]] = gap < -tolerance
    candidates = np.nonzero(hit)[0]
    i, j = first[candidates], second[candidates]
    a, b = axes[i], axes[j]
    crossed = np.cross(a[:, :, :, None], b[:, :, None, :], axis=1).reshape(len(i), 3, 9)
    length = np.linalg.norm(crossed, axis=1)
    tested = np.concatenate([a, b, crossed / np.where(length < 1e-9, 1.0, length)[:, None, :]], axis=2)
    reach = np.einsum("nk,nkt->nt", halves[i], np.abs(np.einsum("nxk,nxt->nkt", a, tested)))
    reach += np.einsum("nk,nkt->nt", halves[j], np.abs(np.einsum("nxk,nxt->nkt", b, tested)))
    apart = np.abs(np.einsum("nx,nxt->nt", centers[j] - centers[i], tested)) - reach
    apart[:, 6:][length < 1e-9] = -np.inf
    hit[candidates] = apart.max(axis=1, initial=-np.inf) < -tolerance
    return hit
