"""Defects planted in the bundled machine as it is built: each is found, and the machine as built has none.

Every mutation is one opinion over the machine's own scene. One of each kind is found in the machine as built, and all
of them in a copy that has lost its visuals and what the build recorded: then nothing but the physics tells. Nothing
here knows the machine's names: a mutation picks its victim by what it is.
"""

from __future__ import annotations

import itertools
import json
import math
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics

from yellowiron.checks import check

pytestmark = pytest.mark.slow


@dataclass
class Victims:
    """The machine on a stage, and prims to hurt."""

    stage: Usd.Stage

    def joints(self, kind: str = "", *, cut: bool | None = None, driven: bool | None = None) -> list[Usd.Prim]:
        found = [p for p in self.stage.Traverse() if p.IsA(UsdPhysics.Joint)]
        return [
            p
            for p in found
            if kind in str(p.GetTypeName())
            and (cut is None or bool(p.GetAttribute("physics:excludeFromArticulation").Get()) == cut)
            and (driven is None or bool(UsdPhysics.DriveAPI.GetAll(p)) == driven)
        ]

    @property
    def slide(self) -> Usd.Prim:
        return self.joints("Prismatic", driven=True)[-1]

    @property
    def passive(self) -> Usd.Prim:
        return self.joints("Prismatic", driven=False)[0]

    @property
    def pin(self) -> Usd.Prim:
        """A limited hinge on a driven cylinder: part of a loop."""
        ends = {str(t) for r in ("body0", "body1") for t in self.targets(self.slide, r)}
        hinges = self.joints("Revolute", driven=False)
        return next(j for j in hinges if ends & {str(t) for t in self.targets(j, "body1")})

    @property
    def rod_pin(self) -> Usd.Prim:
        ends = {str(t) for r in ("body0", "body1") for t in self.targets(self.slide, r)}
        hinges = self.joints("Revolute", driven=False)
        return next(j for j in hinges if ends & {str(t) for t in self.targets(j, "body0")})

    @property
    def cut(self) -> Usd.Prim:
        """The cut that closes the last loop."""
        return self.joints(cut=True)[-1]

    @property
    def axle(self) -> Usd.Prim:
        return self.joints("Revolute", driven=True)[0]

    @property
    def wheel(self) -> Usd.Prim:
        return self.stage.GetPrimAtPath(self.targets(self.axle, "body1")[0])

    @property
    def bodies(self) -> list[Usd.Prim]:
        return [p for p in self.stage.Traverse() if p.HasAPI(UsdPhysics.RigidBodyAPI)]

    @property
    def link(self) -> Usd.Prim:
        """The lightest body."""
        return min(self.bodies, key=lambda p: UsdPhysics.MassAPI(p).GetMassAttr().Get())

    @property
    def root(self) -> Usd.Prim:
        return next(p for p in self.stage.Traverse() if p.HasAPI(UsdPhysics.ArticulationRootAPI))

    @property
    def scene(self) -> Usd.Prim:
        return next(p for p in self.stage.Traverse() if p.IsA(UsdPhysics.Scene))

    @property
    def material(self) -> Usd.Prim:
        return next(p for p in self.stage.Traverse() if p.HasAPI(UsdPhysics.MaterialAPI))

    def collider(self, kind: str, body: Usd.Prim | None = None) -> Usd.Prim:
        prims = Usd.PrimRange(body) if body else self.stage.Traverse()
        found = (p for p in prims if p.HasAPI(UsdPhysics.CollisionAPI) and p.GetTypeName() == kind)
        return next(
            p for p in found if body or str(p.GetPath()).startswith(str(self.bodies[0].GetPath().GetParentPath()))
        )

    @staticmethod
    def targets(joint: Usd.Prim, name: str) -> list[Sdf.Path]:
        return list(joint.GetRelationship(f"physics:{name}").GetTargets())


