"""A template of a machine of which a person says that some roles are not drawn."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import asdict, replace

import networkx

from yellowiron.model.template import JointTemplate, Template


def undrawn(template: Template, absent: Collection[str]) -> Template:
    """The template without the `absent` roles: without what moves with absent bodies alone, without joints to them, and
    without what speaks of either. Where a pin is absent, its joints are the bodies' all the same. Where the root is,
    the nearest body to it is the root. What nothing joins to the root any more need not be drawn either."""
    gone = {role.name for role in template.roles if role.name in absent}
    if not gone:
        return template
    body_of = {role.name: template.body_of(role.name) for role in template.roles}
    gone |= {name for name, body in body_of.items() if body in gone and not template.role(name).rigid}
    left = {role.name for role in template.roles if role.rigid} - gone
    if not left:
        return template
    root = template.root if template.root in left else _nearest(template, left)
    above = {role.name: role.parent for role in template.roles}

    def parent(name: str) -> str | None:
        found = above[name]
        while found in gone:
            found = above[found]
        return found

    joints = tuple(
        replace(joint, parts=(_standing(joint.parts[0], template, gone), _standing(joint.parts[1], template, gone)))
        for joint in template.joints if not _lost(joint, template, gone)
    )  # fmt: skip
    roles = [replace(role, parent=parent(role.name)) for role in template.roles if role.name not in gone]
    bare = replace(template, root=root, roles=tuple(roles), joints=joints)
    graph = networkx.Graph([ends for joint in joints if None not in (ends := bare.bodies_of(joint))])
    reached = networkx.node_connected_component(graph, root) if root in graph else {root}
    free = {role.name for role in roles if bare.body_of(role.name) not in reached}
    bare = replace(bare, roles=tuple(replace(r, optional=r.optional or r.name in free) for r in roles))
    return _without_words_of(
        _dangling(bare, template), gone | {j.name for j in template.joints} - {j.name for j in joints}
    )


def _dangling(bare: Template, whole: Template) -> Template:
    """The template in which what a loop held before, and nothing drives, hangs freely."""

    def bridges(template: Template) -> set[frozenset[str | None]]:
        ends = [template.bodies_of(joint) for joint in template.joints]
        graph = networkx.Graph([pair for pair in ends if None not in pair])
        return {frozenset(pair) for pair in networkx.bridges(graph)}

    driven = {cylinder.slide for actuator in bare.actuators for cylinder in actuator.cylinders}
    driven |= {name for actuator in bare.actuators for name in actuator.joints}
    new = bridges(bare) - bridges(whole)
    joints = tuple(
        replace(j, free=True)
        if j.type == "revolute" and j.drive is None and j.name not in driven and frozenset(bare.bodies_of(j)) in new
        else j
        for j in bare.joints
    )
    return replace(bare, joints=joints)


def _without_words_of(template: Template, gone: set[str]) -> Template:
    """The template without what speaks of roles and joints that are `gone`: cylinders, motors, sites, and in turn what
    is measured, sensed and tested there."""
    actuators = []
    for actuator in template.actuators:
        cylinders = tuple(c for c in actuator.cylinders if gone.isdisjoint(c.joints))
        motors = tuple(name for name in actuator.joints if name not in gone)
        if cylinders or motors:
            actuators.append(replace(actuator, cylinders=cylinders, joints=motors))
    sites = tuple(s for s in template.sites if s.body not in gone and not _speaks_of(s.rule, gone))
    lost = {a.name for a in template.actuators} - {a.name for a in actuators}
    every = {*gone, *lost, *({s.name for s in template.sites} - {s.name for s in sites})}
    load = template.payload
    return replace(
        template,
        actuators=tuple(actuators),
        sites=sites,
        measurements=tuple(m for m in template.measurements if not _speaks_of((m.quantity, m.steps), every)),
        sensors=tuple(s for s in template.sensors if not _speaks_of(asdict(s), every)),
        tests=tuple(t for t in template.tests if not _speaks_of(asdict(t), every)),
        payload=None if load is not None and _speaks_of(asdict(load), every) else load,
    )


def _speaks_of(value: object, names: Collection[str]) -> bool:
    """Whether one of the names stands in nested data, as a key or a text."""
    if isinstance(value, str):
        return value.lstrip("-").partition("[")[0] in names
    if isinstance(value, Mapping):
        return any(_speaks_of(one, names) for pair in value.items() for one in pair)
    return isinstance(value, list | tuple) and any(_speaks_of(one, names) for one in value)


def _nearest(template: Template, left: Collection[str]) -> str:
    """The body of those `left` that the fewest joints join to the root; frames before others, then as listed."""
    graph = networkx.Graph([ends for joint in template.joints if None not in (ends := template.bodies_of(joint))])
    away = networkx.single_source_shortest_path_length(graph, template.root) if template.root in graph else {}
    kinds = {role.name: role.kind for role in template.roles}
    listed = [role.name for role in template.roles if role.name in left]
    return min(listed, key=lambda body: (kinds[body] != "frame", away.get(body, len(away)), listed.index(body)))


def _lost(joint: JointTemplate, template: Template, gone: Collection[str]) -> bool:
    return any(body in gone for body in template.bodies_of(joint))


def _standing(part: str, template: Template, gone: Collection[str]) -> str:
    """A part of a joint, its body where it is not drawn."""
    name = part.partition("[")[0]
    return str(template.body_of(name)) if name in gone else part
