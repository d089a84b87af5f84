"""The layers of a machine: which there are, what is in which, that they move, and that they are the same every time."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade

from yellowiron.model.errors import MechanismError, OutputError
from yellowiron.usd import count_joints, write_machine

FILES = {
    "test_machine.usda",
    "scene.usda",
    "payloads/geometry.usdc",
    "payloads/base.usda",
    "payloads/physics.usda",
    "payloads/physx.usda",
    "payloads/mujoco.usda",
    "payloads/sensors.usda",
    "payloads/textures/rust.png",
}


def files_of(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


@pytest.fixture
def stage(written: Path) -> Usd.Stage:
    return Usd.Stage.Open(str(written / "test_machine.usda"))


def open_to_edit(folder: Path) -> Usd.Stage:
    """A stage whose edits stay in its session layer."""
    stage = Usd.Stage.Open(str(folder / "test_machine.usda"))
    stage.SetEditTarget(stage.GetSessionLayer())
    return stage


def test_files(written: Path) -> None:
    assert set(files_of(written)) == FILES


def test_returns_what_it_wrote(write: Callable[..., tuple[Path, ...]], tmp_path: Path) -> None:
    paths = write(tmp_path)
    assert paths[0] == tmp_path / "test_machine.usda"
    assert {str(p.relative_to(tmp_path)) for p in paths} == FILES


@pytest.mark.slow
def test_same_bytes_twice_and_from_another_process(written: Path, tmp_path: Path, root: Path) -> None:
    script = (
        "import sys, pathlib, tempfile; sys.path.insert(0, 'tests/usd'); import conftest as c\n"
        "from yellowiron.usd import write_machine\n"
        "class Factory:\n    def mktemp(self, name): return pathlib.Path(tempfile.mkdtemp())\n"
        "m = c.machine._get_wrapped_function()(c.shapes._get_wrapped_function()(), Factory())\n"
        "write_machine(m.mechanism, m.assembly, sys.argv[1], name='test_machine', texture_folders=[m.texture_folder])"
    )
    for seed in ("1", "2"):
        environment = {**os.environ, "PYTHONPATH": str(root / "src"), "PYTHONHASHSEED": seed, "TMPDIR": str(tmp_path)}
        folder = tmp_path / seed / "deeper"
        subprocess.run([sys.executable, "-c", script, str(folder)], cwd=root, env=environment, check=True)
        assert files_of(folder) == files_of(written)


def test_every_path_is_relative(written: Path) -> None:
    for path in written.rglob("*.usd*"):
        layer = Sdf.Layer.FindOrOpen(str(path))
        for asset in layer.GetCompositionAssetDependencies():
            assert not asset or asset.startswith("./"), f"{path.name}: {asset}"
        assert str(written.parent) not in layer.ExportToString()


def test_opens_from_any_folder(written: Path, tmp_path: Path) -> None:
    elsewhere = tmp_path / "mit Leerzeichen" / "机器"
    shutil.copytree(written, elsewhere)
    for name in ("test_machine.usda", "scene.usda"):
        stage = Usd.Stage.Open(str(elsewhere / name))
        assert not stage.GetCompositionErrors()
        assert any(p.IsA(UsdPhysics.RevoluteJoint) for p in stage.Traverse())


def test_units_and_default_prim(written: Path) -> None:
    for path in written.rglob("*.usd*"):
        layer = Sdf.Layer.FindOrOpen(str(path))
        info = layer.pseudoRoot
        assert info.GetInfo("metersPerUnit") == info.GetInfo("kilogramsPerUnit") == 1.0
        assert info.GetInfo("upAxis") == "Z"
        assert layer.GetPrimAtPath(f"/{layer.defaultPrim}"), path


def test_machine_file_has_no_scene(stage: Usd.Stage) -> None:
    types = {p.GetTypeName() for p in stage.Traverse()}
    assert not types & {"PhysicsScene", "DomeLight", "DistantLight", "Plane"}


def test_scene_stands_on_ground(written: Path) -> None:
    stage = Usd.Stage.Open(str(written / "scene.usda"))
    types = [p.GetTypeName() for p in stage.Traverse()]
    assert types.count("PhysicsScene") == types.count("Plane") == types.count("DomeLight") == 1
    scene = next(p for p in stage.Traverse() if p.GetTypeName() == "PhysicsScene")
    assert scene.GetAttribute("physxScene:solverType").Get() == "TGS"
    assert stage.GetPrimAtPath("/World/test_machine").HasPayload()


def test_bodies_are_flat_and_stand_at_their_origins(stage: Usd.Stage, machine) -> None:
    root = stage.GetDefaultPrim()
    cache = UsdGeom.XformCache()
    bodies = [p for p in stage.Traverse() if p.HasAPI(UsdPhysics.RigidBodyAPI)]
    assert [p.GetParent() for p in bodies] == [root] * len(machine.mechanism.bodies)
    for prim, body in zip(bodies, machine.mechanism.bodies, strict=True):
        assert prim.GetCustomDataByKey("yellowiron:name") == body.name
        expected = np.eye(4)
        expected[3, :3] = body.origin
        assert np.array_equal(np.array(cache.GetLocalToWorldTransform(prim)), expected)


def test_names_keep_their_script_and_what_is_illegal_is_displayed(stage: Usd.Stage) -> None:
    assert stage.GetPrimAtPath("/test_machine/铲斗")
    bolt = stage.GetPrimAtPath("/test_machine/arm/visuals/bolt_1_2_")
    assert bolt.GetDisplayName() == 'bolt 1/2"'
    assert stage.GetPrimAtPath("/test_machine/arm/visuals/bolt_1_2__2").GetDisplayName() == 'bolt 1/2"'
    assert stage.GetDefaultPrim().GetDisplayName() == "Prüfmaschine 1"


def test_parts_are_instances_placed_as_drawn(stage: Usd.Stage, machine) -> None:
    cache = UsdGeom.XformCache()
    parts = {p.GetCustomDataByKey("yellowiron:part"): p for p in stage.Traverse()}
    parts.pop(None)
    assert len(parts) == len(machine.assembly.parts)
    for part in machine.assembly.parts:
        prim = parts[part.id]
        assert prim.IsInstance()
        assert np.allclose(np.array(cache.GetLocalToWorldTransform(prim)).T, part.transform, atol=1e-12)
        mesh = UsdGeom.Mesh(prim.GetPrototype().GetChild("mesh"))
        drawn = np.array(mesh.GetPointsAttr().Get()) @ part.transform[:3, :3].T + part.transform[:3, 3]
        expected = machine.assembly.points_of(part)
        for extreme in (np.min, np.max):
            assert np.allclose(extreme(drawn, axis=0), extreme(expected, axis=0), atol=1e-6)


def test_one_prototype_a_shape_and_look_and_instances_share_it(stage: Usd.Stage) -> None:
    folder = Path(stage.GetRootLayer().realPath).parent
    layer = Sdf.Layer.FindOrOpen(str(folder / "payloads" / "geometry.usdc"))
    prototypes = [spec.name for spec in layer.GetPrimAtPath("/Prototypes").nameChildren]
    # BEAM in its own colour and with the texture, brackets of steel, of no material; the others once.
    assert sorted(prototypes) == sorted(
        ["BEAM", "BEAM_2", "bracket", "bracket_2", "WHEEL", "PIN_50x300", "铲斗", "Kugel_Größe_3", "Kapsel"]
    )


def test_material_is_inside_the_prototype_and_reaches_instances(stage: Usd.Stage) -> None:
    def material_of(path: str) -> UsdShade.Material:
        prim = stage.GetPrimAtPath(path + "/mesh")
        assert prim.IsInstanceProxy()
        return UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]

    wheel = material_of("/test_machine/wheel_l/visuals/WHEEL")
    shader = wheel.ComputeSurfaceSource()[0]
    assert shader.GetIdAttr().Get() == "UsdPreviewSurface"
    assert np.allclose(shader.GetInput("diffuseColor").Get(), (0.02, 0.02, 0.02))
    assert shader.GetInput("roughness").Get() == pytest.approx(0.9)
    beam = material_of("/test_machine/frame/visuals/BEAM").ComputeSurfaceSource()[0]
    assert np.allclose(beam.GetInput("diffuseColor").Get(), (0.9, 0.6, 0.05))
    assert beam.GetInput("metallic").Get() == pytest.approx(0.9)


def test_texture_is_copied_and_mapped(stage: Usd.Stage) -> None:
    prim = stage.GetPrimAtPath("/test_machine/arm/visuals/BEAM/mesh")
    coordinates = UsdGeom.PrimvarsAPI(prim).GetPrimvar("st").ComputeFlattened()
    assert len(coordinates) == len(UsdGeom.Mesh(prim).GetFaceVertexIndicesAttr().Get())
    material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
    texture = UsdShade.Shader(material.GetPrim().GetChild("texture"))
    file = texture.GetInput("file").Get()
    assert file.path == "./textures/rust.png"
    assert Path(file.resolvedPath).is_file()


def test_physics_variant(written: Path) -> None:
    stage = open_to_edit(written)
    stage.GetDefaultPrim().GetVariantSet("Physics").SetVariantSelection("off")
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        assert not [s for s in prim.GetAppliedSchemas() if re.match("Physics|Physx|Mjc", s)]
        assert not prim.IsA(UsdPhysics.Joint)
        assert not [a for a in prim.GetAuthoredAttributes() if a.GetName().startswith("physics:")]


def test_base_variant(written: Path) -> None:
    stage = open_to_edit(written)
    root = stage.GetDefaultPrim()
    assert root.GetVariantSet("Base").GetVariantSelection() == "floating"

    def world_joints() -> list[Usd.Prim]:
        return [
            p
            for p in stage.Traverse()
            if p.IsA(UsdPhysics.FixedJoint) and root.GetPath() in UsdPhysics.Joint(p).GetBody0Rel().GetTargets()
        ]

    assert not world_joints()
    root.GetVariantSet("Base").SetVariantSelection("fixed")
    (joint,) = world_joints()
    assert UsdPhysics.Joint(joint).GetBody1Rel().GetTargets() == [root.GetPath().AppendChild("frame")]
    root.GetVariantSet("Physics").SetVariantSelection("off")
    assert not world_joints()


def test_physics_opinions_only_in_their_layers(written: Path) -> None:
    for name, pattern in (
        ("test_machine.usda", r"physics:|physx\w*:|mjc:|newton:|API\b"),
        ("payloads/base.usda", r"physics:|physx\w*:|mjc:|newton:|(Physics|Physx|Mjc|Newton)\w+"),
        ("payloads/physics.usda", r"physx|mjc:|newton:|Physx|Mjc|Newton"),
        ("payloads/physx.usda", r"mjc:|newton:|Mjc|Newton"),
        ("payloads/mujoco.usda", r"physx|Physx|physics:"),
    ):
        text = Sdf.Layer.FindOrOpen(str(written / name)).ExportToString()
        assert not re.search(pattern, text), name


def test_mass_properties(stage: Usd.Stage, machine) -> None:
    for body in machine.mechanism.bodies:
        prim = stage.GetPrimAtPath(f"/test_machine/{body.name}")
        api = UsdPhysics.MassAPI(prim)
        assert api.GetMassAttr().Get() == pytest.approx(body.mass)
        center = np.array(api.GetCenterOfMassAttr().Get()) + body.origin
        assert np.allclose(center, body.center_of_mass, atol=1e-6)
        rotation = api.GetPrincipalAxesAttr().Get()
        axes = np.array(Gf.Matrix3d(Gf.Rotation(Gf.Quatd(rotation)))).T
        moments = np.array(api.GetDiagonalInertiaAttr().Get())
        assert np.allclose(axes @ np.diag(moments) @ axes.T, body.inertia, rtol=0, atol=1e-5 * np.max(moments))


def test_articulation_root_and_solver(stage: Usd.Stage) -> None:
    roots = [p for p in stage.Traverse() if p.HasAPI(UsdPhysics.ArticulationRootAPI)]
    assert [str(r.GetPath().name) for r in roots] == ["frame"]
    assert roots[0].GetAttribute("physxArticulation:solverPositionIterationCount").Get() >= 32
    assert roots[0].GetAttribute("physxArticulation:enabledSelfCollisions").Get() is False
    assert roots[0].GetAttribute("newton:selfCollisionEnabled").Get() is False


def test_filtered_pairs(stage: Usd.Stage, machine) -> None:
    pairs = set()
    for prim in stage.Traverse():
        for target in UsdPhysics.FilteredPairsAPI(prim).GetFilteredPairsRel().GetTargets():
            pairs.add(frozenset((prim.GetName(), target.name)))
    for joint in machine.mechanism.joints:
        assert frozenset((joint.body0, joint.body1)) in pairs
    assert frozenset(("frame", "chain")) not in pairs


def test_physics_materials(stage: Usd.Stage) -> None:
    steel = stage.GetPrimAtPath("/test_machine/materials/steel")
    api = UsdPhysics.MaterialAPI(steel)
    values = (api.GetDensityAttr(), api.GetStaticFrictionAttr(), api.GetDynamicFrictionAttr(), api.GetRestitutionAttr())
    assert [v.Get() for v in values] == pytest.approx([7850.0, 0.6, 0.5, 0.1])
    assert steel.GetAttribute("yellowiron:elasticity").Get() == pytest.approx(2.1e11)
    collider = stage.GetPrimAtPath("/test_machine/wheel_l/colliders/WHEEL")
    bound = UsdShade.MaterialBindingAPI(collider).ComputeBoundMaterial("physics")[0]
    assert bound.GetPath() == "/test_machine/materials/rubber"


def test_contacts_in_physx_give_way_critically_damped_but_those_of_tyres(stage: Usd.Stage) -> None:
    """Per mass, as Newton's and MuJoCo's do."""
    for prim in stage.GetPrimAtPath("/test_machine/materials").GetChildren():
        per_mass, stiffness, damping = (
            prim.GetAttribute(f"physxMaterial:compliantContact{name}").Get()
            for name in ("AccelerationSpring", "Stiffness", "Damping")
        )
        if prim.GetName() == "rubber":
            assert (per_mass, stiffness, damping) == (None, None, None)
        else:
            assert per_mass is True, prim.GetName()
            assert damping == pytest.approx(2.0 * stiffness**0.5)


def test_counts(written: Path) -> None:
    assert count_joints(written / "test_machine.usda") == {
        "bodies": 10,
        "revolute": 5,
        "prismatic": 1,
        "fixed": 1,
        "spherical": 2,
        "distance": 1,
        "linear_drives": 1,
        "angular_drives": 1,
        "loops": 1,
    }


def test_frame_takes_cad_to_machine(machine, tmp_path: Path) -> None:
    frame = np.array([[0.0, -1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 2.0], [0.0, 0.0, 1.0, 3.0], [0.0, 0.0, 0.0, 1.0]])
    arguments = {"name": "turned", "frame": frame, "texture_folders": [machine.texture_folder]}
    stage = Usd.Stage.Open(str(write_machine(machine.mechanism, machine.assembly, tmp_path, **arguments)[0]))
    part = machine.assembly.parts[0]
    prim = stage.GetPrimAtPath("/turned/frame/visuals/BEAM")
    placed = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(prim)).T
    assert np.allclose(placed, frame @ part.transform, atol=1e-12)


@pytest.mark.parametrize(("name", "error"), [("scene", OutputError), ("a/b", OutputError), ("", OutputError)])
def test_bad_name(machine, tmp_path: Path, name: str, error: type[Exception]) -> None:
    with pytest.raises(error) as raised:
        write_machine(machine.mechanism, machine.assembly, tmp_path, name=name)
    assert raised.value.hint
    assert not list(tmp_path.iterdir())


def test_part_without_geometry(machine, tmp_path: Path) -> None:
    fewer = replace(machine.assembly, parts=machine.assembly.parts[1:])
    with pytest.raises(MechanismError, match="has a part that the CAD model has not"):
        write_machine(machine.mechanism, fewer, tmp_path, name="m")


def test_missing_texture(machine, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="texture file is not there") as raised:
        write_machine(machine.mechanism, machine.assembly, tmp_path, name="m")
    assert raised.value.where == "rust.png"


def test_unwritable_folder(machine, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("not a folder")
    with pytest.raises(OutputError):
        write_machine(
            machine.mechanism, machine.assembly, tmp_path / "file", name="m", texture_folders=[machine.texture_folder]
        )
