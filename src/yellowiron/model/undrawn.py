"""A template of a machine of which a person says that some roles are not drawn."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import networkx

from yellowiron.model.template import JointTemplate, Template


def undrawn(template: Template, absent: Collection[str]) -> Template:
    """The template without the `absent` roles: without what moves with absent bodies alone, and without joints to them.
    Where a pin is absent, its joints are the bodies' all the same. Where the root is, the nearest body to it is the
    root. What nothing joins to the root any more need not be drawn either."""
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
    return replace(bare, roles=tuple(replace(r, optional=r.optional or r.name in free) for r in roles))


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
