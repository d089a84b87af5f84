"""Which reading of a CAD model the template fits best: contact tolerances, readings of the welds, variants.

A machine that is found whole (every body, every joint, no hydraulic cylinder left over) can be so only under a variant
with as many cylinders as are drawn: these come first, with the likeliest readings, from the tightest tolerance to the
widest; then the readings that weld less carefully; only then the other variants. Where contacts do not hold the
machine together, nothing ends that but `EFFORT`: the best so far is the answer then.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from yellowiron.alignment.assignment.answer import (
    MARGIN,
    MOVING,
    Answer,
    idle_links,
    is_whole,
    open_choices,
    shows_what_is_special,
)
from yellowiron.alignment.assignment.cp_sat import (
    JOINT_WEIGHT,
    MISSING_WEIGHT,
    TYPED,
    Effort,
    playing,
    solve,
    without_islands,
)
from yellowiron.alignment.assignment.names import name_scores
from yellowiron.alignment.assignment.one_sided import one_sided
from yellowiron.alignment.assignment.sheet_weights import sheet_weights
from yellowiron.alignment.assignment.sides import twin_role
from yellowiron.alignment.assignment.symmetries import alike_branches
from yellowiron.alignment.assignment.weights import (
    MOSTLY,
    decided_shares,
    name_agreement,
    name_weights,
    size_weights,
)
from yellowiron.alignment.structure.clusters import Structure, loose_ends, structure_of
from yellowiron.alignment.structure.observation import Observation, slewing_joints
from yellowiron.alignment.tolerances import CONTACT, UPRIGHT
from yellowiron.model.errors import AlignmentError
from yellowiron.model.geometry import Floats
from yellowiron.model.rows import across_absent
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template, choose
from yellowiron.support.caching.remembered import remembered

EFFORT = 4.0
"""CP-SAT's deterministic time for a search: of machines that are whole, or nearly, it took 0.01 to 1.8."""
EACH = 1.0
"""… and for one program of it: 0.01 to 0.7."""
MANY_JOINTS = 30
"""A type with more joints may take more, as their cube: a backhoe loader of 59 to 63 took up to 8 for one program when
programs were rewritten first (`cp_sat.solve`)."""
BROKEN = 1.1
"""More pieces that move than this many for a body, and four: spacers and rings on pins are some."""
APART = 0.2
"""The two loose halves of one body, plates of a link, are no farther apart than this share of the machine's size."""
AGAIN = 0.5
"""The share of it for a search made again without names."""
BELIEVED = 0.6
"""Names that agree less with the joints than this have no say in the search."""


