"""What a machine file shows and collides with, body by body. Metres, each body's own frame in the drawn pose."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np
from pxr import Gf, Tf, Usd, UsdGeom, UsdPhysics, UsdShade

from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Color, Floats, Mesh
from yellowiron.support.record import DETAIL, DETAILS, RECORD
from yellowiron.support.vectors import triple

_NEUTRAL: Color = (0.5, 0.5, 0.5)
Kind = Literal["mesh", "cylinder", "capsule", "box", "sphere"]


@dataclass(frozen=True, eq=False)
class Visual:
    """A surface to see: `mesh` placed by `matrix` (4, 4) in its body; linear RGB."""

    name: str
    mesh: Mesh
    matrix: Floats
    color: Color = _NEUTRAL


@dataclass(frozen=True, eq=False)
class Collider:
    """A shape to touch, placed by `matrix` (4, 4; a proper rotation for the analytic kinds, along whose z cylinders and
    capsules lie). `size`: (radius, height) of these (a capsule's height without its caps), (radius,) of a sphere, the
    three edges of a box. A mesh's `approximation` is UsdPhysics' token. `friction` is the dynamic one, None: not said;
    it `rules` over that of what it touches where its material says so. `material` is that one's name.
    """

    name: str
    kind: Kind
    matrix: Floats
    size: tuple[float, ...] = ()
    mesh: Mesh | None = None
    approximation: str = ""
    friction: float | None = None
    rules: bool = False
    material: str = ""


@dataclass(frozen=True, eq=False)
class BodyGeometry:
    """One body's visuals and colliders, in the file's order."""

    visuals: tuple[Visual, ...] = ()
    colliders: tuple[Collider, ...] = ()


@dataclass(frozen=True, eq=False)
class Geometry:
    """All bodies' geometry by name, and the pairs of bodies that must not collide with each other."""

    bodies: Mapping[str, BodyGeometry] = field(default_factory=dict)
    filtered: tuple[tuple[str, str], ...] = ()
    detail: str = DETAILS[0]


def read_geometry(path: str | Path | Geometry, *, detail: str = DETAILS[0]) -> Geometry:
    """The geometry of the machine in a USD file (or in a scene that holds one), its physics switched on, its brakes
    released and its colliders in that `detail`, whatever the file selects; one that was read before is itself.

    `YellowironError` where the file does not open or holds no machine of ours, or there is no such detail.
    """
    if detail not in DETAILS:
        raise YellowironError(
            f"There is no detail '{detail}'",
            where="--detail",
            hint=f"Choose {', '.join(DETAILS[:-1])} or {DETAILS[-1]}.",
        )
    if isinstance(path, Geometry):
        return path
    try:
        stage = Usd.Stage.Open(str(path))
    except Tf.ErrorException as error:
        raise YellowironError(
            "The file cannot be read as USD", where=str(path), hint="It is damaged or no USD; write it again."
        ) from error
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        for name, choice in (("Physics", "on"), ("Brakes", "released"), (DETAIL, detail)):
            for prim in [p for p in stage.Traverse() if p.GetVariantSets().HasVariantSet(name)]:
                prim.GetVariantSet(name).SetVariantSelection(choice)
    bodies = {str(data["name"]): prim for prim, data in _described(stage) if data.get("kind") == "body"}
    if not bodies:
        raise YellowironError(
            "There is no yellowiron machine in the file",
            where=str(path),
            hint="Give the machine file or the scene.usda that `yellowiron build` wrote.",
        )
    names = {prim.GetPath(): name for name, prim in bodies.items()}
    reader = _Reader(UsdGeom.XformCache())
    pairs = [
        (name, names[target])
        for name, prim in bodies.items()
        if prim.HasAPI(UsdPhysics.FilteredPairsAPI)
        for target in UsdPhysics.FilteredPairsAPI(prim).GetFilteredPairsRel().GetTargets()
        if target in names
    ]
    return Geometry({name: reader.body(prim) for name, prim in bodies.items()}, tuple(pairs), detail)


def _described(stage: Usd.Stage) -> Iterator[tuple[Usd.Prim, Mapping[str, object]]]:
    for prim in stage.Traverse():
        data = prim.GetCustomDataByKey(RECORD)
        if data:
            yield prim, data


class _Reader:
    """Reads prims relative to their body; meshes that instances share are read once."""

    def __init__(self, cache: UsdGeom.XformCache) -> None:
        self._cache = cache
        self._meshes: dict[object, Mesh] = {}

    def body(self, prim: Usd.Prim) -> BodyGeometry:
        visuals: list[Visual] = []
        colliders: list[Collider] = []
        for each in Usd.PrimRange(prim, Usd.TraverseInstanceProxies()):
            if each.HasAPI(UsdPhysics.CollisionAPI):
                collider = self._collider(each, prim)
                if collider is not None:
                    colliders.append(collider)
            elif each.IsA(UsdGeom.Mesh) and UsdGeom.Imageable(each).ComputePurpose() in ("default", "render"):
                visuals.append(Visual(_label(each, prim), self._mesh(each), self._matrix(each, prim), _color(each)))
        return BodyGeometry(tuple(visuals), tuple(colliders))

    def _matrix(self, prim: Usd.Prim, body: Usd.Prim) -> Floats:
        matrix, _ = self._cache.ComputeRelativeTransform(prim, body)
        return np.array(matrix, dtype=np.float64).T

    def _mesh(self, prim: Usd.Prim) -> Mesh:
        shared = prim.GetPrimInPrototype() if prim.IsInstanceProxy() else prim
        key = shared.GetPath()
        if key not in self._meshes:
            mesh = UsdGeom.Mesh(prim)
            points = np.array(mesh.GetPointsAttr().Get() or [], dtype=np.float64).reshape(-1, 3)
            counts = np.array(mesh.GetFaceVertexCountsAttr().Get() or [], dtype=np.int64)
            indices = np.array(mesh.GetFaceVertexIndicesAttr().Get() or [], dtype=np.int32)
            triangles = _fans(counts, indices)
            if mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded:
                triangles = triangles[:, ::-1]
            self._meshes[key] = Mesh(points, triangles)
        return self._meshes[key]

    def _collider(self, prim: Usd.Prim, body: Usd.Prim) -> Collider | None:
        matrix, name = self._matrix(prim, body), _label(prim, body)
        friction, rules, material = _friction(prim)
        if prim.IsA(UsdGeom.Mesh):
            token = "none"
            if prim.HasAPI(UsdPhysics.MeshCollisionAPI):
                token = str(UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get())
            mesh = self._mesh(prim)
            made = Collider(name, "mesh", matrix, (), mesh, token, friction, rules, material)
            return made if len(mesh.triangles) else None
        said: dict[str, Any] = {"friction": friction, "rules": rules, "material": material}
        scale = np.linalg.norm(matrix[:3, :3], axis=0)
        proper = matrix.copy()
        proper[:3, :3] /= scale
        if np.linalg.det(proper[:3, :3]) < 0.0:
            proper[:3, 0] *= -1.0
        if prim.IsA(UsdGeom.Cube):
            edge = float(UsdGeom.Cube(prim).GetSizeAttr().Get())
            return Collider(name, "box", proper, tuple((edge * scale).tolist()), **said)
        if prim.IsA(UsdGeom.Sphere):
            radius = float(UsdGeom.Sphere(prim).GetRadiusAttr().Get()) * float(scale.max())
            return Collider(name, "sphere", proper, (radius,), **said)
        for kind, schema in (("cylinder", UsdGeom.Cylinder), ("capsule", UsdGeom.Capsule)):
            if prim.IsA(schema):
                shape = schema(prim)
                axis = "XYZ".index(str(shape.GetAxisAttr().Get()))
                turned = proper.copy()
                turned[:3, :3] = np.roll(proper[:3, :3], 2 - axis, axis=1)
                radius = float(shape.GetRadiusAttr().Get()) * float(np.delete(scale, axis).max())
                height = float(shape.GetHeightAttr().Get()) * float(scale[axis])
                size = (radius, height)
                return Collider(name, kind, turned, size, **said)  # type: ignore[arg-type]
        return None


def _fans(counts: Floats | np.ndarray, indices: np.ndarray) -> np.ndarray:
    """Triangles (m, 3) of polygons, each cut into a fan from its first corner."""
    if len(counts) and bool((counts == 3).all()):
        return indices.reshape(-1, 3)
    starts = np.cumsum(counts) - counts
    rows = [
        (indices[start], indices[start + corner], indices[start + corner + 1])
        for start, count in zip(starts.tolist(), counts.tolist(), strict=True)
        for corner in range(1, count - 1)
    ]
    return np.array(rows, dtype=np.int32).reshape(-1, 3)


def _label(prim: Usd.Prim, body: Usd.Prim) -> str:
    """The part's name: that of the prim right under the scope of visuals or colliders."""
    scope = prim
    while scope.GetParent().GetParent() != body and scope.GetParent() != body:
        scope = scope.GetParent()
    return str(scope.GetName())


def _color(prim: Usd.Prim) -> Color:
    """The bound preview surface's diffuse colour, else the mesh's own mean display colour, else grey."""
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    if material:
        shader, _, _ = material.ComputeSurfaceSource()
        diffuse = shader.GetInput("diffuseColor") if shader else None
        value = diffuse.Get() if diffuse else None
        if value is not None:
            return triple(value)
    colors = UsdGeom.Gprim(prim).GetDisplayColorAttr().Get()
    return triple(Gf.Vec3f(*np.array(colors).mean(axis=0).tolist())) if colors else _NEUTRAL


def _friction(prim: Usd.Prim) -> tuple[float | None, bool, str]:
    """The dynamic friction of a collider's material, None where it has none, whether it rules, and its name."""
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")
    if not material or not material.GetPrim().HasAPI(UsdPhysics.MaterialAPI):
        return None, False, ""
    combine = material.GetPrim().GetAttribute("physxMaterial:frictionCombineMode")
    rules = bool(combine) and combine.Get() in ("min", "multiply")
    name = str(material.GetPrim().GetMetadata("displayName") or material.GetPrim().GetName())
    return float(UsdPhysics.MaterialAPI(material.GetPrim()).GetDynamicFrictionAttr().Get()), rules, name
