"""`joints.json` of a machine that was found: names and entries of its joints."""

from __future__ import annotations

from yellowiron.library.proposal.actuators import QUANTITIES
from yellowiron.library.proposal.draft import Draft, Json
from yellowiron.library.proposal.hierarchy import pin_of
from yellowiron.library.proposal.naming import snake_case, title
from yellowiron.model.found import FoundJoint


def joint_name(draft: Draft, joint: FoundJoint) -> str:
    """A name that no joint has yet: the other type's, the file's, or `a2b_joint`."""
    a, b = draft.names[joint.a], draft.names[joint.b]
    between = "_2_" if a[-1].isdigit() else "2"
    name = draft.like.joint(a, b, joint.type) or snake_case(joint.name) or f"{a}{between}{b}_joint"
    while name in draft.joint_names:
        name = name.removesuffix("_joint") + "_other_joint"
    return name


def entry_of(draft: Draft, k: int, joint: FoundJoint) -> Json:
    """The entry of the joint with index k; the actuators are there already."""
    a, b = draft.names[joint.a], draft.names[joint.b]
    name = draft.joint_names[k]
    kind = {"revolute": "Revolute", "prismatic": "Prismatic", "fixed": "Fixed"}[joint.type]
    entry: Json = {"joint_type": kind, "Body": [a, b]}
    pin = pin_of(draft, joint) if joint.type == "revolute" else None
    if pin is not None:
        entry["Body"] = [b if draft.pins[pin][0] == joint.a else a, pin]
    known = draft.like.joint_entry(name)
    if known is not None:
        entry |= known
        for limit in known.get("Limit", ()):
            if isinstance(limit, str) and (wanted := limit.lstrip("-").strip()) in draft.like.wanted:
                draft.want(wanted, "", "")
    elif joint.type == "prismatic":
        entry |= _slide(draft, k)
    elif joint.type == "revolute" and not joint.loop:
        entry |= _free(draft, joint)
    declared = any(body.name for body in draft.machine.bodies)
    return entry | {"source": joint.reason if declared else f"found by: {joint.reason}"}


def _slide(draft: Draft, k: int) -> Json:
    name = draft.joint_names[k]
    for actuator, entry in draft.actuators.items():
        if any(c["slide"] == name for c in entry.get("cylinders", ())):
            stroke = entry["specifications"].get("stroke", f"{title(actuator)} Stroke")
            return {"Limit": ["0", draft.want(stroke, "length", QUANTITIES["stroke"][2])], "Drive": ["Linear Drive"]}
    moved = title(draft.names[draft.machine.joints[k].b])
    back = draft.want(f"{moved} Travel In", "length", "how far it goes in from the drawn pose")
    out = draft.want(f"{moved} Travel Out", "length", "how far it goes out from the drawn pose")
    # In a closed chain it is the cylinder that moves it.
    return {"Limit": [f"-{back}", out]} | ({} if draft.machine.joints[k].loop else {"Drive": ["Linear Drive"]})


def _free(draft: Draft, joint: FoundJoint) -> Json:
    """A hinge of no closed chain: a wheel's, a slewing bearing's, an axle's, or one without its cylinder."""
    machine = draft.machine
    if "wheel" in (machine.bodies[joint.a].kind, machine.bodies[joint.b].kind):
        return {"Drive": ["Angular Drive"], "free": "Y"}
    if joint.upright:
        return {"Drive": ["Angular Drive"]}
    moved = title(draft.names[joint.b])
    low = draft.want(f"{moved} Angle Down", "angle", "how far it turns one way from the drawn pose")
    high = draft.want(f"{moved} Angle Up", "angle", "how far it turns the other way from the drawn pose")
    limits: Json = {"Limit": [f"-{low}", high]}
    carries = {
        c for j in machine.joints for c in (j.a, j.b) if "wheel" in (machine.bodies[j.a].kind, machine.bodies[j.b].kind)
    }
    return limits | ({"free": "Y"} if joint.b in carries else {"Drive": ["Angular Drive"]})
