"""CAD to USD and nothing else."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdPhysics, UsdShade

from yellowiron.model.errors import OutputError
from yellowiron.usd import write_assembly


@pytest.mark.parametrize("suffix", [".usd", ".usda", ".usdc"])
def test_tree_instances_and_places(machine, tmp_path: Path, suffix: str) -> None:
    path = write_assembly(machine.assembly, tmp_path / "new folder" / f"out{suffix}")
    stage = Usd.Stage.Open(str(path))
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1.0
    assert stage.GetDefaultPrim().GetName() == "MACHINE"
    cache = UsdGeom.XformCache()
    parts = {p.GetCustomDataByKey("yellowiron:part"): p for p in stage.Traverse()}
    for part in machine.assembly.parts:
        prim = parts[part.id]
        assert prim.IsInstance()
        assert (prim.GetDisplayName() or prim.GetName()) == part.name
        assert np.allclose(np.array(cache.GetLocalToWorldTransform(prim)).T, part.transform)
    assert parts["MACHINE/FRAME/BEAM"].GetPath() == "/MACHINE/FRAME/BEAM"
    assert not any(p.HasAPI(UsdPhysics.RigidBodyAPI) for p in stage.Traverse())
    assert [p.name for p in (tmp_path / "new folder").iterdir()] == [path.name]


def test_shapes_are_shared_and_not_drawn_at_the_origin(machine, tmp_path: Path) -> None:
    stage = Usd.Stage.Open(str(write_assembly(machine.assembly, tmp_path / "out.usdc")))
    shapes = stage.GetPrimAtPath("/Shapes")
    assert shapes.IsAbstract()
    assert len(shapes.GetAllChildren()) == 8  # seven shapes, one of them in two colours
    assert len(stage.GetPrototypes()) == 8


def test_colour_reaches_the_instance(machine, tmp_path: Path) -> None:
    stage = Usd.Stage.Open(str(write_assembly(machine.assembly, tmp_path / "out.usdc")))
    mesh = stage.GetPrimAtPath("/MACHINE/FRAME/BEAM/mesh")
    shader = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()[0].ComputeSurfaceSource()[0]
    assert np.allclose(shader.GetInput("diffuseColor").Get(), (0.9, 0.6, 0.05))


def test_triangle_colours_show_through_a_primvar(machine, tmp_path: Path) -> None:
    part = machine.assembly.parts[1]
    shape = machine.assembly.shape_of(part)
    colours = np.tile([[0.1, 0.2, 0.3]], (len(shape.mesh.triangles), 1))
    painted = replace(shape, key="painted", mesh=replace(shape.mesh, triangle_colors=colours))
    assembly = replace(machine.assembly, parts=(replace(part, shape="painted"),), shapes={"painted": painted})
    stage = Usd.Stage.Open(str(write_assembly(assembly, tmp_path / "out.usda")))
    mesh = next(p for p in stage.Traverse(Usd.TraverseInstanceProxies()) if p.IsA(UsdGeom.Mesh))
    primvar = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("displayColor")
    assert primvar.GetInterpolation() == "uniform"
    assert len(primvar.Get()) == len(UsdGeom.Mesh(mesh).GetFaceVertexCountsAttr().Get())


def test_same_bytes_twice(machine, tmp_path: Path) -> None:
    for suffix in (".usda", ".usdc"):
        first = write_assembly(machine.assembly, tmp_path / f"a{suffix}").read_bytes()
        assert write_assembly(machine.assembly, tmp_path / "other" / f"a{suffix}").read_bytes() == first


def test_an_empty_assembly(machine, tmp_path: Path) -> None:
    path = write_assembly(replace(machine.assembly, parts=(), name=""), tmp_path / "out.usda")
    assert Usd.Stage.Open(str(path)).GetDefaultPrim().GetName() == "assembly"


def test_an_assembly_called_like_the_shapes(machine, tmp_path: Path) -> None:
    stage = Usd.Stage.Open(str(write_assembly(replace(machine.assembly, name="Shapes"), tmp_path / "out.usda")))
    assert stage.GetDefaultPrim().GetPath() == "/Shapes"
    assert not stage.GetDefaultPrim().IsAbstract()


def test_another_extension(machine, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="no USD extension"):
        write_assembly(machine.assembly, tmp_path / "out.obj")


def test_an_unwritable_place_leaves_nothing(machine, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="cannot be written"):
        write_assembly(machine.assembly, tmp_path / "file" / "out.usda")
    assert [p.name for p in tmp_path.iterdir()] == ["file"]