def put(prim: Usd.Prim, name: str, value: object, kind: Sdf.ValueTypeName | None = None) -> None:
    attribute = prim.GetAttribute(name)
    if not attribute:
        assert kind is not None
        attribute = prim.CreateAttribute(name, kind, False)
    attribute.Set(value)


def scale(prim: Usd.Prim, name: str, factor: float) -> None:
    put(prim, name, prim.GetAttribute(name).Get() * factor)


def turn(prim: Usd.Prim, degrees: float, axis: tuple[float, float, float], *sides: int) -> None:
    """Turns a joint's frames about an axis of the bodies'."""
    by = Gf.Quatf(Gf.Rotation(Gf.Vec3d(*axis), degrees).GetQuat())
    for side in sides:
        attribute = prim.GetAttribute(f"physics:localRot{side}")
        attribute.Set(by * (attribute.Get() or Gf.Quatf(1.0)))


def shift(prim: Usd.Prim, offset: tuple[float, float, float], *sides: int) -> None:
    for side in sides:
        attribute = prim.GetAttribute(f"physics:localPos{side}")
        attribute.Set((attribute.Get() or Gf.Vec3f(0.0)) + Gf.Vec3f(*offset))


def hinge_line(prim: Usd.Prim) -> tuple[float, float, float]:
    axis = Gf.Rotation(Gf.Quatd(prim.GetAttribute("physics:localRot0").Get())).TransformDir(Gf.Vec3d(1, 0, 0))
    return (axis[0], axis[1], axis[2])


def drive(prim: Usd.Prim, instance: str) -> None:
    api = UsdPhysics.DriveAPI.Apply(prim, instance)
    api.CreateStiffnessAttr(1e6)
    api.CreateDampingAttr(1e5)


def unroot(v: Victims) -> None:
    """Newton's root schema brings UsdPhysics' with it, where it is registered."""
    root = v.root
    for schema in [s for s in root.GetAppliedSchemas() if "ArticulationRootAPI" in s]:
        root.RemoveAppliedSchema(schema)


def rename_drive(v: Victims) -> None:
    v.slide.RemoveAPI(UsdPhysics.DriveAPI, "linear")
    drive(v.slide, "X")


def swap_bodies(v: Victims) -> None:
    """Turns a tree joint in a chain around: body0 becomes the child."""
    joint = v.slide
    first, second = (Victims.targets(joint, n) for n in ("body0", "body1"))
    joint.GetRelationship("physics:body0").SetTargets(second)
    joint.GetRelationship("physics:body1").SetTargets(first)
    for name in ("localPos", "localRot"):
        one, two = (joint.GetAttribute(f"physics:{name}{i}") for i in (0, 1))
        values = one.Get(), two.Get()
        one.Set(values[1])
        two.Set(values[0])
    limits = [joint.GetAttribute(f"physics:{n}Limit") for n in ("lower", "upper")]
    lower, upper = (a.Get() for a in limits)
    limits[0].Set(-upper)
    limits[1].Set(-lower)


def nest(v: Victims) -> None:
    made = UsdGeom.Xform.Define(v.stage, v.wheel.GetPath().AppendChild("weight")).GetPrim()
    UsdPhysics.RigidBodyAPI.Apply(made)
    UsdPhysics.MassAPI.Apply(made).CreateMassAttr(100.0)
    UsdPhysics.CollisionAPI.Apply(UsdGeom.Cube.Define(v.stage, made.GetPath().AppendChild("shape")).GetPrim())
    joint = UsdPhysics.FixedJoint.Define(v.stage, v.root.GetPath().AppendChild("weight_mount"))
    joint.CreateBody0Rel().SetTargets([v.wheel.GetPath()])
    joint.CreateBody1Rel().SetTargets([made.GetPath()])


def stretch(v: Victims) -> None:
    UsdGeom.Xformable(v.wheel).AddScaleOp().Set(Gf.Vec3f(1.0, 1.5, 1.0))


