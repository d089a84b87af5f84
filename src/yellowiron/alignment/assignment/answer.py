"""An answer of the search: one reading of the welds under one variant of the template, solved."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import networkx as nx

from yellowiron.alignment.assignment.cp_sat import JOINT_WEIGHT, MISSING_WEIGHT, Effort, Solution, solve
from yellowiron.alignment.assignment.weights import Weights
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.model.template import Template

MOVING = ("revolute", "spherical", "prismatic")
"""Joints that a machine has to show to be whole."""
MARGIN = 20
"""An assignment is doubtful if the best without it scores this little less: less than a name is worth."""
RIVALS = 4.0
"""CP-SAT's deterministic time for all of a machine's rivals; machines that are nearly whole take 0.03 to 0.4."""
SIDED_WEIGHT = 4 * MISSING_WEIGHT
"""What a variant loses for a cylinder that stands to one side where it should be in the middle."""


@dataclass(frozen=True)
class Judged:
    """What a solid was judged to be where contacts alone do not tell (`alignment.fusion`): its `body`, by how much that
    is better than the next (`lead`, the score's units), which that is (None: no body), and why. `grounded`: its names
    tell it from every other body; what only contacts, its shape and place speak for is not."""

    body: str
    lead: float
    second: str | None
    words: str
    grounded: bool


@dataclass(frozen=True, eq=False)
class Answer:
    """One reading of the welds and one variant of the template, solved. `contact`: the tolerance of the contacts, as a
    share of the machine's diagonal. `judged`: solid → what it was judged to be, where contacts alone do not tell.
    `open_choices`: variant → the choices that are nearly as good."""

    contact: float
    structure: Structure
    choices: dict[str, str]
    template: Template
    solution: Solution
    unary: Weights
    sided: tuple[str, ...]
    barred: frozenset[tuple[str, int]]
    judged: Mapping[int, Judged] | None = None
    open_choices: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    @property
    def score(self) -> int:
        """What variants and readings are compared by: a cylinder at the wrong place is worse than a missing one, and a
        pin that is drawn and is no joint's as bad as a joint lost. Else bodies would be found where none is drawn."""
        idle = len(drawn_pins(self.structure) - explained_pins(self))
        return self.solution.score - SIDED_WEIGHT * len(self.sided) - JOINT_WEIGHT * idle


NEARLY_ALL = 0.9
"""Swing booms without pins had 0.96 of their joints; a loader with a grapple, taken for a parallel linkage, 0.72."""


def is_whole(answer: Answer) -> bool:
    """True where every body is played and every joint found, each at a place it may have, and no hydraulic cylinder is
    left over."""
    found = {*answer.solution.hinge_of, *answer.solution.slide_of}
    joints = {j.name for j in answer.template.joints if j.type in MOVING}
    bodies = {r.name for r in answer.template.roles if r.rigid and not r.optional}
    cylinders = {c for slide in answer.structure.slides for c in slide[:2]}
    played = answer.solution.body_of
    return not answer.sided and joints <= found and bodies <= set(played.values()) and cylinders <= set(played)


def open_choices(
    chosen: Mapping[str, str], tried: Sequence[tuple[Mapping[str, str], float]], least: float
) -> dict[str, tuple[str, ...]]:
    """Variant → the choices other than the one `chosen` under which an answer was found that scores `least` or more;
    `tried`: choices, and what the best answer under them scores."""
    close = [other for other, score in tried if score >= least]
    found = {name: {other[name] for other in close if name in other} - {own} for name, own in chosen.items()}
    return {name: tuple(sorted(others)) for name, others in sorted(found.items()) if others}


def found_joints(answer: Answer) -> set[str]:
    """The hinges and slides of its template that an answer has found."""
    joints = {j.name for j in answer.template.joints if j.type in MOVING}
    return joints & {*answer.solution.hinge_of, *answer.solution.slide_of}


def held_share(answer: Answer) -> float:
    """The share of the hinges and slides of its template that an answer has found, 0 to 1."""
    joints = {j.name for j in answer.template.joints if j.type in MOVING}
    return len(found_joints(answer)) / len(joints) if joints else 1.0


def shows_what_is_special(answer: Answer, template: Template) -> bool:
    """Whether an answer shows the special machine that it takes this one for (`Template.special`): it found every hinge
    and slide that only this one has, or nearly all of the machine's (`NEARLY_ALL`). With a part of them any other
    linkage would do. `template`: the type with all its variants."""
    if held_share(answer) >= NEARLY_ALL:
        return True
    special = template.special() & answer.choices.items()
    only = {
        j.name for j in template.joints if any({(n, c) for c in allowed} <= special for n, allowed in j.when.items())
    }
    there = {j.name for j in answer.template.joints if j.type in MOVING}
    return only & there <= {*answer.solution.hinge_of, *answer.solution.slide_of}


def idle_links(answer: Answer) -> frozenset[int]:
    """The clusters that play no body and hang on two others and more: links of a mechanism that the type, as it was
    chosen, does not have."""
    around: dict[int, set[int]] = {}
    for hinge in answer.structure.hinges:
        around.setdefault(hinge.a, set()).add(hinge.b)
        around.setdefault(hinge.b, set()).add(hinge.a)
    return frozenset(c for c, others in around.items() if len(others) > 1 and c not in answer.solution.body_of)


def drawn_share(answer: Answer, solids: Sequence[Solid]) -> float:
    """How much of what is drawn an answer explains, 0 to 1: the least of its shares of the joints between the bodies
    that it has, of the drawn pins, of the slides, and of the surface. 0 where it has no closed linkage: a chain
    alone does not tell one end from the other. Of a machine without cylinders this can be all, though half of the
    type's joints are not found."""
    structure, solution, template = answer.structure, answer.solution, answer.template
    found = {*solution.hinge_of, *solution.slide_of}
    played = set(solution.body_of.values())
    moving = [j for j in template.joints if j.type in MOVING]
    possible = {j.name for j in moving if set(template.bodies_of(j)) <= played}
    # Twin cylinders, and a ram with the sections that it moves, are one slide.
    slides = {frozenset(slide[:2]) for slide in structure.slides}
    sliding = {frozenset(structure.slides[number][:2]) for number in solution.slide_of.values()}
    graph = nx.Graph([pair for j in moving if j.name in found and None not in (pair := template.bodies_of(j))])
    if not nx.cycle_basis(graph):
        return 0.0
    pins = drawn_pins(structure)
    area = [sum(solids[i].surface for i in sorted(c.members)) for c in structure.clusters]
    return min(
        _share(len(found & possible), len(possible)),
        _share(len(explained_pins(answer)), len(pins)),
        _share(len(sliding), len(slides)),
        _share(sum(area[c] for c in solution.body_of), sum(area)),
    )


def drawn_pins(structure: Structure) -> set[int]:
    """The solids on which clusters turn."""
    return {pin for hinge in structure.hinges for pin in hinge.pins}


def explained_pins(answer: Answer) -> set[int]:
    """Those of them on which a joint was found."""
    hinges = answer.structure.hinges
    return {pin for number in answer.solution.hinge_of.values() for pin in hinges[number].pins}


def _share(part: float, whole: float) -> float:
    return part / whole if whole else 1.0


def rivals_of(answer: Answer) -> dict[int, str | None]:
    """Clusters that could as well be another body (or none), and which: where a machine is not whole, its joints alone
    may not tell. All are, from where `RIVALS` is spent: nobody looked."""
    found: dict[int, str | None] = {}
    effort = Effort(RIVALS)
    for cluster, body in sorted(answer.solution.body_of.items()):
        other = solve(
            answer.structure, answer.template, unary=answer.unary, barred=answer.barred, without=(cluster, body),
            at_least=answer.solution.objective - MARGIN - MISSING_WEIGHT, effort=effort,
        )  # fmt: skip
        if other is None and effort.spent:
            found[cluster] = None
        if other is not None and answer.solution.score - other.score < MARGIN:
            found[cluster] = other.body_of.get(cluster)
    return found
