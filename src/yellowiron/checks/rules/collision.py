"""Collision: that bodies have shapes, and shapes that engines take."""

from __future__ import annotations

import numpy as np

from yellowiron.checks.islands import Island
from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.values import StageBody, StageCollider, extent, leaf
from yellowiron.checks.view import View

_TOKENS = (
    "none",
    "convexDecomposition",
    "convexHull",
    "boundingSphere",
    "boundingCube",
    "meshSimplification",
    "sdf",
    "sphereFill",
)
"""UsdPhysics' approximations, and the two that PhysX adds."""
_OVERLAP = 1e-3
_FAR = 0.5
"""Of a body's size: a collider as far from all that is drawn of it is misplaced."""


@rule(
    "CHK100",
    "warning",
    "Give it one, if anything shall touch it: without it everything falls through.",
)
def no_collider(view: View) -> Remarks:
    """A body has no collider, nor one that it is welded to; unless it is undrawn between two, or pads stand for it."""
    welds = [joint.bodies for joint in view.joints if joint.enabled and joint.type == "fixed"]
    solid = {path for path, body in view.bodies.items() if body.has_collider}
    solid |= {path for weld in welds if solid.intersection(weld) for path in weld}
    between = {joint.bodies[0] for joint in view.joints} & {joint.bodies[1] for joint in view.joints}
    padded = {c.body for c in view.colliders if c.body in view.bodies and _is_pad(c, view.bodies[c.body])}
    solid |= {
        path
        for joint in view.joints
        for path in joint.bodies
        if padded.intersection(joint.bodies) and path in view.bodies and view.bodies[path].drawn is None
    }
    for body in view.bodies.values():
        link = body.bounds is None and body.path in between
        if body.enabled and body.path not in solid and body.mass and not link:
            yield body.path, "No collider is at or under it."


def _is_pad(collider: StageCollider, body: StageBody) -> bool:
    """Whether a collider is one of those with which its body stands while the brakes are set, by the record."""
    return f'"{collider.path.rpartition("/")[2]}"' in str(body.record.get("pads", ""))


@rule(
    "CHK101",
    "warning",
    "Choose convexHull or convexDecomposition: PhysX takes an exact mesh on static bodies only.",
)
def exact_mesh(view: View) -> Remarks:
    """A moving mesh collides as it is."""
    for collider in view.colliders:
        body = view.bodies.get(collider.body)
        if body is None or body.kinematic or collider.shape != "Mesh":
            continue
        if collider.approximation in (None, "none"):
            said = "says 'none'" if collider.approximation else "is not given"
            yield collider.path, f"Its approximation {said}, on a body that moves."


@rule(
    "CHK102",
    "warning",
    "Use none, convexHull, convexDecomposition, boundingCube, boundingSphere or meshSimplification; PhysX also "
    "knows sdf and sphereFill.",
)
def unknown_token(view: View) -> Remarks:
    """A collision approximation is unknown."""
    for collider in view.colliders:
        if collider.approximation is not None and collider.approximation not in _TOKENS:
            yield collider.path, f"'{collider.approximation}' is no approximation."


@rule(
    "CHK103",
    "error",
    "Give it a size above 0, or points and faces; or remove it.",
)
def empty(view: View) -> Remarks:
    """A collider has no volume."""
    for collider in view.colliders:
        if collider.empty:
            yield collider.path, f"This {collider.shape or 'shape'} is empty."


@rule(
    "CHK104",
    "info",
    "Filter the pair (PhysicsFilteredPairsAPI), or switch the articulation's self-collision off.",
)
def overlapping(view: View) -> Remarks:
    """Bodies overlap and may collide."""
    for island in view.islands:
        if not island.roots or not all(view.self_collision.get(r, True) for r in island.roots):
            continue
        pairs = list(_overlaps(island))
        if pairs:
            names = [f"{leaf(a.path)}–{leaf(b.path)}" for a, b in pairs[:3]]
            yield (
                pairs[0][0].path,
                f"Boxes of {len(pairs)} unjointed pair(s) overlap in the drawn pose: {', '.join(names)}.",
            )


def _overlaps(island: Island) -> list[tuple[StageBody, StageBody]]:
    """Pairs of bodies, neither jointed nor filtered, whose collider boxes interpenetrate."""
    joined = {frozenset(j.bodies) for j in island.joints}
    solid = [b for b in island.bodies if b.solid is not None]
    found = []
    for index, first in enumerate(solid):
        for second in solid[index + 1 :]:
            if frozenset((first.path, second.path)) in joined:
                continue
            if second.path in first.filtered or first.path in second.filtered:
                continue
            a, b = first.solid, second.solid
            if a is not None and b is not None and (np.minimum(a[1], b[1]) - np.maximum(a[0], b[0])).min() > _OVERLAP:
                found.append((first, second))
    return found


@rule(
    "CHK105",
    "warning",
    "Take the ground's group out of its filteredGroups, or the ground's colliders out of that group.",
)
def groundless(view: View) -> Remarks:
    """A collision group meets nothing that stands still."""
    for group in view.groundless:
        yield group, "Bodies are in it, and it is filtered from every collider that belongs to none: they fall through."


@rule(
    "CHK106",
    "warning",
    "Correct the path, or remove it: the pair that was meant collides.",
)
def lost_filter(view: View) -> Remarks:
    """A filtered pair names nothing."""
    for path, target in view.lost_filters:
        yield path, f"Its filteredPairs name {target}, which is not there, or is deactivated."


@rule(
    "CHK107",
    "warning",
    "Put it where the body's geometry is: what is seen touches nothing, and what touches is not seen.",
)
def stray_collider(view: View) -> Remarks:
    """A collider is far from its body's geometry."""
    for collider in view.colliders:
        body = view.bodies.get(collider.body)
        if body is None or body.drawn is None or collider.bounds is None:
            continue
        gap = np.maximum(0.0, np.maximum(collider.bounds[0] - body.drawn[1], body.drawn[0] - collider.bounds[1]))
        distance, size = float(np.linalg.norm(gap)), extent(body.drawn)
        if distance > _FAR * size:
            yield collider.path, f"It is {distance:.3g} m from all that is drawn of a body {size:.3g} m across."
