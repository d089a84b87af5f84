"""The root, where nothing that was found plays it: a machine without its base would be no machine at all."""

from __future__ import annotations

from dataclasses import replace

from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.model.template import Template


def with_root(solution: Solution, structure: Structure, solids: tuple[Solid, ...], template: Template) -> Solution:
    """The solution, with the largest cluster that nothing else is played by as the template's root where that has none.
    No joint speaks for it, so that it comes out as doubtful. What turns on the pin of a joint that was found is another
    piece of the body there."""
    root = template.role(template.root)
    if root.name in solution.body_of.values():
        return solution
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
