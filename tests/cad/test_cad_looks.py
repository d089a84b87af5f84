"""Metalness, roughness, textures and colours of faces: kept by every reader that can find them, and into USD."""

from __future__ import annotations

import json
import struct
import zipfile
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from pkgutil import resolve_name

import numpy as np
import pytest
from PIL import Image
from pxr import Sdf, Usd, UsdGeom, UsdShade
from test_cad_triangles import CORNERS, FACES, binary

from kit.cadfiles import fbx as cad_fbx
from kit.cadfiles.step import box, faces_of
from yellowiron.cad.recognition import format_of
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Mesh
from yellowiron.usd import write_assembly

UVS = np.tile([[0.0, 0.0], [1.0, 0.0], [1.0, 0.25]], (len(FACES), 1)).reshape(-1, 3, 2)
"""Every triangle sees the lower part of the picture."""


def read_cad(path: Path) -> Assembly:
    """Read in this process: the files are our own."""
    return resolve_name(format_of(path).reader)(str(path))


def picture(size: tuple[int, int] = (16, 16), form: str = "PNG") -> bytes:
    """Orange above, black below."""
    image = Image.new("RGB", size, (255, 128, 0))
    image.paste((0, 0, 0), (0, size[1] // 2, size[0], size[1]))
    out = BytesIO()
    image.save(out, form)
    return out.getvalue()


def glb(path: Path, image: bytes = b"", **texture: object) -> Path:
    """A box in two primitives of one mesh: the first half textured, the second plain metal."""
    corners = CORNERS[FACES].astype("<f4")
    uvs = UVS.astype("<f4").copy()
    uvs[..., 1] = 1.0 - uvs[..., 1]
    image = image or picture()
    blob = corners.tobytes() + uvs.tobytes() + image
    sizes = [corners.nbytes // 2, corners.nbytes // 2, uvs.nbytes // 2, len(image)]
    starts = [0, corners.nbytes // 2, corners.nbytes, corners.nbytes + uvs.nbytes]
    count = len(FACES) * 3 // 2
    vec3 = {"componentType": 5126, "type": "VEC3", "count": count}
    document = {
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"name": "BOOM", "mesh": 0}],
        "meshes": [{"primitives": [
            {"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "material": 0},
            {"attributes": {"POSITION": 1}, "material": 1},
        ]}],
        "materials": [
            {"pbrMetallicRoughness":
                {"baseColorTexture": {"index": 0}, "metallicFactor": 0.0, "roughnessFactor": 0.75}},
            {"pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.3, 0.4, 1.0], "metallicFactor": 1.0}},
        ],
        "textures": [{"source": 0}],
        "images": [texture or {"bufferView": 3, "mimeType": "image/png", "name": "paint"}],
        "accessors": [{**vec3, "bufferView": 0}, {**vec3, "bufferView": 1},
                      {"componentType": 5126, "type": "VEC2", "count": count, "bufferView": 2}],
        "bufferViews": [{"buffer": 0, "byteOffset": a, "byteLength": n} for a, n in zip(starts, sizes, strict=True)],
        "buffers": [{"byteLength": len(blob)}],
    }  # fmt: skip
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    blob += bytes(-len(blob) % 4)
    head = struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(blob), len(text), 0x4E4F534A)
    path.write_bytes(head + text + struct.pack("<II", len(blob), 0x004E4942) + blob)
    return path


def obj(path: Path, reference: str = "paint.png") -> Path:
    lines = ["mtllib machine.mtl", "o BOOM", "usemtl paint", *(f"v {x} {y} {z}" for x, y, z in CORNERS)]
    lines += [f"vt {u} {v}" for u, v in UVS.reshape(-1, 2)]
    lines += ["f " + " ".join(f"{p + 1}/{3 * n + k + 1}" for k, p in enumerate(f)) for n, f in enumerate(FACES)]
    path.write_text("\n".join(lines) + "\n")
    path.with_name("machine.mtl").write_text(f"newmtl paint\nKd 1 1 1\nPm 0.25\nPr 0.75\nmap_Kd -s 1 1 1 {reference}\n")
    path.with_name("paint.png").write_bytes(picture())
    return path


def fbx(path: Path, binary_form: bool = True) -> Path:
    objects = [
        cad_fbx.geometry(1000, CORNERS * 100.0, FACES, UVS), cad_fbx.material(1100, "paint", (1.0, 1.0, 1.0)),
        cad_fbx.texture(1200, "paint.png"), cad_fbx.model(10, "BOOM", np.eye(4), mesh=True),
    ]  # fmt: skip
    links = [(10, 0), (1000, 10), (1100, 10), (1200, 1100, "DiffuseColor")]
    cad_fbx.write(path, objects, links, binary=binary_form)
    path.with_name("paint.png").write_bytes(picture())
    return path


def collada(path: Path) -> Path:
    def source(name: str, values: np.ndarray, axes: str) -> str:
        params = "".join(f'<param name="{a}" type="float"/>' for a in axes)
        numbers = " ".join(f"{v:g}" for v in values.reshape(-1))
        return (
            f'<source id="{name}"><float_array id="{name}-a" count="{values.size}">{numbers}</float_array>'
            f'<technique_common><accessor source="#{name}-a" count="{values.size // len(axes)}" stride="{len(axes)}">'
            f"{params}</accessor></technique_common></source>"
        )

    indices = " ".join(f"{p} {3 * n + k}" for n, f in enumerate(FACES) for k, p in enumerate(f))
    path.write_text(
        '<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>'
        '<unit meter="1"/><up_axis>Z_UP</up_axis></asset><library_images><image id="i"><init_from>paint.png</init_from>'
        '</image></library_images><library_effects><effect id="e"><profile_COMMON><newparam sid="s"><surface type="2D">'
        '<init_from>i</init_from></surface></newparam><newparam sid="p"><sampler2D><source>s</source></sampler2D>'
        '</newparam><technique sid="c"><lambert><diffuse><texture texture="p" texcoord="UV"/></diffuse></lambert>'
        '</technique></profile_COMMON></effect></library_effects><library_materials><material id="m"><instance_effect '
        'url="#e"/></material></library_materials><library_geometries><geometry id="g"><mesh>'
        + source("p", CORNERS, "XYZ") + source("t", UVS, "ST") +
        '<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles material="m" count="12">'
        '<input semantic="VERTEX" source="#v" offset="0"/><input semantic="TEXCOORD" source="#t" offset="1" set="0"/>'
        f"<p>{indices}</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
        '<visual_scene id="s"><node id="n" name="BOOM"><instance_geometry url="#g"><bind_material><technique_common>'
        '<instance_material symbol="m" target="#m"><bind_vertex_input semantic="UV" input_semantic="TEXCOORD" '
        'input_set="0"/></instance_material></technique_common></bind_material></instance_geometry></node>'
        '</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>'
    )  # fmt: skip
    path.with_name("paint.png").write_bytes(picture())
    return path


WRITERS: dict[str, Callable[[Path], Path]] = {"a.obj": obj, "a.fbx": fbx, "a.dae": collada}


def gltf(path: Path) -> Path:
    data = glb(path.with_name("a.glb")).read_bytes()
    size = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20 : 20 + size])
    document["buffers"][0]["uri"] = "a.bin"
    path.with_name("a.bin").write_bytes(data[28 + size :])
    path.write_text(json.dumps(document))
    return path


def usd(path: Path) -> Path:
    from pxr import UsdUtils

    assembly = read_cad(glb(path.with_name("a.glb")))
    if path.suffix != ".usdz":
        return write_assembly(assembly, path)
    flat = write_assembly(assembly, path.with_suffix(".usdc"))
    UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath(str(flat)), str(path))
    return path


