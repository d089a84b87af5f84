"""Which cluster is which body: an assignment over the template's joints, solved to the end by CP-SAT.

x[c, b]: cluster c plays body b; z[j, h]: hinge (or slide) h of the CAD model is joint j of the template. In
local-polytope form (the z that share an x sum to at most that x) the relaxation is tight and the search short.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

from yellowiron.alignment.structure.clusters import Structure
from yellowiron.model.template import JointTemplate, Template

JOINT_WEIGHT = 100
MISSING_WEIGHT = 60
SEED = 1
EFFORT = 30.0
"""CP-SAT's deterministic time, in its own seconds: the answer does not depend on the machine's load."""


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


def solve(
    structure: Structure,
    template: Template,
    *,
    unary: Mapping[tuple[int, str], int] | None = None,
    barred: Collection[tuple[str, int]] = (),
    without: tuple[int, str] | None = None,
    at_least: int | None = None,
) -> Solution | None:
    """The best assignment of clusters to the template's rigid roles (a resolved template, see `choose`).

    `unary[(cluster, body)]` adds weight (a joint counts `JOINT_WEIGHT`); names, sizes and sides come in by it.
    `barred`: (joint, hinge) that cannot be the same; `without`: (cluster, body) that is not to be. None where no
    assignment's objective is `at_least` so much: to be told so is quicker than the best.
    """
    from ortools.sat.python import cp_model

    unary = unary or {}
    bodies = {r.name: r for r in template.roles if r.rigid}
    model = cp_model.CpModel()
    x: dict[tuple[int, str], Any] = {}
    linked = {i for h in structure.hinges for i in (h.a, h.b)} | {i for s in structure.slides for i in s[:2]}
    named = {c for (c, _), weight in unary.items() if weight > 0}
    for c, cluster in enumerate(structure.clusters):
        if c not in linked and c not in named:
            continue
        for name, role in bodies.items():
            typed = role.kind if role.kind in ("wheel", "barrel", "rod") else ""
            if cluster.kind == typed:
                x[c, name] = model.new_bool_var(f"x_{c}_{name}")
    for c in range(len(structure.clusters)):
        model.add_at_most_one([v for (k, _), v in x.items() if k == c])
    for name in bodies:
        model.add_at_most_one([v for (_, b), v in x.items() if b == name])

    terms: list[tuple[int, Any]] = []
    pivots: dict[tuple[str, int], list[Any]] = {}
    slides: dict[tuple[str, int], list[Any]] = {}
    for joint in template.joints:
        first, second = template.bodies_of(joint)
        if first is None or second is None or first == second:
            continue
        edges = [e for e in _edges(joint, structure) if joint.type == "prismatic" or (joint.name, e[0]) not in barred]
        by_end: dict[tuple[int, str], list[Any]] = {}
        every = []
        for number, (a, b) in edges:
            for ca, cb in ((a, b), (b, a)):
                if (ca, first) not in x or (cb, second) not in x:
                    continue
                z = model.new_bool_var(f"z_{joint.name}_{number}_{ca}")
                every.append(z)
                by_end.setdefault((ca, first), []).append(z)
                by_end.setdefault((cb, second), []).append(z)
                table = slides if joint.type == "prismatic" else pivots
                table.setdefault((joint.name, number), []).append(z)
                terms.append((JOINT_WEIGHT, z))
        model.add_at_most_one(every)
        for end, group in by_end.items():
            model.add(sum(group) <= x[end])
    for table in (pivots, slides):
        by_number: dict[int, list[Any]] = {}
        for (_, number), group in table.items():
            by_number.setdefault(number, []).extend(group)
        for group in by_number.values():
            model.add_at_most_one(group)
    terms += [(weight, x[key]) for key, weight in sorted(unary.items()) if key in x and weight]
    terms += [(1, v) for (c, _), v in sorted(x.items()) if c in linked]
    if without in x:
        model.add(x[without] == 0)
    total = sum(weight * v for weight, v in terms)
    if at_least is not None:
        model.add(total >= at_least)
    model.maximize(total)

    solver = cp_model.CpSolver()
    solver.parameters.num_workers = 1
    solver.parameters.random_seed = SEED
    solver.parameters.max_deterministic_time = EFFORT
    status = solver.solve(model)
    if status not in (cp_model.OPTIMAL, cp_model.FEASIBLE):
        if at_least is not None:
            return None
        return Solution({}, {}, {}, -MISSING_WEIGHT * len(bodies), 0, False)
    body_of = {c: b for (c, b), v in x.items() if solver.boolean_value(v)}
    missing = sum(1 for name, role in bodies.items() if not role.optional and name not in body_of.values())
    idle = sum(1 for c, k in enumerate(structure.clusters) if k.kind in ("barrel", "rod", "wheel") and c not in body_of)
    return Solution(
        body_of,
        {j: n for (j, n), group in pivots.items() if any(solver.boolean_value(z) for z in group)},
        {j: n for (j, n), group in slides.items() if any(solver.boolean_value(z) for z in group)},
        round(solver.objective_value) - MISSING_WEIGHT * (missing + idle),
        round(solver.objective_value),
        status == cp_model.OPTIMAL,
    )


def _edges(joint: JointTemplate, structure: Structure) -> list[tuple[int, tuple[int, int]]]:
    if joint.type == "prismatic":
        return [(k, (barrel, rod)) for k, (barrel, rod, _) in enumerate(structure.slides)]
    if joint.type in ("revolute", "spherical"):
        return [(k, (h.a, h.b)) for k, h in enumerate(structure.hinges)]
    return []
