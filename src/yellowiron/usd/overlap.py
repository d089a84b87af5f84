"""Bodies whose colliders overlap in the drawn pose, by the oriented boxes of their parts."""

from __future__ import annotations

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.usd.plan import PlacedPart, Plan

TOLERANCE = 1e-3
"""Boxes that interpenetrate by less than this (metres) only touch."""


def overlapping_bodies(plan: Plan, tolerance: float = TOLERANCE) -> list[tuple[str, str]]:
    """Pairs of bodies, in the mechanism's order, that have overlapping collider boxes.

    Boxes enclose their parts, so no overlapping pair is missed; a part that only sits inside another's box may be
    filtered needlessly, which costs a contact that self-collision would have found.
    """
    names, centers, axes, halves = [], [], [], []
    for body in plan.mechanism.bodies:
        for placed in plan.parts[body.name]:
            if placed.approximation.usd and len(placed.prototype.shape.mesh.points):
                center, rotation, half = _box(placed, np.asarray(body.origin))
                names.append(body.name)
                centers.append(center)
                axes.append(rotation)
                halves.append(half)
    if not names:
        return []
    order = {body.name: index for index, body in enumerate(plan.mechanism.bodies)}
    owner = np.array([order[name] for name in names])
    first, second = np.nonzero(owner[:, None] < owner[None, :])
    hit = _boxes_overlap(np.array(centers), np.array(axes), np.array(halves), first, second, tolerance)
    pairs = sorted({(int(owner[i]), int(owner[j])) for i, j in zip(first[hit], second[hit], strict=True)})
    bodies = plan.mechanism.bodies
    return [(bodies[i].name, bodies[j].name) for i, j in pairs]


def _box(placed: PlacedPart, origin: Floats) -> tuple[Floats, Floats, Floats]:
    """Centre, axes (columns) and half edges of a part's box, machine frame. A shear keeps its first axis."""
    points = placed.prototype.shape.mesh.points
    lower, upper = points.min(axis=0), points.max(axis=0)
    linear = placed.matrix[:3, :3]
    rotation, _ = np.linalg.qr(linear)
    corners = np.stack(np.meshgrid(*np.stack([lower, upper], axis=1), indexing="ij"), axis=-1).reshape(-1, 3)
    local = (corners @ linear.T) @ rotation
    low, high = local.min(axis=0), local.max(axis=0)
    center = rotation @ (0.5 * (low + high)) + placed.matrix[:3, 3] + origin
    return center, rotation, 0.5 * (high - low)


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
