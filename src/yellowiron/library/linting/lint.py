"""The lint of templates: what loads and still would not make a machine. Codes: docs/template-format.md."""

from __future__ import annotations

import fnmatch
import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from yellowiron.library.linting.mobility import Group, TemplateMobility, blocks, mobility, welded_ends
from yellowiron.library.notation.validated_json import near
from yellowiron.library.parsing.joints import DIMENSION, stated_gains
from yellowiron.library.parsing.machine_tests import lint_tests
from yellowiron.model.finding import Finding
from yellowiron.model.rows import expand, rings, split_index
from yellowiron.model.specification import fold
from yellowiron.model.template import Choices, JointTemplate, Template, choose

MOST_COMBINATIONS = 512
"""Sets of choices that are looked at; a template with more says so."""
SAMPLE = 2
"""Parts of a row that the mobility is looked at with: how many there are shows in the CAD model only."""
_EVERY_BODY = "*"
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
    findings: dict[Finding, None] = dict.fromkeys(_whole(template))
    figures: list[TemplateMobility] = []
    combinations = _combinations(template)
    for choices in itertools.islice(combinations, MOST_COMBINATIONS):
        chosen = choose(template, choices)
        broken = list(_references(template, chosen, choices))
        findings.update(dict.fromkeys(broken))
        chosen = _without(chosen, broken)
        findings.update(dict.fromkeys(_connections(chosen)))
        expanded = expand(chosen, {r.name: SAMPLE for r in chosen.roles})
        figures.append(mobility(expanded, choices))
        for group in figures[-1].groups:
            findings.update(dict.fromkeys(_movement(expanded, group)))
        findings.update(dict.fromkeys(_loose(expanded, figures[-1].loose)))
    if next(combinations, None) is not None:
        findings[
            Finding(
                "TPL015", "info", template.equipment_type, f"Only {MOST_COMBINATIONS} sets of choices were checked."
            )
        ] = None
    ordered = sorted(findings, key=lambda f: _ORDER.index(f.severity))
    return LintReport(tuple(ordered), tuple(figures), counts(choose(template, {})))


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
    names = [v.name for v in template.variants]
    for values in itertools.product(*(v.choices for v in template.variants)):
        yield dict(zip(names, values, strict=True))


def _whole(template: Template) -> Iterator[Finding]:
    """What does not depend on the choices."""
    yield from _specifications(template)
    used = {split_index(p)[0] for j in template.joints for p in j.parts}
    for role in template.roles:
        if role.kind == "pin" and role.name not in used:
            yield Finding(
                "TPL009",
                "warning",
                role.name,
                f"No joint uses the pin '{role.name}'.",
                "Name it in the Body of a joint.",
            )
        if role.rigid and role.optional and role.name in used:
            yield Finding(
                "TPL012",
                "warning",
                role.name,
                f"The body '{role.name}' is optional, and a joint needs it.",
                "Declare a variant instead: without the part, the joint is left out.",
            )
    for joint in template.joints:
        stated = [name for name, _ in stated_gains(joint)]
        if joint.drive is None and stated:
            yield Finding(
                "TPL017",
                "warning",
                joint.name,
                f"The joint states {', '.join(stated)} and has no drive: they have no effect.",
                "Give it a Drive.",
            )
    if any(r.many for r in template.roles):
        yield Finding(
            "TPL014",
            "info",
            template.equipment_type,
            f"Rows of parts (name[*]) are looked at with {SAMPLE} parts; rings are joined to nothing and not counted.",
        )
    if not template.actuators:
        yield Finding(
            "TPL007",
            "warning",
            template.equipment_type,
            "Nothing is driven.",
            "Give joints a Drive, and actuators.json.",
        )
    yield from _measurements(template)
    yield from lint_tests(template)
    without = [r.name for r in template.roles if template.materials and r.name not in template.materials]
    if without:
        yield Finding(
            "TPL013", "info", ", ".join(without), "These roles have no material of their own.", 'Add an entry "*".'
        )


