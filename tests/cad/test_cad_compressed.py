"""Compressed glTF: Draco and meshopt, quantised positions, extensions that a file may and may not need.

The meshopt streams were made from the arrays that stand beside them, by the reference encoder (meshoptimizer 0.2.30a0,
vertices of version 0, indices of version 1)."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_cad_gltf import BOX, FACES, document, fail, packed

from yellowiron.cad import read_cad
from yellowiron.cad.readers.meshes import meshopt

pytestmark = pytest.mark.usefixtures("read_here")

BOX_STREAM = bytes.fromhex(
    "a00100c00000650100c00000670100c00000670100c000007c010ccc0000cbcccb010ccc0000cdcecd010ccc0000cdcecd010ccc0000"
    "7c7b7c013fff000065666566656665013fff000067686768676867013fff000098979897989798013fff00007c7b7c7b7c7b7c000000"
    "0000000000000000000000000000000000000000000000000000000000"
)
FACES_STREAM = bytes.fromhex("e1fe00ff0f0716a102071391050f06ff02040203007687566778a9866589689801690000")
SEQUENCE_STREAM = bytes.fromhex("d10004080a0c020808040a0c0612100412140e0404101214021608101618060a100816180e00000000")
GRID_STREAM = bytes.fromhex(
    "a0152aaaaaaaaaaaaaaaaaaa8000001f0002060a0e12161a1e22262a2e32363a3e42464a4e52565a5e62666a6e72767affffc0007e82"
    "868a8e92969a9e1480020080808080001f004a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4affffc0004a"
    "4a4a4a4a4a4a4a4a0000000000000000000000000000000000000000000000000000000000000000000300"
)
MIXED_STREAM = bytes.fromhex(
    "e1ffffffffffffffffffffffffffffffffffffffffffffffffff38041eff186d0cff520e53ff0844356f1101ff121c0bff350764f40b"
    "0aff1402021f01041f01041f01041f01041f01041f01041f0104ff311a67ff4c331ef32e4dff0d144ef7410a2f2f3eff1326312c1e00"
    "7687566778a9866589689801690000"
)
MIXED = [
    28, 30, 45, 57, 2, 8, 49, 56, 14, 18, 52, 25, 16, 49, 15, 24, 38, 32, 5, 1, 51, 45, 50, 32, 60, 61, 62, 61, 62, 63,
    62, 63, 64, 63, 64, 65, 64, 65, 66, 65, 66, 67, 66, 67, 68, 67, 68, 69, 44, 57, 5, 43, 17, 32, 55, 16, 43, 9, 19,
    58, 25, 30, 17, 6, 25, 37, 27, 46, 21, 36, 46, 55,
]  # fmt: skip


def indices(stream: bytes, mode: str, count: int) -> list[int]:
    found: list[int] = np.frombuffer(meshopt.decoded(stream, mode=mode, count=count, stride=4), "<u4").tolist()
    return found


def turned(triangles: list[int]) -> list[list[int]]:
    """Triangles with their smallest corner first: where a triangle begins is the encoder's."""
    rows = np.array(triangles).reshape(-1, 3)
    return [np.roll(row, -int(row.argmin())).tolist() for row in rows]


def test_meshopt_streams() -> None:
    assert meshopt.decoded(BOX_STREAM, mode="ATTRIBUTES", count=8, stride=12) == BOX.tobytes()
    n = np.arange(41)
    grid = np.stack([n, n**2, n * 37 % 256, np.full(41, 3)], axis=1).astype("<u2")
    assert meshopt.decoded(GRID_STREAM, mode="ATTRIBUTES", count=41, stride=8) == grid.tobytes()
    assert turned(indices(FACES_STREAM, "TRIANGLES", 36)) == turned(FACES.reshape(-1).tolist())
    assert indices(SEQUENCE_STREAM, "INDICES", 36) == FACES.reshape(-1).tolist()
    assert indices(MIXED_STREAM, "TRIANGLES", 72) == MIXED
    short = meshopt.decoded(SEQUENCE_STREAM, mode="INDICES", count=36, stride=2)
    assert np.frombuffer(short, "<u2").tolist() == FACES.reshape(-1).tolist()


@pytest.mark.parametrize(
    ("stream", "mode", "count", "stride"),
    [(BOX_STREAM, "ATTRIBUTES", 8, 12), (FACES_STREAM, "TRIANGLES", 36, 4), (SEQUENCE_STREAM, "INDICES", 36, 4)],
)
def test_meshopt_damage(stream: bytes, mode: str, count: int, stride: int) -> None:
    for keep in range(0, len(stream) // 2, 5):
        with pytest.raises(ValueError, match=r"cut short|version|length"):
            meshopt.decoded(stream[:keep], mode=mode, count=count, stride=stride)
    for broken in ({"mode": "SOUP"}, {"count": -1}, {"count": 1 << 40}, {"stride": 0}, {"stride": 300}):
        with pytest.raises(ValueError, match=r"known|broken"):
            meshopt.decoded(stream, **{"mode": mode, "count": count, "stride": stride, **broken})  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="version"):
        meshopt.decoded(bytes([stream[0] + 1]) + stream[1:], mode=mode, count=count, stride=stride)


