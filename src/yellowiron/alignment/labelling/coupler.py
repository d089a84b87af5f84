"""A quick coupler, told by shape alone: what stands between a tool's hinges and the tool, which hangs in it on pins of
its own.

It moves with the tool, so that it is no body; its parts carry the bores of the hinges, and two or more other bores
across the machine, as wide, that go on in parts that have none of the hinges' bores. An ear that is welded to its tool
shares no bore with it, and what is bolted on shares narrow ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.alignment.features.contacts import SharedAxis
from yellowiron.alignment.features.solids import Cyl, Solid, coaxial
from yellowiron.alignment.labelling.place import Place
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.alignment.tolerances import SAME_DIRECTION
from yellowiron.model.geometry import Floats

SLACK = 0.1
"""Two bores on one pin are off each other by this share of a radius at most."""
WIDE = 0.6
"""Least radius of a grip's bore by that of the hinges' narrowest."""
_REASON = "between the hinges and the tool, which hangs in it on pins of its own"
_LEAST = 0.6
"""How strong that evidence is."""


def with_couplers(places: Mapping[int, Place], solids: Sequence[Solid], answer: Answer) -> dict[int, Place]:
    """The places of all parts, those of couplers among them; as they were where a name has told a coupler already."""
    found = dict(places)
    template = answer.template
    for role in template.roles:
        body = template.body_of(role.parent) if role.kind == "coupler" and role.parent is not None else None
        if body is None or any(place.role == role.name for place in places.values()):
            continue
        own = [i for i, place in sorted(places.items()) if place.body == body and place.role == body]
        for i in _coupler_parts(own, [solids[i] for i in own], _hinges(body, answer.structure, answer.solution)):
            old = found[i]
            found[i] = replace(old, role=role.name, confidence=min(old.confidence, _LEAST), reason=_REASON, how="bores")
    return found


def _hinges(body: str, structure: Structure, solution: Solution) -> list[SharedAxis]:
    """The distinct axes on which a body hangs."""
    numbers = set()
    for number in solution.hinge_of.values():
        hinge = structure.hinges[number]
        if body in (solution.body_of.get(hinge.a), solution.body_of.get(hinge.b)):
            numbers.add(hinge.axis)
    return [structure.axes[number] for number in sorted(numbers)]


def _coupler_parts(numbers: Sequence[int], solids: Sequence[Solid], hinges: Sequence[SharedAxis]) -> list[int]:
    """Which of a tool's parts are its coupler's; none where it has none. `numbers` of `solids`."""
    if len(hinges) < 2:
        return []
    across = hinges[0].direction
    axes = [_hole(axis) for axis in hinges]
    holes = [_holes_across(s, across, WIDE * min(axis.radius for axis in axes)) for s in solids]
    hung = [{k for k, axis in enumerate(axes) if any(_on_any(c, [axis]) for c in own)} for own in holes]
    if len(set().union(*hung)) < 2:
        return []
    carriers = [n for n, met in enumerate(hung) if met]
    rest = [n for n, met in enumerate(hung) if not met]
    carried = [c for n in carriers for c in holes[n]]
    grips = _grips(carried, [c for n in rest for c in holes[n]], axes)
    if len(grips) < 2:
        return []
    room = np.array([_flat(c.center, across) for c in carried])
    free = [n for n in rest if not any(_on_any(c, grips) for c in solids[n].cylinders)]
    inside = [n for n in free if _within(_flat(solids[n].points, across), room)]
    return [numbers[n] for n in sorted({*carriers, *inside})]


def _holes_across(solid: Solid, across: Floats, least: float) -> list[Cyl]:
    """The bores of a part across the machine, of at least a radius."""
    bores = [c for c in solid.cylinders if c.inner and c.full and c.radius >= least]
    return [c for c in bores if abs(c.direction @ across) > SAME_DIRECTION]


def _grips(carried: Sequence[Cyl], others: Sequence[Cyl], axes: Sequence[Cyl]) -> list[Cyl]:
    """The carriers' bores, one of each axis that is no hinge's, that go on in other parts."""
    grips: list[Cyl] = []
    for hole in carried:
        if not _on_any(hole, (*axes, *grips)) and _on_any(hole, others):
            grips.append(hole)
    return grips


def _hole(axis: SharedAxis) -> Cyl:
    return Cyl(axis.origin, axis.direction, axis.radius, 0.0, 2.0 * np.pi, True)


def _on_any(one: Cyl, others: Iterable[Cyl]) -> bool:
    """True if a cylinder's middle is on the axis of one of these, and parallel to it."""
    return any(coaxial(one, other, SLACK) for other in others)


def _flat(points: Floats, across: Floats) -> Floats:
    """Points (n, 3) as seen along an axis (n, 2)."""
    plane = np.linalg.svd(across[None, :])[2][1:]
    return np.asarray(points @ plane.T)


def _within(points: Floats, room: Floats) -> bool:
    """Whether the middle of points (n, 2) lies in the convex hull of others (m, 2)."""
    from scipy.spatial import Delaunay, QhullError

    try:
        return bool((Delaunay(room).find_simplex(points.mean(axis=0)[None]) >= 0).all())
    except QhullError:
        return False
