"""Machines as other tools write them: whatever their units, axes and hierarchy, a sound one gives no error.

The styles are those of Isaac Sim's URDF importer (centimetres, Y up, the articulation root on the base link, links as
siblings, joints in a scope, instanceable visuals and collisions) and of the MuJoCo and Newton converters (nested
bodies, joints inside their bodies, several joints between two bodies, actuators as prims, an equality that closes the
loop). Both are the same luffing crane: a boom on a slewing column, raised by a cylinder.
"""

from __future__ import annotations

import importlib.util
import json
import math
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade

from yellowiron.checks import check
from yellowiron.model.finding import Finding

LUFF = math.degrees(math.atan2(0.3, 1.0))
"""The cylinder's angle above the horizontal."""


def start(path: Path, *, meters: float, up: str) -> Usd.Stage:
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, meters)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    UsdGeom.SetStageUpAxis(stage, up)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/crane").GetPrim())
    return stage


def rotation(axis: tuple[float, float, float], degrees: float) -> Gf.Quatf:
    return Gf.Quatf(Gf.Rotation(Gf.Vec3d(*axis), degrees).GetQuat())


def weigh(prim: Usd.Prim, mass: float, moments: tuple[float, float, float], center: Gf.Vec3f) -> None:
    UsdPhysics.RigidBodyAPI.Apply(prim)
    api = UsdPhysics.MassAPI.Apply(prim)
    api.CreateMassAttr(mass)
    api.CreateDiagonalInertiaAttr(Gf.Vec3f(*moments))
    api.CreatePrincipalAxesAttr(Gf.Quatf(1.0))
    api.CreateCenterOfMassAttr(center)


def place(prim: Usd.Prim, at: Gf.Vec3d, turned: Gf.Quatf | None = None, size: Gf.Vec3d | None = None) -> None:
    xform = UsdGeom.Xformable(prim)
    xform.AddTranslateOp().Set(at)
    if turned is not None:
        xform.AddOrientOp(UsdGeom.XformOp.PrecisionFloat).Set(turned)
    if size is not None:
        xform.AddScaleOp(UsdGeom.XformOp.PrecisionDouble).Set(size)


def cube(stage: Usd.Stage, path: str, at: Gf.Vec3d, size: Gf.Vec3d, turned: Gf.Quatf | None = None) -> Usd.Prim:
    shape = UsdGeom.Cube.Define(stage, path)
    shape.CreateSizeAttr(1.0)
    shape.CreateExtentAttr([Gf.Vec3f(-0.5), Gf.Vec3f(0.5)])
    place(shape.GetPrim(), at, turned, size)
    return shape.GetPrim()


def connect(
    joint: UsdPhysics.Joint, first: str, second: str, at0: Gf.Vec3f, at1: Gf.Vec3f, turned: Gf.Quatf | None = None
) -> Usd.Prim:
    if first:
        joint.CreateBody0Rel().SetTargets([Sdf.Path(first)])
    joint.CreateBody1Rel().SetTargets([Sdf.Path(second)])
    for position, attribute in ((at0, joint.CreateLocalPos0Attr()), (at1, joint.CreateLocalPos1Attr())):
        attribute.Set(position)
    for attribute in (joint.CreateLocalRot0Attr(), joint.CreateLocalRot1Attr()):
        attribute.Set(turned or Gf.Quatf(1.0))
    return joint.GetPrim()


def limit(prim: Usd.Prim, lower: float, upper: float) -> None:
    prim.CreateAttribute("physics:lowerLimit", Sdf.ValueTypeNames.Float, False).Set(lower)
    prim.CreateAttribute("physics:upperLimit", Sdf.ValueTypeNames.Float, False).Set(upper)


