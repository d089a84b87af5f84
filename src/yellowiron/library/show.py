"""A template as people see it: the hierarchy as a tree, each body with its pins and the joints that carry it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rich.text import Text
from rich.tree import Tree

from yellowiron.library.notation.quantities import number_text
from yellowiron.library.parsing.joints import DIMENSION
from yellowiron.model.rows import split_index
from yellowiron.model.template import Choices, JointTemplate, Role, Template
from yellowiron.support.units import SI_UNIT


def tree(template: Template, uses: Mapping[str, Mapping[str, Any]] | None = None) -> Tree:
    """The hierarchy with, under each body, its joints (type, other body, pin, limits, drive); of a type known by
    its sheet only, what the sheet is asked for. `uses`: the modules that it is put together from."""
    top = Tree(Text(template.equipment_type, style="bold"))
    if template.sheet_only:
        asked = top.add(Text("asked of a sheet", style="italic"))
        for wanted in template.wanted:
            asked.add(Text.assemble((wanted.name, "bold"), (f"  {wanted.dimension}; {wanted.where}", "dim")))
        return top
    nodes: dict[str | None, Tree] = {None: top}
    shown: set[str] = set()
    for role in template.roles:
        if role.parent is None and not role.rigid and role.name == template.equipment_type:
            nodes[role.name] = top
            continue
        nodes[role.name] = nodes[role.parent].add(_role(role, template))
    for joint in template.joints:
        bodies = [b for b in template.bodies_of(joint) if b is not None]
        for part, body in zip(joint.parts, template.bodies_of(joint), strict=True):
            # Under the body that the joint names itself: the one that moves, where the other is named by its pin.
            if split_index(part)[0] == body and joint.name not in shown:
                nodes[body].add(_joint(joint, next((b for b in bodies if b != body), body)))
                shown.add(joint.name)
    _actuators(top, template)
    _sensors(top, template)
    _variants(top, template)
    _modules(top, uses or {})
    return top


def _modules(top: Tree, uses: Mapping[str, Mapping[str, Any]]) -> None:
    if uses:
        listed = top.add(Text("modules", style="italic"))
        for name, use in uses.items():
            told = ", ".join(f"{key} {value}" for key, value in use.items() if key not in ("module", "source"))
            listed.add(Text.assemble((name, "bold"), f"  {use['module']}", (f"  {told}", "dim")))


def _actuators(top: Tree, template: Template) -> None:
    if template.actuators:
        levers = top.add(Text("actuators", style="italic"))
        for actuator in template.actuators:
            moved = [c.slide for c in actuator.cylinders] or list(actuator.joints)
            levers.add(Text.assemble((actuator.name, "bold"), f"  {actuator.kind}: {', '.join(moved)}"))


def _sensors(top: Tree, template: Template) -> None:
    if template.sensors:
        sensed = top.add(Text("sensors", style="italic"))
        for sensor in template.sensors:
            kind, place = next(iter(sensor.mount.items()))
            notes = [f"{sensor.type} on {kind} {place}", *_when(sensor.when)]
            sensed.add(Text.assemble((sensor.name, "bold"), (f"  {', '.join(notes)}", "dim")))


def _variants(top: Tree, template: Template) -> None:
    if template.variants:
        choices = top.add(Text("variants", style="italic"))
        for variant in template.variants:
            words = ", ".join(f"{c} (default)" if c == variant.default else c for c in variant.choices)
            choices.add(Text.assemble((variant.name, "bold"), f"  {words}; decided by {variant.decided_by}"))


def _role(role: Role, template: Template) -> Text:
    text = Text(role.name + ("[*]" if role.many else ""), style="bold" if role.rigid else "")
    notes = ["root"] if role.name == template.root else []
    notes += [role.kind] if role.kind else []
    notes += ["optional"] if role.optional else []
    notes += [f"hidden, for {role.hidden['row']}"] if role.hidden else []
    notes += _when(role.rigid_when, "body where ")
    notes += _when(role.when)
    return text.append(f"  {', '.join(notes)}" if notes else "", style="dim not bold")


def _joint(joint: JointTemplate, other: str) -> Text:
    pins = [p for p in joint.parts if p.endswith("pin")]
    words = [f"{joint.type} with {other}" + (f" on {pins[0]}" if pins else "")]
    if joint.lower is not None or joint.upper is not None:
        unit = SI_UNIT[DIMENSION[joint.type]]
        ends = [
            "…" if v is None else v if isinstance(v, str) else number_text(v, unit) for v in (joint.lower, joint.upper)
        ]
        words.append(f"{ends[0]} to {ends[1]}")
    words += [f"{joint.drive} drive"] if joint.drive else []
    words += _when(joint.drive_when, "driven where ") if joint.drive else []
    words += ["closed to a ring"] if joint.ring else []
    words += [joint.follows.words] if joint.follows else []
    words += [f"held as drawn, or {', '.join(joint.positions)}"] if joint.positions else []
    words += [_spring(joint), *_when(joint.rest_when, "sprung where ")] if joint.rest is not None else []
    words += (
        ["free"]
        if joint.free and (joint.rest is None or joint.rest_when) and (joint.drive is None or joint.drive_when)
        else []
    )
    words += _when(joint.when)
    return Text.assemble((joint.name, "cyan"), (f"  {', '.join(words)}", "dim"))


def _spring(joint: JointTemplate) -> str:
    """How stiff it is, how much it damps, and where it rests."""
    unit = SI_UNIT[DIMENSION[joint.type]]
    per = {"m": ("N/m", "N*s/m"), "rad": ("N*m/rad", "N*m*s/rad")}[unit]
    gains = zip((joint.stiffness, joint.damping), per, strict=True)
    of = " and ".join(number_text(gain, one) for gain, one in gains if gain)
    rest = joint.rest if isinstance(joint.rest, str) else number_text(joint.rest or 0.0, unit)
    return f"spring of {of}, its rest {rest}"


def _when(when: Choices, before: str = "") -> list[str]:
    return [f"{before}{name}={'|'.join(choices)}" for name, choices in when.items()]
