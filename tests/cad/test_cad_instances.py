"""Mirrored and scaled instances, and names in the encodings of the world, format by format."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable
from pathlib import Path
from pkgutil import resolve_name

import numpy as np
import pytest
from test_cad_gltf import packed

from kit.cadfiles import fbx as cad_fbx
from kit.cadfiles.step import box
from yellowiron.cad.recognition import format_of
from yellowiron.model.assembly import Assembly

CORNERS = np.array([[x, y, z] for x in (0.0, 4.0) for y in (0.0, 3.0) for z in (0.0, 2.0)])
CORNERS[7] += 1.0
FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
     [1, 5, 7], [1, 7, 3]]
)  # fmt: skip
MIRROR, DOUBLE = np.diag([-1.0, 1.0, 1.0, 1.0]), np.diag([2.0, 2.0, 2.0, 1.0])
MIRROR[:3, 3], DOUBLE[:3, 3] = (-1.0, 0.0, 0.0), (0.0, 9.0, 0.0)
PLACES = (np.eye(4), MIRROR, DOUBLE)
"""As drawn, mirrored and twice as large, metres."""


def read(path: Path) -> Assembly:
    """Read in this process: the files are our own."""
    return resolve_name(format_of(path).reader)(str(path))


def glb(path: Path) -> None:
    blob = CORNERS.astype("<f4").tobytes() + FACES.astype("<u2").tobytes()
    nodes = [{"name": "BOOM", "mesh": 0, "matrix": m.T.reshape(-1).tolist()} for m in PLACES]
    document = {
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1, 2]}], "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"componentType": 5126, "type": "VEC3", "count": 8, "bufferView": 0},
                      {"componentType": 5123, "type": "SCALAR", "count": 36, "bufferView": 1}],
        "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
        "buffers": [{"byteLength": len(blob)}],
    }  # fmt: skip
    path.write_bytes(packed(document, blob))


def fbx(path: Path) -> None:
    objects = [cad_fbx.geometry(1, CORNERS * 100.0, FACES), cad_fbx.material(2, "m", (1.0, 0.5, 0.0))]
    links = [(2, 10), (2, 11), (2, 12)]
    for n, place in enumerate(PLACES, start=10):
        rigid = np.eye(4)
        rigid[:3, 3] = place[:3, 3] * 100.0
        objects.append(cad_fbx.model(n, "BOOM", rigid, mesh=True, scale=np.diag(place)[:3].tolist()))
        links += [(n, 0), (1, n)]
    cad_fbx.write(path, objects, links, binary=True)


def collada(path: Path) -> None:
    numbers = " ".join(f"{v:g}" for v in CORNERS.reshape(-1))
    indices = " ".join(str(v) for v in FACES.reshape(-1))
    nodes = "".join(
        f'<node id="n{n}" name="BOOM"><matrix>{" ".join(f"{v:g}" for v in m.reshape(-1))}</matrix>'
        '<instance_geometry url="#g"/></node>'
        for n, m in enumerate(PLACES)
    )
    params = "".join(f'<param name="{a}" type="float"/>' for a in "XYZ")
    path.write_text(
        '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter="1"/>'
        '<up_axis>Z_UP</up_axis></asset><library_geometries><geometry id="g"><mesh><source id="p">'
        '<float_array id="a" count="24">'
        f'{numbers}</float_array><technique_common><accessor source="#a" count="8" stride="3">{params}</accessor>'
        '</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>'
        f'<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>{indices}</p></triangles></mesh>'
        f'</geometry></library_geometries><library_visual_scenes><visual_scene id="s">{nodes}</visual_scene>'
        '</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>'
    )


def usd(path: Path) -> None:
    from pxr import Gf, Usd, UsdGeom

    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    mesh = UsdGeom.Mesh.Define(stage, stage.CreateClassPrim("/shape").GetPath().AppendChild("mesh"))
    mesh.CreatePointsAttr(CORNERS.astype(np.float32))
    mesh.CreateFaceVertexCountsAttr([3] * len(FACES))
    mesh.CreateFaceVertexIndicesAttr(FACES.reshape(-1).tolist())
    for n, place in enumerate(PLACES):
        prim = UsdGeom.Xform.Define(stage, f"/BOOM{n}")
        prim.GetPrim().SetDisplayName("BOOM")
        prim.AddTransformOp().Set(Gf.Matrix4d(place.T.tolist()))
        prim.GetPrim().GetReferences().AddInternalReference("/shape")
        prim.GetPrim().SetInstanceable(True)
    stage.Save()


def dxf(path: Path) -> None:
    import ezdxf

    drawing = ezdxf.new(units=6)
    block = drawing.blocks.new("BOOM")
    for face in FACES:
        block.add_3dface([tuple(CORNERS[i]) for i in face])
    for place in PLACES:
        x, y, z = np.diag(place)[:3].tolist()
        drawing.modelspace().add_blockref(
            "BOOM", place[:3, 3].tolist(), dxfattribs={"xscale": x, "yscale": y, "zscale": z}
        )
    drawing.saveas(path)


WRITERS: dict[str, Callable[[Path], None]] = {
    "a.glb": glb, "a.fbx": fbx, "a.dae": collada, "a.usda": usd, "a.dxf": dxf,
}  # fmt: skip


@pytest.mark.parametrize("name", WRITERS)
def test_mirrored_and_scaled(name: str, tmp_path: Path) -> None:
    WRITERS[name](tmp_path / name)
    assembly = read(tmp_path / name)
    assert len(assembly.parts) == 3 and len(assembly.shapes) == 1
    boxes = sorted(tuple(np.round(assembly.points_of(p).max(axis=0), 4).tolist()) for p in assembly.parts)
    expected = [tuple((CORNERS @ m[:3, :3].T + m[:3, 3]).max(axis=0).tolist()) for m in PLACES]
    np.testing.assert_allclose(boxes, sorted(expected), atol=1e-5)
    scales = sorted(float(np.linalg.det(p.transform[:3, :3])) for p in assembly.parts)
    assert scales == pytest.approx([-1.0, 1.0, 8.0], rel=1e-5)


def test_an_fbx_part_that_does_not_arrive_is_said(tmp_path: Path) -> None:
    fbx(tmp_path / "a.fbx")
    assert not read(tmp_path / "a.fbx").findings
    data = (tmp_path / "a.fbx").read_bytes()
    link = b"OO" + b"L" + (1).to_bytes(8, "little") + b"L" + (12).to_bytes(8, "little")
    assert data.count(link) == 1
    (tmp_path / "a.fbx").write_bytes(data.replace(link, link[:3] + (9).to_bytes(8, "little") + link[11:]))
    assembly = read(tmp_path / "a.fbx")
    assert len(assembly.parts) == 2
    assert "declares 3 occurrences of parts and 2 were read" in assembly.findings[0].message


def iges(path: Path, names: list[str]) -> None:
    """Boxes as figures with these names, the last placed twice as large; surfaces, not solids."""
    from OCP.BRepToIGES import BRepToIGES_BREntity
    from OCP.collections import HArray1_IGESData_IGESEntity
    from OCP.gp import gp_XYZ
    from OCP.IGESBasic import IGESBasic_SingularSubfigure, IGESBasic_SubfigureDef
    from OCP.IGESControl import IGESControl_Controller, IGESControl_Writer
    from OCP.TCollection import TCollection_HAsciiString

    IGESControl_Controller.Init_s()
    writer = IGESControl_Writer("MM", 0)
    made = BRepToIGES_BREntity()
    made.SetModel(writer.Model())
    for n, name in enumerate(names):
        array = HArray1_IGESData_IGESEntity(1, 1)
        array.SetValue(1, made.TransferShape(box(10.0, 20.0, 30.0 + n)))
        figure, placed = IGESBasic_SubfigureDef(), IGESBasic_SingularSubfigure()
        figure.Init(0, TCollection_HAsciiString(name), array)
        placed.Init(figure, gp_XYZ(100.0 * n, 0.0, 0.0), n == len(names) - 1, 2.0 if n == len(names) - 1 else 1.0)
        writer.AddEntity(placed)
    writer.ComputeModel()
    writer.Write(str(path))


NAMES = {
    "cp932": ["アーム", "ブーム", "バケット"],
    "gb18030": ["动臂油缸", "铲斗", "前车架总成"],
    "cp1252": ["Schaufelträger", "Vérin de levage", "Größe"],
}


@pytest.mark.parametrize("encoding", NAMES)
def test_names_in_iges(encoding: str, tmp_path: Path) -> None:
    names = NAMES[encoding]
    places = ["N" * len(name.encode(encoding)) + str(n) for n, name in enumerate(names)]
    iges(tmp_path / "a.igs", places)
    data = (tmp_path / "a.igs").read_bytes()
    for place, name in zip(places, names, strict=True):
        data = data.replace(place.encode(), name.encode(encoding) + place[-1:].encode())
    (tmp_path / "a.igs").write_bytes(data)
    assembly = read(tmp_path / "a.igs")
    assert [p.name for p in assembly.parts] == [f"{name}{n}" for n, name in enumerate(names)]
    assert any(f.code == "CAD010" and encoding in f.message for f in assembly.findings)
    shapes = [assembly.shape_of(p) for p in assembly.parts]
    assert all(s.closed and s.exact for s in shapes)
    size = np.ptp(assembly.points_of(assembly.parts[-1]), axis=0)
    np.testing.assert_allclose(size, [0.02, 0.04, 0.064], atol=1e-6)


@pytest.mark.parametrize("encoding", NAMES)
def test_names_in_obj(encoding: str, tmp_path: Path) -> None:
    lines, start = ["mtllib a.mtl"], 1
    for name in NAMES[encoding]:
        lines += [f"o {name}", f"usemtl {name}", *(f"v {x + start} {y} {z}" for x, y, z in CORNERS)]
        lines += [f"f {a + start} {b + start} {c + start}" for a, b, c in FACES]
        start += len(CORNERS)
    (tmp_path / "a.obj").write_bytes("\n".join(lines).encode(encoding))
    looks = "".join(f"newmtl {name}\nKd 0.5 0.25 {n / 4}\n" for n, name in enumerate(NAMES[encoding]))
    (tmp_path / "a.mtl").write_bytes(looks.encode(encoding))
    assembly = read(tmp_path / "a.obj")
    assert [p.name for p in assembly.parts] == NAMES[encoding]
    assert [p.color for p in assembly.parts] == [(0.5, 0.25, n / 4) for n in range(3)]
    assert any(f.code == "CAD010" and encoding in f.message for f in assembly.findings)


@pytest.mark.parametrize(("encoding", "page"), [("cp932", "ANSI_932"), ("gbk", "ANSI_936"), ("cp1252", "ANSI_1252")])
def test_names_in_dxf(encoding: str, page: str, tmp_path: Path) -> None:
    """Older drawings say which encoding they are in; newer ones are UTF-8."""
    name = NAMES["gb18030" if encoding == "gbk" else encoding][0]
    corners = "".join(
        f"{10 + i}\n{x}\n{20 + i}\n{y}\n{30 + i}\n0\n" for i, (x, y) in enumerate([(0, 0), (4, 0), (4, 3), (0, 3)])
    )
    text = (
        f"0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$DWGCODEPAGE\n3\n{page}\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n"
        f"0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\n{name}\n{corners}0\nENDSEC\n0\nEOF\n"
    )
    (tmp_path / "a.dxf").write_bytes(text.encode(encoding))
    assert [p.name for p in read(tmp_path / "a.dxf").parts] == [name]


@pytest.mark.parametrize("encoding", NAMES)
def test_names_in_gltf(encoding: str, tmp_path: Path) -> None:
    """UTF-8 by its standard; some programs write their computer's encoding all the same."""
    glb(tmp_path / "a.glb")
    data = (tmp_path / "a.glb").read_bytes()
    size = struct.unpack_from("<I", data, 12)[0]
    document, blob = json.loads(data[20 : 20 + size]), data[28 + size :]
    for node, name in zip(document["nodes"], NAMES[encoding], strict=True):
        node["name"] = name
    document["buffers"][0]["uri"] = "a.bin"
    (tmp_path / "a.bin").write_bytes(blob)
    (tmp_path / "a.gltf").write_bytes(json.dumps(document, ensure_ascii=False).encode(encoding))
    assert [p.name for p in read(tmp_path / "a.gltf").parts] == NAMES[encoding]


