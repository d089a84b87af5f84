"""Rigid bodies, colliders and materials of a stage, as values."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from pxr import Gf, Tf, Usd, UsdGeom, UsdPhysics, UsdShade

from yellowiron.checks.reading.attributes import axis_token, number, quaternion, vector
from yellowiron.checks.values import StageBody, StageCollider, StageMaterial, Units, union
from yellowiron.model.geometry import Floats
from yellowiron.support.record import RECORD

_FIELDS = {
    "Sphere": ("radius",),
    "Cylinder": ("radius", "height"),
    "Capsule": ("radius",),
    "Cone": ("radius", "height"),
    "Cube": ("size",),
}
_SHEAR = 1e-4
_EQUAL, _DISC = 0.02, 0.1
"""Moments this close, of the largest, are equal; this far apart they are a disc's."""


class Poses:
    """World transforms and boxes in metres, each computed once."""

    def __init__(self, units: Units) -> None:
        self.meters = units.meters_per_unit
        self._transforms = UsdGeom.XformCache()
        self._boxes = UsdGeom.BBoxCache(
            Usd.TimeCode.Default(), [UsdGeom.Tokens.default_, UsdGeom.Tokens.guide, UsdGeom.Tokens.proxy], False, True
        )

    def matrix(self, prim: Usd.Prim) -> Gf.Matrix4d:
        """Local to world, stage units, row vectors as in Gf."""
        try:
            return self._transforms.GetLocalToWorldTransform(prim)
        except Tf.ErrorException:  # an operation of the wrong type: CHK004
            return Gf.Matrix4d(1.0)

    def bounds(self, prim: Usd.Prim) -> Floats | None:
        """The box (2, 3) of a prim's geometry in the world, metres; None where it has none."""
        try:
            reach = self._boxes.ComputeWorldBound(prim).ComputeAlignedRange()
        except Tf.ErrorException:
            return None
        if reach.IsEmpty():
            return None
        box = np.array([reach.GetMin(), reach.GetMax()]) * self.meters
        return box if np.isfinite(box).all() else None


def record_of(prim: Usd.Prim) -> Mapping[str, Any]:
    """What a yellowiron build wrote on a prim, or nothing."""
    found = prim.GetCustomDataByKey(RECORD)
    return found if isinstance(found, dict) else {}


def rotation_and_scale(matrix: Gf.Matrix4d) -> tuple[Floats, Floats, bool, bool]:
    """A transform's proper rotation (3, 3), scale (3,), whether it shears and whether it mirrors."""
    return _rotation_and_scale(np.array(matrix, dtype=np.float64)[:3, :3].tobytes())


@functools.lru_cache(maxsize=1024)
def _rotation_and_scale(rows: bytes) -> tuple[Floats, Floats, bool, bool]:
    """Of a matrix's bytes: a body's colliders are all turned as it is."""
    linear = np.frombuffer(rows).reshape(3, 3).T
    if not np.isfinite(linear).all():
        return np.full((3, 3), np.nan), np.full(3, np.nan), False, False
    scale = np.linalg.norm(linear, axis=0)
    unit = linear / np.where(scale > 0.0, scale, 1.0)
    mirrored = bool(np.linalg.det(linear) < 0.0)
    sheared = bool(np.abs(unit.T @ unit - np.eye(3)).max() > _SHEAR)
    left, _, right = np.linalg.svd(unit)
    rotation = left @ np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right)) or 1.0]) @ right
    rotation.setflags(write=False)
    scale.setflags(write=False)
    return rotation, scale, sheared, mirrored


def is_rigid(prim: Usd.Prim) -> bool:
    """Whether a prim is a rigid body, switched off or not."""
    return bool(prim.HasAPI(UsdPhysics.RigidBodyAPI))


def is_body(prim: Usd.Prim) -> bool:
    """Whether a prim is a rigid body that is not switched off."""
    return (
        prim.HasAPI(UsdPhysics.RigidBodyAPI)
        and UsdPhysics.RigidBodyAPI(prim).GetRigidBodyEnabledAttr().Get() is not False
    )


def body_of(prim: Usd.Prim) -> str:
    """The path of the rigid body at or above a prim; "" is the world."""
    while prim and not prim.IsPseudoRoot():
        if is_body(prim):
            return str(prim.GetPath())
        prim = prim.GetParent()
    return ""


