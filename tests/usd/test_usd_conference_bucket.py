"""The conference paper's own example: the bucket body and its six bolts move as one, said by JSON-1 to JSON-4 in the
names of the CAD parts."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
import trimesh
from pxr import Gf, Usd, UsdGeom, UsdPhysics, UsdShade
from usd_shapes import ACROSS, at, make_shape, open_box, round_shape

from yellowiron.library import apply_joints, load_documents, with_relations
from yellowiron.mechanism import build_mechanism
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Role, Template
from yellowiron.usd import read_mechanism, write_machine

BOLTS = [f"bucket bolt{number}" for number in range(1, 7)]

JSON_1 = {
    "bucket body": {
        "density": 7850,
        "elasticity": 2.1e11,
        "static friction": 0.6,
        "dynamic friction": 0.5,
        "restitution": 0.1,
        "color": "#FFCD11",
        "texture": "rust.png",
        "roughness": 0.7,
        "metalness": 0.2,
    },
    "bucket bolt*": {"name": "zinc", "density": 7130, "color": "#C0C0C0", "metalness": 1.0},
}
JSON_2 = {"bucket body": "convexDecomposition", "bucket bolt*": "none", "arm beam": "convexHull"}
JSON_3 = {"bucket": ["bucket body", *BOLTS]}
JSON_4 = {
    "arm2bucket_joint": {
        "joint_type": "Revolute",
        "Body": ["arm", "bucket_pin"],
        "Limit": [-30, 60],
        "Drive": ["Angular Drive"],
        "stiffness": 2.0e5,
        "damping": 1.0e4,
        "max_force": 3.0e5,
    }
}


@pytest.fixture(scope="module")
def assembly() -> Assembly:
    shapes = {
        "beam": make_shape("arm beam", trimesh.creation.box((3.0, 0.4, 0.4))),
        "bucket": open_box("bucket body"),
        "bolt": round_shape("bolt", 0.02, 0.1),
        "pin": round_shape("pin", 0.05, 0.6),
    }
    places = {
        "arm beam": ("beam", at(-1.5, 0.0, 1.0)),
        "bucket pin": ("pin", at(0.0, 0.0, 1.0, turn=ACROSS)),
        "bucket body": ("bucket", at(0.6, 0.0, 0.6)),
        **{bolt: ("bolt", at(0.2 + 0.1 * i, 0.9, 0.6)) for i, bolt in enumerate(BOLTS)},
    }
    parts = [
        Part(f"EXCAVATOR/{name}", name, ("EXCAVATOR",), shapes[shape].key, place, (0.1, 0.1, 0.9))
        for name, (shape, place) in places.items()
    ]
    return Assembly("EXCAVATOR", "step", 0.001, tuple(parts), {s.key: s for s in shapes.values()})


@pytest.fixture(scope="module")
def folder(assembly: Assembly, tmp_path_factory: pytest.TempPathFactory) -> Path:
    from PIL import Image

    data = tmp_path_factory.mktemp("data")
    Image.new("RGB", (2, 2), (120, 60, 30)).save(data / "rust.png")
    paths = []
    for number, document in enumerate((JSON_1, JSON_2, JSON_3, JSON_4), start=1):
        paths.append(data / f"json-{number}.json")
        paths[-1].write_text(json.dumps(document))
    roles = (
        Role("arm", None, True),
        Role("bucket", "arm", True),
        Role("bucket_pin", "bucket", False, kind="pin"),
    )
    template = Template("excavator", "", "arm", roles, ())
    documents = load_documents(paths, template, assembly)
    assert not documents.findings
    said = with_relations(None, documents)
    assert said is not None
    solved = [
        PartAssignment("EXCAVATOR/arm beam", "arm", "arm", 1.0, "the rest"),
        PartAssignment("EXCAVATOR/bucket pin", "bucket_pin", "bucket", 1.0, "a pin"),
    ]
    mechanism = build_mechanism(
        assembly,
        apply_joints(template, documents),
        Alignment("excavator", np.eye(4), (*solved, *said.parts)),
        Specifications(),
        name="bucket example",
        documents=documents,
    )
    out = tmp_path_factory.mktemp("out")
    write_machine(mechanism, assembly, out, name="bucket", texture_folders=documents.folders)
    return out


@pytest.fixture(scope="module")
def stage(folder: Path) -> Usd.Stage:
    return Usd.Stage.Open(str(folder / "bucket.usda"))


def test_json_3_the_bolts_are_in_the_buckets_rigid_body(stage: Usd.Stage) -> None:
    bucket = stage.GetPrimAtPath("/bucket/bucket")
    assert bucket.HasAPI(UsdPhysics.RigidBodyAPI)
    parts = [p.GetCustomDataByKey("yellowiron:part") for p in bucket.GetChild("visuals").GetChildren()]
    assert set(parts) == {f"EXCAVATOR/{name}" for name in ("bucket pin", "bucket body", *BOLTS)}
    assert sum(p.HasAPI(UsdPhysics.RigidBodyAPI) for p in stage.Traverse()) == 2


def test_json_1_materials_show_and_weigh(stage: Usd.Stage, assembly: Assembly, folder: Path) -> None:
    mesh = stage.GetPrimAtPath("/bucket/bucket/visuals/bucket_body/mesh")
    shader = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()[0].ComputeSurfaceSource()[0]
    assert shader.GetInput("roughness").Get() == pytest.approx(0.7)
    assert shader.GetInput("metallic").Get() == pytest.approx(0.2)
    assert shader.GetInput("diffuseColor").HasConnectedSource()
    assert (folder / "payloads" / "textures" / "rust.png").is_file()
    bolt = stage.GetPrimAtPath("/bucket/bucket/visuals/bucket_bolt1/mesh")
    shader = UsdShade.MaterialBindingAPI(bolt).ComputeBoundMaterial()[0].ComputeSurfaceSource()[0]
    grey = ((0xC0 / 255 + 0.055) / 1.055) ** 2.4
    assert np.allclose(shader.GetInput("diffuseColor").Get(), [grey] * 3, atol=1e-6)
    material = UsdPhysics.MaterialAPI(stage.GetPrimAtPath("/bucket/materials/bucket_body"))
    assert material.GetDensityAttr().Get() == 7850.0
    assert material.GetStaticFrictionAttr().Get() == pytest.approx(0.6)
    assert material.GetPrim().GetAttribute("yellowiron:elasticity").Get() == pytest.approx(2.1e11)
    arm = UsdPhysics.MassAPI(stage.GetPrimAtPath("/bucket/arm")).GetMassAttr().Get()
    assert arm == pytest.approx(3.0 * 0.4 * 0.4 * 7850.0)


def test_json_2_colliders(stage: Usd.Stage) -> None:
    colliders = {p.GetName(): p for p in stage.GetPrimAtPath("/bucket/bucket/colliders").GetChildren()}
    assert not any("bolt" in name for name in colliders)
    pieces = colliders["bucket_body"].GetChildren()
    tokens = {p.GetName(): UsdPhysics.MeshCollisionAPI(p).GetApproximationAttr().Get() for p in pieces}
    assert tokens.pop("mesh") == "convexDecomposition"
    assert len(tokens) > 1 and set(tokens.values()) == {"convexHull"}


def test_json_4_joint_and_drive(stage: Usd.Stage) -> None:
    prim = stage.GetPrimAtPath("/bucket/joints/arm2bucket_joint")
    joint = UsdPhysics.RevoluteJoint(prim)
    assert joint.GetBody0Rel().GetTargets() == ["/bucket/arm"]
    assert joint.GetBody1Rel().GetTargets() == ["/bucket/bucket"]
    assert joint.GetLowerLimitAttr().Get() == pytest.approx(-30.0)
    assert joint.GetUpperLimitAttr().Get() == pytest.approx(60.0)
    anchor = UsdGeom.XformCache().GetLocalToWorldTransform(stage.GetPrimAtPath("/bucket/bucket"))
    assert np.allclose(anchor.Transform(Gf.Vec3d(joint.GetLocalPos1Attr().Get())), (0.0, 0.0, 1.0), atol=1e-6)


def test_json_4_gains(stage: Usd.Stage) -> None:
    prim = stage.GetPrimAtPath("/bucket/joints/arm2bucket_joint")
    drive = UsdPhysics.DriveAPI(prim, "angular")
    assert drive.GetStiffnessAttr().Get() == pytest.approx(2.0e5 * math.pi / 180)
    assert drive.GetDampingAttr().Get() == pytest.approx(1.0e4 * math.pi / 180)
    assert drive.GetMaxForceAttr().Get() == pytest.approx(3.0e5)


def test_it_reads_back(folder: Path) -> None:
    mechanism = read_mechanism(folder / "scene.usda")
    assert {part.part for part in mechanism.body("bucket").parts} >= {f"EXCAVATOR/{bolt}" for bolt in BOLTS}
