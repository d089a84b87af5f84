"""Bodies: mass, centre and inertia of the parts that move together, and the corners of their convex hulls."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from yellowiron.mechanism.bodies.choice import BY_USER, Choice
from yellowiron.mechanism.bodies.mass import Factor, Masses, Moments, combine
from yellowiron.mechanism.placement import Placement
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats, Mesh
from yellowiron.model.mechanism import Body, BodyPart, Vector
from yellowiron.support.caching.remembered import remembered
from yellowiron.support.vectors import clean_triple

COLLISION = "convexHull"
"""The collision approximation of a part that neither document nor template names."""


def bodies(
    names: Sequence[str],
    origins: Mapping[str, Vector],
    placement: Placement,
    masses: Masses,
    tokens: Choice[str],
    findings: list[Finding],
) -> tuple[Body, ...]:
    """The bodies of those names, in that order, machine frame. `tokens` choose each part's collision
    approximation."""
    result = []
    for name in names:
        rows = placement.rows_of_body(name)
        factor = masses.factors[name]
        whole = combine(masses.moments[row] for row in rows).scaled(factor.value)
        if whole.mass <= 0.0:
            whole = Moments(1.0, placement.points_of(rows).mean(axis=0), np.zeros((3, 3)))
            words = "The body has neither volume nor area: it weighs 1 kg."
            findings.append(Finding("MEC034", "warning", name, words, "Check its parts in the CAD model."))
        result.append(
            Body(
                name=name,
                origin=origins[name],
                mass=whole.mass,
                center_of_mass=clean_triple(whole.center),
                inertia=whole.inertia,
                parts=tuple(_part(row, placement, masses, factor, tokens) for row in rows),
                hull=np.concatenate([_placed_hull(placement, row) for row in rows]),
                source=factor.source,
            )
        )
    return tuple(result)


def _part(row: int, placement: Placement, masses: Masses, factor: Factor, tokens: Choice[str]) -> BodyPart:
    part, role, material = placement.parts[row], placement.roles[row], masses.parts[row]
    token, told = tokens.of(part.name, role) or (COLLISION, "default")
    return BodyPart(
        part=part.id,
        role=role,
        material=material.key,
        collision=token,
        mass=masses.moments[row].mass * factor.value,
        source=f"material {material.source}; collision {told}",
        pooled=not told.startswith(BY_USER),
    )


@remembered
def hull_corners(mesh: Mesh) -> Floats:
    """(n, 3) corners of a mesh's convex hull, in the mesh's order; of a flat or tiny one its distinct points."""
    from scipy.spatial import ConvexHull, QhullError  # a tenth of a second that not every command needs

    try:
        return np.asarray(mesh.points[np.sort(ConvexHull(mesh.points).vertices)], dtype=np.float64)
    except (QhullError, ValueError):
        return np.unique(mesh.points, axis=0)


def _placed_hull(placement: Placement, row: int) -> Floats:
    """(n, 3) hull corners of one placed part: a hull's image under a linear map is the image's hull."""
    matrix = placement.transforms[row]
    corners = hull_corners(placement.shapes[row].mesh)
    return np.asarray(corners @ matrix[:3, :3].T + matrix[:3, 3], dtype=np.float64)