@dataclass
class Search:
    """One search: `look` gives what geometry shows with a contact tolerance; the rest as for `align`. `agreement`: how
    far the names agreed with what was found, 0 to 1."""

    look: Callable[[float], Observation]
    template: Template
    specifications: Specifications
    choices: Mapping[str, str]
    edited: Mapping[str, str]
    best: Answer | None = None
    agreement: float = 1.0
    _named: bool = True
    _tried: list[tuple[dict[str, str], float]] = field(default_factory=list)
    _effort: Effort = field(init=False)
    _looked: dict[float, tuple[Observation, list[dict[str, float]], list[Structure]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._effort = self._allowed(1.0)

    def _allowed(self, share: float) -> Effort:
        """What a search may take."""
        joints = sum(1 for j in machine_of(self.template, {}).joints if j.type in ("revolute", "prismatic"))
        more = max(1.0, joints / MANY_JOINTS) ** 3
        return Effort(share * more * EFFORT, more * EACH)

    def run(self) -> tuple[Answer, Observation, list[dict[str, float]]]:
        """The best answer, what was observed with its tolerance, and what the names say of each solid there, as far as
        they are to be believed: where they contradict the joints, the search is made again without them."""
        answer, observation, scores = self._run()
        self.agreement = name_agreement(answer.structure, answer.solution, scores)
        believed = [{body: self.agreement * score for body, score in of.items()} for of in scores]
        if self.agreement < BELIEVED:
            self.best, self._tried = None, []
            self._looked = {c: (s, [{} for _ in s.solids], known) for c, (s, _, known) in self._looked.items()}
            self._named = False
            self._effort = self._allowed(AGAIN)
            answer, observation, _ = self._run()
            if len(believed) != len(observation.solids):
                believed = [{} for _ in observation.solids]
        return answer, observation, believed

    def _run(self) -> tuple[Answer, Observation, list[dict[str, float]]]:
        variants = variants_of(self.template, self.choices)
        for others, careful in ((False, True), (False, False), (True, True)):
            # The other variants only under the tolerance that did best.
            for contact in CONTACT if self.best is None or not others else (self.best.contact,):
                for structure in self._readings(contact, careful=careful):
                    # Sections in each other slide, too, and are no cylinders.
                    drawn = len(self._looked[contact][0].cylinders)
                    first, *rest = _by_cylinders(variants, self.template, drawn)
                    for chosen in itertools.chain(*rest) if others else first:
                        self._try(contact, structure, chosen)
                        if self._effort.spent:
                            return self._result()
                    if self.best is not None and is_whole(self.best) and self._obeyed(self.best):
                        if not others and idle_links(self.best):
                            self._try_special(contact, list(itertools.chain(*rest)), careful=careful)
                        return self._result()
        return self._result()

    def _try_special(self, contact: float, chosen: Sequence[dict[str, str]], *, careful: bool) -> None:
        """Other variants on all readings of the welds: links that are left over may make a special machine whole."""
        read = dict.fromkeys([*self._looked[contact][2], *self._readings(contact, careful=careful)])
        for structure, one in itertools.product(read, chosen):
            if not self._effort.spent:
                self._try(contact, structure, one)

    def _obeyed(self, answer: Answer) -> bool:
        """Whether no cluster is found to be another body than what a person said of most of it."""
        solids, body_of = self._looked[answer.contact][0].solids, answer.solution.body_of
        for c, found in sorted(body_of.items()):
            said = decided_shares(solids, answer.structure.clusters[c].members, answer.template, self.edited)
            if any(share > MOSTLY and found != body for body, share in said.items()):
                return False
        return True

    def _result(self) -> tuple[Answer, Observation, list[dict[str, float]]]:
        assert self.best is not None
        observation, scores, _ = self._looked[self.best.contact]
        if is_whole(self.best):
            return self.best, observation, scores
        as_good = open_choices(self.best.choices, self._tried, self.best.score - MARGIN)
        return replace(self.best, open_choices=as_good), observation, scores

    def _readings(self, contact: float, *, careful: bool) -> Iterator[Structure]:
        """The readings of the welds that were not looked at before (of the careful ones: all)."""
        if contact not in self._looked:
            observation = self.look(contact)
            parts = tuple(s.part for s in observation.solids)
            scores = name_scores(parts, self.template) if self._named else [{} for _ in parts]
            self._looked[contact] = (observation, scores, [])
        observation, _, known = self._looked[contact]
        if careful and known:
            yield from list(known)
            return
        first = _by_cylinders(variants_of(self.template, self.choices), self.template, len(observation.cylinders))[0]
        bodies = max(sum(r.rigid for r in machine_of(self.template, chosen).roles) for chosen in first)
        for structure in _structures(observation, self.template, bodies, careful=careful):
            if not any(_equal(structure, other) for other in known):
                known.append(structure)
                yield structure

    def _try(self, contact: float, structure: Structure, chosen: dict[str, str]) -> None:
        observation, scores, _ = self._looked[contact]
        resolved = machine_of(self.template, chosen)
        unary = name_weights(observation.solids, structure, resolved, scores, self.edited)
        for more in (
            sheet_weights(structure, observation.cylinders, resolved, self.specifications),
            size_weights(observation.solids, structure, resolved),
        ):
            for key, weight in more.items():
                unary[key] = unary.get(key, 0) + weight
        barred = _barred(structure, resolved, observation.up)
        least = _least(self.best, structure, resolved, unary) if self.best is not None else None
        alike = alike_branches(resolved, unary)
        solution = solve(
            structure, resolved, unary=unary, barred=barred, at_least=least, effort=self._effort, alike=alike
        )
        if solution is None:
            return
        drawn = across_absent(resolved, set(solution.body_of.values()))
        if drawn is not resolved:
            again = solve(structure, drawn, unary=unary, barred=barred, effort=self._effort)
            if again is not None and again.score > solution.score:
                resolved, solution = drawn, again
        solution = without_islands(solution, resolved, unary)
        sided = one_sided(observation, structure, solution, self.template, resolved)
        answer = Answer(contact, structure, chosen, resolved, solution, unary, sided, barred)
        self._tried.append((chosen, answer.score))
        # With a part of what makes it special any machine that lacks something would be one.
        if not (self.best is None or shows_what_is_special(answer, self.template)):
            return
        if self.best is None or (is_whole(answer), answer.score) > (is_whole(self.best), self.best.score):
            self.best = answer


def _least(best: Answer, structure: Structure, template: Template, unary: Mapping[tuple[int, str], int]) -> int:
    """The objective below which no answer of a structure is better than the best: what is missing or idle whatever is
    chosen counts against it, and a machine found whole, which beats every other, has at least its joints."""
    missing = 0
    rigid = [r for r in template.roles if r.rigid]
    for kind in TYPED:
        drawn = sum(1 for c in structure.clusters if c.kind == kind)
        roles = [r for r in rigid if r.kind == kind]
        missing += max(0, sum(not r.optional for r in roles) - drawn) + max(0, drawn - len(roles))
    others = sum(structure.clusters[c].kind not in TYPED for c in playing(structure, unary))
    missing += max(0, sum(not r.optional for r in rigid if r.kind not in TYPED) - others)
    better = best.score + MISSING_WEIGHT * missing + 1
    joints = sum(1 for j in template.joints if j.type in MOVING)
    return better if is_whole(best) else min(better, JOINT_WEIGHT * joints)


def _equal(one: Structure, other: Structure) -> bool:
    return (one.clusters, one.hinges, one.slides) == (other.clusters, other.hinges, other.slides)


def _by_cylinders(variants: list[dict[str, str]], template: Template, drawn: int) -> list[list[dict[str, str]]]:
    """The variants in groups: first those with as many hydraulic cylinders as are drawn, and of these common machines
    before special ones: the search is bounded. If one fits wholly, no variant with fewer or more can score as high."""
    special = template.special()
    groups: dict[tuple[int, bool], list[dict[str, str]]] = {}
    for chosen in variants:
        machine = machine_of(template, chosen)
        count = sum(1 for r in machine.roles if r.kind == "barrel")
        # A rope in its block looks like one.
        count += sum(len(a.cylinders) for a in machine.actuators if a.kind == "winch")
        groups.setdefault((abs(count - drawn), not special.isdisjoint(chosen.items())), []).append(chosen)
    return [groups[key] for key in sorted(groups)]


def _structures(observation: Observation, template: Template, bodies: int, *, careful: bool) -> Iterator[Structure]:
    """Readings of the welds, likeliest first: flat contact alone, unless that leaves more pieces that move than the
    machine has `bodies`; then also what touches; each first with wide round things fast in their bores, then turning in
    them. `careful`: without the welds that lock a pin. Where the type has an arm on either side, what is far apart
    across a hinge is first read as two bodies, and then as one."""
    if not observation.evidence:
        yield Structure()
        return
    read = functools.cache(functools.partial(structure_of, leaves=_has_leaves(template), careful=careful))
    wide = APART * observation.size
    apart = [replace(e, halves_within=wide) for e in observation.evidence] if _has_twin_arms(template) else []
    broken = loose_ends(read((*apart, *observation.evidence)[0], weak=False)) > BROKEN * bodies + 4
    for several in (apart, observation.evidence):
        for weak in (broken, not broken):
            for evidence in several:
                yield read(evidence, weak=weak)


def _barred(structure: Structure, template: Template, up: Floats | None) -> frozenset[tuple[str, int]]:
    """A machine slews about the upright: the hinges that lie otherwise are none of its slewing joints."""
    if up is None:
        return frozenset()
    lying = [
        k for k, hinge in enumerate(structure.hinges) if abs(float(structure.axes[hinge.axis].direction @ up)) < UPRIGHT
    ]
    return frozenset((name, k) for name in slewing_joints(template) for k in lying)


def _has_twin_arms(template: Template) -> bool:
    """True if the type has one arm to the left and one to the right, each a body of its own."""
    return any(r.rigid and r.kind == "arm" and twin_role(r.name) is not None for r in template.roles)


def _has_leaves(template: Template) -> bool:
    """True if a body other than a wheel hangs on a single joint."""
    degree: dict[str, int] = {r.name: 0 for r in template.roles if r.rigid}
    for joint in template.joints:
        for body in template.bodies_of(joint):
            if body is not None:
                degree[body] += 1
    kinds = {r.name: r.kind for r in template.roles}
    return any(n == 1 and kinds[b] != "wheel" and b != template.root for b, n in degree.items())


def machine_of(template: Template, chosen: Mapping[str, str]) -> Template:
    """`choose`, made once for every combination: a search asks for the same ones hundreds of times."""
    return _machine(template, frozenset(chosen.items()))


@remembered
def _machine(template: Template, chosen: frozenset[tuple[str, str]]) -> Template:
    return choose(template, dict(chosen))


def variants_of(template: Template, choices: Mapping[str, str]) -> list[dict[str, str]]:
    """Every combination that goes together of the choices that geometry decides; what `choices` fixes is fixed."""
    known = {v.name: v for v in template.variants}
    for name, value in choices.items():
        if name in known and value not in known[name].choices:
            raise AlignmentError(
                f"'{value}' is no choice of {name}",
                where=template.equipment_type,
                hint=f"Choose one of: {', '.join(known[name].choices)}.",
            )
    fixed = {n: v for n, v in choices.items() if n in known}
    open_ones = [v for v in template.variants if v.decided_by == "geometry" and v.name not in fixed]
    ordered = [[v.default, *(c for c in v.choices if c != v.default)] for v in open_ones]
    every = [
        {**fixed, **dict(zip((v.name for v in open_ones), combination, strict=True))}
        for combination in itertools.product(*ordered)
    ]
    if not (found := [chosen for chosen in every if template.go_together(chosen)]):
        said = ", ".join(f"{name}={value}" for name, value in fixed.items())
        raise AlignmentError(
            f"These choices do not go together: {said}",
            where=template.equipment_type,
            hint="Leave one of them to the CAD model, or choose what it needs ('needs' in variants.json).",
        )
    return found
