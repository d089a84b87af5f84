"""Which cluster is which body: an assignment over the template's joints, solved to the end by CP-SAT.

x[c, b]: cluster c plays body b; z[j, h]: hinge (or slide) h of the CAD model is joint j of the template. In
local-polytope form (the z that share an x sum to at most that x) the relaxation is tight and the search short.
"""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import networkx as nx

from yellowiron.alignment.assignment.directions import direction_classes, linkages_of, never_together, twin_linkages
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.model.template import JointTemplate, Template

JOINT_WEIGHT = 100
"""What a joint counts that is found; `weights` are measured against it."""
MISSING_WEIGHT = 60
"""What a body counts that is not found, or a wheel or half of a hydraulic cylinder that is no body."""
TYPED = ("wheel", "barrel", "rod")
"""Kinds of clusters that are told by their shape, and play nothing but bodies of that kind."""
SEED = 1
"""The same answer every time."""
MOST = 10.0
"""What one program may take, of CP-SAT's deterministic time: the answer does not depend on the machine's load. Those of
machines that are whole take 0.01 to 0.7."""

WRITING = 2e-5
"""What writing down a program counts a variable, in the same time."""


@dataclass
class Effort:
    """What several programs may take together: `left` of CP-SAT's deterministic time, `each` of them no more than so
    much. What has run out of it gives the best found so far, or none."""

    left: float
    each: float = MOST

    @property
    def spent(self) -> bool:
        """True where nothing is left."""
        return self.left <= 0.0


@dataclass(frozen=True)
class Solution:
    """Cluster → body, joint → hinge (index into `Structure.hinges`; slides: into `Structure.slides`), the score that
    variants are compared by, what was maximised for it (before what is missing is counted), and whether the search
    proved it the best."""

    body_of: dict[int, str]
    hinge_of: dict[str, int]
    slide_of: dict[str, int]
    score: int
    objective: int
    proven: bool


@dataclass(frozen=True, eq=False)
class _Program:
    """The integer program: the CP-SAT model, `x[c, b]`, for each (joint, hinge) and (joint, slide) its `pivots` and
    `slides`, one z for each way round, and the (weight, variable) `terms` of what is maximised."""

    model: Any
    x: dict[tuple[int, str], Any] = field(default_factory=dict)
    pivots: dict[tuple[str, int], list[Any]] = field(default_factory=dict)
    slides: dict[tuple[str, int], list[Any]] = field(default_factory=dict)
    terms: list[tuple[int, Any]] = field(default_factory=list)


