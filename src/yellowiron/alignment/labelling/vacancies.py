"""Vacancies: bodies that a machine must have and that nothing was found for. What is large enough to be one of them and
only goes with a neighbour of it is no sure part of that neighbour."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from yellowiron.alignment.assignment.cp_sat import TYPED
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.model.template import Template

HALF = 0.5
"""Of a body's usual share of the surface: what has as much may be it."""


class Vacancies:
    """Which solids may be a body of which nothing is `played`, by their size: what is told by its shape (wheels, halves
    of hydraulic cylinders) or may be absent leaves none."""

    def __init__(
        self, solids: Sequence[Solid], structure: Structure, template: Template, played: Collection[str]
    ) -> None:
        missing = {
            r.name for r in template.roles
            if r.rigid and not r.optional and not r.many and r.kind not in TYPED and r.name not in played
        }  # fmt: skip
        total = sum(s.surface for s in solids) or 1.0
        self._least = {b: HALF * template.usual[b].area for b in sorted(missing) if b in template.usual}
        # The root first: no machine lacks it.
        order = sorted(self._least, key=lambda b: (b != template.root, b))
        pairs = [set(template.bodies_of(joint)) for joint in template.joints]
        bodies = {b for pair in pairs for b in pair if b is not None}
        self._beside = {b: [m for m in order if m != b and {b, m} in pairs] for b in bodies} if order else {}
        surface: dict[str, float] = {}
        for solid in solids:
            surface[solid.part.id] = surface.get(solid.part.id, 0.0) + solid.surface / total
        self._share = {s.index: surface[s.part.id] for s in solids}
        for cluster in structure.clusters:
            whole = sum(solids[i].surface for i in sorted(cluster.members)) / total
            self._share |= {i: max(self._share[i], whole) for i in sorted(cluster.members)}

    def of(self, solid: int, body: str) -> str | None:
        """The body beside `body` that a solid that goes with it may be: the mesh that it is of, or what it is rigid
        with, is large enough."""
        share = self._share[solid]
        return next((m for m in self._beside.get(body, ()) if share >= self._least[m]), None)