def read_bodies(
    prims: Iterable[Usd.Prim], colliders: Iterable[StageCollider], poses: Poses, units: Units
) -> dict[str, StageBody]:
    """Path → body, in the stage's order. Bodies that are switched off are included, and say so."""
    solid: dict[str, list[Floats]] = {}
    owners = set()
    for collider in colliders:
        owners.add(collider.body)
        if collider.bounds is not None:
            solid.setdefault(collider.body, []).append(collider.bounds)
    made = (p for p in prims if p.HasAPI(UsdPhysics.RigidBodyAPI))
    return {str(p.GetPath()): _read_body(p, solid, owners, poses, units) for p in made}


def _read_body(
    prim: Usd.Prim, solid: dict[str, list[Floats]], owners: set[str], poses: Poses, units: Units
) -> StageBody:
    path = str(prim.GetPath())
    matrix = poses.matrix(prim)
    rotation, scale, sheared, mirrored = rotation_and_scale(matrix)
    pose = np.eye(4)
    pose[:3, :3] = rotation
    pose[:3, 3] = np.array(matrix.ExtractTranslation()) * poses.meters
    api = UsdPhysics.RigidBodyAPI(prim)
    kilograms, meters = units.kilograms_per_unit, units.meters_per_unit
    authored = number(prim, "physics:mass")
    density = number(prim, "physics:density")
    local = vector(prim, "physics:centerOfMass")
    moments = vector(prim, "physics:diagonalInertia")
    filtered = prim.GetRelationship("physics:filteredPairs")
    return StageBody(
        path=path,
        parent_body=body_of(prim.GetParent()),
        pose=pose,
        scale=scale,
        sheared=sheared,
        mirrored=mirrored,
        enabled=is_body(prim),
        kinematic=bool(api.GetKinematicEnabledAttr().Get()),
        mass=None if authored is None else authored * kilograms,
        density=None if density is None else density * kilograms / meters**3,
        center_of_mass=None if not _given(local) else np.array(matrix.Transform(local)) * meters,
        inertia=None if moments is None else np.array(moments, dtype=np.float64) * kilograms * meters**2,
        bounds=union(_boxes(prim, poses)),
        solid=union(solid.get(path, [])),
        has_collider=path in owners,
        disc_axis=_disc_axis(prim, moments, rotation),
        drawn=union(_boxes(prim, poses, _collides)),
        weightless=_is_weightless(prim),
        filtered=tuple(str(t) for t in filtered.GetTargets()) if filtered else (),
        record=record_of(prim),
    )


def _disc_axis(prim: Usd.Prim, moments: Gf.Vec3d | None, rotation: Floats) -> Floats | None:
    """The axis of the largest moment where the other two are equal: the body turns like a disc or a wheel."""
    if moments is None or not all(math.isfinite(m) and m > 0.0 for m in moments):
        return None
    order = np.argsort(np.array(moments))
    small, middle, large = (float(moments[int(i)]) for i in order)
    if middle - small > _EQUAL * large or large - middle < _DISC * large:
        return None
    written = quaternion(prim, "physics:principalAxes") or Gf.Quatd(0.0)
    length = written.GetLength()
    if not math.isfinite(length):
        return None
    turn = Gf.Matrix3d(written.GetNormalized()) if length > 0.0 else Gf.Matrix3d(1.0)
    return np.asarray(rotation @ np.array(turn, dtype=np.float64).T[:, int(order[2])])


def _given(local: Gf.Vec3d | None) -> bool:
    """UsdPhysics writes "not given" as minus infinity."""
    return local is not None and all(math.isfinite(c) for c in local)


def _collides(prim: Usd.Prim) -> bool:
    """Whether a prim is a collider, a part of a body of its own, or a guide."""
    guide = prim.IsA(UsdGeom.Imageable) and UsdGeom.Imageable(prim).GetPurposeAttr().Get() == UsdGeom.Tokens.guide
    return bool(guide or prim.HasAPI(UsdPhysics.CollisionAPI) or prim.HasAPI(UsdPhysics.RigidBodyAPI))


def _is_weightless(prim: Usd.Prim) -> bool:
    """Whether gravity is off on a body, as PhysX or MuJoCo say it."""
    off = prim.GetAttribute("physxRigidBody:disableGravity")
    return bool(off and off.Get() is True) or (number(prim, "mjc:gravcomp") or 0.0) >= 1.0