TEXTURED: dict[str, Callable[[Path], Path]] = {
    "GLB": lambda folder: glb(folder / "b.glb"),
    "glTF": lambda folder: gltf(folder / "b.gltf"),
    "OBJ": lambda folder: obj(folder / "b.obj"),
    "COLLADA": lambda folder: collada(folder / "b.dae"),
    "FBX (text)": lambda folder: fbx(folder / "b.fbx", False),
    "FBX (binary)": lambda folder: fbx(folder / "b.fbx"),
    **{f"USD ({s})": lambda folder, s=s: usd(folder / f"b.{s}") for s in ("usda", "usdc", "usdz")},
}
"""Formats with textures, by their names in the docs' table."""


def check(assembly: Assembly) -> None:
    """One textured box, its picture found and its coordinates in place."""
    (part,) = assembly.parts
    shape = assembly.shape_of(part)
    (finish,) = shape.finishes
    assert finish.texture is not None and finish.texture.file.startswith("paint_")
    assert finish.texture.data == picture()
    # The mean of orange (linear: 1, 0.216, 0) and black.
    assert part.color == pytest.approx((0.5, 0.108, 0.0), abs=0.01)
    seen = shape.mesh.uvs
    assert seen is not None and seen.shape == (12, 3, 2)
    rows = {tuple(map(tuple, np.round(row[np.lexsort(row.T)], 5))) for row in seen}
    assert rows == {((0.0, 0.0), (1.0, 0.0), (1.0, 0.25))}


