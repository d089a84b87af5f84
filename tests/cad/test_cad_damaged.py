"""Files that lie, are cut short, or lead elsewhere: told in one sentence or a finding."""

from __future__ import annotations

import functools
import struct
import subprocess
import sys
import time
import zipfile
from dataclasses import replace
from pathlib import Path

import ezdxf
import numpy as np
import pytest

import yellowiron.cad
from kit.cadfiles import blend as cad_blend
from kit.cadfiles.exports import ITEMS, WRITERS
from kit.packages import install_package
from yellowiron import cli
from yellowiron.cad import formats, read_cad
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.support.guard import run_guarded

BOX = np.array([[x, y, z] for x in (0.0, 0.4) for y in (0.0, 0.3) for z in (0.0, 0.2)])
FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                  [0, 6, 4], [1, 5, 7], [1, 7, 3]])  # fmt: skip


def outcome(path: Path) -> Assembly | CadError:
    """The assembly, or the one sentence that says why there is none."""
    try:
        return read_cad(path, timeout_s=60, memory_mb=3000)
    except CadError as error:
        assert error.where and error.hint and "\n" not in error.message
        return error


def codes(path: Path) -> set[str]:
    found = outcome(path)
    return {"refused"} if isinstance(found, CadError) else {f.code for f in found.findings}


def sound(name: str, folder: Path) -> Path:
    """The formats' small machine, its shapes boxes."""
    file, write = WRITERS[name]
    write(folder / file, {item.shape: (BOX, FACES) for item in ITEMS})
    return folder / file


