"""The articulation's root: the link whose pose PhysX integrates, and where that is said.

PhysX (its TGS solver) takes each position iteration as a small step of its own, and adds that step's motion to the root
link's pose in single precision. The rounding, a fraction of a micrometre near the origin and more away from it, has the
same sign in every iteration of a step. All other links follow the root, so that it shows only where a loop's constraint
ties the root link itself to another: the solver closes that loop against an error that is none. A loader steering with
a front frame as root erred by 0.74 mm, and by 4.2 mm when it stood 20 m from the origin; with its rear axle, which no
cut touches, as root by 0.09 and 0.11 mm.
"""

from __future__ import annotations

from pxr import Sdf

from yellowiron.model.mechanism import Mechanism
from yellowiron.usd.authoring.stage import declare_variants, over
from yellowiron.usd.planning.plan import BASE_JOINT, JOINTS, Plan

BASES = ("floating", "fixed")
"""Variants of the set `Base`, the first of them the one that a machine file selects."""


def root_link(mechanism: Mechanism) -> str:
    """The body to be the articulation's root link: the mechanism's root where no cut joint touches it, else the nearest
    body in the tree that none touches (of equals: none that a motor turns, then the heaviest), else the root."""
    touched = {body for joint in mechanism.joints if joint.cut for body in (joint.body0, joint.body1)}
    tree = [joint for joint in mechanism.joints if not joint.cut]
    level = [mechanism.root]
    for _ in mechanism.bodies:
        if not touched.issuperset(level):
            break
        level = [joint.body1 for joint in tree if joint.body0 in level]
    spun = {joint.body1 for joint in tree if joint.drive is not None and joint.drive.kind == "velocity"}
    free = [body for body in level if body not in touched]
    return min(free, key=lambda body: (body in spun, -mechanism.body(body).mass), default=mechanism.root)


def articulation_roots(layer: Sdf.Layer, plan: Plan) -> tuple[Sdf.PrimSpec, ...]:
    """A layer's opinions on the articulation's root, one prim each variant of `Base`: floating, the root link; fixed,
    the joint to the world, which makes the articulation's base a fixed one (the place that UsdPhysics names for it)."""
    spec = over(layer, plan.root)
    declare_variants(spec, "Base", BASES)
    link = plan.body_paths[root_link(plan.mechanism)][len(plan.root) + 1 :]
    paths = {"floating": link, "fixed": f"{JOINTS}/{BASE_JOINT}"}
    return tuple(over(layer, f"{plan.root}{{Base={base}}}{paths[base]}") for base in BASES)