def test_meshopt_filters() -> None:
    """m · 2^e; and a unit quaternion whose largest number is left out, its place in the last two bits."""
    raw = np.array([(-3 << 24) | 20, (2 << 24) | (0xFFFFFF & -7)], dtype=np.int64).astype("<u4").tobytes()
    values = np.frombuffer(meshopt.filtered(raw, filter="EXPONENTIAL", stride=4), "<f4")
    assert values.tolist() == [2.5, -28.0]
    q = np.array([0.1, -0.3, np.sqrt(1 - 0.14), 0.2])  # the third is left out
    step = 32767
    rest = np.round(np.array([q[3], q[0], q[1]]) * np.sqrt(2.0) * (step | 3)).astype(int)
    stored = np.array([*rest, (step & ~3) | 2], dtype="<i2").tobytes()
    found = np.frombuffer(meshopt.filtered(stored, filter="QUATERNION", stride=8), "<i2") / 32767.0
    np.testing.assert_allclose(found, q, atol=1e-3)
    assert meshopt.filtered(b"\1\2\3\4", filter="OCTAHEDRAL", stride=4) == b"\1\2\3\4"


def squeezed(*, required: bool = True) -> tuple[dict[str, Any], bytes]:
    """The machine of `document`, its box and faces compressed as gltfpack does it: beside an empty stand-in."""
    content, blob = document()
    blob += BOX_STREAM + FACES_STREAM
    start = 264
    views = content["bufferViews"]
    for number, (stream, kind, count, stride) in {
        0: (BOX_STREAM, "ATTRIBUTES", 8, 12), 2: (FACES_STREAM, "TRIANGLES", 36, 2),
    }.items():  # fmt: skip
        packed_in = {
            "buffer": 0, "byteOffset": start, "byteLength": len(stream), "byteStride": stride, "mode": kind,
            "count": count,
        }  # fmt: skip
        views[number] = {
            "buffer": 1, "byteOffset": 0, "byteLength": count * stride,
            "extensions": {"EXT_meshopt_compression": packed_in},
        }  # fmt: skip
        start += len(stream)
    fallback = {"byteLength": 200, "extensions": {"EXT_meshopt_compression": {"fallback": True}}}
    content["buffers"] = [{"byteLength": len(blob)}, fallback]
    content["extensionsUsed"] = ["EXT_meshopt_compression"]
    if required:
        content["extensionsRequired"] = ["EXT_meshopt_compression"]
    return content, blob


@pytest.mark.parametrize("required", [True, False])
def test_meshopt_file(required: bool, tmp_path: Path) -> None:
    (tmp_path / "plain.glb").write_bytes(packed(*document()))
    (tmp_path / "small.glb").write_bytes(packed(*squeezed(required=required)))
    plain, small = read_cad(tmp_path / "plain.glb"), read_cad(tmp_path / "small.glb")
    assert [p.id for p in small.parts] == [p.id for p in plain.parts]
    for one, other in zip(small.parts, plain.parts, strict=True):
        assert small.shape_of(one).volume == pytest.approx(plain.shape_of(other).volume, rel=1e-9)
        np.testing.assert_allclose(one.transform, other.transform)
    assert not small.findings


