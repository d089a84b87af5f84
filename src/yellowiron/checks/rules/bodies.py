"""Rigid bodies: nesting, scale, and bodies that are not part of the machine."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from yellowiron.checks.islands import Island
from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.values import leaf
from yellowiron.checks.view import View

_UNIFORM = 1e-4


@rule(
    "CHK020",
    "warning",
    "Put bodies beside each other: engines older than OpenUSD 25.11 move a nested body twice or drop it.",
)
def nested(view: View) -> Remarks:
    """Rigid bodies are nested."""
    for body in view.bodies.values():
        if body.parent_body:
            yield body.path, f"It is a rigid body inside the rigid body {body.parent_body}."


@rule(
    "CHK021",
    "warning",
    "Scale its geometry, not the body: joint frames and colliders are stretched with it.",
)
def stretched(view: View) -> Remarks:
    """A jointed body is scaled differently along its axes."""
    for island in view.islands:
        for body in island.bodies:
            scale = body.scale
            if np.isfinite(scale).all() and scale.max() - scale.min() > _UNIFORM * scale.max():
                yield body.path, f"Its scale is ({scale[0]:.4g}, {scale[1]:.4g}, {scale[2]:.4g})."


@rule(
    "CHK022",
    "error",
    "A rigid body's frame can only turn and move: mirror the mesh instead.",
)
def mirrored(view: View) -> Remarks:
    """A body is mirrored or sheared."""
    for body in view.bodies.values():
        if body.mirrored or body.sheared:
            yield body.path, f"Its transform {'mirrors' if body.mirrored else 'shears'}."


@rule(
    "CHK023",
    "warning",
    "PhysX has no kinematic articulation links: fix the base with a joint to the world instead.",
)
def kinematic(view: View) -> Remarks:
    """An articulation has a kinematic body."""
    for island in view.islands:
        if island.roots:
            for body in island.bodies:
                if body.kinematic:
                    yield body.path, "It is kinematic and part of an articulation."


@rule(
    "CHK024",
    "warning",
    "Its joints hold to the world instead: switch it on, or deactivate the body and its joints.",
)
def disabled(view: View) -> Remarks:
    """A body is switched off."""
    for body in view.bodies.values():
        if not body.enabled:
            yield body.path, "rigidBodyEnabled is false."


@rule(
    "CHK025",
    "warning",
    "Joint it to the machine, or take it out of the machine's prim: it falls off.",
)
def loose(view: View) -> Remarks:
    """A body of a machine is held by no joint."""
    held = {b.path for i in view.islands for b in i.bodies}
    for root in map(view.scope, view.roots):
        groups = [i for i in _inside(root, view.islands) if not i.floating]
        if not groups:
            continue
        largest = max(groups, key=lambda i: len(i.bodies))
        for island in groups:
            if island is not largest:
                names = ", ".join(leaf(b.path) for b in island.bodies[:4])
                yield island.bodies[0].path, f"{names}: no joint holds these to the rest of {root}."
        for body in view.bodies.values():
            if body.enabled and body.path not in held and body.path.startswith(f"{root}/"):
                yield body.path, f"No joint holds it to the rest of {root}."


def _inside(root: str, islands: Iterable[Island]) -> list[Island]:
    """The islands with a body at or under a prim."""
    return [i for i in islands if any(b.path == root or b.path.startswith(f"{root}/") for b in i.bodies)]


@rule(
    "CHK026",
    "warning",
    "Apply PhysicsRigidBodyAPI to its link: it stays where it is while the machine moves.",
)
def stranded_collider(view: View) -> Remarks:
    """A collider inside a machine belongs to no body."""
    links = {b.path.rsplit("/", 1)[0] for i in view.islands for b in i.bodies if len(i.bodies) > 1}
    said = set()
    off = [b.path for b in view.bodies.values() if not b.enabled]
    for collider in view.colliders:
        if collider.body or any(collider.path.startswith(b) for b in off):
            continue
        root = view.under_root(collider.path)
        parts = collider.path.split("/")
        link = next(("/".join(parts[: n + 1]) for n in range(len(parts)) if "/".join(parts[:n]) in links), "")
        if root and link and link.startswith(f"{root}/") and link not in said:
            said.add(link)
            yield link, f"Its collider {leaf(collider.path)} has no rigid body above it."


@rule(
    "CHK027",
    "info",
    "Check the machine's file, not its geometry; with variants, choose the one that has physics.",
)
def no_physics(view: View) -> Remarks:
    """There is no physics."""
    if not view.bodies and not view.broken:
        yield view.name, "The file has no rigid body."


@rule(
    "CHK028",
    "warning",
    "Set physxRigidBody:disableGravity to false, or mjc:gravcomp to 0: what it weighs is missing on every drive below.",
)
def weightless(view: View) -> Remarks:
    """Gravity is off on a body of a machine."""
    for island in view.islands:
        off = [b for b in island.bodies if b.weightless]
        if off and len(off) == len(island.bodies):
            yield island.where, "It is off on all of its bodies."
        else:
            yield from ((b.path, "It is off here, and on for others of the machine.") for b in off)
