"""Joint entries: the journal paper's Fig. A1, with the conference paper's JSON-4 as further keys."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

from yellowiron.library.notation.quantities import limit, quantity, yes
from yellowiron.library.notation.validated_json import Document, near
from yellowiron.library.parsing.variants import choices_of
from yellowiron.model.errors import TemplateError
from yellowiron.model.rows import split_index
from yellowiron.model.specification import fold, share_of
from yellowiron.model.template import AS_DRAWN, Direction, DriveType, Follows, JointTemplate, JointType, Role, Variant

DIMENSION: Mapping[str, str] = {
    "prismatic": "length",
    "distance": "length",
    "revolute": "angle",
    "spherical": "angle",
    "fixed": "length",
}
"""Joint type → the dimension of its limits."""
_GAINS = ("stiffness", "damping", "max_force", "max_velocity")
"""The keys of JSON-4, all in SI units."""
_DRIVABLE: Mapping[str, str] = {"linear": "prismatic", "angular": "revolute"}
_COUPLED = ("prismatic", "revolute")
"""Types of joints that can follow: those of one coordinate."""


def read_joints(document: Document) -> tuple[JointTemplate, ...]:
    """The joints of a `joints.json`, their parts still as written. `TemplateError` for limits or drives that do not fit
    the joint's type."""
    return tuple(
        replace(read_joint(document, name, entry, None), name=" ".join(name.split()))
        for name, entry in document.data.items()
    )


def read_joint(document: Document, name: str, entry: Mapping[str, Any], base: JointTemplate | None) -> JointTemplate:
    """One entry; what it does not state is taken from `base`."""
    if base is None:
        for key in ("joint_type", "Body"):
            if key not in entry:
                raise TemplateError(
                    f"'{key}' is missing",
                    where=document.at(name),
                    hint="Only a joint of the template may leave it out.",
                )
        base = JointTemplate(name=name, type="fixed", parts=("", ""))
    kind = cast(JointType, entry["joint_type"].lower()) if "joint_type" in entry else base.type
    lower, upper = _limits(document, name, entry["Limit"], kind) if "Limit" in entry else (base.lower, base.upper)
    body = entry.get("Body", base.parts)
    gains = {key: float(entry[key]) for key in _GAINS if key in entry}
    joint = replace(
        base,
        type=kind,
        parts=(body[0].strip(), body[1].strip()),
        lower=lower,
        upper=upper,
        drive=_drive(document, name, entry["Drive"], kind) if "Drive" in entry else base.drive,
        free=yes(entry["free"]) if "free" in entry else base.free,
        when=choices_of(entry, "when") if "when" in entry else base.when,
        drive_when=choices_of(entry, "drive_when") if "drive_when" in entry else base.drive_when,
        rest_when=choices_of(entry, "rest_when") if "rest_when" in entry else base.rest_when,
        ring=yes(entry["ring"]) if "ring" in entry else base.ring,
        follows=_follows(document, name, entry["follows"], kind) if "follows" in entry else base.follows,
        direction=cast(Direction, entry["direction"].lower()) if "direction" in entry else base.direction,
        positions=_positions(document, name, entry["positions"], kind) if "positions" in entry else base.positions,
        position_variant=entry.get("chosen_by", base.position_variant),
        rest=_rest(document, name, entry["rest"], kind) if "rest" in entry else base.rest,
    )
    if joint.positions and (joint.drive is not None or joint.follows is not None):
        raise TemplateError(
            f"Joint '{name}' is held in positions, and moves",
            where=document.at(name, "positions"),
            hint="Leave out its Drive, or what it follows: a pin holds it where it is.",
        )
    if joint.follows is not None and joint.drive is not None:
        raise TemplateError(
            f"Joint '{name}' follows '{joint.follows.joint}' and has a drive of its own",
            where=document.at(name, "follows" if "follows" in entry else "Drive"),
            hint="Drive the leader: what follows takes its motion from there.",
        )
    if joint.ring and [split_index(part)[1] for part in joint.parts] != ["i", "i+1"]:
        raise TemplateError(
            f"Joint '{name}' closes a ring, but does not run along a row",
            where=document.at(name, "Body"),
            hint="Its Body is [name[i], name[i+1]].",
        )
    joint = replace(
        joint,
        stiffness=gains.get("stiffness", base.stiffness),
        damping=gains.get("damping", base.damping),
        max_force=gains.get("max_force", base.max_force),
        max_velocity=gains.get("max_velocity", base.max_velocity),
    )
    return _sprung(document, joint) if joint.rest is not None else joint