def solve(
    structure: Structure,
    template: Template,
    *,
    unary: Mapping[tuple[int, str], int] | None = None,
    barred: Collection[tuple[str, int]] = (),
    without: tuple[int, str] | None = None,
    at_least: int | None = None,
    effort: Effort | None = None,
    alike: Sequence[Sequence[str]] = (),
) -> Solution | None:
    """The best assignment of clusters to the template's rigid roles (a resolved template, see `choose`).

    `unary[(cluster, body)]` adds weight (a joint counts `JOINT_WEIGHT`); names, sizes and sides come in by it.
    `barred`: (joint, hinge) that cannot be the same; `without`: (cluster, body) that is not to be. None where no
    assignment's objective is `at_least` so much: to be told so is quicker than the best; and where `effort` (default:
    `MOST`), which this takes from, was spent before one was found. `alike`: bodies that may all change places, each
    with what hangs on it (`symmetries.alike_branches`): of the answers that differ by that alone one is looked for.
    """
    from ortools.sat.python import cp_model

    # The search depends on the order in which variables and constraints are made: the steps below fix it.
    effort = effort if effort is not None else Effort(MOST)
    if effort.spent and at_least is not None:
        return None
    unary = unary or {}
    if at_least is not None and at_most(structure, template, unary) < at_least:
        return None
    program = _Program(cp_model.CpModel())
    linked = _linked(structure)
    _add_bodies(program, structure, template, playing(structure, unary))
    for joint in template.joints:
        _add_joint(program, joint, structure, template, barred)
    _add_one_joint_each(program)
    _add_directions(program, structure, template)
    _add_weights(program, unary, linked)
    for group in alike:
        _add_order(program, group, len(structure.clusters))
    if without in program.x:
        program.model.add(program.x[without] == 0)
    total = cp_model.LinearExpr.weighted_sum([v for _, v in program.terms], [weight for weight, _ in program.terms])
    if at_least is not None:
        program.model.add(total >= at_least)
    program.model.maximize(total)

    solver = cp_model.CpSolver()
    solver.parameters.num_workers = 1
    solver.parameters.random_seed = SEED
    # The relaxation is tight as it is written down: to rewrite it takes four times as long as to solve it.
    solver.parameters.cp_model_presolve = False
    # Else it takes Ctrl-C from Python, and leaves it with nobody: the process then dies where it stands.
    solver.parameters.catch_sigint_signal = False
    solver.parameters.max_deterministic_time = max(0.0, min(effort.left, effort.each))
    status = solver.solve(program.model)
    effort.left -= solver.response_proto.deterministic_time + WRITING * len(program.model.proto.variables)
    if status in (cp_model.OPTIMAL, cp_model.FEASIBLE):
        return _solution(program, solver, structure, template, proven=status == cp_model.OPTIMAL)
    if at_least is not None:
        return None
    return Solution({}, {}, {}, -MISSING_WEIGHT * sum(r.rigid for r in template.roles), 0, False)


def at_most(structure: Structure, template: Template, unary: Mapping[tuple[int, str], int]) -> int:
    """What no assignment's objective is more than: every hinge and slide a joint of bodies of the same kinds as its
    clusters', every cluster what most speaks for. Most programs of a machine whose contacts tell little end here."""

    def pair(kinds: Iterable[str]) -> tuple[str, ...]:
        return tuple(sorted(kind if kind in TYPED else "" for kind in kinds))

    kind_of = {r.name: r.kind for r in template.roles if r.rigid}
    drawn = Counter(("pivot", pair(structure.clusters[c].kind for c in (h.a, h.b))) for h in structure.hinges)
    drawn.update(("slide", pair(structure.clusters[c].kind for c in s[:2])) for s in structure.slides)
    wanted = Counter(
        ("slide" if joint.type == "prismatic" else "pivot", pair(kind_of[str(body)] for body in ends))
        for joint in template.joints
        for ends in [template.bodies_of(joint)]
        if joint.type in ("revolute", "spherical", "prismatic") and set(ends) <= kind_of.keys()
    )
    most: dict[int, int] = {}
    for (cluster, _), weight in unary.items():
        most[cluster] = max(most.get(cluster, 0), weight)
    return JOINT_WEIGHT * (drawn & wanted).total() + sum(most.values()) + len(_linked(structure))


def playing(structure: Structure, unary: Mapping[tuple[int, str], int]) -> frozenset[int]:
    """The clusters that can play a body at all: what is on a joint, or what something speaks for."""
    return _linked(structure) | {c for (c, _), weight in unary.items() if weight > 0}


def _linked(structure: Structure) -> frozenset[int]:
    return frozenset({i for h in structure.hinges for i in (h.a, h.b)} | {i for s in structure.slides for i in s[:2]})


