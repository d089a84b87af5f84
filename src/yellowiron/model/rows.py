"""A template made concrete by what the CAD model shows: counted rows (`track_shoe_l[*]` and the joints along it), once
it shows how many there are, and what stands in for bodies that are not drawn.

The parts of a row are `track_shoe_l_1`, `track_shoe_l_2`, … in order along it, and so are its joints:
`…_joint[i]` becomes `…_joint_1`, `…_joint_2`, ….
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
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
    # A part of a row's part is drawn with it, or alone: a tyre, and of its wheel nothing else.
    for role in template.roles:
        if role.many and role.parent in sizes:
            sizes[role.parent] = max(sizes[role.parent], sizes[role.name])
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


def as_drawn(template: Template, present: Collection[str]) -> Template:
    """The template (its variants decided) for a machine of which these bodies are drawn: without absent axles
    (`without_absent_axles`), an absent hitch one with the frame behind it, an absent frame one with the frame that
    carries it, an absent slideway with what bears it, what an absent coupling holds on what it is held by
    (`without_absent_couplings`), and what would turn on one pin of an absent body turning on each other."""
    bare = without_absent_axles(_with_hitches_in_one(template, present), present)
    return across_absent(without_absent_couplings(_with_bearers_in_one(bare, present), present), present)


def _with_hitches_in_one(template: Template, present: Collection[str]) -> Template:
    """A hitch that is not drawn between two frames that are, on each of which it turns, is one with the second: the
    machine bends as it is steered, and does not roll. It keeps the hinge to the frame above it."""
    known = [j for j in template.joints if j.type == "revolute" and names_known(j, template)]
    hinges = [(j, pair) for j in known if len({*(pair := template.bodies_of(j))}) == 2]
    for role in [r for r in template.roles if r.rigid and r.name not in present and r.parent is not None]:
        above = template.body_of(str(role.parent))
        own = [(j, next(b for b in pair if b != role.name)) for j, pair in hinges if role.name in pair]
        frames = {str(b): j for j, b in own if b in present and template.role(str(b)).kind == "frame"}
        if len(frames) != 2 or above not in frames:
            continue
        (behind,) = set(frames) - {above}
        places = {behind: role.parent, role.name: behind}
        roles = tuple(
            replace(r, parent=places.get(r.name, r.parent), rigid=r.rigid and r.name != role.name)
            for r in template.roles
        )
        joints = tuple(j for j in template.joints if j.name != frames[behind].name)
        template = replace(template, roles=roles, joints=joints)
    return template


def names_known(joint: JointTemplate, template: Template) -> bool:
    """Whether the parts that a joint names are the template's."""
    return all(template.knows(part.partition("[")[0]) for part in joint.parts)


def _with_bearers_in_one(template: Template, present: Collection[str]) -> Template:
    """Frames that are not drawn, on one that is, are one with it: an articulated machine drawn in one piece. So are
    arms on which something slides that is drawn: a forklift's mast in its chassis."""
    slides = [j for j in template.joints if j.type == "prismatic" and j.follows is None]
    bearers = {
        str(a) for a, b in map(template.bodies_of, slides) if b in present and template.role(str(a)).kind == "arm"
    }
    absent = {
        r.name
        for r in template.roles
        if r.rigid and r.name not in present and r.parent is not None
        if (above := template.body_of(r.parent)) in present
        if r.name in bearers or r.kind == template.role(str(above)).kind == "frame"
    }
    if not absent:
        return template
    merged = replace(template, roles=tuple(replace(r, rigid=r.rigid and r.name not in absent) for r in template.roles))
    known = [j for j in template.joints if names_known(j, template)]
    gone = {j.name for j in known if len(set(merged.bodies_of(j))) == 1}
    return replace(merged, joints=tuple(j for j in template.joints if j.name not in gone))


