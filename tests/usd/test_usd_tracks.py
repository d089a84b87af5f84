"""Tracks in USD and MJCF: rings that are no part of the articulation, balls that carry, friction that rules."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import mujoco
import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdPhysics, UsdShade

from kit.machines.crawler import crawler
from kit.machines.solids import box, lathe
from kit.machines.tracked_template import write_tracked_template
from yellowiron import kinematics, usd
from yellowiron.checks import check
from yellowiron.exporters import export_mjcf, read_geometry
from yellowiron.library import load_template
from yellowiron.mechanism import build_mechanism
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.rows import expand
from yellowiron.model.specification import Specifications
from yellowiron.model.template import choose
from yellowiron.usd.planning.lathe_colliders import turned_pieces


@pytest.fixture(scope="module")
def machines(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[Mechanism, Path]]:
    """Mechanism and folder by choice of `tracks`; the shoes' material rules over friction."""
    folder = tmp_path_factory.mktemp("tracks")
    template = load_template(write_tracked_template(folder / "template"))
    slippery = {k: dataclasses.replace(m, friction_combine="min") for k, m in template.materials.items() if "shoe" in k}
    template = dataclasses.replace(template, materials={**template.materials, **slippery})
    drawn = crawler(24, 3, 1)
    made = {}
    for tracks in ("belt", "shoes"):
        aligned = drawn.aligned(shoes=tracks == "shoes")
        chosen = expand(choose(template, {"tracks": tracks}), aligned.counts)
        built = build_mechanism(drawn.assembly(), chosen, aligned, Specifications(), name="crawler")
        built = kinematics.complete(built)
        usd.write_machine(built, drawn.assembly(), folder / tracks, name="crawler")
        made[tracks] = (built, folder / tracks)
    return made


@pytest.mark.slow
@pytest.mark.parametrize("tracks", ["belt", "shoes"])
def test_comes_back(machines: dict[str, tuple[Mechanism, Path]], tracks: str) -> None:
    built, folder = machines[tracks]
    read = usd.read_mechanism(folder / "crawler.usda")
    assert read.floating == built.floating
    assert [j.cut for j in read.joints] == [j.cut for j in built.joints]
    assert {b.name: (b.shapes, b.pads) for b in read.bodies} == {b.name: (b.shapes, b.pads) for b in built.bodies}


def test_rings_are_not_in_the_articulation(machines: dict[str, tuple[Mechanism, Path]]) -> None:
    stage = Usd.Stage.Open(str(machines["shoes"][1] / "crawler.usda"))
    joints = [UsdPhysics.Joint(p) for p in stage.Traverse() if p.IsA(UsdPhysics.Joint)]
    ring = [j for j in joints if "shoe" in j.GetPrim().GetName()]
    assert len(ring) == 48
    assert all(j.GetExcludeFromArticulationAttr().Get() for j in ring)
    assert not any(j.GetExcludeFromArticulationAttr().Get() for j in joints if j not in ring)
    assert sum(p.HasAPI(UsdPhysics.ArticulationRootAPI) for p in stage.Traverse()) == 1


def test_shoes_may_touch_wheels(machines: dict[str, tuple[Mechanism, Path]]) -> None:
    stage = Usd.Stage.Open(str(machines["shoes"][1] / "crawler.usda"))
    pairs = {
        frozenset((prim.GetName(), target.name))
        for prim in stage.Traverse()
        if prim.HasAPI(UsdPhysics.FilteredPairsAPI)
        for target in UsdPhysics.FilteredPairsAPI(prim).GetFilteredPairsRel().GetTargets()
    }
    shoes = {f"track_shoe_l_{k}" for k in range(1, 25)}
    assert frozenset(("track_shoe_l_1", "track_shoe_l_2")) in pairs
    assert frozenset(("track_shoe_l_24", "track_shoe_l_1")) in pairs
    wheels = {"sprocket_l", "idler_l", "track_roller_l_1", "carrier_roller_l_1"}
    assert not [pair for pair in pairs if pair & shoes and pair & wheels]


