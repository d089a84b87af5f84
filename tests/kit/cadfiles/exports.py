"""One small machine, written to every format that can be written here, each in another unit: a tree with a plate that
has a bore, two pins of one shape (one of them turned), and a wedge with a Chinese name. Metres, linear RGB."""

from __future__ import annotations

import itertools
import json
import struct
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np

from kit.cadfiles import fbx as cad_fbx
from kit.cadfiles.step import Node, Use, box, compound, cut, cylinder, moved, rotation, translation, write_step

Color = tuple[float, float, float]
Meshes = Mapping[str, tuple[np.ndarray, np.ndarray]]
"""Shape → points (n, 3) in metres, triangles (m, 3)."""


@dataclass(frozen=True, eq=False)
class Item:
    name: str
    path: tuple[str, ...]
    shape: str
    matrix: np.ndarray
    color: Color


def _place(x: float, y: float, z: float, turn: np.ndarray | None = None) -> np.ndarray:
    return translation(x, y, z) @ (np.eye(4) if turn is None else turn)


ITEMS = (
    Item("BOOM", ("LOADER", "FRONT"), "plate", _place(1.0, 0.2, 0.3), (0.8, 0.1, 0.05)),
    Item("PIN", ("LOADER", "FRONT"), "pin", _place(1.2, 0.3, 0.1), (0.25, 0.25, 0.25)),
    Item("PIN", ("LOADER", "FRONT"), "pin", _place(2.0, 0.5, 0.1, rotation((1, 0, 0), 0.7)), (0.25, 0.25, 0.25)),
    Item("铲斗", ("LOADER",), "wedge", _place(2.5, -0.4, 0.2, rotation((0, 0, 1), 0.5)), (0.05, 0.1, 0.9)),
)


def solids() -> dict[str, Any]:
    """The shapes as Open CASCADE has them, in millimetres."""
    plate = cut(box(400.0, 200.0, 100.0), cylinder(50.0, 140.0, at=(200.0, 100.0, -20.0)))
    wedge = cut(box(300.0, 600.0, 200.0), moved(box(600.0, 700.0, 300.0), rotation((0, 1, 0), -0.6)))
    return {"plate": plate, "pin": cylinder(49.0, 300.0), "wedge": wedge}


def _millimetres(matrix: np.ndarray) -> np.ndarray:
    scaled = matrix.copy()
    scaled[:3, 3] *= 1000.0
    return scaled


def step(path: Path, meshes: Meshes) -> None:
    shapes = solids()
    products = {i.shape: Node(i.name, shapes[i.shape], color=i.color) for i in ITEMS}
    front = Node("FRONT", children=[Use(products[i.shape], _millimetres(i.matrix)) for i in ITEMS[:3]])
    write_step(path, Node("LOADER", children=[Use(front), Use(products["wedge"], _millimetres(ITEMS[3].matrix))]))


def _all_solids() -> list[Any]:
    shapes = solids()
    return [moved(shapes[i.shape], _millimetres(i.matrix)) for i in ITEMS]


