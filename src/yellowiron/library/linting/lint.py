"""The lint of templates: what loads and still would not make a machine. Codes: docs/template-format.md."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

from yellowiron.library.linting.choices import references, without
from yellowiron.library.linting.entries import SAMPLE, entries
from yellowiron.library.linting.mobility import TemplateMobility, mobility, welded_ends
from yellowiron.library.linting.movement import connections, loose_joints, movement
from yellowiron.model.finding import Finding
from yellowiron.model.rows import expand, split_index
from yellowiron.model.template import AS_DRAWN, Template, choose, holds, in_position
from yellowiron.support.graphs import blocks

MOST_COMBINATIONS = 3000
"""Sets of choices that are looked at; a template with more says so."""
_ORDER = ("error", "warning", "info")


@dataclass(frozen=True)
class LintReport:
    """What the lint found; the mobility under every set of choices; and, under the default choices, the `counts` of
    bodies, joints by type, `linear_drives`, `angular_drives` and `loops`."""

    findings: tuple[Finding, ...]
    mobility: tuple[TemplateMobility, ...]
    counts: Mapping[str, int] = field(default_factory=dict)

    @property
    def sound(self) -> bool:
        """No finding is an error."""
        return not any(f.severity == "error" for f in self.findings)


def lint(template: Template) -> LintReport:
    """Checks names, references and mobility under every set of the template's choices. A finding that several sets
    share is there once; errors come first. A type that is known by its sheet only has nothing to check but its words,
    which loading does."""
    if template.sheet_only:
        return LintReport((), (), {"values asked of a sheet": len(template.wanted)})
    findings: dict[Finding, None] = dict.fromkeys(entries(template))
    figures: list[TemplateMobility] = []
    combinations = _combinations(template)
    for choices in itertools.islice(combinations, MOST_COMBINATIONS):
        chosen = _held(choose(template, choices))
        broken = list(references(template, chosen, choices))
        findings.update(dict.fromkeys(broken))
        chosen = without(chosen, broken)
        findings.update(dict.fromkeys(connections(chosen)))
        expanded = expand(chosen, {r.name: SAMPLE for r in chosen.roles})
        figures.append(mobility(expanded, choices))
        for group in figures[-1].groups:
            findings.update(dict.fromkeys(movement(expanded, group)))
        findings.update(dict.fromkeys(loose_joints(expanded, figures[-1].loose)))
    if next(combinations, None) is not None:
        findings[
            Finding(
                "TPL015", "info", template.equipment_type, f"Only {MOST_COMBINATIONS} sets of choices were checked."
            )
        ] = None
    ordered = sorted(findings, key=lambda f: _ORDER.index(f.severity))
    return LintReport(tuple(ordered), tuple(figures), counts(_held(choose(template, {}))))


def _held(chosen: Template) -> Template:
    """The template with every joint that is held in a position welded."""
    return in_position(replace(chosen, joints=tuple(replace(j, at=j.at and 0.0) for j in chosen.joints)))


def counts(template: Template) -> dict[str, int]:
    """Bodies, joints by type, drives and independent loops of a template whose variants are decided."""
    present = {r.name for r in template.roles}
    joints = [j for j in template.joints if all(split_index(p)[0] in present for p in j.parts)]
    result = {"bodies": sum(r.rigid for r in template.roles)}
    for kind in ("revolute", "prismatic", "fixed", "spherical", "distance"):
        result[kind] = sum(j.type == kind for j in joints)
    for drive in ("linear", "angular"):
        result[f"{drive}_drives"] = sum(j.drive == drive for j in joints)
    ends = welded_ends(template, joints)
    result["loops"] = sum(
        len(names) - len({b for n in names for b in ends[n]}) + 1 for names in blocks(ends) if len(names) > 1
    )
    return result


def _combinations(template: Template) -> Iterator[dict[str, str]]:
    """Every set of choices that goes together. Joints that are held in positions weld wherever they are: all of them as
    drawn, all in their first position, and so on, not one by one."""
    held = {joint.chosen_by for joint in template.joints if joint.positions}
    drawn = dict.fromkeys(held, AS_DRAWN)
    others = [v for v in template.variants if v.name not in held]
    for values in itertools.product(*(v.choices for v in others)):
        choices = dict(zip((v.name for v in others), values, strict=True))
        if not template.go_together({**choices, **drawn}):
            continue
        yield {**choices, **drawn}
        there = {j.chosen_by: [*j.positions] for j in template.joints if j.positions and holds(j.when, choices)}
        for number in range(max(map(len, there.values()), default=0)):
            at = {name: places[min(number, len(places) - 1)] for name, places in there.items()}
            if template.go_together({**choices, **drawn, **at}):
                yield {**choices, **drawn, **at}
