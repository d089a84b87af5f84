"""What the internet gives: tessellated AP242, USD as CAD converters write it and people re-parent it, references,
folders of parts — each read, converted and sound."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cad_validators import errors_of

from kit.cadfiles.step import Node, Use, box, cylinder, translation, write_step
from yellowiron.cad import read_cad
from yellowiron.model.assembly import Assembly
from yellowiron.usd import write_assembly

pytestmark = pytest.mark.slow


def converted(source: Path, folder: Path) -> Assembly:
    """What is read, after its USD has passed the validators in another folder."""
    pytest.importorskip("physx_usd_schemas")
    pytest.importorskip("newton_usd_schemas")
    assembly = read_cad(source)
    write_assembly(assembly, folder / "out" / "machine.usdc")
    (folder / "out").rename(folder / "moved")
    assert errors_of(folder / "moved" / "machine.usdc") == []
    return assembly


def tessellated(shape: object) -> object:
    """A solid of the same triangles, without a surface under them."""
    from OCP.BRep import BRep_Builder, BRep_Tool
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.Poly import Poly_Triangle
    from OCP.TopAbs import TopAbs_FACE, TopAbs_REVERSED
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS, TopoDS_Face, TopoDS_Shell, TopoDS_Solid

    BRepMesh_IncrementalMesh(shape, 0.1)
    builder, shell, solid = BRep_Builder(), TopoDS_Shell(), TopoDS_Solid()
    builder.MakeShell(shell)
    explorer = TopExp_Explorer(shape, TopAbs_FACE)
    while explorer.More():
        face = TopoDS.Face(explorer.Current())
        bare = TopoDS_Face()
        mesh = BRep_Tool.Triangulation_s(face, TopLoc_Location()).Copy()
        if face.Orientation() == TopAbs_REVERSED:
            # Open CASCADE writes triangles as they are, whichever way their face looks.
            for i in range(1, mesh.NbTriangles() + 1):
                a, b, c = mesh.Triangle(i).Get()
                mesh.SetTriangle(i, Poly_Triangle(a, c, b))
        builder.MakeFace(bare, mesh)
        builder.Add(shell, bare)
        explorer.Next()
    shell.Closed(True)
    builder.MakeSolid(solid)
    builder.Add(solid, shell)
    return solid


def test_tessellated_ap242(tmp_path: Path) -> None:
    from OCP.Interface import Interface_Static

    pin = Node("PIN", tessellated(cylinder(25.0, 200.0)), color=(0.1, 0.2, 0.3))
    root = Node("LOADER", children=[Use(pin), Use(pin, translation(500.0, 0.0, 0.0))])
    Interface_Static.SetIVal_s("write.step.tessellated", 1)
    try:
        write_step(tmp_path / "a.step", root, schema="AP242DIS")
    finally:
        Interface_Static.SetIVal_s("write.step.tessellated", 0)
    assert b"TESSELLATED" in (tmp_path / "a.step").read_bytes()
    assembly = converted(tmp_path / "a.step", tmp_path)
    assert [p.id for p in assembly.parts] == ["LOADER/PIN", "LOADER/PIN#2"] and len(assembly.shapes) == 1
    shape = assembly.shape_of(assembly.parts[0])
    assert shape.closed and not shape.exact
    assert shape.volume == pytest.approx(np.pi * 0.025**2 * 0.2, rel=0.02)
    assert [round(c.radius, 4) for c in shape.cylinders] == [0.025]
    assert "CAD011" in {f.code for f in assembly.findings}


def test_external_references(tmp_path: Path) -> None:
    nodes = Node("TOP", children=[Use(Node("ARM", box(100, 200, 300))), Use(Node("PIN", cylinder(5, 50)))])
    (tmp_path / "parts").mkdir()
    write_step(tmp_path / "parts" / "top.step", nodes, external="part_")
    assert len(list((tmp_path / "parts").iterdir())) == 3
    assembly = converted(tmp_path / "parts" / "top.step", tmp_path)
    assert [p.id for p in assembly.parts] == ["TOP/ARM", "TOP/PIN"]
    # The folder as a whole is the same machine, once.
    assert [p.name for p in read_cad(tmp_path / "parts").parts] == ["ARM", "PIN"]


def test_a_folder_of_parts(tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    write_step(tmp_path / "parts" / "BOOM.step", Node("BOOM", box(1000, 200, 300)))
    write_step(tmp_path / "parts" / "PIN.stp", Node("PIN", cylinder(25, 200)))
    assembly = converted(tmp_path / "parts", tmp_path)
    assert [p.name for p in assembly.parts] == ["BOOM", "PIN"]


CONVERTED = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 0.01
    upAxis = "Y"
)
def Xform "World"
{
    def Scope "Looks"
    {
        def Material "Steel_Yellow"
        {
            token outputs:mdl:surface.connect = </World/Looks/Steel_Yellow/Shader.outputs:out>
            def Shader "Shader"
            {
                uniform token info:implementationSource = "sourceAsset"
                uniform asset info:mdl:sourceAsset = @OmniPBR.mdl@
                uniform token info:mdl:sourceAsset:subIdentifier = "OmniPBR"
                color3f inputs:diffuse_color_constant = (0.9, 0.6, 0.05)
                float inputs:metallic_constant = 0.75
                float inputs:reflection_roughness_constant = 0.25
                token outputs:out
            }
        }
    }
    def Xform "tn__WHEELLOADERASSY_sC" (displayName = "WHEEL LOADER ASSY")
    {
        matrix4d xformOp:transform = ((0.1, 0, 0, 0), (0, 0.1, 0, 0), (0, 0, 0.1, 0), (0, 0, 0, 1))
        uniform token[] xformOpOrder = ["xformOp:transform"]
        def Xform "boom" (doc = "re-parented by hand: the parts below came from elsewhere in the tree")
        {
            double3 xformOp:translate = (1000, 0, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
            def Xform "tn__PIN40_gA" (
                displayName = "PIN 40"
                instanceable = true
                prepend references = </Prototypes/tn__PIN40_gA>
            )
            {
                double3 xformOp:translate = (0, 500, 0)
                uniform token[] xformOpOrder = ["xformOp:translate"]
            }
            def Xform "tn__PIN40_gB" (
                displayName = "PIN 40"
                prepend references = </Prototypes/tn__PIN40_gA>
            )
            {
                matrix4d xformOp:transform = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (7, 8, 9, 1))
                uniform token[] xformOpOrder = ["!resetXformStack!", "xformOp:transform"]
            }
            def Xform "hidden" (prepend references = </Prototypes/tn__PIN40_gA>)
            {
                token visibility = "invisible"
            }
        }
    }
}
class "Prototypes"
{
    def Xform "tn__PIN40_gA"
    {
        def Mesh "tn__PIN40_gA_mesh_0" (
            displayName = "Mesh_0"
            prepend apiSchemas = ["MaterialBindingAPI"]
        )
        {
            rel material:binding = </World/Looks/Steel_Yellow>
            int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
            int[] faceVertexIndices = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]
            point3f[] points = [(0,0,0), (0,0,2), (0,3,0), (0,3,2), (4,0,0), (4,0,2), (4,3,0), (4,3,2)]
            uniform token orientation = "rightHanded"
        }
    }
}
"""
"""As a CAD converter of a simulation platform writes it: millimetres under a scale, encoded names with the original as
display name, prototypes and MDL materials; then parts re-parented by hand."""


