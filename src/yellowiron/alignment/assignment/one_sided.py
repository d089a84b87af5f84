"""Cylinders that stand to one side of the machine where a template's variant has one in the middle."""

from __future__ import annotations

from collections.abc import Iterator

from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.alignment.structure.observation import Observation
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template

ONE_SIDED = 0.12
"""A cylinder further than this share of its bodies' width from their middle is to one side."""


def one_sided(
    observation: Observation, structure: Structure, solution: Solution, template: Template, resolved: Template
) -> tuple[str, ...]:
    """Barrels without a side, which another variant of `template` has left and right, that are not in the middle of the
    bodies they hinge on. `resolved` is the template with its variants decided, which `solution` is of."""
    sided = {r.name for r in template.roles}
    kinds = {r.name: r.kind for r in resolved.roles}
    found = []
    for joint in resolved.joints:
        slide = solution.slide_of.get(joint.name)
        ends = [b for b in resolved.bodies_of(joint) if b is not None]
        barrel = next((b for b in ends if kinds.get(b) == "barrel"), None)
        if slide is None or barrel is None or f"{barrel}_l" not in sided:
            continue
        origin = observation.cylinders[structure.slides[slide][2]].origin
        shares = list(_off_middle(origin, ends, observation.solids, structure, solution, resolved))
        if shares and min(shares) > ONE_SIDED:
            found.append(barrel)
    return tuple(found)


def _off_middle(
    origin: Floats, ends: list[str], solids: tuple[Solid, ...], structure: Structure, solution: Solution,
    resolved: Template,
) -> Iterator[float]:  # fmt: skip
    """How far a cylinder (a point of its axis, its two bodies) is from the middle of each body that it hinges on, along
    the hinge, as a share of that body's width."""
    cluster_of = {b: c for c, b in solution.body_of.items()}
    for pivot in resolved.joints:
        bodies = [b for b in resolved.bodies_of(pivot) if b is not None]
        host = next((b for b in bodies if b not in ends), None)
        hinge = solution.hinge_of.get(pivot.name)
        if hinge is None or host not in cluster_of or not set(bodies) & set(ends):
            continue
        along = structure.axes[structure.hinges[hinge].axis].direction
        reach = [p for i in structure.clusters[cluster_of[host]].members for p in _extent(solids[i], along)]
        low, high = min(reach), max(reach)
        yield abs(float(origin @ along) - 0.5 * (low + high)) / max(high - low, 1e-9)


def _extent(solid: Solid, along: Floats) -> tuple[float, float]:
    run = solid.points @ along
    return float(run.min()), float(run.max())