def mirror(v: Victims) -> None:
    UsdGeom.Xformable(v.wheel).AddScaleOp().Set(Gf.Vec3f(1.0, -1.0, 1.0))


def no_inertia_for_a_gram(v: Victims) -> None:
    put(v.link, "physics:mass", 0.001)


def nan_points(v: Victims) -> None:
    points = v.collider("Mesh").GetAttribute("points")
    values = list(points.Get())
    values[0] = Gf.Vec3f(math.nan, 0.0, 0.0)
    points.Set(values)


def hide_colliders(v: Victims) -> None:
    for prim in Usd.PrimRange(v.wheel):
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            put(prim, "physics:collisionEnabled", False, Sdf.ValueTypeNames.Bool)


def refer(v: Victims) -> None:
    v.stage.DefinePrim(v.root.GetPath().AppendChild("lost")).GetReferences().AddReference("./lost.usda")


def absolute(v: Victims) -> None:
    put(v.stage.DefinePrim("/World/paint", "Shader"), "inputs:file", "/home/me/paint.mdl", Sdf.ValueTypeNames.Asset)


def weld(v: Victims) -> None:
    v.pin.SetTypeName("PhysicsFixedJoint")


def loosen(v: Victims) -> None:
    """A joint between two other bodies: the pin of the loop hangs elsewhere."""
    v.rod_pin.GetRelationship("physics:body1").SetTargets([v.wheel.GetPath()])


def degrees_twice(v: Victims) -> None:
    for name in ("lower", "upper"):
        scale(v.pin, f"physics:{name}Limit", math.degrees(1.0))


def radians(joint: Usd.Prim) -> None:
    for name in ("lower", "upper"):
        scale(joint, f"physics:{name}Limit", math.radians(1.0))


def oscillating(v: Victims) -> Usd.Prim:
    """A limited hinge outside any cylinder's loop: its limits are whole degrees."""
    hinges = v.joints("Revolute", driven=False)
    whole = [j for j in hinges if float(j.GetAttribute("physics:upperLimit").Get() or 0.5).is_integer()]
    return next(j for j in whole if math.isfinite(j.GetAttribute("physics:upperLimit").Get()))


def swap_limits(joint: Usd.Prim) -> None:
    lower, upper = (joint.GetAttribute(f"physics:{n}Limit") for n in ("lower", "upper"))
    values = lower.Get(), upper.Get()
    lower.Set(values[1])
    upper.Set(values[0])


ACROSS = (1.0, 0.0, 0.0)


def tilted(joint: Usd.Prim, degrees: float, *sides: int) -> None:
    """Turns a hinge out of its plane, about a line square to its axis."""
    line = Gf.Vec3d(*hinge_line(joint))
    square = Gf.Cross(line, Gf.Vec3d(1, 0, 0) if abs(line[0]) < 0.9 else Gf.Vec3d(0, 1, 0))
    turn(joint, degrees, tuple(square), *sides)


Mutation = Callable[[Victims], object]