def test_colours_of_faces_in_iges(tmp_path: Path) -> None:
    """Of a solid and of surfaces; with the product's name."""
    from OCP.IGESCAFControl import IGESCAFControl_Writer
    from OCP.IGESControl import IGESControl_Controller
    from OCP.Interface import Interface_Static

    from kit.cadfiles.step import faces_of
    from yellowiron.cad.brep.xcaf import Product, add_products, new_document

    shape = box(100.0, 200.0, 300.0)
    red, blue = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
    IGESControl_Controller.Init_s()
    for mode in (0, 1):
        document = new_document()
        add_products(document, [Product("BOOM", shape, [], red, [(faces_of(shape)[0], blue)])])
        Interface_Static.SetIVal_s("write.iges.brep.mode", mode)
        writer = IGESCAFControl_Writer()
        writer.SetColorMode(True)
        writer.SetNameMode(True)
        assert writer.Transfer(document)
        writer.Write(str(tmp_path / "a.igs"))
        (part,) = (assembly := read(tmp_path / "a.igs")).parts
        colors = assembly.shape_of(part).mesh.triangle_colors
        assert part.name == "BOOM" and assembly.shape_of(part).closed
        assert colors is not None and {tuple(np.round(c, 3).tolist()) for c in colors} == {red, blue}