def _boxes(prim: Usd.Prim, poses: Poses, without: Callable[[Usd.Prim], bool] = is_rigid) -> list[Floats]:
    """The boxes of a body's own geometry, without those of prims like bodies nested in it."""
    if prim.IsA(UsdGeom.Gprim):
        box = poses.bounds(prim)
        return [] if box is None else [box]
    found: list[Floats] = []
    for child in prim.GetFilteredChildren(Usd.TraverseInstanceProxies()):
        if without(child):
            continue
        nested = any(without(p) for p in Usd.PrimRange(child, Usd.TraverseInstanceProxies()))
        if nested:
            found += _boxes(child, poses, without)
        elif (box := poses.bounds(child)) is not None:
            found.append(box)
    return found


def read_colliders(prims: Iterable[Usd.Prim], poses: Poses, units: Units) -> tuple[StageCollider, ...]:
    """Every enabled collider, in the stage's order."""
    enabled = (
        p
        for p in prims
        if p.HasAPI(UsdPhysics.CollisionAPI) and UsdPhysics.CollisionAPI(p).GetCollisionEnabledAttr().Get() is not False
    )
    return tuple(_read_collider(p, poses, units) for p in enabled)


def _read_collider(prim: Usd.Prim, poses: Poses, units: Units) -> StageCollider:
    shape = str(prim.GetTypeName())
    approximation = None
    if prim.HasAPI(UsdPhysics.MeshCollisionAPI):
        approximation = str(UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get())
    rotation, scale, _, _ = rotation_and_scale(poses.matrix(prim))
    round_about = shape in ("Cylinder", "Capsule", "Cone")
    axis = rotation[:, "XYZ".index(axis_token(prim, "axis", "Z"))] if round_about else None
    density = number(prim, "physics:density")
    material, missing = _physics_material(prim)
    per_volume = units.kilograms_per_unit / units.meters_per_unit**3
    if density is None and material:
        density = number(prim.GetStage().GetPrimAtPath(material), "physics:density")
    return StageCollider(
        path=str(prim.GetPath()),
        body=body_of(prim),
        shape=shape,
        approximation=approximation,
        bounds=poses.bounds(prim),
        axis=axis,
        radius=(number(prim, "radius") or 0.0) * poses.meters * float(scale.max()),
        height=(number(prim, "height") or 0.0) * poses.meters * float(scale.max()),
        empty=_is_empty(prim, scale),
        density=None if density is None else density * per_volume,
        material=material,
        material_missing=missing,
    )


def _is_empty(prim: Usd.Prim, scale: Floats) -> bool:
    """Whether a shape has no volume to collide with."""
    kind = str(prim.GetTypeName())
    if kind == "Mesh":
        points, counts = (prim.GetAttribute(n).Get() for n in ("points", "faceVertexCounts"))
        return not points or not counts
    sizes = [number(prim, f) for f in _FIELDS.get(kind, ())]
    return any(s is not None and not s > 0.0 for s in sizes) or bool((scale == 0.0).any())


def _physics_material(prim: Usd.Prim) -> tuple[str, bool]:
    """The material that a collider is bound to for physics, and whether a binding leads nowhere."""
    named = prim.GetRelationship("material:binding:physics")
    if named and named.GetTargets():
        target = named.GetTargets()[0]
        found = prim.GetStage().GetPrimAtPath(target)
        return str(target) if found else "", not found
    bound, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")
    return (str(bound.GetPath()) if bound else ""), False


def read_materials(prims: Iterable[Usd.Prim], units: Units) -> tuple[StageMaterial, ...]:
    """Every physics material."""
    per_volume = units.kilograms_per_unit / units.meters_per_unit**3
    found = []
    for prim in prims:
        if prim.HasAPI(UsdPhysics.MaterialAPI):
            density = number(prim, "physics:density")
            found.append(
                StageMaterial(
                    path=str(prim.GetPath()),
                    static_friction=number(prim, "physics:staticFriction"),
                    dynamic_friction=number(prim, "physics:dynamicFriction"),
                    restitution=number(prim, "physics:restitution"),
                    density=None if density is None else density * per_volume,
                )
            )
    return tuple(found)