def iges(path: Path, meshes: Meshes) -> None:
    """Inches; a figure a shape, coloured and placed by subfigures (one of them turned), in groups with names."""
    from OCP.BRepToIGESBRep import BRepToIGESBRep_Entity
    from OCP.collections import HArray1_IGESData_IGESEntity, HArray2_double
    from OCP.gp import gp_XYZ
    from OCP.IGESBasic import IGESBasic_Group, IGESBasic_Name, IGESBasic_SingularSubfigure, IGESBasic_SubfigureDef
    from OCP.IGESControl import IGESControl_Controller, IGESControl_Writer
    from OCP.IGESGeom import IGESGeom_TransformationMatrix
    from OCP.IGESGraph import IGESGraph_Color
    from OCP.TCollection import TCollection_HAsciiString

    IGESControl_Controller.Init_s()
    writer = IGESControl_Writer("IN", 1)
    made = BRepToIGESBRep_Entity()
    made.SetModel(writer.Model())

    def entities(*members: Any) -> Any:
        array = HArray1_IGESData_IGESEntity(1, len(members))
        for number, member in enumerate(members, start=1):
            array.SetValue(number, member)
        return array

    def named(entity: Any, name: str) -> Any:
        title = IGESBasic_Name()
        title.Init(1, TCollection_HAsciiString(name))
        entity.AddProperty(title)
        return entity

    figures = {}
    for item in ITEMS:
        if item.shape not in figures:
            color = IGESGraph_Color()
            color.Init(*(100.0 * _srgb(v) for v in item.color), None)
            solid = made.TransferShape(solids()[item.shape])
            solid.InitColor(color)
            figure = figures[item.shape] = IGESBasic_SubfigureDef()
            figure.Init(0, TCollection_HAsciiString(item.name), entities(solid))

    def placed(item: Item) -> Any:
        entity, inch = IGESBasic_SingularSubfigure(), 0.0254
        entity.Init(figures[item.shape], gp_XYZ(0.0, 0.0, 0.0), False, 1.0)
        rows = HArray2_double(1, 3, 1, 4)
        for i in range(3):
            for j in range(4):
                rows.SetValue(i + 1, j + 1, item.matrix[i, j] / (inch if j == 3 else 1.0))
        matrix = IGESGeom_TransformationMatrix()
        matrix.Init(rows)
        entity.InitTransf(matrix)
        return entity

    front, loader = IGESBasic_Group(), IGESBasic_Group()
    front.Init(entities(*(placed(item) for item in ITEMS[:3])))
    loader.Init(entities(named(front, "FRONT"), placed(ITEMS[3])))
    writer.AddEntity(named(loader, "LOADER"))
    writer.ComputeModel()
    writer.Write(str(path))


def brep(path: Path, meshes: Meshes) -> None:
    from OCP.BRepTools import BRepTools

    BRepTools.Write_s(compound(*_all_solids()), str(path))


def freecad(path: Path, meshes: Meshes) -> None:
    """Two pins: one object and a link to it, in a group with a placement of its own; a hidden tool besides."""
    from OCP.BRepTools import BRepTools

    shapes = solids()
    group = translation(0.0, 0.0, 500.0)
    inside = [np.linalg.inv(group) @ _millimetres(i.matrix) for i in ITEMS[:3]]
    places = {"Boom": inside[0], "Pin": inside[1], "Bucket": _millimetres(ITEMS[3].matrix), "Tool": np.eye(4)}
    kinds = {"Boom": "plate", "Pin": "pin", "Bucket": "wedge", "Tool": "pin"}
    labels = {"Boom": "BOOM", "Pin": "PIN", "Bucket": "铲斗", "Tool": "TOOL"}
    types = {**dict.fromkeys(kinds, "Part::Feature"), "Front": "App::Part", "Link": "App::Link"}

    def placement(matrix: np.ndarray, name: str = "Placement") -> str:
        w = np.sqrt(max(0.0, 1.0 + np.trace(matrix[:3, :3]))) / 2.0
        x, y, z = np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]]) / (
            4 * w
        )
        p = matrix[:3, 3]
        return (
            f'<Property name="{name}"><PropertyPlacement Px="{p[0]}" Py="{p[1]}" Pz="{p[2]}" '
            f'Q0="{x:.17g}" Q1="{y:.17g}" Q2="{z:.17g}" Q3="{w:.17g}"/></Property>'
        )

    def entry(name: str, *properties: str, label: str = "") -> str:
        own = f'<Property name="Label"><String value={quoteattr(label or name)}/></Property>'
        return f'<Object name="{name}"><Properties>{own}{"".join(properties)}</Properties></Object>'

    data = [
        entry(n, f'<Property name="Shape"><Part file="{n}.brp"/></Property>', placement(places[n]), label=labels[n])
        for n in kinds
    ]
    members = "".join(f'<Link value="{n}"/>' for n in ("Boom", "Pin", "Link"))
    data.append(
        entry(
            "Front",
            f'<Property name="Group"><LinkList>{members}</LinkList></Property>',
            placement(group),
            label="FRONT",
        )
    )
    linked = '<Property name="LinkedObject"><XLink name="Pin"/></Property>'
    data.append(entry("Link", linked, placement(inside[2], "LinkPlacement"), label="PIN"))
    objects = "".join(f'<Object name="{n}" type="{t}"/>' for n, t in types.items())
    document = f"<Document><Objects>{objects}</Objects><ObjectData>{''.join(data)}</ObjectData></Document>"

    def look(name: str, color: Color) -> str:
        r, g, b = (round(255 * _srgb(v)) for v in color)
        shown = "false" if name == "Tool" else "true"
        return (
            f'<ViewProvider name="{name}"><Properties><Property name="Visibility"><Bool value="{shown}"/></Property>'
            f'<Property name="ShapeColor"><PropertyColor value="{r << 24 | g << 16 | b << 8}"/></Property>'
            "</Properties></ViewProvider>"
        )

    colors = {"Boom": ITEMS[0].color, "Pin": ITEMS[1].color, "Bucket": ITEMS[3].color, "Tool": (1.0, 1.0, 1.0)}
    looks = "".join(look(n, c) for n, c in colors.items())
    gui = f"<Document><ViewProviderData>{looks}</ViewProviderData></Document>"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("Document.xml", document)
        archive.writestr("GuiDocument.xml", gui)
        for name, kind in kinds.items():
            file = path.with_suffix(f".{name}.brp")
            BRepTools.Write_s(moved(shapes[kind], places[name]), str(file))
            archive.write(file, f"{name}.brp")
            file.unlink()