MUTATIONS: dict[str, dict[str, tuple[Mutation, set[str]]]] = {
    "frames apart": {
        "a pin 1.3 m away": (lambda v: shift(v.pin, (1.3, 0, 0), 1), {"CHK050"}),
        "a cut pin 5 mm away": (lambda v: shift(v.cut, (0, 0, 0.005), 0), {"CHK050"}),
        "an axle 0.2 mm away": (lambda v: shift(v.axle, (0.0002, 0, 0), 1), {"CHK050"}),
    },
    "frame rotated": {
        "a pin by 30°": (lambda v: tilted(v.pin, 30, 1), {"CHK051"}),
        "a slide by 1°": (lambda v: turn(v.slide, 1, (0, 1, 0), 1), {"CHK051"}),
        "a pin about its own axis": (lambda v: turn(v.pin, 10, hinge_line(v.pin), 1), {"CHK053"}),
    },
    "wrong hinge axis": {
        "a pin of a loop by 5°": (lambda v: tilted(v.pin, 5, 0, 1), {"CHK092"}),
        "a rod pin by 90°": (lambda v: tilted(v.rod_pin, 90, 0, 1), {"CHK092"}),
        "a pin by 0.5°": (lambda v: tilted(v.pin, 0.5, 0, 1), {"CHK092"}),
        "an axle by 90°": (lambda v: tilted(v.axle, 90, 0, 1), {"CHK096"}),
    },
    "wrong slide axis": {
        "in its plane by 15°": (lambda v: turn(v.slide, 15, hinge_line(v.pin), 0, 1), {"CHK095"}),
        "out of its plane by 3°": (lambda v: turn(v.slide, 3, (0, 0, 1), 0, 1), {"CHK092"}),
    },
    "limits swapped": {
        "of a slide": (lambda v: swap_limits(v.slide), {"CHK060"}),
        "of a pin": (lambda v: swap_limits(v.pin), {"CHK060"}),
    },
    "limits in radians": {
        "of a pin of a loop": (lambda v: radians(v.pin), {"CHK062"}),
        "of a rod pin": (lambda v: radians(v.rod_pin), {"CHK062"}),
        "of a hinge of its own": (lambda v: radians(oscillating(v)), {"CHK062"}),
    },
    "limits converted twice": {"of a pin": (degrees_twice, {"CHK063"})},
    "limits without room": {
        "of a pin": (
            lambda v: [put(v.pin, f"physics:{n}Limit", 0.0) for n in ("lower", "upper")],
            {"CHK061"},
        ),
    },
    "drawn outside its limits": {"a slide": (lambda v: put(v.slide, "physics:lowerLimit", 0.05), {"CHK067"})},
    "stroke too long": {
        "90 m": (lambda v: put(v.slide, "physics:upperLimit", 90.0), {"CHK066"}),
        "a passive one of 900 m": (lambda v: put(v.passive, "physics:upperLimit", 900.0), {"CHK066"}),
    },
    "slide without limits": {
        "a driven one": (
            lambda v: [v.slide.GetAttribute(f"physics:{n}Limit").Block() for n in ("lower", "upper")],
            {"CHK064"},
        ),
        "a passive one": (lambda v: put(v.passive, "physics:upperLimit", math.inf), {"CHK064"}),
    },
    "stiffness": {
        "1e12": (lambda v: put(v.slide, "drive:linear:physics:stiffness", 1e12), {"CHK074"}),
        "negative": (lambda v: scale(v.slide, "drive:linear:physics:stiffness", -1.0), {"CHK073"}),
        "without damping": (lambda v: put(v.slide, "drive:linear:physics:damping", 0.0), {"CHK077"}),
    },
    "no force": {
        "of a cylinder": (lambda v: put(v.slide, "drive:linear:physics:maxForce", 0.0), {"CHK072"}),
        "of a motor": (lambda v: put(v.axle, "drive:angular:physics:maxForce", -1.0), {"CHK072"}),
    },
    "drive instance unknown": {"X": (rename_drive, {"CHK070"})},
    "drive on the wrong joint": {
        "angular on a slide": (lambda v: drive(v.slide, "angular"), {"CHK071"}),
        "linear on a hinge": (lambda v: drive(v.axle, "linear"), {"CHK071"}),
    },
    "drive target outside": {
        "in millimetres": (
            lambda v: put(v.slide, "drive:linear:physics:targetPosition", 300.0, Sdf.ValueTypeNames.Float),
            {"CHK075"},
        ),
    },
    "velocity limit": {
        "0": (lambda v: put(v.slide, "physxJoint:maxJointVelocity", 0.0), {"CHK076"}),
        "negative, Newton's": (lambda v: put(v.axle, "newton:velocityLimit", -5.0), {"CHK076"}),
    },
    "twins both driven": {"a passive slide": (lambda v: drive(v.passive, "linear"), {"CHK094"})},
    "driven and cut": {
        "a slide": (
            lambda v: put(v.slide, "physics:excludeFromArticulation", True, Sdf.ValueTypeNames.Bool),
            {"CHK078", "CHK084"},
        ),
    },
    "collider missing": {"of a wheel": (hide_colliders, {"CHK100"})},
    "collider as it is": {
        "a mesh without approximation": (
            lambda v: put(v.collider("Mesh"), "physics:approximation", "none"),
            {"CHK101"},
        ),
        "an unknown approximation": (
            lambda v: put(v.collider("Mesh"), "physics:approximation", "convexhull"),
            {"CHK102"},
        ),
        "a cylinder of no radius": (lambda v: put(v.collider("Cylinder"), "radius", 0.0), {"CHK103"}),
    },
    "link too light": {"1 g": (no_inertia_for_a_gram, {"CHK033"})},
    "mass": {
        "negative": (lambda v: scale(v.link, "physics:mass", -1.0), {"CHK030"}),
        "in grams": (lambda v: scale(v.link, "physics:mass", 1000.0), {"CHK034"}),
        "not a number": (lambda v: put(v.link, "physics:mass", math.nan), {"CHK004"}),
    },
    "inertia": {
        "impossible": (
            lambda v: put(v.wheel, "physics:diagonalInertia", Gf.Vec3f(1.0, 1.0, 500.0)),
            {"CHK035"},
        ),
        "of nothing": (
            lambda v: put(v.wheel, "physics:diagonalInertia", Gf.Vec3f(0.0, 100.0, 100.0)),
            {"CHK035"},
        ),
        "in kg·mm²": (lambda v: scale(v.wheel, "physics:diagonalInertia", 1e6), {"CHK036"}),
    },
    "centre of mass": {"in millimetres": (lambda v: scale(v.wheel, "physics:centerOfMass", 1000.0), {"CHK037"})},
    "pin removed": {
        "a cut one": (lambda v: v.cut.SetActive(False), {"CHK093"}),
        "a rod pin of the tree": (lambda v: v.rod_pin.SetActive(False), {"CHK083", "CHK093"}),
        "switched off": (
            lambda v: put(v.cut, "physics:jointEnabled", False, Sdf.ValueTypeNames.Bool),
            {"CHK045", "CHK093"},
        ),
        "hung elsewhere": (loosen, {"CHK050"}),
    },
    "pin welded": {"a barrel's": (weld, {"CHK090", "CHK094"})},
    "bodies nested": {"a weight in a wheel": (nest, {"CHK020"})},
    "body scaled": {
        "stretched": (stretch, {"CHK021"}),
        "mirrored": (mirror, {"CHK022"}),
    },
    "body kinematic": {
        "a link": (
            lambda v: put(v.link, "physics:kinematicEnabled", True, Sdf.ValueTypeNames.Bool),
            {"CHK023"},
        ),
    },
    "body no body": {"a wheel": (lambda v: v.wheel.RemoveAPI(UsdPhysics.RigidBodyAPI), {"CHK044"})},
    "articulation root": {
        "none": (unroot, {"CHK080"}),
        "two": (lambda v: UsdPhysics.ArticulationRootAPI.Apply(v.wheel), {"CHK081"}),
    },
    "loop not cut": {
        "a cut withdrawn": (lambda v: put(v.cut, "physics:excludeFromArticulation", False), {"CHK082"}),
    },
    "loop cut twice": {
        "a pin": (
            lambda v: put(v.pin, "physics:excludeFromArticulation", True, Sdf.ValueTypeNames.Bool),
            {"CHK083"},
        ),
    },
    "tree joint reversed": {"a slide": (swap_bodies, {"CHK085"})},
    "joint body": {
        "missing": (lambda v: v.pin.GetRelationship("physics:body1").SetTargets([]), {"CHK050", "CHK093"}),
        "both missing": (
            lambda v: [v.pin.GetRelationship(f"physics:body{i}").SetTargets([]) for i in (0, 1)],
            {"CHK040"},
        ),
        "not there": (
            lambda v: v.pin.GetRelationship("physics:body1").SetTargets([Sdf.Path("/World/nobody")]),
            {"CHK041"},
        ),
        "the same twice": (
            lambda v: v.pin.GetRelationship("physics:body1").SetTargets(Victims.targets(v.pin, "body0")),
            {"CHK042"},
        ),
        "several": (
            lambda v: v.pin.GetRelationship("physics:body1").AddTarget(v.wheel.GetPath()),
            {"CHK043"},
        ),
    },
    "joint rotation": {
        "a quaternion of length 2": (
            lambda v: put(v.pin, "physics:localRot0", v.pin.GetAttribute("physics:localRot0").Get() * 2.0),
            {"CHK052"},
        ),
    },
    "reference": {"broken": (refer, {"CHK010"}), "absolute": (absolute, {"CHK012"})},
    "not a number": {
        "a point": (nan_points, {"CHK004"}),
        "a place": (lambda v: put(v.wheel, "xformOp:translate", Gf.Vec3d(math.nan, 0.0, 0.0)), {"CHK004"}),
    },
    "units": {
        "none": (lambda v: v.stage.GetRootLayer().pseudoRoot.ClearInfo("metersPerUnit"), {"CHK002"}),
        "millimetres": (lambda v: UsdGeom.SetStageMetersPerUnit(v.stage, 0.001), {"CHK034"}),
        "no axis": (lambda v: v.stage.GetRootLayer().pseudoRoot.ClearInfo("upAxis"), {"CHK003"}),
    },
    "gravity": {
        "in other units": (
            lambda v: put(v.scene, "physics:gravityMagnitude", 981.0, Sdf.ValueTypeNames.Float),
            {"CHK007"},
        ),
    },
    "friction": {
        "negative": (lambda v: put(v.material, "physics:dynamicFriction", -0.3), {"CHK110"}),
        "bouncing": (lambda v: put(v.material, "physics:restitution", 1.7), {"CHK110"}),
        "sliding above static": (lambda v: put(v.material, "physics:staticFriction", 0.01), {"CHK111"}),
    },
}
FIRST = [(kind, *next(iter(group.values()))) for kind, group in MUTATIONS.items()]
CASES = [(f"{kind}: {what}", *case) for kind, group in MUTATIONS.items() for what, case in group.items()]
_COUNT = itertools.count()