def importer_style(path: Path) -> Path:
    """Isaac Sim's URDF importer: centimetres, Y up, so positions are (x, up, -left) · 100; hinges about Z."""
    stage = start(path, meters=0.01, up="Y")
    shapes = UsdGeom.Xform.Define(stage, "/shapes")
    shapes.GetPrim().SetSpecifier(Sdf.SpecifierClass)
    tilt = rotation((0, 0, 1), LUFF)
    along = Gf.Vec3f(math.cos(math.radians(LUFF)), math.sin(math.radians(LUFF)), 0.0)
    links = {
        "base_link": (Gf.Vec3d(0, 0, 0), Gf.Vec3d(120, 40, 120), Gf.Vec3f(0, 20, 0), None, 900.0, (2e6, 2e6, 2e6)),
        "column": (Gf.Vec3d(0, 40, 0), Gf.Vec3d(40, 60, 40), Gf.Vec3f(0, 30, 0), None, 300.0, (1.3e5, 8e4, 1.3e5)),
        "boom": (Gf.Vec3d(0, 90, 0), Gf.Vec3d(300, 20, 20), Gf.Vec3f(150, 0, 0), None, 250.0, (2e4, 1.9e6, 1.9e6)),
        "barrel": (Gf.Vec3d(10, 60, 0), Gf.Vec3d(70, 12, 12), along * 35, tilt, 40.0, (1e3, 1.7e4, 1.7e4)),
        "rod": (Gf.Vec3d(110, 90, 0), Gf.Vec3d(70, 6, 6), along * -35, tilt, 20.0, (120, 8.2e3, 8.2e3)),
    }
    for name, (at, size, center, turned, mass, moments) in links.items():
        library = cube(stage, f"/shapes/{name}/mesh", Gf.Vec3d(*center), size, turned)
        UsdPhysics.CollisionAPI.Apply(library)
        link = UsdGeom.Xform.Define(stage, f"/crane/{name}").GetPrim()
        place(link, at, Gf.Quatf(1.0), Gf.Vec3d(1.0))
        weigh(link, mass, moments, center)
        for kind in ("visuals", "collisions"):
            prim = UsdGeom.Xform.Define(stage, f"/crane/{name}/{kind}").GetPrim()
            prim.GetReferences().AddInternalReference(f"/shapes/{name}")
            prim.SetInstanceable(True)
    UsdPhysics.ArticulationRootAPI.Apply(stage.GetPrimAtPath("/crane/base_link"))
    UsdGeom.Scope.Define(stage, "/crane/joints")

    def of(kind: type[Any], name: str, axis: str) -> Any:
        made = kind.Define(stage, f"/crane/joints/{name}")
        made.CreateAxisAttr(axis)
        return made

    hinge, slide = UsdPhysics.RevoluteJoint, UsdPhysics.PrismaticJoint
    zero, crane = Gf.Vec3f(0.0), "/crane"
    connect(UsdPhysics.FixedJoint.Define(stage, "/crane/root_joint"), "", f"{crane}/base_link", zero, zero)
    slew = connect(of(hinge, "slew", "Y"), f"{crane}/base_link", f"{crane}/column", Gf.Vec3f(0, 40, 0), zero)
    drive = UsdPhysics.DriveAPI.Apply(slew, "angular")
    drive.CreateStiffnessAttr(1e7)
    drive.CreateDampingAttr(1e6)
    luff = connect(of(hinge, "luff", "Z"), f"{crane}/column", f"{crane}/boom", Gf.Vec3f(0, 50, 0), zero)
    luff.GetAttribute("physics:excludeFromArticulation").Set(True)
    limit(luff, -30.0, 60.0)
    foot = connect(of(hinge, "foot", "Z"), f"{crane}/column", f"{crane}/barrel", Gf.Vec3f(10, 20, 0), zero)
    limit(foot, -60.0, 60.0)
    stroke = connect(
        of(slide, "stroke", "X"), f"{crane}/barrel", f"{crane}/rod", Gf.Vec3f(100, 30, 0), zero, tilt
    )  # fmt: skip
    limit(stroke, -30.0, 25.0)
    drive = UsdPhysics.DriveAPI.Apply(stroke, "linear")
    drive.CreateStiffnessAttr(1e6)
    drive.CreateDampingAttr(1e5)
    drive.CreateMaxForceAttr(5e6)
    head = connect(of(hinge, "head", "Z"), f"{crane}/rod", f"{crane}/boom", zero, Gf.Vec3f(110, 0, 0))
    limit(head, -60.0, 60.0)
    paint = UsdShade.Material.Define(stage, "/crane/Looks/paint")
    shader = UsdShade.Shader.Define(stage, "/crane/Looks/paint/shader")
    shader.GetPrim().CreateAttribute("info:implementationSource", Sdf.ValueTypeNames.Token, False).Set("sourceAsset")
    shader.SetSourceAsset(Sdf.AssetPath("OmniPBR.mdl"), "mdl")
    paint.CreateSurfaceOutput("mdl").ConnectToSource(shader.CreateOutput("out", Sdf.ValueTypeNames.Token))
    UsdPhysics.Scene.Define(stage, "/physicsScene")
    stage.GetRootLayer().Save()
    return path