def _rest(document: Document, name: str, value: Any, kind: str) -> float | str:
    """Where a spring pushes nothing, SI, or `AS_DRAWN`."""
    place = document.at(name, "rest")
    if kind not in _COUPLED:
        raise TemplateError(
            f"Joint '{name}' is {kind} and has no spring",
            where=place,
            hint="A slide or a pivot has one: rest goes with Prismatic and Revolute.",
        )
    drawn = isinstance(value, str) and fold(value) == AS_DRAWN
    return AS_DRAWN if drawn else quantity(value, DIMENSION[kind], where=place)


def _sprung(document: Document, joint: JointTemplate) -> JointTemplate:
    """A joint with a spring moves on its own. `TemplateError` where something else moves or holds it, or nothing says
    how stiff it is."""
    for what, other in (("Drive", joint.drive), ("follows", joint.follows), ("positions", joint.positions)):
        if other:
            raise TemplateError(
                f"Joint '{joint.name}' has a spring and {what}",
                where=document.at(joint.name, "rest"),
                hint=f"Leave out {what}, or rest: a spring is on a joint that moves on its own.",
            )
    if joint.ring or any(split_index(part)[1] for part in joint.parts):
        raise TemplateError(
            f"Joint '{joint.name}' has a spring and is a row of joints",
            where=document.at(joint.name, "rest"),
            hint="A joint that is there once may have one.",
        )
    if not joint.stiffness and not joint.damping:
        raise TemplateError(
            f"Joint '{joint.name}' has a rest, and neither stiffness nor damping",
            where=document.at(joint.name, "rest"),
            hint="State its stiffness, N/m or N*m/rad, and its damping.",
        )
    return replace(joint, free=True)


def _positions(document: Document, name: str, entry: Mapping[str, Any], kind: str) -> dict[str, float | str]:
    """Name → where a joint may be held, SI, or what share of which specification."""
    if kind not in _COUPLED:
        raise TemplateError(
            f"Joint '{name}' is {kind} and has positions",
            where=document.at(name, "positions"),
            hint="A slide or a pivot has some.",
        )
    if AS_DRAWN in entry:
        raise TemplateError(
            f"'{AS_DRAWN}' is the position that the CAD model shows",
            where=document.at(name, "positions", AS_DRAWN),
            hint="Name the others only.",
        )
    places = {each: document.at(name, "positions", each) for each in entry}
    return {
        each: str(value) if share_of(value) is not None else quantity(value, DIMENSION[kind], where=places[each])
        for each, value in entry.items()
    }


def positions_chosen(joints: Sequence[JointTemplate]) -> tuple[Variant, ...]:
    """The variants by which a person says in which of its positions a joint is held. Joints that are there under
    different choices may share one."""
    held: dict[str, dict[str, None]] = {}
    for joint in joints:
        if joint.positions:
            held.setdefault(joint.chosen_by, {AS_DRAWN: None}).update(dict.fromkeys(joint.positions))
    return tuple(Variant(name, tuple(places), AS_DRAWN) for name, places in held.items())


def resolve_leaders(joints: Sequence[JointTemplate], at: Callable[..., str]) -> tuple[JointTemplate, ...]:
    """The joints with their leaders spelled as the joints are. `at` gives a place by its keys. `TemplateError` for a
    leader that is not there, is of another type or a joint along a row, and for joints that lead each other in a
    circle."""
    by_name = {fold(j.name): j for j in joints}
    resolved = []
    for joint in joints:
        if joint.follows is not None:
            place = at(joint.name, "follows", "joint")
            leader = _leader(joint, joint.follows.joint, by_name, place)
            joint = replace(joint, follows=replace(joint.follows, joint=leader.name))
        resolved.append(joint)
    leads = {j.name: j.follows.joint for j in resolved if j.follows is not None}
    for name in leads:
        way = [name]
        while way[-1] in leads and leads[way[-1]] not in way:
            way.append(leads[way[-1]])
        if leads.get(way[-1]) == name:
            raise TemplateError(
                f"Joint '{name}' follows itself" + (f", by way of {', '.join(way[1:])}" if way[1:] else ""),
                where=at(name, "follows", "joint"),
                hint="One of them leads: give that one a drive instead.",
            )
    return tuple(resolved)