def without_absent_couplings(template: Template, present: Collection[str]) -> Template:
    """The template (its variants decided) without the couplings that are not drawn (the yokes between a dozer's push
    arms and its blade; usually smaller than either body that they join), where what they carry hangs on nothing else
    that is drawn but hydraulic cylinders and struts. Where cylinders or struts are drawn between whatever couplings
    join, these hinge on each other on the couplings' first pins; otherwise they are welded."""
    roles = {r.name: r for r in template.roles}
    known = [j for j in template.joints if names_known(j, template)]
    ends = {j.name: tuple(map(str, template.bodies_of(j))) for j in known}
    at: dict[str, list[JointTemplate]] = {}
    for joint in known:
        for body in {*ends[joint.name]}:
            at.setdefault(body, []).append(joint)

    def beside(body: str) -> list[str]:
        return [b for j in at.get(body, []) if j.type != "prismatic" for b in ends[j.name] if b != body]

    rams = {name for name, role in roles.items() if role.kind in ("barrel", "rod")}
    struts = {b for b, own in at.items() if all(j.type == "spherical" for j in own) and len(own) == 2}
    idle = rams | {b for b in struts if not roles[b].kind}
    slides = [ends[j.name] for j in known if j.type == "prismatic" and {*ends[j.name]} <= rams & {*present}]
    across = [{*beside(a), *beside(b)} for a, b in slides] + [{*beside(b)} for b in idle & {*present} - rams]
    stands: dict[str, dict[str, str]] = {}
    partly: set[str] = set()
    for name, role in roles.items():
        held = {b for b in beside(name) if b not in idle}
        if role.kind or not role.rigid or name in {*present} | idle or len(held) != 2:
            continue
        if not held <= {*present}:
            partly |= held
            continue
        loose = [b for b in held if not any(o in present and o not in idle for o in beside(b))]
        usual = [template.usual[b].area if b in template.usual else 0.0 for b in (name, *held)]
        if len(loose) == 1 and usual[0] < min(usual[1:]):
            stands.setdefault(loose[0], {})[name] = next(b for b in held if b != loose[0])
    joints, places = list(template.joints), dict[str, str]()
    # Of arms of which one is not drawn nothing is told.
    for carried, bearers in ((body, own) for body, own in stands.items() if body not in partly):
        turns = all({bearer, carried} in across for bearer in bearers.values())
        joints = [j for j in joints if not bearers.keys() & {*ends.get(j.name, ())}]
        places |= bearers
        for name, bearer in bearers.items():
            first = next(j for j in at[name] if bearer in ends[j.name])
            pin = next(part for part in first.parts if part != name)
            joints.append(
                replace(first, name=f"{bearer}2{carried}_joint", parts=(carried, pin))
                if turns
                else JointTemplate(f"{bearer}2{carried}_joint", "fixed", (carried, bearer))
            )
    if not places:
        return template
    changed = (replace(r, parent=places[r.name], rigid=False) if r.name in places else r for r in template.roles)
    return replace(template, roles=tuple(changed), joints=tuple(joints))


def across_absent(template: Template, present: Collection[str]) -> Template:
    """Links that share a pin with a body that is not drawn (a bucket's links, on the eye of its cylinder's rod) hinge
    on each other, on the same pin."""
    roles, joints = list(template.roles), list(template.joints)
    for role in [r for r in template.roles if r.kind == "pin"]:
        on_it = [j for j in joints if j.type == "revolute" and role.name in j.parts]
        if len(on_it) != 2:
            continue
        first, second = (set(template.bodies_of(j)) for j in on_it)
        ends = sorted(str(b) for b in first ^ second)
        if len(first & second) != 1 or first & second & {*present} or not {*ends} <= {*present}:
            continue
        bearer, carried = sorted(ends, key=template.depth)
        (absent,) = (str(b) for b in first & second)
        # The absent body keeps one of its joints: it may tell what its cylinder would have moved.
        kept = next(j for j in on_it if bearer in template.bodies_of(j))
        across = JointTemplate(f"{bearer}2{carried}_joint", "revolute", (carried, role.name))
        roles = [replace(r, parent=bearer) if r.name == role.name else r for r in roles]
        joints = [replace(j, parts=(bearer, absent)) if j is kept else across if j in on_it else j for j in joints]
    if joints == list(template.joints):
        return template
    return replace(template, roles=tuple(roles), joints=tuple(joints))


def without_absent_axles(template: Template, present: Collection[str]) -> Template:
    """The template (its variants decided) without the axles that no part is drawn for: of the bodies that are not
    `present`, those that hold nothing but wheels on the body above them, alone or together (an axle with its knuckles,
    tie rods and steering cylinder). Their wheels, and what else moves with them, then move on that body. So does the
    one wheel of a knuckle that is not drawn between an axle and tie rods that are: these no longer reach it."""
    wheels = {r.name for r in template.roles if r.kind == "wheel"}
    known = [j for j in template.joints if names_known(j, template)]
    ends = {j.name: template.bodies_of(j) for j in known}
    beside: dict[str, set[str]] = {}
    for pair in ends.values():
        for body in pair:
            beside.setdefault(str(body), set()).update(str(b) for b in pair if b != body)
    above = {r.name: template.body_of(r.parent) for r in template.roles if r.rigid and r.parent is not None}
    open_ones = [b for b in above if b not in present and b != template.root and b not in wheels]
    absent: set[str] = set()
    for group in [{b} for b in open_ones] + _hanging_together(open_ones, beside):
        others = set().union(*(beside.get(b, set()) for b in group)) - group
        carriers = {above[b] for b in group} - group
        if len(carriers) == 1 and carriers <= others and others & wheels and others <= wheels | carriers:
            absent |= group
    knuckles = {b for b in open_ones if len(beside.get(b, set()) & wheels) == 1 and above[b] in present} - absent
    absent |= knuckles
    if not absent:
        return template
    merged = replace(template, roles=tuple(replace(r, rigid=r.rigid and r.name not in absent) for r in template.roles))
    gone = {j.name for j in known if absent & {*ends[j.name]} and len(set(merged.bodies_of(j))) == 1}
    gone |= {j.name for j in known if knuckles & {*ends[j.name]} and not wheels & {*ends[j.name]}}
    return replace(merged, joints=tuple(j for j in template.joints if j.name not in gone))


def _hanging_together(bodies: Sequence[str], beside: Mapping[str, Collection[str]]) -> list[set[str]]:
    """The groups of these bodies that are beside each other."""
    found, left = [], dict.fromkeys(bodies)
    while left:
        group = [next(iter(left))]
        for body in group:
            left.pop(body, None)
            group += [b for b in beside.get(body, ()) if b in left and b not in group]
        found.append(set(group))
    return found