def _specifications(template: Template) -> Iterator[Finding]:
    """Names of specifications, in limits and actuators."""
    known = {fold(w.name): w for w in template.wanted}
    said: set[str] = set()
    for joint in template.joints:
        if joint.type == "prismatic" and joint.lower is None and joint.upper is None:
            yield Finding("TPL010", "warning", joint.name, "The slide has no limits.", 'Give Limit ["0", "… Stroke"].')
        for value in (joint.lower, joint.upper):
            if not isinstance(value, str):
                continue
            name = value.lstrip("-").strip()
            wanted = known.get(fold(name))
            if wanted is None and fold(name) not in said:
                said.add(fold(name))
                yield Finding(
                    "TPL004",
                    "info",
                    joint.name,
                    f"The limit '{name}' is not in wanted.json; it is looked for by its words.",
                    near(name, (w.name for w in template.wanted)),
                )
            elif wanted is not None and wanted.dimension != DIMENSION[joint.type]:
                yield Finding(
                    "TPL005",
                    "error",
                    joint.name,
                    f"Its limit '{name}' is a {wanted.dimension}; the joint is {joint.type}.",
                    f"Name a {DIMENSION[joint.type]}.",
                )
    for actuator in template.actuators:
        for quantity, name in actuator.specifications.items():
            if fold(name) not in known and template.wanted:
                yield Finding(
                    "TPL004",
                    "warning",
                    actuator.name,
                    f"Its {quantity} '{name}' is not in wanted.json and not looked for.",
                    near(name, (w.name for w in template.wanted)),
                )


def _measurements(template: Template) -> Iterator[Finding]:
    """Names in the measurements: specification, actuators, sites, joints, bodies."""
    known = {
        "actuator": {a.name for a in template.actuators},
        "site": {s.name for s in template.sites},
        "joint": {j.name for j in template.joints},
        "body": {f"{r.name}_1" if r.many else r.name for r in template.roles if r.rigid},
    }
    parts = [f"{r.name}_1" if r.many else r.name for r in template.roles]
    wanted = {fold(w.name) for w in template.wanted}
    for measurement in template.measurements:
        if fold(measurement.specification) not in wanted:
            yield Finding(
                "TPL011",
                "warning",
                measurement.name,
                f"'{measurement.specification}' is not in wanted.json: nothing to compare with.",
                near(measurement.specification, (w.name for w in template.wanted)),
            )
        for kind, name in dict.fromkeys(_named((measurement.quantity, measurement.steps))):
            # A pattern may fit bodies that are there under other choices only: once these are made, it need not.
            pattern = kind == "body" and _EVERY_BODY in name
            fits = pattern and (not template.variants or fnmatch.filter(parts, name))
            if name not in known[kind] and not fits:
                yield Finding(
                    "TPL011",
                    "error",
                    measurement.name,
                    f"There is no {kind} '{name}'.",
                    near(name, sorted(known[kind])),
                )


_NAMING = {
    "actuator": "actuator",
    "actuators": "actuator",
    "set": "actuator",
    "site": "site",
    "sites": "site",
    "joint": "joint",
    "joints": "joint",
    "from": "joint",
    "bodies": "body",
}


def _named(value: object) -> Iterator[tuple[str, str]]:
    """(kind, name) of everything that a measurement's quantity and steps name."""
    if isinstance(value, Mapping):
        for key, inner in value.items():
            if key in _NAMING:
                yield from ((_NAMING[key], n) for n in ([inner] if isinstance(inner, str) else inner))
            else:
                yield from _named(inner)
    elif isinstance(value, (list, tuple)):
        for inner in value:
            yield from _named(inner)


