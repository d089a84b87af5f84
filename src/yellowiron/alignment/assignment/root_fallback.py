"""The root, where nothing that was found plays it: a machine without its base would be no machine at all."""

from __future__ import annotations

from dataclasses import replace

from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.alignment.features.solids import Solid, size_of
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template

CRUMB = 0.01
"""A root that no joint speaks for and that has less than this share of the largest surface left over is a crumb."""
GROUND = 0.02
"""What comes as near to the lowest of all, in machine sizes, stands on the ground."""


def with_root(
    solution: Solution, structure: Structure, solids: tuple[Solid, ...], template: Template, up: Floats | None = None
) -> Solution:
    """The solution, with the largest cluster that nothing else is played by as the template's root where that has none.
    No joint speaks for it, so that it comes out as doubtful. What turns on the pin of a joint that was found is another
    piece of the body there. Where a crumb is the root, by no joint, the largest that stands on the ground is it instead
    (`up` (3,): which way is up)."""
    root = template.role(template.root)
    own = next((c for c, body in solution.body_of.items() if body == root.name), None)
    if own is not None:
        return _without_crumb(solution, structure, solids, template, own, up) if up is not None else solution
    pins = {p for number in solution.hinge_of.values() for p in structure.hinges[number].pins}
    hung = {c for h in structure.hinges if pins & {*h.pins} for c in (h.a, h.b)}
    left = [
        (round(sum(solids[i].shape.area for i in cluster.members), 9), -c)
        for c, cluster in enumerate(structure.clusters)
        if c not in solution.body_of and not cluster.kind and c not in hung
    ]
    if not left:
        return solution
    return replace(solution, body_of={**solution.body_of, -max(left)[1]: root.name})


def _without_crumb(
    solution: Solution, structure: Structure, solids: tuple[Solid, ...], template: Template, own: int, up: Floats
) -> Solution:
    """The solution with what stands on the ground as the root, if the cluster that is (`own`) is a crumb."""
    found = {*solution.hinge_of, *solution.slide_of}
    held = any(template.root in template.bodies_of(j) for j in template.joints if j.name in found)
    free = [c for c, cluster in enumerate(structure.clusters) if c not in solution.body_of and not cluster.kind]
    surface = {c: sum(solids[i].surface for i in sorted(structure.clusters[c].members)) for c in (*free, own)}
    if held or surface[own] >= CRUMB * max((surface[c] for c in free), default=0.0):
        return solution
    lows = [float((s.points @ up).min()) for s in solids]
    level = min(lows) + GROUND * size_of(solids)
    standing = [(surface[c], -c) for c in free if min(lows[i] for i in structure.clusters[c].members) <= level]
    if not standing:
        return solution
    bodies = {c: body for c, body in solution.body_of.items() if c != own}
    return replace(solution, body_of={**bodies, -max(standing)[1]: template.root})