@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_flipped_bytes(seed: int, tmp_path: Path) -> None:
    """Open CASCADE crashes on many of them: in its own process."""
    path = sound("STEP", tmp_path)
    data = bytearray(path.read_bytes())
    rng = np.random.default_rng(seed)
    for at in rng.integers(len(data) // 2, len(data), 40):
        data[at] ^= 1 << int(rng.integers(8))
    path.write_bytes(data)
    assert codes(path)


@pytest.mark.usefixtures("read_here")
def test_a_step_file_with_bytes_that_are_no_text(tmp_path: Path) -> None:
    """What they have overwritten may have been a part's place in the tree."""
    path = sound("STEP", tmp_path)
    data = path.read_bytes()
    at = data.rindex(b"= NEXT_ASSEMBLY_USAGE_OCCURRENCE")
    path.write_bytes(data[:at] + bytes(20) + data[at + 20 :])
    assert codes(path) & {"CAD001", "refused"}
    path.write_bytes(data + bytes(20))
    assert not codes(path)


@pytest.mark.usefixtures("read_here")
def test_an_ifc_that_is_cut_short(tmp_path: Path) -> None:
    pytest.importorskip("ifcopenshell")
    path = sound("IFC", tmp_path)
    path.write_bytes(path.read_bytes()[: -len("END-ISO-10303-21;") - 200])
    assert codes(path) == {"refused"}


@pytest.mark.usefixtures("read_here")
def test_an_iges_with_a_damaged_entity(tmp_path: Path) -> None:
    path = sound("IGES", tmp_path)
    path.write_text(path.read_text().replace("     186 ", "     1x6 ", 1))
    assert "CAD001" in codes(path)


@pytest.mark.parametrize(
    ("mark", "damage", "says"),
    [
        ("T0000001", "", "truncated"),
        ("\n110,", "\n1\0\0,", "is no text"),
        (",7.874015748,", ",7.8740e308,", "no coordinate"),
    ],
)
@pytest.mark.slow
def test_an_iges_that_open_cascade_would_not_survive(mark: str, damage: str, says: str, tmp_path: Path) -> None:
    path = sound("IGES", tmp_path)
    text = path.read_text()
    assert mark in text
    path.write_text(text.replace(mark, damage, 1))
    found = outcome(path)
    assert isinstance(found, CadError) and says in found.message


@pytest.mark.usefixtures("read_here")
def test_indices_that_are_no_numbers(tmp_path: Path) -> None:
    path = sound("COLLADA", tmp_path)
    text = path.read_text()
    assert "<p>0 " in text
    path.write_text(text.replace("<p>0 ", "<p>x ", 1))
    found = outcome(path)
    assert isinstance(found, CadError) and "no whole number" in found.message


@pytest.mark.usefixtures("read_here")
@pytest.mark.parametrize("name", ["OBJ", "PLY", "3MF", "COLLADA"])
def test_points_that_are_no_numbers(name: str, tmp_path: Path) -> None:
    path = sound(name, tmp_path)
    unit = {"OBJ": "400", "PLY": "0.4", "3MF": "15.748031496", "COLLADA": "40"}[name]
    text = path.read_bytes() if name != "3MF" else zipfile.ZipFile(path).read("3D/3dmodel.model")
    mark = b'"' if name == "3MF" else b" "
    damaged = text.replace(mark + unit.encode(), mark + b"nan", 1)
    assert damaged != text
    if name == "3MF":
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("3D/3dmodel.model", damaged)
    else:
        path.write_bytes(damaged)
    assert codes(path) & {"CAD001", "CAD003", "refused"}


def test_an_archive_that_would_fill_the_memory(tmp_path: Path) -> None:
    path = sound("3MF", tmp_path)
    data = bytearray(path.read_bytes())
    at = data.index(b"3D/3dmodel.model", data.index(b"PK\x01\x02")) - 46
    data[at + 24 : at + 28] = struct.pack("<I", 3_000_000_000)
    path.write_bytes(data)
    assert codes(path) == {"refused"}


@pytest.mark.usefixtures("read_here")
def test_an_archive_that_leads_elsewhere(tmp_path: Path) -> None:
    folder = tmp_path / "a" / "b"
    folder.mkdir(parents=True)
    path = folder / "evil.usdz"
    cube = b'#usda 1.0\n(metersPerUnit = 1)\ndef Cube "c" {}\ndef "e" (references = @../../evil.usda@</c>) {}\n'
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in (("machine.usda", cube), ("../../evil.usda", b'#usda 1.0\ndef Cube "c" {}\n')):
            archive.writestr(zipfile.ZipInfo(name), text)
    before = sorted(p for p in tmp_path.rglob("*"))
    outcome(path)
    assert sorted(p for p in tmp_path.rglob("*")) == before
    assert not (tmp_path.parent / "evil.usda").exists()


@pytest.mark.usefixtures("read_here")
def test_a_usd_reference_that_leads_nowhere(tmp_path: Path) -> None:
    path = tmp_path / "machine.usda"
    path.write_text('#usda 1.0\n(metersPerUnit = 1)\ndef Cube "frame" {}\ndef "boom" (references = @gone.usda@) {}\n')
    assert "CAD008" in codes(path)


@pytest.mark.usefixtures("read_here")
def test_parts_without_a_name_and_of_one_name(tmp_path: Path) -> None:
    path = tmp_path / "machine.usda"
    cubes = "".join(f'def Xform "a{k}" (\ndisplayName = "PIN"\n)\n{{\ndef Cube "mesh" {{}}\n}}\n' for k in range(3))
    path.write_text(f"#usda 1.0\n(metersPerUnit = 1)\n{cubes}")
    read = outcome(path)
    assert isinstance(read, Assembly)
    assert len({p.id for p in read.parts}) == len(read.parts) == 3
    assert {p.name for p in read.parts} == {"PIN"}


@pytest.mark.usefixtures("read_here")
def test_entities_of_an_ifc_that_are_lost_are_told(tmp_path: Path) -> None:
    """IfcOpenShell passes over an entity whose name is damaged; a `#` in a string is no reference."""
    pytest.importorskip("ifcopenshell")
    path = tmp_path / "machine.ifc"
    WRITERS["IFC"][1](path, {item.shape: (BOX, FACES) for item in ITEMS})
    sound = path.read_text().replace("'PIN'", "'PIN #4711'")
    path.write_text(sound)
    assert [f.code for f in read_cad(path).findings] == []
    path.write_text(sound.replace("IFCBUILDINGELEMENTPROXY", "IFCBUILDINGELEMENTPRXY", 1))
    read = read_cad(path)
    assert len(read.parts) == len(ITEMS) - 1
    assert "CAD001" in [f.code for f in read.findings]


@pytest.mark.usefixtures("read_here")
@pytest.mark.parametrize("name", ["FBX (text)", "FBX (binary)"])
def test_a_node_of_an_fbx_that_is_lost_is_told(name: str, tmp_path: Path) -> None:
    """What hangs below it is still there."""
    path = sound(name, tmp_path)
    data = path.read_bytes()
    mark = (
        b'Model: 12,"Model::PIN","Mesh"'
        if name == "FBX (text)"
        else b"ModelL\x0c" + bytes(7) + b"S\n\0\0\0PIN\0\x01Model"
    )
    assert mark in data
    path.write_bytes(data.replace(mark, mark.replace(b"Model", b"Modal"), 1))
    assert "CAD001" in codes(path)


@pytest.mark.usefixtures("read_here")
def test_a_node_of_a_gltf_that_says_what_it_should_not(tmp_path: Path) -> None:
    path = sound("glTF", tmp_path)
    text = path.read_text()
    path.write_text(text.replace('"mesh": 1', '"mash": 1', 1))
    assert "CAD001" in codes(path)


@pytest.mark.usefixtures("read_here")
def test_a_usd_prim_whose_reference_brings_nothing(tmp_path: Path) -> None:
    path = tmp_path / "machine.usda"
    head = '#usda 1.0\n(metersPerUnit = 1)\ndef Cube "a" {}\n'
    path.write_text(head + 'class "gone" {}\ndef Xform "b" (prepend references = </gone>) {}\n')
    assert "CAD001" in codes(path)
    path.write_text(head + 'def Xform "b" (references = None) {}\n')
    assert not codes(path)


@pytest.mark.usefixtures("read_here")
@pytest.mark.parametrize("form", ["asc", "bin"])
def test_entities_of_a_dxf_that_are_lost_are_told(form: str, tmp_path: Path) -> None:
    """ezdxf passes over an entity of no known kind."""
    path = sound("DXF", tmp_path)
    ezdxf.readfile(path).saveas(path, fmt=form)
    data = path.read_bytes()
    at = data.rindex(b"INSERT")
    path.write_bytes(data[:at] + b"INSXRT" + data[at + 6 :])
    assert "CAD001" in codes(path)


@pytest.mark.usefixtures("read_here")
def test_a_binary_dxf(tmp_path: Path) -> None:
    path = sound("DXF", tmp_path)
    ezdxf.readfile(path).saveas(path, fmt="bin")
    read = read_cad(path)
    assert len(read.parts) == len(ITEMS) and not read.findings
    data = path.read_bytes()
    path.write_bytes(data[: len(data) // 2])
    assert codes(path) == {"refused"}


def stl_text(folder: Path) -> Path:
    """Two boxes as the text of an STL file."""
    text = ""
    for number, name in enumerate(("BOOM", "PIN")):
        facets = "".join(
            "facet normal 0 0 0\nouter loop\n"
            + "".join(f"vertex {x + number} {y} {z}\n" for x, y, z in BOX[face])
            + "endloop\nendfacet\n"
            for face in FACES
        )
        text += f"solid {name}\n{facets}endsolid {name}\n"
    path = folder / "machine.stl"
    path.write_text(text)
    return path


@pytest.mark.usefixtures("read_here")
def test_an_stl_text_that_is_cut_short(tmp_path: Path) -> None:
    """Its first solid has an end."""
    path = stl_text(tmp_path)
    text = path.read_text()
    assert codes(path) == {"CAD009"}
    path.write_text(text[: text.rindex("facet")])
    assert codes(path) == {"refused"}
    path.write_text(text.replace("endfacet", "endfcaet", 1))
    assert codes(path) & {"CAD001", "refused"}


@pytest.mark.usefixtures("read_here")
def test_an_obj_that_is_cut_short(tmp_path: Path) -> None:
    """The format has no end; points without faces show it."""
    path = sound("OBJ", tmp_path)
    text = path.read_text()
    assert codes(path) == {"CAD009"}
    head, _, tail = text.rpartition("\no ")
    for short in (head + "\no PIN\n", head + "\no " + tail[: tail.index("\nf ")], text.replace("\nf ", "\nd ", 1)):
        path.write_text(short)
        assert "CAD001" in codes(path)


@pytest.mark.usefixtures("read_here")
def test_a_ply_that_has_other_lines_than_it_says(tmp_path: Path) -> None:
    path = sound("PLY", tmp_path)
    lines = path.read_text().splitlines(keepends=True)
    assert codes(path) == {"CAD009"}
    for damaged in (lines[:-5], [*lines[:20], *lines[19:]]):
        path.write_text("".join(damaged))
        assert "CAD001" in codes(path)


@pytest.mark.parametrize(
    ("name", "target"),
    [
        ("STEP", "step:read_step"),
        pytest.param("IGES", "iges:read_iges", marks=pytest.mark.slow),
        pytest.param("BREP", "brep_file:read_brep", marks=pytest.mark.slow),
        pytest.param("FreeCAD", "freecad:read_freecad", marks=pytest.mark.slow),
    ],
)
@pytest.mark.slow
def test_what_is_worked_on_for_ever_is_ended(name: str, target: str, tmp_path: Path) -> None:
    """By processor time, long before the guard's own limit: one sentence with a hint."""
    path = sound(name, tmp_path)
    module, function = target.split(":")
    code = (
        f"from yellowiron.cad.readers.exact import {module}, patience\n"
        "patience.SECONDS = patience.TEXT_SECONDS = 1.0\n"
        "patience.BYTES_A_SECOND = 1e9\n"
        "def go_on(*_, **__):\n    while True: pass\n"
        f"{module}.products.assemble = go_on\n"
        f"{module}.{function}({str(path)!r})\n"
    )
    start = time.monotonic()
    with pytest.raises(CadError, match="came to no end") as caught:
        run_guarded("builtins:exec", code, where=str(path), error=CadError, timeout_s=120.0)
    assert time.monotonic() - start < 60.0
    assert caught.value.hint and caught.value.where == str(path)


@pytest.mark.usefixtures("read_here")
@pytest.mark.parametrize(
    ("part", "mark", "damage"),
    [
        ("Document.xml", '<Link value="Boom"/>', '<Link value="Bo0m"/>'),
        ("Document.xml", '<Object name="Boom"><', '<Object name="Bo0m"><'),
        ("Document.xml", '"Shape"><Part file="Boom.brp"', '"Shap"><Part file="Boom.brp"'),
        ("Document.xml", '<XLink name="Pin"/>', '<XLink name="Pim"/>'),
        ("GuiDocument.xml", '<Bool value="true"/>', '<Bool value="trve"/>'),
    ],
)  # fmt: skip
def test_objects_of_a_freecad_file_that_are_lost_are_told(part: str, mark: str, damage: str, tmp_path: Path) -> None:
    path = sound("FreeCAD", tmp_path)
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    assert mark.encode() in members[part]
    members[part] = members[part].replace(mark.encode(), damage.encode(), 1)
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    assert "CAD001" in codes(path)


@pytest.mark.usefixtures("read_here")
def test_a_group_of_an_unknown_kind_holds_what_it_holds(tmp_path: Path) -> None:
    path = sound("FreeCAD", tmp_path)
    data = path.read_bytes()
    assert data.count(b'type="App::Part"') == 1
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    members["Document.xml"] = members["Document.xml"].replace(b"App::Part", b"App::Stock")
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    read = read_cad(path)
    assert len(read.parts) == len(ITEMS) and not read.findings


def test_what_a_blender_file_links_to_and_is_not_there(tmp_path: Path) -> None:
    if not cad_blend.is_here():
        pytest.skip("bpy (the extra blender) is not here")
    script = (
        "import bpy, sys\n"
        "bpy.ops.wm.read_factory_settings(use_empty=True)\n"
        "bpy.ops.mesh.primitive_cube_add(); bpy.context.object.name = 'BOOM'\n"
        "bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1] + '/library.blend')\n"
        "bpy.ops.wm.read_factory_settings(use_empty=True)\n"
        "bpy.ops.mesh.primitive_cube_add(); bpy.context.object.name = 'FRAME'\n"
        "with bpy.data.libraries.load(sys.argv[1] + '/library.blend', link=True) as (_, linked):\n"
        "    linked.objects = ['BOOM']\n"
        "bpy.context.scene.collection.objects.link(linked.objects[0])\n"
        "bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1] + '/machine.blend')\n"
    )
    subprocess.run([sys.executable, "-c", script, str(tmp_path)], check=True, capture_output=True)
    path = tmp_path / "machine.blend"
    assert sorted(p.name for p in read_cad(path).parts) == ["BOOM", "FRAME"] and not codes(path)
    (tmp_path / "library.blend").unlink()
    assert codes(path) == {"CAD008"}


def test_a_blender_file_that_is_damaged(tmp_path: Path) -> None:
    """What Blender passes over, it says only in its log."""
    if not cad_blend.is_here():
        pytest.skip("bpy (the extra blender) is not here")
    path = tmp_path / "machine.blend"
    cad_blend.blend(path, {item.shape: (BOX, FACES) for item in ITEMS})
    data = path.read_bytes()
    assert len(read_cad(path).parts) == len(ITEMS) and not codes(path)
    # Two blocks of one address.
    first = data.index(b"DATA", 5000)
    second = data.index(b"DATA", first + 4)
    path.write_bytes(data[: second + 8] + data[first + 8 : first + 16] + data[second + 16 :])
    assert codes(path) & {"CAD001", "refused"}


@pytest.mark.parametrize(
    ("body", "says", "limit"),
    [("with must_end(1.0):\n        work()", "no end", 120.0), ("work()", "more than 2 s", 2.0)],
)
@pytest.mark.slow
def test_a_reader_that_goes_on_for_ever_is_one_sentence(
    body: str,
    says: str,
    limit: float,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """By its own limit or by the guard's: the program ends with code 2."""
    work = "def work():\n    while True: pass\n"
    text = f"from yellowiron.support.limits import must_end\n\n{work}\ndef read(path):\n    {body}\n"
    install_package(
        tmp_path / "site", monkeypatch, name="endless", group="yellowiron.tests",
        entries={"it": "reader_without_end:read"}, modules={"reader_without_end": text},
    )  # fmt: skip
    endless = tuple(replace(f, reader="reader_without_end:read") if f.name == "OBJ" else f for f in formats.FORMATS)
    monkeypatch.setattr(formats, "FORMATS", endless)
    monkeypatch.setattr(yellowiron.cad, "read_cad", functools.partial(read_cad, timeout_s=limit))
    path = sound("OBJ", tmp_path)
    monkeypatch.setattr(sys, "argv", ["yellowiron", "convert", str(path), "--out", str(tmp_path / "machine.usda")])
    monkeypatch.setattr("signal.signal", lambda *_: None)
    with pytest.raises(SystemExit) as ended:
        cli.main()
    assert ended.value.code == 2
    said = " ".join(capsys.readouterr().err.split())
    assert says in said and "hint:" in said and "Traceback" not in said
    assert not (tmp_path / "machine.usda").exists()


@pytest.mark.usefixtures("read_here")
def test_what_is_lost_of_a_robot_s_mesh_and_of_a_folder_s_file_is_told(tmp_path: Path) -> None:
    """The files are read through another one."""
    path = sound("OBJ", tmp_path)
    robot = tmp_path / "machine.urdf"
    robot.write_text(
        '<robot name="machine"><link name="frame"><visual><geometry>'
        '<mesh filename="machine.obj" scale="1e-3 1e-3 1e-3"/></geometry></visual></link></robot>'
    )
    assert not codes(robot) & {"CAD001", "refused"}
    text = path.read_text()
    path.write_text(text[: text.index("\nf ", text.rindex("\no "))])
    assert "CAD001" in codes(robot)
    robot.unlink()
    assert "CAD001" in codes(tmp_path)
