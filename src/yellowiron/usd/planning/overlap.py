"""Bodies whose colliders overlap in the drawn pose."""

from __future__ import annotations

import itertools

import numpy as np

from yellowiron.model.mechanism import Body
from yellowiron.support.convex.solids import Convex, convex, interpenetrate, touch
from yellowiron.usd.planning.plan import Plan
from yellowiron.usd.planning.primitives import Primitive

TOLERANCE = 1e-3
"""Colliders that interpenetrate by less than this (metres) only touch."""


def overlapping_bodies(plan: Plan, tolerance: float = TOLERANCE) -> list[tuple[str, str]]:
    """Pairs of bodies, in the mechanism's order, that have overlapping colliders in any detail. A part that collides
    by itself counts as its hull, so no overlapping pair is missed."""
    solids = {body.name: _solids(plan, body) for body in plan.mechanism.bodies}
    return [
        (one, other)
        for one, other in itertools.combinations(solids, 2)
        if any(
            touch(a, b, -tolerance) and interpenetrate(a, b, 0.5 * tolerance)
            for a, b in itertools.product(solids[one], solids[other])
        )
    ]


def _solids(plan: Plan, body: Body) -> list[Convex]:
    """All that a body collides as, machine frame."""
    found = [convex(Primitive.of(shape).surface()) for shape in body.shapes]
    origin = np.asarray(body.origin)
    for placed in plan.parts[body.name]:
        points = placed.prototype.shape.mesh.points
        if placed.collides and len(points):
            found.append(convex(points @ placed.matrix[:3, :3].T + placed.matrix[:3, 3] + origin))
    for by_body in plan.solids.values():
        found += [one.data.solid.shifted(origin) for one in by_body[body.name]]
    return found