def test_balls(machines: dict[str, tuple[Mechanism, Path]]) -> None:
    built, folder = machines["belt"]
    stage = Usd.Stage.Open(str(folder / "crawler.usda"))
    balls = [p for p in stage.Traverse() if p.IsA(UsdGeom.Sphere) and p.HasAPI(UsdPhysics.CollisionAPI)]
    assert len(balls) == 6
    assert all(UsdShade.MaterialBindingAPI(p).ComputeBoundMaterial("physics")[0] for p in balls)
    radius = UsdGeom.Sphere(balls[0]).GetRadiusAttr().Get()
    assert radius == built.body("track_wheel_l_1").shapes[0].radius
    assert not [p for p in stage.Traverse() if p.HasAPI(UsdPhysics.CollisionAPI) and p.GetName().startswith("shoe")]


def test_tracks_are_pads_while_the_brakes_are_set(machines: dict[str, tuple[Mechanism, Path]]) -> None:
    built, folder = machines["belt"]
    stage = Usd.Stage.Open(str(folder / "crawler.usda"))
    touching = {}
    for brakes in ("released", "set"):
        stage.GetDefaultPrim().GetVariantSet("Brakes").SetVariantSelection(brakes)
        colliders = [UsdPhysics.CollisionAPI(p) for p in stage.Traverse() if p.HasAPI(UsdPhysics.CollisionAPI)]
        kinds = [c.GetPrim().GetTypeName() for c in colliders if c.GetCollisionEnabledAttr().Get()]
        touching[brakes] = kinds.count("Sphere"), sum("_pad_" in c.GetPrim().GetName() for c in colliders)
    assert touching == {"released": (6, 0), "set": (0, 2)}
    bounds = UsdGeom.BBoxCache(Usd.TimeCode.Default(), [UsdGeom.Tokens.default_, UsdGeom.Tokens.guide])
    for pad in built.body("undercarriage").pads:
        prim = next(p for p in stage.Traverse() if p.GetName() == pad.name)
        assert UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")[0]
        box = bounds.ComputeWorldBound(prim).ComputeAlignedRange()
        wheels = [built.body(f"track_wheel_{pad.name[-1]}_{k}").shapes[0] for k in (1, 3)]
        assert box.GetMin()[2] == pytest.approx(0.0, abs=1e-6)
        assert (box.GetMax()[0], box.GetMin()[0]) == pytest.approx([w.center[0] for w in wheels], abs=1e-6)
        assert 0.5 * (box.GetMin()[1] + box.GetMax()[1]) == pytest.approx(wheels[0].center[1], abs=1e-6)


def test_a_check_knows_set_brakes_for_what_they_are(
    machines: dict[str, tuple[Mechanism, Path]], tmp_path: Path
) -> None:
    found = {}
    for number, (brakes, removed) in enumerate((("released", False), ("set", False), ("released", True))):
        file = tmp_path / f"{number}.usda"
        stage = Usd.Stage.CreateNew(str(file))
        stage.SetDefaultPrim(stage.DefinePrim("/World", "Xform"))
        UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
        UsdGeom.SetStageMetersPerUnit(stage, 1.0)
        UsdPhysics.Scene.Define(stage, "/World/scene")
        machine = stage.DefinePrim("/World/crawler", "Xform")
        machine.GetReferences().AddReference(str(machines["belt"][1] / "crawler.usda"))
        machine.GetVariantSet("Brakes").SetVariantSelection(brakes)
        balls = [str(p.GetPath()) for p in stage.Traverse() if p.IsA(UsdGeom.Sphere) and "wheel" in p.GetName()]
        for path in balls if removed else ():
            UsdPhysics.CollisionAPI(stage.GetPrimAtPath(path)).CreateCollisionEnabledAttr(False)
        stage.Save()
        found[brakes, removed] = {finding.code for finding in check(file)} & {"CHK100", "CHK124"}
    assert found == {("released", False): set(), ("set", False): set(), ("released", True): {"CHK100"}}


