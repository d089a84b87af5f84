"""GLB and glTF: the tree, instances, colours, and files that are broken, cut short or ask for other files."""

from __future__ import annotations

import base64
import json
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from yellowiron.cad import read_cad
from yellowiron.model.errors import CadError

pytestmark = pytest.mark.usefixtures("read_here")

BOX = np.array([[x, y, z] for x in (0.0, 0.4) for y in (0.0, 0.3) for z in (0.0, 0.2)], dtype="<f4")
FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
     [1, 5, 7], [1, 7, 3]], dtype="<u2",
)  # fmt: skip
PIN = BOX * np.array([0.1, 0.1, 2.0], dtype="<f4")


def document() -> tuple[dict[str, Any], bytes]:
    """A machine of a frame with two equal pins, one of them turned and scaled, and a painted plate."""
    blob = BOX.tobytes() + PIN.tobytes() + FACES.tobytes()
    accessor = {"componentType": 5126, "type": "VEC3", "count": 8}
    box = [{"attributes": {"POSITION": 0}, "indices": 2, "material": 0}]
    pin = [{"attributes": {"POSITION": 1}, "indices": 2}]
    plate = [{**box[0]}, {"attributes": {"POSITION": 1}, "indices": 2, "material": 1}]
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"name": "MACHINE", "nodes": [0]}],
        "nodes": [
            {"name": "ASSY", "children": [1, 2, 3, 4], "translation": [1.0, 0.0, 0.0]},
            {"name": "Rahmen", "mesh": 0},
            {"name": "PIN", "mesh": 1},
            {"name": "PIN", "mesh": 1, "rotation": [0.0, 0.0, 0.70710678, 0.70710678], "scale": [2.0, 2.0, 2.0]},
            {"name": "", "mesh": 2, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1]},
        ],
        "meshes": [{"primitives": box}, {"primitives": pin}, {"name": "板", "primitives": plate}],
        "materials": [
            {"pbrMetallicRoughness": {"baseColorFactor": [1.0, 0.6, 0.0, 1.0]}},
            {"pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.1, 0.1, 1.0]}},
        ],
        "accessors": [
            {**accessor, "bufferView": 0},
            {**accessor, "bufferView": 1},
            {"componentType": 5123, "type": "SCALAR", "count": 36, "bufferView": 2},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 96},
            {"buffer": 0, "byteOffset": 96, "byteLength": 96},
            {"buffer": 0, "byteOffset": 192, "byteLength": 72},
        ],
        "buffers": [{"byteLength": len(blob)}],
    }, blob


def packed(content: dict[str, Any], blob: bytes) -> bytes:
    text = json.dumps(content).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(blob), len(text), 0x4E4F534A)
    return head + text + struct.pack("<II", len(blob), 0x004E4942) + blob


def fail(path: Path) -> CadError:
    with pytest.raises(CadError) as caught:
        read_cad(path, timeout_s=60, memory_mb=3000)
    assert caught.value.where
    assert caught.value.hint
    assert "\n" not in caught.value.message
    return caught.value


@pytest.fixture
def write(tmp_path: Path) -> Callable[..., Path]:
    def written(content: dict[str, Any], blob: bytes, name: str = "machine.glb") -> Path:
        path = tmp_path / name
        path.write_bytes(packed(content, blob))
        return path

    return written


