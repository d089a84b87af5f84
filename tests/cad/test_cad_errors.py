"""Files that are no CAD file, or a broken one: one sentence each, and no crash here."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import pytest
import trimesh

from kit.cadfiles.step import Node, Use, box, cylinder, moved, translation, write_step
from yellowiron.cad import read_cad
from yellowiron.cad.readers.exact import part21
from yellowiron.cad.readers.exact.brep_text import fault
from yellowiron.model.errors import CadError

pytestmark = pytest.mark.slow
HERE = pytest.mark.usefixtures("read_here")
"""For what is refused before, or whatever, Open CASCADE does with it; the others are read in a child process."""

OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(504)


def fail(path: Path) -> CadError:
    with pytest.raises(CadError) as caught:
        read_cad(path, timeout_s=30)
    error = caught.value
    assert error.where
    assert error.hint
    assert "\n" not in error.message
    return error


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    pin = Node("PIN", cylinder(20, 100))
    root = Node("ROOT", children=[Use(pin), Use(pin, translation(0, 0, 200)), Use(Node("PLATE", box(100, 50, 8)))])
    return write_step(tmp_path_factory.mktemp("cad") / "good.step", root).read_bytes()


@HERE
def test_no_such_file(tmp_path: Path) -> None:
    assert "no such" in fail(tmp_path / "none.step").message


@HERE
def test_folder(tmp_path: Path) -> None:
    assert "folder" in fail(tmp_path).message


@HERE
def test_empty(tmp_path: Path) -> None:
    (tmp_path / "empty.step").write_bytes(b"")
    assert "empty" in fail(tmp_path / "empty.step").message


@HERE
@pytest.mark.parametrize("content", [b"Dear reader,\n", bytes(range(256)) * 8, b"%PDF-1.7\n", b"\x89PNG\r\n"])
@pytest.mark.parametrize("suffix", [".step", ".dat", ""])
def test_not_cad(content: bytes, suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"file{suffix}"
    path.write_bytes(content)
    assert "not a STEP file" in fail(path).message or "no CAD file" in fail(path).message


@HERE
@pytest.mark.parametrize("keep", [0.3, 0.9, 0.999])
def test_truncated(keep: float, good: bytes, tmp_path: Path) -> None:
    path = tmp_path / "cut.step"
    path.write_bytes(good[: int(len(good) * keep)])
    assert "truncated" in fail(path).message


@HERE
def test_byte_order_mark(good: bytes, tmp_path: Path) -> None:
    path = tmp_path / "mark.step"
    path.write_bytes(b"\xef\xbb\xbf" + good)
    assert "byte-order mark" in fail(path).message


@HERE
@pytest.mark.parametrize(
    ("name", "content", "says"),
    [
        ("arm.sldprt", OLE, "SolidWorks"),
        ("arm.SLDASM", OLE + "SwDocMgr".encode("utf-16-le"), "SolidWorks"),
        ("arm.sldprt", bytes(range(200)), "SolidWorks"),
        ("arm.step", OLE + "SolidWorks".encode("utf-16-le"), "SolidWorks"),
        ("house.rvt", OLE, "Revit"),
        ("house", OLE + "BasicFileInfo".encode("utf-16-le"), "Revit"),
        ("arm.CATPart", b"V5_CFV2\x00\x00", "CATIA"),
        ("arm.ipt", OLE, "Inventor"),
        ("arm.jt", b"Version 9.5 JT  DM 6.4" + bytes(60), "JT"),
        ("arm.dgn", b"\x08\x09\xfe\x02" + bytes(50), "DGN"),
        ("arm.x_t", b"**ABCDEFGHIJKLMNOPQRSTUVWXYZ**", "Parasolid"),
        ("arm.prt", bytes(range(100)), "NX"),
    ],
)
def test_proprietary(name: str, content: bytes, says: str, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    error = fail(path)
    assert error.message.startswith("No open reader exists for")
    assert says in error.message
    assert "export to" in error.message and "2. " in error.hint


@HERE
@pytest.mark.parametrize(
    ("name", "content", "says"),
    [
        ("a.igs", b" " * 72 + b"S      1\n", "IGES"),
        ("a.fbx", b"Kaydara FBX Binary  \x00", "FBX"),
        ("a.usda", b"#usda 1.0\n(\n", "USD"),
        ("a.dae", b"<?xml version='1.0'?><COLLADA>", "COLLADA"),
        ("a.urdf", b"<robot name='a'>", "URDF"),
        ("a.xml", b"<mujoco>", "MJCF"),
        ("a.ply", b"ply\nformat ascii 1.0\n", "PLY"),
        ("a.dxf", b"0\nSECTION\n2\nENTITIES\n", "DXF"),
        ("a.ifc", b"ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\n", "IFC"),
        ("a.brep", b"DBRep_DrawableShape\n", "shape"),
    ],
)
def test_the_beginning_of_a_file_alone(name: str, content: bytes, says: str, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    error = fail(path)
    assert says in error.message and not error.message.startswith("The reader"), error.message


@HERE
def test_archives(tmp_path: Path, good: bytes) -> None:
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr("machine.step", good)
    assert "unpack it" in fail(tmp_path / "a.zip").hint
    with zipfile.ZipFile(tmp_path / "a.fcstd", "w") as archive:
        archive.writestr("Document.xml", "<x/>")
    assert "FreeCAD" in fail(tmp_path / "a.fcstd").message
    (tmp_path / "a.stpz").write_bytes(b"\x1f\x8b\x08\x00")
    assert "gunzip" in fail(tmp_path / "a.stpz").hint


@HERE
@pytest.mark.parametrize("version", [20, 138])
def test_an_archive_of_another_version_is_damaged(version: int, tmp_path: Path) -> None:
    path = tmp_path / "a.usdz"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("machine.usda", "#usda 1.0\n")
    data = bytearray(path.read_bytes())
    data[data.index(b"PK\x01\x02") + 6] = version
    path.write_bytes(data)
    fail(path)


@HERE
def test_an_instance_of_nothing_is_told(tmp_path: Path) -> None:
    path = tmp_path / "machine.usda"
    cube, empty = 'def Cube "frame" {}', 'def Xform "pin" (instanceable = true) {}'
    path.write_text(f"#usda 1.0\n(metersPerUnit = 1)\n{cube}\n{empty}\n")
    assembly = read_cad(path)
    assert [f.message for f in assembly.findings if f.code == "CAD001"] == [
        "The file declares 2 occurrences of parts and 1 were read"
    ]


@HERE
@pytest.mark.parametrize("damage", ["name", "number"])
def test_what_a_drawing_lost_is_told(damage: str, tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.new("R2018")
    block = document.blocks.new("PIN")
    block.add_3dface([(0, 0, 0), (1.25, 0, 0), (0, 1, 0)])
    document.modelspace().add_blockref("PIN", (0, 0, 0))
    document.modelspace().add_3dface([(0, 0, 0), (2, 0, 0), (0, 2, 0)])
    path = tmp_path / "machine.dxf"
    document.saveas(path)
    text = path.read_text()
    head, tail = text.split("AcDbBlockReference\n  2\nPIN\n") if damage == "name" else text.rsplit("1.25", 1)
    path.write_text(head + ("AcDbBlockReference\n  2\nPIX\n" if damage == "name" else "1.25v") + tail)
    assert "CAD001" in {f.code for f in read_cad(path).findings}


@HERE
def test_content_decides_not_the_name(good: bytes, tmp_path: Path) -> None:
    path = tmp_path / "machine.sldasm"
    path.write_bytes(b"\n/* a comment */\n" + good)
    assert len(read_cad(path).parts) == 3


@HERE
def test_no_solid(tmp_path: Path) -> None:
    assert "no solid" in fail(write_step(tmp_path / "wire.step", Node("WIRE", wire()))).message


def wire() -> object:
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge
    from OCP.gp import gp_Pnt

    return BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(10, 0, 0)).Edge()


def test_dangling_references_do_not_crash_the_caller(good: bytes, tmp_path: Path) -> None:
    path = tmp_path / "dangling.step"
    path.write_bytes(re.sub(rb"(?m)^#\d+ = (?:PLANE|CYLINDRICAL_SURFACE)\(.*?;\n", b"", good, flags=re.DOTALL))
    try:
        assembly = read_cad(path, timeout_s=30)
    except CadError as error:
        assert "damaged: it refers to" in error.message or "Nothing can be read" in error.message
    else:
        assert {finding.code for finding in assembly.findings} & {"CAD001", "CAD003", "CAD006"}


@pytest.mark.parametrize("number", [b"1.E400", b"-1.E300", b"NAN", b"1.E9"])
def test_absurd_coordinates(number: bytes, good: bytes, tmp_path: Path) -> None:
    path = tmp_path / "absurd.step"
    path.write_bytes(re.sub(rb"(CARTESIAN_POINT\('',\()100\.", rb"\g<1>" + number, good))
    try:
        assembly = read_cad(path, timeout_s=30)
    except CadError as error:
        assert error.hint
    else:
        assert {finding.code for finding in assembly.findings} & {"CAD001", "CAD003", "CAD004", "CAD006", "CAD007"}
        assert [part.name for part in assembly.parts][:2] == ["PIN", "PIN"]


def test_time_limit(good: bytes, tmp_path: Path) -> None:
    path = tmp_path / "good.step"
    path.write_bytes(good)
    with pytest.raises(CadError, match=r"more than 0\.01 s"):
        read_cad(path, timeout_s=0.01)


def test_declared_occurrences(good: bytes) -> None:
    facts = part21.scan(good)
    assert (facts.occurrences, facts.complete) == (3, True)
    assert b"PLATE" in facts.names
    cyclic = (
        b"#1=NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','a','',#10,#11,$);\n#2=NEXT_ASSEMBLY_USAGE_OCCURRENCE('2','b','',#11,#12,$);"
        b"\n#3=NEXT_ASSEMBLY_USAGE_OCCURRENCE('3','c','',#12,#11,$);ENDSEC;"
    )
    assert part21.scan(cyclic).occurrences is None


def test_names_of_solids_are_seen(good: bytes) -> None:
    assert not part21.scan(good).named
    for entity in (b"MANIFOLD_SOLID_BREP", b"CLOSED_SHELL"):
        assert part21.scan(good.replace(entity + b"(''", entity + b"('BOOM'", 1)).named


def test_diagnosis(good: bytes) -> None:
    assert part21.diagnose(good) == ""
    assert "does not have, such as #999999" in part21.diagnose(good.replace(b"#11,", b"#999999,"))
    assert "twice" in part21.diagnose(good.replace(b"ENDSEC;\nEND-ISO", b"#11 = PLANE('',#12);\nENDSEC;\nEND-ISO"))
    assert "not numbers" in part21.diagnose(good.replace(b"(0.,", b"(NaN,"))
    assert "1.E300" in part21.diagnose(good.replace(b"(0.,", b"(1.E300,"))


def test_a_shape_that_is_cut_short_is_not_read_for_ever(tmp_path: Path) -> None:
    from OCP.BRepTools import BRepTools

    path = tmp_path / "block.brep"
    BRepTools.Write_s(box(10, 20, 30), str(path))
    text = path.read_text()
    path.write_text(text[: text.rindex("*") - 8])
    # What becomes of it hangs on what is in memory; never does it take the whole time that a reader has.
    assert "more than" not in fail(path).message


@HERE
def test_a_shape_that_is_nowhere_is_refused(tmp_path: Path) -> None:
    from OCP.BRepTools import BRepTools

    path = tmp_path / "block.brep"
    BRepTools.Write_s(box(10, 20, 30), str(path))
    path.write_text(path.read_text().replace(" 20 ", " nan.5 ", 1))
    assert "neither a number" in fail(path).message


@HERE
@pytest.mark.parametrize(
    ("mark", "damage", "says"),
    [
        ("\nCurves ", "\nCurves 4294967", "declares more than it has: Curves"),
        ("\nSurfaces ", "\nSurfaces x", "in line"),
        ("\nTriangulations 0", "", "not all of its sections"),
        ("\nSo\n", "\n7\n", "other shapes"),
        ("\n+1 0", "", "other shapes"),
    ],
)
def test_a_shape_that_would_be_read_for_ever_is_refused(mark: str, damage: str, says: str, tmp_path: Path) -> None:
    from OCP.BRepTools import BRepTools

    path = tmp_path / "block.brep"
    BRepTools.Write_s(cylinder(10, 30), str(path))
    text = path.read_text()
    assert mark in text and fault(text.encode()) == ""
    path.write_text(text.replace(mark, damage, 1))
    assert says in fail(path).message


def test_sound_shapes_have_no_fault(tmp_path: Path) -> None:
    """With triangles, splines and places, in every version of the text."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.BRepTools import BRepTools
    from OCP.Message import Message_ProgressRange
    from OCP.TopTools import TopTools_FormatVersion

    path = tmp_path / "shape.brep"
    for number in (1, 2, 3):
        version = getattr(TopTools_FormatVersion, f"TopTools_FormatVersion_VERSION_{number}")
        for shape in (cylinder(10, 30), BRepBuilderAPI_NurbsConvert(cylinder(10, 30)).Shape()):
            for meshed in (False, True):
                if meshed:
                    BRepMesh_IncrementalMesh(shape, 0.5)
                BRepTools.Write_s(
                    moved(shape, translation(1, 2, 3)), str(path), True, True, version, Message_ProgressRange()
                )
                assert fault(path.read_bytes()) == ""


@HERE
def test_warnings_leave_no_file_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    geom = '<geom type="box" size="1 1 1" user="nan"/>'
    Path("box.xml").write_text(f"<mujoco><worldbody><body>{geom}</body></worldbody></mujoco>")
    try:
        read_cad("box.xml")
    except CadError as error:
        assert error.hint
    assert [p.name for p in tmp_path.iterdir()] == ["box.xml"]


@pytest.mark.parametrize("suffix", [".mjcf", ".xml"])
def test_an_mjcf_file_is_read_by_either_suffix(suffix: str, tmp_path: Path) -> None:
    """With the meshes beside it; MuJoCo itself opens .xml alone."""
    (tmp_path / "meshes").mkdir()
    trimesh.creation.box((1.0, 2.0, 3.0)).export(tmp_path / "meshes" / "box.stl")
    (tmp_path / f"a{suffix}").write_text(
        '<mujoco><asset><mesh name="m" file="meshes/box.stl"/></asset>'
        '<worldbody><body name="arm"><geom type="mesh" mesh="m"/></body></worldbody></mujoco>'
    )
    read = read_cad(tmp_path / f"a{suffix}")
    assert read.format == "MJCF" and abs(read.shape_of(read.parts[0]).volume - 6.0) < 1e-9