def _srgb(value: float) -> float:
    return 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055


def _world(item: Item, meshes: Meshes) -> np.ndarray:
    points, _ = meshes[item.shape]
    return points @ item.matrix[:3, :3].T + item.matrix[:3, 3]


def _gltf(meshes: Meshes) -> tuple[dict[str, Any], bytes]:
    blob, views, accessors, shapes, materials = b"", [], [], [], []
    order = list(meshes)
    for key in order:
        points, triangles = meshes[key]
        color = next(i.color for i in ITEMS if i.shape == key)
        for array, kind, component in (
            (points.astype("<f4"), "VEC3", 5126),
            (triangles.astype("<u4").reshape(-1), "SCALAR", 5125),
        ):
            bounds = {"min": array.min(0).tolist(), "max": array.max(0).tolist()} if kind == "VEC3" else {}
            accessors.append(
                {"bufferView": len(views), "componentType": component, "count": len(array), "type": kind, **bounds}
            )
            views.append({"buffer": 0, "byteOffset": len(blob), "byteLength": array.nbytes})
            blob += array.tobytes()
        at = len(accessors)
        shapes.append(
            {"primitives": [{"attributes": {"POSITION": at - 2}, "indices": at - 1, "material": len(materials)}]}
        )
        materials.append({"pbrMetallicRoughness": {"baseColorFactor": [*color, 1.0]}})
    nodes = [
        {"name": i.name, "mesh": order.index(i.shape), "matrix": i.matrix.T.reshape(-1).tolist()} for i in ITEMS
    ] + [{"name": "FRONT", "children": [0, 1, 2]}, {"name": "LOADER", "children": [4, 3]}]
    document = {
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [5]}], "scene": 0, "nodes": nodes, "meshes": shapes,
        "materials": materials, "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(blob)}],
    }  # fmt: skip
    return document, blob


def glb(path: Path, meshes: Meshes) -> None:
    document, blob = _gltf(meshes)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    blob += bytes(-len(blob) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(blob), 0x004E4942) + blob
    path.write_bytes(b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks)


def gltf(path: Path, meshes: Meshes) -> None:
    document, blob = _gltf(meshes)
    document["buffers"][0]["uri"] = "machine.bin"
    path.with_name("machine.bin").write_bytes(blob)
    path.write_text(json.dumps(document), encoding="utf-8")