def converter_style(path: Path) -> Path:
    """The MuJoCo converter: metres, bodies nested as the tree, joints in their bodies, actuators and equalities."""
    stage = start(path, meters=1.0, up="Z")
    tilt = rotation((0, 1, 0), -LUFF)
    along = Gf.Vec3f(math.cos(math.radians(LUFF)), 0.0, math.sin(math.radians(LUFF)))
    base = "/crane/geometry/base"
    head = f"{base}/head"
    rod = f"{head}/barrel/rod"
    v, c = Gf.Vec3d, Gf.Vec3f
    links = {
        base: (v(0, 0, 0), v(1.2, 1.2, 0.4), c(0, 0, 0.2), None, 900.0, (200, 200, 216)),
        head: (v(0, 0, 0.4), v(0.4, 0.4, 0.6), c(0, 0, 0.3), None, 300.0, (13, 13, 8)),
        f"{head}/barrel": (v(0.1, 0, 0.2), v(0.7, 0.12, 0.12), along * 0.35, tilt, 40.0, (0.1, 1.7, 1.7)),
        rod: (v(1, 0, 0.3), v(0.7, 0.06, 0.06), along * -0.35, tilt, 20.0, (0.012, 0.82, 0.82)),
        f"{head}/boom": (v(0, 0, 0.5), v(3, 0.2, 0.2), c(1.5, 0, 0), None, 250.0, (2, 190, 190)),
    }
    for link, (at, size, center, turned, mass, moments) in links.items():
        prim = UsdGeom.Xform.Define(stage, link).GetPrim()
        place(prim, at)
        weigh(prim, mass, moments, center)
        UsdPhysics.CollisionAPI.Apply(cube(stage, f"{link}/shape", Gf.Vec3d(*center), size, turned))
    UsdPhysics.ArticulationRootAPI.Apply(stage.GetPrimAtPath(base))
    zero = Gf.Vec3f(0.0)

    def hinge(path: str, axis: str) -> Any:
        made = UsdPhysics.RevoluteJoint.Define(stage, path)
        made.CreateAxisAttr(axis)
        return made

    connect(UsdPhysics.FixedJoint.Define(stage, f"{base}/weld"), "/crane", base, zero, zero)
    # A joint of two freedoms is two joints between the same bodies.
    connect(hinge(f"{head}/slew", "Z"), base, head, Gf.Vec3f(0, 0, 0.4), zero)
    tip = connect(hinge(f"{head}/tip", "X"), base, head, Gf.Vec3f(0, 0, 0.4), zero)
    limit(tip, -2.0, 2.0)
    limit(connect(hinge(f"{head}/barrel/foot", "Y"), head, f"{head}/barrel", Gf.Vec3f(0.1, 0, 0.2), zero), -60.0, 60.0)
    slide = UsdPhysics.PrismaticJoint.Define(stage, f"{head}/barrel/rod/stroke")
    slide.CreateAxisAttr("X")
    limit(connect(slide, f"{head}/barrel", rod, Gf.Vec3f(1, 0, 0.3), zero, tilt), -0.3, 0.25)
    limit(connect(hinge(f"{head}/boom/luff", "Y"), head, f"{head}/boom", Gf.Vec3f(0, 0, 0.5), zero), -60.0, 30.0)
    eye = UsdPhysics.SphericalJoint.Define(stage, "/crane/physics/eye")
    prim = connect(eye, rod, f"{head}/boom", zero, Gf.Vec3f(1.1, 0, 0))
    prim.GetAttribute("physics:excludeFromArticulation").Set(True)
    prim.AddAppliedSchema("MjcEqualityConnectAPI")
    for name, target in (("slew", f"{head}/slew"), ("tip", f"{head}/tip"), ("lift", f"{rod}/stroke")):
        actuator = stage.DefinePrim(f"/crane/physics/{name}_motor", "MjcActuator")
        actuator.CreateRelationship("mjc:target", False).SetTargets([Sdf.Path(target)])
    UsdPhysics.Scene.Define(stage, "/scene")
    stage.GetRootLayer().Save()
    return path


STYLES = {"importer": importer_style, "converter": converter_style}


def severe(findings: tuple[Finding, ...]) -> list[Finding]:
    return [f for f in findings if f.severity == "error"]