@pytest.mark.parametrize("name", WRITERS)
def test_texture(name: str, tmp_path: Path) -> None:
    assembly = read_cad(WRITERS[name](tmp_path / name))
    check(assembly)
    assert "CAD012" not in {f.code for f in assembly.findings}
    if name == "a.obj":
        finish = assembly.shape_of(assembly.parts[0]).finishes[0]
        assert (finish.metallic, finish.roughness) == (0.25, 0.75)
    # And into USD, from where it comes back.
    out = write_assembly(assembly, tmp_path / "usd" / "out.usda")
    (file,) = (tmp_path / "usd" / "textures").iterdir()
    assert file.read_bytes() == picture()
    check(read_cad(out))
    stage = Usd.Stage.Open(str(out))
    (surface,) = [
        shader
        for p in stage.Traverse(Usd.TraverseInstanceProxies())
        if (shader := UsdShade.Shader(p)) and shader.GetShaderId() == "UsdPreviewSurface"
    ]
    assert tuple(surface.GetInput("diffuseColor").Get()) == pytest.approx(assembly.parts[0].color)
    moved = tmp_path / "elsewhere"
    (tmp_path / "usd").rename(moved)
    check(read_cad(moved / "out.usda"))


def test_several_materials_of_one_mesh(tmp_path: Path) -> None:
    assembly = read_cad(glb(tmp_path / "a.glb"))
    (part,) = assembly.parts
    shape = assembly.shape_of(part)
    assert [(f.metallic, f.roughness, f.texture is not None) for f in shape.finishes] == [
        (0.0, 0.75, True),
        (1.0, None, False),
    ]
    assert np.bincount(shape.mesh.triangle_finishes).tolist() == [6, 6]
    assert shape.closed
    out = write_assembly(assembly, tmp_path / "out.usda")
    stage = Usd.Stage.Open(str(out))
    mesh = next(p for p in stage.Traverse(Usd.TraverseInstanceProxies()) if p.IsA(UsdGeom.Mesh))
    subsets = UsdShade.MaterialBindingAPI(mesh).GetMaterialBindSubsets()
    assert sorted(len(s.GetIndicesAttr().Get()) for s in subsets) == [6, 6]
    for subset in subsets:
        assert UsdShade.MaterialBindingAPI(subset.GetPrim()).ComputeBoundMaterial()[0]
    again = read_cad(out)
    shape = again.shape_of(again.parts[0])
    assert {(f.metallic, f.texture is not None) for f in shape.finishes} == {(None, True), (1.0, False)}
    colors = shape.mesh.triangle_colors
    assert colors is not None and len(np.unique(np.round(colors, 3), axis=0)) == 2


def test_usdz_holds_its_pictures(tmp_path: Path) -> None:
    from pxr import UsdUtils

    usd = write_assembly(read_cad(obj(tmp_path / "a.obj")), tmp_path / "out.usdc")
    (tmp_path / "alone").mkdir()
    assert UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath(str(usd)), str(tmp_path / "alone" / "a.usdz"))
    assembly = read_cad(tmp_path / "alone" / "a.usdz")
    assert assembly.shape_of(assembly.parts[0]).finishes[0].texture is not None


