"""Mass and inertia: given, possible, and in proportion to the body."""

from __future__ import annotations

import numpy as np

from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.values import StageBody, extent
from yellowiron.checks.view import View

_TRIANGLE = 1e-2
_LIGHTEST = 1.2
"""kg/m³: a part of a machine is denser than air, even measured by the box around it."""
_HEAVIEST = 25_000.0
"""kg/m³: nothing is denser than osmium."""
_SHARE = 1e-6
"""Of the machine's mass: below it a link is a mistake, and a solver loses it."""


@rule(
    "CHK030",
    "error",
    "Give it above 0.",
)
def negative(view: View) -> Remarks:
    """A mass or density is negative."""
    for body in view.bodies.values():
        for name, value in (("mass", body.mass), ("density", body.density)):
            if value is not None and value < 0.0:
                yield body.path, f"Its {name} is {value:g}."
    for material in view.materials:
        if material.density is not None and material.density < 0.0:
            yield material.path, f"Its density is {material.density:g} kg/m³."


@rule(
    "CHK031",
    "warning",
    "Give a mass: without one, and without a collider to take a volume from, engines invent one.",
)
def massless(view: View) -> Remarks:
    """A body has no mass."""
    for body in view.bodies.values():
        if body.enabled and not body.mass and not body.has_collider and not body.kinematic:
            yield body.path, "It has no mass, and no collider to take a volume from."


@rule(
    "CHK032",
    "warning",
    "Give a mass, or a density on the body, its colliders or their material.",
)
def guessed(view: View) -> Remarks:
    """A body's mass is left to a guess."""
    dense = {c.body for c in view.colliders if c.density}
    for body in view.bodies.values():
        given = body.mass or body.density or body.path in dense
        if body.enabled and not body.kinematic and not given and body.has_collider:
            yield body.path, "It has neither mass nor density: engines take 1000 kg/m³."


@rule(
    "CHK033",
    "warning",
    "Give its real mass, in the stage's unit: a solver cannot carry a load through it.",
)
def too_light(view: View) -> Remarks:
    """A body weighs next to nothing."""
    for island in view.islands:
        for body in island.bodies:
            if not body.mass or body.mass < 0.0 or not np.isfinite(body.mass):
                continue
            density = _density(body)
            if density is not None and density < _LIGHTEST:
                yield body.path, f"{body.mass:.3g} kg: less than the air in its place weighs."
            elif body.mass < _SHARE * island.mass:
                yield body.path, f"{body.mass:.3g} kg in a machine of {island.mass:.3g} kg."


@rule(
    "CHK034",
    "warning",
    "Look for a mass in grams or tonnes where the stage's unit is kilograms.",
)
def too_heavy(view: View) -> Remarks:
    """A body is heavier than any metal."""
    for body in view.bodies.values():
        density = _density(body)
        if density is not None and density > _HEAVIEST:
            yield body.path, f"{body.mass:.4g} kg in a box of {_volume(body.bounds):.3g} m³."


def _volume(box: np.ndarray[tuple[int, int], np.dtype[np.float64]] | None) -> float:
    return 0.0 if box is None else float(np.prod(box[1] - box[0]))


def _density(body: StageBody) -> float | None:
    """Mass over the box around the body's geometry, kg/m³: the box is never smaller than the body. None if flat."""
    volume = _volume(body.bounds)
    edges = body.bounds[1] - body.bounds[0] if body.bounds is not None else np.zeros(3)
    if not body.mass or edges.min() < 1e-3 * max(edges.max(), 1e-9):
        return None
    return body.mass / volume


@rule(
    "CHK035",
    "error",
    "Principal moments are all above 0, and none exceeds the sum of the other two. Leave all three at 0 to have "
    "them computed.",
)
def impossible_inertia(view: View) -> Remarks:
    """An inertia is impossible."""
    for body in view.bodies.values():
        moments = body.inertia
        if moments is None or not np.isfinite(moments).all() or not moments.any():
            continue
        text = f"({moments[0]:.4g}, {moments[1]:.4g}, {moments[2]:.4g}) kg·m²"
        if moments.min() <= 0.0:
            yield body.path, f"Its principal moments are {text}: one is not above 0."
        elif 2.0 * moments.max() > (1.0 + _TRIANGLE) * moments.sum():
            yield body.path, f"Its principal moments are {text}: one exceeds the sum of the others."


@rule(
    "CHK036",
    "warning",
    "Look for an inertia in other units, or of another mass.",
)
def misfit_inertia(view: View) -> Remarks:
    """An inertia does not fit the body's size."""
    for body in view.bodies.values():
        size = extent(body.bounds)
        moments = body.inertia
        if moments is None or not body.mass or body.mass <= 0.0 or size == 0.0:
            continue
        if not np.isfinite(moments).all() or moments.min() <= 0.0:
            continue
        radius = float(np.sqrt(moments.max() / body.mass))
        if radius > size or radius < 1e-3 * size:
            yield body.path, f"Its radius of gyration is {radius:.3g} m, and it is {size:.3g} m across."


@rule(
    "CHK037",
    "warning",
    "Give it in the body's frame and in the stage's unit.",
)
def center_outside(view: View) -> Remarks:
    """A centre of mass lies outside its body."""
    for body in view.bodies.values():
        if body.bounds is None or body.center_of_mass is None or not np.isfinite(body.center_of_mass).all():
            continue
        nearest = np.clip(body.center_of_mass, body.bounds[0], body.bounds[1])
        distance = float(np.linalg.norm(body.center_of_mass - nearest))
        if distance > 0.5 * extent(body.bounds):
            yield body.path, f"It is {distance:.3g} m outside a body that is {extent(body.bounds):.3g} m across."


@rule(
    "CHK038",
    "warning",
    "Give its mass: engines take 0 for one that is not given, and weigh its colliders instead.",
)
def zero(view: View) -> Remarks:
    """A mass is written as 0."""
    dense = {c.body for c in view.colliders if c.density}
    for island in view.islands:
        for body in island.bodies:
            if body.mass == 0.0 and not body.density and body.path in dense and not body.kinematic:
                yield body.path, "Its mass is 0, so it weighs what its colliders do at their materials' density."