@pytest.fixture(scope="session")
def built(built_loader: Any, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The example's scene, in a folder that is written to."""
    return shutil.copytree(built_loader.folder, tmp_path_factory.mktemp("checked") / "machine") / "scene.usda"


@pytest.fixture(scope="session")
def stripped(built: Path) -> Path:
    """The same scene in one file, without visuals, that says nothing of yellowiron."""
    stage = Usd.Stage.Open(str(built))
    stage.SetEditTarget(stage.GetSessionLayer())
    for prim in [p for p in stage.Traverse() if p.IsInstance()]:
        prim.SetActive(False)
    layer = stage.Flatten()
    path = built.parent / "stripped.usdc"

    def strip(spec_path: Sdf.Path) -> None:
        if spec_path.IsPrimPath():
            layer.GetObjectAtPath(spec_path).ClearInfo("customData")

    layer.Traverse(Sdf.Path.absoluteRootPath, strip)
    layer.Export(str(path))
    return path


def mutate(scene: Path, mutation: Mutation) -> Path:
    """A file beside the scene that holds one mutation of it."""
    original = Sdf.Layer.FindOrOpen(str(scene))
    root = Sdf.Layer.CreateAnonymous(".usda")
    root.subLayerPaths.append(original.identifier)
    for name in ("metersPerUnit", "kilogramsPerUnit", "upAxis", "defaultPrim"):
        root.pseudoRoot.SetInfo(name, original.pseudoRoot.GetInfo(name))
    mutation(Victims(Usd.Stage.Open(root)))
    path = scene.parent / f"mutant_{next(_COUNT)}.usda"
    text = root.ExportToString().replace(original.identifier, f"./{scene.name}")
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture
def ours_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """OpenUSD's own validators, a third of the work, are not asked: every defect here is one of our rules'."""
    monkeypatch.setattr("yellowiron.checks.validators.validate", lambda stage: [])


def codes(path: Path) -> set[str]:
    return {f.code for f in check(path)}


def test_there_are_enough() -> None:
    assert len(CASES) >= 80
    assert len(FIRST) >= 40


@pytest.mark.parametrize("scene", ["built", "stripped"])
def test_nothing_is_found_in_the_sound_machine(scene: str, request: pytest.FixtureRequest) -> None:
    assert check(request.getfixturevalue(scene)) == ()


def test_the_machine_alone_only_lacks_a_scene(built: Path) -> None:
    machine = next(p for p in built.parent.glob("*.usda") if p.stem != "scene" and not p.stem.startswith("mutant"))
    assert {f.code for f in check(machine)} == {"CHK006"}


@pytest.mark.usefixtures("ours_alone")
@pytest.mark.parametrize(("mutation", "expected"), [c[1:] for c in FIRST], ids=[c[0] for c in FIRST])
def test_a_planted_defect_is_found_in_the_built_machine(mutation: Mutation, expected: set[str], built: Path) -> None:
    found = codes(mutate(built, mutation))
    assert found & expected, sorted(found)


@pytest.mark.usefixtures("ours_alone")
@pytest.mark.parametrize(("mutation", "expected"), [c[1:] for c in CASES], ids=[c[0] for c in CASES])
def test_a_planted_defect_is_found_by_physics_alone(mutation: Mutation, expected: set[str], stripped: Path) -> None:
    found = codes(mutate(stripped, mutation))
    assert found & expected, sorted(found)


@pytest.mark.usefixtures("ours_alone")
def test_what_the_build_recorded_is_compared(built: Path) -> None:
    """Defects that only the record knows of."""
    cases: list[tuple[Mutation, str]] = [
        (lambda v: [shift(v.axle, (0.05, 0, 0), 0, 1)], "CHK122"),
        (lambda v: v.cut.SetActive(False), "CHK120"),
        (lambda v: v.cut.SetActive(False), "CHK126"),
        (lambda v: v.pin.SetTypeName("PhysicsSphericalJoint"), "CHK121"),
        (lambda v: v.link.RemoveAPI(UsdPhysics.RigidBodyAPI), "CHK121"),
        (lambda v: scale(v.pin, "physics:upperLimit", 0.9), "CHK123"),
        (lambda v: scale(v.slide, "drive:linear:physics:maxForce", 2.0), "CHK124"),
        (lambda v: scale(v.link, "physics:mass", 1.1), "CHK125"),
        (lambda v: put(v.link, "physics:density", 7000.0, Sdf.ValueTypeNames.Float), "CHK013"),
    ]
    for mutation, code in cases:
        assert code in codes(mutate(built, mutation))


@pytest.mark.parametrize(("variant", "choice", "expected"), [("Base", "fixed", "CHK006"), ("Physics", "off", "CHK027")])
def test_every_variant_is_sound(built: Path, variant: str, choice: str, expected: str) -> None:
    machine = next(p for p in built.parent.glob("*.usda") if p.stem != "scene" and not p.stem.startswith("mutant"))

    def choose(v: Victims) -> None:
        v.stage.GetDefaultPrim().GetVariantSet(variant).SetVariantSelection(choice)

    assert codes(mutate(machine, choose)) == {expected}


def test_findings_are_json(built: Path) -> None:
    assert json.loads(json.dumps([f.__dict__ for f in check(mutate(built, rename_drive))]))
