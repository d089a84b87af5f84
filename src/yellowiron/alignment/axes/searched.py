"""The axes that a search has for the joints it found."""

from __future__ import annotations

from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.features.telescopes import Nest
from yellowiron.alignment.structure.observation import Observation
from yellowiron.model.alignment import Vector
from yellowiron.support.vectors import triple


def searched_axes(answer: Answer) -> dict[str, tuple[Vector, Vector]]:
    """Joint → the axis that the search has for it, for every hinge that it found."""
    structure = answer.structure
    axes = {j: structure.axes[structure.hinges[h].axis] for j, h in sorted(answer.solution.hinge_of.items())}
    return {j: (triple(axis.origin), triple(axis.direction)) for j, axis in axes.items()}


def shown_axes(answer: Answer, observation: Observation) -> dict[str, tuple[Vector, Vector]]:
    """Joint → its axis, for the joints that no pin is drawn for and that no wheel turns on, for the slides whose rod is
    not drawn in its barrel, and for sections in each other."""
    structure, cylinders = answer.structure, observation.cylinders
    found = {}
    for joint, slide in sorted(answer.solution.slide_of.items()):
        outer, _, number = structure.slides[slide]
        drawn = cylinders[number] if number < len(cylinders) else observation.nests[number - len(cylinders)]
        if isinstance(drawn, Nest) or drawn.apart:
            # A section may slide over the one that carries it: outwards is away from that.
            over = isinstance(drawn, Nest) and _carried(answer, joint) == answer.solution.body_of.get(outer)
            found[joint] = (triple(drawn.origin), triple(-drawn.direction if over else drawn.direction))
    for joint, number in sorted(answer.solution.hinge_of.items()):
        hinge = structure.hinges[number]
        if not hinge.pins and not any(structure.clusters[c].kind == "wheel" for c in (hinge.a, hinge.b)):
            axis = structure.axes[hinge.axis]
            found[joint] = (triple(axis.origin), triple(axis.direction))
    return found


def _carried(answer: Answer, joint: str) -> str | None:
    """The second body of a joint."""
    return answer.template.bodies_of(answer.template.joint(joint))[1]