def test_tree_instances_colours(write: Callable[..., Path]) -> None:
    assembly = read_cad(write(*document()))
    assert (assembly.name, assembly.format, assembly.unit) == ("MACHINE", "glTF", 1.0)
    assert [p.id for p in assembly.parts] == ["ASSY/Rahmen", "ASSY/PIN", "ASSY/PIN#2", "ASSY/板"]
    assert len(assembly.shapes) == 3
    frame, one, other, plate = assembly.parts
    assert one.shape == other.shape
    assert np.allclose(one.transform[:3, 3], (1.0, 0.0, 0.0))
    assert np.allclose(other.transform[:3, :3] @ (1.0, 0.0, 0.0), (0.0, 2.0, 0.0), atol=1e-6)
    assert np.allclose(plate.transform[:3, 3], (1.0, 0.0, 5.0))
    assert frame.color == (1.0, 0.6, 0.0)
    colors = assembly.shape_of(plate).mesh.triangle_colors
    assert colors is not None
    assert np.allclose(colors[[0, -1]], [(1.0, 0.6, 0.0), (0.1, 0.1, 0.1)])
    shape = assembly.shape_of(frame)
    assert shape.closed
    assert not shape.exact
    assert shape.volume == pytest.approx(0.4 * 0.3 * 0.2, rel=1e-6)
    assert len(shape.planes) == 6
    assert assembly.declared_occurrences == 4
    assert not assembly.findings


def test_inside_out_is_turned(write: Callable[..., Path]) -> None:
    content, blob = document()
    assembly = read_cad(write(content, blob[:192] + FACES[:, ::-1].tobytes()))
    assert assembly.shape_of(assembly.parts[0]).volume == pytest.approx(0.024, rel=1e-6)
    normals = {tuple(np.round(p.normal).tolist()): p.point for p in assembly.shape_of(assembly.parts[0]).planes}
    assert normals[1.0, 0.0, 0.0][0] == pytest.approx(0.4)


def test_text_with_a_file_beside_it(tmp_path: Path) -> None:
    content, blob = document()
    (tmp_path / "machine 1.bin").write_bytes(blob)
    content["buffers"][0]["uri"] = "machine%201.bin"
    path = tmp_path / "machine.gltf"
    path.write_text(json.dumps(content))
    assert len(read_cad(path).parts) == 4
    content["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(blob).decode()
    path.write_text(json.dumps(content))
    assert len(read_cad(path).parts) == 4


@pytest.mark.parametrize(
    "uri", ["../secret.bin", "%2e%2e/secret.bin", "/etc/passwd", "file:///etc/passwd", "..\\secret.bin"]
)
def test_no_file_outside_of_its_folder(uri: str, tmp_path: Path) -> None:
    content, blob = document()
    (tmp_path / "secret.bin").write_bytes(blob)
    folder = tmp_path / "inner"
    folder.mkdir()
    content["buffers"][0]["uri"] = uri
    path = folder / "machine.gltf"
    path.write_text(json.dumps(content))
    assert "outside of its folder" in fail(path).message


def test_missing_file(tmp_path: Path) -> None:
    content, _ = document()
    content["buffers"][0]["uri"] = "gone.bin"
    path = tmp_path / "machine.gltf"
    path.write_text(json.dumps(content))
    assert "missing: 'gone.bin'" in fail(path).message


@pytest.mark.parametrize("keep", [0.05, 0.3, 0.9, 0.999])
def test_truncated(keep: float, tmp_path: Path) -> None:
    whole = packed(*document())
    path = tmp_path / "cut.glb"
    path.write_bytes(whole[: int(len(whole) * keep)])
    assert "truncated" in fail(path).message


def test_lying_counts(write: Callable[..., Path]) -> None:
    content, blob = document()
    content["accessors"][0]["count"] = 4_000_000_000
    assembly = read_cad(write(content, blob))
    assert [p.name for p in assembly.parts] == ["PIN", "PIN", "板"]
    assert {f.code for f in assembly.findings} == {"CAD001", "CAD003"}
    for accessor in content["accessors"]:
        accessor["count"] = 3_000_000_000
    assert "fewer" in fail(write(content, blob)).message


def test_corner_that_is_not_there(write: Callable[..., Path]) -> None:
    content, blob = document()
    faces = FACES.copy()
    faces[3, 1] = 999
    assert "not finite" in fail(write(content, blob[:192] + faces.tobytes())).message


@pytest.mark.parametrize(
    ("value", "says"), [(np.nan, "not finite"), (np.inf, "not finite"), (1e30, "large"), (1e6, "large")]
)
def test_absurd_coordinates(value: float, says: str, write: Callable[..., Path]) -> None:
    content, blob = document()
    box = BOX.copy()
    box[2, 1] = value
    assembly = read_cad(write(content, box.tobytes() + blob[96:]))
    assert {"CAD001", "CAD003"} <= {f.code for f in assembly.findings}
    assert any(says in f.message for f in assembly.findings)
    assert [p.name for p in assembly.parts] == ["PIN", "PIN"]


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda d: d["nodes"][1].update(children=[0]), "hangs in it twice"),
        (lambda d: d["nodes"][0]["children"].append(99), "not there"),
        (lambda d: d["nodes"][1].update(mesh=7), "not there"),
        (lambda d: d["nodes"][1].update(matrix=[1, 2, 3]), "placement"),
        (lambda d: d["nodes"][3].update(rotation=[0, 0, 0, 0]), "placement"),
        (lambda d: d.update(extensionsRequired=["ACME_wire_geometry"]), "needs ACME_wire_geometry"),
        (lambda d: d.update(asset={"version": "1.0"}), "version 2"),
        (lambda d: d.update(meshes=[{}, {}, {}]), "no triangles"),
        (lambda d: d.update(nodes=[], scenes=[{"nodes": []}]), "no triangles"),
        (lambda d: d.update(buffers=[{"byteLength": 10**9}]), "truncated"),
    ],
)
def test_broken(change: Callable[[dict[str, Any]], None], says: str, write: Callable[..., Path]) -> None:
    content, blob = document()
    change(content)
    assert says in fail(write(content, blob)).message