def test_exports_have_the_brakes_released_whatever_the_file_selects(
    machines: dict[str, tuple[Mechanism, Path]], tmp_path: Path
) -> None:
    stage = Usd.Stage.CreateNew(str(tmp_path / "braked.usda"))
    machine = stage.DefinePrim("/crawler")
    machine.GetReferences().AddReference(str(machines["belt"][1] / "crawler.usda"))
    machine.GetVariantSet("Brakes").SetVariantSelection("set")
    stage.Save()
    found = read_geometry(tmp_path / "braked.usda").bodies
    assert not [c for c in found["undercarriage"].colliders if "_pad_" in c.name]
    assert all(c.kind == "sphere" for name, body in found.items() if "wheel" in name for c in body.colliders)


def test_friction_rules_in_every_engine(machines: dict[str, tuple[Mechanism, Path]], tmp_path: Path) -> None:
    built, folder = machines["shoes"]
    stage = Usd.Stage.Open(str(folder / "crawler.usda"))
    shoe = next(p for p in stage.Traverse() if p.GetName().startswith("shoe") and p.HasAPI(UsdPhysics.CollisionAPI))
    material, _ = UsdShade.MaterialBindingAPI(shoe).ComputeBoundMaterial("physics")
    assert material.GetPrim().GetAttribute("physxMaterial:frictionCombineMode").Get() == "min"
    assert shoe.GetAttribute("mjc:priority").Get() == 1
    path = export_mjcf(built, folder / "crawler.usda", tmp_path)
    model = mujoco.MjModel.from_xml_path(str(path))
    names = [model.geom(i).name for i in range(model.ngeom)]
    ruling = {n.split(".")[0] for i, n in enumerate(names) if model.geom_priority[i] == 1}
    assert ruling == {b.name for b in built.bodies if "shoe" in b.name}


def test_mujoco_holds_the_ring(machines: dict[str, tuple[Mechanism, Path]], tmp_path: Path) -> None:
    """Hanging in the air for half a second, its pins stay together."""
    built, folder = machines["shoes"]
    path = export_mjcf(built, folder / "crawler.usda", tmp_path, base="fixed")
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    assert model.nv == 1 + 2 * (1 + 1 + 3 + 1) + 2 * (6 + 23)
    for _ in range(500):
        mujoco.mj_step(model, data)
    cut = next(j for j in built.joints if j.cut)
    ends = []
    for name in (cut.body0, cut.body1):
        number = model.body(name).id
        local = np.array(cut.anchor) - np.array(built.body(name).origin)
        ends.append(data.xpos[number] + data.xmat[number].reshape(3, 3) @ local)
    assert np.linalg.norm(ends[0] - ends[1]) < 1e-3
    # It has not fallen off the wheels that it hangs on.
    assert data.body("track_shoe_l_1").xpos[2] > -0.2


def test_turned_parts_keep_their_flanges() -> None:
    flanged = lathe("flanged", [(0.03, -0.1), (0.09, -0.1), (0.09, -0.08), (0.07, -0.08), (0.07, 0.1), (0.03, 0.1)])
    flange, tread = turned_pieces(flanged)
    for piece, radius, low, high in ((flange, 0.09, -0.1, -0.08), (tread, 0.07, -0.08, 0.1)):
        assert np.hypot(*piece.points[:, :2].T).max() == pytest.approx(radius, abs=1e-5)
        assert piece.points[:, 2].min() == pytest.approx(low, abs=1e-5)
        assert piece.points[:, 2].max() == pytest.approx(high, abs=1e-5)
    assert turned_pieces(box("block", 0.1, 0.1, 0.1)) == ()
