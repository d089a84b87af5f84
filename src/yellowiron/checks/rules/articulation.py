"""The articulation: one root, a tree, and one cut in every loop."""

from __future__ import annotations

from yellowiron.checks.islands import Island, reversed_joints, root_body
from yellowiron.checks.loops import KINDS
from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.values import WORLD, leaf
from yellowiron.checks.view import View


@rule(
    "CHK080",
    "warning",
    "Apply PhysicsArticulationRootAPI to the machine's prim: without it every joint is a soft constraint.",
)
def no_root(view: View) -> Remarks:
    """A machine has no articulation root."""
    for island in view.islands:
        moving = [j for j in island.joints if j.type in ("revolute", "prismatic", "spherical") and not j.cut]
        if not island.roots and len(island.bodies) > 1 and moving:
            yield island.where, f"{len(island.bodies)} jointed bodies, and no articulation root at or above them."


@rule(
    "CHK081",
    "error",
    "Leave PhysicsArticulationRootAPI on one prim of the machine.",
)
def several_roots(view: View) -> Remarks:
    """An articulation has several roots."""
    for island in view.islands:
        for tree in island.trees:
            held = {j.path for j in island.joints if set(tree).intersection(j.bodies)}
            roots = [r for r in island.roots if r in held or any(b == r or b.startswith(f"{r}/") for b in tree)]
            for root in roots[1:]:
                yield root, f"{roots[0]} is a root of the same articulation."


@rule(
    "CHK082",
    "error",
    "Set excludeFromArticulation on one joint of the loop: on a structural pin, not on a slide or a driven joint.",
)
def uncut_loop(view: View) -> Remarks:
    """A loop is not cut."""
    for island in view.islands:
        if not island.roots:
            continue
        for loop in island.uncut:
            names = ", ".join(j.name for j in loop.joints)
            yield loop.closing.path, f"The joints {names} make a loop, and none of them is cut."


@rule(
    "CHK083",
    "error",
    "Cut one joint of a loop and no more: what only cut joints hold is an articulation of its own, or none.",
)
def cut_in_two(view: View) -> Remarks:
    """A machine is cut in two."""
    for island in view.islands:
        for part in _severed(island):
            cut = next(j for j in island.joints if j.cut and set(part).intersection(j.bodies))
            names = ", ".join(leaf(b) for b in part[:4])
            yield cut.path, f"Only cut joints hold {names}{' …' if len(part) > 4 else ''}."


def _severed(island: Island) -> list[tuple[str, ...]]:
    """Trees besides the largest one that have no root of their own, where cuts made them."""
    if not island.roots or len(island.trees) < 2:
        return []
    largest = max(island.trees, key=len)
    held = [j for j in island.joints if j.cut]
    return [
        tree
        for tree in island.trees
        if tree is not largest
        and not any(b in island.roots for b in tree)
        and any(set(tree).intersection(j.bodies) for j in held)
        and not any(WORLD in j.bodies and set(tree).intersection(j.bodies) for j in island.joints if not j.cut)
    ]


@rule(
    "CHK084",
    "warning",
    "Cut a pin of the loop: Newton drops a cut slide, and PhysX cannot drive it.",
)
def cut_slide(view: View) -> Remarks:
    """A slide is cut."""
    for joint in view.joints:
        if joint.cut and joint.type == "prismatic":
            yield joint.path, "It has excludeFromArticulation."


@rule(
    "CHK085",
    "warning",
    "Exchange body0 and body1 with their frames, and negate limits: Newton refuses a joint whose body0 is the child.",
)
def reversed_joint(view: View) -> Remarks:
    """A tree joint is reversed."""
    root = view.record.get("root")
    recorded = next((p for p, b in view.bodies.items() if root and b.record.get("name") == root), "")
    for island in view.islands:
        if not island.roots or len(island.roots) > len(island.trees) or island.uncut:
            continue
        joints = [j for j in island.joints if not j.cut and j.type in KINDS]
        for tree in island.trees:
            of_tree = [j for j in joints if set(tree).intersection(j.bodies)]
            for joint in reversed_joints(of_tree, root_body(island, tree, recorded)):
                yield joint.path, f"Its body0 {leaf(joint.bodies[0])} hangs from its body1."
