"""The physics joints of a USD stage, as declared joints."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdPhysics

from yellowiron.cad.readers.declared import declared_joint
from yellowiron.model.assembly import DeclaredJoint

_TYPES = {
    "PhysicsRevoluteJoint": "revolute",
    "PhysicsPrismaticJoint": "prismatic",
    "PhysicsSphericalJoint": "spherical",
    "PhysicsFixedJoint": "fixed",
}
_AXES = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


def usd_joints(stage: Usd.Stage, unit: float, names: Callable[[Usd.Prim], list[str]]) -> Iterator[DeclaredJoint]:
    """The revolute, prismatic, spherical and fixed joints of a stage, in the pose that is drawn, metres.

    `names` are what the prims from the root to one are called. A body whose own name is another's, too, is called by
    its whole path.
    """
    joints = [UsdPhysics.Joint(p) for p in stage.Traverse() if p.IsA(UsdPhysics.Joint) and p.GetTypeName() in _TYPES]
    ends = [tuple(_body(stage, rel) for rel in (j.GetBody0Rel(), j.GetBody1Rel())) for j in joints]
    paths = {prim.GetPath(): names(prim) for pair in ends for prim in pair if prim}
    lasts = [path[-1] for path in paths.values()]
    called = {key: path[-1] if lasts.count(path[-1]) == 1 else "/".join(path) for key, path in paths.items()}
    cache = UsdGeom.XformCache()
    for joint, pair in zip(joints, ends, strict=True):
        prim = joint.GetPrim()
        bodies = [called[p.GetPath()] if p else "" for p in pair]
        # The frame on the child: there it is where the body is drawn. Without a child, on the parent.
        of_child = bool(pair[1])
        body = pair[1] if of_child else pair[0]
        position = (joint.GetLocalPos1Attr() if of_child else joint.GetLocalPos0Attr()).Get() or Gf.Vec3f(0.0)
        turn = (joint.GetLocalRot1Attr() if of_child else joint.GetLocalRot0Attr()).Get() or Gf.Quatf(1.0)
        matrix = cache.GetLocalToWorldTransform(body) if body else Gf.Matrix4d(1.0)
        kind = _TYPES[prim.GetTypeName()]
        axis = (0.0, 0.0, 0.0)
        limits: tuple[float | None, float | None] = (None, None)
        if kind in ("revolute", "prismatic"):
            token = prim.GetAttribute("physics:axis").Get() or "X"
            axis = matrix.TransformDir(Gf.Quatd(turn).Transform(Gf.Vec3d(_AXES.get(token, _AXES["X"]))))
            scale = unit if kind == "prismatic" else math.pi / 180.0
            limits = (_limit(prim, "lower", scale), _limit(prim, "upper", scale))
        anchor = np.array(matrix.Transform(Gf.Vec3d(position))) * unit
        yield declared_joint(prim.GetName(), kind, (bodies[0], bodies[1]), anchor, axis, limits)


def _body(stage: Usd.Stage, relation: Usd.Relationship) -> Usd.Prim | None:
    """The body at an end of a joint: what the relation names, or the prim above it that is one. None: the world."""
    targets = relation.GetTargets()
    prim = stage.GetPrimAtPath(targets[0]) if targets else None
    above = prim
    while above and not above.IsPseudoRoot():
        if above.HasAPI(UsdPhysics.RigidBodyAPI):
            return above
        above = above.GetParent()
    return prim or None


def _limit(prim: Usd.Prim, end: str, scale: float) -> float | None:
    value = prim.GetAttribute(f"physics:{end}Limit").Get()
    return float(value) * scale if value is not None and math.isfinite(value) else None
