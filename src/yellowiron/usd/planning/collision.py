"""Collision approximations (the conference paper's JSON-2): our token → UsdPhysics, PhysX and Newton attributes.

| token | physics:approximation | engine layers |
|---|---|---|
| `none` | no collider | |
| `analytic` | a Cylinder, Capsule, Cube or Sphere prim; `convexHull` where the part is none of them | |
| `triangleMesh` | `none` (UsdPhysics' word for the exact mesh) | PhysX allows it on static bodies only |
| `convexHull`, `boundingCube`, `boundingSphere` | the same | |
| `turned` | discs with `convexHull`, between the steps of the outer profile; one hull where it is not turned | |
| `convexDecomposition` | pieces with `convexHull` | PhysX, beside them: `PhysxConvexDecompositionCollisionAPI` |
| `meshSimplification` | the same | PhysX: `PhysxTriangleMeshSimplificationCollisionAPI` |
| `sdf` | `convexDecomposition` | PhysX: `sdf`, `PhysxSDFMeshCollisionAPI`; Newton: `NewtonSDFCollisionAPI` |
| `sphereFill` | `convexDecomposition` | PhysX: `sphereFill`, `PhysxSphereFillCollisionAPI` |

`sdf` and `sphereFill` are no UsdPhysics tokens: the neutral layer keeps the nearest one and PhysX's layer overrides it.
A decomposition is written as its pieces (`support.convex`), because engines differ in theirs: Newton's is one hull.
PhysX's settings are for who lets it decompose the mesh itself: with its default of 500 000 voxels a wheel loader takes
48 s to load on one core, with 50 000 11 s, with the pieces 3.5 s.

Masses are always explicit, so a `boundingSphere` changes none.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from yellowiron.model.errors import MechanismError
from yellowiron.model.specification import fold


@dataclass(frozen=True)
class Approximation:
    """How a part collides. `usd` is the UsdPhysics token ("" without a mesh collider); `physx_usd` replaces it for
    PhysX; `physx_values` are attribute → value of `physx_schema`, only those that differ from its defaults."""

    token: str
    usd: str = ""
    physx_usd: str = ""
    physx_schema: str = ""
    physx_values: Mapping[str, float | int | bool] = field(default_factory=dict)
    newton_schema: str = ""


APPROXIMATIONS = {
    a.token: a
    for a in (
        Approximation("none"),
        Approximation("analytic", "convexHull"),
        Approximation("turned", "convexHull"),
        Approximation("triangleMesh", "none"),
        Approximation("convexHull", "convexHull"),
        Approximation("boundingCube", "boundingCube"),
        Approximation("boundingSphere", "boundingSphere"),
        Approximation(
            "convexDecomposition",
            "convexDecomposition",
            physx_schema="PhysxConvexDecompositionCollisionAPI",
            physx_values={
                "physxConvexDecompositionCollision:shrinkWrap": True,
                "physxConvexDecompositionCollision:voxelResolution": 50_000,
            },
        ),
        Approximation(
            "meshSimplification",
            "meshSimplification",
            physx_schema="PhysxTriangleMeshSimplificationCollisionAPI",
        ),
        Approximation(
            "sdf",
            "convexDecomposition",
            physx_usd="sdf",
            physx_schema="PhysxSDFMeshCollisionAPI",
            newton_schema="NewtonSDFCollisionAPI",
        ),
        Approximation(
            "sphereFill",
            "convexDecomposition",
            physx_usd="sphereFill",
            physx_schema="PhysxSphereFillCollisionAPI",
        ),
    )
}
"""Every token, in the order of the table above."""

_SPELLINGS = {
    **{fold(token): token for token in APPROXIMATIONS},
    "": "none",
    "nocollision": "none",
    "mesh": "triangleMesh",
    "exactmesh": "triangleMesh",
    "hull": "convexHull",
    "boundingbox": "boundingCube",
    "simplification": "meshSimplification",
    "sdfmesh": "sdf",
    "signeddistancefield": "sdf",
    "sphereapproximation": "sphereFill",
    "spherefilling": "sphereFill",
}


def approximation(token: str, *, where: str = "") -> Approximation:
    """The approximation of that name, read without regard to case, `_` or spaces; `MechanismError` if unknown."""
    found = _SPELLINGS.get(fold(token))
    if found is None:
        raise MechanismError(
            f"'{token}' is no collision approximation", where=where, hint=f"Known: {', '.join(APPROXIMATIONS)}."
        )
    return APPROXIMATIONS[found]