def _leader(joint: JointTemplate, name: str, joints: Mapping[str, JointTemplate], place: str) -> JointTemplate:
    leader = joints.get(fold(name))
    if leader is None:
        raise TemplateError(
            f"Joint '{joint.name}' follows a joint '{name}' that is not there",
            where=place,
            hint=near(name, (j.name for j in joints.values())) or "Name a joint of joints.json.",
        )
    if leader.type != joint.type:
        raise TemplateError(
            f"Joint '{joint.name}' is {joint.type} and follows '{leader.name}', which is {leader.type}",
            where=place,
            hint="Leader and follower are of one type: slides follow slides, pivots follow pivots.",
        )
    if any(split_index(part)[1] for part in leader.parts):
        raise TemplateError(
            f"Joint '{joint.name}' follows '{leader.name}', which is a row of joints",
            where=place,
            hint="Name a joint that is there once.",
        )
    return leader


def stated_gains(joint: JointTemplate) -> Iterator[tuple[str, float]]:
    """The gains that a joint entry states, SI."""
    for key in _GAINS:
        value = getattr(joint, key)
        if value is not None:
            yield key, value


def resolve_parts(joint: JointTemplate, roles: Mapping[str, Role], where: str) -> JointTemplate:
    """The joint with its parts spelled as in the hierarchy (`roles`: by folded name). `TemplateError` for a part that
    is not there."""
    parts = []
    for part in joint.parts:
        name, index = split_index(part)
        role = roles.get(fold(name))
        if role is None:
            raise TemplateError(
                f"Joint '{joint.name}' names a part '{part}' that the hierarchy does not have",
                where=where,
                hint=near(name, (r.name for r in roles.values())) or "Add it to hierarchy.json.",
            )
        if bool(index) != role.many:
            raise TemplateError(
                f"Part '{part}' of joint '{joint.name}' "
                + ("has an index, but is one part" if index else "is a row of parts and needs an index"),
                where=where,
                hint="A row is written name[*] in the hierarchy, and name[i], name[i+1] in joints.",
            )
        parts.append(f"{role.name}[{index}]" if index else role.name)
    return replace(joint, parts=(parts[0], parts[1]))


def check_bodies(joint: JointTemplate, bodies: tuple[str | None, str | None], where: str) -> None:
    """`TemplateError` unless a joint joins two different bodies."""
    for part, body in zip(joint.parts, bodies, strict=True):
        if body is None:
            raise TemplateError(
                f"Part '{part}' of joint '{joint.name}' moves with no body",
                where=where,
                hint='Mark it or one of its parents "rigid body": "Y".',
            )
    row = [split_index(part)[1] for part in joint.parts]
    if bodies[0] == bodies[1] and row[0] == row[1]:
        raise TemplateError(
            f"Joint '{joint.name}' joins '{bodies[0]}' with itself",
            where=where,
            hint=f"'{joint.parts[0]}' and '{joint.parts[1]}' move together; name a part of the other body.",
        )


def _limits(
    document: Document, name: str, value: list[Any], kind: str
) -> tuple[float | str | None, float | str | None]:
    place = document.at(name, "Limit")
    lower, upper = (limit(v, DIMENSION[kind], where=place) for v in value)
    if isinstance(lower, float) and isinstance(upper, float) and lower >= upper:
        raise TemplateError(
            f"The lower limit of joint '{name}' is not below its upper limit",
            where=place,
            hint="Limit is [lower, upper]; a joint that cannot move is Fixed.",
        )
    if kind == "fixed" and (lower is not None or upper is not None):
        raise TemplateError(f"The fixed joint '{name}' has limits", where=place, hint="Remove Limit.")
    return lower, upper


def _follows(document: Document, name: str, entry: Mapping[str, Any], kind: str) -> Follows:
    if kind not in _COUPLED:
        raise TemplateError(
            f"Joint '{name}' is {kind} and cannot follow another",
            where=document.at(name, "follows"),
            hint="Slides and pivots can: they have one coordinate.",
        )
    ratio = float(entry.get("ratio", 1.0))
    if ratio == 0.0:
        raise TemplateError(
            f"Joint '{name}' follows with a ratio of 0, which holds it still",
            where=document.at(name, "follows", "ratio"),
            hint="Make it a Fixed joint, or give the ratio.",
        )
    offset = quantity(entry.get("offset", 0.0), DIMENSION[kind], where=document.at(name, "follows", "offset"))
    return Follows(" ".join(entry["joint"].split()), ratio, offset, entry.get("kind", "chain"))


def _drive(document: Document, name: str, value: Any, kind: str) -> DriveType | None:
    word = (value[0] if value else None) if isinstance(value, list) else value
    if not word:
        return None
    drive: DriveType = "linear" if word.lower().startswith("linear") else "angular"
    if _DRIVABLE[drive] != kind:
        raise TemplateError(
            f"Joint '{name}' is {kind} and cannot have a drive that is {drive}",
            where=document.at(name, "Drive"),
            hint="Linear Drive goes with Prismatic, Angular Drive with Revolute.",
        )
    return drive