def stl(path: Path, meshes: Meshes) -> None:
    corners = np.concatenate([_world(i, meshes)[meshes[i.shape][1]] for i in ITEMS]) * 1000.0
    records = np.zeros(len(corners), dtype=[("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
    records["v"] = corners
    path.write_bytes(bytes(80) + struct.pack("<I", len(corners)) + records.tobytes())


def obj(path: Path, meshes: Meshes) -> None:
    lines, start = ["mtllib machine.mtl"], 1
    for number, item in enumerate(ITEMS):
        lines += [f"o {item.name}", f"usemtl c{number}"]
        lines += [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in _world(item, meshes) * 1000.0]
        lines += [f"f {a} {b} {c}" for a, b, c in meshes[item.shape][1] + start]
        start += len(meshes[item.shape][0])
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    looks = "".join(f"newmtl c{n}\nKd {i.color[0]} {i.color[1]} {i.color[2]}\n" for n, i in enumerate(ITEMS))
    path.with_name("machine.mtl").write_text(looks)


def ply(path: Path, meshes: Meshes) -> None:
    vertices, faces, start = [], [], 0
    for item in ITEMS:
        rgb = " ".join(str(round(255 * v)) for v in item.color)
        vertices += [f"{x:.9g} {y:.9g} {z:.9g} {rgb}" for x, y, z in _world(item, meshes)]
        faces += [f"3 {a} {b} {c}" for a, b, c in meshes[item.shape][1] + start]
        start += len(meshes[item.shape][0])
    head = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}"]
    head += [f"property float {a}" for a in "xyz"] + [f"property uchar {c}" for c in ("red", "green", "blue")]
    head += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    path.write_text("\n".join([*head, *vertices, *faces]) + "\n")


def threemf(path: Path, meshes: Meshes) -> None:
    order = list(meshes)
    inch = 0.0254
    colors = {i.shape: "#" + "".join(f"{round(255 * _srgb(v)):02X}" for v in i.color) for i in ITEMS}
    names = {i.shape: i.name for i in ITEMS}

    def numbers(matrix: np.ndarray) -> str:
        scaled = matrix.copy()
        scaled[:3, 3] /= inch
        return " ".join(f"{v:.12g}" for v in scaled[:3].T.reshape(-1))

    text = []
    for number, key in enumerate(order):
        points, triangles = meshes[key]
        rows = "".join(f'<vertex x="{x:.12g}" y="{y:.12g}" z="{z:.12g}"/>' for x, y, z in points / inch)
        faces = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in triangles)
        text.append(
            f'<object id="{number + 2}" type="model" name={quoteattr(names[key])} pid="1" pindex="{number}">'
            f"<mesh><vertices>{rows}</vertices><triangles>{faces}</triangles></mesh></object>"
        )
    parts = [f'<component objectid="{order.index(i.shape) + 2}" transform="{numbers(i.matrix)}"/>' for i in ITEMS]
    text.append(f'<object id="10" type="model" name="FRONT"><components>{"".join(parts[:3])}</components></object>')
    whole = f'<component objectid="10"/>{parts[3]}'
    text.append(f'<object id="11" type="model" name="LOADER"><components>{whole}</components></object>')
    bases = "".join(f'<base name="m" displaycolor="{colors[k]}"/>' for k in order)
    model = (
        '<?xml version="1.0" encoding="UTF-8"?><model unit="inch" '
        'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>'
        f'<basematerials id="1">{bases}</basematerials>{"".join(text)}</resources>'
        '<build><item objectid="11"/></build></model>'
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("3D/3dmodel.model", model)


def collada(path: Path, meshes: Meshes) -> None:
    """Centimetres, Z up."""
    geometry, effects, materials = [], [], []
    for key, (points, triangles) in meshes.items():
        color = next(i.color for i in ITEMS if i.shape == key)
        numbers = " ".join(f"{v:.12g}" for v in (points * 100.0).reshape(-1))
        indices = " ".join(str(v) for v in triangles.reshape(-1))
        params = "".join(f'<param name="{a}" type="float"/>' for a in "XYZ")
        geometry.append(
            f'<geometry id="{key}"><mesh><source id="{key}-p"><float_array id="{key}-a" count="{points.size}">{numbers}'
            f'</float_array><technique_common><accessor source="#{key}-a" count="{len(points)}" stride="3">{params}'
            f'</accessor></technique_common></source><vertices id="{key}-v"><input semantic="POSITION" '
            f'source="#{key}-p"/></vertices><triangles material="m" count="{len(triangles)}"><input semantic="VERTEX" '
            f'source="#{key}-v" offset="0"/><p>{indices}</p></triangles></mesh></geometry>'
        )
        rgba = " ".join(str(v) for v in (*color, 1.0))
        effects.append(
            f'<effect id="{key}-fx"><profile_COMMON><technique sid="c"><lambert><diffuse><color>{rgba}</color>'
            "</diffuse></lambert></technique></profile_COMMON></effect>"
        )
        materials.append(f'<material id="{key}-m"><instance_effect url="#{key}-fx"/></material>')

    def node(number: int, item: Item) -> str:
        matrix = item.matrix.copy()
        matrix[:3, 3] *= 100.0
        numbers = " ".join(f"{v:.12g}" for v in matrix.reshape(-1))
        bound = f'<instance_material symbol="m" target="#{item.shape}-m"/>'
        return (
            f'<node id="n{number}" name={quoteattr(item.name)}><matrix>{numbers}</matrix><instance_geometry '
            f'url="#{item.shape}"><bind_material><technique_common>{bound}</technique_common></bind_material>'
            "</instance_geometry></node>"
        )

    nodes = [node(n, i) for n, i in enumerate(ITEMS)]
    scene = f'<node id="l" name="LOADER"><node id="f" name="FRONT">{"".join(nodes[:3])}</node>{nodes[3]}</node>'
    path.write_text(
        '<?xml version="1.0" encoding="utf-8"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" '
        'version="1.4.1"><asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>'
        f"<library_effects>{''.join(effects)}</library_effects><library_materials>{''.join(materials)}"
        f"</library_materials><library_geometries>{''.join(geometry)}</library_geometries><library_visual_scenes>"
        f'<visual_scene id="s">{scene}</visual_scene></library_visual_scenes>'
        '<scene><instance_visual_scene url="#s"/></scene></COLLADA>',
        encoding="utf-8",
    )


def fbx(path: Path, meshes: Meshes, *, binary: bool = False) -> None:
    """Inches, Z up; one geometry for two pins."""
    inch = 0.0254
    number = {key: 1000 + n for n, key in enumerate(meshes)}
    objects = [cad_fbx.geometry(number[key], points / inch, faces) for key, (points, faces) in meshes.items()]
    objects += [
        cad_fbx.material(number[key] + 100, key, next(i.color for i in ITEMS if i.shape == key)) for key in meshes
    ]
    objects += [cad_fbx.model(n, name, np.eye(4), mesh=False) for n, name in ((1, "LOADER"), (2, "FRONT"))]
    links = [(1, 0), (2, 1)]
    for n, item in enumerate(ITEMS, start=10):
        place = item.matrix.copy()
        place[:3, 3] /= inch
        objects.append(cad_fbx.model(n, item.name, place, mesh=True))
        links += [(n, len(item.path)), (number[item.shape], n), (number[item.shape] + 100, n)]
    cad_fbx.write(path, objects, links, unit_cm=2.54, binary=binary)


def fbx_binary(path: Path, meshes: Meshes) -> None:
    """The same records as bytes."""
    fbx(path, meshes, binary=True)


def usd(path: Path, meshes: Meshes) -> None:
    """Centimetres, prototypes with their materials inside, instances."""
    from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade

    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    for key, (points, triangles) in meshes.items():
        color = next(i.color for i in ITEMS if i.shape == key)
        root = stage.CreateClassPrim(f"/{key}")
        mesh = UsdGeom.Mesh.Define(stage, root.GetPath().AppendChild("mesh"))
        mesh.CreatePointsAttr((points * 100.0).astype(np.float32))
        mesh.CreateFaceVertexCountsAttr([3] * len(triangles))
        mesh.CreateFaceVertexIndicesAttr(triangles.reshape(-1).tolist())
        material = UsdShade.Material.Define(stage, root.GetPath().AppendChild("look"))
        shader = UsdShade.Shader.Define(stage, material.GetPath().AppendChild("shader"))
        shader.CreateIdAttr("UsdPreviewSurface")
        shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*color))
        material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
        UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(material)
    for number, item in enumerate(ITEMS):
        above = "/" + "/".join(item.path)
        UsdGeom.Xform.Define(stage, above)
        prim = UsdGeom.Xform.Define(stage, f"{above}/part_{number}")
        prim.GetPrim().SetDisplayName(item.name)
        matrix = item.matrix.copy()
        matrix[:3, 3] *= 100.0
        prim.AddTransformOp().Set(Gf.Matrix4d(matrix.T.tolist()))
        prim.GetPrim().GetReferences().AddInternalReference(f"/{item.shape}")
        prim.GetPrim().SetInstanceable(True)
    stage.SetDefaultPrim(stage.GetPrimAtPath("/LOADER"))
    stage.Save()


