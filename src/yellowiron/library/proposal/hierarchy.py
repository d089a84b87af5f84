"""`hierarchy.json` of a machine that was found: bodies under those they hang on, their pins, rows of tracks."""

from __future__ import annotations

from yellowiron.library.proposal.draft import Draft, Json, other_body
from yellowiron.model.found import FoundJoint, FoundMachine

_ROWS = (
    ("sprocket", "sprocket", ""), ("idler", "idler", ""), ("track_roller", "roller", "[*]"),
    ("carrier_roller", "carrier", "[*]"), ("track_shoe", "shoe", "[*]"),
)  # fmt: skip
"""Parts of a track that move with the root until the template says more (docs/tracks.md)."""


def hierarchy(draft: Draft, root: int) -> Json:
    """The entries of all bodies, nested outward from the root."""
    parents = _parents(draft.machine)
    rows = {f"{n}_{s}{many}": kind for n, kind, many in _ROWS for s in "lr"} if draft.machine.tracks == 2 else {}

    def entry(k: int) -> Json:
        body = draft.machine.bodies[k]
        child: Json = {pin: {"rigid body": "N", "kind": "pin"} for pin, (host, _) in draft.pins.items() if host == k}
        if k == root:
            child |= {row: {"rigid body": "N", "kind": kind} for row, kind in rows.items()}
        child |= {draft.names[c]: entry(c) for c in sorted(parents) if parents[c] == k}
        kind = draft.like.kind(draft.names[k]) or body.kind
        return {"rigid body": "Y"} | ({"kind": kind} if kind else {}) | ({"child": child} if child else {})

    return {draft.names[root]: entry(root)}


def _parents(machine: FoundMachine) -> dict[int, int]:
    """Body → the one it hangs on: the first joint that leads to it, outward from the root, slides last."""
    parent: dict[int, int] = {}
    reached = {machine.root}
    joints = sorted(machine.joints, key=lambda j: j.type == "prismatic")
    while True:
        ahead = next((j for j in joints if (j.a in reached) != (j.b in reached)), None)
        if ahead is None:
            return parent
        near, far = (ahead.a, ahead.b) if ahead.a in reached else (ahead.b, ahead.a)
        parent[far] = near
        reached.add(far)


def add_pins(draft: Draft) -> None:
    """A role for the parts of every pin, carried by the body that all joints on it have in common."""
    for joint in draft.machine.joints:
        same = [j for j in draft.machine.joints if j.pins == joint.pins]
        if not joint.pins or same[0] is not joint:
            continue
        common = set.intersection(*({j.a, j.b} for j in same)) or {joint.a}
        # Where the file says which body has the pin, that carries it.
        host = min(common, key=lambda k: (not set(joint.pins) <= set(draft.machine.bodies[k].parts), k))
        role = draft.like.pin(joint.pins)
        if role is None or role in draft.pins or role in draft.names:
            role = f"{draft.names[other_body(joint, host) if host in (joint.a, joint.b) else joint.b]}_pin"
        stem, number = role, 2
        while role in draft.pins or role in draft.names:
            role, number = f"{stem}_{number}", number + 1
        draft.pins[role] = (host, joint.pins)


def pin_of(draft: Draft, joint: FoundJoint) -> str | None:
    """The role of a joint's pin, if one of its bodies carries it."""
    found = (r for r, (host, ids) in draft.pins.items() if ids == joint.pins and host in (joint.a, joint.b))
    return next(found, None)
