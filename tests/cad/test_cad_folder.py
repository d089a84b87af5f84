"""Folders of part files: one assembly, one unit, nothing twice."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from test_cad_triangles import CORNERS, FACES, binary

from kit.cadfiles.exports import ITEMS, urdf
from kit.cadfiles.step import Node, Use, box, translation, write_step
from yellowiron.cad import read_cad
from yellowiron.model.errors import CadError

pytestmark = pytest.mark.usefixtures("read_here")

BOX = CORNERS[FACES]


def test_stl_files_share_one_unit(tmp_path: Path) -> None:
    """A bolt of 30 mm and a frame of 4 m, both in millimetres: alone the bolt would be 30 m long."""
    folder = tmp_path / "loader"
    (folder / "front").mkdir(parents=True)
    (folder / "FRAME.stl").write_bytes(binary(BOX * 1000.0))
    (folder / "front" / "BOLT.stl").write_bytes(binary(BOX * 7.0))
    (folder / "notes.txt").write_text("nothing")
    assembly = read_cad(folder)
    assert [p.id for p in assembly.parts] == ["FRAME", "front/BOLT"]
    assert assembly.name == "loader" and assembly.unit == 1e-3
    volumes = [assembly.shape_of(p).volume * np.linalg.det(p.transform[:3, :3]) for p in assembly.parts]
    assert volumes == pytest.approx([24.0, 24.0 * 0.007**3], rel=1e-5)
    assert [f.code for f in assembly.findings] == ["CAD009"]


def test_step_files_hang_below_their_names(tmp_path: Path) -> None:
    write_step(tmp_path / "BOOM.step", Node("BOOM", box(100.0, 50.0, 20.0)))
    plate = Node("PLATE", box(10.0, 10.0, 1.0))
    two = Node("ARM", children=[Use(plate), Use(plate, translation(500.0, 0.0, 0.0))])
    write_step(tmp_path / "ARM.step", two)
    assembly = read_cad(tmp_path)
    assert [p.id for p in assembly.parts] == ["ARM/ARM/PLATE", "ARM/ARM/PLATE#2", "BOOM"]
    assert len(assembly.shapes) == 2


def test_a_robots_meshes_are_read_with_it(tmp_path: Path) -> None:
    mesh = (CORNERS * 0.1, FACES)
    urdf(tmp_path / "machine.urdf", {i.shape: mesh for i in ITEMS})
    assembly = read_cad(tmp_path)
    assert len(assembly.parts) == len(ITEMS) and assembly.format == "URDF"


def test_what_cannot_be_read_is_named(tmp_path: Path) -> None:
    with pytest.raises(CadError, match="holds no CAD file"):
        read_cad(tmp_path)
    (tmp_path / "arm.sldprt").write_bytes(bytes.fromhex("d0cf11e0a1b11ae1") + bytes(500))
    (tmp_path / "boom.stl").write_bytes(binary(BOX))
    assembly = read_cad(tmp_path)
    assert len(assembly.parts) == 1
    assert any(f.code == "CAD008" and "SolidWorks" in f.message for f in assembly.findings)
    outside = tmp_path.parent / "outside.stl"
    outside.write_bytes(binary(BOX))
    (tmp_path / "link.stl").symlink_to(outside)
    assert len(read_cad(tmp_path).parts) == 1


def test_blender(tmp_path: Path) -> None:
    if importlib.util.find_spec("bpy") is None:
        pytest.skip("bpy (the extra blender) is not here")
    script = (
        "import bpy, sys\n"
        "bpy.ops.wm.read_factory_settings(use_empty=True)\n"
        "bpy.ops.mesh.primitive_cube_add(size=1, location=(1, 2, 3)); bpy.context.object.name = 'BOOM'\n"
        "m = bpy.data.materials.new('Paint'); m.use_nodes = True; n = m.node_tree.nodes\n"
        "b = next(e for e in n if e.type == 'BSDF_PRINCIPLED')\n"
        "b.inputs['Metallic'].default_value = 0.25; b.inputs['Roughness'].default_value = 0.75\n"
        "i = bpy.data.images.new('paint', 8, 8); i.pixels = [1, 0.5, 0, 1] * 64; i.pack()\n"
        "t = n.new('ShaderNodeTexImage'); t.image = i\n"
        "m.node_tree.links.new(t.outputs['Color'], b.inputs['Base Color'])\n"
        "bpy.context.object.data.materials.append(m)\n"
        "bpy.ops.object.duplicate(linked=True); bpy.context.object.location = (4, 0, 0)\n"
        "bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])\n"
    )
    path = tmp_path / "machine.blend"
    subprocess.run([sys.executable, "-c", script, str(path)], check=True, capture_output=True)
    assembly = read_cad(path)
    assert [p.name.partition(".")[0] for p in assembly.parts] == ["BOOM", "BOOM"] and len(assembly.shapes) == 1
    centres = sorted(assembly.points_of(p).mean(axis=0).tolist() for p in assembly.parts)
    assert np.allclose(centres, [[1.0, 2.0, 3.0], [4.0, 0.0, 0.0]])
    shape = assembly.shape_of(assembly.parts[0])
    (finish,) = shape.finishes
    assert (finish.metallic, finish.roughness) == (0.25, 0.75)
    assert finish.texture is not None and shape.mesh.uvs is not None
    assert assembly.parts[0].color == pytest.approx((1.0, 0.216, 0.0), abs=0.01)
