"""Vacancies: frames that a machine must have and that nothing was found for. What is large enough to be one of them and
only goes with a neighbour of it is no sure part of that neighbour; the largest thing left over may be the root."""

from __future__ import annotations

from collections.abc import Sequence

from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.labelling.place import DOUBTFUL, Place

HALF = 0.5
"""Of a frame's usual share of the surface: what has as much may be it."""


class Vacancies:
    """Which solids may be a frame of which nothing was found, by their size; frames that may be absent leave none."""

    def __init__(self, solids: Sequence[Solid], answer: Answer) -> None:
        judged, template = answer.judged, answer.template
        found = {*answer.solution.body_of.values()} if judged is None else {what.body for what in judged.values()}
        missing = [
            r.name for r in template.roles
            if r.rigid and r.kind == "frame" and not r.optional and r.name not in found and r.name in template.usual
        ]  # fmt: skip
        self._answer = answer
        self._least = {b: HALF * template.usual[b].area for b in missing}
        pairs = [set(template.bodies_of(joint)) for joint in template.joints]
        # The root first: no machine lacks it.
        order = sorted(missing, key=lambda b: (b != template.root, b))
        self._beside = {r.name: [m for m in order if {m, r.name} in pairs] for r in template.roles if r.rigid}
        total = sum(s.surface for s in solids) or 1.0
        meshes: dict[str, float] = {}
        for solid in solids:
            meshes[solid.part.id] = meshes.get(solid.part.id, 0.0) + solid.surface / total
        self._share = {s.index: meshes[s.part.id] for s in solids}
        for cluster in answer.structure.clusters:
            whole = sum(solids[i].surface for i in sorted(cluster.members)) / total
            self._share |= {i: max(self._share[i], whole) for i in sorted(cluster.members)}

    def beside(self, body: str, solid: int) -> str | None:
        """The frame beside `body` that a solid which goes with it may be: the mesh that it is of, or what it is rigid
        with, is large enough."""
        return next((m for m in self._beside.get(body, ()) if self._share[solid] >= self._least[m]), None)

    def root(self) -> dict[int, Place]:
        """Solid → its place, of what was left over by the judge and is the root for want of one (`with_root`), where it
        is large enough for that: for a person to look at."""
        root, judged = self._answer.template.root, self._answer.judged
        if judged is None or root not in self._least:
            return {}
        words = f"the largest that is left over, and nothing else is {root}"
        left = [i for c, b in self._answer.solution.body_of.items() if b == root
                for i in sorted(self._answer.structure.clusters[c].members - judged.keys())]  # fmt: skip
        return {
            i: Place(root, root, DOUBTFUL, words, how="judged") for i in left if self._share[i] >= self._least[root]
        }
