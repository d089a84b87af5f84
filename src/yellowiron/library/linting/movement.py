"""Findings on how a template moves: bodies out of reach, groups of loops that are locked, loose or driven twice."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from yellowiron.library.linting.mobility import Group
from yellowiron.model.finding import Finding
from yellowiron.model.rows import rings, split_index
from yellowiron.model.template import Template
from yellowiron.support.text import with_article


def connections(template: Template) -> Iterator[Finding]:
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


def movement(template: Template, group: Group) -> Iterator[Finding]:
    """A group of loops moves as its drives want it to: neither locked nor loose, nor one part driven twice. Links of a
    spatial one that spin idly, and what holds there what others hold already, are said."""
    name = _name_of(template, group)
    yield from _spatial(template, group, name)
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
    kind = "spatial" if group.spatial else "planar"
    figures = f"{kind} mobility {group.grubler}, {group.expected} expected"
    if group.computed < group.expected:
        pivots = _missing_pivots(template, group.joints)
        message = f"The {name} is locked ({figures})"
        if pivots:
            listed = " and ".join(f"from '{frame}' to '{part}'" for frame, part in pivots)
            message += f": there is no pivot {listed}, and a part without a joint to its frame is welded to it"
            hint = "Add " + ", ".join(f"{frame}2{part}_joint" for frame, part in pivots) + ": Revolute."
        elif group.halves:
            listed = ", ".join(f"'{left[:-2]}' for '{left}' and '{right}'" for left, right in group.halves)
            message += ": left and right halves that move as one are held twice"
            hint = f"Say that they are one body, without a side, in however many pieces it is drawn: {listed}."
        else:
            hint = _freeing(group) or "A pivot is missing, or a joint is there twice: " + ", ".join(group.joints) + "."
        yield Finding("TPL002", "error", template.root, f"{message}.", hint)
    else:
        yield Finding(
            "TPL003",
            "error",
            template.root,
            f"The {name} is loose ({figures}, {group.computed} by rank).",
            'A joint or a drive is missing, or "free" is, among: ' + ", ".join(group.joints) + ".",
        )


def _spatial(template: Template, group: Group, name: str) -> Iterator[Finding]:
    if group.idle:
        links = ", ".join(" with ".join(link.bodies) for link in group.idle)
        yield Finding(
            "TPL022",
            "info",
            template.root,
            f"Between balls at both ends these links of the {name} can spin about their own line, which moves nothing "
            f"else and is not counted: {links}.",
        )
    if group.superfluous and group.computed == group.expected:
        instead = "; ".join(
            f"{joint} ({'none' if not kind else with_article(kind)} would do)"
            for joint, kind in group.superfluous.items()
        )
        yield Finding(
            "TPL023",
            "info",
            template.root,
            f"The {name} is held {group.computed - group.grubler} times more than it needs: it moves only where its "
            f"joints are exactly in line.",
            f"One of these may be freer: {instead}.",
        )


def _freeing(group: Group) -> str:
    """What would let a locked spatial group move; "" where no change of one or two joints does."""
    if not group.unlocking:
        return ""
    ways = [" and ".join(f"{joint} {kind.capitalize()}" for joint, kind in way.items()) for way in group.unlocking[:6]]
    more = len(group.unlocking) - len(ways)
    return f"It moves with {', or with '.join(ways)}{f' ({more} more ways)' if more else ''}."


def _name_of(template: Template, group: Group) -> str:
    """The actuators that drive a group; where their names come from joints, the words those have in common."""
    members = set(group.joints)
    names = [a.name for a in template.actuators if members & {*a.joints, *(c.slide for c in a.cylinders)}]
    short = [n.partition("_cylinder")[0] if "2" in n else n for n in names]
    return " and ".join(dict.fromkeys(short)) or f"loop of {group.joints[0]}"


def loose_joints(template: Template, joints: Sequence[str]) -> Iterator[Finding]:
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
