"""Speeds and forces each way in Newton, whose MuJoCo solver knows no speed limit: two actuators of MuJoCo's a drive.

A servo, whose force range is what the damper takes at rated speed, and that damper: however far the target, the joint
goes no faster than rated, each way its own (`Drive.rated`, and MJCF's actuators, which say the same). Newton joins both
with the joint's `PhysicsDriveAPI` and its `joint_target_q`; where MuJoCo's attributes are not registered with its
builder, that drive alone is left, which overshoots rated speed. PhysX knows nothing of them.
"""

from __future__ import annotations

from pxr import Sdf, Vt

from yellowiron.model.mechanism import Drive
from yellowiron.usd.authoring.metadata import set_custom
from yellowiron.usd.authoring.stage import Types, define, set_attribute, set_targets
from yellowiron.usd.planning.plan import ACTUATORS, Plan

SERVO, DAMPER = "servo", "damper"
"""The kinds of these prims in their records."""
_TERMS = 10
"""Numbers that MuJoCo takes of a gain and of a bias."""


def write_servos(layer: Sdf.Layer, plan: Plan) -> None:
    """A servo and a damper for every drive whose speed can be limited so."""
    home = f"{plan.root}/{ACTUATORS}"
    for joint in plan.mechanism.joints:
        drive = joint.drive
        if drive is None or joint.cut or not drive.rated:
            continue
        if layer.GetPrimAtPath(home) is None:
            define(layer, home, "Scope")
        target = plan.joint_paths[joint.name]
        name = target.rsplit("/", 1)[-1]
        for kind, path in ((SERVO, f"{home}/{name}"), (DAMPER, f"{home}/{name}_damping")):
            spec = define(layer, path, "MjcActuator")
            set_targets(spec, "mjc:target", target)
            set_attribute(spec, "mjc:biasType", Types.Token, "affine", uniform=True)
            write_gains(spec, kind, drive)
            set_custom(spec, {"kind": kind, "name": joint.name})


def write_gains(spec: Sdf.PrimSpec, kind: str, drive: Drive) -> None:
    """The gains of a drive's servo or damper, N/m and N·s/m or per radian; of the servo the forces that its damper
    takes at rated speed."""
    if kind == SERVO:
        terms = (drive.stiffness,), (0.0, -drive.stiffness, 0.0)
        for end, value in (("min", -drive.damping * drive.speeds[0]), ("max", drive.damping * drive.speeds[1])):
            set_attribute(spec, f"mjc:forceRange:{end}", Types.Double, float(value), uniform=True)
    else:
        terms = (drive.damping,), (0.0, 0.0, -drive.damping)
    for name, values in zip(("gainPrm", "biasPrm"), terms, strict=True):
        padded = Vt.DoubleArray([*values, *[0.0] * (_TERMS - len(values))])
        set_attribute(spec, f"mjc:{name}", Types.DoubleArray, padded, uniform=True)
