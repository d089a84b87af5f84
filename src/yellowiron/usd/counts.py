"""What a USD file holds, counted: for the report, beside the template's counts."""

from __future__ import annotations

from pathlib import Path

from pxr import Usd, UsdPhysics

from yellowiron.support.record import COLLIDING, DETAIL, RECORD
from yellowiron.usd.read import open_stage

_TYPES = {
    "revolute": UsdPhysics.RevoluteJoint,
    "prismatic": UsdPhysics.PrismaticJoint,
    "fixed": UsdPhysics.FixedJoint,
    "spherical": UsdPhysics.SphericalJoint,
    "distance": UsdPhysics.DistanceJoint,
}


def count_joints(path: str | Path) -> dict[str, int]:
    """Rigid bodies, joints by type, drives and loops (joints excluded from the articulation; of a ring that is no part
    of it, the one that closes it) of a file as it opens: cut pivots count as the spherical joints they are written as.
    `YellowironError` where the file does not open."""
    stage = open_stage(path)
    prims = list(stage.Traverse(Usd.TraverseInstanceProxies()))
    joints = [UsdPhysics.Joint(p) for p in prims if p.IsA(UsdPhysics.Joint)]
    return {
        "bodies": sum(p.HasAPI(UsdPhysics.RigidBodyAPI) for p in prims),
        **{name: sum(p.IsA(kind) for p in prims) for name, kind in _TYPES.items()},
        "linear_drives": sum(p.HasAPI(UsdPhysics.DriveAPI, "linear") for p in prims),
        "angular_drives": sum(p.HasAPI(UsdPhysics.DriveAPI, "angular") for p in prims),
        "loops": sum(bool(j.GetExcludeFromArticulationAttr().Get()) and not _in_ring(j) for j in joints),
    }


def count_colliders(path: str | Path) -> dict[str, dict[str, int]]:
    """How many colliders each body of a file has, by its name, in every detail that is for colliding. Errors as of
    `count_joints`."""
    stage = open_stage(path)
    found: dict[str, dict[str, int]] = {}
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        for detail in COLLIDING:
            for prim in [p for p in stage.Traverse() if p.GetVariantSets().HasVariantSet(DETAIL)]:
                prim.GetVariantSet(DETAIL).SetVariantSelection(detail)
            for prim in stage.Traverse():
                record = prim.GetCustomDataByKey(RECORD) or {}
                if record.get("kind") == "body":
                    inside = Usd.PrimRange(prim, Usd.TraverseInstanceProxies())
                    number = sum(p.HasAPI(UsdPhysics.CollisionAPI) for p in inside)
                    found.setdefault(str(record["name"]), {})[detail] = number
    return found


def _in_ring(joint: UsdPhysics.Joint) -> bool:
    """Whether a joint is in the tree of a chain that no joint ties to the machine."""
    record = joint.GetPrim().GetCustomDataByKey(RECORD) or {}
    return bool(record.get("floating")) and not record.get("cut")