def _references(template: Template, chosen: Template, choices: Mapping[str, str]) -> Iterator[Finding]:
    """Entries that stay under the choices and refer to others that do not."""
    roles, joints = {r.name for r in chosen.roles}, {j.name: j for j in chosen.joints}
    under = ", ".join(f"{k}={v}" for k, v in choices.items()) or "the template's own choices"

    def gone(where: str, what: str) -> Finding:
        return Finding("TPL008", "error", where, f"Under {under}, {what} is not there.", "Give both the same 'when'.")

    for joint in chosen.joints:
        for part in joint.parts:
            if split_index(part)[0] not in roles:
                yield gone(joint.name, f"its part '{part}'")
    for role in chosen.roles:
        if role.parent is not None and role.parent not in roles:
            yield gone(role.name, f"its parent '{role.parent}'")
    if chosen.root not in roles:
        yield gone(chosen.root, "the root")
    for actuator in template.actuators:
        cylinders = [c for c in actuator.cylinders if _holds(c.when, choices)]
        for cylinder in cylinders:
            for name in (cylinder.slide, cylinder.barrel_joint, cylinder.rod_joint):
                if name and name not in joints:
                    yield gone(actuator.name, f"its joint '{name}'")
    yield from _sensors(chosen, under)
    for kept in chosen.actuators:
        for cylinder in kept.cylinders:
            yield from _cylinder(chosen, kept.name, joints, cylinder.slide, (cylinder.barrel_joint, cylinder.rod_joint))
    driven = {c.slide for a in chosen.actuators for c in a.cylinders} | {j for a in chosen.actuators for j in a.joints}
    for joint in chosen.joints:
        if joint.drive and joint.name not in driven:
            yield Finding(
                "TPL007",
                "warning",
                joint.name,
                "The joint has a drive, and no actuator moves it.",
                "Add it to actuators.json.",
            )


def _sensors(chosen: Template, under: str) -> Iterator[Finding]:
    """Sensors whose place does not exist under the choices."""
    joints = {j.name for j in chosen.joints}
    there = {
        "site": {s.name for s in chosen.sites},
        "role": {r.name for r in chosen.roles},
        "joint": joints,
        "cylinder": joints,
        "actuator": {a.name for a in chosen.actuators},
    }
    for sensor in chosen.sensors:
        for kind, names in there.items():
            if kind in sensor.mount and sensor.mount[kind] not in names:
                words = f"Under {under}, the {kind} '{sensor.mount[kind]}' that it is mounted on is not there."
                yield Finding("TPL018", "warning", sensor.name, words, "Give the sensor the same 'when'.")


def _cylinder(
    template: Template, actuator: str, joints: Mapping[str, JointTemplate], slide: str, pivots: tuple[str, str]
) -> Iterator[Finding]:
    """An actuator's cylinder: a slide with a drive, each end with its own pivot."""
    if slide not in joints or _missing_parts(template, joints[slide]):
        return
    if joints[slide].drive is None:
        yield Finding(
            "TPL006", "error", actuator, f"Its slide '{slide}' has no drive.", 'Give it "Drive": ["Linear Drive"].'
        )
    ends = set(template.bodies_of(joints[slide]))
    for pivot in pivots:
        there = pivot in joints and not _missing_parts(template, joints[pivot])
        if there and not ends & set(template.bodies_of(joints[pivot])):
            yield Finding(
                "TPL006",
                "error",
                actuator,
                f"'{pivot}' is at neither end of the cylinder '{slide}'.",
                "Name the pivots of its barrel and rod.",
            )


def _missing_parts(template: Template, joint: JointTemplate) -> bool:
    present = {r.name for r in template.roles}
    return any(split_index(p)[0] not in present for p in joint.parts)


def _without(template: Template, broken: list[Finding]) -> Template:
    """The template without joints whose parts are gone, so that the rest can still be checked."""
    if not any(f.code == "TPL008" for f in broken):
        return template
    present = {r.name for r in template.roles}
    roles = tuple(r if r.parent in present else replace(r, parent=None) for r in template.roles)
    return replace(template, roles=roles, joints=tuple(j for j in template.joints if not _missing_parts(template, j)))