def test_usd_of_a_converter_re_parented_by_hand(tmp_path: Path) -> None:
    (tmp_path / "machine.usda").write_text(CONVERTED, encoding="utf-8")
    assembly = converted(tmp_path / "machine.usda", tmp_path)
    assert [p.id for p in assembly.parts] == [
        "World/WHEEL LOADER ASSY/boom/PIN 40",
        "World/WHEEL LOADER ASSY/boom/PIN 40#2",
    ]
    assert len(assembly.shapes) == 1
    low = [assembly.points_of(p).min(axis=0) for p in assembly.parts]
    np.testing.assert_allclose(low[0], (1.0, 0.5, 0.0), atol=1e-6)
    np.testing.assert_allclose(low[1], (0.07, 0.08, 0.09), atol=1e-6)
    size = [np.ptp(assembly.points_of(p), axis=0) for p in assembly.parts]
    np.testing.assert_allclose(size, [(0.004, 0.003, 0.002), (0.04, 0.03, 0.02)], atol=1e-6)
    shape = assembly.shape_of(assembly.parts[0])
    assert shape.closed
    # The material stands outside of the prototype: the reference drops its binding for instances.
    looks = {(p.color, assembly.shape_of(p).finishes) for p in assembly.parts}
    assert len(looks) == 1
