"""A machine whose file declares its bodies and joints (a robot description), for a template to be made from.

1. bodies are the links that draw something; what is welded together is one, unless geometry shows that it turns
2. joints are those declared; links that draw nothing take their joints along
3. what geometry finds besides is added where a description has no word for it: the pins that close its loops
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from yellowiron.alignment.discovery.description import across, some
from yellowiron.alignment.discovery.discover import discover
from yellowiron.alignment.structure.loops import Edge, bridges, components, freedoms
from yellowiron.alignment.tolerances import UPRIGHT
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import PARALLEL_HINGES, Assembly, DeclaredJoint, Part, loop_axis
from yellowiron.model.errors import AlignmentError
from yellowiron.model.finding import Finding
from yellowiron.model.found import FoundBody, FoundJoint, FoundMachine, Vector
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template
from yellowiron.support.graphs import LedSets

BESIDE = 0.01
"""Metres up to which two hinges are on one line."""
ROUND = 0.05
"""A wheel is round, and on its axis, within this share of its radius."""
_MOVING = ("revolute", "prismatic")
_Type = Literal["revolute", "prismatic", "fixed"]


@dataclass(frozen=True)
class _Joint:
    """A joint of two links: about or along a line (metres, unit vector, the file's frame)."""

    name: str
    type: _Type
    a: str
    b: str
    point: Vector
    axis: Vector
    reason: str
    pins: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class _Links:
    """The file's links: link → its parts, for those that draw something; link → m² of these; link → the first link of
    those that are one body with it (`group`), which stands for the body."""

    assembly: Assembly
    parts: Mapping[str, Sequence[Part]]
    area: Mapping[str, float]
    group: Mapping[str, str]

    def ends(self, joint: _Joint) -> tuple[str, str]:
        """The two bodies of a joint."""
        return self.group[joint.a], self.group[joint.b]

    def drawn(self, body: str) -> list[str]:
        """The links of a body that draw something."""
        return [link for link in self.parts if self.group[link] == body]

    def surface(self, body: str) -> float:
        """The surface of a body, m²."""
        return sum(a for link, a in self.area.items() if self.group[link] == body)

    def title(self, body: str) -> str:
        """A body is called after its link, of several the largest."""
        return max(self.drawn(body), key=lambda link: self.area[link])

    def ids(self, body: str) -> tuple[str, ...]:
        """The ids of a body's parts, in CAD order."""
        drawn = self.drawn(body)
        return tuple(p.id for p in self.assembly.parts if any(p in self.parts[link] for link in drawn))


def declared_roles(assembly: Assembly, template: Template, found: Alignment) -> tuple[PartAssignment, ...]:
    """Bodies for the parts that an alignment put elsewhere than the file's own links say. Only where the file has a
    link for every body of the template, by its name: then the template was made from it."""
    links = assembly.links()
    roles = {_key(r.name): r.name for r in template.roles if r.rigid and not r.hidden}
    body = {link: roles[_key(link)] for link in links if _key(link) in roles}
    if not body or {r.name for r in template.roles if r.rigid and not r.optional} - set(body.values()):
        return ()
    body = assembly.over_welds(body)
    wanted = {part.id: body[link] for link, parts in links.items() if link in body for part in parts}
    return tuple(
        PartAssignment(a.part, wanted[a.part], wanted[a.part], 1.0, "the file declares it as that body", source="data")
        for a in found.parts
        if wanted.get(a.part, a.body) != a.body and a.source == "solved"
    )


def _key(name: str) -> str:
    return re.sub(r"[\W_]+", "", name).casefold()


def robot(assembly: Assembly, geometry: FoundMachine | None) -> FoundMachine | None:
    """The machine as its file declares it; None where the file declares no joint between two bodies that it draws.

    `geometry` is what `discover` finds in the same model, if anything. Findings: ALN024, ALN025.
    """
    parts = assembly.links()
    area = {name: sum(assembly.shape_of(p).area for p in drawn) for name, drawn in parts.items()}
    shown = _between_links(assembly, geometry)
    apart = {frozenset((j.a, j.b)) for j in shown}
    names = list(dict.fromkeys(b for j in assembly.joints for b in j.bodies if b))
    links = _Links(assembly, parts, area, _groups(assembly.joints, names, parts, apart))
    moving = [j for j in _declared(assembly.joints) if len(set(links.ends(j))) == 2]
    drawn = {links.group[name] for name in parts}
    left = [j.name for j in moving if not set(links.ends(j)) <= drawn]
    joints = [_with_pins(j, shown, links) for j in moving if j.name not in left]
    if not joints:
        return None
    extra = [j for j in shown if len(set(links.ends(j))) == 2 and set(links.ends(j)) <= drawn]
    extra = [j for j in extra if not _is_known(j, joints, links)]
    if freedoms(_edges([*joints, *extra], links))[0] <= freedoms(_edges(joints, links))[0]:
        joints += extra
    return _describe(links, joints, left, geometry)


def _between_links(assembly: Assembly, geometry: FoundMachine | None) -> list[_Joint]:
    """The joints that geometry finds, each between the two links that are nearest to it of the bodies it joins."""
    if geometry is None:
        return []
    link_of = {part.id: name for name, parts in assembly.links().items() for part in parts}
    parts = {part.id: part for part in assembly.parts}
    found = []
    for joint in geometry.joints:
        ends = []
        for body in (geometry.bodies[joint.a], geometry.bodies[joint.b]):
            near: dict[str, float] = {}
            for part in (parts[p] for p in body.parts if p in link_of and p not in joint.pins):
                offset = assembly.points_of(part) - np.array(joint.point)
                distance = np.linalg.norm(np.cross(offset, joint.direction), axis=1).min()
                near[link_of[part.id]] = min(near.get(link_of[part.id], np.inf), round(float(distance), 6))
            ends.append(min(near, key=lambda n: (near[n], n)) if near else "")
        if joint.type in _MOVING and all(ends) and ends[0] != ends[1]:
            reason = f"found by: {joint.reason}; the file does not declare it"
            one, other = ends
            found.append(_Joint("", joint.type, one, other, joint.point, joint.direction, reason, joint.pins))
    return found


def _groups(
    declared: Sequence[DeclaredJoint], names: Sequence[str], links: Mapping[str, object], apart: set[frozenset[str]]
) -> dict[str, str]:
    """Link → the first link of those that are one body with it."""
    groups = LedSets(names)
    for joint in declared:
        one, other = joint.bodies
        if joint.type == "fixed" and one and other and frozenset((one, other)) not in apart:
            groups.join(one, other)
    for joint in declared:
        # A link without a shape between two that have one: it goes with the one it hangs on.
        one, other = joint.bodies
        if joint.type not in _MOVING or not one or not other:
            continue
        drawn = {groups.leader(name) for name in links}
        hung = groups.leader(other)
        onward = any(j.bodies[0] and groups.leader(j.bodies[0]) == hung for j in declared)
        if hung not in drawn and onward:
            groups.join(one, other)
    return {name: groups.leader(name) for name in names}


def _declared(joints: Sequence[DeclaredJoint]) -> Iterator[_Joint]:
    """The declared hinges and slides, and points that close a loop as the hinges that the loop makes of them."""
    for joint in joints:
        one, other = joint.bodies
        if not one or not other:
            continue
        bounds = ""
        if joint.lower is not None and joint.upper is not None:
            unit, scale = ("m", 1.0) if joint.type == "prismatic" else ("°", 180.0 / np.pi)
            bounds = f", {joint.lower * scale:.6g} to {joint.upper * scale:.6g} {unit}"
        reason = f"declared by the file: {joint.type} joint '{joint.name}'{bounds}"
        if joint.type in _MOVING:
            kind: _Type = "revolute" if joint.type == "revolute" else "prismatic"
            yield _Joint(joint.name, kind, one, other, joint.anchor, joint.axis, reason)
        axis = loop_axis(joint, joints) if joint.type == "spherical" else None
        if axis is not None:
            yield _Joint(joint.name, "revolute", one, other, joint.anchor, axis, reason)


def _edges(joints: Sequence[_Joint], links: _Links) -> list[Edge]:
    number = {name: k for k, name in enumerate(dict.fromkeys(links.group.values()))}
    ends = [links.ends(j) for j in joints]
    sliding = [j.type == "prismatic" for j in joints]
    return [Edge(number[a], number[b], k, k, sliding[k], sliding[k]) for k, (a, b) in enumerate(ends)]


def _with_pins(joint: _Joint, shown: Sequence[_Joint], links: _Links) -> _Joint:
    """A declared hinge with the pins that geometry finds on its line."""
    ends = set(links.ends(joint))
    same = (s for s in shown if set(links.ends(s)) == ends and s.pins and _in_line(joint, s))
    found = next(same, None) if joint.type == "revolute" else None
    return joint if found is None else replace(joint, pins=found.pins)


def _in_line(one: _Joint, other: _Joint) -> bool:
    beside = float(np.linalg.norm(np.cross(np.subtract(one.point, other.point), other.axis)))
    return one.type == other.type == "revolute" and beside < BESIDE and _along(one.axis, other.axis)


def _is_known(extra: _Joint, joints: Sequence[_Joint], links: _Links) -> bool:
    """Whether there is a joint between these bodies, or both turn on the same line already."""
    ends = set(links.ends(extra))
    on = set()
    for joint in joints:
        pair = set(links.ends(joint))
        if pair == ends:
            return True
        if _in_line(joint, extra):
            on |= pair
    return ends <= on


def _along(one: Vector, other: Vector) -> bool:
    return abs(float(np.dot(one, other))) > PARALLEL_HINGES


def _describe(
    links: _Links, joints: Sequence[_Joint], left: Sequence[str], geometry: FoundMachine | None
) -> FoundMachine:
    """The machine, its root first and its bodies from there outward. `left`: names of the joints left out."""
    edges = _edges(joints, links)
    names = list(dict.fromkeys(links.group.values()))
    largest = max(components(edges), key=lambda piece: sum(links.surface(names[k]) for k in piece))
    joints = [j for j, e in zip(joints, edges, strict=True) if e.a in largest]
    edges = [e for e in edges if e.a in largest]
    order = _outward(_root([names[k] for k in sorted(largest)], links), joints, links)
    up = _upright(joints)
    ids = {n: links.ids(n) for n in order}
    kinds = _kinds(links, order, ids, joints, up, geometry)
    bodies = [FoundBody(ids[n], kinds[n], (n,), _reason(n, links), name=links.title(n)) for n in order]
    single = bridges(edges)
    found = [
        _found_joint(joint, order, ids, up, links, in_chain=edge not in single)
        for joint, edge in zip(joints, edges, strict=True)
    ]
    found.sort(key=lambda j: (j.b, j.a))
    findings = _remarks(links, ids, left)
    return FoundMachine(links.assembly.name, tuple(bodies), 0, tuple(found), 0, findings)


def _root(bodies: Sequence[str], links: _Links) -> str:
    """The largest body that is no joint's child, if there is one; else the largest."""
    declared = links.assembly.joints
    children = {links.group[j.bodies[1]] for j in declared if j.type in _MOVING and all(j.bodies)}
    heads = [n for n in dict.fromkeys(links.group.values()) if n in bodies and n not in children]
    return max(heads or bodies, key=links.surface)


def _outward(root: str, joints: Sequence[_Joint], links: _Links) -> list[str]:
    """The bodies from the root outward."""
    order = [root]
    pairs = [links.ends(j) for j in joints]
    for here in order:
        order += dict.fromkeys(
            other for a, b in pairs for one, other in ((a, b), (b, a)) if one == here and other not in order
        )
    return order


def _found_joint(
    joint: _Joint, order: Sequence[str], ids: Mapping[str, Sequence[str]], up: Floats, links: _Links, *, in_chain: bool
) -> FoundJoint:
    """A joint with its bodies' numbers in `order`; a slide's axis points from the first to the second."""
    a, b = sorted(order.index(body) for body in links.ends(joint))
    upright = joint.type == "revolute" and abs(float(np.dot(joint.axis, up))) > UPRIGHT
    axis = joint.axis
    if joint.type == "prismatic":
        ahead = _middle(links.assembly, ids[order[b]]) - _middle(links.assembly, ids[order[a]])
        axis = axis if float(ahead @ np.array(axis)) >= 0.0 else (-axis[0], -axis[1], -axis[2])
    return FoundJoint(
        joint.type, a, b, joint.point, axis, 0.0, joint.pins, joint.reason, in_chain, upright, joint.name
    )  # fmt: skip


def _remarks(links: _Links, ids: Mapping[str, Sequence[str]], left: Sequence[str]) -> tuple[Finding, ...]:
    """What of the file is not in the machine: joints (`left`) and parts."""
    assembly, findings = links.assembly, []
    if left:
        words = f"Nothing is drawn for a body of theirs: {some(left)}. These joints are left out."
        findings.append(Finding("ALN024", "info", assembly.name, words))
    unlinked = [p.name for p in assembly.parts if not any(p.id in parts for parts in ids.values())]
    if unlinked:
        words = f"Declared joints tie them to nothing: {some(unlinked)}. They are left out."
        findings.append(Finding("ALN025", "warning", assembly.name, words, "Give them a body in the alignment."))
    return tuple(findings)


def _reason(body: str, links: _Links) -> str:
    welded = links.drawn(body)
    return f"declared by the file: {' and '.join(f'{link!r}' for link in welded[:3])}" + (
        f" and {len(welded) - 3} more welded to it" if len(welded) > 3 else ""
    )


def _upright(joints: Sequence[_Joint]) -> Floats:
    """Across most of the hinges."""
    axes = np.array([j.axis for j in joints if j.type == "revolute"] or [(0.0, 1.0, 0.0)])
    pitch = axes[int(np.argmax((np.abs(axes @ axes.T) > PARALLEL_HINGES).sum(axis=1)))]
    return across(pitch)


def _middle(assembly: Assembly, ids: Sequence[str]) -> Floats:
    points = np.concatenate([assembly.points_of(assembly.part(i)) for i in ids])
    return np.asarray(0.5 * (points.min(axis=0) + points.max(axis=0)), dtype=np.float64)


def _kinds(
    links: _Links, order: Sequence[str], ids: Mapping[str, Sequence[str]], joints: Sequence[_Joint], up: Floats,
    geometry: FoundMachine | None,
) -> dict[str, str]:  # fmt: skip
    """What each body is: the halves of a cylinder hang on a hinge each, a wheel is round about its one joint."""
    on: dict[str, list[_Joint]] = {n: [j for j in joints if n in links.ends(j)] for n in order}
    hinged = {n: [j for j in js if j.type == "revolute"] for n, js in on.items()}
    shown = {p: b.kind for b in geometry.bodies for p in b.parts} if geometry is not None else {}
    kinds = dict.fromkeys(order, "")
    for n in order[1:]:
        swings = any(abs(float(np.dot(j.axis, up))) < UPRIGHT for j in hinged[n])
        kinds[n] = "arm" if swings else "frame" if hinged[n] else ""
        if len(on[n]) == 1 and hinged[n] and _round(links.assembly, ids[n], hinged[n][0]):
            kinds[n] = "wheel"
    kinds[order[0]] = "frame"
    for slide in (j for j in joints if j.type == "prismatic"):
        ends = sorted(links.ends(slide), key=order.index)
        if all(hinged[n] for n in ends):
            kinds |= dict(zip(ends, _halves([shown.get(p) for p in ids[ends[0]]]), strict=True))
    return kinds


def _halves(said: Sequence[str | None]) -> tuple[str, str]:
    """What the two bodies of a slide are, by what geometry says of the first one's parts: its barrel, if in doubt."""
    return ("rod", "barrel") if "rod" in said and "barrel" not in said else ("barrel", "rod")


def _round(assembly: Assembly, ids: Sequence[str], joint: _Joint) -> bool:
    """Whether a body is as wide and as high about a joint's axis, which runs through its middle."""
    axis = np.array(joint.axis)
    points = np.concatenate([assembly.points_of(assembly.part(i)) for i in ids]) - np.array(joint.point)
    u = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    u = u / np.linalg.norm(u)
    angles = np.linspace(0.0, np.pi, 8, endpoint=False)
    directions = np.cos(angles)[:, None] * u + np.sin(angles)[:, None] * np.cross(axis, u)
    low, high = (points @ directions.T).min(axis=0), (points @ directions.T).max(axis=0)
    radius = 0.5 * float((high - low).max())
    return bool(np.abs(high + low).max() < 2 * ROUND * radius and np.ptp(high - low) < 2 * ROUND * radius)


def discover_declared(assembly: Assembly) -> FoundMachine:
    """The bodies and joints of a CAD model as its file declares them, with those that geometry finds besides; where it
    declares none, as `discover` finds them, whose `AlignmentError` it raises."""
    try:
        geometry = discover(assembly)
    except AlignmentError:
        if (machine := robot(assembly, None)) is None:
            raise
        return machine
    return robot(assembly, geometry) or geometry
