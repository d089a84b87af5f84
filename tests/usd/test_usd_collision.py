"""Collision: every token's attributes, and the primitives that stand for shapes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from pxr import Usd, UsdGeom, UsdPhysics, UsdShade

from yellowiron.model.errors import MechanismError
from yellowiron.model.geometry import CylinderFeature, Mesh, Shape
from yellowiron.usd.planning.collision import APPROXIMATIONS, approximation
from yellowiron.usd.planning.primitives import Primitive, fit_primitive


@pytest.fixture(scope="module")
def stage(written: Path) -> Usd.Stage:
    return Usd.Stage.Open(str(written / "test_machine.usda"))


def collider(stage: Usd.Stage, path: str) -> Usd.Prim:
    body, name = path.split("/")
    return stage.GetPrimAtPath(f"/test_machine/{body}/colliders/{name}")


@pytest.mark.parametrize(
    ("path", "token", "schema"),
    [
        ("frame/bracket_3", "convexHull", ""),
        ("frame/bracket_4", "meshSimplification", "PhysxTriangleMeshSimplificationCollisionAPI"),
        ("arm/BEAM", "boundingCube", ""),
        ("hanger/Kugel_Größe_3", "boundingSphere", ""),
        ("铲斗/铲斗", "sdf", "PhysxSDFMeshCollisionAPI"),
        ("铲斗/Zahn_ä", "none", ""),
        ("cab/bracket", "sphereFill", "PhysxSphereFillCollisionAPI"),
    ],
)
def test_mesh_tokens(stage: Usd.Stage, path: str, token: str, schema: str) -> None:
    prim = collider(stage, path)
    assert prim.GetTypeName() == "Mesh"
    assert prim.HasAPI(UsdPhysics.CollisionAPI)
    assert UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get() == token
    applied = prim.GetMetadata("apiSchemas").GetAppliedItems()
    assert [s for s in applied if s.startswith("Physx")] == ([schema] if schema else [])
    assert UsdGeom.Imageable(prim).ComputePurpose() == "guide"


def test_a_decomposition_is_in_pieces_that_every_engine_takes(stage: Usd.Stage, machine) -> None:
    """Not each engine's own idea of it: Newton's would be one hull."""
    group = collider(stage, "frame/bracket")
    mesh, *pieces = group.GetChildren()
    assert UsdGeom.Imageable(mesh).ComputePurpose() == "guide"
    assert UsdPhysics.MeshCollisionAPI(mesh).GetApproximationAttr().Get() == "convexDecomposition"
    assert "PhysxConvexDecompositionCollisionAPI" in mesh.GetMetadata("apiSchemas").GetAppliedItems()
    assert not mesh.HasAPI(UsdPhysics.CollisionAPI)
    assert len(pieces) > 1
    for piece in pieces:
        assert piece.HasAPI(UsdPhysics.CollisionAPI)
        assert UsdPhysics.MeshCollisionAPI(piece).GetApproximationAttr().Get() == "convexHull"
        bound, _ = UsdShade.MaterialBindingAPI(piece).ComputeBoundMaterial("physics")
        assert bound.GetPath() == "/test_machine/materials/steel"
        assert trimesh.Trimesh(*placed(piece), process=False).is_convex
    points = np.concatenate([placed(piece)[0] for piece in pieces])
    expected = machine.assembly.points_of(machine.assembly.parts[1])
    assert np.allclose(
        [points.min(axis=0), points.max(axis=0)], [expected.min(axis=0), expected.max(axis=0)], atol=1e-6
    )


def placed(prim: Usd.Prim) -> tuple[np.ndarray, np.ndarray]:
    """A mesh's points where they are in the machine, and its triangles."""
    matrix = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(prim)).T
    assert np.linalg.det(matrix[:3, :3]) > 0
    mesh = UsdGeom.Mesh(prim)
    points = np.array(mesh.GetPointsAttr().Get()) @ matrix[:3, :3].T + matrix[:3, 3]
    return points, np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)


def test_tokens_that_only_physx_knows_have_a_neutral_one(written: Path) -> None:
    from pxr import Sdf

    layer = Sdf.Layer.FindOrOpen(str(written / "payloads" / "physics.usda"))
    for path in ("铲斗/colliders/铲斗", "cab/colliders/bracket"):
        attribute = layer.GetAttributeAtPath(f"/test_machine/{path}.physics:approximation")
        assert attribute.default == "convexDecomposition"


@pytest.mark.parametrize(
    ("path", "kind"),
    [
        ("frame/BEAM", "Cube"),
        ("wheel_l/WHEEL", "Cylinder"),
        ("wheel_r/WHEEL", "Cylinder"),
        ("barrel/PIN_50x300", "Cylinder"),
        ("chain/Kapsel", "Capsule"),
        ("hanger/Kugel_Größe_3_2", "Sphere"),
    ],
)
def test_analytic_parts(stage: Usd.Stage, machine, path: str, kind: str) -> None:
    prim = collider(stage, path)
    assert prim.GetTypeName() == kind
    assert not prim.HasAPI(UsdPhysics.MeshCollisionAPI)
    visual = stage.GetPrimAtPath(str(prim.GetPath()).replace("/colliders/", "/visuals/"))
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), ["default", "guide"])
    drawn = cache.ComputeWorldBound(visual).ComputeAlignedRange()
    analytic = cache.ComputeWorldBound(prim).ComputeAlignedRange()
    tolerance = 0.01 * np.linalg.norm(drawn.GetSize())
    assert np.allclose(drawn.GetMin(), analytic.GetMin(), atol=tolerance)
    assert np.allclose(drawn.GetMax(), analytic.GetMax(), atol=tolerance)