def without_islands(
    solution: Solution, template: Template, unary: Mapping[tuple[int, str], int] | None = None
) -> Solution:
    """The solution without pairs of bodies that one hinge joins to each other and nothing to the rest: any two pieces
    on a pin are as good; and without bodies that no joint was found of and that `unary` speaks of less than of another:
    any piece left over is as good. Wheels and halves of hydraulic cylinders are told by their shape, and stay."""
    found = {*solution.hinge_of, *solution.slide_of}
    kinds = {r.name: r.kind for r in template.roles}
    ends = {j.name: template.bodies_of(j) for j in template.joints if j.name in found}
    graph = nx.MultiGraph([(*pair, name) for name, pair in sorted(ends.items())])
    pairs = [group for group in nx.connected_components(graph) if graph.subgraph(group).number_of_edges() == 1]
    gone = {body for pair in pairs for body in pair if not any(kinds[b] in TYPED for b in pair)}
    if len(gone) == len(graph):
        gone = set()
    joints = {name for name, pair in ends.items() if gone & {*pair}}
    most: dict[int, int] = {}
    for (cluster, _), weight in (unary or {}).items():
        most[cluster] = max(most.get(cluster, 0), weight)
    for cluster, body in solution.body_of.items() if unary is not None and len(graph) else ():
        said = unary is not None and 0 < most.get(cluster, 0) <= unary.get((cluster, body), 0)
        gone |= {body} if not (said or body in graph or kinds[body] in TYPED) else set()
    if not gone:
        return solution
    lost = JOINT_WEIGHT * len(joints)
    missing = MISSING_WEIGHT * sum(not template.role(b).optional for b in gone)
    return replace(
        solution,
        body_of={c: b for c, b in solution.body_of.items() if b not in gone},
        hinge_of={j: h for j, h in solution.hinge_of.items() if j not in joints},
        score=solution.score - lost - missing,
        objective=solution.objective - lost,
    )


def _add_bodies(program: _Program, structure: Structure, template: Template, clusters: Collection[int]) -> None:
    """x for every cluster of `clusters` and body of its kind; a cluster plays one body at most, and the other way."""
    model, x = program.model, program.x
    bodies = {r.name: r for r in template.roles if r.rigid}
    for c, cluster in enumerate(structure.clusters):
        if c not in clusters:
            continue
        for name, role in bodies.items():
            typed = role.kind if role.kind in TYPED else ""
            wide = typed == "wheel" and cluster.number in structure.drums
            if cluster.kind == typed and wide == role.drum:
                x[c, name] = model.new_bool_var(f"x_{c}_{name}")
    by_cluster: dict[int, list[Any]] = {c: [] for c in range(len(structure.clusters))}
    by_body: dict[str, list[Any]] = {name: [] for name in bodies}
    for (c, name), variable in x.items():
        by_cluster[c].append(variable)
        by_body[name].append(variable)
    for group in (*by_cluster.values(), *by_body.values()):
        model.add_at_most_one(group)


def _add_joint(
    program: _Program,
    joint: JointTemplate,
    structure: Structure,
    template: Template,
    barred: Collection[tuple[str, int]],
) -> None:
    """z for every hinge or slide that a joint can be, each way round: one of them at most, and only between clusters
    that play the joint's bodies."""
    from ortools.sat.python import cp_model

    first, second = template.bodies_of(joint)
    if first is None or second is None or first == second:
        return
    model, x = program.model, program.x
    table = program.slides if joint.type == "prismatic" else program.pivots
    by_end: dict[tuple[int, str], list[Any]] = {}
    every = []
    for number, (a, b) in _edges(joint, structure, template):
        if joint.type != "prismatic" and (joint.name, number) in barred:
            continue
        for ca, cb in ((a, b), (b, a)):
            if (ca, first) not in x or (cb, second) not in x:
                continue
            z = model.new_bool_var(f"z_{joint.name}_{number}_{ca}")
            every.append(z)
            by_end.setdefault((ca, first), []).append(z)
            by_end.setdefault((cb, second), []).append(z)
            table.setdefault((joint.name, number), []).append(z)
            program.terms.append((JOINT_WEIGHT, z))
    model.add_at_most_one(every)
    for end, group in by_end.items():
        model.add(cp_model.LinearExpr.sum(group) <= x[end])


def _add_one_joint_each(program: _Program) -> None:
    """A hinge or slide is one joint at most."""
    for table in (program.pivots, program.slides):
        by_number: dict[int, list[Any]] = {}
        for (_, number), group in table.items():
            by_number.setdefault(number, []).extend(group)
        for group in by_number.values():
            program.model.add_at_most_one(group)