@pytest.mark.parametrize(
    "reference",
    ["../paint.png", "/etc/passwd", "file:///etc/passwd", "..\\..\\secret.png", "%2e%2e/secret.png", "a\0b"],
)
def test_no_picture_from_outside(reference: str, tmp_path: Path) -> None:
    (tmp_path / "secret.png").write_bytes(picture())
    (tmp_path / "inner").mkdir()
    assembly = read_cad(glb(tmp_path / "inner" / "a.glb", uri=reference))
    shape = assembly.shape_of(assembly.parts[0])
    assert all(f.texture is None for f in shape.finishes) and shape.mesh.uvs is None
    assert "not in the model's folder" in next(f.message for f in assembly.findings if f.code == "CAD012")


def test_a_path_of_another_computer(tmp_path: Path) -> None:
    path = obj(tmp_path / "a.obj", "C:\\Users\\me\\paint\\paint.png")
    check(read_cad(path))


@pytest.mark.parametrize(
    ("image", "says"),
    [
        (b"\x89PNG\r\n\x1a\n" + bytes(100), "damaged"),
        (picture()[:48], "damaged"),
        (b"no picture", "damaged"),
        (
            b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR\x00\x01\x86\xa0\x00\x01\x86\xa0\x08\x02\x00\x00\x00" + bytes(20),
            "points",
        ),
    ],
)
def test_bad_pictures(image: bytes, says: str, tmp_path: Path) -> None:
    assembly = read_cad(glb(tmp_path / "a.glb", image))
    message = next(f.message for f in assembly.findings if f.code == "CAD012")
    assert says in message or "damaged" in message
    assert assembly.shape_of(assembly.parts[0]).mesh.uvs is None


def test_other_forms_become_png(tmp_path: Path) -> None:
    assembly = read_cad(glb(tmp_path / "a.glb", picture(form="BMP")))
    texture = assembly.shape_of(assembly.parts[0]).finishes[0].texture
    assert texture is not None and texture.file.endswith(".png") and texture.data.startswith(b"\x89PNG")


def test_colours_of_points_and_faces(tmp_path: Path) -> None:
    half = np.array([[1.0, 0.0, 0.0]] * 6 + [[0.0, 0.0, 1.0]] * 6)

    def kept(assembly: Assembly) -> None:
        colors = assembly.shape_of(assembly.parts[0]).mesh.triangle_colors
        assert colors is not None
        assert {tuple(np.round(c, 2)) for c in colors} == {(1.0, 0.0, 0.0), (0.0, 0.0, 1.0)}

    # STL's spare bytes, in both manners.
    data = bytearray(binary(CORNERS[FACES]))
    for n in range(12):
        struct.pack_into("<H", data, 84 + 50 * n + 48, 0x8000 | (31 << 10 if n < 6 else 31))
    (tmp_path / "viscam.stl").write_bytes(bytes(data))
    kept(read_cad(tmp_path / "viscam.stl"))
    data[:10] = b"COLOR=\x00\x00\x00\xff"
    for n in range(12):
        struct.pack_into("<H", data, 84 + 50 * n + 48, 31 if n < 6 else 31 << 10)
    (tmp_path / "magics.stl").write_bytes(bytes(data))
    kept(read_cad(tmp_path / "magics.stl"))
    # OBJ with colours at its points.
    corners = CORNERS[FACES].reshape(-1, 3)
    rows = [
        f"v {x} {y} {z} {r} {g} {b}" for (x, y, z), (r, g, b) in zip(corners, np.repeat(half, 3, axis=0), strict=True)
    ]
    rows += [f"f {3 * n + 1} {3 * n + 2} {3 * n + 3}" for n in range(12)]
    (tmp_path / "points.obj").write_text("\n".join(rows))
    kept(read_cad(tmp_path / "points.obj"))
    # DXF: faces of two colours in one block, and in one layer.
    import ezdxf

    drawing = ezdxf.new(units=6)
    block = drawing.blocks.new("BOOM")
    for n, face in enumerate(FACES):
        block.add_3dface([tuple(CORNERS[i]) for i in face], dxfattribs={"color": 1 if n < 6 else 5})
    drawing.modelspace().add_blockref("BOOM", (0, 0, 0))
    drawing.saveas(tmp_path / "a.dxf")
    kept(read_cad(tmp_path / "a.dxf"))