@pytest.mark.parametrize("style", STYLES)
def test_a_sound_machine_of_another_tool_gives_no_error(style: str, tmp_path: Path) -> None:
    findings = check(STYLES[style](tmp_path / "crane.usda"))
    assert not severe(findings)
    # Nested bodies are that converter's way, and older engines do not follow it.
    expected = {"importer": set(), "converter": {"CHK020"}}[style]
    assert {f.code for f in findings if f.severity == "warning"} == expected


@pytest.mark.parametrize("style", STYLES)
def test_their_defects_are_found_in_their_units(style: str, tmp_path: Path) -> None:
    path = STYLES[style](tmp_path / "crane.usda")
    text = path.read_text(encoding="utf-8")
    swap = {"importer": "float physics:upperLimit = 25", "converter": "float physics:upperLimit = 0.25"}[style]
    assert text.count(swap) == 1
    long = tmp_path / "long.usda"
    long.write_text(text.replace(swap, swap.split(" = ")[0] + " = 9000"), encoding="utf-8")
    assert {f.code for f in severe(check(long))} == {"CHK066"}


def test_zx120_as_its_urdf_gives_no_error(shared_data: Path, tmp_path: Path) -> None:
    """A real excavator's joints, as its authors published them, in an importer's way: a plain tree, no drives."""
    truth = json.loads((shared_data / "zx120" / "zx120.truth.json").read_text(encoding="utf-8"))
    path = tmp_path / "zx120.usda"
    stage = start(path, meters=1.0, up="Z")
    UsdPhysics.ArticulationRootAPI.Apply(stage.GetDefaultPrim())
    joints = truth["joints"]
    origin = {j["child"]: Gf.Vec3d(*j["xyz"]) for j in joints}
    for link in dict.fromkeys(n for j in joints for n in (j["parent"], j["child"])):
        prim = UsdGeom.Xform.Define(stage, f"/crane/{link}").GetPrim()
        place(prim, origin.get(link, Gf.Vec3d(0.0)))
        weigh(prim, 500.0, (50.0, 50.0, 50.0), Gf.Vec3f(0.0))
        UsdPhysics.CollisionAPI.Apply(cube(stage, f"/crane/{link}/shape", Gf.Vec3d(0.0), Gf.Vec3d(0.8)))
    hinge, slide = UsdPhysics.RevoluteJoint, UsdPhysics.PrismaticJoint
    kinds = {"revolute": hinge, "continuous": hinge, "prismatic": slide}
    for joint in joints:
        made = kinds.get(joint["type"], UsdPhysics.FixedJoint).Define(stage, f"/crane/joints/{joint['name']}")
        at, axis = Gf.Vec3d(*joint["xyz"]), Gf.Vec3d(*joint["axis"])
        turned = Gf.Quatf(Gf.Rotation(Gf.Vec3d(1, 0, 0), axis).GetQuat())
        parent = Gf.Vec3f(at - origin.get(joint["parent"], Gf.Vec3d(0.0)))
        prim = connect(made, f"/crane/{joint['parent']}", f"/crane/{joint['child']}", parent, Gf.Vec3f(0.0), turned)
        if joint["type"] == "prismatic":
            limit(prim, -0.5, 0.5)
    UsdPhysics.Scene.Define(stage, "/scene")
    stage.GetRootLayer().Save()
    assert {f.code for f in check(path) if f.severity != "info"} == set()