def test_meshopt_file_that_is_damaged(tmp_path: Path) -> None:
    content, blob = squeezed()
    (tmp_path / "small.glb").write_bytes(packed(content, blob[:264] + b"\xff" + blob[265:]))
    read = read_cad(tmp_path / "small.glb")
    assert [p.name for p in read.parts] == ["PIN", "PIN", "板"]
    assert any("buffer view 0: its attributes are of a version" in f.message for f in read.findings)
    for key, value in (("count", "x"), ("byteLength", 10**9), ("mode", None)):
        broken = copy.deepcopy(content)
        broken["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value
        (tmp_path / "small.glb").write_bytes(packed(broken, blob))
        assert "Compressed geometry is broken" in " ".join(f.message for f in read_cad(tmp_path / "small.glb").findings)


def test_quantised_positions(tmp_path: Path) -> None:
    """Positions as whole numbers of 16 bits, four to a row, that the node scales back (KHR_mesh_quantization)."""
    content, blob = document()
    steps = np.zeros((8, 4), dtype="<u2")
    steps[:, :3] = np.round(BOX / 0.4 * 65535.0)
    content["accessors"][0] |= {"componentType": 5123, "normalized": True}
    content["bufferViews"][0] |= {"byteLength": 64, "byteStride": 8}
    content["nodes"][1] |= {"scale": [0.4, 0.4, 0.4]}
    content["extensionsRequired"] = ["KHR_mesh_quantization"]
    (tmp_path / "small.glb").write_bytes(packed(content, steps.tobytes() + bytes(32) + blob[96:]))
    read = read_cad(tmp_path / "small.glb")
    points = read.points_of(read.parts[0])
    np.testing.assert_allclose([points.min(axis=0), points.max(axis=0)], [(1, 0, 0), (1.4, 0.3, 0.2)], atol=1e-5)


def dracoed() -> tuple[dict[str, Any], bytes]:
    DracoPy = pytest.importorskip("DracoPy")
    content, blob = document()
    stream = DracoPy.encode(BOX, FACES.astype(np.uint32), quantization_bits=16, preserve_order=False)
    attribute = next(a["unique_id"] for a in DracoPy.decode(stream).attributes if a["attribute_type"] == 0)
    content["bufferViews"].append({"buffer": 0, "byteOffset": len(blob), "byteLength": len(stream)})
    content["accessors"] += [{"componentType": 5126, "type": "VEC3", "count": 8}]
    content["accessors"] += [{"componentType": 5123, "type": "SCALAR", "count": 36}]
    content["meshes"][0]["primitives"][0] |= {
        "attributes": {"POSITION": 3},
        "indices": 4,
        "extensions": {"KHR_draco_mesh_compression": {"bufferView": 3, "attributes": {"POSITION": attribute}}},
    }
    content["extensionsUsed"] = content["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    blob += stream + bytes(-len(stream) % 4)
    content["buffers"][0]["byteLength"] = len(blob)
    return content, blob


def test_draco_file(tmp_path: Path) -> None:
    path = tmp_path / "small.glb"
    path.write_bytes(packed(*dracoed()))
    read = read_cad(path)
    assert [p.name for p in read.parts] == ["Rahmen", "PIN", "PIN", "板"]
    shape = read.shape_of(read.parts[0])
    assert shape.closed
    assert shape.volume == pytest.approx(0.024, rel=1e-3)
    assert read.parts[0].color == (1.0, 0.6, 0.0)
    assert not read.findings


def test_draco_file_that_is_damaged(tmp_path: Path) -> None:
    content, blob = dracoed()
    path = tmp_path / "small.glb"
    path.write_bytes(packed(content, blob[:264] + b"DRACOX" + blob[270:]))
    read = read_cad(path)
    assert [p.name for p in read.parts] == ["PIN", "PIN", "板"]
    assert any("compressed triangles are broken" in f.message for f in read.findings)
    for key, value in (("bufferView", 77), ("attributes", {"POSITION": 99}), ("attributes", None)):
        broken = copy.deepcopy(content)
        broken["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"][key] = value
        path.write_bytes(packed(broken, blob))
        assert "CAD003" in {f.code for f in read_cad(path).findings}


def test_draco_without_its_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Needed: one sentence that says what to install. Not needed: what stands beside it is read."""
    content, blob = document()
    content["meshes"][0]["primitives"][0]["extensions"] = {"KHR_draco_mesh_compression": {}}
    content["extensionsUsed"] = ["KHR_draco_mesh_compression"]
    path = tmp_path / "small.glb"
    monkeypatch.setitem(__import__("sys").modules, "DracoPy", None)
    path.write_bytes(packed(content, blob))
    assert len(read_cad(path).parts) == 4
    content["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    path.write_bytes(packed(content, blob))
    error = fail(path)
    assert "DracoPy" in error.message
    assert "pip install" in (error.hint or "")


@pytest.mark.parametrize(
    "name",
    [
        "KHR_texture_basisu",
        "MSFT_texture_dds",
        "KHR_materials_clearcoat",
        "KHR_lights_punctual",
        "EXT_texture_avif",
        "KHR_animation_pointer",
        "KHR_xmp_json_ld",
    ],
)
def test_what_only_looks_need(name: str, tmp_path: Path) -> None:
    content, blob = document()
    content["extensionsRequired"] = content["extensionsUsed"] = [name]
    (tmp_path / "m.glb").write_bytes(packed(content, blob))
    assert len(read_cad(tmp_path / "m.glb").parts) == 4


def test_what_is_not_needed(tmp_path: Path) -> None:
    content, blob = document()
    content["extensionsUsed"] = ["ACME_wire_geometry"]
    content["nodes"][1]["extensions"] = {"ACME_wire_geometry": {"x": [1, 2]}}
    (tmp_path / "m.gltf").write_text(json.dumps(content))
    content["buffers"][0]["uri"] = "m.bin"
    (tmp_path / "m.bin").write_bytes(blob)
    (tmp_path / "m.gltf").write_text(json.dumps(content))
    assert len(read_cad(tmp_path / "m.gltf").parts) == 4
