"""How much memory a file's reader may take: by its format, unpacked, with the files that it names."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from yellowiron.cad.formats import FORMATS
from yellowiron.cad.need import need_mb
from yellowiron.cad.recognition import format_of

FACTOR = {known.name: known.memory for known in FORMATS}
MEGABYTE = 1 << 20


def need(file: Path) -> int:
    return need_mb(file, format_of(file))


def test_by_its_format_and_size(tmp_path: Path) -> None:
    for name, head, kind in (("a.step", b"ISO-10303-21;", "STEP"), ("a.obj", b"v 0 0 0\n", "OBJ"),
                             ("a.fbx", b"Kaydara FBX", "FBX")):  # fmt: skip
        (tmp_path / name).write_bytes(head.ljust(10 * MEGABYTE, b" "))
        assert need(tmp_path / name) == 1 + 10 * FACTOR[kind]


def test_an_archive_counts_unpacked(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "a.3mf", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("3D/3dmodel.model", bytes(10 * MEGABYTE))
    assert (tmp_path / "a.3mf").stat().st_size < 20_000
    assert need(tmp_path / "a.3mf") == 1 + 10 * FACTOR["3MF"]


@pytest.mark.parametrize("extension", ["KHR_draco_mesh_compression", "EXT_meshopt_compression"])
def test_compressed_triangles_are_more_than_their_bytes(extension: str, tmp_path: Path) -> None:
    for name, text in (("a.gltf", '{"a": "KHR_lights"}'), ("b.gltf", f'{{"a": "{extension}"}}')):
        (tmp_path / name).write_text(text.ljust(10 * MEGABYTE))
    assert need(tmp_path / "a.gltf") == 1 + 10 * FACTOR["glTF"]
    assert need(tmp_path / "b.gltf") == 1 + 80 * FACTOR["glTF"]


@pytest.mark.parametrize("place", ["robot", "robot/meshes", "meshes"])
def test_files_that_it_names_count(place: str, tmp_path: Path) -> None:
    for folder in ("robot", place):
        (tmp_path / folder).mkdir(parents=True, exist_ok=True)
    for name in ("arm.stl", "other.stl"):
        (tmp_path / place / name).write_bytes(bytes(10 * MEGABYTE))
    (tmp_path / "robot" / "a.urdf").write_text('<robot name="r"><mesh filename="package://r/arm.stl"/></robot>')
    assert need(tmp_path / "robot" / "a.urdf") == 1 + 10 * FACTOR["URDF"]


def test_a_folder_is_all_its_files(tmp_path: Path) -> None:
    (tmp_path / "a.step").write_bytes(b"ISO-10303-21;".ljust(10 * MEGABYTE))
    (tmp_path / "a.txt").write_bytes(bytes(50 * MEGABYTE))
    (tmp_path / "b.obj").write_bytes(b"v 0 0 0\n".ljust(5 * MEGABYTE))
    assert need_mb(tmp_path, None) == 1 + 10 * FACTOR["STEP"] + 5 * FACTOR["OBJ"]
