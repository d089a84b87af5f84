"""Stage → `View`: everything the rules read, read once."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np
from pxr import Gf, Tf, Usd, UsdGeom, UsdPhysics, Vt

from yellowiron.checks.islands import build_islands
from yellowiron.checks.reading import layers
from yellowiron.checks.reading.attributes import number
from yellowiron.checks.reading.bodies import Poses, read_bodies, read_colliders, read_materials, record_of
from yellowiron.checks.reading.bodies import rotation_and_scale as split
from yellowiron.checks.reading.joints import read_joints
from yellowiron.checks.reading.settings import groundless, lost_filters, read_solver
from yellowiron.checks.values import Units
from yellowiron.checks.view import View
from yellowiron.model.geometry import Floats

_SELF_COLLISION = ("physxArticulation:enabledSelfCollisions", "newton:selfCollisionEnabled")
_PHYSICS = ("physics:", "drive:", "limit:", "physx", "newton:", "mjc:")
_ARRAYS = ("points", "normals", "extent")
_FINITE = (
    "points",
    "physics:mass",
    "physics:density",
    "physics:diagonalInertia",
    "physics:localPos0",
    "physics:localPos1",
    "stiffness",
    "damping",
    "targetPosition",
    "targetVelocity",
)
"""Ends of attributes that cannot be infinite either; limits and largest forces can, and −∞ is some defaults."""

_NUMBERS = (
    float, Gf.Vec3f, Gf.Vec3d, Gf.Vec4d, Vt.FloatArray, Vt.DoubleArray, Vt.Vec3fArray, Vt.Vec3dArray
)  # fmt: skip


def read_view(stage: Usd.Stage, name: str) -> View:
    """A stage as values; `name` stands for the file in findings."""
    units = layers.read_units(stage)
    prims = list(stage.Traverse(Usd.TraverseInstanceProxies()))
    poses = Poses(units)
    colliders = read_colliders(prims, poses, units)
    bodies = read_bodies(prims, colliders, poses, units)
    joints = read_joints(prims, poses, units)
    roots = tuple(str(p.GetPath()) for p in prims if p.HasAPI(UsdPhysics.ArticulationRootAPI))
    machine = layers.find_machine(stage)
    return View(
        name=name,
        units=units,
        layer_units=tuple(layers.layer_units(stage)),
        bodies=bodies,
        joints=joints,
        colliders=colliders,
        materials=read_materials(prims, units),
        roots=roots,
        self_collision={r: _self_collision(stage.GetPrimAtPath(r)) for r in roots},
        scenes=tuple(_scenes(prims, units)),
        solver=tuple(read_solver(prims)),
        lost_filters=tuple(lost_filters(prims)),
        groundless=tuple(groundless(stage, prims, colliders)),
        not_numbers=tuple(_not_numbers(prims)),
        broken=tuple(layers.broken_references(stage)),
        missing_assets=tuple(layers.missing_assets(stage)),
        absolute_paths=tuple(layers.absolute_paths(stage)),
        stray_physics=tuple(layers.stray_physics(stage, machine)),
        islands=build_islands({k: b for k, b in bodies.items() if b.enabled}, joints, roots),
        machine=str(machine.GetPath()) if machine else "",
        frame=_frame(machine, poses) if machine else np.eye(4),
        record=record_of(machine) if machine else {},
    )


def _frame(prim: Usd.Prim, poses: Poses) -> Floats:
    matrix = poses.matrix(prim)
    frame = np.eye(4)
    frame[:3, :3] = split(matrix)[0]
    frame[:3, 3] = np.array(matrix.ExtractTranslation()) * poses.meters
    return frame


def _self_collision(root: Usd.Prim) -> bool:
    """Whether an articulation's links may collide: off where any engine's schema says so, on by default."""
    said = [root.GetAttribute(n) for n in _SELF_COLLISION if root.GetAttribute(n)]
    return not any(a.HasAuthoredValue() and a.Get() is False for a in said)


def _scenes(prims: Iterable[Usd.Prim], units: Units) -> Iterator[tuple[str, float | None]]:
    """Path and gravity (m/s², None: the default) of every physics scene."""
    for prim in prims:
        if prim.IsA(UsdPhysics.Scene):
            gravity = number(prim, "physics:gravityMagnitude")
            given = gravity is not None and math.isfinite(gravity) and gravity >= 0.0
            if prim.GetAttribute("newton:gravityEnabled").Get() is False:
                gravity, given = 0.0, True
            yield str(prim.GetPath()), gravity * units.meters_per_unit if given and gravity is not None else None


def _not_numbers(prims: Iterable[Usd.Prim]) -> Iterator[tuple[str, str]]:
    """(prim, attribute) wherever a transform, a shape or a physics attribute holds NaN, or an infinity that means
    nothing."""
    seen = set()
    for prim in prims:
        original = prim.GetPrimInPrototype() if prim.IsInstanceProxy() else prim
        if original.GetPath() in seen:
            continue
        seen.add(original.GetPath())
        path = str(prim.GetPath())
        if prim.IsA(UsdGeom.Xformable) and not _is_placed(prim):
            yield path, "its transform"
        for attribute in prim.GetAuthoredAttributes():
            name = attribute.GetName()
            if name in _ARRAYS or name.startswith(_PHYSICS):
                value = attribute.Get()
                if _holds(np.isnan, value) or (name.endswith(_FINITE) and _holds(np.isinf, value)):
                    yield path, name


def _is_placed(prim: Usd.Prim) -> bool:
    """Whether a prim's transform can be computed and is finite."""
    try:
        return bool(np.isfinite(np.array(UsdGeom.Xformable(prim).GetLocalTransformation())).all())
    except Tf.ErrorException:
        return False


def _holds(kind: Callable[[Floats], Any], value: object) -> bool:
    """Whether any number of a value is of a kind: `np.isnan`, `np.isinf`."""
    if isinstance(value, Gf.Quatf | Gf.Quatd):
        value = Gf.Vec4d(value.GetReal(), *value.GetImaginary())
    if isinstance(value, _NUMBERS):
        return bool(kind(np.array(value, dtype=np.float64)).any())
    return False