def usdz(path: Path, meshes: Meshes) -> None:
    from pxr import Sdf, UsdUtils

    usd(path.with_suffix(".usdc"), meshes)
    UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath(str(path.with_suffix(".usdc"))), str(path))
    path.with_suffix(".usdc").unlink()


def urdf(path: Path, meshes: Meshes) -> None:
    """A link a part, its mesh an STL in millimetres with a scale; the wedge turns about Y on the plate."""
    for key, (points, triangles) in meshes.items():
        records = np.zeros(len(triangles), dtype=[("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
        records["v"] = (points * 1000.0)[triangles]
        path.with_name(f"{key}.stl").write_bytes(bytes(80) + struct.pack("<I", len(triangles)) + records.tobytes())

    def origin(matrix: np.ndarray) -> str:
        r = matrix[:3, :3]
        rpy = (np.arctan2(r[2, 1], r[2, 2]), np.arcsin(-r[2, 0]), np.arctan2(r[1, 0], r[0, 0]))
        numbers = [" ".join(f"{v:.12g}" for v in values) for values in (matrix[:3, 3], rpy)]
        return f'<origin xyz="{numbers[0]}" rpy="{numbers[1]}"/>'

    links, joints = ['<link name="base"/>'], []
    for number, item in enumerate(ITEMS):
        rgba = " ".join(str(v) for v in (*item.color, 1.0))
        links.append(
            f'<link name="l{number}"><visual name={quoteattr(item.name)}><geometry><mesh filename='
            f'"package://loader/{item.shape}.stl" scale="0.001 0.001 0.001"/></geometry>'
            f'<material name="m{number}"><color rgba="{rgba}"/></material></visual></link>'
        )
        kind = "revolute" if item.shape == "wedge" else "fixed"
        limits = '<axis xyz="0 1 0"/><limit lower="-0.5" upper="0.8" effort="1" velocity="1"/>' if number == 3 else ""
        joints.append(
            f'<joint name="j{number}" type="{kind}"><parent link="base"/><child link="l{number}"/>'
            f"{origin(item.matrix)}{limits}</joint>"
        )
    path.write_text(f'<robot name="LOADER">{"".join(links + joints)}</robot>', encoding="utf-8")


def mjcf(path: Path, meshes: Meshes) -> None:
    assets, bodies = [], []
    for key, (points, triangles) in meshes.items():
        vertices = " ".join(f"{v:.9g}" for v in points.reshape(-1))
        faces = " ".join(str(v) for v in triangles.reshape(-1))
        assets.append(f'<mesh name="{key}" vertex="{vertices}" face="{faces}"/>')
    for number, item in enumerate(ITEMS):
        r, p = item.matrix[:3, :3], item.matrix[:3, 3]
        axes = " ".join(f"{v:.12g}" for v in (*r[:, 0], *r[:, 1]))
        rgba = " ".join(str(v) for v in (*item.color, 1.0))
        title = quoteattr(f"{item.name} {number}")
        joint = '<joint name="tilt" type="hinge" axis="0 1 0" range="-30 45"/>' if number == 3 else ""
        bodies.append(
            f'<body name={title} pos="{p[0]} {p[1]} {p[2]}" xyaxes="{axes}">{joint}'
            f"<geom name={title} type='mesh' mesh='{item.shape}' rgba='{rgba}' contype='0' conaffinity='0' group='2'/>"
            '<geom type="box" size="0.1 0.1 0.1" group="3"/></body>'
        )
    path.write_text(
        f'<mujoco model="LOADER"><asset>{"".join(assets)}</asset><worldbody><geom type="plane" size="5 5 1"/>'
        f'<body name="LOADER">{"".join(bodies)}</body></worldbody></mujoco>',
        encoding="utf-8",
    )


def dxf(path: Path, meshes: Meshes) -> None:
    import ezdxf
    from ezdxf import units
    from ezdxf.math import Matrix44
    from ezdxf.render import MeshBuilder

    # No random numbers, and not the time: the same file every time.
    ezdxf.options.write_fixed_meta_data_for_testing = True
    document = ezdxf.new("R2018", units=units.MM)
    blocks = {}
    for key, (points, triangles) in meshes.items():
        item = next(i for i in ITEMS if i.shape == key)
        block = blocks[key] = document.blocks.new(item.name)
        builder = MeshBuilder()
        builder.vertices, builder.faces = [tuple(v) for v in points * 1000.0], triangles.tolist()
        mesh = builder.render_mesh(block)
        mesh.rgb = tuple(round(255 * _srgb(v)) for v in item.color)
    front = document.blocks.new("FRONT")
    for layout, items in ((front, ITEMS[:3]), (document.modelspace(), ITEMS[3:])):
        for item in items:
            insert = layout.add_blockref(blocks[item.shape].name, (0, 0, 0))
            insert.transform(Matrix44(_millimetres(item.matrix).T.reshape(-1)))
    document.modelspace().add_blockref("FRONT", (0, 0, 0))
    document.saveas(path)


def ifc(path: Path, meshes: Meshes) -> None:
    """Millimetres; an assembly with its parts, shapes as triangulated face sets."""
    import ifcopenshell
    import ifcopenshell.guid

    numbers = itertools.count(1)

    def guid() -> str:
        return str(ifcopenshell.guid.compress(f"{next(numbers):032x}"))

    f = ifcopenshell.file(schema="IFC4")

    def new(kind: str, *values: Any) -> Any:
        return f.create_entity(kind, *values)

    def placed(matrix: np.ndarray, above: Any = None) -> Any:
        p, z, x = (tuple(float(v) for v in m) for m in (matrix[:3, 3], matrix[:3, 2], matrix[:3, 0]))
        axes = new("IfcAxis2Placement3D", new("IfcCartesianPoint", p), new("IfcDirection", z), new("IfcDirection", x))
        return new("IfcLocalPlacement", above, axes)

    origin = placed(np.eye(4))
    context = new("IfcGeometricRepresentationContext", None, "Model", 3, 1e-5, origin.RelativePlacement)
    unit = new("IfcSIUnit", None, "LENGTHUNIT", "MILLI", "METRE")
    project = new(
        "IfcProject", guid(), None, "P", None, None, None, None, (context,), new("IfcUnitAssignment", (unit,))
    )
    shapes = {}
    for key, (points, triangles) in meshes.items():
        rows = tuple(tuple(float(v) for v in p) for p in points * 1000.0)
        faces = tuple(tuple(int(v) + 1 for v in t) for t in triangles)
        body = new("IfcTriangulatedFaceSet", new("IfcCartesianPointList3D", rows), None, None, faces, None)
        rgb = new("IfcColourRgb", None, *next(i.color for i in ITEMS if i.shape == key))
        style = new("IfcSurfaceStyle", None, "BOTH", (new("IfcSurfaceStyleShading", rgb, 0.0),))
        new("IfcStyledItem", body, (style,), None)
        represented = new("IfcShapeRepresentation", context, "Body", "Tessellation", (body,))
        shapes[key] = new("IfcProductDefinitionShape", None, None, (represented,))

    def part(kind: str, name: str, matrix: np.ndarray, shape: Any = None) -> Any:
        return new(kind, guid(), None, name, None, None, placed(_millimetres(matrix), origin), shape, None)

    parts = [part("IfcBuildingElementProxy", i.name, i.matrix, shapes[i.shape]) for i in ITEMS]
    front, loader = (part("IfcElementAssembly", n, np.eye(4)) for n in ("FRONT", "LOADER"))
    for whole, members in ((project, (loader,)), (loader, (front, parts[3])), (front, tuple(parts[:3]))):
        new("IfcRelAggregates", guid(), None, None, None, whole, members)
    f.write(str(path))


Writer = Callable[[Path, Meshes], None]
WRITERS: dict[str, tuple[str, Writer]] = {
    "STEP": ("machine.step", step),
    "IGES": ("machine.igs", iges),
    "BREP": ("machine.brep", brep),
    "FreeCAD": ("machine.FCStd", freecad),
    "GLB": ("machine.glb", glb),
    "glTF": ("machine.gltf", gltf),
    "STL": ("machine.stl", stl),
    "OBJ": ("machine.obj", obj),
    "PLY": ("machine.ply", ply),
    "3MF": ("machine.3mf", threemf),
    "COLLADA": ("machine.dae", collada),
    "FBX (text)": ("machine.fbx", fbx),
    "FBX (binary)": ("machine.fbx", fbx_binary),
    "USD (usda)": ("machine.usda", usd),
    "USD (usdc)": ("machine.usdc", usd),
    "USD (usdz)": ("machine.usdz", usdz),
    "URDF": ("machine.urdf", urdf),
    "MJCF": ("machine.xml", mjcf),
    "DXF": ("machine.dxf", dxf),
    "IFC": ("machine.ifc", ifc),
}
"""Format → the file's name and what writes it."""
