"""The scene tree: nodes with and without meshes, their pivots, and what becomes of them on the way."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdSkel, Vt
from test_cad_gltf import BOX, FACES, document, packed

from kit.cadfiles import fbx as cad_fbx
from kit.cadfiles.blend import blend, is_here
from kit.cadfiles.exports import ITEMS, WRITERS, Meshes
from kit.cadfiles.step import rotation, translation
from yellowiron.alignment.assignment.unit_scale import scaled
from yellowiron.cad import read_cad, taken_apart
from yellowiron.kinematics.start import Start, started
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, Node
from yellowiron.model.template import Template

pytestmark = pytest.mark.usefixtures("read_here")
QUARTER = [0.0, 0.0, 0.70710678, 0.70710678]


def named(assembly: Assembly) -> dict[str, tuple[int, Node]]:
    return {node.name: (number, node) for number, node in enumerate(assembly.nodes)}


def chain(assembly: Assembly, number: int | None) -> list[str]:
    return [assembly.nodes[n].name for n in reversed(assembly.nodes_above(number))]


def rigged() -> tuple[dict[str, Any], bytes]:
    """A boom below an empty below a bone, with another bone that nothing hangs on."""
    content, blob = document()
    content["nodes"] = [
        {"name": "ROOT", "children": [1], "scale": [2.0, 2.0, 2.0]},
        {"name": "BoomBone", "children": [2, 4], "translation": [1.0, 0.0, 0.5], "rotation": QUARTER},
        {"name": "BoomEmpty", "children": [3], "translation": [1.0, 0.0, 0.0]},
        {"name": "BOOM", "mesh": 0},
        {"name": "ArmBone", "translation": [3.0, 0.0, 0.0]},
        {"name": "Lamp"},
    ]
    content["scenes"] = [{"nodes": [0, 5]}]
    content["skins"] = [{"joints": [1, 4]}]
    return content, blob


@pytest.fixture
def boom(tmp_path: Path) -> Assembly:
    path = tmp_path / "machine.glb"
    path.write_bytes(packed(*rigged()))
    return read_cad(path)


def test_gltf_nodes(boom: Assembly) -> None:
    assert [(n.name, n.parent, n.bone) for n in boom.nodes] == [
        ("ROOT", None, False), ("BoomBone", 0, True), ("BoomEmpty", 1, False), ("BOOM", 2, False),
        ("ArmBone", 1, True), ("Lamp", None, False),
    ]  # fmt: skip
    assert boom.parts[0].node == 3
    assert boom.nodes_above(3) == (3, 2, 1, 0)
    np.testing.assert_allclose(boom.nodes[1].origin, (2.0, 0.0, 1.0), atol=1e-6)
    np.testing.assert_allclose(boom.nodes[2].origin, (2.0, 2.0, 1.0), atol=1e-6)
    np.testing.assert_allclose(boom.nodes[4].origin, (2.0, 6.0, 1.0), atol=1e-6)
    np.testing.assert_allclose(boom.nodes[3].transform, boom.parts[0].transform, atol=1e-12)


def test_place_that_is_no_number(tmp_path: Path) -> None:
    content, blob = rigged()
    content["nodes"][4]["translation"] = [1e308, 1e308, float("inf")]
    path = tmp_path / "machine.glb"
    path.write_bytes(packed(content, blob))
    nodes = named(read_cad(path))
    np.testing.assert_array_equal(nodes["ArmBone"][1].transform, nodes["BoomBone"][1].transform)


def test_other_unit(boom: Assembly) -> None:
    larger = scaled(boom, 3.0)
    np.testing.assert_allclose(larger.nodes[4].origin, (6.0, 18.0, 3.0), atol=1e-5)
    np.testing.assert_allclose(larger.nodes[4].transform[:3, :3], boom.nodes[4].transform[:3, :3])


def test_taken_apart(tmp_path: Path) -> None:
    content, blob = rigged()
    content["meshes"] = [{"primitives": [content["meshes"][0]["primitives"][0], content["meshes"][1]["primitives"][0]]}]
    far = (BOX * np.array([0.1, 0.1, 2.0]) + np.array([5.0, 0.0, 0.0])).astype("<f4")
    path = tmp_path / "machine.glb"
    path.write_bytes(packed(content, BOX.tobytes() + far.tobytes() + FACES.tobytes() + blob[264:]))
    assembly = taken_apart(read_cad(path))
    assert [p.name for p in assembly.parts] == ["BOOM", "BOOM"]
    assert [p.node for p in assembly.parts] == [3, 3]
    assert len(assembly.nodes) == 6


def test_folder(tmp_path: Path) -> None:
    for name in ("one.glb", "two.glb"):
        (tmp_path / name).write_bytes(packed(*rigged()))
    assembly = read_cad(tmp_path)
    assert [p.node for p in assembly.parts] == [3, 9]
    assert chain(assembly, 9) == ["ROOT", "BoomBone", "BoomEmpty", "BOOM"]
    assert assembly.nodes[6].parent is None


def test_nodes_move_with_their_bodies(boom: Assembly) -> None:
    """A start pose moves a node with the parts that it carries, and one without parts with its parent."""
    move = translation(0.0, 0.0, 7.0)
    alignment = Alignment("excavator", np.eye(4), (PartAssignment(boom.parts[0].id, "boom", "boom", 1.0, ""),))
    template = Template("excavator", "", "boom", (), ())
    moved, _, _ = started(boom, template, alignment, Start({}, {"boom": move}, ()))
    np.testing.assert_allclose(moved.nodes[3].transform, move @ boom.nodes[3].transform)
    np.testing.assert_allclose(moved.nodes[2].transform, boom.nodes[2].transform)


@pytest.mark.parametrize("binary", [False, True])
def test_fbx_pivots_and_bones(binary: bool, tmp_path: Path) -> None:
    """A node turns about its rotation pivot; what moves its mesh alone does not move the node."""
    turn = rotation((0, 0, 1), 0.5)
    pivot = {"RotationPivot": (30.0, 0.0, 10.0)}
    objects = [
        cad_fbx.model(10, "BoomBone", translation(100.0, 0.0, 50.0), mesh=False, bone=True),
        cad_fbx.model(11, "BOOM", turn, mesh=True, further={**pivot, "GeometricTranslation": (0.0, 7.0, 0.0)}),
        cad_fbx.model(12, "ARM", translation(0.0, 0.0, 20.0), mesh=True),
        cad_fbx.geometry(20, BOX.astype(float) * 100.0, FACES.astype(np.int64)),
    ]
    path = tmp_path / "machine.fbx"
    cad_fbx.write(path, objects, [(10, 0), (11, 10), (12, 11), (20, 11), (20, 12)], binary=binary)
    assembly = read_cad(path)
    assert [(n.name, n.parent, n.bone) for n in assembly.nodes] == [
        ("BoomBone", None, True), ("BOOM", 0, False), ("ARM", 1, False),
    ]  # fmt: skip
    assert [p.node for p in assembly.parts] == [1, 2]
    np.testing.assert_allclose(assembly.nodes[0].origin, (1.0, 0.0, 0.5), atol=1e-6)
    np.testing.assert_allclose(assembly.nodes[1].origin, (1.3, 0.0, 0.6), atol=1e-6)
    at = translation(0.3, 0.0, 0.1)
    outer = translation(1.0, 0.0, 0.5) @ at @ turn @ np.linalg.inv(at)
    arm = outer @ translation(0.0, 0.0, 0.2)
    np.testing.assert_allclose(assembly.nodes[2].transform, arm, atol=1e-6)
    low = np.min(assembly.points_of(assembly.parts[1]), axis=0)
    np.testing.assert_allclose(low, (BOX @ arm[:3, :3].T + arm[:3, 3]).min(axis=0), atol=1e-6)
    drawn = (BOX + np.array([0.0, 0.07, 0.0])) @ outer[:3, :3].T + outer[:3, 3]
    np.testing.assert_allclose(np.min(assembly.points_of(assembly.parts[0]), axis=0), drawn.min(axis=0), atol=1e-6)


def test_fbx_of_loose_edges(tmp_path: Path) -> None:
    """A mesh without a face is no reason to read nothing."""
    objects = [
        cad_fbx.model(10, "BOOM", np.eye(4), mesh=True),
        cad_fbx.model(11, "Vert", translation(10.0, 0.0, 0.0), mesh=True),
        cad_fbx.geometry(20, BOX.astype(float) * 100.0, FACES.astype(np.int64)),
        cad_fbx.geometry(21, BOX.astype(float) * 100.0, np.zeros((0, 3), dtype=np.int64)),
    ]
    cad_fbx.write(tmp_path / "m.fbx", objects, [(10, 0), (11, 0), (20, 10), (21, 11)], binary=True)
    assembly = read_cad(tmp_path / "m.fbx")
    assert [p.name for p in assembly.parts] == ["BOOM"]
    assert [n.name for n in assembly.nodes] == ["BOOM", "Vert"]


def test_usd_pivots_and_skeletons(tmp_path: Path) -> None:
    stage = Usd.Stage.CreateNew(str(tmp_path / "machine.usda"))
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    frame = UsdGeom.Xform.Define(stage, "/MACHINE/FRAME")
    frame.AddTranslateOp().Set(Gf.Vec3d(100.0, 0.0, 0.0))
    cube = UsdGeom.Cube.Define(stage, "/MACHINE/FRAME/BOOM")
    cube.CreateSizeAttr(40.0)
    api = UsdGeom.XformCommonAPI(cube)
    api.SetTranslate(Gf.Vec3d(0.0, 50.0, 0.0))
    api.SetPivot(Gf.Vec3f(10.0, 0.0, 0.0))
    api.SetRotate(Gf.Vec3f(0.0, 0.0, 90.0))
    skeleton = UsdSkel.Skeleton.Define(stage, "/MACHINE/Rig")
    skeleton.CreateJointsAttr(Vt.TokenArray(["Boom", "Boom/Arm"]))
    places = [Gf.Matrix4d(1.0).SetTranslate(Gf.Vec3d(x, 0.0, 20.0)) for x in (10.0, 30.0)]
    skeleton.CreateBindTransformsAttr(Vt.Matrix4dArray(places))
    stage.Save()
    assembly = read_cad(tmp_path / "machine.usda")
    nodes = named(assembly)
    number, boom = nodes["BOOM"]
    np.testing.assert_allclose(boom.origin, (1.1, 0.5, 0.0), atol=1e-7)
    assert assembly.parts[0].node == number
    # The prim's own origin is turned about the pivot.
    np.testing.assert_allclose(assembly.points_of(assembly.parts[0]).mean(axis=0), (1.1, 0.4, 0.0), atol=1e-7)
    assert chain(assembly, nodes["Arm"][0]) == ["MACHINE", "Rig", "Boom", "Arm"] or chain(
        assembly, nodes["Arm"][0]
    ) == ["Rig", "Boom", "Arm"]
    assert nodes["Arm"][1].bone
    np.testing.assert_allclose(nodes["Arm"][1].origin, (0.3, 0.0, 0.2), atol=1e-7)


def test_collada_joints(tmp_path: Path, boxes: Meshes) -> None:
    path = tmp_path / "machine.dae"
    WRITERS["COLLADA"][1](path, boxes)
    text = path.read_text(encoding="utf-8")
    node = '<node id="hip" name="Hip" type="JOINT"><translate>100 0 0</translate></node></visual_scene>'
    path.write_text(text.replace("</visual_scene>", node), encoding="utf-8")
    hip = named(read_cad(path))["Hip"][1]
    assert hip.bone
    np.testing.assert_allclose(hip.origin, (1.0, 0.0, 0.0), atol=1e-6)


def test_collada_with_drawn_edges(tmp_path: Path, boxes: Meshes) -> None:
    """As SketchUp exports them: the library refused the whole file."""
    path = tmp_path / "machine.dae"
    WRITERS["COLLADA"][1](path, boxes)
    plain = read_cad(path)
    text = path.read_text(encoding="utf-8")
    source = re.search(r'<vertices id="([^"]+)"', text)
    assert source
    given = f'<input offset="0" semantic="VERTEX" source="#{source.group(1)}"/><p>0 1</p>'
    edges = f'<lines count="1">{given}</lines><lines count="0"/><linestrips count="1">{given}</linestrips></mesh>'
    path.write_text(text.replace("</mesh>", edges, 1), encoding="utf-8")
    drawn = read_cad(path)
    assert [p.id for p in drawn.parts] == [p.id for p in plain.parts]
    assert [len(drawn.shape_of(p).mesh.triangles) for p in drawn.parts] == [12] * len(plain.parts)


@pytest.fixture
def boxes() -> Meshes:
    return {item.shape: (BOX.astype(float), FACES.astype(np.int64)) for item in ITEMS}


@pytest.mark.parametrize("name", ["GLB", "glTF", "COLLADA", "FBX (text)", "FBX (binary)", "USD (usda)", "Blender"])
def test_every_scene_format_keeps_its_tree(name: str, tmp_path: Path, boxes: Meshes) -> None:
    if name == "Blender" and not is_here():
        pytest.skip("Blender is not here")
    file, write = ("machine.blend", blend) if name == "Blender" else WRITERS[name]
    write(tmp_path / file, boxes)
    assembly = read_cad(tmp_path / file)
    assert [chain(assembly, p.node)[-1 - len(p.path) :] for p in assembly.parts] == [
        [*p.path, p.name] for p in assembly.parts
    ]
    for part in assembly.parts:
        assert part.node is not None
        np.testing.assert_allclose(assembly.nodes[part.node].transform, part.transform, atol=1e-6)
    assert all(n.parent is None or n.parent < k for k, n in enumerate(assembly.nodes))
    assert json.dumps([n.name for n in assembly.nodes], ensure_ascii=False).count("铲斗") == 1