def layered(urdf: Path, folder: Path) -> Path:
    """A URDF as the URDF converter of NVIDIA writes it: an interface with a payload, a layer each for geometry and
    physics, links nested as the tree in a scope, joints in another, mimics as applied schemas, the base welded to the
    default prim, colliders as invisible guides."""
    root = ElementTree.parse(urdf).getroot()
    joints = root.findall("joint")
    contents = folder / "Payload" / "Contents.usda"
    contents.parent.mkdir(parents=True)
    below = [start(contents.with_name(f"{name}.usda"), meters=1.0, up="Z") for name in ("Physics", "Geometry")]
    physics, geometry = (each.GetRootLayer() for each in below)
    for layer in (physics, geometry):
        layer.Save()
    stage = start(contents, meters=1.0, up="Z")
    stage.GetRootLayer().subLayerPaths[:] = ["./Physics.usda", "./Geometry.usda"]
    parents = {j.find("child").get("link"): j for j in joints}  # type: ignore[union-attr]

    def numbers(element: ElementTree.Element | None, key: str, default: str) -> list[float]:
        return [float(x) for x in (element.get(key, default) if element is not None else default).split()]

    def path_of(link: str) -> str:
        joint = parents.get(link)
        above = path_of(joint.find("parent").get("link")) if joint is not None else "/crane/Geometry"  # type: ignore
        return f"{above}/{link}"

    for link in (each.get("name", "") for each in root.findall("link")):
        joint = parents.get(link)
        stage.SetEditTarget(geometry)
        prim = UsdGeom.Xform.Define(stage, path_of(link)).GetPrim()
        if joint is None:
            continue
        x, y, z = numbers(joint.find("origin"), "xyz", "0 0 0")
        place(prim, Gf.Vec3d(x, y, z), Gf.Quatf(1.0), Gf.Vec3d(1.0))
        shape = cube(stage, f"{path_of(link)}/guide", Gf.Vec3d(0.0), Gf.Vec3d(0.8))
        UsdGeom.Imageable(shape).CreatePurposeAttr("guide")
        stage.SetEditTarget(physics)
        weigh(prim, 500.0, (50.0, 50.0, 50.0), Gf.Vec3f(0.0))
        UsdPhysics.CollisionAPI.Apply(shape)
    stage.SetEditTarget(physics)
    for joint in joints:
        parent, child = joint.find("parent").get("link"), joint.find("child").get("link")  # type: ignore[union-attr]
        kind = {"revolute": UsdPhysics.RevoluteJoint, "continuous": UsdPhysics.RevoluteJoint,
                "prismatic": UsdPhysics.PrismaticJoint}.get(joint.get("type", ""), UsdPhysics.FixedJoint)  # fmt: skip
        made = kind.Define(stage, f"/crane/Physics/{joint.get('name')}")
        axis = numbers(joint.find("axis"), "xyz", "1 0 0")
        turned = Gf.Quatf(Gf.Rotation(Gf.Vec3d(1, 0, 0), Gf.Vec3d(*axis)).GetQuat())
        base = parent not in parents
        at = Gf.Vec3f(*numbers(joint.find("origin"), "xyz", "0 0 0"))
        prim = connect(made, "/crane" if base else path_of(str(parent)), path_of(str(child)), at, Gf.Vec3f(0.0), turned)
        bounds = joint.find("limit")
        if bounds is not None and joint.get("type") in ("revolute", "prismatic"):
            ends = [float(bounds.get(key, "0")) for key in ("lower", "upper")]
            limit(prim, *(ends if joint.get("type") == "prismatic" else map(math.degrees, ends)))
        mimic = joint.find("mimic")
        if mimic is not None:
            prim.AddAppliedSchema("NewtonMimicAPI")
            leader = prim.CreateRelationship("newton:mimicJoint", False)
            leader.SetTargets([Sdf.Path(f"/crane/Physics/{mimic.get('joint')}")])
        if base:
            UsdPhysics.ArticulationRootAPI.Apply(stage.GetPrimAtPath("/crane"))
    UsdPhysics.Scene.Define(stage, "/PhysicsScene")
    for layer in (stage.GetRootLayer(), physics, geometry):
        layer.Save()
    interface = start(folder / "zx120.usda", meters=1.0, up="Z")
    interface.GetDefaultPrim().GetPayloads().AddPayload("./Payload/Contents.usda")
    interface.DefinePrim("/PhysicsScene").GetPayloads().AddPayload("./Payload/Contents.usda", "/PhysicsScene")
    interface.GetRootLayer().Save()
    return folder / "zx120.usda"


def test_zx120_in_layers_and_nested_is_told_what_engines_do_not_couple(shared_data: Path, tmp_path: Path) -> None:
    """The same excavator from its own URDF, in the layers and the nesting of a converter of today. Its rods mimic
    hinges: a slide cannot follow a pivot."""
    path = layered(shared_data / "zx120" / "original" / "zx120.urdf", tmp_path)
    stage = Usd.Stage.Open(str(path))
    assert sum(prim.IsA(UsdPhysics.Joint) for prim in stage.Traverse()) >= 12
    assert {f.code for f in check(path) if f.severity != "info"} == {"CHK020", "CHK098"}


@pytest.mark.slow
def test_newtons_own_assets_give_no_error_of_ours() -> None:
    """The robots that Newton ships with (where it is installed)."""
    found = importlib.util.find_spec("newton")
    if found is None or not found.submodule_search_locations:
        pytest.skip("newton is not here")
    assets = sorted((Path(found.submodule_search_locations[0]) / "examples" / "assets").glob("*.usd*"))
    assert assets
    for asset in assets:
        assert not [f for f in severe(check(asset)) if f.code.startswith("CHK")], asset.name
