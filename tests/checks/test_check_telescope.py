"""A cylinder beside the slide of two sections: its pivots stand still, which locks nothing."""

from __future__ import annotations

from pathlib import Path

from pxr import Gf, Usd, UsdGeom, UsdPhysics

from yellowiron.checks import check

PIVOTS = {"foot": ("outer", "barrel", (0.5, 0.0, 0.0)), "head": ("inner", "rod", (2.0, 0.0, 0.0))}


def _stage(path: Path, tilt: float = 0.0) -> Path:
    """Two sections, and a cylinder between them whose slide is turned by `tilt` degrees from theirs."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    machine = UsdGeom.Xform.Define(stage, "/machine")
    stage.SetDefaultPrim(machine.GetPrim())
    for name in ("outer", "inner", "barrel", "rod"):
        body = UsdGeom.Xform.Define(stage, f"/machine/{name}").GetPrim()
        UsdPhysics.RigidBodyAPI.Apply(body)
        mass = UsdPhysics.MassAPI.Apply(body)
        mass.CreateMassAttr(10.0)
        mass.CreateDiagonalInertiaAttr(Gf.Vec3f(1.0))
        mass.CreateCenterOfMassAttr(Gf.Vec3f(0.0))
        mass.CreatePrincipalAxesAttr(Gf.Quatf(1.0))
    UsdPhysics.ArticulationRootAPI.Apply(stage.GetPrimAtPath("/machine/outer"))
    slides = {"sections": ("outer", "inner", 0.0), "cylinder": ("barrel", "rod", tilt)}
    for name, (a, b, angle) in slides.items():
        slide = UsdPhysics.PrismaticJoint.Define(stage, f"/machine/{name}")
        slide.CreateAxisAttr("X")
        slide.CreateLowerLimitAttr(-0.5)
        slide.CreateUpperLimitAttr(0.5)
        turn = Gf.Rotation(Gf.Vec3d(0, 1, 0), angle).GetQuat()
        _join(slide, a, b, (0.5, 0.0, 0.0), Gf.Quatf(turn))
        if name == "cylinder":
            drive = UsdPhysics.DriveAPI.Apply(slide.GetPrim(), "linear")
            drive.CreateStiffnessAttr(1e6)
    for name, (a, b, at) in PIVOTS.items():
        pivot = UsdPhysics.RevoluteJoint.Define(stage, f"/machine/{name}")
        pivot.CreateAxisAttr("Y")
        _join(pivot, a, b, at, Gf.Quatf(1.0))
        pivot.CreateExcludeFromArticulationAttr(name == "head")
    stage.GetRootLayer().Save()
    return path


def _join(joint: UsdPhysics.Joint, a: str, b: str, at: tuple[float, float, float], turn: Gf.Quatf) -> None:
    joint.CreateBody0Rel().SetTargets([f"/machine/{a}"])
    joint.CreateBody1Rel().SetTargets([f"/machine/{b}"])
    for position in (joint.CreateLocalPos0Attr, joint.CreateLocalPos1Attr):
        position(Gf.Vec3f(*at))
    for rotation in (joint.CreateLocalRot0Attr, joint.CreateLocalRot1Attr):
        rotation(turn)


def test_pivots_that_stand_still_are_not_remarked(tmp_path: Path) -> None:
    assert "CHK091" not in {f.code for f in check(_stage(tmp_path / "telescope.usda"))}


def test_a_slide_that_leans_turns_them(tmp_path: Path) -> None:
    """It is no other case: with pivots the cylinder may stand as it likes."""
    assert "CHK091" not in {f.code for f in check(_stage(tmp_path / "telescope.usda", 3.0))}
