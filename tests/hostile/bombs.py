"""Files of a few lines, or of a few megabytes, that say they are machines of gigabytes: what makes each, and a word of
its reader's answer."""

from __future__ import annotations

import json
import struct
import zipfile
import zlib
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Bomb:
    """A file's name and content. What is refused for what it says of itself is not built (`early`)."""

    name: str
    file: str
    content: Callable[[], bytes]
    word: str
    early: bool = True
    beside_mb: int = 896
    """What its reader may take beside what it needs: less where it takes long to fill."""


def glb(document: dict[str, object], blob: bytes) -> bytes:
    """A GLB file of a document and a buffer."""
    text = json.dumps({"asset": {"version": "2.0"}, "buffers": [{"byteLength": len(blob)}], **document}).encode()
    text, blob = text + b" " * (-len(text) % 4), blob + b"\0" * (-len(blob) % 4)
    head = struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(blob), len(text), 0x4E4F534A)
    return head + text + struct.pack("<II", len(blob), 0x004E4942) + blob


def triangle(**more: object) -> dict[str, object]:
    """A glTF document of one mesh whose points and corners are the first two accessors."""
    mesh = {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}
    return {"meshes": [mesh], "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], **more}


def greedy_gltf() -> bytes:
    many = 2_000_000_000
    accessors = [{"bufferView": 0, "componentType": 5126, "count": many, "type": "VEC3"},
                 {"bufferView": 0, "componentType": 5125, "count": many, "type": "SCALAR"}]  # fmt: skip
    return glb(triangle(accessors=accessors, bufferViews=[{"buffer": 0, "byteLength": 64}]), bytes(64))


def branching_gltf() -> bytes:
    nodes: list[dict[str, object]] = [{"children": [k + 1, k + 1]} for k in range(40)]
    return glb({**triangle(), "nodes": [*nodes, {"mesh": 0}]}, bytes(64))


def huge_picture() -> bytes:
    """A triangle with a picture of 8192 by 8192 black points, 200 kB."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(deflated(8192 * (3 * 8192 + 1)))
    picture = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 8192, 8192, 8, 2, 0, 0, 0))
    picture += chunk(b"IDAT", rows) + chunk(b"IEND", b"")
    points = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack("<3I", 0, 1, 2)
    views = [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12},
             {"buffer": 0, "byteOffset": 48, "byteLength": len(picture)}]  # fmt: skip
    accessors = [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                 {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"}]  # fmt: skip
    document = triangle(
        bufferViews=views, accessors=accessors, images=[{"bufferView": 2, "mimeType": "image/png"}],
        textures=[{"source": 0}], materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    )  # fmt: skip
    document["meshes"] = [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}]
    return glb(document, points + picture)


def deflated(size: int) -> list[bytes]:
    """So many zeros, compressed, without being made: a block of them again and again."""
    one = 1 << 20
    packer = zlib.compressobj(9)
    first = packer.compress(bytes(one)) + packer.flush(zlib.Z_FULL_FLUSH)
    again = packer.compress(bytes(one)) + packer.flush(zlib.Z_FULL_FLUSH)
    whole, rest = divmod(size, one)
    end = zlib.compressobj(9, zlib.DEFLATED, -15)
    # The sum of zeros: 1, and their number.
    last = end.compress(bytes(rest)) + end.flush() + struct.pack(">HH", size % 65521, 1)
    return [first, *[again] * (whole - 1), last]


def pdf() -> bytes:
    """A page whose content is 2.5 GB of blanks."""
    content = b"".join(deflated(2_500 << 20))
    return (
        b"%%PDF-1.4\n1 0 obj<</Type/Catalog/Pages 2 0 R>>endobj\n2 0 obj<</Type/Pages/Kids[3 0 R]/Count 1>>endobj\n"
        b"3 0 obj<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]/Contents 4 0 R>>endobj\n"
        b"4 0 obj<</Filter/FlateDecode/Length %d>>stream\n"
        % len(content)
        + content
        + b"\nendstream endobj\ntrailer<</Root 1 0 R/Size 5>>\n%%EOF\n"
    )


def zipped(name: str, text: str) -> bytes:
    from io import BytesIO

    out = BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, text)
    return out.getvalue()


def branching_3mf() -> bytes:
    objects = "".join(
        f'<object id="{k}"><components>{f"""<component objectid="{k + 1}"/>""" * 2}</components></object>'
        for k in range(1, 40)
    )
    mesh = "<mesh><vertices/><triangles/></mesh>"
    text = f'<resources>{objects}<object id="40">{mesh}</object></resources><build><item objectid="1"/></build>'
    return zipped("3D/3dmodel.model", f"<model>{text}</model>")


def branching_freecad() -> bytes:
    """Groups of two links to the group below."""
    names = [f"G{k}" for k in range(24)]
    links = [(f"L{k}{side}", k + 1) for k in range(23) for side in "ab"]
    objects = [f'<Object type="App::DocumentObjectGroup" name="{n}"/>' for n in names]
    objects += [f'<Object type="App::Link" name="{n}"/>' for n, _ in links]
    data = []
    for k, name in enumerate(names):
        held = "".join(f'<Link value="L{k}{side}"/>' for side in "ab") if k < 23 else ""
        data.append(f'<Object name="{name}"><Properties><Property name="Group" type="App::PropertyLinkList">'
                    f"<LinkList>{held}</LinkList></Property></Properties></Object>")  # fmt: skip
    for name, below in links:
        data.append(f'<Object name="{name}"><Properties><Property name="LinkedObject" type="App::PropertyXLink">'
                    f'<XLink name="G{below}"/></Property></Properties></Object>')  # fmt: skip
    text = f"<Objects>{''.join(objects)}</Objects><ObjectData>{''.join(data)}</ObjectData>"
    return zipped("Document.xml", f'<Document SchemaVersion="4">{text}</Document>')


def branching_step() -> bytes:
    lines = [f"#{k}=PRODUCT_DEFINITION_SHAPE('','',#{k + 100});" for k in range(1, 41)]
    for k in range(1, 40):
        use = f"=NEXT_ASSEMBLY_USAGE_OCCURRENCE('','','',#{k + 100},#{k + 101},$);"
        lines += [f"#{200 + 2 * k}{use}", f"#{201 + 2 * k}{use}"]
    text = "\n".join(("ISO-10303-21;", "HEADER;", "ENDSEC;", "DATA;", *lines, "ENDSEC;", "END-ISO-10303-21;", ""))
    return text.encode()


def branching_dxf() -> bytes:
    """Blocks of a row of 30 000 of the block below."""
    rows = "0\nINSERT\n8\n0\n100\nAcDbBlockReference\n2\nB{}\n10\n0\n20\n0\n30\n0\n70\n30000\n71\n30000\n44\n1\n45\n1\n"
    face = "0\n3DFACE\n8\n0\n10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n0\n12\n1\n22\n1\n32\n0\n13\n1\n23\n1\n33\n0\n"
    head = "0\nBLOCK\n8\n0\n2\nB{0}\n70\n0\n10\n0\n20\n0\n30\n0\n3\nB{0}\n"
    blocks = "".join(f"{head.format(k)}{rows.format(k + 1) if k < 5 else face}0\nENDBLK\n" for k in range(6))
    text = f"0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{rows.format(0)}0\nENDSEC\n0\nEOF\n"
    return text.encode()


def branching_usd(instanceable: bool) -> bytes:
    """Prims of ten references each to the prim below."""
    kind = "instanceable = true\n" if instanceable else ""
    text = '#usda 1.0\n(defaultPrim = "A0"\nmetersPerUnit = 1)\n'
    for k in range(8):
        below = "".join(f'def Xform "c{n}" ({kind}references = </A{k + 1}>) {{\n}}\n' for n in range(10))
        text += f'def Xform "A{k}" {{\n{below}}}\n'
    return (text + 'def Xform "A8" {\ndef Cube "c" {\n}\n}\n').encode()


def collada(arrays: str = "", entities: str = "", name: str = "n") -> bytes:
    """Ten lines of COLLADA with a mesh."""
    return f"""<?xml version="1.0"?>{entities}
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter="1"/></asset>
<library_geometries><geometry id="g"><mesh>{arrays}</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="{name}"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>""".encode()


def greedy_collada() -> bytes:
    many = 2_000_000_000
    return collada(
        f"""<source id="p"><float_array id="a" count="{many}">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#a" count="{many}" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION"
source="#p"/></vertices><triangles count="{many}"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p>
</triangles>"""
    )


_ENTITIES = "".join(f"<!ENTITY l{k + 1} '{f'&l{k};' * 10}'>" for k in range(12))
LAUGHS = f"<!DOCTYPE r [<!ENTITY l0 'ha'>{_ENTITIES}]>"


def fbx_record(name: bytes, properties: list[bytes], below: list[bytes], at: int) -> bytes:
    """A record of a binary FBX file that begins at a place; `below` are whole records made for theirs."""
    data, held = b"".join(properties), b"".join(below) + (bytes(13) if below else b"")
    end = at + 13 + len(name) + len(data) + len(held)
    return struct.pack("<III", end, len(properties), len(data)) + bytes([len(name)]) + name + data + held


def greedy_fbx() -> bytes:
    """A binary FBX file with an array of 300 million numbers, 2.4 GB, compressed to as many megabytes."""
    packed = b"".join(deflated(2_400 << 20))
    numbers = b"d" + struct.pack("<III", 300 << 20, 1, len(packed)) + packed

    def text(words: bytes) -> bytes:
        return b"S" + struct.pack("<I", len(words)) + words

    def number(value: int) -> bytes:
        return b"L" + struct.pack("<q", value)

    geometry = [number(1), text(b"a\0\1Geometry"), text(b"Mesh")]
    model = [number(2), text(b"a\0\1Model"), text(b"Mesh")]
    data = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", 7400)
    inner = len(data) + 13 + len(b"FBXHeaderExtension")
    version = fbx_record(b"FBXVersion", [b"I" + struct.pack("<i", 7400)], [], inner)
    data += fbx_record(b"FBXHeaderExtension", [], [version], len(data))
    inner = len(data) + 13 + len(b"Objects")
    vertices = fbx_record(b"Vertices", [numbers], [], inner + 13 + len(b"Geometry") + len(b"".join(geometry)))
    mesh = fbx_record(b"Geometry", geometry, [vertices], inner)
    node = fbx_record(b"Model", model, [fbx_record(b"V", [b"I\0\0\0\0"], [], inner + len(mesh) + 13 + 5
                      + len(b"".join(model)))], inner + len(mesh))  # fmt: skip
    data += fbx_record(b"Objects", [], [mesh, node], len(data))
    inner = len(data) + 13 + len(b"Connections")
    first = fbx_record(b"C", [text(b"OO"), number(1), number(2)], [], inner)
    other = fbx_record(b"C", [text(b"OO"), number(2), number(0)], [], inner + len(first))
    return data + fbx_record(b"Connections", [], [first, other], len(data)) + bytes(13)


BOMBS = (
    Bomb("OBJ, a face of 9 million corners", "a.obj",
         lambda: b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf " + b"1 2 3 " * 3_000_000, "100000 corners"),
    Bomb("STL of 4 billion triangles", "a.stl", lambda: bytes(80) + b"\xff\xff\xff\xff" + bytes(500), "4294967295"),
    Bomb("PLY of 2 billion points", "a.ply",
         lambda: b"ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\n"
         b"property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
         + bytes(100), "2000000001"),
    Bomb("glTF of 2 billion points", "a.glb", greedy_gltf, "2000000000"),
    Bomb("glTF, a tree of 2^40 nodes", "a.glb", branching_gltf, "twice"),
    Bomb("STEP, 2^39 parts", "a.step", branching_step, "200000 parts"),
    Bomb("DXF, 10^54 blocks", "a.dxf", branching_dxf, "200000 parts"),
    Bomb("3MF, 2^39 objects", "a.3mf", branching_3mf, "200000 parts"),
    Bomb("FreeCAD, 2^23 links", "a.fcstd", branching_freecad, "200000 parts"),
    Bomb("USD, 10^8 instances", "a.usda", lambda: branching_usd(True), "200000 parts", early=False),
    Bomb("USD, 10^8 references", "a.usda", lambda: branching_usd(False), "needs more", early=False,
         beside_mb=256),
    Bomb("COLLADA of 2 billion points", "a.dae", greedy_collada, ""),
    Bomb("COLLADA, entities in entities", "a.dae", lambda: collada("", LAUGHS, "&l12;"), ""),
    Bomb("URDF, entities in entities", "a.urdf",
         lambda: (LAUGHS + '<robot name="r"><link name="&l12;"/></robot>').encode(), ""),
    Bomb("FBX, an array of 2.4 GB", "a.fbx", greedy_fbx, "", early=False),
    Bomb("glTF, a picture of 64 million points", "a.glb", huge_picture, "", early=False),
    Bomb("PDF with a stream of 2.5 GB", "a.pdf", pdf, "memory", early=False),
)  # fmt: skip