def _add_directions(program: _Program, structure: Structure, template: Template) -> None:
    """The hinges of a linkage have one direction, as has its mirror image; and those on which frames turn
    another than tools' linkages have."""
    model = program.model
    linkage_of, frames, tools = linkages_of(template)
    class_of, firsts = direction_classes(structure)
    lies: dict[tuple[int, int], Any] = {}
    for (joint, number), group in program.pivots.items():
        if joint not in linkage_of:
            continue
        key = linkage_of[joint], class_of[number]
        if key not in lies:
            lies[key] = model.new_bool_var(f"lies_{key[0]}_{key[1]}")
        for z in group:
            model.add_implication(z, lies[key])
    linkages = sorted({linkage for linkage, _ in lies})
    for linkage in linkages:
        model.add_at_most_one(v for (k, _), v in lies.items() if k == linkage)
    for one, other in sorted(twin_linkages(template, linkage_of)):
        for (k, a), (m, b) in itertools.product(sorted(lies), repeat=2):
            if (k, m) == (one, other) and a != b:
                model.add_at_most_one([lies[k, a], lies[m, b]])
    for turned, tool in itertools.product(sorted(frames & set(linkages)), sorted(tools & set(linkages))):
        for a, b in never_together(firsts):
            if (turned, a) in lies and (tool, b) in lies:
                model.add_at_most_one([lies[turned, a], lies[tool, b]])


def _add_order(program: _Program, group: Sequence[str], last: int) -> None:
    """The clusters that play these bodies in the order of their numbers; those that are not played come last."""
    ranks = []
    for body in group:
        own = [(c, v) for (c, b), v in program.x.items() if b == body]
        ranks.append(last + sum((c - last) * v for c, v in own))
    for one, other in itertools.pairwise(ranks):
        program.model.add(one <= other)


def _add_weights(program: _Program, unary: Mapping[tuple[int, str], int], linked: Collection[int]) -> None:
    """What speaks for a cluster being a body besides its joints; and a little for every linked cluster that is one."""
    x = program.x
    program.terms.extend((weight, x[key]) for key, weight in sorted(unary.items()) if key in x and weight)
    program.terms.extend((1, v) for (c, _), v in sorted(x.items()) if c in linked)


def _solution(program: _Program, solver: Any, structure: Structure, template: Template, *, proven: bool) -> Solution:
    """What the solver found."""
    body_of = {c: b for (c, b), v in program.x.items() if solver.boolean_value(v)}
    played = set(body_of.values())
    missing = sum(1 for r in template.roles if r.rigid and not r.optional and r.name not in played)
    idle = sum(1 for c, k in enumerate(structure.clusters) if k.kind in TYPED and c not in body_of)

    def chosen(table: dict[tuple[str, int], list[Any]]) -> dict[str, int]:
        return {j: n for (j, n), group in table.items() if any(solver.boolean_value(z) for z in group)}

    objective = round(solver.objective_value)
    score = objective - MISSING_WEIGHT * (missing + idle)
    return Solution(body_of, chosen(program.pivots), chosen(program.slides), score, objective, proven)


def _edges(joint: JointTemplate, structure: Structure, template: Template) -> list[tuple[int, tuple[int, int]]]:
    """The hinges or slides that a joint can be: one between two sections that no cylinder moves is no cylinder's."""
    if joint.type == "prismatic":
        kinds = {template.role(str(body)).kind for body in template.bodies_of(joint)}
        moved = any(c.slide == joint.name for a in template.actuators for c in a.cylinders)
        any_slide = moved or bool(kinds & {"barrel", "rod"})
        return [(k, (a, b)) for k, (a, b, n) in enumerate(structure.slides) if any_slide or n >= structure.cylinders]
    if joint.type in ("revolute", "spherical"):
        return [(k, (h.a, h.b)) for k, h in enumerate(structure.hinges)]
    return []
