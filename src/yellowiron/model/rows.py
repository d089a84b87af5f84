"""Counted rows: `track_shoe_l[*]` and the joints along it, made concrete once the CAD model shows how many there are.

The parts of a row are `track_shoe_l_1`, `track_shoe_l_2`, … in order along it, and so are its joints:
`…_joint[i]` becomes `…_joint_1`, `…_joint_2`, ….
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace

from yellowiron.model.template import JointTemplate, Role, Template

_INDEX = re.compile(r"^(.*?)\s*\[\s*(\*|i(?:\s*[+-]\s*\d+)?)\s*\]$")


def split_index(part: str) -> tuple[str, str]:
    """`track_shoe_l[i+1]` → (`track_shoe_l`, `i+1`); the index is empty for a single part."""
    match = _INDEX.match(part)
    return (match.group(1), match.group(2).replace(" ", "")) if match else (part, "")


def member(row: str, number: int) -> str:
    """The name of a row's part, the first being number 1."""
    return f"{row}_{number}"


def rings(template: Template) -> tuple[str, ...]:
    """The rows that a joint closes to a ring."""
    return tuple(dict.fromkeys(split_index(j.parts[0])[0] for j in template.joints if j.ring))


def count_members(roles: Iterable[str | None], template: Template) -> dict[str, int]:
    """Row → how many parts it has, from the roles that parts play: the highest number that occurs."""
    counts: dict[str, int] = {}
    for name in {r for r in roles if r is not None}:
        row = template.row_of(name)
        if row is not None:
            counts[row] = max(counts.get(row, 0), int(name.rpartition("_")[2]))
    return dict(sorted(counts.items()))


def expand(template: Template, counts: Mapping[str, int]) -> Template:
    """The template with concrete parts and joints in the place of its rows; its variants are decided (`choose`).

    `counts`: row → number of parts; a row without one has none, and its joints go with it. Rows of hidden bodies have
    as many as their rule says. A joint along a row (`[i]`, `[i+1]`) joins each part with the next, in a ring also the
    last with the first.
    """
    sizes = {r.name: int(counts.get(r.name, 0)) for r in template.roles if r.many}
    sizes |= {r.name: len(r.hidden["at"]) for r in template.roles if r.many and r.hidden}
    if not sizes:
        return template
    roles: list[Role] = []
    for role in template.roles:
        if not role.many:
            roles.append(role)
            continue
        for number in range(1, sizes[role.name] + 1):
            under_row = role.parent is not None and role.parent in sizes
            parent = member(str(role.parent), number) if under_row else role.parent
            roles.append(replace(role, name=member(role.name, number), parent=parent, many=False, row=role.name))
    along = {j.name: _along(j, sizes) for j in template.joints}
    actuators = tuple(
        replace(a, joints=tuple(joint.name for name in a.joints for joint in along.get(name, ())))
        for a in template.actuators
    )
    return replace(
        template,
        roles=tuple(roles),
        joints=tuple(joint for joints in along.values() for joint in joints),
        actuators=tuple(a for a in actuators if a.joints or a.cylinders),
    )


def _along(joint: JointTemplate, sizes: Mapping[str, int]) -> tuple[JointTemplate, ...]:
    """A joint of single parts as it is; one along a row once for each of its parts."""
    ends = [split_index(part) for part in joint.parts]
    rows = [row for row, index in ends if index]
    if not rows:
        return (joint,)
    count = min(sizes.get(row, 0) for row in rows)
    name = split_index(joint.name)[0]
    made = []
    for number in range(1, count + 1):
        parts = []
        for row, index in ends:
            place = number + int(index[1:] or "0") if index else 0
            if index and joint.ring:
                place = (place - 1) % count + 1
            parts.append((row, place if index else None))
        if all(place is None or 1 <= place <= count for _, place in parts):
            first, second = (row if place is None else member(row, place) for row, place in parts)
            made.append(replace(joint, name=f"{name}_{number}", parts=(first, second)))
    return tuple(made)