def test_not_a_number_of_a_place(write: Callable[..., Path]) -> None:
    content, blob = document()
    content["nodes"][1]["translation"] = [float("nan"), 0, 0]
    content["nodes"][2]["scale"] = [1, 0, 1]
    assembly = read_cad(write(content, blob))
    assert [p.name for p in assembly.parts] == ["PIN", "板"]
    assert [f.code for f in assembly.findings] == ["CAD003", "CAD003", "CAD001"]


@pytest.mark.parametrize(
    "content", [b"glTF", b"glTF\x02\x00\x00\x00", b"glTF\x01\x00\x00\x00" + bytes(40), b"{}", b"{nonsense", b"[" * 9999]
)
def test_no_document(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "machine.gltf"
    path.write_bytes(content)
    fail(path)


@pytest.mark.parametrize("seed", range(5))
def test_flipped_bytes(seed: int, tmp_path: Path) -> None:
    """Reads, or says why not; never anything else."""
    random = np.random.default_rng(seed)
    whole = bytearray(packed(*document()))
    for place in random.integers(0, len(whole), 6):
        whole[place] = random.integers(0, 256)
    path = tmp_path / "flipped.glb"
    path.write_bytes(bytes(whole))
    try:
        assembly = read_cad(path, timeout_s=60, memory_mb=3000)
    except CadError as error:
        assert error.hint
    else:
        for part in assembly.parts:
            assert np.isfinite(assembly.points_of(part)).all()


def test_meshes_outside_the_scene_are_told(write: Callable[..., Path]) -> None:
    content, blob = document()
    content["nodes"][0]["children"].remove(4)
    assembly = read_cad(write(content, blob))
    assert len(assembly.parts) == 3
    assert [f.code for f in assembly.findings if f.severity == "warning"] == ["CAD001"]


def test_a_mesh_that_lost_its_triangles_is_told(write: Callable[..., Path]) -> None:
    content, blob = document()
    content["meshes"][2]["primitivgs"] = content["meshes"][2].pop("primitives")
    assembly = read_cad(write(content, blob))
    assert len(assembly.parts) == 3
    assert "declares 4" in next(f.message for f in assembly.findings if f.code == "CAD001")


def appended(content: dict[str, Any], blob: bytes, values: Any, component: int, kind: str) -> tuple[int, bytes]:
    """The number of a new accessor, and the buffer with its numbers."""
    data = values.tobytes()
    view = {"buffer": 0, "byteOffset": len(blob), "byteLength": len(data)}
    content["bufferViews"].append(view)
    entry = {
        "componentType": component,
        "type": kind,
        "count": len(values),
        "bufferView": len(content["bufferViews"]) - 1,
    }
    content["accessors"].append(entry)
    blob += data + b"\0" * (-len(data) % 4)
    content["buffers"][0]["byteLength"] = len(blob)
    return len(content["accessors"]) - 1, blob


def skinned() -> tuple[dict[str, Any], bytes]:
    """Two boxes in one mesh, a bone to each: the arm's is drawn at the origin, bound 1 m along X, and stands turned by
    90 degrees about Z at (3, 0, 0); the frame's stands where it is drawn."""
    content, blob = document()
    content["nodes"] = [
        {"name": "Armature", "children": [1, 3], "translation": [0.0, 0.0, 0.0]},
        {"name": "FRAME", "children": [2]},
        {"name": "ARM", "translation": [3.0, 0.0, 0.0], "rotation": [0.0, 0.0, 0.70710678, 0.70710678]},
        # The place of a skinned mesh's own node says nothing.
        {"name": "Object_7", "mesh": 0, "skin": 0, "translation": [50.0, 60.0, 70.0], "scale": [9.0, 9.0, 9.0]},
    ]
    points = np.concatenate([BOX, BOX + np.array([1.0, 0.0, 0.0], dtype="<f4")])
    faces = np.concatenate([FACES, FACES + 8]).astype("<u2")
    bones = np.zeros((16, 4), dtype="<u1")
    bones[8:, 0] = 1
    bones[:8, 1] = 1
    weights = np.tile(np.array([255, 0, 0, 0], dtype="<u1"), (16, 1))
    inverse = np.tile(np.eye(4, dtype="<f4"), (2, 1, 1))
    inverse[1, 0, 3] = -1.0
    position, blob = appended(content, blob, points, 5126, "VEC3")
    indices, blob = appended(content, blob, faces.reshape(-1), 5123, "SCALAR")
    joints, blob = appended(content, blob, bones, 5121, "VEC4")
    shares, blob = appended(content, blob, weights, 5121, "VEC4")
    content["accessors"][shares]["normalized"] = True
    binds, blob = appended(content, blob, inverse.transpose(0, 2, 1).copy(), 5126, "MAT4")
    attributes = {"POSITION": position, "JOINTS_0": joints, "WEIGHTS_0": shares}
    content["meshes"] = [{"primitives": [{"attributes": attributes, "indices": indices, "material": 0}]}]
    content["skins"] = [{"joints": [1, 2], "inverseBindMatrices": binds}]
    return content, blob


def extents(assembly: Any, name: str) -> tuple[Any, Any]:
    part = next(p for p in assembly.parts if p.name == name)
    points = assembly.shapes[part.shape].mesh.points @ part.transform[:3, :3].T + part.transform[:3, 3]
    return points.min(axis=0), points.max(axis=0)


def test_a_skinned_mesh_is_a_part_for_each_bone(write: Callable[..., Path]) -> None:
    assembly = read_cad(write(*skinned()))
    assert [(p.name, p.path) for p in assembly.parts] == [
        ("FRAME", ("Armature", "FRAME")),
        ("ARM", ("Armature", "FRAME", "ARM")),
    ]
    assert not [f for f in assembly.findings if f.severity == "error"]
    np.testing.assert_allclose(extents(assembly, "FRAME"), [[0.0, 0.0, 0.0], [0.4, 0.3, 0.2]], atol=1e-6)
    # (x, y, z) of the box, turned by 90 degrees about Z: (3 - y, x, z).
    np.testing.assert_allclose(extents(assembly, "ARM"), [[2.7, 0.0, 0.0], [3.0, 0.4, 0.2]], atol=1e-6)
    nodes = [assembly.nodes[p.node].name for p in assembly.parts if p.node is not None]
    assert nodes == ["FRAME", "ARM"]


def test_a_mesh_of_one_bone_keeps_its_name(write: Callable[..., Path]) -> None:
    content, blob = skinned()
    content["nodes"][3]["name"] = "Boom plate"
    content["skins"][0]["joints"] = [2, 2]
    assembly = read_cad(write(content, blob))
    assert [(p.name, p.path[-1]) for p in assembly.parts] == [("Boom plate", "ARM")]


@pytest.mark.parametrize("damage", ["no bones", "a bone that is not there", "weights below zero", "short binds"])
def test_a_broken_skin_leaves_the_mesh_at_its_node(write: Callable[..., Path], damage: str) -> None:
    content, blob = skinned()
    attributes = content["meshes"][0]["primitives"][0]["attributes"]
    if damage == "no bones":
        del attributes["JOINTS_0"]
    elif damage == "a bone that is not there":
        content["skins"][0]["joints"] = [1, 77]
    elif damage == "weights below zero":
        attributes["WEIGHTS_0"], blob = appended(content, blob, -np.ones((16, 4), dtype="<f4"), 5126, "VEC4")
    else:
        content["accessors"][content["skins"][0]["inverseBindMatrices"]]["count"] = 1
    assembly = read_cad(write(content, blob))
    assert len(assembly.parts) == 1
    assert any(f.code == "CAD003" and "skin" in f.message for f in assembly.findings)


def test_sparse_numbers(write: Callable[..., Path]) -> None:
    """A box whose upper corners are written as changes, and one that is nothing but changes."""
    content, blob = document()
    low = BOX.copy()
    low[:, 2] = 0.0
    rows = np.flatnonzero(BOX[:, 2] > 0.0).astype("<u2")
    whole, blob = appended(content, blob, low, 5126, "VEC3")
    places, blob = appended(content, blob, rows, 5123, "SCALAR")
    values, blob = appended(content, blob, BOX[rows], 5126, "VEC3")
    every, blob = appended(content, blob, np.arange(8, dtype="<u1"), 5121, "SCALAR")
    views = [content["accessors"][n]["bufferView"] for n in (places, values, every)]
    sparse = {
        "count": 4,
        "indices": {"bufferView": views[0], "componentType": 5123},
        "values": {"bufferView": views[1]},
    }
    content["accessors"][whole]["sparse"] = sparse
    content["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = whole
    only = {"count": 8, "indices": {"bufferView": views[2], "componentType": 5121}, "values": {"bufferView": 1}}
    content["accessors"][1] = {"componentType": 5126, "type": "VEC3", "count": 8, "sparse": only}
    assembly = read_cad(write(content, blob))
    assert not [f for f in assembly.findings if f.severity == "error"]
    np.testing.assert_allclose(extents(assembly, "Rahmen"), [[1.0, 0.0, 0.0], [1.4, 0.3, 0.2]], atol=1e-6)
    np.testing.assert_allclose(extents(assembly, "PIN"), [[1.0, 0.0, 0.0], [1.04, 0.03, 0.4]], atol=1e-6)


@pytest.mark.parametrize("mode", [5, 6])
def test_strips_and_fans(write: Callable[..., Path], mode: int) -> None:
    """The four corners of a box's floor, as a strip and as a fan: two triangles that look the same way."""
    content, blob = document()
    corners = np.array([0, 2, 4, 6] if mode == 5 else [0, 2, 6, 4], dtype="<u2")
    number, blob = appended(content, blob, corners, 5123, "SCALAR")
    plate = {"attributes": {"POSITION": 0}, "indices": number, "mode": mode}
    content["meshes"][0]["primitives"].append(plate)
    assembly = read_cad(write(content, blob))
    mesh = next(assembly.shapes[p.shape].mesh for p in assembly.parts if p.name == "Rahmen")
    assert len(mesh.triangles) == 14
    a, b, c = (mesh.points[mesh.triangles[12:, k]] for k in range(3))
    np.testing.assert_allclose(np.cross(b - a, c - a), [[0.0, 0.0, -0.12]] * 2, atol=1e-6)
