"""The hierarchy: which part names there are, which are bodies, and what moves with what."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from yellowiron.library.notation.quantities import yes
from yellowiron.library.notation.validated_json import Document, near
from yellowiron.library.parsing.variants import choices_of
from yellowiron.model.errors import TemplateError
from yellowiron.model.specification import fold
from yellowiron.model.template import JointTemplate, Role

_ROW = "[*]"
_HIDDEN = {"radius": 0.9, "mass": 1.0, "above": 0.0}


@dataclass
class _Node:
    """One name of the file while it is read."""

    name: str
    where: str
    entry: Mapping[str, Any] = field(default_factory=dict)
    parent: str | None = None
    stated: bool = False


def read_hierarchy(document: Document) -> tuple[Role, ...]:
    """The roles of a `hierarchy.json`: nested entries, lists of names, `parent` keys, or any mix of them, parents
    first. `TemplateError` for a name with two parents, and for one that moves with itself."""
    nodes: dict[str, _Node] = {}

    def visit(name: str, entry: Mapping[str, Any], parent: str | None, keys: tuple[object, ...]) -> None:
        node = nodes.setdefault(fold(_bare(name)), _Node(name, document.at(*keys)))
        if parent is not None:
            _lead(node, parent, document.at(*keys), nodes)
        if node.stated and entry:
            raise TemplateError(
                f"'{name}' is there twice in the hierarchy",
                where=document.at(*keys),
                hint=f"Keep one entry; the other is {node.where}.",
            )
        if entry:
            node.entry, node.stated, node.name = entry, True, name
        if "parent" in entry:
            _lead(node, str(entry["parent"]), document.at(*keys, "parent"), nodes)
        child = entry.get("child", {})
        for follower in child:
            visit(follower, child[follower] if isinstance(child, dict) else {}, name, (*keys, "child", follower))

    for name, entry in document.data.items():
        visit(name, entry, None, (name,))
    for node in nodes.values():
        if node.parent is not None and fold(_bare(node.parent)) not in nodes:
            raise TemplateError(
                f"The parent '{node.parent}' is not in the hierarchy",
                where=node.where,
                hint=near(node.parent, (n.name for n in nodes.values())),
            )
    return tuple(_role(node, nodes, document) for node in _parents_first(nodes))


def read_relations(document: Document, joints: tuple[JointTemplate, ...]) -> tuple[Role, ...]:
    """The roles of a `relations.json` (leader → followers). A name that leads, and every joint's part that follows
    nobody, is a body unless it only groups bodies."""
    nodes: dict[str, _Node] = {}
    for leader, followers in document.data.items():
        nodes.setdefault(fold(leader), _Node(leader, document.at(leader)))
        for index, follower in enumerate(followers):
            node = nodes.setdefault(fold(follower), _Node(follower, document.at(leader, index)))
            _lead(node, leader, document.at(leader, index), nodes)
    for joint in joints:
        for part in joint.parts:
            nodes.setdefault(fold(_bare(part)), _Node(_bare(part), document.at()))
    leaders = {fold(n.parent) for n in nodes.values() if n.parent is not None}
    groups = {fold(n.parent) for n in nodes.values() if n.parent is not None and fold(n.name) in leaders}
    for key, node in nodes.items():
        body = (key in leaders and key not in groups) or node.parent is None or fold(node.parent) in groups
        node.entry = {"rigid body": "Y" if body and key not in groups else "N"}
    return tuple(_role(node, nodes, document) for node in _parents_first(nodes))


def root_of(roles: tuple[Role, ...]) -> str | None:
    """The first body, in the file's order, that moves with no other."""
    by_name = {role.name: role for role in roles}
    for role in roles:
        parent = by_name.get(role.parent) if role.parent else None
        while parent is not None and not parent.rigid:
            parent = by_name.get(parent.parent) if parent.parent else None
        if role.rigid and parent is None:
            return role.name
    return None


def _bare(name: str) -> str:
    return name.strip().removesuffix(_ROW).rstrip()


def _lead(node: _Node, parent: str, where: str, nodes: Mapping[str, _Node]) -> None:
    """Notes that a node moves with `parent`; refuses a second parent and a circle."""
    key = fold(_bare(parent))
    if node.parent is not None and fold(_bare(node.parent)) != key:
        # An ancestor named again further down is a circle; say that rather than "two parents".
        if fold(_bare(node.name)) in _ancestors(key, nodes):
            raise _circle(node.name, where)
        raise TemplateError(
            f"'{node.name}' moves with two parents, '{node.parent}' and '{parent}'",
            where=where,
            hint="A part has one parent; remove one of the two.",
        )
    if fold(_bare(node.name)) in _ancestors(key, nodes):
        raise _circle(node.name, where)
    node.parent = parent


def _ancestors(key: str, nodes: Mapping[str, _Node]) -> Iterator[str]:
    """A name's key, its parent's, and so on; ends at a circle."""
    seen: set[str] = set()
    while key not in seen:
        seen.add(key)
        yield key
        node = nodes.get(key)
        if node is None or node.parent is None:
            return
        key = fold(_bare(node.parent))


def _circle(name: str, where: str) -> TemplateError:
    return TemplateError(
        f"The hierarchy runs in a circle: '{name}' moves with itself",
        where=where,
        hint="Remove the entry that makes a part its own ancestor.",
    )


def _parents_first(nodes: Mapping[str, _Node]) -> list[_Node]:
    """Depth first, children in the file's order."""
    children: dict[str | None, list[str]] = {}
    for key, node in nodes.items():
        children.setdefault(fold(_bare(node.parent)) if node.parent is not None else None, []).append(key)
    ordered: list[_Node] = []
    stack = list(reversed(children.get(None, [])))
    while stack:
        key = stack.pop()
        ordered.append(nodes[key])
        stack.extend(reversed(children.get(key, [])))
    return ordered


def _role(node: _Node, nodes: Mapping[str, _Node], document: Document) -> Role:
    parent = nodes[fold(_bare(node.parent))] if node.parent is not None else None
    return Role(
        name=_bare(node.name),
        parent=_bare(parent.name) if parent is not None else None,
        rigid=yes(node.entry.get("rigid body")),
        kind="wheel" if node.entry.get("kind") == "drum" else node.entry.get("kind", ""),
        drum=node.entry.get("kind") == "drum",
        side=node.entry.get("side", ""),
        optional=yes(node.entry.get("optional")),
        many=node.name.strip().endswith(_ROW),
        when=choices_of(node.entry, "when"),
        rigid_when=choices_of(node.entry, "rigid_when"),
        hidden=_hidden(node),
    )


def _hidden(node: _Node) -> dict[str, Any]:
    """The rule of a row of hidden bodies, with its defaults; empty for any other entry."""
    rule = node.entry.get("hidden")
    if rule is None:
        return {}
    if not node.name.strip().endswith(_ROW) or not yes(node.entry.get("rigid body")):
        raise TemplateError(
            f"'{node.name}' has a hidden rule and is no row of bodies",
            where=node.where,
            hint='Write name[*] and "rigid body": "Y".',
        )
    return {
        "row": _bare(rule["row"]),
        "at": tuple(map(float, rule["at"])),
        **{k: float(rule.get(k, v)) for k, v in _HIDDEN.items()},
    }
