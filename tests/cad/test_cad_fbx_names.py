"""FBX files with names in the encodings that exporters of other languages write."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from kit.cadfiles import fbx as cad_fbx
from kit.machines.solids import box
from yellowiron.cad import read_cad
from yellowiron.cad.readers.meshes.fbx_mended import legible

NAMES = {b"AAAA": "动臂".encode("gbk"), b"BBBBBB": "挖掘机".encode("gbk")}
"""What a file that we can write says → what is said in its place, as many bytes long."""


def _drawn(path: Path, *, binary: bool) -> bytes:
    mesh = box("block", 2.0, 1.0, 0.5).mesh
    objects = [
        cad_fbx.geometry(1000, mesh.points, mesh.triangles), cad_fbx.material(1100, "paint", (1.0, 1.0, 1.0)),
        cad_fbx.texture(1200, "D:/BBBBBB/paint.png"), cad_fbx.model(10, "AAAA", np.eye(4), mesh=True),
    ]  # fmt: skip
    links = [(10, 0), (1000, 10), (1100, 10), (1200, 1100, "DiffuseColor")]
    cad_fbx.write(path, objects, links, binary=binary)
    data = path.read_bytes()
    assert all(name in data for name in NAMES)
    for name, other in NAMES.items():
        data = data.replace(name, other)
    path.write_bytes(data)
    return data


@pytest.mark.parametrize("binary", [True, False])
def test_names_in_gbk_are_read(binary: bool, tmp_path: Path) -> None:
    path = tmp_path / "digger.fbx"
    _drawn(path, binary=binary)
    assembly = read_cad(path)
    assert [part.name for part in assembly.parts] == ["动臂"]
    assert np.ptp(assembly.points_of(assembly.parts[0]), axis=0) == pytest.approx([0.02, 0.01, 0.005], rel=1e-6)
    assert "CAD010" in {finding.code for finding in assembly.findings}


def test_only_names_are_spelled_otherwise(tmp_path: Path) -> None:
    data = _drawn(tmp_path / "digger.fbx", binary=True)
    spelled, titles, encoding = legible(data)
    assert encoding == "gb18030"
    assert len(spelled) == len(data)
    assert "动臂" in titles.values()
    changed = {n for n, (one, other) in enumerate(zip(data, spelled, strict=True)) if one != other}
    names = {data.index(name) + k for name in NAMES.values() for k in range(len(name))}
    assert names <= changed
    assert all(data[n] >= 0x80 for n in changed)


@pytest.mark.parametrize("binary", [True, False])
def test_what_is_legible_stays_as_it_is(binary: bool, tmp_path: Path) -> None:
    path = tmp_path / "digger.fbx"
    cad_fbx.write(path, [cad_fbx.model(10, "Стрела 动臂", np.eye(4), mesh=False)], [(10, 0)], binary=binary)
    data = path.read_bytes()
    assert legible(data) == (data, {}, "utf-8")