@pytest.mark.parametrize("key", ["DiffuseColor", "ShapeAppearance"])
def test_freecads_colours_of_faces(key: str, tmp_path: Path) -> None:
    from OCP.BRepTools import BRepTools

    shape = box(100.0, 200.0, 300.0)
    BRepTools.Write_s(shape, str(tmp_path / "a.brp"))
    packed = [0xFF0000FF if n < 3 else 0x0000FFFF for n in range(len(faces_of(shape)))]
    if key == "DiffuseColor":
        tag, rows = "ColorList", [struct.pack("<I", p) for p in packed]
    else:
        tag, rows = "MaterialList", [struct.pack("<4I2f", 0, p, 0, 0, 0.2, 0.0) for p in packed]
    document = (
        '<Document><Objects><Object name="Boom" type="Part::Feature"/></Objects><ObjectData><Object name="Boom">'
        '<Properties><Property name="Label"><String value="BOOM"/></Property><Property name="Shape">'
        '<Part file="a.brp"/></Property></Properties></Object></ObjectData></Document>'
    )
    looks = (
        '<Document><ViewProviderData><ViewProvider name="Boom"><Properties><Property name="Visibility"><Bool '
        f'value="true"/></Property><Property name="{key}"><{tag} file="{key}"/></Property></Properties></ViewProvider>'
        "</ViewProviderData></Document>"
    )
    with zipfile.ZipFile(tmp_path / "a.FCStd", "w") as archive:
        archive.writestr("Document.xml", document)
        archive.writestr("GuiDocument.xml", looks)
        archive.writestr(key, struct.pack("<I", len(rows)) + b"".join(rows))
        archive.write(tmp_path / "a.brp", "a.brp")
    assembly = read_cad(tmp_path / "a.FCStd")
    colors = assembly.shape_of(assembly.parts[0]).mesh.triangle_colors
    assert colors is not None and {tuple(np.round(c, 3)) for c in colors} == {(1.0, 0.0, 0.0), (0.0, 0.0, 1.0)}


def test_a_triangle_that_is_turned_over_takes_its_coordinates_along() -> None:
    from yellowiron.cad.mesh.assembly import shape_of

    corners = CORNERS[FACES[:, ::-1]].reshape(-1, 3)
    triangles = np.arange(36, dtype=np.int32).reshape(-1, 3)
    uvs = corners[:, :2].reshape(-1, 3, 2).copy()
    mesh = shape_of(Mesh(corners, triangles, uvs=uvs), "BOX").mesh
    assert mesh.uvs is not None and not np.array_equal(mesh.triangles, triangles)
    np.testing.assert_allclose(mesh.uvs, mesh.points[mesh.triangles][:, :, :2])


def test_two_boxes_in_one_textured_mesh_are_taken_apart_with_it(tmp_path: Path) -> None:
    from yellowiron.cad import taken_apart

    path = obj(tmp_path / "a.obj")
    lines = path.read_text().splitlines()
    points = [f"v {x + 9.0} {y} {z}" for x, y, z in CORNERS]
    faces = ["f " + " ".join(f"{p + 9}/{3 * n + k + 1}" for k, p in enumerate(f)) for n, f in enumerate(FACES)]
    path.write_text("\n".join([*lines, *points, *faces]) + "\n")
    apart = taken_apart(read_cad(path))
    assert len(apart.parts) == 2 and len(apart.shapes) == 1
    (shape,) = apart.shapes.values()
    assert shape.finishes[0].texture is not None
    assert shape.mesh.uvs is not None and shape.mesh.uvs.shape == (12, 3, 2)