def test_mirrored_colliders_lie_on_their_part_with_a_proper_transform(stage: Usd.Stage, machine) -> None:
    mesh, *pieces = collider(stage, "frame/bracket_2").GetChildren()
    expected = machine.assembly.points_of(machine.assembly.parts[2])
    bounds = [expected.min(axis=0), expected.max(axis=0)]
    points, triangles = placed(mesh)
    assert np.allclose([points.min(axis=0), points.max(axis=0)], bounds, atol=1e-6)
    assert trimesh.Trimesh(points, triangles, process=False).volume > 0  # still counter-clockwise from outside
    cut = [placed(piece) for piece in pieces]
    together = np.concatenate([points for points, _ in cut])
    assert np.allclose([together.min(axis=0), together.max(axis=0)], bounds, atol=1e-6)
    assert all(trimesh.Trimesh(*piece, process=False).volume > 0 for piece in cut)


def test_parts_without_collision_have_no_collider(stage: Usd.Stage) -> None:
    arm = [p.GetName() for p in stage.GetPrimAtPath("/test_machine/arm/colliders").GetChildren()]
    assert arm == ["BEAM"]


@pytest.mark.parametrize("spelling", ["Convex Decomposition", "convex_decomposition", "CONVEXDECOMPOSITION"])
def test_spellings(spelling: str) -> None:
    assert approximation(spelling).token == "convexDecomposition"


def test_triangle_mesh_of_the_paper() -> None:
    assert approximation("triangle mesh").usd == "none"
    assert approximation("none").usd == ""


def test_unknown_token() -> None:
    with pytest.raises(MechanismError, match="'voxels' is no collision approximation") as raised:
        approximation("voxels", where="bucket")
    assert raised.value.where == "bucket"
    assert all(token in raised.value.hint for token in APPROXIMATIONS)


def shape_of(mesh: trimesh.Trimesh, cylinders: tuple[CylinderFeature, ...] = ()) -> Shape:
    return Shape(
        key="k",
        name="s",
        mesh=Mesh(np.array(mesh.vertices), np.array(mesh.faces, dtype=np.int32)),
        volume=float(mesh.volume),
        area=float(mesh.area),
        centroid=np.zeros(3),
        inertia=np.eye(3),
        cylinders=cylinders,
    )


SIZES = st.floats(0.05, 2.0)


@settings(deadline=None, max_examples=30)
@given(radius=SIZES, height=SIZES, seed=st.integers(0, 1000))
def test_a_turned_cylinder_with_its_feature(radius: float, height: float, seed: int) -> None:
    matrix = trimesh.transformations.random_rotation_matrix(np.random.default_rng(seed).random(3))
    matrix[:3, 3] = (1.0, -2.0, 3.0)
    mesh = trimesh.creation.cylinder(radius, height, sections=48, transform=matrix)
    point, direction = tuple(map(float, matrix[:3, 3])), tuple(map(float, matrix[:3, 2]))
    feature = CylinderFeature(point, direction, radius, -height / 2, height / 2, 2 * np.pi, False, area=1.0)
    found = fit_primitive(shape_of(mesh, (feature,)))
    assert found is not None
    assert found.kind == "cylinder"
    assert found.size == pytest.approx((radius, height), rel=1e-6)
    assert np.allclose(found.center, matrix[:3, 3], atol=1e-9)
    assert np.allclose(np.abs(found.rotation[:, 2] @ matrix[:3, 2]), 1.0)


@settings(deadline=None, max_examples=30)
@given(st.tuples(SIZES, SIZES, SIZES), st.integers(0, 10_000))
def test_primitives_enclose_their_shape(size, seed: int) -> None:
    points = np.random.default_rng(seed).normal(size=(40, 3)) * size
    mesh = trimesh.convex.convex_hull(points)
    found = fit_primitive(shape_of(mesh), max_excess=np.inf)
    assert found is not None
    assert inside(found, np.array(mesh.vertices))
    assert found.volume >= mesh.volume


def inside(primitive: Primitive, points: np.ndarray) -> bool:
    local = (points - primitive.center) @ primitive.rotation
    tolerance = 1e-9
    if primitive.kind == "box":
        return bool((np.abs(local) <= np.array(primitive.size) / 2 + tolerance).all())
    if primitive.kind == "sphere":
        return bool((np.linalg.norm(local, axis=1) <= primitive.size[0] + tolerance).all())
    radial, along = np.linalg.norm(local[:, :2], axis=1), np.abs(local[:, 2])
    if primitive.kind == "cylinder":
        return bool(
            (radial <= primitive.size[0] + tolerance).all() and (along <= primitive.size[1] / 2 + tolerance).all()
        )
    beyond = np.maximum(along - primitive.size[1] / 2, 0.0)
    return bool((np.hypot(radial, beyond) <= primitive.size[0] + 1e-6).all())


def test_an_angle_bracket_is_no_primitive() -> None:
    bracket = trimesh.util.concatenate(
        [
            trimesh.creation.box((4.0, 0.2, 0.2)),
            trimesh.creation.box((0.2, 4.0, 0.2), trimesh.transformations.translation_matrix((1.9, 1.9, 0.0))),
        ]
    )
    assert fit_primitive(shape_of(bracket)) is None


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_flat_and_tiny_shapes_are_no_primitive() -> None:
    flat = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]], process=False)
    assert fit_primitive(shape_of(flat)) is None
    assert fit_primitive(shape_of(trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 1, 2]]))) is None