def _connections(template: Template) -> Iterator[Finding]:
    """Every body is reached from the root over joints, save rings, which touch the machine only."""
    reached, front = {template.root, *rings(template)}, [template.root]
    pairs = [template.bodies_of(j) for j in template.joints]
    while front:
        body = front.pop()
        for first, second in pairs:
            for here, other in ((first, second), (second, first)):
                if here == body and other is not None and other not in reached:
                    reached.add(other)
                    front.append(other)
    for role in template.roles:
        if role.rigid and role.name not in reached:
            yield Finding(
                "TPL001",
                "error",
                role.name,
                f"No chain of joints leads from '{template.root}' to '{role.name}'.",
                "Add the joint that carries it.",
            )


def _movement(template: Template, group: Group) -> Iterator[Finding]:
    """A group of loops moves as its drives want it to: neither locked nor loose, nor one part driven twice."""
    name = _name_of(template, group)
    if group.computed == group.expected:
        if group.undetermined:
            yield Finding(
                "TPL016",
                "error",
                template.root,
                f"The drives of {name} do not determine it: some hold each other, and {group.undetermined} of its "
                f"{group.computed} degrees of freedom is left to none.",
                "Mark twin cylinders passive, and give the joint that is left over a drive.",
            )
        return
    figures = f"planar mobility {group.grubler}, {group.expected} expected"
    if group.computed < group.expected:
        pivots = _missing_pivots(template, group.joints)
        message = f"The {name} is locked ({figures})"
        if pivots:
            listed = " and ".join(f"from '{frame}' to '{part}'" for frame, part in pivots)
            message += f": there is no pivot {listed}, and a part without a joint to its frame is welded to it"
            hint = "Add " + ", ".join(f"{frame}2{part}_joint" for frame, part in pivots) + ": Revolute."
        else:
            hint = "A pivot is missing, or a joint is there twice: " + ", ".join(group.joints) + "."
        yield Finding("TPL002", "error", template.root, f"{message}.", hint)
    else:
        yield Finding(
            "TPL003",
            "error",
            template.root,
            f"The {name} is loose ({figures}, {group.computed} by rank).",
            'A joint or a drive is missing, or "free" is, among: ' + ", ".join(group.joints) + ".",
        )


def _name_of(template: Template, group: Group) -> str:
    """The actuators that drive a group; where their names come from joints, the words those have in common."""
    members = set(group.joints)
    names = [a.name for a in template.actuators if members & {*a.joints, *(c.slide for c in a.cylinders)}]
    short = [n.partition("_cylinder")[0] if "2" in n else n for n in names]
    return " and ".join(dict.fromkeys(short)) or f"loop of {group.joints[0]}"


def _loose(template: Template, joints: Sequence[str]) -> Iterator[Finding]:
    """Joints that no loop holds, nothing drives, and nobody declared free."""
    if joints:
        pivots = _missing_pivots(template, joints)
        listed = " and ".join(f"'{part}'" for _, part in pivots)
        message = "No loop holds these joints and nothing drives them: " + ", ".join(joints)
        yield Finding(
            "TPL003",
            "error",
            joints[0],
            f"{message}; {listed} has no pivot on its frame." if pivots else f"{message}.",
            'Add the missing joint, give them a Drive, or declare them "free": "Y".',
        )


def _missing_pivots(template: Template, joints: Iterable[str]) -> list[tuple[str, str]]:
    """(frame, part) for every half of a cylinder that has no pivot of its own."""
    found = []
    for name in joints:
        joint = template.joint(name)
        for part in joint.parts if joint.type == "prismatic" else ():
            role = template.role(split_index(part)[0])
            if not role.rigid:
                found.append((template.body_of(role.name) or "", role.name))
            elif sum(role.name in template.bodies_of(j) for j in template.joints) < 2:
                found.append(("its frame", role.name))
    return found


def _holds(when: Choices, choices: Mapping[str, str]) -> bool:
    return all(choices.get(name) in allowed for name, allowed in when.items())
