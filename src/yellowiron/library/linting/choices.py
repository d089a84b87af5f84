"""What a set of choices leaves without what it needs: joints, parents, cylinders, sensors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from yellowiron.model.finding import Finding
from yellowiron.model.rows import split_index
from yellowiron.model.template import CylinderTemplate, JointTemplate, Template, holds


def references(template: Template, chosen: Template, choices: Mapping[str, str]) -> Iterator[Finding]:
    """Entries that stay under the choices and refer to others that do not; `chosen` is the template under them."""
    under = ", ".join(f"{k}={v}" for k, v in choices.items()) or "the template's own choices"
    for where, what in _gone(template, chosen, choices):
        yield Finding("TPL008", "error", where, f"Under {under}, {what} is not there.", "Give both the same 'when'.")
    yield from _sensors(chosen, under)
    yield from _cylinders(chosen)
    yield from _drives(chosen)


def _gone(template: Template, chosen: Template, choices: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """(entry, what it needs and has not) under the choices."""
    roles, joints = {r.name for r in chosen.roles}, {j.name for j in chosen.joints}
    for joint in chosen.joints:
        for part in joint.parts:
            if split_index(part)[0] not in roles:
                yield joint.name, f"its part '{part}'"
        if joint.follows is not None and joint.follows.joint not in joints:
            yield joint.name, f"the joint '{joint.follows.joint}' that it follows"
    for role in chosen.roles:
        if role.parent is not None and role.parent not in roles:
            yield role.name, f"its parent '{role.parent}'"
    for site in chosen.sites:
        if site.body not in roles:
            yield site.name, f"its body '{site.body}'"
    if chosen.root not in roles:
        yield chosen.root, "the root"
    for actuator in template.actuators:
        for cylinder in (c for c in actuator.cylinders if holds(c.when, choices)):
            for name in cylinder.joints:
                if name and name not in joints:
                    yield actuator.name, f"its joint '{name}'"
            for half in (name for pair in cylinder.rams for name in pair):
                if half not in roles:
                    yield actuator.name, f"its part '{half}'"


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


def _cylinders(chosen: Template) -> Iterator[Finding]:
    """Actuators' cylinders: a slide with a drive, each end with its own pivot, or fixed."""
    joints = {j.name: j for j in chosen.joints}
    seen: set[str] = set()
    for actuator in chosen.actuators:
        for cylinder in actuator.cylinders:
            yield from _cylinder(chosen, actuator.name, joints, cylinder)
            if cylinder.slide in seen:
                words = f"Two cylinders have the slide '{cylinder.slide}'."
                hint = "Those that move one slide together are the 'rams' of one cylinder."
                yield Finding("TPL006", "error", actuator.name, words, hint)
            seen.add(cylinder.slide)


def _cylinder(
    template: Template, actuator: str, joints: Mapping[str, JointTemplate], cylinder: CylinderTemplate
) -> Iterator[Finding]:
    slide = cylinder.slide
    if slide not in joints or _missing_parts(template, joints[slide]):
        return
    led = cylinder.passive and joints[slide].follows is not None
    if joints[slide].drive is None and not led:
        yield Finding(
            "TPL006", "error", actuator, f"Its slide '{slide}' has no drive.", 'Give it "Drive": ["Linear Drive"].'
        )
    ends = set(template.bodies_of(joints[slide]))
    if _crossed(template, joints, cylinder):
        yield Finding(
            "TPL006",
            "error",
            actuator,
            f"'{cylinder.barrel_joint}' is at the rod of the cylinder '{slide}', and '{cylinder.rod_joint}' at its "
            "barrel: bore, force and stroke would be measured on the wrong halves.",
            "Exchange barrel_joint and rod_joint.",
        )
    for pair in cylinder.rams:
        known = {r.name for r in template.roles}
        if known.issuperset(pair) and {template.body_of(half) for half in pair} != ends:
            between = " and ".join(f"'{b}'" for b in sorted(str(b) for b in ends))
            words = f"The ram of '{pair[0]}' and '{pair[1]}' is not between {between}, which '{slide}' joins."
            yield Finding("TPL006", "error", actuator, words, "Name its barrel and its rod, one on each of the two.")
    if cylinder.passive and not cylinder.pins and not led:
        words = f"The cylinder '{slide}' is passive and has no pins: nothing else moves its slide."
        yield Finding("TPL006", "error", actuator, words, "Name it among the 'rams' of the driven one.")
    for pivot in cylinder.pins:
        there = pivot in joints and not _missing_parts(template, joints[pivot])
        if there and not ends & set(template.bodies_of(joints[pivot])):
            yield Finding(
                "TPL006",
                "error",
                actuator,
                f"'{pivot}' is at neither end of the cylinder '{slide}'.",
                "Name the pivots of its barrel and rod.",
            )


def _crossed(template: Template, joints: Mapping[str, JointTemplate], cylinder: CylinderTemplate) -> bool:
    """Whether a cylinder's pivots are each at the other half, by the kinds of the bodies that they carry."""
    kinds = {r.name: r.kind for r in template.roles}
    halves = {kinds.get(b or "", ""): b for b in template.bodies_of(joints[cylinder.slide])}
    if halves.keys() != {"barrel", "rod"} or not cylinder.pins or not {*cylinder.pins} <= joints.keys():
        return False
    carried, pushed = (set(template.bodies_of(joints[n])) for n in cylinder.pins)
    return halves["rod"] in carried and halves["barrel"] in pushed


def _drives(chosen: Template) -> Iterator[Finding]:
    """Joints with a drive that no actuator moves."""
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


def _missing_parts(template: Template, joint: JointTemplate) -> bool:
    present = {r.name for r in template.roles}
    return any(split_index(p)[0] not in present for p in joint.parts)


def without(template: Template, broken: Sequence[Finding]) -> Template:
    """The template without joints whose parts are gone, so that the rest can still be checked."""
    if not any(f.code == "TPL008" for f in broken):
        return template
    present = {r.name for r in template.roles}
    roles = tuple(r if r.parent in present else replace(r, parent=None) for r in template.roles)
    return replace(template, roles=roles, joints=tuple(j for j in template.joints if not _missing_parts(template, j)))
